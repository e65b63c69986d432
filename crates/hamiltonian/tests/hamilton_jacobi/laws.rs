//! Identities that hold for any solution and any pair of events.

use piola_hamiltonian::hamilton_jacobi::{
    Candidate, CharacteristicStrip, ConjugatePoint, Constants, Event, Extremal, ExtremalField, GeodeticDistance,
    InitialFront, IntegralConoid, PrincipalFunction, RayField, Residual, SearchRegion, StationaryCandidate,
    Transversals, WaveFront,
};
use piola_hamiltonian::{HamiltonJacobiError, HamiltonianError};
use piola_hamiltonian::{InvertiblePhaseMap, PhaseFunction, PhaseMap, PolarCoordinates};
use piola_integrators::{DormandPrince853, State, Tolerance};
use piola_numerics::Real;
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use proptest::prelude::*;

use super::systems::{
    Bowl, ByEnergy, ByPolar, FromPlace, OscillatorAction, OscillatorByEnergy, Particle, PolarBowl, ShakenPendulum,
    Swaying,
};

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
    let found: Extremal = distance.between(&Event::new(&[q0], t0), &Event::new(&[q1], t1), &[0.0]).unwrap();
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
            Err(HamiltonianError::HamiltonJacobi(HamiltonJacobiError::NoExtremal { .. })) => Vec::new(),
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

/// Three pendulums that do not know of each other, in coordinates that mix them: all triples of sheets. There is no
/// balance of orientations with three degrees of freedom; the grid must be fine enough by itself.
#[test]
fn sheets_of_three_pendulums_are_all_triples_of_sheets() {
    /// q = R y, p = R π, each pendulum with H = π²/2 − 4 cos y.
    struct Mixed;
    const TURN: [[f64; 3]; 3] = [[0.96, -0.28, 0.0], [0.28, 0.96, 0.0], [0.0, 0.0, 1.0]];
    impl PhaseFunction for Mixed {
        fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
            let back = |x: &[T], i: usize| (0..3).fold(T::zero(), |sum, j| sum + T::lit(TURN[j][i]) * x[j]);
            (0..3)
                .fold(T::zero(), |sum, i| sum + T::lit(0.5) * back(p, i) * back(p, i) - T::lit(4.0) * back(q, i).cos())
        }
    }
    let turned = |y: [f64; 3]| TURN.map(|row| (0..3).map(|i| row[i] * y[i]).sum::<f64>());
    let pendulum = ShakenPendulum { amplitude: 0.0 };
    let (y0, y1, t1, bound) = ([0.5, -0.3, 0.2], [-0.25, 0.4, 0.1], 2.0, 5.0);
    let single: Vec<Vec<Extremal>> = (0..3)
        .map(|i| {
            let region = SearchRegion::new(&[-9.0], &[9.0], 96).unwrap();
            let (from, to) = (Event::new(&[y0[i]], 0.0), Event::new(&[y1[i]], t1));
            GeodeticDistance::new(&pendulum).all_between(&from, &to, &region).unwrap()
        })
        .collect();
    let mut expected = Vec::new();
    for a in &single[0] {
        for b in &single[1] {
            for c in &single[2] {
                let momenta = turned([a.initial_momenta[0], b.initial_momenta[0], c.initial_momenta[0]]);
                if momenta.iter().all(|p| p.abs() < bound) {
                    expected.push((momenta, [a, b, c]));
                }
            }
        }
    }
    assert!(8 <= expected.len(), "more than one sheet of each: {}", expected.len());
    let region = SearchRegion::new(&[-bound; 3], &[bound; 3], 6).unwrap();
    let (from, to) = (Event::new(&turned(y0), 0.0), Event::new(&turned(y1), t1));
    let sheets = GeodeticDistance::new(&Mixed).all_between(&from, &to, &region).unwrap();
    assert_eq!(sheets.len(), expected.len());
    for sheet in &sheets {
        let near =
            |(p, _): &&([f64; 3], [&Extremal; 3])| (0..3).all(|i| (p[i] - sheet.initial_momenta[i]).abs() < 1e-8);
        let (_, parts) = expected.iter().find(near).expect("a triple of sheets");
        let distance: f64 = parts.iter().map(|part| part.distance).sum();
        let tolerance = Tol::stated(1e-10, "integration with the relative tolerance 1e-13");
        assert_close_at_scale("G", &[sheet.distance], &[distance], 10.0, tolerance);
        assert_eq!(sheet.morse_index(), parts.iter().map(|part| part.morse_index()).sum::<usize>());
        assert_eq!(sheet.orientation(), parts.iter().map(|part| part.orientation()).product::<i32>());
    }
    // They are given in the order of the distance, each once.
    assert!(sheets.windows(2).all(|pair| pair[0].distance <= pair[1].distance));
}

/// A function of events that solves nothing.
#[derive(Clone, Copy, Debug)]
struct Anything([f64; 4]);

impl PrincipalFunction for Anything {
    fn value<T: Real>(&self, q: &[T], t: T) -> T {
        let c = self.0.map(T::lit);
        c[0] * q[0] + T::lit(0.5) * (q[0] + c[1] * q[1] + t).sin() + c[2] * q[1] * t + c[3] * q[0] * q[1]
    }
}

/// Rays that run about the centre at a distance of about 3/2 and come together, sooner in one direction than in the
/// other.
#[derive(Clone, Copy, Debug)]
struct Gathering(f64, f64);

impl PrincipalFunction for Gathering {
    fn value<T: Real>(&self, q: &[T], _t: T) -> T {
        let (x, y) = (q[0] - T::lit(1.2), q[1] - T::lit(0.9));
        T::lit(-1.62) * x + T::lit(2.16) * y - T::lit(0.5 * self.0) * x * x - T::lit(0.5 * self.1) * y * y
    }
}

/// x = 1 + y²/5 and a little more.
#[derive(Clone, Copy, Debug)]
struct Wall;

impl InitialFront<2, 1> for Wall {
    fn at<T: Real>(&self, [a]: [T; 1]) -> [T; 2] {
        [T::one() + T::lit(0.2) * a * a + T::lit(0.1) * a, a]
    }
}

/// `(r, φ, p_r, p_φ)` of Cartesian coordinates and momenta.
fn to_polar(q: &[f64], p: &[f64]) -> [f64; 4] {
    let mut polar = [0.0; 4];
    PolarCoordinates.map(q, p, 0.0, &mut polar).unwrap();
    polar
}

/// `(x, y, p_x, p_y)` of polar coordinates and momenta, whichever turn φ has come to.
fn from_polar(q: &[f64], p: &[f64]) -> [f64; 4] {
    let mut cartesian = [0.0; 4];
    PolarCoordinates.invert(q, p, 0.0, &mut cartesian).unwrap();
    cartesian
}

/// Where rays meet their neighbours does not depend on coordinates, nor does how many of them they meet.
fn same_caustics(there: &[ConjugatePoint], here: &[ConjugatePoint]) {
    let parts = |points: &[ConjugatePoint]| -> (Vec<f64>, Vec<usize>) {
        points.iter().map(|point| (point.time, point.multiplicity)).unzip()
    };
    let ((there, theirs), (here, ours)) = (parts(there), parts(here));
    assert_eq!(theirs, ours, "{there:?} {here:?}");
    assert_close("caustics", &there, &here, Tol::stated(1e-9, "dense output of order seven"));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn polar_and_cartesian_coordinates_give_one_residual(
        c in prop::array::uniform4(-1.0..1.0_f64), r in 0.3..1.5_f64, phi in -3.0..3.0_f64, t in -1.0..1.0_f64,
    ) {
        let q = [r * phi.cos(), r * phi.sin()];
        let mut cartesian = Candidate::new(Bowl, Anything(c));
        let mut polar = Candidate::new(PolarBowl, ByPolar(Anything(c)));
        let (here, there) = (cartesian.residual(&q, t).unwrap(), polar.residual(&[r, phi], t).unwrap());
        let parts = |r: Residual| [r.value, r.time_derivative, r.energy];
        // p_φ/r is a difference of terms of p.
        assert_close_at_scale("residual", &parts(there), &parts(here), 10.0, Tol::ulps(16.0));
        let momenta = &to_polar(&q, cartesian.momenta())[2..];
        assert_close_at_scale("p", polar.momenta(), momenta, 5.0, Tol::ulps(8.0));
        assert_close_at_scale("U", &[polar.value()], &[cartesian.value()], 5.0, Tol::ulps(8.0));
    }

    /// The field q̇ = H_p(q, ∂U/∂q) belongs to any U, and so do both sides of what is equal for a solution.
    #[test]
    fn polar_and_cartesian_coordinates_give_one_field_of_extremals(
        c in prop::array::uniform4(-0.5..0.5_f64), r in 0.8..1.5_f64, phi in -3.0..3.0_f64, t in -1.0..1.0_f64,
        span in -0.35..0.35_f64,
    ) {
        let (solution, by_polar) = (Anything(c), ByPolar(Anything(c)));
        let q = [r * phi.cos(), r * phi.sin()];
        let here = ExtremalField::new(&Bowl, &solution, 2).follow(&q, t, t + span, fine()).unwrap();
        let there = ExtremalField::new(&PolarBowl, &by_polar, 2).follow(&[r, phi], t, t + span, fine()).unwrap();
        let tolerance = Tol::stated(1e-11, "two integrations with the relative tolerance 1e-13");
        let end = from_polar(&there.coordinates, &there.momenta);
        assert_close_at_scale("(q, p)", &end, &[&here.coordinates[..], &here.momenta].concat(), 1.0, tolerance);
        assert_close_at_scale("action", &[there.action], &[here.action], 1.0, tolerance);
        assert_close_at_scale("increment", &[there.increment], &[here.increment], 1.0, tolerance);
    }

    #[test]
    fn polar_and_cartesian_coordinates_give_one_transversal_with_its_caustics(
        a in 0.5..0.9_f64, b in 1.3..2.0_f64, x in 1.0..1.4_f64, y in 0.7..1.1_f64, time in 0.2..1.6_f64,
    ) {
        let (values, by_polar) = (Gathering(a, b), ByPolar(Gathering(a, b)));
        let (cartesian, polar) =
            (Transversals::of_values(&Bowl, &values, 0.0), Transversals::of_values(&PolarBowl, &by_polar, 0.0));
        let foot = [x.hypot(y), y.atan2(x)];
        let (start, other) = (cartesian.start(&[x, y], 0.0).unwrap(), polar.start(&foot, 0.0).unwrap());
        let (here, there) = (cartesian.follow(&start, time).unwrap(), polar.follow(&other, time).unwrap());
        let tolerance = Tol::stated(1e-10, "two integrations with the relative tolerance 1e-13");
        assert_close_at_scale("U, H", &[there.value, there.energy], &[here.value, here.energy], 10.0, tolerance);
        let end = from_polar(&there.coordinates, &there.momenta);
        assert_close_at_scale("(q, p)", &end, &[&here.coordinates[..], &here.momenta].concat(), 5.0, tolerance);
        // The Jacobian of the places is a density: dx dy = r dr dφ at both ends.
        let jacobian = there.jacobian * there.coordinates[0] / foot[0];
        assert_close_at_scale("Jacobian", &[jacobian], &[here.jacobian], 10.0, tolerance);
        same_caustics(&there.caustics, &here.caustics);
    }

    #[test]
    fn polar_and_cartesian_coordinates_give_one_wave_front(
        reach in 0.1..0.9_f64, outwards in prop::bool::ANY, energy in 3.5..5.0_f64,
    ) {
        let side = if outwards { 1.0 } else { -1.0 };
        let by_polar = ByPolar(Wall);
        let mut cartesian = WaveFront::open(&Bowl, &Wall, side, energy, (-0.5, 0.5), 7).unwrap();
        let mut polar = WaveFront::open(&PolarBowl, &by_polar, side, energy, (-0.5, 0.5), 7).unwrap();
        let (here, there) = (cartesian.advance(reach, 48).unwrap(), polar.advance(reach, 48).unwrap());
        prop_assert_eq!(there.caustics, here.caustics);
        let tolerance = Tol::stated(1e-10, "steps of order six and of the length 0.02");
        for (ray, other) in cartesian.rays().iter().zip(polar.rays()) {
            let end = from_polar(&other.coordinates(), &other.momenta());
            assert_close_at_scale("(q, p)", &end, &[ray.coordinates(), ray.momenta()].concat(), 3.0, tolerance);
            let jacobian = other.jacobian() * other.coordinates()[0];
            assert_close_at_scale("det(∂q/∂σ, dq/dS)", &[jacobian], &[ray.jacobian()], 1.0, tolerance);
            prop_assert_eq!(other.caustics(), ray.caustics());
        }
    }

    #[test]
    fn polar_and_cartesian_coordinates_give_one_conoid(
        r in 1.0..1.5_f64, phi in -3.0..3.0_f64, speed in 1.5..3.0_f64, slant in -0.5..0.5_f64, left in prop::bool::ANY,
    ) {
        // More or less across the radius, so that rays keep away from the centre.
        let direction = phi + slant + if left { 0.5 } else { -0.5 } * core::f64::consts::PI;
        let (q, p) = ([r * phi.cos(), r * phi.sin()], [speed * direction.cos(), speed * direction.sin()]);
        let times = [0.45, 0.9, 2.1];
        let momenta = to_polar(&q, &p)[2..].to_vec();
        let cartesian = IntegralConoid::new(&Bowl, &Event::new(&q, 0.2), &[p.to_vec()], &times).unwrap();
        let polar = IntegralConoid::new(&PolarBowl, &Event::new(&[r, phi], 0.2), &[momenta], &times).unwrap();
        let (ray, other) = (&cartesian.rays[0], &polar.rays[0]);
        let tolerance = Tol::stated(1e-10, "two integrations with the relative tolerance 1e-13");
        for (here, there) in ray.points.iter().zip(&other.points) {
            let end = from_polar(&there.coordinates, &there.momenta);
            assert_close_at_scale("(q, p)", &end, &[&here.coordinates[..], &here.momenta].concat(), 5.0, tolerance);
            assert_close_at_scale("V, H", &[there.value, there.energy], &[here.value, here.energy], 10.0, tolerance);
            prop_assert_eq!(there.folds, here.folds);
        }
        same_caustics(&other.conjugate_points, &ray.conjugate_points);
    }

    #[test]
    fn action_along_the_extremal_field_is_the_increment_of_its_solution(
        place in -1.0..1.0_f64, q in -1.0..1.0_f64, t0 in 0.2..1.0_f64, dt in -0.15..1.0_f64,
    ) {
        let (mass, omega) = (1.5, 1.25);
        let system = Particle::oscillator(mass, omega, 1);
        let solution = FromPlace { action: OscillatorAction { mass, omega }, place: vec![place] };
        let t1 = t0 + dt;
        let end = ExtremalField::new(&system, &solution, 1).follow(&[q], t0, t1, fine()).unwrap();
        let tolerance = Tol::stated(1e-10, "integration with the relative tolerance 1e-13");
        assert_close_at_scale("∫L dt = U₁ − U₀", &[end.action], &[end.increment], 10.0, tolerance);
        // All of them left the place at t = 0: q = place cos ωt + b sin ωt.
        let b = (q - place * (omega * t0).cos()) / (omega * t0).sin();
        let expected = place * (omega * t1).cos() + b * (omega * t1).sin();
        assert_close_at_scale("q", &end.coordinates, &[expected], 10.0, tolerance);
    }

    /// H(q, ∂S/∂q) of S(q; E) is E, whatever energy the candidate claims.
    #[test]
    fn residual_of_a_stationary_candidate_equals_the_difference_of_energies(
        mass in 0.5..2.0_f64, omega in 0.5..2.0_f64, energy in 1.0..4.0_f64, claimed in 0.0..8.0_f64, part in -0.9..0.9_f64,
    ) {
        let turning = (2.0 * energy / mass).sqrt() / omega;
        let q = part * turning;
        let system = Particle::oscillator(mass, omega, 1);
        let action = ByEnergy { action: OscillatorByEnergy { mass, omega }, energy };
        let mut candidate = StationaryCandidate::new(&system, &action, claimed);
        let found = candidate.residual(&[q]).unwrap();
        // S falls towards the turning points as a root: ∂S/∂q is of 1/(1 − part²) terms.
        let rounding = Tol::ulps(64.0).times(1.0 / (1.0 - part * part));
        assert_close_at_scale("H − E", &[found.value], &[energy - claimed], 8.0, rounding);
        let momentum = mass * omega * turning * (1.0 - part * part).sqrt();
        assert_close_at_scale("∂S/∂q", candidate.momenta(), &[momentum], mass * omega * turning, rounding);
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

proptest! {
    // Forty pairs of events a case.
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn every_gradient_of_the_distance_in_the_plane_is_a_momentum_or_an_energy(
        place in prop::array::uniform4(-0.7..0.7_f64), t0 in -1.0..1.0_f64, span in 0.8..1.2_f64,
    ) {
        let distance = GeodeticDistance::new(&Swaying);
        let ends = [place[0], place[1], t0, place[2], place[3], t0 + span];
        let joined = |ends: &[f64; 6], guess: &[f64]| {
            let (from, to) = (Event::new(&ends[..2], ends[2]), Event::new(&ends[3..5], ends[5]));
            distance.between(&from, &to, guess).unwrap()
        };
        let straight = [(place[2] - place[0]) / span, (place[3] - place[1]) / span];
        let found = joined(&ends, &straight);
        let slopes: Vec<f64> = (0..6)
            .map(|i| {
                slope(|x| {
                    let mut ends = ends;
                    ends[i] += x;
                    joined(&ends, &found.initial_momenta).distance
                })
            })
            .collect();
        let (before, after) = (&found.initial_momenta, &found.final_momenta);
        let (h0, h1) = (found.initial_energy, found.final_energy);
        let expected = [-before[0], -before[1], h0, after[0], after[1], -h1];
        let differences = Tol::stated(2e-9, "differences of order six with the step 0.01");
        assert_close_at_scale("dG", &slopes, &expected, 1.0, differences);
    }
}
