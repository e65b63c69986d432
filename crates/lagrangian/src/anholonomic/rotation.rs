//! The angular velocity as a quasi-velocity: Euler's equations.

use piola_kinematics::{EulerAngles, EulerSequence};
use piola_numerics::Real;

use super::Coframe;

/// The angular velocity in body axes of a body whose attitude are Eulerian angles: u = ω = W θ̇.
///
/// ```text
/// K^k_ij = ε_ijk        I ω̇ + ω×Iω = G                                         W(6.31), W(6.32), W(6.36)
/// ```
///
/// The coordinates are the three angles, of any sequence. The frame is singular at the gimbal points of the
/// sequence.
///
/// # Example
/// The structure coefficients do not depend on the attitude:
/// ```
/// use piola_lagrangian::anholonomic::{BodyAngularVelocity, ByCoframe, structure_coefficients};
/// let k = structure_coefficients(&ByCoframe(BodyAngularVelocity::default()), &[0.3, 0.8, -1.0], 0.0)?;
/// assert!((k[2][(0, 1)] - 1.0_f64).abs() < 1e-15 && k[0][(0, 1)].abs() < 1e-15);
/// # Ok::<(), piola_lagrangian::LagrangianError>(())
/// ```
///
/// # Source
/// W(6.31–6.36).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct BodyAngularVelocity {
    /// The axes of the three angles; z–y–z where not given.
    pub sequence: EulerSequence,
}

impl Coframe for BodyAngularVelocity {
    fn coframe<T: Real>(&self, q: &[T], _t: T, rows: &mut [T]) {
        let w = EulerAngles::new(self.sequence, core::array::from_fn(|i| q[i])).rate_matrix();
        for (i, row) in rows.chunks_exact_mut(3).enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                *entry = w[(i, j)];
            }
        }
    }
}
