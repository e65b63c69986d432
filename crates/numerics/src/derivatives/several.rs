//! Derivatives of formulas of several variables.

use nalgebra::{DMatrix, DVector};

use super::{ScalarFunction, VectorFunction, Workspace};
use crate::error::{check_dimension, check_finite};
use crate::{Dual, Gradient, Jet, NumericsError, Real};

/// Refuses a point that does not fit the workspace or is not finite.
fn check_point<T: Real, const D: usize>(x: &[T], workspace: &Workspace<T, D>) -> Result<(), NumericsError> {
    check_dimension("x", x.len(), workspace.variables())?;
    check_finite("x", x)
}

/// Refuses a direction that does not fit the point or is not finite.
fn check_direction<T: Real>(quantity: &'static str, direction: &[T], x: &[T]) -> Result<(), NumericsError> {
    check_dimension(quantity, direction.len(), x.len())?;
    check_finite(quantity, direction)
}

/// Seeds `out` with D variables at the point from `first` on; the others are constants.
#[inline]
fn seed<T: Real, const D: usize>(out: &mut [Gradient<T, D>], point: impl Iterator<Item = T>, first: usize) {
    for (i, (out, x)) in out.iter_mut().zip(point).enumerate() {
        // Before `first` the difference wraps to a number that is no direction.
        *out = Gradient::variable(x, i.wrapping_sub(first));
    }
}

/// Writes ∇f(x), n entries, to `gradient` and returns f(x).
///
/// # Errors
/// See [the module](super#errors).
///
/// # Example
/// See [`Workspace`].
pub fn gradient_into<T: Real, const D: usize>(
    f: &impl ScalarFunction,
    x: &[T],
    workspace: &mut Workspace<T, D>,
    gradient: &mut [T],
) -> Result<T, NumericsError> {
    check_point(x, workspace)?;
    check_dimension("gradient", gradient.len(), x.len())?;
    if x.is_empty() {
        return value_of_constant(f.call(x));
    }
    let mut value = T::zero();
    for (chunk, out) in gradient.chunks_mut(D).enumerate() {
        seed(&mut workspace.gradients, x.iter().copied(), chunk * D);
        let result = f.call(&workspace.gradients);
        out.copy_from_slice(&result.partials[..out.len()]);
        value = result.value;
    }
    check_finite("value", &[value])?;
    check_finite("gradient", gradient)?;
    Ok(value)
}

/// The value of a formula of no variables.
fn value_of_constant<T: Real>(value: T) -> Result<T, NumericsError> {
    check_finite("value", &[value])?;
    Ok(value)
}

/// ∇f(x).
///
/// # Errors
/// See [the module](super#errors).
///
/// # Example
/// See [the module](super).
pub fn gradient<T: Real>(f: &impl ScalarFunction, x: &[T]) -> Result<DVector<T>, NumericsError> {
    let mut gradient = DVector::from_element(x.len(), T::zero());
    gradient_into(f, x, &mut Workspace::<T, 4>::new(x.len()), gradient.as_mut_slice())?;
    Ok(gradient)
}

/// (f, v·∇f, v·(∇²f)v) at x: value, slope and curvature along the line x + s v.
///
/// # Errors
/// See [the module](super#errors).
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
/// // (3 + s)(4 + 2s) = 12 + 10 s + 2 s²
/// let along = derivatives::directional(&Product, &[3.0, 4.0], &[1.0, 2.0], &mut Workspace::<f64>::new(2));
/// assert_eq!(along, Ok((12.0, 10.0, 4.0)));
/// ```
pub fn directional<T: Real, const D: usize>(
    f: &impl ScalarFunction,
    x: &[T],
    direction: &[T],
    workspace: &mut Workspace<T, D>,
) -> Result<(T, T, T), NumericsError> {
    check_point(x, workspace)?;
    check_direction("direction", direction, x)?;
    for ((jet, &x), &v) in workspace.jets.iter_mut().zip(x).zip(direction) {
        *jet = Jet { value: x, partials: [], rate: v, second_rate: T::zero() };
    }
    let Jet { value, rate, second_rate, .. } = f.call(&workspace.jets);
    check_finite("value and derivatives", &[value, rate, second_rate])?;
    Ok((value, rate, second_rate))
}

/// u·(∇²f)v at x: the mixed second derivative along two directions.
///
/// # Errors
/// See [the module](super#errors).
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
/// let (u, v) = ([1.0, 0.0], [0.0, 1.0]);
/// assert_eq!(derivatives::mixed(&Product, &[3.0, 4.0], &u, &v, &mut Workspace::<f64>::new(2)), Ok(1.0));
/// ```
pub fn mixed<T: Real, const D: usize>(
    f: &impl ScalarFunction,
    x: &[T],
    u: &[T],
    v: &[T],
    workspace: &mut Workspace<T, D>,
) -> Result<T, NumericsError> {
    check_point(x, workspace)?;
    check_direction("u", u, x)?;
    check_direction("v", v, x)?;
    for (i, number) in workspace.nested.iter_mut().enumerate() {
        *number = Dual::new(Dual::new(x[i], u[i]), Dual::constant(v[i]));
    }
    let result = f.call(&workspace.nested).tangent.tangent;
    check_finite("mixed derivative", &[result])?;
    Ok(result)
}

/// Writes (∇²f)v at x, n entries, to `product` and returns v·∇f.
///
/// # Errors
/// See [the module](super#errors).
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
/// let mut product = [0.0; 2];
/// let mut workspace = Workspace::<f64>::new(2);
/// derivatives::hessian_vector_product_into(&Product, &[3.0, 4.0], &[5.0, 6.0], &mut workspace, &mut product)?;
/// assert_eq!(product, [6.0, 5.0]);
/// # Ok::<(), piola_numerics::NumericsError>(())
/// ```
pub fn hessian_vector_product_into<T: Real, const D: usize>(
    f: &impl ScalarFunction,
    x: &[T],
    v: &[T],
    workspace: &mut Workspace<T, D>,
    product: &mut [T],
) -> Result<T, NumericsError> {
    check_point(x, workspace)?;
    check_direction("v", v, x)?;
    check_dimension("product", product.len(), x.len())?;
    let mut slope = T::zero();
    for (chunk, out) in product.chunks_mut(D).enumerate() {
        let point = x.iter().zip(v).map(|(&x, &v)| Dual::new(x, v));
        seed(&mut workspace.gradients_of_duals, point, chunk * D);
        let result = f.call(&workspace.gradients_of_duals);
        for (out, partial) in out.iter_mut().zip(&result.partials) {
            *out = partial.tangent;
        }
        slope = result.value.tangent;
    }
    check_finite("slope", &[slope])?;
    check_finite("product", product)?;
    Ok(slope)
}

/// Writes ∇²f(x), n×n and exactly symmetric, to `hessian`, and ∇f(x) to `gradient`; returns f(x).
///
/// # Errors
/// See [the module](super#errors).
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
/// let (mut gradient, mut hessian) = ([0.0; 2], [0.0; 4]);
/// let mut workspace = Workspace::<f64>::new(2);
/// derivatives::hessian_into(&Product, &[3.0, 4.0], &mut workspace, &mut gradient, &mut hessian)?;
/// assert_eq!((gradient, hessian), ([4.0, 3.0], [0.0, 1.0, 1.0, 0.0]));
/// # Ok::<(), piola_numerics::NumericsError>(())
/// ```
pub fn hessian_into<T: Real, const D: usize>(
    f: &impl ScalarFunction,
    x: &[T],
    workspace: &mut Workspace<T, D>,
    gradient: &mut [T],
    hessian: &mut [T],
) -> Result<T, NumericsError> {
    let n = x.len();
    check_point(x, workspace)?;
    check_dimension("gradient", gradient.len(), n)?;
    check_dimension("hessian", hessian.len(), n * n)?;
    if n == 0 {
        return value_of_constant(f.call(x));
    }
    let mut value = T::zero();
    // Blocks of D×D entries on and below the diagonal; the others follow by symmetry.
    for first_column in (0..n).step_by(D) {
        for first_row in (first_column..n).step_by(D) {
            for (i, (number, &x)) in workspace.gradients_of_gradients.iter_mut().zip(x).enumerate() {
                let inner = Gradient::variable(x, i.wrapping_sub(first_row));
                *number = Gradient::variable(inner, i.wrapping_sub(first_column));
            }
            let result = f.call(&workspace.gradients_of_gradients);
            value = result.value.value;
            for (column, partials) in (first_column..n).zip(&result.partials) {
                gradient[column] = partials.value;
                for (row, &second) in (first_row..n).zip(&partials.partials) {
                    if column <= row {
                        hessian[row + column * n] = second;
                        hessian[column + row * n] = second;
                    }
                }
            }
        }
    }
    check_finite("value", &[value])?;
    check_finite("gradient", gradient)?;
    check_finite("hessian", hessian)?;
    Ok(value)
}

/// ∇²f(x), exactly symmetric.
///
/// # Errors
/// See [the module](super#errors).
///
/// # Example
/// See [the module](super).
pub fn hessian<T: Real>(f: &impl ScalarFunction, x: &[T]) -> Result<DMatrix<T>, NumericsError> {
    let n = x.len();
    let (mut gradient, mut hessian) = (vec![T::zero(); n], DMatrix::from_element(n, n, T::zero()));
    hessian_into(f, x, &mut Workspace::<T, 4>::new(n), &mut gradient, hessian.as_mut_slice())?;
    Ok(hessian)
}

/// Writes ∂fᵢ/∂xⱼ at x, m×n down the columns, to `jacobian`, and f(x), m entries, to `value`.
///
/// # Errors
/// See [the module](super#errors); the workspace must have been made
/// [with at least m values](Workspace::with_values).
///
/// # Example
/// ```
/// use piola_numerics::{Real, derivatives::{self, VectorFunction, Workspace}};
/// struct Polar;
/// impl VectorFunction for Polar {
///     fn values(&self, _variables: usize) -> usize {
///         2
///     }
///     fn call<T: Real>(&self, q: &[T], x: &mut [T]) {
///         let (s, c) = q[1].sin_cos();
///         x[0] = q[0] * c;
///         x[1] = q[0] * s;
///     }
/// }
/// let (mut value, mut jacobian) = ([0.0; 2], [0.0; 4]);
/// let mut workspace = Workspace::<f64>::with_values(2, 2);
/// derivatives::jacobian_into(&Polar, &[2.0, 0.0], &mut workspace, &mut value, &mut jacobian)?;
/// assert_eq!((value, jacobian), ([2.0, 0.0], [1.0, 0.0, 0.0, 2.0]));
/// # Ok::<(), piola_numerics::NumericsError>(())
/// ```
pub fn jacobian_into<T: Real, const D: usize>(
    f: &impl VectorFunction,
    x: &[T],
    workspace: &mut Workspace<T, D>,
    value: &mut [T],
    jacobian: &mut [T],
) -> Result<(), NumericsError> {
    let (n, m) = (x.len(), f.values(x.len()));
    check_point(x, workspace)?;
    check_dimension("value", value.len(), m)?;
    check_dimension("jacobian", jacobian.len(), m * n)?;
    let available = workspace.gradient_values.len();
    let Some(results) = workspace.gradient_values.get_mut(..m) else {
        return Err(NumericsError::WrongLength { quantity: "workspace values", expected: m, found: available });
    };
    if n == 0 {
        f.call(x, value);
        return check_finite("value", value);
    }
    for first in (0..n).step_by(D) {
        seed(&mut workspace.gradients, x.iter().copied(), first);
        f.call(&workspace.gradients, results);
        for (i, result) in results.iter().enumerate() {
            value[i] = result.value;
            for (column, &partial) in (first..n).zip(&result.partials) {
                jacobian[i + column * m] = partial;
            }
        }
    }
    check_finite("value", value)?;
    check_finite("jacobian", jacobian)
}

/// The m×n matrix ∂fᵢ/∂xⱼ at x.
///
/// # Errors
/// See [the module](super#errors).
///
/// # Example
/// ```
/// use piola_numerics::{Real, derivatives::{self, VectorFunction}};
/// struct Swap;
/// impl VectorFunction for Swap {
///     fn values(&self, variables: usize) -> usize {
///         variables
///     }
///     fn call<T: Real>(&self, x: &[T], out: &mut [T]) {
///         out[0] = T::lit(2.0) * x[1];
///         out[1] = x[0];
///     }
/// }
/// assert_eq!(derivatives::jacobian(&Swap, &[5.0, 7.0])?, nalgebra::dmatrix![0.0, 2.0; 1.0, 0.0]);
/// # Ok::<(), piola_numerics::NumericsError>(())
/// ```
pub fn jacobian<T: Real>(f: &impl VectorFunction, x: &[T]) -> Result<DMatrix<T>, NumericsError> {
    let (n, m) = (x.len(), f.values(x.len()));
    let (mut value, mut jacobian) = (vec![T::zero(); m], DMatrix::from_element(m, n, T::zero()));
    jacobian_into(f, x, &mut Workspace::<T, 4>::with_values(n, m), &mut value, jacobian.as_mut_slice())?;
    Ok(jacobian)
}

/// Writes (∇f)v at x, m entries, to `product`, and f(x) to `value`.
///
/// # Errors
/// As [`jacobian_into`].
///
/// # Example
/// ```
/// use piola_numerics::{Real, derivatives::{self, VectorFunction, Workspace}};
/// struct Square;
/// impl VectorFunction for Square {
///     fn values(&self, variables: usize) -> usize {
///         variables
///     }
///     fn call<T: Real>(&self, x: &[T], out: &mut [T]) {
///         for (out, &x) in out.iter_mut().zip(x) {
///             *out = x * x;
///         }
///     }
/// }
/// let (mut value, mut product) = ([0.0; 2], [0.0; 2]);
/// let mut workspace = Workspace::<f64>::with_values(2, 2);
/// let (x, v) = ([3.0, 4.0], [1.0, 10.0]);
/// derivatives::jacobian_vector_product_into(&Square, &x, &v, &mut workspace, &mut value, &mut product)?;
/// assert_eq!((value, product), ([9.0, 16.0], [6.0, 80.0]));
/// # Ok::<(), piola_numerics::NumericsError>(())
/// ```
pub fn jacobian_vector_product_into<T: Real, const D: usize>(
    f: &impl VectorFunction,
    x: &[T],
    v: &[T],
    workspace: &mut Workspace<T, D>,
    value: &mut [T],
    product: &mut [T],
) -> Result<(), NumericsError> {
    let m = f.values(x.len());
    check_point(x, workspace)?;
    check_direction("v", v, x)?;
    check_dimension("value", value.len(), m)?;
    check_dimension("product", product.len(), m)?;
    let available = workspace.dual_values.len();
    let Some(results) = workspace.dual_values.get_mut(..m) else {
        return Err(NumericsError::WrongLength { quantity: "workspace values", expected: m, found: available });
    };
    for ((dual, &x), &v) in workspace.duals.iter_mut().zip(x).zip(v) {
        *dual = Dual::new(x, v);
    }
    f.call(&workspace.duals, results);
    for (i, result) in results.iter().enumerate() {
        value[i] = result.value;
        product[i] = result.tangent;
    }
    check_finite("value", value)?;
    check_finite("product", product)
}
