//! Chains of joints: the pose of the last link and the twists of the joints where they are.
//!
//! A chain of joints that turn about or slide along axes fixed in the previous link is a product of exponentials of
//! the joints' twists in the position where all coordinates are zero:
//!
//! ```text
//! g(q) = exp(q¹ξ_1) exp(q²ξ_2) … g(0)        ξ_s = Σ q̇ⁱ Ad_{exp(q¹ξ_1)…exp(qⁱ⁻¹ξ_{i−1})} ξ_i
//! ```
//!
//! # References
//! R. W. Brockett, in Mathematical Theory of Networks and Systems, Lecture Notes in Control and Information
//! Sciences 58, Springer (1984).

use piola_numerics::Real;

use crate::error::{KinematicsError, length};
use crate::rigid_body::BodyPose;
use crate::twist::SpaceTwist;

/// The pose of the last link of a chain of joints: the product of exponentials of their twists.
///
/// | symbol | argument | shape | unit |
/// |---|---|---|---|
/// | `ξ_i` | `joints`, where all coordinates are zero, from the base outwards | n | rad, m for each unit of the coordinate |
/// | q | `q` | n | rad or m |
/// | g(0) | `home`, the link where all coordinates are zero | pose | m |
/// | g(q) | returned | pose | m |
///
/// # Errors
/// [`KinematicsError::WrongLength`] unless there are as many coordinates as joints.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_kinematics::{BodyPose, SpaceTwist, twist::product_of_exponentials};
/// // Two arms of 1 m along x with parallel joints: folded at the elbow, the hand is back at the shoulder.
/// let joints = [SpaceTwist::revolute(&Vector3::zeros(), &Vector3::z())?, SpaceTwist::revolute(&Vector3::x(), &Vector3::z())?];
/// let home = BodyPose { position: Vector3::new(2.0, 0.0, 0.0), ..BodyPose::at_rest() };
/// let hand = product_of_exponentials(&joints, &[0.5, std::f64::consts::PI], &home)?;
/// assert!(hand.position.amax() <= 4.0 * f64::EPSILON);
/// # Ok::<(), piola_kinematics::KinematicsError>(())
/// ```
///
/// # Source
/// Brockett (1984).
#[doc(alias("forward kinematics", "POE"))]
pub fn product_of_exponentials<T: Real>(
    joints: &[SpaceTwist<f64>],
    q: &[T],
    home: &BodyPose<f64>,
) -> Result<BodyPose<T>, KinematicsError> {
    length("coordinates", q.len(), joints.len())?;
    // From the hand inwards, so that each link is moved once.
    Ok(joints.iter().zip(q).rev().fold(BodyPose::constant(home), |outer, (joint, &q)| {
        SpaceTwist::constant(joint).scaled(q).exponential().product(&outer)
    }))
}

/// The joints' twists where they are at q: the columns of the chain's Jacobian, `ξ_s = Σ q̇ⁱ columns[i]`.
///
/// # Errors
/// [`KinematicsError::WrongLength`] unless there are as many coordinates and columns as joints.
///
/// # Source
/// Brockett (1984).
#[doc(alias = "Jacobian")]
pub fn joint_twists_into<T: Real>(
    joints: &[SpaceTwist<f64>],
    q: &[T],
    columns: &mut [SpaceTwist<T>],
) -> Result<(), KinematicsError> {
    length("coordinates", q.len(), joints.len())?;
    length("columns", columns.len(), joints.len())?;
    let mut reached = BodyPose::at_rest();
    for ((joint, &q), column) in joints.iter().zip(q).zip(columns) {
        let joint = SpaceTwist::constant(joint);
        *column = joint.displaced(&reached);
        reached = reached.product(&joint.scaled(q).exponential());
    }
    Ok(())
}
