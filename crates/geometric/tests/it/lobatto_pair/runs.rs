//! Orders, symplecticity, equal methods, and what goes wrong.

use core::convert::Infallible;
use core::ops::ControlFlow;

use piola_geometric::{ActionRule, LobattoPair, VariationalIntegrator};
use piola_integrators::{Field, GaussLegendre, GaussRadau15, IntegratorsError, Order, State, Step, field, unobserved};
use piola_numerics::{Dual, Gradient, Lanes, Real};
use piola_testkit::{Tol, allocations_in, assert_close, assert_close_at_scale, assert_order, difference_quotient};

use crate::problems::{Force, SecondOrder, kepler, kepler_at};
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
    // hω = 5.8: the step of order eight is stable to six, and its fixed point is far away.
    let mut method = LobattoPair::new(Order::Eight, 0.058).unwrap();
    let start = [1.0, 1e-3, 0.0, 0.0];
    let mut state = State::new(0.0, start.to_vec()).unwrap();
    let error = method.integrate_to(&mut StiffSpring, &mut state, 0.58).unwrap_err();
    let is_told = matches!(error, IntegratorsError::StagesDiverged { .. } | IntegratorsError::NotFinite { .. });
    assert!(is_told, "{error}");
    assert_eq!((state.time, &state.values[..]), (0.0, &start[..]));
    let mut largest = 0.0_f64;
    let observer = |step: Step<'_>| {
        largest = largest.max(step.values[1].abs());
        ControlFlow::Continue(())
    };
    method.integrate_by_newton(&mut StiffSpring, &mut state, 58.0, observer).unwrap();
    assert!(largest < 2e-3, "the spring of amplitude 1e-3 reached {largest:e}");
    let mut alone = State::new(0.0, vec![1.0, 0.0, 0.0, 0.0]).unwrap();
    method.integrate_by_newton(&mut StiffSpring, &mut alone, 58.0, unobserved).unwrap();
    // The pendulum does not know of the spring.
    let pendulum = |state: &State| [state.values[0], state.values[2]];
    let tol = Tol::ulps_because(512.0, "a thousand steps whose iterations end at different roundings");
    assert_close("pendulum", &pendulum(&state), &pendulum(&alone), tol);
}

#[test]
fn newtons_iteration_ends_where_cancellation_hides_the_amplitude() {
    // q̇ = p, ṗ = −1e4 (q − 1): the force of an amplitude of 1e-6 is known to a part in 1e10.
    for order in Order::ALL {
        let mut spring = Stretched;
        let mut state = State::new(0.0, vec![1.0 + 1e-6, 0.0]).unwrap();
        LobattoPair::new(order, 0.003).unwrap().integrate_by_newton(&mut spring, &mut state, 3.0, unobserved).unwrap();
        let (stretch, speed): (f64, f64) = (state.values[0] - 1.0, state.values[1] / 100.0);
        let amplitude = [stretch.hypot(speed)];
        // The energy of a method of order two swings by (hω)²/8.
        let tol = Tol::stated(if order == Order::Two { 0.02 } else { 1e-4 }, "the swing of the energy");
        assert_close("amplitude", &amplitude, &[1e-6], tol);
    }
}

/// A spring of frequency 100 and rest length 1.
struct Stretched;
impl<T: Real> Field<T> for Stretched {
    type Error = Infallible;
    fn dimension(&self) -> usize {
        2
    }
    fn rate(&mut self, _t: f64, y: &[T], rate: &mut [T]) -> Result<(), Infallible> {
        rate[0] = y[1];
        rate[1] = -T::lit(1e4) * (y[0] - T::one());
        Ok(())
    }
}

#[test]
fn a_step_that_overflows_is_refused_and_leaves_the_state() {
    let start = [0.0, 1e308];
    let mut push = field(2, |_t, _y: &[f64], rate: &mut [f64]| rate.copy_from_slice(&[1.0, 1e308]));
    let mut state = State::new(0.0, start.to_vec()).unwrap();
    let error = LobattoPair::new(Order::Four, 1.0).unwrap().integrate_to(&mut push, &mut state, 1.0).unwrap_err();
    assert!(matches!(error, IntegratorsError::NotFinite { index: 1, .. }), "{error}");
    assert_eq!((state.time, &state.values[..]), (0.0, &start[..]));
    let error = GaussLegendre::new(Order::Four, 1.0).unwrap().integrate_to(&mut push, &mut state, 1.0).unwrap_err();
    assert!(matches!(error, IntegratorsError::NotFinite { index: 1, .. }), "{error}");
    assert_eq!((state.time, &state.values[..]), (0.0, &start[..]));
}

/// ṗ = −q
struct Harmonic;
impl Force for Harmonic {
    fn force<T: Real>(&self, _t: f64, q: &[T], force: &mut [T]) {
        force[0] = -q[0];
    }
}

#[test]
fn derivatives_at_rest_are_those_of_the_oscillator() {
    // q̈ = −q at rest, moved: q = cos t, v = −sin t are the derivatives by the start, and values settle at once.
    let expected = [1.0_f64.cos(), -1.0_f64.sin()];
    let start = || State::new(0.0, vec![Dual::variable(0.0), Dual::constant(0.0)]).unwrap();
    let tol = Tol::stated(1e-13, "the errors of the orders at these steps");
    let mut oscillator = SecondOrder { freedom: 1, force: Harmonic };
    for by in ["Lobatto", "Gauss", "Gauss-Radau"] {
        let mut state = start();
        let run = match by {
            "Lobatto" => LobattoPair::new(Order::Eight, 0.05).unwrap().integrate_to(&mut oscillator, &mut state, 1.0),
            "Gauss" => GaussLegendre::new(Order::Eight, 0.05).unwrap().integrate_to(&mut oscillator, &mut state, 1.0),
            _ => GaussRadau15::with_step(0.5).unwrap().integrate_to(&mut oscillator, &mut state, 1.0),
        };
        run.unwrap();
        let tangents: Vec<f64> = state.values.iter().map(|y| y.tangent).collect();
        assert_close(by, &tangents, &expected, tol);
    }
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
        IntegratorsError::OddDimension { dimension: 3 }
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
