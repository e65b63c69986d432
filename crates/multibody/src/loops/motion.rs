//! The motion of a tree with closures, for explicit methods that project.

use piola_integrators::Field;
use piola_kinematics::SingularPosition;
use piola_kinematics::internal::Passages;

use super::{ClosedTree, LoopWorkspace};
use crate::error::MultibodyError;

/// The least share of its own of a condition below which a state lies beside a singular position.
const BESIDE: f64 = 0.05;

/// The part of the largest of the least shares so far from which a run may be begun anew: `BESIDE` is then still reached in time.
const APART: f64 = 0.2;

/// The least share below which a step must not end: there rounding, ε/x² at the distance x, exceeds the error of the method.
const CLOSE_BY: f64 = 1e-6;

/// How many such steps are refused, so that shorter ones are tried, and how many more are then accepted as they are.
const REFUSED: u32 = 4;
const ACCEPTED: u32 = 40;

/// The motion y = (q, v) of a tree with closures under forces, as a field whose steps end where the closures hold.
///
/// The forces are a function of (t, q, v) that writes τ.
///
/// [`DormandPrince853`](piola_integrators::DormandPrince853) projects each accepted step.
///
/// At a singular position conditions that are independent elsewhere depend on each other, and motions of several kinds meet.
/// The motion goes on along the smooth branch, the one of its velocity, and lists the position. With
/// [`stopping_at_singular_positions`](Self::stopping_at_singular_positions) it ends before the position with an error.
/// A position in which the run starts is not recognised as singular. Between two runs of one motion stands
/// [`restart`](Self::restart).
///
/// # Accuracy
/// At the distance x from a singular position rounding moves a state that is brought onto the branch by ε/x². Runs through such
/// positions take tolerances down to about 1e-10. A run with a tighter one may end at such a position with
/// [`MultibodyError::SingularConstraint`].
///
/// # Example
/// A slider of 1 kg on the line y = 0 is tied by a rod of 1 m to a crank of 1 m, so that x = 2 cos φ. At φ = π/2 the rod lies on
/// the crank, and the slider could also stay there.
/// ```
/// use piola_integrators::{DormandPrince853, State, Tolerance};
/// use piola_multibody::{
///     BodyIndex, BodyInertia, BodyPoint, ClosedTree, JointKind, LoopClosure, RigidTree, TreeJoint,
/// };
/// let inertia = BodyInertia::new(1.0, [0.0; 3], [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])?;
/// let hinge = TreeJoint::new("hinge", JointKind::Revolute { axis: [0.0, 0.0, 1.0] });
/// let rails = TreeJoint::new("rails", JointKind::Prismatic { axis: [1.0, 0.0, 0.0] });
/// let mut builder = RigidTree::builder().with_gravity([0.0; 3])?;
/// let crank = builder.attach(BodyIndex::GROUND, hinge, "crank", inertia)?;
/// let slider = builder.attach(BodyIndex::GROUND, rails, "slider", inertia)?;
/// let mut closed = ClosedTree::new(builder.build()?);
/// let [first, second] = [BodyPoint::new(crank, [1.0, 0.0, 0.0]), BodyPoint::new(slider, [0.0; 3])];
/// closed.close("rod", LoopClosure::Distance { first, second, length: 1.0 })?;
/// let angle = 0.5_f64;
/// let start = vec![angle, 2.0 * angle.cos(), 1.0, -2.0 * angle.sin()]; // 1 rad/s
/// let mut motion = closed.motion(|_t, _q, _v, tau| tau.fill(0.0));
/// let mut state = State::new(0.0, start)?;
/// DormandPrince853::new(Tolerance::relative(1e-10)?).integrate_to(&mut motion, &mut state, 2.0)?;
/// assert!((state.values[1] - 2.0 * state.values[0].cos()).abs() < 1e-7); // it went through
/// assert_eq!(motion.singular_positions().len(), 1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct ClosedMotion<'a, F> {
    closed: &'a ClosedTree,
    work: LoopWorkspace,
    tau: Vec<f64>,
    forces: F,
    passages: Passages,
    /// The state of a stage, brought onto the smooth branch.
    stage: (Vec<f64>, Vec<f64>),
    /// The least share of the last accepted or refused state, and the largest of them so far.
    last_share: f64,
    usual_share: f64,
    /// Whether the step begins, and the next one would begin, beside a singular position.
    beside: [bool; 2],
    stops: bool,
    stopped: Option<SingularPosition>,
    /// How many states close by one singular position steps have ended at.
    close_by: u32,
}

impl ClosedTree {
    /// The motion under forces τ(t, q, v), written to the last argument.
    pub fn motion<F: FnMut(f64, &[f64], &[f64], &mut [f64])>(&self, forces: F) -> ClosedMotion<'_, F> {
        ClosedMotion {
            closed: self,
            work: self.workspace(),
            tau: vec![0.0; self.tree.freedoms],
            forces,
            passages: Passages::of(self.conditions, self.tree.freedoms),
            stage: (vec![0.0; self.tree.coordinates], vec![0.0; self.tree.freedoms]),
            last_share: 0.0,
            usual_share: 0.0,
            beside: [false; 2],
            stops: false,
            stopped: None,
            close_by: 0,
        }
    }
}

impl<F> ClosedMotion<'_, F> {
    /// The workspace with the results of the last evaluation.
    pub const fn last(&self) -> &LoopWorkspace {
        &self.work
    }

    /// Ends a run before a singular position with [`MultibodyError::SingularConstraint`].
    #[must_use]
    pub const fn stopping_at_singular_positions(mut self) -> Self {
        self.stops = true;
        self
    }

    /// The singular positions that accepted steps of the method went through: the first 64.
    ///
    /// They are recognised where the method projects its steps.
    pub fn singular_positions(&self) -> &[SingularPosition] {
        self.passages.listed()
    }

    /// How many singular positions accepted steps went through.
    pub const fn singular_count(&self) -> usize {
        self.passages.count()
    }

    /// Whether no singular position is near: then a motion that is [begun anew](Self::restart) at the last accepted state goes on as
    /// this one does, within its tolerance.
    ///
    /// That is so where the least share of a condition that does not depend on the others is at least a fifth of the largest such share
    /// since the start. A mechanism that comes to rest where it is less is not apart again.
    pub const fn is_apart(&self) -> bool {
        let [now, next] = self.beside;
        !now && !next && self.close_by == 0 && !self.passages.is_between() && self.is_usual()
    }

    /// Forgets the run before: the next evaluation is the start of another one.
    pub fn restart(&mut self) {
        self.work.usual_rank = 0;
        self.work.largest.fill(0.0);
        self.passages.clear();
        (self.beside, self.stopped, self.close_by) = ([false; 2], None, 0);
        (self.last_share, self.usual_share) = (0.0, 0.0);
    }

    const fn is_usual(&self) -> bool {
        APART * self.usual_share <= self.last_share
    }

    fn go_on(&self) -> Result<(), MultibodyError> {
        self.stopped.map_or(Ok(()), |position| Err(self.singular(position)))
    }

    fn singular(&self, SingularPosition { t, condition }: SingularPosition) -> MultibodyError {
        MultibodyError::SingularConstraint { closure: self.closed.closure_of(condition).to_owned(), condition, t }
    }
}

impl<F: FnMut(f64, &[f64], &[f64], &mut [f64])> Field for ClosedMotion<'_, F> {
    type Error = MultibodyError;
    fn dimension(&self) -> usize {
        self.closed.tree.coordinates + self.closed.tree.freedoms
    }
    fn rate(&mut self, t: f64, y: &[f64], rate: &mut [f64]) -> Result<(), MultibodyError> {
        self.go_on()?;
        let tree = &self.closed.tree;
        let (q, v) = y.split_at(tree.coordinates);
        let (q_rate, v_rate) = rate.split_at_mut(tree.coordinates);
        (self.forces)(t, q, v, &mut self.tau);
        tree.coordinate_rates(q, v, q_rate)?;
        self.work.is_closed = self.work.usual_rank == 0;
        if self.beside[0] {
            let (of_q, of_v) = (&mut self.stage.0[..], &mut self.stage.1[..]);
            of_q.copy_from_slice(q);
            of_v.copy_from_slice(v);
            self.closed.follow_branch(&mut self.work, of_q, of_v, t)?;
            (self.forces)(t, of_q, of_v, &mut self.tau);
            self.closed.accelerations(&mut self.work, of_q, of_v, &self.tau, t, v_rate)?;
        } else {
            self.closed.accelerations(&mut self.work, q, v, &self.tau, t, v_rate)?;
        }
        if self.work.usual_rank == 0 {
            // The start.
            self.work.usual_rank = self.work.rank;
            self.passages.look(&self.work.gradients, tree.freedoms, self.work.independent(), t);
        }
        if self.passages.accept(t) {
            self.beside[0] = self.beside[1];
        }
        Ok(())
    }
    fn is_second_order(&self) -> bool {
        self.closed.tree.quaternions.is_empty()
    }
    fn project(&mut self, t: f64, y: &mut [f64]) -> Result<(), MultibodyError> {
        self.go_on()?;
        let tree = &self.closed.tree;
        tree.normalise(&mut y[..tree.coordinates])?;
        let (q, v) = y.split_at_mut(tree.coordinates);
        self.work.is_closed = true;
        self.closed.project(&mut self.work, q, v, t)?;
        let (share, condition) = self.work.least_share();
        self.last_share = share;
        self.usual_share = self.usual_share.max(share);
        self.beside[1] = (CLOSE_BY..BESIDE).contains(&share);
        if share < CLOSE_BY {
            q.copy_from_slice(&self.work.start_q);
            v.copy_from_slice(&self.work.start_v);
            // After a shorter step another one may go over the position, unless the run is to end here.
            self.close_by += 1;
            let stays = REFUSED < self.close_by && (self.stops || REFUSED + ACCEPTED < self.close_by);
            if stays || self.close_by <= REFUSED {
                let position = SingularPosition { t, condition };
                self.stopped = stays.then_some(position);
                return Err(self.singular(position));
            }
            self.passages.pass_by(t);
        } else {
            self.work.usual_rank = self.work.rank;
            let found = self.passages.look(&self.work.gradients, tree.freedoms, self.work.independent(), t);
            if found.is_some() || !self.beside[1] {
                self.close_by = 0;
            }
            if self.stops && found.is_some() {
                self.stopped = found;
                return self.go_on();
            }
        }
        Ok(())
    }
}
