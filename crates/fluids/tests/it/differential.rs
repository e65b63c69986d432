//! Differential fluids: golden values, references, limits, motions followed by integration against exact ones.

use nalgebra::Matrix3;
use piola_continuum::rates::{VelocityGradient, exponential_rows};
use piola_continuum::{DeformationGradient, Symmetric};
use piola_fluids::{
    ConvectedMaxwell, DifferentialFluid, ExponentialPhanThienTanner, Extension, FlowMoment, FluidsError, Giesekus,
    LinearPhanThienTanner, Modes, OldroydB, ShearStresses, SteadyStress, StressRate, UpperConvectedMaxwell,
    ViscometricFluid, follow, follow_shear, oscillate,
};
use piola_numerics::{Dual, Lanes, Real};
use piola_tensor::internal::rows::{product_transposed, scaled};
use piola_testkit::golden::{load, number, text};
use piola_testkit::{DoubleDouble, Tol, assert_close, assert_close_at_scale, strategies};
use proptest::prelude::*;
use serde_json::Value;

use super::stresses::{gradient, rows};

const CLOSED: Tol = Tol::stated(1e-13, "closed forms");

/// The modes of a golden case; the solvent is the first one's.
fn modes(input: &Value) -> Modes<OldroydB> {
    let mut solvent = input.get("eta_s").map_or(0.0, number);
    let pairs = input["modes"].as_array().expect("modes");
    let mode = |pair: &Value| {
        let made = OldroydB::new(core::mem::take(&mut solvent), number(&pair[0]), number(&pair[1]));
        made.expect("bounds")
    };
    Modes::new(pairs.iter().map(mode).collect()).expect("a mode")
}

#[test]
fn motions_of_maxwell_fluids_equal_golden() {
    let mut count = 0;
    for case in &load("fluids").cases {
        let (input, output, id) = (&case["input"], &case["output"], text(&case["id"]));
        let close = |stress: Symmetric, tolerance: Tol| {
            let expected = rows(&output["extra_stress"]);
            assert_close(id, stress.rows().as_flattened(), expected.as_flattened(), tolerance);
        };
        match text(&case["kind"]) {
            "ucm_steady" | "oldroyd_b_steady" => {
                let l = gradient(&input["L"]);
                close(modes(input).steady_stress(&l).expect("bounded"), CLOSED);
                let pairs = input["modes"].as_array().expect("modes");
                let each = output["per_mode"].as_array().expect("stresses");
                assert_eq!(pairs.len(), each.len());
                let mut sum = l.rate_of_deformation().0 * (2.0 * input.get("eta_s").map_or(0.0, number));
                for (pair, expected) in pairs.iter().zip(each) {
                    let mode = UpperConvectedMaxwell::new(number(&pair[0]), number(&pair[1])).expect("bounds");
                    let stress = mode.steady_stress(&l).expect("bounded");
                    assert_close(id, stress.rows().as_flattened(), rows(expected).as_flattened(), CLOSED);
                    sum += stress;
                }
                close(sum, CLOSED);
            }
            "maxwell_startup" => {
                let (fluid, l, t) = (modes(input), gradient(&input["L"]), number(&input["t"]));
                close(fluid.start_up_stress(&l, t).expect("bounded"), CLOSED);
                // The same through the history, by quadrature.
                let strain = |s: f64| finger_strain(&l, s);
                let history = fluid.stress_of_history(strain, t).expect("0 < t");
                let solvent = l.rate_of_deformation().0 * (2.0 * fluid.total_solvent_viscosity());
                close(history.value + solvent, Tol::stated(1e-11, "quadratures"));
                let exact = fluid.start_up_stress(&l, t).expect("bounded") - solvent;
                let error = (history.value - exact).components.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
                assert!(error <= history.bound + CLOSED.value() * exact.norm(), "{id}: {error:e} {:e}", history.bound);
            }
            "ucm_startup_shear" => {
                let of = |name: &str| number(&input[name]);
                let fluid = UpperConvectedMaxwell::new(of("eta"), of("lam")).expect("bounds");
                let stresses = fluid.start_up(of("k"), of("t")).expect("0 ≤ t");
                let tolerance = Tol::stated(1e-15, "no cancellation");
                assert_close(id, &[stresses.shear], &[number(&output["tau"])], tolerance);
                assert_close(id, &[stresses.first], &[number(&output["N1"])], tolerance);
                assert_close(id, &[stresses.second], &[number(&output["N2"])], tolerance);
                let l = VelocityGradient::from_rows([[0.0; 3], [of("k"), 0.0, 0.0], [0.0; 3]]).expect("finite");
                let stress = fluid.start_up_stress(&l, of("t")).expect("bounded");
                let general = ShearStresses::of(&stress);
                assert_close(id, &[general.shear, general.first], &[stresses.shear, stresses.first], CLOSED);
                assert_close(id, &[general.first], &[stresses.first], CLOSED);
            }
            "oldroyd_steady_extension" => {
                let (fluid, l) = (modes(input), gradient(&input["L"]));
                let rates = [l.0[(0, 0)], l.0[(1, 1)], l.0[(2, 2)]];
                let stresses = fluid.extensional_stress(rates).expect("bounded");
                close(Symmetric::diagonal(stresses), CLOSED);
                close(fluid.steady_stress(&l).expect("bounded"), CLOSED);
                let extension = match text(&input["kind"]) {
                    "uniaxial" => Extension::Uniaxial,
                    "planar" => Extension::Planar,
                    _ => Extension::Biaxial,
                };
                let viscosity = fluid.extensional_viscosity(extension, rates[0]).expect("bounded");
                assert_close(id, &[viscosity], &[number(&output["extensional_viscosity"])], CLOSED);
            }
            _ => continue,
        }
        count += 1;
    }
    assert_eq!(count, 20);
}

/// Cₜ⁻¹(t − s) − 1 of a steady motion.
fn finger_strain(l: &VelocityGradient, s: f64) -> Symmetric {
    let e = exponential_rows(scaled(l.rows(), s));
    Symmetric::symmetric_part(product_transposed(e, e)) - Symmetric::identity()
}

fn giesekus(alpha: f64) -> Giesekus {
    Giesekus::new(0.125, 2.0, 0.5, alpha).expect("bounds")
}
fn linear(epsilon: f64) -> LinearPhanThienTanner {
    LinearPhanThienTanner::new(0.125, 2.0, 0.5, epsilon).expect("bounds")
}
fn exponential(epsilon: f64) -> ExponentialPhanThienTanner {
    ExponentialPhanThienTanner::new(0.125, 2.0, 0.5, epsilon).expect("bounds")
}

/// The fluid of a name with α or ε.
fn with_fluid(name: &str, parameter: f64, visit: &mut impl Visit) {
    match name {
        "giesekus" => visit.fluid(&giesekus(parameter)),
        "linear" => visit.fluid(&linear(parameter)),
        _ => visit.fluid(&exponential(parameter)),
    }
}

trait Visit {
    fn fluid<F: DifferentialFluid<Mode = F> + StressRate>(&mut self, fluid: &F);
}

#[test]
fn small_normal_stresses_of_giesekus_equal_those_of_twice_the_precision() {
    // λ k = 1e-6 and 1e-3, where the formula as it is usually printed loses up to all digits.
    for alpha in [0.1, 0.3, 0.5] {
        let fluid = giesekus(alpha);
        for k in [2e-6, 2e-3] {
            let expected = fluid.second_normal_stress_difference(DoubleDouble::lit(k)).primal(0);
            let tolerance = Tol::stated(1e-15, "four roundings");
            let what = format!("N₂, α = {alpha}, k = {k:e}");
            assert_close(&what, &[fluid.second_normal_stress_difference(k)], &[expected], tolerance);
        }
    }
}

/// The equation of the fluid holds in steady shear and in steady extension, and differences are even.
struct Steady(f64);

impl Visit for Steady {
    fn fluid<F: DifferentialFluid<Mode = F> + StressRate>(&mut self, fluid: &F) {
        let k = self.0;
        let polymer = fluid.shear_stress(k) - fluid.solvent_viscosity() * k;
        let (first, second) = (fluid.first_normal_stress_difference(k), fluid.second_normal_stress_difference(k));
        // Giesekus' T₃₃ is zero in steady shear: τ₁₁ = N₂, τ₂₂ = N₁ + N₂.
        let stress = Symmetric::new(second, first + second, 0.0, polymer, 0.0, 0.0);
        let l = VelocityGradient::from_rows([[0.0; 3], [k, 0.0, 0.0], [0.0; 3]]).expect("finite");
        let scale = fluid.relaxing(&stress).norm() / fluid.time() + 2.0 * k.abs() * stress.norm();
        let rate = fluid.stress_rate(&stress, &l).components;
        // The polymer's part is a difference here, and an exponential of it.
        let condition =
            1.0 + fluid.shear_stress(k) / polymer + stress.norm() * fluid.time() / fluid.polymer_viscosity();
        assert_close_at_scale(F::NAME, &rate, &[0.0; 6], scale, Tol::ulps(64.0).times(condition));
        assert_close("odd", &[fluid.shear_stress(-k)], &[-fluid.shear_stress(k)], Tol::ulps(0.0));
        assert_close(
            "even",
            &[fluid.sigma1(-k), fluid.sigma2(-k)],
            &[fluid.sigma1(k), fluid.sigma2(k)],
            Tol::ulps(0.0),
        );
        for extension in [Extension::Uniaxial, Extension::Planar, Extension::Biaxial] {
            for rate in [k, -k] {
                let rates = extension.rates(rate);
                let values = fluid.steady_extension(rates).expect("bounded");
                let diagonal = |d: [f64; 3]| [[d[0], 0.0, 0.0], [0.0, d[1], 0.0], [0.0, 0.0, d[2]]];
                let l = VelocityGradient::from_rows(diagonal(rates)).expect("finite");
                let stress = Symmetric::diagonal(values);
                let scale = fluid.relaxing(&stress).norm() / fluid.time() + 4.0 * rate.abs() * stress.norm();
                let left = fluid.stress_rate(&stress, &l).components;
                assert_close_at_scale(
                    F::NAME,
                    &left,
                    &[0.0; 6],
                    scale,
                    Tol::ulps_because(512.0, "a root of each equation, and its left side"),
                );
            }
        }
    }
}

#[test]
fn nonlinear_fluids_equal_oldroyd_fluid_without_their_parameter() {
    struct Check;
    impl Visit for Check {
        fn fluid<F: DifferentialFluid<Mode = F> + StressRate>(&mut self, fluid: &F) {
            let linear = OldroydB::new(0.125, 2.0, 0.5).expect("bounds");
            for k in [1e-8, 0.3, -40.0, 1e8] {
                let what = format!("{} at {k:e}", F::NAME);
                assert_close(&what, &[fluid.shear_stress(k)], &[linear.shear_stress(k)], Tol::ulps(8.0));
                assert_close(&what, &[fluid.sigma1(k)], &[0.0], Tol::ulps(0.0));
                assert_close(&what, &[fluid.sigma2(k)], &[linear.sigma2(k)], Tol::ulps(16.0));
            }
            for extension in [Extension::Uniaxial, Extension::Planar, Extension::Biaxial] {
                for rate in [-0.25, 0.25] {
                    let rates = extension.rates(rate);
                    let (a, b) = (fluid.extensional_stress(rates), linear.extensional_stress(rates));
                    assert_close(F::NAME, &a.expect("bounded"), &b.expect("bounded"), Tol::ulps(8.0));
                }
            }
            let beyond = fluid.extensional_stress([2.0, -1.0, -1.0]).expect_err("2 λ ε̇ = 2");
            assert!(matches!(beyond, FluidsError::BeyondLimit { quantity: "2 λ ε̇", .. }), "{beyond}");
        }
    }
    for name in ["giesekus", "linear", "exponential"] {
        with_fluid(name, 0.0, &mut Check);
    }
}

#[test]
fn steady_motions_beyond_the_limit_are_refused() {
    let fluid = UpperConvectedMaxwell::new(2.0, 0.5).expect("bounds");
    let rate = |e: f64| [[e, 0.0, 0.0], [0.0, -e / 2.0, 0.0], [0.0, 0.0, -e / 2.0]];
    for e in [1.0, 1.5, 100.0] {
        let l = VelocityGradient::from_rows(rate(e)).expect("finite");
        let error = fluid.steady_stress(&l).expect_err("2 λ ε̇ ≥ 1");
        assert!(matches!(error, FluidsError::BeyondLimit { .. }), "{error}");
        assert!(fluid.extensional_stress([e, -e / 2.0, -e / 2.0]).is_err());
        // Grown for a while it is a number, grown for long it is none.
        assert!(fluid.start_up_stress(&l, 3.0).is_ok());
        if 1.2 < e {
            assert!(fluid.start_up_stress(&l, 1e6).is_err());
        }
    }
    assert!(fluid.start_up(1.0, -1.0).is_err());
    assert!(fluid.start_up(f64::NAN, 1.0).is_err());
    assert!(Modes::<OldroydB>::new(Vec::new()).is_err());
    assert!(Giesekus::new(0.0, 1.0, 1.0, 0.75).is_err());
}

#[test]
fn start_up_and_cessation_equal_the_steady_state_in_their_limits() {
    let fluid = OldroydB::new(0.25, 1.5, 0.75).expect("bounds");
    let (k, long) = (3.0, 0.75 * 60.0);
    let steady = [fluid.shear_stress(k), fluid.first_normal_stress_difference(k)];
    let grown = fluid.start_up(k, long).expect("0 ≤ t");
    assert_close("start-up", &[grown.shear, grown.first], &steady, Tol::ulps(4.0));
    let [at_once, later] = [0.0, 0.3].map(|t| fluid.cessation(k, t).expect("0 ≤ t"));
    let polymer = 1.5 * k;
    assert_close("cessation", &[at_once.shear, at_once.first], &[polymer, steady[1]], Tol::ulps(4.0));
    assert_close("cessation", &[later.shear], &[polymer * (-0.4_f64).exp()], Tol::ulps(4.0));
    let rest = fluid.start_up(k, 0.0).expect("0 ≤ t");
    assert_close("at once", &[rest.shear, rest.first], &[0.0, 0.0], Tol::ulps(0.0));
    // Long after, and after long: all numbers.
    let l = VelocityGradient::from_rows([[0.0; 3], [k, 0.0, 0.0], [0.0; 3]]).expect("finite");
    let stress = fluid.start_up_stress(&l, 1e8).expect("bounded");
    assert_close("long", &[stress.components[3], stress.components[1]], &steady, CLOSED);
}

#[test]
fn small_amplitude_moduli_equal_the_transform_of_the_relaxation_modulus() {
    let fluid = Modes::new(vec![giesekus(0.3), Giesekus::new(0.0, 5.0, 20.0, 0.1).expect("bounds")]).expect("modes");
    // Beside their formulas by Maxwell's elements: G″/ω → η₀ at rest, G′ → Σ η/λ at high frequency.
    assert_close("η₀", &[fluid.loss_modulus(1e-9) / 1e-9], &[fluid.zero_rate_viscosity()], Tol::ulps(8.0));
    assert_close("G", &[fluid.storage_modulus(1e12)], &[fluid.relaxation_modulus(0.0)], Tol::ulps(8.0));
    assert_close("2 G′/ω² = Ψ₁", &[2.0 * fluid.storage_modulus(1e-9) / 1e-18], &[2.0 * (1.0 + 100.0)], Tol::ulps(8.0));
    let small = oscillate(&fluid, 1e-4, 0.7, 2, 60, 1e-12).expect("runs");
    let moduli = [fluid.storage_modulus(0.7), fluid.loss_modulus(0.7)];
    assert_close("oscillation", &small.shear[0], &moduli, Tol::stated(1e-7, "terms of second order in γ₀ = 1e-4"));
    assert!(oscillate(&fluid, 0.0, 0.7, 2, 1, 1e-9).is_err());
    assert!(oscillate(&fluid, 1.0, 0.7, 40, 1, 1e-9).is_err());
}

#[test]
fn large_oscillations_of_thinning_fluids_have_softer_moduli_and_third_harmonics() {
    let fluid = giesekus(0.3);
    let response = oscillate(&fluid, 10.0, 2.0, 4, 8, 1e-10).expect("runs");
    let left = Tol::stated(1e-7, "tolerance 1e-10 of each step, and e^(−t/λ) of the periods before");
    assert_close_at_scale("residual", &[response.residual], &[0.0], 1.0, left);
    assert!(response.shear[0][0] < 0.5 * fluid.storage_modulus(2.0));
    assert!(1e-3 * response.shear[0][1].abs() < response.shear[1][0].abs().max(response.shear[1][1].abs()));
    assert!(0.0 < response.first_normal[0][1]);
}

#[test]
fn motions_followed_by_integration_equal_the_exact_ones() {
    let fluid = Modes::new(vec![
        OldroydB::new(0.25, 1.5, 0.75).expect("bounds"),
        OldroydB::new(0.0, 0.5, 4.0).expect("bounds"),
    ])
    .expect("modes");
    let l = [[0.25, -0.1, 0.05], [0.3, -0.15, 0.1], [-0.2, 0.4, -0.1]];
    let times = [0.1, 1.0, 2.5];
    let followed = follow(&fluid, |_| l, &times, 1e-12).expect("runs");
    let l = VelocityGradient::from_rows(l).expect("finite");
    for (stress, time) in followed.iter().zip(times) {
        let exact = fluid.start_up_stress(&l, time).expect("bounded");
        let tolerance = Tol::stated(1e-10, "tolerance 1e-12 of each step");
        assert_close("follow", &stress.components, &exact.components, tolerance);
    }
    // In two pieces: the memory carries over.
    let mut memory = vec![Symmetric::zero(); 2];
    fluid.advance(&mut memory, &l, 1.0).expect("bounded");
    fluid.advance(&mut memory, &l, 1.5).expect("bounded");
    let exact = fluid.start_up_stress(&l, 2.5).expect("bounded") - l.rate_of_deformation().0 * 0.5;
    assert_close("pieces", &(memory[0] + memory[1]).components, &exact.components, Tol::ulps(64.0));
    assert!(follow_shear(&fluid, |_| 1.0, &[1.0, 0.5], 1e-9).is_err());
    assert!(follow_shear(&fluid, |_| f64::NAN, &[1.0], 1e-9).is_err());
}

#[test]
fn motions_followed_through_samples_equal_the_exact_ones() {
    let fluid = OldroydB::new(0.0, 1.5, 0.75).expect("bounds");
    let l = VelocityGradient::from_rows([[0.25, -0.1, 0.05], [0.3, -0.15, 0.1], [-0.2, 0.4, -0.1]]).expect("finite");
    let at = |time: f64| {
        (time, DeformationGradient::from_rows(exponential_rows(scaled(l.rows(), time))).expect("det F > 0"))
    };
    let mut memory = [Symmetric::zero()];
    fluid.advance_through(&mut memory, &[0.0, 0.1, 0.7, 0.9, 2.5].map(at)).expect("bounded");
    let exact = fluid.start_up_stress(&l, 2.5).expect("bounded");
    assert_close("samples", &memory[0].components, &exact.components, CLOSED);
    assert!(fluid.advance_through(&mut memory, &[at(1.0), at(1.0)]).is_err());
}

#[test]
fn start_up_of_nonlinear_fluids_ends_in_their_steady_state() {
    struct Check;
    impl Visit for Check {
        fn fluid<F: DifferentialFluid<Mode = F> + StressRate>(&mut self, fluid: &F) {
            let end = follow_shear(fluid, |_| 6.0, &[40.0], 1e-11).expect("runs")[0];
            let tolerance = Tol::stated(1e-8, "tolerance 1e-11 of each of many steps");
            let expected = [
                fluid.shear_stress(6.0),
                fluid.first_normal_stress_difference(6.0),
                fluid.second_normal_stress_difference(6.0),
            ];
            assert_close(F::NAME, &[end.shear, end.first, end.second], &expected, tolerance);
        }
    }
    for name in ["giesekus", "linear", "exponential"] {
        with_fluid(name, 0.25, &mut Check);
    }
}

#[test]
fn moments_without_solvent_equal_those_of_the_rate() {
    let fluid = LinearPhanThienTanner::new(0.0, 3.0, 1.0, 0.5).expect("bounds");
    // ζ = s/3 + s³/27.
    let moment = fluid.flow_moment(FlowMoment::First, 0.0, 3.0).expect("closed");
    assert_close("∫ s ζ", &[moment], &[3.0 + 9.0 / 5.0], Tol::ulps(4.0));
    assert!(linear(0.25).flow_moment(FlowMoment::First, 0.0, 3.0).is_none());
}

#[test]
fn lanes_equal_scalars() {
    struct Check;
    impl Visit for Check {
        fn fluid<F: DifferentialFluid<Mode = F> + StressRate>(&mut self, fluid: &F) {
            let ks = [0.0, -1e-8, 3.0, 1e8];
            let lanes = Lanes::<f64, 4>::from(ks);
            let found = [fluid.shear_stress(lanes), fluid.sigma1(lanes), fluid.sigma2(lanes)];
            let rate = fluid.shear_rate(found[0]).expect("rates");
            for (lane, &k) in ks.iter().enumerate() {
                let scalar = [fluid.shear_stress(k), fluid.sigma1(k), fluid.sigma2(k)];
                for (found, scalar) in found.iter().zip(scalar) {
                    assert_close(F::NAME, &[found.primal(lane)], &[scalar], Tol::ulps(32.0));
                }
                assert_close(
                    F::NAME,
                    &[rate.primal(lane)],
                    &[k],
                    Tol::ulps_because(128.0, "an inverse by elementary functions of lanes"),
                );
            }
        }
    }
    for name in ["giesekus", "linear", "exponential"] {
        with_fluid(name, 0.25, &mut Check);
    }
}

const TURNED: Tol = Tol::ulps_because(256.0, "an exponential, three products and two rotations");

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn steady_states_satisfy_the_equations(log in -8.0..6.0_f64, parameter in 0.01..0.5_f64) {
        for name in ["giesekus", "linear", "exponential"] {
            with_fluid(name, parameter, &mut Steady(10.0_f64.powf(log)));
        }
    }

    #[test]
    fn rate_at_the_stress_of_a_rate_is_the_rate(log in -8.0..8.0_f64, parameter in 0.01..0.5_f64) {
        struct Check(f64);
        impl Visit for Check {
            fn fluid<F: DifferentialFluid<Mode = F> + StressRate>(&mut self, fluid: &F) {
                let stress = fluid.shear_stress(Dual::variable(self.0));
                let slope = self.0 * stress.tangent / stress.value;
                let tolerance = Tol::ulps(64.0).times(slope.recip().max(1.0));
                let rate = fluid.shear_rate(stress).expect("a rate");
                assert_close(F::NAME, &[rate.value], &[self.0], tolerance);
                assert_close(F::NAME, &[rate.tangent], &[1.0], tolerance.times(16.0));
            }
        }
        for name in ["giesekus", "linear", "exponential"] {
            with_fluid(name, parameter, &mut Check(10.0_f64.powf(log)));
        }
    }

    #[test]
    fn rate_of_stress_seen_by_a_turning_observer_is_the_turned_rate(
        entries in strategies::vector(15, -2.0..2.0), q in strategies::rotation(), spin in strategies::vector(3, -2.0..2.0),
    ) {
        struct Check<'a>(&'a [f64], Matrix3<f64>, nalgebra::Vector3<f64>);
        impl Visit for Check<'_> {
            fn fluid<F: DifferentialFluid<Mode = F> + StressRate>(&mut self, fluid: &F) {
                let Self(entries, q, spin) = self;
                let l = VelocityGradient::new(Matrix3::from_row_slice(&entries[..9])).expect("finite");
                let stress = Symmetric { components: core::array::from_fn(|i| entries[9 + i]) };
                let turned = stress.rotated(q).expect("a rotation");
                let rate = fluid.stress_rate(&stress, &l).matrix();
                let omega = spin.cross_matrix();
                let expected = *q * rate * q.transpose() + omega * turned.matrix() - turned.matrix() * omega;
                let seen = fluid.stress_rate(&turned, &l.seen_from(q, spin)).matrix();
                let tolerance = Tol::ulps_because(256.0, "three products of matrices of entries up to 4");
                assert_close_at_scale(F::NAME, seen.as_slice(), expected.as_slice(), 1.0, tolerance);
            }
        }
        let r = strategies::rotation_matrix(q);
        let (rotation, spin) = (Matrix3::from_fn(|i, j| r[i][j]), nalgebra::Vector3::from_column_slice(&spin));
        for name in ["giesekus", "linear", "exponential"] {
            with_fluid(name, 0.3, &mut Check(&entries, rotation, spin));
        }
    }

    #[test]
    fn start_up_stress_seen_from_turned_axes_is_the_turned_stress(
        entries in strategies::vector(9, -1.0..1.0), q in strategies::rotation(), time in 0.01..4.0_f64,
    ) {
        let fluid = OldroydB::new(0.25, 1.5, 0.75).expect("bounds");
        let l = VelocityGradient::new(Matrix3::from_row_slice(&entries)).expect("finite");
        let r = strategies::rotation_matrix(q);
        let rotation = Matrix3::from_fn(|i, j| r[i][j]);
        let stress = fluid.start_up_stress(&l, time).expect("bounded").matrix();
        let turned = l.seen_from(&rotation, &nalgebra::Vector3::zeros());
        let seen = fluid.start_up_stress(&turned, time).expect("bounded").matrix();
        let error = (seen - rotation * stress * rotation.transpose()).norm();
        let amplification = (2.0 * time * l.0.norm()).exp().min(1e6);
        prop_assert!(error <= TURNED.value() * (stress.norm() + amplification), "{error:e} of {}", stress.norm());
    }
}
