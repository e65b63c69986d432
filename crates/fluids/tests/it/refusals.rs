//! Parameters and stresses that are refused by name.

use piola_fluids::{
    AnyFluid, Bingham, CarreauYasuda, Casson, Cross, Ellis, Eyring, FluidsError, HerschelBulkley, Newtonian,
    Papanastasiou, PowerLaw, Sisko, ViscometricFluid,
};
use piola_numerics::Real;
use piola_testkit::{Tol, assert_close};

#[test]
fn bad_parameters_are_refused_by_name() {
    let refused = |made: Result<AnyFluid, FluidsError>, expected: &str| {
        let message = made.expect_err(expected).to_string();
        assert!(message.contains(expected), "{message} does not say {expected}");
    };
    refused(Newtonian::new(-1.0).map(Into::into), "Newtonian: viscosity_coefficient = -1e0 violates 0 < μ");
    refused(Newtonian::new(f64::NAN).map(Into::into), "viscosity_coefficient = NaN is not finite");
    refused(PowerLaw::new(1.0, 0.0).map(Into::into), "power law: exponent = 0e0 violates 0 < n");
    refused(Bingham::new(-1.0, 1.0).map(Into::into), "Bingham: yield_stress = -1e0 violates 0 ≤ τᵧ");
    refused(HerschelBulkley::new(1.0, 0.0, 0.5).map(Into::into), "Herschel-Bulkley: consistency = 0e0 violates 0 < K");
    refused(Casson::new(1.0, f64::INFINITY).map(Into::into), "Casson: plastic_viscosity = inf is not finite");
    refused(CarreauYasuda::new(1.0, 2.0, 1.0, 1.5, 2.0).map(Into::into), "η∞ ≤ η₀ where 1 < n: τ grows");
    refused(CarreauYasuda::new(1.0, 0.0, 1.0, 0.5, 0.0).map(Into::into), "transition = 0e0 violates 0 < a");
    refused(Cross::new(9.0, 0.0, 1.0, 1.5).map(Into::into), "(m − 1)² (η₀ − η∞) ≤ 4 m η∞");
    refused(Ellis::new(1.0, 1.0, 0.5).map(Into::into), "Ellis: exponent = 5e-1 violates 1 ≤ α");
    refused(Eyring::new(1.0, 0.0).map(Into::into), "Eyring: time = 0e0 violates 0 < λ");
    refused(Sisko::new(0.0, 1.0, 0.5).map(Into::into), "Sisko: infinite_rate_viscosity = 0e0 violates 0 < η∞");
    refused(Papanastasiou::new(1.0, 1.0, 1.0, 0.0).map(Into::into), "growth_time = 0e0 violates 0 < m");
}

#[test]
fn stresses_without_a_rate_are_refused_by_name() {
    let thinning = PowerLaw::new(1.0, 0.05).expect("within bounds");
    let message = thinning.shear_rate(1e20).expect_err("10^400 / s").to_string();
    assert!(message.contains("power law: no shear rate was found at the shear stress 1e20 Pa"), "{message}");
    for fluid in super::shear::fluids() {
        assert!(fluid.shear_rate(f64::NAN).is_err(), "{fluid:?} at NaN");
        assert!(fluid.shear_rate(f64::INFINITY).is_err(), "{fluid:?} at ∞");
    }
}

/// τ = k/(1 + k²), which falls beyond k = 1.
struct Falling;

impl ViscometricFluid for Falling {
    const NAME: &'static str = "falling";
    fn shear_stress<T: Real>(&self, shear_rate: T) -> T {
        shear_rate / (T::one() + shear_rate * shear_rate)
    }
}

#[test]
fn rates_are_found_where_the_stress_grows_or_refused_by_name() {
    for k in [1e-6, 0.1, 0.5, 0.9] {
        let found: f64 = Falling.shear_rate(Falling.shear_stress(k)).expect("a growing branch");
        // 1/τ′ magnifies the rounding of τ: 10 at k = 0.9.
        assert_close("ζ", &[found], &[k], Tol::ulps(64.0));
    }
    for beyond in [0.500_001, 0.6, -3.0] {
        let refused = Falling.shear_rate(beyond);
        assert!(matches!(refused, Err(FluidsError::NoShearRate { fluid: "falling", .. })), "{refused:?}");
    }
}
