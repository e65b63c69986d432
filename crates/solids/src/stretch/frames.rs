//! A law in its principal frame as numbers, and P and ∂P/∂F of these numbers.

use piola_continuum::Deformation;
use piola_continuum::polar::StretchAnalysis;
use piola_numerics::Real;
use piola_tensor::internal::rows::Rows;

use super::analysis;
use super::energy::{StretchEnergy, Volume};
use super::principal::{Principal, tangent};
use crate::known_volume::KnownVolume;
use crate::packed::{self, joined};

/// The spatial and the material axes.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn frames<T: Real>(analysis: &StretchAnalysis<T>) -> [Rows<T>; 2] {
    [analysis.spatial_axes(), analysis.material_axes()]
}

/// The law in the principal frame, fifteen numbers, then the spatial and the material axes, nine each. [`composed`] takes them.
///
/// T must not carry derivatives: axes have none where stretches coalesce.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn in_frames<T: Real, L: StretchEnergy>(law: &L, deformation: &impl Deformation<T>) -> [T; 33] {
    let known = KnownVolume::of(deformation);
    let analysis = analysis::<T, L>(&known);
    let numbers = Principal::of(law, &analysis, &Volume::of(&known)).numbers();
    let [n, m] = frames(&analysis);
    let with_spatial: [T; 24] = joined(&numbers, &packed::of_stress(n));
    joined(&with_spatial, &packed::of_stress(m))
}

/// P and the upper triangle of ∂P/∂F of the numbers of [`in_frames`].
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn composed<T: Real>(numbers: &[T; 33]) -> [T; 54] {
    let (mut own, mut frames) = ([numbers[0]; 15], [[[numbers[0]; 3]; 3]; 2]);
    let mut k = 0;
    while k < 15 {
        own[k] = numbers[k];
        k += 1;
    }
    while k < 33 {
        frames[(k - 15) / 9][(k - 15) % 9 / 3][k % 3] = numbers[k];
        k += 1;
    }
    let (principal, frames) = (Principal::of_numbers(own), frames.each_ref());
    packed::of_pair((principal.first_piola(frames), tangent(&principal, frames)))
}
