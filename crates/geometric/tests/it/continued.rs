//! A stopped run of equal steps that goes on is the whole run, to the last bit.

use core::ops::ControlFlow;

use piola_geometric::{CommutatorFree, LobattoPair, MuntheKaas};
use piola_integrators::{Order, State};

use crate::lie_group::Top;
use crate::problems::{kepler, kepler_at};

/// Writes and reads a state, where the feature allows it.
#[cfg(feature = "serde")]
fn written_and_read(state: &State) -> State {
    serde_json::from_str(&serde_json::to_string(state).unwrap()).unwrap()
}
#[cfg(not(feature = "serde"))]
fn written_and_read(state: &State) -> State {
    state.clone()
}

const END: f64 = 3.0;

macro_rules! continued_runs_are_whole {
    ($method:expr, $system:expr, $start:expr) => {{
        let mut whole = State::new(0.25, $start.to_vec()).unwrap();
        let report = $method.integrate_to($system, &mut whole, END).unwrap();
        for stop in [1, 9, report.steps - 1] {
            let mut state = State::new(0.25, $start.to_vec()).unwrap();
            $method
                .integrate($system, &mut state, END, |step| {
                    if step.number == stop { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
                })
                .unwrap();
            let mut state = written_and_read(&state);
            let rest = $method.integrate_to($system, &mut state, END).unwrap();
            assert_eq!((state, rest.steps), (whole.clone(), report.steps - stop), "{}, {stop}", stringify!($method));
        }
    }};
}

#[test]
fn on_groups() {
    let start = [1.0, 0.0, 0.0, 0.0, 0.3, 2.0, -0.7];
    for order in Order::ALL {
        let mut top = Top::new([1.0, 2.0, 2.5], [0.0, 0.0, 1.0]);
        continued_runs_are_whole!(MuntheKaas::new(order, 0.07).unwrap(), &mut top, start);
    }
    let mut top = Top::new([1.0, 2.0, 2.5], [0.0, 0.0, 1.0]);
    continued_runs_are_whole!(CommutatorFree::new(0.07).unwrap(), &mut top, start);
}

#[test]
fn of_pairs_by_sweeps() {
    for order in Order::ALL {
        continued_runs_are_whole!(LobattoPair::new(order, 0.07).unwrap(), &mut kepler(), kepler_at(0.2, 0.0));
    }
}
