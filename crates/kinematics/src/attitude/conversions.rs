//! Attitudes from quaternions, axes, matrices and nalgebra's rotations, validated on the way in.

use nalgebra::{Matrix3, Quaternion, Rotation3, UnitQuaternion, Vector3};
use piola_numerics::Real;

use crate::attitude::Attitude;
use crate::error::{KinematicsError, finite};

impl Attitude<f64> {
    /// The attitude of a quaternion (w, x, y, z) of any length but zero, which is scaled to length one.
    ///
    /// # Errors
    /// [`KinematicsError::NotFinite`]; [`KinematicsError::NoDirection`] when its length is zero.
    pub fn from_quaternion(quaternion: [f64; 4]) -> Result<Self, KinematicsError> {
        finite("quaternion", &quaternion)?;
        // Scaled by the largest component first: the squares of tiny or huge ones leave the range.
        let largest = quaternion.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
        if largest <= 0.0 {
            return Err(KinematicsError::NoDirection { quantity: "quaternion", length: largest });
        }
        let [w, x, y, z] = quaternion.map(|a| a / largest);
        Ok(Self { w, x, y, z }.normalise())
    }

    /// The rotation by `angle` (rad) about `axis`, a vector of any length but zero.
    ///
    /// # Errors
    /// [`KinematicsError::NotFinite`]; [`KinematicsError::NoDirection`] when the axis is zero.
    pub fn from_axis_angle(axis: &Vector3<f64>, angle: f64) -> Result<Self, KinematicsError> {
        finite("axis and angle", &[axis.x, axis.y, axis.z, angle])?;
        let largest = axis.amax();
        if largest <= 0.0 {
            return Err(KinematicsError::NoDirection { quantity: "axis", length: largest });
        }
        let direction = (axis / largest).normalize();
        let (s, c) = (0.5 * angle).sin_cos();
        Ok(Self { w: c, x: direction.x * s, y: direction.y * s, z: direction.z * s })
    }

    /// The attitude of a matrix Q with `f_i = Q_ij e_j` (rows are the body basis; w is taken ≥ 0).
    ///
    /// # Errors
    /// [`KinematicsError::NotFinite`]; [`KinematicsError::NotRotation`] when Q Qᵀ deviates from 1 by more
    /// than 10⁻⁹ or det Q < 0. Smaller deviations, as in printed matrices, are taken away.
    ///
    /// # Source
    /// W(2.22); the choice of the largest component as divisor is Shepperd's (J. Guidance Control 1, 1978).
    pub fn from_matrix(matrix: &Matrix3<f64>) -> Result<Self, KinematicsError> {
        let rows = matrix.transpose();
        finite("rotation matrix", rows.as_slice())?;
        let deviation = (matrix * matrix.transpose() - Matrix3::identity()).amax();
        let determinant = matrix.determinant();
        if ROTATION_TOLERANCE < deviation || determinant < 0.0 {
            return Err(KinematicsError::NotRotation { deviation, determinant });
        }
        // Q is the transpose of the usual body-to-space matrix.
        let column = products(&rows);
        Self::from_quaternion(if column[0] < 0.0 { column.map(|a| -a) } else { column })
    }
}

/// Of a body-to-space matrix: products 4 `q_a` `q_b` of the components of its quaternion, of the largest component `q_a`
/// with all.
pub(crate) fn products(r: &Matrix3<f64>) -> [f64; 4] {
    let trace = r[(0, 0)] + r[(1, 1)] + r[(2, 2)];
    let wx = r[(2, 1)] - r[(1, 2)];
    let wy = r[(0, 2)] - r[(2, 0)];
    let wz = r[(1, 0)] - r[(0, 1)];
    let xy = r[(0, 1)] + r[(1, 0)];
    let yz = r[(1, 2)] + r[(2, 1)];
    let zx = r[(2, 0)] + r[(0, 2)];
    let squares = [1.0 + trace, 1.0 + 2.0 * r[(0, 0)] - trace, 1.0 + 2.0 * r[(1, 1)] - trace];
    if 0.0 <= trace {
        [squares[0], wx, wy, wz]
    } else if r[(1, 1)].max(r[(2, 2)]) <= r[(0, 0)] {
        [wx, squares[1], xy, zx]
    } else if r[(2, 2)] <= r[(1, 1)] {
        [wy, xy, squares[2], yz]
    } else {
        [wz, zx, yz, 1.0 + 2.0 * r[(2, 2)] - trace]
    }
}

/// Largest deviation of a given matrix from orthogonality, or of a quaternion from length one.
const ROTATION_TOLERANCE: f64 = 1.0e-9;

impl<T> From<Attitude<T>> for [T; 4] {
    /// (w, x, y, z).
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn from(attitude: Attitude<T>) -> Self {
        [attitude.w, attitude.x, attitude.y, attitude.z]
    }
}

impl<T: Real> TryFrom<[T; 4]> for Attitude<T> {
    type Error = KinematicsError;

    /// (w, x, y, z) of length one within 10⁻⁹; kept as it is.
    fn try_from(quaternion: [T; 4]) -> Result<Self, KinematicsError> {
        let [w, x, y, z] = quaternion;
        let attitude = Self { w, x, y, z };
        for lane in 0..T::LANES {
            let squared = attitude.squared_length().primal(lane);
            if squared.is_nan() || 2.0 * ROTATION_TOLERANCE < (squared - 1.0).abs() {
                return Err(KinematicsError::NotUnitQuaternion { length: squared.sqrt() });
            }
        }
        Ok(attitude)
    }
}

impl From<UnitQuaternion<f64>> for Attitude<f64> {
    fn from(rotation: UnitQuaternion<f64>) -> Self {
        Self { w: rotation.w, x: rotation.i, y: rotation.j, z: rotation.k }
    }
}

impl From<Attitude<f64>> for UnitQuaternion<f64> {
    fn from(attitude: Attitude<f64>) -> Self {
        Self::new_unchecked(Quaternion::new(attitude.w, attitude.x, attitude.y, attitude.z))
    }
}

impl From<Attitude<f64>> for Rotation3<f64> {
    /// The rotation that takes body to space components, Qᵀ.
    fn from(attitude: Attitude<f64>) -> Self {
        Self::from_matrix_unchecked(attitude.to_matrix().transpose())
    }
}

impl TryFrom<Rotation3<f64>> for Attitude<f64> {
    type Error = KinematicsError;

    /// The attitude whose body-to-space rotation is the given one.
    fn try_from(rotation: Rotation3<f64>) -> Result<Self, KinematicsError> {
        Self::from_matrix(&rotation.matrix().transpose())
    }
}
