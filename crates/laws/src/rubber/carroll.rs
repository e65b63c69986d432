//! Carroll's energy.

use piola_numerics::{Real, parameters};
use piola_solids::isochoric::Isochoric;

parameters! {
    SolidsError;
    /// Carroll's energy of a change of shape, W = A (I₁ − 3) + B (I₁⁴ − 81) + C (√I₂ − √3).
    ///
    /// | symbol | parameter | unit | bounds |
    /// |---|---|---|---|
    /// | A | `linear` | Pa | 0 < A + 108 B + C/(2 √3) (half the shear modulus) |
    /// | B | `quartic` | Pa | the same |
    /// | C | `root` | Pa | the same |
    ///
    /// With A, B and C not negative it is convex in F and its cofactors. Here I₁⁴ and √I₂ are written less their values at rest, so that
    /// W is zero there.
    ///
    /// # Accuracy
    /// A few ulp: the differences are divided out.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::DeformationGradient;
    /// use piola_laws::rubber::Carroll;
    /// use piola_solids::{Hyperelastic, IncompressibleSolid};
    /// let rubber = IncompressibleSolid::new(Carroll::new(0.5, 0.25, 2.0)?);
    /// // 2 (A + 4 B I₁³ + C/(2 √I₂)) k with I₁ = I₂ = 4 at k = 1.
    /// let shear: f64 = rubber.cauchy(&DeformationGradient::simple_shear(1.0)?).0.components[3];
    /// assert!((shear - 130.0).abs() < 1e-13);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Source
    /// M. M. Carroll, J. Elasticity 103 (2011) 173–187.
    pub struct Carroll("Carroll") {
        /// A, Pa.
        linear as "a": "0 < A + 108 B + C/(2 √3)" => 0.0 < half_of_shear_modulus(linear, quartic, root),
        /// B, Pa.
        quartic as "b": "0 < A + 108 B + C/(2 √3)" => 0.0 < half_of_shear_modulus(linear, quartic, root),
        /// C, Pa.
        root as "c": "0 < A + 108 B + C/(2 √3)" => 0.0 < half_of_shear_modulus(linear, quartic, root),
    }
}

/// √3.
const ROOT_OF_THREE: f64 = 1.732_050_807_568_877_2;

fn half_of_shear_modulus(linear: f64, quartic: f64, root: f64) -> f64 {
    linear + 108.0 * quartic + root / (2.0 * ROOT_OF_THREE)
}

/// A x + B (I₁⁴ − 81) + C (√I₂ − √3) of x = I₁ − 3 and y = I₂ − 3, over any scalar: parameters may have derivatives too.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn carroll<T: Real>([linear, quartic, root]: [T; 3], first: T, second: T) -> T {
    let three = T::lit(3.0);
    let whole = first + three;
    // I₁⁴ − 81 = x (I₁ + 3)(I₁² + 9), √I₂ − √3 = y/(√I₂ + √3).
    let powers = (whole + three) * (whole * whole + T::lit(9.0));
    let below = (second + three).sqrt() + T::lit(ROOT_OF_THREE);
    first * (linear + quartic * powers) + root * second / below
}

impl Isochoric for Carroll {
    const SECOND: bool = true;
    const REFUSED_IS_NOT_FINITE: bool = true;
    const LIMITED: bool = false;
    const STRAIGHT: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, first: T, second: T) -> T {
        carroll([T::lit(self.linear), T::lit(self.quartic), T::lit(self.root)], first, second)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slopes<T: Real>(&self, first: T, second: T) -> [T; 2] {
        let (one, two) = (first + T::lit(3.0), second + T::lit(3.0));
        let cube = one * one * one;
        [T::lit(self.linear) + T::lit(4.0 * self.quartic) * cube, T::lit(0.5 * self.root) / two.sqrt()]
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn curvatures<T: Real>(&self, first: T, second: T) -> [T; 3] {
        let (one, two) = (first + T::lit(3.0), second + T::lit(3.0));
        let bend = T::lit(-0.25 * self.root) / (two * two.sqrt());
        [T::lit(12.0 * self.quartic) * (one * one), T::zero(), bend]
    }
}
