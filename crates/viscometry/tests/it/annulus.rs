//! The annulus beside closed forms over twice the digits: answers are within the bounds that they state.

use std::f64::consts::PI;

use piola_fluids::{Newtonian, PowerLaw};
use piola_numerics::Real;
use piola_testkit::strategies::random_cases;
use piola_testkit::{DoubleDouble, Tol};
use piola_viscometry::{Annulus, Estimate};
use proptest::prelude::*;

fn number(value: f64) -> DoubleDouble {
    DoubleDouble::lit(value)
}

fn pi() -> DoubleDouble {
    DoubleDouble::of_sum(PI, 1.224_646_799_147_353_2e-16)
}

/// What quadratures are asked for, of the size.
const ASKED: Tol = Tol::stated(1e-11, "the tolerance of a quadrature");

/// Within the bound, and the bound within what was asked.
fn within(what: &str, answer: Estimate, truth: DoubleDouble, size: f64) {
    let off = truth.rounding_of(answer.value).abs();
    assert!(off <= answer.error, "{what}: {answer:?} is off by {off:e}");
    assert!(answer.error <= ASKED.value() * size, "{what}: {answer:?}, {ASKED}");
}

/// v and Q with μ = ½, so that c/(4 μ) = c/2.
fn newtonian(inner: f64, gradient: f64, places: [f64; 2]) -> Result<(), Box<dyn std::error::Error>> {
    let fluid = Newtonian::new(0.5)?;
    let annulus = Annulus::new(inner, 1.0, gradient)?;
    let (one, k) = (number(1.0), number(inner));
    let area = one - k * k;
    let log = k.ln();
    let half = number(0.5) * number(gradient);
    let discharge = annulus.discharge(&fluid)?;
    let truth = number(0.5) * pi() * half * (area * (one + k * k) + area * area / log);
    within("discharge", discharge, truth, discharge.value.abs());
    let fastest = annulus.velocity(&fluid, annulus.rest_radius(&fluid)?)?.value;
    for place in places {
        let r = inner + (1.0 - inner) * place;
        let truth = half * (one - number(r).powi(2) - area * number(r).ln() / log);
        within("velocity", annulus.velocity(&fluid, r)?, truth, fastest.abs());
    }
    Ok(())
}

/// ζ = s² where λ is sought by Newton's method over twice the digits.
fn quadratic(inner: f64, gradient: f64, places: [f64; 2]) -> Result<(), Box<dyn std::error::Error>> {
    let fluid = PowerLaw::new(1.0, 0.5)?;
    let annulus = Annulus::new(inner, 1.0, gradient)?;
    let (one, k) = (number(1.0), number(inner));
    let mut lambda = number(annulus.rest_radius(&fluid)?);
    // ∫ (r − λ²/r)² dr, and ∫ (r² − λ²) (r − λ²/r)² dr.
    let speed = |lambda: DoubleDouble, r: DoubleDouble| {
        r.powi(3) / number(3.0) - number(2.0) * lambda.powi(2) * r - lambda.powi(4) / r
    };
    let flux = |lambda: DoubleDouble, r: DoubleDouble| {
        let square = lambda.powi(2);
        r.powi(5) / number(5.0) - square * r.powi(3) + number(3.0) * square.powi(2) * r + square.powi(3) / r
    };
    for _ in 0..3 {
        let sides = number(2.0) * speed(lambda, lambda) - speed(lambda, k) - speed(lambda, one);
        // The derivative by λ of the square's own place vanishes.
        let by_lambda = |r: DoubleDouble| -number(4.0) * lambda * r - number(4.0) * lambda.powi(3) / r;
        let slope = number(2.0) * by_lambda(lambda) - by_lambda(k) - by_lambda(one);
        lambda -= sides / slope;
    }
    let scale = (number(0.5) * number(gradient)).powi(2);
    let discharge = annulus.discharge(&fluid)?;
    let truth = pi() * scale * (flux(lambda, one) - number(2.0) * flux(lambda, lambda) + flux(lambda, k));
    within("discharge", discharge, truth, discharge.value);
    let fastest = annulus.velocity(&fluid, annulus.rest_radius(&fluid)?)?.value;
    for place in places {
        let r = inner + (1.0 - inner) * place;
        let [to, wall] = if r < lambda.primal(0) { [number(r), k] } else { [one, number(r)] };
        let truth = scale * (speed(lambda, to) - speed(lambda, wall));
        within("velocity", annulus.velocity(&fluid, r)?, truth, fastest);
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(2_000)))]

    #[test]
    fn answers_of_an_annulus_equal_closed_forms_within_their_bounds(
        inner in 0.05..0.95_f64, gradient in 0.1..10.0_f64, places in [0.0..1.0_f64, 0.0..1.0_f64],
    ) {
        newtonian(inner, -gradient, places).expect("a flow");
        quadratic(inner, gradient, places).expect("a flow");
    }
}
