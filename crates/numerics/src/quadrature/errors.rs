//! Rules for the error of a panel.

use super::GaussKronrod;

/// What a rule for the error of a panel sees; sums are those for a panel of length two.
#[derive(Clone, Copy, Debug)]
pub struct Samples<'a, const K: usize> {
    /// The points of the panel.
    pub points: &'a GaussKronrod,
    /// Half the length of the panel.
    pub half: f64,
    /// The functions in the middle.
    pub centre: [f64; K],
    /// The functions at the nodes, from the outside inwards: on the side of the first end, on that of the second.
    pub pairs: &'a [[[f64; K]; 2]],
    /// The functions at the two ends, where the rule [asks for them](ErrorRule::SEES_ENDS).
    pub ends: Option<[[f64; K]; 2]>,
    /// Kronrod's sums.
    pub kronrod: [f64; K],
    /// Gauss's sums.
    pub gauss: [f64; K],
    /// Kronrod's sums of |f|.
    pub size: [f64; K],
}

/// A rule for the errors of the integrals over a panel.
pub trait ErrorRule<const K: usize> {
    /// Whether the functions are evaluated at the ends of panels too.
    const SEES_ENDS: bool = false;
    /// Whether half of what halving a panel has changed is an error of each half at least. Every range is then halved once.
    const COMPARES_HALVES: bool = false;
    /// The error of each integral over the panel.
    fn errors(&self, samples: &Samples<'_, K>) -> [f64; K];
}

/// |K − G|: the error of Gauss's rule, many times that of the value for smooth functions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Difference;

impl<const K: usize> ErrorRule<K> for Difference {
    fn errors(&self, samples: &Samples<'_, K>) -> [f64; K] {
        core::array::from_fn(|k| ((samples.kronrod[k] - samples.gauss[k]) * samples.half).abs())
    }
}

/// The largest |K − G| of all functions, for each: where the functions are components of one quantity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LargestDifference;

impl<const K: usize> ErrorRule<K> for LargestDifference {
    fn errors(&self, samples: &Samples<'_, K>) -> [f64; K] {
        let errors: [f64; K] = Difference.errors(samples);
        // NaN stays, so that it is not taken for small.
        [errors.into_iter().fold(0.0, |largest, error| if error <= largest { largest } else { error }); K]
    }
}

/// QUADPACK's estimate: near the error of Kronrod's rule for smooth functions, that of Gauss's for others; with the rounding of
/// the sum, 8 ε ∫ |f| dx.
///
/// ```text
/// D min(1, (200 |K − G|/D)^1.5),   D = K |f − mean of f|
/// ```
///
/// # Source
/// R. Piessens, E. de Doncker-Kapenga, C. W. Überhuber, D. K. Kahaner, *QUADPACK*, Springer 1983.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Quadpack;

impl<const K: usize> ErrorRule<K> for Quadpack {
    fn errors(&self, samples: &Samples<'_, K>) -> [f64; K] {
        let Samples { points, half, centre, pairs, kronrod, gauss, size, .. } = samples;
        core::array::from_fn(|k| {
            // The variation about the mean is the scale of the difference of the rules.
            let mean = 0.5 * kronrod[k];
            let mut variation = points.kronrod[pairs.len()] * (centre[k] - mean).abs();
            for (pair, weight) in pairs.iter().zip(points.kronrod) {
                variation += weight * ((pair[0][k] - mean).abs() + (pair[1][k] - mean).abs());
            }
            let difference = (kronrod[k] - gauss[k]).abs();
            let scaled = if 0.0 < variation {
                variation * (200.0 * difference / variation).powf(1.5).min(1.0)
            } else {
                difference
            };
            scaled * half + 8.0 * f64::EPSILON * size[k] * half
        })
    }
}

/// |K − G| and what is unseen between the ends and the nodes next to them: for functions with kinks and jumps.
///
/// A kink between an end and the next node is seen by neither rule, but at the end itself: there the function differs from its
/// continuation by as much as it does at most in between. A kink across which the rules agree by luck is told by what halving
/// the panel changes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Kinks;

impl<const K: usize> ErrorRule<K> for Kinks {
    const SEES_ENDS: bool = true;
    const COMPARES_HALVES: bool = true;

    fn errors(&self, samples: &Samples<'_, K>) -> [f64; K] {
        let Samples { points, half, centre, pairs, kronrod, gauss, .. } = samples;
        let Some([mut first, mut second]) = samples.ends else { return Difference.errors(samples) };
        // What a polynomial through the nodes has at the ends is taken from what the functions have there.
        let last = points.extrapolation.len() - 1;
        let mut take = |place: usize, values: &[f64; K]| {
            for k in 0..K {
                first[k] -= points.extrapolation[last - place] * values[k];
                second[k] -= points.extrapolation[place] * values[k];
            }
        };
        for (i, pair) in pairs.iter().enumerate() {
            take(i, &pair[0]);
        }
        take(pairs.len(), centre);
        for (i, pair) in pairs.iter().enumerate().rev() {
            take(last - i, &pair[1]);
        }
        let strip = 1.0 - points.nodes[0];
        core::array::from_fn(|k| half * ((kronrod[k] - gauss[k]).abs() + strip * (first[k].abs() + second[k].abs())))
    }
}
