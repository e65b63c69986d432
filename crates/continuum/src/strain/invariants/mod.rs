//! Invariants of deformation, their small-strain forms without cancellation, and their derivatives.
//!
//! ```text
//! I₁ = tr A      I₂ = ½ (I₁² − tr A²)      I₃ = det A                                B(4.62)
//! ∂I₁/∂A = 1     ∂I₂/∂A = I₁ 1 − A         ∂I₃/∂A = Cof A = I₃ A⁻¹                    W(24.12), W(24.16)
//! Ī₁ = J^(−2/3) I₁      Ī₂ = J^(−4/3) I₂                                      of C or B, unchanged by dilatation
//! ```
//!
//! | of | function | | small strain |
//! |---|---|---|---|
//! | any symmetric tensor | [`principal_invariants`], [`derivatives`], [`second_derivatives`] | | |
//! | a deformation: C and B | [`first`], [`second`], [`third`] | I | [`first_minus_three`], [`second_minus_three`], [`third_minus_one`] |
//! | its part without change of volume | [`isochoric_first`], [`isochoric_second`] | Ī | [`isochoric_first_minus_three`], [`isochoric_second_minus_three`], [`isochoric_minus_three`] |
//!
//! J and J − 1 are asked of the [`Deformation`] itself. Derivatives of Ī with respect to C are those functions that
//! begin with `isochoric` and end with `derivative`.

use piola_numerics::linear::matrix3::dot;
use piola_numerics::{Mask, Real};
use piola_tensor::internal::rows::{Rows, cofactor, double_contraction};

use super::kernels::right_cauchy_green;
use crate::deformation::volume::trace_pair;
use crate::{Deformation, Symmetric};

mod isochoric;
mod near_rotation;

pub use isochoric::{
    isochoric_first, isochoric_first_derivative, isochoric_first_minus_three, isochoric_first_second_derivative,
    isochoric_minus_three, isochoric_second, isochoric_second_derivative, isochoric_second_minus_three,
    isochoric_second_second_derivative,
};

pub use piola_tensor::principal_invariants;

/// (∂I₁/∂A, ∂I₂/∂A, ∂I₃/∂A) = (1, I₁ 1 − A, Cof A) of a symmetric tensor; finite for singular A too.
///
/// # Example
/// ```
/// use piola_continuum::{Symmetric, strain::invariants};
/// let derivatives = invariants::derivatives(&Symmetric::diagonal([2.0, 3.0, 0.0]));
/// assert_eq!(derivatives[1], Symmetric::diagonal([3.0, 2.0, 5.0]));
/// assert_eq!(derivatives[2], Symmetric::diagonal([0.0, 0.0, 6.0]));
/// ```
///
/// # Source
/// W(24.12), W(24.16).
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn derivatives<T: Real>(a: &Symmetric<T>) -> [Symmetric<T>; 3] {
    let [xx, yy, zz, xy, yz, xz] = a.components;
    // I₁ − A₁₁ as A₂₂ + A₃₃: no difference is formed.
    let second = Symmetric::new(yy + zz, xx + zz, xx + yy, -xy, -yz, -xz);
    [Symmetric::identity(), second, Symmetric::upper_triangle(cofactor(a.rows()))]
}

/// The second derivatives of I₁, I₂ and I₃ along two symmetric directions X and Y.
///
/// ```text
/// D²I₁ = 0        D²I₂ = tr X tr Y − X : Y        D²I₃ = (tr A tr X − A : X) tr Y − tr X A : Y − tr A X : Y + 2 (A X) : Y
/// ```
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn second_derivatives<T: Real>(a: &Symmetric<T>, x: &Symmetric<T>, y: &Symmetric<T>) -> [T; 3] {
    let second = derivatives(x)[1].double_contraction(y);
    [T::zero(), second, cofactor_derivative(a, x).double_contraction(y)]
}

/// The derivative of Cof A along X: the polarised cofactor, without division.
#[cfg_attr(not(debug_assertions), inline(always))]
fn cofactor_derivative<T: Real>(a: &Symmetric<T>, x: &Symmetric<T>) -> Symmetric<T> {
    let [axx, ayy, azz, axy, ayz, axz] = a.components;
    let [xx, yy, zz, xy, yz, xz] = x.components;
    let two = T::lit(2.0);
    Symmetric::new(
        ayy * zz + azz * yy - two * ayz * yz,
        axx * zz + azz * xx - two * axz * xz,
        axx * yy + ayy * xx - two * axy * xy,
        (ayz * xz + axz * yz) - (axy * zz + azz * xy),
        (axy * xz + axz * xy) - (axx * yz + ayz * xx),
        (axy * yz + ayz * xy) - (ayy * xz + axz * yy),
    )
}

/// I₁ = tr C = F : F.
///
/// # Accuracy
/// 5 ulp.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn first<T: Real>(deformation: &impl Deformation<T>) -> T {
    let f = deformation.gradient_rows();
    double_contraction(f, f)
}

/// I₂ = ½ (I₁² − tr C²) = Cof F : Cof F.
///
/// # Accuracy
/// A few ulp × the condition number of Cof F: no difference of squares is formed.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn second<T: Real>(deformation: &impl Deformation<T>) -> T {
    let k = deformation.cofactor_rows();
    double_contraction(k, k)
}

/// I₃ = det C = J².
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn third<T: Real>(deformation: &impl Deformation<T>) -> T {
    let jacobian = deformation.jacobian();
    jacobian * jacobian
}

/// I₁ − 3 = 2 tr ∇u + ∇u : ∇u, without cancellation.
///
/// # Accuracy
/// A few ulp of |∇u|², or of I₁ − 3 where that is larger; of a rotation what its rounded entries amount to, within 4e-16.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn first_minus_three<T: Real>(deformation: &impl Deformation<T>) -> T {
    let h = deformation.displacement_rows();
    let (trace, error) = trace_pair(h);
    let square = double_contraction(h, h);
    let plain = (trace + trace) + (square + (error + error));
    let cancelling = near_rotation::cancels(plain, square);
    if !cancelling.any() {
        return plain;
    }
    near_rotation::refined(cancelling, near_rotation::first_minus_three(deformation), plain)
}

/// I₂ − 3 = 2 tr K + K : K with K = Cof F − 1 = (tr ∇u) 1 − ∇uᵀ + Cof ∇u, without cancellation.
///
/// # Accuracy
/// A few ulp of |∇u|², or of I₂ − 3 where that is larger; of |K|² at large strain; of a rotation what its rounded entries
/// amount to, within 4e-16.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn second_minus_three<T: Real>(deformation: &impl Deformation<T>) -> T {
    let h = deformation.displacement_rows();
    let minors = cofactor(h);
    let (trace, error) = trace_pair(h);
    let k = [
        [(h[1][1] + h[2][2]) + minors[0][0], minors[0][1] - h[1][0], minors[0][2] - h[2][0]],
        [minors[1][0] - h[0][1], (h[0][0] + h[2][2]) + minors[1][1], minors[1][2] - h[2][1]],
        [minors[2][0] - h[0][2], minors[2][1] - h[1][2], (h[0][0] + h[1][1]) + minors[2][2]],
    ];
    // tr K = 2 tr ∇u + tr Cof ∇u.
    let doubled_second = minors[0][0] + minors[1][1] + minors[2][2];
    let (four, two) = (T::lit(4.0), T::lit(2.0));
    let square = double_contraction(k, k);
    let plain = four * trace + ((two * doubled_second + square) + four * error);
    let cancelling = near_rotation::cancels(plain, square);
    if !cancelling.any() {
        return plain;
    }
    near_rotation::refined(cancelling, near_rotation::second_minus_three(deformation), plain)
}

/// I₃ − 1 = (J − 1)(J + 1), without cancellation.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn third_minus_one<T: Real>(deformation: &impl Deformation<T>) -> T {
    deformation.volume_change() * (T::one() + deformation.jacobian())
}

/// ∂I₁/∂F = 2 F.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn first_gradient<T: Real>(deformation: &impl Deformation<T>) -> Rows<T> {
    piola_tensor::internal::rows::scaled(deformation.gradient_rows(), T::lit(2.0))
}

/// ∂I₂/∂F = 2 F (I₁ 1 − C).
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn second_gradient<T: Real>(deformation: &impl Deformation<T>) -> Rows<T> {
    let f = deformation.gradient_rows();
    let c = right_cauchy_green(f);
    gradient_of_metric_derivative(f, &derivatives(&c)[1])
}

/// ∂I₃/∂F = 2 J Cof F.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn third_gradient<T: Real>(deformation: &impl Deformation<T>) -> Rows<T> {
    piola_tensor::internal::rows::scaled(deformation.cofactor_rows(), T::lit(2.0) * deformation.jacobian())
}

/// ∂φ/∂F = 2 F (∂φ/∂C) of a function of C, given its derivative: by the chain rule of C = Fᵀ F.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn gradient_of_metric_derivative<T: Real>(f: Rows<T>, derivative: &Symmetric<T>) -> Rows<T> {
    let two = T::lit(2.0);
    let s = derivative.rows();
    f.map(|row| [two * dot(row, s[0]), two * dot(row, s[1]), two * dot(row, s[2])])
}
