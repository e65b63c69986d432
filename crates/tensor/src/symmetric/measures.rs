//! Size, deviator and inverse of symmetric tensors.

use piola_numerics::linear::matrix3::dot;
use piola_numerics::sums::unit_in_last_place;
use piola_numerics::{Mask, Real};

use super::Symmetric;
use crate::TensorError;
use crate::error::check_finite;
use crate::scale::{largest, power_of_two_scale, square_root};

impl<T: Real> Symmetric<T> {
    /// |A| = √(A : A), Frobenius' norm.
    ///
    /// # Accuracy
    /// 4 ulp for components anywhere in the range of numbers: they are scaled by a power of two before they are
    /// squared. At A = 0, where the norm has no derivative, that of differentiable numbers is zero.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn norm(&self) -> T {
        let (scale, unscale) = power_of_two_scale(largest(self.components));
        let scaled = *self * scale;
        square_root(scaled.double_contraction(&scaled)) * unscale
    }

    /// ⅓ tr A.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn mean(&self) -> T {
        self.trace() / T::lit(3.0)
    }

    /// dev A = A − ⅓ tr A 1, from differences of the diagonal: a large mean costs no digits.
    ///
    /// # Accuracy
    /// 3 ulp of the largest difference of two diagonal components.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn deviator(&self) -> Self {
        let [xx, yy, zz, xy, yz, xz] = self.components;
        let three = T::lit(3.0);
        let (d, e, f) = (xx - yy, yy - zz, zz - xx);
        Self { components: [(d - f) / three, (e - d) / three, (f - e) / three, xy, yz, xz] }
    }

    /// ⅓ tr A 1.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn spherical_part(&self) -> Self {
        let mean = self.mean();
        Self::diagonal([mean, mean, mean])
    }

    /// adj A, with A adj A = (det A) 1; it exists for singular tensors too.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn adjugate(&self) -> Self {
        let [xx, yy, zz, xy, yz, xz] = self.components;
        Self {
            components: [
                yy * zz - yz * yz,
                xx * zz - xz * xz,
                xx * yy - xy * xy,
                xz * yz - xy * zz,
                xy * xz - xx * yz,
                xy * yz - xz * yy,
            ],
        }
    }

    /// (A⁻¹, det A), ∞ or NaN when A is singular: the kernel of [`inverse`](Self::inverse), without scaling.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn inverse_and_determinant(&self) -> (Self, T) {
        let adjugate = self.adjugate();
        let [xx, _, _, xy, _, xz] = self.components;
        let [a, _, _, b, _, c] = adjugate.components;
        let determinant = dot([xx, xy, xz], [a, b, c]);
        (adjugate * determinant.recip(), determinant)
    }

    /// A⁻¹.
    ///
    /// # Errors
    /// [`TensorError::NotFinite`]; [`TensorError::SingularTensor`] when, in any lane, |det A| is within
    /// rounding (8 ulp) of zero, compared with the product of the largest components of the rows.
    ///
    /// # Accuracy
    /// A few ulp × the condition number, for components anywhere in the range of numbers.
    pub fn inverse(&self) -> Result<Self, TensorError> {
        check_finite("symmetric tensor", &self.components)?;
        let (scale, unscale) = power_of_two_scale(largest(self.components));
        let scaled = *self * scale;
        let (inverse, determinant) = scaled.inverse_and_determinant();
        let [xx, yy, zz, xy, yz, xz] = scaled.components;
        let volume = largest([xx, xy, xz]) * largest([xy, yy, yz]) * largest([xz, yz, zz]);
        let limit = 8.0 * unit_in_last_place::<T>();
        if (volume * T::lit(limit)).less_than(determinant.abs()).all() {
            return Ok(inverse * scale);
        }
        let regular = |lane: usize| limit * volume.primal(lane) < determinant.primal(lane).abs();
        let lane = (0..T::LANES).find(|&lane| !regular(lane)).unwrap_or(0);
        let scale = unscale.primal(lane);
        Err(TensorError::SingularTensor { relative_determinant: determinant.primal(lane), scale })
    }
}
