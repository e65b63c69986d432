//! Yeoh's energy of a change of shape.

use piola_numerics::Real;

use super::Isochoric;
use piola_numerics::parameters;

parameters! {
    SolidsError;
    /// W̄ = C₁ x + C₂ x² + C₃ x³ with x = Ī₁ − 3: one set of numbers for all modes of rubber with filler.
    ///
    /// | symbol | parameter | unit | bounds |
    /// |---|---|---|---|
    /// | C₁ | `c1` | Pa | 0 < C₁ (half the shear modulus) |
    /// | C₂, C₃ | `c2`, `c3` | Pa | –; C₂ is mostly negative |
    ///
    /// # Example
    /// ```
    /// use piola_solids::{Hyperelastic, IncompressibleSolid, isochoric::Yeoh};
    /// use piola_continuum::DeformationGradient;
    /// let rubber = IncompressibleSolid::new(Yeoh::new(1.0, -0.25, 0.5)?);
    /// // 2 k (C₁ + 2 C₂ k² + 3 C₃ k⁴) at k = 1.
    /// assert_eq!(rubber.cauchy(&DeformationGradient::simple_shear(1.0)?).0.components[3], 4.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Source
    /// B(4.63) in Ī₁ alone; Yeoh 1993.
    pub struct Yeoh("Yeoh") {
        /// C₁, Pa.
        c1: "0 < C1" => 0.0 < c1,
        /// C₂, Pa.
        c2: "finite" => true,
        /// C₃, Pa.
        c3: "finite" => true,
    }
}

/// C₁ x + C₂ x² + C₃ x³, over any scalar: parameters may have derivatives too.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn yeoh<T: Real>([c1, c2, c3]: [T; 3], first: T) -> T {
    first * (c1 + first * (c2 + first * c3))
}

impl Isochoric for Yeoh {
    const SECOND: bool = false;
    const REFUSED_IS_NOT_FINITE: bool = true;
    const LIMITED: bool = false;
    const STRAIGHT: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, first: T, _second: T) -> T {
        yeoh([self.c1, self.c2, self.c3].map(T::lit), first)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slopes<T: Real>(&self, first: T, _second: T) -> [T; 2] {
        let beyond = first * (T::lit(2.0 * self.c2) + first * T::lit(3.0 * self.c3));
        [T::lit(self.c1) + beyond, T::zero()]
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn curvatures<T: Real>(&self, first: T, _second: T) -> [T; 3] {
        [T::lit(2.0 * self.c2) + first * T::lit(6.0 * self.c3), T::zero(), T::zero()]
    }
}
