//! The map of Wisdom and Holman: orders, invariants, reference trajectories, and what it refuses.

use std::ops::ControlFlow;

use piola_gravitation::wisdom_holman::{Corrector, Splitting, WisdomHolman};
use piola_gravitation::{Gravitation, GravitationError, PostNewtonian};
use piola_integrators::{Ending, GaussRadau15, IntegratorsError, State};
use piola_testkit::{Tol, allocations_in, assert_close_at_scale, assert_order};

use crate::planets::{SPLITTINGS, outer_solar_system, planets};

/// The end of a run.
fn end(bodies: &Gravitation, start: &[f64], splitting: Splitting, step: f64, time: f64) -> Vec<f64> {
    let mut state = State::new(0.0, start.to_vec()).unwrap();
    WisdomHolman::new(step, splitting).unwrap().integrate_to(bodies, &mut state, time).unwrap();
    state.values
}

/// The largest error of the energy in a run, relative.
fn energy_error(bodies: &Gravitation, start: &[f64], splitting: Splitting, step: f64, time: f64) -> f64 {
    let before = bodies.invariants(start).energy;
    let mut state = State::new(0.0, start.to_vec()).unwrap();
    let mut largest = 0.0_f64;
    let method = WisdomHolman::new(step, splitting).unwrap();
    let run = method.integrate(bodies, &mut state, time, 1, |step| {
        largest = largest.max((bodies.invariants(step.values).energy / before - 1.0).abs());
        ControlFlow::Continue(())
    });
    run.unwrap();
    largest
}

/// 548 years of the outer planets against a solution of 30 digits.
#[test]
fn outer_planets_follow_their_reference() {
    let (bodies, start, reference) = outer_solar_system();
    for (splitting, step, error) in [
        (Splitting::Leapfrog, 100.0, 2e-3),
        (Splitting::Corrected(Corrector::Seventeen), 100.0, 1e-5),
        (Splitting::TenSixFour, 400.0, 1e-8),
        (Splitting::TenSixFour, 100.0, 1e-11),
    ] {
        let found = end(&bodies, &start, splitting, step, 200_000.0);
        let places: Vec<f64> = (0..6).flat_map(|body| bodies.position(&found, body)).collect();
        let what = format!("{splitting:?} of {step} days");
        let tolerance = Tol::stated(error, "error of the splitting, measured");
        assert_close_at_scale(&what, &places, &reference, 30.0, tolerance);
    }
}

#[test]
fn end_converges_with_the_square_of_the_step_over_two_decades() {
    let (bodies, start) = planets(3, 1e-3);
    let mut exact = State::new(0.0, start.clone()).unwrap();
    GaussRadau15::to_rounding().integrate_to(&mut bodies.clone(), &mut exact, 8.0).unwrap();
    let steps = [0.1, 0.032, 0.01, 0.0032, 0.001];
    let errors = steps.map(|step| {
        let found = end(&bodies, &start, Splitting::Leapfrog, step, 8.0);
        found.iter().zip(&exact.values).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    });
    assert_order("leapfrog", &steps, &errors, 2.0, 0.1);
}

#[test]
fn errors_fall_with_the_powers_of_step_and_mass_that_are_promised() {
    // Of the step: ε² h² for the corrected one, whose first order is gone, over two decades.
    let (bodies, start) = planets(3, 1e-3);
    let steps = [0.1, 0.032, 0.01, 0.0032, 0.001];
    for splitting in [Splitting::Leapfrog, Splitting::Corrected(Corrector::Seventeen)] {
        let errors = steps.map(|step| energy_error(&bodies, &start, splitting, step, 8.0));
        assert_order(&format!("{splitting:?}"), &steps, &errors, 2.0, 0.1);
    }
    // ε³ h⁴, with planets so heavy that two decades stand above rounding; ε h¹⁰ and ε² h⁶ add to it where steps are long.
    let (bodies, start) = planets(3, 0.07);
    let steps = [0.2, 0.063, 0.02, 0.0063, 0.002];
    let errors = steps.map(|step| energy_error(&bodies, &start, Splitting::TenSixFour, step, 8.0));
    assert_order("(10, 6, 4)", &steps, &errors, 4.0, 0.1);
    // Of the mass, at one step: ε, of which a planet's energy has one already, and ε².
    let masses = [4e-4, 2e-4, 1e-4];
    for (splitting, order) in [(Splitting::Leapfrog, 1.0), (Splitting::Corrected(Corrector::Seventeen), 2.0)] {
        let errors = masses.map(|mass| {
            let (bodies, start) = planets(3, mass);
            energy_error(&bodies, &start, splitting, 0.1, 60.0)
        });
        assert_order(&format!("{splitting:?} in the mass"), &masses, &errors, order, 0.2);
    }
}

/// A correction of order k leaves ε h^(k+1), above ε² h² only where ε < h^(k−1), and above rounding only where ε h^(k+1) is: no
/// mass shows it over two decades in double precision. A scalar of more digits would not help: the series of Kepler's motion and
/// the coefficients of the correctors are doubles. So the steps go as far down as each order can be seen.
#[test]
fn corrections_leave_the_power_of_the_step_that_follows_their_order() {
    let (bodies, start) = planets(3, 1e-6);
    for (corrector, steps, order, within) in [
        (Corrector::Three, &[0.4, 0.2, 0.1, 0.05, 0.025][..], 4.0, 0.1),
        (Corrector::Five, &[0.4, 0.2, 0.1, 0.07], 6.0, 0.2),
        (Corrector::Seven, &[0.4, 0.28, 0.2, 0.14], 8.0, 0.4),
    ] {
        let error = |&step| energy_error(&bodies, &start, Splitting::Corrected(corrector), step, 12.0);
        let errors: Vec<f64> = steps.iter().map(error).collect();
        assert_order(&format!("{corrector:?}"), steps, &errors, order, within);
    }
}

#[test]
fn end_converges_to_that_of_an_integrator_without_splitting() {
    // Ten planets fill one group of lanes and begin another; the last but one has no mass.
    let (bodies, start) = planets(10, 1e-4);
    let mut parameters = bodies.parameters().to_vec();
    parameters[9] = 0.0;
    let mut bodies = Gravitation::new(parameters).unwrap();
    let mut state = State::new(0.0, start.clone()).unwrap();
    GaussRadau15::to_rounding().integrate_to(&mut bodies, &mut state, 20.0).unwrap();
    for (splitting, step, error) in [
        (Splitting::Leapfrog, 0.02, 1e-6),
        (Splitting::Corrected(Corrector::Seventeen), 0.1, 1e-7),
        (Splitting::TenSixFour, 0.4, 1e-12),
    ] {
        let found = end(&bodies, &start, splitting, step, 20.0);
        let tolerance = Tol::stated(error, "error of the splitting, measured");
        assert_close_at_scale(&format!("{splitting:?}"), &found, &state.values, 40.0, tolerance);
    }
}

#[test]
fn one_planet_moves_on_its_ellipse_whatever_the_step() {
    let (bodies, start) = planets(1, 0.1);
    let [x, v] = [0, 3].map(|half| [0, 1, 2].map(|i| start[2 * (half + i) + 1] - start[2 * (half + i)]));
    let ellipse = piola_gravitation::kepler::KeplerMotion::new(1.1, x, v).unwrap();
    for splitting in SPLITTINGS {
        let found = end(&bodies, &start, splitting, 0.5, 10.0);
        let (centre, planet) = (bodies.position(&found, 0), bodies.position(&found, 1));
        let relative = [0, 1, 2].map(|i| planet[i] - centre[i]);
        let tolerance =
            Tol::ulps_because(1024.0, "twenty steps and sixteen of the corrector, whose errors of the period add up");
        assert_close_at_scale(&format!("{splitting:?}"), &relative, &ellipse.position(10.0), 1.0, tolerance);
    }
}

#[test]
fn momentum_and_angular_momentum_are_kept() {
    let (bodies, start) = planets(4, 1e-3);
    let before = bodies.invariants(&start);
    for splitting in SPLITTINGS {
        let found = bodies.invariants(&end(&bodies, &start, splitting, 0.3, 300.0));
        let rounding = Tol::ulps_because(1024.0, "a thousand steps and more, each of some ulps");
        assert_close_at_scale("p", &found.momentum, &before.momentum, before.momentum_scale, rounding);
        let scale = before.angular_momentum_scale;
        assert_close_at_scale("L", &found.angular_momentum, &before.angular_momentum, scale, rounding);
    }
}

#[test]
fn way_back_leads_to_the_start() {
    let (bodies, start) = planets(3, 1e-3);
    for splitting in SPLITTINGS {
        let mut state = State::new(0.0, start.clone()).unwrap();
        let method = WisdomHolman::new(0.3, splitting).unwrap();
        method.integrate_to(&bodies, &mut state, 30.0).unwrap();
        method.integrate_to(&bodies, &mut state, 0.0).unwrap();
        let rounding = Tol::ulps_because(2048.0, "two hundred steps, whose errors of the period add up");
        assert_close_at_scale(&format!("{splitting:?}"), &state.values, &start, 1.0, rounding);
    }
}

#[test]
fn looking_does_not_change_the_run_and_may_end_it() {
    let (bodies, start) = planets(3, 1e-3);
    for splitting in SPLITTINGS {
        let method = WisdomHolman::new(0.25, splitting).unwrap();
        let mut seen = Vec::new();
        let mut watched = State::new(0.0, start.clone()).unwrap();
        let report = method.integrate(&bodies, &mut watched, 200.0, 7, |step| {
            seen.push((step.number, step.time, step.values.to_vec()));
            ControlFlow::Continue(())
        });
        assert_eq!(watched.values, end(&bodies, &start, splitting, 0.25, 200.0), "{splitting:?}");
        let report = report.unwrap();
        assert_eq!((report.steps, report.evaluations), (800, 800 * splitting.attractions() as u64));
        assert!(seen.iter().map(|(number, ..)| *number).eq((1..=114).map(|k| 7 * k).chain([800])));
        // What is shown on the way is what a run ends with that is made of steps of the same length.
        let (number, time, values) = &seen[9];
        assert_eq!((*number, *time), (70, 17.5));
        assert_eq!(values, &end(&bodies, &start, splitting, 0.25, 17.5));
        // More steps between two looks than are made at once.
        let mut seldom = Vec::new();
        let run = method.integrate(&bodies, &mut State::new(0.0, start.clone()).unwrap(), 200.0, 300, |step| {
            seldom.push(step.number);
            ControlFlow::Continue(())
        });
        assert_eq!((run.unwrap().steps, &seldom[..]), (800, &[300, 600, 800][..]));
        let mut stopped = State::new(0.0, start.clone()).unwrap();
        let report = method.integrate(&bodies, &mut stopped, 200.0, 70, |_| ControlFlow::Break(())).unwrap();
        assert_eq!((report.ending, report.steps, stopped.time), (Ending::Stopped, 70, 17.5));
        assert_eq!(&stopped.values, values);
    }
}

#[test]
fn steps_allocate_nothing() {
    let (bodies, start) = planets(9, 1e-4);
    let method = WisdomHolman::new(0.25, Splitting::Corrected(Corrector::Seventeen)).unwrap();
    let mut counts = [10.0, 1000.0].map(|time| {
        let mut state = State::new(0.0, start.clone()).unwrap();
        allocations_in(|| method.integrate(&bodies, &mut state, time, 5, |_| ControlFlow::Continue(())).unwrap()).0
    });
    counts.sort_unstable();
    assert_eq!(counts[0], counts[1]);
}

fn refused(bodies: &Gravitation, start: &[f64]) -> IntegratorsError<GravitationError> {
    let mut state = State::new(1.5, start.to_vec()).unwrap();
    let method = WisdomHolman::new(0.25, Splitting::Leapfrog).unwrap();
    let error = method.integrate_to(bodies, &mut state, 10.0).unwrap_err();
    assert_eq!((state.time, &state.values[..]), (1.5, start));
    error
}

#[test]
fn other_forces_and_states_are_refused() {
    let (bodies, start) = planets(2, 1e-3);
    let field = |source| IntegratorsError::Field { t: 1.5, source };
    let soft = bodies.clone().with_softening(0.1).unwrap();
    assert_eq!(refused(&soft, &start), field(GravitationError::NotKeplerian { force: "softening" }));
    let relative = bodies.clone().with_post_newtonian(PostNewtonian { centre: 0, speed_of_light: 1e4 }).unwrap();
    let post_newtonian = GravitationError::NotKeplerian { force: "the post-Newtonian term" };
    assert_eq!(refused(&relative, &start), field(post_newtonian));
    let free = Gravitation::new(vec![0.0, 1.0, 1.0]).unwrap();
    assert_eq!(refused(&free, &start), field(GravitationError::MasslessCentre { body: 0 }));
    let length = GravitationError::WrongLength { quantity: "state", expected: 18, found: 12 };
    assert_eq!(refused(&bodies, &start[..12]), field(length));
    let mut together = start;
    for component in 0..3 {
        together[3 * component + 2] = together[3 * component + 1];
    }
    assert_eq!(refused(&bodies, &together), field(GravitationError::CoincidentBodies { first: 1, second: 2 }));
    for step in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = WisdomHolman::new(step, Splitting::Leapfrog).unwrap_err();
        assert!(matches!(error, IntegratorsError::InvalidStep { step: found } if found.to_bits() == step.to_bits()));
    }
    let none = Gravitation::new(Vec::new()).unwrap();
    assert_eq!(refused(&none, &[]), field(GravitationError::MasslessCentre { body: 0 }));
}

/// A test particle flies into a resting planet, both too far away from the centre to be drawn: its attraction is infinite in
/// the middle of the fifth step.
#[test]
fn failed_run_keeps_its_last_good_state() {
    let bodies = Gravitation::new(vec![1.0, 0.0, 1e-30]).unwrap();
    let start =
        bodies.state(&[[0.0; 3], [1e8, 4.5, 0.0], [1e8, 0.0, 0.0]], &[[0.0; 3], [0.0, -1.0, 0.0], [0.0; 3]]).unwrap();
    let mut state = State::new(0.0, start).unwrap();
    let method = WisdomHolman::new(1.0, Splitting::Leapfrog).unwrap();
    let mut seen = Vec::new();
    let error = method.integrate(&bodies, &mut state, 20.0, 1, |step| {
        seen.push(step.time);
        ControlFlow::Continue(())
    });
    let error = error.unwrap_err();
    assert!(matches!(error, IntegratorsError::NotFinite { quantity: "state", t: Some(4.0), .. }), "{error}");
    assert_eq!((state.time, &seen[..]), (4.0, &[1.0, 2.0, 3.0, 4.0][..]));
    assert_eq!((bodies.position(&state.values, 1), bodies.velocity(&state.values, 1)[1]), ([1e8, 0.5, 0.0], -1.0));
}

#[cfg(feature = "serde")]
#[test]
fn splitting_is_read_as_it_was_written() {
    for splitting in SPLITTINGS {
        let text = serde_json::to_string(&splitting).unwrap();
        assert_eq!(serde_json::from_str::<Splitting>(&text).unwrap(), splitting);
    }
}

#[test]
fn end_that_is_not_finite_is_refused_by_name() {
    let bodies = Gravitation::new(vec![1.0, 1e-3]).unwrap();
    let start = bodies.state(&[[0.0; 3], [1.0, 0.0, 0.0]], &[[0.0; 3], [0.0, 1.0, 0.0]]).unwrap();
    let mut state = State::new(0.0, start.clone()).unwrap();
    for end in [f64::NAN, f64::INFINITY] {
        let result = WisdomHolman::new(0.1, Splitting::Leapfrog).unwrap().integrate_to(&bodies, &mut state, end);
        assert!(matches!(result, Err(IntegratorsError::NotFinite { quantity: "end", index: 0, .. })), "{result:?}");
        assert_eq!(state.values, start);
    }
}
