//! Orders, other scalars, allocations and failures.

use piola_geometric::{DiscreteGradient, EnergySystem};
use piola_integrators::{IntegratorsError, Order, State};
use piola_numerics::{Dual, Lanes, Real};
use piola_testkit::{Tol, allocations_in, assert_close, assert_order};

use super::{FreeBody, HenonHeiles, Kepler, Pendulum};
use crate::problems::kepler_at;

#[test]
fn errors_fall_with_the_order() {
    for (order, steps) in [
        (Order::Two, [0.01, 0.005, 0.002, 0.001]),
        (Order::Four, [0.05, 0.025, 0.0125, 0.01]),
        (Order::Six, [0.05, 0.04, 0.025, 0.02]),
        (Order::Eight, [0.1, 0.075, 0.06, 0.05]),
    ] {
        let errors = steps.map(|h| {
            let mut state = State::new(0.0, kepler_at(0.2, 0.0).to_vec()).unwrap();
            DiscreteGradient::new(order, h).unwrap().integrate_to(&Kepler, &mut state, 3.0).unwrap();
            let exact = kepler_at(0.2, 3.0);
            state.values.iter().zip(exact).map(|(a, e)| (a - e).abs()).fold(0.0, f64::max)
        });
        assert_order("discrete gradient", &steps, &errors, f64::from(order.value()), 0.1);
    }
}

#[test]
fn order_two_holds_for_a_structure_that_depends_on_the_state() {
    let run = |order: Order, h: f64| {
        let mut state = State::new(0.0, vec![0.5, 1.0, 0.25]).unwrap();
        DiscreteGradient::new(order, h).unwrap().integrate_to(&FreeBody, &mut state, 4.0).unwrap();
        state.values
    };
    let exact = run(Order::Eight, 0.02);
    for (order, steps) in [(Order::Two, [0.1, 0.05, 0.02, 0.01]), (Order::Four, [0.4, 0.2, 0.16, 0.1])] {
        let errors = steps.map(|h| {
            let end = run(order, h);
            end.iter().zip(&exact).map(|(a, e)| (a - e).abs()).fold(0.0, f64::max)
        });
        assert_order("free body", &steps, &errors, f64::from(order.value()), 0.1);
    }
}

#[test]
fn there_and_back_equals_the_start() {
    let start = [0.1, 0.2, 0.3, -0.1];
    let mut state = State::new(0.0, start.to_vec()).unwrap();
    let mut method = DiscreteGradient::new(Order::Four, 0.1).unwrap();
    method.integrate_to(&HenonHeiles, &mut state, 20.0).unwrap();
    method.integrate_to(&HenonHeiles, &mut state, 0.0).unwrap();
    let tol = Tol::ulps_because(512.0, "2000 substeps, whose roundings the flow magnifies");
    assert_close("start", &state.values, &start, tol);
}

#[test]
fn repeated_runs_are_bit_identical_also_by_a_used_method() {
    let mut used = DiscreteGradient::new(Order::Four, 0.1).unwrap();
    let run = |method: &mut DiscreteGradient| {
        let mut state = State::new(0.0, vec![0.1, 0.2, 0.3, -0.1]).unwrap();
        let report = method.integrate_to(&HenonHeiles, &mut state, 30.0).unwrap();
        (state, report)
    };
    let first = run(&mut used);
    assert_eq!(run(&mut used), first);
    assert_eq!(run(&mut DiscreteGradient::new(Order::Four, 0.1).unwrap()), first);
}

#[test]
fn lanes_give_what_each_lane_gets_alone_to_rounding() {
    let starts = [[0.5, 0.0], [2.5, 0.25]];
    let mut state = State::new(0.0, (0..2).map(|i| Lanes([starts[0][i], starts[1][i]])).collect()).unwrap();
    DiscreteGradient::<Lanes<f64, 2>>::new(Order::Four, 0.1)
        .unwrap()
        .integrate_to(&Pendulum, &mut state, 10.0)
        .unwrap();
    for (lane, start) in starts.into_iter().enumerate() {
        let mut alone = State::new(0.0, start.to_vec()).unwrap();
        DiscreteGradient::new(Order::Four, 0.1).unwrap().integrate_to(&Pendulum, &mut alone, 10.0).unwrap();
        let actual: Vec<f64> = state.values.iter().map(|y| y.primal(lane)).collect();
        let tol = Tol::ulps_because(128.0, "a hundred steps, with elementary functions of lanes");
        assert_close("lane", &actual, &alone.values, tol);
    }
}

#[test]
fn duals_carry_the_derivative_with_respect_to_the_start() {
    // Of small swings the derivative is the midpoint rule's own turn, by 2 atan(h/2).
    let h = 0.1;
    let mut state = State::new(0.0, vec![Dual::variable(1e-10), Dual::constant(0.0)]).unwrap();
    DiscreteGradient::new(Order::Two, h).unwrap().integrate_to(&Pendulum, &mut state, 5.0).unwrap();
    let angle = 50.0 * 2.0 * (0.5 * h).atan();
    let tangents: Vec<f64> = state.values.iter().map(|y| y.tangent).collect();
    assert_close("small", &tangents, &[angle.cos(), -angle.sin()], Tol::ulps(64.0));
    // Of large ones it equals a difference quotient of fourth order.
    let end = |q: f64| {
        let mut state = State::new(0.0, vec![q, 0.0]).unwrap();
        DiscreteGradient::new(Order::Four, h).unwrap().integrate_to(&Pendulum, &mut state, 5.0).unwrap();
        state.values
    };
    let mut state = State::new(0.0, vec![Dual::variable(2.0), Dual::constant(0.0)]).unwrap();
    DiscreteGradient::new(Order::Four, h).unwrap().integrate_to(&Pendulum, &mut state, 5.0).unwrap();
    let tangents: Vec<f64> = state.values.iter().map(|y| y.tangent).collect();
    let d = 1e-3;
    let [minus2, minus, plus, plus2] = [-2.0 * d, -d, d, 2.0 * d].map(|d| end(2.0 + d));
    let quotient: Vec<f64> =
        (0..2).map(|i| (8.0 * (plus[i] - minus[i]) - (plus2[i] - minus2[i])) / (12.0 * d)).collect();
    assert_close("large", &tangents, &quotient, Tol::order(d, 4).times(10.0));
}

#[test]
fn long_runs_allocate_no_more_than_short_ones() {
    let count = |steps: u32| {
        allocations_in(|| {
            let mut state = State::new(0.0, vec![0.1, 0.2, 0.3, -0.1]).unwrap();
            let mut method = DiscreteGradient::new(Order::Four, 0.125).unwrap();
            method.integrate_to(&HenonHeiles, &mut state, 0.125 * f64::from(steps)).unwrap().steps
        })
    };
    assert_eq!((count(10).0, count(10).1), (count(1_000).0, 10));
}

#[test]
fn bad_input_is_refused_by_name() {
    for step in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = DiscreteGradient::<f64>::new(Order::Two, step).unwrap_err();
        assert!(matches!(error, IntegratorsError::InvalidStep { .. }), "{error}");
    }
    let mut method = DiscreteGradient::new(Order::Two, 0.1).unwrap();
    let mut short = State::new(0.0, vec![1.0]).unwrap();
    assert_eq!(
        method.integrate_to(&Pendulum, &mut short, 1.0).unwrap_err(),
        IntegratorsError::WrongLength { quantity: "state", expected: 2, found: 1 }
    );
    let mut state = State::new(0.0, vec![1.0, 0.0]).unwrap();
    state.values[1] = f64::INFINITY;
    assert!(matches!(
        method.integrate_to(&Pendulum, &mut state, 1.0).unwrap_err(),
        IntegratorsError::NotFinite { quantity: "state", index: 1, .. }
    ));
    let mut state = State::new(0.0, vec![1.0, 0.0]).unwrap();
    assert!(matches!(
        method.integrate_to(&Pendulum, &mut state, f64::NAN).unwrap_err(),
        IntegratorsError::NotFinite { quantity: "end", .. }
    ));
}

/// H = p²/2 + q − √(1 − q): a particle that reaches the end of its potential.
struct Edge;
impl EnergySystem for Edge {
    fn dimension(&self) -> usize {
        2
    }
    fn energy<T: Real>(&self, y: &[T]) -> T {
        T::lit(0.5) * y[1] * y[1] - (T::one() - y[0]).sqrt()
    }
}

#[test]
fn failed_run_keeps_the_last_complete_step() {
    let mut state = State::new(0.0, vec![0.0, 2.0]).unwrap();
    let mut last = (0.0, state.values.clone());
    let error = DiscreteGradient::new(Order::Two, 0.03)
        .unwrap()
        .integrate(&Edge, &mut state, 3.0, |step| {
            last = (step.time, step.values.to_vec());
            core::ops::ControlFlow::Continue(())
        })
        .unwrap_err();
    assert!(matches!(error, IntegratorsError::NotFinite { .. } | IntegratorsError::StagesDiverged { .. }), "{error}");
    assert!(0.2 < last.0 && last.0 < 1.0 && last.1[0] < 1.0, "{last:?}");
    assert_eq!((state.time, state.values), last);
}
