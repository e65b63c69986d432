//! Balance of angular momentum: what is left of it when a stress is not symmetric.
//!
//! ```text
//! T = Tᵀ   W(17.34)        P Fᵀ = F Pᵀ   W(17.35)        residual = 2 · axial vector of the skew part
//! ```

use nalgebra::{Matrix3, Vector3};
use piola_numerics::linear::matrix3::dot;
use piola_numerics::sums::unit_in_last_place;
use piola_numerics::{Mask, Real};
use piola_tensor::TensorError;
use piola_tensor::internal::rows::{Rows, product_transposed};

use super::kernels::moment_of_first_piola;
use super::{BiotStress, FirstPiola, MandelStress};
use crate::{ContinuumError, Deformation};

/// T − Tᵀ of what should be Cauchy's stress, as the vector of its entries 32, 13, 21: the moment per volume that
/// the stress exerts on the body beyond what the balance allows.
///
/// | symbol | argument | shape | unit |
/// |---|---|---|---|
/// | T | `stress` | 3×3 | Pa |
/// | residual | returned | 3 | N m/m³ = Pa |
///
/// # Accuracy
/// Exact differences of the entries, rounded once.
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_continuum::stress::moment_residual;
/// let stress = Matrix3::new(0.0, 1.0, 0.0, 3.0, 0.0, 0.0, 0.0, 0.0, 0.0);
/// assert_eq!(moment_residual(&stress).z, 2.0);
/// ```
///
/// # Source
/// W(17.34).
#[inline]
#[must_use]
pub fn moment_residual<T: Real>(stress: &Matrix3<T>) -> Vector3<T> {
    Vector3::new(stress[(2, 1)] - stress[(1, 2)], stress[(0, 2)] - stress[(2, 0)], stress[(1, 0)] - stress[(0, 1)])
}

impl<T: Real> FirstPiola<T> {
    /// P Fᵀ − F Pᵀ as the vector of its entries 32, 13, 21, N m per reference volume: zero by the balance of
    /// angular momentum.
    ///
    /// # Accuracy
    /// A few ulp of |P| |F|.
    ///
    /// # Source
    /// W(17.35).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn moment_residual(&self, deformation: &impl Deformation<T>) -> Vector3<T> {
        Vector3::from(moment_of_first_piola(deformation.gradient_rows(), self.rows()))
    }

    /// Refuses a stress that does not obey the balance of angular momentum W(17.35) to rounding.
    ///
    /// # Errors
    /// [`TensorError::NotSymmetric`](piola_tensor::TensorError::NotSymmetric) when, in any lane, two opposite entries of P Fᵀ differ by more than
    /// 32 ulp of the largest entry of |P| |F|ᵀ.
    pub fn check_moment(&self, deformation: &impl Deformation<T>) -> Result<(), ContinuumError> {
        let absolute = |rows: Rows<T>| rows.map(|row| row.map(T::abs));
        let (p, f) = (self.rows(), deformation.gradient_rows());
        let terms = product_transposed(absolute(p), absolute(f));
        let scale = terms.as_flattened().iter().fold(T::zero(), |scale, x| scale.max(*x));
        refuse_differences(off_diagonal_differences(p, f), scale, scale * T::lit(32.0 * unit_in_last_place::<T>()))
    }

    /// Where P surely obeys the balance: the differences are within 8 ulp of P Fᵀ itself, which is cheaply seen and never
    /// more than [`check_balance`](Self::check_balance) allows. That one decides on the others.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[doc(hidden)]
    pub fn is_balanced(&self, deformation: &impl Deformation<T>) -> T::Mask {
        let (p, f) = (self.rows(), deformation.gradient_rows());
        let [a, b, c] = off_diagonal_differences(p, f);
        let (x, y, z) = (dot(p[0], f[0]), dot(p[1], f[1]), dot(p[2], f[2]));
        let (u, v, w) = (dot(p[0], f[1]), dot(p[1], f[2]), dot(p[0], f[2]));
        let size = (x * x + y * y + z * z) + (u * u + v * v + w * w);
        let ulps = 8.0 * unit_in_last_place::<T>();
        (a * a + b * b + c * c).at_most(size * T::lit(ulps * ulps)) & size.is_finite()
    }

    /// Refuses a stress that does not obey the balance, unless the roundings of T Cof F or F S, from which it may have
    /// been computed, allow that.
    ///
    /// # Errors
    /// [`TensorError::NotSymmetric`](piola_tensor::TensorError::NotSymmetric) when two opposite entries of P Fᵀ differ by more than 96 ulp of
    /// |P| |F| max(1, |F|³/J), by largest entries: T Cof F is rounded by ulp of |T| |F|², and T is |P| |F|/J.
    #[cold]
    #[doc(hidden)]
    pub fn check_balance(&self, deformation: &impl Deformation<T>) -> Result<(), ContinuumError> {
        let differences = off_diagonal_differences(self.rows(), deformation.gradient_rows());
        let (scale, tolerance) = self.tolerated(deformation);
        refuse_differences(differences, scale, tolerance)
    }

    /// |P| |F|, and how much of it roundings may make of the difference of opposite entries.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn tolerated(&self, deformation: &impl Deformation<T>) -> (T, T) {
        let f = largest(deformation.gradient_rows());
        let scale = largest(self.rows()) * f;
        let magnified = scale * T::one().max(f * f * f / deformation.jacobian());
        (scale, magnified * T::lit(96.0 * unit_in_last_place::<T>()))
    }
}

/// (P Fᵀ)₁₂ − (P Fᵀ)₂₁, and those of 23 and 13.
#[cfg_attr(not(debug_assertions), inline(always))]
fn off_diagonal_differences<T: Real>(p: Rows<T>, f: Rows<T>) -> [T; 3] {
    [dot(p[0], f[1]) - dot(p[1], f[0]), dot(p[1], f[2]) - dot(p[2], f[1]), dot(p[0], f[2]) - dot(p[2], f[0])]
}

/// The size of the largest entry.
#[cfg_attr(not(debug_assertions), inline(always))]
fn largest<T: Real>([a, b, c]: Rows<T>) -> T {
    largest_of(a).max(largest_of(b)).max(largest_of(c))
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn largest_of<T: Real>([x, y, z]: [T; 3]) -> T {
    x.abs().max(y.abs()).max(z.abs())
}

/// Refuses the first difference above the tolerance, of any lane.
fn refuse_differences<T: Real>(differences: [T; 3], scale: T, tolerance: T) -> Result<(), ContinuumError> {
    for (difference, (row, column)) in differences.into_iter().zip([(0, 1), (1, 2), (0, 2)]) {
        if !difference.abs().at_most(tolerance).all() {
            let exceeds = |lane: usize| tolerance.primal(lane) < difference.primal(lane).abs();
            let lane = (0..T::LANES).find(|&lane| exceeds(lane)).unwrap_or(0);
            return Err(ContinuumError::Tensor(TensorError::NotSymmetric {
                quantity: "P F^T",
                row,
                column,
                difference: difference.primal(lane),
                scale: scale.primal(lane),
            }));
        }
    }
    Ok(())
}

impl<T: Real> MandelStress<T> {
    /// As [`FirstPiola::moment_residual`], of P = F⁻ᵀ M.
    #[inline]
    #[must_use]
    pub fn moment_residual(&self, deformation: &impl Deformation<T>) -> Vector3<T> {
        self.first_piola(deformation).moment_residual(deformation)
    }
}

impl<T: Real> BiotStress<T> {
    /// Entries 32, 13, 21 of Rᵀ P − Pᵀ R: what its [symmetric part](Self::symmetric_part) leaves out. It need
    /// not vanish.
    #[inline]
    #[must_use]
    pub fn skew_residual(&self) -> Vector3<T> {
        moment_residual(&self.0)
    }
}
