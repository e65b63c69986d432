//! The slow path: one-sided rotations of Jacobi until the images bₖ = F qₖ are orthogonal (Hestenes).

use piola_numerics::linear::matrix3::dot;
use piola_numerics::sums::unit_in_last_place;
use piola_numerics::{Mask, Real};
use piola_tensor::internal::rows::{Rows, apply};
use piola_tensor::internal::spectral::combination;

/// Sweeps after which rotations stop whatever remains; three suffice in all that was tried.
const MOST_SWEEPS: usize = 8;

/// Axes and images with orthogonal images, in the lanes of `mask`; the others are left as they are.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn orthogonalise<T: Real>(
    mask: T::Mask,
    gradient: Rows<T>,
    axes: Rows<T>,
    images: Rows<T>,
) -> (Rows<T>, Rows<T>) {
    let freeze = |rows: Rows<T>| if T::ORDER == 0 { rows } else { rows.map(|row| row.map(T::frozen)) };
    let (mut q, mut b) = (axes, freeze(images));
    for _ in 0..MOST_SWEEPS {
        let first = rotate(mask, &mut q, &mut b, 1, 2);
        let second = rotate(mask, &mut q, &mut b, 0, 2);
        let third = rotate(mask, &mut q, &mut b, 0, 1);
        if !(first | second | third).any() {
            break;
        }
    }
    if T::ORDER == 0 {
        return (q, b);
    }
    let axes = freeze(q);
    (axes, [apply(gradient, axes[0]), apply(gradient, axes[1]), apply(gradient, axes[2])])
}

/// [`orthogonalise`], apart from the kernel of a single point that rarely calls it: within, its loops would have the
/// registers.
#[cold]
#[inline(never)]
pub(super) fn orthogonalise_apart<T: Real>(
    mask: T::Mask,
    gradient: Rows<T>,
    axes: Rows<T>,
    images: Rows<T>,
) -> (Rows<T>, Rows<T>) {
    orthogonalise(mask, gradient, axes, images)
}

/// One rotation of axes i and j, where their images are not orthogonal to rounding; says where that was.
#[cfg_attr(not(debug_assertions), inline(always))]
fn rotate<T: Real>(mask: T::Mask, q: &mut Rows<T>, b: &mut Rows<T>, i: usize, j: usize) -> T::Mask {
    let (one, rounding) = (T::one(), T::lit(unit_in_last_place::<T>()));
    let (alpha, beta, gamma) = (dot(b[i], b[i]), dot(b[j], b[j]), dot(b[i], b[j]));
    let turn = mask & (rounding * (alpha.sqrt() * beta.sqrt())).less_than(gamma.abs());
    // The rotation by the smaller angle; with equal lengths, by 45°.
    let zeta = (beta - alpha) / T::select(turn, gamma + gamma, one);
    let tangent = (zeta.abs() + (one + zeta * zeta).sqrt()).recip().copysign(zeta);
    let cosine = (one + tangent * tangent).sqrt().recip();
    let sine = cosine * tangent;
    let (c, s) = (T::select(turn, cosine, one), T::select(turn, sine, T::zero()));
    for rows in [q, b] {
        let (x, y) = (rows[i], rows[j]);
        rows[i] = combination(c, x, -s, y);
        rows[j] = combination(s, x, c, y);
    }
    turn
}
