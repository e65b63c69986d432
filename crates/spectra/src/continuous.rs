//! Continuous spectra from measured responses, with a regularisation chosen from the data.
//!
//! ```text
//! G(t) = ∫ H(τ) e^(−t/τ) d ln τ      minimised: S + λ Σ (ln Hⱼ₋₁ − 2 ln Hⱼ + ln Hⱼ₊₁)²
//! V(λ) = m S/(m − tr A)²             A = J (JᵀJ + λ DᵀD)⁻¹ Jᵀ
//! ```

use nalgebra::{Cholesky, DMatrix, Dyn};
use piola_fit::internal::{End, Misfit, minimise};
use piola_fit::{Outcome, student};

use crate::error::check;
use crate::{SpectraError, SpectrumData};

/// Nodes for each decade.
const DENSITY: f64 = 6.0;

/// A continuous relaxation spectrum H(τ) of a liquid at nodes that are even in ln τ.
#[derive(Clone, Debug, PartialEq)]
pub struct ContinuousSpectrum {
    /// τ, s, rising.
    pub relaxation_times: Vec<f64>,
    /// H, Pa, at each τ.
    pub spectrum: Vec<f64>,
    /// Pointwise 95 % band of H, Pa: of errors of the data, with the chosen smoothness taken as true.
    pub band: Vec<[f64; 2]>,
    /// The weight λ of the least V.
    pub regularisation: f64,
    /// tr A: the number of parameters that the data determine.
    pub effective_parameters: f64,
    /// √(S/m): the relative error, root mean square.
    pub relative_error: f64,
    /// How the search ended.
    pub outcome: Outcome,
}

/// Relative errors and second differences over the coordinates ln Hⱼ.
struct Smoothed<'d> {
    data: SpectrumData<'d>,
    ln_times: &'d [f64],
    /// ln of the step of ln τ.
    ln_step: f64,
    /// √λ.
    weight: f64,
}

impl Misfit for Smoothed<'_> {
    /// Coordinates and residuals.
    type State = (Vec<f64>, Vec<f64>);

    fn rows(&self) -> usize {
        self.data.count() + self.ln_times.len() - 2
    }

    fn visit(&mut self, x: &[f64]) -> Option<Self::State> {
        let mut residuals = vec![-1.0; self.data.count()];
        for (&height, &time) in x.iter().zip(self.ln_times) {
            self.data.mode(height + self.ln_step, time, |row, share| residuals[row] += share);
        }
        residuals.extend(x.windows(3).map(|h| self.weight * (h[0] - 2.0 * h[1] + h[2])));
        residuals.iter().all(|r| r.is_finite()).then(|| (x.to_vec(), residuals))
    }

    fn residuals<'s>(&self, state: &'s Self::State) -> &'s [f64] {
        &state.1
    }

    fn jacobian(&self, _: &Self::State, x: &[f64]) -> DMatrix<f64> {
        let mut slopes = DMatrix::zeros(self.rows(), x.len());
        for (k, (&height, &time)) in x.iter().zip(self.ln_times).enumerate() {
            self.data.mode(height + self.ln_step, time, |row, share| slopes[(row, k)] = share);
        }
        for k in 0..x.len() - 2 {
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
    inverse: DMatrix<f64>,
    squares: f64,
    effective: f64,
    criterion: f64,
}

fn candidate(misfit: Smoothed<'_>, start: Vec<f64>) -> Option<Candidate<'_>> {
    let rows = misfit.data.count();
    let end = minimise(misfit, start, 40, &|| false)?;
    let squares: f64 = end.state.1[..rows].iter().map(|r| r * r).sum();
    let jacobian = end.misfit.jacobian(&end.state, &end.state.0);
    let inverse = Cholesky::<f64, Dyn>::new(jacobian.tr_mul(&jacobian))?.inverse();
    let measured = jacobian.rows(0, rows);
    let effective = (measured.tr_mul(&measured) * &inverse).trace();
    let left = rows as f64 - effective;
    let criterion = if 0.0 < left { rows as f64 * squares / (left * left) } else { f64::INFINITY };
    Some(Candidate { end, inverse, squares, effective, criterion })
}

/// The continuous spectrum of a liquid: smooth ln H, with the smoothness chosen by generalised cross-validation.
///
/// H has six nodes for each decade, from half a decade below the shortest time that the data reach (1/ω or t) to half a decade
/// beyond the longest. λ is the best of 10⁻⁵, 10⁻⁴·⁵, …, 10².
///
/// # Errors
/// [`SpectraError::NotFinite`], [`SpectraError::WrongLength`], [`SpectraError::OutOfBounds`] of the data, or for
/// fewer than ten numbers; [`SpectraError::NoFit`] where no search ended.
///
/// # Accuracy
/// The responses of the spectrum have the relative error that is returned. H itself is as smooth as the data allow: its peaks
/// are broader than those of a few separate modes, which no band shows.
///
/// # Example
/// ```
/// use piola_spectra::{SpectrumData, fit_continuous};
/// // G(t) = 1/(1 + t) has H(τ) = e^(−1/τ)/τ, which is 1/e at τ = 1.
/// let times: Vec<f64> = (0..41).map(|k| 10.0_f64.powf(0.1 * f64::from(k) - 2.0)).collect();
/// let moduli: Vec<f64> = times.iter().map(|t| 1.0 / (1.0 + t)).collect();
/// let found = fit_continuous(SpectrumData::Relaxation { times: &times, moduli: &moduli })?;
/// let near = found.relaxation_times.iter().position(|&t| 0.99 < t).expect("a node");
/// let t = found.relaxation_times[near];
/// assert!((found.spectrum[near] / ((-1.0 / t).exp() / t) - 1.0).abs() < 0.05);
/// # Ok::<(), piola_spectra::SpectraError>(())
/// ```
///
/// # Source
/// J. Honerkamp, J. Weese, Rheol. Acta 32 (1993) 65: regularisation of ln H. G. H. Golub, M. Heath, G. Wahba, Technometrics 21
/// (1979) 215: V(λ).
pub fn fit_continuous(data: SpectrumData<'_>) -> Result<ContinuousSpectrum, SpectraError> {
    data.check()?;
    let rows = data.count();
    check("number of measured numbers", 0, rows as f64, "10 ≤ number of measured numbers", 10 <= rows)?;
    let half_decade = 0.5 * core::f64::consts::LN_10;
    let [low, high] = data.reach().map(f64::ln);
    let (low, high) = (low - half_decade, high + half_decade);
    let intervals = ((high - low) / core::f64::consts::LN_10 * DENSITY).ceil().max(4.0);
    let step = (high - low) / intervals;
    let ln_times: Vec<f64> =
        (0..=u16::MAX).map(|k| low + step * f64::from(k)).take_while(|&x| x < high + 0.5 * step).collect();
    let mut start: Vec<f64> = ln_times.iter().map(|x| data.largest().ln() - 0.5 * (x - low)).collect();
    let mut best: Option<Candidate<'_>> = None;
    // From the smoothest: each search starts at the end of the one before.
    for k in 0..15_u8 {
        let weight = 10.0_f64.powf(1.0 - 0.25 * f64::from(k));
        let misfit = Smoothed { data, ln_times: &ln_times, ln_step: step.ln(), weight };
        let Some(found) = candidate(misfit, start.clone()) else { continue };
        start.clone_from(&found.end.state.0);
        if best.as_ref().is_none_or(|best| found.criterion < best.criterion) {
            best = Some(found);
        }
    }
    let Candidate { end, inverse, squares, effective, .. } =
        best.ok_or(SpectraError::NoFit { modes: ln_times.len() })?;
    let left = rows as f64 - effective;
    // Between whole degrees of freedom the lower one, which is the wider band.
    let degrees = (1..rows).take_while(|&n| n as f64 <= left).last().unwrap_or(1);
    let factor = student(0.95, degrees).unwrap_or(f64::INFINITY) * (squares / left).sqrt();
    let band = |(k, height): (usize, &f64)| {
        let half = factor * inverse[(k, k)].sqrt();
        [(height - half).exp(), (height + half).exp()]
    };
    Ok(ContinuousSpectrum {
        relaxation_times: ln_times.iter().map(|x| x.exp()).collect(),
        spectrum: end.state.0.iter().map(|h| h.exp()).collect(),
        band: end.state.0.iter().enumerate().map(band).collect(),
        regularisation: end.misfit.weight * end.misfit.weight,
        effective_parameters: effective,
        relative_error: (squares / rows as f64).sqrt(),
        outcome: end.outcome,
    })
}
