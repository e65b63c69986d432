//! Push-forward and pull-back of vectors and second-order tensors.
//!
//! ```text
//!                  forward          back             example
//! vector           F v              F⁻¹ v            line element dX
//! covector         F⁻ᵀ v            Fᵀ v             gradient of a function
//! contravariant    F A Fᵀ           F⁻¹ A F⁻ᵀ        S, D♯
//! covariant        F⁻ᵀ A F⁻¹        Fᵀ A F           Green's strain E ↦ Almansi's e; Ė ↦ D
//! mixed            F A F⁻¹          F⁻¹ A F          F⁻¹ Ḟ ↦ L
//! ```
//! Tangents are carried by [`PairSymmetric::congruence`](piola_tensor::PairSymmetric::congruence) and, with their types, by
//! [`stress::tangents`](crate::stress::tangents).
//!
//! # Accuracy
//! 6 ulp of the product of the norms of the factors; F⁻¹ to a few ulp × the condition number of F.

use nalgebra::{Matrix3, Vector3};
use piola_numerics::Real;
use piola_numerics::linear::matrix3::{from_rows, rows_of};
use piola_tensor::internal::rows::{apply, product, transpose};

use crate::{Deformation, Symmetric};

macro_rules! vectors {
    ($($(#[$documentation:meta])* $name:ident, |$d:ident| $rows:expr;)*) => {$(
        $(#[$documentation])*
        #[cfg_attr(not(debug_assertions), inline(always))]
        #[must_use]
        pub fn $name<T: Real>(deformation: &impl Deformation<T>, v: &Vector3<T>) -> Vector3<T> {
            let $d = deformation;
            Vector3::from(apply($rows, [v[0], v[1], v[2]]))
        }
    )*};
}

macro_rules! tensors {
    ($($(#[$documentation:meta])* $name:ident, |$d:ident| $rows:expr;)*) => {$(
        $(#[$documentation])*
        #[cfg_attr(not(debug_assertions), inline(always))]
        #[must_use]
        pub fn $name<T: Real>(deformation: &impl Deformation<T>, a: &Symmetric<T>) -> Symmetric<T> {
            let $d = deformation;
            a.congruence($rows)
        }
    )*};
}

vectors! {
    /// F v: a line element carried by the body.
    push_vector, |d| d.gradient_rows();
    /// F⁻¹ v.
    pull_vector, |d| d.inverse_rows();
    /// F⁻ᵀ v: a gradient with respect to X as one with respect to x.
    push_covector, |d| transpose(d.inverse_rows());
    /// Fᵀ v.
    pull_covector, |d| transpose(d.gradient_rows());
}

tensors! {
    /// F A Fᵀ.
    push_contravariant, |d| d.gradient_rows();
    /// F⁻¹ A F⁻ᵀ.
    pull_contravariant, |d| d.inverse_rows();
    /// F⁻ᵀ A F⁻¹.
    push_covariant, |d| transpose(d.inverse_rows());
    /// Fᵀ A F.
    pull_covariant, |d| transpose(d.gradient_rows());
}

/// F A F⁻¹ of a tensor with one index of either kind.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn push_mixed<T: Real>(deformation: &impl Deformation<T>, a: &Matrix3<T>) -> Matrix3<T> {
    from_rows(product(product(deformation.gradient_rows(), rows_of(a)), deformation.inverse_rows()))
}

/// F⁻¹ A F of a tensor with one index of either kind.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn pull_mixed<T: Real>(deformation: &impl Deformation<T>, a: &Matrix3<T>) -> Matrix3<T> {
    from_rows(product(product(deformation.inverse_rows(), rows_of(a)), deformation.gradient_rows()))
}
