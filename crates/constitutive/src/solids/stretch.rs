//! Isotropic laws of the principal stretches: the stress and all tangents once, for all of them.
//!
//! ```text
//! W = Σ w(xₐ) + U(J)        xₐ = ln λₐ, or ln λₐ − ⅓ ln J of the isochoric part of the deformation
//! τ = Σ βₐ nₐ ⊗ nₐ        βₐ = w′(xₐ) + J U′,  of an isochoric law less the mean of the w′
//! P = Σ βₐ/λₐ nₐ ⊗ Nₐ        S = Σ βₐ/λₐ² Nₐ ⊗ Nₐ
//! ```
//! A law gives w and its derivatives as functions of the logarithm, which neither cancel near x = 0 nor
//! where two of them coalesce, and U. Each stress is then a function of U or V, put together by
//! [`StretchAnalysis`]; tangents are closed in the principal frame:
//!
//! ```text
//! A_aabb = (∂βₐ/∂xᵦ − δₐᵦ βₐ)/(λₐ λᵦ)        A_abab = G        A_abba = (½ (λₐ² + λᵦ²) G − ½ (βₐ + βᵦ))/(λₐ λᵦ)
//! G = (βₐ − βᵦ)/(λₐ² − λᵦ²) = w′[xₐ, xᵦ] ln[λₐ², λᵦ²]/2
//! ```
//! Square brackets are divided differences, finite for equal stretches. No evaluation fails, whatever the stretches.

use piola_continuum::spectral::{IsotropicFunction, Logarithm, StretchAnalysis};
use piola_continuum::stress::tangents::{FirstPiolaTangent, MaterialTangent, TruesdellTangent, kernels::push_forward};
use piola_continuum::tensor::rows::{Rows, identity, product, scaled, sum, transpose};
use piola_continuum::tensor::{FourthOrder, MajorSymmetric};
use piola_continuum::{CauchyStress, Deformation, FirstPiola, KirchhoffStress, SecondPiola, Symmetric};
use piola_numerics::linear::matrix3::from_rows;
use piola_numerics::{Gradient, Mask, Real};

use crate::ConstitutiveError;

/// The volume as its part U(J) of an energy wants it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Volume<T> {
    /// ln J.
    pub logarithm: T,
    /// J − 1.
    pub change: T,
    /// J.
    pub jacobian: T,
}

impl<T: Real> Volume<T> {
    /// That of F or ∇u.
    #[inline(always)]
    #[must_use]
    pub fn of(deformation: &impl Deformation<T>) -> Self {
        Self {
            logarithm: deformation.ln_jacobian(),
            change: deformation.volume_change(),
            jacobian: deformation.jacobian(),
        }
    }
}

/// An energy Σ w(ln λₐ) + U(J) with its derivatives in closed form.
pub trait StretchEnergy {
    /// Whether w acts on the isochoric part J^(−1/3) F of the deformation.
    const ISOCHORIC: bool;

    /// Refuses deformations at which the law has no answer.
    ///
    /// # Errors
    /// [`ConstitutiveError::BeyondLimit`]; most laws have no limit.
    #[inline(always)]
    fn check<T: Real>(&self, _deformation: &impl Deformation<T>) -> Result<(), ConstitutiveError> {
        Ok(())
    }

    /// Whether the body keeps its volume.
    #[must_use]
    fn is_incompressible(&self) -> bool {
        false
    }

    /// w(x), J/m³, w(0) = w′(0) = 0, without cancellation near 0.
    #[must_use]
    fn part<T: Real>(&self, x: T) -> T;

    /// w′(x), Pa, without cancellation near 0.
    #[must_use]
    fn slope<T: Real>(&self, x: T) -> T;

    /// w″(x), Pa.
    #[must_use]
    fn curvature<T: Real>(&self, x: T) -> T;

    /// w′[x, y] = (w′(x) − w′(y))/(x − y), w″(x) for x = y.
    #[must_use]
    fn secant<T: Real>(&self, x: T, y: T) -> T;

    /// U(J), J/m³, without cancellation.
    #[must_use]
    fn volume_energy<T: Real>(&self, volume: &Volume<T>) -> T;

    /// J U′, Pa, without cancellation.
    #[must_use]
    fn volume_slope<T: Real>(&self, volume: &Volume<T>) -> T;

    /// J (J U′)′, Pa.
    #[must_use]
    fn volume_curvature<T: Real>(&self, volume: &Volume<T>) -> T;
}

/// J^(−1/3) F, kept as itself and as its difference from 1.
#[derive(Clone, Copy)]
struct Isochoric<T> {
    gradient: Rows<T>,
    displacement: Rows<T>,
}

impl<T: Real> Isochoric<T> {
    #[inline(always)]
    fn of(deformation: &impl Deformation<T>) -> Self {
        let third = deformation.ln_jacobian() * T::lit(-1.0 / 3.0);
        let scale = third.exp();
        let mut displacement = scaled(deformation.displacement_rows(), scale);
        let change = third.exp_m1();
        for (k, row) in displacement.iter_mut().enumerate() {
            row[k] += change;
        }
        Self { gradient: scaled(deformation.gradient_rows(), scale), displacement }
    }
}

impl<T: Real> Deformation<T> for Isochoric<T> {
    #[inline(always)]
    fn gradient_rows(&self) -> Rows<T> {
        self.gradient
    }
    #[inline(always)]
    fn displacement_rows(&self) -> Rows<T> {
        self.displacement
    }
    #[inline(always)]
    fn lifted<S: Real>(&self, lift: impl Fn(usize, usize, T) -> S) -> impl Deformation<S> {
        let entry = |i: usize, j: usize| lift(i, j, self.displacement[i][j]);
        let row = |i: usize| [entry(i, 0), entry(i, 1), entry(i, 2)];
        let displacement = [row(0), row(1), row(2)];
        Isochoric { gradient: sum(displacement, identity()), displacement }
    }
    #[inline(always)]
    fn jacobian(&self) -> T {
        T::one()
    }
    #[inline(always)]
    fn volume_change(&self) -> T {
        T::zero()
    }
}

/// w(ln λ), whose sum over the stretches is the energy.
struct Part<'a, L>(&'a L);

impl<L: StretchEnergy> IsotropicFunction for Part<'_, L> {
    #[inline(always)]
    fn value<T: Real>(&self, stretch: T) -> T {
        self.0.part(stretch.ln())
    }
    #[inline(always)]
    fn value_beside_one<T: Real>(&self, elongation: T) -> T {
        self.0.part(elongation.ln_1p())
    }
    #[inline(always)]
    fn slope_at_one<T: Real>(&self) -> T {
        T::zero()
    }
}

/// w′(ln λ)/λⁿ: n = 0 for τ, 1 for P, 2 for S.
struct Stress<'a, L, const N: usize>(&'a L);

impl<L: StretchEnergy, const N: usize> Stress<'_, L, N> {
    #[inline(always)]
    fn divided<T: Real>(slope: T, stretch: T) -> T {
        match N {
            0 => slope,
            1 => slope / stretch,
            _ => slope / (stretch * stretch),
        }
    }
}

impl<L: StretchEnergy, const N: usize> IsotropicFunction for Stress<'_, L, N> {
    #[inline(always)]
    fn value<T: Real>(&self, stretch: T) -> T {
        Self::divided(self.0.slope(stretch.ln()), stretch)
    }
    #[inline(always)]
    fn value_beside_one<T: Real>(&self, elongation: T) -> T {
        Self::divided(self.0.slope(elongation.ln_1p()), T::one() + elongation)
    }
    #[inline(always)]
    fn divided_difference<T: Real>(&self, a: T, b: T) -> T {
        let (x, y) = (a.ln(), b.ln());
        let slope = self.0.secant(x, y) * Logarithm.divided_difference(a, b);
        // (f g)[a, b] = f[a, b] g(b) + f(a) g[a, b]
        match N {
            0 => slope,
            1 => (slope - self.0.slope(x) / a) / b,
            _ => (slope - self.0.slope(x) * (a + b) / (a * a)) / (b * b),
        }
    }
    #[inline(always)]
    fn rough_divided_difference<T: Real>(&self, a: T, b: T, value_at_a: T, value_at_b: T) -> T {
        let (sum, gap) = (a + b, a - b);
        let near = gap.abs().less_than(sum * T::lit(1e-4));
        let quotient = (value_at_a - value_at_b) / T::select(near, T::one(), gap);
        if !near.any() {
            return quotient;
        }
        let middle = T::lit(0.5) * sum;
        let x = middle.ln();
        let order = T::lit(match N {
            0 => 0.0,
            1 => 1.0,
            _ => 2.0,
        });
        let slope = Self::divided(self.0.curvature(x) - order * self.0.slope(x), middle) / middle;
        T::select(near, slope, quotient)
    }
    #[inline(always)]
    fn slope_at_one<T: Real>(&self) -> T {
        self.0.curvature(T::zero())
    }
}

/// The stretches that w acts on.
#[inline(always)]
fn analysis<T: Real, L: StretchEnergy>(deformation: &impl Deformation<T>) -> StretchAnalysis<T> {
    if L::ISOCHORIC { StretchAnalysis::of(&Isochoric::of(deformation)) } else { StretchAnalysis::of(deformation) }
}

/// W less W of the reference.
///
/// # Accuracy
/// A few ulp of Σ |w| + |U|, down to the smallest strains.
#[inline(always)]
#[must_use]
pub fn energy<T: Real, L: StretchEnergy>(law: &L, deformation: &impl Deformation<T>) -> T {
    let stretches = analysis::<T, L>(deformation);
    let volume = law.volume_energy(&Volume::of(deformation));
    if T::ORDER == 0 {
        let [x, y, z] = stretches.log_principal_stretches();
        return (law.part(x) + law.part(y) + law.part(z)) + volume;
    }
    stretches.material_function(&Part(law)).trace() + volume
}

/// What is the same in all directions of βₐ: J U′, of an isochoric law less the mean of the w′.
#[inline(always)]
fn uniform<T: Real, L: StretchEnergy>(law: &L, stretches: &StretchAnalysis<T>, volume: &Volume<T>) -> T {
    let slope = law.volume_slope(volume);
    if !L::ISOCHORIC {
        return slope;
    }
    let sum = if T::ORDER == 0 {
        let [x, y, z] = stretches.log_principal_stretches();
        law.slope(x) + law.slope(y) + law.slope(z)
    } else {
        stretches.material_function(&Stress::<L, 0>(law)).trace()
    };
    slope - sum * T::lit(1.0 / 3.0)
}

/// J^(−1/3) for an isochoric law, whose stretches are λₐ times it; otherwise 1.
#[inline(always)]
fn isochoric_scale<T: Real, L: StretchEnergy>(volume: &Volume<T>) -> T {
    if L::ISOCHORIC { (volume.logarithm * T::lit(-1.0 / 3.0)).exp() } else { T::one() }
}

/// τ.
#[inline(always)]
#[must_use]
pub fn kirchhoff<T: Real, L: StretchEnergy>(law: &L, deformation: &impl Deformation<T>) -> KirchhoffStress<T> {
    let volume = Volume::of(deformation);
    let stress = analysis::<T, L>(deformation).spatial_function(&Stress::<L, 0>(law));
    let stress = if L::ISOCHORIC { stress.deviator() } else { stress };
    KirchhoffStress(stress + Symmetric::identity() * law.volume_slope(&volume))
}

/// P = R f(U) + p F⁻ᵀ.
#[inline(always)]
#[must_use]
pub fn first_piola<T: Real, L: StretchEnergy>(law: &L, deformation: &impl Deformation<T>) -> FirstPiola<T> {
    let volume = Volume::of(deformation);
    FirstPiola(from_rows(first_piola_rows(law, &analysis::<T, L>(deformation), &volume, deformation)))
}

#[inline(always)]
fn first_piola_rows<T: Real, L: StretchEnergy>(
    law: &L,
    stretches: &StretchAnalysis<T>,
    volume: &Volume<T>,
    deformation: &impl Deformation<T>,
) -> Rows<T> {
    let stress = stretches.material_function(&Stress::<L, 1>(law)) * isochoric_scale::<T, L>(volume);
    let uniform = uniform(law, stretches, volume);
    let inverse_transpose = scaled(deformation.cofactor_rows(), volume.jacobian.recip());
    sum(product(stretches.rotation(), stress.rows()), scaled(inverse_transpose, uniform))
}

/// S = f(U) + p C⁻¹.
#[inline(always)]
#[must_use]
pub fn second_piola<T: Real, L: StretchEnergy>(law: &L, deformation: &impl Deformation<T>) -> SecondPiola<T> {
    let volume = Volume::of(deformation);
    let stretches = analysis::<T, L>(deformation);
    let scale = isochoric_scale::<T, L>(&volume);
    let stress = stretches.material_function(&Stress::<L, 2>(law)) * (scale * scale);
    let inverse = deformation.inverse_rows();
    let inverse_square = Symmetric::gram(inverse);
    SecondPiola(stress + inverse_square * uniform(law, &stretches, &volume))
}

/// The law in the principal frame.
struct Principal<T> {
    stretches: [T; 3],
    /// βₐ.
    stress: [T; 3],
    /// ∂βₐ/∂ ln λᵦ for 11, 22, 33, 12, 23, 13.
    stiffness: [T; 6],
    /// (βₐ − βᵦ)/(λₐ² − λᵦ²) for 12, 23, 13.
    secant: [T; 3],
}

/// The two stretches of 12, 23, 13.
const PAIRS: [(usize, usize); 3] = [(0, 1), (1, 2), (0, 2)];

impl<T: Real> Principal<T> {
    #[inline(always)]
    fn of<L: StretchEnergy>(law: &L, analysis: &StretchAnalysis<T>, volume: &Volume<T>) -> Self {
        let x = analysis.log_principal_stretches();
        let scale = isochoric_scale::<T, L>(volume).recip();
        let stretches = analysis.principal_stretches().map(|stretch| stretch * scale);
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
        let secant = |a: usize, b: usize| {
            let (l, m) = (stretches[a], stretches[b]);
            T::lit(0.5) * law.secant(x[a], x[b]) * Logarithm.divided_difference(l * l, m * m)
        };
        Self {
            stretches,
            stress: [slope[0] + uniform, slope[1] + uniform, slope[2] + uniform],
            stiffness,
            secant: [secant(0, 1), secant(1, 2), secant(0, 2)],
        }
    }

    /// P = Σ βₐ/λₐ nₐ ⊗ Nₐ.
    #[inline(always)]
    fn first_piola(&self, analysis: &StretchAnalysis<T>) -> FirstPiola<T> {
        let (n, m) = (analysis.spatial_axes(), analysis.material_axes());
        let values = [0, 1, 2].map(|a| self.stress[a] / self.stretches[a]);
        let entry = |i: usize, j: usize| {
            (values[0] * n[0][i]) * m[0][j] + (values[1] * n[1][i]) * m[1][j] + (values[2] * n[2][i]) * m[2][j]
        };
        FirstPiola(from_rows([0, 1, 2].map(|i| [0, 1, 2].map(|j| entry(i, j)))))
    }

    /// Σ valueₐ axisₐ ⊗ axisₐ.
    #[inline(always)]
    fn about(values: [T; 3], axes: &Rows<T>) -> Symmetric<T> {
        let entry = |(i, j): (usize, usize)| {
            (values[0] * axes[0][i]) * axes[0][j]
                + (values[1] * axes[1][i]) * axes[1][j]
                + (values[2] * axes[2][i]) * axes[2][j]
        };
        Symmetric { components: [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)].map(entry) }
    }

    /// S = Σ βₐ/λₐ² Nₐ ⊗ Nₐ.
    #[inline(always)]
    fn second_piola(&self, analysis: &StretchAnalysis<T>) -> SecondPiola<T> {
        let values = [0, 1, 2].map(|a| self.stress[a] / self.stretches[a] / self.stretches[a]);
        SecondPiola(Self::about(values, &analysis.material_axes()))
    }

    /// ∂S/∂E: F⁻¹ nₐ = Nₐ/λₐ.
    #[inline(always)]
    fn material_tangent(&self, analysis: &StretchAnalysis<T>) -> MaterialTangent<T> {
        let axes = analysis.material_axes();
        let pulled = |a: usize| axes[a].map(|x| x / self.stretches[a]);
        let frame = transpose([pulled(0), pulled(1), pulled(2)]);
        MaterialTangent(MajorSymmetric { components: push_forward(frame, &self.lie()) })
    }

    /// c/J.
    #[inline(always)]
    fn truesdell_tangent(&self, analysis: &StretchAnalysis<T>, volume: &Volume<T>) -> TruesdellTangent<T> {
        let scale = volume.jacobian.recip();
        let components = push_forward(transpose(analysis.spatial_axes()), &self.lie().map(|x| x * scale));
        TruesdellTangent(MajorSymmetric { components })
    }

    /// `λₐ λᵦ A_abba` for 12, 23, 13.
    #[inline(always)]
    fn exchange(&self, pair: usize) -> T {
        let (a, b) = PAIRS[pair];
        let (l, m) = (self.stretches[a], self.stretches[b]);
        T::lit(0.5) * ((l * l + m * m) * self.secant[pair] - (self.stress[a] + self.stress[b]))
    }

    /// The tangent of the Lie derivative of τ in the spatial frame, its upper triangle by rows.
    #[inline(always)]
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

/// ∂S/∂E, closed in the frame of the material axes.
///
/// # Accuracy
/// A few ulp of its norm × (λ₁/λ₃)², also for equal stretches.
#[inline(always)]
#[must_use]
pub fn material_tangent<T: Real, L: StretchEnergy>(law: &L, deformation: &impl Deformation<T>) -> MaterialTangent<T> {
    if T::ORDER != 0 {
        return derived_material_tangent(law, deformation);
    }
    let analysis = analysis::<T, L>(deformation);
    Principal::of(law, &analysis, &Volume::of(deformation)).material_tangent(&analysis)
}

/// (S, ∂S/∂E), the stretches analysed once.
#[inline(always)]
#[must_use]
pub fn second_piola_and_tangent<T: Real, L: StretchEnergy>(
    law: &L,
    deformation: &impl Deformation<T>,
) -> (SecondPiola<T>, MaterialTangent<T>) {
    if T::ORDER != 0 {
        return (second_piola(law, deformation), derived_material_tangent(law, deformation));
    }
    let analysis = analysis::<T, L>(deformation);
    let principal = Principal::of(law, &analysis, &Volume::of(deformation));
    (principal.second_piola(&analysis), principal.material_tangent(&analysis))
}

/// (T, c/J), the stretches analysed once.
#[inline(always)]
#[must_use]
pub fn cauchy_and_tangent<T: Real, L: StretchEnergy>(
    law: &L,
    deformation: &impl Deformation<T>,
) -> (CauchyStress<T>, TruesdellTangent<T>) {
    if T::ORDER != 0 {
        return (kirchhoff(law, deformation).cauchy(deformation), truesdell_tangent(law, deformation));
    }
    let volume = Volume::of(deformation);
    let analysis = analysis::<T, L>(deformation);
    let principal = Principal::of(law, &analysis, &volume);
    let values = principal.stress.map(|stress| stress / volume.jacobian);
    let stress = CauchyStress(Principal::about(values, &analysis.spatial_axes()));
    (stress, principal.truesdell_tangent(&analysis, &volume))
}

/// c/J, closed in the frame of the spatial axes.
#[inline(always)]
#[must_use]
pub fn truesdell_tangent<T: Real, L: StretchEnergy>(law: &L, deformation: &impl Deformation<T>) -> TruesdellTangent<T> {
    if T::ORDER != 0 {
        return derived_material_tangent(law, deformation).truesdell(deformation);
    }
    let volume = Volume::of(deformation);
    let analysis = analysis::<T, L>(deformation);
    Principal::of(law, &analysis, &volume).truesdell_tangent(&analysis, &volume)
}

/// ∂P/∂F, closed in the two principal frames.
#[inline(always)]
#[must_use]
pub fn first_piola_tangent<T: Real, L: StretchEnergy>(
    law: &L,
    deformation: &impl Deformation<T>,
) -> FirstPiolaTangent<T> {
    if T::ORDER != 0 {
        return derived_tangent(law, deformation);
    }
    let analysis = analysis::<T, L>(deformation);
    tangent(&Principal::of(law, &analysis, &Volume::of(deformation)), &analysis)
}

/// (P, ∂P/∂F), the stretches analysed once.
#[inline(always)]
#[must_use]
pub fn first_piola_and_tangent<T: Real, L: StretchEnergy>(
    law: &L,
    deformation: &impl Deformation<T>,
) -> (FirstPiola<T>, FirstPiolaTangent<T>) {
    if T::ORDER != 0 {
        return (first_piola(law, deformation), derived_tangent(law, deformation));
    }
    let analysis = analysis::<T, L>(deformation);
    let principal = Principal::of(law, &analysis, &Volume::of(deformation));
    (principal.first_piola(&analysis), tangent(&principal, &analysis))
}

/// Over scalars with derivatives axes have none where stretches coalesce, but the stress has.
#[inline(never)]
fn derived_tangent<T: Real, L: StretchEnergy>(law: &L, deformation: &impl Deformation<T>) -> FirstPiolaTangent<T> {
    let varied = deformation.lifted(|i, j, x| Gradient::<T, 9>::variable(x, 3 * i + j));
    let stress = first_piola(law, &varied).0;
    let mut components = [[T::zero(); 9]; 9];
    for (place, row) in components.iter_mut().enumerate() {
        *row = stress[(place / 3, place % 3)].partials;
    }
    FirstPiolaTangent(FourthOrder { components })
}

#[inline(never)]
fn derived_material_tangent<T: Real, L: StretchEnergy>(
    law: &L,
    deformation: &impl Deformation<T>,
) -> MaterialTangent<T> {
    let tangent = derived_tangent(law, deformation);
    MaterialTangent(tangent.material(&second_piola(law, deformation), deformation).0.major_part())
}

#[inline(always)]
fn tangent<T: Real>(principal: &Principal<T>, analysis: &StretchAnalysis<T>) -> FirstPiolaTangent<T> {
    let (n, m) = (analysis.spatial_axes(), analysis.material_axes());
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
    let entry = |a: usize, b: usize| {
        let place = [[0, 3, 5], [3, 1, 4], [5, 4, 2]][a][b];
        let whole = if a == b { principal.stiffness[place] - principal.stress[a] } else { principal.stiffness[place] };
        whole * (reciprocal[a] * reciprocal[b])
    };
    for a in 0..3 {
        let (x, y, z) = (entry(a, 0), entry(a, 1), entry(a, 2));
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

/// Writes [`Hyperelastic`](super::Hyperelastic) for a law of principal stretches, the parameters of a generic one in brackets
/// first.
macro_rules! hyperelastic_of_stretches {
    ([$($generics:tt)*] $law:ty) => {
        $crate::solids::stretch::hyperelastic_of_stretches! { [$($generics)*] $law,
            energy -> T,
            first_piola -> piola_continuum::FirstPiola<T>,
            second_piola -> piola_continuum::SecondPiola<T>,
            kirchhoff -> piola_continuum::KirchhoffStress<T>,
            first_piola_tangent -> piola_continuum::stress::tangents::FirstPiolaTangent<T>,
            first_piola_and_tangent ->
                (piola_continuum::FirstPiola<T>, piola_continuum::stress::tangents::FirstPiolaTangent<T>),
            material_tangent -> piola_continuum::stress::tangents::MaterialTangent<T>,
            truesdell_tangent -> piola_continuum::stress::tangents::TruesdellTangent<T>,
            second_piola_and_tangent ->
                (piola_continuum::SecondPiola<T>, piola_continuum::stress::tangents::MaterialTangent<T>),
            cauchy_and_tangent ->
                (piola_continuum::CauchyStress<T>, piola_continuum::stress::tangents::TruesdellTangent<T>)
        }
    };
    ([$($generics:tt)*] $law:ty, $($method:ident -> $result:ty),*) => {
        impl<$($generics)*> $crate::solids::Hyperelastic for $law {
            #[inline(always)]
            fn check<T: piola_numerics::Real>(
                &self,
                deformation: &impl piola_continuum::Deformation<T>,
            ) -> Result<(), $crate::ConstitutiveError> {
                $crate::solids::stretch::StretchEnergy::check(self, deformation)
            }
            fn is_incompressible(&self) -> bool {
                $crate::solids::stretch::StretchEnergy::is_incompressible(self)
            }
            $(
                #[inline(always)]
                fn $method<T: piola_numerics::Real>(
                    &self,
                    deformation: &impl piola_continuum::Deformation<T>,
                ) -> $result {
                    $crate::solids::stretch::$method(self, deformation)
                }
            )*
        }
    };
}
pub(super) use hyperelastic_of_stretches;
