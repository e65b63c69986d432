//! Powers with whole exponents and their derivatives, also at zero.

use piola_numerics::Real;

/// xⁿ, 1 for n = 0.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn power<T: Real>(x: T, n: u8) -> T {
    let mut product = T::one();
    for _ in 0..n {
        product *= x;
    }
    product
}

/// n xⁿ⁻¹.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn power_slope<T: Real>(x: T, n: u8) -> T {
    if n == 0 { T::zero() } else { T::lit(f64::from(n)) * power(x, n - 1) }
}

/// n (n − 1) xⁿ⁻².
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn power_curvature<T: Real>(x: T, n: u8) -> T {
    if n < 2 { T::zero() } else { T::lit(f64::from(n) * f64::from(n - 1)) * power(x, n - 2) }
}
