//! Conjugate points along an extremal, counted with their multiplicity.
//!
//! ```text
//! X = ∂q/∂p₀,   P = ∂p/∂p₀,   W = (P + isX)(P − isX)⁻¹        ker X = {v : W v = v}
//! ```
//!
//! W is unitary; it starts at the unit matrix, and where H_pp is positive definite its eigenvalues e^{iφ} pass through
//! one in one direction only. The sum of the phases, followed continuously, less the sum of the phases in [0, 2π), is
//! 2π times the number of passages. Unlike the sign of det X it does not miss conjugate points of even multiplicity, as
//! those of an isotropic oscillator.

use core::f64::consts::TAU;

use nalgebra::{DMatrix, linalg::Schur};
use num_complex::Complex;

use crate::HamiltonianError;
use crate::PhaseFunction;
use crate::ray::Observed;

/// A point of an extremal that is conjugate to its start, or, of a transversal, a focal point of its initial manifold:
/// there it touches a caustic.
///
/// # Example
/// See [`GeodeticDistance`](super::GeodeticDistance).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ConjugatePoint {
    /// The time, s.
    pub time: f64,
    /// The number of independent variations that leave q there unchanged.
    pub multiplicity: usize,
}

/// Places looked at in a step.
const PLACES: u32 = 4;

/// A little less than 2π.
const NO_TURN: f64 = TAU - 1e-6;

/// Follows the phases along one ray.
#[derive(Debug)]
pub(super) struct Passages {
    freedom: usize,
    /// s, with the sign of the direction of time.
    scale: f64,
    lifted: f64,
    last: Sample,
    count: i64,
    buffer: Vec<f64>,
    pub(super) points: Vec<ConjugatePoint>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Sample {
    time: f64,
    /// Twice the argument of det(P + isX), modulo 2π.
    phase: f64,
}

impl Passages {
    pub(super) fn new(freedom: usize, scale: f64, start: f64) -> Self {
        let last = Sample { time: start, ..Sample::default() };
        Self { freedom, scale, lifted: 0.0, last, count: 0, buffer: Vec::new(), points: Vec::new() }
    }

    /// Of a ray whose variations have δq ≠ 0 at the start.
    pub(super) fn of_manifold(freedom: usize, scale: f64, start: f64, y: &[f64]) -> Self {
        let mut passages = Self::new(freedom, scale, start);
        passages.last = passages.sample(start, y);
        passages.lifted = passages.principal(y);
        passages
    }

    /// P + isX.
    fn frame(&self, y: &[f64]) -> DMatrix<Complex<f64>> {
        let n = self.freedom;
        let entry = |i: usize, j: usize| {
            let first = 2 * n * (1 + j) + 1;
            Complex::new(y[first + n + i], self.scale * y[first + i])
        };
        DMatrix::from_fn(n, n, entry)
    }

    fn sample(&self, time: f64, y: &[f64]) -> Sample {
        let determinant = self.frame(y).determinant();
        Sample { time, phase: 2.0 * determinant.im.atan2(determinant.re) }
    }

    /// The sum of the phases of W in [0, 2π).
    fn principal(&self, y: &[f64]) -> f64 {
        let frame = self.frame(y);
        let conjugate = frame.map(|z| z.conj());
        let unitary = conjugate.try_inverse().map(|inverse| frame * inverse);
        let eigenvalues = unitary.and_then(|w| Schur::try_new(w, f64::EPSILON, 1000)).map(|schur| schur.unpack().1);
        eigenvalues.map_or(f64::NAN, |t| t.diagonal().iter().map(|z| z.im.atan2(z.re).rem_euclid(TAU)).sum())
    }

    /// The lifted sum of phases and the number of passages at a sample near the last one.
    fn count_at(&self, sample: Sample, y: &[f64]) -> (f64, i64) {
        let change = sample.phase - self.last.phase;
        let lifted = self.lifted + (change - TAU * (change / TAU).round());
        // Less than one turn in all is no passage: that is the case of most rays, and costs no eigenvalues.
        if lifted < NO_TURN && self.count <= 0 {
            return (lifted, 0);
        }
        let principal = self.principal(y);
        if principal.is_nan() {
            return (lifted, self.count);
        }
        #[expect(clippy::cast_possible_truncation, reason = "a small whole number")]
        let count = ((lifted - principal) / TAU).round() as i64;
        // Phases within rounding of 2π do not undo a passage.
        (lifted, count.max(self.count))
    }

    /// Looks at a step and locates the passages in it.
    pub(super) fn inspect<H: PhaseFunction>(&mut self, step: Observed<'_, '_, '_, H>) -> Result<(), HamiltonianError> {
        let (start, end) = (step.start(), step.time());
        let mut buffer = core::mem::take(&mut self.buffer);
        buffer.resize(step.values().len(), 0.0);
        let outside = |time: f64, error| HamiltonianError::Run { time, source: Box::new(error) };
        for place in 1..=PLACES {
            let time = if place == PLACES { end } else { start + (end - start) * f64::from(place) / f64::from(PLACES) };
            step.at(time, &mut buffer).map_err(|error| outside(time, error))?;
            let sample = self.sample(time, &buffer);
            loop {
                let (lifted, count) = self.count_at(sample, &buffer);
                if count <= self.count {
                    self.lifted = lifted;
                    self.last = sample;
                    break;
                }
                // The first time at which the count is larger, by bisection.
                let (mut before, mut behind, mut reached) = (self.last.time, time, count);
                loop {
                    let middle = 0.5 * (before + behind);
                    if (behind - before).abs() <= 4.0 * f64::EPSILON * before.abs().max(behind.abs())
                        || middle.total_cmp(&before).is_eq()
                        || middle.total_cmp(&behind).is_eq()
                    {
                        break;
                    }
                    step.at(middle, &mut buffer).map_err(|error| outside(middle, error))?;
                    let found = self.count_at(self.sample(middle, &buffer), &buffer).1;
                    if self.count < found {
                        (behind, reached) = (middle, found);
                    } else {
                        before = middle;
                    }
                }
                let multiplicity = usize::try_from(reached - self.count).unwrap_or(0);
                self.points.push(ConjugatePoint { time: behind, multiplicity });
                self.count = reached;
                step.at(time, &mut buffer).map_err(|error| outside(time, error))?;
            }
        }
        self.buffer = buffer;
        Ok(())
    }
}
