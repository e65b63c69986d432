//! Balance of moment of momentum: what is left of it when a stress is not symmetric.
//!
//! ```text
//! T = Tᵀ   W(17.34)        P Fᵀ = F Pᵀ   W(17.35)        residual = 2 · axial vector of the skew part
//! ```

use nalgebra::{Matrix3, Vector3};
use piola_numerics::sums::unit_in_last_place;
use piola_numerics::{Mask, Real};

use super::kernels::moment_of_first_piola;
use super::{BiotStress, FirstPiola, MandelStress};
use crate::tensor::rows::{Rows, product_transposed};
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
    /// moment of momentum.
    ///
    /// # Accuracy
    /// A few ulp of |P| |F|.
    ///
    /// # Example
    /// ```
    /// use nalgebra::{Matrix3, Vector3};
    /// use piola_continuum::{CauchyStress, DeformationGradient};
    /// let shear = DeformationGradient::new(Matrix3::new(1.0, 0.5, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0))?;
    /// let stress = CauchyStress::new(1.0, 2.0, 4.0, 3.0, 0.0, 0.0)?.first_piola(&shear);
    /// assert_eq!(stress.moment_residual(&shear), Vector3::zeros());
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    ///
    /// # Source
    /// W(17.35).
    #[inline(always)]
    #[must_use]
    pub fn moment_residual(&self, deformation: &impl Deformation<T>) -> Vector3<T> {
        Vector3::from(moment_of_first_piola(deformation.gradient_rows(), self.rows()))
    }

    /// Refuses a stress that does not obey the balance of moment of momentum W(17.35) to rounding.
    ///
    /// # Errors
    /// [`ContinuumError::NotSymmetric`] when, in any lane, two opposite entries of P Fᵀ differ by more than
    /// 32 ulp of the largest entry of |P| |F|ᵀ.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Matrix3;
    /// use piola_continuum::{DeformationGradient, FirstPiola};
    /// let identity = DeformationGradient::new(Matrix3::identity())?;
    /// let twist = FirstPiola::new(Matrix3::new(0.0, 1.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 0.0))?;
    /// assert!(twist.check_moment(&identity).is_err());
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    pub fn check_moment(&self, deformation: &impl Deformation<T>) -> Result<(), ContinuumError> {
        let absolute = |rows: Rows<T>| rows.map(|row| row.map(T::abs));
        let (p, f) = (self.rows(), deformation.gradient_rows());
        let kirchhoff = product_transposed(p, f);
        let terms = product_transposed(absolute(p), absolute(f));
        let scale = terms.as_flattened().iter().fold(T::zero(), |scale, x| scale.max(*x));
        let tolerance = scale * T::lit(32.0 * unit_in_last_place::<T>());
        for (row, column) in [(0, 1), (1, 2), (0, 2)] {
            let difference = kirchhoff[row][column] - kirchhoff[column][row];
            if !difference.abs().at_most(tolerance).all() {
                let exceeds = |lane: usize| tolerance.primal(lane) < difference.primal(lane).abs();
                let lane = (0..T::LANES).find(|&lane| exceeds(lane)).unwrap_or(0);
                return Err(ContinuumError::NotSymmetric {
                    quantity: "P F^T",
                    row,
                    column,
                    difference: difference.primal(lane),
                    scale: scale.primal(lane),
                });
            }
        }
        Ok(())
    }
}

impl<T: Real> MandelStress<T> {
    /// As [`FirstPiola::moment_residual`], of P = F⁻ᵀ M.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::{DeformationGradient, MandelStress};
    /// let stress = MandelStress::from_rows([[0.0, 1.0, 0.0], [3.0, 0.0, 0.0], [0.0; 3]])?;
    /// assert_eq!(stress.moment_residual(&DeformationGradient::identity()).z, 2.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline]
    #[must_use]
    pub fn moment_residual(&self, deformation: &impl Deformation<T>) -> Vector3<T> {
        self.first_piola(deformation).moment_residual(deformation)
    }
}

impl<T: Real> BiotStress<T> {
    /// Entries 32, 13, 21 of Rᵀ P − Pᵀ R: what its [symmetric part](Self::symmetric_part) leaves out. It need
    /// not vanish.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::BiotStress;
    /// let stress = BiotStress::from_rows([[0.0, 1.0, 0.0], [3.0, 0.0, 0.0], [0.0; 3]])?;
    /// assert_eq!(stress.skew_residual().z, 2.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline]
    #[must_use]
    pub fn skew_residual(&self) -> Vector3<T> {
        moment_residual(&self.0)
    }
}
