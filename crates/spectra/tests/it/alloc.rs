//! No response of a spectrum allocates.

use piola_spectra::RetardationSpectrum;
use piola_testkit::allocations_in;

use super::spectrum;

#[test]
fn allocations_in_responses_equal_zero() {
    let melt = spectrum(&[(1e5, 0.01), (1e4, 1.0)], 0.0);
    let creep = RetardationSpectrum::of(&melt);
    let (count, sum) = allocations_in(|| -> f64 {
        let moduli = melt.relaxation_modulus(0.3_f64) + melt.storage_modulus(0.3) + melt.loss_modulus(0.3);
        moduli + melt.startup_viscosity(0.3) + creep.compliance(0.3)
    });
    assert!(sum.is_finite());
    assert_eq!(count, 0);
}
