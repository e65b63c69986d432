//! Events: found, in order, once, to rounding.

use core::f64::consts::PI;
use core::ops::ControlFlow;

use piola_integrators::{
    Crossing, DormandPrince853, Ending, Event, EventAction, Field, IntegratorsError, Report, State, Tolerance, field,
};
use piola_testkit::{Tol, assert_close};

fn oscillator() -> impl Field<Error = core::convert::Infallible> {
    field(2, |_t, y: &[f64], rate: &mut [f64]| {
        rate[0] = y[1];
        rate[1] = -y[0];
    })
}

/// y = t in one step of length four, so that the eight places are half a second apart.
fn clock() -> (impl Field<Error = core::convert::Infallible>, DormandPrince853) {
    let method = DormandPrince853::new(Tolerance::new(1e-9, 1.0).unwrap()).with_first_step(4.0).unwrap();
    (field(1, |_t, _y: &[f64], rate: &mut [f64]| rate[0] = 1.0), method)
}

type Ended<E> = Result<Report, IntegratorsError<E>>;

/// Runs and lists (event, time).
fn run<F: Field>(
    method: &mut DormandPrince853,
    field: &mut F,
    state: &mut State,
    end: f64,
    events: &mut [Event<'_>],
) -> (Ended<F::Error>, Vec<(usize, f64)>) {
    let mut found = Vec::new();
    let report = method.integrate_with_events(
        field,
        state,
        end,
        events,
        |occurrence| {
            found.push((occurrence.event, occurrence.time));
            ControlFlow::Continue(())
        },
        |_| ControlFlow::Continue(()),
    );
    (report, found)
}

fn precise() -> DormandPrince853 {
    DormandPrince853::new(Tolerance::relative(1e-13).unwrap())
}

fn times(found: &[(usize, f64)]) -> Vec<f64> {
    found.iter().map(|(_, time)| *time).collect()
}

fn indices(found: &[(usize, f64)]) -> Vec<usize> {
    found.iter().map(|(index, _)| *index).collect()
}

const ROUNDING: Tol = Tol::stated(1e-11, "tolerance of the run, over ten radians");

#[test]
fn zeros_of_the_cosine_are_odd_multiples_of_a_quarter_turn() {
    for (direction, crossing, expected) in [
        (1.0, Crossing::Either, vec![0.5, 1.5, 2.5]),
        (1.0, Crossing::Falling, vec![0.5, 2.5]),
        (1.0, Crossing::Rising, vec![1.5]),
        (-1.0, Crossing::Either, vec![-0.5, -1.5, -2.5]),
        (-1.0, Crossing::Falling, vec![-0.5, -2.5]),
    ] {
        let mut state = State::new(0.0, vec![1.0, 0.0]).unwrap();
        let mut events = [Event::new(crossing, EventAction::Report, |_t, y| y[0])];
        let (report, found) = run(&mut precise(), &mut oscillator(), &mut state, direction * 3.0 * PI, &mut events);
        assert_eq!(report.unwrap().ending, Ending::Reached);
        let expected: Vec<f64> = expected.iter().map(|x| x * PI).collect();
        assert_close("zeros", &times(&found), &expected, ROUNDING);
    }
}

#[test]
fn two_crossings_in_one_step_are_both_found() {
    let (mut clock, mut method) = clock();
    let mut state = State::new(0.0, vec![0.0]).unwrap();
    let mut events = [Event::new(Crossing::Either, EventAction::Report, |t, _y| (t - 1.1) * (t - 1.7))];
    let (report, found) = run(&mut method, &mut clock, &mut state, 4.0, &mut events);
    assert_eq!(report.unwrap().steps, 1);
    assert_close("crossings", &times(&found), &[1.1, 1.7], Tol::ulps(16.0));
}

#[test]
fn crossing_is_never_reported_before_it_happens() {
    let mut state = State::new(0.0, vec![1.0, 0.0]).unwrap();
    let mut events = [Event::new(Crossing::Falling, EventAction::Stop, |_t, y| y[0])];
    run(&mut precise(), &mut oscillator(), &mut state, 10.0, &mut events).0.unwrap();
    assert!(state.values[0] <= 0.0);
}

#[test]
fn event_exactly_at_the_start_is_none() {
    // Starts on the surface: the first return counts, the start does not.
    let mut state = State::new(0.0, vec![0.0, 1.0]).unwrap();
    let mut events = [Event::new(Crossing::Either, EventAction::Stop, |_t, y| y[0])];
    let (report, found) = run(&mut precise(), &mut oscillator(), &mut state, 10.0, &mut events);
    assert_eq!(report.unwrap().ending, Ending::Event(0));
    assert_close("return", &times(&found), &[PI], ROUNDING);
}

#[test]
fn run_continued_from_an_event_does_not_find_it_again() {
    let mut state = State::new(0.0, vec![1.0, 0.0]).unwrap();
    let mut found = Vec::new();
    for _ in 0..4 {
        let mut events = [Event::new(Crossing::Either, EventAction::Stop, |_t, y| y[0])];
        run(&mut precise(), &mut oscillator(), &mut state, 20.0, &mut events).0.unwrap();
        found.push(state.time);
    }
    assert_close("zeros", &found, &[0.5 * PI, 1.5 * PI, 2.5 * PI, 3.5 * PI], ROUNDING);
}

#[test]
fn stop_in_a_backward_run_leaves_the_state_at_the_event() {
    let mut state = State::new(0.0, vec![1.0, 0.0]).unwrap();
    let mut events = [
        Event::new(Crossing::Either, EventAction::Report, |t, _y| t + 1.0),
        Event::new(Crossing::Either, EventAction::Stop, |_t, y| y[0]),
        Event::new(Crossing::Either, EventAction::Report, |t, _y| t + 1.6),
    ];
    let (report, found) = run(&mut precise(), &mut oscillator(), &mut state, -10.0, &mut events);
    assert_eq!(report.unwrap().ending, Ending::Event(1));
    assert_eq!(indices(&found), [0, 1]);
    assert_close("time", &[state.time], &[-0.5 * PI], ROUNDING);
    assert_close("state", &state.values, &[0.0, 1.0], ROUNDING);
}

#[test]
fn several_events_are_reported_in_the_order_of_time() {
    let (mut clock, mut method) = clock();
    let mut state = State::new(0.0, vec![0.0]).unwrap();
    let mut events = [3.9, 0.2, 0.1, 2.0, 0.3]
        .map(|at| Event::new(Crossing::Either, EventAction::Report, move |_t, y: &[f64]| y[0] - at));
    let (_, found) = run(&mut method, &mut clock, &mut state, 4.0, &mut events);
    assert_eq!(indices(&found), [2, 1, 4, 3, 0]);
    assert_close("times", &times(&found), &[0.1, 0.2, 0.3, 2.0, 3.9], Tol::ulps(16.0));
}

#[test]
fn event_at_the_time_of_a_stop_is_still_reported() {
    let (mut clock, mut method) = clock();
    let mut state = State::new(0.0, vec![0.0]).unwrap();
    let mut events = [
        Event::new(Crossing::Rising, EventAction::Stop, |t, _y| t - 1.5),
        Event::new(Crossing::Falling, EventAction::Report, |t, _y| 1.5 - t),
        Event::new(Crossing::Rising, EventAction::Report, |t, _y| t - 1.75),
    ];
    let (report, found) = run(&mut method, &mut clock, &mut state, 4.0, &mut events);
    assert_eq!(report.unwrap().ending, Ending::Event(0));
    assert_eq!(indices(&found), [0, 1]);
    assert_eq!(state.time.to_bits(), 1.5_f64.to_bits());
}

#[test]
fn zero_exactly_at_a_place_is_found_once() {
    let (mut clock, mut method) = clock();
    let mut state = State::new(0.0, vec![0.0]).unwrap();
    let mut events = [Event::new(Crossing::Either, EventAction::Report, |t, _y| t - 1.5)];
    let (_, found) = run(&mut method, &mut clock, &mut state, 4.0, &mut events);
    assert_eq!(found, [(0, 1.5)]);
}

#[test]
fn observers_of_events_and_of_steps_can_stop_the_run() {
    let (mut clock, mut method) = clock();
    let mut state = State::new(0.0, vec![0.0]).unwrap();
    let mut events = [Event::new(Crossing::Either, EventAction::Report, |t, _y| t - 1.25)];
    let report = method.integrate_with_events(
        &mut clock,
        &mut state,
        4.0,
        &mut events,
        |_| ControlFlow::Break(()),
        |_| ControlFlow::Continue(()),
    );
    assert_eq!(report.unwrap().ending, Ending::Stopped);
    assert_close("stop", &[state.time, state.values[0]], &[1.25, 1.25], Tol::ulps(16.0));
    let report = method.integrate_with_events(
        &mut clock,
        &mut state,
        100.0,
        &mut [],
        |_| ControlFlow::Continue(()),
        |_| ControlFlow::Break(()),
    );
    assert_eq!(report.unwrap().steps, 1);
}

#[test]
fn no_events_cost_no_evaluations() {
    let mut plain = State::new(0.0, vec![1.0, 0.0]).unwrap();
    let mut watched = plain.clone();
    let expected = precise().integrate_to(&mut oscillator(), &mut plain, 10.0).unwrap();
    assert_eq!(run(&mut precise(), &mut oscillator(), &mut watched, 10.0, &mut []).0.unwrap(), expected);
    assert_eq!(plain, watched);
}

/// An event whose function keeps its sign is looked at and never found; the run and its state are those of a run without it.
#[test]
fn event_that_never_fires_leaves_the_run_alone() {
    let start = State::new(0.0, vec![1.0, 0.0]).unwrap();
    let (mut plain, mut watched) = (start.clone(), start);
    let expected = precise().integrate_to(&mut oscillator(), &mut plain, 10.0).unwrap();
    let mut events = [Event::new(Crossing::Either, EventAction::Stop, |_t, y| y[0] + 1.5)];
    let (report, found) = run(&mut precise(), &mut oscillator(), &mut watched, 10.0, &mut events);
    let report = report.unwrap();
    assert_eq!((report.ending, report.steps, found.len()), (Ending::Reached, expected.steps, 0));
    assert_eq!(plain, watched);
}

#[test]
fn event_that_is_nan_is_refused_by_its_index() {
    let mut state = State::new(0.0, vec![1.0, 0.0]).unwrap();
    let mut events = [
        Event::new(Crossing::Either, EventAction::Report, |_t, y| y[0]),
        Event::new(Crossing::Either, EventAction::Report, |t, _y| (1.0 - t).sqrt()),
    ];
    let (report, _) = run(&mut precise(), &mut oscillator(), &mut state, 10.0, &mut events);
    assert!(matches!(report, Err(IntegratorsError::InvalidEvent { event: 1, t }) if 1.0 < t));
}

#[test]
fn state_of_another_dimension_is_refused_before_events_see_it() {
    let mut state = State::new(0.0, vec![1.0]).unwrap();
    let mut events = [Event::new(Crossing::Either, EventAction::Report, |_t, y| y[1])];
    let (report, _) = run(&mut precise(), &mut oscillator(), &mut state, 10.0, &mut events);
    assert_eq!(report, Err(IntegratorsError::WrongLength { quantity: "state", expected: 2, found: 1 }));
}

#[test]
fn zero_of_an_event_costs_few_evaluations() {
    // A line is met by the first secant; a cubic with a slope of 0.03 at its zero within a dozen.
    for (bend, most) in [(0.0, 2), (1.0, 14)] {
        let (mut field, mut method) = clock();
        let mut state = State::new(0.0, vec![0.0]).unwrap();
        let count = core::cell::Cell::new(0);
        let mut events = [Event::new(Crossing::Rising, EventAction::Report, |_t, y| {
            count.set(count.get() + 1);
            let x = y[0] - 1.8;
            0.03 * x + bend * x.powi(3)
        })];
        let mut at_occurrence = 0;
        method
            .integrate_with_events(
                &mut field,
                &mut state,
                4.0,
                &mut events,
                |occurrence| {
                    at_occurrence = count.get();
                    // Four roundings of the dense output, which adds up the whole step of length four.
                    assert!((occurrence.time - 1.8).abs() <= 16.0 * f64::EPSILON, "{}", occurrence.time);
                    ControlFlow::Continue(())
                },
                |_| ControlFlow::Continue(()),
            )
            .unwrap();
        // One at the start and one at each of the four places up to t = 2.
        assert!((6..=5 + most).contains(&at_occurrence), "{at_occurrence} evaluations");
    }
}
