//! Cells between two characteristics and two levels in the plane, interpolated by bicubic polynomials.

use super::CharacteristicSolution;

/// Components of the strip (x¹, x², u, ξ₁, ξ₂).
const N: usize = 5;

/// A cell of two characteristics and two levels: bicubic, with the exact derivatives at its corners.
pub(super) struct Patch {
    /// At 4 i + j the component c of the coefficient of Hᵢ(a) Hⱼ(b), where a runs along s and b along τ.
    coefficients: [[f64; N]; 16],
}

/// The strip, and its derivatives along both sides, at a point of a cell.
pub(super) type Local = ([f64; N], [f64; N], [f64; N]);

impl Patch {
    /// Of the corners (0, 0), (1, 0), (0, 1), (1, 1) in (s, τ): values, derivatives along s, along τ and along both, in
    /// the units of the cell.
    fn new(corners: &[[[f64; N]; 4]; 4]) -> Self {
        let mut coefficients = [[0.0; N]; 16];
        for (corner, &[value, along_s, along_tau, along_both]) in corners.iter().enumerate() {
            let (i, j) = (2 * (corner % 2), 2 * (corner / 2));
            coefficients[4 * i + j] = value;
            coefficients[4 * (i + 1) + j] = along_s;
            coefficients[4 * i + j + 1] = along_tau;
            coefficients[4 * (i + 1) + j + 1] = along_both;
        }
        Self { coefficients }
    }

    /// The first C components and their derivatives.
    fn at<const C: usize>(&self, a: f64, b: f64) -> [[f64; C]; 3] {
        let ((va, da), (vb, db)) = (hermite(a), hermite(b));
        let mut result = [[0.0; C]; 3];
        for i in 0..4 {
            let (mut value, mut slope) = ([0.0; C], [0.0; C]);
            for j in 0..4 {
                let coefficient = &self.coefficients[4 * i + j];
                for c in 0..C {
                    value[c] += vb[j] * coefficient[c];
                    slope[c] += db[j] * coefficient[c];
                }
            }
            for c in 0..C {
                result[0][c] += va[i] * value[c];
                result[1][c] += da[i] * value[c];
                result[2][c] += va[i] * slope[c];
            }
        }
        result
    }

    /// (a, b) with x(a, b) = x in the cell made larger by `edge` of itself, from a start.
    pub(super) fn invert(&self, x: [f64; 2], (mut a, mut b): (f64, f64), edge: f64) -> Option<(f64, f64, Local)> {
        const STEPS: usize = 25;
        /// So often an iterate may leave the neighbourhood of the cell.
        const EXCURSIONS: usize = 3;
        let mut excursions = 0;
        for _ in 0..STEPS {
            let [y, ya, yb] = self.at::<2>(a, b);
            let determinant = ya[0] * yb[1] - ya[1] * yb[0];
            let (dx, dy) = (x[0] - y[0], x[1] - y[1]);
            let (mut da, mut db) = ((dx * yb[1] - dy * yb[0]) / determinant, (ya[0] * dy - ya[1] * dx) / determinant);
            let moved = da.abs().max(db.abs());
            if !moved.is_finite() {
                return None;
            }
            if moved <= 1e-12 {
                let inside = |a: f64| -edge <= a && a <= 1.0 + edge;
                let [y, ya, yb] = self.at::<N>(a, b);
                return (inside(a) && inside(b)).then_some((a, b, (y, ya, yb)));
            }
            if 0.5 < moved {
                (da, db) = (0.5 * da / moved, 0.5 * db / moved);
            }
            let (next_a, next_b) = ((a + da).clamp(-0.5, 1.5), (b + db).clamp(-0.5, 1.5));
            if (next_a - a - da).abs() + (next_b - b - db).abs() > 1e-9 {
                excursions += 1;
                if excursions == EXCURSIONS {
                    return None;
                }
            }
            (a, b) = (next_a, next_b);
        }
        None
    }
}

/// The cubic polynomials of value and slope at 0 and at 1, and their derivatives.
fn hermite(a: f64) -> ([f64; 4], [f64; 4]) {
    let b = 1.0 - a;
    (
        [b * b * (1.0 + 2.0 * a), a * b * b, a * a * (3.0 - 2.0 * a), -a * a * b],
        [-6.0 * a * b, b * (1.0 - 3.0 * a), 6.0 * a * b, a * (3.0 * a - 2.0)],
    )
}

impl<P, M> CharacteristicSolution<'_, P, M> {
    /// The cell of two characteristics between a level and the next.
    pub(super) fn patch(&self, (first, second): (usize, usize), level: usize) -> Patch {
        let (h, k) = (
            self.levels[level + 1] - self.levels[level],
            self.rays[second].parameters[0] - self.rays[first].parameters[0],
        );
        let corner = |ray: usize, level: usize| {
            let (state, rate) = (self.row(&self.rays[ray].states, level), self.row(&self.rays[ray].rates, level));
            [
                core::array::from_fn(|c| state[c]),
                core::array::from_fn(|c| h * rate[c]),
                core::array::from_fn(|c| k * state[N + c]),
                core::array::from_fn(|c| h * k * rate[N + c]),
            ]
        };
        Patch::new(&[corner(first, level), corner(first, level + 1), corner(second, level), corner(second, level + 1)])
    }

    /// A row of the states, or of the rates, of a ray.
    pub(super) fn row<'r>(&self, rows: &'r [f64], level: usize) -> &'r [f64] {
        let n = rows.len() / self.levels.len();
        &rows[level * n..(level + 1) * n]
    }
}
