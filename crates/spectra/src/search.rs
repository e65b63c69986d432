//! The search of the discrete spectrum of least squares with a given number of modes.
//!
//! Coordinates: ln height and ln time of each mode, then the logarithms of the terms beside the modes.

use nalgebra::DMatrix;
use piola_fit::internal::{End, Misfit, minimise};
use piola_numerics::Dual;

use crate::SpectrumData;
use crate::data::Term;

/// Relative errors over the coordinates.
pub(crate) struct Residuals<'d> {
    pub(crate) data: SpectrumData<'d>,
    pub(crate) modes: usize,
    pub(crate) terms: &'static [Term],
}

impl Residuals<'_> {
    pub(crate) fn unknowns(&self) -> usize {
        2 * self.modes + self.terms.len()
    }
}

/// Where a search stands.
pub(crate) struct Place {
    pub(crate) coordinates: Vec<f64>,
    pub(crate) residuals: Vec<f64>,
}

impl Misfit for Residuals<'_> {
    type State = Place;

    fn rows(&self) -> usize {
        self.data.count()
    }

    fn visit(&mut self, x: &[f64]) -> Option<Place> {
        let mut residuals = vec![-1.0; self.rows()];
        let (modes, terms) = x.split_at(2 * self.modes);
        for mode in modes.chunks_exact(2) {
            self.data.mode(mode[0], mode[1], |row, share| residuals[row] += share);
        }
        for (&term, size) in self.terms.iter().zip(terms) {
            let size = size.exp();
            self.data.term(term, |row, share| residuals[row] += size * share);
        }
        residuals.iter().all(|r| r.is_finite()).then(|| Place { coordinates: x.to_vec(), residuals })
    }

    fn residuals<'s>(&self, state: &'s Place) -> &'s [f64] {
        &state.residuals
    }

    fn jacobian(&self, _: &Place, x: &[f64]) -> DMatrix<f64> {
        let mut slopes = DMatrix::zeros(self.rows(), self.unknowns());
        let (modes, terms) = x.split_at(2 * self.modes);
        for (k, mode) in modes.chunks_exact(2).enumerate() {
            self.data.mode(Dual::constant(mode[0]), Dual::variable(mode[1]), |row, share| {
                slopes[(row, 2 * k)] = share.value; // linear in the height
                slopes[(row, 2 * k + 1)] = share.tangent;
            });
        }
        for (k, (&term, size)) in self.terms.iter().zip(terms).enumerate() {
            let size = size.exp();
            self.data.term(term, |row, share| slopes[(row, 2 * self.modes + k)] = size * share);
        }
        slopes
    }
}

/// A search that ended.
pub(crate) struct Found<'d> {
    pub(crate) end: End<Residuals<'d>>,
    pub(crate) squares: f64,
}

/// The best spectrum of so many modes, from even times and from the best spectrum of one mode less.
pub(crate) fn best<'d>(
    data: SpectrumData<'d>,
    modes: usize,
    terms: &'static [Term],
    fewer: Option<&[f64]>,
    stop: &dyn Fn() -> bool,
) -> Option<Found<'d>> {
    const PATIENCE: usize = 200;
    let mut best: Option<Found<'_>> = None;
    for start in starts(&data, modes, terms, fewer) {
        if best.is_some() && stop() {
            break;
        }
        let Some(end) = minimise(Residuals { data, modes, terms }, start, PATIENCE, stop) else { continue };
        let squares = end.state.residuals.iter().map(|r| r * r).sum();
        if best.as_ref().is_none_or(|best| squares < best.squares) {
            best = Some(Found { end, squares });
        }
    }
    best
}

/// Coordinates from which a search starts.
fn starts(data: &SpectrumData<'_>, modes: usize, terms: &[Term], fewer: Option<&[f64]>) -> Vec<Vec<f64>> {
    let [low, high] = data.reach().map(f64::ln);
    let [least, largest] = data.range().map(f64::ln);
    let n = modes as f64;
    let even: Vec<f64> = (0..modes).map(|k| low + (high - low) * (k as f64 + 0.5) / n).collect();
    let height = |time: f64| match data {
        // Compliances rise with time, moduli fall.
        SpectrumData::Creep { .. } => {
            least - n.ln() + (largest - least) * (time - low) / (high - low).max(f64::MIN_POSITIVE)
        }
        _ => largest - n.ln() - 0.5 * (time - low),
    };
    let mut first: Vec<f64> = even.iter().flat_map(|&time| [height(time), time]).collect();
    first.extend(terms.iter().map(|term| match term {
        Term::Equilibrium => largest - 3.0,
        Term::Glassy => least - core::f64::consts::LN_2,
        Term::Flow => largest - core::f64::consts::LN_2 - high,
    }));
    let mut starts = vec![first];
    if let Some(fewer) = fewer.filter(|_| 0 < modes) {
        // A weak mode more, at the shortest times, in the middle and at the longest: never a worse fit than without it.
        let first = if data.is_creep() { least } else { largest };
        let weakest = fewer[..2 * (modes - 1)].chunks_exact(2).fold(first, |least, mode| least.min(mode[0]));
        for time in [low, 0.5 * (low + high), high] {
            let mut start = vec![weakest - 3.0, time];
            start.extend_from_slice(fewer);
            starts.push(start);
        }
    }
    starts
}
