//! Exact conversion between relaxation and retardation: `testdata/golden/retardation.json`.

use piola_spectra::{RelaxationMode, RelaxationSpectrum, RetardationMode, RetardationSpectrum, SpectraError};
use piola_testkit::golden::{Golden, load, number, text, vector};
use piola_testkit::{Tol, assert_each_close};
use proptest::prelude::*;
use serde_json::Value;

/// Σ|terms|/(x F′) at a zero x: what rounding of a term does to 1/(x F′) or to the distance from a pole, at least 1.
///
/// `pole` and `weight` of each fraction; `constant` and `drift` beside them.
fn condition(x: f64, fractions: &[[f64; 2]], constant: f64, drift: f64) -> f64 {
    let sizes = constant + drift / x + fractions.iter().map(|[w, p]| w * p / (p - x).abs()).sum::<f64>();
    let nearest = fractions.iter().map(|[_, p]| (p - x).abs() / x).fold(1.0, f64::min);
    let slope = drift / x + fractions.iter().map(|[w, p]| w * p * x / ((p - x) * (p - x))).sum::<f64>();
    (sizes / (slope * nearest)).max(1.0)
}

fn pairs(case: &Value, weights: &str, times: &str) -> Vec<[f64; 2]> {
    vector(&case[weights]).into_iter().zip(vector(&case[times])).map(|(weight, time)| [weight, time]).collect()
}

fn compare(name: &str, found: &[[f64; 2]], expected: &[[f64; 2]], condition: &dyn Fn(f64) -> f64) {
    assert_eq!(found.len(), expected.len(), "{name}");
    for ([weight, time], [expected_weight, expected_time]) in found.iter().zip(expected) {
        assert_each_close(name, &[*time], &[*expected_time], Tol::ulps(2.0));
        let reason = "4 ulp times what rounding of the fractions does to their zero";
        let tol = Tol::ulps_because(4.0 * condition(*expected_time), reason);
        assert_each_close(name, &[*weight], &[*expected_weight], tol);
    }
}

fn relaxation(case: &Value) -> Result<RelaxationSpectrum, SpectraError> {
    let mode = |[modulus, relaxation_time]: [f64; 2]| RelaxationMode { modulus, relaxation_time };
    let modes = pairs(case, "moduli", "relaxation_times").into_iter().map(mode).collect();
    RelaxationSpectrum::new(modes, number(&case["equilibrium_modulus"]))
}

fn retardation(case: &Value) -> Result<RetardationSpectrum, SpectraError> {
    let mode = |[compliance, retardation_time]: [f64; 2]| RetardationMode { compliance, retardation_time };
    let modes = pairs(case, "compliances", "retardation_times").into_iter().map(mode).collect();
    RetardationSpectrum::new(modes, number(&case["glassy_compliance"]), number(&case["fluidity"]))
}

#[test]
fn conversions_equal_thirty_digits() -> Result<(), SpectraError> {
    let Golden { cases, .. } = load("retardation");
    assert_eq!(cases.len(), 25 + 16);
    for case in cases {
        let name = text(&case["name"]);
        if case["reverse"].as_bool() == Some(true) {
            let creep = retardation(&case)?;
            let found = RelaxationSpectrum::of(&creep)?;
            let fractions: Vec<[f64; 2]> =
                creep.modes().iter().map(|mode| [mode.compliance, mode.retardation_time.recip()]).collect();
            let modes: Vec<[f64; 2]> = found.modes().iter().map(|mode| [mode.modulus, mode.relaxation_time]).collect();
            let condition =
                |time: f64| condition(time.recip(), &fractions, creep.glassy_compliance(), creep.fluidity());
            compare(name, &modes, &pairs(&case, "moduli", "relaxation_times"), &condition);
            let resting = [number(&case["equilibrium_modulus"])];
            assert_each_close(name, &[found.equilibrium_modulus()], &resting, Tol::ulps(8.0));
            continue;
        }
        let spectrum = relaxation(&case)?;
        let creep = RetardationSpectrum::of(&spectrum);
        let fractions: Vec<[f64; 2]> =
            spectrum.modes().iter().map(|mode| [mode.modulus, mode.relaxation_time]).collect();
        let modes: Vec<[f64; 2]> = creep.modes().iter().map(|mode| [mode.compliance, mode.retardation_time]).collect();
        let condition = |time: f64| condition(time, &fractions, spectrum.equilibrium_modulus(), 0.0);
        compare(name, &modes, &pairs(&case, "compliances", "retardation_times"), &condition);
        let terms = [creep.glassy_compliance(), creep.fluidity()];
        let expected = [number(&case["glassy_compliance"]), number(&case["fluidity"])];
        assert_each_close(name, &terms, &expected, Tol::ulps(8.0));
        // Creep is a sum of positive terms: better conditioned than they are.
        let found: Vec<f64> = vector(&case["times"]).into_iter().map(|t| creep.compliance(t)).collect();
        assert_each_close(name, &found, &vector(&case["creep"]), Tol::ulps(32.0));
    }
    Ok(())
}

#[test]
fn elastic_solid_without_modes_is_refused_and_fluid_of_maxwell_converts() -> Result<(), SpectraError> {
    let elastic = RetardationSpectrum::new(vec![], 0.5, 0.0)?;
    let refused = RelaxationSpectrum::of(&elastic).expect_err("no relaxation").to_string();
    assert_eq!(refused, "`number of modes`, entry 0: 0e0 violates 0 < number of modes");
    let fluid = RelaxationSpectrum::of(&RetardationSpectrum::new(vec![], 0.5, 0.125)?)?;
    assert_each_close(
        "g, τ",
        &[fluid.modes()[0].modulus, fluid.modes()[0].relaxation_time],
        &[2.0, 4.0],
        Tol::ulps(1.0),
    );
    let refused = RetardationSpectrum::new(vec![], 0.0, 0.125).expect_err("no glassy compliance").to_string();
    assert_eq!(refused, "`glassy compliance`, entry 0: 0e0 violates 0 < J_g");
    Ok(())
}

proptest! {
    #[test]
    fn there_and_back_equals_the_spectrum(
        steps in prop::collection::vec((-3.0..3.0_f64, 0.5..2.0_f64), 1..7), equilibrium in prop::bool::ANY
    ) {
        let mut ln_time = -4.0;
        let mode = |(ln_modulus, step): (f64, f64)| {
            ln_time += step;
            RelaxationMode { modulus: ln_modulus.exp(), relaxation_time: ln_time.exp() }
        };
        let modes: Vec<RelaxationMode> = steps.into_iter().map(mode).collect();
        let spectrum = RelaxationSpectrum::new(modes, if equilibrium { 0.5 } else { 0.0 }).expect("positive");
        let back = RelaxationSpectrum::of(&RetardationSpectrum::of(&spectrum)).expect("modes");
        let flat = |of: &RelaxationSpectrum| -> Vec<f64> {
            of.modes().iter().flat_map(|mode| [mode.modulus, mode.relaxation_time]).collect()
        };
        let tol = Tol::ulps_because(1e6, "retardation times as near as 1e-3 to relaxation times, both ways");
        assert_each_close("g, τ", &flat(&back), &flat(&spectrum), tol);
        assert_each_close("Gₑ", &[back.equilibrium_modulus()], &[spectrum.equilibrium_modulus()], Tol::ulps(16.0));
    }
}
