//! Regions above a threshold on a regular grid, as closed polygons.

use std::collections::BTreeMap;

/// Values on a regular grid.
///
/// # Example
/// ```
/// use piola_charts::Lattice;
/// let lattice = Lattice::of([0.0; 2], [2.0; 2], [3, 3], |[x, y]| x + y);
/// assert_eq!(lattice.range(), (0.0, 4.0));
/// assert_eq!(lattice.region(3.0).len(), 1);
/// ```
#[derive(Debug, Clone)]
pub struct Lattice {
    /// The first point.
    pub origin: [f64; 2],
    /// The distance between neighbours along each axis.
    pub spacing: [f64; 2],
    /// The number of points along each axis, at least two.
    pub points: [usize; 2],
    /// The values, at i + j · points₁.
    pub values: Vec<f64>,
}

/// An edge of the grid, padded by one point on every side: its lower left point, and whether it is upright.
type Edge = (usize, usize, bool);

impl Lattice {
    /// Samples a function over a rectangle.
    #[must_use]
    pub fn of(low: [f64; 2], high: [f64; 2], points: [usize; 2], value: impl Fn([f64; 2]) -> f64) -> Self {
        let spacing = core::array::from_fn(|k| (high[k] - low[k]) / (points[k] - 1) as f64);
        let mut lattice = Self { origin: low, spacing, points, values: Vec::with_capacity(points[0] * points[1]) };
        for j in 0..points[1] {
            for i in 0..points[0] {
                lattice.values.push(value(lattice.place(i, j)));
            }
        }
        lattice
    }

    /// The point (i, j).
    #[must_use]
    pub fn place(&self, i: usize, j: usize) -> [f64; 2] {
        [self.origin[0] + i as f64 * self.spacing[0], self.origin[1] + j as f64 * self.spacing[1]]
    }

    /// The least and the largest finite value.
    #[must_use]
    pub fn range(&self) -> (f64, f64) {
        let finite = self.values.iter().copied().filter(|value| value.is_finite());
        finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)))
    }

    /// The value at a point of the padded grid; less than any threshold outside, and where it is not finite.
    fn padded(&self, i: usize, j: usize) -> f64 {
        let inside = (1..=self.points[0]).contains(&i) && (1..=self.points[1]).contains(&j);
        let value = if inside { self.values[i - 1 + (j - 1) * self.points[0]] } else { f64::NAN };
        if value.is_finite() { value } else { f64::NEG_INFINITY }
    }

    fn crossing(&self, (i, j, upright): Edge, threshold: f64) -> [f64; 2] {
        let (a, b) = (self.padded(i, j), if upright { self.padded(i, j + 1) } else { self.padded(i + 1, j) });
        // Beside the padding the border runs through the last point.
        let share =
            if a.is_finite() && b.is_finite() { (threshold - a) / (b - a) } else { f64::from(u8::from(b.is_finite())) };
        let [x, y] =
            [self.origin[0] + (i as f64 - 1.0) * self.spacing[0], self.origin[1] + (j as f64 - 1.0) * self.spacing[1]];
        if upright { [x, y + share * self.spacing[1]] } else { [x + share * self.spacing[0], y] }
    }

    /// The borders of the region value ≥ threshold, each closed, the largest first; those of holes go clockwise.
    #[must_use]
    pub fn region(&self, threshold: f64) -> Vec<Vec<[f64; 2]>> {
        let mut next: BTreeMap<Edge, Edge> = BTreeMap::new();
        for j in 0..=self.points[1] {
            for i in 0..=self.points[0] {
                let above = |i: usize, j: usize| threshold <= self.padded(i, j);
                let corners = [above(i, j), above(i + 1, j), above(i + 1, j + 1), above(i, j + 1)];
                // Sides counterclockwise, from corner k to corner k + 1.
                let sides: [Edge; 4] = [(i, j, false), (i + 1, j, true), (i, j + 1, false), (i, j, true)];
                for k in 0..4 {
                    // The border comes in where the region ends on the way around the cell, and leaves where it begins.
                    if !corners[k] || corners[(k + 1) % 4] {
                        continue;
                    }
                    let leaves = (1..4).map(|step| (k + step) % 4).find(|&l| !corners[l] && corners[(l + 1) % 4]);
                    if let Some(leaves) = leaves {
                        next.insert(sides[k], sides[leaves]);
                    }
                }
            }
        }
        let mut loops = Vec::new();
        while let Some((&start, _)) = next.iter().next() {
            let mut points = Vec::new();
            let mut edge = start;
            while let Some(following) = next.remove(&edge) {
                points.push(self.crossing(edge, threshold));
                edge = following;
            }
            loops.push(points);
        }
        loops.sort_by(|a, b| area(b).abs().total_cmp(&area(a).abs()));
        loops
    }
}

/// Positive when counterclockwise.
pub(crate) fn area(polygon: &[[f64; 2]]) -> f64 {
    let count = polygon.len();
    (0..count).map(|i| (polygon[i], polygon[(i + 1) % count])).map(|(a, b)| 0.5 * (a[0] * b[1] - a[1] * b[0])).sum()
}
