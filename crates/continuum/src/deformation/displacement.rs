//! The displacement gradient ∇u = F − 1.

use nalgebra::Matrix3;
use piola_numerics::linear::matrix3::{from_rows, rows_of};
use piola_numerics::{Mask, Real};
use piola_tensor::Symmetric;
use piola_tensor::internal::rows::{Rows, identity, product, scaled, sum};

use super::gradient::{check_jacobian_of, checked_axes};
use super::volume::{determinant, volume_change_of_displacement};
use super::{Deformation, DeformationGradient};
use crate::ContinuumError;
use crate::error::check_finite;

/// The displacement gradient ∇u = ∂u/∂X = F − 1 with 0 < det F, B(4.28): no cancellation at small strain.
///
/// Read and written as an array of rows; what is read is checked.
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_continuum::{Deformation, DisplacementGradient};
/// let tiny = DisplacementGradient::new(Matrix3::from_diagonal_element(1e-20))?;
/// assert_eq!(tiny.volume_change(), 3.0 * 1e-20); // F itself would be 1 to the last bit
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
///
/// # Source
/// B(4.28).
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(transparent)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "[[T; 3]; 3]",
        into = "[[T; 3]; 3]",
        bound(serialize = "T: Real + serde::Serialize", deserialize = "T: Real + serde::Deserialize<'de>")
    )
)]
pub struct DisplacementGradient<T = f64> {
    matrix: Matrix3<T>,
}

impl<T: Real> DisplacementGradient<T> {
    /// From ∇u.
    ///
    /// # Errors
    /// In any lane: [`ContinuumError::NotFinite`] for an entry, or for det F when it overflows;
    /// [`ContinuumError::NonPositiveJacobian`]; [`ContinuumError::VanishingJacobian`] when det F is positive but below
    /// the range of the scalar.
    pub fn new(matrix: Matrix3<T>) -> Result<Self, ContinuumError> {
        Self::from_rows(rows_of(&matrix))
    }

    /// From ∇u as an array of rows.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn from_rows(rows: Rows<T>) -> Result<Self, ContinuumError> {
        check_finite("∇u", rows.as_flattened())?;
        let gradient = Self { matrix: from_rows(rows) };
        check_jacobian_of(gradient.jacobian(), &gradient.gradient_rows())?;
        Ok(gradient)
    }

    /// 0: nothing is deformed.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn zero() -> Self {
        Self { matrix: Matrix3::from_element(T::zero()) }
    }

    /// diag(λ₁ − 1, λ₂ − 1, λ₃ − 1) of the elongations λᵢ − 1 along the axes of coordinates.
    ///
    /// # Errors
    /// [`ContinuumError::NotFinite`]; [`ContinuumError::NonPositiveStretch`] unless −1 is below each elongation.
    pub fn diagonal(elongations: [T; 3]) -> Result<Self, ContinuumError> {
        check_elongations(elongations)?;
        Self::from_rows(Symmetric::diagonal(elongations).rows())
    }

    /// ∇u = k e₂ ⊗ e₁: simple shear by k along direction 2, varying along direction 1.
    ///
    /// # Errors
    /// [`ContinuumError::NotFinite`].
    pub fn simple_shear(amount: T) -> Result<Self, ContinuumError> {
        let o = T::zero();
        Self::from_rows([[o, o, o], [amount, o, o], [o, o, o]])
    }

    /// ∇u = Σ (λᵢ − 1) nᵢ ⊗ nᵢ: the pure stretch with elongations λᵢ − 1 along the columns nᵢ of `axes`.
    ///
    /// # Errors
    /// As [`diagonal`](Self::diagonal); [`TensorError::NotARotation`](piola_tensor::TensorError::NotARotation) unless the axes are orthonormal to 64 ulp and
    /// right-handed.
    ///
    /// # Accuracy
    /// 8 ulp of the largest elongation.
    ///
    /// # Source
    /// W(14.12), W(14.13).
    pub fn from_principal_elongations(elongations: [T; 3], axes: &Matrix3<T>) -> Result<Self, ContinuumError> {
        check_elongations(elongations)?;
        Self::from_rows(Symmetric::diagonal(elongations).congruence(checked_axes(axes)?).rows())
    }

    /// ∇u as a matrix.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub const fn matrix(&self) -> &Matrix3<T> {
        &self.matrix
    }

    /// F⁻¹ − 1 = −F⁻¹ ∇u: the inverse deformation, with the relative accuracy of ∇u.
    ///
    /// # Errors
    /// [`ContinuumError::NotFinite`] and [`ContinuumError::NonPositiveJacobian`] when the inverse is beyond the range of
    /// the scalar.
    pub fn inverse(&self) -> Result<Self, ContinuumError> {
        Self::from_rows(scaled(self.spatial_displacement_rows(), -T::one()))
    }

    /// F₂ F₁ − 1 = ∇u₂ + ∇u₁ + ∇u₂ ∇u₁ with ∇u₂ = `self`: first `first`, then this deformation.
    ///
    /// # Errors
    /// As [`inverse`](Self::inverse).
    pub fn compose(&self, first: &Self) -> Result<Self, ContinuumError> {
        let (second, first) = (self.displacement_rows(), first.displacement_rows());
        Self::from_rows(sum(sum(second, first), product(second, first)))
    }

    /// F = 1 + ∇u, rounded: strains below 10⁻¹⁶ are lost.
    ///
    /// # Errors
    /// [`ContinuumError::NonPositiveJacobian`] when det F is so small that rounding turns the body inside out.
    pub fn to_deformation_gradient(&self) -> Result<DeformationGradient<T>, ContinuumError> {
        DeformationGradient::from_rows(self.gradient_rows())
    }

    /// From rows that are known to be those of ∇u with 0 < det F, or whose result will not be used.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[doc(hidden)]
    pub fn trusted(rows: Rows<T>) -> Self {
        Self { matrix: from_rows(rows) }
    }
}

impl<T: Real> Default for DisplacementGradient<T> {
    fn default() -> Self {
        Self::zero()
    }
}

/// −1 < λᵢ − 1 < ∞ in every lane.
fn check_elongations<T: Real>(elongations: [T; 3]) -> Result<(), ContinuumError> {
    check_finite("principal elongations", &elongations)?;
    for (index, elongation) in elongations.iter().enumerate() {
        if !(-T::one()).less_than(*elongation).all() {
            let stretches = |lane: usize| -1.0 < elongation.primal(lane);
            let lane = (0..T::LANES).find(|&lane| !stretches(lane)).unwrap_or(0);
            return Err(ContinuumError::NonPositiveStretch { index, value: 1.0 + elongation.primal(lane) });
        }
    }
    Ok(())
}

impl<T: Real> Deformation<T> for DisplacementGradient<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn lifted<S: Real>(&self, lift: impl Fn(usize, usize, T) -> S) -> impl Deformation<S> {
        let m = self.matrix();
        DisplacementGradient { matrix: Matrix3::from_fn(|i, j| lift(i, j, m[(i, j)])) }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn gradient_rows(&self) -> Rows<T> {
        sum(rows_of(&self.matrix), identity())
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn displacement_rows(&self) -> Rows<T> {
        rows_of(&self.matrix)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn jacobian(&self) -> T {
        let change = self.volume_change();
        let near = change.abs().less_than(T::lit(0.5));
        // Far from 1 the determinant of F, which is exact where it is small, has more digits than 1 + (J − 1).
        let beyond = if near.all() { change } else { determinant(self.gradient_rows()) };
        T::select(near, T::one() + change, beyond)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn volume_change(&self) -> T {
        volume_change_of_displacement(rows_of(&self.matrix))
    }
}
