//! Steps allocate nothing: runs of ten and of a hundred thousand steps allocate alike, a second run not at all.

use piola_geometric::{CommutatorFree, GeneralisedAlpha, MuntheKaas};
use piola_integrators::{Order, State};
use piola_testkit::allocations_in;

use super::reference;

/// Allocations of runs of 10 and of 100,000 steps of 2⁻¹⁰ s, by a closure that makes such a run and counts its steps.
fn allocations(mut run: impl FnMut(f64, &mut State) -> u64) -> [usize; 2] {
    let (_, start, _) = reference("heavy top, asymmetric");
    [10_u32, 100_000].map(|steps| {
        let mut state = start.clone();
        let (count, taken) = allocations_in(|| run(f64::from(steps) / 1024.0, &mut state));
        assert_eq!(taken, u64::from(steps));
        count
    })
}

#[test]
fn steps_on_groups_allocate_nothing() {
    let (top, _, _) = reference("heavy top, asymmetric");
    let step = 1.0 / 1024.0;
    let [ten, many] = allocations(|end, state| {
        MuntheKaas::new(Order::Four, step).unwrap().integrate_to(&mut top.clone(), state, end).unwrap().steps
    });
    assert_eq!(ten, many);
    let [ten, many] = allocations(|end, state| {
        CommutatorFree::new(step).unwrap().integrate_to(&mut top.clone(), state, end).unwrap().steps
    });
    assert_eq!(ten, many);
    let [ten, many] = allocations(|end, state| {
        GeneralisedAlpha::new(0.8, step).unwrap().integrate_to(&mut top.clone(), state, end).unwrap().steps
    });
    assert_eq!(ten, many);
}

#[test]
fn second_run_of_a_method_on_a_group_allocates_nothing() {
    let (mut top, mut state, _) = reference("heavy top, asymmetric");
    let mut kaas = MuntheKaas::new(Order::Eight, 0.01).unwrap();
    let mut free = CommutatorFree::new(0.01).unwrap();
    let mut alpha = GeneralisedAlpha::new(0.8, 0.01).unwrap();
    let mut round = |end: f64| {
        kaas.integrate_to(&mut top, &mut state, end).unwrap();
        free.integrate_to(&mut top, &mut state, end + 0.1).unwrap();
        alpha.integrate_to(&mut top, &mut state, end + 0.2).unwrap();
    };
    round(0.1);
    assert_eq!(allocations_in(|| round(1.0)).0, 0);
}
