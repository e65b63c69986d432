//! The energy of Lopez-Pamies.

use piola_numerics::{Real, parameters};
use piola_solids::isochoric::Isochoric;

parameters! {
    SolidsError;
    /// The energy of Lopez-Pamies with two terms, of I₁ alone.
    ///
    /// ```text
    /// W = Σ 3^(1−αᵣ)/(2 αᵣ) μᵣ (I₁^αᵣ − 3^αᵣ)      ∂W/∂I₁ = ½ Σ μᵣ (I₁/3)^(αᵣ − 1)      r = 1, 2
    /// ```
    /// The shear modulus of the reference is μ₁ + μ₂. A term with α = 1 is neo-Hookean. With 0 ≤ μᵣ and ½ ≤ αᵣ it is convex in F.
    ///
    /// | symbol | parameter | unit | bounds |
    /// |---|---|---|---|
    /// | μ₁, μ₂ | `first_modulus`, `second_modulus` | Pa | 0 < μ₁ + μ₂ |
    /// | α₁, α₂ | `first_exponent`, `second_exponent` | 1 | not 0 |
    ///
    /// # Accuracy
    /// A few ulp × max(1, |α| ln(I₁/3)), for small strain too.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::DeformationGradient;
    /// use piola_laws::rubber::LopezPamies;
    /// use piola_solids::{Hyperelastic, IncompressibleSolid};
    /// let rubber = IncompressibleSolid::new(LopezPamies::new(2.0, 1.0, 1.0, 2.0)?);
    /// // (μ₁ + μ₂ I₁/3) k with I₁ = 4 at k = 1.
    /// let shear: f64 = rubber.cauchy(&DeformationGradient::simple_shear(1.0)?).0.components[3];
    /// assert!((shear - 10.0 / 3.0).abs() < 1e-14);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Source
    /// O. Lopez-Pamies, C. R. Mécanique 338 (2010) 3–11.
    pub struct LopezPamies("Lopez-Pamies") {
        /// μ₁, Pa.
        first_modulus as "mu1": "0 < μ1 + μ2" => 0.0 < first_modulus + second_modulus,
        /// α₁.
        first_exponent as "alpha1": "α1 ≠ 0" => 0.0 < first_exponent.abs(),
        /// μ₂, Pa.
        second_modulus as "mu2": "0 < μ1 + μ2" => 0.0 < first_modulus + second_modulus,
        /// α₂.
        second_exponent as "alpha2": "α2 ≠ 0" => 0.0 < second_exponent.abs(),
    }
}

/// 3^(1−α)/(2α) μ (I₁^α − 3^α) of x = I₁ − 3, over any scalar: parameters may have derivatives too.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn lopez_pamies_term<T: Real>(modulus: T, exponent: T, first: T) -> T {
    let logarithm = (first * T::lit(1.0 / 3.0)).ln_1p();
    T::lit(1.5) * modulus / exponent * (exponent * logarithm).exp_m1()
}

impl LopezPamies {
    /// μᵣ and αᵣ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    const fn terms(&self) -> [[f64; 2]; 2] {
        [[self.first_modulus, self.first_exponent], [self.second_modulus, self.second_exponent]]
    }
}

impl Isochoric for LopezPamies {
    const SECOND: bool = false;
    const REFUSED_IS_NOT_FINITE: bool = true;
    const LIMITED: bool = false;
    const STRAIGHT: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, first: T, _second: T) -> T {
        let [[mu, alpha], [nu, beta]] = self.terms();
        lopez_pamies_term(T::lit(mu), T::lit(alpha), first) + lopez_pamies_term(T::lit(nu), T::lit(beta), first)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slopes<T: Real>(&self, first: T, second: T) -> [T; 2] {
        self.slopes_and_curvatures(first, second).0
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn curvatures<T: Real>(&self, first: T, second: T) -> [T; 3] {
        self.slopes_and_curvatures(first, second).1
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slopes_and_curvatures<T: Real>(&self, first: T, _second: T) -> ([T; 2], [T; 3]) {
        let logarithm = (first * T::lit(1.0 / 3.0)).ln_1p();
        let below = (first + T::lit(3.0)).recip();
        let (mut slope, mut curvature) = (T::zero(), T::zero());
        for [modulus, exponent] in self.terms() {
            let part = T::lit(0.5 * modulus) * (T::lit(exponent - 1.0) * logarithm).exp();
            slope += part;
            curvature += T::lit(exponent - 1.0) * part * below;
        }
        ([slope, T::zero()], [curvature, T::zero(), T::zero()])
    }
}
