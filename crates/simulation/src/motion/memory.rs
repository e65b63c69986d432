//! Motions under constraints remember more than their state: which constraints are independent, and where they were. After every
//! thousand steps a run forgets all but the state, so that it can be continued from there.

use core::cell::{Cell, RefCell};
use std::rc::Rc;

use piola_integrators::Field;
use piola_lagrangian::LagrangianError;
use piola_lagrangian::constraints::{ConstrainedMotion, Constraints as _};

use crate::constraints::MechanismConstraints;
use crate::forces::{AppliedForces, MechanismPotential};
use crate::joints::JointTree;

/// Singular positions that are listed.
const LISTED: usize = 64;

/// What a motion and its driver tell each other.
#[derive(Debug)]
pub(super) struct Memory {
    /// Whether no singular position is near, so that nothing is lost if the motion begins anew.
    pub(super) apart: Cell<bool>,
    /// Whether it is to begin anew.
    pub(super) renew: Cell<bool>,
    /// Singular positions that the motion went through: s, and the name of the constraint.
    pub(super) passed: RefCell<Vec<(f64, String)>>,
}

impl Memory {
    /// Of a motion before its first step, which begins there.
    pub(super) fn shared() -> Rc<Self> {
        Rc::new(Self { apart: Cell::new(false), renew: Cell::new(true), passed: RefCell::default() })
    }
}

type Motion<'m> =
    ConstrainedMotion<'m, &'m JointTree, MechanismPotential<'m>, AppliedForces<'m>, MechanismConstraints<'m>>;

/// A motion with its memory.
pub(super) struct Remembering<'m> {
    pub(super) motion: Motion<'m>,
    pub(super) constraints: MechanismConstraints<'m>,
    pub(super) memory: Rc<Memory>,
    /// The positions passed before it began anew.
    pub(super) before: usize,
}

impl Field for Remembering<'_> {
    type Error = LagrangianError;
    fn dimension(&self) -> usize {
        self.motion.dimension()
    }
    fn is_second_order(&self) -> bool {
        self.motion.is_second_order()
    }
    fn rate(&mut self, t: f64, y: &[f64], rate: &mut [f64]) -> Result<(), LagrangianError> {
        let Self { motion, constraints, memory, before } = self;
        if memory.renew.take() {
            motion.restart();
            *before = memory.passed.borrow().len();
        }
        motion.rate(t, y, rate)?;
        memory.apart.set(motion.is_apart());
        let mut passed = memory.passed.borrow_mut();
        let known = passed.len() - *before;
        let found = motion.singular_positions().iter().skip(known).take(LISTED - passed.len().min(LISTED));
        let named = |condition| constraints.name(condition).unwrap_or_default().to_string();
        passed.extend(found.map(|at| (at.t, named(at.condition))));
        Ok(())
    }
    fn project(&mut self, t: f64, y: &mut [f64]) -> Result<(), LagrangianError> {
        self.motion.project(t, y)
    }
    fn magnitudes(&self, y: &[f64], magnitudes: &mut [f64]) {
        self.motion.magnitudes(y, magnitudes);
    }
}
