//! The form of the measured curves, and their interpolation.

use super::AdvisedMethod;

/// A measured problem.
pub(super) struct Measured {
    /// Its name, for readers of the table.
    #[expect(dead_code, reason = "tells the reader of the table which problem it is")]
    pub(super) problem: &'static str,
    /// Turns in the run.
    pub(super) turns: f64,
    pub(super) uneven: bool,
    pub(super) velocity_dependent: bool,
    /// The time of one evaluation, s.
    pub(super) evaluation: f64,
    pub(super) curves: &'static [Curve],
}

/// The curve of a method.
pub(super) struct Curve {
    pub(super) method: AdvisedMethod,
    /// Towards smaller errors: the tolerance or the steps in a turn, the error, the time in seconds, the evaluations.
    pub(super) points: &'static [[f64; 4]],
}

/// One run.
pub(super) struct Point {
    /// The tolerance, or the steps in a turn.
    pub(super) parameter: f64,
    pub(super) seconds: f64,
    pub(super) evaluations: f64,
}

impl Curve {
    /// The run that would have this error: between two measured ones, straight lines of the logarithms. A larger error than the
    /// first one costs no less than that; a smaller one than the smallest is not reached.
    pub(super) fn at(&self, error: f64) -> Option<Point> {
        let between = |[parameter, _, seconds, evaluations]: [f64; 4], after: [f64; 4], part: f64| Point {
            parameter: parameter * (after[0] / parameter).powf(part),
            seconds: seconds * (after[2] / seconds).powf(part),
            evaluations: evaluations * (after[3] / evaluations).powf(part),
        };
        let first = *self.points.first()?;
        if first[1] <= error {
            return Some(between(first, first, 0.0));
        }
        // The first crossing: beyond it errors are smaller, until rounding.
        let (before, after) = self.points.iter().zip(&self.points[1..]).find(|(_, after)| after[1] <= error)?;
        let part = (before[1] / error).ln() / (before[1] / after[1]).ln();
        Some(between(*before, *after, part))
    }
}
