//! Orders, symplecticity, equal methods, and what goes wrong.

use core::convert::Infallible;
use core::ops::ControlFlow;

use piola_integrators::{
    ActionRule, Field, IntegratorsError, LobattoPair, Order, State, VariationalIntegrator, field, unobserved,
};
use piola_numerics::{Dual, Gradient, Lanes, Real};
use piola_testkit::{Tol, allocations_in, assert_close, assert_close_at_scale, assert_order, difference_quotient};

use crate::problems::{kepler, kepler_at};
use crate::variational::{Kepler, distance};

#[test]
fn errors_of_keplers_motion_fall_with_the_order() {
    for order in Order::ALL {
        let steps = match order {
            Order::Two => [0.01, 0.005, 0.002, 0.001],
            Order::Four => [0.05, 0.025, 0.0125, 0.01],
            Order::Six => [0.1, 0.08, 0.05, 0.04],
            Order::Eight => [0.25, 0.2, 0.15625, 0.125],
        };
        for by_newton in [false, true] {
            let errors = steps.map(|h| {
                let mut state = State::new(0.0, kepler_at(0.2, 0.0).to_vec()).unwrap();
                let mut method = LobattoPair::new(order, h).unwrap();
                if by_newton {
                    method.integrate_by_newton(&mut kepler(), &mut state, 5.0, unobserved).unwrap();
                } else {
                    method.integrate_to(&mut kepler(), &mut state, 5.0).unwrap();
                }
                distance(&state.values, &kepler_at(0.2, 5.0))
            });
            assert_order("Lobatto", &steps, &errors, f64::from(order.value()), 0.1);
        }
    }
}

/// H = (1 + ½ cos t)(1 + q²) p²/2 + 1 − cos q: it does not separate, and depends on time.
struct Inseparable;
impl<T: Real> Field<T> for Inseparable {
    type Error = Infallible;
    fn dimension(&self) -> usize {
        2
    }
    fn rate(&mut self, t: f64, y: &[T], rate: &mut [T]) -> Result<(), Infallible> {
        let factor = T::lit(1.0 + 0.5 * t.cos());
        rate[0] = factor * (T::one() + y[0] * y[0]) * y[1];
        rate[1] = -(factor * y[0] * y[1] * y[1]) - y[0].sin();
        Ok(())
    }
}

#[test]
fn orders_hold_where_the_hamiltonian_does_not_separate() {
    let run = |order: Order, h: f64| {
        let mut state = State::new(0.5, vec![0.5, 0.75]).unwrap();
        LobattoPair::new(order, h).unwrap().integrate_by_newton(&mut Inseparable, &mut state, 4.5, unobserved).unwrap();
        state.values
    };
    let exact = run(Order::Eight, 0.02);
    for (order, steps) in [
        (Order::Two, [0.02, 0.01, 0.005, 0.002]),
        (Order::Four, [0.1, 0.05, 0.025, 0.02]),
        (Order::Six, [0.16, 0.125, 0.1, 0.08]),
    ] {
        let errors = steps.map(|h| distance(&run(order, h), &exact));
        assert_order("Lobatto", &steps, &errors, f64::from(order.value()), 0.1);
    }
}

#[test]
fn the_derivative_of_a_run_is_symplectic_by_both_iterations() {
    type G = Gradient<f64, 2>;
    for order in Order::ALL {
        for by_newton in [false, true] {
            let mut state = State::new(0.0, vec![G::variable(0.5, 0), G::variable(0.75, 1)]).unwrap();
            let mut method = LobattoPair::<G>::new(order, 0.25).unwrap();
            if by_newton {
                method.integrate_by_newton(&mut Inseparable, &mut state, 5.0, unobserved).unwrap();
            } else {
                method.integrate_to(&mut Inseparable, &mut state, 5.0).unwrap();
            }
            let [[a, b], [c, d]] = [state.values[0].partials, state.values[1].partials];
            assert!(0.1 < b.abs().max(c.abs()), "no derivative of the identity");
            let scale = (a * d).abs().max((b * c).abs());
            let what = format!("{order:?}, Newton's iteration: {by_newton}");
            assert_close_at_scale(&what, &[a * d - b * c], &[1.0], scale, Tol::ulps(64.0));
        }
    }
}

#[test]
fn pairs_equal_lobattos_variational_integrators() {
    for order in Order::ALL {
        let start = || State::new(0.0, kepler_at(0.3, 0.0).to_vec()).unwrap();
        let (mut pair, mut variational) = (start(), start());
        LobattoPair::new(order, 0.1).unwrap().integrate_to(&mut kepler(), &mut pair, 5.0).unwrap();
        let mut method = VariationalIntegrator::new(ActionRule::Lobatto, order, 0.1).unwrap();
        method.integrate_to(&Kepler, &mut variational, 5.0).unwrap();
        let tol = Tol::ulps_because(128.0, "fifty steps of both, whose roundings the motion magnifies");
        assert_close(&format!("{order:?}"), &pair.values, &variational.values, tol);
    }
}

/// A spring of frequency 100 on a pendulum that swings about once in six seconds.
struct StiffSpring;
impl<T: Real> Field<T> for StiffSpring {
    type Error = Infallible;
    fn dimension(&self) -> usize {
        4
    }
    fn rate(&mut self, _t: f64, y: &[T], rate: &mut [T]) -> Result<(), Infallible> {
        rate[0] = y[2];
        rate[1] = y[3];
        rate[2] = -y[0].sin();
        rate[3] = -T::lit(1e4) * y[1];
        Ok(())
    }
}

#[test]
fn newtons_iteration_converges_where_the_fixed_point_does_not() {
    let start = || State::new(0.0, vec![1.0, 0.0, 0.0, 0.0]).unwrap();
    let mut method = LobattoPair::new(Order::Four, 0.25).unwrap();
    // The spring is at rest, so that only its matrix tells; then it is set swinging.
    let mut state = State::new(0.0, vec![1.0, 1e-3, 0.0, 0.0]).unwrap();
    let error = method.integrate_to(&mut StiffSpring, &mut state, 1.0).unwrap_err();
    let is_told = matches!(error, IntegratorsError::StagesDiverged { .. } | IntegratorsError::NotFinite { .. });
    assert!(is_told, "{error}");
    assert_eq!((state.time, &state.values[..]), (0.0, &[1.0, 1e-3, 0.0, 0.0][..]));
    method.integrate_by_newton(&mut StiffSpring, &mut state, 1.0, unobserved).unwrap();
    let mut slow = start();
    method.integrate_by_newton(&mut StiffSpring, &mut slow, 1.0, unobserved).unwrap();
    // The pendulum does not know of the spring.
    let pendulum = |state: &State| [state.values[0], state.values[2]];
    assert_close("pendulum", &pendulum(&state), &pendulum(&slow), Tol::ulps(16.0));
}

#[test]
fn scalars_carry_lanes_and_derivatives() {
    let end = |start: &[f64]| {
        let mut state = State::new(0.0, start.to_vec()).unwrap();
        LobattoPair::new(Order::Six, 0.1).unwrap().integrate_to(&mut Inseparable, &mut state, 3.0).unwrap();
        state.values
    };
    let mut state = State::new(0.0, vec![Lanes([0.5, -0.25]), Lanes([0.75, 1.0])]).unwrap();
    let mut method = LobattoPair::<Lanes<f64, 2>>::new(Order::Six, 0.1).unwrap();
    method.integrate_to(&mut Inseparable, &mut state, 3.0).unwrap();
    for (lane, start) in [[0.5, 0.75], [-0.25, 1.0]].into_iter().enumerate() {
        let actual: Vec<f64> = state.values.iter().map(|y| y.primal(lane)).collect();
        assert_close("lane", &actual, &end(&start), Tol::ulps(64.0));
    }
    let mut state = State::new(0.0, vec![Dual::variable(0.5), Dual::constant(0.75)]).unwrap();
    LobattoPair::<Dual<f64>>::new(Order::Six, 0.1).unwrap().integrate_to(&mut Inseparable, &mut state, 3.0).unwrap();
    let tangents: Vec<f64> = state.values.iter().map(|y| y.tangent).collect();
    let quotient = difference_quotient(end, &[0.5, 0.75], &[1.0, 0.0]);
    assert_close("dual", &tangents, &quotient, Tol::stated(1e-10, "sixth-order differences"));
}

#[test]
fn repeated_runs_are_bit_identical_and_allocate_once() {
    for by_newton in [false, true] {
        let run = |method: &mut LobattoPair, end: f64| {
            let mut state = State::new(0.0, vec![0.5, 0.75]).unwrap();
            if by_newton {
                method.integrate_by_newton(&mut Inseparable, &mut state, end, unobserved).unwrap();
            } else {
                method.integrate_to(&mut Inseparable, &mut state, end).unwrap();
            }
            state
        };
        let mut used = LobattoPair::new(Order::Four, 0.125).unwrap();
        let first = run(&mut used, 5.0);
        assert_eq!(run(&mut used, 5.0), first);
        assert_eq!(run(&mut LobattoPair::new(Order::Four, 0.125).unwrap(), 5.0), first);
        let count = |end: f64| allocations_in(|| run(&mut LobattoPair::new(Order::Four, 0.125).unwrap(), end)).0;
        assert_eq!(count(1.0), count(100.0));
    }
}

#[test]
fn bad_input_is_refused_and_a_failed_run_keeps_the_last_complete_step() {
    assert!(matches!(LobattoPair::<f64>::new(Order::Two, 0.0).unwrap_err(), IntegratorsError::InvalidStep { .. }));
    let mut method = LobattoPair::new(Order::Two, 0.03).unwrap();
    let mut odd = field(3, |_t, _y: &[f64], rate: &mut [f64]| rate.fill(0.0));
    let mut state = State::new(0.0, vec![0.0; 3]).unwrap();
    assert_eq!(
        method.integrate_to(&mut odd, &mut state, 1.0).unwrap_err(),
        IntegratorsError::WrongLength { quantity: "field", expected: 4, found: 3 }
    );
    let mut edge = field(2, |_t, y: &[f64], rate: &mut [f64]| {
        rate[0] = y[1];
        rate[1] = (1.0 - y[0]).sqrt();
    });
    let mut state = State::new(0.0, vec![0.0, 2.0]).unwrap();
    let mut last = (0.0, Vec::new());
    let error = method
        .integrate(&mut edge, &mut state, 3.0, |step| {
            last = (step.time, step.values.to_vec());
            ControlFlow::Continue(())
        })
        .unwrap_err();
    assert!(matches!(error, IntegratorsError::NotFinite { quantity: "rate", index: 1, .. }), "{error}");
    assert!(0.2 < last.0 && last.1[0] < 1.0, "{last:?}");
    assert_eq!((state.time, state.values), last);
}

#[test]
fn nothing_to_integrate_is_integrated() {
    let mut nothing = field(0, |_t, _y: &[f64], _rate: &mut [f64]| ());
    let mut state = State::new(0.0, Vec::new()).unwrap();
    let report = LobattoPair::new(Order::Two, 0.5).unwrap().integrate_to(&mut nothing, &mut state, 1.0).unwrap();
    assert_eq!((report.steps, state.time), (2, 1.0));
}
