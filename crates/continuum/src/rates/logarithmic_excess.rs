//! By how much the logarithmic spin exceeds the polar one, as a function of the ratio of two stretches.

use piola_numerics::{Mask, Real};
use piola_tensor::spectral::IsotropicFunction;

/// g(y) = (1/x − 1/sinh x)/x = (sinh x − x)/(x² sinh x), y = x²: 1/6 − 7y/360 + …
pub(super) struct LogarithmicExcess;

impl IsotropicFunction for LogarithmicExcess {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn value<T: Real>(&self, y: T) -> T {
        let one = T::one();
        // Both series have positive terms only; beyond y = 2 the closed form loses no digits either.
        let near = y.less_than(T::lit(2.0));
        let mut numerator = T::zero();
        let mut denominator = T::zero();
        let inside = T::select(near, y, one);
        let mut k = SERIES_TERMS;
        while 0 < k {
            // Σ y^k/(2k+3)! and Σ y^k/(2k+1)!, nested.
            let n = f64::from(2 * k);
            numerator = (one + numerator) * inside * T::lit(1.0 / ((n + 2.0) * (n + 3.0)));
            denominator = (one + denominator) * inside * T::lit(1.0 / (n * (n + 1.0)));
            k -= 1;
        }
        let series = T::lit(1.0 / 6.0) * (one + numerator) / (one + denominator);
        if near.all() {
            return series;
        }
        let beyond = T::select(near, T::lit(2.0), y);
        let x = beyond.sqrt();
        T::select(near, series, (one - x / x.sinh()) / beyond)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn smooth_within<T: Real>(&self, y: T) -> T {
        // The nearest singularity is the first zero of the hyperbolic sine, y = −π².
        y.abs() + T::lit(9.0)
    }
}

/// With y ≤ 2 the first term left out is below 2¹²/25!, 3e-22.
const SERIES_TERMS: i32 = 11;

#[cfg(test)]
mod tests {
    //! What cannot be seen from outside.
    use super::*;

    #[test]
    fn excess_of_the_logarithmic_spin_equals_its_closed_form() {
        for y in [0.0, 1e-12, 0.5, 1.999_999, 2.0, 2.000_001, 30.0, 900.0_f64] {
            let x = y.sqrt();
            let closed = if y < 1e-6 { 1.0 / 6.0 - 7.0 * y / 360.0 } else { (1.0 - x / x.sinh()) / y };
            let rounding = if y < 1e-6 { 4.0 } else { 4.0 + 16.0 / y };
            let tolerance = rounding * f64::EPSILON * closed.abs().max(1e-3);
            assert!((LogarithmicExcess.value(y) - closed).abs() <= tolerance, "y = {y}");
        }
    }
}
