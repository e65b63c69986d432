//! An accepted step, with the state at any time within it.

use piola_numerics::Real;

use super::stages::Workspace;
use crate::events::Interpolated;
use crate::{IntegratorsError, State};

/// An accepted step of [`GaussRadau15`](super::GaussRadau15), with the state at any time within it.
///
/// The accelerations of a step are known as a polynomial of degree seven. Velocities and positions are its integrals. A
/// step that is not asked costs nothing, and one that is asked needs no evaluation.
///
/// # Accuracy
/// Velocities within the step are accurate to order 9, positions to order 10; at its end to order 15.
#[doc(alias("interpolation", "continuous output"))]
#[derive(Debug)]
pub struct GaussRadauStep<'a, T = f64> {
    work: &'a Workspace<T>,
    values: &'a [T],
    number: u64,
    start: f64,
    end: f64,
    step: f64,
}

impl<'a, T: Real> GaussRadauStep<'a, T> {
    pub(super) fn new(work: &'a Workspace<T>, state: &'a State<T>, number: u64, step: f64, start: f64) -> Self {
        Self { work, values: &state.values, number, start, end: state.time, step }
    }

    /// The number of the step, from 1.
    #[must_use]
    pub const fn number(&self) -> u64 {
        self.number
    }
    /// The time at its start, s.
    #[must_use]
    pub const fn start(&self) -> f64 {
        self.start
    }
    /// The time at its end, s.
    #[must_use]
    pub const fn time(&self) -> f64 {
        self.end
    }
    /// The state (q, v) at its start.
    #[must_use]
    pub fn start_values(&self) -> &[T] {
        &self.work.start
    }
    /// The state (q, v) at its end.
    #[must_use]
    pub const fn values(&self) -> &[T] {
        self.values
    }
    /// Whether a time lies within the step.
    #[must_use]
    pub fn contains(&self, t: f64) -> bool {
        let (low, high) = if self.start <= self.end { (self.start, self.end) } else { (self.end, self.start) };
        low <= t && t <= high
    }

    /// Writes the state (q, v) at a time within the step to `out`.
    ///
    /// ```text
    /// v(s) = v₀ + h (s a₀ + Σ bₖ sᵏ⁺²/(k + 2)),    q(s) = q₀ + h s v₀ + h² (½ s² a₀ + Σ bₖ sᵏ⁺³/((k + 2)(k + 3)))
    /// ```
    ///
    /// with s = (t − t₀)/h and k = 0 … 6.
    ///
    /// # Errors
    /// [`IntegratorsError::OutsideStep`]: dense output never extrapolates. [`IntegratorsError::WrongLength`].
    pub fn at(&self, t: f64, out: &mut [T]) -> Result<(), IntegratorsError> {
        let expected = self.values.len();
        if out.len() != expected {
            return Err(IntegratorsError::WrongLength { quantity: "out", expected, found: out.len() });
        }
        if !self.contains(t) {
            return Err(IntegratorsError::OutsideStep { t, start: self.start, end: self.end });
        }
        if t.to_bits() == self.end.to_bits() {
            out.copy_from_slice(self.values);
            return Ok(());
        }
        self.work.state_at(((t - self.start) / self.step).clamp(0.0, 1.0), out);
        Ok(())
    }
}

impl<E> Interpolated<E> for GaussRadauStep<'_, f64> {
    fn ends(&self) -> (f64, f64) {
        (self.start, self.end)
    }
    fn state_at(&mut self, t: f64, out: &mut [f64]) -> Result<(), IntegratorsError<E>> {
        self.at(t, out).map_err(IntegratorsError::with_field_error)
    }
}
