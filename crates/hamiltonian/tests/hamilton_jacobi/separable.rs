//! Separable systems: reference values, and motions by quadratures against motions by integration.

use piola_hamiltonian::PhaseFunction;
use piola_hamiltonian::hamilton_jacobi::{
    FixedCentres, KeplerParabolic, KeplerPolar, RayField, Separable, SeparableMotion,
};
use piola_hamiltonian::{HamiltonJacobiError, HamiltonianError};
use piola_integrators::{DormandPrince853, State, Tolerance};
use piola_numerics::Real;
use piola_testkit::golden::{self, number, text};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use proptest::prelude::*;

const PI: f64 = core::f64::consts::PI;

/// p² = 2mE − m²ω²q².
#[derive(Debug)]
struct Oscillator {
    mass: f64,
    omega: f64,
}

impl Separable for Oscillator {
    fn freedom(&self) -> usize {
        1
    }
    fn square<T: Real>(&self, _coordinate: usize, x: T, c: &[T]) -> T {
        let stiffness = self.mass * self.omega;
        T::lit(2.0 * self.mass) * c[0] - T::lit(stiffness * stiffness) * x * x
    }
    fn constants(&self, q: &[f64], p: &[f64], constants: &mut [f64]) {
        let stiffness = self.mass * self.omega * self.omega;
        constants[0] = 0.5 * (p[0] * p[0] / self.mass + stiffness * q[0] * q[0]);
    }
}

fn tolerance() -> Tol {
    Tol::stated(1e-12, "quadratures to 1e-13")
}

#[test]
fn radial_action_of_kepler_and_its_derivatives() {
    let golden = golden::load("hamilton_jacobi");
    let case = golden.cases.iter().find(|case| text(&case["kind"]) == "complete_integral_kepler_radial").unwrap();
    let of = |key: &str| number(&case["parameters"][key]);
    let (mass, strength, energy, moment) = (of("m"), of("k"), of("E"), of("L"));
    let kepler = KeplerPolar { mass, strength };
    let radial = (2.0 * mass * (energy + strength) - moment * moment).sqrt();
    let motion = SeparableMotion::through(&kepler, (&[1.0, 0.0], &[radial, moment], 0.0)).unwrap();
    let (Some(low), Some(high)) = motion.turning_points(0) else { panic!("an ellipse has two") };
    assert_close("r", &[low, high], &[number(&case["r_min"]), number(&case["r_max"])], Tol::ulps(32.0));
    let whole = motion.loop_integral(0).unwrap().unwrap();
    assert_close("∮ p_r dr", &[whole], &[number(&case["loop_integral_p_r_dr"])], tolerance());
    for point in case["points"].as_array().unwrap() {
        let part = motion.integral(0, (low, number(&point["r"]))).unwrap();
        assert_close("S_r", &[part.action], &[number(&point["S_r"])], tolerance());
        let expected = [number(&point["dS_dE"]), number(&point["dS_dL"])];
        assert_close("∂S/∂(E, L)", &part.by_constants, &expected, tolerance());
    }
}

#[test]
fn action_of_the_oscillator_and_its_derivative() {
    let golden = golden::load("hamilton_jacobi");
    let case = golden.cases.iter().find(|case| text(&case["kind"]) == "complete_integral_oscillator").unwrap();
    let of = |key: &str| number(&case["parameters"][key]);
    let (mass, omega, energy) = (of("m"), of("omega"), of("E"));
    let oscillator = Oscillator { mass, omega };
    let motion = SeparableMotion::through(&oscillator, (&[0.0], &[(2.0 * mass * energy).sqrt()], 0.0)).unwrap();
    assert_close(
        "∮ p dq",
        &[motion.loop_integral(0).unwrap().unwrap()],
        &[number(&case["loop_integral_p_dq"])],
        tolerance(),
    );
    for point in case["points"].as_array().unwrap() {
        let part = motion.integral(0, (0.0, number(&point["q"]))).unwrap();
        assert_close("S", &[part.action], &[number(&point["S"])], tolerance());
        assert_close("∂S/∂E", &part.by_constants, &[number(&point["dS_dE"])], tolerance());
    }
}

/// The motion by quadratures against that by integration, at several times.
fn compare<S: Separable + PhaseFunction>(system: &S, q: [f64; 2], p: [f64; 2], times: &[f64], stated: f64) {
    let motion = SeparableMotion::through(system, (&q, &p, 0.25)).unwrap();
    for &time in times {
        let (by_q, by_p) = motion.at(time).unwrap();
        let mut state = State::new(0.25, vec![q[0], q[1], p[0], p[1], 0.0]).unwrap();
        DormandPrince853::new(Tolerance::relative(1e-13).unwrap())
            .integrate_to(&mut RayField::new(system, 2, 0), &mut state, time)
            .unwrap();
        let tolerance = Tol::stated(stated, "integration with the relative tolerance 1e-13, spread along the way");
        assert_close_at_scale(&format!("q({time})"), &by_q, &state.values[..2], 1.0, tolerance);
        assert_close_at_scale(&format!("p({time})"), &by_p, &state.values[2..4], 1.0, tolerance);
    }
}

#[test]
fn two_fixed_centres_by_quadratures_and_by_integration() {
    let centres = FixedCentres { mass: 1.5, strengths: [1.0, 0.75], half_distance: 1.0 };
    // Around both centres, around one, and a passage to infinity.
    compare(&centres, [0.9, 0.4], [0.1, 1.6], &[0.75, 3.0, 12.0, -4.0], 1e-8);
    compare(&centres, [0.3, 0.5], [0.2, 0.1], &[0.75, -1.0], 1e-8);
    compare(&centres, [0.9, 0.4], [2.5, 1.6], &[0.75, 3.0, 12.0], 1e-8);
}

#[test]
fn quadratures_do_not_feel_a_close_encounter_with_a_centre() {
    // At t = 2 after an approach to within 3e-6 c, where integration in time has lost four digits. Reference: the
    // separated equations μ″ = R_μ′/2, ν″ = R_ν′/2 in the time dτ = dt/(mc²(cosh²μ − cos²ν)), at thirty digits.
    let centres = FixedCentres { mass: 1.5, strengths: [1.0, 0.75], half_distance: 1.0 };
    let motion = SeparableMotion::through(&centres, (&[0.3, 0.5], &[0.2, 0.1], 0.25)).unwrap();
    let (q, p) = motion.at(2.0).unwrap();
    let tolerance = Tol::stated(1e-11, "quadratures to 1e-13 over three revolutions");
    assert_close("q", &q, &[-0.288_983_638_381_688, -0.480_148_107_694_241_5], tolerance);
    assert_close("p", &p, &[0.390_585_279_270_189_5, 0.573_229_700_305_857_5], tolerance);
}

#[test]
fn kepler_is_one_problem_in_polar_and_parabolic_coordinates() {
    // x = (ξ² − η²)/2, y = ξη: p_ξ = ξ p_x + η p_y, p_η = ξ p_y − η p_x.
    let (mass, strength) = (1.5, 2.0);
    let (xi, eta, px, py) = (1.2, 0.7, -0.4, 1.1);
    let (x, y) = (0.5 * (xi * xi - eta * eta), xi * eta);
    let r = f64::hypot(x, y);
    let polar = KeplerPolar { mass, strength };
    let parabolic = KeplerParabolic { mass, strength };
    let state: (&[f64], &[f64], f64) = (&[xi, eta], &[xi * px + eta * py, xi * py - eta * px], 0.0);
    let a = SeparableMotion::through(&parabolic, state).unwrap();
    let state: (&[f64], &[f64], f64) = (&[r, y.atan2(x)], &[(x * px + y * py) / r, x * py - y * px], 0.0);
    let b = SeparableMotion::through(&polar, state).unwrap();
    assert_close("E", &a.constants()[..1], &b.constants()[..1], Tol::ulps(16.0));
    for time in [0.5, 3.0, 20.0] {
        let ((s, _), (t, _)) = (a.at(time).unwrap(), b.at(time).unwrap());
        let (first, second) =
            ([0.5 * (s[0] * s[0] - s[1] * s[1]), s[0] * s[1]], [t[0] * t[1].cos(), t[0] * t[1].sin()]);
        assert_close("(x, y)", &first, &second, Tol::stated(1e-10, "two sets of quadratures"));
    }
}

/// p² = 2(E + cos(q/a)): wells of the width 2πa, one beside the other.
struct Corrugated(f64);

impl Separable for Corrugated {
    fn freedom(&self) -> usize {
        1
    }
    fn square<T: Real>(&self, _coordinate: usize, x: T, c: &[T]) -> T {
        T::lit(2.0) * (c[0] + (x / T::lit(self.0)).cos())
    }
    fn constants(&self, q: &[f64], p: &[f64], constants: &mut [f64]) {
        constants[0] = 0.5 * p[0] * p[0] - (q[0] / self.0).cos();
    }
}

/// Within ±a arccos(−E) about the bottom of a well, however narrow the wells are.
#[test]
fn turning_points_are_those_of_the_well_in_which_the_motion_is() {
    let mut compared = 0;
    for pitch in [1e-5, 1e-3, 1.0, 1e3] {
        for energy in [-0.5, 0.0, 0.5] {
            let p = (2.0 * (energy + 1.0_f64)).sqrt();
            let wells = Corrugated(pitch);
            let motion = SeparableMotion::through(&wells, (&[0.0], &[p], 0.0)).unwrap();
            let (Some(low), Some(high)) = motion.turning_points(0) else { panic!("a well has two") };
            let expected = pitch * (-energy).acos();
            assert_close("q", &[low, high], &[-expected, expected], Tol::ulps(16.0));
            compared += 1;
        }
    }
    assert_eq!(compared, 12);
}

/// The first step of the search was once as long as a well, where the well is a thousand wells from the origin.
#[test]
fn turning_points_are_those_of_wells_far_from_the_origin() {
    let mut compared = 0;
    for pitch in [1e-3, 1.0, 1e3] {
        for well in [-1000.0, 37.0, 1000.0, 12_345.0] {
            for energy in [-0.9, -0.5, 0.0, 0.5, 0.99_f64] {
                // From the bottom of the well, its slopes, and near its turning points.
                for part in [-0.999, -0.5, 0.0, 0.3, 0.9] {
                    let half_width = pitch * (-energy).acos();
                    let bottom = 2.0 * PI * well * pitch;
                    let q = bottom + part * half_width;
                    let p = (2.0 * (energy + (q / pitch).cos())).sqrt();
                    let wells = Corrugated(pitch);
                    let motion = SeparableMotion::through(&wells, (&[q], &[p], 0.0)).unwrap();
                    let (Some(low), Some(high)) = motion.turning_points(0) else { panic!("a well has two") };
                    let expected = [bottom - half_width, bottom + half_width];
                    assert_close("q", &[low, high], &expected, Tol::ulps(64.0));
                    compared += 1;
                }
            }
        }
    }
    assert_eq!(compared, 300);
}

#[test]
fn circular_orbits_and_forbidden_places() {
    let kepler = KeplerPolar { mass: 1.0, strength: 1.0 };
    let circle = SeparableMotion::through(&kepler, (&[1.0, 0.0], &[0.0, 1.0], 0.0)).unwrap();
    let (q, _) = circle.at(2.0 * PI).unwrap();
    assert_close("once around", &q, &[1.0, 2.0 * PI], Tol::stated(1e-7, "a double turning point is found to √ulp"));
    let ellipse = SeparableMotion::through(&kepler, (&[1.0, 0.0], &[0.5, 0.75], 0.0)).unwrap();
    match ellipse.integral(0, (1.0, 9.0)) {
        Err(HamiltonianError::HamiltonJacobi(HamiltonJacobiError::ForbiddenCoordinate {
            coordinate: 0,
            value: 9.0,
            square,
        })) => assert!(square < 0.0),
        other => panic!("{other:?}"),
    }
    let bad = SeparableMotion::through(&kepler, (&[0.0, 0.0], &[0.5, 0.75], 0.0));
    assert!(matches!(bad, Err(HamiltonianError::NotFinite { .. })));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn motions_of_kepler_by_quadratures_and_by_integration(
        r in 0.7..1.5_f64, radial in -0.6..0.6_f64, moment in 0.5..1.5_f64, negative in prop::bool::ANY, time in -3.0..6.0_f64,
    ) {
        let moment = if negative { -moment } else { moment };
        compare(&KeplerPolar { mass: 1.0, strength: 1.25 }, [r, 0.3], [radial, moment], &[time], 1e-9);
        compare(&KeplerParabolic { mass: 1.0, strength: 1.25 }, [r, 0.3], [radial, moment], &[0.3 * time], 1e-8);
    }
}
