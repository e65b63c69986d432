//! Errors fall with the power of the step that the method promises.

use core::convert::Infallible;
use core::ops::ControlFlow;

use piola_integrators::{
    Composition, DormandPrince853, Field, GaussLegendre, Order, Separable, State, Tolerance, field,
};
use piola_testkit::assert_order;

use crate::problems::{kepler, kepler_at};

const E: f64 = 0.3;

fn error(actual: &[f64], expected: &[f64]) -> f64 {
    actual.iter().zip(expected).map(|(a, e)| (a - e).abs()).fold(0.0, f64::max)
}

fn start() -> State {
    State::new(0.0, kepler_at(E, 0.0).to_vec()).unwrap()
}

fn steps_for(order: Order) -> [f64; 3] {
    match order {
        Order::Two => [0.02, 0.01, 0.005],
        Order::Four => [0.05, 0.025, 0.0125],
        Order::Six => [0.1, 0.0625, 0.05],
        Order::Eight => [0.2, 0.125, 0.1],
    }
}

#[test]
fn composition_error_falls_with_its_order() {
    for order in Order::ALL {
        let steps = steps_for(order).map(|h| if order == Order::Eight { 0.5 * h } else { h });
        let errors = steps.map(|h| {
            let mut state = start();
            Composition::new(order, h).unwrap().integrate_to(&mut kepler(), &mut state, 5.0).unwrap();
            error(&state.values, &kepler_at(E, 5.0))
        });
        assert_order("composition", &steps, &errors, f64::from(order.value()), 0.4);
    }
}

#[test]
fn gauss_legendre_error_falls_with_its_order() {
    for order in Order::ALL {
        let steps = steps_for(order);
        let errors = steps.map(|h| {
            let mut state = start();
            GaussLegendre::new(order, h).unwrap().integrate_to(&mut kepler(), &mut state, 5.0).unwrap();
            error(&state.values, &kepler_at(E, 5.0))
        });
        assert_order("collocation", &steps, &errors, f64::from(order.value()), 0.4);
    }
}

/// q̇ = (1 + ½ sin t) p, ṗ = −(1 + ½ cos 2t) q, as a separable pair and as a field.
struct Driven;
impl Separable for Driven {
    type Error = Infallible;
    fn freedom(&self) -> usize {
        1
    }
    fn velocity(&mut self, t: f64, p: &[f64], velocity: &mut [f64]) -> Result<(), Infallible> {
        velocity[0] = (1.0 + 0.5 * t.sin()) * p[0];
        Ok(())
    }
    fn force(&mut self, t: f64, q: &[f64], force: &mut [f64]) -> Result<(), Infallible> {
        force[0] = -(1.0 + 0.5 * (2.0 * t).cos()) * q[0];
        Ok(())
    }
}
impl Field for Driven {
    type Error = Infallible;
    fn dimension(&self) -> usize {
        2
    }
    fn rate(&mut self, t: f64, y: &[f64], rate: &mut [f64]) -> Result<(), Infallible> {
        self.velocity(t, &y[1..], &mut rate[..1])?;
        self.force(t, &y[..1], &mut rate[1..])
    }
}

#[test]
fn orders_hold_where_both_halves_depend_on_time() {
    let mut reference = State::new(0.5, vec![1.0, 0.25]).unwrap();
    DormandPrince853::new(Tolerance::relative(1e-15).unwrap()).integrate_to(&mut Driven, &mut reference, 4.5).unwrap();
    for order in Order::ALL {
        let steps = steps_for(order);
        let steps = steps.map(|h| if order == Order::Eight { h } else { 2.0 * h });
        let errors = steps.map(|h| {
            let mut state = State::new(0.5, vec![1.0, 0.25]).unwrap();
            Composition::new(order, h).unwrap().integrate_to(&mut Driven, &mut state, 4.5).unwrap();
            error(&state.values, &reference.values)
        });
        assert_order("driven composition", &steps, &errors, f64::from(order.value()), 0.5);
        let steps = steps.map(|h| if order == Order::Eight { 2.0 * h } else { h });
        let errors = steps.map(|h| {
            let mut state = State::new(0.5, vec![1.0, 0.25]).unwrap();
            GaussLegendre::new(order, h).unwrap().integrate_to(&mut Driven, &mut state, 4.5).unwrap();
            error(&state.values, &reference.values)
        });
        assert_order("driven collocation", &steps, &errors, f64::from(order.value()), 0.5);
    }
}

/// A method that takes equal steps: everything is tolerated, and steps may not grow.
fn equal_steps(h: f64) -> DormandPrince853 {
    DormandPrince853::new(Tolerance::new(0.5, 1e6).unwrap()).with_first_step(h).unwrap().with_longest_step(h).unwrap()
}

#[test]
fn dormand_prince_error_falls_with_order_eight() {
    let steps = [0.1, 0.078_125, 0.0625, 0.05];
    let errors = steps.map(|h| {
        let mut state = start();
        let report = equal_steps(h).integrate_to(&mut kepler(), &mut state, 5.0).unwrap();
        assert_eq!((report.rejected, report.evaluations), (0, 1 + 12 * report.steps));
        error(&state.values, &kepler_at(E, 5.0))
    });
    assert_order("8(5,3)", &steps, &errors, 8.0, 0.5);
}

#[test]
fn dense_output_error_of_one_step_falls_with_order_eight() {
    // A polynomial of order seven errs by h⁸ within one step from an exact start.
    let steps = [0.4, 0.2, 0.1];
    let errors = steps.map(|h| {
        let mut state = start();
        let mut largest = 0.0_f64;
        equal_steps(h)
            .integrate(&mut kepler(), &mut state, h, |step| {
                let mut y = [0.0; 4];
                for part in 1..16 {
                    let t = h * f64::from(part) / 16.0;
                    step.at(t, &mut y).unwrap();
                    largest = largest.max(error(&y, &kepler_at(E, t)));
                }
                ControlFlow::Continue(())
            })
            .unwrap();
        largest
    });
    assert_order("dense output", &steps, &errors, 8.0, 0.6);
}

#[test]
fn adaptive_error_is_proportional_to_the_tolerance() {
    let tolerances = [1e-6, 1e-8, 1e-10, 1e-12];
    let errors = tolerances.map(|tolerance| {
        let mut state = start();
        DormandPrince853::new(Tolerance::relative(tolerance).unwrap())
            .integrate_to(&mut kepler(), &mut state, 10.0)
            .unwrap();
        error(&state.values, &kepler_at(E, 10.0))
    });
    assert_order("tolerance", &tolerances, &errors, 1.0, 0.25);
}

#[test]
fn the_step_follows_the_unit_of_time() {
    // The same motion in seconds and in microseconds takes the same steps.
    let counts = [1.0, 1e-6].map(|second: f64| {
        let rate = 1.0 / second;
        let mut oscillator = field(2, move |_t, y: &[f64], out: &mut [f64]| {
            out[0] = rate * y[1];
            out[1] = -rate * y[0];
        });
        let mut state = State::new(0.0, vec![1.0, 0.0]).unwrap();
        DormandPrince853::new(Tolerance::relative(1e-10).unwrap())
            .integrate_to(&mut oscillator, &mut state, 20.0 * second)
            .unwrap()
            .steps
    });
    assert_eq!(counts[0], counts[1]);
}
