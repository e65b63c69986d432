//! det F and det F − 1, also where their terms cancel.
//!
//! ```text
//! det F = Σ ± F₁ᵢ F₂ⱼ F₃ₖ        det(1 + H) − 1 = tr H + i₂(H) + det H
//! ```
//!
//! The six terms of det F may be 10⁸ times larger than their sum, and are when a stretch ratio is 10⁸. A bound
//! of the terms tells where rounding could exceed what the entries of F determine; only there are the sums formed
//! again in twice the precision.

use piola_numerics::internal::Lanewise;
use piola_numerics::linear::matrix3::{cross, dot};
use piola_numerics::sums::{two_product, two_sum};
use piola_numerics::{Mask, Real};
use piola_tensor::internal::rows::{Rows, difference, identity};

/// How much larger than the result the terms may be before the sum is formed in twice the precision.
const CANCELLATION: f64 = 16.0;

/// An unevaluated sum, of about twice the digits of `T`.
#[derive(Clone, Copy)]
pub(crate) struct Pair<T> {
    high: T,
    low: T,
}

impl<T: Real> Pair<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn of(high: T) -> Self {
        Self { high, low: T::zero() }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn product(a: T, b: T) -> Self {
        let (high, low) = two_product(a, b);
        Self { high, low }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn plus(self, other: Self) -> Self {
        let (high, error) = two_sum(self.high, other.high);
        let (high, low) = two_sum(high, error + (self.low + other.low));
        Self { high, low }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn minus(self, other: Self) -> Self {
        self.plus(Self { high: -other.high, low: -other.low })
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn times(self, factor: T) -> Self {
        let (high, error) = two_product(self.high, factor);
        let (high, low) = two_sum(high, error + self.low * factor);
        Self { high, low }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn value(self) -> T {
        self.high + self.low
    }
}

/// a × b in pairs.
#[cfg_attr(not(debug_assertions), inline(always))]
fn cross_pair<T: Real>(a: [T; 3], b: [T; 3]) -> [Pair<T>; 3] {
    let minor = |i: usize, j: usize| Pair::product(a[i], b[j]).minus(Pair::product(a[j], b[i]));
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn determinant_pair<T: Real>(f: Rows<T>) -> Pair<T> {
    let [x, y, z] = cross_pair(f[1], f[2]);
    x.times(f[0][0]).plus(y.times(f[0][1])).plus(z.times(f[0][2]))
}

/// |a₁| + |a₂| + |a₃|.
#[cfg_attr(not(debug_assertions), inline(always))]
fn one_norm<T: Real>(a: [T; 3]) -> T {
    a[0].abs() + a[1].abs() + a[2].abs()
}

/// `precise` where it is finite and `plain` cancels.
#[cfg_attr(not(debug_assertions), inline(always))]
fn refined<T: Real>(cancels: T::Mask, precise: T, plain: T) -> T {
    T::select(cancels & precise.is_finite(), precise, plain)
}

/// det F within a few ulp of what the entries determine.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn determinant<T: Real>(f: Rows<T>) -> T {
    let plain = dot(f[0], cross(f[1], f[2]));
    let terms = one_norm(f[0]) * one_norm(f[1]) * one_norm(f[2]);
    let cancels = (T::lit(CANCELLATION) * plain.abs()).less_than(terms);
    if cancels.any() { refined(cancels, precise_determinant(&f), plain) } else { plain }
}

/// det F in twice the precision: rare and long, so that it is kept out of the loops that ask for det F.
#[cold]
#[inline(never)]
fn precise_determinant<T: Real>(f: &Rows<T>) -> T {
    determinant_pair(*f).value()
}

/// tr H + i₂(H) + det H with the trace's rounding kept, and the bound of its terms less what they may amount to.
struct PlainVolumeChange;

impl Lanewise<9, 2> for PlainVolumeChange {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<T: Real>(&self, [a, b, c, d, e, f, g, k, l]: [T; 9]) -> [T; 2] {
        let h = [[a, b, c], [d, e, f], [g, k, l]];
        let second = (h[0][0] * h[1][1] - h[0][1] * h[1][0])
            + (h[1][1] * h[2][2] - h[1][2] * h[2][1])
            + (h[0][0] * h[2][2] - h[0][2] * h[2][0]);
        let (first, error) = trace_pair(h);
        let change = first + ((second + dot(h[0], cross(h[1], h[2]))) + error);
        let one = T::one();
        let terms = (one + one_norm(h[0])) * (one + one_norm(h[1])) * (one + one_norm(h[2]));
        // J + |J − 1|: what relative errors of F and of the result may amount to.
        let determined = one + change + change.abs();
        [change, terms - T::lit(CANCELLATION) * determined]
    }
}

/// tr H + i₂(H) + det H, and where that is not enough.
#[cfg_attr(not(debug_assertions), inline(always))]
fn plain_volume_change<T: Real>([[a, b, c], [d, e, f], [g, k, l]]: Rows<T>) -> (T, T::Mask) {
    let [change, excess] = T::lanewise(&PlainVolumeChange, [a, b, c, d, e, f, g, k, l]);
    (change, T::zero().less_than(excess))
}

/// tr H, rounded, and the rounding error.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn trace_pair<T: Real>(h: Rows<T>) -> (T, T) {
    let (partial, first_error) = two_sum(h[0][0], h[1][1]);
    let (trace, second_error) = two_sum(partial, h[2][2]);
    (trace, first_error + second_error)
}

/// det(1 + H) − 1 of a displacement gradient.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn volume_change_of_displacement<T: Real>(h: Rows<T>) -> T {
    let (plain, cancels) = plain_volume_change(h);
    if !cancels.any() {
        return plain;
    }
    refined(cancels, precise_volume_change_of_displacement(&h), plain)
}

#[cold]
#[inline(never)]
fn precise_volume_change_of_displacement<T: Real>(h: &Rows<T>) -> T {
    let minor = |i: usize, j: usize| Pair::product(h[i][i], h[j][j]).minus(Pair::product(h[i][j], h[j][i]));
    let second = minor(0, 1).plus(minor(1, 2)).plus(minor(0, 2));
    let first = Pair::of(h[0][0]).plus(Pair::of(h[1][1])).plus(Pair::of(h[2][2]));
    first.plus(second).plus(determinant_pair(*h)).value()
}

/// det F − 1 of a deformation gradient.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn volume_change_of_gradient<T: Real>(f: Rows<T>) -> T {
    let (plain, cancels) = plain_volume_change(difference(f, identity()));
    if !cancels.any() {
        return plain;
    }
    refined(cancels, precise_volume_change_of_gradient(&f), plain)
}

#[cold]
#[inline(never)]
fn precise_volume_change_of_gradient<T: Real>(f: &Rows<T>) -> T {
    determinant_pair(*f).minus(Pair::of(T::one())).value()
}
