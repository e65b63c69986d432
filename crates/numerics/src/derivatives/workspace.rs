//! Memory for the drivers.

use crate::{Dual, Gradient, Jet, Real};

/// Memory for the derivatives of formulas of n variables and m values, taken once.
///
/// `T` is the scalar of the points and `D` the number of directions differentiated at once: 4 suits small
/// formulas, 8 long ones with many variables on machines with wide registers.
///
/// # Example
/// ```
/// use piola_numerics::{Real, derivatives::{self, ScalarFunction, Workspace}};
/// struct Product;
/// impl ScalarFunction for Product {
///     fn call<T: Real>(&self, x: &[T]) -> T {
///         x[0] * x[1]
///     }
/// }
/// let (mut work, x, v) = (Workspace::<f64>::new(2), [3.0, 4.0], [1.0, 2.0]);
/// let (mut gradient, mut hessian, mut product) = ([0.0; 2], [0.0; 4], [0.0; 2]);
/// assert_eq!(derivatives::gradient_into(&mut work, &Product, &x, &mut gradient)?, 12.0);
/// derivatives::hessian_into(&mut work, &Product, &x, &mut gradient, &mut hessian)?;
/// assert_eq!((gradient, hessian), ([4.0, 3.0], [0.0, 1.0, 1.0, 0.0]));
/// // Along x + s v: (3 + s)(4 + 2s) = 12 + 10 s + 2 s².
/// assert_eq!(derivatives::directional(&mut work, &Product, &x, &v)?, (12.0, 10.0, 4.0));
/// assert_eq!(derivatives::mixed(&mut work, &Product, &x, &v, &[0.0, 1.0])?, 1.0);
/// derivatives::hessian_vector_product_into(&mut work, &Product, &x, &v, &mut product)?;
/// assert_eq!(product, [2.0, 1.0]);
/// # Ok::<(), piola_numerics::NumericsError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Workspace<T: Real = f64, const D: usize = 4> {
    pub(super) duals: Vec<Dual<T>>,
    pub(super) dual_values: Vec<Dual<T>>,
    pub(super) nested: Vec<Dual<Dual<T>>>,
    pub(super) jets: Vec<Jet<T, 0>>,
    pub(super) gradients: Vec<Gradient<T, D>>,
    pub(super) gradient_values: Vec<Gradient<T, D>>,
    pub(super) gradients_of_duals: Vec<Gradient<Dual<T>, D>>,
    pub(super) gradients_of_gradients: Vec<Gradient<Gradient<T, D>, D>>,
}

impl<T: Real, const D: usize> Workspace<T, D> {
    /// For formulas of `variables` variables with one value.
    #[must_use]
    pub fn new(variables: usize) -> Self {
        Self::with_values(variables, 0)
    }
    /// For formulas of `variables` variables with up to `values` values.
    #[must_use]
    pub fn with_values(variables: usize, values: usize) -> Self {
        const { assert!(0 < D, "at least one direction is taken at once") };
        let zero = T::zero();
        Self {
            duals: vec![Dual::constant(zero); variables],
            dual_values: vec![Dual::constant(zero); values],
            nested: vec![Dual::constant(Dual::constant(zero)); variables],
            jets: vec![Jet::constant(zero); variables],
            gradients: vec![Gradient::constant(zero); variables],
            gradient_values: vec![Gradient::constant(zero); values],
            gradients_of_duals: vec![Gradient::constant(Dual::constant(zero)); variables],
            gradients_of_gradients: vec![Gradient::constant(Gradient::constant(zero)); variables],
        }
    }
    /// The number of variables n.
    #[must_use]
    pub fn variables(&self) -> usize {
        self.duals.len()
    }
}
