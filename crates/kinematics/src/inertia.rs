//! Inertia tensors of rigid bodies: what they may be, how they move.
//!
//! ```text
//! I = ∫ (|r|² 1 − r⊗r) dμ,   r from the centre of mass, body components        W(2.33)
//! ```
//!
//! An [`Inertia`] is symmetric, positive definite and obeys I₃ ≤ I₁ + I₂, because I₁ + I₂ − I₃ = 2∫z²dμ.
//! A body without thickness about an axis (a thin rod, I₁ = 0) is refused: its attitude about that axis
//! does not exist and the equations of motion would be singular. Place it as particles (two of mass m/6
//! at the ends and one of 2m/3 in the middle move as a uniform rod of mass m does).
//!
//! # References
//! W(2.33–2.34).

use nalgebra::{Matrix3, SymmetricEigen, Vector3};
use piola_numerics::Real;

use crate::attitude::Attitude;
use crate::error::{KinematicsError, finite};
use crate::vector::constant_matrix_times;

/// The inertia tensor of a rigid body about its centre of mass, in body components.
///
/// # Example
/// ```
/// use piola_kinematics::Inertia;
/// let inertia = Inertia::principal([1.0, 2.0, 2.5])?;
/// assert_eq!(inertia.matrix()[(2, 2)], 2.5);
/// // No body has 1 + 2 < 4.
/// assert!(Inertia::principal([1.0, 2.0, 4.0]).is_err());
/// # Ok::<(), piola_kinematics::KinematicsError>(())
/// ```
///
/// # Source
/// W(2.33–2.34).
#[doc(alias("moment of inertia", "inertia tensor"))]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "[[f64; 3]; 3]", into = "[[f64; 3]; 3]"))]
pub struct Inertia {
    /// Symmetric to the last bit.
    matrix: Matrix3<f64>,
}

/// Principal moments I₁ ≤ I₂ ≤ I₃ and the right-handed basis of their axes.
///
/// # Example
/// ```
/// use piola_kinematics::Inertia;
/// let principal = Inertia::principal([3.0, 1.0, 2.5])?.principal_axes();
/// assert_eq!(principal.moments, [1.0, 2.5, 3.0]);
/// # Ok::<(), piola_kinematics::KinematicsError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrincipalAxes {
    /// I₁ ≤ I₂ ≤ I₃, in kg m².
    pub moments: [f64; 3],
    /// Column i is the axis of moment i, in body components; det = +1.
    pub axes: Matrix3<f64>,
}

/// Relative deviation from symmetry and from the triangle inequality that is taken for rounding of the
/// data, and the smallest I₁/I₃ that is not taken for zero.
const TOLERANCE: f64 = 1.0e-12;

impl Inertia {
    /// The inertia tensor with the given matrix about the centre of mass (body components, kg m²).
    ///
    /// # Errors
    /// With I₁ ≤ I₂ ≤ I₃ the principal moments, and rounding understood as 10⁻¹² I₃:
    /// [`NotFinite`](KinematicsError::NotFinite);
    /// [`InertiaNotSymmetric`](KinematicsError::InertiaNotSymmetric) unless `I_ij` = `I_ji`;
    /// [`InertiaNotPositiveDefinite`](KinematicsError::InertiaNotPositiveDefinite) unless 0 < I₁;
    /// [`InertiaTriangleInequality`](KinematicsError::InertiaTriangleInequality) unless I₃ ≤ I₁ + I₂.
    ///
    /// # Source
    /// W(2.34).
    pub fn new(matrix: Matrix3<f64>) -> Result<Self, KinematicsError> {
        finite("inertia tensor", matrix.transpose().as_slice())?;
        let scale = matrix.amax();
        for (row, column) in [(0, 1), (0, 2), (1, 2)] {
            let difference = matrix[(row, column)] - matrix[(column, row)];
            if TOLERANCE * scale < difference.abs() {
                return Err(KinematicsError::InertiaNotSymmetric { row, column, difference });
            }
        }
        let inertia = Self { matrix: matrix * 0.5 + matrix.transpose() * 0.5 };
        let principal_moments = inertia.principal_moments();
        let [smallest, middle, largest] = principal_moments;
        if smallest <= TOLERANCE * largest.abs() {
            return Err(KinematicsError::InertiaNotPositiveDefinite { principal_moments });
        }
        if smallest + middle < largest * (1.0 - TOLERANCE) {
            return Err(KinematicsError::InertiaTriangleInequality { principal_moments });
        }
        Ok(inertia)
    }

    /// The inertia tensor with the given moments about the body axes, which are principal (kg m²).
    ///
    /// # Errors
    /// As [`new`](Inertia::new).
    pub fn principal(moments: [f64; 3]) -> Result<Self, KinematicsError> {
        Self::new(Matrix3::from_diagonal(&Vector3::from(moments)))
    }

    /// The matrix about the centre of mass, in body components (kg m²).
    #[inline]
    #[must_use]
    pub fn matrix(&self) -> Matrix3<f64> {
        self.matrix
    }

    /// I a, for the angular velocity, its rate or a tangent's angular velocity in body components.
    #[inline]
    #[must_use]
    pub fn times<T: Real>(&self, in_body: &Vector3<T>) -> Vector3<T> {
        constant_matrix_times(&self.matrix, in_body)
    }

    /// Principal moments in ascending order (kg m²).
    ///
    /// # Accuracy
    /// A few ulps of the largest moment.
    #[must_use]
    pub fn principal_moments(&self) -> [f64; 3] {
        self.principal_axes().moments
    }

    /// Principal moments in ascending order and a right-handed basis of their axes.
    ///
    /// ```text
    /// I = A diag(I₁, I₂, I₃) Aᵀ,   A = axes
    /// ```
    ///
    /// Of the many such bases always the same is returned:
    /// * of moments that differ, the first two axes point so that their largest component is positive (the
    ///   earlier one, where two are equal to 10⁻⁸), and the third completes the right-handed basis;
    /// * where two moments are equal to 64 ε I₃, one of their axes is as near as can be to a body axis, the
    ///   first of those that are most nearly perpendicular to the axis of the third moment;
    /// * where all three are, the axes are the body axes.
    ///
    /// # Accuracy
    /// Moments to a few ulps of the largest; axes to a few ulps × I₃/(difference of the moments).
    ///
    /// # Source
    /// W(2.33–2.34).
    #[must_use]
    pub fn principal_axes(&self) -> PrincipalAxes {
        let eigen = SymmetricEigen::new(self.matrix);
        let mut order = [0, 1, 2];
        order.sort_by(|&i, &j| eigen.eigenvalues[i].total_cmp(&eigen.eigenvalues[j]));
        let moments = order.map(|i| eigen.eigenvalues[i]);
        let axis = |i: usize| pointed(eigen.eigenvectors.column(order[i]).into_owned());
        let near = |i: usize| moments[i + 1] - moments[i] <= EQUAL * moments[2].abs();
        let axes = match (near(0), near(1)) {
            (true, true) => [Vector3::x(), Vector3::y(), Vector3::z()],
            (true, false) => {
                let unique = axis(2);
                let first = across(&unique);
                [first, unique.cross(&first), unique]
            }
            (false, true) => {
                let unique = axis(0);
                let second = across(&unique);
                [unique, second, unique.cross(&second)]
            }
            (false, false) => {
                let (first, second) = (axis(0), axis(1));
                [first, second, first.cross(&second)]
            }
        };
        PrincipalAxes { moments, axes: Matrix3::from_columns(&axes) }
    }

    /// The same body in turned body axes: `attitude` is that of the old axes seen from the new.
    ///
    /// ```text
    /// I_new = R I Rᵀ,   R v = attitude.to_space(v)
    /// ```
    #[must_use]
    pub fn rotated(&self, attitude: Attitude<f64>) -> Self {
        let q = attitude.to_matrix();
        let matrix = q.transpose() * self.matrix * q;
        Self { matrix: matrix * 0.5 + matrix.transpose() * 0.5 }
    }

    /// The tensor about the point c + `offset` of a body of the given mass (kg m², body components).
    ///
    /// ```text
    /// I_P = I + m (|s|² 1 − s⊗s),   s = offset from the centre of mass
    /// ```
    ///
    /// The inverse is [`about_centre_of_mass`](Inertia::about_centre_of_mass).
    ///
    /// # Source
    /// W(2.33), parallel axes.
    #[doc(alias("parallel axis theorem", "Steiner"))]
    #[must_use]
    pub fn about_offset_point(&self, mass: f64, offset: &Vector3<f64>) -> Matrix3<f64> {
        self.matrix + point_inertia(mass, offset)
    }

    /// The tensor about the centre of mass from the one about the point c + `offset`.
    ///
    /// # Errors
    /// As [`new`](Inertia::new): an offset that is too long for the given tensor leaves none.
    ///
    /// # Accuracy
    /// Cancellation: absolute error of a few ulps of the *given* tensor.
    pub fn about_centre_of_mass(
        about_offset_point: Matrix3<f64>,
        mass: f64,
        offset: &Vector3<f64>,
    ) -> Result<Self, KinematicsError> {
        Self::new(about_offset_point - point_inertia(mass, offset))
    }
}

/// Moments that differ by less than this multiple of the largest are equal to the rounding of the axes.
const EQUAL: f64 = 64.0 * f64::EPSILON;

/// ±axis, the largest component positive; the earlier one where two are equal to √ε.
fn pointed(axis: Vector3<f64>) -> Vector3<f64> {
    let nearly_largest = axis.amax() * (1.0 - 1.0e-8);
    match axis.iter().find(|component| nearly_largest <= component.abs()) {
        Some(component) if *component < 0.0 => -axis,
        _ => axis,
    }
}

/// A unit vector across a unit vector, as near as can be to a body axis: the first of those most across.
fn across(axis: &Vector3<f64>) -> Vector3<f64> {
    let nearly_least = axis.iter().fold(1.0_f64, |least, component| least.min(component.abs())) + 1.0e-8;
    let chosen = axis.iter().position(|component| component.abs() <= nearly_least).unwrap_or(0);
    let mut across = -axis * axis[chosen];
    across[chosen] += 1.0;
    across.normalize()
}

/// m (|s|² 1 − s⊗s): the inertia of a particle at s about the origin.
pub(crate) fn point_inertia(mass: f64, s: &Vector3<f64>) -> Matrix3<f64> {
    // Written by components: |s|² − x² would cancel.
    let (x, y, z) = (s.x, s.y, s.z);
    Matrix3::new(y * y + z * z, -x * y, -x * z, -x * y, z * z + x * x, -y * z, -x * z, -y * z, x * x + y * y) * mass
}

impl TryFrom<[[f64; 3]; 3]> for Inertia {
    type Error = KinematicsError;

    /// Rows of the matrix about the centre of mass.
    fn try_from(rows: [[f64; 3]; 3]) -> Result<Self, KinematicsError> {
        Self::new(Matrix3::from(rows).transpose())
    }
}

impl From<Inertia> for [[f64; 3]; 3] {
    /// Rows of the matrix about the centre of mass.
    fn from(inertia: Inertia) -> Self {
        inertia.matrix.transpose().into()
    }
}
