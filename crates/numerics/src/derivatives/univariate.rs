//! Derivatives of formulas of one variable.

use super::UnivariateFunction;
use crate::error::check_finite;
use crate::{Dual, Jet, NumericsError, Real};

/// (f, f′) at x.
///
/// # Errors
/// See [the module](super#errors).
///
/// # Example
/// ```
/// use piola_numerics::{Real, derivatives::{self, UnivariateFunction}};
/// struct Square;
/// impl UnivariateFunction for Square {
///     fn call<T: Real>(&self, x: T) -> T {
///         x * x
///     }
/// }
/// assert_eq!(derivatives::first_derivative(&Square, 3.0), Ok((9.0, 6.0)));
/// ```
#[inline]
pub fn first_derivative<T: Real>(f: &impl UnivariateFunction, x: T) -> Result<(T, T), NumericsError> {
    check_finite("x", &[x])?;
    let Dual { value, tangent } = f.call(Dual::variable(x));
    check_finite("value and derivative", &[value, tangent])?;
    Ok((value, tangent))
}

/// (f, f′, f″) at x.
///
/// # Errors
/// See [the module](super#errors).
///
/// # Example
/// ```
/// use piola_numerics::{Real, derivatives::{self, UnivariateFunction}};
/// struct Cube;
/// impl UnivariateFunction for Cube {
///     fn call<T: Real>(&self, x: T) -> T {
///         x.powi(3)
///     }
/// }
/// assert_eq!(derivatives::second_derivative(&Cube, 2.0), Ok((8.0, 12.0, 12.0)));
/// ```
#[inline]
pub fn second_derivative<T: Real>(f: &impl UnivariateFunction, x: T) -> Result<(T, T, T), NumericsError> {
    check_finite("x", &[x])?;
    let Jet { value, rate, second_rate, .. } = f.call(Jet::<T, 0>::time(x));
    check_finite("value and derivatives", &[value, rate, second_rate])?;
    Ok((value, rate, second_rate))
}
