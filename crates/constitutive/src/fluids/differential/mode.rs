//! What a differential fluid is made of, and what its linear response is.

use piola_continuum::Symmetric;
use piola_continuum::rates::VelocityGradient;
use piola_numerics::Real;
use piola_numerics::linear::matrix3::from_rows;

use super::steady::steady_mode;
use crate::ConstitutiveError;
use crate::fluids::ViscometricFluid;

/// One mode of a differential fluid: a polymer of one relaxation time beside a Newtonian solvent.
///
/// ```text
/// V = 2 ηₛ D + τ      λ (τ̇ − L τ − τ Lᵀ) + R(τ) = 2 ηₚ D
/// ```
/// R(τ) = τ + … is what tells the fluids apart. A polymer that [slips](Self::slip) is carried by L − ξ D in place of L.
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
    /// ξ: the share of the stretching that the polymer does not follow; none of most.
    #[inline(always)]
    #[must_use]
    fn slip(&self) -> f64 {
        0.0
    }
    /// R(τ), Pa.
    #[must_use]
    fn relaxing<T: Real>(&self, stress: &Symmetric<T>) -> Symmetric<T>;
    /// The principal values of τ, Pa, in the steady extension D = diag(ε̇₁, ε̇₂, ε̇₃), reached from rest.
    ///
    /// # Errors
    /// [`ConstitutiveError::BeyondLimit`] where the stress grows without end.
    fn steady_extension(&self, rates: [f64; 3]) -> Result<[f64; 3], ConstitutiveError>;

    /// τ̇, Pa/s, of a particle.
    #[inline(always)]
    #[must_use]
    fn stress_rate<T: Real>(&self, stress: &Symmetric<T>, velocity_gradient: &VelocityGradient<T>) -> Symmetric<T> {
        let drawn = velocity_gradient.stretching().0 * T::lit(2.0 * self.polymer_viscosity()) - self.relaxing(stress);
        drawn * T::lit(self.time().recip()) + convected(stress, &carrying(self, velocity_gradient))
    }
}

/// L − ξ D.
#[inline(always)]
pub(super) fn carrying<M: Mode, T: Real>(mode: &M, velocity_gradient: &VelocityGradient<T>) -> VelocityGradient<T> {
    if mode.slip() <= 0.0 {
        return *velocity_gradient;
    }
    // Entry by entry: L less ξ D would lose the digits of a stretching that hardly draws.
    let (half, l) = (T::lit(0.5 * mode.slip()), velocity_gradient.rows());
    let (along, across) = (T::lit(1.0 - mode.slip()), T::lit(1.0 - 0.5 * mode.slip()));
    let [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]] = l;
    VelocityGradient(from_rows([
        [along * xx, across * xy - half * yx, across * xz - half * zx],
        [across * yx - half * xy, along * yy, across * yz - half * zy],
        [across * zx - half * xz, across * zy - half * yz, along * zz],
    ]))
}

/// L τ + τ Lᵀ.
#[inline(always)]
pub(super) fn convected<T: Real>(stress: &Symmetric<T>, velocity_gradient: &VelocityGradient<T>) -> Symmetric<T> {
    Symmetric::sum_with_transpose(piola_continuum::tensor::rows::product(velocity_gradient.rows(), stress.rows()))
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

    /// Its ratio to the viscosity of a Newtonian fluid: Trouton's.
    #[must_use]
    pub fn trouton_ratio(self) -> f64 {
        match self {
            Self::Uniaxial => 3.0,
            Self::Planar => 4.0,
            Self::Biaxial => 6.0,
        }
    }
}

/// Shear stress and normal stress differences at one time of a shear flow, Pa.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ShearStresses<T = f64> {
    /// T₁₂.
    pub shear: T,
    /// N₁ = T₂₂ − T₁₁.
    pub first: T,
    /// N₂ = T₁₁ − T₃₃.
    pub second: T,
}

impl<T: Real> ShearStresses<T> {
    /// Of a stress, or of an extra stress.
    #[inline(always)]
    #[must_use]
    pub fn of(stress: &Symmetric<T>) -> Self {
        let [t11, t22, t33, t12, ..] = stress.components;
        Self { shear: t12, first: t22 - t11, second: t11 - t33 }
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
/// | the stress of any steady motion, and its derivative with respect to L | [`steady_stress`](Self::steady_stress) |
/// | start-up, cessation, any motion of Maxwell's and Oldroyd's fluids, exactly | [`ConvectedMaxwell`](super::ConvectedMaxwell) |
/// | any motion of any of them, by integration; large oscillations | [`Following`](super::Following), [`follow`](super::follow), [`follow_shear`](super::follow_shear), [`oscillate`](super::oscillate) |
///
/// # Example
/// ```
/// use piola_constitutive::fluids::{DifferentialFluid, Extension, OldroydB};
/// let fluid = OldroydB::new(0.5, 2.0, 4.0)?;
/// assert_eq!(fluid.storage_modulus(0.25), 0.25); // (2/4)/2 at λω = 1
/// assert_eq!(fluid.loss_modulus(0.25), 0.375);
/// assert_eq!(fluid.extensional_viscosity(Extension::Uniaxial, 0.0)?, 7.5); // 3 (ηₛ + ηₚ)
/// # Ok::<(), piola_constitutive::ConstitutiveError>(())
/// ```
pub trait DifferentialFluid {
    /// What its modes are.
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
    fn relaxation_modulus(&self, time: f64) -> f64 {
        sum_of(self.modes(), |mode| (-time / mode.time()).exp())
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
    /// [`ConstitutiveError::BeyondLimit`] where a stress grows without end.
    fn extensional_stress(&self, rates: [f64; 3]) -> Result<[f64; 3], ConstitutiveError> {
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

    /// T + p 1, Pa, in a steady motion with the velocity gradient L since always; over dual numbers with its derivative.
    ///
    /// ```text
    /// R(τ) − λ (L τ + τ Lᵀ) = 2 ηₚ D      with L − ξ D in the place of L where the polymer slips
    /// ```
    /// The state is the one that a motion started from rest ends in: that of a positive definite conformation
    /// 1 + (1 − ξ) (λ/ηₚ) τ, which is unique and stable. It is found by Newton's method from rest, and where that fails along L that
    /// grows from zero; derivatives are those of the equation. Each state takes steps of its own, so that lanes would wait for the
    /// slowest at every one: a call over lanes does not compile. In shear the viscometric functions of
    /// [`batch`](crate::fluids::batch) run in lanes.
    ///
    /// # Errors
    /// [`ConstitutiveError::BeyondLimit`] where there is none: the stress would grow without end.
    ///
    /// # Accuracy
    /// That of a linear system of six equations, balanced; diagonal for a diagonal L.
    ///
    /// # Example
    /// ```
    /// use piola_constitutive::fluids::{DifferentialFluid, Giesekus, ViscometricFluid};
    /// use piola_continuum::rates::VelocityGradient;
    /// use piola_numerics::Dual;
    /// let fluid = Giesekus::new(0.0, 2.0, 0.5, 0.25)?;
    /// let zero = Dual::constant(0.0_f64);
    /// let shear = VelocityGradient::from_rows([[zero; 3], [Dual::variable(4.0_f64), zero, zero], [zero; 3]])?;
    /// let stress = fluid.steady_stress(&shear)?.components[3];
    /// let function = fluid.shear_stress(Dual::variable(4.0));
    /// assert!((stress.value - function.value).abs() < 1e-14);
    /// assert!((stress.tangent - function.tangent).abs() < 1e-14); // dT₁₂/dk
    /// # Ok::<(), piola_constitutive::ConstitutiveError>(())
    /// ```
    fn steady_stress<T: Real>(
        &self,
        velocity_gradient: &VelocityGradient<T>,
    ) -> Result<Symmetric<T>, ConstitutiveError> {
        let mut total = velocity_gradient.stretching().0 * T::lit(2.0 * self.total_solvent_viscosity());
        for mode in self.modes() {
            total += steady_mode(mode, velocity_gradient)?;
        }
        Ok(total)
    }

    /// The stress difference of an [`Extension`] at the rate ε̇, divided by ε̇, Pa s; at rest its limit.
    ///
    /// # Errors
    /// As [`extensional_stress`](Self::extensional_stress).
    fn extensional_viscosity(&self, extension: Extension, rate: f64) -> Result<f64, ConstitutiveError> {
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
        $(impl crate::fluids::differential::DifferentialFluid for $mode {
            type Mode = Self;

            fn modes(&self) -> &[Self] {
                core::slice::from_ref(self)
            }
        })+
    };
}
pub(super) use only_mode;
