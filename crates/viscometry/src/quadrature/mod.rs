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

mod rule;
mod stress;

use rule::Panel;

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
    let mut panels = [Panel::default(); PANELS];
    let mut count = 0;
    for ends in breaks.windows(2).take(PANELS / 2) {
        panels[count] = Panel::integrate(ends[0], ends[1], &mut integrand)?;
        count += 1;
    }
    loop {
        let used = &panels[..count];
        let total = Estimate {
            value: used.iter().map(|panel| panel.value).sum(),
            error: used.iter().map(|panel| panel.error).sum(),
        };
        if !(total.value.is_finite() && total.error.is_finite()) {
            let value = if total.value.is_finite() { total.error } else { total.value };
            return Err(ViscometryError::NotFinite { flow: "quadrature", quantity: "integral", value });
        }
        let rounding = used.iter().map(|panel| panel.rounding).sum::<f64>();
        let is_enough = total.error <= WANTED * total.value.abs() + 2.0 * rounding;
        if is_enough || count == PANELS {
            let size = total.value.abs().max(rounding / f64::EPSILON);
            return if total.error <= ACCEPTED * size {
                Ok(total)
            } else {
                Err(ViscometryError::NotConverged { value: total.value, error: total.error })
            };
        }
        let worst = (0..count).max_by(|&i, &j| panels[i].error.total_cmp(&panels[j].error)).unwrap_or(0);
        let Panel { from, to, .. } = panels[worst];
        let middle = 0.5 * (from + to);
        panels[worst] = Panel::integrate(from, middle, &mut integrand)?;
        panels[count] = Panel::integrate(middle, to, &mut integrand)?;
        count += 1;
    }
}
