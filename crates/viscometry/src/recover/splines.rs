//! B-splines on given abscissas: values and derivatives without allocation.
//!
//! ```text
//! B⁰ᵢ = 1 on [tᵢ, tᵢ₊₁)      Bᵖᵢ = (u − tᵢ)/(tᵢ₊ₚ − tᵢ) Bᵖ⁻¹ᵢ + (tᵢ₊ₚ₊₁ − u)/(tᵢ₊ₚ₊₁ − tᵢ₊₁) Bᵖ⁻¹ᵢ₊₁
//! (Bᵖᵢ)′ = p Bᵖ⁻¹ᵢ/(tᵢ₊ₚ − tᵢ) − p Bᵖ⁻¹ᵢ₊₁/(tᵢ₊ₚ₊₁ − tᵢ₊₁)
//! ```
//! C. de Boor, *A Practical Guide to Splines*, 1978.

use nalgebra::DMatrix;

use super::banded::{Banded, HIGHEST};

/// A value and its first four derivatives.
pub(super) type Derivatives = [f64; 5];

/// The splines of one degree on given knots.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Splines {
    degree: usize,
    knots: Vec<f64>,
}

impl Splines {
    /// As many as there are abscissas, without knots next to the ends (`degree` is odd and below the number of abscissas).
    pub(super) fn on(abscissas: &[f64], degree: usize) -> Self {
        let (count, near) = (abscissas.len(), degree.div_ceil(2));
        let ends = |at: usize| core::iter::repeat_n(abscissas[at], degree + 1);
        let inner = abscissas[near..count - near].iter().copied();
        Self { degree, knots: ends(0).chain(inner).chain(ends(count - 1)).collect() }
    }

    /// Their number.
    pub(super) fn count(&self) -> usize {
        self.knots.len() - self.degree - 1
    }

    /// Their degree.
    pub(super) const fn degree(&self) -> usize {
        self.degree
    }

    /// The intervals between different knots.
    pub(super) fn intervals(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        self.knots.windows(2).filter(|pair| pair[0] < pair[1]).map(|pair| [pair[0], pair[1]])
    }

    /// The first of the splines that do not vanish at `u`, and those `degree` + 1 with their derivatives.
    fn at(&self, u: f64) -> (usize, [[f64; HIGHEST + 1]; 5]) {
        let (p, t) = (self.degree, &self.knots);
        let span = t[p + 1..self.count()].partition_point(|knot| *knot <= u) + p;
        // Of all degrees up to p: `lower[d][j]` is B of degree d number span − d + j.
        let mut lower = [[0.0; HIGHEST + 1]; HIGHEST + 1];
        lower[0][0] = 1.0;
        for d in 1..=p {
            for j in 0..d {
                let i = span + 1 + j - d;
                let share = lower[d - 1][j] / (t[i + d] - t[i]);
                lower[d][j] += (t[i + d] - u) * share;
                lower[d][j + 1] += (u - t[i]) * share;
            }
        }
        let mut all = [[0.0; HIGHEST + 1]; 5];
        for (order, row) in all.iter_mut().enumerate().take(p.min(4) + 1) {
            *row = lower[p - order];
            for d in p - order + 1..=p {
                let mut raised = [0.0; HIGHEST + 1];
                for j in 0..d {
                    let i = span + 1 + j - d;
                    let share = d as f64 * row[j] / (t[i + d] - t[i]);
                    raised[j] -= share;
                    raised[j + 1] += share;
                }
                *row = raised;
            }
        }
        (span - p, all)
    }

    /// Of the sum with these coefficients, its value and derivatives at `u`.
    pub(super) fn sum(&self, coefficients: &[f64], u: f64) -> Derivatives {
        let (first, all) = self.at(u);
        all.map(|row| coefficients[first..=first + self.degree].iter().zip(row).map(|(c, b)| c * b).sum())
    }

    /// Adds Σ `weights[k]` B⁽ᵏ⁾(u) to a row of all splines.
    pub(super) fn accumulate(&self, row: &mut [f64], weights: Derivatives, u: f64) {
        let (first, all) = self.at(u);
        for (weight, values) in weights.into_iter().zip(all) {
            for (place, value) in row[first..=first + self.degree].iter_mut().zip(values) {
                *place += weight * value;
            }
        }
    }

    /// Bᵢ⁽ᵏ⁾ at each abscissa, a row each.
    pub(super) fn matrix(&self, abscissas: &[f64], order: usize) -> DMatrix<f64> {
        let mut matrix = DMatrix::zeros(abscissas.len(), self.count());
        for (row, &u) in abscissas.iter().enumerate() {
            let (first, all) = self.at(u);
            for (j, value) in all[order].into_iter().enumerate().take(self.degree + 1) {
                matrix[(row, first + j)] = value;
            }
        }
        matrix
    }

    /// ∫ Bᵢ⁽ᵐ⁾ Bⱼ⁽ᵐ⁾ du.
    pub(super) fn roughness(&self, order: usize) -> DMatrix<f64> {
        let mut gram = DMatrix::zeros(self.count(), self.count());
        let weighted = |[a, b]: [f64; 2], (node, weight): (f64, f64)| {
            let half = 0.5 * (b - a);
            (0.5 * (a + b) + half * node, half * weight)
        };
        for interval in self.intervals() {
            // Degree 2 (p − m) ≤ 8 with p ≤ 5 and 1 < m: five points are exact.
            for (u, weight) in GAUSS.map(|point| weighted(interval, point)) {
                let (first, all) = self.at(u);
                for i in 0..=self.degree {
                    for j in 0..=self.degree {
                        gram[(first + i, first + j)] += weight * all[order][i] * all[order][j];
                    }
                }
            }
        }
        gram
    }

    /// The first spline at `u` and the values of those that do not vanish there.
    pub(super) fn values(&self, u: f64) -> (usize, [f64; HIGHEST + 1]) {
        let (first, all) = self.at(u);
        (first, all[0])
    }

    /// The first spline at `u`, and those that do not vanish there with their derivatives.
    pub(super) fn derivatives(&self, u: f64) -> (usize, [[f64; HIGHEST + 1]; 5]) {
        self.at(u)
    }

    /// The factors of the matrix of all splines at as many abscissas.
    pub(super) fn factors(&self, abscissas: &[f64]) -> Option<Banded> {
        let rows: Vec<(usize, [f64; HIGHEST + 1])> = abscissas.iter().map(|&u| self.values(u)).collect();
        Banded::factors(self.degree, rows.iter().map(|(first, values)| (*first, &values[..=self.degree])))
    }

    /// The coefficients of the sum through the values at the abscissas, refined once; `None` where there is none.
    pub(super) fn through(&self, abscissas: &[f64], values: &[f64]) -> Option<Vec<f64>> {
        let factors = self.factors(abscissas)?;
        let mut found = factors.solve(values);
        let missing: Vec<f64> =
            abscissas.iter().zip(values).map(|(u, value)| value - self.sum(&found, *u)[0]).collect();
        for (coefficient, more) in found.iter_mut().zip(factors.solve(&missing)) {
            *coefficient += more;
        }
        Some(found)
    }
}

/// Gauss and Legendre's five points of [−1, 1].
const GAUSS: [(f64, f64); 5] = [
    (-0.906_179_845_938_664, 0.236_926_885_056_189_08),
    (-0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
    (0.906_179_845_938_664, 0.236_926_885_056_189_08),
];

#[cfg(test)]
mod tests {
    use super::Splines;

    #[test]
    fn splines_of_degree_seven_reproduce_powers_with_their_derivatives() {
        let abscissas: Vec<f64> = (0..12).map(|i| 0.3 * f64::from(i) - 1.0).collect();
        let splines = Splines::on(&abscissas, 7);
        let values: Vec<f64> = abscissas.iter().map(|u| u.powi(5)).collect();
        let coefficients = splines.through(&abscissas, &values).expect("a solution");
        for u in [-1.0_f64, -0.87, 0.5, 1.234, 2.3] {
            let exact = [u.powi(5), 5.0 * u.powi(4), 20.0 * u.powi(3), 60.0 * u * u, 120.0 * u];
            for (actual, exact) in splines.sum(&coefficients, u).into_iter().zip(exact) {
                assert!((actual - exact).abs() < 1e-8 * (1.0 + exact.abs()), "{u}: {actual} {exact}");
            }
        }
    }

    #[test]
    fn the_roughness_of_a_cubic_is_the_integral_of_its_squared_second_derivative() {
        let abscissas: Vec<f64> = (0..9).map(|i| f64::from(i) / 8.0).collect();
        let splines = Splines::on(&abscissas, 5);
        let values: Vec<f64> = abscissas.iter().map(|u| u.powi(3)).collect();
        let c = nalgebra::DVector::from_vec(splines.through(&abscissas, &values).expect("a solution"));
        // ∫ (6 u)² du = 12.
        assert!((c.dot(&(splines.roughness(2) * &c)) - 12.0).abs() < 1e-8);
    }
}
