//! Errors fall with the order over two decades and more, within a tenth: the implicit methods, the pairs and Gauss–Radau, and their dense
//! output. Splittings are in `splittings` and `processed`.
//!
//! A slope is straight where neither the next power nor rounding shows. The explicit pairs and `GaussRadau15` therefore run with 31
//! digits; their errors end where the coefficients do, which are doubles. `GaussLegendre` and `GaussLegendre16` run in doubles. The
//! motion of the latter is a spiral q = cosh ωt in the complex plane with ω = exp(iπ/4): there the next power of the error is at right
//! angles to the first.

use core::convert::Infallible;
use core::ops::ControlFlow;

use piola_integrators::{
    DormandPrince853, Field, GaussLegendre, GaussLegendre16, GaussRadau15, Nystrom86, Nystrom1210, Order, SecondOrder,
    State, Tolerance, Verner98,
};
use piola_numerics::Real;
use piola_testkit::{DoubleDouble, assert_order};

use crate::problems::{kepler, kepler_at};

const SLOPE: f64 = 0.1;

fn wide(x: f64) -> DoubleDouble {
    DoubleDouble::lit(x)
}

fn error<T: Real>(actual: &[T], exact: &[T]) -> f64 {
    actual.iter().zip(exact).map(|(&a, &e)| (a - e).primal(0).abs()).fold(0.0, f64::max)
}

fn assert_slope(what: &str, steps: &[f64], order: f64, error: impl Fn(f64) -> f64) {
    let errors: Vec<f64> = steps.iter().map(|&h| error(h)).collect();
    assert!(100.0 * errors[errors.len() - 1] < errors[0], "{what}: less than two decades: {errors:?}");
    assert_order(what, steps, &errors, order, SLOPE);
}

fn parts(span: f64, counts: &[u32]) -> Vec<f64> {
    counts.iter().map(|&count| span / f64::from(count)).collect()
}

/// A method that takes equal steps: everything is tolerated, and steps may not grow.
macro_rules! equal_steps {
    ($method:ident) => {
        |h: f64| {
            $method::new(Tolerance::new(0.5, 1e9).unwrap()).with_first_step(h).unwrap().with_longest_step(h).unwrap()
        }
    };
}

/// A circle about the centre of attraction.
fn circle<T: Real>(t: f64) -> [T; 4] {
    let (sine, cosine) = T::lit(t).sin_cos();
    [cosine, sine, -sine, cosine]
}

/// q̈ = −q.
struct Oscillator;
impl<T: Real> SecondOrder<T> for Oscillator {
    type Error = Infallible;
    const VELOCITY_DEPENDENT: bool = false;
    fn freedom(&self) -> usize {
        1
    }
    fn acceleration(&mut self, _t: T, q: &[T], _v: &[T], acceleration: &mut [T]) -> Result<(), Infallible> {
        acceleration[0] = -q[0];
        Ok(())
    }
}

/// ẋ = x cos t, ż = −z² ẋ: x = exp(sin t), z = 1/(1 + x).
struct Driven;
impl<T: Real> Field<T> for Driven {
    type Error = Infallible;
    fn dimension(&self) -> usize {
        2
    }
    fn rate(&mut self, t: f64, y: &[T], rate: &mut [T]) -> Result<(), Infallible> {
        rate[0] = y[0] * T::lit(t).cos();
        rate[1] = -y[1] * y[1] * rate[0];
        Ok(())
    }
}

fn driven_at<T: Real>(t: f64) -> [T; 2] {
    let x = T::lit(t).sin().exp();
    [x, (T::one() + x).recip()]
}

#[test]
fn gauss_legendre() {
    for order in Order::ALL {
        let counts: &[u32] = match order {
            Order::Two => &[100, 200, 400, 1000, 2000],
            Order::Four => &[40, 60, 80, 120, 160],
            Order::Six => &[20, 30, 40, 50, 60],
            Order::Eight => &[16, 20, 24, 28, 32],
        };
        assert_slope(&format!("{order:?}"), &parts(5.0, counts), f64::from(order.value()), |h| {
            let mut state = State::new(0.0, kepler_at(0.2, 0.0).to_vec()).unwrap();
            GaussLegendre::new(order, h).unwrap().integrate_to(&mut kepler(), &mut state, 5.0).unwrap();
            error(&state.values, &kepler_at(0.2, 5.0))
        });
    }
}

/// Kepler's circle, five radians.
macro_rules! assert_slope_on_a_circle {
    ($what:expr, $method:expr, $counts:expr, $order:expr) => {
        assert_slope($what, &parts(5.0, $counts), $order, |h| {
            let mut state = State::new(0.0, circle::<DoubleDouble>(0.0).to_vec()).unwrap();
            $method(h).integrate_to(&mut kepler(), &mut state, 5.0).unwrap();
            error(&state.values, &circle(5.0))
        })
    };
}

#[test]
fn explicit_pairs() {
    assert_slope_on_a_circle!("8(5,3)", equal_steps!(DormandPrince853), &[16, 20, 25, 32, 40], 8.0);
    assert_slope_on_a_circle!("8(6)", equal_steps!(Nystrom86), &[16, 20, 25, 32], 8.0);
    // On a circle the ninth power nearly vanishes.
    assert_slope("9(8)", &parts(5.0, &[24, 28, 32, 40]), 9.0, |h| {
        let mut state = State::new(0.0, driven_at::<DoubleDouble>(0.0).to_vec()).unwrap();
        equal_steps!(Verner98)(h).integrate_to(&mut Driven, &mut state, 5.0).unwrap();
        error(&state.values, &driven_at(5.0))
    });
    // The phase of an oscillator: on a circle the coefficients' rounding is in the way.
    assert_slope("12(10)", &parts(100.0, &[60, 70, 80, 100]), 12.0, |h| {
        let mut state = State::new(0.0, vec![wide(1.0), wide(0.0)]).unwrap();
        equal_steps!(Nystrom1210)(h).integrate_to(&mut Oscillator, &mut state, 100.0).unwrap();
        let (sine, cosine) = wide(100.0).sin_cos();
        error(&state.values, &[cosine, -sine])
    });
}

#[test]
fn gauss_radau_15() {
    let method = |h| GaussRadau15::with_step(h).unwrap();
    // Lengths that are doubles: of others the times are rounded.
    assert_slope_on_a_circle!("15", method, &[8, 10, 16, 20], 15.0);
}

/// q̈ = i q in the complex plane.
struct Spiral;
impl<T: Real> SecondOrder<T> for Spiral {
    type Error = Infallible;
    const VELOCITY_DEPENDENT: bool = false;
    fn freedom(&self) -> usize {
        2
    }
    fn acceleration(&mut self, _t: T, q: &[T], _v: &[T], acceleration: &mut [T]) -> Result<(), Infallible> {
        (acceleration[0], acceleration[1]) = (-q[1], q[0]);
        Ok(())
    }
}

/// cosh ωt and its rate.
fn spiral(t: f64) -> [f64; 4] {
    let w = 0.5_f64.sqrt();
    let ((sine, cosine), x) = ((w * t).sin_cos(), w * t);
    // ω sinh ωt with ω = w (1 + i).
    let (re, im) = (x.sinh() * cosine, x.cosh() * sine);
    [x.cosh() * cosine, x.sinh() * sine, w * (re - im), w * (re + im)]
}

#[test]
fn gauss_legendre_16() {
    assert_slope("16", &parts(100.0, &[28, 32, 36, 40]), 16.0, |h| {
        let mut state = State::new(0.0, spiral(0.0).to_vec()).unwrap();
        GaussLegendre16::with_step(h).unwrap().integrate_to(&mut Spiral, &mut state, 100.0).unwrap();
        let exact = spiral(100.0);
        (state.values[0] - exact[0]).hypot(state.values[1] - exact[1]) / exact[0].hypot(exact[1])
    });
}

/// The largest error within one step of a circle from an exact start: of the first `rows` components.
macro_rules! assert_slope_of_dense_output {
    ($what:expr, $method:expr, $steps:expr, $rows:expr, $order:expr) => {
        assert_slope($what, &$steps, $order, |h| {
            let mut state = State::new(0.0, circle::<DoubleDouble>(0.0).to_vec()).unwrap();
            let mut largest = 0.0_f64;
            $method(h)
                .integrate(&mut kepler(), &mut state, h, |step| {
                    let mut y = [wide(0.0); 4];
                    for part in 1..16 {
                        let t = h * f64::from(part) / 16.0;
                        step.at(t, &mut y).unwrap();
                        largest = largest.max(error(&y[..$rows], &circle(t)[..$rows]));
                    }
                    ControlFlow::Continue(())
                })
                .unwrap();
            largest
        })
    };
}

/// Within a step a polynomial of order p errs by hᵖ⁺¹; velocities of a method for positions by one power less.
///
/// The output of `Verner98` is not here: its tenth power outweighs the eleventh only where the error is below 1e-17, and there the
/// coefficients are at their end (`verner_dense_output_errs_within_a_step_by_no_less_a_power_than_ten`).
#[test]
fn dense_outputs() {
    let steps = [0.3, 0.25, 0.2, 0.15];
    assert_slope_of_dense_output!("8(5,3)", equal_steps!(DormandPrince853), steps, 4, 8.0);
    assert_slope_of_dense_output!("8(6), positions", equal_steps!(Nystrom86), steps, 2, 8.0);
    assert_slope_of_dense_output!("8(6)", equal_steps!(Nystrom86), steps, 4, 7.0);
    assert_slope_of_dense_output!("12(10), positions", equal_steps!(Nystrom1210), steps, 2, 10.0);
    assert_slope_of_dense_output!("12(10)", equal_steps!(Nystrom1210), steps, 4, 9.0);
    let method = |h| GaussRadau15::with_step(h).unwrap();
    assert_slope_of_dense_output!("15, positions", method, [0.8, 0.6, 0.5, 0.4], 2, 10.0);
    assert_slope_of_dense_output!("15", method, [0.6, 0.5, 0.4, 0.3], 4, 9.0);
}

/// One step whose middle is the centre of the spiral.
#[test]
fn dense_output_of_gauss_legendre_16() {
    for (what, first, order) in [("positions", 0, 10.0), ("velocities", 2, 9.0)] {
        assert_slope(what, &[1.6, 1.25, 1.0, 0.8], order, |h| {
            let (start, end) = (-0.5 * h, 0.5 * h);
            let mut state = State::new(start, spiral(start).to_vec()).unwrap();
            let mut largest = 0.0_f64;
            GaussLegendre16::with_step(h)
                .unwrap()
                .integrate(&mut Spiral, &mut state, end, |step| {
                    let mut y = [0.0; 4];
                    for part in 1..16 {
                        let t = start + h * f64::from(part) / 16.0;
                        step.at(t, &mut y).unwrap();
                        let exact = spiral(t);
                        largest = largest.max((y[first] - exact[first]).hypot(y[first + 1] - exact[first + 1]));
                    }
                    ControlFlow::Continue(())
                })
                .unwrap();
            largest
        });
    }
}
