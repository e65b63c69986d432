//! The motion under constraints as a field that projects itself, and a run with a method chosen for it.

use core::ops::Range;

use piola_integrators::{Field, Tolerance};
use piola_kinematics::internal::Passages;
use piola_kinematics::{Holonomic, SingularPosition};

use super::workspace::Workspace;
use super::{Constrained, Constraints};
use crate::LagrangianError;
use crate::Run;
use crate::record::{Certificate, record};
use crate::{Forces, Potential};

/// The least share of its own of a constraint, of the largest so far, below which a state lies beside a singular position.
const BESIDE: f64 = 0.2;

/// The share from which a run may be begun anew: it then knows the usual share again, or nearly.
const APART: f64 = 0.7;

/// The least share below which a step must not end: there rounding, ε/x² at the distance x, exceeds the error of the method.
const CLOSE_BY: f64 = 1e-3;

/// The share below which accelerations are interpolated.
pub(super) const WITHIN: f64 = 3e-3;

/// How many such steps are refused, so that shorter ones are tried, and how many more are then accepted as they are.
const REFUSED: u32 = 4;
const ACCEPTED: u32 = 40;

/// The motion in positions and velocities, y = (q, q̇), brought back to φ = 0 and φ̇ = 0 after every accepted step.
///
/// The independent constraints are chosen where the constraints are satisfied, at the start and after every
/// projection, and kept in between: a loop that is not quite closed at a stage of a step may seem to have one
/// condition more.
///
/// At a singular position constraints that are independent elsewhere depend on each other, and motions of several kinds meet.
/// The motion goes on along the smooth branch, the one of its velocity, and lists the position. With
/// [`stopping_at_singular_positions`](Self::stopping_at_singular_positions) it ends before the position with
/// [`ConstraintError::Singular`](crate::ConstraintError::Singular). So it always does where the run starts in a singular
/// position. Between two runs of one motion stands [`restart`](Self::restart).
///
/// # Accuracy
/// At the distance x from a singular position rounding moves a state that is brought onto the branch by ε/x². Runs pass such
/// positions at tolerances down to about 1e-10. Where the share is below 3e-3 of the usual one, accelerations are interpolated from
/// states on both sides. A run with a tighter tolerance may end at such a position with
/// [`ConstraintError::Singular`](crate::ConstraintError::Singular).
///
/// # Example
/// See [`Constrained::integrate`].
#[derive(Clone, Debug)]
pub struct ConstrainedMotion<'a, S, P, F, C> {
    pub(super) system: &'a Constrained<S, P, F, C>,
    pub(super) coordinates: usize,
    pub(super) work: Workspace,
    /// The number of independent constraints, once they have been chosen, and the order in which they were.
    rank: Option<usize>,
    order: Vec<usize>,
    passages: Passages,
    /// The largest sᵢ, and the largest of the least shares, so far.
    largest: Vec<f64>,
    usual_share: f64,
    /// The share at the last look.
    last_share: f64,
    /// The independent constraint with the least share, at the last look.
    weakest: usize,
    /// A state before its projection, or brought onto the branch, and scratch of the same length.
    pub(super) stage: Vec<f64>,
    pub(super) scratch: Vec<f64>,
    /// An acceleration.
    pub(super) one: Vec<f64>,
    /// The time of the last state that was not close by a singular position, and its share.
    pub(super) apart: (f64, f64),
    /// Whether the step begins, and the next one would begin, beside a singular position.
    beside: [bool; 2],
    stops: bool,
    stopped: Option<SingularPosition>,
    /// How many states close by one singular position steps have ended at.
    close_by: u32,
    /// How many states within the reach of interpolation steps have ended at, since the last position.
    within: u32,
}

impl<S, P, F, C> ConstrainedMotion<'_, S, P, F, C> {
    /// Ends a run before a singular position with [`ConstraintError::Singular`](crate::ConstraintError::Singular).
    #[must_use]
    pub const fn stopping_at_singular_positions(mut self) -> Self {
        self.stops = true;
        self
    }
    /// The singular positions that accepted steps of the method went through: the first 64.
    ///
    /// They are recognised where the method projects its steps. [`Constraints::name`] names a condition.
    #[must_use]
    pub fn singular_positions(&self) -> &[SingularPosition] {
        self.passages.listed()
    }
    /// How many singular positions accepted steps went through.
    #[must_use]
    pub const fn singular_count(&self) -> usize {
        self.passages.count()
    }
    /// Whether no singular position is near: then a motion that is [begun anew](Self::restart) at the last accepted state goes on as
    /// this one does, but for rounding.
    #[must_use]
    pub const fn is_apart(&self) -> bool {
        let [now, next] = self.beside;
        !now && !next && self.close_by == 0 && !self.passages.is_between() && APART <= self.last_share
    }
    /// Forgets the run before: the next evaluation is the start of another one.
    pub fn restart(&mut self) {
        (self.rank, self.stopped, self.close_by, self.within) = (None, None, 0, 0);
        (self.beside, self.usual_share) = ([false; 2], 0.0);
        self.largest.fill(0.0);
        self.passages.clear();
    }

    /// The least share and its constraint. The share of an independent constraint is the part of its gradient that is its own, over
    /// the largest gradient so far: zero at a singular position.
    fn least_share(&self) -> (f64, usize) {
        let independence = &self.work.independence;
        let mut least = (1.0, self.weakest);
        for (place, &constraint) in independence.taken().iter().enumerate() {
            let own = independence.share(place) * independence.sizes[constraint] / self.largest[constraint];
            if own < least.0 {
                least = (own, constraint);
            }
        }
        least
    }

    /// The least share over the usual share: zero at a singular position.
    pub(super) fn relative_share(&self) -> f64 {
        self.least_share().0 / self.usual_share
    }

    /// The relative share at a state on the branch, whose least share may become the usual one.
    fn share(&mut self) -> f64 {
        for (largest, &size) in self.largest.iter_mut().zip(&self.work.independence.sizes) {
            *largest = largest.max(size);
        }
        let (share, weakest) = self.least_share();
        self.weakest = weakest;
        self.usual_share = self.usual_share.max(share);
        self.last_share = share / self.usual_share;
        self.last_share
    }
}

impl<S: Holonomic, P: Potential, F: Forces, C: Constraints> Constrained<S, P, F, C> {
    /// The motion of n coordinates as a field in (q, q̇), for any integrator. Start it from an
    /// [assembled](Self::assemble) state.
    ///
    /// [`DormandPrince853`](piola_integrators::DormandPrince853) projects every accepted step ([`Field::project`]); with other methods the residuals
    /// grow slowly, by the error of each step.
    pub fn motion(&self, coordinates: usize) -> ConstrainedMotion<'_, S, P, F, C> {
        let count = self.constraints.count();
        ConstrainedMotion {
            system: self,
            coordinates,
            work: Workspace::default(),
            rank: None,
            order: Vec::new(),
            passages: Passages::of(count, coordinates),
            largest: vec![0.0; count],
            usual_share: 0.0,
            last_share: 0.0,
            weakest: 0,
            stage: vec![0.0; 2 * coordinates],
            scratch: vec![0.0; 2 * coordinates],
            one: vec![0.0; coordinates],
            apart: (0.0, 0.0),
            beside: [false; 2],
            stops: false,
            stopped: None,
            close_by: 0,
            within: 0,
        }
    }

    /// Integrates the motion from the nearest consistent state over a span of time and keeps every step.
    ///
    /// The run goes through singular positions on the branch of its velocity and [lists](Run::singular_positions) them.
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
            |motion| motion.singular_positions().to_vec(),
        )
    }
}

impl<S: Holonomic, P: Potential, F: Forces, C: Constraints> ConstrainedMotion<'_, S, P, F, C> {
    fn go_on(&self) -> Result<(), LagrangianError> {
        self.stopped.map_or(Ok(()), |position| Err(self.system.singular(position.condition, position.t)))
    }

    /// Projects a state and chooses its constraints; the share is zero where fewer are independent than before.
    fn project_and_choose(&mut self, t: f64, y: &mut [f64], before: usize) -> Result<f64, LagrangianError> {
        let (system, work) = (self.system, &mut self.work);
        let (q, v) = y.split_at_mut(self.coordinates);
        let projected = system.project_into(work, q, v, t);
        if projected.is_err() {
            // At a singular position Newton's method may fail.
            y.copy_from_slice(&self.stage);
            let (q, v) = y.split_at(self.coordinates);
            system.form(work, q, v, t)?;
            system.factor(work, false)?;
        }
        work.independence.choose(system.least_share);
        if work.independence.rank < before {
            return Ok(0.0);
        }
        if projected.is_ok() && before < work.independence.rank {
            return Err(system.singular(work.independence.order[before], t));
        }
        let share = self.share();
        projected.map(|_| share).or_else(|error| if share < CLOSE_BY { Ok(share) } else { Err(error) })
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
        self.go_on()?;
        let n = self.coordinates;
        let (q, v) = y.split_at(n);
        let (velocity, acceleration) = rate.split_at_mut(n);
        velocity.copy_from_slice(v);
        if self.rank.is_none() {
            self.system.acceleration_into(&mut self.work, q, v, t, acceleration)?;
            self.rank = Some(self.work.independence.rank);
            self.share();
            self.passages.look(&self.work.gradients.rows, n, self.work.independence.taken(), t);
        } else if self.beside[0] && self.is_within(t, y)? && self.interpolate(t, y, acceleration) {
            // Rounding is too large here for what follows.
        } else if self.beside[0] {
            self.stage.copy_from_slice(y);
            let (q, v) = self.stage.split_at_mut(n);
            self.system.follow_branch(&mut self.work, (q, v), t, self.scratch.split_at_mut(n).into())?;
            self.system.follow_into(&mut self.work, (q, v), t, acceleration)?;
        } else {
            self.system.follow_into(&mut self.work, (q, v), t, acceleration)?;
        }
        if self.passages.accept(t) {
            self.beside[0] = self.beside[1];
        }
        Ok(())
    }
    fn project(&mut self, t: f64, y: &mut [f64]) -> Result<(), LagrangianError> {
        self.go_on()?;
        self.stage.copy_from_slice(y);
        self.order.clear();
        self.order.extend_from_slice(&self.work.independence.order);
        let before = self.rank.unwrap_or(self.work.independence.rank);
        let share = self.project_and_choose(t, y, before);
        if share.as_ref().is_ok_and(|&share| CLOSE_BY <= share) {
            self.apart = (t, self.last_share);
            let taken = self.work.independence.taken();
            let found = self.passages.look(&self.work.gradients.rows, self.coordinates, taken, t);
            if self.stops && found.is_some() {
                self.stopped = found;
            }
            self.beside[1] = self.last_share < BESIDE;
            if found.is_some() || !self.beside[1] {
                (self.close_by, self.within) = (0, 0);
            } else if self.last_share < WITHIN {
                // Steps that stay so short never pass.
                self.within += 1;
                if REFUSED + ACCEPTED < self.within {
                    self.stopped = Some(SingularPosition { t, condition: self.weakest });
                }
            }
            return self.go_on();
        }
        // Too close by, or a shorter step is tried: with what was chosen for this one.
        let independence = &self.work.independence;
        let condition = if independence.rank < before { independence.order[independence.rank] } else { self.weakest };
        self.work.independence.order.clone_from(&self.order);
        self.work.independence.rank = before;
        y.copy_from_slice(&self.stage);
        share?;
        // After a shorter step another one may go over the position, unless the run is to end here.
        self.close_by += 1;
        let stays = REFUSED < self.close_by && (self.stops || REFUSED + ACCEPTED < self.close_by);
        if stays || self.close_by <= REFUSED {
            self.stopped = stays.then_some(SingularPosition { t, condition });
            return Err(self.system.singular(condition, t));
        }
        self.passages.pass_by(t);
        self.beside[1] = false;
        Ok(())
    }
}
