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
///         x.iter().fold(T::lit(1.0), |product, &x| product * x)
///     }
/// }
/// let mut workspace = Workspace::<f64>::new(3);
/// let mut gradient = [0.0; 3];
/// let value = derivatives::gradient_into(&Product, &[1.0, 2.0, 3.0], &mut workspace, &mut gradient)?;
/// assert_eq!((value, gradient), (6.0, [6.0, 3.0, 2.0]));
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
