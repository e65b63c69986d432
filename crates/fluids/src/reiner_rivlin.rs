//! The fluid of Reiner and Rivlin.

use piola_numerics::{Real, parameters};

use super::viscometric::ViscometricFluid;

/// The coefficients g₁ and g₂ of a Reiner–Rivlin fluid, functions of the invariants of D:
/// I = tr D, II = ½ (I² − D : D), III = det D.
pub trait ReinerRivlinCoefficients {
    /// g₁, Pa s.
    #[must_use]
    fn first<T: Real>(&self, invariants: [T; 3]) -> T;
    /// g₂, Pa s².
    #[must_use]
    fn second<T: Real>(&self, invariants: [T; 3]) -> T;
}

parameters! {
    FluidsError;
    /// Coefficients of a Reiner–Rivlin fluid that are constants.
    ///
    /// | symbol | parameter | unit | bounds |
    /// |---|---|---|---|
    /// | g₁ | `linear`; 2 μ of a Newtonian fluid | Pa s | 0 ≤ g₁ |
    /// | g₂ | `quadratic` | Pa s² | finite |
    pub struct ConstantCoefficients("Reiner-Rivlin") {
        /// g₁, Pa s.
        linear: "0 ≤ g₁" => 0.0 <= linear,
        /// g₂, Pa s².
        quadratic: "finite" => true,
    }
}

impl ReinerRivlinCoefficients for ConstantCoefficients {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn first<T: Real>(&self, _invariants: [T; 3]) -> T {
        T::lit(self.linear)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn second<T: Real>(&self, _invariants: [T; 3]) -> T {
        T::lit(self.quadratic)
    }
}

/// The fluid of Reiner and Rivlin: the most general whose stress is a function of the present rate of deformation.
///
/// ```text
/// T = −p 1 + g₁ D + g₂ D²      g₁, g₂ functions of I, II, III of D
/// in shear: τ = g₁ k/2,  σ₁ = σ₂ = g₂ k²/4,  at I = 0, II = −k²/4, III = 0
/// ```
/// A multiple of 1, the third coefficient of W(19.21), is part of the pressure of an incompressible fluid; for fluids with an equation of
/// state see `StokesianFluid` (feature `motions`).
///
/// # Accuracy
/// 4 ulp of each term.
///
/// # Example
/// ```
/// use piola_fluids::{ConstantCoefficients, ReinerRivlin, ViscometricFluid};
/// let fluid = ReinerRivlin(ConstantCoefficients::new(1.5, 0.5)?);
/// assert_eq!((fluid.shear_stress(2.0), fluid.sigma1(2.0), fluid.sigma2(2.0)), (1.5, 0.5, 0.5));
/// # Ok::<(), piola_fluids::FluidsError>(())
/// ```
///
/// # Source
/// W(19.21).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ReinerRivlin<C>(
    /// g₁ and g₂.
    pub C,
);

/// The invariants of D in simple shear.
#[cfg_attr(not(debug_assertions), inline(always))]
fn invariants<T: Real>(shear_rate: T) -> [T; 3] {
    [T::zero(), T::lit(-0.25) * shear_rate * shear_rate, T::zero()]
}

impl<C: ReinerRivlinCoefficients> ViscometricFluid for ReinerRivlin<C> {
    const NAME: &'static str = "Reiner-Rivlin";
    const NORMAL_STRESSES: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn shear_stress<T: Real>(&self, shear_rate: T) -> T {
        T::lit(0.5) * self.0.first(invariants(shear_rate)) * shear_rate
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sigma1<T: Real>(&self, shear_rate: T) -> T {
        T::lit(0.25) * self.0.second(invariants(shear_rate)) * shear_rate * shear_rate
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sigma2<T: Real>(&self, shear_rate: T) -> T {
        self.sigma1(shear_rate)
    }
}
