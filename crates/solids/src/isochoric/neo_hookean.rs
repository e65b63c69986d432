//! The neo-Hookean energy of a change of shape.

use piola_numerics::Real;

use super::Isochoric;
use piola_numerics::parameters;

parameters! {
    SolidsError;
    /// W̄ = ½ μ (Ī₁ − 3): the network of Gaussian chains.
    ///
    /// | symbol | parameter | unit | bounds |
    /// |---|---|---|---|
    /// | μ | `shear_modulus` | Pa | 0 < μ |
    ///
    /// # Example
    /// ```
    /// use piola_solids::{Hyperelastic, IncompressibleSolid, isochoric::NeoHookean};
    /// use piola_continuum::DeformationGradient;
    /// let rubber = IncompressibleSolid::new(NeoHookean::new(2.0)?);
    /// assert_eq!(rubber.cauchy(&DeformationGradient::simple_shear(0.5)?).0.components[3], 1.0); // μ k
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Source
    /// B(4.66) with C₀₁ = 0.
    pub struct NeoHookean("isochoric neo-Hookean") {
        /// μ, Pa.
        shear_modulus as "mu": "0 < μ" => 0.0 < shear_modulus,
    }
}

/// ½ μ x, over any scalar: parameters may have derivatives too.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn neo_hookean<T: Real>(mu: T, first: T) -> T {
    T::lit(0.5) * mu * first
}

impl Isochoric for NeoHookean {
    const SECOND: bool = false;
    const REFUSED_IS_NOT_FINITE: bool = true;
    const LIMITED: bool = false;
    const STRAIGHT: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, first: T, _second: T) -> T {
        neo_hookean(T::lit(self.shear_modulus), first)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slopes<T: Real>(&self, _first: T, _second: T) -> [T; 2] {
        [T::lit(0.5 * self.shear_modulus), T::zero()]
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn curvatures<T: Real>(&self, _first: T, _second: T) -> [T; 3] {
        [T::zero(); 3]
    }
}
