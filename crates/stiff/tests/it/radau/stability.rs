//! The stability function, by steps of the method itself.

use piola_integrators::State;
use piola_stiff::{RadauIia, RadauOrder};
use piola_testkit::{Tol, assert_close_at_scale};

use super::oscillation;

/// R(z) by one step of length one.
fn stability_function(order: RadauOrder, re: f64, im: f64) -> [f64; 2] {
    let mut state = State::new(0.0, vec![1.0, 0.0]).unwrap();
    RadauIia::with_step(order, 1.0).unwrap().integrate_to(&mut oscillation(re, im), &mut state, 1.0).unwrap();
    [state.values[0], state.values[1]]
}

/// The Padé approximation (s − 1, s) of the exponential.
fn pade(s: u32, re: f64, im: f64) -> [f64; 2] {
    let evaluate = |degree: u32, sign: f64| {
        let (mut term, mut sum, mut coefficient) = ([1.0, 0.0], [1.0, 0.0], 1.0);
        for k in 1..=degree {
            coefficient *= sign * f64::from(degree - k + 1) / (f64::from(2 * s - k) * f64::from(k));
            term = [term[0] * re - term[1] * im, term[0] * im + term[1] * re];
            sum = [sum[0] + coefficient * term[0], sum[1] + coefficient * term[1]];
        }
        sum
    };
    let ([a, b], [c, d]) = (evaluate(s - 1, 1.0), evaluate(s, -1.0));
    let square = c * c + d * d;
    [(a * c + b * d) / square, (b * c - a * d) / square]
}

#[test]
fn one_step_equals_the_pade_approximation() {
    for order in RadauOrder::ALL {
        let s = order.value().div_ceil(2);
        for (re, im) in [(-0.1, 0.0), (-1.0, 0.0), (-1.0, 2.0), (-10.0, 3.0), (0.0, 1.0), (1.0, 0.5), (-50.0, 0.0)] {
            let found = stability_function(order, re, im);
            let tol = Tol::ulps_because(200.0, "terms of the Padé approximation cancel");
            assert_close_at_scale(&format!("{order:?} at {re} + {im}i"), &found, &pade(s, re, im), 1.0, tol);
        }
    }
}

#[test]
fn oscillations_never_grow() {
    let mut compared = 0;
    for order in RadauOrder::ALL {
        let mut least = 1.0_f64;
        for place in -30..=60 {
            let omega = 10f64.powf(f64::from(place) / 10.0);
            let [a, b] = stability_function(order, 0.0, omega);
            assert!(a.hypot(b) <= 1.0 + 8.0 * f64::EPSILON, "{order:?} at {omega}i: {}", a.hypot(b));
            least = least.min(a.hypot(b));
            compared += 1;
        }
        assert!(least < 1e-4, "{order:?}: {least}");
    }
    assert_eq!(compared, 3 * 91);
}

#[test]
fn infinitely_stiff_components_vanish_in_one_step() {
    for order in RadauOrder::ALL {
        // |R(z)| → s (or its reciprocal)/|z|: ten times stiffer, ten times less.
        let values =
            [1e4, 1e5, 1e6, 1e7].map(|stiffness| stability_function(order, -stiffness, 0.0)[0].abs() * stiffness);
        for pair in values.windows(2) {
            assert!((pair[0] / pair[1] - 1.0).abs() < 0.02, "{order:?}: {values:?}");
        }
    }
}
