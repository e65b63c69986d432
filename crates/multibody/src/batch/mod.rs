//! Many states of one tree, in lanes and on all cores.
//!
//! The passes are those of one state, over lanes; results have the same bits for any number of lanes and threads.

mod blocks;

use core::any::Any;

use piola_numerics::{LaneKernel, Lanes, dispatch_lanes};

pub use blocks::{DerivativeBlocks, StateBlocks};

use crate::derivatives::{self, AccelerationDerivatives};
use crate::error::{MultibodyError, all_finite, check_length};
use crate::tree::RigidTree;
use crate::workspace::TreeWorkspace;
use crate::{forward_dynamics, inverse_dynamics, mass_matrix};
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
    freedoms: usize,
}

impl BatchWorkspace {
    /// Memory for so many threads, at least one. More than one need the feature `rayon`.
    #[must_use]
    pub fn new(tree: &RigidTree, threads: usize) -> Self {
        let make = |_| dispatch_lanes::<_, BASE, AVX2, AVX512>(Make(tree));
        Self { threads: (0..threads.max(1)).map(make).collect(), links: tree.links(), freedoms: tree.freedoms() }
    }
}

/// The memory of one thread with N lanes.
struct InLanes<const N: usize> {
    work: TreeWorkspace<Lanes<f64, N>>,
    q: Vec<Lanes<f64, N>>,
    v: Vec<Lanes<f64, N>>,
    third: Vec<Lanes<f64, N>>,
    /// Vectors and matrices that are written; the matrices are empty until they are needed.
    out: AccelerationDerivatives<Lanes<f64, N>>,
}

struct Make<'a>(&'a RigidTree);

impl LaneKernel for Make<'_> {
    type Output = Box<dyn Any + Send>;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<const N: usize>(self) -> Box<dyn Any + Send> {
        let zeros = |n: usize| vec![Lanes::splat(0.0); n];
        let (n, tree) = (self.0.freedoms(), self.0);
        let out =
            AccelerationDerivatives { acceleration: zeros(n), by_q: Vec::new(), by_v: Vec::new(), by_tau: Vec::new() };
        Box::new(InLanes::<N> {
            work: tree.workspace(),
            q: zeros(tree.coordinates()),
            v: zeros(n),
            third: zeros(n),
            out,
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
    /// M of q.
    MassMatrix,
    /// v̇ and its derivatives of q, v, τ.
    Derivatives,
}

/// The states of some blocks; v and the third vector are empty where an operation does not read them.
#[derive(Clone, Copy)]
struct Inputs<'a> {
    q: &'a [f64],
    v: &'a [f64],
    third: &'a [f64],
}

/// What an operation writes for some blocks, in the order of [`AccelerationDerivatives`]; empty where it writes nothing.
type Outputs<'a> = [&'a mut [f64]; 4];

/// Some blocks of states as a kernel: the index of the first state that may be wrong.
struct Blocks<'a> {
    tree: &'a RigidTree,
    memory: &'a mut (dyn Any + Send),
    operation: Operation,
    inputs: Inputs<'a>,
    outputs: Outputs<'a>,
}

impl LaneKernel for Blocks<'_> {
    type Output = Option<usize>;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<const N: usize>(self) -> Option<usize> {
        let Self { tree, memory, operation, inputs, mut outputs } = self;
        let lanes: &mut InLanes<N> = memory.downcast_mut()?;
        let [nq, n, square] =
            [tree.coordinates(), tree.freedoms(), tree.freedoms() * tree.freedoms()].map(|count| count * BLOCK);
        let mut suspect = None;
        for block in 0..outputs.iter().zip([n, square, square, square]).map(|(out, each)| out.len() / each).max()? {
            let mut lane = 0;
            while lane < BLOCK {
                load(inputs.q, block * nq + lane, &mut lanes.q);
                load(inputs.v, block * n + lane, &mut lanes.v);
                load(inputs.third, block * n + lane, &mut lanes.third);
                let is_right = match operation {
                    Operation::Inverse => {
                        let InLanes { work, q, v, third, out } = &mut *lanes;
                        inverse_dynamics::pass_outwards(tree, &mut work.forces, q, v, third);
                        inverse_dynamics::pass_inwards(tree, &mut work.forces, third, &mut out.acceleration);
                        all_finite(&out.acceleration)
                    }
                    Operation::Forward | Operation::Derivatives => {
                        let InLanes { work, q, v, third, out } = &mut *lanes;
                        forward_dynamics::pass_outwards(tree, &mut work.articulation, q, v);
                        let is_positive = forward_dynamics::pass_inwards(tree, work, third, &mut out.acceleration);
                        let states = &mut work.articulation;
                        forward_dynamics::pass_accelerations(tree, states, &work.gains, &mut out.acceleration);
                        let is_right = piola_numerics::Mask::all(is_positive) && all_finite(&out.acceleration);
                        (operation == Operation::Forward || differentiate(tree, lanes)) && is_right
                    }
                    Operation::MassMatrix => mass_matrix_of(tree, lanes),
                };
                let written = [&lanes.out.acceleration, &lanes.out.by_q, &lanes.out.by_v, &lanes.out.by_tau];
                for ((to, from), each) in outputs.iter_mut().zip(written).zip([n, square, square, square]) {
                    store(from, to, block * each + lane);
                }
                if !(is_right && tree.has_unit_quaternions(&lanes.q)) && suspect.is_none() {
                    suspect = Some(block * BLOCK + lane);
                }
                lane += N;
            }
        }
        suspect
    }
}

/// Loads what a block has; an empty slice is left out.
#[cfg_attr(not(debug_assertions), inline(always))]
fn load<const N: usize>(blocks: &[f64], from: usize, out: &mut [Lanes<f64, N>]) {
    if blocks.is_empty() {
        return;
    }
    for (k, out) in out.iter_mut().enumerate() {
        *out = Lanes::load(&blocks[from + k * BLOCK..from + k * BLOCK + N], 0.0);
    }
}

/// Stores what has a place.
#[cfg_attr(not(debug_assertions), inline(always))]
fn store<const N: usize>(values: &[Lanes<f64, N>], blocks: &mut [f64], from: usize) {
    if blocks.is_empty() {
        return;
    }
    for (k, lanes) in values.iter().enumerate() {
        lanes.store(&mut blocks[from + k * BLOCK..from + k * BLOCK + N]);
    }
}

/// The mass matrix in lanes: a kernel of its own, which the compiler takes apart from the others.
struct MassMatrixInLanes<'a> {
    tree: &'a RigidTree,
    memory: &'a mut (dyn Any + Send),
}

impl LaneKernel for MassMatrixInLanes<'_> {
    type Output = bool;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<const N: usize>(self) -> bool {
        let Some(InLanes::<N> { work, q, out, .. }) = self.memory.downcast_mut() else { return false };
        mass_matrix::fill(self.tree, work, q, &mut out.by_tau, true);
        all_finite(q) && all_finite(&out.by_tau)
    }
}

#[inline(never)]
fn mass_matrix_of(tree: &RigidTree, memory: &mut (dyn Any + Send)) -> bool {
    dispatch_lanes::<_, BASE, AVX2, AVX512>(MassMatrixInLanes { tree, memory })
}

/// The derivatives of accelerations that are there, in lanes.
struct DerivativesInLanes<'a> {
    tree: &'a RigidTree,
    memory: &'a mut (dyn Any + Send),
}

impl LaneKernel for DerivativesInLanes<'_> {
    type Output = bool;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<const N: usize>(self) -> bool {
        let Some(InLanes::<N> { work, v, out, .. }) = self.memory.downcast_mut() else { return false };
        derivatives::differentiate_accelerations(self.tree, work, v, out)
    }
}

#[inline(never)]
fn differentiate(tree: &RigidTree, memory: &mut (dyn Any + Send)) -> bool {
    dispatch_lanes::<_, BASE, AVX2, AVX512>(DerivativesInLanes { tree, memory })
}

/// Memory for the matrices of an operation, where it is not there yet.
struct Prepare<'a> {
    tree: &'a RigidTree,
    memory: &'a mut (dyn Any + Send),
    operation: Operation,
}

impl LaneKernel for Prepare<'_> {
    type Output = ();
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<const N: usize>(self) {
        let Some(InLanes::<N> { out, .. }) = self.memory.downcast_mut() else { return };
        let entries = self.tree.freedoms() * self.tree.freedoms();
        if matches!(self.operation, Operation::MassMatrix | Operation::Derivatives) {
            out.by_tau.resize(entries, Lanes::splat(0.0));
        }
        if self.operation == Operation::Derivatives {
            out.by_q.resize(entries, Lanes::splat(0.0));
            out.by_v.resize(entries, Lanes::splat(0.0));
        }
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
        let n = self.freedoms();
        let given = [("q", self.coordinates(), q), ("v", n, v), ("a", n, a)];
        self.check_blocks(work, &given, &[("tau", n, tau)])?;
        let inputs = Inputs { q: &q.values, v: &v.values, third: &a.values };
        let outputs = [&mut tau.values[..], &mut [], &mut [], &mut []];
        let suspect = run(self, work, Operation::Inverse, inputs, outputs);
        self.find_wrong_state(suspect, q, Some(v), Some(a), |work, q, v, a, out| {
            self.inverse_dynamics(work, q, v, a, &mut out.acceleration)
        })
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
        let n = self.freedoms();
        let given = [("q", self.coordinates(), q), ("v", n, v), ("tau", n, tau)];
        self.check_blocks(work, &given, &[("out", n, out)])?;
        let inputs = Inputs { q: &q.values, v: &v.values, third: &tau.values };
        let outputs = [&mut out.values[..], &mut [], &mut [], &mut []];
        let suspect = run(self, work, Operation::Forward, inputs, outputs);
        self.find_wrong_state(suspect, q, Some(v), Some(tau), |work, q, v, tau, out| {
            self.forward_dynamics(work, q, v, tau, &mut out.acceleration)
        })
    }

    /// [`mass_matrix`](Self::mass_matrix) of many states: n² components of each, entry (i, j) at `i + j n`.
    ///
    /// The first call makes memory for matrices in the workspace; later ones allocate nothing.
    ///
    /// From 30 freedoms on, single states take less time: call [`mass_matrix`](RigidTree::mass_matrix) for each.
    ///
    /// # Errors
    /// As [`inverse_dynamics_of_states`](Self::inverse_dynamics_of_states).
    ///
    /// # Example
    /// ```
    /// use piola_multibody::{
    ///     BatchWorkspace, BodyIndex, BodyInertia, JointKind, RigidTree, StateBlocks, TreeJoint,
    /// };
    /// let mut builder = RigidTree::builder();
    /// let hinge = TreeJoint::new("hinge", JointKind::Revolute { axis: [0.0, 1.0, 0.0] });
    /// builder.attach(BodyIndex::GROUND, hinge, "bob", BodyInertia::particle(2.0, [0.5, 0.0, 0.0])?)?;
    /// let tree = builder.build()?;
    /// let (places, mut matrices) = (StateBlocks::new(1, 10), StateBlocks::new(1, 10));
    /// tree.mass_matrix_of_states(&mut BatchWorkspace::new(&tree, 1), &places, &mut matrices)?;
    /// let mut mass_matrix = [0.0];
    /// matrices.get(9, &mut mass_matrix)?;
    /// assert_eq!(mass_matrix, [0.5]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn mass_matrix_of_states(
        &self,
        work: &mut BatchWorkspace,
        q: &StateBlocks,
        out: &mut StateBlocks,
    ) -> Result<(), MultibodyError> {
        let n = self.freedoms();
        self.check_blocks(work, &[("q", self.coordinates(), q)], &[("out", n * n, out)])?;
        let inputs = Inputs { q: &q.values, v: &[], third: &[] };
        let outputs = [&mut [], &mut [], &mut [], &mut out.values[..]];
        let suspect = run(self, work, Operation::MassMatrix, inputs, outputs);
        self.find_wrong_state(suspect, q, None, None, |work, q, _, _, out| self.mass_matrix(work, q, &mut out.by_tau))
    }

    /// [`forward_dynamics_derivatives`](Self::forward_dynamics_derivatives) of many states.
    ///
    /// The first call makes memory for matrices in the workspace; later ones allocate nothing.
    ///
    /// From 18 freedoms on, single states take less time: call
    /// [`forward_dynamics_derivatives`](RigidTree::forward_dynamics_derivatives) for each.
    ///
    /// # Errors
    /// As [`inverse_dynamics_of_states`](Self::inverse_dynamics_of_states).
    pub fn forward_dynamics_derivatives_of_states(
        &self,
        work: &mut BatchWorkspace,
        q: &StateBlocks,
        v: &StateBlocks,
        tau: &StateBlocks,
        out: &mut DerivativeBlocks,
    ) -> Result<(), MultibodyError> {
        let n = self.freedoms();
        let given = [("q", self.coordinates(), q), ("v", n, v), ("tau", n, tau)];
        let DerivativeBlocks { acceleration, by_q, by_v, by_tau } = out;
        let written = [
            ("out.acceleration", n, &*acceleration),
            ("out.by_q", n * n, &*by_q),
            ("out.by_v", n * n, &*by_v),
            ("out.by_tau", n * n, &*by_tau),
        ];
        self.check_blocks(work, &given, &written)?;
        let inputs = Inputs { q: &q.values, v: &v.values, third: &tau.values };
        let outputs =
            [&mut acceleration.values[..], &mut by_q.values[..], &mut by_v.values[..], &mut by_tau.values[..]];
        let suspect = run(self, work, Operation::Derivatives, inputs, outputs);
        self.find_wrong_state(suspect, q, Some(v), Some(tau), |work, q, v, tau, out| {
            self.forward_dynamics_derivatives(work, q, v, tau, out)
        })
    }

    /// Refuses a workspace of another tree and blocks of other sizes.
    fn check_blocks(
        &self,
        work: &BatchWorkspace,
        given: &[(&'static str, usize, &StateBlocks)],
        written: &[(&'static str, usize, &StateBlocks)],
    ) -> Result<(), MultibodyError> {
        if work.links != self.links() || work.freedoms != self.freedoms() {
            return Err(MultibodyError::OtherWorkspace { expected: self.links(), found: work.links });
        }
        let states = given.first().map_or(0, |(_, _, q)| q.states());
        for &(quantity, length, blocks) in given.iter().chain(written) {
            check_length(quantity, length, blocks.components())?;
            check_length(quantity, states, blocks.states())?;
        }
        Ok(())
    }

    /// Evaluates states one by one, from a suspect one on, to name what is wrong.
    #[cold]
    fn find_wrong_state(
        &self,
        suspect: Option<usize>,
        q: &StateBlocks,
        v: Option<&StateBlocks>,
        third: Option<&StateBlocks>,
        evaluate: impl Fn(
            &mut TreeWorkspace<f64>,
            &[f64],
            &[f64],
            &[f64],
            &mut AccelerationDerivatives<f64>,
        ) -> Result<(), MultibodyError>,
    ) -> Result<(), MultibodyError> {
        let Some(suspect) = suspect else { return Ok(()) };
        let n = self.freedoms();
        let (mut work, mut out) = (self.workspace(), AccelerationDerivatives::new(self));
        let [mut q_of, mut v_of, mut third_of] = [vec![0.0; self.coordinates()], vec![0.0; n], vec![0.0; n]];
        for state in suspect..q.states() {
            q.get(state, &mut q_of)?;
            for (blocks, values) in [(v, &mut v_of), (third, &mut third_of)] {
                if let Some(blocks) = blocks {
                    blocks.get(state, values)?;
                }
            }
            evaluate(&mut work, &q_of, &v_of, &third_of, &mut out)
                .map_err(|source| MultibodyError::InState { state, source: Box::new(source) })?;
        }
        Ok(())
    }
}

/// Shares of the outputs for threads, one after the other.
struct Shares<'a> {
    rest: Outputs<'a>,
    /// Numbers of one share of each.
    each: [usize; 4],
}

impl<'a> Iterator for Shares<'a> {
    type Item = Outputs<'a>;
    fn next(&mut self) -> Option<Outputs<'a>> {
        if self.rest.iter().all(|rest| rest.is_empty()) {
            return None;
        }
        let mut share: Outputs<'a> = [&mut [], &mut [], &mut [], &mut []];
        for ((share, rest), &each) in share.iter_mut().zip(&mut self.rest).zip(&self.each) {
            let all = core::mem::take(rest);
            let end = each.min(all.len());
            (*share, *rest) = all.split_at_mut(end);
        }
        Some(share)
    }
}

/// Runs the blocks on the threads of the workspace: a state that may be wrong.
fn run(
    tree: &RigidTree,
    work: &mut BatchWorkspace,
    operation: Operation,
    inputs: Inputs<'_>,
    outputs: Outputs<'_>,
) -> Option<usize> {
    let [nq, n, square] =
        [tree.coordinates(), tree.freedoms(), tree.freedoms() * tree.freedoms()].map(|count| count * BLOCK);
    if n == 0 {
        return None;
    }
    for memory in &mut work.threads {
        dispatch_lanes::<_, BASE, AVX2, AVX512>(Prepare { tree, memory: &mut **memory, operation });
    }
    let share = (inputs.q.len() / nq).div_ceil(work.threads.len()).max(1);
    let one = |(index, (memory, outputs)): (usize, (&mut Box<dyn Any + Send>, Outputs<'_>))| {
        let first = index * share;
        let from = |values: &[f64], each: usize| if values.is_empty() { 0 } else { first * each };
        let inputs = Inputs {
            q: &inputs.q[from(inputs.q, nq)..],
            v: &inputs.v[from(inputs.v, n)..],
            third: &inputs.third[from(inputs.third, n)..],
        };
        let kernel = Blocks { tree, memory: &mut **memory, operation, inputs, outputs };
        let suspect = dispatch_lanes::<_, BASE, AVX2, AVX512>(kernel);
        suspect.map(|state| state + first * BLOCK)
    };
    let shares = Shares { rest: outputs, each: [n, square, square, square].map(|each| share * each) };
    #[cfg(feature = "rayon")]
    if 1 < work.threads.len() {
        use rayon::prelude::*;
        let mut parts: Vec<_> = work.threads.iter_mut().zip(shares).enumerate().collect();
        return parts.par_drain(..).filter_map(one).min();
    }
    work.threads.iter_mut().zip(shares).enumerate().filter_map(one).min()
}
