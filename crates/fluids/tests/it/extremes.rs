//! Shear rates from 1e-8 to 1e8, exponents from 0.05 to 2, and rest, of every fluid: odd, even, finite, rising, with an inverse.

use piola_fluids::{
    AnyFluid, CarreauYasuda, Cross, Ellis, ExponentialDamping, ExponentialPhanThienTanner, Eyring, Giesekus,
    HerschelBulkley, Kbkz, LinearPhanThienTanner, Newtonian, OldroydB, Papanastasiou, PowerLaw, RationalDamping,
    ReinerRivlin, Relaxation, SecondOrder, Sisko, Slipping, UpperConvectedMaxwell, ViscometricFluid,
};
use piola_numerics::Dual;
use piola_testkit::strategies::random_cases;
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use proptest::prelude::*;

use super::elastic::{all, elastic};

/// Fluids with exponents, of any n.
fn of_exponent(n: f64) -> Vec<AnyFluid> {
    [
        PowerLaw::new(1.5, n).map(AnyFluid::from),
        HerschelBulkley::new(2.0, 1.0, n).map(AnyFluid::from),
        HerschelBulkley::new(0.0, 1.0, n).map(AnyFluid::from),
        CarreauYasuda::new(3.0, 0.5, 1.5, n, 1.25).map(AnyFluid::from),
        CarreauYasuda::new(3.0, 0.0, 1e6, n, n.max(0.25)).map(AnyFluid::from),
        Sisko::new(0.1, 2.0, n).map(AnyFluid::from),
        Cross::new(2.0, 0.25, 1.5, n).map(AnyFluid::from),
        Ellis::new(2.0, 1.5, n.recip().max(1.0)).map(AnyFluid::from),
        Papanastasiou::new(0.5, 0.75, n, 4.0).map(AnyFluid::from),
        Papanastasiou::new(0.5, 0.75, n, 1e6).map(AnyFluid::from),
    ]
    .into_iter()
    .map(|fluid| fluid.expect("within bounds"))
    .collect()
}

/// τ, N₁, N₂, τ/k.
fn functions(fluid: &AnyFluid, k: f64) -> [f64; 4] {
    [
        fluid.shear_stress(k),
        fluid.first_normal_stress_difference(k),
        fluid.second_normal_stress_difference(k),
        fluid.viscosity(k),
    ]
}

/// Everything is finite, odd or even to the bit, and of the sign it must have.
fn is_regular(fluid: &AnyFluid, k: f64) -> Result<(), TestCaseError> {
    let (there, back) = (functions(fluid, k), functions(fluid, -k));
    prop_assert!(there.iter().all(|x| x.is_finite()), "{fluid:?} at {k:e}: {there:?}");
    prop_assert!(0.0 < there[0] && 0.0 < there[3], "{fluid:?} at {k:e}: {there:?}");
    prop_assert_eq!(there[0].to_bits(), (-back[0]).to_bits(), "{:?} at {:e}", fluid, k);
    for i in 1..4 {
        prop_assert!((there[i] - back[i]).abs() <= 0.0, "{fluid:?} at {k:e}: {there:?} or {back:?}");
    }
    let slope = fluid.shear_stress(Dual::variable(k));
    prop_assert!(slope.tangent.is_finite(), "{fluid:?} at {k:e}: {slope:?}");
    prop_assert!((slope.value / there[0] - 1.0).abs() <= Tol::ulps(64.0).value(), "{fluid:?} at {k:e}: {slope:?}");
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(10_000)))]

    #[test]
    fn functions_of_fluids_of_any_exponent_are_finite_and_odd_or_even_at_every_rate(
        n in 0.05..2.0_f64, log in -8.0..8.0_f64,
    ) {
        let k = 10.0_f64.powf(log);
        for fluid in of_exponent(n) {
            is_regular(&fluid, k)?;
        }
    }

    #[test]
    fn normal_stresses_of_elastic_fluids_are_even_and_shear_stresses_odd(log in -8.0..8.0_f64) {
        let k = 10.0_f64.powf(log);
        for fluid in elastic() {
            is_regular(&fluid, k)?;
        }
    }

    #[test]
    fn rates_of_fluids_of_any_exponent_are_those_of_their_stresses(n in 0.05..2.0_f64, log in -8.0..8.0_f64) {
        let k = 10.0_f64.powf(log);
        for fluid in of_exponent(n) {
            let stress = fluid.shear_stress(Dual::variable(k));
            let slope = k * stress.tangent / stress.value;
            // What of a rate is in its stress: an ulp over the slope.
            let known = Tol::ulps(64.0).times((1.0 + log.abs()) / slope.min(1.0));
            let rate = fluid.shear_rate(stress.value);
            if known.value() < 1e-2 {
                let rate = rate.map_err(|error| TestCaseError::fail(format!("{fluid:?} at {k:e}: {error}")))?;
                prop_assert!((rate / k - 1.0).abs() <= known.value(), "{fluid:?} at {k:e}: {rate:e}");
            } else if let (Ok(rate), true) = (rate, fluid.yield_stress() < stress.value) {
                // Some rate it may be, but of the same stress.
                let again = fluid.shear_stress(rate);
                let search = Tol::stated(1e-11, "a search for a stress that hardly grows with the rate");
                assert_close(&format!("{fluid:?} at {k:e}"), &[again], &[stress.value], search);
            }
        }
    }
}

/// Newton's steps from the power law's branch to the linear one and back, alone, have no end here.
#[test]
fn rates_across_a_bend_are_found() {
    let (yielding, rate) =
        (Papanastasiou::new(0.5, 0.75, 0.158_919_137_625_068_4, 1e6).expect("bounds"), 9.182_468_858e-8);
    let found: f64 = yielding.shear_rate(yielding.shear_stress(rate)).expect("a growing stress");
    assert_close(
        "ζ(τ(k))",
        &[found],
        &[rate],
        Tol::ulps_because(256.0, "at a bend the stress hardly grows with the rate"),
    );
}

#[test]
fn functions_at_the_ends_of_the_range_and_at_rest_are_those_of_their_limits() {
    for n in [0.05, 0.5, 1.0, 2.0] {
        for fluid in of_exponent(n) {
            for k in [1e-8, 1e8] {
                assert!(is_regular(&fluid, k).is_ok(), "{fluid:?} at {k:e}: {:?}", is_regular(&fluid, k));
            }
        }
    }
    for fluid in all().into_iter().chain([0.05, 2.0].into_iter().flat_map(of_exponent)) {
        let rest = functions(&fluid, 0.0);
        assert_close(&format!("{fluid:?} at rest"), &rest[..3], &[0.0; 3], Tol::ulps(0.0));
        assert!(!rest[3].is_nan(), "{fluid:?}: {rest:?}");
        let denormal = functions(&fluid, 1e-310);
        assert!(denormal.iter().all(|x| !x.is_nan()), "{fluid:?}: {denormal:?}");
        if fluid.yield_stress() <= 0.0 {
            let rate: f64 = fluid.shear_rate(0.0).expect("rest");
            assert_close(&format!("{fluid:?}"), &[rate], &[0.0], Tol::ulps(0.0));
        }
        for k in [f64::NAN, f64::INFINITY] {
            assert!(!fluid.shear_stress(k).is_finite() || k.is_infinite(), "{fluid:?}");
            assert!(fluid.shear_rate(k).is_err(), "{fluid:?} at a stress of {k}");
        }
    }
}

#[test]
fn newtonian_limits_of_elastic_fluids_equal_the_newtonian_fluid() {
    let newtonian = Newtonian::new(0.75).expect("bounds");
    let memory = vec![Relaxation { viscosity: 0.75, time: 1e-30 }];
    let oldroyd = OldroydB::new(0.25, 0.5, 1e-30).expect("bounds");
    let limits: Vec<AnyFluid> = vec![
        ReinerRivlin(piola_fluids::ConstantCoefficients::new(1.5, 0.0).expect("bounds")).into(),
        SecondOrder::new(0.75, 0.0, 0.0).expect("bounds").into(),
        UpperConvectedMaxwell::new(0.75, 1e-30).expect("bounds").into(),
        oldroyd.into(),
        Giesekus::new(0.25, 0.5, 1e-30, 0.5).expect("bounds").into(),
        LinearPhanThienTanner::new(0.25, 0.5, 1e-30, 0.5).expect("bounds").into(),
        ExponentialPhanThienTanner::new(0.25, 0.5, 1e-30, 0.5).expect("bounds").into(),
        Slipping::new(oldroyd, 0.5).expect("bounds").into(),
        Kbkz::new(memory.clone(), RationalDamping::new(8.0, 0.5).expect("bounds")).expect("bounds").into(),
        Kbkz::new(memory, ExponentialDamping::new(0.2, 0.5).expect("bounds")).expect("bounds").into(),
        Eyring::new(0.75e20, 1e-20).expect("bounds").into(),
    ];
    for fluid in limits {
        for k in [1e-8, 1e-3, 1.0, -7.0, 1e4, 1e8] {
            let what = format!("{fluid:?} at {k:e}");
            let [shear, first, second, viscosity] = functions(&fluid, k);
            let tolerance = Tol::stated(1e-13, "sums");
            assert_close(&what, &[shear, viscosity], &[newtonian.shear_stress(k), 0.75], tolerance);
            // N₁ = 2 λ k τ of λ = 1e-30 s at k ≤ 1e8.
            let none = Tol::stated(1e-21, "2 λ k ≤ 2e-22");
            assert_close_at_scale(&what, &[first, second], &[0.0; 2], shear.abs(), none);
            assert_close(&what, &[fluid.shear_rate(0.75 * k).expect("a rate")], &[k], tolerance);
        }
    }
}
