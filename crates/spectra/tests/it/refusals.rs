//! What is refused, by name.

use piola_spectra::{RelaxationSpectrum, SpectraError, SpectrumData, SpectrumOptions, fit_spectrum};

use super::spectrum;

fn refused(times: &[f64], moduli: &[f64], options: SpectrumOptions) -> String {
    fit_spectrum(SpectrumData::Relaxation { times, moduli }, options).expect_err("refused").to_string()
}

#[test]
fn data_that_no_spectrum_has_are_refused_by_name() {
    let options = SpectrumOptions::default();
    assert_eq!(refused(&[1.0, 2.0], &[1.0, f64::NAN], options), "`relaxation modulus`, entry 1: NaN is not finite");
    assert_eq!(refused(&[0.0, 2.0], &[1.0, 1.0], options), "`time`, entry 0: 0e0 violates 0 < t");
    assert_eq!(refused(&[1.0, 2.0], &[1.0], options), "`relaxation modulus` has length 1; length 2 is needed");
    assert_eq!(
        refused(&[1.0, 2.0], &[1.0, 0.5], options),
        "a spectrum with number of modes = 1 needs at least 5 measured numbers; found 2"
    );
    let none = SpectrumOptions { modes: Some(0), ..options };
    assert_eq!(refused(&[1.0], &[1.0], none), "`number of modes`, entry 0: 0e0 violates 0 < number of modes");
}

#[test]
fn spectra_without_modes_and_solids_as_fluids_are_refused() {
    assert!(matches!(RelaxationSpectrum::new(vec![], 1.0), Err(SpectraError::OutOfBounds { .. })));
    let solid = spectrum(&[(1.0, 1.0)], 2.0);
    assert_eq!(
        solid.maxwell_modes().expect_err("a solid").to_string(),
        "`equilibrium modulus`, entry 0: 2e0 violates Gₑ = 0 for a fluid"
    );
}

#[test]
fn creep_that_is_not_positive_is_refused_by_name() {
    let refused = |times: &[f64], compliances: &[f64]| {
        let data = SpectrumData::Creep { times, compliances };
        fit_spectrum(data, SpectrumOptions::default()).expect_err("refused").to_string()
    };
    assert_eq!(refused(&[1.0, 2.0], &[1.0, -1.0]), "`creep compliance`, entry 1: -1e0 violates 0 < J");
    assert_eq!(refused(&[1.0, f64::INFINITY], &[1.0, 1.0]), "`time`, entry 1: inf is not finite");
    assert_eq!(
        refused(&[1.0, 2.0], &[1.0, 2.0]),
        "a spectrum with number of modes = 0 needs at least 4 measured numbers; found 2"
    );
}
