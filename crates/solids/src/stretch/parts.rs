//! Functions of one stretch, of which energy and stresses are made.

use piola_numerics::{Mask, Real};
use piola_tensor::spectral::{IsotropicFunction, Logarithm};

use super::energy::StretchEnergy;

/// w(ln λ), whose sum over the stretches is the energy.
pub(super) struct Part<'a, L>(pub(super) &'a L);

impl<L: StretchEnergy> IsotropicFunction for Part<'_, L> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn value<T: Real>(&self, stretch: T) -> T {
        self.0.part(stretch.ln())
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn value_beside_one<T: Real>(&self, elongation: T) -> T {
        self.0.part(elongation.ln_1p())
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slope_at_one<T: Real>(&self) -> T {
        T::zero()
    }
}

/// w′(ln λ)/λⁿ: n = 0 for τ, 1 for P, 2 for S.
pub(super) struct Stress<'a, L, const N: usize>(pub(super) &'a L);

impl<L: StretchEnergy, const N: usize> Stress<'_, L, N> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn divided<T: Real>(slope: T, stretch: T) -> T {
        match N {
            0 => slope,
            1 => slope / stretch,
            _ => slope / (stretch * stretch),
        }
    }
}

impl<L: StretchEnergy, const N: usize> IsotropicFunction for Stress<'_, L, N> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn value<T: Real>(&self, stretch: T) -> T {
        Self::divided(self.0.slope(stretch.ln()), stretch)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn value_beside_one<T: Real>(&self, elongation: T) -> T {
        Self::divided(self.0.slope(elongation.ln_1p()), T::one() + elongation)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn divided_difference<T: Real>(&self, a: T, b: T) -> T {
        let (x, y) = (a.ln(), b.ln());
        let slope = self.0.secant(x, y) * Logarithm.divided_difference(a, b);
        // (f g)[a, b] = f[a, b] g(b) + f(a) g[a, b]
        match N {
            0 => slope,
            1 => (slope - self.0.slope(x) / a) / b,
            _ => (slope - self.0.slope(x) * (a + b) / (a * a)) / (b * b),
        }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn rough_divided_difference<T: Real>(&self, a: T, b: T, value_at_a: T, value_at_b: T) -> T {
        let (sum, gap) = (a + b, a - b);
        let near = gap.abs().less_than(sum * T::lit(1e-4));
        let quotient = (value_at_a - value_at_b) / T::select(near, T::one(), gap);
        if !near.any() {
            return quotient;
        }
        let middle = T::lit(0.5) * sum;
        let x = middle.ln();
        let order = T::lit(match N {
            0 => 0.0,
            1 => 1.0,
            _ => 2.0,
        });
        let slope = Self::divided(self.0.curvature(x) - order * self.0.slope(x), middle) / middle;
        T::select(near, slope, quotient)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slope_at_one<T: Real>(&self) -> T {
        self.0.curvature_at_rest()
    }
}
