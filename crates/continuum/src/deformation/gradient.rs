//! The deformation gradient F = ∂x/∂X.

use nalgebra::Matrix3;
use piola_numerics::linear::matrix3::{from_rows, rows_of};
use piola_numerics::sums::unit_in_last_place;
use piola_numerics::{Mask, Real};
use piola_tensor::Symmetric;
use piola_tensor::internal::rows::{Rows, difference, identity, product};
use piola_tensor::rotation::check_rotation;

use super::volume::{determinant, volume_change_of_gradient};
use super::{Deformation, DisplacementGradient};
use crate::ContinuumError;
use crate::error::check_finite;

/// The deformation gradient F = ∂x/∂X with 0 < det F, W(14.7–14.8).
///
/// Read and written as an array of rows; what is read is checked.
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_continuum::{Deformation, DeformationGradient};
/// let stretch = DeformationGradient::new(Matrix3::new(2.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.25))?;
/// assert_eq!(stretch.jacobian(), 0.5);
/// assert!(DeformationGradient::new(-Matrix3::<f64>::identity()).is_err());
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
///
/// # Source
/// W(14.7), W(14.8).
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
pub struct DeformationGradient<T = f64> {
    matrix: Matrix3<T>,
}

impl<T: Real> DeformationGradient<T> {
    /// From F.
    ///
    /// # Errors
    /// In any lane: [`ContinuumError::NotFinite`] for an entry, or for det F when it overflows;
    /// [`ContinuumError::NonPositiveJacobian`]; [`ContinuumError::VanishingJacobian`] when det F is positive but below
    /// the range of the scalar, as that of diag(10⁻²⁰⁰, 10⁻²⁰⁰, 1): nothing that divides by J could be computed.
    pub fn new(matrix: Matrix3<T>) -> Result<Self, ContinuumError> {
        Self::from_rows(rows_of(&matrix))
    }

    /// From F as an array of rows.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn from_rows(rows: Rows<T>) -> Result<Self, ContinuumError> {
        check_finite("F", rows.as_flattened())?;
        check_jacobian_of(determinant(rows), &rows)?;
        Ok(Self { matrix: from_rows(rows) })
    }

    /// The deformation gradient of a displacement gradient, kept as ∇u so that small strains keep their digits.
    ///
    /// F = 1 + ∇u itself cannot hold a strain below 10⁻¹⁶; therefore the result is a [`DisplacementGradient`],
    /// which every formula over [`Deformation`] takes as well. To round it to F, see
    /// [`DisplacementGradient::to_deformation_gradient`].
    ///
    /// # Errors
    /// As [`DisplacementGradient::new`].
    ///
    /// # Source
    /// B(4.28).
    pub fn from_displacement_gradient(gradient: Matrix3<T>) -> Result<DisplacementGradient<T>, ContinuumError> {
        DisplacementGradient::new(gradient)
    }

    /// 1: nothing is deformed.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn identity() -> Self {
        Self { matrix: from_rows(identity()) }
    }

    /// diag(λ₁, λ₂, λ₃): stretches along the axes of coordinates.
    ///
    /// # Errors
    /// [`ContinuumError::NotFinite`], [`ContinuumError::NonPositiveStretch`].
    pub fn diagonal(stretches: [T; 3]) -> Result<Self, ContinuumError> {
        check_stretches(stretches)?;
        Self::from_rows(Symmetric::diagonal(stretches).rows())
    }

    /// F = λ 1: the same stretch in all directions.
    ///
    /// # Errors
    /// As [`diagonal`](Self::diagonal).
    pub fn dilatation(stretch: T) -> Result<Self, ContinuumError> {
        Self::diagonal([stretch; 3])
    }

    /// diag(λ, λₜ, λₜ): a bar along the first axis, stretched by λ, with stretch λₜ across.
    ///
    /// # Errors
    /// As [`diagonal`](Self::diagonal).
    pub fn uniaxial(axial: T, transverse: T) -> Result<Self, ContinuumError> {
        Self::diagonal([axial, transverse, transverse])
    }

    /// F = 1 + k e₂ ⊗ e₁: simple shear by k along direction 2, varying along direction 1.
    ///
    /// The only entry off the diagonal is F₂₁ = k. For other directions, see
    /// [`simple_shear_along`](Self::simple_shear_along).
    ///
    /// # Errors
    /// [`ContinuumError::NotFinite`].
    pub fn simple_shear(amount: T) -> Result<Self, ContinuumError> {
        let (o, l) = (T::zero(), T::one());
        Self::from_rows([[l, o, o], [amount, l, o], [o, o, l]])
    }

    /// F = 1 + k d ⊗ n: simple shear by k along d of the planes normal to n.
    ///
    /// d and n are unit vectors at right angles, the first two columns of `axes`.
    ///
    /// # Errors
    /// [`ContinuumError::NotFinite`]; [`TensorError::NotARotation`](piola_tensor::TensorError::NotARotation) unless `axes` is orthonormal and right-handed.
    pub fn simple_shear_along(amount: T, axes: &Matrix3<T>) -> Result<Self, ContinuumError> {
        let q = checked_axes(axes)?;
        let mut rows: Rows<T> = identity();
        for (i, row) in rows.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                *entry += amount * q[i][0] * q[j][1];
            }
        }
        Self::from_rows(rows)
    }

    /// F = Σ λᵢ nᵢ ⊗ nᵢ: the pure stretch with principal stretches λᵢ along the columns nᵢ of `axes`.
    ///
    /// With a rotation R, `rotation.compose(&stretch)` is R U.
    ///
    /// # Errors
    /// [`ContinuumError::NotFinite`]; [`ContinuumError::NonPositiveStretch`]; [`TensorError::NotARotation`](piola_tensor::TensorError::NotARotation) unless the
    /// axes are orthonormal to 64 ulp and right-handed.
    ///
    /// # Accuracy
    /// 8 ulp of the largest stretch: a stretch that is smaller than that cannot be kept in F unless its axis is an
    /// axis of coordinates.
    ///
    /// # Source
    /// W(14.12), W(14.13).
    pub fn from_principal_stretches(stretches: [T; 3], axes: &Matrix3<T>) -> Result<Self, ContinuumError> {
        check_stretches(stretches)?;
        Self::from_rows(Symmetric::diagonal(stretches).congruence(checked_axes(axes)?).rows())
    }

    /// F as a matrix.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub const fn matrix(&self) -> &Matrix3<T> {
        &self.matrix
    }

    /// F⁻¹, the deformation from the deformed to the reference configuration.
    ///
    /// # Errors
    /// [`ContinuumError::NotFinite`] and [`ContinuumError::NonPositiveJacobian`] when the inverse is beyond the range of
    /// the scalar.
    pub fn inverse(&self) -> Result<Self, ContinuumError> {
        Self::from_rows(self.inverse_rows())
    }

    /// F₂ F₁ with F₂ = `self`: first `first`, then this deformation.
    ///
    /// # Errors
    /// As [`inverse`](Self::inverse).
    pub fn compose(&self, first: &Self) -> Result<Self, ContinuumError> {
        Self::from_rows(product(self.gradient_rows(), first.gradient_rows()))
    }

    /// ∇u = F − 1 as a type of its own; entries of F below 10⁻¹⁶ on the diagonal are lost.
    ///
    /// # Errors
    /// [`ContinuumError::NonPositiveJacobian`] when det F is so small that the loss turns the body inside out.
    pub fn to_displacement_gradient(&self) -> Result<DisplacementGradient<T>, ContinuumError> {
        DisplacementGradient::from_rows(self.displacement_rows())
    }

    /// From rows that are known to be those of F with 0 < det F, or whose result will not be used.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[doc(hidden)]
    pub fn trusted(rows: Rows<T>) -> Self {
        Self { matrix: from_rows(rows) }
    }
}

impl<T: Real> Default for DeformationGradient<T> {
    fn default() -> Self {
        Self::identity()
    }
}

/// 0 < det F < ∞ in every lane.
///
/// # Errors
/// [`ContinuumError::NonPositiveJacobian`].
#[inline]
pub fn check_jacobian<T: Real>(determinant: T) -> Result<(), ContinuumError> {
    if (T::zero().less_than(determinant) & determinant.is_finite()).all() {
        return Ok(());
    }
    let fits = |lane: usize| 0.0 < determinant.primal(lane) && determinant.primal(lane).is_finite();
    let lane = (0..T::LANES).find(|&lane| !fits(lane)).unwrap_or(0);
    let determinant = determinant.primal(lane);
    if !determinant.is_finite() {
        return Err(ContinuumError::NotFinite { quantity: "det F", index: 0, value: determinant });
    }
    Err(ContinuumError::NonPositiveJacobian { determinant })
}

/// As [`check_jacobian`] for the determinant of F; a positive one that is rounded to zero is told apart from zero.
#[inline]
pub(super) fn check_jacobian_of<T: Real>(determinant: T, gradient: &Rows<T>) -> Result<(), ContinuumError> {
    check_jacobian(determinant).map_err(|error| match error {
        ContinuumError::NonPositiveJacobian { determinant: zero } if 0.0 <= zero => {
            let lane = (0..T::LANES).find(|&lane| determinant.primal(lane) <= 0.0).unwrap_or(0);
            vanishing(gradient.map(|row| row.map(|x| x.primal(lane))), unit_in_last_place::<T>()).unwrap_or(error)
        }
        other => other,
    })
}

/// log₁₀ det F if it is positive and below the range of a scalar with this unit in the last place.
#[cold]
fn vanishing(gradient: Rows<f64>, unit_in_last_place: f64) -> Option<ContinuumError> {
    let least = if unit_in_last_place < 1e-10 { f64::MIN_POSITIVE } else { f64::from(f32::MIN_POSITIVE) };
    // Rows scaled by powers of two: no product rounds differently, and none vanishes.
    let mut exponent = 0.0;
    let scaled = gradient.map(|row| {
        let power = row.iter().fold(0.0, |largest: f64, x| largest.max(x.abs())).log2().floor();
        exponent += power;
        // In two steps, because 2¹⁰⁷⁴ is out of range.
        let half = (-0.5 * power).floor();
        row.map(|x| x * half.exp2() * (-power - half).exp2())
    });
    let logarithm = (determinant(scaled).log2() + exponent) * core::f64::consts::LOG10_2;
    (logarithm.is_finite() && logarithm < least.log10()).then_some(ContinuumError::VanishingJacobian { logarithm })
}

/// 0 < λᵢ < ∞ in every lane.
fn check_stretches<T: Real>(stretches: [T; 3]) -> Result<(), ContinuumError> {
    check_finite("principal stretches", &stretches)?;
    for (index, stretch) in stretches.iter().enumerate() {
        if !T::zero().less_than(*stretch).all() {
            let positive = |lane: usize| 0.0 < stretch.primal(lane);
            let lane = (0..T::LANES).find(|&lane| !positive(lane)).unwrap_or(0);
            return Err(ContinuumError::NonPositiveStretch { index, value: stretch.primal(lane) });
        }
    }
    Ok(())
}

/// The rows of a matrix with orthonormal, right-handed columns.
pub(super) fn checked_axes<T: Real>(axes: &Matrix3<T>) -> Result<Rows<T>, ContinuumError> {
    check_rotation(axes)?;
    Ok(rows_of(axes))
}

impl<T: Real> Deformation<T> for DeformationGradient<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn lifted<S: Real>(&self, lift: impl Fn(usize, usize, T) -> S) -> impl Deformation<S> {
        let m = self.matrix();
        DeformationGradient { matrix: Matrix3::from_fn(|i, j| lift(i, j, m[(i, j)])) }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn gradient_rows(&self) -> Rows<T> {
        rows_of(&self.matrix)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn displacement_rows(&self) -> Rows<T> {
        difference(rows_of(&self.matrix), identity())
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn jacobian(&self) -> T {
        determinant(rows_of(&self.matrix))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn volume_change(&self) -> T {
        volume_change_of_gradient(rows_of(&self.matrix))
    }
}
