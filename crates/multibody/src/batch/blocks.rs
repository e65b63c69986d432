//! Many vectors in blocks of eight, component by component, as lanes load them.

use crate::error::{MultibodyError, check_length};

/// States in one block.
pub(crate) const BLOCK: usize = 8;

/// Vectors of equal length for many states: q, v, v̇ or τ of each.
///
/// Eight states form a block. In a block the first component of all eight comes first, then the second.
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
        for (k, &value) in values.iter().enumerate() {
            self.values[from + k * BLOCK] = value;
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
