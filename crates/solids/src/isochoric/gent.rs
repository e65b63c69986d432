//! Gent's energy of a change of shape.

use piola_numerics::Real;

use super::Isochoric;
use crate::SolidsError;
use crate::exponent_range::{check_below, within};
use piola_numerics::parameters;

parameters! {
    SolidsError;
    /// W̄ = −½ μ Jₘ ln(1 − (Ī₁ − 3)/Jₘ): a network whose chains can be stretched so far and no further.
    ///
    /// | symbol | parameter | unit | bounds |
    /// |---|---|---|---|
    /// | μ | `shear_modulus` | Pa | 0 < μ |
    /// | Jₘ | `limit` | 1 | 0 < Jₘ; Ī₁ − 3 stays below it |
    ///
    /// # Errors
    /// `check` refuses Jₘ ≤ Ī₁ − 3; without it energy, stresses and tangents are NaN there.
    ///
    /// # Example
    /// ```
    /// use piola_solids::SolidsError;
    /// use piola_solids::{Hyperelastic, IncompressibleSolid, isochoric::Gent};
    /// use piola_continuum::DeformationGradient;
    /// let rubber = IncompressibleSolid::new(Gent::new(2.0, 4.0)?);
    /// // μ k/(1 − k²/Jₘ) at k = 1.
    /// let shear: f64 = rubber.cauchy(&DeformationGradient::simple_shear(1.0)?).0.components[3];
    /// assert!((shear - 2.0 / 0.75).abs() < 1e-15);
    /// let torn = rubber.check(&DeformationGradient::simple_shear(2.0)?);
    /// assert!(matches!(torn, Err(SolidsError::BeyondLimit { value: 4.0, limit: 4.0, .. })));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Source
    /// Gent 1996.
    pub struct Gent("Gent") {
        /// μ, Pa.
        shear_modulus as "mu": "0 < μ" => 0.0 < shear_modulus,
        /// Jₘ.
        limit: "0 < Jm" => 0.0 < limit,
    }
}

/// −½ μ Jₘ ln(1 − x/Jₘ), over any scalar: parameters may have derivatives too.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn gent<T: Real>(mu: T, limit: T, first: T) -> T {
    within(first, limit, T::lit(-0.5) * mu * limit * (-first / limit).ln_1p())
}

impl Isochoric for Gent {
    const SECOND: bool = false;
    const REFUSED_IS_NOT_FINITE: bool = true;
    const STRAIGHT: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, first: T, _second: T) -> T {
        gent(T::lit(self.shear_modulus), T::lit(self.limit), first)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slopes<T: Real>(&self, first: T, _second: T) -> [T; 2] {
        let slope = T::lit(0.5 * self.shear_modulus * self.limit) / (T::lit(self.limit) - first);
        [within(first, T::lit(self.limit), slope), T::zero()]
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn curvatures<T: Real>(&self, first: T, _second: T) -> [T; 3] {
        let reciprocal = (T::lit(self.limit) - first).recip();
        let curvature = T::lit(0.5 * self.shear_modulus * self.limit) * (reciprocal * reciprocal);
        [within(first, T::lit(self.limit), curvature), T::zero(), T::zero()]
    }

    fn check(&self, first: f64, _second: f64) -> Result<(), SolidsError> {
        check_below(Self::NAME, "I1 − 3", first, self.limit)
    }
}
