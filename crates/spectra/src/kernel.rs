//! The responses of one mode of unit modulus.
//!
//! ```text
//! G′ = x²/(1 + x²)    G″ = x/(1 + x²)    x = ω τ        G = e^(−t/τ)        η⁺ = τ (1 − e^(−t/τ))
//! ```

use piola_numerics::Real;

/// G′ of a mode of unit modulus. Accuracy: 3 ulp, for x of any size.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn storage<T: Real>(x: T) -> T {
    // With the larger of x and 1/x squared nothing overflows.
    let inverse = x.recip();
    T::select(T::one().less_than(x), (T::one() + inverse * inverse).recip(), x * x / (T::one() + x * x))
}

/// G″ of a mode of unit modulus. Accuracy: 3 ulp.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn loss<T: Real>(x: T) -> T {
    (x + x.recip()).recip()
}

/// G(t) of a mode of unit modulus, of t/τ.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn relaxation<T: Real>(ratio: T) -> T {
    (-ratio).exp()
}

/// 1 − e^(−t/τ), of t/τ, without cancellation.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn growth<T: Real>(ratio: T) -> T {
    -(-ratio).exp_m1()
}
