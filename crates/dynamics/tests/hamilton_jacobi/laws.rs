//! Identities that hold for any solution and any pair of events.

use piola_dynamics::DynamicsError;
use piola_dynamics::hamilton_jacobi::{
    Candidate, CharacteristicStrip, Constants, Event, Extremal, ExtremalField, GeodeticDistance, RayField, SearchRegion,
};
use piola_dynamics::hamiltonian::PhaseFunction;
use piola_integrators::{DormandPrince853, State, Tolerance};
use piola_numerics::Real;
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use proptest::prelude::*;

use super::systems::{Bowl, FromPlace, OscillatorAction, Particle, PolarBowl, ShakenPendulum};

fn fine() -> Tolerance {
    Tolerance::relative(1e-13).unwrap()
}

/// The derivative of G by one number, by central differences of order six: it knows nothing of momenta.
fn slope(f: impl Fn(f64) -> f64) -> f64 {
    let h = 1e-2;
    let difference = |k: f64| f(k * h) - f(-k * h);
    (45.0 * difference(1.0) - 9.0 * difference(2.0) + difference(3.0)) / (60.0 * h)
}

#[test]
fn gradients_of_the_distance_are_momenta_and_energies() {
    let pendulum = ShakenPendulum { amplitude: 1.0 };
    let distance = GeodeticDistance::new(&pendulum);
    let (q0, t0, q1, t1) = (0.3, 0.1, 0.9, 1.0);
    let found = distance.between(&Event::new(&[q0], t0), &Event::new(&[q1], t1), &[0.0]).unwrap();
    let start = found.initial_momenta.clone();
    let g = |a: f64, b: f64, c: f64, d: f64| {
        distance.between(&Event::new(&[q0 + a], t0 + b), &Event::new(&[q1 + c], t1 + d), &start).unwrap().distance
    };
    let slopes = [
        slope(|x| g(x, 0.0, 0.0, 0.0)),
        slope(|x| g(0.0, x, 0.0, 0.0)),
        slope(|x| g(0.0, 0.0, x, 0.0)),
        slope(|x| g(0.0, 0.0, 0.0, x)),
    ];
    let expected = [-found.initial_momenta[0], found.initial_energy, found.final_momenta[0], -found.final_energy];
    assert_close("dG", &slopes, &expected, Tol::stated(1e-9, "differences of order six with the step 0.01"));
    // So are the second derivatives those of the momenta.
    let p0 = |a: f64, c: f64| distance.between(&Event::new(&[q0 + a], t0), &Event::new(&[q1 + c], t1), &start).unwrap();
    let second = [
        slope(|x| -p0(0.0, x).initial_momenta[0]),
        slope(|x| -p0(x, 0.0).initial_momenta[0]),
        slope(|x| p0(0.0, x).final_momenta[0]),
    ];
    let hessians = [found.mixed_hessian[(0, 0)], found.initial_hessian[(0, 0)], found.final_hessian[(0, 0)]];
    assert_close("d²G", &second, &hessians, Tol::stated(1e-8, "differences of order six with the step 0.01"));
}

#[test]
fn the_distance_as_function_of_its_end_solves_the_equation() {
    // ∂G/∂t₁ and ∂G/∂q₁ by differences, put into H.
    let distance = GeodeticDistance::new(&Bowl);
    let (from, q, t) = (Event::new(&[0.3, -0.2], 0.0), [0.6, 0.5], 0.8);
    let start = distance.between(&from, &Event::new(&q, t), &[0.0, 0.0]).unwrap().initial_momenta;
    let g = |x: f64, y: f64, s: f64| {
        distance.between(&from, &Event::new(&[q[0] + x, q[1] + y], t + s), &start).unwrap().distance
    };
    let momenta = [slope(|x| g(x, 0.0, 0.0)), slope(|y| g(0.0, y, 0.0))];
    let residual = slope(|s| g(0.0, 0.0, s)) + Bowl.value(&q, &momenta, t);
    assert_close_at_scale("residual", &[residual], &[0.0], 1.0, Tol::stated(1e-9, "differences of order six"));
}

#[test]
fn sheets_of_a_pendulum_are_those_of_a_dense_scan() {
    // Every change of sign of q(t₁; p₀) − q₁ over 4000 momenta belongs to one sheet.
    let pendulum = ShakenPendulum { amplitude: 0.0 };
    let (q0, q1, t1, bound) = (0.5, -0.25, 6.0, 6.0);
    let coarse = Tolerance::relative(1e-8).unwrap();
    let end = |p: f64| {
        let mut state = State::new(0.0, vec![q0, p, 0.0]).unwrap();
        DormandPrince853::new(coarse).integrate_to(&mut RayField::new(&pendulum, 1, 0), &mut state, t1).unwrap();
        state.values[0] - q1
    };
    let scan: Vec<f64> = (0..=4000).map(|i| end(-bound + 2.0 * bound * f64::from(i) / 4000.0)).collect();
    let changes = scan.windows(2).filter(|pair| pair[0] * pair[1] < 0.0).count();
    let region = SearchRegion::new(&[-bound], &[bound], 48).unwrap();
    let distance = GeodeticDistance::new(&pendulum);
    let sheets = distance.all_between(&Event::new(&[q0], 0.0), &Event::new(&[q1], t1), &region).unwrap();
    assert_eq!(sheets.len(), changes);
    assert!(sheets.windows(2).all(|pair| pair[0].distance < pair[1].distance));
    // Some of them swing to and fro, and have passed conjugate points.
    assert!(sheets.iter().any(|sheet| sheet.morse_index() == 0));
    assert!(sheets.iter().any(|sheet| 2 <= sheet.morse_index()));
    // Their orientations alternate, and add up to the degree that the ends of the region give.
    assert_eq!(distance.degree(&Event::new(&[q0], 0.0), &Event::new(&[q1], t1), &region).unwrap(), Some(1));
    assert_eq!(sheets.iter().map(Extremal::orientation).sum::<i32>(), 1);
}

/// Two pendulums that do not know of each other, in coordinates that mix them: every sheet of the one with every sheet
/// of the other. A grid that is too coarse is found out by the degree.
#[test]
fn sheets_of_two_pendulums_are_all_pairs_of_sheets() {
    struct Mixed; // q = R y, p = R π, each pendulum with H = π²/2 − 4 cos y
    const TURN: [[f64; 2]; 2] = [[0.8, -0.6], [0.6, 0.8]];
    impl PhaseFunction for Mixed {
        fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
            let back = |x: &[T], i: usize| T::lit(TURN[0][i]) * x[0] + T::lit(TURN[1][i]) * x[1];
            let one = |i: usize| T::lit(0.5) * back(p, i) * back(p, i) - T::lit(4.0) * back(q, i).cos();
            one(0) + one(1)
        }
    }
    let turned = |y: [f64; 2]| TURN.map(|row| row[0] * y[0] + row[1] * y[1]);
    let pendulum = ShakenPendulum { amplitude: 0.0 };
    let (y0, y1, t1) = ([0.5, -0.3], [-0.25, 0.4], 3.0);
    let single: Vec<Vec<Extremal>> = (0..2)
        .map(|i| {
            let region = SearchRegion::new(&[-9.0], &[9.0], 96).unwrap();
            let (from, to) = (Event::new(&[y0[i]], 0.0), Event::new(&[y1[i]], t1));
            GeodeticDistance::new(&pendulum).all_between(&from, &to, &region).unwrap()
        })
        .collect();
    let (from, to) = (Event::new(&turned(y0), 0.0), Event::new(&turned(y1), t1));
    let distance = GeodeticDistance::new(&Mixed);
    let mut expected: Vec<([f64; 2], f64, i32)> = Vec::new();
    for a in &single[0] {
        for b in &single[1] {
            let momenta = turned([a.initial_momenta[0], b.initial_momenta[0]]);
            expected.push((momenta, a.distance + b.distance, a.orientation() * b.orientation()));
        }
    }
    let mut doubled = 0;
    for (bound, resolution) in [(2.0, 1), (3.0, 1), (4.0, 2), (5.0, 2), (6.0, 3), (6.0, 16)] {
        let region = SearchRegion::new(&[-bound; 2], &[bound; 2], resolution).unwrap();
        let inside: Vec<_> = expected.iter().filter(|(p, ..)| p.iter().all(|p| p.abs() < bound)).collect();
        let degree = distance.degree(&from, &to, &region).unwrap();
        assert_eq!(degree, Some(inside.iter().map(|(.., orientation)| orientation).sum()));
        let sheets = match distance.all_between(&from, &to, &region) {
            Err(DynamicsError::NoExtremal { .. }) => Vec::new(),
            other => other.unwrap(),
        };
        assert_eq!(sheets.iter().map(Extremal::orientation).sum::<i32>(), degree.unwrap(), "{bound} {resolution}");
        doubled += usize::from(resolution * resolution < sheets.len());
        for sheet in &sheets {
            let near =
                |(p, ..): &&&([f64; 2], f64, i32)| (0..2).all(|i| (p[i] - sheet.initial_momenta[i]).abs() < 1e-8);
            let known = inside.iter().find(near).expect("a pair of sheets");
            let tolerance = Tol::stated(1e-10, "integration with the relative tolerance 1e-13");
            assert_close_at_scale("G", &[sheet.distance], &[known.1], 10.0, tolerance);
            assert_eq!(sheet.orientation(), known.2);
        }
        if resolution == 16 {
            assert_eq!(sheets.len(), inside.len());
        }
    }
    assert!(0 < doubled, "some grid was doubled");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn action_along_the_extremal_field_is_the_increment_of_its_solution(
        place in -1.0..1.0_f64, q in -1.0..1.0_f64, t0 in 0.2..1.0_f64, dt in -0.15..1.0_f64,
    ) {
        let (mass, omega) = (1.5, 1.25);
        let system = Particle::oscillator(mass, omega, 1);
        let solution = FromPlace { action: OscillatorAction { mass, omega }, place: vec![place] };
        let residual = Candidate::new(&system, &solution).residual(&[q], t0).unwrap();
        let rounding = Tol::ulps(64.0);
        assert_close_at_scale("HJ", &[residual.value], &[0.0], residual.energy.abs() + 100.0, rounding);
        let t1 = t0 + dt;
        let end = ExtremalField::new(&system, &solution, 1).follow(&[q], t0, t1, fine()).unwrap();
        let tolerance = Tol::stated(1e-10, "integration with the relative tolerance 1e-13");
        assert_close_at_scale("∫L dt = U₁ − U₀", &[end.action], &[end.increment], 10.0, tolerance);
        // All of them left the place at t = 0: q = place cos ωt + b sin ωt.
        let b = (q - place * (omega * t0).cos()) / (omega * t0).sin();
        let expected = place * (omega * t1).cos() + b * (omega * t1).sin();
        assert_close_at_scale("q", &end.coordinates, &[expected], 10.0, tolerance);
    }

    #[test]
    fn characteristic_strips_keep_the_equation_and_are_trajectories(
        q in -1.0..1.0_f64, p in -2.0..2.0_f64, t in -1.0..1.0_f64, span in 0.1..2.0_f64,
    ) {
        let pendulum = ShakenPendulum { amplitude: 1.0 };
        let start = CharacteristicStrip::<_>::start(&pendulum, &[q], &[p], t, 0.0).unwrap();
        let mut strip = State::new(0.0, start).unwrap();
        let mut field = CharacteristicStrip::new(&pendulum, 1);
        let absolute = Tolerance::new(1e-13, 1e-13).unwrap();
        DormandPrince853::new(absolute).integrate_to(&mut field, &mut strip, span).unwrap();
        let mut ray = State::new(t, vec![q, p, 0.0]).unwrap();
        DormandPrince853::new(absolute).integrate_to(&mut RayField::new(&pendulum, 1, 0), &mut ray, t + span).unwrap();
        let [q1, t1, u1, p1, slope] = strip.values[..] else { unreachable!() };
        let tolerance = Tol::stated(1e-10, "integration with the tolerance 1e-13");
        assert_close_at_scale("(q, p)", &[q1, p1], &ray.values[..2], 1.0, tolerance);
        let energy = pendulum.value(&[q1], &[p1], t1);
        assert_close_at_scale("p_t + H", &[slope + energy], &[0.0], 10.0, tolerance);
        // U′ = p·H_p + p_t is the Lagrangian where p_t = −H.
        assert_close_at_scale("U = ∫L dt", &[u1], &ray.values[2..3], 10.0, tolerance);
    }

    #[test]
    fn polar_and_cartesian_coordinates_give_one_distance(
        r0 in 0.6..1.4_f64, r1 in 0.6..1.4_f64, angle in 0.2..1.4_f64, span in 0.25..0.6_f64,
    ) {
        let polar = |r: f64, phi: f64| [r * phi.cos(), r * phi.sin()];
        let (a, b) = ([r0, 0.2], [r1, 0.2 + angle]);
        // Guesses of the straight way. After longer times none of the harder and harder swings outwards is back.
        let ([x0, y0], [x1, y1]) = (polar(r0, 0.2), polar(r1, 0.2 + angle));
        let p = [(x1 - x0) / span, (y1 - y0) / span];
        let cartesian = GeodeticDistance::new(&Bowl)
            .between(&Event::new(&[x0, y0], 0.0), &Event::new(&[x1, y1], span), &p)
            .unwrap();
        // Polar coordinates are singular at the centre, where the straight way may lead: near the momenta found.
        let p: Vec<f64> = cartesian.initial_momenta.iter().map(|p| 1.02 * p + 0.01).collect();
        let guess = [(x0 * p[0] + y0 * p[1]) / r0, x0 * p[1] - y0 * p[0]];
        let other = GeodeticDistance::new(&PolarBowl).between(&Event::new(&a, 0.0), &Event::new(&b, span), &guess).unwrap();
        let tolerance = Tol::stated(1e-10, "two boundary-value problems");
        assert_close_at_scale("G", &[other.distance], &[cartesian.distance], 1.0, tolerance);
        let energies = [other.initial_energy, other.final_energy];
        assert_close_at_scale("H", &energies, &[cartesian.initial_energy, cartesian.final_energy], 1.0, tolerance);
        // p_φ = x p_y − y p_x, an integral.
        let moment = x0 * cartesian.initial_momenta[1] - y0 * cartesian.initial_momenta[0];
        assert_close_at_scale("p_φ", &[other.initial_momenta[1], other.final_momenta[1]], &[moment; 2], 1.0, tolerance);
        assert_eq!(other.morse_index(), cartesian.morse_index());
    }

    #[test]
    fn motion_from_a_complete_integral_is_that_of_the_oscillator(
        q in -1.0..1.0_f64, y in -1.0..1.0_f64, p in -2.0..2.0_f64, t0 in 0.2..1.0_f64, t1 in 0.2..2.2_f64,
    ) {
        let (mass, omega) = (1.5, 1.25);
        let system = Particle::oscillator(mass, omega, 2);
        let integral = OscillatorAction { mass, omega };
        let state: (&[f64], &[f64], f64) = (&[q, y], &[p, 1.0], t0);
        let motion = Constants::through(&system, &integral, state, &[0.1, 0.2]).unwrap();
        let (q1, p1) = motion.at(t1, (&[q, y], t0)).unwrap();
        let (s, c) = (omega * (t1 - t0)).sin_cos();
        let expected = [q * c + p / (mass * omega) * s, y * c + 1.0 / (mass * omega) * s];
        let momenta = [p * c - mass * omega * q * s, c - mass * omega * y * s];
        let tolerance = Tol::stated(1e-12, "formulas and Newton's iteration in double precision").times(10.0);
        assert_close_at_scale("q", &q1, &expected, 1.0, tolerance);
        assert_close_at_scale("p", &p1, &momenta, 1.0, tolerance);
    }
}
