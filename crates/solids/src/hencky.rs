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
/// | λ | `first_lame_parameter`, U″(1) of `volumetric` | Pa | 0 < λ + ⅔ μ (the bulk modulus) |
/// | μ | `shear_modulus` | Pa | 0 < μ (the shear modulus) |
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
#[cfg_attr(
    feature = "serde",
    serde(try_from = "Written<U>", bound(deserialize = "U: Volumetric + serde::Deserialize<'de>"))
)]
pub struct Hencky<U = Lame> {
    shear_modulus: f64,
    volumetric: U,
}

impl Hencky {
    /// From Lamé's constants.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`], [`SolidsError::OutOfBounds`].
    pub fn new(first_lame_parameter: f64, shear_modulus: f64) -> Result<Self, SolidsError> {
        let (lambda, mu) = (first_lame_parameter, shear_modulus);
        check_bound(LAW, "shear_modulus", mu, "0 < μ", 0.0 < mu)?;
        check_bound(LAW, "first_lame_parameter", lambda, "0 < λ + ⅔ μ", 0.0 < lambda + 2.0 / 3.0 * mu)?;
        Ok(Self { shear_modulus, volumetric: Lame::new(lambda)? })
    }

    /// λ, Pa.
    #[doc(alias = "lambda")]
    #[must_use]
    pub const fn first_lame_parameter(&self) -> f64 {
        self.volumetric.first_lame_parameter()
    }
}

impl<U: Volumetric> Hencky<U> {
    /// With μ, Pa, and any U.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`], [`SolidsError::OutOfBounds`].
    pub fn with_volumetric(shear_modulus: f64, volumetric: U) -> Result<Self, SolidsError> {
        check_bound(LAW, "shear_modulus", shear_modulus, "0 < μ", 0.0 < shear_modulus)?;
        let lambda = volumetric.bulk_modulus();
        check_bound(LAW, "U″(1)", lambda, "0 < U″(1) + ⅔ μ", 0.0 < lambda + 2.0 / 3.0 * shear_modulus)?;
        Ok(Self { shear_modulus, volumetric })
    }

    /// The same with U in another form.
    pub(super) fn map<V>(self, volumetric: impl FnOnce(U) -> V) -> Hencky<V> {
        Hencky { shear_modulus: self.shear_modulus, volumetric: volumetric(self.volumetric) }
    }

    /// μ, Pa.
    #[doc(alias = "mu")]
    #[must_use]
    pub const fn shear_modulus(&self) -> f64 {
        self.shear_modulus
    }

    /// U.
    #[must_use]
    pub const fn volumetric(&self) -> &U {
        &self.volumetric
    }
}

impl<U: Volumetric> StretchEnergy for Hencky<U> {
    const ISOCHORIC: bool = false;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn part<T: Real>(&self, x: T) -> T {
        T::lit(self.shear_modulus) * (x * x)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slope<T: Real>(&self, x: T) -> T {
        T::lit(2.0 * self.shear_modulus) * x
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn curvature<T: Real>(&self, _x: T) -> T {
        T::lit(2.0 * self.shear_modulus)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn secant<T: Real>(&self, _x: T, _y: T) -> T {
        T::lit(2.0 * self.shear_modulus)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn volume_energy<T: Real>(&self, volume: &Volume<T>) -> T {
        self.volumetric.energy(volume.change, volume.jacobian)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn volume_slope<T: Real>(&self, volume: &Volume<T>) -> T {
        self.volumetric.mean_kirchhoff(volume.change, volume.jacobian)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn volume_curvature<T: Real>(&self, volume: &Volume<T>) -> T {
        self.volumetric.stiffness(volume.change, volume.jacobian)
    }
}

hyperelastic_of_stretches!([U: Volumetric] Hencky<U>);

read_with!(with_volumetric of Hencky<U: Volumetric> { shear_modulus as "mu": f64, volumetric: U });
