//! Measured responses that a spectrum is fitted to.

use crate::SpectraError;
use crate::error::check;

/// A measured linear response.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum SpectrumData<'d> {
    /// Small-amplitude oscillation: G′ and G″ at angular frequencies.
    Oscillation {
        /// ω, rad/s; 0 < ω.
        angular_frequencies: &'d [f64],
        /// G′, Pa; 0 < G′.
        storage_moduli: &'d [f64],
        /// G″, Pa; 0 < G″.
        loss_moduli: &'d [f64],
    },
    /// Relaxation after a step of strain: G at times.
    Relaxation {
        /// t, s; 0 < t.
        times: &'d [f64],
        /// G, Pa; 0 < G.
        moduli: &'d [f64],
    },
}

impl SpectrumData<'_> {
    /// Measured numbers.
    pub(crate) fn count(&self) -> usize {
        match self {
            Self::Oscillation { angular_frequencies, .. } => 2 * angular_frequencies.len(),
            Self::Relaxation { times, .. } => times.len(),
        }
    }

    /// The least and the greatest relaxation time that the abscissas reach: 1/ω or t.
    pub(crate) fn reach(&self) -> [f64; 2] {
        let (abscissas, is_frequency) = match *self {
            Self::Oscillation { angular_frequencies, .. } => (angular_frequencies, true),
            Self::Relaxation { times, .. } => (times, false),
        };
        let time = |x: &f64| if is_frequency { x.recip() } else { *x };
        let widen = |[low, high]: [f64; 2], t: f64| [low.min(t), high.max(t)];
        abscissas.iter().map(time).fold([f64::INFINITY, 0.0], widen)
    }

    /// Largest measured modulus.
    pub(crate) fn largest(&self) -> f64 {
        let moduli = match self {
            Self::Oscillation { storage_moduli, .. } => storage_moduli,
            Self::Relaxation { moduli, .. } => moduli,
        };
        moduli.iter().fold(0.0, |largest: f64, &g| largest.max(g))
    }

    /// Refuses lists of unequal length and numbers that are not finite and positive.
    pub(crate) fn check(&self) -> Result<(), SpectraError> {
        match *self {
            Self::Oscillation { angular_frequencies, storage_moduli, loss_moduli } => {
                let expected = angular_frequencies.len();
                positive("angular frequency", angular_frequencies, expected, "0 < ω")?;
                positive("storage modulus", storage_moduli, expected, "0 < G′")?;
                positive("loss modulus", loss_moduli, expected, "0 < G″")
            }
            Self::Relaxation { times, moduli } => {
                positive("time", times, times.len(), "0 < t")?;
                positive("relaxation modulus", moduli, times.len(), "0 < G")
            }
        }
    }
}

fn positive(quantity: &'static str, values: &[f64], expected: usize, bound: &'static str) -> Result<(), SpectraError> {
    if values.len() != expected {
        return Err(SpectraError::WrongLength { quantity, expected, found: values.len() });
    }
    values.iter().enumerate().try_for_each(|(index, &value)| check(quantity, index, value, bound, 0.0 < value))
}
