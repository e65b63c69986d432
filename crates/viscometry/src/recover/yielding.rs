//! Coaxial cylinders and a fluid that seems to yield: what is known below the smallest torque, and the bend of ΔΩ.

use super::rule::{Below, Rule};
use super::smoothing::Curve;

/// The part of the bend within a width that a smooth curve misses; measured on Bingham's fluid, which bends most sharply.
const MISSED: f64 = 0.15;

/// The bend of ΔΩ over the torque where a fluid that yields begins to flow at the outer cylinder, which no smooth curve follows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Kink {
    /// ln torque there, at least and at most: a step above the yield torque, which lies below the smallest one.
    pub(super) at: [f64; 2],
    /// The distance of the rows there.
    pub(super) width: f64,
    /// dζ/d ln M at the smallest torque, by which 2 d²ΔΩ/(d ln M)² is less from there on.
    pub(super) rise: f64,
}

impl Kink {
    /// How far ln ζ may be off within a width of the bend.
    pub(super) fn doubt(self, u: f64, logarithm: Option<f64>) -> f64 {
        let near = (1.0 - (u - u.clamp(self.at[0], self.at[1])).abs() / self.width).max(0.0);
        logarithm.map_or(0.0, |logarithm| MISSED * near * self.width * self.rise.max(0.0) * (-logarithm).exp())
    }
}

/// The rule for a curve that steepens towards the smallest drive as the speeds of a fluid that yields: d ln W/d ln x is large there, so
/// that hardly anything flows a gap below, and falls by a third within half as much again of the drive.
pub(super) fn yielding(rule: Rule, curve: &Curve, [lowest, highest]: [f64; 2]) -> Rule {
    const STEEP: f64 = 3.0;
    const FALLS: f64 = 1.5;
    let Rule::Series { step, order, below: Below::Powers } = rule else { return rule };
    let slope = |u: f64| curve.at(u)[1];
    let next = (lowest + 1.5_f64.ln()).min(highest);
    if STEEP < slope(lowest).min(step * slope(lowest)) && FALLS * slope(next) < slope(lowest) {
        return Rule::Series { step, order, below: Below::Yield { lowest } };
    }
    rule
}
