//! Generalised Newtonian fluids in shear: references, oddness, inverses, derivatives, lanes, limits.

use piola_fluids::{
    AnyFluid, Bingham, CarreauYasuda, Casson, Cross, Ellis, Eyring, FlowMoment, HerschelBulkley, Newtonian,
    Papanastasiou, Parameters, PowerLaw, Sisko, ViscometricFluid,
};
use piola_numerics::{Dual, Lanes, Real};
use piola_testkit::strategies::random_cases;
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use proptest::prelude::*;

use super::references::{fluid, moments, shear_stresses};

/// One fluid of each kind, two of some.
pub(super) fn fluids() -> Vec<AnyFluid> {
    let made = [
        Newtonian::new(0.75).map(AnyFluid::from),
        PowerLaw::new(1.5, 0.05).map(AnyFluid::from),
        PowerLaw::new(1.5, 2.0).map(AnyFluid::from),
        CarreauYasuda::new(3.0, 0.0, 0.5, 0.05, 2.0).map(AnyFluid::from),
        CarreauYasuda::new(3.0, 0.5, 0.5, 2.0, 4.0).map(AnyFluid::from),
        HerschelBulkley::new(2.0, 1.0, 0.05).map(AnyFluid::from),
        HerschelBulkley::new(2.0, 1.0, 2.0).map(AnyFluid::from),
        Cross::new(1.0, 1.0, 0.5, 2.0).map(AnyFluid::from),
        Ellis::new(1.0, 0.1, 20.0).map(AnyFluid::from),
        Ellis::new(1.0, 0.1, 1.0).map(AnyFluid::from),
        Sisko::new(0.1, 2.0, 2.0).map(AnyFluid::from),
        Papanastasiou::new(5.0, 1.0, 1.0, 1000.0).map(AnyFluid::from),
        Bingham::new(0.0, 2.0).map(AnyFluid::from),
        Casson::new(0.0, 2.0).map(AnyFluid::from),
        Eyring::new(2.0, 3.0).map(AnyFluid::from),
    ];
    let tabled = ["bingham", "herschel", "casson", "carreau", "cross", "ellis", "eyring", "sisko", "papanastasiou"];
    made.into_iter().map(|fluid| fluid.expect("within bounds")).chain(tabled.map(fluid)).collect()
}

/// d ln τ/d ln k.
fn slope(fluid: &AnyFluid, k: f64) -> f64 {
    let at = fluid.shear_stress(Dual::variable(k));
    k * at.tangent / at.value
}

fn rates() -> impl Strategy<Value = f64> {
    (-8.0..8.0_f64, any::<bool>()).prop_map(|(log, back)| if back { -10.0_f64.powf(log) } else { 10.0_f64.powf(log) })
}

#[test]
fn shear_stresses_equal_references() {
    for (name, k, expected) in shear_stresses() {
        assert_close(&format!("{name} at {k:e}"), &[fluid(&name).shear_stress(k)], &[expected], Tol::ulps(16.0));
    }
}

#[test]
fn rates_at_reference_stresses_equal_their_rates() {
    for (name, k, stress) in shear_stresses() {
        let fluid = fluid(&name);
        let tolerance = Tol::ulps(16.0).times((1.0 / slope(&fluid, k)).max(1.0));
        assert_close(&format!("{name} at {k:e}"), &[fluid.shear_rate(stress).expect("a rate")], &[k], tolerance);
    }
}

#[test]
fn closed_moments_equal_quadratures_of_the_rate() {
    let (mut closed, moments) = (0, moments());
    for (name, moment, from, to, expected) in &moments {
        let (moment, from, to, expected) = (*moment, *from, *to, *expected);
        if let Some(value) = fluid(name).flow_moment(moment, from, to) {
            assert_close(&format!("{name} {moment:?} {from}..{to}"), &[value], &[expected], Tol::ulps(40.0));
            closed += 1;
        }
    }
    assert_eq!(closed, 73, "of {}", moments.len());
}

#[test]
fn moments_of_the_power_law_equal_their_formula_over_a_narrow_interval() {
    let (fluid, wall) = (PowerLaw::new(2.0, 0.5).expect("within bounds"), 3.0_f64);
    let next = wall + 1e-9;
    let moment = fluid.flow_moment(FlowMoment::Zeroth, wall, next).expect("closed");
    // ζ = s²/4 grows by 2e-9/3 of itself.
    assert_close("moment", &[moment], &[(next - wall) * (wall * wall + 3e-9) / 4.0], Tol::ulps(16.0));
}

#[test]
fn fluids_at_rest_have_no_stress_and_stresses_up_to_yield_no_rate() {
    let mut below_yield = 0;
    for fluid in fluids() {
        assert_close("τ(0)", &[fluid.shear_stress(0.0)], &[0.0], Tol::ulps(0.0));
        for share in [0.0, 0.5, 1.0, -1.0, -0.25] {
            let stress = share * fluid.yield_stress();
            assert_close("ζ", &[fluid.shear_rate(stress).expect("rest")], &[0.0], Tol::ulps(0.0));
            let dual = fluid.shear_rate(Dual::variable(0.999 * stress)).expect("rest");
            assert!(!dual.tangent.is_nan(), "{fluid:?} below yield: {dual:?}");
            for moment in [FlowMoment::Reciprocal, FlowMoment::Zeroth, FlowMoment::First, FlowMoment::Second] {
                if let (true, Some(value)) = (0.0 < stress, fluid.flow_moment(moment, 0.1 * stress, stress)) {
                    assert_close("moment below yield", &[value], &[0.0], Tol::ulps(0.0));
                    below_yield += 1;
                }
            }
        }
    }
    // At ½ and at the whole yield stress the closed ones of four moments.
    assert!(16 <= below_yield, "{below_yield} moments");
}

#[test]
fn viscosities_at_rest_equal_the_limits_of_slow_flow() {
    for fluid in fluids() {
        let (rest, slow) = (fluid.viscosity(0.0), fluid.viscosity(1e-300));
        let limit = Tol::stated(1e-9, "10⁻³⁰⁰ to the power a = 0.05 or more is not zero");
        if rest.is_finite() && 0.0 < rest {
            assert_close(&format!("{fluid:?}"), &[slow], &[rest], limit);
        } else {
            assert!(rest <= slow || 1e12 < slow, "{fluid:?}: {rest:e} at rest, {slow:e} near it");
        }
    }
}

#[test]
fn newtonian_limits_equal_the_newtonian_fluid() {
    let newtonian = Newtonian::new(0.75).expect("within bounds");
    let limits = [
        PowerLaw::new(0.75, 1.0).map(AnyFluid::from),
        Bingham::new(0.0, 0.75).map(AnyFluid::from),
        HerschelBulkley::new(0.0, 0.75, 1.0).map(AnyFluid::from),
        Casson::new(0.0, 0.75).map(AnyFluid::from),
        CarreauYasuda::new(0.75, 0.25, 2.0, 1.0, 2.0).map(AnyFluid::from),
        CarreauYasuda::new(0.75, 0.25, 0.0, 0.5, 2.0).map(AnyFluid::from),
        Cross::new(0.75, 0.25, 0.0, 0.5).map(AnyFluid::from),
        Cross::new(0.75, 0.75, 1.0, 3.0).map(AnyFluid::from),
        Ellis::new(0.75, 1e300, 3.0).map(AnyFluid::from),
        Ellis::new(1.5, 1.0, 1.0).map(AnyFluid::from),
        Eyring::new(0.75e20, 1e-20).map(AnyFluid::from),
        Sisko::new(0.75, 0.0, 0.5).map(AnyFluid::from),
        Papanastasiou::new(0.0, 0.75, 1.0, 1.0).map(AnyFluid::from),
    ];
    for fluid in limits.map(|fluid| fluid.expect("within bounds")) {
        for k in [1e-8, 1e-3, 1.0, -7.0, 1e4, 1e8] {
            let what = |name| format!("{fluid:?}: {name} at {k:e}");
            let (stress, rate) = (fluid.shear_stress(k), fluid.shear_rate(0.75 * k).expect("a rate"));
            assert_close(&what("τ"), &[stress], &[newtonian.shear_stress(k)], Tol::ulps(8.0));
            assert_close(&what("ζ"), &[rate], &[k], Tol::ulps(8.0));
        }
    }
}

/// τ over parameters that are the variables equals τ; its derivative by each equals the difference quotient.
fn derivatives_by_parameters<F: ViscometricFluid + Parameters<N>, const N: usize>(fluid: &F, k: f64) {
    let at = fluid.parameters();
    assert_close("τ", &[F::shear_stress_of(at, k)], &[fluid.shear_stress(k)], Tol::ulps(2.0));
    for i in 0..N {
        let mut variable = at.map(Dual::constant);
        variable[i] = Dual::variable(at[i]);
        let exact = F::shear_stress_of(variable, Dual::constant(k)).tangent;
        let step = 1e-3 * at[i];
        let shifted = |steps: f64| {
            let mut moved = at;
            moved[i] += steps * step;
            F::shear_stress_of(moved, k)
        };
        let quotient = (8.0 * (shifted(1.0) - shifted(-1.0)) - (shifted(2.0) - shifted(-2.0))) / (12.0 * step);
        let scale = fluid.shear_stress(k) / at[i];
        // Fourth order in the step times ln k.
        let tolerance = Tol::order(1e-2, 4);
        let error = (exact - quotient).abs() / scale.abs().max(exact.abs());
        assert!(error < tolerance.value(), "{} by {} at {k:e}: {exact} or {quotient}", F::NAME, F::NAMES[i]);
        let rest = F::shear_stress_of(variable, Dual::constant(0.0)).tangent;
        assert!(rest.is_finite(), "{} by {} at rest: {rest}", F::NAME, F::NAMES[i]);
    }
}

#[test]
fn derivatives_by_parameters_equal_difference_quotients() {
    for k in [1e-3, 0.7, 40.0, 1e5] {
        derivatives_by_parameters(&Newtonian::new(0.75).expect("bounds"), k);
        derivatives_by_parameters(&PowerLaw::new(0.75, 0.4).expect("bounds"), k);
        derivatives_by_parameters(&Bingham::new(0.5, 0.75).expect("bounds"), k);
        derivatives_by_parameters(&HerschelBulkley::new(0.5, 0.75, 0.4).expect("bounds"), k);
        derivatives_by_parameters(&Casson::new(0.5, 0.75).expect("bounds"), k);
        derivatives_by_parameters(&CarreauYasuda::new(2.0, 0.1, 1.5, 0.3, 1.25).expect("bounds"), k);
        derivatives_by_parameters(&Cross::new(2.0, 0.1, 1.5, 0.75).expect("bounds"), k);
        derivatives_by_parameters(&Ellis::new(2.0, 1.5, 2.5).expect("bounds"), k);
        derivatives_by_parameters(&Eyring::new(2.0, 1.5).expect("bounds"), k);
        derivatives_by_parameters(&Sisko::new(0.5, 3.0, 0.375).expect("bounds"), k);
        derivatives_by_parameters(&Papanastasiou::new(0.5, 0.75, 0.5, 4.0).expect("bounds"), k);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(10_000)))]

    #[test]
    fn shear_stress_is_odd_and_viscosity_even(k in rates()) {
        for fluid in fluids() {
            prop_assert_eq!(fluid.shear_stress(-k).to_bits(), (-fluid.shear_stress(k)).to_bits());
            prop_assert_eq!(fluid.viscosity(-k).to_bits(), fluid.viscosity(k).to_bits());
            let quotient = fluid.shear_stress(k) / k;
            prop_assert!((fluid.viscosity(k) / quotient - 1.0).abs() <= Tol::ulps(4.0).value());
        }
    }

    #[test]
    fn rate_at_the_stress_of_a_rate_is_the_rate(k in rates()) {
        for fluid in fluids() {
            let (stress, slope) = (fluid.shear_stress(k), slope(&fluid, k));
            let rate = fluid.shear_rate(stress);
            prop_assert!(rate.is_ok(), "{:?} at {k:e}: {rate:?}", fluid);
            let rate = rate.unwrap_or(f64::NAN);
            // The stress knows the rate to an ulp over the slope; the power of it to |ln k|/n ulp.
            let tolerance = Tol::ulps(16.0).times((1.0 / slope).max(1.0) * (1.0 + k.abs().ln().abs() / 4.0));
            if tolerance.value() < 0.1 {
                prop_assert!((rate / k - 1.0).abs() <= tolerance.value(), "{:?} at {k:e}: {rate:e}", fluid);
            }
        }
    }

    #[test]
    fn derivative_of_the_rate_is_the_reciprocal_of_that_of_the_stress(k in rates()) {
        for fluid in fluids() {
            let forward = fluid.shear_stress(Dual::variable(k));
            let tolerance = Tol::ulps(64.0).times((1.0 / slope(&fluid, k)).max(1.0) * (1.0 + k.abs().ln().abs()));
            if tolerance.value() < 1e-3 {
                let back = fluid.shear_rate(forward);
                prop_assert!(back.is_ok());
                let tangent = back.map_or(f64::NAN, |back| back.tangent);
                prop_assert!((tangent - 1.0).abs() <= tolerance.value(), "{:?} at {k:e}: {tangent}", fluid);
            }
        }
    }

    #[test]
    fn second_derivative_in_nested_duals_is_that_of_the_slope(k in 1e-2..1e2_f64) {
        for fluid in fluids() {
            let nested = fluid.shear_stress(Dual { value: Dual::variable(k), tangent: Dual::lit(1.0) });
            let h = 1e-4 * k;
            let slope = |k: f64| fluid.shear_stress(Dual::variable(k)).tangent;
            let quotient = (8.0 * (slope(k + h) - slope(k - h)) - (slope(k + 2.0 * h) - slope(k - 2.0 * h))) / (12.0 * h);
            let scale = nested.tangent.tangent.abs().max(slope(k) / k);
            let tolerance = Tol::stated(1e-9, "h⁴ of the fifth derivative and ulp/h, h = 1e-4 k");
            let what = format!("{fluid:?} at {k:e}");
            assert_close_at_scale(&what, &[nested.tangent.tangent], &[quotient], scale, tolerance);
        }
    }

    #[test]
    fn lanes_equal_scalars(k in proptest::array::uniform4(rates())) {
        for fluid in fluids() {
            let lanes = Lanes::<f64, 4>::from(k);
            let (stress, viscosity) = (fluid.shear_stress(lanes), fluid.viscosity(lanes));
            let rate = fluid.shear_rate(stress);
            prop_assert!(rate.is_ok(), "{:?} at {k:?}: {rate:?}", fluid);
            let rate = rate.unwrap_or(Lanes::splat(f64::NAN));
            for (lane, &k) in k.iter().enumerate() {
                let tolerance = Tol::ulps(16.0).times(1.0 + k.abs().ln().abs());
                prop_assert!((stress.primal(lane) / fluid.shear_stress(k) - 1.0).abs() <= tolerance.value(), "{:?} at {k:e}", fluid);
                prop_assert!((viscosity.primal(lane) / fluid.viscosity(k) - 1.0).abs() <= tolerance.value());
                let tolerance = tolerance.times((2.0 / slope(&fluid, k)).max(1.0));
                if tolerance.value() < 0.1 {
                    prop_assert!((rate.primal(lane) / k - 1.0).abs() <= tolerance.value(), "{:?} at {k:e}", fluid);
                }
            }
        }
    }
}
