//! Any fluid: what is written is read back, what is wrong is refused.

use piola_fluids::{AnyFluid, Giesekus, ViscometricFluid};
use piola_testkit::{Tol, assert_close};

use super::elastic::elastic;
use super::shear::fluids;

#[test]
fn what_is_written_is_read_back() {
    for fluid in fluids().into_iter().chain(elastic()) {
        let written = serde_json::to_string(&fluid).expect("written");
        assert!(written.starts_with(r#"{"fluid":""#), "{written}");
        let read: AnyFluid = serde_json::from_str(&written).expect(&written);
        assert_eq!(read, fluid, "{written}");
        let k = 0.7;
        let of = |fluid: &AnyFluid| [fluid.shear_stress(k), fluid.sigma1(k), fluid.sigma2(k), fluid.viscosity(k)];
        assert_close(fluid.name(), &of(&read), &of(&fluid), Tol::ulps(0.0));
        assert!(written.len() < toml::to_string(&fluid).expect("written").len() + 200);
    }
}

#[test]
fn dispatched_functions_equal_those_of_the_fluid() {
    let fluid = Giesekus::new(0.125, 2.0, 0.5, 0.3).expect("bounds");
    let any = AnyFluid::from(fluid);
    for k in [1e-6, 1.0, 1e6] {
        let normal = [any.first_normal_stress_difference(k), any.second_normal_stress_difference(k)];
        let expected = [fluid.first_normal_stress_difference(k), fluid.second_normal_stress_difference(k)];
        assert_close("N₁, N₂", &normal, &expected, Tol::ulps(0.0));
    }
    for fluid in elastic() {
        for k in [0.3, 20.0] {
            let name = fluid.name();
            assert_close(name, &[fluid.shear_stress(-k)], &[-fluid.shear_stress(k)], Tol::ulps(0.0));
            assert_close(
                name,
                &[fluid.sigma1(-k), fluid.sigma2(-k)],
                &[fluid.sigma1(k), fluid.sigma2(k)],
                Tol::ulps(0.0),
            );
            let difference = fluid.sigma2(k) - fluid.sigma1(k);
            assert_close(name, &[fluid.first_normal_stress_difference(k)], &[difference], Tol::ulps(16.0));
        }
    }
}

#[test]
fn what_is_wrong_is_refused_by_name() {
    let refused = |written: &str, expected: &str| {
        let message = serde_json::from_str::<AnyFluid>(written).expect_err(expected).to_string();
        assert!(message.contains(expected), "{message} does not say {expected}");
    };
    refused(r#"{"fluid":"ketchup"}"#, "unknown variant `ketchup`");
    refused(r#"{"fluid":"casson","yield_stress":1.0}"#, "missing field `plastic_viscosity`");
    refused(r#"{"fluid":"newtonian","viscosity_coefficient":-1.0}"#, "viscosity_coefficient = -1e0 violates 0 < μ");
    refused(r#"{"fluid":"newtonian","viscosity_coefficient":1.0,"colour":2.0}"#, "unknown field `colour`");
    refused(r#"{"fluid":"giesekus_modes","modes":[]}"#, "number of modes = 0e0 violates 0 < number of modes");
    let mode = r#"{"solvent_viscosity":0.0,"polymer_viscosity":1.0,"time":1.0,"mobility":0.9}"#;
    refused(&format!(r#"{{"fluid":"giesekus_modes","modes":[{mode}]}}"#), "mobility = 9e-1 violates 0 ≤ α ≤ ½");
    let network = r#"{"solvent_viscosity":0.0,"polymer_viscosity":1.0,"time":1.0}"#;
    refused(&format!(r#"{{"fluid":"johnson_segalman","network":{network},"slip":1.5}}"#), "0 ≤ ξ ≤ 1");
    let damping = r#"{"alpha":1.0,"beta":2.0}"#;
    let memory = r#"[{"viscosity":1.0,"time":1.0}]"#;
    refused(&format!(r#"{{"fluid":"kbkz_rational","memory":{memory},"damping":{damping}}}"#), "0 ≤ β ≤ 1");
}
