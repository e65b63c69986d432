//! Bad input, failed runs, repetition and allocations.

use core::ops::ControlFlow;

use piola_geometric::{ActionRule, DiscreteEulerLagrange, VariationalIntegrator, VariationalSystem, momentum_map};
use piola_integrators::{Ending, IntegratorsError, Order, State};
use piola_numerics::Real;
use piola_testkit::allocations_in;

use super::{Kepler, SphericalPendulum, all};

#[test]
fn bad_input_is_refused_by_name() {
    for step in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = VariationalIntegrator::<f64>::new(ActionRule::Gauss, Order::Two, step).unwrap_err();
        assert!(matches!(error, IntegratorsError::InvalidStep { .. }), "{error}");
        assert!(DiscreteEulerLagrange::<f64>::new(step).is_err());
    }
    let mut method = VariationalIntegrator::new(ActionRule::Gauss, Order::Four, 0.1).unwrap();
    assert_eq!(
        method.start(&Kepler, 0.0, &[1.0], &[0.0, 1.0]).unwrap_err(),
        IntegratorsError::WrongLength { quantity: "q", expected: 2, found: 1 }
    );
    assert_eq!(
        method.start(&Kepler, 0.0, &[1.0, 0.0], &[0.0, 1.0, 2.0]).unwrap_err(),
        IntegratorsError::WrongLength { quantity: "v", expected: 2, found: 3 }
    );
    let error = method.start(&Kepler, 0.0, &[1.0, 0.0], &[f64::NAN, 1.0]).unwrap_err();
    assert!(matches!(error, IntegratorsError::NotFinite { quantity: "v", index: 0, .. }), "{error}");
    let error = method.start(&Kepler, 0.0, &[0.0, 0.0], &[0.0, 1.0]).unwrap_err();
    assert!(matches!(error, IntegratorsError::NotFinite { quantity: "derivative of the Lagrangian", .. }), "{error}");
    let mut short = State::new(0.0, vec![1.0, 0.0]).unwrap();
    assert_eq!(
        method.integrate_to(&Kepler, &mut short, 1.0).unwrap_err(),
        IntegratorsError::WrongLength { quantity: "state", expected: 4, found: 2 }
    );
    assert_eq!(
        momentum_map(&[1.0], &[1.0, 2.0]).unwrap_err(),
        IntegratorsError::WrongLength { quantity: "p", expected: 1, found: 2 }
    );
}

/// L = v: it has no momenta that depend on v.
struct Irregular;
impl VariationalSystem for Irregular {
    fn freedom(&self) -> usize {
        1
    }
    fn lagrangian<T: Real>(&self, q: &[T], v: &[T], _t: T) -> T {
        v[0] + q[0]
    }
}

#[test]
fn a_lagrangian_that_is_not_regular_is_refused() {
    let mut method = VariationalIntegrator::new(ActionRule::Gauss, Order::Two, 0.1).unwrap();
    let mut state = State::new(0.0, vec![0.5, 1.0]).unwrap();
    let error = method.integrate_to(&Irregular, &mut state, 1.0).unwrap_err();
    assert!(matches!(error, IntegratorsError::SingularMatrix { pivot: 0, .. }), "{error}");
    assert_eq!(state, State::new(0.0, vec![0.5, 1.0]).unwrap());
}

/// L = v²/2 + √(1 − q) + 4q: a particle that reaches the end of its potential.
struct Edge;
impl VariationalSystem for Edge {
    fn freedom(&self) -> usize {
        1
    }
    fn lagrangian<T: Real>(&self, q: &[T], v: &[T], _t: T) -> T {
        T::lit(0.5) * v[0] * v[0] + (T::one() - q[0]).sqrt() + T::lit(4.0) * q[0]
    }
}

#[test]
fn failed_run_keeps_the_last_complete_step() {
    for (rule, order) in all() {
        let mut state = State::new(0.0, vec![0.0, 2.0]).unwrap();
        let mut last = (0.0, state.values.clone());
        let error = VariationalIntegrator::new(rule, order, 0.03)
            .unwrap()
            .integrate(&Edge, &mut state, 3.0, |step| {
                last = (step.time, step.values.to_vec());
                ControlFlow::Continue(())
            })
            .unwrap_err();
        let is_told = matches!(error, IntegratorsError::NotFinite { .. } | IntegratorsError::StagesDiverged { .. });
        assert!(is_told, "{error}");
        assert!(0.2 < last.0 && last.0 < 1.0, "{last:?}");
        assert_eq!((state.time, state.values), last);
    }
}

#[test]
fn repeated_runs_are_bit_identical_also_by_a_used_method() {
    for (rule, order) in all() {
        let run = |method: &mut VariationalIntegrator| {
            let mut state = State::new(0.0, vec![0.5, 0.0, 0.25, 1.0]).unwrap();
            let report = method.integrate_to(&SphericalPendulum, &mut state, 5.0).unwrap();
            (state, report)
        };
        let mut used = VariationalIntegrator::new(rule, order, 0.1).unwrap();
        let first = run(&mut used);
        assert_eq!(run(&mut used), first);
        assert_eq!(run(&mut VariationalIntegrator::new(rule, order, 0.1).unwrap()), first);
    }
}

#[test]
fn long_runs_allocate_no_more_than_short_ones() {
    for (rule, order) in all() {
        let run = |steps: u32| {
            allocations_in(|| {
                let mut state = State::new(0.0, vec![0.5, 0.0, 0.25, 1.0]).unwrap();
                let mut method = VariationalIntegrator::new(rule, order, 0.125).unwrap();
                method.integrate_to(&SphericalPendulum, &mut state, 0.125 * f64::from(steps)).unwrap().steps
            })
        };
        assert_eq!((run(10).0, run(10).1), (run(200).0, 10));
    }
}

#[test]
fn the_observer_stops_a_run() {
    let mut state = State::new(0.0, vec![0.5, 0.0, 0.25, 1.0]).unwrap();
    let mut method = VariationalIntegrator::new(ActionRule::Lobatto, Order::Four, 0.125).unwrap();
    let report = method
        .integrate(&SphericalPendulum, &mut state, 5.0, |step| {
            if step.number == 3 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        })
        .unwrap();
    assert_eq!((report.ending, report.steps, state.time), (Ending::Stopped, 3, 0.375));
}
