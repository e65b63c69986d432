//! Errors fall with the order.

use piola_geometric::{ActionRule, VariationalIntegrator};
use piola_integrators::{Order, State};
use piola_testkit::{Tol, assert_close, assert_order};

use super::{Driven, Kepler, all, distance};
use crate::problems::kepler_at;

fn steps(order: Order) -> [f64; 4] {
    match order {
        Order::Two => [0.01, 0.005, 0.002, 0.001],
        Order::Four => [0.05, 0.025, 0.0125, 0.01],
        Order::Six => [0.1, 0.08, 0.05, 0.04],
        Order::Eight => [0.25, 0.2, 0.15625, 0.125],
    }
}

#[test]
fn errors_of_keplers_motion_fall_with_the_order() {
    for (rule, order) in all() {
        let steps = steps(order);
        let errors = steps.map(|h| {
            let mut state = State::new(0.0, kepler_at(0.2, 0.0).to_vec()).unwrap();
            VariationalIntegrator::new(rule, order, h).unwrap().integrate_to(&Kepler, &mut state, 5.0).unwrap();
            distance(&state.values, &kepler_at(0.2, 5.0))
        });
        assert_order(&format!("{rule:?}"), &steps, &errors, f64::from(order.value()), 0.1);
    }
}

#[test]
fn errors_of_a_driven_damped_oscillator_fall_with_the_order() {
    let driven = Driven { friction: 0.1 };
    assert_close("start", &driven.exact(0.0), &[1.0, 0.0], Tol::ulps(4.0));
    for (rule, order) in all() {
        let steps = match order {
            Order::Two | Order::Four => steps(order),
            Order::Six => steps(order).map(|h| 2.0 * h),
            Order::Eight => [0.3125, 0.25, 0.2, 0.15625],
        };
        let errors = steps.map(|h| {
            let mut state = State::new(0.0, vec![1.0, 0.0]).unwrap();
            VariationalIntegrator::new(rule, order, h).unwrap().integrate_to(&driven, &mut state, 5.0).unwrap();
            distance(&state.values, &driven.exact(5.0))
        });
        assert_order(&format!("{rule:?}"), &steps, &errors, f64::from(order.value()), 0.1);
    }
}

/// Newton's method ends a linear system in one iteration: a wrong derivative of the friction would ask for more.
#[test]
fn a_linear_system_takes_one_iteration_a_step() {
    let driven = Driven { friction: 0.9 };
    for (rule, order) in all() {
        let mut state = State::new(0.0, vec![1.0, 0.0]).unwrap();
        let mut method = VariationalIntegrator::new(rule, order, 0.25).unwrap();
        let report = method.integrate_to(&driven, &mut state, 5.0).unwrap();
        // The predictor, the iteration and the look at its end.
        assert!(report.evaluations <= 3 * report.steps, "{rule:?}, {order:?}: {report:?}");
    }
}

#[test]
fn a_start_from_rest_falls_freely() {
    /// L = v²/2 + q: q = t²/2, of which every rule is exact.
    struct Falling;
    impl piola_geometric::VariationalSystem for Falling {
        fn freedom(&self) -> usize {
            1
        }
        fn lagrangian<T: piola_numerics::Real>(&self, q: &[T], v: &[T], _t: T) -> T {
            T::lit(0.5) * v[0] * v[0] + q[0]
        }
    }
    for (rule, order) in all() {
        let mut method = VariationalIntegrator::new(rule, order, 0.125).unwrap();
        let mut state = method.start(&Falling, 0.0, &[0.0], &[0.0]).unwrap();
        method.integrate_to(&Falling, &mut state, 4.0).unwrap();
        assert_close("fall", &state.values, &[8.0, 4.0], Tol::ulps(8.0));
    }
    assert_eq!(VariationalIntegrator::<f64>::new(ActionRule::Gauss, Order::Two, 0.5).unwrap().order(), Order::Two);
}
