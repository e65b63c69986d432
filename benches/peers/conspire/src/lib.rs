//! The laws of conspire beside ours: see the bench. Here are energies of a change of shape that it has and we have no type of.

use piola_solids::isochoric::Isochoric;
use piola_numerics::Real;

/// W̄ = ½ (μ − μₘ) x + ½ (μₘ/c) (exp(c x) − 1) with x = Ī₁ − 3: conspire's Fung.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exponential {
    /// μ, Pa: the shear modulus of the reference.
    pub mu: f64,
    /// μₘ, Pa.
    pub extra: f64,
    /// c.
    pub exponent: f64,
}

impl Isochoric for Exponential {
    const SECOND: bool = false;
    const REFUSED_IS_NOT_FINITE: bool = true;
    const LIMITED: bool = false;
    const STRAIGHT: bool = true;

    #[inline(always)]
    fn energy<T: Real>(&self, first: T, _second: T) -> T {
        let exponential = T::lit(self.extra / self.exponent) * (T::lit(self.exponent) * first).exp_m1();
        T::lit(0.5) * (T::lit(self.mu - self.extra) * first + exponential)
    }

    #[inline(always)]
    fn slopes<T: Real>(&self, first: T, _second: T) -> [T; 2] {
        let exponential = (T::lit(self.exponent) * first).exp_m1();
        [T::lit(0.5 * self.mu) + T::lit(0.5 * self.extra) * exponential, T::zero()]
    }

    #[inline(always)]
    fn curvatures<T: Real>(&self, first: T, second: T) -> [T; 3] {
        self.slopes_and_curvatures(first, second).1
    }

    #[inline(always)]
    fn slopes_and_curvatures<T: Real>(&self, first: T, _second: T) -> ([T; 2], [T; 3]) {
        let exponential = (T::lit(self.exponent) * first).exp_m1();
        let slope = T::lit(0.5 * self.mu) + T::lit(0.5 * self.extra) * exponential;
        let curvature = T::lit(0.5 * self.extra * self.exponent) * (exponential + T::one());
        ([slope, T::zero()], [curvature, T::zero(), T::zero()])
    }
}

/// W̄ = μ₁ x + μ₂ ((x + 3)⁴ − 81) + μ₃ (√(y + 3) − √3) with x = Ī₁ − 3 and y = Ī₂ − 3: conspire's Carroll.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Carroll {
    /// μ₁, Pa.
    pub linear: f64,
    /// μ₂, Pa.
    pub quartic: f64,
    /// μ₃, Pa.
    pub root: f64,
}

impl Isochoric for Carroll {
    const SECOND: bool = true;
    const REFUSED_IS_NOT_FINITE: bool = true;
    const LIMITED: bool = false;
    const STRAIGHT: bool = true;

    /// (x + 3)⁴ − 81 = x (108 + 54 x + 12 x² + x³) and √(y + 3) − √3 = y/(√(y + 3) + √3).
    #[inline(always)]
    fn energy<T: Real>(&self, first: T, second: T) -> T {
        let cubic = T::lit(108.0) + first * (T::lit(54.0) + first * (T::lit(12.0) + first));
        let three = T::lit(3.0);
        first * (T::lit(self.linear) + T::lit(self.quartic) * cubic)
            + T::lit(self.root) * second / ((second + three).sqrt() + three.sqrt())
    }

    #[inline(always)]
    fn slopes<T: Real>(&self, first: T, second: T) -> [T; 2] {
        let (trace, other) = (first + T::lit(3.0), second + T::lit(3.0));
        let quartic = T::lit(4.0 * self.quartic) * (trace * trace * trace);
        [T::lit(self.linear) + quartic, T::lit(0.5 * self.root) / other.sqrt()]
    }

    #[inline(always)]
    fn curvatures<T: Real>(&self, first: T, second: T) -> [T; 3] {
        let (trace, other) = (first + T::lit(3.0), second + T::lit(3.0));
        let root = T::lit(-0.25 * self.root) / (other * other.sqrt());
        [T::lit(12.0 * self.quartic) * (trace * trace), T::zero(), root]
    }
}
