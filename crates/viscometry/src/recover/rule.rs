//! What is recovered at a point, as a function of a smooth curve y(u) = ln W(ln x) and its derivatives there and below.
//!
//! ```text
//! plain      a e^y
//! local      a e^y (m + y′)
//! series     Σ 2 e^y y′ at u − nδ, n < N, and the rest 2 e^y F(…) at u − Nδ
//! ```

use super::series::{self, Order};
use super::smoothing::Fitted;
use super::splines::Derivatives;

/// The rule by which the recovered quantity follows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Rule {
    /// e^`logarithm` e^y.
    Plain { logarithm: f64 },
    /// e^`logarithm` e^y (`multiple` + y′).
    Local { multiple: f64, logarithm: f64 },
    /// The series of coaxial cylinders with step δ, its rest by powers of this many moments, or of this exponent.
    Series { step: f64, order: Order, exponent: Option<f64> },
}

/// Terms of the series, at most; in narrower gaps the rest needs fewer.
const MOST: usize = 64;
/// Up to here the variance of the exponents in steps is none.
pub(super) const ONE_POWER: f64 = 1e-9;
/// Gaps with a smaller δ need none.
const NARROW: f64 = 0.02;

impl Rule {
    /// The most terms that stay above `lowest`.
    pub(super) fn most_terms(self, u: f64, lowest: f64) -> usize {
        match self {
            Self::Plain { .. } | Self::Local { .. } => 0,
            Self::Series { step, exponent: None, .. } if step < NARROW => 0,
            Self::Series { step, exponent, .. } => {
                // An exponent that is given holds below the lowest row and not above.
                let most = if exponent.is_some() { usize::MAX } else { MOST };
                let mut terms = 0;
                while terms < most && lowest <= u - (terms + 1) as f64 * step {
                    terms += 1;
                }
                terms
            }
        }
    }

    /// ln of the recovered quantity and the part of it that the rest of the series may be off; `None` unless it is positive.
    pub(super) fn value(self, curve: &Fitted, u: f64, terms: usize) -> Option<[f64; 2]> {
        match self {
            Self::Plain { logarithm } => Some([logarithm + curve.at(u)[0], 0.0]),
            Self::Local { multiple, logarithm } => {
                let [y, slope, ..] = curve.at(u);
                let factor = multiple + slope;
                (0.0 < factor).then(|| [logarithm + y + factor.ln(), 0.0])
            }
            Self::Series { step, order, exponent } => {
                let reference = curve.at(u)[0];
                let mut sum = 0.0;
                for n in 0..terms {
                    let [y, slope, ..] = curve.at(u - n as f64 * step);
                    sum += (y - reference).exp() * slope;
                }
                let mut last = curve.at(u - terms as f64 * step);
                let order = assume(&mut last, step, order, exponent);
                let rest = series::rest(last, step, order);
                let size = (last[0] - reference).exp();
                sum += size * rest.factor;
                (0.0 < sum).then(|| [reference + (2.0 * sum).ln(), size * rest.error / sum])
            }
        }
    }

    /// Adds the derivatives of the logarithm with respect to the coefficients to a row of zeros.
    pub(super) fn gradient(self, curve: &Fitted, u: f64, terms: usize, row: &mut [f64]) {
        match self {
            Self::Plain { .. } => curve.splines.accumulate(row, [1.0, 0.0, 0.0, 0.0, 0.0], u),
            Self::Local { multiple, .. } => {
                let slope = curve.at(u)[1];
                curve.splines.accumulate(row, [1.0, 1.0 / (multiple + slope), 0.0, 0.0, 0.0], u);
            }
            Self::Series { step, order, exponent } => {
                let Some([logarithm, _]) = self.value(curve, u, terms) else { return };
                for n in 0..terms {
                    let at = u - n as f64 * step;
                    let [y, slope, ..] = curve.at(at);
                    let size = 2.0 * (y - logarithm).exp();
                    curve.splines.accumulate(row, [size * slope, size, 0.0, 0.0, 0.0], at);
                }
                let at = u - terms as f64 * step;
                let mut last = curve.at(at);
                let order = assume(&mut last, step, order, exponent);
                let rest = series::rest(last, step, order);
                let size = 2.0 * (last[0] - logarithm).exp();
                let [first, second] = if exponent.is_some() { [0.0; 2] } else { rest.slopes };
                curve.splines.accumulate(row, [size * rest.factor, size * first, size * second, 0.0, 0.0], at);
            }
        }
    }
}

/// One power of a given exponent in place of the measured derivatives. Where the rows show hardly more than one power, derivatives of
/// higher order would be rounding: the variance is all that is taken, and they enter the error as those of powers four apart.
fn assume(derivatives: &mut Derivatives, step: f64, order: Order, exponent: Option<f64>) -> Order {
    let [y, _, variance, ..] = *derivatives;
    if let Some(exponent) = exponent {
        *derivatives = [y, exponent, 0.0, 0.0, 0.0];
        order
    } else if (variance * step * step).abs() < ONE_POWER {
        [derivatives[3], derivatives[4]] = [4.0 * variance, 16.0 * variance];
        Order::Variance
    } else {
        order
    }
}
