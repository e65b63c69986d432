//! Runs that are stopped at some step, written down, read and continued: to the last bit the runs that nobody stopped.

use std::ops::ControlFlow;

use piola_gravitation::hybrid::{HybridSymplectic, critical_radii};
use piola_gravitation::regularised::Regularised;
use piola_gravitation::wisdom_holman::{Corrector, DemocraticHeliocentric, Splitting, WisdomHolman};
use piola_gravitation::{Gravitation, GravitationError};
use piola_integrators::{Checkpoint, Ending, IntegratorsError, State, Step};
use piola_numerics::{Dual, Real};
use piola_testkit::golden;

use crate::planets::{SPLITTINGS, planets, reference, triples};

/// As it is read from a file.
fn written(kept: &Checkpoint) -> Checkpoint {
    serde_json::from_str(&serde_json::to_string(kept).unwrap()).unwrap()
}

fn stop<T>(at: u64) -> impl FnMut(Step<'_, T>) -> ControlFlow<()> {
    move |step| if step.number == at { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
}

fn go_on<T>(_step: Step<'_, T>) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// Another state, which a continued run overwrites.
fn elsewhere() -> State {
    State::new(7.0, vec![1.0]).unwrap()
}

/// Each number as the other one, but for rounding that the way magnifies.
fn assert_near(found: &[f64], expected: &[f64], bound: f64, what: &impl std::fmt::Display) {
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() < bound, "{what}: {found} and {expected}");
    }
}

/// The steps after which the observers stop.
const STOPS: [u64; 4] = [1, 2, 31, 99];

/// The continued runs of a map equal the whole one, whichever step they were stopped at, also after a second stop.
macro_rules! assert_continues {
    ($what:expr, $method:expr, $bodies:expr, $start:expr, $end:expr) => {
        assert_continues!($what, $method, $method, $bodies, $start, $end)
    };
    // `anew` begins runs on the way as `method` continues them.
    ($what:expr, $method:expr, $anew:expr, $bodies:expr, $start:expr, $end:expr) => {
        let (what, method, bodies, start) = ($what, $method, $bodies, || State::new(0.0, $start.clone()).unwrap());
        let end: f64 = $end;
        let mut whole = start();
        let (report, _) = method.integrate_to_checkpoint(bodies, &mut whole, end, 1, go_on).unwrap();
        for at in STOPS {
            let (mut stopped, mut continued) = (start(), elsewhere());
            let (first, kept) = method.integrate_to_checkpoint(bodies, &mut stopped, end, 1, stop(at)).unwrap();
            assert_eq!(kept.state(), &stopped, "{what}, stopped at {at}");
            let (_, again) = method.resume(bodies, &written(&kept), &mut continued, end, 1, stop(at + 3)).unwrap();
            let (second, last) = method.resume(bodies, &written(&again), &mut continued, end, 1, go_on).unwrap();
            assert_eq!(continued, whole, "{what}, stopped at {at}");
            assert_eq!(second, report, "{what}, stopped at {at}");
            // Of a run that has come to its end nothing is left, and it goes on to another one.
            assert_eq!(method.resume(bodies, &last, &mut continued, end, 1, go_on).unwrap().0, report, "{what}");
            assert_eq!(continued, whole, "{what}");
            for (kept, other) in [(&last, 1.2 * end), (&kept, 0.7 * end)] {
                let (third, _) = method.resume(bodies, kept, &mut continued, other, 0, go_on).unwrap();
                let mut begun = State::new(kept.state().time, kept.state().values.clone()).unwrap();
                $anew.integrate_to(bodies, &mut begun, other).unwrap();
                assert!(first != third && continued.time.to_bits() == other.to_bits(), "{what}");
                assert_near(&continued.values, &begun.values, 1e-12, &what);
            }
        }
    };
}

#[test]
fn maps_of_planets_continue_from_any_step() {
    // Ten planets are two groups of lanes.
    for (count, mass) in [(3, 1e-3), (10, 1e-6)] {
        let (bodies, start) = planets(count, mass);
        for splitting in SPLITTINGS {
            let jacobi = WisdomHolman::new(0.1, splitting).unwrap();
            assert_continues!(format!("Jacobi, {splitting:?}"), jacobi, &bodies, start, 10.4);
            let heliocentric = DemocraticHeliocentric::new(0.1, splitting).unwrap();
            assert_continues!(format!("heliocentric, {splitting:?}"), heliocentric, &bodies, start, 10.4);
        }
    }
}

/// Planets that meet at t = 9.6, within steps that are stopped before, in and after the encounter.
fn meeting() -> (Gravitation, Vec<f64>) {
    let data = reference("planet_encounter");
    let bodies = Gravitation::new(golden::vector(&data["masses"])).unwrap();
    let start = bodies.state(&triples(&data["positions"]), &triples(&data["velocities"])).unwrap();
    (bodies, start)
}

#[test]
fn runs_through_encounters_continue_from_any_step() {
    let (bodies, start) = meeting();
    for splitting in [Splitting::Leapfrog, Splitting::TenSixFour] {
        let method = HybridSymplectic::new(0.1, splitting).unwrap();
        // Three Hill radii are longer than what a planet travels in the step.
        let critical = critical_radii(&bodies, &start, 3.0, 0.1).unwrap();
        let anew = method.clone().with_critical_radii(critical).unwrap();
        assert_continues!(format!("{splitting:?}"), &method, &anew, &bodies, start, 12.0);
        let mut state = State::new(0.0, start.clone()).unwrap();
        let (report, _) = method.integrate_to_checkpoint(&bodies, &mut state, 12.0, 0, go_on).unwrap();
        assert!(0 < report.encounter_steps && report.closest.is_some(), "{report:?}");
    }
}

#[test]
fn a_run_back_is_continued_too() {
    let (bodies, start) = planets(4, 1e-3);
    let method = WisdomHolman::new(0.1, Splitting::TenSixFour).unwrap();
    assert_continues!("backwards", method, &bodies, start, -10.4);
}

#[test]
fn regularised_runs_continue_from_any_step() {
    let data = reference("pythagorean");
    let bodies = Gravitation::new(golden::vector(&data["masses"])).unwrap();
    let places: Vec<[f64; 3]> = golden::matrix(&data["positions"]).iter().map(|x| [x[0], x[1], 0.0]).collect();
    let start = bodies.state(&places, &[[0.0; 3]; 3]).unwrap();
    let method = Regularised::to_rounding();
    for end in [20.0, -20.0] {
        let mut whole = State::new(0.0, start.clone()).unwrap();
        let (report, _) = method.integrate_to_checkpoint(&bodies, &mut whole, end, go_on).unwrap();
        assert!(100 < report.steps, "{report:?}");
        for at in [1, 50, 99] {
            let (mut stopped, mut continued) = (State::new(0.0, start.clone()).unwrap(), elsewhere());
            let (first, kept) = method.integrate_to_checkpoint(&bodies, &mut stopped, end, stop(at)).unwrap();
            assert_eq!((first.steps, first.ending), (at, Ending::Stopped));
            // Its own time is no other direction.
            let (there, same) = method.resume(&bodies, &kept, &mut continued, kept.state().time, go_on).unwrap();
            assert_eq!((there.steps, &continued), (at, &stopped));
            let (second, last) = method.resume(&bodies, &written(&same), &mut continued, end, go_on).unwrap();
            assert_eq!((second, &continued), (report, &whole), "stopped at {at}");
            // Steps that were made already are steps.
            let most = method.with_most_steps(at - 1);
            let result = most.resume(&bodies, &kept, &mut elsewhere(), end, go_on).err();
            assert!(matches!(result, Some(IntegratorsError::TooManySteps { steps, .. }) if steps == at), "{result:?}");
            // Farther, and back to the start.
            method.resume(&bodies, &last, &mut continued, 1.1 * end, go_on).unwrap();
            assert_eq!(continued.time.to_bits(), (1.1 * end).to_bits());
            let (back, _) = method.resume(&bodies, &kept, &mut continued, 0.0, go_on).unwrap();
            assert!(back.steps > at && continued.time.abs() <= 0.0);
            for (found, expected) in continued.values.iter().zip(&start) {
                assert!((found - expected).abs() < 1e-9, "{found} and {expected}: rounding, which the way magnifies");
            }
        }
    }
}

#[test]
fn derivatives_are_continued_too() {
    let (bodies, start) = planets(3, 1e-3);
    let seeded: Vec<Dual<f64>> = start.iter().enumerate().map(|(i, &x)| Dual::new(x, Real::lit(i as f64))).collect();
    let method = DemocraticHeliocentric::new(0.1, Splitting::TenSixFour).unwrap();
    let mut whole = State::new(0.0, seeded).unwrap();
    let mut state = whole.clone();
    let report = method.integrate_to(&bodies, &mut whole, 5.0).unwrap();
    let (_, kept) = method.integrate_to_checkpoint(&bodies, &mut state, 5.0, 1, stop(17)).unwrap();
    let (continued, _) = method.resume(&bodies, &kept, &mut state, 5.0, 0, go_on).unwrap();
    assert_eq!((continued, state), (report, whole));
}

#[test]
fn checkpoints_of_other_methods_and_bodies_are_refused_and_leave_the_state() {
    let (bodies, start) = planets(3, 1e-3);
    let state = || State::new(0.0, start.clone()).unwrap();
    let jacobi = WisdomHolman::new(0.1, Splitting::Leapfrog).unwrap();
    let hybrid = HybridSymplectic::new(0.1, Splitting::Leapfrog).unwrap();
    let regularised = Regularised::to_rounding();
    let (_, of_jacobi) = jacobi.integrate_to_checkpoint(&bodies, &mut state(), 5.0, 1, stop(3)).unwrap();
    let (_, of_hybrid) = hybrid.integrate_to_checkpoint(&bodies, &mut state(), 5.0, 1, stop(3)).unwrap();
    let (_, of_chain) = regularised.integrate_to_checkpoint(&bodies, &mut state(), 5.0, stop(3)).unwrap();
    let wrong = |result: Option<IntegratorsError<_>>| {
        assert!(matches!(result, Some(IntegratorsError::WrongMethod { .. })), "{result:?}");
    };
    let mut left = elsewhere();
    wrong(jacobi.resume(&bodies, &of_hybrid, &mut left, 5.0, 0, go_on).err());
    wrong(hybrid.resume(&bodies, &of_jacobi, &mut left, 5.0, 0, go_on).err());
    wrong(regularised.resume(&bodies, &of_jacobi, &mut left, 5.0, go_on).err());
    let (more, _) = planets(12, 1e-3);
    let long = |result: Option<IntegratorsError<_>>| {
        assert!(matches!(result, Some(IntegratorsError::WrongLength { .. })), "{result:?}");
    };
    long(jacobi.resume(&more, &of_jacobi, &mut left, 5.0, 0, go_on).err());
    long(hybrid.resume(&more, &of_hybrid, &mut left, 5.0, 0, go_on).err());
    long(regularised.resume(&more, &of_chain, &mut left, 5.0, go_on).err());
    // An end that is none.
    let no_end = |result: Option<IntegratorsError<_>>| {
        assert!(matches!(result, Some(IntegratorsError::NotFinite { quantity: "end", .. })), "{result:?}");
    };
    let heliocentric = DemocraticHeliocentric::new(0.1, Splitting::Leapfrog).unwrap();
    let (_, of_heliocentric) = heliocentric.integrate_to_checkpoint(&bodies, &mut state(), 5.0, 1, stop(3)).unwrap();
    for end in [f64::NAN, f64::INFINITY] {
        no_end(jacobi.resume(&bodies, &of_jacobi, &mut left, end, 0, go_on).err());
        no_end(heliocentric.resume(&bodies, &of_heliocentric, &mut left, end, 0, go_on).err());
        no_end(hybrid.resume(&bodies, &of_hybrid, &mut left, end, 0, go_on).err());
        no_end(regularised.resume(&bodies, &of_chain, &mut left, end, go_on).err());
    }
    // Another splitting, also where the steps are the same; and a number of none.
    let other = |result: Option<IntegratorsError<_>>, expected: &str| {
        let is_it = |found: &_| matches!(found, IntegratorsError::WrongMethod { expected: named, found: "Leapfrog" } if *named == expected);
        assert!(result.as_ref().is_some_and(is_it), "{result:?}");
    };
    for (splitting, name) in
        [(Splitting::TenSixFour, "TenSixFour"), (Splitting::Corrected(Corrector::Seventeen), "Corrected(Seventeen)")]
    {
        let jacobi = WisdomHolman::new(0.1, splitting).unwrap();
        other(jacobi.resume(&bodies, &of_jacobi, &mut left, 5.0, 0, go_on).err(), name);
        let heliocentric = DemocraticHeliocentric::new(0.1, splitting).unwrap();
        other(heliocentric.resume(&bodies, &of_heliocentric, &mut left, 5.0, 0, go_on).err(), name);
        let hybrid = HybridSymplectic::new(0.1, splitting).unwrap();
        other(hybrid.resume(&bodies, &of_hybrid, &mut left, 5.0, 0, go_on).err(), name);
    }
    let mut unknown = serde_json::to_value(&of_jacobi).unwrap();
    unknown["numbers"][4] = 9.0.into();
    let unknown: Checkpoint = serde_json::from_value(unknown).unwrap();
    let result = jacobi.resume(&bodies, &unknown, &mut left, 5.0, 0, go_on).err();
    assert!(matches!(result, Some(IntegratorsError::InvalidRow { index: 4, .. })), "{result:?}");
    // Radii of other bodies, and critical radii that are none.
    let wide = hybrid.clone().with_radii(vec![1e-9; 2]).unwrap();
    let result = wide.resume(&bodies, &of_hybrid, &mut left, 5.0, 0, go_on).err();
    let Some(IntegratorsError::Field { source: GravitationError::WrongLength { .. }, .. }) = result else {
        panic!("{result:?}")
    };
    let mut negative = serde_json::to_value(&of_hybrid).unwrap();
    let last = negative["numbers"].as_array().unwrap().len() - 1;
    negative["numbers"][last] = (-1.0).into();
    let negative: Checkpoint = serde_json::from_value(negative).unwrap();
    let result = hybrid.resume(&bodies, &negative, &mut left, 5.0, 0, go_on).err();
    let Some(IntegratorsError::Field { source: GravitationError::InvalidRadius { .. }, .. }) = result else {
        panic!("{result:?}")
    };
    // A chain in which a body stands twice, and a row beyond the last.
    let text = serde_json::to_value(&of_chain).unwrap();
    let last = text["numbers"].as_array().unwrap().len() - 1;
    for (index, value) in [(last, text["numbers"][last - 1].clone()), (2, 40.0.into())] {
        let mut changed = text.clone();
        changed["numbers"][index] = value;
        let changed: Checkpoint = serde_json::from_value(changed).unwrap();
        let result = regularised.resume(&bodies, &changed, &mut left, 5.0, go_on).err();
        let Some(IntegratorsError::InvalidRow { index: found, .. }) = result else { panic!("{result:?}") };
        assert_eq!(found, index);
    }
    assert_eq!(left, elsewhere());
}
