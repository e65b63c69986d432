//! The compressible neo-Hookean solid that is coupled: I₁ itself, not that of the change of shape.

use piola_continuum::Deformation;
use piola_numerics::Real;

use super::invariant::{Curvatures, InvariantEnergy, Invariants, Slopes, first_excess, hyperelastic_of_invariants};
use super::volumetric::{Logarithmic, SimoTaylor, Volumetric};
use crate::SolidsError;
use crate::error::check_bound;

const LAW: &str = "neo-Hookean";

/// The coupled neo-Hookean solid, with any energy of the change of volume.
///
/// ```text
/// W = ½ μ (I₁ − 3) − μ ln J + U(J)        T = J⁻¹ [μ (B − 1) + J U′ 1]        U″(1) = λ
/// ```
/// | name | U | source |
/// |---|---|---|
/// | [`NeoHookeanLogarithmic`] | ½ λ ln² J | Simo & Pister 1984; the form of most finite-element texts |
/// | [`NeoHookeanCiarlet`] | ¼ λ (J² − 1 − 2 ln J) | Ciarlet 1988: polyconvex |
/// | [`NeoHookeanIsochoric`](super::NeoHookeanIsochoric) | | W̄ = ½ μ (Ī₁ − 3) and ½ κ (J − 1)²: not this type |
///
/// | symbol | parameter | unit | bounds |
/// |---|---|---|---|
/// | μ | `shear_modulus` | Pa | 0 < μ |
/// | λ | U″(1) of `volumetric` | Pa | 0 < λ + ⅔ μ (the bulk modulus) |
///
/// At small strain it is Hooke's law with Lamé's constants λ and μ.
///
/// # Accuracy
/// P, S, τ relative 1e-13 down to ∇u = 1e-16; tangents a few ulp of their norm.
///
/// # Example
/// ```
/// use piola_solids::{Hyperelastic, NeoHookeanLogarithmic};
/// use piola_continuum::DeformationGradient;
/// let solid = NeoHookeanLogarithmic::with_constants(0.75, 1.5)?;
/// let stress = solid.kirchhoff(&DeformationGradient::diagonal([2.0, 1.0, 1.0])?).0;
/// assert_eq!(stress.components[1], 1.5 * 2.0_f64.ln()); // λ ln J
/// assert_eq!(stress.components[0], 1.5 * 2.0_f64.ln() + 2.25); // and μ (λ₁² − 1)
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// B(4.65) with C₀₁ = 0 and another Γ.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "Written<U>", bound(deserialize = "U: Volumetric + serde::Deserialize<'de>"))
)]
pub struct NeoHookean<U> {
    shear_modulus: f64,
    volumetric: U,
}

/// W = ½ μ (I₁ − 3) − μ ln J + ½ λ ln² J.
pub type NeoHookeanLogarithmic = NeoHookean<Logarithmic>;

/// W = ½ μ (I₁ − 3) − μ ln J + ¼ λ (J² − 1 − 2 ln J).
pub type NeoHookeanCiarlet = NeoHookean<SimoTaylor>;

impl<U: Volumetric> NeoHookean<U> {
    /// With μ, Pa, and U.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`], [`SolidsError::OutOfBounds`].
    pub fn new(shear_modulus: f64, volumetric: U) -> Result<Self, SolidsError> {
        check_bound(LAW, "shear_modulus", shear_modulus, "0 < μ", 0.0 < shear_modulus)?;
        let lambda = volumetric.bulk_modulus();
        check_bound(LAW, "U″(1)", lambda, "0 < U″(1) + ⅔ μ", 0.0 < lambda + 2.0 / 3.0 * shear_modulus)?;
        Ok(Self { shear_modulus, volumetric })
    }

    /// The same with U in another form.
    pub(super) fn map<V>(self, volumetric: impl FnOnce(U) -> V) -> NeoHookean<V> {
        NeoHookean { shear_modulus: self.shear_modulus, volumetric: volumetric(self.volumetric) }
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

impl NeoHookeanLogarithmic {
    /// With μ and λ, Pa.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn with_constants(shear_modulus: f64, first_lame_parameter: f64) -> Result<Self, SolidsError> {
        Self::new(shear_modulus, Logarithmic::new(first_lame_parameter)?)
    }
}

impl NeoHookeanCiarlet {
    /// With μ and λ, Pa.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn with_constants(shear_modulus: f64, first_lame_parameter: f64) -> Result<Self, SolidsError> {
        Self::new(shear_modulus, SimoTaylor::new(first_lame_parameter)?)
    }
}

impl<U: Volumetric> InvariantEnergy for NeoHookean<U> {
    const SECOND: bool = false;
    const CURVED: bool = false;
    const STRAIGHT: bool = U::STRAIGHT;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        T::lit(0.5 * self.shear_modulus) * first_excess(deformation)
            + self.volumetric.energy(deformation.volume_change(), deformation.jacobian())
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slopes<T: Real>(&self, invariants: &Invariants<T>) -> Slopes<T> {
        let residual = self.volumetric.mean_kirchhoff(invariants.change, invariants.jacobian);
        Slopes {
            first: T::lit(0.5 * self.shear_modulus),
            second: T::zero(),
            residual,
            volume: residual - T::lit(self.shear_modulus),
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn curvatures<T: Real>(&self, invariants: &Invariants<T>) -> Curvatures<T> {
        let reciprocal = invariants.jacobian.recip();
        let volume = self.volumetric.curvature(invariants.change, invariants.jacobian);
        Curvatures::of_volume(T::lit(self.shear_modulus) * (reciprocal * reciprocal) + volume)
    }
}

hyperelastic_of_invariants!([U: Volumetric] NeoHookean<U>);

read_with!(new of NeoHookean<U: Volumetric> { shear_modulus as "mu": f64, volumetric: U });
