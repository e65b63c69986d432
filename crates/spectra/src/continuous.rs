//! Continuous spectra from measured responses, with a regularisation chosen from the data.
//!
//! ```text
//! G(t) = Gₑ + ∫ H(τ) e^(−t/τ) d ln τ                       minimised: S + λ Σ (ln Hⱼ₋₁ − 2 ln Hⱼ + ln Hⱼ₊₁)²
//! J(t) = J_g + t/η₀ + ∫ L(τ) (1 − e^(−t/τ)) d ln τ         the same over ln L
//! λ: least (m − p) ln(S + λ R) + ln det(JᵀJ + λ DᵀD) − (n − 2) ln λ     R = Σ (…)², n nodes, p = 2 + number of terms outside the integral
//! ```

use core::cell::{Cell, RefCell};
use core::ops::ControlFlow;

use nalgebra::{Cholesky, DMatrix, Dyn};
use piola_fit::internal::{End, Misfit, minimise};
use piola_fit::{Outcome, student};

use crate::data::Term;
use crate::error::check;
use crate::{SpectraError, SpectrumData};

/// Nodes for each decade.
const DENSITY: f64 = 6.0;
/// Decades of nodes beyond what the data reach.
const BEYOND: f64 = 1.0;

/// A continuous spectrum at nodes that are even in ln τ: of relaxation H(τ), of creep L(τ).
#[derive(Clone, Debug, PartialEq)]
pub struct ContinuousSpectrum {
    /// τ, s, rising: relaxation times, of creep retardation times.
    pub times: Vec<f64>,
    /// H, Pa, at each τ; of creep L, 1/Pa.
    pub spectrum: Vec<f64>,
    /// Pointwise 95 % band of H or L. Its lower end is zero at the ends of the spectrum that the data would not miss.
    pub band: Vec<[f64; 2]>,
    /// Gₑ, Pa; `None` of liquids and of creep.
    pub equilibrium_modulus: Option<f64>,
    /// `J_g`, 1/Pa, of creep.
    pub glassy_compliance: Option<f64>,
    /// 1/η₀, 1/(Pa s), of a liquid that creeps.
    pub fluidity: Option<f64>,
    /// λ: the weight of smoothness of the greatest likelihood.
    pub regularisation: f64,
    /// `tr J (JᵀJ + λ DᵀD)⁻¹ Jᵀ`: the number of parameters that the data determine.
    pub effective_parameters: f64,
    /// √(S/m): the relative error, root mean square.
    pub relative_error: f64,
    /// How the search ended.
    pub outcome: Outcome,
}

/// Relative errors and second differences over the coordinates ln Hⱼ, and the logarithms of the terms beside the integral.
struct Smoothed<'d> {
    data: SpectrumData<'d>,
    ln_times: &'d [f64],
    terms: &'static [Term],
    /// ln of the step of ln τ.
    ln_step: f64,
    /// √λ.
    weight: f64,
}

impl Smoothed<'_> {
    /// Measured numbers less what no smoothness holds: the level and the slope of ln H, and the terms beside the integral.
    fn degrees(&self) -> f64 {
        (self.data.count() as f64 - 2.0 - self.terms.len() as f64).max(1.0)
    }
}

impl Misfit for Smoothed<'_> {
    /// Coordinates and residuals.
    type State = (Vec<f64>, Vec<f64>);

    fn rows(&self) -> usize {
        self.data.count() + self.ln_times.len() - 2
    }

    fn visit(&mut self, x: &[f64]) -> Option<Self::State> {
        let mut residuals = vec![-1.0; self.data.count()];
        let (heights, terms) = x.split_at(self.ln_times.len());
        for (&height, &time) in heights.iter().zip(self.ln_times) {
            self.data.mode(height + self.ln_step, time, |row, share| residuals[row] += share);
        }
        for (&term, size) in self.terms.iter().zip(terms) {
            let size = size.exp();
            self.data.term(term, |row, share| residuals[row] += size * share);
        }
        residuals.extend(heights.windows(3).map(|h| self.weight * (h[0] - 2.0 * h[1] + h[2])));
        residuals.iter().all(|r| r.is_finite()).then(|| (x.to_vec(), residuals))
    }

    fn residuals<'s>(&self, state: &'s Self::State) -> &'s [f64] {
        &state.1
    }

    fn jacobian(&self, _: &Self::State, x: &[f64]) -> DMatrix<f64> {
        let mut slopes = DMatrix::zeros(self.rows(), x.len());
        let (heights, terms) = x.split_at(self.ln_times.len());
        for (k, (&height, &time)) in heights.iter().zip(self.ln_times).enumerate() {
            self.data.mode(height + self.ln_step, time, |row, share| slopes[(row, k)] = share);
        }
        for (k, (&term, size)) in self.terms.iter().zip(terms).enumerate() {
            let size = size.exp();
            self.data.term(term, |row, share| slopes[(row, heights.len() + k)] = size * share);
        }
        for k in 0..heights.len() - 2 {
            let row = self.data.count() + k;
            slopes[(row, k)] = self.weight;
            slopes[(row, k + 1)] = -2.0 * self.weight;
            slopes[(row, k + 2)] = self.weight;
        }
        slopes
    }
}

/// A spectrum of one λ.
struct Candidate<'d> {
    end: End<Smoothed<'d>>,
    /// The mean of `(JᵀJ + λ DᵀD)⁻¹` and of its share from errors of the data.
    covariance: DMatrix<f64>,
    squares: f64,
    /// S + λ Σ (…)².
    penalised: f64,
    effective: f64,
    /// −2 ln of the likelihood of λ.
    criterion: f64,
}

fn candidate<'d>(misfit: Smoothed<'d>, start: Vec<f64>, stop: &dyn Fn() -> bool) -> Option<Candidate<'d>> {
    let (rows, nodes) = (misfit.data.count(), misfit.ln_times.len());
    let degrees = misfit.degrees();
    let end = minimise(misfit, start, 40, stop)?;
    let sum = |residuals: &[f64]| residuals.iter().map(|r| r * r).sum::<f64>();
    let (squares, penalised) = (sum(&end.state.1[..rows]), sum(&end.state.1));
    let jacobian = end.misfit.jacobian(&end.state, &end.state.0);
    let mut normal = jacobian.tr_mul(&jacobian);
    // No smoothness holds the terms beside the integral: where one vanishes, its column does.
    let largest = normal.diagonal().max();
    (nodes..normal.nrows()).for_each(|k| normal[(k, k)] += f64::EPSILON * largest);
    let factor = Cholesky::<f64, Dyn>::new(normal)?;
    let determinant: f64 = factor.l_dirty().diagonal().iter().map(|x| 2.0 * x.ln()).sum();
    let inverse = factor.inverse();
    let measured = jacobian.rows(0, rows);
    let resolution = measured.tr_mul(&measured) * &inverse;
    let effective = resolution.trace();
    let covariance = 0.5 * (&inverse + &inverse * resolution);
    let ln_weight = 2.0 * end.misfit.weight.ln();
    let criterion = degrees * penalised.ln() + determinant - (nodes as f64 - 2.0) * ln_weight;
    Some(Candidate { end, covariance, squares, penalised, effective, criterion })
}

/// The continuous spectrum: smooth ln H, of creep smooth ln L, with the smoothness chosen by its likelihood.
///
/// | argument | meaning |
/// |---|---|
/// | `data` | G′ and G″, G(t), or J(t) |
/// | `equilibrium` | whether there is an equilibrium modulus, as of a solid |
///
/// The spectrum has six nodes for each decade, from a decade below the shortest time that the data reach (1/ω or t) to a decade beyond the
/// longest. λ is the likeliest of 10⁻⁵, 10⁻⁴·⁵, …, 10², where second differences of ln H are normal numbers (generalised maximum
/// likelihood). Cross-validation would choose far too rough a spectrum of one table in ten.
///
/// The variance of the band is s² times the mean of `(JᵀJ + λ DᵀD)⁻¹` and of its share from errors of the data; the λ tried are weighted by
/// their likelihood. Ends of the spectrum that could be left out without the data's missing them have the lower end 0.
///
/// # Errors
/// [`SpectraError::NotFinite`], [`SpectraError::WrongLength`], [`SpectraError::OutOfBounds`] of the data, or for
/// fewer than ten numbers; [`SpectraError::NoFit`] where no search ended.
///
/// # Accuracy
/// The responses of the spectrum have the relative error that is returned. In tables of known smooth spectra with 1 and 3 % noise the 95 %
/// band holds 93 to 100 % of all nodes within the data (example `coverage`), but fewer where ln H bends more sharply than elsewhere: in a
/// valley between peaks, and where the spectrum ends. Peaks are broader than those of a few separate modes, which no band shows.
///
/// # Example
/// ```
/// use piola_spectra::{SpectrumData, fit_continuous};
/// // G(t) = 1/(1 + t) has H(τ) = e^(−1/τ)/τ, which is 1/e at τ = 1.
/// let times: Vec<f64> = (0..41).map(|k| 10.0_f64.powf(0.1 * f64::from(k) - 2.0)).collect();
/// let moduli: Vec<f64> = times.iter().map(|t| 1.0 / (1.0 + t)).collect();
/// let found = fit_continuous(SpectrumData::Relaxation { times: &times, moduli: &moduli }, false)?;
/// let near = found.times.iter().position(|&t| 0.99 < t).expect("a node");
/// let t = found.times[near];
/// assert!((found.spectrum[near] / ((-1.0 / t).exp() / t) - 1.0).abs() < 0.05);
/// # Ok::<(), piola_spectra::SpectraError>(())
/// ```
///
/// # Source
/// J. Honerkamp, J. Weese, Rheol. Acta 32 (1993) 65: regularisation of ln H. G. Wahba, Ann. Statist. 13 (1985) 1378: the likelihood of λ;
/// J. R. Statist. Soc. B 45 (1983) 133: the band.
pub fn fit_continuous(data: SpectrumData<'_>, equilibrium: bool) -> Result<ContinuousSpectrum, SpectraError> {
    fit_continuous_until(data, equilibrium, &mut |_| ControlFlow::Continue(()))
}

/// The same until `watch`, which is told the finished part of the work, breaks: the best spectrum until then is returned, with
/// [`Outcome::Interrupted`].
///
/// # Errors
/// As [`fit_continuous`].
pub fn fit_continuous_until(
    data: SpectrumData<'_>,
    equilibrium: bool,
    watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<ContinuousSpectrum, SpectraError> {
    /// Values of λ.
    const TRIED: u8 = 15;
    data.check()?;
    let rows = data.count();
    check("number of measured numbers", 0, rows as f64, "10 ≤ number of measured numbers", 10 <= rows)?;
    let [low, high] = data.reach().map(f64::ln);
    let (low, high) = (low - BEYOND * core::f64::consts::LN_10, high + BEYOND * core::f64::consts::LN_10);
    let intervals = ((high - low) / core::f64::consts::LN_10 * DENSITY).ceil().max(4.0);
    let step = (high - low) / intervals;
    let ln_times: Vec<f64> =
        (0..=u16::MAX).map(|k| low + step * f64::from(k)).take_while(|&x| x < high + 0.5 * step).collect();
    let terms = data.terms(equilibrium);
    let (watch, done, broken) = (RefCell::new(watch), Cell::new(0.0), Cell::new(false));
    let stop = || {
        if !broken.get() {
            broken.set((*watch.borrow_mut())(done.get()).is_break());
        }
        broken.get()
    };
    let mut start = beginning(&data, &ln_times, terms);
    let mut found: Vec<Candidate<'_>> = Vec::new();
    // From the smoothest: each search starts at the end of the one before.
    for k in 0..TRIED {
        done.set(f64::from(k) / f64::from(TRIED));
        let weight = 10.0_f64.powf(1.0 - 0.25 * f64::from(k));
        let misfit = Smoothed { data, ln_times: &ln_times, terms, ln_step: step.ln(), weight };
        let Some(next) = candidate(misfit, start.clone(), &stop) else { continue };
        start.clone_from(&next.end.state.0);
        found.push(next);
        if broken.get() {
            break;
        }
    }
    let place = |a: &usize, b: &usize| found[*a].criterion.total_cmp(&found[*b].criterion);
    let best = (0..found.len()).min_by(place).ok_or(SpectraError::NoFit { modes: ln_times.len() })?;
    let variances = variances(&found, best);
    let Candidate { end, squares, effective, .. } = found.swap_remove(best);
    let degrees = (1..rows).take_while(|&n| n as f64 <= end.misfit.degrees()).last().unwrap_or(1);
    let factor = student(0.95, degrees).unwrap_or(f64::INFINITY);
    let [lower, upper] = unnoticed(&end, factor * factor * squares / end.misfit.degrees());
    let band = |(k, height): (usize, &f64)| {
        let half = factor * variances[k].sqrt();
        [if k < lower || upper <= k { 0.0 } else { (height - half).exp() }, (height + half).exp()]
    };
    let (heights, sizes) = end.state.0.split_at(ln_times.len());
    let size = |term: Term| terms.iter().zip(sizes).find(|(other, _)| **other == term).map(|(_, size)| size.exp());
    Ok(ContinuousSpectrum {
        times: ln_times.iter().map(|x| x.exp()).collect(),
        spectrum: heights.iter().map(|h| h.exp()).collect(),
        band: heights.iter().enumerate().map(band).collect(),
        equilibrium_modulus: size(Term::Equilibrium),
        glassy_compliance: size(Term::Glassy),
        fluidity: size(Term::Flow),
        regularisation: end.misfit.weight * end.misfit.weight,
        effective_parameters: effective,
        relative_error: (squares / rows as f64).sqrt(),
        outcome: if broken.get() { Outcome::Interrupted } else { end.outcome },
    })
}

/// The variance of each ln H: of errors of the data, and of the other λ, each with its likelihood.
fn variances(found: &[Candidate<'_>], best: usize) -> Vec<f64> {
    let least = found[best].criterion;
    let weights: Vec<f64> = found.iter().map(|other| (-0.5 * (other.criterion - least)).exp()).collect();
    let sum: f64 = weights.iter().sum();
    let heights = &found[best].end.state.0;
    let of = |k: usize| {
        let each = found.iter().zip(&weights).map(|(other, weight)| {
            let scale = other.penalised / other.end.misfit.degrees();
            let apart = other.end.state.0[k] - heights[k];
            weight * (scale * other.covariance[(k, k)] + apart * apart)
        });
        each.sum::<f64>() / sum
    };
    (0..found[best].end.misfit.ln_times.len()).map(of).collect()
}

/// The nodes below the first number, and from the second on, whose share could be left out without adding more than `limit` to S.
fn unnoticed(end: &End<Smoothed<'_>>, limit: f64) -> [usize; 2] {
    let (misfit, x) = (&end.misfit, &end.state.0);
    let tail = |order: &mut dyn Iterator<Item = usize>| {
        let mut left_out = vec![0.0; misfit.data.count()];
        let mut count = 0;
        for k in order {
            misfit.data.mode(x[k] + misfit.ln_step, misfit.ln_times[k], |row, share| left_out[row] += share);
            if limit < left_out.iter().map(|r| r * r).sum() {
                break;
            }
            count += 1;
        }
        count
    };
    let nodes = misfit.ln_times.len();
    [tail(&mut (0..nodes)), nodes - tail(&mut (0..nodes).rev())]
}

/// Where the first search starts.
fn beginning(data: &SpectrumData<'_>, ln_times: &[f64], terms: &[Term]) -> Vec<f64> {
    let [least, largest] = data.range().map(f64::ln);
    let (low, high) = (ln_times[0], ln_times[ln_times.len() - 1]);
    let slope = if data.is_creep() { (largest - least) / (high - low) } else { -0.5 };
    let first = if data.is_creep() { least - core::f64::consts::LN_10 } else { largest };
    let heights = ln_times.iter().map(|x| first + slope * (x - low));
    let sizes = terms.iter().map(|term| match term {
        Term::Equilibrium | Term::Glassy => least - core::f64::consts::LN_2,
        Term::Flow => largest - core::f64::consts::LN_2 - high,
    });
    heights.chain(sizes).collect()
}
