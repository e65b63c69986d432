//! Adaptive integration of several functions of one variable at once.
//!
//! ```text
//! ∫ f dt ≈ K₁₅ f,    error ≈ |K₁₅ f − G₇ f|
//! ```
//!
//! The rule of Gauss and Kronrod with 7 and 15 nodes, exact for polynomials of degree 13 and 22; the interval with
//! the largest error is halved until the sum of the errors is small enough. The error stated is that of the Gaussian
//! rule, many times that of the value returned.

use piola_numerics::gauss_kronrod::{GAUSS, KRONROD, NODES};

use crate::LagrangianError;

/// After so many intervals an integral is given up.
const MOST_INTERVALS: usize = 2000;

/// A part of the range with its values and the largest of their errors.
struct Interval<const K: usize> {
    from: f64,
    to: f64,
    values: [f64; K],
    magnitudes: [f64; K],
    errors: [f64; K],
}

/// Values and errors of K integrals.
#[derive(Clone, Copy, Debug)]
pub struct Integrals<const K: usize> {
    /// The integrals.
    pub values: [f64; K],
    /// Their error bounds.
    pub errors: [f64; K],
}

/// Integrates K functions from `from` to `to`, each to `relative` times ∫|f| plus `absolute`.
///
/// # Errors
/// [`LagrangianError::QuadratureNotConverged`], [`LagrangianError::NotFinite`], and those of the functions.
pub fn integrate<E: From<LagrangianError>, const K: usize>(
    (from, to): (f64, f64),
    (relative, absolute): (f64, f64),
    mut functions: impl FnMut(f64) -> Result<[f64; K], E>,
) -> Result<Integrals<K>, E> {
    let mut intervals = vec![rule((from, to), &mut functions)?];
    loop {
        let sum = |part: fn(&Interval<K>) -> &[f64; K]| -> [f64; K] {
            core::array::from_fn(|k| intervals.iter().map(|interval| part(interval)[k]).sum())
        };
        let (values, errors) = (sum(|interval| &interval.values), sum(|interval| &interval.errors));
        let magnitudes = sum(|interval| &interval.magnitudes);
        // Below some ulp of ∫|f| errors are made of rounding.
        let allowed: [f64; K] =
            core::array::from_fn(|k| absolute + relative.max(50.0 * f64::EPSILON) * magnitudes[k].abs());
        let excess = |errors: &[f64; K]| -> f64 {
            (0..K).map(|k| if allowed[k] < errors[k] { errors[k] / allowed[k] } else { 0.0 }).fold(0.0, f64::max)
        };
        if excess(&errors) <= 0.0 {
            return Ok(Integrals { values, errors });
        }
        let ratio = |interval: &Interval<K>| -> f64 {
            let over = |k: usize| if allowed[k] < errors[k] { interval.errors[k] / errors[k] } else { 0.0 };
            (0..K).map(over).fold(0.0, f64::max)
        };
        let worst = intervals.iter().enumerate().max_by(|a, b| ratio(a.1).total_cmp(&ratio(b.1)));
        let Some(worst) = worst.map(|(index, _)| index) else { return Ok(Integrals { values, errors }) };
        let Interval { from, to, .. } = intervals[worst];
        let middle = 0.5 * (from + to);
        let error = errors.into_iter().fold(0.0, f64::max);
        if MOST_INTERVALS <= intervals.len() || middle.total_cmp(&from).is_eq() || middle.total_cmp(&to).is_eq() {
            return Err(LagrangianError::QuadratureNotConverged { intervals: intervals.len(), error }.into());
        }
        intervals[worst] = rule((from, middle), &mut functions)?;
        intervals.push(rule((middle, to), &mut functions)?);
    }
}

fn rule<E: From<LagrangianError>, const K: usize>(
    (from, to): (f64, f64),
    functions: &mut impl FnMut(f64) -> Result<[f64; K], E>,
) -> Result<Interval<K>, E> {
    let (centre, half) = (0.5 * (from + to), 0.5 * (to - from));
    let (mut kronrod, mut gauss, mut magnitudes) = ([0.0; K], [0.0; K], [0.0; K]);
    let mut add = |values: [f64; K], weight: f64, gauss_weight: f64| {
        for k in 0..K {
            kronrod[k] += weight * values[k];
            gauss[k] += gauss_weight * values[k];
            magnitudes[k] += weight * values[k].abs();
        }
    };
    add(functions(centre)?, KRONROD[7], GAUSS[3]);
    for (i, &node) in NODES[..7].iter().enumerate() {
        let gauss_weight = if i % 2 == 1 { GAUSS[i / 2] } else { 0.0 };
        for t in [centre - half * node, centre + half * node] {
            add(functions(t)?, KRONROD[i], gauss_weight);
        }
    }
    for value in kronrod {
        if !value.is_finite() {
            return Err(LagrangianError::NotFinite { quantity: "integrand of the action", index: 0, value }.into());
        }
    }
    Ok(Interval {
        from,
        to,
        values: kronrod.map(|value| half * value),
        magnitudes: magnitudes.map(|value| half.abs() * value),
        errors: core::array::from_fn(|k| (half * (kronrod[k] - gauss[k])).abs()),
    })
}
