//! The motion under constraints as a field that projects itself, and a run with a method chosen for it.

use core::ops::Range;

use piola_integrators::{Field, Tolerance};
use piola_kinematics::Holonomic;

use super::workspace::Workspace;
use super::{Constrained, Constraints};
use crate::Run;
use crate::record::{Certificate, record};
use crate::{ConstraintError, LagrangianError};
use crate::{Forces, Potential};

/// The motion in positions and velocities, y = (q, q̇), brought back to φ = 0 and φ̇ = 0 after every accepted step.
///
/// The independent constraints are chosen where the constraints are satisfied, at the start and after every
/// projection, and kept in between: a loop that is not quite closed at a stage of a step may seem to have one
/// condition more. A position where their number changes is singular: the motion may branch there, and the run
/// ends with [`ConstraintError::Singular`].
///
/// # Example
/// See [`Constrained::integrate`].
#[derive(Clone, Debug)]
pub struct ConstrainedMotion<'a, S, P, F, C> {
    system: &'a Constrained<S, P, F, C>,
    coordinates: usize,
    work: Workspace,
    /// The number of independent constraints, once they have been chosen, and the order in which they were.
    rank: Option<usize>,
    order: Vec<usize>,
}

impl<S: Holonomic, P: Potential, F: Forces, C: Constraints> Constrained<S, P, F, C> {
    /// The motion of n coordinates as a field in (q, q̇), for any integrator. Start it from an
    /// [assembled](Self::assemble) state.
    ///
    /// [`DormandPrince853`](piola_integrators::DormandPrince853) projects every accepted step ([`Field::project`]); with other methods the residuals
    /// grow slowly, by the error of each step.
    pub fn motion(&self, coordinates: usize) -> ConstrainedMotion<'_, S, P, F, C> {
        ConstrainedMotion { system: self, coordinates, work: Workspace::default(), rank: None, order: Vec::new() }
    }

    /// Integrates the motion from the nearest consistent state over a span of time and keeps every step.
    ///
    /// The method is the adaptive one of order eight, every accepted step being projected; its global error is
    /// estimated by a second run with a hundredth of the tolerance. For an observer, dense output or events give
    /// [`motion`](Self::motion) to an integrator.
    ///
    /// # Errors
    /// What [`assemble`](Self::assemble) refuses; [`LagrangianError::Unfinished`] when the run fails: it holds the
    /// steps made until then.
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Vector3;
    /// # use piola_lagrangian::constraints::Constraints;
    /// # use piola_lagrangian::{Holonomic, Lagrangian, Placement};
    /// # use piola_numerics::Real;
    /// use piola_integrators::Tolerance;
    /// # struct Bead;
    /// # impl Holonomic for Bead {
    /// #     fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
    /// #         bodies.particle(2.0, Vector3::new(q[0], q[1], T::zero()));
    /// #     }
    /// # }
    /// # struct Circle;
    /// # impl Constraints for Circle {
    /// #     fn count(&self) -> usize {
    /// #         1
    /// #     }
    /// #     fn residuals<T: Real>(&self, q: &[T], _t: T, out: &mut [T]) {
    /// #         out[0] = q[0] * q[0] + q[1] * q[1] - T::lit(25.0);
    /// #     }
    /// # }
    /// let bead = Lagrangian::of(Bead).with_constraints(Circle); // |x| = 5 m
    /// let start = bead.assemble(&[6.0, 8.0], &[1.0, 1.0], 0.0)?;
    /// assert!((start.coordinates[0] - 3.0).abs() < 1e-15 && (start.coordinates[1] - 4.0).abs() < 1e-15);
    /// assert!((start.velocities[0] - 0.16).abs() < 1e-15 && (start.velocities[1] + 0.12).abs() < 1e-15);
    /// // At 10 m/s: 2 rad/s.
    /// let run = bead.integrate(&[5.0, 0.0], &[0.0, 10.0], 0.0..10.0, Tolerance::relative(1e-11)?)?;
    /// assert!((run.last().0[0] - 5.0 * 20.0_f64.cos()).abs() < 1e-8);
    /// assert!(run.residual() < 1e-15 && run.error_estimate() < 1e-8);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn integrate(
        &self,
        q: &[f64],
        v: &[f64],
        times: Range<f64>,
        tolerance: Tolerance,
    ) -> Result<Run, LagrangianError> {
        let assembly = self.assemble(q, v, times.start)?;
        let n = q.len();
        let start = [assembly.coordinates, assembly.velocities].concat();
        let (mut work, mut unconstrained) = (Workspace::default(), crate::Workspace::default());
        record(
            || self.motion(n),
            n,
            &start,
            times,
            tolerance,
            |time, state| {
                let (q, v) = state.split_at(n);
                let (residual, rate_residual) = self.relative_residuals(&mut work, q, v, time);
                let energies = self.lagrangian.energies_with(&mut unconstrained, q, v, time)?;
                Ok(Certificate { integral: energies.total(), kinetic: energies.kinetic, residual, rate_residual })
            },
        )
    }
}

impl<S: Holonomic, P: Potential, F: Forces, C: Constraints> Field for ConstrainedMotion<'_, S, P, F, C> {
    type Error = LagrangianError;
    fn dimension(&self) -> usize {
        2 * self.coordinates
    }
    fn is_second_order(&self) -> bool {
        true
    }
    fn rate(&mut self, t: f64, y: &[f64], rate: &mut [f64]) -> Result<(), LagrangianError> {
        let (q, v) = y.split_at(self.coordinates);
        let (velocity, acceleration) = rate.split_at_mut(self.coordinates);
        velocity.copy_from_slice(v);
        if self.rank.is_some() {
            return self.system.follow_into(&mut self.work, (q, v), t, acceleration);
        }
        self.system.acceleration_into(&mut self.work, q, v, t, acceleration)?;
        self.rank = Some(self.work.independence.rank);
        Ok(())
    }
    fn project(&mut self, t: f64, y: &mut [f64]) -> Result<(), LagrangianError> {
        let (q, v) = y.split_at_mut(self.coordinates);
        self.order.clear();
        self.order.extend_from_slice(&self.work.independence.order);
        let projected = self.system.project_into(&mut self.work, q, v, t);
        let independence = &mut self.work.independence;
        let before = self.rank.unwrap_or(independence.rank);
        let changed = projected.and_then(|_| {
            independence.choose(self.system.least_share);
            if independence.rank == before {
                return Ok(());
            }
            // The constraint that is lost, or the one that is new.
            let place = independence.rank.min(before);
            let constraint = independence.order.get(place).copied().unwrap_or_default();
            Err(LagrangianError::Constraint(ConstraintError::Singular {
                constraint,
                name: self.system.name_of(constraint),
                time: t,
            }))
        });
        if changed.is_err() {
            // A shorter step is tried with what was chosen for this one.
            independence.order.clone_from(&self.order);
            independence.rank = before;
        }
        changed
    }
}
