//! Gauss's collocation by Newton's iteration: equal to sweeps where both converge, and beyond.

use core::convert::Infallible;

use piola_geometric::GaussCollocation;
use piola_geometric::internal::PairTableau;
use piola_integrators::{Field, GaussLegendre, IntegratorsError, Order, State};
use piola_numerics::Real;
use piola_testkit::{Tol, allocations_in, assert_close, assert_order};

/// A spring pendulum H = |p|²/2 + k (|q| − 1)²/2 + q₂.
struct SpringPendulum(f64);
impl<T: Real> Field<T> for SpringPendulum {
    type Error = Infallible;
    fn dimension(&self) -> usize {
        4
    }
    fn rate(&mut self, _t: f64, y: &[T], rate: &mut [T]) -> Result<(), Infallible> {
        let length = (y[0] * y[0] + y[1] * y[1]).sqrt();
        let pull = T::lit(self.0) * (T::one() - length.recip());
        rate[0] = y[2];
        rate[1] = y[3];
        rate[2] = -pull * y[0];
        rate[3] = -pull * y[1] - T::one();
        Ok(())
    }
}

fn energy(k: f64, y: &[f64]) -> f64 {
    0.5 * (y[2] * y[2] + y[3] * y[3]) + 0.5 * k * (y[0].hypot(y[1]) - 1.0).powi(2) + y[1]
}

/// μᵢⱼ + μⱼᵢ = 1 to the last bit, and Σⱼ bⱼ μᵢⱼ cⱼᵏ⁻¹ = cᵢᵏ/k.
#[test]
fn couplings_are_symplectic_and_of_the_order_of_the_stages() {
    let mut compared = 0;
    for order in Order::ALL {
        let tableau = PairTableau::gauss(order);
        let s = tableau.stages;
        assert_eq!(s, order.value() as usize / 2);
        for i in 0..s {
            for j in 0..s {
                assert!((tableau.positions[i][j] + tableau.positions[j][i] - 1.0).abs() <= 0.0);
                assert!((tableau.positions[i][j] - tableau.momenta[i][j]).abs() <= 0.0);
            }
            for k in 1..=s {
                let power = |x: f64, n: usize| (0..n).fold(1.0, |product, _| product * x);
                let sum: f64 =
                    (0..s).map(|j| tableau.weights[j] * tableau.positions[i][j] * power(tableau.nodes[j], k - 1)).sum();
                let expected = power(tableau.nodes[i], k) / k as f64;
                assert!((sum - expected).abs() < 8.0 * f64::EPSILON, "{order:?}, {i}, {k}: {sum} {expected}");
                compared += 1;
            }
        }
    }
    assert_eq!(compared, 1 + 4 + 9 + 16);
}

#[test]
fn newton_and_sweeps_lead_to_the_same_state() {
    for order in Order::ALL {
        let start = State::new(0.0, vec![0.9, 0.3, -0.2, 0.4]).unwrap();
        let (mut newton, mut sweeps) = (start.clone(), start);
        GaussCollocation::new(order, 0.05).unwrap().integrate_to(&mut SpringPendulum(10.0), &mut newton, 5.0).unwrap();
        GaussLegendre::new(order, 0.05).unwrap().integrate_to(&mut SpringPendulum(10.0), &mut sweeps, 5.0).unwrap();
        let tol = Tol::stated(1e-13, "rounding of a hundred steps, grown by the motion");
        assert_close(&format!("{order:?}"), &newton.values, &sweeps.values, tol);
    }
}

/// k = 10⁸: sweeps diverge, Newton's iteration does not; the energy of two thousand steps stays where it was.
#[test]
fn stiff_spring_pendulum_keeps_its_energy_where_sweeps_diverge() {
    let k = 1e8;
    for order in [Order::Two, Order::Four, Order::Eight] {
        let mut state = State::new(0.0, vec![1.0, 0.0, 0.0, 0.0]).unwrap();
        let error =
            GaussLegendre::new(order, 0.01).unwrap().integrate_to(&mut SpringPendulum(k), &mut state, 1.0).unwrap_err();
        let diverged = matches!(error, IntegratorsError::StagesDiverged { .. } | IntegratorsError::NotFinite { .. });
        assert!(diverged, "{error}");
        let mut state = State::new(0.0, vec![1.0, 0.0, 0.0, 0.0]).unwrap();
        let before = energy(k, &state.values);
        GaussCollocation::new(order, 0.01).unwrap().integrate_to(&mut SpringPendulum(k), &mut state, 20.0).unwrap();
        let after = energy(k, &state.values);
        // The energy of the fast vibration, which the pull of gravity excites, is exchanged: measured 0.023 at order two.
        assert!((after - before).abs() < 5e-2, "{order:?}: {before} {after}");
        // k δ²/2 is no more than that energy.
        assert!((state.values[0].hypot(state.values[1]) - 1.0).abs() < 4e-5);
    }
}

/// The oscillator's phase over two decades of errors: within a tenth of the order.
#[test]
fn phase_errors_fall_with_the_order() {
    struct Oscillator;
    impl<T: Real> Field<T> for Oscillator {
        type Error = Infallible;
        fn dimension(&self) -> usize {
            2
        }
        fn rate(&mut self, _t: f64, y: &[T], rate: &mut [T]) -> Result<(), Infallible> {
            rate[0] = y[1];
            rate[1] = -y[0];
            Ok(())
        }
    }
    for (order, steps) in [
        (Order::Two, [0.05, 0.02, 0.01, 0.005]),
        (Order::Four, [0.25, 0.2, 0.1, 0.05]),
        (Order::Six, [0.5, 0.4, 0.25, 0.2]),
        (Order::Eight, [0.625, 0.5, 0.4, 0.3125]),
    ] {
        let errors = steps.map(|h| {
            let mut state = State::new(0.0, vec![1.0, 0.0]).unwrap();
            GaussCollocation::new(order, h).unwrap().integrate_to(&mut Oscillator, &mut state, 100.0).unwrap();
            (state.values[0] - 100.0_f64.cos()).abs().max((state.values[1] + 100.0_f64.sin()).abs())
        });
        assert_order(&format!("{order:?}"), &steps, &errors, f64::from(order.value()), 0.1);
    }
}

/// Quadratic integrals are kept in systems of odd dimension, too: |y|² and the energy of a free body.
#[test]
fn free_body_keeps_both_integrals() {
    struct Body;
    impl<T: Real> Field<T> for Body {
        type Error = Infallible;
        fn dimension(&self) -> usize {
            3
        }
        fn rate(&mut self, _t: f64, y: &[T], rate: &mut [T]) -> Result<(), Infallible> {
            let omega = [y[0], y[1] / T::lit(2.0), y[2] / T::lit(3.0)];
            rate[0] = y[1] * omega[2] - y[2] * omega[1];
            rate[1] = y[2] * omega[0] - y[0] * omega[2];
            rate[2] = y[0] * omega[1] - y[1] * omega[0];
            Ok(())
        }
    }
    let mut state = State::new(0.0, vec![1.0, 2.0, 3.0]).unwrap();
    GaussCollocation::new(Order::Four, 1.0).unwrap().integrate_to(&mut Body, &mut state, 1000.0).unwrap();
    let y = &state.values;
    assert!((y.iter().map(|y| y * y).sum::<f64>() - 14.0).abs() < 1e-12);
    assert!((0.5 * (y[0] * y[0] + y[1] * y[1] / 2.0 + y[2] * y[2] / 3.0) - 3.0).abs() < 1e-12);
}

#[test]
fn steps_allocate_nothing_and_bad_input_is_named() {
    let mut state = State::new(0.0, vec![1.0, 0.0, 0.0, 0.0]).unwrap();
    let mut method = GaussCollocation::new(Order::Six, 0.01).unwrap();
    method.integrate_to(&mut SpringPendulum(1e4), &mut state, 0.1).unwrap();
    let (count, _) = allocations_in(|| method.integrate_to(&mut SpringPendulum(1e4), &mut state, 1.1).unwrap());
    assert_eq!(count, 0);
    assert!(matches!(GaussCollocation::<f64>::new(Order::Six, f64::NAN), Err(IntegratorsError::InvalidStep { .. })));
    let mut short = State::new(0.0, vec![1.0]).unwrap();
    let error = method.integrate_to(&mut SpringPendulum(1e4), &mut short, 1.0).unwrap_err();
    assert_eq!(error, IntegratorsError::WrongLength { quantity: "state", expected: 4, found: 1 });
    let mut state = State::new(0.0, vec![0.0, 0.0, 0.0, 0.0]).unwrap();
    let error = method.integrate_to(&mut SpringPendulum(1e4), &mut state, 1.0).unwrap_err();
    assert!(matches!(error, IntegratorsError::NotFinite { quantity: "jacobian", .. }), "{error}");
    assert!(state.time.abs() <= 0.0);
}
