//! Homogeneous deformations x = F X + c.

use nalgebra::Vector3;
use piola_numerics::Real;
use piola_tensor::internal::rows::apply;

use super::Deformation;
use crate::ContinuumError;
use crate::error::check_finite;

/// The homogeneous deformation x = F X + c of a whole body.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_continuum::{DeformationGradient, HomogeneousDeformation};
/// let shear = HomogeneousDeformation::new(DeformationGradient::simple_shear(0.5)?, Vector3::new(0.0, 0.0, 3.0))?;
/// let x = shear.position(Vector3::new(2.0, 0.0, 0.0));
/// assert_eq!(x, Vector3::new(2.0, 1.0, 3.0));
/// assert_eq!(shear.reference_position(x), Vector3::new(2.0, 0.0, 0.0));
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
///
/// # Source
/// W(14.10).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "Written<D, T>",
        into = "Written<D, T>",
        bound(
            serialize = "T: Real + serde::Serialize, D: Deformation<T> + serde::Serialize",
            deserialize = "T: Real + serde::Deserialize<'de>, D: Deformation<T> + serde::Deserialize<'de>"
        )
    )
)]
pub struct HomogeneousDeformation<D, T = f64> {
    deformation: D,
    translation: Vector3<T>,
}

impl<T: Real, D: Deformation<T>> HomogeneousDeformation<D, T> {
    /// From F, or ∇u, and the translation c, m.
    ///
    /// # Errors
    /// [`ContinuumError::NotFinite`] for the translation.
    pub fn new(deformation: D, translation: Vector3<T>) -> Result<Self, ContinuumError> {
        check_finite("translation", translation.as_slice())?;
        Ok(Self { deformation, translation })
    }

    /// F or ∇u, the same everywhere.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub const fn deformation(&self) -> &D {
        &self.deformation
    }

    /// c, m.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub const fn translation(&self) -> &Vector3<T> {
        &self.translation
    }

    /// x = F X + c, m.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn position(&self, reference: Vector3<T>) -> Vector3<T> {
        reference + self.displacement(reference)
    }

    /// u = ∇u X + c, m, without the difference of two places.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn displacement(&self, reference: Vector3<T>) -> Vector3<T> {
        Vector3::from(apply(self.deformation.displacement_rows(), reference.into())) + self.translation
    }

    /// X = F⁻¹ (x − c), m.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn reference_position(&self, position: Vector3<T>) -> Vector3<T> {
        Vector3::from(apply(self.deformation.inverse_rows(), (position - self.translation).into()))
    }
}

/// How a homogeneous deformation is written: its gradient by rows and its translation.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
struct Written<D, T> {
    deformation: D,
    translation: [T; 3],
}

#[cfg(feature = "serde")]
impl<T: Real, D: Deformation<T>> TryFrom<Written<D, T>> for HomogeneousDeformation<D, T> {
    type Error = ContinuumError;
    fn try_from(written: Written<D, T>) -> Result<Self, ContinuumError> {
        Self::new(written.deformation, Vector3::from(written.translation))
    }
}

#[cfg(feature = "serde")]
impl<T: Real, D: Deformation<T>> From<HomogeneousDeformation<D, T>> for Written<D, T> {
    fn from(motion: HomogeneousDeformation<D, T>) -> Self {
        Self { deformation: motion.deformation, translation: motion.translation.into() }
    }
}
