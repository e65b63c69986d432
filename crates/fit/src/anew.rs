//! Intervals by fitting anew: profile likelihood, and the bootstrap of residuals.
//!
//! ```text
//! profile      θₖ is held at v, all others are fitted: the interval ends where S(v) = S + (t w)² s²,   s² = S/(m − k)
//! bootstrap    r*(θ) = r(θ) − r(θ̂) + e*     e* drawn from c (r(θ̂) − mean of the test)
//! ```
//! r*(θ) are the residuals of data that the fitted law would have made with the errors e*. The factor c gives e* the mean square s². A test
//! of few rows draws from the residuals of all tests; so does every test where the means of the tests hold most of S.
//!
//! Where neighbouring residuals are correlated, e* are drawn in blocks of L neighbours, as many as count for one. Correlation ρʲ at the
//! distance j multiplies the variance of a sum of residuals by w² = (1 + ρ)/(1 − ρ). Blocks keep only v² = 1 + 2 Σ (1 − j/L) ρʲ of it, j < L:
//! e* are multiplied by w/v.
//!
//! The interval is between quantiles of the θ* so far out as Student's t of m − k degrees is on a normal law, because the errors' size is an
//! estimate too. Where fewer than five samples would lie beyond, the quantiles with five samples beyond are moved away from the median in
//! proportion.
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

/// The least share of fits made anew that must succeed.
const LEAST_SUCCEED: f64 = 0.9;

/// Tests of fewer rows draw from the residuals of all tests.
const FEW_ROWS: usize = 5;

/// Samples beyond a quantile that is not extrapolated.
const BEYOND: f64 = 5.0;

impl Anew<'_> {
    /// The intervals of all parameters that are determined. Linear intervals stay where this is none: where they are asked for, where `stop`
    /// says so before the end, and where more than a tenth of the fits of a bootstrap fail. `fit` returns parameters and S of a changed fit.
    pub fn intervals(
        &self,
        how: Intervals,
        fit: &mut Again<'_>,
        stop: &dyn Fn() -> bool,
    ) -> Option<Vec<Option<[f64; 2]>>> {
        let found = match how {
            Intervals::Linear => None,
            Intervals::Profile => {
                (0..self.values.len()).map(|k| (!stop()).then(|| self.profiled(k, fit))).collect::<Option<_>>()
            }
            Intervals::Bootstrap { samples, seed } => self.resampled(samples, seed, fit, stop),
        };
        // A fit that was stopped is no fit.
        found.filter(|_| !stop())
    }

    fn profiled(&self, k: usize, fit: &mut Again<'_>) -> Option<[f64; 2]> {
        let error = self.errors[k]?;
        let quantile = self.widening * student(self.confidence, self.degrees_of_freedom)?;
        let least = squares(self.series.iter().copied().flatten());
        let limit = least * (1.0 + quantile * quantile / self.degrees_of_freedom as f64);
        let mut squares = |value: f64| fit(Change::Held(k, value)).map(|(_, squares)| squares);
        Some(profile(self.values[k], self.bounds[k], error, (least, limit), &mut squares))
    }

    /// By the bootstrap of residuals.
    fn resampled(
        &self,
        samples: usize,
        seed: u64,
        fit: &mut Again<'_>,
        stop: &dyn Fn() -> bool,
    ) -> Option<Vec<Option<[f64; 2]>>> {
        let t = student(self.confidence, self.degrees_of_freedom)?;
        let sources = Sources::new(self.series, self.degrees_of_freedom)?;
        let mut random = SplitMix(seed);
        let mut found: Vec<Vec<f64>> = vec![Vec::new(); self.values.len()];
        let mut shift = Vec::new();
        for _ in 0..samples {
            if stop() {
                return None;
            }
            shift.clear();
            for (place, residuals) in self.series.iter().enumerate() {
                let source = sources.of(place);
                let block = block(self.widening, residuals.len());
                let scale = sources.scale * left_out_by_blocks(self.widening, block);
                let mut from = 0;
                for (row, residual) in residuals.iter().enumerate() {
                    from = if row % block == 0 { random.below(source.len()) } else { (from + 1) % source.len() };
                    shift.push(scale * source[from] - residual);
                }
            }
            if let Some((values, _)) = fit(Change::Shifted(&shift)) {
                found.iter_mut().zip(values).for_each(|(found, value)| found.push(value));
            }
        }
        let succeeded = found.iter().map(Vec::len).min()? as f64;
        if succeeded < 1.0 || succeeded < LEAST_SUCCEED * samples as f64 {
            return None;
        }
        let normal = Normal::standard();
        let reach = t.min(normal.inverse_cdf(1.0 - BEYOND.min(0.25 * succeeded) / (succeeded + 1.0)));
        let tail = normal.cdf(-reach);
        let ends = |((mut values, error), [least, greatest]): ((Vec<f64>, &Option<f64>), &[f64; 2])| {
            error.as_ref()?;
            values.sort_by(f64::total_cmp);
            let median = quantile(&values, 0.5);
            let end = |share: f64| median + (quantile(&values, share) - median) * (t / reach);
            Some([end(tail).max(*least), end(1.0 - tail).min(*greatest)])
        };
        Some(found.into_iter().zip(self.errors).zip(self.bounds).map(ends).collect())
    }
}

/// The sum of squares.
fn squares<'r>(residuals: impl IntoIterator<Item = &'r f64>) -> f64 {
    residuals.into_iter().map(|r| r * r).sum()
}

/// Residuals less their mean.
fn centred(residuals: &[f64]) -> Vec<f64> {
    let mean = residuals.iter().sum::<f64>() / residuals.len() as f64;
    residuals.iter().map(|r| r - mean).collect()
}

/// What the errors of each test are drawn from.
struct Sources {
    all: Vec<f64>,
    /// Nothing for a test that draws from all.
    own: Vec<Option<Vec<f64>>>,
    /// What gives the errors the mean square S/(m − k).
    scale: f64,
}

impl Sources {
    /// None where the residuals do not differ.
    fn new(series: &[&[f64]], degrees_of_freedom: usize) -> Option<Self> {
        let all = centred(&series.concat());
        let own = series.iter().map(|residuals| (FEW_ROWS <= residuals.len()).then(|| centred(residuals))).collect();
        let mut sources = Self { all, own, scale: 1.0 };
        let total = squares(series.iter().copied().flatten());
        // The expected sum of squares of what is drawn.
        let drawn = |sources: &Self| -> f64 {
            let of = |(place, residuals): (usize, &&[f64])| {
                let source = sources.of(place);
                residuals.len() as f64 * squares(source) / source.len() as f64
            };
            series.iter().enumerate().map(of).sum()
        };
        if drawn(&sources) < 0.5 * total {
            sources.own.fill(None);
        }
        let mean_square = drawn(&sources) / sources.all.len() as f64;
        sources.scale = (total / degrees_of_freedom as f64 / mean_square).sqrt();
        (0.0 < mean_square && sources.scale.is_finite()).then_some(sources)
    }

    fn of(&self, place: usize) -> &[f64] {
        self.own[place].as_deref().unwrap_or(&self.all)
    }
}

/// The root of w² over what blocks keep of it, for residuals whose correlation ρʲ falls with the distance j: w² = (1 + ρ)/(1 − ρ).
fn left_out_by_blocks(widening: f64, block: usize) -> f64 {
    let square = widening * widening;
    let rho = (square - 1.0) / (square + 1.0);
    let (mut kept, mut power) = (1.0, 1.0);
    for j in 1..block {
        power *= rho;
        kept += 2.0 * (1.0 - j as f64 / block as f64) * power;
    }
    widening / kept.sqrt()
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

/// Refuses a bootstrap of too few or too many samples.
///
/// # Errors
/// [`FitError::UnknownIntervals`].
pub fn check_intervals(intervals: Intervals) -> Result<(), FitError> {
    match intervals {
        Intervals::Bootstrap { samples, .. } if !(FEWEST..=MOST).contains(&samples) => {
            Err(FitError::UnknownIntervals { name: format!("bootstrap:{samples}") })
        }
        _ => Ok(()),
    }
}

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
                let bootstrap = Self::Bootstrap { samples, seed: 0 };
                check_intervals(bootstrap).map_err(|_| unknown())?;
                Ok(bootstrap)
            }
            _ => Err(unknown()),
        }
    }
}
