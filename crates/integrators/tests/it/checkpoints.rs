//! A run continued from any of its steps is the whole run, to the last bit.

use core::ops::ControlFlow;

use piola_integrators::{
    Checkpoint, Composition, DormandPrince853, Field, GaussLegendre, GaussLegendre16, GaussRadau15, IntegratorsError,
    Nystrom86, Nystrom1210, Order, ProcessedSplitting, SecondOrder, SplittingScheme, State, Tolerance, Verner98,
};
use piola_numerics::Real;
use piola_testkit::{Tol, assert_close};

use crate::continuing::{assert_refused, elsewhere, growing, until, written_and_read};
use crate::problems::{henon_heiles, kepler, kepler_at, three_bodies};

const END: f64 = 30.0;

fn start() -> State {
    State::new(0.25, kepler_at(0.6, 0.0).to_vec()).unwrap()
}

macro_rules! continued_runs_are_whole {
    ($method:expr, $field:expr) => {{
        let mut whole = start();
        let mut kept = Vec::new();
        let mut seen = Vec::new();
        let report = $method
            .integrate(&mut $field, &mut whole, END, |step| {
                kept.push(step.checkpoint());
                seen.push(step.values().to_vec());
                ControlFlow::Continue(())
            })
            .unwrap();
        assert!(10 < kept.len());
        for (number, checkpoint) in kept.into_iter().enumerate().step_by(7) {
            assert_eq!(checkpoint.state().values, seen[number]);
            let checkpoint = written_and_read(&checkpoint);
            let mut state = elsewhere(4);
            let refused =
                $method.resume(&mut $field, &checkpoint, &mut state, f64::NAN, |_step| ControlFlow::Continue(()));
            assert_refused(&refused, &state);
            // A new method, and a state that has nothing to do with it.
            let mut continued = elsewhere(4);
            let mut next = number + 1;
            let resumed = $method
                .resume(&mut $field, &checkpoint, &mut continued, END, |step| {
                    assert_eq!(step.values(), &seen[next][..]);
                    next += 1;
                    assert_eq!(step.number(), next as u64);
                    ControlFlow::Continue(())
                })
                .unwrap();
            assert_eq!((continued, resumed), (whole.clone(), report), "from step {number}");
        }
    }};
}

#[test]
fn explicit_pairs_continue_from_any_step() {
    let tolerance = Tolerance::relative(1e-9).unwrap();
    continued_runs_are_whole!(DormandPrince853::new(tolerance), kepler());
    continued_runs_are_whole!(Verner98::new(tolerance), kepler());
    continued_runs_are_whole!(Nystrom86::new(tolerance), kepler());
    continued_runs_are_whole!(Nystrom1210::new(tolerance), kepler());
}

#[test]
fn collocation_continues_from_any_step() {
    let tolerance = Tolerance::relative(1e-12).unwrap();
    continued_runs_are_whole!(GaussLegendre16::new(tolerance), kepler());
    continued_runs_are_whole!(GaussRadau15::new(tolerance), kepler());
    continued_runs_are_whole!(GaussRadau15::to_rounding(), kepler());
    continued_runs_are_whole!(GaussLegendre16::with_step(0.3).unwrap(), kepler());
    continued_runs_are_whole!(GaussRadau15::with_step(0.3).unwrap(), kepler());
}

/// The attraction, with its ends of steps brought back to the plane of an integral: the angular momentum.
struct Projected;
impl Field for Projected {
    type Error = core::convert::Infallible;
    fn dimension(&self) -> usize {
        4
    }
    fn rate(&mut self, t: f64, y: &[f64], rate: &mut [f64]) -> Result<(), Self::Error> {
        Field::rate(&mut kepler(), t, y, rate)
    }
    fn project(&mut self, _t: f64, y: &mut [f64]) -> Result<(), Self::Error> {
        let found = y[0] * y[3] - y[1] * y[2];
        let factor = (1.0 - 0.6_f64 * 0.6).sqrt() / found;
        y[2] *= factor;
        y[3] *= factor;
        Ok(())
    }
}

#[test]
fn projected_ends_of_steps_continue_too() {
    continued_runs_are_whole!(DormandPrince853::new(Tolerance::relative(1e-7).unwrap()), Projected);
}

#[test]
fn a_checkpoint_of_another_system_or_method_is_refused() {
    let tolerance = Tolerance::relative(1e-9).unwrap();
    let mut kept = None;
    let mut state = start();
    Verner98::new(tolerance)
        .integrate(&mut kepler(), &mut state, END, |step| {
            kept = Some(step.checkpoint());
            ControlFlow::Break(())
        })
        .unwrap();
    let kept: Checkpoint = kept.unwrap();
    let untouched = state.clone();
    let run = GaussLegendre16::new(tolerance)
        .resume(&mut henon_heiles(), &kept, &mut state, END, |_| ControlFlow::Continue(()));
    let found = "Verner98";
    assert_eq!(run, Err(IntegratorsError::WrongMethod { expected: "GaussLegendre16", found }));
    let run = Nystrom86::new(tolerance).resume(&mut kepler(), &kept, &mut state, END, |_| ControlFlow::Continue(()));
    assert_eq!(run, Err(IntegratorsError::WrongMethod { expected: "Nystrom86", found }));
    let run =
        Verner98::new(tolerance).resume(&mut three_bodies(), &kept, &mut state, END, |_| ControlFlow::Continue(()));
    assert_eq!(run, Err(IntegratorsError::WrongLength { quantity: "checkpoint.memory", expected: 12, found: 4 }));
    assert_eq!(state, untouched);
}

/// Of methods whose memories have equal sizes, one cannot continue the other's run.
#[test]
fn a_checkpoint_of_gauss_legendre_is_refused_by_others() {
    let (mut state, mut method) = (start(), GaussLegendre::new(Order::Four, 0.07).unwrap());
    let report = method.integrate(&mut kepler(), &mut state, 7.0, until(3)).unwrap();
    let kept = method.checkpoint(&state, report);
    let mut state = elsewhere(4);
    let run = ProcessedSplitting::new(0.07)
        .unwrap()
        .resume(&mut kepler(), &kept, &mut state, 7.0, 0, |_step| ControlFlow::Continue(()));
    let error = IntegratorsError::WrongMethod { expected: "ProcessedSplitting", found: "GaussLegendre" };
    assert_eq!(run, Err(error));
    // Another order, another system.
    let mut other = GaussLegendre::new(Order::Six, 0.07).unwrap();
    let run = other.resume(&mut kepler(), &kept, &mut state, 7.0, |_step| ControlFlow::Continue(()));
    assert_eq!(run, Err(IntegratorsError::WrongLength { quantity: "checkpoint.memory", expected: 12, found: 8 }));
    let run = method.resume(&mut three_bodies(), &kept, &mut state, 7.0, |_step| ControlFlow::Continue(()));
    assert_eq!(run, Err(IntegratorsError::WrongLength { quantity: "checkpoint.memory", expected: 24, found: 8 }));
    assert_eq!(state, elsewhere(4));
}

#[test]
fn a_resumed_run_may_have_another_end() {
    // Farther, nearer, and back: collocation in adaptive and in equal steps, and an explicit pair.
    macro_rules! check {
        ($method:expr) => {{
            let (mut state, mut kept) = (start(), None);
            $method
                .integrate(&mut kepler(), &mut state, END, |step| {
                    kept = (step.number() == 20).then(|| step.checkpoint()).or(kept.take());
                    ControlFlow::Continue(())
                })
                .unwrap();
            let kept: Checkpoint = kept.unwrap();
            let from = kept.state().time;
            for end in [END + 7.0, from + 0.1, from, from - 0.1, 0.25, -3.0] {
                let mut state = start();
                let report =
                    $method.resume(&mut kepler(), &kept, &mut state, end, |_step| ControlFlow::Continue(())).unwrap();
                assert_eq!(state.time.to_bits(), end.to_bits());
                assert_eq!(report.steps == 20, (end - from).abs() <= 0.0, "to {end}");
                let tol = Tol::stated(1e-7, "tolerances and steps that err by 1e-9 in a turn, along five turns");
                assert_close("state", &state.values, &kepler_at(0.6, end - 0.25), tol);
            }
        }};
    }
    let tolerance = Tolerance::relative(1e-11).unwrap();
    check!(GaussLegendre16::new(tolerance));
    check!(GaussRadau15::new(tolerance));
    check!(GaussLegendre16::with_step(0.1).unwrap());
    check!(Nystrom1210::new(tolerance));
    check!(Verner98::new(tolerance));
}

#[test]
fn a_run_without_forces_can_be_kept() {
    // The best step is without bound there.
    struct Free;
    impl<T: Real> SecondOrder<T> for Free {
        type Error = core::convert::Infallible;
        fn freedom(&self) -> usize {
            1
        }
        fn acceleration(&mut self, _t: T, _q: &[T], _v: &[T], acceleration: &mut [T]) -> Result<(), Self::Error> {
            acceleration[0] = T::zero();
            Ok(())
        }
    }
    let tolerance = Tolerance::relative(1e-9).unwrap();
    let (mut whole, mut kept) = (State::new(0.0, vec![0.0, 1.0]).unwrap(), None);
    GaussLegendre16::new(tolerance)
        .integrate(&mut Free, &mut whole, 50.0, |step| {
            kept = kept.take().or_else(|| Some(step.checkpoint()));
            ControlFlow::Continue(())
        })
        .unwrap();
    let kept = written_and_read(&kept.unwrap());
    let mut state = start();
    GaussLegendre16::new(tolerance).resume(&mut Free, &kept, &mut state, 50.0, |_| ControlFlow::Continue(())).unwrap();
    assert_eq!(state, whole);
}

#[cfg(feature = "serde")]
#[test]
fn a_written_checkpoint_without_a_positive_step_or_a_known_method_is_refused() {
    let tolerance = Tolerance::relative(1e-9).unwrap();
    let (mut state, mut kept) = (start(), None);
    Nystrom86::new(tolerance)
        .integrate(&mut kepler(), &mut state, END, |step| {
            kept = Some(step.checkpoint());
            ControlFlow::Break(())
        })
        .unwrap();
    let mut value = serde_json::to_value(kept.unwrap()).unwrap();
    value["numbers"][0] = serde_json::json!(-0.5);
    let kept: Checkpoint = serde_json::from_value(value).unwrap();
    let run = Nystrom86::new(tolerance).resume(&mut kepler(), &kept, &mut state, END, |_| ControlFlow::Continue(()));
    assert_eq!(run, Err(IntegratorsError::NotPositive { quantity: "checkpoint.numbers", value: -0.5 }));
    let mut value = serde_json::to_value(kept).unwrap();
    value["method"] = serde_json::json!("Nystrom");
    let error = serde_json::from_value::<Checkpoint>(value).unwrap_err().to_string();
    assert!(error.starts_with("unknown variant `Nystrom`, expected one of `AdaptiveMuntheKaas`"), "{error}");
}

#[test]
fn stopped_runs_of_equal_steps_go_on_with_the_same_steps() {
    let schemes = [SplittingScheme::Composition(Order::Two), SplittingScheme::Composition(Order::Eight)]
        .into_iter()
        .chain([SplittingScheme::Composition10, SplittingScheme::Nystrom6]);
    for scheme in schemes {
        let method = || Composition::with_scheme(scheme, 0.07).unwrap();
        let start = || State::new(0.25, kepler_at(0.2, 0.0).to_vec()).unwrap();
        let mut whole = start();
        let report = method().integrate_to(&mut kepler(), &mut whole, 7.0).unwrap();
        for stop in [1, 13, report.steps - 1] {
            let mut state = start();
            let first = method().integrate(&mut kepler(), &mut state, 7.0, until(stop)).unwrap();
            let mut state = written_and_read(&state);
            let second = method().integrate_to(&mut kepler(), &mut state, 7.0).unwrap();
            assert_eq!((state, first.steps + second.steps), (whole.clone(), report.steps), "{scheme}, {stop}");
        }
    }
}

/// The force at the end of a step is kept for the next one; in a run that goes on it is computed anew, at the same moment.
#[test]
fn stopped_runs_with_forces_that_depend_on_time_go_on_too() {
    for scheme in SplittingScheme::ALL {
        let method = || Composition::with_scheme(scheme, 0.07).unwrap();
        let start = || State::new(0.25, kepler_at(0.2, 0.0).to_vec()).unwrap();
        let mut whole = start();
        let steps = method().integrate_to(&mut growing(), &mut whole, 7.0).unwrap().steps;
        for stop in 1..steps {
            let mut state = start();
            method().integrate(&mut growing(), &mut state, 7.0, until(stop)).unwrap();
            method().integrate_to(&mut growing(), &mut state, 7.0).unwrap();
            assert_eq!(state, whole, "{scheme}, {stop}");
        }
    }
}

#[test]
fn gauss_legendre_continues_from_any_step() {
    for order in Order::ALL {
        let method = || GaussLegendre::new(order, 0.07).unwrap();
        let (mut whole, mut seen) = (start(), Vec::new());
        let report = method()
            .integrate(&mut kepler(), &mut whole, 7.0, |step| {
                seen.push(step.values.to_vec());
                ControlFlow::Continue(())
            })
            .unwrap();
        for stop in [1, 2, 13, report.steps - 1] {
            let (mut state, mut first) = (start(), method());
            let stopped = first.integrate(&mut kepler(), &mut state, 7.0, until(stop)).unwrap();
            let kept = written_and_read(&first.checkpoint(&state, stopped));
            let mut continued = elsewhere(4);
            let refused =
                method().resume(&mut kepler(), &kept, &mut continued, f64::NAN, |_step| ControlFlow::Continue(()));
            assert_refused(&refused, &continued);
            let mut next = stop;
            let resumed = method()
                .resume(&mut kepler(), &kept, &mut continued, 7.0, |step| {
                    next += 1;
                    assert_eq!((step.number, step.values), (next, &seen[usize::try_from(next).unwrap() - 1][..]));
                    ControlFlow::Continue(())
                })
                .unwrap();
            assert_eq!((continued, resumed), (whole.clone(), report), "{order:?}, {stop}");
        }
    }
}

#[test]
fn a_run_to_another_end_counts_its_own_steps() {
    let mut method = Composition::new(Order::Four, 0.07).unwrap();
    let mut state = State::new(0.0, kepler_at(0.2, 0.0).to_vec()).unwrap();
    method.integrate(&mut kepler(), &mut state, 7.0, until(3)).unwrap();
    let mut other = State::new(state.time, state.values.clone()).unwrap();
    other.carry.clone_from(&state.carry);
    let reports = [&mut state, &mut other].map(|state| method.integrate_to(&mut kepler(), state, 3.0).unwrap());
    assert_eq!((&state, reports[0]), (&other, reports[1]));
    // A time that is none of the run's own begins another run.
    state.time += 0.01;
    assert_eq!(method.integrate_to(&mut kepler(), &mut state, 3.0).unwrap().steps, 1);
}

#[cfg(feature = "serde")]
#[test]
fn a_written_state_whose_run_is_impossible_is_refused() {
    let mut state = State::new(0.0, kepler_at(0.2, 0.0).to_vec()).unwrap();
    let mut method = Composition::new(Order::Two, 0.07).unwrap();
    method.integrate(&mut kepler(), &mut state, 7.0, |_| ControlFlow::Break(())).unwrap();
    let written = serde_json::to_value(&state).unwrap();
    assert!(serde_json::from_value::<State>(written.clone()).is_ok());
    for (name, value) in [("longest", -0.07), ("longest", 0.0), ("longest", 1e-300)] {
        let mut wrong = written.clone();
        wrong["run"][name] = serde_json::json!(value);
        assert!(serde_json::from_value::<State>(wrong).is_err(), "{name} = {value}");
    }
}
