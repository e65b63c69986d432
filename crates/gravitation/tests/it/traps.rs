//! What goes wrong silently elsewhere: each case is answered by name.

use piola_gravitation::{Gravitation, GravitationError, PostNewtonian};
use piola_integrators::{Composition, DormandPrince853, GaussLegendre, IntegratorsError, Order, State, Tolerance};
use piola_testkit::{Tol, assert_close};

fn refusal<T: core::fmt::Debug>(result: Result<T, GravitationError>) -> GravitationError {
    result.expect_err("this must be refused")
}

#[test]
fn lengths_that_differ_are_refused_by_name() {
    let named = |error: GravitationError| {
        let GravitationError::WrongLength { quantity, expected, found } = error else { panic!("{error}") };
        (quantity, expected, found)
    };
    let mut pair = Gravitation::new(vec![1.0; 2]).unwrap();
    assert_eq!(named(refusal(pair.accelerations_into(&[0.0; 5], &mut [0.0; 6]))), ("positions", 6, 5));
    assert_eq!(named(refusal(pair.state(&[[0.0; 3]], &[[0.0; 3]; 2]))), ("positions", 2, 1));
}

#[test]
fn bodies_in_one_place_are_named_before_a_run() {
    let place = |gm: Vec<f64>| {
        let bodies = Gravitation::new(gm)?;
        bodies.state(&[[1.0, 0.0, 2.0], [3.0; 3], [1.0, -0.0, 2.0]], &[[0.0; 3]; 3])
    };
    assert_eq!(refusal(place(vec![1.0, 1.0, 1.0])), GravitationError::CoincidentBodies { first: 0, second: 2 });
    assert_eq!(refusal(place(vec![0.0, 1.0, 1.0])), GravitationError::CoincidentBodies { first: 0, second: 2 });
    assert!(place(vec![0.0, 1.0, 0.0]).is_ok()); // test particles do not feel each other
    let soft = Gravitation::new(vec![1.0; 2]).unwrap().with_softening(0.5).unwrap();
    assert!(soft.state(&[[0.0; 3]; 2], &[[0.0; 3]; 2]).is_ok());
    let soft = soft.with_post_newtonian(PostNewtonian::of(1)).unwrap(); // nothing softens this term
    assert!(matches!(soft.state(&[[0.0; 3]; 2], &[[0.0; 3]; 2]), Err(GravitationError::CoincidentBodies { .. })));
    // Places that are no numbers are no place: nothing is found, nothing panics.
    let nan = vec![f64::NAN; 18];
    assert_eq!(Gravitation::new(vec![1.0; 3]).unwrap().coincident(&nan), None);
}

#[test]
fn bodies_that_collide_during_a_run_are_named() {
    // Two bodies fly towards each other and meet, to the last bit, in the middle of a fixed step.
    let start = |bodies: &Gravitation| {
        State::new(
            0.0,
            bodies
                .state(
                    &[[8.0, 9.0, 7.0], [1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]],
                    &[[0.0; 3], [-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]],
                )
                .unwrap(),
        )
        .unwrap()
    };
    // So light that they do not attract noticeably; after one second they are in one place.
    let mut bodies = Gravitation::new(vec![0.0, 1e-30, 1e-30]).unwrap();
    let mut state = start(&bodies);
    let outcome = Composition::new(Order::Two, 2.0).unwrap().integrate_to(&mut bodies, &mut state, 4.0);
    let Err(IntegratorsError::Field { t: time, source }) = outcome else { panic!("{outcome:?}") };
    assert_eq!(source, GravitationError::CoincidentBodies { first: 1, second: 2 });
    assert!((time - 1.0).abs() < f64::EPSILON);
    assert!(state.time <= 0.0, "the last good state is kept");

    let mut state = start(&bodies);
    let outcome = GaussLegendre::new(Order::Two, 2.0).unwrap().integrate_to(&mut bodies, &mut state, 4.0);
    assert!(matches!(outcome, Err(IntegratorsError::Field { .. })), "{outcome:?}");

    // An adaptive method steps around what is as narrow as that, or says so.
    let mut heavy = Gravitation::new(vec![0.0, 1.0, 1.0]).unwrap();
    let mut state = start(&heavy);
    let outcome = DormandPrince853::new(Tolerance::relative(1e-10).unwrap())
        .with_most_steps(100_000)
        .integrate_to(&mut heavy, &mut state, 4.0);
    assert!(outcome.is_err(), "{outcome:?}");
}

#[test]
fn impossible_parameters_of_attraction_are_refused() {
    let new = |gm: f64| Gravitation::new(vec![1.0, gm]);
    assert_eq!(refusal(new(-1.0)), GravitationError::InvalidGravitationalParameter { body: 1, value: -1.0 });
    assert!(new(f64::NAN).is_err() && new(f64::INFINITY).is_err() && new(0.0).is_ok());
    for softening in [-1.0, f64::NAN, f64::INFINITY] {
        assert!(new(1.0).unwrap().with_softening(softening).is_err());
    }
    let term = |centre, speed_of_light| new(0.0).unwrap().with_post_newtonian(PostNewtonian { centre, speed_of_light });
    assert_eq!(refusal(term(2, 1.0)), GravitationError::NoSuchBody { body: 2, bodies: 2 });
    assert_eq!(refusal(term(1, 1.0)), GravitationError::MasslessCentre { body: 1 });
    assert_eq!(refusal(term(0, 0.0)), GravitationError::InvalidSpeedOfLight { value: 0.0 });
    assert!(term(0, f64::NAN).is_err());
    let nan = new(1.0).unwrap().state(&[[0.0; 3], [1.0, f64::NAN, 0.0]], &[[0.0; 3]; 2]);
    assert!(matches!(refusal(nan), GravitationError::NotFinite { quantity: "positions", index: 4, .. }));
}

#[test]
fn no_bodies_and_one_body_are_systems() {
    for n in [0, 1] {
        let mut bodies = Gravitation::new(vec![1.0; n]).unwrap();
        let start = bodies.state(&vec![[1.0; 3]; n], &vec![[2.0; 3]; n]).unwrap();
        let mut state = State::new(0.0, start).unwrap();
        Composition::new(Order::Four, 0.5).unwrap().integrate_to(&mut bodies, &mut state, 1.0).unwrap();
        assert_close("x", &state.values[..3 * n], &vec![3.0; 3 * n], Tol::ulps(4.0));
    }
}

#[cfg(feature = "serde")]
#[test]
fn written_gravitation_is_checked_when_read() {
    let bodies = Gravitation::new(vec![2.0, 1.0]).unwrap().with_post_newtonian(PostNewtonian::of(0)).unwrap();
    let text = serde_json::to_string(&bodies).unwrap();
    let read: Gravitation = serde_json::from_str(&text).unwrap();
    assert_eq!((read.parameters(), read.post_newtonian()), (bodies.parameters(), bodies.post_newtonian()));
    let refused = serde_json::from_str::<Gravitation>(r#"{"parameters": [1.0, -1.0]}"#).unwrap_err();
    assert!(refused.to_string().contains("must satisfy 0 ≤ Gm"), "{refused}");
    assert!(serde_json::from_str::<Gravitation>(r#"{"parameters": [1.0], "mass": 1.0}"#).is_err());
}

#[test]
fn nystrom_pairs_follow_newton_and_refuse_the_post_newtonian_term() {
    let bodies = Gravitation::new(vec![1.0, 1e-3]).unwrap();
    let start = bodies.state(&[[0.0; 3], [1.0, 0.0, 0.0]], &[[0.0; 3], [0.0, 1.0, 0.0]]).unwrap();
    let tolerance = Tolerance::relative(1e-13).unwrap();
    let (mut state, mut other) = (State::new(0.0, start.clone()).unwrap(), State::new(0.0, start.clone()).unwrap());
    let mut newton = bodies.clone();
    piola_integrators::Nystrom1210::new(tolerance).integrate_to(&mut newton, &mut state, 20.0).unwrap();
    piola_integrators::GaussRadau15::to_rounding().integrate_to(&mut newton, &mut other, 20.0).unwrap();
    let tol = Tol::stated(1e-11, "twenty steps of tolerance 1e-13, amplified by three revolutions");
    assert_close("places and velocities", &state.values, &other.values, tol);
    let term = PostNewtonian { centre: 0, speed_of_light: 1e4 };
    let mut relativistic = bodies.with_post_newtonian(term).unwrap();
    let mut state = State::new(0.0, start).unwrap();
    let run = piola_integrators::Nystrom1210::new(tolerance).integrate_to(&mut relativistic, &mut state, 1.0);
    assert!(matches!(run, Err(IntegratorsError::VelocityDependent)));
}
