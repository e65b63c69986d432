//! A quantity sampled on a regular grid of a plane.

/// Values on a regular grid of a plane.
///
/// # Example
/// ```
/// use piola_studies::PlaneSamples;
/// // x + y at the corners of a unit square.
/// let samples = PlaneSamples { origin: [0.0; 2], spacing: [1.0; 2], points: [2, 2], values: vec![0.0, 1.0, 1.0, 2.0] };
/// assert_eq!(samples.at([0.25, 0.5]), Some(0.75));
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct PlaneSamples {
    /// The first point, m.
    pub origin: [f64; 2],
    /// The distance between neighbours along each axis, m.
    pub spacing: [f64; 2],
    /// The number of points along each axis, at least two.
    pub points: [usize; 2],
    /// The values, at i + j · points₁.
    pub values: Vec<f64>,
}

impl PlaneSamples {
    /// Bilinear interpolation; none outside, beside a value that is not finite, or with fewer points or values than stated.
    #[must_use]
    pub fn at(&self, x: [f64; 2]) -> Option<f64> {
        if self.points.iter().any(|points| *points < 2) || self.values.len() < self.points[0] * self.points[1] {
            return None;
        }
        let t: [f64; 2] = core::array::from_fn(|k| (x[k] - self.origin[k]) / self.spacing[k]);
        let inside = |k: usize| 0.0 <= t[k] && t[k] <= (self.points[k] - 1) as f64;
        if !(inside(0) && inside(1)) {
            return None;
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between zero and the points")]
        let cell: [usize; 2] = core::array::from_fn(|k| (t[k] as usize).min(self.points[k] - 2));
        let [a, b]: [f64; 2] = core::array::from_fn(|k| t[k] - cell[k] as f64);
        let value = |i: usize, j: usize| self.values[cell[0] + i + (cell[1] + j) * self.points[0]];
        let found =
            (1.0 - b) * ((1.0 - a) * value(0, 0) + a * value(1, 0)) + b * ((1.0 - a) * value(0, 1) + a * value(1, 1));
        found.is_finite().then_some(found)
    }
}
