//! Regularised motion: collisions, long ellipses, three bodies to an escape, and what it refuses.

use std::ops::ControlFlow;

use piola_gravitation::regularised::Regularised;
use piola_gravitation::{Gravitation, GravitationError, PostNewtonian};
use piola_integrators::{Ending, IntegratorsError, State, Tolerance};
use piola_numerics::Dual;
use piola_testkit::{Tol, allocations_in, assert_close_at_scale, golden};

use crate::planets::reference;

/// A plane state of bodies from (x₁, y₁, x₂, …) and velocities in the same order.
fn plane(bodies: &Gravitation, values: &[f64]) -> Vec<f64> {
    let (x, v) = values.split_at(values.len() / 2);
    let triples = |half: &[f64]| half.chunks(2).map(|pair| [pair[0], pair[1], 0.0]).collect::<Vec<[f64; 3]>>();
    bodies.state(&triples(x), &triples(v)).unwrap()
}

fn in_plane(bodies: &Gravitation, state: &[f64]) -> Vec<f64> {
    let pair = |[x, y, _]: [f64; 3]| [x, y];
    let places = (0..bodies.bodies()).flat_map(|body| pair(bodies.position(state, body)));
    places.chain((0..bodies.bodies()).flat_map(|body| pair(bodies.velocity(state, body)))).collect()
}

/// How much the largest component grows with a change of each component of the start, up to some times.
fn growth(bodies: &Gravitation, start: &[f64], times: &[f64]) -> Vec<f64> {
    let mut largest = vec![1.0_f64; times.len()];
    for component in 0..6 {
        let seeded = start.iter().enumerate().map(|(i, &x)| Dual::new(x, if i == component { 1.0 } else { 0.0 }));
        let mut state = State::new(0.0, seeded.collect()).unwrap();
        for (largest, &time) in largest.iter_mut().zip(times) {
            Regularised::to_rounding().integrate_to(bodies, &mut state, time).unwrap();
            *largest = state.values.iter().fold(*largest, |largest, x| largest.max(x.tangent.abs()));
        }
    }
    for later in 1..largest.len() {
        largest[later] = largest[later].max(largest[later - 1]);
    }
    largest
}

/// Burrau's three bodies: dozens of close encounters, then one escapes.
#[test]
fn pythagorean_bodies_part_as_in_seventy_digits() {
    let data = reference("pythagorean");
    let bodies = Gravitation::new(golden::vector(&data["masses"])).unwrap();
    let start: Vec<f64> = golden::matrix(&data["positions"]).concat().into_iter().chain([0.0; 6]).collect();
    let start = plane(&bodies, &start);
    let states = data["states"].as_array().unwrap();
    let times: Vec<f64> = states.iter().map(|state| golden::number(&state["t"])).collect();
    let growth = growth(&bodies, &start, &times);
    let mut state = State::new(0.0, start).unwrap();
    let energy = bodies.invariants(&state.values).energy;
    let mut compared = 0;
    for ((expected, &time), &growth) in states.iter().zip(&times).zip(&growth) {
        Regularised::to_rounding().integrate_to(&bodies, &mut state, time).unwrap();
        let found = in_plane(&bodies, &state.values);
        let tolerance = Tol::ulps_because(4096.0, "rounding where the kinetic energy is hundreds of times the energy")
            .times(growth);
        let change = bodies.invariants(&state.values).energy / energy - 1.0;
        assert_close_at_scale(&format!("t = {time}"), &found, &golden::vector(&expected["state"]), 1.0, tolerance);
        assert!(change.abs() < 1e-12, "t = {time}: energy changed by {change}");
        compared += 1;
    }
    assert_eq!(compared, 4);
}

#[test]
fn figure_eight_is_that_of_its_reference() {
    let golden = golden::load("trajectories");
    let case = golden.cases.iter().find(|case| golden::text(&case["name"]) == "figure_eight").unwrap();
    let bodies = Gravitation::new(vec![1.0; 3]).unwrap();
    let mut state = State::new(0.0, plane(&bodies, &golden::vector(&case["initial_state"]))).unwrap();
    for expected in case["states"].as_array().unwrap() {
        Regularised::to_rounding().integrate_to(&bodies, &mut state, golden::number(&expected["t"])).unwrap();
        let (found, values) = (in_plane(&bodies, &state.values), golden::vector(&expected["state"]));
        assert_close_at_scale("figure eight", &found, &values, 1.0, Tol::stated(1e-12, "rounding of a hundred steps"));
    }
}

/// A pair with e = 0.999999, ten thousand times around, its centre flying: the pericentre is passed at 1400 times the mean speed.
#[test]
fn very_long_ellipse_costs_two_or_three_times_a_short_one() {
    let mut steps = Vec::new();
    for (eccentricity, revolutions) in [(0.5_f64, 1e3), (0.999_999, 1e4)] {
        // From the apocentre, Gm = ½ each: a = 1, period 2π.
        let bodies = Gravitation::new(vec![0.5, 0.5]).unwrap();
        let (far, slow) = (1.0 + eccentricity, ((1.0 - eccentricity) / (1.0 + eccentricity)).sqrt());
        let start = bodies
            .state(
                &[[0.5 * far, 0.0, 0.0], [-0.5 * far, 0.0, 0.0]],
                &[[0.0, 0.5 * slow, 0.125], [0.0, -0.5 * slow, 0.125]],
            )
            .unwrap();
        let energy = bodies.invariants(&start).energy;
        let mut state = State::new(0.0, start).unwrap();
        let time = revolutions * std::f64::consts::TAU;
        let report = Regularised::to_rounding().integrate_to(&bodies, &mut state, time).unwrap();
        steps.push(report.steps as f64 / revolutions);
        let (first, second) = (bodies.position(&state.values, 0), bodies.position(&state.values, 1));
        let relative = [0, 1, 2].map(|axis| first[axis] - second[axis]);
        let tolerance = Tol::stated(4e-15, "3πN² times two ulp of the energy").times(revolutions * revolutions);
        assert_close_at_scale(&format!("e = {eccentricity}"), &relative, &[far, 0.0, 0.0], far, tolerance);
        assert_close_at_scale("centre", &[0.5 * (first[2] + second[2])], &[0.125 * time], time, Tol::ulps(64.0));
        // Steps that end near the pericentre, where the kinetic energy is 10⁶ times the energy, round there: it walks at random.
        let change = bodies.invariants(&state.values).energy / energy - 1.0;
        assert!(change.abs() < 3e-12 * revolutions.sqrt(), "energy changed by {change}");
    }
    assert!(steps[1] < 3.0 * steps[0], "{steps:?}");
}

/// Straight into each other: the fall from rest at distance d lasts π/2 √(d³/(2μ)), and mirrors itself.
#[test]
fn bodies_that_collide_come_back() {
    let bodies = Gravitation::new(vec![3.0, 1.0]).unwrap();
    let start = bodies.state(&[[0.0; 3], [0.0, 2.0, 0.0]], &[[0.0; 3]; 2]).unwrap();
    let fall = std::f64::consts::FRAC_PI_2 * (8.0_f64 / 8.0).sqrt();
    // Half a fall after the collision: t = π/4 of η − sin η = 2t with r = 1 − cos η, solved by hand.
    let mut angle = 2.0_f64;
    for _ in 0..20 {
        angle -= (angle - angle.sin() - std::f64::consts::FRAC_PI_2) / (1.0 - angle.cos());
    }
    for (falls, expected) in [(2.0, 2.0), (1.5, 1.0 - angle.cos()), (20.0, 2.0)] {
        let mut state = State::new(0.0, start.clone()).unwrap();
        Regularised::to_rounding().integrate_to(&bodies, &mut state, falls * fall).unwrap();
        let separation = bodies.position(&state.values, 1)[1] - bodies.position(&state.values, 0)[1];
        assert_close_at_scale(
            &format!("{falls} falls"),
            &[separation.abs()],
            &[expected],
            1.0,
            Tol::stated(1e-11, "3πN² times some ulps"),
        );
    }
}

#[test]
fn way_back_leads_to_the_start_and_the_end_is_met() {
    let bodies = Gravitation::new(vec![1.0, 0.5, 0.25, 0.125]).unwrap();
    let start = bodies
        .state(
            &[[0.0; 3], [1.0, 0.0, 0.1], [1.1, 0.05, 0.0], [-2.0, 1.0, 0.0]],
            &[[0.0; 3], [0.0, 1.0, 0.0], [0.5, 2.0, 0.3], [0.3, -0.4, 0.2]],
        )
        .unwrap();
    let mut state = State::new(2.0, start.clone()).unwrap();
    let method = Regularised::to_rounding();
    for end in [2.3, 5.0, 2.0] {
        let mut last = 0.0;
        let report = method.integrate(&bodies, &mut state, end, |step| {
            last = step.time;
            ControlFlow::Continue(())
        });
        assert_eq!((report.unwrap().ending, last, state.time), (Ending::Reached, end, end));
    }
    let tolerance = Tol::stated(1e-10, "rounding, which the close pair enlarges");
    assert_close_at_scale("start", &state.values, &start, 1.0, tolerance);
}

#[test]
fn error_follows_the_tolerance() {
    let bodies = Gravitation::new(vec![1.0, 0.5, 0.25]).unwrap();
    let start = plane(&bodies, &[0.0, 0.0, 1.0, 0.0, -2.0, 0.5, 0.0, 0.0, 0.0, 0.8, 0.2, -0.6]);
    let end = |tolerance: f64| {
        let mut state = State::new(0.0, start.clone()).unwrap();
        let method = Regularised::new(Tolerance::relative(tolerance).unwrap());
        let report = method.integrate_to(&bodies, &mut state, 20.0).unwrap();
        (state.values, report.evaluations)
    };
    let (best, most) = end(1e-14);
    let mut fewer = most;
    for tolerance in [1e-11, 1e-8, 1e-5] {
        let (found, evaluations) = end(tolerance);
        assert!(evaluations < fewer, "{tolerance}: {evaluations} and {fewer}");
        fewer = evaluations;
        let allowed =
            Tol::stated(1e3 * tolerance, "the tolerance of each step, a hundred of them, which the motion enlarges");
        assert_close_at_scale(&format!("tolerance {tolerance}"), &found, &best, 1.0, allowed);
    }
}

/// ∂x(t)/∂x₀ of a fall from rest: of the similar motion λx₀ at λ^(3/2) t, x(t; λx₀) = λ x(λ^(−3/2) t): x − 3/2 t v at λ = 1.
#[test]
fn derivative_by_the_size_of_the_start_is_that_of_similar_motions() {
    let bodies = Gravitation::new(vec![3.0, 4.0, 5.0]).unwrap();
    let places = [1.0, 3.0, -2.0, -1.0, 1.0, -1.0];
    let start = plane(&bodies, &[&places[..], &[0.0; 6]].concat());
    let grows: Vec<Dual<f64>> = start.iter().map(|&x| Dual::new(x, x)).collect();
    let (mut plain, mut state) = (State::new(0.0, start).unwrap(), State::new(0.0, grows).unwrap());
    let time = 3.0;
    Regularised::to_rounding().integrate_to(&bodies, &mut plain, time).unwrap();
    Regularised::to_rounding().integrate_to(&bodies, &mut state, time).unwrap();
    let places = 9;
    for component in 0..places {
        let (x, v) = (plain.values[component], plain.values[places + component]);
        let found = state.values[component];
        let tolerance = Tol::stated(1e-10, "rounding, which an encounter at t = 1.9 enlarges");
        assert_close_at_scale("x", &[found.value, found.tangent], &[x, x - 1.5 * time * v], 10.0, tolerance);
    }
}

#[test]
fn steps_allocate_nothing() {
    let bodies = Gravitation::new(vec![1.0, 0.5, 0.25]).unwrap();
    let start = plane(&bodies, &[0.0, 0.0, 1.0, 0.0, -2.0, 0.5, 0.0, 0.0, 0.0, 0.8, 0.2, -0.6]);
    let counts = [1.0, 100.0].map(|time| {
        let mut state = State::new(0.0, start.clone()).unwrap();
        allocations_in(|| Regularised::to_rounding().integrate_to(&bodies, &mut state, time).unwrap()).0
    });
    assert_eq!(counts[0], counts[1]);
}

#[test]
fn other_bodies_and_states_are_refused_and_runs_can_be_limited() {
    let bodies = Gravitation::new(vec![1.0, 0.5, 0.25]).unwrap();
    let start = plane(&bodies, &[0.0, 0.0, 1.0, 0.0, -2.0, 0.5, 0.0, 0.0, 0.0, 0.8, 0.2, -0.6]);
    let refused = |bodies: &Gravitation, start: &[f64]| {
        let mut state = State::new(1.5, start.to_vec()).unwrap();
        let error = Regularised::to_rounding().integrate_to(bodies, &mut state, 10.0).unwrap_err();
        assert_eq!((state.time, &state.values[..]), (1.5, start));
        error
    };
    let other = |found| IntegratorsError::Field { t: 1.5, source: GravitationError::NotRegularisable { found } };
    assert_eq!(refused(&bodies.clone().with_softening(0.1).unwrap(), &start), other("softening is on"));
    let relative = bodies.clone().with_post_newtonian(PostNewtonian { centre: 0, speed_of_light: 1e4 }).unwrap();
    assert_eq!(refused(&relative, &start), other("the post-Newtonian term is on"));
    assert_eq!(refused(&Gravitation::new(vec![1.0]).unwrap(), &[0.0; 6]), other("there are fewer than two bodies"));
    assert_eq!(refused(&Gravitation::new(vec![1.0, 0.0, 1.0]).unwrap(), &start), other("a body has no mass"));
    let length = GravitationError::WrongLength { quantity: "state", expected: 18, found: 12 };
    assert_eq!(refused(&bodies, &start[..12]), IntegratorsError::Field { t: 1.5, source: length });
    let mut together = start.clone();
    together[1] = together[0];
    let meeting = GravitationError::CoincidentBodies { first: 0, second: 1 };
    assert_eq!(refused(&bodies, &together), IntegratorsError::Field { t: 1.5, source: meeting });
    let mut state = State::new(0.0, start.clone()).unwrap();
    let end = Regularised::to_rounding().integrate_to(&bodies, &mut state, f64::NAN);
    assert!(matches!(end, Err(IntegratorsError::NotFinite { quantity: "end", .. })));
    let error = Regularised::to_rounding().with_most_steps(7).integrate_to(&bodies, &mut state, 100.0).unwrap_err();
    assert!(
        matches!(error, IntegratorsError::TooManySteps { steps: 7, t } if t.to_bits() == state.time.to_bits()),
        "{error}"
    );
    assert!(0.0 < state.time);
    // What was reached goes on to the same end.
    let mut whole = State::new(0.0, start).unwrap();
    Regularised::to_rounding().integrate_to(&bodies, &mut whole, 3.0).unwrap();
    Regularised::to_rounding().integrate_to(&bodies, &mut state, 3.0).unwrap();
    assert_close_at_scale("goes on", &state.values, &whole.values, 1.0, Tol::stated(1e-12, "rounding of some steps"));
    // A run of no length, and one that is stopped.
    let report = Regularised::to_rounding().integrate_to(&bodies, &mut state, 3.0).unwrap();
    assert_eq!((report.steps, report.ending), (0, Ending::Reached));
    let report = Regularised::to_rounding().integrate(&bodies, &mut state, 9.0, |_| ControlFlow::Break(())).unwrap();
    assert_eq!((report.steps, report.ending), (1, Ending::Stopped));
}
