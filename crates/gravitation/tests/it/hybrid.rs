//! Close encounters of planets: a reference trajectory, invariants, who meets, collisions, and what is refused.

use std::ops::ControlFlow;

use piola_gravitation::hybrid::{ClosestApproach, HybridReport, HybridSymplectic, critical_radii};
use piola_gravitation::regularised::Regularised;
use piola_gravitation::wisdom_holman::{Corrector, DemocraticHeliocentric, Splitting};
use piola_gravitation::{Gravitation, GravitationError};
use piola_integrators::{Ending, GaussRadau15, IntegratorsError, State};
use piola_numerics::Dual;
use piola_testkit::{Tol, allocations_in, assert_close, assert_close_at_scale, assert_order, golden};

use crate::planets::{SPLITTINGS, planets, reference, triples};

/// Two planets that meet at 0.04 Hill radii at t = 9.6, and a third: masses, start, and the reference in 30 digits.
struct Meeting {
    bodies: Gravitation,
    start: Vec<f64>,
    data: serde_json::Value,
}

impl Meeting {
    fn new() -> Self {
        let data = reference("planet_encounter");
        let bodies = Gravitation::new(golden::vector(&data["masses"])).unwrap();
        let start = bodies.state(&triples(&data["positions"]), &triples(&data["velocities"])).unwrap();
        Self { bodies, start, data }
    }

    /// Times and places of the bodies, one after the other.
    fn places(&self) -> Vec<(f64, Vec<f64>)> {
        let states = self.data["states"].as_array().unwrap().iter();
        states.map(|state| (golden::number(&state["t"]), golden::vector(&state["state"])[..12].to_vec())).collect()
    }

    fn run(&self, method: &HybridSymplectic, t: f64) -> (Vec<f64>, HybridReport) {
        let mut state = State::new(0.0, self.start.clone()).unwrap();
        let report = method.integrate_to(&self.bodies, &mut state, t).unwrap();
        (state.values, report)
    }

    fn energy_error(&self, values: &[f64]) -> f64 {
        (self.bodies.invariants(values).energy / self.bodies.invariants(&self.start).energy - 1.0).abs()
    }
}

fn places(bodies: &Gravitation, values: &[f64]) -> Vec<f64> {
    (0..bodies.bodies()).flat_map(|body| bodies.position(values, body)).collect()
}

fn hybrid(step: f64, splitting: Splitting) -> HybridSymplectic {
    HybridSymplectic::new(step, splitting).unwrap()
}

/// The end of a run without splitting.
fn exact(bodies: &Gravitation, start: &[f64], t: f64) -> Vec<f64> {
    let mut state = State::new(0.0, start.to_vec()).unwrap();
    GaussRadau15::to_rounding().integrate_to(&mut bodies.clone(), &mut state, t).unwrap();
    state.values
}

#[test]
fn planets_that_meet_follow_their_reference() {
    let meeting = Meeting::new();
    let mut state = State::new(0.0, meeting.start.clone()).unwrap();
    let radii = critical_radii(&meeting.bodies, &meeting.start, 3.0, 0.0).unwrap();
    let method = hybrid(1.0 / 128.0, Splitting::TenSixFour).with_critical_radii(radii).unwrap();
    let mut closest = None;
    for ((t, expected), error) in meeting.places().into_iter().zip([1e-13, 1e-12, 1e-11]) {
        let report = method.integrate_to(&meeting.bodies, &mut state, t).unwrap();
        let found = places(&meeting.bodies, &state.values);
        let tolerance = Tol::stated(error, "measured: rounding, which the encounter blows up");
        assert_close_at_scale(&format!("t = {t}"), &found, &expected, 1.0, tolerance);
        closest = closest.or(report.closest.filter(|closest| closest.distance < 0.01));
    }
    let error = meeting.energy_error(&state.values);
    assert!(error < 1e-13, "the energy changed by {error}");
    let Some(ClosestApproach { first, second, distance, t }) = closest else { panic!("nobody met") };
    let expected = &meeting.data["closest_approach"];
    assert_eq!((first, second), (1, 2));
    let tolerance = Tol::stated(1e-11, "the same, and the time of an extremum");
    assert_close("distance", &[distance], &[golden::number(&expected["distance"])], tolerance);
    // Within a motion time is that of the first part alone.
    let tolerance = Tol::stated(1e-8, "error of the splitting within a step, measured");
    assert_close("time", &[t], &[golden::number(&expected["t"])], tolerance);
}

#[test]
fn energy_after_an_encounter_falls_to_rounding_with_the_step() {
    let meeting = Meeting::new();
    let bounds = [
        (Splitting::Leapfrog, 0.1, 1e-6),
        (Splitting::Leapfrog, 0.025, 1e-8),
        (Splitting::Corrected(Corrector::Seventeen), 0.0125, 3e-10),
        (Splitting::TenSixFour, 0.3, 3e-7),
        (Splitting::TenSixFour, 0.075, 3e-10),
        (Splitting::TenSixFour, 0.0125, 3e-14),
    ];
    for (splitting, step, bound) in bounds {
        let (values, report) = meeting.run(&hybrid(step, splitting), 20.0);
        let error = meeting.energy_error(&values);
        assert!(error < bound, "{splitting:?} of {step}: {error}");
        assert!(0 < report.encounter_steps && report.encounter_steps < report.run.steps, "{report:?}");
    }
}

#[test]
fn end_after_an_encounter_converges_with_the_square_of_the_step() {
    let meeting = Meeting::new();
    let expected = &meeting.places()[2].1;
    let radii = critical_radii(&meeting.bodies, &meeting.start, 3.0, 0.0).unwrap();
    let steps = [0.02, 0.01, 0.005, 0.0025];
    let errors = steps.map(|step| {
        let method = hybrid(step, Splitting::Leapfrog).with_critical_radii(radii.clone()).unwrap();
        let found = places(&meeting.bodies, &meeting.run(&method, 20.0).0);
        found.iter().zip(expected).fold(0.0, |largest: f64, (a, b)| largest.max((a - b).abs()))
    });
    assert_order("leapfrog", &steps, &errors, 2.0, 0.1);
}

#[test]
fn momentum_and_angular_momentum_are_kept_through_an_encounter() {
    let meeting = Meeting::new();
    let before = meeting.bodies.invariants(&meeting.start);
    for splitting in SPLITTINGS {
        let found = meeting.bodies.invariants(&meeting.run(&hybrid(0.1, splitting), 20.0).0);
        assert_close_at_scale("p", &found.momentum, &before.momentum, before.momentum_scale, Tol::ulps(8.0));
        let scale = before.angular_momentum_scale;
        let rounding = Tol::ulps(64.0);
        assert_close_at_scale("L", &found.angular_momentum, &before.angular_momentum, scale, rounding);
    }
}

#[test]
fn way_back_through_an_encounter_leads_to_the_start() {
    let meeting = Meeting::new();
    let radii = critical_radii(&meeting.bodies, &meeting.start, 3.0, 0.0).unwrap();
    for (splitting, step) in [(Splitting::Leapfrog, 0.1), (Splitting::TenSixFour, 0.2)] {
        let method = hybrid(step, splitting).with_critical_radii(radii.clone()).unwrap();
        let mut state = State::new(0.0, meeting.start.clone()).unwrap();
        let there = method.integrate_to(&meeting.bodies, &mut state, 12.0).unwrap();
        let back = method.integrate_to(&meeting.bodies, &mut state, 0.0).unwrap();
        assert_eq!(there.encounter_steps, back.encounter_steps);
        let rounding = Tol::stated(1e-11, "rounding, which the encounter blows up, measured");
        assert_close_at_scale(&format!("{splitting:?}"), &state.values, &meeting.start, 1.0, rounding);
    }
}

#[test]
fn derivatives_through_an_encounter_are_those_of_a_run_without_splitting() {
    let meeting = Meeting::new();
    let start: Vec<Dual<f64>> =
        meeting.start.iter().enumerate().map(|(i, &x)| Dual::new(x, if i == 1 { 1.0 } else { 0.0 })).collect();
    let tangents = |values: &[Dual<f64>]| values.iter().map(|x| x.tangent).collect::<Vec<f64>>();
    let mut state = State::new(0.0, start.clone()).unwrap();
    GaussRadau15::to_rounding().integrate_to(&mut meeting.bodies.clone(), &mut state, 12.0).unwrap();
    let expected = tangents(&state.values);
    let mut state = State::new(0.0, start).unwrap();
    hybrid(0.025, Splitting::TenSixFour).integrate_to(&meeting.bodies, &mut state, 12.0).unwrap();
    let found = tangents(&state.values);
    let largest = expected.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    assert!(10.0 < largest, "{largest}");
    let tolerance = Tol::stated(3e-8, "error of the splitting, measured");
    assert_close_at_scale("∂/∂x₁", &found, &expected, largest, tolerance);
}

#[test]
fn planets_far_apart_move_as_without_encounters() {
    let (bodies, start) = planets(3, 1e-5);
    for splitting in SPLITTINGS {
        let (mut state, mut plain) = (State::new(0.0, start.clone()).unwrap(), State::new(0.0, start.clone()).unwrap());
        let report = hybrid(0.1, splitting).integrate_to(&bodies, &mut state, 60.0).unwrap();
        let method = DemocraticHeliocentric::new(0.1, splitting).unwrap();
        let expected = method.integrate_to(&bodies, &mut plain, 60.0).unwrap();
        assert_eq!((report.encounter_steps, report.closest, report.run), (0, None, expected));
        assert_eq!(state, plain);
    }
}

/// Comets run against a planet at twice its speed: a step takes them by four critical radii. All that come within one are found.
#[test]
fn encounters_within_a_step_are_found() {
    let bodies = Gravitation::new(vec![1.0, 1e-4, 0.0]).unwrap();
    let (mut found, mut passed) = (0, 0);
    for comet in 0..120 {
        let part = f64::from(comet) / 120.0;
        let angle = 1.0 + 0.3 * part;
        let r = 1.0 + 0.16 * ((7.3 * part).fract() - 0.5);
        let start = bodies
            .state(
                &[[0.0; 3], [1.0, 0.0, 0.0], [r * angle.cos(), r * angle.sin(), 0.01]],
                &[[0.0; 3], [0.0, 1.0, 0.0], [1.1 * angle.sin(), -1.1 * angle.cos(), 0.05]],
            )
            .unwrap();
        let mut reference = State::new(0.0, start.clone()).unwrap();
        let (mut least, mut between) = (f64::INFINITY, start.clone());
        let distance = |values: &[f64]| {
            let (a, b) = (bodies.position(values, 1), bodies.position(values, 2));
            (0..3).map(|axis| (a[axis] - b[axis]).powi(2)).sum::<f64>().sqrt()
        };
        let run = GaussRadau15::to_rounding().integrate(&mut bodies.clone(), &mut reference, 1.2, |step| {
            for part in 0..=100 {
                let t = step.start() + (step.time() - step.start()) * f64::from(part) / 100.0;
                step.at(t.min(step.time()), &mut between).unwrap();
                least = least.min(distance(&between));
            }
            ControlFlow::Continue(())
        });
        run.unwrap();
        let method = hybrid(0.1, Splitting::Leapfrog).with_critical_radii(vec![0.0, 0.05, 0.0]).unwrap();
        let report = method.integrate_to(&bodies, &mut State::new(0.0, start).unwrap(), 1.2).unwrap();
        if let Some(closest) = report.closest {
            found += 1;
            let tolerance = Tol::stated(5e-3, "error of the leapfrog, and of a hundred looks in a step");
            assert_close("distance", &[closest.distance], &[least], tolerance);
        } else {
            passed += 1;
            assert!(0.05 < least, "a passage at {least} was not found");
        }
    }
    assert!(30 < found && 30 < passed, "{found} and {passed}");
}

/// Two pairs at opposite places meet at the same time, each by itself; test particles meet a planet, and not each other.
#[test]
fn pairs_and_test_particles_meet_as_without_splitting() {
    let pairs = Gravitation::new(vec![1.0, 1e-5, 2e-5, 3e-5, 1e-5]).unwrap();
    let particles = Gravitation::new(vec![1.0, 1e-5, 0.0, 0.0, 0.0]).unwrap();
    let starts = [
        pairs
            .state(
                &[[0.0; 3], [1.0, 0.0, 0.0], [0.99, 0.02, 0.001], [-1.5, 0.0, 0.0], [-1.49, -0.03, 0.002]],
                &[[0.0; 3], [0.0, 1.0, 0.0], [0.1, 0.9, 0.0], [0.0, -0.816, 0.0], [-0.06, -0.716, 0.0]],
            )
            .unwrap(),
        particles
            .state(
                &[[0.0; 3], [1.0, 0.0, 0.0], [0.99, 0.02, 0.001], [0.985, 0.025, 0.0], [0.985, 0.025, 0.0]],
                &[[0.0; 3], [0.0, 1.0, 0.0], [0.1, 0.9, 0.0], [0.12, 0.9, 0.0], [0.1, 0.88, 0.005]],
            )
            .unwrap(),
    ];
    for (bodies, start) in [pairs, particles].iter().zip(starts) {
        let expected = exact(bodies, &start, 3.0);
        let mut state = State::new(0.0, start).unwrap();
        let report = hybrid(0.05, Splitting::TenSixFour).integrate_to(bodies, &mut state, 3.0).unwrap();
        assert!(report.closest.unwrap().distance < 0.01, "{report:?}");
        let tolerance = Tol::stated(1e-9, "error of the splitting, measured");
        assert_close_at_scale("pairs", &state.values, &expected, 1.0, tolerance);
    }
}

/// So near that an integrator of places from the origin cannot resolve the distance: beside the regularised motion.
#[test]
fn very_close_passage_is_that_of_the_regularised_motion() {
    let bodies = Gravitation::new(vec![1.0, 1e-3, 5e-4]).unwrap();
    let start = bodies
        .state(&[[0.0; 3], [1.0, 0.0, 0.0], [0.98, 0.023, 0.0]], &[[0.0; 3], [0.0, 1.0, 0.0], [0.1, 0.9, 0.0]])
        .unwrap();
    let mut reference = State::new(0.0, start.clone()).unwrap();
    Regularised::to_rounding().integrate_to(&bodies, &mut reference, 0.15).unwrap();
    let mut state = State::new(0.0, start.clone()).unwrap();
    let report = hybrid(0.0125, Splitting::TenSixFour).integrate_to(&bodies, &mut state, 0.15).unwrap();
    let closest = report.closest.unwrap().distance;
    assert!(closest < 2e-5, "{closest}");
    let change = bodies.invariants(&state.values).energy / bodies.invariants(&start).energy - 1.0;
    assert!(change.abs() < 1e-12, "energy changed by {change}");
    let tolerance =
        Tol::stated(1e-8, "rounding of the start, which the passage blows up by the inverse of its distance");
    let places = bodies.bodies() * 3;
    assert_close_at_scale("places", &state.values[..places], &reference.values[..places], 1.0, tolerance);
}

#[test]
fn looking_does_not_change_a_run_with_encounters() {
    let meeting = Meeting::new();
    let method = hybrid(0.1, Splitting::TenSixFour);
    let (plain, report) = meeting.run(&method, 12.0);
    let mut state = State::new(0.0, meeting.start.clone()).unwrap();
    let mut seen = 0;
    let watched = method.integrate(&meeting.bodies, &mut state, 12.0, 1, |_| {
        seen += 1;
        ControlFlow::Continue(())
    });
    let watched = watched.unwrap();
    assert_eq!((state.values, seen, watched.run.steps), (plain.clone(), 120, 120));
    assert_eq!((watched.closest, watched.encounter_steps), (report.closest, report.encounter_steps));
    // The same bits again.
    assert_eq!(meeting.run(&method, 12.0), (plain, report));
    let mut stopped = State::new(0.0, meeting.start.clone()).unwrap();
    let report = method.integrate(&meeting.bodies, &mut stopped, 12.0, 95, |_| ControlFlow::Break(())).unwrap();
    assert_eq!((report.run.ending, report.run.steps), (Ending::Stopped, 95));
}

#[test]
fn steps_without_encounters_allocate_nothing() {
    let (bodies, start) = planets(4, 1e-5);
    let method = hybrid(0.1, Splitting::TenSixFour);
    let counts = [10.0, 300.0].map(|t| {
        let mut state = State::new(0.0, start.clone()).unwrap();
        allocations_in(|| method.integrate(&bodies, &mut state, t, 5, |_| ControlFlow::Continue(())).unwrap()).0
    });
    assert_eq!(counts[0], counts[1]);
}

#[test]
fn collisions_end_a_run_by_name() {
    let meeting = Meeting::new();
    let closest = golden::number(&meeting.data["closest_approach"]["distance"]);
    for (radius, collides) in [(0.49 * closest, false), (0.51 * closest, true)] {
        let method = hybrid(0.1, Splitting::TenSixFour).with_radii(vec![0.0, radius, radius, 0.0]).unwrap();
        let mut state = State::new(0.0, meeting.start.clone()).unwrap();
        let mut seen = 0.0;
        let run = method.integrate(&meeting.bodies, &mut state, 20.0, 1, |step| {
            seen = step.time;
            ControlFlow::Continue(())
        });
        if !collides {
            assert!(run.is_ok(), "{run:?}");
            continue;
        }
        let Err(IntegratorsError::Field { t, source }) = run else { panic!("{run:?}") };
        let GravitationError::Collision { first, second, distance, contact } = source else { panic!("{source}") };
        assert_eq!((first, second, contact), (1, 2, 2.0 * radius));
        assert!(distance < contact && 0.99 * closest < distance, "{distance}");
        // The step before the encounter is the last good one.
        assert!(9.4 < state.time && state.time <= t && t < state.time + 0.2, "{t} and {}", state.time);
        assert_eq!(state.time.to_bits(), f64::to_bits(seen));
        assert!(meeting.energy_error(&state.values) < 1e-7);
    }
}

#[test]
fn planets_near_the_central_body_end_a_run_by_name() {
    // Pericentre 0.1 of an ellipse of a = 1, from the apocentre 1.9: v² = 2/1.9 − 1.
    let bodies = Gravitation::new(vec![1.0, 1e-6, 1e-6]).unwrap();
    let start = bodies
        .state(
            &[[0.0; 3], [1.9, 0.0, 0.0], [0.0, 5.0, 0.0]],
            &[[0.0; 3], [0.0, (2.0_f64 / 1.9 - 1.0).sqrt(), 0.0], [-0.44, 0.0, 0.0]],
        )
        .unwrap();
    let run = |method: HybridSymplectic| {
        let mut state = State::new(0.0, start.clone()).unwrap();
        (method.integrate_to(&bodies, &mut state, 5.0), state.time)
    };
    let method = hybrid(0.05, Splitting::Leapfrog);
    assert!(run(method.clone().with_least_distance(0.099).unwrap()).0.is_ok());
    let (outcome, reached) = run(method.clone().with_least_distance(0.15).unwrap());
    let Err(IntegratorsError::Field { t, source }) = outcome else { panic!("{outcome:?}") };
    let GravitationError::NearCentre { body: 1, distance, least: 0.15 } = source else { panic!("{source}") };
    assert!(
        0.099 < distance && distance < 0.15 && (t - reached).abs() <= 0.05 + 1e-12,
        "{distance} at {t} after {reached}"
    );
    assert!((3.0 - 0.2..3.2).contains(&reached), "{reached}");
    let (outcome, _) = run(method.with_radii(vec![0.12, 0.01, 0.0]).unwrap());
    let Err(IntegratorsError::Field { source, .. }) = outcome else { panic!("{outcome:?}") };
    assert!(matches!(source, GravitationError::Collision { first: 0, second: 1, .. }), "{source}");
}

/// Two planets fly straight into each other, and have no radii.
#[test]
fn run_into_one_place_fails_and_keeps_its_last_good_state() {
    let bodies = Gravitation::new(vec![1.0, 1e-3, 1e-3]).unwrap();
    let start = bodies
        .state(&[[0.0; 3], [-100.0, 1.0, 0.0], [-100.0, -1.0, 0.0]], &[[0.0; 3], [0.0, -0.25, 0.0], [0.0, 0.25, 0.0]])
        .unwrap();
    let mut state = State::new(0.0, start).unwrap();
    let method = hybrid(1.0, Splitting::Leapfrog).with_critical_radii(vec![0.0, 0.5, 0.5]).unwrap();
    let run = method.integrate_to(&bodies, &mut state, 10.0);
    assert!(matches!(run, Err(IntegratorsError::StepTooSmall { .. } | IntegratorsError::NotFinite { .. })), "{run:?}");
    assert!(state.time < 4.0 && state.values.iter().all(|x| x.is_finite()), "{state:?}");
}

#[test]
fn radii_and_states_out_of_range_are_refused_by_name() {
    let (bodies, start) = planets(2, 1e-3);
    let method = hybrid(0.1, Splitting::Leapfrog);
    for value in [-1.0, f64::NAN, f64::INFINITY] {
        let refusals = [
            ("critical radii", method.clone().with_critical_radii(vec![0.0, value, 1.0])),
            ("radii", method.clone().with_radii(vec![0.0, value, 1.0])),
        ];
        for (name, refusal) in refusals {
            let Err(GravitationError::InvalidRadius { quantity, body: 1, value: found }) = refusal else {
                panic!("{refusal:?}")
            };
            assert_eq!((quantity, found.to_bits()), (name, value.to_bits()));
        }
        assert!(method.clone().with_least_distance(value).is_err());
    }
    for step in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(HybridSymplectic::new(step, Splitting::Leapfrog), Err(IntegratorsError::InvalidStep { .. })));
    }
    let refused = |method: &HybridSymplectic, bodies: &Gravitation, start: &[f64]| {
        let mut state = State::new(1.5, start.to_vec()).unwrap();
        let error = method.integrate_to(bodies, &mut state, 10.0).unwrap_err();
        assert_eq!((state.time, &state.values[..]), (1.5, start));
        let IntegratorsError::Field { t: 1.5, source } = error else { panic!("{error}") };
        source
    };
    let length = |quantity, found| GravitationError::WrongLength { quantity, expected: 3, found };
    let wrong = method.clone().with_critical_radii(vec![0.0; 2]).unwrap();
    assert_eq!(refused(&wrong, &bodies, &start), length("critical radii", 2));
    let wrong = method.clone().with_radii(vec![0.0; 4]).unwrap();
    assert_eq!(refused(&wrong, &bodies, &start), length("radii", 4));
    let soft = bodies.clone().with_softening(0.1).unwrap();
    assert_eq!(refused(&method, &soft, &start), GravitationError::NotKeplerian { force: "softening" });
    let free = Gravitation::new(vec![0.0, 1.0, 1.0]).unwrap();
    assert_eq!(refused(&method, &free, &start), GravitationError::MasslessCentre { body: 0 });
    let none = Gravitation::new(Vec::new()).unwrap();
    assert_eq!(refused(&method, &none, &[]), GravitationError::MasslessCentre { body: 0 });
    let mut together = start.clone();
    for component in 0..3 {
        together[3 * component + 2] = together[3 * component + 1];
    }
    assert_eq!(refused(&method, &bodies, &together), GravitationError::CoincidentBodies { first: 1, second: 2 });
    assert_eq!(
        critical_radii(&bodies, &start[..4], 3.0, 0.1),
        Err(GravitationError::WrongLength { quantity: "state", expected: 18, found: 4 })
    );
    for (hill_radii, step) in [(f64::NAN, 0.1), (3.0, f64::NAN), (-1.0, 0.1), (3.0, f64::INFINITY)] {
        let radii = critical_radii(&bodies, &start, hill_radii, step);
        assert!(matches!(radii, Err(GravitationError::InvalidRadius { .. })), "{hill_radii}, {step}");
    }
    let mut in_the_centre = start.clone();
    for component in 0..3 {
        in_the_centre[3 * component + 1] = in_the_centre[3 * component];
    }
    let radii = critical_radii(&bodies, &in_the_centre, 3.0, 0.0);
    assert_eq!(radii, Err(GravitationError::CoincidentBodies { first: 0, second: 1 }));
}

#[cfg(feature = "serde")]
#[test]
fn reports_are_read_as_they_were_written() {
    let meeting = Meeting::new();
    let (_, report) = meeting.run(&hybrid(0.1, Splitting::Leapfrog), 12.0);
    let text = serde_json::to_string(&report).unwrap();
    assert_eq!(serde_json::from_str::<HybridReport>(&text).unwrap(), report);
}

/// Two planets that run against each other on one circle touch at t = 0.1.
fn about_to_touch() -> (Gravitation, Vec<f64>) {
    let bodies = Gravitation::new(vec![1.0, 1e-9, 1e-9]).unwrap();
    let (sine, cosine) = 0.2_f64.sin_cos();
    let places = [[0.0; 3], [1.0, 0.0, 0.0], [cosine, sine, 0.0]];
    let start = bodies.state(&places, &[[0.0; 3], [0.0, 1.0, 0.0], [sine, -cosine, 0.0]]).unwrap();
    (bodies, start)
}

#[test]
fn a_collision_after_the_end_is_no_collision() {
    let (bodies, start) = about_to_touch();
    for splitting in [Splitting::Leapfrog, Splitting::TenSixFour] {
        let method = HybridSymplectic::new(0.08, splitting).unwrap().with_radii(vec![0.01, 0.001, 0.001]).unwrap();
        let mut state = State::new(0.0, start.clone()).unwrap();
        // The first motion of a next step would end beyond 0.1.
        let report = method.integrate_to(&bodies, &mut state, 0.08).unwrap();
        assert_eq!(state.time.to_bits(), 0.08_f64.to_bits());
        assert!(report.closest.is_none_or(|closest| closest.t <= 0.08), "{report:?}");
        let run = method.integrate_to(&bodies, &mut state, 0.16);
        let Err(IntegratorsError::Field { t, source: GravitationError::Collision { first: 1, second: 2, .. } }) = run
        else {
            panic!("{run:?}");
        };
        assert_close("time", &[t], &[0.099], Tol::stated(1e-3, "found at a step's end or at the least distance"));
    }
}

#[test]
fn only_planets_alone_are_judged_by_their_arcs_about_the_centre() {
    // A light planet revolves about a heavy one. Alone, with its velocity of the start, it would fall to 0.05 from the centre.
    let bodies = Gravitation::new(vec![1.0, 1e-3, 0.0]).unwrap();
    let near = 2e-3;
    let speed = (1e-3_f64 / near).sqrt();
    let places = [[0.0; 3], [1.0, 0.0, 0.0], [1.0 + near, 0.0, 0.0]];
    let start = bodies.state(&places, &[[0.0; 3], [0.0, 1.0, 0.0], [0.0, 1.0 - speed, 0.0]]).unwrap();
    let method = HybridSymplectic::new(3.0, Splitting::Leapfrog).unwrap().with_least_distance(0.2).unwrap();
    let mut state = State::new(0.0, start.clone()).unwrap();
    method.integrate_to(&bodies, &mut state, 3.0).unwrap();
    let alone = method.with_critical_radii(vec![0.0; 3]).unwrap();
    let mut state = State::new(0.0, start).unwrap();
    let run = alone.integrate_to(&bodies, &mut state, 3.0);
    assert!(matches!(run, Err(IntegratorsError::Field { source: GravitationError::NearCentre { body: 2, .. }, .. })));
}

#[test]
fn radii_of_no_body_are_no_default() {
    let meeting = Meeting::new();
    let mut state = State::new(0.0, meeting.start.clone()).unwrap();
    let none = hybrid(0.1, Splitting::Leapfrog).with_radii(Vec::new()).unwrap();
    let expected = meeting.bodies.bodies();
    let wrong = |quantity| GravitationError::WrongLength { quantity, expected, found: 0 };
    let run = none.integrate_to(&meeting.bodies, &mut state, 1.0);
    assert_eq!(run, Err(IntegratorsError::Field { t: 0.0, source: wrong("radii") }));
    let none = hybrid(0.1, Splitting::Leapfrog).with_critical_radii(Vec::new()).unwrap();
    let run = none.integrate_to(&meeting.bodies, &mut state, 1.0);
    assert_eq!(run, Err(IntegratorsError::Field { t: 0.0, source: wrong("critical radii") }));
}
