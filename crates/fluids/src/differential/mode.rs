//! Modes of differential fluids, and the linear response of such fluids.

use crate::FluidsError;
use crate::ViscometricFluid;

/// One mode of a differential fluid: a polymer of one relaxation time beside a Newtonian solvent.
///
/// ```text
/// V = 2 ηₛ D + τ      λ (τ̇ − L τ − τ Lᵀ) + R(τ) = 2 ηₚ D
/// ```
/// The fluids differ in R(τ) = τ + …. A polymer that [slips](Self::slip) is carried by L − ξ D in place of L.
pub trait Mode: ViscometricFluid + Clone {
    /// ηₛ, Pa s.
    #[must_use]
    fn solvent_viscosity(&self) -> f64;
    /// ηₚ, Pa s.
    #[must_use]
    fn polymer_viscosity(&self) -> f64;
    /// λ, s.
    #[must_use]
    fn time(&self) -> f64;
    /// ξ: the share of the rate of deformation that the polymer does not follow; none of most.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn slip(&self) -> f64 {
        0.0
    }
    /// The principal values of τ, Pa, in the steady extension D = diag(ε̇₁, ε̇₂, ε̇₃), reached from rest.
    ///
    /// # Errors
    /// [`FluidsError::BeyondLimit`] where the stress grows without end.
    fn steady_extension(&self, rates: [f64; 3]) -> Result<[f64; 3], FluidsError>;
}

/// A flow that stretches.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum Extension {
    /// D = ε̇ diag(1, −½, −½); the stress difference is T₁₁ − T₂₂.
    Uniaxial,
    /// D = ε̇ diag(1, −1, 0); T₁₁ − T₂₂.
    Planar,
    /// D = ε̇ diag(1, 1, −2); T₁₁ − T₃₃.
    Biaxial,
}

impl Extension {
    /// The principal rates, 1/s, at the rate ε̇.
    #[must_use]
    pub fn rates(self, rate: f64) -> [f64; 3] {
        match self {
            Self::Uniaxial => [rate, -rate / 2.0, -rate / 2.0],
            Self::Planar => [rate, -rate, 0.0],
            Self::Biaxial => [rate, rate, -2.0 * rate],
        }
    }

    /// The difference of principal stresses that drives the flow, Pa.
    #[must_use]
    pub fn difference(self, stresses: [f64; 3]) -> f64 {
        match self {
            Self::Uniaxial | Self::Planar => stresses[0] - stresses[1],
            Self::Biaxial => stresses[0] - stresses[2],
        }
    }

    /// Trouton's ratio: extensional over shear viscosity of a Newtonian fluid.
    #[must_use]
    pub fn trouton_ratio(self) -> f64 {
        match self {
            Self::Uniaxial => 3.0,
            Self::Planar => 4.0,
            Self::Biaxial => 6.0,
        }
    }
}

/// A differential fluid: one mode, or several side by side.
///
/// ```text
/// G(t) = Σ (ηₚ/λ) exp(−t/λ)
/// G′(ω) = Σ (ηₚ/λ) (λω)²/(1 + (λω)²)      G″(ω) = ηₛ ω + Σ (ηₚ/λ) λω/(1 + (λω)²)
/// ```
/// | to get | use |
/// |---|---|
/// | τ, N₁, N₂ in steady shear | [`ViscometricFluid`] |
/// | G(t), G′, G″, the viscosity at rest | this trait |
/// | stresses and viscosity of steady extension | [`extensional_stress`](Self::extensional_stress), [`extensional_viscosity`](Self::extensional_viscosity) |
/// | with the feature `motions`: the stress of any steady motion, and its derivative with respect to L | `SteadyStress` |
/// | start-up, cessation, any motion of Maxwell's and Oldroyd's fluids, exactly | `ConvectedMaxwell` |
/// | any motion of any of them, by integration; large oscillations | `Following`, `follow`, `follow_shear`, `oscillate` |
///
/// # Example
/// ```
/// use piola_fluids::{DifferentialFluid, Extension, OldroydB};
/// let fluid = OldroydB::new(0.5, 2.0, 4.0)?;
/// assert_eq!(fluid.storage_modulus(0.25), 0.25); // (2/4)/2 at λω = 1
/// assert_eq!(fluid.loss_modulus(0.25), 0.375);
/// assert_eq!(fluid.extensional_viscosity(Extension::Uniaxial, 0.0)?, 7.5); // 3 (ηₛ + ηₚ)
/// # Ok::<(), piola_fluids::FluidsError>(())
/// ```
pub trait DifferentialFluid {
    /// The type of its modes.
    type Mode: Mode;

    /// Its modes.
    #[must_use]
    fn modes(&self) -> &[Self::Mode];

    /// Σ ηₛ, Pa s.
    #[must_use]
    fn total_solvent_viscosity(&self) -> f64 {
        self.modes().iter().map(Mode::solvent_viscosity).sum()
    }

    /// Σ (ηₛ + ηₚ), Pa s.
    #[must_use]
    fn zero_rate_viscosity(&self) -> f64 {
        self.modes().iter().map(|mode| mode.solvent_viscosity() + mode.polymer_viscosity()).sum()
    }

    /// G(t), Pa, 0 < t: the shear stress after a small step of shear, divided by it; the solvent's impulse at t = 0 apart.
    #[must_use]
    fn relaxation_modulus(&self, t: f64) -> f64 {
        sum_of(self.modes(), |mode| (-t / mode.time()).exp())
    }

    /// G′(ω), Pa: in phase with a small oscillating shear.
    #[must_use]
    fn storage_modulus(&self, angular_frequency: f64) -> f64 {
        sum_of(self.modes(), |mode| {
            let x = mode.time() * angular_frequency.abs();
            if 1.0 < x { 1.0 / (1.0 + x.recip() * x.recip()) } else { x * x / (1.0 + x * x) }
        })
    }

    /// G″(ω), Pa: in phase with the rate of a small oscillating shear.
    #[must_use]
    fn loss_modulus(&self, angular_frequency: f64) -> f64 {
        let polymer = sum_of(self.modes(), |mode| {
            let x = mode.time() * angular_frequency;
            if x.abs() <= 0.0 { 0.0 } else { 1.0 / (x + x.recip()) }
        });
        self.total_solvent_viscosity() * angular_frequency + polymer
    }

    /// The principal values of T + p 1, Pa, in the steady extension D = diag(ε̇₁, ε̇₂, ε̇₃), reached from rest.
    ///
    /// # Errors
    /// [`FluidsError::BeyondLimit`] where a stress grows without end.
    fn extensional_stress(&self, rates: [f64; 3]) -> Result<[f64; 3], FluidsError> {
        for rate in rates {
            crate::error::check_finite(Self::Mode::NAME, "rate of extension", rate)?;
        }
        let mut total = rates.map(|rate| 2.0 * self.total_solvent_viscosity() * rate);
        for mode in self.modes() {
            let stresses = mode.steady_extension(rates)?;
            total = core::array::from_fn(|i| total[i] + stresses[i]);
        }
        Ok(total)
    }

    /// The stress difference of an [`Extension`] at the rate ε̇, divided by ε̇, Pa s; at rest its limit.
    ///
    /// # Errors
    /// As [`extensional_stress`](Self::extensional_stress).
    fn extensional_viscosity(&self, extension: Extension, rate: f64) -> Result<f64, FluidsError> {
        let stresses = self.extensional_stress(extension.rates(rate))?;
        let resting = rate.abs() <= 0.0;
        Ok(if resting {
            extension.trouton_ratio() * self.zero_rate_viscosity()
        } else {
            extension.difference(stresses) / rate
        })
    }
}

/// Σ (ηₚ/λ) f.
fn sum_of<M: Mode>(modes: &[M], share: impl Fn(&M) -> f64) -> f64 {
    modes.iter().map(|mode| mode.polymer_viscosity() / mode.time() * share(mode)).sum()
}

/// Implements `DifferentialFluid` for a mode: it is the only one.
macro_rules! only_mode {
    ($($mode:ty),+) => {
        $(impl crate::differential::DifferentialFluid for $mode {
            type Mode = Self;

            fn modes(&self) -> &[Self] {
                core::slice::from_ref(self)
            }
        })+
    };
}
pub(super) use only_mode;
