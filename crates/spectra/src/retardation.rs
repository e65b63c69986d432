//! Retardation spectra: creep in closed form, exact conversion from and to relaxation.

use piola_numerics::Real;

use crate::error::check;
use crate::interlacing::{Axis, Fractions, joined};
use crate::{RelaxationMode, RelaxationSpectrum, SpectraError, kernel};

/// One mode of a retardation spectrum: J (1 − e^(−t/λ)).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RetardationMode {
    /// J, 1/Pa; 0 < J.
    pub compliance: f64,
    /// λ, s; 0 < λ.
    pub retardation_time: f64,
}

/// A discrete retardation spectrum: the generalised Kelvin–Voigt model.
///
/// ```text
/// J(t) = J_g + t/η₀ + Σ Jₖ (1 − e^(−t/λₖ))      t/η₀ only of a liquid
/// ```
/// It is fitted to creep, or converted from a relaxation spectrum; [`RelaxationSpectrum::of`] converts back. Both conversions are exact:
///
/// ```text
/// Q(λ) = Gₑ + Σ gᵢ τᵢ/(τᵢ − λ) = 0 at each λₖ                    Jₖ = 1/Σ gᵢ τᵢ λₖ/(λₖ − τᵢ)²
/// P(τ) = J_g − τ/η₀ + Σ Jₖ τ/(τ − λₖ) = 0 at each τᵢ              gᵢ = 1/(τᵢ/η₀ + Σ Jₖ λₖ τᵢ/(λₖ − τᵢ)²)
/// ```
/// The retardation times lie between the relaxation times, one in each gap. A solid has one more, beyond the longest.
///
/// | symbol | meaning | unit | bounds |
/// |---|---|---|---|
/// | `J_g` | glassy compliance, also called J₀ | 1/Pa | 0 < `J_g` |
/// | 1/η₀ | fluidity | 1/(Pa s) | 0 ≤ 1/η₀; zero for a solid |
/// | Jₖ, λₖ | compliance and retardation time of a mode | 1/Pa, s | 0 < Jₖ, 0 < λₖ |
///
/// # Accuracy
/// Each zero is found by bisection, as its distance from the nearer pole, to the last place that the sum resolves: the times to 2 ulp, the
/// heights as [`RelaxationSpectrum::of`] says. Tests compare with 30 digits. Equal times are joined.
///
/// # Example
/// ```
/// use piola_spectra::{RelaxationMode, RelaxationSpectrum, RetardationSpectrum};
/// // A standard linear solid with Gₑ = g = 1 Pa, τ = 1 s: J(0) = 1/2, J(∞) = 1, λ = τ (Gₑ + g)/Gₑ = 2 s.
/// let solid = RelaxationSpectrum::new(vec![RelaxationMode { modulus: 1.0, relaxation_time: 1.0 }], 1.0)?;
/// let creep = RetardationSpectrum::of(&solid);
/// assert!((creep.modes()[0].retardation_time - 2.0).abs() < 1e-14);
/// assert!((creep.compliance(2.0) - (1.0 - 0.5 * (-1.0_f64).exp())).abs() < 1e-14);
/// let back = RelaxationSpectrum::of(&creep)?;
/// assert!((back.modes()[0].relaxation_time - 1.0).abs() < 1e-14);
/// # Ok::<(), piola_spectra::SpectraError>(())
/// ```
///
/// # Source
/// B. Gross, Mathematical Structure of the Theories of Viscoelasticity, Hermann, Paris, 1953.
#[derive(Clone, Debug, PartialEq)]
pub struct RetardationSpectrum {
    modes: Vec<RetardationMode>,
    glassy_compliance: f64,
    fluidity: f64,
}

impl RetardationSpectrum {
    /// From its modes, in any order, the glassy compliance `J_g`, 1/Pa, and the fluidity 1/η₀, 1/(Pa s). The modes are sorted by
    /// retardation time. There may be none.
    ///
    /// # Errors
    /// [`SpectraError::NotFinite`]; [`SpectraError::OutOfBounds`] unless 0 < Jₖ, 0 < λₖ, 0 < `J_g` and 0 ≤ 1/η₀.
    pub fn new(mut modes: Vec<RetardationMode>, glassy_compliance: f64, fluidity: f64) -> Result<Self, SpectraError> {
        for (index, mode) in modes.iter().enumerate() {
            check("compliance", index, mode.compliance, "0 < J", 0.0 < mode.compliance)?;
            check("retardation time", index, mode.retardation_time, "0 < λ", 0.0 < mode.retardation_time)?;
        }
        check("glassy compliance", 0, glassy_compliance, "0 < J_g", 0.0 < glassy_compliance)?;
        check("fluidity", 0, fluidity, "0 ≤ 1/η₀", 0.0 <= fluidity)?;
        modes.sort_by(|a, b| a.retardation_time.total_cmp(&b.retardation_time));
        Ok(Self { modes, glassy_compliance, fluidity })
    }

    /// Of a relaxation spectrum.
    #[must_use]
    pub fn of(spectrum: &RelaxationSpectrum) -> Self {
        let modes = joined(spectrum.modes().iter().map(|mode| [mode.modulus, mode.relaxation_time]));
        let constant = spectrum.equilibrium_modulus();
        let zeros = Fractions { axis: Axis::Times, modes: &modes, constant, drift: 0.0 }.zeros();
        let mode = |[compliance, retardation_time]: [f64; 2]| RetardationMode { compliance, retardation_time };
        Self {
            modes: zeros.into_iter().map(mode).collect(),
            glassy_compliance: spectrum.glassy_modulus().recip(),
            fluidity: spectrum.zero_shear_viscosity().map_or(0.0, f64::recip),
        }
    }

    /// The modes, from the shortest retardation time to the longest.
    #[must_use]
    pub fn modes(&self) -> &[RetardationMode] {
        &self.modes
    }

    /// `J_g`, 1/Pa: the compliance of fast loads.
    #[must_use]
    pub const fn glassy_compliance(&self) -> f64 {
        self.glassy_compliance
    }

    /// 1/η₀, 1/(Pa s); zero for a solid.
    #[must_use]
    pub const fn fluidity(&self) -> f64 {
        self.fluidity
    }

    /// Creep compliance J(t), 1/Pa, at the time `t`, s, after a step of stress.
    pub fn compliance<T: Real>(&self, t: T) -> T {
        let first = T::lit(self.glassy_compliance) + T::lit(self.fluidity) * t;
        self.modes
            .iter()
            .fold(first, |sum, mode| sum + T::lit(mode.compliance) * kernel::growth(t / T::lit(mode.retardation_time)))
    }
}

impl RelaxationSpectrum {
    /// Of a retardation spectrum, exactly: one mode below the shortest retardation time, one in each gap, and one more, beyond the
    /// longest, of a liquid.
    ///
    /// # Errors
    /// [`SpectraError::OutOfBounds`] of a solid without retardation modes, which does not relax; [`SpectraError::NotFinite`] where a
    /// modulus overflows.
    ///
    /// # Accuracy
    /// Times: 2 ulp. Moduli and compliances: 4 ulp times the condition of the zero, Σ|terms| over F′ and the distance from the nearest
    /// pole. That is some units, unless a mode is much weaker than its neighbours, where the data leave no more digits.
    ///
    /// # Example
    /// ```
    /// use piola_spectra::{RelaxationSpectrum, RetardationSpectrum};
    /// // J = 1/2 + t/4: Maxwell's fluid with g = 2 Pa and η = 4 Pa s.
    /// let fluid = RelaxationSpectrum::of(&RetardationSpectrum::new(vec![], 0.5, 0.25)?)?;
    /// assert_eq!((fluid.modes()[0].modulus, fluid.modes()[0].relaxation_time), (2.0, 2.0));
    /// # Ok::<(), piola_spectra::SpectraError>(())
    /// ```
    pub fn of(creep: &RetardationSpectrum) -> Result<Self, SpectraError> {
        // The poles 1/λ rise where the times fall.
        let pairs = creep.modes.iter().map(|mode| [mode.compliance, mode.retardation_time]);
        let mut modes = joined(pairs);
        modes.reverse();
        let (constant, drift) = (creep.glassy_compliance, creep.fluidity);
        let zeros = Fractions { axis: Axis::Rates, modes: &modes, constant, drift }.zeros();
        let mode = |[modulus, relaxation_time]: [f64; 2]| RelaxationMode { modulus, relaxation_time };
        let resting = modes.iter().fold(constant, |sum, mode| sum + mode[0]).recip();
        Self::new(zeros.into_iter().map(mode).collect(), if 0.0 < drift { 0.0 } else { resting })
    }
}
