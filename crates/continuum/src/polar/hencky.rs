//! Rotation, stretch and logarithm of one deformation, with the widest instructions of the machine.

use core::marker::PhantomData;

use nalgebra::Matrix3;
use piola_numerics::linear::matrix3::from_rows;
#[cfg(feature = "serde")]
use piola_numerics::linear::matrix3::rows_of;
use piola_numerics::{Kernel, Real, dispatch};
#[cfg(feature = "serde")]
use piola_tensor::{internal::positive_definite, rotation::check_rotation};

use super::StretchAnalysis;
#[cfg(feature = "serde")]
use crate::{ContinuumError, error::check_finite};
use crate::{Deformation, Symmetric};

/// What [`polar_hencky`] finds.
///
/// What is read is checked as [`Rotation`](crate::strain::Rotation), [`RightStretch`](crate::strain::RightStretch) and
/// [`HenckyStrain`](crate::strain::HenckyStrain) are.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "Written<T>",
        into = "Written<T>",
        bound(serialize = "T: Real + serde::Serialize", deserialize = "T: Real + serde::Deserialize<'de>")
    )
)]
pub struct PolarHencky<T: Real = f64> {
    /// R of F = R U.
    pub rotation: Matrix3<T>,
    /// U.
    pub right_stretch: Symmetric<T>,
    /// ln U.
    pub hencky: Symmetric<T>,
}

/// The parts as they are written.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Written<T> {
    rotation: [[T; 3]; 3],
    right_stretch: [T; 6],
    hencky: [T; 6],
}

#[cfg(feature = "serde")]
impl<T: Real> TryFrom<Written<T>> for PolarHencky<T> {
    type Error = ContinuumError;
    fn try_from(Written { rotation, right_stretch, hencky }: Written<T>) -> Result<Self, ContinuumError> {
        let rotation = from_rows(rotation);
        check_rotation(&rotation)?;
        check_finite("U", &right_stretch)?;
        let right_stretch = Symmetric { components: right_stretch };
        positive_definite("U", &right_stretch)?;
        check_finite("ln U", &hencky)?;
        Ok(Self { rotation, right_stretch, hencky: Symmetric { components: hencky } })
    }
}

#[cfg(feature = "serde")]
impl<T: Real> From<PolarHencky<T>> for Written<T> {
    fn from(PolarHencky { rotation, right_stretch, hencky }: PolarHencky<T>) -> Self {
        Self { rotation: rows_of(&rotation), right_stretch: right_stretch.components, hencky: hencky.components }
    }
}

/// R, U and ln U of one deformation, by code that is chosen at run time for the machine.
///
/// ```text
/// F = R U,   ln U = Σ ln λₖ qₖ ⊗ qₖ
/// ```
/// | symbol | what | shape, unit |
/// |---|---|---|
/// | F | the deformation gradient | 3×3, 1 |
/// | R, U | its polar factors, W(14.11) | 3×3 rotation; symmetric, positive, 1 |
/// | λₖ, qₖ | principal stretches and axes of U | 1 |
///
/// The numbers are those of [`StretchAnalysis`] to the last bit. That one is compiled into its caller for the machine
/// that the caller is compiled for, and computes single quantities; this one saves a sixth of the time where all three
/// are needed and the caller is compiled for any x86-64. For many points at a time, `piola-batch` takes a
/// third of the time.
///
/// # Accuracy
/// That of [`StretchAnalysis`].
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_continuum::DeformationGradient;
/// use piola_continuum::polar::polar_hencky;
/// // Twice as long along 1, then turned by 90° about 3.
/// let f = DeformationGradient::new(Matrix3::new(0.0, -1.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 1.0))?;
/// let polar = polar_hencky(&f);
/// assert_eq!(polar.rotation, Matrix3::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0));
/// assert_eq!(polar.right_stretch.components[..3], [2.0, 1.0, 1.0]);
/// assert_eq!(polar.hencky.components[0], 2.0_f64.ln());
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[inline]
#[must_use]
pub fn polar_hencky<T: Real, D: Deformation<T>>(deformation: &D) -> PolarHencky<T> {
    dispatch(Point { deformation, scalar: PhantomData })
}

/// The computation, compiled for each set of instructions.
struct Point<'a, T, D> {
    deformation: &'a D,
    scalar: PhantomData<T>,
}

impl<T: Real, D: Deformation<T>> Kernel for Point<'_, T, D> {
    type Output = PolarHencky<T>;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) -> PolarHencky<T> {
        let stretch = StretchAnalysis::of(self.deformation);
        // The logarithms first, beside which the rest is computed.
        let hencky = stretch.hencky_material();
        let right_stretch = stretch.right_stretch();
        PolarHencky { rotation: from_rows(stretch.rotation()), right_stretch, hencky }
    }
}
