//! Homogeneous and rigid motions.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::DeformationGradient;
use piola_numerics::Real;

use super::Motion;
use crate::FieldsError;
use crate::error::check_finite;

/// F(t) and c(t) of a [`Homogeneous`] motion.
pub trait AffineHistory {
    /// F(t), with 0 < det F.
    fn gradient<T: Real>(&self, t: T) -> Matrix3<T>;

    /// ∇u(t) = F(t) − 1: a history that knows it states it here, and F from it, and keeps small strains exact.
    #[inline]
    fn displacement_gradient<T: Real>(&self, t: T) -> Matrix3<T> {
        self.gradient(t) - identity()
    }

    /// c(t), m; zero unless stated.
    #[inline]
    fn translation<T: Real>(&self, t: T) -> Vector3<T> {
        let _ = t;
        Vector3::repeat(T::zero())
    }
}

/// The homogeneous motion x = F(t) X + c(t), W(14.10).
///
/// # Example
/// A rod stretched along its axis while its cross section shrinks.
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use piola_fields::{AffineHistory, Homogeneous, Motion};
/// use piola_numerics::Real;
/// struct Pull;
/// impl AffineHistory for Pull {
///     fn gradient<T: Real>(&self, t: T) -> Matrix3<T> {
///         let stretch = T::lit(1.0) + t;
///         Matrix3::from_diagonal(&Vector3::new(stretch, T::lit(1.0), T::lit(1.0) / stretch))
///     }
/// }
/// let motion = Homogeneous(Pull);
/// let particle = Vector3::new(2.0, 0.0, 1.0);
/// assert_eq!(motion.position(&particle, 1.0)?, Vector3::new(4.0, 0.0, 0.5));
/// assert_eq!(motion.velocity(&particle, 1.0)?, Vector3::new(2.0, 0.0, -0.25));
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Homogeneous<H>(pub H);

impl<H: AffineHistory> Motion for Homogeneous<H> {
    #[inline]
    fn place<T: Real>(&self, reference: &Vector3<T>, t: T) -> Vector3<T> {
        self.0.gradient(t) * reference + self.0.translation(t)
    }
    #[inline]
    fn displacement<T: Real>(&self, reference: &Vector3<T>, t: T) -> Vector3<T> {
        self.0.displacement_gradient(t) * reference + self.0.translation(t)
    }
}

/// The homogeneous deformation x = F X + c at rest, W(14.10).
///
/// # Example
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use piola_continuum::DeformationGradient;
/// use piola_fields::{Affine, Motion};
/// let stretch = DeformationGradient::new(Matrix3::from_diagonal(&Vector3::new(2.0, 1.0, 1.0)))?;
/// let deformation = Affine::new(stretch, Vector3::new(0.0, 0.0, 5.0))?;
/// let x = deformation.position(&Vector3::new(3.0, 1.0, 0.0), 0.0)?;
/// assert_eq!(x, Vector3::new(6.0, 1.0, 5.0));
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Parts"))]
pub struct Affine {
    gradient: DeformationGradient,
    translation: Vector3<f64>,
}

/// What is read of an [`Affine`] before it is checked.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
struct Parts {
    gradient: DeformationGradient,
    translation: Vector3<f64>,
}

#[cfg(feature = "serde")]
impl TryFrom<Parts> for Affine {
    type Error = FieldsError;
    fn try_from(parts: Parts) -> Result<Self, FieldsError> {
        Self::new(parts.gradient, parts.translation)
    }
}

impl Affine {
    /// From F and c, m.
    ///
    /// # Errors
    /// [`FieldsError::NotFinite`].
    pub fn new(gradient: DeformationGradient, translation: Vector3<f64>) -> Result<Self, FieldsError> {
        check_finite("translation", translation.as_slice())?;
        Ok(Self { gradient, translation })
    }
}

impl Motion for Affine {
    #[inline]
    fn place<T: Real>(&self, reference: &Vector3<T>, _time: T) -> Vector3<T> {
        self.gradient.matrix().map(T::lit) * reference + self.translation.map(T::lit)
    }
    #[inline]
    fn displacement<T: Real>(&self, reference: &Vector3<T>, _time: T) -> Vector3<T> {
        (self.gradient.matrix() - Matrix3::identity()).map(T::lit) * reference + self.translation.map(T::lit)
    }
}

/// R(t) and c(t) of a [`Rigid`] motion.
pub trait RigidHistory {
    /// The rotation R(t) as a quaternion (w, x, y, z) of any length but zero: every such history is a rotation.
    ///
    /// An angle φ about the unit vector e is (cos ½φ, e sin ½φ).
    fn attitude<T: Real>(&self, t: T) -> [T; 4];

    /// c(t), m; zero unless stated.
    #[inline]
    fn translation<T: Real>(&self, t: T) -> Vector3<T> {
        let _ = t;
        Vector3::repeat(T::zero())
    }
}

/// The rigid motion x = R(t) X + c(t).
///
/// # Accuracy
/// `FᵀF` − 1 is within a few ulp of zero at any time; ∇u is computed without cancellation for small angles.
///
/// # Example
/// A turn about the third axis at 3 radians per second: the acceleration points to the axis.
/// ```
/// use nalgebra::Vector3;
/// use piola_fields::{Motion, Rigid, RigidHistory};
/// use piola_numerics::Real;
/// struct Spin;
/// impl RigidHistory for Spin {
///     fn attitude<T: Real>(&self, t: T) -> [T; 4] {
///         let (s, c) = (T::lit(1.5) * t).sin_cos();
///         [c, T::lit(0.0), T::lit(0.0), s]
///     }
/// }
/// let acceleration = Rigid(Spin).acceleration(&Vector3::new(2.0, 0.0, 1.0), 0.0)?;
/// assert_eq!(acceleration, Vector3::new(-18.0, 0.0, 0.0)); // −ω² r
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Rigid<H>(pub H);

impl<H: RigidHistory> Motion for Rigid<H> {
    #[inline]
    fn place<T: Real>(&self, reference: &Vector3<T>, t: T) -> Vector3<T> {
        (turn_less_identity(self.0.attitude(t)) + identity()) * reference + self.0.translation(t)
    }
    #[inline]
    fn displacement<T: Real>(&self, reference: &Vector3<T>, t: T) -> Vector3<T> {
        turn_less_identity(self.0.attitude(t)) * reference + self.0.translation(t)
    }
}

/// 1.
#[cfg_attr(not(debug_assertions), inline(always))]
fn identity<T: Real>() -> Matrix3<T> {
    let (o, l) = (T::zero(), T::one());
    Matrix3::new(l, o, o, o, l, o, o, o, l)
}

/// R − 1 = 2 (w [v]× + [v]×²)/|q|² for q = (w, v).
#[cfg_attr(not(debug_assertions), inline(always))]
fn turn_less_identity<T: Real>([w, x, y, z]: [T; 4]) -> Matrix3<T> {
    let two = T::lit(2.0) / (w * w + x * x + y * y + z * z);
    Matrix3::new(
        -(y * y + z * z),
        x * y - w * z,
        x * z + w * y,
        x * y + w * z,
        -(x * x + z * z),
        y * z - w * x,
        x * z - w * y,
        y * z + w * x,
        -(x * x + y * y),
    ) * two
}
