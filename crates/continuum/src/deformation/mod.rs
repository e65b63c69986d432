//! Deformation of a neighbourhood: the deformation gradient F = ∂x/∂X, or the displacement gradient ∇u = F − 1.
//!
//! | you have | type | keeps |
//! |---|---|---|
//! | F | [`DeformationGradient`] | small stretches (det F → 0) |
//! | ∇u | [`DisplacementGradient`] | small strains (∇u → 0), without cancellation |
//! | x = F X + c | [`HomogeneousDeformation`] | either, with the translation |
//!
//! Storing only ∇u would lose small stretches and storing only F small strains, so both exist; formulas are
//! generic over [`Deformation`] and take from it what they need. Strains are in [`strain`](crate::strain).

mod displacement;
pub(crate) mod gradient;
mod homogeneous;
mod interchange;
pub(crate) mod moderate;
pub mod transport;
pub(crate) mod volume;

pub use displacement::DisplacementGradient;
pub use gradient::DeformationGradient;
pub use homogeneous::HomogeneousDeformation;

use nalgebra::Vector3;
use piola_numerics::Real;

use piola_tensor::internal::rows::{Rows, apply, cofactor, product, scaled, transpose};

/// The deformation of a neighbourhood: F = 1 + ∇u with 0 < det F.
///
/// What is asked of it is computed from what it stores without loss of digits.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_continuum::{Deformation, DeformationGradient};
/// let stretch = DeformationGradient::diagonal([2.0, 3.0, 0.5])?;
/// assert_eq!(stretch.line_element(Vector3::x()), Vector3::new(2.0, 0.0, 0.0));
/// assert_eq!(stretch.area_element(Vector3::x()), Vector3::new(1.5, 0.0, 0.0)); // 3 × 0.5
/// assert_eq!(stretch.volume_element(2.0), 6.0);
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
pub trait Deformation<T: Real>: Copy {
    /// F, by rows.
    #[must_use]
    fn gradient_rows(&self) -> Rows<T>;

    /// The same deformation over another scalar: each stored entry of F or ∇u through `lift(row, column, entry)`,
    /// unchecked. It carries derivatives into formulas.
    #[must_use]
    fn lifted<S: Real>(&self, lift: impl Fn(usize, usize, T) -> S) -> impl Deformation<S>;

    /// ∇u = F − 1, by rows.
    #[must_use]
    fn displacement_rows(&self) -> Rows<T>;

    /// J = det F, the ratio of volumes W(14.8).
    ///
    /// # Accuracy
    /// A few ulp × the condition number Σ |Fᵢⱼ Cofᵢⱼ|/J, also where the products in det F are far larger than J.
    #[must_use]
    fn jacobian(&self) -> T;

    /// J − 1, the relative change of volume.
    ///
    /// # Accuracy
    /// A few ulp × the condition number; for small ∇u a few ulp of |∇u|², or of J − 1 where that is larger.
    #[must_use]
    fn volume_change(&self) -> T;

    /// ln J, without cancellation near J = 1 and without loss near J = 0.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn ln_jacobian(&self) -> T {
        self.volume_change().ln_1p_given(self.jacobian())
    }

    /// Where strain and rotation are moderate, see [`is_moderate`](moderate::is_moderate).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn is_moderate(&self) -> T::Mask {
        moderate::is_moderate(self.gradient_rows(), self.displacement_rows())
    }

    /// Cof F = J F⁻ᵀ, by rows.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn cofactor_rows(&self) -> Rows<T> {
        cofactor(self.gradient_rows())
    }

    /// F⁻¹, by rows.
    ///
    /// # Accuracy
    /// A few ulp × the condition number of F.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn inverse_rows(&self) -> Rows<T> {
        scaled(transpose(self.cofactor_rows()), self.jacobian().recip())
    }

    /// 1 − F⁻¹ = F⁻¹ ∇u = ∂u/∂x, the displacement gradient with respect to the deformed place, by rows.
    ///
    /// # Accuracy
    /// A few ulp × the condition number of F, of its own norm: nothing cancels at small strain.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn spatial_displacement_rows(&self) -> Rows<T> {
        product(self.inverse_rows(), self.displacement_rows())
    }

    /// dx = F dX, m.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn line_element(&self, reference: Vector3<T>) -> Vector3<T> {
        Vector3::from(apply(self.gradient_rows(), reference.into()))
    }

    /// n da = Cof F N dA, m²: Nanson's formula B(4.39).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn area_element(&self, reference: Vector3<T>) -> Vector3<T> {
        Vector3::from(apply(self.cofactor_rows(), reference.into()))
    }

    /// dv = J dV, m³.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn volume_element(&self, reference: T) -> T {
        self.jacobian() * reference
    }
}
