//! A law of stretches in the principal frame: stresses and tangents from one set of terms.

use piola_continuum::internal::tangents::push_forward;
use piola_continuum::polar::StretchAnalysis;
use piola_continuum::stress::tangents::{FirstPiolaTangent, MaterialTangent, TruesdellTangent};
use piola_continuum::{FirstPiola, SecondPiola, Symmetric};
use piola_numerics::Real;
use piola_numerics::linear::matrix3::from_rows;
use piola_tensor::internal::rows::{Rows, transpose};
use piola_tensor::spectral::{IsotropicFunction, Logarithm};
use piola_tensor::{FourthOrder, MajorSymmetric};

use super::energy::{StretchEnergy, Volume, isochoric_scale};

/// The law in the principal frame.
pub(super) struct Principal<T> {
    stretches: [T; 3],
    /// βₐ.
    pub(super) stress: [T; 3],
    /// ∂βₐ/∂ ln λᵦ for 11, 22, 33, 12, 23, 13.
    stiffness: [T; 6],
    /// (βₐ − βᵦ)/(λₐ² − λᵦ²) for 12, 23, 13.
    secant: [T; 3],
}

/// The two stretches of 12, 23, 13.
const PAIRS: [(usize, usize); 3] = [(0, 1), (1, 2), (0, 2)];

impl<T: Real> Principal<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn of<L: StretchEnergy>(law: &L, analysis: &StretchAnalysis<T>, volume: &Volume<T>) -> Self {
        let x = analysis.log_principal_stretches();
        let scale = isochoric_scale::<T, L>(volume).recip();
        let [l, m, n] = analysis.principal_stretches();
        let stretches = [l * scale, m * scale, n * scale];
        let slope = [law.slope(x[0]), law.slope(x[1]), law.slope(x[2])];
        let curvature = [law.curvature(x[0]), law.curvature(x[1]), law.curvature(x[2])];
        let bulk = law.volume_curvature(volume);
        let mut uniform = law.volume_slope(volume);
        let mut stiffness = [curvature[0], curvature[1], curvature[2], T::zero(), T::zero(), T::zero()];
        if L::ISOCHORIC {
            let third = T::lit(1.0 / 3.0);
            uniform -= (slope[0] + slope[1] + slope[2]) * third;
            let mean = (curvature[0] + curvature[1] + curvature[2]) * (third * third);
            for (place, entry) in stiffness.iter_mut().enumerate() {
                let (a, b) = if place < 3 { (place, place) } else { PAIRS[place - 3] };
                *entry += mean - (curvature[a] + curvature[b]) * third;
            }
        }
        for entry in &mut stiffness {
            *entry += bulk;
        }
        let secant =
            [secant(law, &x, &stretches, 0, 1), secant(law, &x, &stretches, 1, 2), secant(law, &x, &stretches, 0, 2)];
        Self { stretches, stress: [slope[0] + uniform, slope[1] + uniform, slope[2] + uniform], stiffness, secant }
    }

    /// P = Σ βₐ/λₐ nₐ ⊗ Nₐ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn first_piola(&self, [n, m]: [&Rows<T>; 2]) -> FirstPiola<T> {
        let v = quotients(self.stress, self.stretches);
        FirstPiola(from_rows([
            [dyads(v, n, m, 0, 0), dyads(v, n, m, 0, 1), dyads(v, n, m, 0, 2)],
            [dyads(v, n, m, 1, 0), dyads(v, n, m, 1, 1), dyads(v, n, m, 1, 2)],
            [dyads(v, n, m, 2, 0), dyads(v, n, m, 2, 1), dyads(v, n, m, 2, 2)],
        ]))
    }

    /// Its fifteen numbers.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) const fn numbers(&self) -> [T; 15] {
        let ([a, b, c], [d, e, f], [x, y, z]) = (self.stretches, self.stress, self.secant);
        let [g, h, i, j, k, l] = self.stiffness;
        [a, b, c, d, e, f, g, h, i, j, k, l, x, y, z]
    }

    /// Of its numbers.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) const fn of_numbers([a, b, c, d, e, f, g, h, i, j, k, l, x, y, z]: [T; 15]) -> Self {
        Self { stretches: [a, b, c], stress: [d, e, f], stiffness: [g, h, i, j, k, l], secant: [x, y, z] }
    }

    /// Σ valueₐ axisₐ ⊗ axisₐ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn about(v: [T; 3], n: &Rows<T>) -> Symmetric<T> {
        Symmetric {
            components: [
                dyads(v, n, n, 0, 0),
                dyads(v, n, n, 1, 1),
                dyads(v, n, n, 2, 2),
                dyads(v, n, n, 0, 1),
                dyads(v, n, n, 1, 2),
                dyads(v, n, n, 0, 2),
            ],
        }
    }

    /// S = Σ βₐ/λₐ² Nₐ ⊗ Nₐ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn second_piola(&self, analysis: &StretchAnalysis<T>) -> SecondPiola<T> {
        let values = quotients(quotients(self.stress, self.stretches), self.stretches);
        SecondPiola(Self::about(values, &analysis.material_axes()))
    }

    /// ∂S/∂E: F⁻¹ nₐ = Nₐ/λₐ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn material_tangent(&self, analysis: &StretchAnalysis<T>) -> MaterialTangent<T> {
        let ([a, b, c], [l, m, n]) = (analysis.material_axes(), self.stretches);
        let frame = transpose([quotients(a, [l; 3]), quotients(b, [m; 3]), quotients(c, [n; 3])]);
        MaterialTangent(MajorSymmetric { components: push_forward(frame, &self.lie()) })
    }

    /// c/J.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn truesdell_tangent(&self, analysis: &StretchAnalysis<T>, volume: &Volume<T>) -> TruesdellTangent<T> {
        let scale = volume.jacobian.recip();
        let components = push_forward(transpose(analysis.spatial_axes()), &self.lie().map(|x| x * scale));
        TruesdellTangent(MajorSymmetric { components })
    }

    /// `λₐ λᵦ A_abba` for 12, 23, 13.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn exchange(&self, pair: usize) -> T {
        let (a, b) = PAIRS[pair];
        let (l, m) = (self.stretches[a], self.stretches[b]);
        T::lit(0.5) * ((l * l + m * m) * self.secant[pair] - (self.stress[a] + self.stress[b]))
    }

    /// The tangent of the Lie derivative of τ in the spatial frame, its upper triangle by rows.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn lie(&self) -> [T; 21] {
        let (o, k) = (T::zero(), &self.stiffness);
        let along = |a: usize| k[a] - T::lit(2.0) * self.stress[a];
        let across = [self.exchange(0), self.exchange(1), self.exchange(2)];
        [
            along(0),
            k[3],
            k[5],
            o,
            o,
            o,
            along(1),
            k[4],
            o,
            o,
            o,
            along(2),
            o,
            o,
            o,
            across[0],
            o,
            o,
            across[1],
            o,
            across[2],
        ]
    }
}

// Functions, not closures, which the compiler may leave out of line, where there are no lanes.

/// (βₐ − βᵦ)/(λₐ² − λᵦ²).
#[cfg_attr(not(debug_assertions), inline(always))]
fn secant<T: Real, L: StretchEnergy>(law: &L, x: &[T; 3], stretches: &[T; 3], a: usize, b: usize) -> T {
    let (l, m) = (stretches[a], stretches[b]);
    T::lit(0.5) * law.secant(x[a], x[b]) * Logarithm.divided_difference(l * l, m * m)
}

/// Component by component.
#[cfg_attr(not(debug_assertions), inline(always))]
fn quotients<T: Real>([a, b, c]: [T; 3], [x, y, z]: [T; 3]) -> [T; 3] {
    [a / x, b / y, c / z]
}

/// Entry (i, j) of Σ vₐ nₐ ⊗ mₐ.
#[cfg_attr(not(debug_assertions), inline(always))]
fn dyads<T: Real>(v: [T; 3], n: &Rows<T>, m: &Rows<T>, i: usize, j: usize) -> T {
    (v[0] * n[0][i]) * m[0][j] + (v[1] * n[1][i]) * m[1][j] + (v[2] * n[2][i]) * m[2][j]
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn tangent<T: Real>(principal: &Principal<T>, [n, m]: [&Rows<T>; 2]) -> FirstPiolaTangent<T> {
    let [l, k, j] = principal.stretches;
    let reciprocal = [l.recip(), k.recip(), j.recip()];
    // nₐ ⊗ Nᵦ as nine entries, row 3a + b.
    let mut dyads = [[T::zero(); 9]; 9];
    for a in 0..3 {
        for b in 0..3 {
            let (x, y) = (n[a], m[b]);
            dyads[3 * a + b] = [
                x[0] * y[0],
                x[0] * y[1],
                x[0] * y[2],
                x[1] * y[0],
                x[1] * y[1],
                x[1] * y[2],
                x[2] * y[0],
                x[2] * y[1],
                x[2] * y[2],
            ];
        }
    }
    // The tangent in the frames, times the dyads.
    let mut half = [[T::zero(); 9]; 9];
    let ([xx, yy, zz, xy, yz, xz], stress) = (principal.stiffness, principal.stress);
    let whole = [[xx - stress[0], xy, xz], [xy, yy - stress[1], yz], [xz, yz, zz - stress[2]]];
    let scale = |a: usize, b: usize| reciprocal[a] * reciprocal[b];
    for a in 0..3 {
        let (x, y, z) = (whole[a][0] * scale(a, 0), whole[a][1] * scale(a, 1), whole[a][2] * scale(a, 2));
        for column in 0..9 {
            half[4 * a][column] = x * dyads[0][column] + y * dyads[4][column] + z * dyads[8][column];
        }
    }
    for (pair, (a, b)) in PAIRS.into_iter().enumerate() {
        let own = principal.secant[pair];
        let exchange = principal.exchange(pair) * (reciprocal[a] * reciprocal[b]);
        let (forth, back) = (3 * a + b, 3 * b + a);
        for column in 0..9 {
            let (x, y) = (dyads[forth][column], dyads[back][column]);
            half[forth][column] = own * x + exchange * y;
            half[back][column] = exchange * x + own * y;
        }
    }
    let mut components = [[T::zero(); 9]; 9];
    for r in 0..9 {
        for s in r..9 {
            let mut total = dyads[0][r] * half[0][s];
            for k in 1..9 {
                total += dyads[k][r] * half[k][s];
            }
            components[r][s] = total;
            components[s][r] = total;
        }
    }
    FirstPiolaTangent(FourthOrder { components })
}
