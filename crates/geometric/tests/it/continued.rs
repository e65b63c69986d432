//! A stopped run that goes on is the whole run, to the last bit, also after it was written and read.

use core::ops::ControlFlow;

use piola_geometric::{
    AdaptiveMuntheKaas, Chord, CommutatorFree, DiscreteEulerLagrange, DiscreteGradient, DiscreteLagrangian,
    GaussCollocation, GeneralisedAlpha, LobattoPair, MuntheKaas, ReversibleComposition, VariationalIntegrator,
    VariationalSystem,
};
use piola_integrators::{Checkpoint, IntegratorsError, Order, Report, SplittingScheme, State, Step, Tolerance};
use piola_numerics::Real;

use crate::continuing::{assert_refused, elsewhere, growing, until, written_and_read};
use crate::discrete_gradient::{DampedPendulum, HenonHeiles};
use crate::lie_group::Top;
use crate::problems::{kepler, kepler_at};
use crate::reversible::Distance;
use crate::variational::{self, Kepler};

const END: f64 = 3.0;
const TOP: [f64; 7] = [1.0, 0.0, 0.0, 0.0, 0.3, 2.0, -0.7];

fn start(values: &[f64]) -> State {
    State::new(0.25, values.to_vec()).unwrap()
}

/// Methods that keep nothing but the state.
macro_rules! continued_runs_are_whole {
    ($method:expr, $system:expr, $start:expr) => {{
        let mut whole = start(&$start);
        let report = $method.integrate_to($system, &mut whole, END).unwrap();
        for stop in [1, 9, report.steps - 1] {
            let mut state = start(&$start);
            $method.integrate($system, &mut state, END, until(stop)).unwrap();
            let mut state = written_and_read(&state);
            let rest = $method.integrate_to($system, &mut state, END).unwrap();
            assert_eq!((state, rest.steps), (whole.clone(), report.steps - stop), "{}, {stop}", stringify!($method));
        }
    }};
}

/// Methods with checkpoints: `run` integrates with an observer, `resume` goes on from a checkpoint with a new method.
fn resumed_runs_are_whole<M>(
    name: &str,
    start: &State,
    method: impl Fn() -> M,
    run: impl Fn(&mut M, &mut State, &mut dyn FnMut(Step<'_>) -> ControlFlow<()>) -> Result<Report, IntegratorsError>,
    checkpoint: impl Fn(&M, &State, Report) -> Checkpoint,
    resume: impl Fn(
        &mut M,
        &Checkpoint,
        &mut State,
        f64,
        &mut dyn FnMut(Step<'_>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError>,
) {
    let (mut whole, mut seen) = (start.clone(), Vec::new());
    let report = run(&mut method(), &mut whole, &mut |step| {
        seen.push(step.values.to_vec());
        ControlFlow::Continue(())
    })
    .unwrap();
    assert!(10 < report.steps, "{name}: {} steps", report.steps);
    for stop in [1, 2, 9, report.steps - 1] {
        let (mut state, mut first) = (start.clone(), method());
        let stopped = run(&mut first, &mut state, &mut until(stop)).unwrap();
        let kept = written_and_read(&checkpoint(&first, &state, stopped));
        assert_eq!((kept.state(), kept.report().steps), (&state, stop));
        // A new method, and a state that has nothing to do with it.
        let mut continued = elsewhere(state.values.len());
        let refused = resume(&mut method(), &kept, &mut continued, f64::NAN, &mut |_step| ControlFlow::Continue(()));
        assert_refused(&refused, &continued);
        let mut next = stop;
        let resumed = resume(&mut method(), &kept, &mut continued, END, &mut |step| {
            next += 1;
            assert_eq!((step.number, step.values), (next, &seen[usize::try_from(next).unwrap() - 1][..]), "{name}");
            ControlFlow::Continue(())
        })
        .unwrap();
        assert_eq!(
            (&continued, resumed.steps, resumed.ending),
            (&whole, report.steps, report.ending),
            "{name}, {stop}"
        );
        assert!(resumed.evaluations.abs_diff(report.evaluations) <= 1, "{name}: {resumed:?}, {report:?}");
    }
}

macro_rules! with_checkpoints {
    ($method:expr, $system:expr, $start:expr) => {
        with_checkpoints!($method, $system, $start, integrate, resume)
    };
    ($method:expr, $system:expr, $start:expr, $integrate:ident, $resume:ident) => {
        resumed_runs_are_whole(
            stringify!($method),
            &start(&$start),
            || $method,
            |method, state, observer| method.$integrate($system, state, END, observer),
            |method, state, report| method.checkpoint(state, report),
            |method, kept, state, end, observer| method.$resume($system, kept, state, end, observer),
        )
    };
}

/// h L((q₀ + q₁)/2, (q₁ − q₀)/h).
struct Midpoint;
impl DiscreteLagrangian for Midpoint {
    fn freedom(&self) -> usize {
        2
    }
    fn discrete_lagrangian<T: Real>(&self, chord: Chord<'_, T>) -> T {
        let h = T::lit(chord.step);
        let middle = [0, 1].map(|i| T::lit(0.5) * (chord.start[i] + chord.end[i]));
        let v = [0, 1].map(|i| chord.change[i] / h);
        h * Kepler.lagrangian(&middle, &v, T::zero())
    }
}

#[test]
fn on_groups() {
    let top = || Top::new([1.0, 2.0, 2.5], [0.0, 0.0, 1.0]);
    for order in Order::ALL {
        continued_runs_are_whole!(MuntheKaas::new(order, 0.07).unwrap(), &mut top(), TOP);
    }
    continued_runs_are_whole!(CommutatorFree::new(0.07).unwrap(), &mut top(), TOP);
    with_checkpoints!(AdaptiveMuntheKaas::new(Tolerance::relative(1e-11).unwrap()), &mut top(), TOP);
    with_checkpoints!(GeneralisedAlpha::new(0.8, 0.07).unwrap(), &mut top(), TOP);
}

#[test]
fn of_collocation_and_pairs() {
    for order in Order::ALL {
        with_checkpoints!(LobattoPair::new(order, 0.07).unwrap(), &mut kepler(), kepler_at(0.2, 0.0));
        with_checkpoints!(
            LobattoPair::new(order, 0.07).unwrap(),
            &mut kepler(),
            kepler_at(0.2, 0.0),
            integrate_by_newton,
            resume_by_newton
        );
        with_checkpoints!(GaussCollocation::new(order, 0.07).unwrap(), &mut kepler(), kepler_at(0.2, 0.0));
    }
}

#[test]
fn of_variational_integrators() {
    for (rule, order) in variational::all() {
        with_checkpoints!(VariationalIntegrator::new(rule, order, 0.07).unwrap(), &Kepler, kepler_at(0.2, 0.0));
    }
    with_checkpoints!(DiscreteEulerLagrange::new(0.07).unwrap(), &Midpoint, kepler_at(0.2, 0.0));
}

#[test]
fn of_discrete_gradients() {
    for order in Order::ALL {
        with_checkpoints!(DiscreteGradient::new(order, 0.07).unwrap(), &HenonHeiles, [0.1, 0.2, 0.3, 0.1]);
    }
    let damped = DampedPendulum { friction: 0.3 };
    with_checkpoints!(DiscreteGradient::new(Order::Two, 0.07).unwrap(), &damped, [1.0, 0.2]);
}

#[test]
fn of_reversible_steps() {
    for scheme in [SplittingScheme::Composition(Order::Two), SplittingScheme::Nystrom6] {
        resumed_runs_are_whole(
            &scheme.to_string(),
            &start(&kepler_at(0.5, 0.0)),
            || ReversibleComposition::new(scheme, 0.1).unwrap(),
            |method, state, observer| method.integrate(&mut growing(), &Distance, state, END, observer),
            ReversibleComposition::checkpoint,
            |method, kept, state, end, observer| method.resume(&mut growing(), &Distance, kept, state, end, observer),
        );
    }
}

#[test]
fn a_checkpoint_of_another_method_or_size_is_refused() {
    let mut state = start(&kepler_at(0.2, 0.0));
    let mut method = LobattoPair::new(Order::Four, 0.07).unwrap();
    let report = method.integrate(&mut kepler(), &mut state, END, until(3)).unwrap();
    let kept = method.checkpoint(&state, report);
    let before = state.clone();
    let run = LobattoPair::new(Order::Six, 0.07)
        .unwrap()
        .resume(&mut kepler(), &kept, &mut state, END, |_step| ControlFlow::Continue(()));
    assert!(matches!(
        run,
        Err(IntegratorsError::WrongLength { quantity: "checkpoint.memory", expected: 16, found: 12 })
    ));
    let run =
        GaussCollocation::new(Order::Four, 0.07)
            .unwrap()
            .resume(&mut kepler(), &kept, &mut state, END, |_step| ControlFlow::Continue(()));
    let error = IntegratorsError::WrongMethod { expected: "GaussCollocation", found: "LobattoPair" };
    assert_eq!(run, Err(error));
    assert_eq!(state, before);
    let unused = ReversibleComposition::new(SplittingScheme::Nystrom6, 0.1).unwrap().checkpoint(&state, report);
    let run = ReversibleComposition::new(SplittingScheme::Nystrom6, 0.1).unwrap().resume(
        &mut growing(),
        &Distance,
        &unused,
        &mut state,
        END,
        |_step| ControlFlow::Continue(()),
    );
    assert_eq!(run, Err(IntegratorsError::WrongLength { quantity: "checkpoint.numbers", expected: 1, found: 0 }));
    assert_eq!(state, before);
}

/// Of polynomials of degree one and of two points the memories have equal sizes.
#[test]
fn a_checkpoint_of_polynomials_is_refused_by_a_discrete_lagrangian() {
    let mut compared = 0;
    for (rule, order) in variational::all().filter(|&(_, order)| order == Order::Two) {
        let mut state = start(&kepler_at(0.2, 0.0));
        let mut method = VariationalIntegrator::new(rule, order, 0.07).unwrap();
        let report = method.integrate(&Kepler, &mut state, END, until(3)).unwrap();
        let kept = method.checkpoint(&state, report);
        let mut other = elsewhere(4);
        let run = DiscreteEulerLagrange::new(0.07)
            .unwrap()
            .resume(&Midpoint, &kept, &mut other, END, |_step| ControlFlow::Continue(()));
        let (expected, found) = ("DiscreteEulerLagrange", "VariationalIntegrator");
        assert_eq!(run, Err(IntegratorsError::WrongMethod { expected, found }));
        assert_eq!(other, elsewhere(4));
        compared += 1;
    }
    assert_ne!(compared, 0);
}

/// A run that cannot begin leaves the density alone, too.
#[test]
fn a_refused_run_of_reversible_steps_leaves_the_density() {
    let mut state = start(&kepler_at(0.5, 0.0));
    let mut method = ReversibleComposition::new(SplittingScheme::Nystrom6, 0.1).unwrap();
    let report = method.integrate(&mut growing(), &Distance, &mut state, END, until(3)).unwrap();
    let kept = method.checkpoint(&state, report);
    method.integrate(&mut growing(), &Distance, &mut state, END, until(7)).unwrap();
    let (density, mut other) = (method.density(), elsewhere(4));
    let run = method.resume(&mut growing(), &Distance, &kept, &mut other, f64::NAN, |_step| ControlFlow::Continue(()));
    assert_refused(&run, &other);
    assert_ne!(kept, method.checkpoint(kept.state(), kept.report()));
    assert_eq!(method.density(), density);
}

/// A run without a step knows no next one.
#[test]
fn a_checkpoint_without_a_next_step_is_refused() {
    let mut top = Top::new([1.0, 2.0, 2.5], [0.0, 0.0, 1.0]);
    let (mut state, mut method) = (start(&TOP), AdaptiveMuntheKaas::new(Tolerance::relative(1e-11).unwrap()));
    let t = state.time;
    let report = method.integrate_to(&mut top, &mut state, t).unwrap();
    let kept = method.checkpoint(&state, report);
    let run = method.resume(&mut top, &kept, &mut state, END, |_step| ControlFlow::Continue(()));
    assert_eq!(run, Err(IntegratorsError::NotPositive { quantity: "checkpoint.numbers", value: 0.0 }));
}

/// A matrix is read with its exchanges of rows: a row that is none is refused.
#[cfg(feature = "serde")]
#[test]
fn a_written_checkpoint_with_an_impossible_row_is_refused() {
    let mut state = start(&kepler_at(0.2, 0.0));
    let mut method = GaussCollocation::new(Order::Two, 0.07).unwrap();
    let report = method.integrate(&mut kepler(), &mut state, END, until(3)).unwrap();
    let written = serde_json::to_value(method.checkpoint(&state, report)).unwrap();
    for wrong in [4.0, -1.0, 1e300, 1.5] {
        let mut value = written.clone();
        value["numbers"][2] = serde_json::json!(wrong);
        let kept: Checkpoint = serde_json::from_value(value).unwrap();
        let before = state.clone();
        let run = method.resume(&mut kepler(), &kept, &mut state, END, |_step| ControlFlow::Continue(()));
        let quantity = "checkpoint.numbers";
        assert_eq!(run, Err(IntegratorsError::InvalidRow { quantity, index: 2, value: wrong, dimension: 4 }));
        assert_eq!(state, before);
    }
}
