//! Responses against each other and against closed forms.

use piola_fluids::ViscometricFluid;
use piola_numerics::Dual;
use piola_spectra::RetardationSpectrum;
use piola_testkit::{Tol, assert_close, assert_each_close};
use proptest::prelude::*;

use super::spectrum;

fn modes() -> impl Strategy<Value = Vec<(f64, f64)>> {
    // Times at least a factor of e^0.5 apart.
    prop::collection::vec((-3.0..3.0_f64, 0.5..2.0_f64), 1..7).prop_map(|steps| {
        let mut ln_time = -4.0;
        let mut mode = |(ln_modulus, step): (f64, f64)| {
            ln_time += step;
            (ln_modulus.exp(), ln_time.exp())
        };
        steps.into_iter().map(&mut mode).collect()
    })
}

#[test]
fn responses_of_one_mode_equal_maxwells() {
    let mode = spectrum(&[(3.0, 2.0)], 0.0);
    // At ω τ = 1 both moduli are g/2.
    assert_each_close("moduli", &[mode.storage_modulus(0.5), mode.loss_modulus(0.5)], &[1.5, 1.5], Tol::ulps(4.0));
    let decayed = 3.0 * (-1.0_f64).exp();
    assert_each_close("G(τ)", &[mode.relaxation_modulus(2.0)], &[decayed], Tol::ulps(4.0));
    assert_each_close("η⁺(τ)", &[mode.startup_viscosity(2.0)], &[6.0 - 2.0 * decayed], Tol::ulps(8.0));
    // J = 1/g + t/η.
    let creep = RetardationSpectrum::of(&mode);
    assert!(creep.modes().is_empty());
    assert_each_close("J", &[creep.compliance(5.0)], &[1.0 / 3.0 + 5.0 / 6.0], Tol::ulps(4.0));
}

#[test]
fn moduli_at_extreme_frequencies_equal_their_limits() {
    let solid = spectrum(&[(2.0, 1.0), (1.0, 3.0)], 4.0);
    assert_each_close("G′(∞)", &[solid.storage_modulus(1e200)], &[7.0], Tol::ulps(1.0));
    assert_each_close("G′(0)", &[solid.storage_modulus(1e-200)], &[4.0], Tol::ulps(1.0));
    assert_each_close("G″", &[solid.loss_modulus(1e-200)], &[5e-200], Tol::ulps(4.0));
    assert_eq!(solid.zero_shear_viscosity(), None);
}

#[test]
fn jeffreys_creep_equals_its_closed_form() {
    // g₁ = g₂ = 1, τ = 1 and 3: 1/(1 − λ) + 1/(1 − λ/3) = 0 at λ = 3/2; 1/J = (2/3)/(1/9) + 2/(1) = 8.
    let creep = RetardationSpectrum::of(&spectrum(&[(1.0, 1.0), (1.0, 3.0)], 0.0));
    let found = creep.modes()[0];
    assert_each_close("λ", &[found.retardation_time], &[1.5], Tol::ulps(4.0));
    assert_each_close("J", &[found.compliance], &[0.125], Tol::ulps(16.0));
    // J(t) = 1/2 + t/4 + (1 − e^(−2t/3))/8.
    let expected = 0.5 + 0.75 + 0.125 * (1.0 - (-2.0_f64).exp());
    assert_each_close("J(3)", &[creep.compliance(3.0)], &[expected], Tol::ulps(16.0));
}

proptest! {
    #[test]
    fn rate_of_startup_viscosity_equals_relaxation_modulus(modes in modes(), equilibrium in 0.0..2.0_f64, t in 0.01..50.0_f64) {
        let spectrum = spectrum(&modes, equilibrium);
        let rate = spectrum.startup_viscosity(Dual::variable(t)).tangent;
        assert_close("dη⁺/dt", &[rate], &[spectrum.relaxation_modulus(t)], Tol::ulps(32.0));
    }

    #[test]
    fn glassy_and_retarded_compliance_equals_steady_state_compliance(modes in modes()) {
        let liquid = spectrum(&modes, 0.0);
        let creep = RetardationSpectrum::of(&liquid);
        let sum = creep.compliance(0.0) + creep.modes().iter().map(|mode| mode.compliance).sum::<f64>();
        let expected = liquid.steady_state_compliance().expect("a liquid");
        let tol = Tol::ulps_because(1e5, "retardation times as near as 1e-3 to relaxation times, moduli of ratio e⁶");
        assert_close("J_e", &[sum], &[expected], tol);
    }

    #[test]
    fn glassy_and_retarded_compliance_of_a_solid_equals_inverse_equilibrium_modulus(modes in modes(), equilibrium in 0.1..2.0_f64) {
        let creep = RetardationSpectrum::of(&spectrum(&modes, equilibrium));
        prop_assert_eq!(creep.modes().len(), modes.len());
        let sum = creep.compliance(0.0) + creep.modes().iter().map(|mode| mode.compliance).sum::<f64>();
        let tol = Tol::ulps_because(1e5, "retardation times as near as 1e-3 to relaxation times, moduli of ratio e⁶");
        assert_close("J_∞", &[sum], &[equilibrium.recip()], tol);
    }

    #[test]
    fn viscosity_of_maxwell_modes_equals_zero_shear_viscosity(modes in modes(), rate in 0.01..100.0_f64) {
        let liquid = spectrum(&modes, 0.0);
        let law = liquid.maxwell_modes().expect("a liquid");
        let viscosity = liquid.zero_shear_viscosity().expect("a liquid");
        assert_close("η", &[law.viscosity(rate)], &[viscosity], Tol::ulps(16.0));
        // N₁/(2 T₁₂²) is the steady-state compliance.
        let stress = law.shear_stress(rate);
        let compliance = law.first_normal_stress_difference(rate) / (2.0 * stress * stress);
        assert_close("Jₑ⁰", &[compliance], &[liquid.steady_state_compliance().expect("a liquid")], Tol::ulps(64.0));
    }
}
