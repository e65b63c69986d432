//! Discrete relaxation spectra and their responses in closed form.

use piola_fluids::{Modes, UpperConvectedMaxwell};
use piola_numerics::Real;

use crate::error::check;
use crate::{SpectraError, kernel};

/// One mode of a relaxation spectrum: g e^(−t/τ).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RelaxationMode {
    /// g, Pa; 0 < g.
    pub modulus: f64,
    /// τ, s; 0 < τ.
    pub relaxation_time: f64,
}

/// A discrete relaxation spectrum: the generalised Maxwell model.
///
/// ```text
/// G(t) = Gₑ + Σ gᵢ e^(−t/τᵢ)
/// G′(ω) = Gₑ + Σ gᵢ ω²τᵢ²/(1 + ω²τᵢ²)      G″(ω) = Σ gᵢ ωτᵢ/(1 + ω²τᵢ²)
/// ```
/// | symbol | meaning | unit | bounds |
/// |---|---|---|---|
/// | gᵢ | modulus of a mode | Pa | 0 < gᵢ |
/// | τᵢ | relaxation time of a mode | s | 0 < τᵢ |
/// | Gₑ | equilibrium modulus | Pa | 0 ≤ Gₑ; zero for a liquid |
///
/// # Accuracy
/// Every sum has positive terms: a few ulp for each mode, without cancellation.
///
/// # Example
/// ```
/// use piola_spectra::{RelaxationMode, RelaxationSpectrum};
/// let mode = |modulus, relaxation_time| RelaxationMode { modulus, relaxation_time };
/// let melt = RelaxationSpectrum::new(vec![mode(2.0, 1.0), mode(1.0, 4.0)], 0.0)?;
/// assert_eq!(melt.zero_shear_viscosity(), Some(6.0)); // 2 · 1 + 1 · 4
/// assert_eq!(melt.steady_state_compliance(), Some(0.5)); // (2 · 1 + 1 · 16)/6²
/// # Ok::<(), piola_spectra::SpectraError>(())
/// ```
///
/// # Source
/// J. D. Ferry, Viscoelastic Properties of Polymers, 3rd ed., Wiley, 1980, chapter 3.
#[derive(Clone, Debug, PartialEq)]
pub struct RelaxationSpectrum {
    modes: Vec<RelaxationMode>,
    equilibrium_modulus: f64,
}

impl RelaxationSpectrum {
    /// From its modes, in any order, and the equilibrium modulus, Pa. The modes are sorted by relaxation time.
    ///
    /// # Errors
    /// [`SpectraError::NotFinite`]; [`SpectraError::OutOfBounds`] unless 0 < gᵢ, 0 < τᵢ and 0 ≤ Gₑ, and without any mode.
    pub fn new(mut modes: Vec<RelaxationMode>, equilibrium_modulus: f64) -> Result<Self, SpectraError> {
        let count = modes.len() as f64;
        check("number of modes", 0, count, "0 < number of modes", 0.0 < count)?;
        for (index, mode) in modes.iter().enumerate() {
            check("modulus", index, mode.modulus, "0 < g", 0.0 < mode.modulus)?;
            check("relaxation time", index, mode.relaxation_time, "0 < τ", 0.0 < mode.relaxation_time)?;
        }
        check("equilibrium modulus", 0, equilibrium_modulus, "0 ≤ Gₑ", 0.0 <= equilibrium_modulus)?;
        modes.sort_by(|a, b| a.relaxation_time.total_cmp(&b.relaxation_time));
        Ok(Self { modes, equilibrium_modulus })
    }

    /// The modes, from the shortest relaxation time to the longest.
    #[must_use]
    pub fn modes(&self) -> &[RelaxationMode] {
        &self.modes
    }

    /// Gₑ, Pa.
    #[must_use]
    pub const fn equilibrium_modulus(&self) -> f64 {
        self.equilibrium_modulus
    }

    /// The sum over the modes of a response.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sum<T: Real>(&self, first: T, response: impl Fn(T, T) -> T) -> T {
        self.modes.iter().fold(first, |sum, mode| sum + response(T::lit(mode.modulus), T::lit(mode.relaxation_time)))
    }

    /// Relaxation modulus G(t), Pa, at the time `t`, s, after a step of strain.
    pub fn relaxation_modulus<T: Real>(&self, t: T) -> T {
        self.sum(T::lit(self.equilibrium_modulus), |g, tau| g * kernel::relaxation(t / tau))
    }

    /// Storage modulus G′(ω), Pa, at the angular frequency ω, rad/s.
    pub fn storage_modulus<T: Real>(&self, angular_frequency: T) -> T {
        self.sum(T::lit(self.equilibrium_modulus), |g, tau| g * kernel::storage(angular_frequency * tau))
    }

    /// Loss modulus G″(ω), Pa, at the angular frequency ω, rad/s.
    pub fn loss_modulus<T: Real>(&self, angular_frequency: T) -> T {
        self.sum(T::zero(), |g, tau| g * kernel::loss(angular_frequency * tau))
    }

    /// Viscosity η⁺(t) = Gₑ t + Σ gᵢ τᵢ (1 − e^(−t/τᵢ)), Pa s, in the start-up of a slow shear flow.
    pub fn startup_viscosity<T: Real>(&self, t: T) -> T {
        self.sum(T::lit(self.equilibrium_modulus) * t, |g, tau| g * tau * kernel::growth(t / tau))
    }

    /// G(0) = Gₑ + Σ gᵢ, Pa.
    #[must_use]
    pub fn glassy_modulus(&self) -> f64 {
        self.modes.iter().fold(self.equilibrium_modulus, |sum, mode| sum + mode.modulus)
    }

    /// Zero-shear viscosity η₀ = Σ gᵢ τᵢ, Pa s; `None` of a solid, which has Gₑ > 0.
    #[must_use]
    pub fn zero_shear_viscosity(&self) -> Option<f64> {
        self.is_liquid().then(|| self.sum(0.0, |g, tau| g * tau))
    }

    /// Recoverable steady-state compliance Jₑ⁰ = Σ gᵢ τᵢ²/η₀², 1/Pa; `None` of a solid.
    #[must_use]
    pub fn steady_state_compliance(&self) -> Option<f64> {
        let viscosity = self.zero_shear_viscosity()?;
        Some(self.sum(0.0, |g, tau| g * (tau / viscosity) * (tau / viscosity)))
    }

    /// Whether Gₑ = 0.
    #[must_use]
    pub fn is_liquid(&self) -> bool {
        self.equilibrium_modulus <= 0.0
    }

    /// Upper-convected Maxwell modes ηᵢ = gᵢ τᵢ: the law whose linear response this is.
    ///
    /// # Errors
    /// [`SpectraError::OutOfBounds`] of a solid, which has Gₑ > 0; [`SpectraError::Fluids`] if gᵢ τᵢ over- or underflows.
    pub fn maxwell_modes(&self) -> Result<Modes<UpperConvectedMaxwell>, SpectraError> {
        check("equilibrium modulus", 0, self.equilibrium_modulus, "Gₑ = 0 for a fluid", self.is_liquid())?;
        let fluid = |mode: &RelaxationMode| {
            UpperConvectedMaxwell::new(mode.modulus * mode.relaxation_time, mode.relaxation_time)
        };
        Ok(Modes::new(self.modes.iter().map(fluid).collect::<Result<_, _>>()?)?)
    }
}
