//! Ogden's incompressible solid.

use piola_continuum::Deformation;
use piola_numerics::Real;

use super::terms::{Series, parts_of_series};
use super::{OgdenTerm, StretchEnergy, Volume, hyperelastic_of_stretches};
use crate::SolidsError;
use crate::error::check_finite;
use crate::incompressible::{Pressure, check_volume};

const LAW: &str = "incompressible Ogden";

/// Ogden's incompressible solid, its pressure given.
///
/// ```text
/// T = Σₚ μₚ V^αₚ − p 1,   det F = 1        p = q + Σₚ μₚ
/// ```
/// As a [`Hyperelastic`](crate::Hyperelastic) law it has the energy Σₚ μₚ/αₚ (λ₁^αₚ + λ₂^αₚ + λ₃^αₚ − 3) − p (J − 1), or
/// the same less (Σₚ μₚ) ln J + q (J − 1), so that stress and tangent are derivatives at a fixed p or q. To have the
/// pressure from a condition such as a free face see `piola_specimens::homogeneous`.
///
/// | symbol | parameter | unit | bounds |
/// |---|---|---|---|
/// | μₚ, αₚ | `terms`, 1 to 8 of them | Pa, – | αₚ ≠ 0, 0 < ½ Σ μₚ αₚ |
/// | p, q | `pressure` | Pa | – |
///
/// # Accuracy
/// With an excess pressure P, S, τ relative 1e-13 down to ∇u = 1e-16; with a whole pressure a few ulp of p and of the moduli.
///
/// # Errors
/// `check` refuses 1e-6 ≤ |J − 1| and powers beyond the range of the scalar.
///
/// # Example
/// ```
/// use piola_solids::{Hyperelastic, IncompressibleOgden, OgdenTerm};
/// use piola_continuum::DeformationGradient;
/// let rubber = IncompressibleOgden::new(&[OgdenTerm { modulus: 2.0, exponent: 2.0 }])?;
/// let bar = rubber.cauchy(&DeformationGradient::diagonal([4.0, 0.5, 0.5])?).0.components;
/// assert!((bar[0] - bar[1] - 31.5_f64).abs() < 1e-13); // μ (λ^α − λ^(−α/2))
/// let sheared = rubber.at_pressure(0.5)?.cauchy(&DeformationGradient::simple_shear(1.0)?).0.components;
/// assert!((sheared[2] - 1.5_f64).abs() < 1e-15); // μ − p
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// R. W. Ogden, Proc. R. Soc. Lond. A 326 (1972) 565–584.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Written", into = "Written"))]
pub struct IncompressibleOgden {
    series: Series,
    pressure: Pressure,
    /// Σₚ μₚ.
    moduli: f64,
}

impl IncompressibleOgden {
    /// Without excess pressure: the reference is free of stress.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`], [`SolidsError::OutOfBounds`].
    pub fn new(terms: &[OgdenTerm]) -> Result<Self, SolidsError> {
        let series = Series::new(LAW, terms)?;
        Ok(Self { series, pressure: Pressure::Excess(0.0), moduli: series.moduli() })
    }

    /// At the pressure p of T = Σₚ μₚ V^αₚ − p 1, Pa.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`].
    pub fn at_pressure(self, pressure: f64) -> Result<Self, SolidsError> {
        check_finite(LAW, "p", pressure)?;
        Ok(Self { pressure: Pressure::Whole(pressure), ..self })
    }

    /// At the pressure q beyond that of a body at rest, Pa.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`].
    pub fn at_excess_pressure(self, excess: f64) -> Result<Self, SolidsError> {
        check_finite(LAW, "q", excess)?;
        Ok(Self { pressure: Pressure::Excess(excess), ..self })
    }

    /// The terms.
    #[must_use]
    pub fn terms(&self) -> &[OgdenTerm] {
        self.series.terms()
    }

    /// p or q, Pa.
    #[must_use]
    pub const fn pressure(&self) -> Pressure {
        self.pressure
    }

    /// The shear modulus ½ Σ μₚ αₚ, Pa.
    #[must_use]
    pub fn shear_modulus(&self) -> f64 {
        self.series.shear_modulus()
    }
}

/// U = −q (J − 1), or (Σₚ μₚ) ln J − p (J − 1), beside the series, which has −(Σₚ μₚ) ln J.
impl StretchEnergy for IncompressibleOgden {
    const ISOCHORIC: bool = false;
    parts_of_series!();

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn check<T: Real>(&self, deformation: &impl Deformation<T>) -> Result<(), SolidsError> {
        check_volume(LAW, deformation)?;
        self.series.check(LAW, deformation, false)
    }
    fn is_incompressible(&self) -> bool {
        true
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn volume_energy<T: Real>(&self, volume: &Volume<T>) -> T {
        match self.pressure {
            Pressure::Excess(q) => -(T::lit(q) * volume.change),
            Pressure::Whole(p) => T::lit(self.moduli) * volume.logarithm - T::lit(p) * volume.change,
        }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn volume_slope<T: Real>(&self, volume: &Volume<T>) -> T {
        match self.pressure {
            Pressure::Excess(q) => -(T::lit(q) * volume.jacobian),
            Pressure::Whole(p) => (T::lit(self.moduli) - T::lit(p)) - T::lit(p) * volume.change,
        }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn volume_curvature<T: Real>(&self, volume: &Volume<T>) -> T {
        let (Pressure::Excess(pressure) | Pressure::Whole(pressure)) = self.pressure;
        -(T::lit(pressure) * volume.jacobian)
    }
}

hyperelastic_of_stretches!([] IncompressibleOgden);

/// The parameters as they are written.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    terms: Vec<OgdenTerm>,
    #[serde(default)]
    pressure: Pressure,
}

#[cfg(feature = "serde")]
impl TryFrom<Written> for IncompressibleOgden {
    type Error = SolidsError;

    fn try_from(Written { terms, pressure }: Written) -> Result<Self, SolidsError> {
        let law = Self::new(&terms)?;
        match pressure {
            Pressure::Excess(excess) => law.at_excess_pressure(excess),
            Pressure::Whole(whole) => law.at_pressure(whole),
        }
    }
}

#[cfg(feature = "serde")]
impl From<IncompressibleOgden> for Written {
    fn from(law: IncompressibleOgden) -> Self {
        Self { terms: law.terms().to_vec(), pressure: law.pressure }
    }
}
