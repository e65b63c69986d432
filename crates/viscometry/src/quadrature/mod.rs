//! Quadrature with an error bound, and the moments of the shear rate between two shear stresses.
//!
//! Every discharge, velocity and speed difference is a moment of the flow function ζ:
//!
//! ```text
//! Mₚ(a, b) = ∫ₐᵇ sᵖ ζ(s) ds = ∫ τ(k)ᵖ k τ′(k) dk from ζ(a) to ζ(b)
//! ```
//!
//! Where the fluid has a closed form that keeps its digits it serves. Otherwise the rate is the variable, so that no root is sought inside
//! the integrand (τ′ is exact, by dual numbers), and its logarithm is what is divided into panels, so that eight decades of
//! rates cost no more than one. Where the interval is narrow the stress is the variable: its width is then known exactly, as a
//! share of the upper stress, and nothing cancels.

mod stress;

use piola_numerics::quadrature::{self as adaptive, Ending, GaussKronrod, Panel, Quadpack};

pub use stress::moment;
pub(crate) use stress::{Span, rate_integral, scaled_moment, stress_integral};

use crate::{Estimate, ViscometryError};

/// The most panels, on the stack.
const PANELS: usize = 96;

/// The relative error at which bisection ends.
const WANTED: f64 = 2e-14;

/// The relative error above which a result is refused.
const ACCEPTED: f64 = 1e-8;

/// ∫ f over the consecutive intervals between `breaks`, by Kronrod's rule of 21 points in Gauss's of 10, bisecting the worst panel.
///
/// Up to 96 panels lie on the stack; nothing is allocated. It ends at a relative error of 2e-14, or when only rounding is left.
///
/// # Errors
/// What the integrand refuses; [`ViscometryError::NotFinite`] where it is not finite;
/// [`ViscometryError::NotConverged`] where a relative error of 1e-8 is out of reach.
///
/// # Accuracy
/// The error of the result is a bound for integrands that 21 points on a panel resolve; that of QUADPACK otherwise.
///
/// # Example
/// ```
/// use piola_viscometry::{ViscometryError, quadrature};
/// let third = quadrature::integrate(&[0.0, 1.0], |x| Ok::<_, ViscometryError>(x * x))?;
/// assert!((third.value - 1.0 / 3.0).abs() <= third.error);
/// # Ok::<(), ViscometryError>(())
/// ```
pub fn integrate(
    breaks: &[f64],
    mut integrand: impl FnMut(f64) -> Result<f64, ViscometryError>,
) -> Result<Estimate, ViscometryError> {
    let parts = breaks.windows(2).take(PANELS / 2).map(|ends| (ends[0], ends[1]));
    // The rounding of a sum is 8 ε of its size; twice that is not asked for.
    let allowed = |values: &[f64; 1], sizes: &[f64; 1]| [WANTED * values[0].abs() + 16.0 * f64::EPSILON * sizes[0]];
    let method = (&GaussKronrod::POINTS_21, &Quadpack);
    let found = adaptive::integrate(&mut [Panel::EMPTY; PANELS], parts, method, &allowed, |_, x| {
        integrand(x).map(|value| [value])
    })?;
    let total = Estimate { value: found.values[0], error: found.errors[0] };
    if let Ending::NotFinite { .. } = found.ending {
        let value = if total.value.is_finite() { total.error } else { total.value };
        return Err(ViscometryError::NotFinite { flow: "quadrature", quantity: "integral", value });
    }
    if total.error <= ACCEPTED * total.value.abs().max(8.0 * found.sizes[0]) {
        Ok(total)
    } else {
        Err(ViscometryError::NotConverged { value: total.value, error: total.error })
    }
}
