//! Discrete spectra from measured responses.
//!
//! ```text
//! S = Σ (model/measured − 1)²      over all measured numbers, G′ and G″ alike
//! ```
//! S is minimised over ln gᵢ, ln τᵢ and, where asked, ln Gₑ, so that all stay positive.

use nalgebra::DMatrix;
use piola_fit::internal::{End, Misfit, minimise};
use piola_fit::{Autocorrelation, Covariance, Criteria, Outcome, student};
use piola_numerics::{Dual, Real};

use crate::{RelaxationMode, RelaxationSpectrum, SpectraError, SpectrumData, kernel};

/// What is fitted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SpectrumOptions {
    /// The number of modes; `None` chooses it by the least `AICc`.
    pub modes: Option<usize>,
    /// The most modes that are tried where the number is chosen.
    pub most_modes: usize,
    /// Whether there is an equilibrium modulus, as of a solid.
    pub equilibrium: bool,
}

impl Default for SpectrumOptions {
    /// A liquid; the number of modes is chosen, up to 12.
    fn default() -> Self {
        Self { modes: None, most_modes: 12, equilibrium: false }
    }
}

/// How well a number of modes fits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModeCount {
    /// The number of modes.
    pub modes: usize,
    /// √(S/m) of m measured numbers: the relative error, root mean square.
    pub relative_error: f64,
    /// Criteria for choosing between numbers of modes.
    pub criteria: Criteria,
}

/// A discrete spectrum fitted to a measured response.
#[derive(Clone, Debug, PartialEq)]
pub struct SpectrumFit {
    /// The spectrum of least S.
    pub spectrum: RelaxationSpectrum,
    /// 95 % interval of each gᵢ, Pa, linear in ln gᵢ; `None` of a mode that the data do not determine.
    pub modulus_intervals: Vec<Option<[f64; 2]>>,
    /// 95 % interval of each τᵢ, s, linear in ln τᵢ.
    pub relaxation_time_intervals: Vec<Option<[f64; 2]>>,
    /// 95 % interval of Gₑ, Pa; `None` if no Gₑ is fitted or the data do not determine it.
    pub equilibrium_interval: Option<[f64; 2]>,
    /// √(S/m): the relative error, root mean square.
    pub relative_error: f64,
    /// How the search ended.
    pub outcome: Outcome,
    /// The numbers of modes that were tried, in this order.
    pub tried: Vec<ModeCount>,
}

/// The coordinates ln g₁, ln τ₁, …, ln gₙ, ln τₙ, and ln Gₑ where there is one.
struct Residuals<'d> {
    data: SpectrumData<'d>,
    modes: usize,
    equilibrium: bool,
}

impl SpectrumData<'_> {
    /// Calls `add(row, response of one mode/measured)` for each measured number.
    pub(crate) fn mode<T: Real>(&self, ln_modulus: T, ln_time: T, mut add: impl FnMut(usize, T)) {
        let g = ln_modulus.exp();
        match *self {
            SpectrumData::Oscillation { angular_frequencies, storage_moduli, loss_moduli } => {
                let rows = angular_frequencies.iter().zip(storage_moduli).zip(loss_moduli).enumerate();
                for (row, ((&frequency, &storage), &loss)) in rows {
                    let x = (T::lit(frequency.ln()) + ln_time).exp();
                    add(2 * row, g * kernel::storage(x) / T::lit(storage));
                    add(2 * row + 1, g * kernel::loss(x) / T::lit(loss));
                }
            }
            SpectrumData::Relaxation { times, moduli } => {
                for (row, (&t, &modulus)) in times.iter().zip(moduli).enumerate() {
                    let ratio = (T::lit(t.ln()) - ln_time).exp();
                    add(row, g * kernel::relaxation(ratio) / T::lit(modulus));
                }
            }
        }
    }
}

impl Residuals<'_> {
    fn unknowns(&self) -> usize {
        2 * self.modes + usize::from(self.equilibrium)
    }

    /// Calls `add(row, 1/measured)` for each number to which Gₑ contributes.
    fn constant(&self, mut add: impl FnMut(usize, f64)) {
        match self.data {
            SpectrumData::Oscillation { storage_moduli, .. } => {
                storage_moduli.iter().enumerate().for_each(|(row, g)| add(2 * row, g.recip()));
            }
            SpectrumData::Relaxation { moduli, .. } => {
                moduli.iter().enumerate().for_each(|(row, g)| add(row, g.recip()));
            }
        }
    }
}

/// Where a search stands.
struct Place {
    coordinates: Vec<f64>,
    residuals: Vec<f64>,
}

impl Misfit for Residuals<'_> {
    type State = Place;

    fn rows(&self) -> usize {
        self.data.count()
    }

    fn visit(&mut self, x: &[f64]) -> Option<Place> {
        let mut residuals = vec![-1.0; self.rows()];
        for mode in x[..2 * self.modes].chunks_exact(2) {
            self.data.mode(mode[0], mode[1], |row, share| residuals[row] += share);
        }
        if self.equilibrium {
            let equilibrium = x[2 * self.modes].exp();
            self.constant(|row, share| residuals[row] += equilibrium * share);
        }
        residuals.iter().all(|r| r.is_finite()).then(|| Place { coordinates: x.to_vec(), residuals })
    }

    fn residuals<'s>(&self, state: &'s Place) -> &'s [f64] {
        &state.residuals
    }

    fn jacobian(&self, _: &Place, x: &[f64]) -> DMatrix<f64> {
        let mut slopes = DMatrix::zeros(self.rows(), self.unknowns());
        for (k, mode) in x[..2 * self.modes].chunks_exact(2).enumerate() {
            self.data.mode(Dual::constant(mode[0]), Dual::variable(mode[1]), |row, share| {
                slopes[(row, 2 * k)] = share.value; // linear in g
                slopes[(row, 2 * k + 1)] = share.tangent;
            });
        }
        if self.equilibrium {
            let equilibrium = x[2 * self.modes].exp();
            self.constant(|row, share| slopes[(row, 2 * self.modes)] = equilibrium * share);
        }
        slopes
    }
}

/// A search that ended.
struct Found<'d> {
    end: End<Residuals<'d>>,
    squares: f64,
}

/// The best spectrum of so many modes, from even times and from the best spectrum of one mode less.
fn best<'d>(data: SpectrumData<'d>, modes: usize, equilibrium: bool, fewer: Option<&[f64]>) -> Option<Found<'d>> {
    const PATIENCE: usize = 200;
    let ends = starts(&data, modes, equilibrium, fewer).into_iter().filter_map(|start| {
        let end = minimise(Residuals { data, modes, equilibrium }, start, PATIENCE, &|| false)?;
        let squares = end.state.residuals.iter().map(|r| r * r).sum();
        Some(Found { end, squares })
    });
    ends.min_by(|a, b| a.squares.total_cmp(&b.squares))
}

/// Coordinates from which a search starts.
fn starts(data: &SpectrumData<'_>, modes: usize, equilibrium: bool, fewer: Option<&[f64]>) -> Vec<Vec<f64>> {
    let [low, high] = data.reach().map(f64::ln);
    let (n, largest) = (modes as f64, data.largest().ln());
    let even: Vec<f64> = (0..modes).map(|k| low + (high - low) * (k as f64 + 0.5) / n).collect();
    let mut first: Vec<f64> = even.iter().flat_map(|&time| [largest - n.ln() - 0.5 * (time - low), time]).collect();
    if equilibrium {
        first.push(largest - 3.0);
    }
    let mut starts = vec![first];
    if let Some(fewer) = fewer {
        // A weak mode more, at the shortest times, in the middle and at the longest: never a worse fit than without it.
        for time in [low, 0.5 * (low + high), high] {
            let weakest = fewer[..2 * (modes - 1)].chunks_exact(2).fold(largest, |least, mode| least.min(mode[0]));
            let mut start = vec![weakest - 3.0, time];
            start.extend_from_slice(fewer);
            starts.push(start);
        }
    }
    starts
}

/// The discrete spectrum of least relative squares.
///
/// | argument | meaning |
/// |---|---|
/// | `data` | G′ and G″, or G(t) |
/// | `options` | the number of modes, or the most that are tried; whether there is an equilibrium modulus |
///
/// Where the number of modes is not given, numbers are tried upwards, until two in a row do not lower `AICc`.
/// The 95 % intervals are those of independent errors, widened where neighbouring residuals are correlated; for that the data
/// stand in the order of ω or t.
///
/// # Errors
/// [`SpectraError::NotFinite`], [`SpectraError::WrongLength`], [`SpectraError::OutOfBounds`] of the data or of no mode;
/// [`SpectraError::TooFewNumbers`]: n modes need at least 2 n + 3 numbers, one more with an equilibrium modulus;
/// [`SpectraError::NoFit`] where the residuals of all starts are not finite.
///
/// # Accuracy
/// The search ends at a minimum of S to about 1e-7 of ln gᵢ and ln τᵢ where the data determine them. S may have several
/// minima: the search starts from even times and from the best spectrum of one mode less.
///
/// # Example
/// ```
/// use piola_spectra::{SpectrumData, SpectrumOptions, fit_spectrum};
/// // One Maxwell mode, g = 2 Pa and τ = 1 s.
/// let angular_frequencies = [0.25_f64, 0.5, 1.0, 2.0, 4.0];
/// let storage_moduli = angular_frequencies.map(|w| 2.0 * w * w / (1.0 + w * w));
/// let loss_moduli = angular_frequencies.map(|w| 2.0 * w / (1.0 + w * w));
/// let data = SpectrumData::Oscillation {
///     angular_frequencies: &angular_frequencies,
///     storage_moduli: &storage_moduli,
///     loss_moduli: &loss_moduli,
/// };
/// let fit = fit_spectrum(data, SpectrumOptions { modes: Some(1), ..SpectrumOptions::default() })?;
/// let mode = fit.spectrum.modes()[0];
/// assert!((mode.modulus - 2.0).abs() < 1e-6 && (mode.relaxation_time - 1.0).abs() < 1e-6);
/// # Ok::<(), piola_spectra::SpectraError>(())
/// ```
///
/// # Source
/// M. Baumgaertel, H. H. Winter, Rheol. Acta 28 (1989) 511: free moduli and times, relative errors.
pub fn fit_spectrum(data: SpectrumData<'_>, options: SpectrumOptions) -> Result<SpectrumFit, SpectraError> {
    data.check()?;
    let SpectrumOptions { modes: asked, most_modes, equilibrium } = options;
    let (rows, least) = (data.count(), asked.unwrap_or(1));
    let most = asked.unwrap_or(most_modes);
    crate::error::check("number of modes", 0, most as f64, "0 < number of modes", 0 < most.min(least))?;
    let needed = |modes: usize| modes.saturating_mul(2).saturating_add(3 + usize::from(equilibrium));
    if rows < needed(least) {
        return Err(SpectraError::TooFewNumbers { modes: least, needed: needed(least), found: rows });
    }
    let (mut chosen, mut last): (Option<(Found<'_>, f64)>, Option<Vec<f64>>) = (None, None);
    let (mut tried, mut in_vain) = (Vec::new(), 0);
    for modes in (1..=most).take_while(|&modes| needed(modes) <= rows) {
        let Some(found) = best(data, modes, equilibrium, last.as_deref()) else { break };
        last = Some(found.end.state.coordinates.clone());
        let criteria = Criteria::new(rows, 2 * modes + usize::from(equilibrium), found.squares);
        tried.push(ModeCount { modes, relative_error: (found.squares / rows as f64).sqrt(), criteria });
        let value = criteria.aicc.unwrap_or(f64::INFINITY);
        let is_better = chosen.as_ref().is_none_or(|(_, least)| value < *least);
        if asked.is_some() || is_better {
            chosen = Some((found, value));
            in_vain = 0;
        } else {
            in_vain += 1;
            if 2 <= in_vain {
                break;
            }
        }
    }
    let (found, _) = chosen.ok_or(SpectraError::NoFit { modes: least })?;
    if asked.is_some_and(|modes| modes != found.end.misfit.modes) {
        return Err(SpectraError::NoFit { modes: least });
    }
    report(found, tried)
}

/// The spectrum of a search with its intervals.
fn report(found: Found<'_>, tried: Vec<ModeCount>) -> Result<SpectrumFit, SpectraError> {
    let Found { end: End { misfit, state, outcome }, squares } = found;
    let (x, residuals) = (&state.coordinates, &state.residuals);
    let (rows, unknowns) = (misfit.rows(), misfit.unknowns());
    let free: Vec<usize> = (0..unknowns).collect();
    let degrees = rows - unknowns;
    let covariance = Covariance::new(&misfit.jacobian(&state, x), &free, squares / degrees as f64);
    let widening = match misfit.data {
        SpectrumData::Oscillation { .. } => {
            let [storage, loss] = [0, 1].map(|k| residuals.iter().skip(k).step_by(2).copied().collect::<Vec<f64>>());
            Autocorrelation::of([storage.as_slice(), loss.as_slice()])
        }
        SpectrumData::Relaxation { .. } => Autocorrelation::of([residuals.as_slice()]),
    };
    let factor = student(0.95, degrees).map(|t| t * widening.map_or(1.0, |found| found.widening));
    let interval = |k: usize| {
        let place = covariance.parameters.iter().position(|&other| other == k)?;
        let half = factor? * covariance.matrix[place][place].sqrt();
        Some([(x[k] - half).exp(), (x[k] + half).exp()])
    };
    let mut order: Vec<usize> = (0..misfit.modes).collect();
    order.sort_by(|&a, &b| x[2 * a + 1].total_cmp(&x[2 * b + 1]));
    let mode = |&k: &usize| RelaxationMode { modulus: x[2 * k].exp(), relaxation_time: x[2 * k + 1].exp() };
    let equilibrium = if misfit.equilibrium { x[2 * misfit.modes].exp() } else { 0.0 };
    Ok(SpectrumFit {
        spectrum: RelaxationSpectrum::new(order.iter().map(mode).collect(), equilibrium)?,
        modulus_intervals: order.iter().map(|&k| interval(2 * k)).collect(),
        relaxation_time_intervals: order.iter().map(|&k| interval(2 * k + 1)).collect(),
        equilibrium_interval: if misfit.equilibrium { interval(2 * misfit.modes) } else { None },
        relative_error: (squares / rows as f64).sqrt(),
        outcome,
        tried,
    })
}
