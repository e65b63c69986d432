//! Democratic heliocentric coordinates: orders, invariants, a reference trajectory, every scalar, and what is refused.

use std::ops::ControlFlow;

use piola_gravitation::wisdom_holman::{Corrector, DemocraticHeliocentric, Splitting};
use piola_gravitation::{Gravitation, GravitationError, PostNewtonian};
use piola_integrators::{Ending, GaussRadau15, IntegratorsError, State};
use piola_numerics::{Dual, Lanes, Real};
use piola_testkit::{Tol, allocations_in, assert_close, assert_close_at_scale, assert_order};

use crate::planets::{SPLITTINGS, outer_solar_system, planets};

/// The end of a run over any scalar.
fn end<T: Real>(bodies: &Gravitation, start: &[T], splitting: Splitting, step: f64, t: f64) -> Vec<T> {
    let mut state = State::new(0.0, start.to_vec()).unwrap();
    DemocraticHeliocentric::new(step, splitting).unwrap().integrate_to(bodies, &mut state, t).unwrap();
    state.values
}

/// The end of a run without splitting.
fn exact(bodies: &Gravitation, start: &[f64], t: f64) -> Vec<f64> {
    let mut state = State::new(0.0, start.to_vec()).unwrap();
    GaussRadau15::to_rounding().integrate_to(&mut bodies.clone(), &mut state, t).unwrap();
    state.values
}

/// The largest difference of the places.
fn error(found: &[f64], expected: &[f64]) -> f64 {
    let places = found.len() / 2;
    found[..places].iter().zip(expected).fold(0.0, |largest: f64, (a, b)| largest.max((a - b).abs()))
}

/// The largest error of the energy in a run, relative.
fn energy_error(bodies: &Gravitation, start: &[f64], splitting: Splitting, step: f64, t: f64) -> f64 {
    let before = bodies.invariants(start).energy;
    let mut largest = 0.0_f64;
    let method = DemocraticHeliocentric::new(step, splitting).unwrap();
    let run = method.integrate(bodies, &mut State::new(0.0, start.to_vec()).unwrap(), t, 1, |step| {
        largest = largest.max((bodies.invariants(step.values).energy / before - 1.0).abs());
        ControlFlow::Continue(())
    });
    run.unwrap();
    largest
}

#[test]
fn outer_planets_follow_their_reference() {
    let (bodies, start, reference) = outer_solar_system();
    for (splitting, step, error) in [
        (Splitting::Leapfrog, 100.0, 3e-3),
        (Splitting::Corrected(Corrector::Seventeen), 100.0, 3e-5),
        (Splitting::TenSixFour, 400.0, 1e-8),
        (Splitting::TenSixFour, 100.0, 1e-11),
    ] {
        let found = end(&bodies, &start, splitting, step, 200_000.0);
        let places: Vec<f64> = (0..6).flat_map(|body| bodies.position(&found, body)).collect();
        let tolerance = Tol::stated(error, "error of the splitting, measured");
        assert_close_at_scale(&format!("{splitting:?} of {step} days"), &places, &reference, 30.0, tolerance);
    }
}

#[test]
fn end_converges_with_the_square_of_the_step_over_two_decades() {
    let (bodies, start) = planets(3, 1e-3);
    let expected = exact(&bodies, &start, 8.0);
    let steps = [0.1, 0.032, 0.01, 0.0032, 0.001];
    let errors = steps.map(|step| error(&end(&bodies, &start, Splitting::Leapfrog, step, 8.0), &expected));
    assert_order("leapfrog", &steps, &errors, 2.0, 0.1);
}

#[test]
fn errors_fall_with_the_powers_of_step_and_mass_that_are_promised() {
    // Over two decades: ε² h² of the corrected map, and ε³ h⁴ with planets so heavy that it stands above rounding.
    let (bodies, start) = planets(3, 1e-3);
    let steps = [0.1, 0.032, 0.01, 0.0032, 0.001];
    for splitting in [Splitting::Leapfrog, Splitting::Corrected(Corrector::Seventeen)] {
        let errors = steps.map(|step| energy_error(&bodies, &start, splitting, step, 8.0));
        assert_order(&format!("{splitting:?}"), &steps, &errors, 2.0, 0.1);
    }
    let (bodies, start) = planets(3, 0.07);
    let steps = [0.2, 0.063, 0.02, 0.0063, 0.002];
    let errors = steps.map(|step| energy_error(&bodies, &start, Splitting::TenSixFour, step, 8.0));
    assert_order("(10, 6, 4)", &steps, &errors, 4.0, 0.1);
    // The correctors take away what is of first order in the masses, of the central body's motion too.
    let masses = [4e-4, 2e-4, 1e-4];
    for (splitting, order) in [(Splitting::Leapfrog, 1.0), (Splitting::Corrected(Corrector::Seventeen), 2.0)] {
        let errors = masses.map(|mass| {
            let (bodies, start) = planets(3, mass);
            energy_error(&bodies, &start, splitting, 0.1, 60.0)
        });
        assert_order(&format!("{splitting:?} in the mass"), &masses, &errors, order, 0.2);
    }
}

#[test]
fn end_converges_to_that_of_an_integrator_without_splitting() {
    // Ten planets fill one group of lanes and begin another; two have no mass.
    let (bodies, start) = planets(10, 1e-4);
    let mut parameters = bodies.parameters().to_vec();
    (parameters[2], parameters[9]) = (0.0, 0.0);
    let bodies = Gravitation::new(parameters).unwrap();
    let expected = exact(&bodies, &start, 20.0);
    for (splitting, step, error) in [
        (Splitting::Leapfrog, 0.02, 1e-6),
        (Splitting::Corrected(Corrector::Seventeen), 0.1, 1e-7),
        (Splitting::TenSixFour, 0.4, 1e-11),
    ] {
        let found = end(&bodies, &start, splitting, step, 20.0);
        let tolerance = Tol::stated(error, "error of the splitting, measured");
        assert_close_at_scale(&format!("{splitting:?}"), &found, &expected, 40.0, tolerance);
    }
}

/// All at rest: the planets fall.
#[test]
fn planets_fall_from_rest_as_without_splitting() {
    let (bodies, mut start) = planets(3, 1e-3);
    start[12..].fill(0.0);
    let expected = exact(&bodies, &start, 0.5);
    let found = end(&bodies, &start, Splitting::TenSixFour, 0.05, 0.5);
    let tolerance = Tol::stated(1e-12, "error of the splitting, measured");
    assert_close_at_scale("fall", &found, &expected, 1.0, tolerance);
}

#[test]
fn order_in_which_planets_are_listed_does_not_matter() {
    let (bodies, start) = planets(4, 1e-3);
    let order = [0, 3, 1, 4, 2];
    let listed = Gravitation::new(order.map(|body: usize| bodies.parameters()[body]).to_vec()).unwrap();
    let relisted = |values: &[f64]| values.chunks(5).flat_map(|x| order.map(|body| x[body])).collect::<Vec<f64>>();
    let found = end(&listed, &relisted(&start), Splitting::TenSixFour, 0.3, 30.0);
    let expected = relisted(&end(&bodies, &start, Splitting::TenSixFour, 0.3, 30.0));
    let rounding = Tol::ulps_because(2048.0, "a hundred steps, whose errors of the period add up");
    assert_close_at_scale("relisted", &found, &expected, 1.0, rounding);
}

#[test]
fn test_particles_change_planets_by_rounding_alone() {
    let (bodies, start) = planets(4, 1e-3);
    let with = |mass: f64| Gravitation::new([bodies.parameters(), &[mass]].concat()).unwrap();
    let place = [[3.0, 0.0, 0.1], [0.0, 0.5, 0.0]].concat();
    let joined: Vec<f64> = start.chunks(5).zip(&place).flat_map(|(x, own)| [x, &[*own]].concat()).collect();
    let alone = end(&bodies, &start, Splitting::TenSixFour, 0.3, 30.0);
    let found = end(&with(0.0), &joined, Splitting::TenSixFour, 0.3, 30.0);
    let planets: Vec<f64> = found.chunks(6).flat_map(|x| x[..5].to_vec()).collect();
    // The lanes of a motion iterate together.
    let rounding = Tol::ulps_because(2048.0, "a hundred steps, whose errors of the period add up");
    assert_close_at_scale("planets", &planets, &alone, 1.0, rounding);
    let heavy = end(&with(1e-6), &joined, Splitting::TenSixFour, 0.3, 30.0);
    assert!(1e3 * rounding.value() < error(&heavy[..5], &alone[..5]), "a body of some mass moves the others");
}

#[test]
fn momentum_and_angular_momentum_are_kept() {
    let (bodies, start) = planets(4, 1e-3);
    let before = bodies.invariants(&start);
    for splitting in SPLITTINGS {
        let found = bodies.invariants(&end(&bodies, &start, splitting, 0.3, 300.0));
        assert_close_at_scale("p", &found.momentum, &before.momentum, before.momentum_scale, Tol::ulps(8.0));
        let rounding = Tol::ulps_because(1024.0, "a thousand steps and more, each of some ulps");
        let scale = before.angular_momentum_scale;
        assert_close_at_scale("L", &found.angular_momentum, &before.angular_momentum, scale, rounding);
    }
}

#[test]
fn way_back_leads_to_the_start() {
    let (bodies, start) = planets(3, 1e-3);
    for splitting in SPLITTINGS {
        let mut state = State::new(0.0, start.clone()).unwrap();
        let method = DemocraticHeliocentric::new(0.3, splitting).unwrap();
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
        let method = DemocraticHeliocentric::new(0.25, splitting).unwrap();
        let mut seen = Vec::new();
        let mut watched = State::new(0.0, start.clone()).unwrap();
        let report = method.integrate(&bodies, &mut watched, 50.0, 7, |step| {
            seen.push((step.number, step.time, step.values.to_vec()));
            ControlFlow::Continue(())
        });
        assert_eq!(watched.values, end(&bodies, &start, splitting, 0.25, 50.0), "{splitting:?}");
        assert_eq!(report.unwrap().evaluations, 200 * splitting.attractions() as u64);
        assert!(seen.iter().map(|(number, ..)| *number).eq((1..=28).map(|k| 7 * k).chain([200])));
        let (number, t, values) = &seen[9];
        assert_eq!((*number, *t), (70, 17.5));
        // A run that ends there does not make the first motion of a next step, which a look takes back.
        let rounding = Tol::ulps(64.0);
        assert_close_at_scale("look", values, &end(&bodies, &start, splitting, 0.25, 17.5), 1.0, rounding);
        let mut stopped = State::new(0.0, start.clone()).unwrap();
        let report = method.integrate(&bodies, &mut stopped, 50.0, 70, |_| ControlFlow::Break(())).unwrap();
        assert_eq!((report.ending, report.steps, stopped.time), (Ending::Stopped, 70, 17.5));
        assert_eq!(&stopped.values, values);
    }
}

#[test]
fn steps_allocate_nothing() {
    let (bodies, start) = planets(9, 1e-4);
    let method = DemocraticHeliocentric::new(0.25, Splitting::Corrected(Corrector::Seventeen)).unwrap();
    let counts = [10.0, 1000.0].map(|t| {
        let mut state = State::new(0.0, start.clone()).unwrap();
        allocations_in(|| method.integrate(&bodies, &mut state, t, 5, |_| ControlFlow::Continue(())).unwrap()).0
    });
    assert_eq!(counts[0], counts[1]);
}

#[test]
fn lanes_follow_as_many_systems_as_there_are() {
    let (bodies, start) = planets(3, 1e-3);
    let other = planets(3, 2e-3).1;
    let lanes: Vec<Lanes<f64, 2>> = start.iter().zip(&other).map(|(a, b)| Lanes([*a, *b])).collect();
    let together = end(&bodies, &lanes, Splitting::TenSixFour, 0.3, 30.0);
    // A motion may take another way to the same root, by as many ulps as Kepler's motion has.
    let rounding = Tol::ulps_because(2048.0, "a hundred steps, whose errors of the period add up");
    for (lane, start) in [start, other].iter().enumerate() {
        let found: Vec<f64> = together.iter().map(|x| x.0[lane]).collect();
        let alone = end(&bodies, start, Splitting::TenSixFour, 0.3, 30.0);
        assert_close_at_scale(&format!("lane {lane}"), &found, &alone, 1.0, rounding);
    }
}

#[test]
fn derivatives_by_the_start_are_those_of_a_run_without_splitting() {
    let (bodies, start) = planets(3, 1e-3);
    for component in [1, 6, 13, 22] {
        let seeded = start.iter().enumerate().map(|(i, &x)| Dual::new(x, if i == component { 1.0 } else { 0.0 }));
        let seeded: Vec<Dual<f64>> = seeded.collect();
        let mut state = State::new(0.0, seeded.clone()).unwrap();
        GaussRadau15::to_rounding().integrate_to(&mut bodies.clone(), &mut state, 5.0).unwrap();
        let tangents = |values: &[Dual<f64>]| values.iter().map(|x| x.tangent).collect::<Vec<f64>>();
        let found = tangents(&end(&bodies, &seeded, Splitting::TenSixFour, 0.05, 5.0));
        let tolerance = Tol::stated(1e-12, "error of the splitting, measured");
        assert_close_at_scale(&format!("by {component}"), &found, &tangents(&state.values), 10.0, tolerance);
    }
}

#[test]
fn single_precision_ends_within_its_rounding() {
    let (bodies, start) = planets(3, 1e-3);
    #[expect(clippy::cast_possible_truncation, reason = "the start of a run in single precision")]
    let single: Vec<f32> = start.iter().map(|&x| x as f32).collect();
    let double: Vec<f64> = single.iter().map(|&x| f64::from(x)).collect();
    let found: Vec<f64> = end(&bodies, &single, Splitting::TenSixFour, 0.3, 10.0).into_iter().map(f64::from).collect();
    let expected = end(&bodies, &double, Splitting::TenSixFour, 0.3, 10.0);
    assert_close_at_scale("f32", &found, &expected, 1.0, Tol::ulps32(256.0));
}

fn refused(bodies: &Gravitation, start: &[f64]) -> IntegratorsError<GravitationError> {
    let mut state = State::new(1.5, start.to_vec()).unwrap();
    let method = DemocraticHeliocentric::new(0.25, Splitting::Leapfrog).unwrap();
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
    let mut together = start.clone();
    for component in 0..3 {
        together[3 * component + 2] = together[3 * component + 1];
    }
    assert_eq!(refused(&bodies, &together), field(GravitationError::CoincidentBodies { first: 1, second: 2 }));
    for step in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = DemocraticHeliocentric::new(step, Splitting::Leapfrog).unwrap_err();
        assert!(matches!(error, IntegratorsError::InvalidStep { step: found } if found.to_bits() == step.to_bits()));
    }
    let mut state = State::new(0.0, start).unwrap();
    state.values[4] = f64::NAN;
    let method = DemocraticHeliocentric::new(0.25, Splitting::Leapfrog).unwrap();
    let Err(IntegratorsError::Field { source, .. }) = method.integrate_to(&bodies, &mut state, 1.0) else {
        panic!("NaN was taken")
    };
    assert!(matches!(source, GravitationError::NotFinite { quantity: "state", index: 4, .. }), "{source}");
    state.values[4] = 0.0;
    let error = method.integrate_to(&bodies, &mut state, f64::INFINITY).unwrap_err();
    assert_eq!(error, IntegratorsError::NotFinite { quantity: "end", index: 0, value: f64::INFINITY, t: None });
}

/// Test particles fly into a resting planet, all too far away from the centre to be drawn: its attraction is infinite in the middle
/// of the fifth step.
#[test]
fn failed_run_keeps_its_last_good_state() {
    let bodies = Gravitation::new(vec![1.0, 0.0, 1e-30]).unwrap();
    let start =
        bodies.state(&[[0.0; 3], [1e8, 4.5, 0.0], [1e8, 0.0, 0.0]], &[[0.0; 3], [0.0, -1.0, 0.0], [0.0; 3]]).unwrap();
    let mut state = State::new(0.0, start).unwrap();
    let method = DemocraticHeliocentric::new(1.0, Splitting::Leapfrog).unwrap();
    let error = method.integrate_to(&bodies, &mut state, 20.0).unwrap_err();
    assert!(matches!(error, IntegratorsError::NotFinite { quantity: "state", t: Some(4.0), .. }), "{error}");
    assert_eq!((state.time, bodies.velocity(&state.values, 1)[1]), (4.0, -1.0));
    assert_close("place", &bodies.position(&state.values, 1)[1..], &[0.5, 0.0], Tol::ulps(4.0));
}

#[test]
fn same_run_gives_the_same_bits() {
    let (bodies, start) = planets(3, 1e-3);
    let run = || end(&bodies, &start, Splitting::TenSixFour, 0.3, 30.0).into_iter().map(f64::to_bits);
    assert!(run().eq(run()));
}
