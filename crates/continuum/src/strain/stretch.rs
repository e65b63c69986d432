//! The factors of the polar decomposition F = R U = V R, and Biot's strain.

use nalgebra::Matrix3;
use piola_numerics::Real;
use piola_numerics::linear::matrix3::from_rows;
use piola_tensor::Slots;
use piola_tensor::internal::rows::Rows;
use piola_tensor::rotation::check_rotation;
use piola_tensor::spectral::{SquareRoot, derivative_array, second_derivative};

use super::RightCauchyGreen;
use super::lines::{along, derivatives_of_measure, moving_analysis, tangent};
use crate::measures::{linear_measure, symmetric_measure};
use crate::polar::StretchAnalysis;
use crate::{ContinuumError, Deformation, Symmetric};

symmetric_measure! {
    /// The right stretch tensor U = √C of F = R U.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::DeformationGradient;
    /// use piola_continuum::strain::RightStretch;
    /// let bar = DeformationGradient::uniaxial(2.0, 0.5)?;
    /// assert_eq!(RightStretch::of(&bar), RightStretch::new(2.0, 0.5, 0.5, 0.0, 0.0, 0.0)?);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    ///
    /// # Source
    /// W(14.11).
    RightStretch, "U", "U", |u| u
}

symmetric_measure! {
    /// The left stretch tensor V = √B of F = V R.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::DeformationGradient;
    /// use piola_continuum::strain::LeftStretch;
    /// // Stretched by 2 along 1, then turned by 90° about 3: in space the stretch is along 2.
    /// let turned = DeformationGradient::from_rows([[0.0, -1.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 1.0]])?;
    /// assert_eq!(LeftStretch::of(&turned).0.components[..3], [1.0, 2.0, 1.0]);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    ///
    /// # Source
    /// W(14.11).
    LeftStretch, "V", "V", |v| v
}

symmetric_measure! {
    /// Biot's strain U − 1: elongations of the principal lines.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::DisplacementGradient;
    /// use piola_continuum::strain::BiotStrain;
    /// let tiny = DisplacementGradient::diagonal([1e-20, 0.0, 0.0])?;
    /// assert_eq!(BiotStrain::of(&tiny).0.components[0], 1e-20);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    BiotStrain, "U - 1", "U", |biot| biot + Symmetric::identity()
}

linear_measure!(BiotStrain);

macro_rules! of_stretch_analysis {
    ($($(#[$documentation:meta])* $name:ident $method:ident),*) => { $(
        impl<T: Real> $name<T> {
            $(#[$documentation])*
            ///
            /// To ask for several measures of one deformation, make one [`StretchAnalysis`] and use
            /// [`from_analysis`](Self::from_analysis).
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[must_use]
            pub fn of(deformation: &impl Deformation<T>) -> Self {
                Self::from_analysis(&StretchAnalysis::of(deformation))
            }

            /// From the stretches of a deformation that are already known.
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[must_use]
            pub fn from_analysis(analysis: &StretchAnalysis<T>) -> Self {
                Self(analysis.$method())
            }
        }
    )* };
}
pub(super) use of_stretch_analysis;

of_stretch_analysis!(
    /// U of F = R U.
    ///
    /// # Accuracy
    /// 8 ulp of its norm at any ratio of stretches.
    RightStretch right_stretch,
    /// V of F = V R.
    ///
    /// # Accuracy
    /// 8 ulp of its norm at any ratio of stretches.
    LeftStretch left_stretch,
    /// U − 1.
    ///
    /// # Accuracy
    /// 8 ulp of its norm, from ∇u at small strain too.
    BiotStrain right_stretch_less_one
);
derivatives_of_measure!(RightStretch);
derivatives_of_measure!(LeftStretch);
derivatives_of_measure!(BiotStrain);

impl<T: Real> RightStretch<T> {
    /// ∂U/∂C: entry (ij, kl) in the order 11, 22, 33, 12, 23, 13, without factors for shears; the same as ∂(U − 1)/∂C.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn derivative_by_metric(metric: &RightCauchyGreen<T>) -> Slots<T> {
        derivative_array(&SquareRoot, &metric.0)
    }

    /// ∂²U/∂C² along two symmetric directions.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn second_derivative_by_metric(
        metric: &RightCauchyGreen<T>,
        first: &Symmetric<T>,
        second: &Symmetric<T>,
    ) -> Symmetric<T> {
        second_derivative(&SquareRoot, &metric.0, first, second)
    }
}

/// The rotation R of F = R U = V R.
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_continuum::{DeformationGradient, Symmetric};
/// use piola_continuum::strain::Rotation;
/// let turned = DeformationGradient::from_rows([[0.0, -1.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 1.0]])?;
/// let rotation = Rotation::of(&turned);
/// assert_eq!(*rotation.matrix(), Matrix3::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0));
/// // A material tensor seen in space: what was along 1 is along 2.
/// assert_eq!(rotation.to_space(&Symmetric::diagonal([5.0, 0.0, 0.0])), Symmetric::diagonal([0.0, 5.0, 0.0]));
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
///
/// # Source
/// W(14.11).
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
pub struct Rotation<T = f64> {
    matrix: Matrix3<T>,
}

impl<T: Real> Rotation<T> {
    /// R of a deformation.
    ///
    /// # Accuracy
    /// Orthogonal within 8 ulp; within a few ulp × λ₁/(λ₂ + λ₃) of the rotation that F determines.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn of(deformation: &impl Deformation<T>) -> Self {
        Self::from_analysis(&StretchAnalysis::of(deformation))
    }

    /// From the stretches of a deformation that are already known.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn from_analysis(analysis: &StretchAnalysis<T>) -> Self {
        Self { matrix: from_rows(analysis.rotation()) }
    }

    /// From an orthogonal matrix with determinant one.
    ///
    /// # Errors
    /// [`ContinuumError::NotFinite`], [`TensorError::NotARotation`](piola_tensor::TensorError::NotARotation) beyond 64 ulp, in any lane.
    pub fn from_matrix(matrix: Matrix3<T>) -> Result<Self, ContinuumError> {
        check_rotation(&matrix)?;
        Ok(Self { matrix })
    }

    /// R as a matrix.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub const fn matrix(&self) -> &Matrix3<T> {
        &self.matrix
    }

    /// R as an array of rows.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn rows(&self) -> Rows<T> {
        piola_numerics::linear::matrix3::rows_of(&self.matrix)
    }

    /// R A Rᵀ: a material tensor turned into space, as V = R U Rᵀ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn to_space(&self, material: &Symmetric<T>) -> Symmetric<T> {
        material.congruence(self.rows())
    }

    /// Rᵀ A R: a spatial tensor turned back into the reference configuration.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn to_reference(&self, spatial: &Symmetric<T>) -> Symmetric<T> {
        spatial.transposed_congruence(self.rows())
    }

    /// dR along a direction dF; with Ḟ for dF the rate Ṙ.
    ///
    /// # Source
    /// W(14.24).
    #[inline]
    #[must_use]
    pub fn derivative(deformation: &impl Deformation<T>, direction: &Matrix3<T>) -> Matrix3<T> {
        tangent(Rotation::from_analysis(&moving_analysis(&along(deformation, direction))).rows())
    }
}

impl<T: Real> TryFrom<[[T; 3]; 3]> for Rotation<T> {
    type Error = ContinuumError;
    fn try_from(rows: [[T; 3]; 3]) -> Result<Self, ContinuumError> {
        Self::from_matrix(from_rows(rows))
    }
}

impl<T: Real> From<Rotation<T>> for [[T; 3]; 3] {
    fn from(rotation: Rotation<T>) -> Self {
        rotation.rows()
    }
}
