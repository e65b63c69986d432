//! Steady states of differential fluids at any velocity gradient, with and without slip: against closed forms, the equation,
//! long motions, difference quotients.

use nalgebra::Matrix3;
use piola_continuum::Symmetric;
use piola_continuum::rates::VelocityGradient;
use piola_fluids::{
    DifferentialFluid, ExponentialPhanThienTanner, Extension, FluidsError, Following, Giesekus, LinearPhanThienTanner,
    Modes, OldroydB, Slipping, SteadyStress, StressRate, UpperConvectedMaxwell, ViscometricFluid,
};
use piola_numerics::{Dual, Lanes, Real};
use piola_testkit::strategies::random_cases;
use piola_testkit::{Tol, assert_close, assert_close_at_scale, strategies};
use proptest::prelude::*;

/// What is done with a fluid of any type.
trait Visit {
    fn fluid<F: DifferentialFluid<Mode = F> + StressRate + core::fmt::Debug>(&mut self, fluid: &F);
}

fn oldroyd() -> OldroydB {
    OldroydB::new(0.125, 2.0, 0.5).expect("bounds")
}
fn linear(extensibility: f64) -> LinearPhanThienTanner {
    LinearPhanThienTanner::new(0.125, 2.0, 0.5, extensibility).expect("bounds")
}
fn exponential(extensibility: f64) -> ExponentialPhanThienTanner {
    ExponentialPhanThienTanner::new(0.125, 2.0, 0.5, extensibility).expect("bounds")
}

/// One fluid of each kind that has a steady state in every flow; then those that have none in a strong extension.
fn each(visit: &mut impl Visit, parameter: f64, slip: f64) {
    visit.fluid(&Giesekus::new(0.125, 2.0, 0.5, parameter).expect("bounds"));
    visit.fluid(&linear(parameter));
    visit.fluid(&exponential(parameter));
    visit.fluid(&Slipping::new(linear(parameter), slip).expect("bounds"));
    visit.fluid(&Slipping::new(exponential(parameter), slip).expect("bounds"));
}
fn each_unbounded(visit: &mut impl Visit, slip: f64) {
    visit.fluid(&UpperConvectedMaxwell::new(2.0, 0.5).expect("bounds"));
    visit.fluid(&oldroyd());
    visit.fluid(&Giesekus::new(0.125, 2.0, 0.5, 0.0).expect("bounds"));
    visit.fluid(&linear(0.0));
    visit.fluid(&exponential(0.0));
    visit.fluid(&Slipping::new(oldroyd(), slip).expect("bounds"));
}

fn shear<T: Real>(k: T) -> VelocityGradient<T> {
    let zero = T::zero();
    VelocityGradient::from_rows([[zero; 3], [k, zero, zero], [zero; 3]]).expect("finite")
}

fn diagonal(rates: [f64; 3]) -> VelocityGradient {
    VelocityGradient::from_rows([[rates[0], 0.0, 0.0], [0.0, rates[1], 0.0], [0.0, 0.0, rates[2]]]).expect("finite")
}

struct Shear(f64);
impl Visit for Shear {
    fn fluid<F: DifferentialFluid<Mode = F> + StressRate + core::fmt::Debug>(&mut self, fluid: &F) {
        let k = self.0;
        let what = format!("{fluid:?} at {k:e}");
        let found = fluid.steady_stress(&shear(Dual::variable(k)));
        let stress = found.unwrap_or_else(|error| panic!("{what}: {error}"));
        let [t11, t22, t33, t12, t23, t13] = stress.components;
        let functions = [
            fluid.shear_stress(Dual::variable(k)),
            fluid.first_normal_stress_difference(Dual::variable(k)),
            fluid.second_normal_stress_difference(Dual::variable(k)),
        ];
        let tolerance = Tol::stated(1e-13, "six balanced equations");
        for (found, function) in [t12, t22 - t11, t11 - t33].into_iter().zip(functions) {
            // Of N₂ in slow flow the difference of two stresses of its own order.
            let scale = 1e-3 * functions[1].value.abs();
            assert_close_at_scale(&what, &[found.value], &[function.value], scale, tolerance);
            let scale = 1e-3 * functions[1].tangent.abs().max(functions[1].value / k.abs().max(1e-300));
            // Where the stress levels off its slope is a difference of slopes that are 10³ and more times as large.
            assert_close_at_scale(&what, &[found.tangent], &[function.tangent], scale, tolerance.times(1e4));
        }
        let across = [t23.value, t13.value, t33.value];
        assert_close_at_scale(&what, &across, &[0.0; 3], t12.value.abs(), Tol::ulps(4.0));
    }
}

struct Stretch(f64);
impl Visit for Stretch {
    fn fluid<F: DifferentialFluid<Mode = F> + StressRate + core::fmt::Debug>(&mut self, fluid: &F) {
        for extension in [Extension::Uniaxial, Extension::Planar, Extension::Biaxial] {
            for rate in [self.0, -self.0] {
                let rates = extension.rates(rate);
                let what = format!("{fluid:?}, {extension:?} at {rate:e}");
                let found = fluid.steady_stress(&diagonal(rates)).unwrap_or_else(|error| panic!("{what}: {error}"));
                let expected = Symmetric::diagonal(fluid.extensional_stress(rates).expect("bounded"));
                let tolerance = Tol::stated(1e-13, "six balanced equations");
                // An exponential knows the trace to an ulp of it; of two equal stresses each is known to what rounding of L does
                // to them: f is near the pole of both.
                let strong = 1.0 + found.norm() * fluid.time() / fluid.polymer_viscosity();
                let close = tolerance.times(1.0 + strong.ln());
                assert_close_at_scale(&what, &[found.trace()], &[expected.trace()], expected.norm(), close);
                assert_close(&what, &found.components, &expected.components, close.or(Tol::ulps(4.0).times(strong)));
            }
        }
    }
}

/// A network that hardly draws: beside the steady state there is one whose network would not be stretched but turned
/// inside out, by less than rounding of L less ξ D.
#[test]
fn networks_that_slip_almost_wholly_have_the_state_of_the_functions_in_fast_extension() {
    each(&mut Stretch(5.967_481_545_884_967_6e4), 0.367_922_267_584_377_6, 0.999_307_588_373_359_2);
}

#[test]
fn steady_states_of_fluids_without_limit_end_at_the_limit() {
    struct Check;
    impl Visit for Check {
        fn fluid<F: DifferentialFluid<Mode = F> + StressRate + core::fmt::Debug>(&mut self, fluid: &F) {
            // 2 (1 − ξ) λ ε̇ = 1.
            let limit = 1.0 / (1.0 - fluid.slip());
            for share in [1e-8, 0.5, 0.999] {
                Stretch(0.4 * share * limit).fluid(fluid);
                let l = diagonal(Extension::Uniaxial.rates(share * limit));
                assert!(fluid.steady_stress(&l).is_ok(), "{fluid:?} at {share}");
            }
            for share in [1.0, 1.001, 2.0, 1e8] {
                let l = diagonal(Extension::Uniaxial.rates(share * limit));
                let error = fluid.steady_stress(&l).expect_err("2 λ ε̇ ≥ 1");
                let FluidsError::BeyondLimit { value, limit: allowed, .. } = error else { panic!("{error}") };
                // From 2 (1 − ξ) λ ε̇, what stretches the stress, to 2 λ |D| with |D|² = 3/2 ε̇²; here 2 λ = 1.
                let rounding = Tol::ulps(4.0).value();
                assert!(allowed.to_bits() == 1.0_f64.to_bits() && share * (1.0 - rounding) <= value, "{error}");
                assert!(value <= share * limit * 1.5_f64.sqrt() * (1.0 + rounding), "{error}");
            }
        }
    }
    each_unbounded(&mut Check, 0.25);
}

#[test]
fn steady_stresses_in_shear_and_extension_equal_their_closed_forms_at_extreme_rates() {
    for k in [0.0, 1e-8, 1e-3, 0.7, -3.0, 1e2, 1e5, -1e8] {
        each(&mut Shear(k), 0.25, 0.2);
        each(&mut Shear(k), 0.01, 1e-3);
        each_unbounded(&mut Shear(k), 0.25);
    }
    for rate in [1e-8, 0.7, 30.0, 1e4, 1e8] {
        each(&mut Stretch(rate), 0.25, 0.2);
        each(&mut Stretch(rate), 0.01, 1e-3);
    }
}

#[test]
fn slipping_networks_without_slip_equal_the_networks() {
    let network = linear(0.25);
    let none = Slipping::new(network, 0.0).expect("bounds");
    let nearly = Slipping::new(network, 1e-12).expect("bounds");
    for k in [0.0, 1e-8, -0.3, 5.0, 1e3, 1e8] {
        let expected = [network.shear_stress(k), network.sigma1(k), network.sigma2(k), network.viscosity(k)];
        let found = [none.shear_stress(k), none.sigma1(k), none.sigma2(k), none.viscosity(k)];
        let near = [nearly.shear_stress(k), 0.0, nearly.sigma2(k), nearly.viscosity(k)];
        // x³ ≤ λ k/2 ε in 1 + q x².
        let tolerance = Tol::stated(1e-11, "q = 2e-12").times(1.0 + (k * k).cbrt());
        for i in 0..4 {
            assert_close("ξ = 0", &[found[i]], &[expected[i]], Tol::ulps(16.0));
            assert_close("ξ → 0", &[near[i]], &[expected[i]], tolerance);
        }
    }
    assert!(Slipping::new(network, -0.1).is_err());
    assert!(Slipping::new(network, 1.1).is_err());
    assert!(Slipping::new(network, f64::NAN).is_err());
}

#[test]
fn slipping_fluids_in_shear_equal_their_formulas_over_lanes_and_duals() {
    // Johnson and Segalman: x = λ k.
    let fluid = Slipping::new(oldroyd(), 0.25).expect("bounds");
    let ks = [0.0, -1e-8, 3.0, 1e8];
    let lanes =
        [fluid.shear_stress(Lanes::<f64, 4>::from(ks)), fluid.sigma1(Lanes::from(ks)), fluid.sigma2(Lanes::from(ks))];
    for (lane, k) in ks.into_iter().enumerate() {
        let (x, q) = (0.5 * k, 0.25 * 1.75);
        let expected = 0.125 * k + 4.0 * x / (1.0 + q * x * x);
        let first = 8.0 * x * x / (1.0 + q * x * x);
        assert_close("T₁₂", &[fluid.shear_stress(k)], &[expected], Tol::ulps(16.0));
        assert_close("N₁", &[fluid.first_normal_stress_difference(k)], &[first], Tol::ulps(16.0));
        assert_close("N₂", &[fluid.second_normal_stress_difference(k)], &[-0.125 * first], Tol::ulps(16.0));
        let scalars = [fluid.shear_stress(k), fluid.sigma1(k), fluid.sigma2(k)];
        for (lanes, scalar) in lanes.iter().zip(scalars) {
            assert_close("lanes", &[lanes.primal(lane)], &[scalar], Tol::ulps(32.0));
        }
    }
    assert_close("η₀", &[fluid.viscosity(0.0)], &[2.125], Tol::ulps(4.0));
    // Without solvent the stress rises to (ηₚ/λ)/(2 √q) and no further.
    let melt = Slipping::new(linear_melt(), 0.5).expect("bounds");
    let k = melt.shear_rate(0.9 * 4.0 / (2.0 * 0.75_f64.sqrt())).expect("below the maximum");
    assert_close("τ(ζ)", &[melt.shear_stress(k)], &[0.9 * 4.0 / (2.0 * 0.75_f64.sqrt())], Tol::ulps(64.0));
    assert!(melt.shear_rate(1.01 * 4.0 / (2.0 * 0.75_f64.sqrt())).is_err());
}

fn linear_melt() -> LinearPhanThienTanner {
    LinearPhanThienTanner::new(0.0, 2.0, 0.5, 0.1).expect("bounds")
}

#[test]
fn modes_side_by_side_have_the_sum_of_their_steady_stresses() {
    let (a, b) = (exponential(0.2), ExponentialPhanThienTanner::new(0.0, 5.0, 20.0, 0.05).expect("bounds"));
    let both = Modes::new(vec![a, b]).expect("modes");
    let l = VelocityGradient::from_rows([[0.5, 0.3, -1.5], [2.9, -0.75, -1.4], [2.2, 0.3, 0.25]]).expect("finite");
    let sum = a.steady_stress(&l).expect("bounded") + b.steady_stress(&l).expect("bounded");
    assert_close("sum", &both.steady_stress(&l).expect("bounded").components, &sum.components, Tol::ulps(8.0));
}

/// The equation holds, the conformation is positive definite, turned axes turn the stress, derivatives are difference quotients.
struct General<'a>(&'a VelocityGradient, Matrix3<f64>, Matrix3<f64>);
impl Visit for General<'_> {
    fn fluid<F: DifferentialFluid<Mode = F> + StressRate + core::fmt::Debug>(&mut self, fluid: &F) {
        let Self(l, turn, direction) = self;
        let what = format!("{fluid:?} at {:?}", l.rows());
        let stress = fluid.steady_stress(l).unwrap_or_else(|error| panic!("{what}: {error}"));
        let polymer = stress - l.rate_of_deformation().0 * (2.0 * fluid.solvent_viscosity());
        let scale = fluid.relaxing(&polymer).norm() / fluid.time() + 2.0 * l.0.norm() * polymer.norm();
        let rate = fluid.stress_rate(&polymer, l).components;
        assert_close_at_scale(
            &what,
            &rate,
            &[0.0; 6],
            scale,
            Tol::ulps_because(512.0, "six balanced equations by elimination, and their left side"),
        );
        let turned = VelocityGradient::new(*turn * l.0 * turn.transpose()).expect("finite");
        let seen = fluid.steady_stress(&turned).expect("as before").matrix();
        let expected = *turn * stress.matrix() * turn.transpose();
        // How far rounding of L moves a steady state: a large one is one near its limit.
        let strong = 1.0 + polymer.norm() * fluid.time() / fluid.polymer_viscosity();
        assert_close(
            &what,
            seen.as_slice(),
            expected.as_slice(),
            Tol::ulps_because(256.0, "six balanced equations by elimination, and two rotations").times(strong),
        );
        let along = VelocityGradient(l.0.zip_map(direction, Dual::new));
        let derivative = fluid.steady_stress(&along).expect("as before").components.map(|x| x.tangent);
        let h = 1e-3 / strong;
        let at = |steps: f64| {
            fluid.steady_stress(&VelocityGradient(l.0 + *direction * (steps * h))).expect("near").components
        };
        let [a, b, c, d] = [at(1.0), at(-1.0), at(2.0), at(-2.0)];
        let quotient: [f64; 6] = core::array::from_fn(|i| (8.0 * (a[i] - b[i]) - (c[i] - d[i])) / (12.0 * h));
        let tolerance = Tol::stated(1e-8, "h⁴ and ulp/h").times(strong);
        assert_close(&what, &derivative, &quotient, tolerance);
    }
}

/// There is a steady state, and the equation holds in it.
struct Any<'a>(&'a VelocityGradient);
impl Visit for Any<'_> {
    fn fluid<F: DifferentialFluid<Mode = F> + StressRate + core::fmt::Debug>(&mut self, fluid: &F) {
        let l = self.0;
        let what = format!("{fluid:?} at {:?}", l.rows());
        let stress = fluid.steady_stress(l).unwrap_or_else(|error| panic!("{what}: {error}"));
        let polymer = stress - l.rate_of_deformation().0 * (2.0 * fluid.solvent_viscosity());
        let scale = fluid.relaxing(&polymer).norm() / fluid.time() + 2.0 * l.0.norm() * polymer.norm();
        let rate = fluid.stress_rate(&polymer, l).components;
        // Of the whole the polymer's part is a difference, and an exponential of it is relaxing.
        let trace = polymer.norm() * fluid.time() / fluid.polymer_viscosity();
        let share = 1.0 + stress.norm() / polymer.norm() + trace;
        assert_close_at_scale(
            &what,
            &rate,
            &[0.0; 6],
            scale,
            Tol::ulps_because(512.0, "six balanced equations by elimination, and their left side").times(share),
        );
    }
}

struct Long<'a>(&'a VelocityGradient);
impl Visit for Long<'_> {
    fn fluid<F: DifferentialFluid<Mode = F> + StressRate + core::fmt::Debug>(&mut self, fluid: &F) {
        let rows = self.0.rows();
        let mut motion = Following::from_rest(fluid, 1e-10).expect("a tolerance");
        let end = motion.advance(|_| rows, 60.0 * fluid.time()).expect("runs");
        let steady = fluid.steady_stress(self.0).expect("bounded");
        let tolerance = Tol::stated(1e-7, "tolerance 1e-10 of each of many steps");
        assert_close(&format!("{fluid:?} at {rows:?}"), &end.components, &steady.components, tolerance);
        let mut still = Following::from_steady(fluid, self.0, 1e-10).expect("bounded");
        let same = still.advance(|_| rows, fluid.time()).expect("runs");
        assert_close("from the steady state", &same.components, &steady.components, tolerance);
    }
}

fn isochoric(entries: &[f64]) -> VelocityGradient {
    let mut l = Matrix3::from_row_slice(entries);
    let third = l.trace() / 3.0;
    for i in 0..3 {
        l[(i, i)] -= third;
    }
    VelocityGradient::new(l).expect("finite")
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(1_000)))]

    #[test]
    fn steady_stresses_satisfy_the_equation_for_all_observers_with_exact_derivatives(
        entries in strategies::vector(9, -1.0..1.0), log in -3.0..1.5_f64, q in strategies::rotation(),
        along in strategies::vector(9, -1.0..1.0), parameter in 0.02..0.5_f64, slip in 0.0..1.0_f64,
    ) {
        let size = 10.0_f64.powf(log);
        let l = isochoric(&entries.iter().map(|x| x * size).collect::<Vec<_>>());
        let r = strategies::rotation_matrix(q);
        let direction = isochoric(&along).0;
        each(&mut General(&l, Matrix3::from_fn(|i, j| r[i][j]), direction), parameter, slip);
    }

    #[test]
    fn steady_stresses_in_shear_equal_the_viscometric_functions(
        log in -8.0..8.0_f64, parameter in 0.01..0.5_f64, slip in 0.0..1.0_f64,
    ) {
        each(&mut Shear(10.0_f64.powf(log)), parameter, slip);
        each_unbounded(&mut Shear(-10.0_f64.powf(log)), slip);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn steady_states_of_limited_fluids_satisfy_the_equation_at_every_rate(
        entries in strategies::vector(9, -1.0..1.0), log in -8.0..8.0_f64, parameter in 0.02..0.5_f64, slip in 0.0..0.9_f64,
    ) {
        let size = 10.0_f64.powf(log);
        let l = isochoric(&entries.iter().map(|x| x * size).collect::<Vec<_>>());
        each(&mut Any(&l), parameter, slip);
    }

    #[test]
    fn steady_stresses_in_extension_equal_the_extensional_stresses(
        log in -8.0..8.0_f64, parameter in 0.01..0.5_f64, slip in 0.0..1.0_f64,
    ) {
        each(&mut Stretch(10.0_f64.powf(log)), parameter, slip);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn steady_stresses_equal_those_after_long_motions(
        entries in strategies::vector(9, -3.0..3.0), parameter in 0.1..0.5_f64, slip in 0.0..0.9_f64,
    ) {
        each(&mut Long(&isochoric(&entries)), parameter, slip);
    }
}
