//! Adaptive integration of several functions of one variable at once.
//!
//! ```text
//! ∫ f dt ≈ K₁₅ f,    error ≈ |K₁₅ f − G₇ f|
//! ```
//!
//! The rule of Gauss and Kronrod with 7 and 15 nodes, exact for polynomials of degree 13 and 22; the interval with
//! the largest error is halved until the sum of the errors is small enough. The error stated is that of the Gaussian
//! rule, many times that of the value returned.
//!
//! Nodes and weights: A. S. Kronrod, *Nodes and Weights of Quadrature Formulas* (1965).

use crate::DynamicsError;

/// Positive nodes from the outside inwards; odd indices belong to both rules.
const NODES: [f64; 7] = [
    0.991_455_371_120_812_6,
    0.949_107_912_342_758_5,
    0.864_864_423_359_769_1,
    0.741_531_185_599_394_4,
    0.586_087_235_467_691_1,
    0.405_845_151_377_397_2,
    0.207_784_955_007_898_47,
];
/// Weights of the fifteen-point rule, the centre last.
const KRONROD: [f64; 8] = [
    0.022_935_322_010_529_224,
    0.063_092_092_629_978_56,
    0.104_790_010_322_250_18,
    0.140_653_259_715_525_92,
    0.169_004_726_639_267_9,
    0.190_350_578_064_785_4,
    0.204_432_940_075_298_9,
    0.209_482_141_084_727_82,
];
/// Weights of the seven-point rule, the centre last.
const GAUSS: [f64; 4] =
    [0.129_484_966_168_869_7, 0.279_705_391_489_276_64, 0.381_830_050_505_118_9, 0.417_959_183_673_469_4];

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
pub(crate) struct Integrals<const K: usize> {
    pub(crate) values: [f64; K],
    pub(crate) errors: [f64; K],
}

/// Integrates K functions from `from` to `to`, each to `relative` times ∫|f| plus `absolute`.
pub(crate) fn integrate<const K: usize>(
    (from, to): (f64, f64),
    (relative, absolute): (f64, f64),
    mut functions: impl FnMut(f64) -> Result<[f64; K], DynamicsError>,
) -> Result<Integrals<K>, DynamicsError> {
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
            return Err(DynamicsError::QuadratureNotConverged { intervals: intervals.len(), error });
        }
        intervals[worst] = rule((from, middle), &mut functions)?;
        intervals.push(rule((middle, to), &mut functions)?);
    }
}

fn rule<const K: usize>(
    (from, to): (f64, f64),
    functions: &mut impl FnMut(f64) -> Result<[f64; K], DynamicsError>,
) -> Result<Interval<K>, DynamicsError> {
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
    for (i, node) in NODES.into_iter().enumerate() {
        let gauss_weight = if i % 2 == 1 { GAUSS[i / 2] } else { 0.0 };
        for time in [centre - half * node, centre + half * node] {
            add(functions(time)?, KRONROD[i], gauss_weight);
        }
    }
    for value in kronrod {
        if !value.is_finite() {
            return Err(DynamicsError::NonFinite { quantity: "integrand of the action", index: 0, value });
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
