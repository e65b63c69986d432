//! Deformations and stresses for batches of any length.

use piola_continuum::{CauchyStress, DeformationGradient, Symmetric};
use piola_testkit::spectral::{Random, adversarial_set};

/// Hard and easy deformations in turn, so that blocks of lanes hold both.
pub(super) fn deformations(count: usize) -> Vec<DeformationGradient> {
    let set = adversarial_set();
    // A step without a common factor with the length of the set mixes its kinds.
    (0..count)
        .map(|i| DeformationGradient::from_rows(set[(i * 7 + 1) % set.len()].gradient).expect("a deformation"))
        .collect()
}

pub(super) fn stresses(count: usize) -> Vec<CauchyStress> {
    let mut random = Random::new(7);
    (0..count).map(|_| CauchyStress(Symmetric { components: [(); 6].map(|()| random.symmetric()) })).collect()
}
