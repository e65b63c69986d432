//! Finite J₂ plasticity and viscoplasticity.

use piola_continuum::{DeformationGradient, Symmetric};
use piola_numerics::Real;
use piola_solids::{Hyperelastic, SolidsError};
use piola_tensor::internal::rows::{Rows, product};

use crate::error::check_bound;
use crate::{Evolution, InelasticError, flow};

/// The yield stress of isotropic hardening, σ(α) = σ₀ + H α + (σ∞ − σ₀)(1 − e^(−δ α)).
///
/// | symbol | field | unit | bounds |
/// |---|---|---|---|
/// | σ₀ | `yield_stress` | Pa | 0 < σ₀ |
/// | H | `linear` | Pa | 0 ≤ H |
/// | σ∞ | `saturation` | Pa | σ₀ ≤ σ∞ |
/// | δ | `saturation_exponent` | – | 0 ≤ δ |
///
/// # Example
/// ```
/// use piola_inelastic::Hardening;
/// let steel = Hardening { yield_stress: 0.45e9, linear: 0.13e9, saturation: 0.715e9, saturation_exponent: 16.93 };
/// assert_eq!(steel.stress(0.0), 0.45e9);
/// ```
///
/// # Source
/// J. C. Simo, Comput. Methods Appl. Mech. Engrg. 68 (1988) 1–31.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Hardening {
    /// σ₀, Pa.
    pub yield_stress: f64,
    /// H, Pa.
    pub linear: f64,
    /// σ∞, Pa.
    pub saturation: f64,
    /// δ.
    pub saturation_exponent: f64,
}

const LAW: &str = "J₂ plasticity";

impl Hardening {
    /// σ(α), Pa, of the accumulated inelastic strain α.
    #[must_use]
    pub fn stress<T: Real>(&self, accumulated: T) -> T {
        let saturating = (accumulated * T::lit(-self.saturation_exponent)).exp_m1();
        T::lit(self.yield_stress) + T::lit(self.linear) * accumulated
            - T::lit(self.saturation - self.yield_stress) * saturating
    }

    /// The same, if within its bounds.
    ///
    /// # Errors
    /// [`InelasticError::NotFinite`], [`InelasticError::OutOfBounds`].
    pub fn checked(self) -> Result<Self, InelasticError> {
        check_bound(LAW, "yield_stress", self.yield_stress, "0 < σ₀", 0.0 < self.yield_stress)?;
        check_bound(LAW, "linear", self.linear, "0 ≤ H", 0.0 <= self.linear)?;
        check_bound(LAW, "saturation", self.saturation, "σ₀ ≤ σ∞", self.yield_stress <= self.saturation)?;
        let exponent = self.saturation_exponent;
        check_bound(LAW, "saturation_exponent", exponent, "0 ≤ δ", 0.0 <= exponent)?;
        Ok(self)
    }
}

/// The elastic-plastic solid of von Mises' yield condition at finite strain, with or without viscosity.
///
/// ```text
/// P = Pₑ(F Fᵢ⁻¹) Fᵢ⁻ᵀ        Ḟᵢ = Dᵢ Fᵢ,   Dᵢ = α̇ (3/2) dev M/σ,   σ = √(3/2) |dev M|
/// α̇ = ⟨σ − σ(α)⟩/η,  or  σ ≤ σ(α), 0 ≤ α̇ for η = 0: independent of the rate
/// ```
/// The elastic law may be any isotropic energy. The ten internal variables are Fᵢ by rows and α.
///
/// | symbol | parameter | unit | bounds |
/// |---|---|---|---|
/// | σ(α) | `hardening` | Pa | see [`Hardening`] |
/// | η | `viscosity` | Pa s | 0 ≤ η |
///
/// # Accuracy
/// That of the [`StepControl`](crate::StepControl); det Fᵢ = 1 to rounding.
///
/// # Example
/// Sheared far beyond its yield stress, the solid bears no more than σ₀/√3.
/// ```
/// use piola_continuum::DeformationGradient;
/// use piola_inelastic::{StepControl, Hardening, InelasticPoint, Viscoplastic};
/// use piola_solids::Hencky;
/// let hardening = Hardening { yield_stress: 0.01, linear: 0.0, saturation: 0.01, saturation_exponent: 0.0 };
/// let law = Viscoplastic::new(Hencky::new(1.0, 1.0)?, hardening, 0.0)?;
/// let mut point = InelasticPoint::new(&law);
/// let shear = DeformationGradient::simple_shear(0.1)?;
/// let stress = point.advance(&shear, 1.0, &StepControl::one_step())?.first_piola.cauchy(&shear).0.components[3];
/// assert!((stress - 0.01 / 3.0_f64.sqrt()).abs() < 1e-4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// G. Weber and L. Anand, Comput. Methods Appl. Mech. Engrg. 79 (1990) 173–202.
#[doc(alias("von Mises", "J2", "Perzyna", "plasticity"))]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Viscoplastic<L> {
    pub(crate) elastic: L,
    hardening: Hardening,
    viscosity: f64,
}

impl<L: Hyperelastic> Viscoplastic<L> {
    /// Of the elastic law, its yield stress and η, Pa s.
    ///
    /// # Errors
    /// [`InelasticError::NotFinite`], [`InelasticError::OutOfBounds`].
    pub fn new(elastic: L, hardening: Hardening, viscosity: f64) -> Result<Self, InelasticError> {
        check_bound(LAW, "viscosity", viscosity, "0 ≤ η", 0.0 <= viscosity)?;
        Ok(Self { elastic, hardening: hardening.checked()?, viscosity })
    }

    /// dev M and σ = √(3/2) |dev M|.
    fn stress<T: Real>(&self, elastic: &Rows<T>) -> (Symmetric<T>, T) {
        let deviator = flow::mandel(&self.elastic, elastic).deviator();
        let square = flow::square(&deviator, self.hardening.yield_stress);
        (deviator, (T::lit(1.5) * square).sqrt())
    }
}

impl<L: Hyperelastic> Evolution<10, 7> for Viscoplastic<L> {
    fn initial(&self) -> [f64; 10] {
        flow::virgin()
    }

    fn evolves(&self, from: &[f64; 10], gradient: &Rows<f64>, _dt: f64) -> bool {
        let (_, stress) = self.stress(&flow::elastic(gradient, &flow::inelastic(from), &Symmetric::zero()));
        self.hardening.stress(from[9]) < stress
    }

    fn residual<T: Real>(&self, from: &[T; 10], gradient: &Rows<T>, unknowns: &[T; 7], dt: f64) -> [T; 7] {
        let (increment, strain) = (flow::increment(unknowns), unknowns[6]);
        let elastic = flow::elastic(gradient, &flow::inelastic(from), &increment);
        let (deviator, stress) = self.stress(&elastic);
        let [a, b, c, d, e, f] = (increment - deviator * (T::lit(1.5) * strain / stress)).components;
        // σ − σ(α) = η α̇, as a strain: over the yield stress, and free of Δt where that is short.
        let beyond = (stress - self.hardening.stress(from[9] + strain)) * T::lit(1.0 / self.hardening.yield_stress);
        let viscous = strain * T::lit(self.viscosity / self.hardening.yield_stress);
        let scale = if 0.0 < self.viscosity { dt } else { 1.0 };
        let rate = if 0.0 < self.viscosity { beyond * T::lit(scale) - viscous } else { beyond };
        [a, b, c, d, e, f, rate]
    }

    fn updated<T: Real>(&self, from: &[T; 10], _gradient: &Rows<T>, unknowns: &[T; 7], _dt: f64) -> [T; 10] {
        let after = product(flow::exponential(&flow::increment(unknowns)), flow::inelastic(from));
        let mut state = flow::with_inelastic(*from, &after);
        state[9] += unknowns[6];
        state
    }

    fn first_piola<T: Real>(&self, gradient: &Rows<T>, state: &[T; 10]) -> Rows<T> {
        flow::first_piola(&self.elastic, gradient, &flow::inelastic(state))
    }

    fn coordinates<T: Real>(&self, about: &[T; 10], state: &[T; 10]) -> [T; 10] {
        flow::coordinates(about, state)
    }

    fn at_coordinates<T: Real>(&self, about: &[T; 10], coordinates: &[T; 10]) -> [T; 10] {
        flow::at_coordinates(about, coordinates, true)
    }

    fn dissipated(&self, from: &[f64; 10], gradient: &Rows<f64>, state: &[f64; 10]) -> f64 {
        flow::dissipated(&self.elastic, from, gradient, state)
    }

    fn check(&self, gradient: &Rows<f64>, state: &[f64; 10]) -> Result<(), SolidsError> {
        let elastic = flow::elastic(gradient, &flow::inelastic(state), &Symmetric::zero());
        self.elastic.check(&DeformationGradient::trusted(elastic))
    }
}
