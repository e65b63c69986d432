//! What every fluid answers to: steady motions, histories, start and stop, oscillations, extension.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::rates::{ExponentialMotion, HomogeneousMotion, VelocityGradient, steady_turn};
use piola_continuum::{DeformationGradient, Symmetric};
use piola_fluids::{
    AnyFluid, Bingham, ExponentialDamping, Extension, FluidsError, Giesekus, Kbkz, LinearViscous, OldroydB,
    Oscillation, PowerLaw, RationalDamping, Relaxation, SecondOrder, SimpleFluid, SteadyStress, UpperConvectedMaxwell,
    ViscometricFluid,
};
use piola_testkit::{Tol, assert_close, assert_close_at_scale, strategies};
use proptest::prelude::*;

use super::elastic::{all, elastic};

const FOLLOWED: Tol = Tol::stated(1e-8, "tolerance 1e-11 of each of many steps");
const QUADRATURE: Tol = Tol::stated(1e-11, "quadratures");

fn shear(k: f64) -> VelocityGradient {
    VelocityGradient::from_rows([[0.0; 3], [k, 0.0, 0.0], [0.0; 3]]).expect("finite")
}

fn stresses(fluid: &AnyFluid, k: f64) -> [f64; 3] {
    [fluid.shear_stress(k), fluid.first_normal_stress_difference(k), fluid.second_normal_stress_difference(k)]
}

#[test]
fn responses_to_steady_shear_equal_the_viscometric_functions_at_extreme_rates() {
    for fluid in all() {
        for k in [0.0, 1e-8, 1e-3, 0.7, -12.0, 1e4, 1e8] {
            let what = format!("{fluid:?} at {k:e}");
            let stress = fluid.response_to_steady(&shear(k)).unwrap_or_else(|error| panic!("{what}: {error}"));
            let [t11, t22, _, t12, t23, t13] = stress.components;
            let [shear, first, second] = stresses(&fluid, k);
            assert_close(&what, &[t12], &[shear], QUADRATURE);
            assert_close_at_scale(
                &what,
                &[t22 - t11, t11 - stress.components[2]],
                &[first, second],
                1e-3 * first.abs(),
                QUADRATURE,
            );
            assert_close_at_scale(&what, &[t13, t23], &[0.0; 2], shear.abs(), Tol::ulps(4.0));
        }
    }
}

#[test]
fn responses_to_the_start_of_shear_equal_those_to_the_motion_and_to_samples_and_end_in_the_steady_state() {
    let motion = |k: f64| ExponentialMotion::new(shear(k).0, Matrix3::identity()).expect("a motion");
    for fluid in all() {
        for (k, time) in [(1.5, 0.4), (-8.0, 2.0)] {
            let what = format!("{fluid:?} at {k:e} after {time}");
            let start = fluid.response_to_start(k, time, 1e-11).unwrap_or_else(|error| panic!("{what}: {error}"));
            let expected = [start.shear, start.first, start.second];
            let close = |what: &str, stress: &Symmetric| {
                let [t11, t22, t33, t12, ..] = stress.components;
                let scale = expected.iter().fold(0.0_f64, |a, x| a.max(x.abs()));
                assert_close_at_scale(what, &[t12, t22 - t11, t11 - t33], &expected, scale, FOLLOWED);
            };
            close(&what, &fluid.response_to_motion(&motion(k), time, 1e-11).expect("a motion"));
            let sample = |t: f64| (t + 7.0, motion(k).deformation(t).expect("a motion"));
            let samples = [0.0, 0.2, 0.3, 0.9, 1.0].map(|share| sample(share * time));
            close(&what, &fluid.response_to_samples(&samples, 1e-11).expect("samples"));
        }
        let steady = stresses(&fluid, 2.0);
        let end = fluid.response_to_start(2.0, 30.0, 1e-11).expect("a time");
        assert_close(fluid.name(), &[end.shear, end.first, end.second], &steady, FOLLOWED);
        let rest = fluid.response_to_start(2.0, 0.0, 1e-11).expect("a time");
        assert_close(fluid.name(), &[rest.shear, rest.first, rest.second], &[0.0; 3], Tol::ulps(0.0));
        assert!(fluid.response_to_start(f64::NAN, 1.0, 1e-9).is_err());
        assert!(fluid.response_to_start(1.0, -1.0, 1e-9).is_err());
        assert!(fluid.response_to_samples(&[], 1e-9).is_err());
        let same = (1.0, DeformationGradient::diagonal([1.0; 3]).expect("det F > 0"));
        assert!(fluid.response_to_samples(&[same, same], 1e-9).is_err());
    }
}

#[test]
fn responses_to_the_stop_of_shear_fall_from_the_polymers_part_to_nothing() {
    for fluid in all() {
        let [at_once, later, long] = [0.0, 0.25, 40.0].map(|t| fluid.response_to_stop(3.0, t, 1e-11).expect("a time"));
        let steady = stresses(&fluid, 3.0);
        let what = fluid.name();
        // After the stop nothing of the solvent is left, and of fluids without memory nothing at all.
        assert!(at_once.shear <= steady[0] * (1.0 + 1e-8), "{what}");
        if 0.0 < at_once.shear {
            assert_close(what, &[at_once.first, at_once.second], &steady[1..], FOLLOWED);
            assert!(0.0 < later.shear && later.shear < at_once.shear, "{what}: {later:?}");
            assert!(later.first < at_once.first, "{what}: {later:?}");
        }
        assert_close_at_scale(what, &[long.shear, long.first, long.second], &[0.0; 3], steady[0], FOLLOWED);
        assert!(fluid.response_to_stop(1.0, -1.0, 1e-9).is_err());
    }
}

#[test]
fn small_oscillations_equal_those_of_small_amplitude_and_slow_ones_the_viscosity_at_rest() {
    for fluid in all() {
        let rest = fluid.viscosity(0.0_f64);
        let small = fluid.response_to_small_oscillation(0.7);
        if !rest.is_finite() {
            assert!(matches!(small, Err(FluidsError::BeyondLimit { .. })), "{fluid:?}");
            continue;
        }
        let small = small.expect("a viscosity at rest");
        let slow = fluid.response_to_small_oscillation(1e-9).expect("a viscosity at rest");
        assert_close(fluid.name(), &[slow.loss], &[1e-9 * rest], Tol::stated(1e-13, "terms of order (λω)²"));
        let tiny = fluid.response_to_oscillation(1e-6, 0.7, 2, 1e-11).expect("runs");
        // Powers and exponentials near rest are not linear at 1e-6.
        let differentiable = (fluid.viscosity(1e-6) / rest - 1.0).abs() < 1e-5;
        if differentiable {
            let tolerance = Tol::stated(2e-5, "terms beyond the first in γ₀ = 1e-6");
            assert_close(&format!("{fluid:?}"), &tiny.shear[0], &[small.storage, small.loss], tolerance);
            assert_close_at_scale("third", &tiny.shear[1], &[0.0; 2], small.loss, tolerance);
        }
        assert!(fluid.response_to_small_oscillation(0.0).is_err());
        assert!(fluid.response_to_oscillation(0.0, 1.0, 2, 1e-9).is_err());
        assert!(fluid.response_to_oscillation(1.0, 1.0, 16, 1e-9).is_err());
        assert!(fluid.response_to_oscillation(1.0, f64::INFINITY, 2, 1e-9).is_err());
    }
}

#[test]
fn large_oscillations_of_fluids_of_the_present_rate_equal_their_closed_forms() {
    let response = |fluid: AnyFluid, count: usize| fluid.response_to_oscillation(3.0, 2.0, count, 1e-9).expect("runs");
    // Of Bingham's fluid: 4 τᵧ/(π n) of alternating sign beside the viscous part.
    let bingham = response(Bingham::new(0.5, 0.75).expect("bounds").into(), 15);
    for (n, parts) in (1..).step_by(2).zip(&bingham.shear) {
        let viscous = if n == 1 { 0.75 * 2.0 } else { 0.0 };
        let sign = if n % 4 == 1 { 1.0 } else { -1.0 };
        let expected = viscous + sign * 4.0 * 0.5 / (core::f64::consts::PI * f64::from(n) * 3.0);
        assert_close_at_scale(
            "Bingham",
            parts,
            &[0.0, expected],
            0.1,
            Tol::ulps_because(256.0, "sums over some hundred nodes"),
        );
    }
    let left = Tol::ulps_because(450.0, "sums over some hundred nodes");
    assert_close_at_scale("residual", &[bingham.residual], &[0.0], 1.0, left);
    // Of a power law, by mpmath at 50 digits: (2/√π) Γ(1 + n/2)/Γ(3/2 + n/2) of K (γ₀ ω)ⁿ/γ₀.
    for (exponent, factor) in [(0.05, POWER_005), (0.5, POWER_050), (2.0, POWER_200)] {
        let fluid = PowerLaw::new(1.5, exponent).expect("bounds");
        let found = response(fluid.into(), 3);
        let expected = 1.5 * 6.0_f64.powf(exponent) / 3.0 * factor;
        assert_close("power law", &[found.shear[0][1]], &[expected], Tol::stated(1e-13, "exponential convergence"));
    }
    let second = SecondOrder::new(2.0, -0.5, 0.75).expect("bounds");
    let found = response(second.into(), 3);
    assert_close("N₁", &[found.first_normal[0][1], found.first_normal[1][1]], &[2.0, 2.0], Tol::ulps(4.0));
    assert_close("T₁₂", &found.shear[0], &[2.0, 4.0], Tol::ulps(4.0));
}
const POWER_005: f64 = 1.254_127_020_284_298;
const POWER_050: f64 = 1.112_835_788_898_764_2;
const POWER_200: f64 = 0.848_826_363_156_775_1;

/// T₁₂ and N₁ at the phase ω t.
fn resynthesised(response: &Oscillation, amplitude: f64, phase: f64) -> [f64; 2] {
    let sum = |parts: &[[f64; 2]], from: f64| -> f64 {
        let mut n = from;
        let mut total = 0.0;
        for [sine, cosine] in parts {
            total += sine * (n * phase).sin() + cosine * (n * phase).cos();
            n += 2.0;
        }
        total
    };
    [amplitude * sum(&response.shear, 1.0), amplitude * amplitude * sum(&response.first_normal, 0.0)]
}

#[test]
fn large_oscillations_equal_the_response_to_the_oscillating_motion() {
    struct Oscillating;
    impl HomogeneousMotion for Oscillating {
        fn gradient<T: piola_numerics::Real>(&self, t: T) -> Matrix3<T> {
            let mut f = Matrix3::from_diagonal_element(T::one());
            f[(1, 0)] = T::lit(1.5) * (T::lit(2.0) * t).sin();
            f
        }
    }
    for fluid in elastic() {
        // After the start is forgotten: e^(−24).
        let (time, response) = (12.3, fluid.response_to_oscillation(1.5, 2.0, 15, 1e-10).expect("runs"));
        let stress = fluid.response_to_motion(&Oscillating, time, 1e-10).expect("runs");
        let [t11, t22, _, t12, ..] = stress.components;
        let expected = resynthesised(&response, 1.5, 2.0 * time);
        let tolerance = Tol::stated(1e-6, "fifteen harmonics; what is left of the start");
        assert_close_at_scale(fluid.name(), &[t12, t22 - t11], &expected, 1.0, tolerance);
        // The last two periods differ by what is left of the start: none of a fluid without memory.
        let left = Tol::stated(1e-6, "tolerance 1e-10 of each step, and e^(−t/λ) of the periods before");
        assert_close_at_scale(fluid.name(), &[response.residual], &[0.0], 1.0, left);
    }
}

#[test]
fn responses_to_extension_equal_closed_forms_and_their_newtonian_limits() {
    for fluid in all() {
        for extension in [Extension::Uniaxial, Extension::Planar, Extension::Biaxial] {
            let rest = fluid.viscosity(0.0_f64);
            let at_rest = fluid.response_to_extension(extension, 0.0);
            if !rest.is_finite() {
                assert!(matches!(at_rest, Err(FluidsError::BeyondLimit { .. })), "{fluid:?}");
                let pulled = fluid.response_to_extension(extension, 0.3).expect("it flows");
                // k = √(2 D : D) of the three: √3 ε̇, 2 ε̇, √12 ε̇; the difference is trouton η ε̇.
                let k = 0.3
                    * extension.trouton_ratio().sqrt()
                    * if extension == Extension::Biaxial { 2.0_f64.sqrt() } else { 1.0 };
                let expected = extension.trouton_ratio() * fluid.viscosity(k);
                assert_close(&format!("{fluid:?}"), &[pulled], &[expected], Tol::ulps(32.0));
                continue;
            }
            let limit = extension.trouton_ratio() * rest;
            assert_close(fluid.name(), &[at_rest.expect("a limit")], &[limit], Tol::stated(1e-13, "sums"));
            let slow = fluid.response_to_extension(extension, 1e-9).expect("slow");
            let slope = (fluid.viscosity(4e-9) / rest - 1.0).abs();
            assert_close(
                &format!("{fluid:?}"),
                &[slow],
                &[limit],
                Tol::stated(1e-7, "λ ε̇ = 1e-9").times(1.0 + slope / 1e-8),
            );
        }
    }
    let linear = LinearViscous::new(0.25, 0.75).expect("bounds");
    let pulled = linear.response_to_extension(Extension::Uniaxial, 5.0).expect("it flows");
    assert_close("Trouton", &[pulled], &[2.25], Tol::ulps(4.0));
}

fn kbkz<H: piola_fluids::Damping>(damping: H) -> Kbkz<H> {
    let memory = vec![Relaxation { viscosity: 2.0, time: 0.5 }, Relaxation { viscosity: 1.0, time: 4.0 }];
    Kbkz::new(memory, damping).expect("bounds")
}

#[test]
fn memory_without_damping_equals_oldroyd_modes_in_every_response() {
    let integral = kbkz(ExponentialDamping::new(0.0, 0.5).expect("bounds"));
    let modes = piola_fluids::Modes::new(vec![
        UpperConvectedMaxwell::new(2.0, 0.5).expect("bounds"),
        UpperConvectedMaxwell::new(1.0, 4.0).expect("bounds"),
    ])
    .expect("modes");
    let l =
        VelocityGradient::from_rows([[0.05, -0.05, 0.02], [0.1, -0.025, 0.05], [-0.08, 0.15, -0.025]]).expect("finite");
    let close = |what: &str, a: Symmetric, b: Symmetric, tolerance| {
        assert_close(what, &a.components, &b.components, tolerance);
    };
    let found = integral.steady_stress(&l).expect("bounded");
    let expected = modes.steady_stress(&l).expect("bounded");
    close("steady", found.value, expected, QUADRATURE);
    assert!((found.value - expected).norm() <= found.bound + 1e-12 * expected.norm(), "{:e}", found.bound);
    let motion = ExponentialMotion::new(l.0, Matrix3::identity()).expect("a motion");
    let along = modes.response_to_motion(&motion, 2.0, 1e-12).expect("runs");
    close("motion", integral.response_to_motion(&motion, 2.0, 0.0).expect("runs"), along, FOLLOWED);
    let samples = [0.0, 0.5, 0.75, 2.0].map(|t| (t, motion.deformation(t).expect("a motion")));
    close("samples", integral.response_to_samples(&samples, 0.0).expect("runs"), along, FOLLOWED);
    for rate in [-3.0, -0.3, 0.1, 0.124] {
        for extension in [Extension::Uniaxial, Extension::Planar, Extension::Biaxial] {
            let (a, b) =
                (integral.response_to_extension(extension, rate), modes.response_to_extension(extension, rate));
            match (a, b) {
                (Ok(a), Ok(b)) => assert_close("extension", &[a], &[b], Tol::stated(1e-10, "quadratures to e^(−665)")),
                (Err(a), Err(_)) => assert!(matches!(a, FluidsError::BeyondLimit { .. }), "{a}"),
                (a, b) => panic!("{extension:?} at {rate}: {a:?} or {b:?}"),
            }
        }
    }
    // 2 λ ε̇ ≥ 1 of the longer mode.
    assert!(integral.response_to_extension(Extension::Uniaxial, 0.126).is_err());
    assert!(integral.response_to_extension(Extension::Uniaxial, 1e8).is_err());
}

#[test]
fn damped_memory_has_a_steady_stress_in_every_extension() {
    // Of h = α/(α + (I₁ − 3)) the damped strain ends at α in uniaxial extension: η_E ε̇ → α Σ G.
    let fluid = kbkz(RationalDamping::new(8.0, 1.0).expect("bounds"));
    for rate in [1e3, 1e5, 1e8] {
        let stress = fluid.response_to_extension(Extension::Uniaxial, rate).expect("bounded") * rate;
        let tolerance = Tol::stated(1e-1, "the time until the strain is large, ln 8/(2 λ ε̇)").times(100.0 / rate);
        assert_close("α Σ G", &[stress], &[8.0 * 4.25], tolerance.or(QUADRATURE));
    }
    let wagner = kbkz(ExponentialDamping::new(0.2, 0.5).expect("bounds"));
    for rate in [1e-8, 0.1, 1.0, 1e3, 1e8] {
        for extension in [Extension::Uniaxial, Extension::Planar, Extension::Biaxial] {
            for rate in [rate, -rate] {
                let viscosity = wagner.response_to_extension(extension, rate).expect("bounded");
                assert!(0.0 < viscosity && viscosity.is_finite(), "{extension:?} at {rate:e}: {viscosity:e}");
            }
        }
    }
    // Of I₂ alone a strong uniaxial flow is hardly damped: (Cₜ⁻¹ − 1) h grows like e^(ε̇ s).
    let weak = kbkz(RationalDamping::new(8.0, 0.0).expect("bounds"));
    assert!(weak.response_to_extension(Extension::Uniaxial, 0.2).is_ok());
    assert!(weak.response_to_extension(Extension::Uniaxial, 0.26).is_err());
}

#[test]
fn start_and_stop_of_nonlinear_fluids_equal_those_of_oldroyd_fluid_without_their_parameter() {
    let exact = OldroydB::new(0.125, 2.0, 0.5).expect("bounds");
    let fluid = Giesekus::new(0.125, 2.0, 0.5, 0.0).expect("bounds");
    for (k, time) in [(1e-8, 0.3), (5.0, 0.01), (5.0, 1.0), (1e4, 0.5)] {
        let (a, b) = (fluid.response_to_start(k, time, 1e-12), exact.response_to_start(k, time, 0.0));
        let (a, b) = (a.expect("runs"), b.expect("closed"));
        assert_close("start", &[a.shear], &[b.shear], FOLLOWED);
        assert_close("start", &[a.first], &[b.first], FOLLOWED);
        let (a, b) = (fluid.response_to_stop(k, time, 1e-12), exact.response_to_stop(k, time, 0.0));
        let (a, b) = (a.expect("runs"), b.expect("closed"));
        assert_close("stop", &[a.shear], &[b.shear], FOLLOWED);
        assert_close("stop", &[a.first], &[b.first], FOLLOWED);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn responses_to_slow_motions_equal_those_of_the_newtonian_fluid(entries in strategies::vector(9, -1.0..1.0)) {
        let mut l = Matrix3::from_row_slice(&entries);
        l -= Matrix3::from_diagonal_element(l.trace() / 3.0);
        let size = 1e-7;
        let slow = VelocityGradient::new(l * size).expect("finite");
        let mut compared = 0;
        for fluid in all() {
            let rest = fluid.viscosity(0.0_f64);
            // Powers and yield stresses are not Newtonian at 1e-7.
            let thinned = (fluid.viscosity(size) / rest - 1.0).abs();
            if !rest.is_finite() || 1e-4 < thinned {
                continue;
            }
            compared += 1;
            let newtonian = LinearViscous::new(0.0, rest).expect("bounds");
            let stress = fluid.response_to_steady(&slow).expect("slow");
            let expected = newtonian.response_to_steady(&slow).expect("linear");
            // Normal stresses are of the order λ |L| ≤ 1e-6; a viscosity has fallen by what it has at √(2 D : D) ≤ 4 · 1e-7.
            let tolerance = Tol::stated(2e-6, "λ |L|").or(Tol::stated(8.0, "as much as the viscosity").times(thinned));
            assert_close(&format!("{fluid:?}"), &stress.components, &expected.components, tolerance);
        }
        // All fluids with memory, and most of the others.
        prop_assert!(elastic().len() + 6 < compared, "{compared} fluids");
    }

    #[test]
    fn responses_to_steady_motions_seen_from_turned_axes_are_the_turned_ones(
        entries in strategies::vector(9, -0.3..0.3), q in strategies::rotation(), mirrored in any::<bool>(),
    ) {
        let mut l = Matrix3::from_row_slice(&entries);
        l -= Matrix3::from_diagonal_element(l.trace() / 3.0);
        let r = strategies::rotation_matrix(q);
        let sign = if mirrored { -1.0 } else { 1.0 };
        let turn = Matrix3::from_fn(|i, j| sign * r[i][j]);
        let turned = VelocityGradient::new(turn * l * turn.transpose()).expect("finite");
        let l = VelocityGradient::new(l).expect("finite");
        let mut compared = 0;
        for fluid in all() {
            let (stress, seen) = (fluid.response_to_steady(&l), fluid.response_to_steady(&turned));
            let (Ok(stress), Ok(seen)) = (&stress, &seen) else {
                prop_assert!(stress.is_err() == seen.is_err(), "{fluid:?}: {stress:?} or {seen:?}");
                continue;
            };
            let expected = turn * stress.matrix() * turn.transpose();
            let turned = Tol::stated(1e-11, "quadratures, and a search at each stress of a network");
            assert_close(&format!("{fluid:?}"), seen.matrix().as_slice(), expected.as_slice(), turned);
            compared += 1;
        }
        // Only networks without a limit are refused, in strong extensions.
        prop_assert!(all().len() <= compared + 6, "{compared} fluids");
    }
}

#[test]
fn responses_to_a_resting_body_are_nothing() {
    let rest = ExponentialMotion::new(Matrix3::zeros(), Matrix3::identity()).expect("a motion");
    for fluid in all() {
        let stress = fluid.response_to_motion(&rest, 1.0, 1e-9).expect("rest");
        assert_close(fluid.name(), &stress.components, &[0.0; 6], Tol::ulps(0.0));
        // A rounding of D is a rate: solids at small stresses answer to it with their yield stress.
        if fluid.viscosity(0.0_f64).is_finite() {
            let turning = steady_turn(&Vector3::new(1.0, -2.0, 0.5)).expect("finite");
            let stress = fluid.response_to_motion(&turning, 1.0, 1e-9).expect("a rigid motion");
            let scale = fluid.viscosity(0.0_f64).max(fluid.shear_stress(1e-15) / 1e-15);
            assert_close_at_scale(&format!("{fluid:?}"), &stress.components, &[0.0; 6], scale, Tol::ulps(64.0));
        }
    }
}
