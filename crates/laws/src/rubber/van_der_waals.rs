//! The van der Waals energy of Kilian.

use piola_numerics::internal::excess_over_logarithm;
use piola_numerics::{Real, parameters};
use piola_solids::SolidsError;
use piola_solids::isochoric::Isochoric;

use super::limit::{check_below, within};

parameters! {
    SolidsError;
    /// The van der Waals energy of Kilian: chains that end at a stretch and attract each other.
    ///
    /// ```text
    /// W = μ (−(λₘ² − 3)(ln(1 − η) + η) − ⅔ a (x/2)^(3/2))      x = (1 − β)(I₁ − 3) + β (I₂ − 3),   η = √(x/(λₘ² − 3))
    /// ∂W/∂x = ½ μ (1/(1 − η) − a √(x/2))
    /// ```
    /// | symbol | parameter | unit | bounds |
    /// |---|---|---|---|
    /// | μ | `shear_modulus` | Pa | 0 < μ |
    /// | λₘ | `locking_stretch` | 1 | 3 < λₘ²; x stays below λₘ² − 3 |
    /// | a | `interaction` of the chains | 1 | 0 ≤ a |
    /// | β | `mixture` of I₁ and I₂ | 1 | 0 ≤ β ≤ 1 |
    ///
    /// The shear modulus of the reference is μ, for any a.
    ///
    /// # Accuracy
    /// Energy and stress a few ulp × 1/(1 − η). ∂²W/∂x² grows as x^(−½) at the reference and is taken at 10⁻¹⁶ below that: the tangent is
    /// within some 10⁻⁸ of its norm there, a few ulp elsewhere.
    ///
    /// # Errors
    /// `check` refuses λₘ² − 3 ≤ x; without it energy, stresses and tangents are NaN there.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::DeformationGradient;
    /// use piola_laws::rubber::VanDerWaals;
    /// use piola_solids::{Hyperelastic, IncompressibleSolid};
    /// // λₘ² − 3 = 8, x = k² = 2: η = ½, √(x/2) = 1.
    /// let rubber = IncompressibleSolid::new(VanDerWaals::new(3.0, 11.0_f64.sqrt(), 0.5, 0.0)?);
    /// let shear = DeformationGradient::simple_shear(2.0_f64.sqrt())?;
    /// let stress: f64 = rubber.cauchy(&shear).0.components[3];
    /// assert!((stress - 3.0 * 2.0_f64.sqrt() * 1.5).abs() < 1e-13); // μ k (1/(1 − η) − a √(x/2))
    /// assert!(rubber.check(&DeformationGradient::simple_shear(3.0)?).is_err());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Source
    /// H. G. Kilian, Polymer 22 (1981) 209–217; H. G. Kilian, H. F. Enderle and K. Unseld, Colloid Polym. Sci. 264 (1986) 866–876, with β.
    #[doc(alias("Kilian"))]
    pub struct VanDerWaals("van der Waals") {
        /// μ, Pa.
        shear_modulus as "mu": "0 < μ" => 0.0 < shear_modulus,
        /// λₘ.
        locking_stretch as "lambda_m": "3 < λm²" => 3.0 < locking_stretch * locking_stretch && 0.0 < locking_stretch,
        /// a.
        interaction as "a": "0 ≤ a" => 0.0 <= interaction,
        /// β.
        mixture as "beta": "0 ≤ β ≤ 1" => (0.0..=1.0).contains(&mixture),
    }
}

/// The energy of x = I₁ − 3 and y = I₂ − 3 by μ, λₘ, a and β, over any scalar: parameters may have derivatives too.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn van_der_waals<T: Real>([modulus, locking, interaction, mixture]: [T; 4], first: T, second: T) -> T {
    /// Added under roots, so that their derivatives at the reference are those of the limit.
    const TINY: f64 = 1e-36;
    let (half, third) = (T::lit(0.5), T::lit(1.0 / 3.0));
    let x = first + mixture * (second - first);
    let limit = locking * locking - T::lit(3.0);
    // Rounding may leave the reference on either side of x = 0.
    let beyond = T::select(T::zero().less_than(x), x, T::zero());
    let share = ((beyond + T::lit(TINY)) / limit).sqrt();
    let root = (half * (beyond + T::lit(TINY))).sqrt();
    // −ln(1 − η) − η less its part of second order, which is x/2 of a limit.
    let stiffening = limit * (excess_over_logarithm(-share) - half * (share * share));
    let attraction = T::lit(2.0) * third * interaction * (root * root * root);
    within(x, limit, modulus * (half * x + stiffening - attraction))
}

impl VanDerWaals {
    /// λₘ² − 3.
    fn limit(&self) -> f64 {
        self.locking_stretch * self.locking_stretch - 3.0
    }

    /// x of I₁ − 3 and I₂ − 3.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn argument<T: Real>(&self, first: T, second: T) -> T {
        first + T::lit(self.mixture) * (second - first)
    }

    /// By I₁ and I₂ of a derivative by x.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn shares<T: Real>(&self) -> [T; 2] {
        [T::lit(1.0 - self.mixture), T::lit(self.mixture)]
    }
}

impl Isochoric for VanDerWaals {
    const SECOND: bool = true;
    const REFUSED_IS_NOT_FINITE: bool = true;
    const STRAIGHT: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, first: T, second: T) -> T {
        let parameters =
            [T::lit(self.shear_modulus), T::lit(self.locking_stretch), T::lit(self.interaction), T::lit(self.mixture)];
        van_der_waals(parameters, first, second)
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
    fn slopes_and_curvatures<T: Real>(&self, first: T, second: T) -> ([T; 2], [T; 3]) {
        /// Least x of the curvature.
        const LEAST: f64 = 1e-16;
        let x = self.argument(first, second);
        let limit = T::lit(self.limit());
        let tiny = T::lit(1e-36);
        let beyond = T::select(tiny.less_than(x), x, tiny);
        let apart = T::select(T::lit(LEAST).less_than(x), x, T::lit(LEAST));
        let left = T::one() - (beyond / limit).sqrt();
        let half = T::lit(0.5 * self.shear_modulus);
        let slope = half * (left.recip() - T::lit(self.interaction) * (T::lit(0.5) * beyond).sqrt());
        let stiffening = (T::lit(2.0) * limit * (apart / limit).sqrt() * left * left).recip();
        let attraction = T::lit(0.25 * self.interaction) / (T::lit(0.5) * apart).sqrt();
        let curvature = within(x, limit, half * (stiffening - attraction));
        let slope = within(x, limit, slope);
        let [one, two]: [T; 2] = self.shares();
        ([one * slope, two * slope], [one * one * curvature, one * two * curvature, two * two * curvature])
    }

    fn check(&self, first: f64, second: f64) -> Result<(), SolidsError> {
        check_below(Self::NAME, "(1 − β)(I1 − 3) + β (I2 − 3)", self.argument(first, second), self.limit())
    }
}
