//! Many vectors in blocks of eight, component by component, as lanes load them.

use crate::error::{MultibodyError, check_length};
use crate::tree::RigidTree;

/// States in one block.
pub(crate) const BLOCK: usize = 8;

/// Vectors of equal length for many states: q, v, v̇ or τ of each.
///
/// Eight states form a block. In a block the first component of all eight comes first, then the second. Places behind the last
/// state repeat it.
///
/// # Example
/// ```
/// use piola_multibody::StateBlocks;
/// let mut velocities = StateBlocks::new(3, 100);
/// velocities.set(99, &[1.0, 2.0, 3.0])?;
/// let mut out = [0.0; 3];
/// velocities.get(99, &mut out)?;
/// assert_eq!((out, velocities.states()), ([1.0, 2.0, 3.0], 100));
/// # Ok::<(), piola_multibody::MultibodyError>(())
/// ```
#[doc(alias("structure of arrays", "batch"))]
#[derive(Clone, Debug, PartialEq)]
pub struct StateBlocks {
    components: usize,
    states: usize,
    pub(crate) values: Vec<f64>,
}

impl StateBlocks {
    /// Zeros for so many states of so many components.
    #[must_use]
    pub fn new(components: usize, states: usize) -> Self {
        Self { components, states, values: vec![0.0; states.div_ceil(BLOCK) * BLOCK * components] }
    }

    /// Components of each vector.
    #[must_use]
    pub const fn components(&self) -> usize {
        self.components
    }

    /// The number of states.
    #[must_use]
    pub const fn states(&self) -> usize {
        self.states
    }

    /// Sets the vector of one state.
    ///
    /// # Errors
    /// [`MultibodyError::NoSuchIndex`], [`MultibodyError::WrongLength`].
    pub fn set(&mut self, state: usize, values: &[f64]) -> Result<(), MultibodyError> {
        self.check(state)?;
        check_length("values", self.components, values.len())?;
        let from = self.place(state);
        // Lanes behind the last state compute too: with its values they are as right as it.
        let lanes = if state + 1 == self.states { BLOCK - state % BLOCK } else { 1 };
        for (k, &value) in values.iter().enumerate() {
            self.values[from + k * BLOCK..from + k * BLOCK + lanes].fill(value);
        }
        Ok(())
    }

    /// Reads the vector of one state.
    ///
    /// # Errors
    /// [`MultibodyError::NoSuchIndex`], [`MultibodyError::WrongLength`].
    pub fn get(&self, state: usize, out: &mut [f64]) -> Result<(), MultibodyError> {
        self.check(state)?;
        check_length("out", self.components, out.len())?;
        let from = self.place(state);
        for (k, out) in out.iter_mut().enumerate() {
            *out = self.values[from + k * BLOCK];
        }
        Ok(())
    }

    const fn place(&self, state: usize) -> usize {
        state / BLOCK * BLOCK * self.components + state % BLOCK
    }

    fn check(&self, state: usize) -> Result<(), MultibodyError> {
        if state < self.states {
            return Ok(());
        }
        Err(MultibodyError::NoSuchIndex { what: "state", index: state, count: self.states })
    }
}

/// [`AccelerationDerivatives`](crate::AccelerationDerivatives) of many states.
///
/// # Example
/// A hundred hanging pendulums of 2 kg and 0.5 m: −g/l and 1/(m l²).
/// ```
/// use piola_multibody::{
///     BatchWorkspace, BodyIndex, BodyInertia, DerivativeBlocks, JointKind, RigidTree, StateBlocks, TreeJoint,
/// };
/// let mut builder = RigidTree::builder();
/// let hinge = TreeJoint::new("hinge", JointKind::Revolute { axis: [0.0, 1.0, 0.0] });
/// builder.attach(BodyIndex::GROUND, hinge, "bob", BodyInertia::particle(2.0, [0.0, 0.0, -0.5])?)?;
/// let tree = builder.build()?;
/// let (zeros, mut out) = (StateBlocks::new(1, 100), DerivativeBlocks::new(&tree, 100));
/// let mut work = BatchWorkspace::new(&tree, 1);
/// tree.forward_dynamics_derivatives_of_states(&mut work, &zeros, &zeros, &zeros, &mut out)?;
/// let (mut by_q, mut by_tau) = ([0.0], [0.0]);
/// out.by_q.get(99, &mut by_q)?;
/// out.by_tau.get(99, &mut by_tau)?;
/// assert_eq!((by_q, by_tau), ([-19.62], [2.0]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct DerivativeBlocks {
    /// v̇.
    pub acceleration: StateBlocks,
    /// ∂v̇/∂q, along the tangent space: ∂v̇ᵢ/∂qⱼ at `i + j n`.
    pub by_q: StateBlocks,
    /// ∂v̇/∂v.
    pub by_v: StateBlocks,
    /// ∂v̇/∂τ = M⁻¹.
    pub by_tau: StateBlocks,
}

impl DerivativeBlocks {
    /// Memory for the derivatives at so many states of a tree.
    #[must_use]
    pub fn new(tree: &RigidTree, states: usize) -> Self {
        let n = tree.freedoms();
        let matrix = StateBlocks::new(n * n, states);
        Self { acceleration: StateBlocks::new(n, states), by_q: matrix.clone(), by_v: matrix.clone(), by_tau: matrix }
    }
}
