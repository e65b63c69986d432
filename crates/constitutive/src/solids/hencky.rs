//! Hencky's law: linear between the logarithmic strain and Kirchhoff's stress.

use piola_numerics::Real;

use super::stretch::{StretchEnergy, Volume, hyperelastic_of_stretches};
use crate::ConstitutiveError;
use crate::error::check_bound;

const LAW: &str = "Hencky";

/// Hencky's solid: Hooke's law of the logarithmic strain.
///
/// ```text
/// W = μ tr (ln U)² + ½ λ (tr ln U)²        τ = 2 μ ln V + λ ln J 1
/// ```
///
/// | symbol | parameter | unit | bounds |
/// |---|---|---|---|
/// | λ | `lambda` | Pa | 0 < λ + ⅔ μ (the bulk modulus) |
/// | μ | `mu` | Pa | 0 < μ (the shear modulus) |
///
/// For principal stretches from 0.2116 to e^⅓ = 1.3956 the law is elliptic whatever λ ≥ 0 and μ (Bruhns, Xiao and
/// Meyers, Proc. R. Soc. Lond. A 457 (2001) 2207–2226); beyond it need not be.
///
/// # Accuracy
/// Stresses relative 1e-13 down to ∇u = 1e-16, tangents a few ulp of their norm, for equal and nearly equal stretches too.
///
/// # Example
/// ```
/// use piola_constitutive::solids::{Hencky, Hyperelastic};
/// use piola_continuum::DeformationGradient;
/// let law = Hencky::new(2.0, 1.0)?;
/// let bar = DeformationGradient::diagonal([1.0_f64.exp(), 1.0, 1.0])?;
/// let stress = law.kirchhoff(&bar).0.components;
/// assert!((stress[0] - 4.0).abs() < 1e-15 && (stress[1] - 2.0).abs() < 1e-15); // 2 μ + λ along, λ across
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// H. Hencky, Z. techn. Physik 9 (1928) 215–220.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Written", into = "Written"))]
pub struct Hencky {
    lambda: f64,
    mu: f64,
}

impl Hencky {
    /// From Lamé's constants.
    ///
    /// # Errors
    /// [`ConstitutiveError::NotFinite`], [`ConstitutiveError::OutOfBounds`].
    pub fn new(lambda: f64, mu: f64) -> Result<Self, ConstitutiveError> {
        check_bound(LAW, "mu", mu, "0 < mu", 0.0 < mu)?;
        check_bound(LAW, "lambda", lambda, "0 < lambda + 2/3 mu", 0.0 < lambda + 2.0 / 3.0 * mu)?;
        Ok(Self { lambda, mu })
    }

    /// λ, Pa.
    #[must_use]
    pub const fn lambda(&self) -> f64 {
        self.lambda
    }

    /// μ, Pa.
    #[must_use]
    pub const fn mu(&self) -> f64 {
        self.mu
    }
}

impl StretchEnergy for Hencky {
    const ISOCHORIC: bool = false;

    #[inline(always)]
    fn part<T: Real>(&self, x: T) -> T {
        T::lit(self.mu) * (x * x)
    }
    #[inline(always)]
    fn slope<T: Real>(&self, x: T) -> T {
        T::lit(2.0 * self.mu) * x
    }
    #[inline(always)]
    fn curvature<T: Real>(&self, _x: T) -> T {
        T::lit(2.0 * self.mu)
    }
    #[inline(always)]
    fn secant<T: Real>(&self, _x: T, _y: T) -> T {
        T::lit(2.0 * self.mu)
    }
    #[inline(always)]
    fn volume_energy<T: Real>(&self, volume: &Volume<T>) -> T {
        T::lit(0.5 * self.lambda) * (volume.logarithm * volume.logarithm)
    }
    #[inline(always)]
    fn volume_slope<T: Real>(&self, volume: &Volume<T>) -> T {
        T::lit(self.lambda) * volume.logarithm
    }
    #[inline(always)]
    fn volume_curvature<T: Real>(&self, _volume: &Volume<T>) -> T {
        T::lit(self.lambda)
    }
}

hyperelastic_of_stretches!(Hencky);

/// The parameters as they are written.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    lambda: f64,
    mu: f64,
}

#[cfg(feature = "serde")]
impl TryFrom<Written> for Hencky {
    type Error = ConstitutiveError;

    fn try_from(Written { lambda, mu }: Written) -> Result<Self, ConstitutiveError> {
        Self::new(lambda, mu)
    }
}

#[cfg(feature = "serde")]
impl From<Hencky> for Written {
    fn from(Hencky { lambda, mu }: Hencky) -> Self {
        Self { lambda, mu }
    }
}
