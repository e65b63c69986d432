//! Scaling by powers of two, which rounds nothing: squares and cubes of components stay within the range of numbers.

use piola_numerics::Real;
use piola_numerics::linear::matrix3::dot;
use piola_numerics::sums::unit_in_last_place;

/// Where scaling has to take care, for the numbers of one format.
struct Range {
    /// The smallest size that is scaled to one; what is smaller stays below one.
    least: f64,
    /// From here on the steps below would overflow ...
    large: f64,
    /// ... without this factor.
    reduction: f64,
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn range<T: Real>() -> Range {
    // Powers of two written by their bits would say less: 2⁻¹⁰⁰⁰, 2⁹⁰⁰, 2⁻¹⁰⁰, and 2⁻¹²⁰, 2⁹⁰, 2⁻⁴⁰.
    if unit_in_last_place::<T>() < 1e-10 {
        Range {
            least: 9.332_636_185_032_189e-302,
            large: 8.452_712_498_170_644e270,
            reduction: 7.888_609_052_210_118e-31,
        }
    } else {
        Range {
            least: 7.523_163_845_262_64e-37,
            large: 1.237_940_039_285_380_3e27,
            reduction: 9.094_947_017_729_282e-13,
        }
    }
}

/// (s, 1/s), powers of two and constants, with 1 ≤ s m < 2 for sizes m in the range of normal numbers.
///
/// The power of two below m, without looking at its bits: S. M. Rump, T. Ogita, S. Oishi, *Accurate
/// floating-point summation I*, SIAM J. Sci. Comput. 31 (2008).
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn power_of_two_scale<T: Real>(size: T) -> (T, T) {
    let Range { least, large, reduction } = range::<T>();
    let ulp = unit_in_last_place::<T>();
    let size = size.frozen().max(T::lit(least));
    let reduced = T::select(T::lit(large).less_than(size), T::lit(reduction), T::one());
    let lifted = (size * reduced) * T::lit(1.0 / ulp + 1.0);
    let power = (lifted - T::lit(1.0 - 0.5 * ulp) * lifted).abs();
    (reduced / power, power / reduced)
}

/// The largest modulus of some numbers.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn largest<T: Real, const N: usize>(values: [T; N]) -> T {
    values.iter().fold(T::zero(), |largest, x| largest.max(x.abs()))
}

/// √x, with the derivative zero at zero, where it has none.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn square_root<T: Real>(x: T) -> T {
    let positive = T::zero().less_than(x);
    T::select(positive, T::select(positive, x, T::one()).sqrt(), x.frozen())
}

/// |v|, anywhere within the range of numbers.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn norm<T: Real>(v: [T; 3]) -> T {
    let (scale, unscale) = power_of_two_scale(largest(v));
    let v = [v[0] * scale, v[1] * scale, v[2] * scale];
    square_root(dot(v, v)) * unscale
}
