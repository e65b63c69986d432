//! Intervals by fitting anew: profile likelihood, and the bootstrap of residuals.
//!
//! ```text
//! profile      θₖ is held at v, all others are fitted: the interval ends where S(v) = S + (t w)² s²
//! bootstrap    r*(θ) = r(θ) − r(θ̂) + e*     e* drawn from (r(θ̂) − mean) √(m/(m − k)), within each test
//! ```
//! r*(θ) are the residuals of data that the fitted law would have made with the errors e*. Where neighbouring residuals are correlated, e* are
//! drawn in blocks of as many neighbours as count for one. The interval is between quantiles of the θ* so far out as Student's t of m − k
//! degrees is on a normal law, because the errors' size is an estimate too.
//!
//! B. Efron, *Ann. Statist.* 7 (1979) 1; H. R. Künsch, *Ann. Statist.* 17 (1989) 1217; T. C. Hesterberg, *Am. Stat.* 69 (2015) 371.

use core::str::FromStr;

use statrs::distribution::{ContinuousCDF, Normal};

use crate::statistics::{profile, student};
use crate::{FitError, Intervals};

/// A change of a fit that is made anew.
#[derive(Clone, Copy, Debug)]
pub enum Change<'c> {
    /// These numbers are added to the residuals.
    Shifted(&'c [f64]),
    /// This parameter is held at a value.
    Held(usize, f64),
}

/// Makes a changed fit anew: its parameters and S.
pub type Again<'a> = dyn FnMut(Change<'_>) -> Option<(Vec<f64>, f64)> + 'a;

/// What intervals follow from, besides fits made anew.
#[derive(Clone, Copy, Debug)]
pub struct Anew<'f> {
    /// The fitted parameters.
    pub values: &'f [f64],
    /// Their bounds.
    pub bounds: &'f [[f64; 2]],
    /// Their standard errors, of those that are determined.
    pub errors: &'f [Option<f64>],
    /// Weighted residuals, a series for each test.
    pub series: &'f [&'f [f64]],
    /// m − k.
    pub degrees_of_freedom: usize,
    /// What linear intervals are multiplied by for correlated residuals.
    pub widening: f64,
    /// The probability of the intervals.
    pub confidence: f64,
}

/// The share of fits made anew that must succeed.
const MOST_FAIL: f64 = 0.9;

impl Anew<'_> {
    /// The intervals of all parameters that are determined; none where intervals are linear. `fit` returns parameters and S of a
    /// changed fit.
    pub fn intervals(&self, how: Intervals, fit: &mut Again<'_>) -> Option<Vec<Option<[f64; 2]>>> {
        match how {
            Intervals::Linear => None,
            Intervals::Profile => Some((0..self.values.len()).map(|k| self.profiled(k, fit)).collect()),
            Intervals::Bootstrap { samples, seed } => Some(self.resampled(samples, seed, fit)),
        }
    }

    fn profiled(&self, k: usize, fit: &mut Again<'_>) -> Option<[f64; 2]> {
        let error = self.errors[k]?;
        let quantile = self.widening * student(self.confidence, self.degrees_of_freedom)?;
        let least: f64 = self.series.iter().flat_map(|residuals| residuals.iter()).map(|r| r * r).sum();
        let limit = least * (1.0 + quantile * quantile / self.degrees_of_freedom as f64);
        let mut squares = |value: f64| fit(Change::Held(k, value)).map(|(_, squares)| squares);
        Some(profile(self.values[k], self.bounds[k], error, (least, limit), &mut squares))
    }

    /// By the bootstrap of residuals.
    fn resampled(&self, samples: usize, seed: u64, fit: &mut Again<'_>) -> Vec<Option<[f64; 2]>> {
        let none = || vec![None; self.values.len()];
        let Some(t) = student(self.confidence, self.degrees_of_freedom) else { return none() };
        let all: Vec<f64> = self.series.concat();
        let count = all.len() as f64;
        let mean = all.iter().sum::<f64>() / count;
        let scale = (count / self.degrees_of_freedom as f64).sqrt();
        let mut random = SplitMix(seed);
        let mut found: Vec<Vec<f64>> = vec![Vec::with_capacity(samples); self.values.len()];
        let mut shift = Vec::with_capacity(all.len());
        for _ in 0..samples {
            shift.clear();
            for residuals in self.series {
                let block = block(self.widening, residuals.len());
                let mut from = 0;
                for (place, residual) in residuals.iter().enumerate() {
                    from =
                        if place % block == 0 { random.below(residuals.len()) } else { (from + 1) % residuals.len() };
                    shift.push(scale * (residuals[from] - mean) - residual);
                }
            }
            if let Some((values, _)) = fit(Change::Shifted(&shift)) {
                found.iter_mut().zip(values).for_each(|(found, value)| found.push(value));
            }
        }
        if found.iter().any(|values| (values.len() as f64) < MOST_FAIL * samples as f64) {
            return none();
        }
        let tail = Normal::standard().cdf(-t);
        let ends = |(values, error): (Vec<f64>, &Option<f64>)| {
            error.as_ref()?;
            let mut values = values;
            values.sort_by(f64::total_cmp);
            Some([quantile(&values, tail), quantile(&values, 1.0 - tail)])
        };
        found.into_iter().zip(self.errors).map(ends).collect()
    }
}

/// Neighbours that are drawn together: as many as count for one.
fn block(widening: f64, rows: usize) -> usize {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "between 1 and 99, as the widening is below 10"
    )]
    let block = (widening * widening).ceil().clamp(1.0, 99.0) as usize;
    block.min((rows / 2).max(1))
}

/// The value below which a share of sorted numbers lies, between the two next to it.
fn quantile(sorted: &[f64], share: f64) -> f64 {
    let place = (share * (sorted.len() as f64 + 1.0) - 1.0).clamp(0.0, sorted.len() as f64 - 1.0);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a place in a list")]
    let below = place.floor() as usize;
    let above = (below + 1).min(sorted.len() - 1);
    sorted[below] + (place - place.floor()) * (sorted[above] - sorted[below])
}

/// Random numbers of G. L. Steele, D. Lea, C. H. Flood, OOPSLA 2014.
struct SplitMix(u64);

impl SplitMix {
    /// A whole number below `bound`.
    fn below(&mut self, bound: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        #[expect(clippy::cast_possible_truncation, reason = "below `bound`")]
        let below = ((u128::from(z) * bound as u128) >> 64) as usize;
        below
    }
}

/// Samples of a bootstrap, unless their number is given; and the fewest and the most.
const SAMPLES: usize = 1000;
const FEWEST: usize = 200;
const MOST: usize = 100_000;

impl FromStr for Intervals {
    type Err = FitError;

    /// `linear`, `profile`, `bootstrap` or `bootstrap:N` with 200 to 100,000 samples.
    fn from_str(text: &str) -> Result<Self, FitError> {
        let unknown = || FitError::UnknownIntervals { name: text.to_owned() };
        match text.split_once(':').map_or((text, None), |(name, count)| (name, Some(count))) {
            ("linear", None) => Ok(Self::Linear),
            ("profile", None) => Ok(Self::Profile),
            ("bootstrap", count) => {
                let samples = count.map_or(Ok(SAMPLES), |count| count.parse().map_err(|_| unknown()))?;
                if !(FEWEST..=MOST).contains(&samples) {
                    return Err(unknown());
                }
                Ok(Self::Bootstrap { samples, seed: 0 })
            }
            _ => Err(unknown()),
        }
    }
}
