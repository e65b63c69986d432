//! Products of symmetric tensors: with vectors, with one another, between two factors.

use core::ops::Mul;

use nalgebra::{Matrix3, Vector3};
use piola_numerics::Real;
use piola_numerics::linear::matrix3::dot;
use piola_numerics::linear::matrix3::{from_rows, rows_of};

use super::Symmetric;
use crate::TensorError;
use crate::rotation::check_rotation;
use crate::rows::{Rows, product, transpose};

impl<T: Real> Symmetric<T> {
    /// v ⊗ v = vᵢ vⱼ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn dyad(v: [T; 3]) -> Self {
        Self { components: [v[0] * v[0], v[1] * v[1], v[2] * v[2], v[0] * v[1], v[1] * v[2], v[0] * v[2]] }
    }

    /// ½ (v ⊗ w + w ⊗ v).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn symmetric_dyad(v: [T; 3], w: [T; 3]) -> Self {
        let half = T::lit(0.5);
        let mean = |i: usize, j: usize| half * (v[i] * w[j] + v[j] * w[i]);
        Self { components: [v[0] * w[0], v[1] * w[1], v[2] * w[2], mean(0, 1), mean(1, 2), mean(0, 2)] }
    }

    /// A B, in general not symmetric.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn product(&self, other: &Self) -> Rows<T> {
        product(self.rows(), other.rows())
    }

    /// A B + B A, twice the symmetric part of the product.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn anticommutator(&self, other: &Self) -> Self {
        let (a, b) = (self.rows(), other.rows());
        let (two, both) = (T::lit(2.0), |i: usize, j: usize| dot(a[i], b[j]) + dot(a[j], b[i]));
        Self {
            components: [
                two * dot(a[0], b[0]),
                two * dot(a[1], b[1]),
                two * dot(a[2], b[2]),
                both(0, 1),
                both(1, 2),
                both(0, 2),
            ],
        }
    }

    /// A² = A A.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn square(&self) -> Self {
        Self::gram(self.rows())
    }

    /// A Aᵀ of a general tensor, symmetric to the last bit.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn gram(a: Rows<T>) -> Self {
        Self {
            components: [
                dot(a[0], a[0]),
                dot(a[1], a[1]),
                dot(a[2], a[2]),
                dot(a[0], a[1]),
                dot(a[1], a[2]),
                dot(a[0], a[2]),
            ],
        }
    }

    /// F A Fᵀ: how a contravariant tensor, as the second Piola–Kirchhoff stress, is carried forward.
    ///
    /// # Accuracy
    /// 6 ulp of |F|² |A|; symmetric because only the upper triangle is computed.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn congruence(&self, f: Rows<T>) -> Self {
        let fa = product(f, self.rows());
        Self {
            components: [
                dot(fa[0], f[0]),
                dot(fa[1], f[1]),
                dot(fa[2], f[2]),
                dot(fa[0], f[1]),
                dot(fa[1], f[2]),
                dot(fa[0], f[2]),
            ],
        }
    }

    /// Fᵀ A F: how a covariant tensor, as Almansi's strain, is carried back.
    ///
    /// # Accuracy
    /// As [`congruence`](Self::congruence).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn transposed_congruence(&self, f: Rows<T>) -> Self {
        self.congruence(transpose(f))
    }

    /// Q A Qᵀ, the tensor turned by the rotation Q.
    ///
    /// # Errors
    /// [`TensorError::NotFinite`], [`TensorError::NotARotation`]. A kernel that knows its Q uses
    /// [`congruence`](Self::congruence).
    pub fn rotated(&self, rotation: &Matrix3<T>) -> Result<Self, TensorError> {
        check_rotation(rotation)?;
        Ok(self.congruence(rows_of(rotation)))
    }
}

/// A v.
impl<T: Real> Mul<Vector3<T>> for Symmetric<T> {
    type Output = Vector3<T>;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn mul(self, v: Vector3<T>) -> Vector3<T> {
        Vector3::from(self.apply([v[0], v[1], v[2]]))
    }
}

/// A B, in general not symmetric.
impl<T: Real> Mul for Symmetric<T> {
    type Output = Matrix3<T>;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn mul(self, other: Self) -> Matrix3<T> {
        from_rows(self.product(&other))
    }
}
