//! Hencky's law: linear between the logarithmic strain and Kirchhoff's stress.

use piola_numerics::Real;

use super::stretch::{StretchEnergy, Volume, hyperelastic_of_stretches};
use super::volumetric::{Lame, Volumetric};
use crate::SolidsError;
use crate::error::check_bound;

const LAW: &str = "Hencky";

/// Hencky's solid: Hooke's law of the logarithmic strain, with any energy of the change of volume.
///
/// ```text
/// W = μ tr (ln U)² + U(J)        τ = 2 μ ln V + J U′ 1        U = ½ λ (ln J)² unless another is chosen
/// ```
///
/// | symbol | parameter | unit | bounds |
/// |---|---|---|---|
/// | λ | `lambda`, U″(1) of `volumetric` | Pa | 0 < λ + ⅔ μ (the bulk modulus) |
/// | μ | `mu` | Pa | 0 < μ (the shear modulus) |
///
/// With U = ½ λ (ln J)², for principal stretches from 0.2116 to e^⅓ = 1.3956 the law is elliptic whatever λ ≥ 0 and μ (Bruhns,
/// Xiao and Meyers, Proc. R. Soc. Lond. A 457 (2001) 2207–2226); beyond it need not be.
///
/// # Accuracy
/// Stresses relative 1e-13 down to ∇u = 1e-16, tangents a few ulp of their norm, for equal and nearly equal stretches too.
///
/// # Example
/// ```
/// use piola_solids::{Hencky, Hyperelastic, volumetric::Miehe};
/// use piola_continuum::DeformationGradient;
/// let law = Hencky::new(2.0, 1.0)?;
/// let bar = DeformationGradient::diagonal([1.0_f64.exp(), 1.0, 1.0])?;
/// let stress = law.kirchhoff(&bar).0.components;
/// assert!((stress[0] - 4.0).abs() < 1e-15 && (stress[1] - 2.0).abs() < 1e-15); // 2 μ + λ along, λ across
/// let other = Hencky::with_volumetric(1.0, Miehe::new(2.0)?)?;
/// let across = other.kirchhoff(&bar).0.components[1];
/// assert!((across - 2.0 * (1.0_f64.exp() - 1.0)).abs() < 1e-15); // λ (J − 1)
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// H. Hencky, Z. techn. Physik 9 (1928) 215–220.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Written<U>", into = "Written<U>"))]
#[cfg_attr(
    feature = "serde",
    serde(bound(
        serialize = "U: Volumetric + Clone + serde::Serialize",
        deserialize = "U: Volumetric + serde::Deserialize<'de>"
    ))
)]
pub struct Hencky<U = Lame> {
    mu: f64,
    volumetric: U,
}

impl Hencky {
    /// From Lamé's constants.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`], [`SolidsError::OutOfBounds`].
    pub fn new(lambda: f64, mu: f64) -> Result<Self, SolidsError> {
        check_bound(LAW, "mu", mu, "0 < mu", 0.0 < mu)?;
        check_bound(LAW, "lambda", lambda, "0 < lambda + 2/3 mu", 0.0 < lambda + 2.0 / 3.0 * mu)?;
        Ok(Self { mu, volumetric: Lame::new(lambda)? })
    }

    /// λ, Pa.
    #[must_use]
    pub const fn lambda(&self) -> f64 {
        self.volumetric.lambda()
    }
}

impl<U: Volumetric> Hencky<U> {
    /// With μ, Pa, and any U.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`], [`SolidsError::OutOfBounds`].
    pub fn with_volumetric(mu: f64, volumetric: U) -> Result<Self, SolidsError> {
        check_bound(LAW, "mu", mu, "0 < mu", 0.0 < mu)?;
        let lambda = volumetric.bulk_modulus();
        check_bound(LAW, "U″(1)", lambda, "0 < U″(1) + 2/3 mu", 0.0 < lambda + 2.0 / 3.0 * mu)?;
        Ok(Self { mu, volumetric })
    }

    /// The same with U in another form.
    pub(super) fn map<V>(self, volumetric: impl FnOnce(U) -> V) -> Hencky<V> {
        Hencky { mu: self.mu, volumetric: volumetric(self.volumetric) }
    }

    /// μ, Pa.
    #[must_use]
    pub const fn mu(&self) -> f64 {
        self.mu
    }

    /// U.
    #[must_use]
    pub const fn volumetric(&self) -> &U {
        &self.volumetric
    }
}

impl<U: Volumetric> StretchEnergy for Hencky<U> {
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
        self.volumetric.energy(volume.change, volume.jacobian)
    }
    #[inline(always)]
    fn volume_slope<T: Real>(&self, volume: &Volume<T>) -> T {
        self.volumetric.mean_kirchhoff(volume.change, volume.jacobian)
    }
    #[inline(always)]
    fn volume_curvature<T: Real>(&self, volume: &Volume<T>) -> T {
        self.volumetric.stiffness(volume.change, volume.jacobian)
    }
}

hyperelastic_of_stretches!([U: Volumetric] Hencky<U>);

/// The parameters as they are written.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Written<U> {
    mu: f64,
    volumetric: U,
}

#[cfg(feature = "serde")]
impl<U: Volumetric> TryFrom<Written<U>> for Hencky<U> {
    type Error = SolidsError;

    fn try_from(Written { mu, volumetric }: Written<U>) -> Result<Self, SolidsError> {
        Self::with_volumetric(mu, volumetric)
    }
}

#[cfg(feature = "serde")]
impl<U> From<Hencky<U>> for Written<U> {
    fn from(Hencky { mu, volumetric }: Hencky<U>) -> Self {
        Self { mu, volumetric }
    }
}
