//! Accelerations close by a singular position, from states at both sides of it.
//!
//! At the distance x from the position rounding changes an acceleration by ε/x². Along the branch the acceleration is smooth. So it
//! is interpolated between states q + τ q̇ at t + τ that are brought onto the branch:
//!
//! ```text
//! a(0) = Σ_k w_k (a(k τ) + a(−k τ)),   k = 1, 2, 3,   w = (15, −6, 1)/20,   error τ⁶ a⁽⁶⁾/20
//! ```

use piola_kinematics::Holonomic;

use super::Constraints;
use super::motion::{ConstrainedMotion, WITHIN};
use crate::LagrangianError;
use crate::{Forces, Potential};

/// The share at the nearest states beside it: the least, the wanted and the largest.
const ASIDE: [f64; 3] = [1e-2, 1.5e-2, 2.2e-2];

const WEIGHTS: [f64; 3] = [15.0 / 20.0, -6.0 / 20.0, 1.0 / 20.0];

impl<S: Holonomic, P: Potential, F: Forces, C: Constraints> ConstrainedMotion<'_, S, P, F, C> {
    /// Whether the relative share of a state is below [`WITHIN`].
    pub(super) fn is_within(&mut self, t: f64, y: &[f64]) -> Result<bool, LagrangianError> {
        let (q, v) = y.split_at(self.coordinates);
        self.system.form(&mut self.work, q, v, t)?;
        self.system.factor(&mut self.work, true)?;
        Ok(self.work.independence.follow().is_err() || self.relative_share() < WITHIN)
    }

    /// The interpolated acceleration at a state; false where the motion stays so close by that no such states are found.
    pub(super) fn interpolate(&mut self, t: f64, y: &[f64], acceleration: &mut [f64]) -> bool {
        let (time, share) = self.apart;
        let [least, wanted, largest] = ASIDE;
        let mut step = wanted * (t - time).abs() / share;
        if !(0.0 < step && step.is_finite()) {
            return false;
        }
        for _ in 0..12 {
            match self.accelerate_at(t, y, step).map(|()| self.relative_share()) {
                Ok(share) if least <= share && share <= largest => {
                    return self.sum(t, y, step, acceleration).is_ok();
                }
                // The share grows with the distance.
                Ok(share) => step *= (wanted / share).clamp(0.25, 4.0),
                // Too far to be brought onto the branch, perhaps.
                Err(_) => step *= 0.5,
            }
        }
        false
    }

    fn sum(&mut self, t: f64, y: &[f64], step: f64, acceleration: &mut [f64]) -> Result<(), LagrangianError> {
        acceleration.fill(0.0);
        for (k, weight) in [1.0, 2.0, 3.0].into_iter().zip(WEIGHTS) {
            for side in [k * step, -k * step] {
                self.accelerate_at(t, y, side)?;
                for (sum, one) in acceleration.iter_mut().zip(&self.one) {
                    *sum += weight * one;
                }
            }
        }
        Ok(())
    }

    /// The acceleration on the branch at q + τ q̇.
    fn accelerate_at(&mut self, t: f64, y: &[f64], step: f64) -> Result<(), LagrangianError> {
        let n = self.coordinates;
        self.stage.copy_from_slice(y);
        let (q, v) = self.stage.split_at_mut(n);
        for (q, v) in q.iter_mut().zip(&*v) {
            *q += step * v;
        }
        self.system.follow_branch(&mut self.work, (q, v), t + step, self.scratch.split_at_mut(n).into())?;
        self.system.follow_into(&mut self.work, (q, v), t + step, &mut self.one)
    }
}
