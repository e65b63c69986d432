//! Steps allocate nothing: runs of ten, a thousand and a million steps allocate alike.

use core::ops::ControlFlow;

use piola_integrators::{
    Composition, Crossing, DormandPrince853, Event, EventAction, GaussLegendre, Order, State, Tolerance,
};
use piola_testkit::allocations_in;

use crate::problems::{FIGURE_EIGHT, kepler, kepler_at, three_bodies};

const RUNS: [u32; 3] = [10, 1_000, 1_000_000];

/// Allocations of runs of so many steps of 2⁻¹⁰ s, by a closure that makes such a run and counts its steps.
fn allocations(mut run: impl FnMut(f64) -> u64) -> [usize; 3] {
    RUNS.map(|steps| {
        let (count, taken) = allocations_in(|| run(f64::from(steps) / 1024.0));
        assert_eq!(taken, u64::from(steps));
        count
    })
}

#[test]
fn million_composition_steps_of_bodies_allocate_nothing() {
    let [ten, thousand, million] = allocations(|end| {
        let mut state = State::new(0.0, FIGURE_EIGHT.to_vec()).unwrap();
        let mut method = Composition::new(Order::Two, 1.0 / 1024.0).unwrap();
        method.integrate_to(&mut three_bodies(), &mut state, end).unwrap().steps
    });
    assert_eq!((thousand, million), (ten, ten));
}

#[test]
fn million_collocation_steps_allocate_nothing() {
    let [ten, thousand, million] = allocations(|end| {
        let mut state = State::new(0.0, kepler_at(0.3, 0.0).to_vec()).unwrap();
        let mut method = GaussLegendre::new(Order::Four, 1.0 / 1024.0).unwrap();
        method.integrate_to(&mut kepler(), &mut state, end).unwrap().steps
    });
    assert_eq!((thousand, million), (ten, ten));
}

#[test]
fn million_adaptive_steps_with_dense_output_and_events_allocate_nothing() {
    let [ten, thousand, million] = allocations(|end| {
        let mut state = State::new(0.0, kepler_at(0.3, 0.0).to_vec()).unwrap();
        let step = 1.0 / 1024.0;
        let mut method = DormandPrince853::new(Tolerance::relative(1e-9).unwrap())
            .with_first_step(step)
            .unwrap()
            .with_longest_step(step)
            .unwrap();
        let mut events = [Event::new(Crossing::Either, EventAction::Report, |_t, y| y[1])];
        method
            .integrate_with_events(
                &mut kepler(),
                &mut state,
                end,
                &mut events,
                |_| ControlFlow::Continue(()),
                |_| ControlFlow::Continue(()),
            )
            .unwrap()
            .steps
    });
    assert_eq!((thousand, million), (ten, ten));
}

#[test]
fn second_run_of_a_method_allocates_nothing() {
    let mut state = State::new(0.0, FIGURE_EIGHT.to_vec()).unwrap();
    let mut composition = Composition::new(Order::Eight, 0.01).unwrap();
    let mut collocation = GaussLegendre::new(Order::Eight, 0.01).unwrap();
    let mut adaptive = DormandPrince853::new(Tolerance::relative(1e-9).unwrap());
    let mut round = |end: f64| {
        composition.integrate_to(&mut three_bodies(), &mut state, end).unwrap();
        collocation.integrate_to(&mut three_bodies(), &mut state, end + 0.1).unwrap();
        adaptive.integrate_to(&mut three_bodies(), &mut state, end + 0.2).unwrap();
    };
    round(0.1);
    assert_eq!(allocations_in(|| round(1.0)).0, 0);
}
