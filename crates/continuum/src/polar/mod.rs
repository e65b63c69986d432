//! The polar decomposition F = R U = V R and functions of the stretches, from one analysis of F.
//!
//! ```text
//! C = FᵀF = 1 + 2E = Σ λₖ² qₖ ⊗ qₖ        bₖ = F qₖ,   G = [bₖ · bₗ],   S = √G
//! U = Σ Sₖₗ qₖ ⊗ qₗ        R = Σ (S⁻¹)ₖₗ bₗ ⊗ qₖ        f(U) = Σ f(S)ₖₗ qₖ ⊗ qₗ
//! ```
//! G would be diagonal but for the rounding of the axes and, over differentiable scalars, for derivatives. What is
//! off its diagonal is carried to first order through each function by divided differences, which need no gap
//! between the stretches: results are as accurate as from a singular value decomposition of F although only a
//! symmetric problem is solved. Where the first order does not suffice (stretch ratios above some 10⁴) one-sided
//! rotations of Jacobi make the bₖ orthogonal first: the slow path, gated by a mask and reported.
//!
//! For small strain everything is computed from 2E of ∇u, as the difference from the rotation alone.

mod hencky;
mod in_frame;
mod orthogonal_images;
mod quantities;

pub use self::hencky::{PolarHencky, polar_hencky};

use piola_numerics::sums::unit_in_last_place;
use piola_numerics::{Mask, Real};

use self::in_frame::{departure_of, roots_of};
use self::orthogonal_images::{orthogonalise, orthogonalise_apart, orthogonalise_pair};
use crate::{Deformation, Symmetric};
use piola_tensor::internal::rows::{Rows, apply, transpose};
use piola_tensor::internal::spectral::{
    axes_in_order, components_in, gram, larger, largest_modulus, product_entry, unturned_frame,
};

/// Strains with components up to this size are computed from ∇u and relative to the rotation.
const SMALL: f64 = 0.25;
/// Where the diagonal of 2E is below this, C has more digits.
const SHRUNK: f64 = -0.5;

/// Analysis of the stretches, axes and rotation of a deformation. Each method computes one quantity from it.
///
/// # Accuracy
/// As a singular value decomposition of F: with the stretches λ₁ ≥ λ₂ ≥ λ₃ and ε = 2⁻⁵², R within a few
/// ε λ₁/(λ₂ + λ₃) and orthogonal within 8 ε, U within a few ε ‖U‖, ln U within a few ε λ₁/λ₃, all norm-wise and
/// whatever the gaps of the stretches. For small strain ln U and U − 1 are within a few ε of their own norm.
/// Each principal stretch is within 8 ε λ₁, its logarithm within 8 ε λ₁/λ₃, whatever the gaps.
///
/// # Derivatives
/// Over scalars with derivatives all tensors have theirs up to the fourth order, finite at coalescence. Single
/// principal values and axes have them where the stretches are distinct; those of Σ λₖ are within 8 ε (λ₁/λ₃)².
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_continuum::{DeformationGradient, polar::StretchAnalysis};
/// // Twice as long along 1, then turned by 90° about 3.
/// let f = DeformationGradient::new(Matrix3::new(0.0, -1.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 1.0))?;
/// let stretch = StretchAnalysis::of(&f);
/// assert_eq!(stretch.principal_stretches(), [2.0, 1.0, 1.0]);
/// assert_eq!(stretch.rotation(), [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]);
/// assert_eq!(stretch.hencky_material().components[0], 2.0_f64.ln());
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct StretchAnalysis<T: Real = f64> {
    gradient: Rows<T>,
    displacement: Rows<T>,
    /// 2E.
    twice_green: Symmetric<T>,
    /// 2E, for small strain, or C in the frame of the axes.
    square: [T; 6],
    /// qₖ by rows, without derivatives.
    axes: Rows<T>,
    /// Where the first axis is that of the largest stretch, and not of the smallest.
    first: T::Mask,
    /// bₖ = F qₖ by rows.
    images: Rows<T>,
    /// Where the strain is small, and 1 or 0 accordingly: U is kept as its excess over this.
    small: T::Mask,
    shift: T,
    /// The diagonal of S, without derivatives.
    stretches: [T; 3],
    /// The diagonal of S less the shift, without derivatives.
    excess: [T; 3],
    /// What S has beyond that: rounding and derivatives.
    departure: [T; 6],
    slow: T::Mask,
}

/// 2E = H + Hᵀ + Hᵀ H, each rounding proportional to what it rounds also near pure rotations.
#[cfg_attr(not(debug_assertions), inline(always))]
fn twice_green<T: Real>(h: &Rows<T>) -> Symmetric<T> {
    Symmetric {
        components: [
            along(h, 0, 1, 2),
            along(h, 1, 2, 0),
            along(h, 2, 0, 1),
            across(h, 0, 1, 2),
            across(h, 1, 2, 0),
            across(h, 0, 2, 1),
        ],
    }
}

/// (2E)ᵢᵢ.
#[cfg_attr(not(debug_assertions), inline(always))]
fn along<T: Real>(h: &Rows<T>, i: usize, j: usize, k: usize) -> T {
    h[i][i] * (T::lit(2.0) + h[i][i]) + (h[j][i] * h[j][i] + h[k][i] * h[k][i])
}

/// (2E)ᵢⱼ.
#[cfg_attr(not(debug_assertions), inline(always))]
fn across<T: Real>(h: &Rows<T>, i: usize, j: usize, k: usize) -> T {
    (h[i][j] + h[j][i]) + ((h[i][i] * h[i][j] + h[j][i] * h[j][j]) + h[k][i] * h[k][j])
}

/// Whether the cosine of the angle between two images is more than rounding leaves.
#[cfg_attr(not(debug_assertions), inline(always))]
fn tilted<T: Real>(length: T, other: T, product: T) -> T::Mask {
    let enough = T::lit((0.125 * unit_in_last_place::<T>()).sqrt());
    (enough * (length * other)).less_than(product.abs())
}

/// Whether images of such lengths and products are not orthogonal enough for the first order to suffice.
#[cfg_attr(not(debug_assertions), inline(always))]
fn any_tilted<T: Real>([a, b, c]: &[T; 3], gram: &[T; 6]) -> T::Mask {
    tilted(*a, *b, gram[3]) | tilted(*b, *c, gram[4]) | tilted(*a, *c, gram[5])
}

/// Whether the images of the two axes beside the separated one are so close in length, beside the longest, that the product
/// of the two changes their lengths by more than rounding: of S between the axes
///
/// ```text
/// [[m + h, d], [d, m − h]]        eigenvalues m ± √(h² + d²):  beyond the diagonal by less than d²/(|h| + |d|)
/// ```
#[cfg_attr(not(debug_assertions), inline(always))]
fn unresolved<T: Real>([a, b, c]: &[T; 3], product: T) -> T::Mask {
    let (half, rounding) = (T::lit(0.5), T::lit(2.0 * unit_in_last_place::<T>()));
    let (h, d) = ((half * (*b - *c)).abs(), (product / (*b + *c)).abs());
    (rounding * larger(*a, *b) * (h + d)).less_than(d * d)
}

/// Lane by lane and component by component.
#[cfg_attr(not(debug_assertions), inline(always))]
fn choose<T: Real>(mask: T::Mask, a: [T; 6], b: [T; 6]) -> [T; 6] {
    [
        T::select(mask, a[0], b[0]),
        T::select(mask, a[1], b[1]),
        T::select(mask, a[2], b[2]),
        T::select(mask, a[3], b[3]),
        T::select(mask, a[4], b[4]),
        T::select(mask, a[5], b[5]),
    ]
}

/// Σ aₖ ⊗ bₖ by rows.
#[cfg_attr(not(debug_assertions), inline(always))]
fn outer_products<T: Real>(a: &Rows<T>, b: &Rows<T>) -> Rows<T> {
    [
        [product_entry(a, b, 0, 0), product_entry(a, b, 0, 1), product_entry(a, b, 0, 2)],
        [product_entry(a, b, 1, 0), product_entry(a, b, 1, 1), product_entry(a, b, 1, 2)],
        [product_entry(a, b, 2, 0), product_entry(a, b, 2, 1), product_entry(a, b, 2, 2)],
    ]
}

/// F qₖ by rows.
#[cfg_attr(not(debug_assertions), inline(always))]
fn images_of<T: Real>(gradient: Rows<T>, axes: &Rows<T>) -> Rows<T> {
    [apply(gradient, axes[0]), apply(gradient, axes[1]), apply(gradient, axes[2])]
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn freeze<T: Real>(rows: Rows<T>) -> Rows<T> {
    if T::ORDER == 0 { rows } else { rows.map(|row| row.map(T::frozen)) }
}

impl<T: Real> StretchAnalysis<T> {
    /// Of F or ∇u.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn of(deformation: &impl Deformation<T>) -> Self {
        let (gradient, displacement) = (deformation.gradient_rows(), deformation.displacement_rows());
        let twice_green = twice_green(&displacement);
        let green =
            if T::ORDER == 0 { twice_green } else { Symmetric { components: twice_green.components.map(T::frozen) } };
        let small = largest_modulus(green.components).at_most(T::lit(SMALL));
        // The frame of 2E or, where that is nearly −1 and a small stretch would be lost in it, of C.
        let [x, y, z, ..] = green.components;
        let shrunk = larger(larger(x, y), z).less_than(T::lit(SHRUNK));
        let measure = if shrunk.any() {
            let cauchy_green = gram(&freeze(transpose(gradient)));
            Symmetric { components: choose(shrunk, cauchy_green, green.components) }
        } else {
            green
        };

        let frame = unturned_frame(&measure);
        let (mut axes, mut first) = (frame.axes(), frame.first);
        let (mut images, products) = if T::ORDER == 0 {
            frame.images(gradient)
        } else {
            (axes, first) = (freeze(axes_in_order(first, axes)), Mask::splat(true));
            let images = images_of(gradient, &axes);
            (images, gram(&images))
        };
        // For small strain 2E in the frame, otherwise C.
        let mut square = if small.all() {
            components_in(&axes, &twice_green)
        } else if small.any() {
            choose(small, components_in(&axes, &twice_green), products)
        } else {
            products
        };

        let mut roots = roots_of(small, &square);
        let mut slow = Mask::splat(false);
        if !small.all() {
            let products = if T::ORDER == 0 { square } else { gram(&freeze(images)) };
            slow = !small & any_tilted(&roots.0, &products);
            if slow.any() {
                // In lanes within, or it would not have their width.
                (axes, images) = if T::LANES == 1 {
                    orthogonalise_apart(slow, gradient, axes, images)
                } else {
                    orthogonalise(slow, gradient, axes, images)
                };
                square = choose(slow, gram(&images), square);
                roots = roots_of(small, &square);
            }
            let close = !small & !slow & unresolved(&roots.0, products[4]);
            if close.any() {
                (axes, images) = orthogonalise_pair(close, gradient, axes, images);
                square = choose(close, gram(&images), square);
                roots = roots_of(small, &square);
            }
        }
        let shift = T::select(small, T::one(), T::zero());
        let departure = departure_of(shift, &square, &roots.0, &roots.1);
        Self {
            gradient,
            displacement,
            twice_green,
            square,
            axes,
            first,
            images,
            small,
            shift,
            stretches: roots.0,
            excess: roots.1,
            departure,
            slow,
        }
    }

    /// Where the slow path was taken: about where λ₁² > 10⁸ λ₂ λ₃.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn slow_path(&self) -> T::Mask {
        self.slow
    }
}
