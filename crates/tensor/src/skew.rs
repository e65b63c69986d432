//! Skew tensors of second order, as their axial vectors.

use nalgebra::{Matrix3, Vector3};
use piola_numerics::linear::matrix3::{cross, dot, from_rows, rows_of};
use piola_numerics::sums::unit_in_last_place;
use piola_numerics::{Mask, Real};

use super::rotation::check_rotation;
use super::rows::{Rows, apply};
use super::scale;
use super::symmetric::Symmetric;
use crate::TensorError;
use crate::error::check_finite;
use crate::linear_space;

/// A skew tensor W = −Wᵀ, as a spin, by its axial vector w.
///
/// ```text
/// W v = w × v        W = [  0  −w₃  w₂ ]
///                        [  w₃  0  −w₁ ]
///                        [ −w₂  w₁  0  ]
/// ```
///
/// # Example
/// ```
/// use piola_tensor::Skew;
/// let spin = Skew::new(0.0, 0.0, 2.0); // two radians per second about the third axis
/// assert_eq!(spin.apply([3.0, 0.0, 0.0]), [0.0, 6.0, 0.0]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "[T; 3]",
        into = "[T; 3]",
        bound(serialize = "T: Real + serde::Serialize", deserialize = "T: Real + serde::Deserialize<'de>")
    )
)]
#[repr(transparent)]
pub struct Skew<T = f64> {
    /// The axial vector w: the components 32, 13, 21.
    pub axial: [T; 3],
}

impl<T: Real> Skew<T> {
    /// From the axial vector: the components 32, 13, 21.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub const fn new(x: T, y: T, z: T) -> Self {
        Self { axial: [x, y, z] }
    }

    /// 0.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn zero() -> Self {
        Self { axial: [T::zero(); 3] }
    }

    /// ½ (A − Aᵀ).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn skew_part(a: Rows<T>) -> Self {
        Self::difference_from_transpose(a) * T::lit(0.5)
    }

    /// A − Aᵀ, twice the skew part.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn difference_from_transpose(a: Rows<T>) -> Self {
        Self { axial: [a[2][1] - a[1][2], a[0][2] - a[2][0], a[1][0] - a[0][1]] }
    }

    /// A B − B A for symmetric A and B, which is skew.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn commutator(a: &Symmetric<T>, b: &Symmetric<T>) -> Self {
        let (a, b) = (a.rows(), b.rows());
        let entry = |i: usize, j: usize| dot(a[i], b[j]) - dot(a[j], b[i]);
        Self { axial: [entry(2, 1), entry(0, 2), entry(1, 0)] }
    }

    /// From a matrix that is skew to rounding.
    ///
    /// # Errors
    /// [`TensorError::NotFinite`]; [`TensorError::NotSkew`] when two opposite entries add up to more than
    /// 32 ulp of the largest entry.
    pub fn from_matrix(matrix: &Matrix3<T>) -> Result<Self, TensorError> {
        let rows = rows_of(matrix);
        check_finite("skew tensor", rows.as_flattened())?;
        let scale = rows.as_flattened().iter().fold(T::zero(), |scale, x| scale.max(x.abs()));
        let tolerance = scale * T::lit(32.0 * unit_in_last_place::<T>());
        for (row, column) in super::slots::PAIR {
            let sum = rows[row][column] + rows[column][row];
            if !sum.abs().at_most(tolerance).all() {
                let exceeds = |lane: usize| tolerance.primal(lane) < sum.primal(lane).abs();
                let lane = (0..T::LANES).find(|&lane| exceeds(lane)).unwrap_or(0);
                let (sum, scale) = (sum.primal(lane), scale.primal(lane));
                return Err(TensorError::NotSkew { row, column, sum, scale });
            }
        }
        Ok(Self::skew_part(rows))
    }

    /// All nine components as an array of rows.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn rows(&self) -> Rows<T> {
        let ([x, y, z], o) = (self.axial, T::zero());
        [[o, -z, y], [z, o, -x], [-y, x, o]]
    }

    /// All nine components as a matrix.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn matrix(&self) -> Matrix3<T> {
        from_rows(self.rows())
    }

    /// The axial vector w.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn axial_vector(&self) -> Vector3<T> {
        Vector3::from(self.axial)
    }

    /// W v = w × v.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn apply(&self, v: [T; 3]) -> [T; 3] {
        cross(self.axial, v)
    }

    /// W : V = 2 w · v.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn double_contraction(&self, other: &Self) -> T {
        T::lit(2.0) * dot(self.axial, other.axial)
    }

    /// |W| = √(W : W) = √2 |w|.
    ///
    /// # Accuracy
    /// 4 ulp for components anywhere in the range of numbers.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn norm(&self) -> T {
        scale::norm(self.axial) * T::lit(core::f64::consts::SQRT_2)
    }

    /// W A − A W for symmetric A: how A changes while it turns with the spin W.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn turning(&self, a: &Symmetric<T>) -> Symmetric<T> {
        // W A + (W A)ᵀ, column by column: A W = −(W A)ᵀ.
        let rows = a.rows();
        Symmetric::sum_with_transpose([self.apply(rows[0]), self.apply(rows[1]), self.apply(rows[2])])
    }

    /// Q W Qᵀ, the tensor turned by the rotation Q: its axial vector is Q w.
    ///
    /// # Errors
    /// [`TensorError::NotFinite`], [`TensorError::NotARotation`].
    pub fn rotated(&self, rotation: &Matrix3<T>) -> Result<Self, TensorError> {
        check_rotation(rotation)?;
        Ok(Self { axial: apply(rows_of(rotation), self.axial) })
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    #[doc(hidden)]
    pub fn each(a: &Self, b: &Self, f: impl Fn(T, T) -> T) -> Self {
        let (a, b) = (a.axial, b.axial);
        Self { axial: [f(a[0], b[0]), f(a[1], b[1]), f(a[2], b[2])] }
    }
}

linear_space!(Skew);

/// W v = w × v.
impl<T: Real> core::ops::Mul<Vector3<T>> for Skew<T> {
    type Output = Vector3<T>;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn mul(self, v: Vector3<T>) -> Vector3<T> {
        Vector3::from(self.apply([v[0], v[1], v[2]]))
    }
}

/// From the axial vector; refuses infinite and NaN components.
impl<T: Real> TryFrom<[T; 3]> for Skew<T> {
    type Error = TensorError;
    fn try_from(axial: [T; 3]) -> Result<Self, TensorError> {
        check_finite("axial vector", &axial)?;
        Ok(Self { axial })
    }
}

/// The axial vector.
impl<T> From<Skew<T>> for [T; 3] {
    fn from(tensor: Skew<T>) -> Self {
        tensor.axial
    }
}

/// From the axial vector; refuses infinite and NaN components.
impl<T: Real> TryFrom<Vector3<T>> for Skew<T> {
    type Error = TensorError;
    fn try_from(axial: Vector3<T>) -> Result<Self, TensorError> {
        Self::try_from([axial[0], axial[1], axial[2]])
    }
}

impl<T: Real> From<Skew<T>> for Matrix3<T> {
    fn from(tensor: Skew<T>) -> Self {
        tensor.matrix()
    }
}

#[cfg(feature = "glam")]
crate::glam_vectors!(Skew, TensorError, |tensor| tensor.axial);
