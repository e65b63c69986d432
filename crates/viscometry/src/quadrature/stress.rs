//! Integrals over the shear stress, in the variable in which they are smooth.

use piola_fluids::{FlowMoment, ViscometricFluid};
use piola_numerics::Dual;

use super::integrate;
use crate::error::check_bound;
use crate::{Estimate, ViscometryError};

/// Panels of ln(`k_top`/k) at the start: a decaying exponential is resolved on each.
const LAYERS: [f64; 5] = [0.0, 3.0, 8.0, 18.0, 37.0];

/// The share of what exceeds the yield stress below which an interval is narrow: a closed form would lose digits there.
const NARROW: f64 = 1.0 / 32.0;

/// The same where ζ is a closed form: stresses are then the cheaper variable, unless the place where flow begins is near.
const NARROW_CLOSED: f64 = 15.0 / 16.0;

/// Roundings granted to a closed form.
const CLOSED: f64 = 64.0 * f64::EPSILON;

/// Shear stresses from `top` (1 − `share`) to `top`: a narrow interval keeps the digits of its width.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Span {
    /// The upper stress, Pa, 0 ≤ top.
    pub(crate) top: f64,
    /// The width over the upper stress, 0 ≤ share ≤ 1.
    pub(crate) share: f64,
}

/// The part of a span that flows.
enum Flowing {
    /// None of it.
    Nothing,
    /// A narrow part: go by stresses.
    Narrow,
    /// From this stress, Pa, to the upper one.
    Wide(f64),
}

impl Span {
    /// The part that flows, narrow below a share of what exceeds the yield stress.
    fn flowing<F: ViscometricFluid + ?Sized>(self, fluid: &F, narrow: f64) -> Flowing {
        let yields = fluid.yield_stress();
        let excess = self.top - yields;
        if !(excess > 0.0 && self.share > 0.0) {
            return Flowing::Nothing;
        }
        let width = self.top * self.share;
        if width < narrow * excess {
            Flowing::Narrow
        } else if width < excess {
            Flowing::Wide((self.top * (1.0 - self.share)).max(yields))
        } else {
            Flowing::Wide(yields)
        }
    }
}

/// ∫ sᵖ ζ(s) ds from `top` (1 − `share`) to `top`, with its error.
///
/// # Errors
/// [`ViscometryError::NotFinite`], [`ViscometryError::OutOfBounds`] unless 0 ≤ top and 0 ≤ share ≤ 1;
/// [`ViscometryError::Fluids`] where no rate has the stress; [`ViscometryError::NotIncreasing`] where τ falls.
///
/// # Accuracy
/// 1e-13 where the fluid has a closed form or τ is smooth but at rest, whatever `share` is; a fluid with a yield stress `τ_y` loses the digits
/// of top − `τ_y`.
///
/// # Example
/// ```
/// use piola_fluids::{FlowMoment, Newtonian};
/// use piola_viscometry::quadrature;
/// let water = Newtonian::new(0.5)?;
/// let discharge = quadrature::moment(&water, FlowMoment::Second, 3.0, 1.0)?; // s⁴/(4 μ)
/// assert!((discharge.value - 40.5).abs() <= discharge.error);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn moment<F: ViscometricFluid + ?Sized>(
    fluid: &F,
    moment: FlowMoment,
    top: f64,
    share: f64,
) -> Result<Estimate, ViscometryError> {
    check_bound("moment", "top", top, "0 ≤ top", 0.0 <= top)?;
    check_bound("moment", "share", share, "0 ≤ share ≤ 1", 0.0 <= share && share <= 1.0)?;
    Ok(scaled_moment(fluid, moment, Span { top, share })?.scaled(top.powi(moment.power() + 1)))
}

/// ∫ sᵖ ζ ds over the span, divided by topᵖ⁺¹: a mean shear rate, 1/s.
pub(crate) fn scaled_moment<F: ViscometricFluid + ?Sized>(
    fluid: &F,
    moment: FlowMoment,
    span: Span,
) -> Result<Estimate, ViscometryError> {
    let top = span.top;
    let power = moment.power();
    if let Flowing::Wide(from) = span.flowing(fluid, NARROW)
        && let Some(closed) = fluid.flow_moment(moment, from, top)
    {
        let value = closed / top.powi(power + 1);
        // Powers of very large or small stresses leave the range before their quotient does.
        if value.is_finite() && (value > 0.0 || fluid.shear_rate(top)? == 0.0) {
            let condition = top / (top - fluid.yield_stress());
            return Ok(Estimate { value, error: CLOSED * condition * value });
        }
    }
    stress_integral(fluid, span, |stress, rate| (stress / top).powi(power) * (rate / top))
}

/// ∫ w(s, ζ(s)) ds over the span.
pub(crate) fn stress_integral<F: ViscometricFluid + ?Sized>(
    fluid: &F,
    span: Span,
    mut weight: impl FnMut(f64, f64) -> f64,
) -> Result<Estimate, ViscometryError> {
    match span.flowing(fluid, if F::CLOSED_RATE { NARROW_CLOSED } else { NARROW }) {
        Flowing::Nothing => Ok(Estimate::ZERO),
        Flowing::Narrow => {
            let width = span.top * span.share;
            let integral = integrate(&[0.0, 1.0], |x| {
                let stress = span.top * (1.0 - span.share * x);
                Ok(weight(stress, fluid.shear_rate(stress)?))
            })?;
            Ok(integral.scaled(width))
        }
        Flowing::Wide(from) => {
            let lower = if from > fluid.yield_stress() { fluid.shear_rate(from)? } else { 0.0 };
            let upper = fluid.shear_rate(span.top)?;
            if upper <= lower {
                return Ok(Estimate::ZERO);
            }
            let mut integrand = |rate: f64| {
                let at = fluid.shear_stress(Dual { value: rate, tangent: 1.0 });
                if at.tangent < 0.0 {
                    return Err(ViscometryError::NotIncreasing { fluid: F::NAME, shear_rate: rate, slope: at.tangent });
                }
                Ok(weight(at.value, rate) * at.tangent)
            };
            // The upper rate is rounded, near the yield stress by more.
            let condition = span.top / (span.top - fluid.yield_stress());
            let moved = 8.0 * f64::EPSILON * condition * (integrand(upper)? * upper).abs();
            let integral = rate_integral(lower, upper, integrand)?;
            Ok(Estimate { value: integral.value, error: integral.error + moved })
        }
    }
}

/// ∫ f(k) dk over rates from `lower` to `upper`, by panels of ln k; f k vanishes at k = 0 like a power of k.
pub(crate) fn rate_integral(
    lower: f64,
    upper: f64,
    mut integrand: impl FnMut(f64) -> Result<f64, ViscometryError>,
) -> Result<Estimate, ViscometryError> {
    if !upper.is_finite() {
        return Err(ViscometryError::NotFinite { flow: "quadrature", quantity: "shear rate", value: upper });
    }
    if upper <= lower {
        return Ok(Estimate::ZERO);
    }
    let depth = if lower > 0.0 { (upper / lower).ln() } else { f64::INFINITY };
    let reached = depth.min(LAYERS[LAYERS.len() - 1]);
    let mut breaks = LAYERS;
    let mut count = 1;
    while count < breaks.len() && breaks[count] < reached {
        count += 1;
    }
    if count < breaks.len() {
        breaks[count] = reached;
        count += 1;
    }
    let body = integrate(&breaks[..count], |x| {
        let rate = upper * (-x).exp();
        // Rates below the smallest number are at rest.
        if rate > 0.0 { Ok(integrand(rate)? * rate) } else { Ok(0.0) }
    })?;
    if depth <= reached {
        return Ok(body);
    }
    // What lies below the least rate of the panels, to the first digit: a share of 1e-16.
    let end = upper * (-reached).exp();
    let start = lower.max(0.0);
    let middle = 0.5 * (start + end);
    let rest = if middle > 0.0 { integrand(middle)? * (end - start) } else { 0.0 };
    Ok(Estimate { value: body.value + rest, error: body.error + rest.abs() })
}
