//! Nodes, conditions of order and the order itself, in twice double precision.

use core::convert::Infallible;

use piola_integrators::{GaussRadau15, SecondOrder, State};
use piola_numerics::Real;
use piola_testkit::{DoubleDouble, Tol, assert_close, assert_order};

use super::by;
use crate::problems::kepler;

fn wide(x: f64) -> DoubleDouble {
    DoubleDouble::lit(x)
}

/// The state after one step of length one.
fn one_step<T: Real, F: FnMut(T, &[T], &[T], &mut [T])>(start: Vec<T>, function: F) -> Vec<T> {
    let mut state = State::new(0.0, start).unwrap();
    let mut field = by(1, function);
    GaussRadau15::with_step(1.0).unwrap().integrate_to(&mut field, &mut state, 1.0).unwrap();
    state.values
}

/// The times at which a step of length one evaluates the field: the start, and the nodes of the first sweep.
fn nodes<T: Real>() -> Vec<T> {
    let mut times = Vec::new();
    one_step(vec![T::zero(); 2], |t, _q, _v, a: &mut [T]| {
        times.push(t);
        a[0] = T::zero();
    });
    assert_eq!(times.len(), 8, "one sweep shows that nothing accelerates");
    times
}

#[test]
fn nodes_equal_the_zeros_of_legendre_seven_plus_eight() {
    let found = nodes::<DoubleDouble>();
    assert_eq!(found[0], wide(0.0));
    for pair in found.windows(2) {
        assert!(pair[0].primal(0) < pair[1].primal(0) && pair[1].primal(0) < 1.0);
    }
    for &c in &found {
        let x = wide(2.0) * c - wide(1.0);
        let (mut before, mut now, mut slope_before, mut slope) = (wide(1.0), x, wide(0.0), wide(1.0));
        for k in 1..8 {
            let (k, next) = (wide(f64::from(k)), wide(f64::from(k + 1)));
            let p = ((k + next) * x * now - k * before) / next;
            let d = ((k + next) * (now + x * slope) - k * slope_before) / next;
            (before, now, slope_before, slope) = (now, p, slope, d);
        }
        let error = ((before + now) / (slope_before + slope)).primal(0).abs();
        assert!(error < 1e-31, "{c:?} is off by {error:e}");
    }
    // Doubles are the nearest ones, to which the tables then belong.
    for (rounded, exact) in nodes::<f64>().iter().zip(found) {
        assert_eq!(rounded.to_bits(), exact.primal(0).to_bits());
    }
}

#[test]
fn one_step_equals_the_integrals_of_powers_to_degree_fourteen() {
    for degree in 0..=15 {
        let [position, velocity] = {
            let n = wide(f64::from(degree));
            let once = wide(1.0) / (n + wide(1.0));
            [once / (n + wide(2.0)), once]
        };
        let errors =
            |values: &[DoubleDouble]| [(values[0] - position).primal(0).abs(), (values[1] - velocity).primal(0).abs()];
        let values = one_step(vec![wide(0.0); 2], |t, _q, _v, a| a[0] = t.powi(degree));
        let [of_position, of_velocity] = errors(&values);
        // Positions are exact to degree thirteen: ∫(1 − t) tᵏ has degree k + 1.
        if degree < 14 {
            assert!(of_position < 1e-30, "degree {degree}: {of_position:e}");
        }
        if degree < 15 {
            assert!(of_velocity < 1e-30, "degree {degree}: {of_velocity:e}");
        } else {
            assert!(1e-10 < of_velocity, "the order is no higher: {of_velocity:e}");
        }
        if degree < 14 {
            let rounded = one_step(vec![0.0; 2], |t: f64, _q, _v, a| a[0] = t.powi(degree));
            let tol = Tol::stated(1e-13, "coefficients up to thousands, of alternating sign");
            assert_close("powers", &rounded, &[position.primal(0), velocity.primal(0)], tol);
        }
    }
}

/// The Padé approximant of degrees eight and seven of eˣ.
fn pade(x: DoubleDouble) -> DoubleDouble {
    let (mut up, mut down) = (wide(0.0), wide(0.0));
    let (mut above, mut below) = (wide(1.0), wide(1.0));
    for k in 0..=8 {
        up += above;
        down += below;
        let k = f64::from(k);
        above = above * x * wide(8.0 - k) / wide((15.0 - k) * (k + 1.0));
        below = -below * x * wide(7.0 - k) / wide((15.0 - k) * (k + 1.0));
    }
    up / down
}

#[test]
fn one_step_of_damping_equals_the_pade_approximant() {
    // Every coefficient takes part, and this approximant belongs to these nodes alone.
    for beta in [0.0625, 0.125, 0.25] {
        let exact = pade(wide(-2.0 * beta));
        let values = one_step(vec![wide(0.0), wide(1.0)], |_t, _q, v, a| a[0] = wide(-2.0 * beta) * v[0]);
        assert!((values[1] - exact).primal(0).abs() < 1e-29, "{:e}", (values[1] - exact).primal(0));
        let position = (wide(1.0) - exact) / wide(2.0 * beta);
        assert!((values[0] - position).primal(0).abs() < 1e-29, "{:e}", (values[0] - position).primal(0));
        let rounded = one_step(vec![0.0, 1.0], |_t, _q, v: &[f64], a| a[0] = -2.0 * beta * v[0]);
        assert_close("damping", &rounded, &[position.primal(0), exact.primal(0)], Tol::ulps(4.0));
    }
}

/// The largest error, over position and velocity, of a circular motion of radius and rate one after 16 units of time.
fn circle_error<F: SecondOrder<DoubleDouble, Error = Infallible>>(field: &mut F, h: f64) -> f64 {
    let start = [1.0, 0.0, 0.0, 1.0].map(wide).to_vec();
    let mut state = State::new(0.0, start).unwrap();
    GaussRadau15::with_step(h).unwrap().integrate_to(field, &mut state, 16.0).unwrap();
    let (sine, cosine) = wide(16.0).sin_cos();
    let exact = [cosine, sine, -sine, cosine];
    state.values.iter().zip(exact).map(|(&x, exact)| (x - exact).primal(0).abs()).fold(0.0, f64::max)
}

#[test]
fn error_falls_with_order_fifteen() {
    // Nearly two decades of steps.
    let steps = [2.0, 1.0, 0.5, 0.25, 0.125];
    let errors = steps.map(|h| circle_error(&mut kepler(), h));
    assert!(1e17 < errors[0] / errors[4], "{errors:?}");
    assert_order("attraction", &steps, &errors, 15.0, 0.3);
    // Charged in a magnetic field: the velocity alone turns it, about the same circle.
    let mut charged = by(2, |_t, _q: &[DoubleDouble], v: &[DoubleDouble], a: &mut [DoubleDouble]| {
        (a[0], a[1]) = (-v[1], v[0]);
    });
    let steps = [1.0, 0.5, 0.25, 0.125];
    let errors = steps.map(|h| circle_error(&mut charged, h));
    assert!(1e13 < errors[0] / errors[3], "{errors:?}");
    assert_order("charge", &steps, &errors, 15.0, 0.3);
}
