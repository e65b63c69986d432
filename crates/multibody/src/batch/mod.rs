//! Many states of one tree, in lanes and on all cores.
//!
//! The passes are those of one state, over lanes; results have the same bits for any number of lanes and threads.

mod blocks;

use core::any::Any;

use piola_numerics::{LaneKernel, Lanes, dispatch_lanes};

pub use blocks::StateBlocks;

use crate::error::{MultibodyError, all_finite, check_length};
use crate::tree::RigidTree;
use crate::workspace::TreeWorkspace;
use crate::{forward_dynamics, inverse_dynamics};
use blocks::BLOCK;

/// Lanes for each set of instructions: one register.
const BASE: usize = 2;
const AVX2: usize = 4;
const AVX512: usize = 8;

/// The memory of evaluations of many states: of one thread, or of as many as are given.
///
/// # Example
/// A hundred pendulums of 2 kg at 0.5 m, held horizontally by −9.81 N m each.
/// ```
/// use piola_multibody::{
///     BatchWorkspace, BodyIndex, BodyInertia, JointKind, RigidTree, StateBlocks, TreeJoint,
/// };
/// let mut builder = RigidTree::builder();
/// let hinge = TreeJoint::new("hinge", JointKind::Revolute { axis: [0.0, 1.0, 0.0] });
/// builder.attach(BodyIndex::GROUND, hinge, "bob", BodyInertia::particle(2.0, [0.5, 0.0, 0.0])?)?;
/// let tree = builder.build()?;
/// let zeros = StateBlocks::new(1, 100);
/// let mut torques = zeros.clone();
/// tree.inverse_dynamics_of_states(&mut BatchWorkspace::new(&tree, 1), &zeros, &zeros, &zeros, &mut torques)?;
/// let mut torque = [0.0];
/// torques.get(99, &mut torque)?;
/// assert_eq!(torque, [-9.81]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct BatchWorkspace {
    threads: Vec<Box<dyn Any + Send>>,
    links: usize,
}

impl BatchWorkspace {
    /// Memory for so many threads, at least one. More than one need the feature `rayon`.
    #[must_use]
    pub fn new(tree: &RigidTree, threads: usize) -> Self {
        let make = |_| dispatch_lanes::<_, BASE, AVX2, AVX512>(Make(tree));
        Self { threads: (0..threads.max(1)).map(make).collect(), links: tree.links() }
    }
}

/// The memory of one thread with N lanes.
struct InLanes<const N: usize> {
    work: TreeWorkspace<Lanes<f64, N>>,
    q: Vec<Lanes<f64, N>>,
    v: Vec<Lanes<f64, N>>,
    third: Vec<Lanes<f64, N>>,
    out: Vec<Lanes<f64, N>>,
}

struct Make<'a>(&'a RigidTree);

impl LaneKernel for Make<'_> {
    type Output = Box<dyn Any + Send>;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<const N: usize>(self) -> Box<dyn Any + Send> {
        let zeros = |n: usize| vec![Lanes::splat(0.0); n];
        let (n, tree) = (self.0.freedoms(), self.0);
        Box::new(InLanes::<N> {
            work: tree.workspace(),
            q: zeros(tree.coordinates()),
            v: zeros(n),
            third: zeros(n),
            out: zeros(n),
        })
    }
}

/// What is evaluated for each state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Operation {
    /// τ of q, v, v̇.
    Inverse,
    /// v̇ of q, v, τ.
    Forward,
}

/// Some blocks of states as a kernel: the index of the first state that may be wrong.
struct Blocks<'a> {
    tree: &'a RigidTree,
    memory: &'a mut (dyn Any + Send),
    operation: Operation,
    q: &'a [f64],
    v: &'a [f64],
    third: &'a [f64],
    out: &'a mut [f64],
}

impl LaneKernel for Blocks<'_> {
    type Output = Option<usize>;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<const N: usize>(self) -> Option<usize> {
        let Self { tree, memory, operation, q, v, third, out } = self;
        let InLanes::<N> { work, q: q_lanes, v: v_lanes, third: third_lanes, out: out_lanes } =
            memory.downcast_mut()?;
        let (nq, n) = (tree.coordinates() * BLOCK, tree.freedoms() * BLOCK);
        let mut suspect = None;
        let inputs = q.chunks_exact(nq).zip(v.chunks_exact(n)).zip(third.chunks_exact(n));
        for (block, (((q, v), third), out)) in inputs.zip(out.chunks_exact_mut(n)).enumerate() {
            let mut lane = 0;
            while lane < BLOCK {
                load(q, lane, q_lanes);
                load(v, lane, v_lanes);
                load(third, lane, third_lanes);
                let is_right = match operation {
                    Operation::Inverse => {
                        inverse_dynamics::pass_outwards(tree, &mut work.forces, q_lanes, v_lanes, third_lanes);
                        inverse_dynamics::pass_inwards(tree, &mut work.forces, third_lanes, out_lanes);
                        true
                    }
                    Operation::Forward => {
                        forward_dynamics::pass_outwards(tree, &mut work.articulation, q_lanes, v_lanes);
                        let is_positive = forward_dynamics::pass_inwards(tree, work, third_lanes, out_lanes);
                        forward_dynamics::pass_accelerations(tree, &mut work.articulation, &work.gains, out_lanes);
                        piola_numerics::Mask::all(is_positive)
                    }
                };
                for (k, &lanes) in out_lanes.iter().enumerate() {
                    lanes.store(&mut out[k * BLOCK + lane..k * BLOCK + lane + N]);
                }
                let is_right = is_right && all_finite(out_lanes) && tree.has_unit_quaternions(q_lanes);
                if !is_right && suspect.is_none() {
                    suspect = Some(block * BLOCK + lane);
                }
                lane += N;
            }
        }
        suspect
    }
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn load<const N: usize>(block: &[f64], lane: usize, out: &mut [Lanes<f64, N>]) {
    for (k, out) in out.iter_mut().enumerate() {
        *out = Lanes::load(&block[k * BLOCK + lane..k * BLOCK + lane + N], 0.0);
    }
}

impl RigidTree {
    /// [`inverse_dynamics`](Self::inverse_dynamics) of many states.
    ///
    /// # Errors
    /// [`MultibodyError::InState`], with the first state that is wrong; [`MultibodyError::WrongLength`],
    /// [`MultibodyError::OtherWorkspace`]. What was computed of the other states stands in `tau`.
    pub fn inverse_dynamics_of_states(
        &self,
        work: &mut BatchWorkspace,
        q: &StateBlocks,
        v: &StateBlocks,
        a: &StateBlocks,
        tau: &mut StateBlocks,
    ) -> Result<(), MultibodyError> {
        self.evaluate(work, Operation::Inverse, q, v, ("a", a), tau)
    }

    /// [`forward_dynamics`](Self::forward_dynamics) of many states.
    ///
    /// # Errors
    /// As [`inverse_dynamics_of_states`](Self::inverse_dynamics_of_states).
    pub fn forward_dynamics_of_states(
        &self,
        work: &mut BatchWorkspace,
        q: &StateBlocks,
        v: &StateBlocks,
        tau: &StateBlocks,
        out: &mut StateBlocks,
    ) -> Result<(), MultibodyError> {
        self.evaluate(work, Operation::Forward, q, v, ("tau", tau), out)
    }

    fn evaluate(
        &self,
        work: &mut BatchWorkspace,
        operation: Operation,
        q: &StateBlocks,
        v: &StateBlocks,
        (name, third): (&'static str, &StateBlocks),
        out: &mut StateBlocks,
    ) -> Result<(), MultibodyError> {
        if work.links != self.links() {
            return Err(MultibodyError::OtherWorkspace { expected: self.links(), found: work.links });
        }
        let states = q.states();
        for (quantity, length, blocks) in [
            ("q", self.coordinates(), q),
            ("v", self.freedoms(), v),
            (name, self.freedoms(), third),
            ("out", self.freedoms(), &*out),
        ] {
            check_length(quantity, length, blocks.components())?;
            check_length(quantity, states, blocks.states())?;
        }
        if self.freedoms() == 0 {
            return Ok(());
        }
        match run(self, work, operation, q, v, third, out) {
            None => Ok(()),
            Some(suspect) => self.find_wrong_state(operation, suspect, q, v, third),
        }
    }

    /// Evaluates states one by one, from a suspect one on, to name what is wrong.
    #[cold]
    fn find_wrong_state(
        &self,
        operation: Operation,
        suspect: usize,
        q: &StateBlocks,
        v: &StateBlocks,
        third: &StateBlocks,
    ) -> Result<(), MultibodyError> {
        let n = self.freedoms();
        let (mut work, mut q_of) = (self.workspace(), vec![0.0; self.coordinates()]);
        let [mut v_of, mut third_of, mut out] = [vec![0.0; n], vec![0.0; n], vec![0.0; n]];
        for state in suspect..q.states() {
            q.get(state, &mut q_of)?;
            v.get(state, &mut v_of)?;
            third.get(state, &mut third_of)?;
            match operation {
                Operation::Inverse => self.inverse_dynamics(&mut work, &q_of, &v_of, &third_of, &mut out),
                Operation::Forward => self.forward_dynamics(&mut work, &q_of, &v_of, &third_of, &mut out),
            }
            .map_err(|source| MultibodyError::InState { state, source: Box::new(source) })?;
        }
        Ok(())
    }
}

/// Runs the blocks on the threads of the workspace: a state that may be wrong.
fn run(
    tree: &RigidTree,
    work: &mut BatchWorkspace,
    operation: Operation,
    q: &StateBlocks,
    v: &StateBlocks,
    third: &StateBlocks,
    out: &mut StateBlocks,
) -> Option<usize> {
    let (nq, n) = (tree.coordinates() * BLOCK, tree.freedoms() * BLOCK);
    let share = (q.values.len() / nq).div_ceil(work.threads.len()).max(1);
    let one = |(index, (memory, out)): (usize, (&mut Box<dyn Any + Send>, &mut [f64]))| {
        let first = index * share;
        let kernel = Blocks {
            tree,
            memory: &mut **memory,
            operation,
            q: &q.values[first * nq..],
            v: &v.values[first * n..],
            third: &third.values[first * n..],
            out,
        };
        let suspect = dispatch_lanes::<_, BASE, AVX2, AVX512>(kernel);
        suspect.map(|state| state + first * BLOCK)
    };
    let outputs = out.values.chunks_mut(share * n);
    #[cfg(feature = "rayon")]
    if 1 < work.threads.len() {
        use rayon::prelude::*;
        let mut parts: Vec<_> = work.threads.iter_mut().zip(outputs).enumerate().collect();
        return parts.par_drain(..).filter_map(one).min();
    }
    work.threads.iter_mut().zip(outputs).enumerate().filter_map(one).min()
}
