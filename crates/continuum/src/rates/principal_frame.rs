//! Algebra in the principal frame of U, where it is diagonal but for rounding and derivatives.

use piola_numerics::{Dual, Mask, Real};
use piola_tensor::internal::rows::{Rows, product, transpose};
use piola_tensor::spectral::IsotropicFunction;

use crate::Symmetric;

/// f[a, b, c] from the first differences, to half the digits: enough for the factor of a rounding.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn second_difference<T: Real, F: IsotropicFunction + ?Sized>(
    f: &F,
    [a, b, c]: [T; 3],
    ab: T,
    bc: T,
    ac: T,
) -> T {
    // Over the widest gap, which the other two are no larger than.
    let (wide, first, last) = (a - c, a - b, b - c);
    let by_first = first.abs().at_most(wide.abs()) & last.abs().at_most(wide.abs());
    let by_second = last.abs().at_most(first.abs());
    let (gap, change) = (T::select(by_second, first, last), T::select(by_second, ac - bc, ab - ac));
    let (gap, change) = (T::select(by_first, wide, gap), T::select(by_first, ab - bc, change));
    let near = gap.abs().at_most(T::lit(1e-4) * (a + b + c));
    let quotient = change / T::select(near, T::one(), gap);
    if !near.any() {
        return quotient;
    }
    let middle = Dual::variable((a + b + c) * T::lit(1.0 / 3.0));
    let curvature = f.value(Dual::new(middle, Dual::constant(T::one()))).tangent.tangent;
    T::select(near, T::lit(0.5) * curvature, quotient)
}

/// Σ Mₖₗ qₖ ⊗ qₗ for axes by rows.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn along<T: Real>(axes: &Rows<T>, m: Symmetric<T>) -> Symmetric<T> {
    let half = product(m.rows(), *axes);
    Symmetric::upper_triangle(product(transpose(*axes), half))
}

/// ω of S Ω + Ω S = [k]×, by (tr S 1 − S) ω = k, for an S that is diagonal but for rounding and derivatives: each
/// pass brings in one order of these.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn spin_of<T: Real>(stretch: &[T; 6], k: [T; 3]) -> [T; 3] {
    let [a, b, c, n, p, r] = *stretch;
    let reciprocal = [(b + c).recip(), (c + a).recip(), (a + b).recip()];
    let mut spin = [k[0] * reciprocal[0], k[1] * reciprocal[1], k[2] * reciprocal[2]];
    let mut pass = 0;
    while pass <= T::ORDER {
        let [x, y, z] = spin;
        spin = [
            (k[0] + (n * y + r * z)) * reciprocal[0],
            (k[1] + (n * x + p * z)) * reciprocal[1],
            (k[2] + (r * x + p * y)) * reciprocal[2],
        ];
        pass += 1;
    }
    spin
}
