//! The operators L of Lu + f = 0 and their eigenvalues.

use crate::SpectralError;
use crate::error::check_bound;

/// Lamé's parameters of an isotropic linear solid, or the two viscosities of a fluid.
///
/// # Example
/// ```
/// use piola_spectral::LameParameters;
/// let steel = LameParameters::new(121e9, 81e9)?;
/// assert_eq!(steel.longitudinal_modulus(), 283e9);
/// // A Poisson ratio of one quarter: λ = μ.
/// let lame = LameParameters::from_engineering(2.5, 0.25)?;
/// assert_eq!((lame.first(), lame.shear_modulus()), (1.0, 1.0));
/// # Ok::<(), piola_spectral::SpectralError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LameParameters {
    first: f64,
    shear_modulus: f64,
}

impl LameParameters {
    /// λ and μ, Pa (or Pa·s).
    ///
    /// # Errors
    /// λ or μ not finite; 0 < μ or 0 < λ + 2μ violated: the operator would not be elliptic.
    pub fn new(first: f64, shear_modulus: f64) -> Result<Self, SpectralError> {
        check_bound("λ", first, "", true)?;
        check_bound("μ", shear_modulus, "0 < μ", 0.0 < shear_modulus)?;
        let sum = first + 2.0 * shear_modulus;
        check_bound("λ + 2μ", sum, "", true)?;
        if 0.0 < sum {
            Ok(Self { first, shear_modulus })
        } else {
            Err(SpectralError::NotElliptic { first, shear_modulus })
        }
    }

    /// From Young's modulus E and Poisson's ratio ν: λ = Eν/((1 + ν)(1 − 2ν)), μ = E/(2(1 + ν)).
    ///
    /// # Errors
    /// 0 < E or −1 < ν < ½ violated.
    pub fn from_engineering(young_modulus: f64, poisson_ratio: f64) -> Result<Self, SpectralError> {
        check_bound("E", young_modulus, "0 < E", 0.0 < young_modulus)?;
        check_bound("ν", poisson_ratio, "-1 < ν < 1/2", -1.0 < poisson_ratio && poisson_ratio < 0.5)?;
        let shear_modulus = young_modulus / (2.0 * (1.0 + poisson_ratio));
        Self::new(2.0 * shear_modulus * poisson_ratio / (1.0 - 2.0 * poisson_ratio), shear_modulus)
    }

    /// λ.
    #[doc(alias = "lambda")]
    #[must_use]
    pub fn first(&self) -> f64 {
        self.first
    }

    /// μ.
    #[doc(alias = "mu")]
    #[must_use]
    pub fn shear_modulus(&self) -> f64 {
        self.shear_modulus
    }

    /// λ + 2μ.
    #[doc(alias = "P-wave modulus")]
    #[must_use]
    pub fn longitudinal_modulus(&self) -> f64 {
        self.first + 2.0 * self.shear_modulus
    }
}

/// The operator L of Lu + f = 0, with f a force for each unit of volume.
///
/// ```text
///            L u                        −κ of a part along q   −κ of a part across q
/// elastic    μΔu + (λ + μ)∇(∇·u)        (λ + 2μ) q²            μ q²
/// membrane   S Δu                       S q²                   S q²
/// plate      −B Δ²u                     B q⁴                   B q⁴
/// ```
/// q is the wave vector: π times index over side for each axis. A viscous fluid in creeping motion has the operator of an
/// elastic solid, with the velocity in place of the displacement. Membrane and plate act on each component alone.
///
/// # Example
/// ```
/// use piola_spectral::{BoxOperator, LameParameters};
/// let operator = BoxOperator::elastic(LameParameters::new(1.5, 0.75)?);
/// assert_eq!(operator.eigenvalues(2.0), [-6.0, -1.5]);
/// # Ok::<(), piola_spectral::SpectralError>(())
/// ```
///
/// # Source
/// B(4.79), B(4.80), B(4.81), B(4.85), B(4.91). The sign of the plate is that of its energy, not of B(4.81).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoxOperator {
    /// −κ/q^(2·order) along q and across q.
    pub(crate) stiffnesses: [f64; 2],
    /// 1 for Δ, 2 for Δ².
    pub(crate) order: i32,
    pub(crate) lame: Option<LameParameters>,
}

impl BoxOperator {
    /// μΔu + (λ + μ)∇(∇·u): linear elasticity, or the creeping viscous fluid.
    #[must_use]
    pub fn elastic(lame: LameParameters) -> Self {
        let stiffnesses = [lame.longitudinal_modulus(), lame.shear_modulus()];
        Self { stiffnesses, order: 1, lame: Some(lame) }
    }

    /// S Δu: a membrane with tension S.
    ///
    /// # Errors
    /// S not finite, or 0 < S violated.
    pub fn membrane(tension: f64) -> Result<Self, SpectralError> {
        check_bound("tension", tension, "0 < S", 0.0 < tension)?;
        Ok(Self { stiffnesses: [tension; 2], order: 1, lame: None })
    }

    /// −B Δ²u: a thin plate with bending stiffness B, supported so that u or its normal derivative, and then the same of
    /// Δu, vanish at the walls.
    ///
    /// # Errors
    /// B not finite, or 0 < B violated.
    #[doc(alias = "biharmonic")]
    pub fn plate(bending_stiffness: f64) -> Result<Self, SpectralError> {
        check_bound("bending stiffness", bending_stiffness, "0 < B", 0.0 < bending_stiffness)?;
        Ok(Self { stiffnesses: [bending_stiffness; 2], order: 2, lame: None })
    }

    /// The eigenvalues κ of a wave of square wave number q² = `wave_number_squared`, along and across q.
    #[must_use]
    pub fn eigenvalues(&self, wave_number_squared: f64) -> [f64; 2] {
        self.stiffnesses.map(|stiffness| -stiffness * wave_number_squared.powi(self.order))
    }
}
