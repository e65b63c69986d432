//! Discrete spectra from measured responses.
//!
//! ```text
//! S = Σ (model/measured − 1)²      over all measured numbers, G′ and G″ alike
//! ```
//! S is minimised over ln gᵢ, ln τᵢ and, where asked, ln Gₑ, so that all stay positive; of creep over ln Jₖ, ln λₖ, ln `J_g` and ln 1/η₀.

use core::cell::{Cell, RefCell};
use core::ops::ControlFlow;

use piola_fit::internal::{End, Misfit};
use piola_fit::{Autocorrelation, Covariance, Criteria, Outcome, student};

use crate::data::Term;
use crate::search::{Found, best};
use crate::{RelaxationMode, RelaxationSpectrum, RetardationMode, RetardationSpectrum, SpectraError, SpectrumData};

/// What is fitted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SpectrumOptions {
    /// The number of modes, of creep that of retardation modes; `None` chooses it by the least `AICc`.
    pub modes: Option<usize>,
    /// The most modes that are tried where the number is chosen.
    pub most_modes: usize,
    /// Whether there is an equilibrium modulus, as of a solid; then creep has no 1/η₀.
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
    /// The relaxation spectrum of least S; of creep the exact conversion of the retardation spectrum of least S.
    pub spectrum: RelaxationSpectrum,
    /// The retardation spectrum that was fitted, if the data are of creep.
    pub retardation: Option<RetardationFit>,
    /// 95 % interval of each gᵢ, Pa, symmetric in ln gᵢ; `None` of a mode that the data do not determine to four orders of magnitude.
    /// Of creep they follow to first order from those of what was fitted, which [`RetardationFit`] has; `None` where the data do not
    /// determine all of it.
    pub modulus_intervals: Vec<Option<[f64; 2]>>,
    /// 95 % interval of each τᵢ, s, symmetric in ln τᵢ.
    pub relaxation_time_intervals: Vec<Option<[f64; 2]>>,
    /// 95 % interval of Gₑ, Pa; `None` if no Gₑ is fitted or the data do not determine it.
    pub equilibrium_interval: Option<[f64; 2]>,
    /// √(S/m): the relative error, root mean square.
    pub relative_error: f64,
    /// How the search ended.
    pub outcome: Outcome,
    /// Whether the caller stopped it before all numbers of modes were tried.
    pub interrupted: bool,
    /// The numbers of modes that were tried, in this order.
    pub tried: Vec<ModeCount>,
}

/// A retardation spectrum fitted to creep.
///
/// # Example
/// ```
/// use piola_spectra::{SpectrumData, SpectrumOptions, fit_spectrum};
/// // J(t) = 1 + t + 2 (1 − e^(−t)), 1/Pa.
/// let times = [0.125, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0_f64];
/// let compliances = times.map(|t| 1.0 + t + 2.0 * (1.0 - (-t).exp()));
/// let data = SpectrumData::Creep { times: &times, compliances: &compliances };
/// let fit = fit_spectrum(data, SpectrumOptions { modes: Some(1), ..SpectrumOptions::default() })?;
/// let creep = fit.retardation.expect("the data are of creep").spectrum;
/// assert!((creep.glassy_compliance() - 1.0).abs() < 1e-6 && (creep.fluidity() - 1.0).abs() < 1e-6);
/// assert!((creep.modes()[0].compliance - 2.0).abs() < 1e-6);
/// // A liquid relaxes by one mode more.
/// assert_eq!(fit.spectrum.modes().len(), 2);
/// # Ok::<(), piola_spectra::SpectraError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct RetardationFit {
    /// The spectrum of least S.
    pub spectrum: RetardationSpectrum,
    /// 95 % interval of each Jₖ, 1/Pa, symmetric in ln Jₖ; `None` where the data do not determine it to four orders of magnitude.
    pub compliance_intervals: Vec<Option<[f64; 2]>>,
    /// 95 % interval of each λₖ, s.
    pub retardation_time_intervals: Vec<Option<[f64; 2]>>,
    /// 95 % interval of `J_g`, 1/Pa.
    pub glassy_interval: Option<[f64; 2]>,
    /// 95 % interval of 1/η₀, 1/(Pa s); `None` of a solid too.
    pub fluidity_interval: Option<[f64; 2]>,
}

/// The discrete spectrum of least relative squares.
///
/// | argument | meaning |
/// |---|---|
/// | `data` | G′ and G″, G(t), or J(t) |
/// | `options` | the number of modes, or the most that are tried; whether there is an equilibrium modulus |
///
/// Where the number of modes is not given, numbers are tried upwards, until two in a row do not lower `AICc`. Those of a liquid that
/// creeps start at none: J = `J_g` + t/η₀.
/// The 95 % intervals are those of independent errors, widened where neighbouring residuals are correlated; for that the data
/// stand in the order of ω or t.
///
/// # Errors
/// [`SpectraError::NotFinite`], [`SpectraError::WrongLength`], [`SpectraError::OutOfBounds`] of the data or of no mode;
/// [`SpectraError::TooFewNumbers`]: n modes need at least 2 n + 3 numbers, one more with an equilibrium modulus or a fluidity;
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
    fit_spectrum_until(data, options, &mut |_| ControlFlow::Continue(()))
}

/// The same until `watch`, which is told the finished part of the work, breaks: the best spectrum until then is returned.
///
/// # Errors
/// As [`fit_spectrum`].
pub fn fit_spectrum_until(
    data: SpectrumData<'_>,
    options: SpectrumOptions,
    watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<SpectrumFit, SpectraError> {
    data.check()?;
    let SpectrumOptions { modes: asked, most_modes, equilibrium } = options;
    let terms = data.terms(equilibrium);
    // Without a mode a solid does not relax, and neither does a relaxation.
    let fewest = usize::from(equilibrium || !data.is_creep());
    let (rows, least) = (data.count(), asked.unwrap_or(fewest));
    let most = asked.unwrap_or(most_modes);
    crate::error::check("number of modes", 0, most as f64, "0 < number of modes", fewest <= most.min(least))?;
    let needed = |modes: usize| modes.saturating_mul(2).saturating_add(3 + usize::from(!terms.is_empty()));
    if rows < needed(least) {
        return Err(SpectraError::TooFewNumbers { modes: least, needed: needed(least), found: rows });
    }
    let (watch, done, broken) = (RefCell::new(watch), Cell::new(0.0), Cell::new(false));
    let stop = || {
        if !broken.get() {
            broken.set((*watch.borrow_mut())(done.get()).is_break());
        }
        broken.get()
    };
    let (mut chosen, mut last): (Option<(Found<'_>, f64)>, Option<Vec<f64>>) = (None, None);
    let (mut tried, mut in_vain) = (Vec::new(), 0);
    for modes in (fewest..=most).take_while(|&modes| needed(modes) <= rows) {
        if chosen.is_some() && stop() {
            break;
        }
        // A search of n modes costs as n².
        let share = modes.saturating_sub(1) as f64 / most.max(1) as f64;
        done.set(share * share);
        let Some(found) = best(data, modes, terms, last.as_deref(), &stop) else { break };
        last = Some(found.end.state.coordinates.clone());
        let criteria = Criteria::new(rows, 2 * modes + terms.len(), found.squares);
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
    if !broken.get() && asked.is_some_and(|modes| modes != found.end.misfit.modes) {
        return Err(SpectraError::NoFit { modes: least });
    }
    report(found, tried, broken.get())
}

/// Half widths of logarithms from which on not even four orders of magnitude are told.
const LOST: f64 = 9.2;

/// The spectrum of a search with its intervals.
fn report(found: Found<'_>, tried: Vec<ModeCount>, interrupted: bool) -> Result<SpectrumFit, SpectraError> {
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
        SpectrumData::Relaxation { .. } | SpectrumData::Creep { .. } => Autocorrelation::of([residuals.as_slice()]),
    };
    let factor = student(0.95, degrees).map(|t| t * widening.map_or(1.0, |found| found.widening));
    let interval = |k: usize| {
        let place = covariance.parameters.iter().position(|&other| other == k)?;
        let half = factor? * covariance.matrix[place][place].sqrt();
        (half < LOST).then(|| [(x[k] - half).exp(), (x[k] + half).exp()])
    };
    let mut order: Vec<usize> = (0..misfit.modes).collect();
    order.sort_by(|&a, &b| x[2 * a + 1].total_cmp(&x[2 * b + 1]));
    let heights: Vec<_> = order.iter().map(|&k| interval(2 * k)).collect();
    let times: Vec<_> = order.iter().map(|&k| interval(2 * k + 1)).collect();
    let place = |term: Term| misfit.terms.iter().position(|&other| other == term).map(|k| 2 * misfit.modes + k);
    let size = |term: Term| place(term).map_or(0.0, |k| x[k].exp());
    let within = |term: Term| place(term).and_then(interval);
    let relative_error = (squares / rows as f64).sqrt();
    if misfit.data.is_creep() {
        let (glassy_interval, fluidity_interval) = (within(Term::Glassy), within(Term::Flow));
        let mode = |&k: &usize| RetardationMode { compliance: x[2 * k].exp(), retardation_time: x[2 * k + 1].exp() };
        let modes = order.iter().map(mode).collect();
        let spectrum = RetardationSpectrum::new(modes, size(Term::Glassy), size(Term::Flow))?;
        let relaxation = RelaxationSpectrum::of(&spectrum)?;
        let converted = |x: &[f64]| {
            let mode = |k: &usize| RetardationMode { compliance: x[2 * k].exp(), retardation_time: x[2 * k + 1].exp() };
            let size = |term: Term| place(term).map_or(0.0, |k| x[k].exp());
            let modes = order.iter().map(mode).collect();
            let spectrum = RetardationSpectrum::new(modes, size(Term::Glassy), size(Term::Flow)).ok()?;
            Some(logarithms(&RelaxationSpectrum::of(&spectrum).ok()?))
        };
        let halves = first_order(&covariance, x, &logarithms(&relaxation), &converted);
        let within = |k: usize| {
            let half = factor? * halves.as_ref()?[k];
            let value = logarithms(&relaxation)[k];
            (half < LOST).then(|| [(value - half).exp(), (value + half).exp()])
        };
        let count = relaxation.modes().len();
        let (moduli, relaxation_times) =
            ((0..count).map(|k| within(2 * k)).collect(), (0..count).map(|k| within(2 * k + 1)).collect());
        return Ok(SpectrumFit {
            equilibrium_interval: if relaxation.is_liquid() { None } else { within(2 * count) },
            spectrum: relaxation,
            retardation: Some(RetardationFit {
                spectrum,
                compliance_intervals: heights,
                retardation_time_intervals: times,
                glassy_interval,
                fluidity_interval,
            }),
            modulus_intervals: moduli,
            relaxation_time_intervals: relaxation_times,
            relative_error,
            outcome,
            interrupted,
            tried,
        });
    }
    let mode = |&k: &usize| RelaxationMode { modulus: x[2 * k].exp(), relaxation_time: x[2 * k + 1].exp() };
    Ok(SpectrumFit {
        spectrum: RelaxationSpectrum::new(order.iter().map(mode).collect(), size(Term::Equilibrium))?,
        retardation: None,
        modulus_intervals: heights,
        relaxation_time_intervals: times,
        equilibrium_interval: within(Term::Equilibrium),
        relative_error,
        outcome,
        interrupted,
        tried,
    })
}

/// ln gᵢ and ln τᵢ of each mode; then ln Gₑ, of a solid.
fn logarithms(spectrum: &RelaxationSpectrum) -> Vec<f64> {
    let modes = spectrum.modes().iter().flat_map(|mode| [mode.modulus.ln(), mode.relaxation_time.ln()]);
    let equilibrium = (!spectrum.is_liquid()).then(|| spectrum.equilibrium_modulus().ln());
    modes.chain(equilibrium).collect()
}

/// Standard errors of functions of the coordinates x, to first order: √(d C dᵀ) with central differences d. None unless all coordinates
/// are determined and all functions are there.
fn first_order(
    covariance: &Covariance,
    x: &[f64],
    values: &[f64],
    functions: &dyn Fn(&[f64]) -> Option<Vec<f64>>,
) -> Option<Vec<f64>> {
    const STEP: f64 = 1e-4;
    if covariance.parameters.len() != x.len() {
        return None;
    }
    let mut slopes = Vec::with_capacity(x.len());
    for k in 0..x.len() {
        let at = |step: f64| {
            let mut moved = x.to_vec();
            moved[k] += step;
            functions(&moved).filter(|found| found.len() == values.len())
        };
        let (after, before) = (at(STEP)?, at(-STEP)?);
        slopes
            .push(after.iter().zip(before).map(|(after, before)| (after - before) / (2.0 * STEP)).collect::<Vec<_>>());
    }
    let variance = |function: usize| {
        let mut sum = 0.0;
        for (i, row) in covariance.matrix.iter().enumerate() {
            for (j, entry) in row.iter().enumerate() {
                sum += slopes[i][function] * entry * slopes[j][function];
            }
        }
        sum
    };
    Some((0..values.len()).map(|function| variance(function).max(0.0).sqrt()).collect())
}
