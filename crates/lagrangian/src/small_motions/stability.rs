//! What becomes of a small disturbance.

use nalgebra::{DMatrix, SymmetricEigen};

use super::Linearisation;
use super::normal_modes::SWEEPS;
use super::reduction::Reduction;
use crate::{LagrangianError, SmallMotionsError};

/// What becomes of a small disturbance.
///
/// # Example
/// See [`ComplexModes`](super::ComplexModes).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Stability {
    /// Every small motion dies away, and so does every sufficiently small one of the full equations.
    Asymptotic,
    /// The energy of small motions is positive and never grows: what starts small stays small, in the full
    /// equations too when the forces have a potential (Lagrange, Dirichlet).
    Stable,
    /// No small motion grows exponentially, but some neither decay nor are held by their energy: rigid-body
    /// motions, gyroscopic stabilisation, a threshold within rounding. Terms of higher order decide.
    Marginal,
    /// Some small motion grows exponentially, and the full equations leave the state too (Liapunov).
    Unstable,
}

impl Linearisation {
    /// What becomes of a small disturbance.
    ///
    /// Where forces are not circulatory and no energy is fed in (N = 0, 0 ≤ C), definiteness decides: all is
    /// stable if 0 < K, and asymptotically so if 0 < C (Kelvin, Tait, Chetayev). Otherwise the signs of the
    /// real parts of the [complex frequencies](Self::complex_modes) do, where rounding leaves no doubt.
    ///
    /// # Errors
    /// As [`complex_modes`](Self::complex_modes).
    pub fn stability(&self) -> Result<Stability, LagrangianError> {
        self.check()?;
        let n = self.coordinates();
        if n == 0 {
            return Ok(Stability::Stable);
        }
        let reduction = Reduction::of(&self.mass_matrix)?;
        let (stiffness, damping) = (reduction.of_form(&self.stiffness), reduction.of_form(&self.damping));
        let circulatory = reduction.of_form(&self.circulatory).amax();
        let rounding = 16.0 * n as f64 * f64::EPSILON;
        if circulatory <= rounding * stiffness.amax() {
            let (least_stiffness, stiffest) = extremes(&stiffness)?;
            let (least_damping, most) = extremes(&damping)?;
            let held = rounding * stiffest < least_stiffness;
            // What is left where the velocity terms of a turning placement cancel.
            let noise = rounding * most.max(stiffest.sqrt()).max(reduction.of_form(&self.gyroscopic).amax());
            if held && noise < least_damping {
                return Ok(Stability::Asymptotic);
            }
            if held && most <= noise {
                return Ok(Stability::Stable);
            }
            let modes = self.complex_modes()?;
            return Ok(match modes.stability() {
                Stability::Marginal if held && -noise <= least_damping => Stability::Stable,
                verdict => verdict,
            });
        }
        Ok(self.complex_modes()?.stability())
    }
}

/// The least eigenvalue of a symmetric matrix, and the largest in size.
fn extremes(matrix: &DMatrix<f64>) -> Result<(f64, f64), LagrangianError> {
    let n = matrix.nrows();
    let symmetric = (matrix + matrix.transpose()) * 0.5;
    let eigen = SymmetricEigen::try_new(symmetric, f64::EPSILON, SWEEPS * n)
        .ok_or(LagrangianError::SmallMotions(SmallMotionsError::NoEigenvalues { rows: n }))?;
    let least = eigen.eigenvalues.iter().fold(f64::INFINITY, |least, &x| least.min(x));
    Ok((least, eigen.eigenvalues.amax()))
}
