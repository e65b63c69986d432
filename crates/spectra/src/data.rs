//! Measured responses that a spectrum is fitted to.

use piola_numerics::Real;

use crate::error::check;
use crate::{SpectraError, kernel};

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
    /// Creep after a step of stress: J at times.
    Creep {
        /// t, s; 0 < t.
        times: &'d [f64],
        /// J, 1/Pa; 0 < J.
        compliances: &'d [f64],
    },
}

/// A term of a response beside its modes.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Term {
    /// Gₑ.
    Equilibrium,
    /// `J_g`.
    Glassy,
    /// 1/η₀.
    Flow,
}

impl SpectrumData<'_> {
    /// Measured numbers.
    pub(crate) fn count(&self) -> usize {
        match self {
            Self::Oscillation { angular_frequencies, .. } => 2 * angular_frequencies.len(),
            Self::Relaxation { times, .. } | Self::Creep { times, .. } => times.len(),
        }
    }

    pub(crate) const fn is_creep(&self) -> bool {
        matches!(self, Self::Creep { .. })
    }

    /// The terms beside the modes, of a solid or a liquid.
    pub(crate) const fn terms(&self, is_solid: bool) -> &'static [Term] {
        match (self, is_solid) {
            (Self::Creep { .. }, true) => &[Term::Glassy],
            (Self::Creep { .. }, false) => &[Term::Glassy, Term::Flow],
            (_, true) => &[Term::Equilibrium],
            (_, false) => &[],
        }
    }

    /// The least and the greatest time that the abscissas reach: 1/ω or t.
    pub(crate) fn reach(&self) -> [f64; 2] {
        let (abscissas, is_frequency) = match *self {
            Self::Oscillation { angular_frequencies, .. } => (angular_frequencies, true),
            Self::Relaxation { times, .. } | Self::Creep { times, .. } => (times, false),
        };
        let time = |x: &f64| if is_frequency { x.recip() } else { *x };
        let widen = |[low, high]: [f64; 2], t: f64| [low.min(t), high.max(t)];
        abscissas.iter().map(time).fold([f64::INFINITY, 0.0], widen)
    }

    /// The least and the largest measured modulus or compliance.
    pub(crate) fn range(&self) -> [f64; 2] {
        let moduli = match self {
            Self::Oscillation { storage_moduli, .. } => storage_moduli,
            Self::Relaxation { moduli, .. } => moduli,
            Self::Creep { compliances, .. } => compliances,
        };
        moduli.iter().fold([f64::INFINITY, 0.0], |[least, largest], &g| [least.min(g), largest.max(g)])
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
            Self::Creep { times, compliances } => {
                positive("time", times, times.len(), "0 < t")?;
                positive("creep compliance", compliances, times.len(), "0 < J")
            }
        }
    }

    /// Calls `add(row, response of one mode/measured)` for each measured number; the mode has a modulus, of creep a compliance.
    pub(crate) fn mode<T: Real>(&self, ln_height: T, ln_time: T, mut add: impl FnMut(usize, T)) {
        let height = ln_height.exp();
        match *self {
            Self::Oscillation { angular_frequencies, storage_moduli, loss_moduli } => {
                let rows = angular_frequencies.iter().zip(storage_moduli).zip(loss_moduli).enumerate();
                for (row, ((&frequency, &storage), &loss)) in rows {
                    let x = (T::lit(frequency.ln()) + ln_time).exp();
                    add(2 * row, height * kernel::storage(x) / T::lit(storage));
                    add(2 * row + 1, height * kernel::loss(x) / T::lit(loss));
                }
            }
            Self::Relaxation { times, moduli } => {
                for (row, (&t, &modulus)) in times.iter().zip(moduli).enumerate() {
                    let ratio = (T::lit(t.ln()) - ln_time).exp();
                    add(row, height * kernel::relaxation(ratio) / T::lit(modulus));
                }
            }
            Self::Creep { times, compliances } => {
                for (row, (&t, &compliance)) in times.iter().zip(compliances).enumerate() {
                    let ratio = (T::lit(t.ln()) - ln_time).exp();
                    add(row, height * kernel::growth(ratio) / T::lit(compliance));
                }
            }
        }
    }

    /// Calls `add(row, response of a unit of the term/measured)` for each number to which it contributes.
    pub(crate) fn term(&self, term: Term, mut add: impl FnMut(usize, f64)) {
        match *self {
            Self::Oscillation { storage_moduli, .. } => {
                storage_moduli.iter().enumerate().for_each(|(row, g)| add(2 * row, g.recip()));
            }
            Self::Relaxation { moduli, .. } => moduli.iter().enumerate().for_each(|(row, g)| add(row, g.recip())),
            Self::Creep { times, compliances } => {
                for (row, (t, j)) in times.iter().zip(compliances).enumerate() {
                    add(row, if term == Term::Flow { t / j } else { j.recip() });
                }
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
