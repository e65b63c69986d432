//! The slow path: one-sided rotations of Jacobi until the images bₖ = F qₖ are orthogonal (Hestenes).

use piola_numerics::linear::matrix3::dot;
use piola_numerics::sums::unit_in_last_place;
use piola_numerics::{Mask, Real};
use piola_tensor::internal::rows::{Rows, apply};
use piola_tensor::internal::spectral::combination;

use super::freeze;

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
    let (mut q, mut b) = (axes, freeze(images));
    for _ in 0..MOST_SWEEPS {
        let first = rotate(mask, &mut q, &mut b, 1, 2);
        let second = rotate(mask, &mut q, &mut b, 0, 2);
        let third = rotate(mask, &mut q, &mut b, 0, 1);
        if !(first | second | third).any() {
            break;
        }
    }
    with_derivatives(gradient, q, b)
}

/// Axes and images with the second and third images orthogonal, in the lanes of `mask`, and the longer of the two first: rare, and
/// apart from the kernel of a single point.
#[cold]
#[inline(never)]
fn pair_apart<T: Real>(mask: T::Mask, gradient: Rows<T>, axes: Rows<T>, images: Rows<T>) -> (Rows<T>, Rows<T>) {
    pair_within(mask, gradient, axes, images)
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn pair_within<T: Real>(mask: T::Mask, gradient: Rows<T>, axes: Rows<T>, images: Rows<T>) -> (Rows<T>, Rows<T>) {
    let (mut q, mut b) = (axes, freeze(images));
    let _ = rotate(mask, &mut q, &mut b, 1, 2);
    // Turned by a right angle about the first axis where they have changed places.
    let exchange = mask & dot(b[1], b[1]).less_than(dot(b[2], b[2]));
    for rows in [&mut q, &mut b] {
        let (x, y) = (rows[1], rows[2]);
        for i in 0..3 {
            rows[1][i] = T::select(exchange, y[i], x[i]);
            rows[2][i] = T::select(exchange, -x[i], y[i]);
        }
    }
    with_derivatives(gradient, q, b)
}

/// [`pair_apart`], in lanes within, or it would not have their width.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn orthogonalise_pair<T: Real>(
    mask: T::Mask,
    gradient: Rows<T>,
    axes: Rows<T>,
    images: Rows<T>,
) -> (Rows<T>, Rows<T>) {
    if T::LANES == 1 { pair_apart(mask, gradient, axes, images) } else { pair_within(mask, gradient, axes, images) }
}

/// Axes without derivatives and their images with those of F: the values are kept, since the rounding of new products with the
/// longest stretch would turn short images again.
#[cfg_attr(not(debug_assertions), inline(always))]
fn with_derivatives<T: Real>(gradient: Rows<T>, axes: Rows<T>, images: Rows<T>) -> (Rows<T>, Rows<T>) {
    if T::ORDER == 0 {
        return (axes, images);
    }
    let axes = freeze(axes);
    let mut varied = images;
    for (varied, axis) in varied.iter_mut().zip(axes) {
        for (entry, image) in varied.iter_mut().zip(apply(gradient, axis)) {
            *entry += image - image.frozen();
        }
    }
    (axes, varied)
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
