//! What is recovered at a point, as a function of a smooth curve y(u) = ln W(ln x) and its derivatives there and below.
//!
//! ```text
//! plain      a e^y
//! local      a e^y (m + y′)
//! series     Σ 2 e^y y′ at u − nδ, n < N, and the rest 2 e^y F(…) at u − Nδ
//! ```

use super::series::{self, Order};
use super::smoothing::Curve;
use super::splines::Derivatives;

/// The rule by which the recovered quantity follows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Rule {
    /// e^`logarithm` e^y.
    Plain { logarithm: f64 },
    /// e^`logarithm` e^y (`multiple` + y′).
    Local { multiple: f64, logarithm: f64 },
    /// The series of coaxial cylinders with step δ and its rest.
    Series { step: f64, order: Order, below: Below },
}

/// The responses below the smallest drive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Below {
    /// Powers of as many moments as the order tells.
    Powers,
    /// One power of this exponent.
    Exponent(f64),
    /// Those of a fluid that yields, below this ln drive: ζ rises there from none, and its integral is 2 W.
    Yield { lowest: f64 },
}

/// Terms of the series, at most; in narrower gaps the rest needs fewer.
const MOST: usize = 64;
/// Up to here the variance of the exponents in steps is none.
pub(super) const ONE_POWER: f64 = 1e-9;
/// Gaps with a smaller δ need none.
const NARROW: f64 = 0.02;

/// The largest ½ ζ(v) at v below the lowest row of a fluid that yields, over e^`logarithm`, and its derivative with respect to y′(u₀): ζ
/// rises with v and is positive, so that it lies below its mean from v to the lowest row, and below its value there.
///
/// ```text
/// ½ ζ(v) ≤ W/(u₀ − v)      ½ ζ(v) ≤ ½ ζ(u₀) ≤ W′ + W/δ      W, W′ at u₀
/// ```
fn rest_of_yield(curve: &Curve, v: f64, lowest: f64, step: f64, logarithm: f64) -> [f64; 2] {
    let [y, slope, ..] = curve.at(lowest);
    let mean = (lowest - v).max(f64::MIN_POSITIVE).recip();
    let (size, value) = ((y - logarithm).exp(), slope + step.recip());
    if mean < value { [size * mean, 0.0] } else { [size * value, size] }
}

impl Rule {
    /// Whether the fluid seems to yield.
    pub(super) const fn yields(self) -> bool {
        matches!(self, Self::Series { below: Below::Yield { .. }, .. })
    }

    /// The most terms that stay above `lowest`.
    pub(super) fn most_terms(self, u: f64, lowest: f64) -> usize {
        match self {
            Self::Plain { .. } | Self::Local { .. } => 0,
            Self::Series { step, below: Below::Powers, .. } if step < NARROW => 0,
            Self::Series { step, below, .. } => {
                // What is assumed below the lowest row does not hold above.
                let most = if below == Below::Powers { MOST } else { usize::MAX };
                let mut terms = 0;
                while terms < most && lowest <= u - (terms + 1) as f64 * step {
                    terms += 1;
                }
                terms
            }
        }
    }

    /// ln of the recovered quantity and the part of it that the rest of the series may be off; `None` unless it is positive.
    pub(super) fn value(self, curve: &Curve, u: f64, terms: usize) -> Option<[f64; 2]> {
        match self {
            Self::Plain { logarithm } => Some([logarithm + curve.at(u)[0], 0.0]),
            Self::Local { multiple, logarithm } => {
                let [y, slope, ..] = curve.at(u);
                let factor = multiple + slope;
                (0.0 < factor).then(|| [logarithm + y + factor.ln(), 0.0])
            }
            Self::Series { step, below: Below::Yield { lowest }, .. } => {
                let reference = curve.at(u)[0];
                let mut sum = 0.0;
                let mut at = u;
                while lowest <= at {
                    let [y, slope, ..] = curve.at(at);
                    sum += (y - reference).exp() * slope;
                    at -= step;
                }
                let unknown = 0.5 * rest_of_yield(curve, at, lowest, step, reference)[0];
                sum += unknown;
                (0.0 < sum).then(|| [reference + (2.0 * sum).ln(), -(-unknown / sum).ln_1p()])
            }
            Self::Series { step, order, below } => {
                let reference = curve.at(u)[0];
                let mut sum = 0.0;
                for n in 0..terms {
                    let [y, slope, ..] = curve.at(u - n as f64 * step);
                    sum += (y - reference).exp() * slope;
                }
                let mut last = curve.at(u - terms as f64 * step);
                let order = assume(&mut last, step, order, below);
                let rest = series::rest(last, step, order);
                let size = (last[0] - reference).exp();
                sum += size * rest.factor;
                (0.0 < sum).then(|| [reference + (2.0 * sum).ln(), size * rest.error / sum])
            }
        }
    }

    /// Adds the derivatives of the logarithm with respect to the coefficients to a row of zeros.
    pub(super) fn gradient(self, curve: &Curve, u: f64, terms: usize, row: &mut [f64]) {
        match self {
            Self::Plain { .. } => curve.accumulate(row, [1.0, 0.0, 0.0, 0.0, 0.0], u),
            Self::Local { multiple, .. } => {
                let slope = curve.at(u)[1];
                curve.accumulate(row, [1.0, 1.0 / (multiple + slope), 0.0, 0.0, 0.0], u);
            }
            Self::Series { step, order, below } => {
                let Some([logarithm, _]) = self.value(curve, u, terms) else { return };
                let mut term = |at: f64| {
                    let [y, slope, ..] = curve.at(at);
                    let size = 2.0 * (y - logarithm).exp();
                    curve.accumulate(row, [size * slope, size, 0.0, 0.0, 0.0], at);
                };
                if let Below::Yield { lowest } = below {
                    let mut at = u;
                    while lowest <= at {
                        term(at);
                        at -= step;
                    }
                    let [rest, by_slope] = rest_of_yield(curve, at, lowest, step, logarithm);
                    curve.accumulate(row, [rest, by_slope, 0.0, 0.0, 0.0], lowest);
                    return;
                }
                (0..terms).for_each(|n| term(u - n as f64 * step));
                let at = u - terms as f64 * step;
                let mut last = curve.at(at);
                let order = assume(&mut last, step, order, below);
                let rest = series::rest(last, step, order);
                let size = 2.0 * (last[0] - logarithm).exp();
                let [first, second] = if below == Below::Powers { rest.slopes } else { [0.0; 2] };
                curve.accumulate(row, [size * rest.factor, size * first, size * second, 0.0, 0.0], at);
            }
        }
    }
}

/// One power of a given exponent in place of the measured derivatives. Where the rows show hardly more than one power, derivatives of
/// higher order would be rounding: the variance is all that is taken, and they enter the error as those of powers four apart.
fn assume(derivatives: &mut Derivatives, step: f64, order: Order, below: Below) -> Order {
    let [y, _, variance, ..] = *derivatives;
    if let Below::Exponent(exponent) = below {
        *derivatives = [y, exponent, 0.0, 0.0, 0.0];
        order
    } else if (variance * step * step).abs() < ONE_POWER {
        [derivatives[3], derivatives[4]] = [4.0 * variance, 16.0 * variance];
        Order::Variance
    } else {
        order
    }
}

/// Noise leaves no more than the variance of the exponents.
pub(super) const fn coarse(rule: Rule) -> Rule {
    match rule {
        Rule::Series { step, order: Order::Full, below } => Rule::Series { step, order: Order::Variance, below },
        other => other,
    }
}

/// The rule under a power of the rate below the smallest torque, if one is given.
pub(super) const fn assumed(rule: Rule, exponent: Option<f64>) -> Rule {
    match (rule, exponent) {
        (Rule::Series { step, .. }, Some(exponent)) => {
            Rule::Series { step, order: Order::Power, below: Below::Exponent(exponent) }
        }
        _ => rule,
    }
}
