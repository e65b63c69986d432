//! Screws: twists by their axes and the axes of twists.
//!
//! ```text
//! rotation about the line through p along the unit vector d, advancing by h for each radian:  ω = d,  v = p×d + h d
//! ```
//!
//! # References
//! R. S. Ball, *A Treatise on the Theory of Screws* (1900).

use nalgebra::Vector3;

use crate::error::{KinematicsError, finite};
use crate::twist::SpaceTwist;
use crate::vector::cross;

/// The axis of a twist: every rigid motion is a screw at every moment.
///
/// # Example
/// See [`SpaceTwist::screw_axis`].
#[doc(alias("Mozzi", "instantaneous axis"))]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(tag = "motion", rename_all = "snake_case", deny_unknown_fields))]
pub enum ScrewAxis {
    /// Rotation about a line and translation along it.
    Screw {
        /// The point of the axis nearest to the origin (m).
        #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::finite::vector"))]
        point: Vector3<f64>,
        /// Unit vector along the axis, towards which ω points.
        #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::finite::vector"))]
        direction: Vector3<f64>,
        /// |ω| (rad/s).
        speed: f64,
        /// Advance for each radian (m/rad).
        pitch: f64,
    },
    /// No rotation.
    Translation {
        /// v (m/s).
        #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::finite::vector"))]
        velocity: Vector3<f64>,
    },
}

impl SpaceTwist<f64> {
    /// Rotation about the line through `point` (m) along `axis`, of any length but zero, at 1 rad/s.
    ///
    /// # Errors
    /// As [`screw`](Self::screw).
    pub fn revolute(point: &Vector3<f64>, axis: &Vector3<f64>) -> Result<Self, KinematicsError> {
        Self::screw(point, axis, 0.0)
    }

    /// Translation along `axis`, of any length but zero, at 1 m/s.
    ///
    /// # Errors
    /// As [`screw`](Self::screw).
    pub fn prismatic(axis: &Vector3<f64>) -> Result<Self, KinematicsError> {
        Ok(Self::new(Vector3::zeros(), direction(axis)?))
    }

    /// Rotation about the line through `point` (m) along `axis`, of any length but zero, at 1 rad/s, and advance
    /// along it by `pitch` (m/rad).
    ///
    /// # Errors
    /// [`KinematicsError::NotFinite`]; [`KinematicsError::NoDirection`] when the axis is zero.
    pub fn screw(point: &Vector3<f64>, axis: &Vector3<f64>, pitch: f64) -> Result<Self, KinematicsError> {
        finite("point", point.as_slice())?;
        finite("pitch", &[pitch])?;
        let angular = direction(axis)?;
        let linear = cross(point, &angular) + angular * pitch;
        finite("velocity", linear.as_slice())?;
        Ok(Self::new(angular, linear))
    }

    /// The axis about which and along which the motion is at this moment.
    ///
    /// ```text
    /// point ω×v/|ω|²     pitch ω·v/|ω|²
    /// ```
    ///
    /// # Errors
    /// [`KinematicsError::NotFinite`], also where the axis is so far away that its place leaves the range of numbers.
    ///
    /// # Accuracy
    /// The point to a few ulps of |v|/|ω|.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Vector3;
    /// use piola_kinematics::{SpaceTwist, twist::ScrewAxis};
    /// let motion = SpaceTwist::screw(&Vector3::x(), &Vector3::z(), 0.25)?.scaled(2.0);
    /// let expected = ScrewAxis::Screw { point: Vector3::x(), direction: Vector3::z(), speed: 2.0, pitch: 0.25 };
    /// assert_eq!(motion.screw_axis()?, expected);
    /// # Ok::<(), piola_kinematics::KinematicsError>(())
    /// ```
    pub fn screw_axis(&self) -> Result<ScrewAxis, KinematicsError> {
        finite("angular velocity", self.angular.as_slice())?;
        finite("velocity", self.linear.as_slice())?;
        // Scaled by the largest component first: the square of a tiny one is zero.
        let largest = self.angular.amax();
        if largest <= 0.0 {
            return Ok(ScrewAxis::Translation { velocity: self.linear });
        }
        let speed = largest * (self.angular / largest).norm();
        let direction = self.angular / largest / (speed / largest);
        let velocity = self.linear / speed;
        let (point, pitch) = (direction.cross(&velocity), direction.dot(&velocity));
        finite("speed", &[speed])?;
        finite("point", point.as_slice())?;
        finite("pitch", &[pitch])?;
        Ok(ScrewAxis::Screw { point, direction, speed, pitch })
    }
}

/// The unit vector along a vector.
fn direction(axis: &Vector3<f64>) -> Result<Vector3<f64>, KinematicsError> {
    finite("axis", axis.as_slice())?;
    let largest = axis.amax();
    if largest <= 0.0 {
        return Err(KinematicsError::NoDirection { quantity: "axis", length: largest });
    }
    Ok((axis / largest).normalize())
}
