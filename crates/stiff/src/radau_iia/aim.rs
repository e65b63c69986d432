//! What a tolerance means for steps of each order.

use piola_integrators::Tolerance;

use super::Control;
use super::order::RadauOrder;

/// The tolerance with which runs of a fixed step iterate.
pub(super) const ROUNDING: f64 = 1e-14;

/// The tolerance with a relative part no less than rounding leaves; an absolute one stays as it is.
pub(super) fn above_rounding(tolerance: Tolerance) -> Tolerance {
    let (relative, absolute) = (tolerance.relative_part(), tolerance.absolute_part());
    let raised = if 0.0 < relative { relative.max(ROUNDING) } else { relative };
    // Numbers between those of two valid tolerances are valid.
    Tolerance::new(raised, absolute).unwrap_or(tolerance)
}

/// The accuracy that a method of some order needs within a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Aim {
    /// The error allowed in a component: absolute + relative · magnitude.
    pub(super) absolute: f64,
    pub(super) relative: f64,
    /// How many times that is what the stiff part of the error may be.
    pub(super) widening: f64,
    /// The part of it that Newton's iteration may leave.
    pub(super) unswept: f64,
    /// The change up to which an iteration that no longer contracts is taken to show the rounding of a stiff field.
    pub(super) noise: f64,
    pub(super) most_sweeps: u32,
    /// Whether the step is like the last one, so that its iteration contracts alike.
    pub(super) is_familiar: bool,
}

/// The least tolerance to which the stiff part of an error is held.
const SEEN: f64 = 1e-12;
/// [`Aim::noise`] of steps that adapt.
const NOISE: f64 = 0.01;

impl Aim {
    pub(super) fn of(control: Control, order: RadauOrder) -> Self {
        let tolerance = match control {
            // Below the smallest magnitudes nothing is iterated.
            Control::Fixed(_) => {
                let (absolute, noise) = (f64::MIN_POSITIVE, 1e4);
                return Self {
                    absolute,
                    relative: ROUNDING,
                    widening: 1.0,
                    unswept: 1e-2,
                    noise,
                    most_sweeps: 50,
                    is_familiar: false,
                };
            }
            Control::Adaptive(tolerance) => tolerance,
        };
        let most_sweeps = match order {
            RadauOrder::Five => 7,
            RadauOrder::Nine => 12,
            RadauOrder::Thirteen => 17,
        };
        let (absolute, relative) = (tolerance.absolute_part(), tolerance.relative_part());
        if relative <= 0.0 {
            // An absolute tolerance has a unit: only a relative one has powers.
            return Self {
                absolute,
                relative,
                widening: 1.0,
                unswept: 1e-2,
                noise: NOISE,
                most_sweeps,
                is_familiar: false,
            };
        }
        // The error of the estimate is of order s + 1, that of the step of order 2s.
        let s = order.tableau().stages() as f64;
        let exponent = (s + 1.0) / (2.0 * s);
        let widening = 0.1 * relative.powf(exponent - 1.0);
        // What the iteration leaves is an error of the step itself.
        let unswept = (0.3 * relative.powf(1.0 - exponent)).min(0.03);
        let unswept = unswept.max(10.0 * f64::EPSILON / (relative * widening));
        // Nearer to rounding than that the stiff part of an error cannot be seen.
        let seen = widening * (relative / relative.max(SEEN));
        Self {
            absolute: absolute * widening,
            relative: relative * widening,
            widening: seen,
            unswept,
            noise: NOISE,
            most_sweeps,
            is_familiar: false,
        }
    }
}

impl Control {
    /// The orders between which the contraction of the iteration decides.
    ///
    /// On the problems of `examples/stiff` these take the least time at each tolerance.
    pub(super) const fn orders(self) -> [RadauOrder; 2] {
        let relative = match self {
            Self::Adaptive(tolerance) => tolerance.relative_part(),
            Self::Fixed(_) => 0.0,
        };
        if relative <= 0.0 {
            [RadauOrder::Five, RadauOrder::Thirteen]
        } else if relative <= 1e-11 {
            [RadauOrder::Nine, RadauOrder::Thirteen]
        } else if relative <= 1e-5 {
            [RadauOrder::Nine, RadauOrder::Nine]
        } else {
            [RadauOrder::Five, RadauOrder::Nine]
        }
    }
}
