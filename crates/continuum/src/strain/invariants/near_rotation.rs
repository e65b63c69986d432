//! I₁ − 3 and I₂ − 3 where all of their terms cancel: of rotations as doubles hold them.
//!
//! ```text
//! C − 1 = H + Hᵀ + Hᵀ H,     I₁ − 3 = tr(C − 1),     I₂ − 3 = 2 tr(C − 1) + i₂(C − 1)
//! ```
//! In twice the digits, from F or ∇u, whichever was given.

use piola_numerics::Real;
use piola_numerics::sums::unit_in_last_place;
use piola_tensor::internal::rows::Rows;

use crate::Deformation;
use crate::deformation::volume::Pair;

/// Where the value is below 2¹² ulp of the terms of which it is the sum.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn cancels<T: Real>(value: T, terms: T) -> T::Mask {
    let magnified = value.abs() * T::lit(2.0_f64.powi(-12) / unit_in_last_place::<T>());
    magnified.less_than(terms)
}

/// `precise` where the plain sum cancels.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn refined<T: Real>(cancelling: T::Mask, precise: T, plain: T) -> T {
    T::select(cancelling & precise.is_finite(), precise, plain)
}

/// I₁ − 3.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn first_minus_three<T: Real>(deformation: &impl Deformation<T>) -> T {
    of_rows(&deformation.gradient_rows(), &deformation.displacement_rows())[0]
}

/// I₂ − 3.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn second_minus_three<T: Real>(deformation: &impl Deformation<T>) -> T {
    of_rows(&deformation.gradient_rows(), &deformation.displacement_rows())[1]
}

/// Both, rare and long, so that they are kept out of the loops that ask for them.
#[cold]
#[inline(never)]
fn of_rows<T: Real>(f: &Rows<T>, h: &Rows<T>) -> [T; 2] {
    // What F has beyond 1 + ∇u: of F given and below ½ what F − 1 has lost; of ∇u given nothing, F being 1 + ∇u rounded.
    let lost = [f[0][0] - (T::one() + h[0][0]), f[1][1] - (T::one() + h[1][1]), f[2][2] - (T::one() + h[2][2])];
    let entry = |j: usize, k: usize| {
        let mut sum = Pair::product(h[0][j], h[0][k]);
        sum = sum.plus(Pair::product(h[1][j], h[1][k])).plus(Pair::product(h[2][j], h[2][k]));
        let crossed = lost[j] * h[j][k] + lost[k] * h[k][j];
        sum = sum.plus(Pair::of(h[j][k])).plus(Pair::of(h[k][j])).plus(Pair::of(crossed));
        if j == k { sum.plus(Pair::of(lost[j] + lost[j])) } else { sum }
    };
    let (xx, yy, zz) = (entry(0, 0), entry(1, 1), entry(2, 2));
    let (xy, yz, xz) = (entry(0, 1).value(), entry(1, 2).value(), entry(0, 2).value());
    let trace = xx.plus(yy).plus(zz);
    let (x, y, z) = (xx.value(), yy.value(), zz.value());
    let second = (x * y - xy * xy) + (y * z - yz * yz) + (x * z - xz * xz);
    [trace.value(), trace.plus(trace).plus(Pair::of(second)).value()]
}
