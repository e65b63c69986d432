//! The Mooney–Rivlin energy of a change of shape.

use piola_numerics::Real;

use super::Isochoric;
use piola_numerics::parameters;

parameters! {
    SolidsError;
    /// W̄ = C₁₀ (Ī₁ − 3) + C₀₁ (Ī₂ − 3).
    ///
    /// | symbol | parameter | unit | bounds |
    /// |---|---|---|---|
    /// | C₁₀, C₀₁ | `c10`, `c01` | Pa | 0 < C₁₀ + C₀₁ (half the shear modulus) |
    ///
    /// # Example
    /// ```
    /// use piola_solids::{Hyperelastic, IncompressibleSolid, isochoric::MooneyRivlin};
    /// use piola_continuum::DeformationGradient;
    /// let rubber = IncompressibleSolid::new(MooneyRivlin::new(0.5, 0.25)?).at_pressure(0.0)?;
    /// let stress = rubber.cauchy(&DeformationGradient::simple_shear(1.0)?).0.components;
    /// assert_eq!(stress[3], 1.5); // 2 (C₁₀ + C₀₁) k
    /// assert_eq!(stress[2], 0.5); // 2 C₁₀ − 2 C₀₁
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Source
    /// B(4.66).
    pub struct MooneyRivlin("isochoric Mooney–Rivlin") {
        /// C₁₀, Pa.
        c10: "0 < C10 + C01" => 0.0 < c10 + c01,
        /// C₀₁, Pa.
        c01: "0 < C10 + C01" => 0.0 < c10 + c01,
    }
}

/// C₁₀ x + C₀₁ y, over any scalar: parameters may have derivatives too.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn mooney_rivlin<T: Real>([c10, c01]: [T; 2], first: T, second: T) -> T {
    c10 * first + c01 * second
}

impl Isochoric for MooneyRivlin {
    const SECOND: bool = true;
    const REFUSED_IS_NOT_FINITE: bool = true;
    const LIMITED: bool = false;
    const STRAIGHT: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, first: T, second: T) -> T {
        mooney_rivlin([self.c10, self.c01].map(T::lit), first, second)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slopes<T: Real>(&self, _first: T, _second: T) -> [T; 2] {
        [T::lit(self.c10), T::lit(self.c01)]
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn curvatures<T: Real>(&self, _first: T, _second: T) -> [T; 3] {
        [T::zero(); 3]
    }
}
