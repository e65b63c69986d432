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
    /// Towards smaller errors.
    pub(super) points: &'static [Point],
}

/// One run.
#[derive(Clone, Copy)]
pub(super) struct Point {
    /// The tolerance, or the steps in a turn.
    pub(super) parameter: f64,
    pub(super) error: f64,
    pub(super) seconds: f64,
    pub(super) evaluations: f64,
}

impl Curve {
    /// The run that would have this error: between two measured ones, straight lines of the logarithms. A larger error than the
    /// first one costs no less than that; a smaller one than the smallest is not reached.
    pub(super) fn at(&self, error: f64) -> Option<Point> {
        let first = self.points.first()?;
        if first.error <= error {
            return Some(*first);
        }
        // The last crossing: beyond it all errors are smaller, until rounding.
        let (before, after) = self.points.iter().zip(&self.points[1..]).find(|(_, after)| after.error <= error)?;
        let part = (before.error / error).ln() / (before.error / after.error).ln();
        let between = |a: f64, b: f64| a * (b / a).powf(part);
        Some(Point {
            parameter: between(before.parameter, after.parameter),
            error,
            seconds: between(before.seconds, after.seconds),
            evaluations: between(before.evaluations, after.evaluations),
        })
    }
}
