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

use piola_continuum::polar::StretchAnalysis;
use piola_continuum::stress::tangents::{FirstPiolaTangent, MaterialTangent, TruesdellTangent};
use piola_continuum::{CauchyStress, Deformation, FirstPiola, KirchhoffStress, SecondPiola, Symmetric};
use piola_numerics::linear::matrix3::from_rows;
use piola_numerics::{Gradient, Real};
use piola_tensor::FourthOrder;
use piola_tensor::internal::rows::{Rows, product, scaled, sum};

use super::known_volume::KnownVolume;

mod energy;
pub(crate) mod frames;
pub(crate) mod isochoric;
mod parts;
mod principal;

use energy::isochoric_scale;
pub use energy::{StretchEnergy, Volume};
use frames::frames;
use isochoric::UnimodularDeformation;
use parts::{Part, Stress};
use principal::{Principal, tangent};

/// The stretches that w acts on.
#[cfg_attr(not(debug_assertions), inline(always))]
fn analysis<T: Real, L: StretchEnergy>(deformation: &impl Deformation<T>) -> StretchAnalysis<T> {
    if L::ISOCHORIC {
        StretchAnalysis::of(&UnimodularDeformation::of(deformation))
    } else {
        StretchAnalysis::of(deformation)
    }
}

/// W less W of the reference.
///
/// # Accuracy
/// A few ulp of Σ |w| + |U|, down to the smallest strains.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn energy<T: Real, L: StretchEnergy>(law: &L, deformation: &impl Deformation<T>) -> T {
    let known = KnownVolume::of(deformation);
    energy_of(law, &analysis::<T, L>(&known), &Volume::of(&known))
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn energy_of<T: Real, L: StretchEnergy>(law: &L, stretches: &StretchAnalysis<T>, volume: &Volume<T>) -> T {
    let volume = law.volume_energy(volume);
    if T::ORDER == 0 {
        let (_, [x, y, z]) = stretches.stretches_in_frame();
        return (law.part(x) + law.part(y) + law.part(z)) + volume;
    }
    stretches.material_function(&Part(law)).trace() + volume
}

/// Σ w′(xₐ)/λₐⁿ over the axes of U, or of V for `SPATIAL`; and Σ w′(xₐ), for an isochoric law.
///
/// Each logarithm and each w′ is computed once, whatever the number of powers in it.
#[cfg_attr(not(debug_assertions), inline(always))]
fn stress_function<T: Real, L: StretchEnergy, const N: usize, const SPATIAL: bool>(
    law: &L,
    stretches: &StretchAnalysis<T>,
) -> (Symmetric<T>, T) {
    let function = Stress::<L, N>(law);
    if T::ORDER == 0 {
        let ([l, m, n], [x, y, z]) = stretches.stretches_in_frame();
        let [u, v, w] = [law.slope(x), law.slope(y), law.slope(z)];
        let values = [Stress::<L, N>::divided(u, l), Stress::<L, N>::divided(v, m), Stress::<L, N>::divided(w, n)];
        let stress = if SPATIAL {
            stretches.spatial_function_of(&function, values)
        } else {
            stretches.material_function_of(&function, values)
        };
        return (stress, u + v + w);
    }
    let stress = if SPATIAL { stretches.spatial_function(&function) } else { stretches.material_function(&function) };
    let sum = if L::ISOCHORIC { stretches.material_function(&Stress::<L, 0>(law)).trace() } else { T::zero() };
    (stress, sum)
}

/// The spherical part of β: J U′, less the mean of the w′ if the law is isochoric.
#[cfg_attr(not(debug_assertions), inline(always))]
fn uniform<T: Real, L: StretchEnergy>(law: &L, sum: T, volume: &Volume<T>) -> T {
    let slope = law.volume_slope(volume);
    if L::ISOCHORIC { slope - sum * T::lit(1.0 / 3.0) } else { slope }
}

/// τ.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn kirchhoff<T: Real, L: StretchEnergy>(law: &L, deformation: &impl Deformation<T>) -> KirchhoffStress<T> {
    let known = KnownVolume::of(deformation);
    let volume = Volume::of(&known);
    let (stress, _) = stress_function::<T, L, 0, true>(law, &analysis::<T, L>(&known));
    let stress = if L::ISOCHORIC { stress.deviator() } else { stress };
    KirchhoffStress(stress + Symmetric::identity() * law.volume_slope(&volume))
}

/// P = R f(U) + p F⁻ᵀ.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn first_piola<T: Real, L: StretchEnergy>(law: &L, deformation: &impl Deformation<T>) -> FirstPiola<T> {
    let known = KnownVolume::of(deformation);
    FirstPiola(from_rows(first_piola_rows(law, &analysis::<T, L>(&known), &Volume::of(&known), &known)))
}

/// (W, P), the stretches analysed once.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn energy_and_first_piola<T: Real, L: StretchEnergy>(
    law: &L,
    deformation: &impl Deformation<T>,
) -> (T, FirstPiola<T>) {
    let known = KnownVolume::of(deformation);
    let (analysis, volume) = (analysis::<T, L>(&known), Volume::of(&known));
    let stress = first_piola_rows(law, &analysis, &volume, &known);
    (energy_of(law, &analysis, &volume), FirstPiola(from_rows(stress)))
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn first_piola_rows<T: Real, L: StretchEnergy>(
    law: &L,
    stretches: &StretchAnalysis<T>,
    volume: &Volume<T>,
    deformation: &impl Deformation<T>,
) -> Rows<T> {
    let (stress, sum_of_slopes) = stress_function::<T, L, 1, false>(law, stretches);
    let stress = stress * isochoric_scale::<T, L>(volume);
    let uniform = uniform(law, sum_of_slopes, volume);
    let inverse_transpose = scaled(deformation.cofactor_rows(), volume.jacobian.recip());
    sum(product(stretches.rotation(), stress.rows()), scaled(inverse_transpose, uniform))
}

/// S = f(U) + p C⁻¹.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn second_piola<T: Real, L: StretchEnergy>(law: &L, deformation: &impl Deformation<T>) -> SecondPiola<T> {
    let known = KnownVolume::of(deformation);
    let volume = Volume::of(&known);
    let stretches = analysis::<T, L>(&known);
    let scale = isochoric_scale::<T, L>(&volume);
    let (stress, sum_of_slopes) = stress_function::<T, L, 2, false>(law, &stretches);
    let stress = stress * (scale * scale);
    let inverse = deformation.inverse_rows();
    let inverse_square = Symmetric::gram(inverse);
    SecondPiola(stress + inverse_square * uniform(law, sum_of_slopes, &volume))
}

/// ∂S/∂E, closed in the frame of the material axes.
///
/// # Accuracy
/// A few ulp of its norm × (λ₁/λ₃)², also for equal stretches.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn material_tangent<T: Real, L: StretchEnergy>(law: &L, deformation: &impl Deformation<T>) -> MaterialTangent<T> {
    if T::ORDER != 0 {
        return derived_material_tangent(law, deformation);
    }
    let known = KnownVolume::of(deformation);
    let analysis = analysis::<T, L>(&known);
    Principal::of(law, &analysis, &Volume::of(&known)).material_tangent(&analysis)
}

/// (S, ∂S/∂E), the stretches analysed once.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn second_piola_and_tangent<T: Real, L: StretchEnergy>(
    law: &L,
    deformation: &impl Deformation<T>,
) -> (SecondPiola<T>, MaterialTangent<T>) {
    if T::ORDER != 0 {
        return (second_piola(law, deformation), derived_material_tangent(law, deformation));
    }
    let known = KnownVolume::of(deformation);
    let analysis = analysis::<T, L>(&known);
    let principal = Principal::of(law, &analysis, &Volume::of(&known));
    (principal.second_piola(&analysis), principal.material_tangent(&analysis))
}

/// (T, c/J), the stretches analysed once.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn cauchy_and_tangent<T: Real, L: StretchEnergy>(
    law: &L,
    deformation: &impl Deformation<T>,
) -> (CauchyStress<T>, TruesdellTangent<T>) {
    if T::ORDER != 0 {
        return (kirchhoff(law, deformation).cauchy(deformation), truesdell_tangent(law, deformation));
    }
    let known = KnownVolume::of(deformation);
    let volume = Volume::of(&known);
    let analysis = analysis::<T, L>(&known);
    let principal = Principal::of(law, &analysis, &volume);
    let values = principal.stress.map(|stress| stress / volume.jacobian);
    let stress = CauchyStress(Principal::about(values, &analysis.spatial_axes()));
    (stress, principal.truesdell_tangent(&analysis, &volume))
}

/// c/J, closed in the frame of the spatial axes.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn truesdell_tangent<T: Real, L: StretchEnergy>(law: &L, deformation: &impl Deformation<T>) -> TruesdellTangent<T> {
    if T::ORDER != 0 {
        return derived_material_tangent(law, deformation).truesdell(deformation);
    }
    let known = KnownVolume::of(deformation);
    let volume = Volume::of(&known);
    let analysis = analysis::<T, L>(&known);
    Principal::of(law, &analysis, &volume).truesdell_tangent(&analysis, &volume)
}

/// ∂P/∂F, closed in the two principal frames.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn first_piola_tangent<T: Real, L: StretchEnergy>(
    law: &L,
    deformation: &impl Deformation<T>,
) -> FirstPiolaTangent<T> {
    if T::ORDER != 0 {
        return derived_tangent(law, deformation);
    }
    let known = KnownVolume::of(deformation);
    let analysis = analysis::<T, L>(&known);
    tangent(&Principal::of(law, &analysis, &Volume::of(&known)), frames(&analysis).each_ref())
}

/// (P, ∂P/∂F), the stretches analysed once.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn first_piola_and_tangent<T: Real, L: StretchEnergy>(
    law: &L,
    deformation: &impl Deformation<T>,
) -> (FirstPiola<T>, FirstPiolaTangent<T>) {
    if T::ORDER != 0 {
        return (first_piola(law, deformation), derived_tangent(law, deformation));
    }
    let known = KnownVolume::of(deformation);
    let analysis = analysis::<T, L>(&known);
    let principal = Principal::of(law, &analysis, &Volume::of(&known));
    let frames = frames(&analysis);
    (principal.first_piola(frames.each_ref()), tangent(&principal, frames.each_ref()))
}

/// (W, P, ∂P/∂F), the stretches analysed once.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn energy_first_piola_and_tangent<T: Real, L: StretchEnergy>(
    law: &L,
    deformation: &impl Deformation<T>,
) -> (T, FirstPiola<T>, FirstPiolaTangent<T>) {
    if T::ORDER != 0 {
        let (energy, stress) = energy_and_first_piola(law, deformation);
        return (energy, stress, derived_tangent(law, deformation));
    }
    let known = KnownVolume::of(deformation);
    let (analysis, volume) = (analysis::<T, L>(&known), Volume::of(&known));
    let principal = Principal::of(law, &analysis, &volume);
    let (energy, frames) = (energy_of(law, &analysis, &volume), frames(&analysis));
    (energy, principal.first_piola(frames.each_ref()), tangent(&principal, frames.each_ref()))
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

/// Writes [`Hyperelastic`](super::Hyperelastic) for a law of principal stretches, the parameters of a generic one in brackets
/// first.
macro_rules! hyperelastic_of_stretches {
    ([$($generics:tt)*] $law:ty) => {
        $crate::stretch::hyperelastic_of_stretches! { [$($generics)*] $law,
            energy -> T,
            first_piola -> piola_continuum::FirstPiola<T>,
            energy_and_first_piola -> (T, piola_continuum::FirstPiola<T>),
            energy_first_piola_and_tangent ->
                (T, piola_continuum::FirstPiola<T>, piola_continuum::stress::tangents::FirstPiolaTangent<T>),
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
        impl<$($generics)*> $crate::Hyperelastic for $law {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn check<T: piola_numerics::Real>(
                &self,
                deformation: &impl piola_continuum::Deformation<T>,
            ) -> Result<(), $crate::SolidsError> {
                $crate::stretch::StretchEnergy::check(self, deformation)
            }
            fn is_incompressible(&self) -> bool {
                $crate::stretch::StretchEnergy::is_incompressible(self)
            }
            $(
                #[cfg_attr(not(debug_assertions), inline(always))]
                fn $method<T: piola_numerics::Real>(
                    &self,
                    deformation: &impl piola_continuum::Deformation<T>,
                ) -> $result {
                    $crate::stretch::$method(self, deformation)
                }
            )*
        }
    };
}
pub(super) use hyperelastic_of_stretches;
