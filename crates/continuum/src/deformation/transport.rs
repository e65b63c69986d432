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
        #[inline(always)]
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
        #[inline(always)]
        #[must_use]
        pub fn $name<T: Real>(deformation: &impl Deformation<T>, a: &Symmetric<T>) -> Symmetric<T> {
            let $d = deformation;
            a.congruence($rows)
        }
    )*};
}

vectors! {
    /// F v: a line element carried by the body.
    ///
    /// # Example
    /// ```
    /// use nalgebra::{Matrix3, Vector3};
    /// use piola_continuum::{DeformationGradient, deformation::transport};
    /// let stretch = DeformationGradient::new(Matrix3::from_diagonal(&[2.0, 1.0, 1.0].into()))?;
    /// assert_eq!(transport::push_vector(&stretch, &Vector3::x()).x, 2.0);
    /// assert_eq!(transport::push_covector(&stretch, &Vector3::x()).x, 0.5);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    push_vector, |d| d.gradient_rows();
    /// F⁻¹ v.
    ///
    /// # Example
    /// ```
    /// use nalgebra::{Matrix3, Vector3};
    /// use piola_continuum::{DeformationGradient, deformation::transport};
    /// let stretch = DeformationGradient::new(Matrix3::from_diagonal(&[2.0, 1.0, 1.0].into()))?;
    /// assert_eq!(transport::pull_vector(&stretch, &Vector3::x()).x, 0.5);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    pull_vector, |d| d.inverse_rows();
    /// F⁻ᵀ v: a gradient with respect to X as one with respect to x.
    ///
    /// # Example
    /// ```
    /// use nalgebra::{Matrix3, Vector3};
    /// use piola_continuum::{DeformationGradient, deformation::transport};
    /// let stretch = DeformationGradient::new(Matrix3::from_diagonal(&[2.0, 1.0, 1.0].into()))?;
    /// assert_eq!(transport::push_covector(&stretch, &Vector3::x()).x, 0.5); // twice as long, half the gradient
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    push_covector, |d| transpose(d.inverse_rows());
    /// Fᵀ v.
    ///
    /// # Example
    /// ```
    /// use nalgebra::{Matrix3, Vector3};
    /// use piola_continuum::{DeformationGradient, deformation::transport};
    /// let stretch = DeformationGradient::new(Matrix3::from_diagonal(&[2.0, 1.0, 1.0].into()))?;
    /// assert_eq!(transport::pull_covector(&stretch, &Vector3::x()).x, 2.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    pull_covector, |d| transpose(d.gradient_rows());
}

tensors! {
    /// F A Fᵀ.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Matrix3;
    /// use piola_continuum::{DeformationGradient, Symmetric, deformation::transport};
    /// let stretch = DeformationGradient::new(Matrix3::from_diagonal(&[2.0, 1.0, 1.0].into()))?;
    /// let one = Symmetric::identity();
    /// assert_eq!(transport::push_contravariant(&stretch, &one).components[0], 4.0); // B
    /// assert_eq!(transport::push_covariant(&stretch, &one).components[0], 0.25); // B⁻¹
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    push_contravariant, |d| d.gradient_rows();
    /// F⁻¹ A F⁻ᵀ.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Matrix3;
    /// use piola_continuum::{DeformationGradient, Symmetric, deformation::transport};
    /// let stretch = DeformationGradient::new(Matrix3::from_diagonal(&[2.0, 1.0, 1.0].into()))?;
    /// assert_eq!(transport::pull_contravariant(&stretch, &Symmetric::identity()).components[0], 0.25); // C⁻¹
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    pull_contravariant, |d| d.inverse_rows();
    /// F⁻ᵀ A F⁻¹.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Matrix3;
    /// use piola_continuum::{DeformationGradient, Symmetric, deformation::transport};
    /// let stretch = DeformationGradient::new(Matrix3::from_diagonal(&[2.0, 1.0, 1.0].into()))?;
    /// assert_eq!(transport::push_covariant(&stretch, &Symmetric::identity()).components[0], 0.25); // B⁻¹
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    push_covariant, |d| transpose(d.inverse_rows());
    /// Fᵀ A F.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Matrix3;
    /// use piola_continuum::{DeformationGradient, Symmetric, deformation::transport};
    /// let stretch = DeformationGradient::new(Matrix3::from_diagonal(&[2.0, 1.0, 1.0].into()))?;
    /// assert_eq!(transport::pull_covariant(&stretch, &Symmetric::identity()).components[0], 4.0); // C
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    pull_covariant, |d| transpose(d.gradient_rows());
}

/// F A F⁻¹ of a tensor with one index of either kind.
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_continuum::{DeformationGradient, deformation::transport};
/// let stretch = DeformationGradient::new(Matrix3::from_diagonal(&[2.0, 1.0, 1.0].into()))?;
/// let a = Matrix3::new(3.0, 1.0, 0.0, 0.0, 5.0, 0.0, 0.0, 0.0, 7.0);
/// let pushed = transport::push_mixed(&stretch, &a);
/// assert_eq!((pushed[(0, 1)], pushed.trace()), (2.0, 15.0)); // the trace stays
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[inline(always)]
#[must_use]
pub fn push_mixed<T: Real>(deformation: &impl Deformation<T>, a: &Matrix3<T>) -> Matrix3<T> {
    from_rows(product(product(deformation.gradient_rows(), rows_of(a)), deformation.inverse_rows()))
}

/// F⁻¹ A F of a tensor with one index of either kind.
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_continuum::{DeformationGradient, deformation::transport};
/// let stretch = DeformationGradient::new(Matrix3::from_diagonal(&[2.0, 1.0, 1.0].into()))?;
/// let a = Matrix3::new(3.0, 1.0, 0.0, 0.0, 5.0, 0.0, 0.0, 0.0, 7.0);
/// assert_eq!(transport::pull_mixed(&stretch, &a)[(0, 1)], 0.5);
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[inline(always)]
#[must_use]
pub fn pull_mixed<T: Real>(deformation: &impl Deformation<T>, a: &Matrix3<T>) -> Matrix3<T> {
    from_rows(product(product(deformation.inverse_rows(), rows_of(a)), deformation.gradient_rows()))
}
