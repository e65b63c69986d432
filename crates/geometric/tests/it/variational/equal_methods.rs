//! Methods that are the same on paper give the same numbers.

use piola_geometric::{
    ActionRule, Chord, DiscreteEulerLagrange, DiscreteLagrangian, VariationalIntegrator, VariationalSystem,
};
use piola_integrators::{GaussLegendre, Order, State};
use piola_numerics::{Lanes, Real};
use piola_testkit::{Tol, assert_close};

use super::{Driven, Kepler, SphericalPendulum, all};
use crate::problems::{kepler, kepler_at};

#[test]
fn gauss_rules_equal_gauss_legendre_collocation() {
    for order in Order::ALL {
        let start = || State::new(0.0, kepler_at(0.3, 0.0).to_vec()).unwrap();
        let (mut variational, mut collocation) = (start(), start());
        let mut method = VariationalIntegrator::new(ActionRule::Gauss, order, 0.1).unwrap();
        method.integrate_to(&Kepler, &mut variational, 5.0).unwrap();
        GaussLegendre::new(order, 0.1).unwrap().integrate_to(&mut kepler(), &mut collocation, 5.0).unwrap();
        let tol = Tol::ulps_because(128.0, "fifty steps of both, whose roundings the motion magnifies");
        assert_close(&format!("{order:?}"), &variational.values, &collocation.values, tol);
    }
}

#[test]
fn lobattos_rule_of_order_two_equals_stoermer_and_verlet() {
    let mut state = State::new(0.0, kepler_at(0.3, 0.0).to_vec()).unwrap();
    let h = 0.1;
    let mut method = VariationalIntegrator::new(ActionRule::Lobatto, Order::Two, h).unwrap();
    method.integrate_to(&Kepler, &mut state, 5.0).unwrap();
    // Kick, drift, kick.
    let [mut x, mut y, mut u, mut w] = kepler_at(0.3, 0.0);
    for _ in 0..50 {
        for part in [true, false] {
            let cube = (x * x + y * y).powf(1.5);
            u -= 0.5 * h * x / cube;
            w -= 0.5 * h * y / cube;
            if part {
                x += h * u;
                y += h * w;
            }
        }
    }
    let tol = Tol::ulps_because(256.0, "fifty steps, one of the two without compensation");
    assert_close("Störmer-Verlet", &state.values, &[x, y, u, w], tol);
}

/// The midpoint rule's discrete Lagrangian and discrete forces of a system.
struct Midpoint<S>(S);

impl<S: VariationalSystem> DiscreteLagrangian for Midpoint<S> {
    const FORCED: bool = S::FORCED;
    fn freedom(&self) -> usize {
        self.0.freedom()
    }
    fn discrete_lagrangian<T: Real>(&self, chord: Chord<'_, T>) -> T {
        let (q, v) = middle(chord);
        T::lit(chord.step) * self.0.lagrangian(&q, &v, T::lit(chord.t + 0.5 * chord.step))
    }
    fn discrete_forces<T: Real>(&self, chord: Chord<'_, T>, at_start: &mut [T], at_end: &mut [T]) {
        let (q, v) = middle(chord);
        self.0.force(&q, &v, T::lit(chord.t + 0.5 * chord.step), at_start);
        for (start, end) in at_start.iter_mut().zip(at_end) {
            *start *= T::lit(0.5 * chord.step);
            *end = *start;
        }
    }
}

fn middle<T: Real>(chord: Chord<'_, T>) -> (Vec<T>, Vec<T>) {
    let q = chord.start.iter().zip(chord.end).map(|(&a, &b)| T::lit(0.5) * (a + b)).collect();
    (q, chord.change.iter().map(|&change| change / T::lit(chord.step)).collect())
}

fn assert_midpoint_equal(what: &str, system: impl VariationalSystem, start: &[f64]) {
    let mut first = State::new(0.0, start.to_vec()).unwrap();
    let mut second = first.clone();
    let mut method = VariationalIntegrator::new(ActionRule::Gauss, Order::Two, 0.1).unwrap();
    method.integrate_to(&system, &mut first, 5.0).unwrap();
    DiscreteEulerLagrange::new(0.1).unwrap().integrate_to(&Midpoint(system), &mut second, 5.0).unwrap();
    assert_close(what, &first.values, &second.values, Tol::ulps_because(128.0, "fifty steps of both"));
}

#[test]
fn gauss_rule_of_order_two_equals_the_discrete_lagrangian_of_the_midpoint() {
    assert_midpoint_equal("pendulum", SphericalPendulum, &[0.5, 0.0, 0.25, 1.0]);
    assert_midpoint_equal("driven", Driven { friction: 0.1 }, &[1.0, 0.0]);
    // Five coordinates: more than are differentiated at once.
    assert_midpoint_equal("chain", Chain, &[0.1, -0.2, 0.3, 0.0, 0.4, 0.0, 0.1, 0.0, -0.1, 0.2]);
}

/// Five masses between springs that harden.
struct Chain;
impl VariationalSystem for Chain {
    fn freedom(&self) -> usize {
        5
    }
    fn lagrangian<T: Real>(&self, q: &[T], v: &[T], _t: T) -> T {
        let (mut sum, mut before) = (T::zero(), T::zero());
        for (&q, &v) in q.iter().zip(v) {
            let square = (q - before) * (q - before);
            sum += T::lit(0.5) * (v * v - square) - T::lit(0.25) * square * square;
            before = q;
        }
        sum
    }
}

#[test]
fn there_and_back_equals_the_start() {
    let start = [0.5, 0.0, 0.25, 1.0];
    for (rule, order) in all() {
        let mut state = State::new(0.0, start.to_vec()).unwrap();
        let mut method = VariationalIntegrator::new(rule, order, 0.1).unwrap();
        method.integrate_to(&SphericalPendulum, &mut state, 10.0).unwrap();
        method.integrate_to(&SphericalPendulum, &mut state, 0.0).unwrap();
        let tol = Tol::ulps_because(512.0, "200 steps, whose roundings the flow magnifies");
        assert_close(&format!("{rule:?} {order:?}"), &state.values, &start, tol);
    }
}

#[test]
fn lanes_give_what_each_lane_gets_alone_to_rounding() {
    let starts = [[0.5, 0.0, 0.25, 1.0], [0.25, 0.5, -0.5, 0.5]];
    for (rule, order) in all() {
        let lanes = (0..4).map(|i| Lanes([starts[0][i], starts[1][i]])).collect();
        let mut state = State::new(0.0, lanes).unwrap();
        let mut method = VariationalIntegrator::<Lanes<f64, 2>>::new(rule, order, 0.1).unwrap();
        method.integrate_to(&SphericalPendulum, &mut state, 5.0).unwrap();
        for (lane, start) in starts.into_iter().enumerate() {
            let mut alone = State::new(0.0, start.to_vec()).unwrap();
            let mut method = VariationalIntegrator::new(rule, order, 0.1).unwrap();
            method.integrate_to(&SphericalPendulum, &mut alone, 5.0).unwrap();
            let actual: Vec<f64> = state.values.iter().map(|y| y.primal(lane)).collect();
            assert_close("lane", &actual, &alone.values, Tol::ulps(64.0));
        }
    }
}
