//! The derivatives of a state by the start of a run and by parameters.

use piola_numerics::{Gradient, Real};

use super::{Directional, check_length};
use crate::IntegratorsError;
use crate::state::check_finite;

/// What a state is differentiated by. Nothing else is computed.
///
/// # Example
/// See [`Sensitivities`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SensitivityInputs {
    /// The start y₀.
    Start,
    /// The parameters p.
    Parameters,
    /// Both.
    StartAndParameters,
}

impl SensitivityInputs {
    const fn start(self) -> bool {
        matches!(self, Self::Start | Self::StartAndParameters)
    }
    const fn parameters(self) -> bool {
        matches!(self, Self::Parameters | Self::StartAndParameters)
    }
}

/// The derivatives of a state y(t): ∂y/∂y₀ (n×n) and ∂y/∂p (n×m).
///
/// [`ForwardSensitivity`](super::ForwardSensitivity) moves them along with the state. They are summed with compensation.
///
/// # Example
/// ```
/// use piola_integrators::{Sensitivities, SensitivityInputs};
/// let sensitivities: Sensitivities = Sensitivities::at_start(2, 1, SensitivityInputs::StartAndParameters);
/// assert_eq!(sensitivities.by_start(), [1.0, 0.0, 0.0, 1.0]);
/// assert_eq!(sensitivities.by_parameters(), [0.0, 0.0]);
/// ```
#[doc(alias("state transition matrix", "monodromy matrix", "variational equations"))]
#[derive(Clone, Debug, PartialEq)]
pub struct Sensitivities<T = f64> {
    inputs: SensitivityInputs,
    n: usize,
    m: usize,
    start: Columns<T>,
    parameters: Columns<T>,
}

/// A row-major matrix with what rounding left of its sums.
#[derive(Clone, Debug, PartialEq)]
struct Columns<T> {
    count: usize,
    entries: Vec<T>,
    carry: Vec<T>,
}

impl<T: Real> Sensitivities<T> {
    /// The derivatives at the start itself, for n components and m parameters: ∂y/∂y₀ = 1, ∂y/∂p = 0.
    #[must_use]
    pub fn at_start(n: usize, m: usize, inputs: SensitivityInputs) -> Self {
        let columns = |count| Columns { count, entries: vec![T::zero(); n * count], carry: vec![T::zero(); n * count] };
        let mut start = columns(if inputs.start() { n } else { 0 });
        start.entries.iter_mut().step_by(n + 1).for_each(|x| *x = T::one());
        Self { inputs, n, m, start, parameters: columns(if inputs.parameters() { m } else { 0 }) }
    }

    /// What the state is differentiated by.
    #[must_use]
    pub const fn inputs(&self) -> SensitivityInputs {
        self.inputs
    }

    /// ∂yᵢ/∂y₀ⱼ at `i * n + j`; empty where it was not asked for.
    #[must_use]
    pub fn by_start(&self) -> &[T] {
        &self.start.entries
    }

    /// ∂yᵢ/∂pⱼ at `i * m + j`; empty where it was not asked for.
    #[must_use]
    pub fn by_parameters(&self) -> &[T] {
        &self.parameters.entries
    }

    /// The number of directions: columns of both matrices.
    pub(super) const fn directions(&self) -> usize {
        self.start.count + self.parameters.count
    }

    /// Refuses derivatives of another system.
    pub(super) fn check<E>(&self, n: usize, m: usize) -> Result<(), IntegratorsError<E>> {
        check_length("sensitivities", n, self.n)?;
        check_length("sensitivities by parameters", m, self.m)
    }

    /// Refuses numbers that are not finite, of a step from the time t.
    pub(super) fn check_finite<E>(&self, t: f64) -> Result<(), IntegratorsError<E>> {
        check_finite("sensitivities by start", Some(t), &self.start.entries)?;
        check_finite("sensitivities by parameters", Some(t), &self.parameters.entries)
    }

    /// Makes room for what another one holds.
    pub(super) fn resize_as(&mut self, other: &Self) {
        (self.inputs, self.n, self.m) = (other.inputs, other.n, other.m);
        for (columns, other) in [(&mut self.start, &other.start), (&mut self.parameters, &other.parameters)] {
            columns.count = other.count;
            columns.entries.resize(other.entries.len(), T::zero());
            columns.carry.resize(other.carry.len(), T::zero());
        }
    }

    /// Gives y and what rounding left of it the derivatives of a chunk of directions.
    pub(super) fn read(&self, first: usize, y: &mut [Directional<T>], carry: &mut [Directional<T>]) {
        for (i, (y, carry)) in y.iter_mut().zip(carry).enumerate() {
            for (slot, (y, carry)) in y.partials.iter_mut().zip(&mut carry.partials).enumerate() {
                (*y, *carry) = match self.column(first + slot) {
                    Some((columns, j)) => {
                        (columns.entries[i * columns.count + j], columns.carry[i * columns.count + j])
                    }
                    None => (T::zero(), T::zero()),
                };
            }
        }
    }

    /// Takes the derivatives of a chunk of directions from y and what rounding left of it.
    pub(super) fn write(&mut self, first: usize, y: &[Directional<T>], carry: &[Directional<T>]) {
        for (i, (y, carry)) in y.iter().zip(carry).enumerate() {
            for (slot, (&y, &carry)) in y.partials.iter().zip(&carry.partials).enumerate() {
                if let Some((columns, j)) = self.column_mut(first + slot) {
                    columns.entries[i * columns.count + j] = y;
                    columns.carry[i * columns.count + j] = carry;
                }
            }
        }
    }

    /// Writes the parameters with the derivatives of a chunk of directions to `out`.
    pub(super) fn seed_parameters(&self, first: usize, p: &[T], out: &mut [Directional<T>]) {
        for (j, (out, &p)) in out.iter_mut().zip(p).enumerate() {
            // Before `first` the difference wraps to a number that is no direction.
            let direction = if 0 < self.parameters.count { self.start.count + j } else { usize::MAX };
            *out = Gradient::variable(p, direction.wrapping_sub(first));
        }
    }

    fn column(&self, direction: usize) -> Option<(&Columns<T>, usize)> {
        match direction.checked_sub(self.start.count) {
            None => Some((&self.start, direction)),
            Some(j) if j < self.parameters.count => Some((&self.parameters, j)),
            Some(_) => None,
        }
    }

    fn column_mut(&mut self, direction: usize) -> Option<(&mut Columns<T>, usize)> {
        match direction.checked_sub(self.start.count) {
            None => Some((&mut self.start, direction)),
            Some(j) if j < self.parameters.count => Some((&mut self.parameters, j)),
            Some(_) => None,
        }
    }
}
