//! Deformation of a neighbourhood: the deformation gradient F = ∂x/∂X, or the displacement gradient ∇u = F − 1.
//!
//! | you have | type | keeps |
//! |---|---|---|
//! | F | [`DeformationGradient`] | small stretches (det F → 0) |
//! | ∇u | [`DisplacementGradient`] | small strains (∇u → 0), without cancellation |
//!
//! Storing only ∇u would lose small stretches and storing only F small strains, so both exist; formulas are
//! generic over [`Deformation`] and take from it what they need.

mod displacement;
pub(crate) mod gradient;

pub use displacement::DisplacementGradient;
pub use gradient::DeformationGradient;

use piola_numerics::Real;

use crate::tensor::rows::Rows;

/// The deformation of a neighbourhood: F = 1 + ∇u with 0 < det F.
///
/// What is asked of it is computed from what it stores without loss of digits.
pub trait Deformation<T: Real>: Copy {
    /// F, by rows.
    #[must_use]
    fn gradient_rows(&self) -> Rows<T>;

    /// ∇u = F − 1, by rows.
    #[must_use]
    fn displacement_rows(&self) -> Rows<T>;

    /// J = det F, the ratio of volumes W(14.8).
    #[must_use]
    fn jacobian(&self) -> T;

    /// J − 1, the relative change of volume.
    #[must_use]
    fn volume_change(&self) -> T;
}

/// det(1 + H) − 1 = tr H + i₂(H) + det H, without cancellation for small H.
#[inline(always)]
pub(crate) fn volume_change<T: Real>(h: Rows<T>) -> T {
    use piola_numerics::linear::matrix3::determinant;
    let second = (h[0][0] * h[1][1] - h[0][1] * h[1][0])
        + (h[1][1] * h[2][2] - h[1][2] * h[2][1])
        + (h[0][0] * h[2][2] - h[0][2] * h[2][0]);
    (h[0][0] + h[1][1] + h[2][2]) + (second + determinant(h))
}
