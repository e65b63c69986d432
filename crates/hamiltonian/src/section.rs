//! Poincaré sections: where a motion crosses a surface of phase space.
//!
//! ```text
//! s(q, p) = 0,    crossed with ṡ = {s, H} of one sign
//! ```

use core::ops::ControlFlow;

use piola_integrators::{Crossing, DormandPrince853, Ending, Event, EventAction, State, Tolerance};

use super::integrals::PhasePoint;
use super::{HamiltonianField, PhaseFunction};
use crate::HamiltonianError;
use crate::check::check_finite;

/// A surface of section of the motions of a Hamiltonian.
///
/// # Example
/// An oscillator crosses q = 0 upwards once in every period, with all its energy in p:
/// ```
/// use piola_hamiltonian::{PhaseFunction, PhasePoint, PoincareSection};
/// use piola_integrators::Tolerance;
/// use piola_numerics::Real;
/// struct Oscillator;
/// impl PhaseFunction for Oscillator {
///     fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
///         T::lit(0.5) * (p[0] * p[0] + q[0] * q[0])
///     }
/// }
/// struct Coordinate;
/// impl PhaseFunction for Coordinate {
///     fn value<T: Real>(&self, q: &[T], _p: &[T], _t: T) -> T {
///         q[0]
///     }
/// }
/// let section = PoincareSection::new(&Oscillator, &Coordinate, Tolerance::relative(1e-12)?);
/// let mut crossings = Vec::new();
/// section.follow_into(&PhasePoint::new(&[1.0], &[0.0], 0.0)?, 100.0, 3, &mut crossings)?;
/// assert_eq!(crossings.len(), 3);
/// assert!((crossings[0].time() - 1.5 * std::f64::consts::PI).abs() < 1e-10);
/// assert!((crossings[2].p()[0] - 1.0).abs() < 1e-10);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// The sections of H. Poincaré, *Les méthodes nouvelles de la mécanique céleste* III (1899); the motion is W(9.10).
#[derive(Clone, Copy, Debug)]
pub struct PoincareSection<'a, H, S> {
    hamiltonian: &'a H,
    surface: &'a S,
    crossing: Crossing,
    tolerance: Tolerance,
}

impl<'a, H: PhaseFunction, S: PhaseFunction> PoincareSection<'a, H, S> {
    /// The section by the surface s = 0, crossed from s < 0 to s > 0.
    #[must_use]
    pub const fn new(hamiltonian: &'a H, surface: &'a S, tolerance: Tolerance) -> Self {
        Self { hamiltonian, surface, crossing: Crossing::Rising, tolerance }
    }

    /// The same with crossings of another sense, or of both.
    #[must_use]
    pub const fn crossed(mut self, crossing: Crossing) -> Self {
        self.crossing = crossing;
        self
    }

    /// Follows the motion until the time `end`, or as many crossings as `most`, and appends each crossing to `crossings`.
    ///
    /// What was found before an error is there. The times of crossings are found to rounding on the continuous
    /// extension of each step, of order seven.
    ///
    /// # Errors
    /// [`HamiltonianError::NotFinite`]; [`HamiltonianError::Run`] when the motion cannot be followed.
    pub fn follow_into(
        &self,
        start: &PhasePoint,
        end: f64,
        most: usize,
        crossings: &mut Vec<PhasePoint>,
    ) -> Result<(), HamiltonianError> {
        self.follow_observed_into(start, end, most, crossings, |_| ControlFlow::Continue(()))
    }

    /// [`follow_into`](Self::follow_into) with an observer that gets the time after every step and may stop the motion.
    ///
    /// # Errors
    /// As [`follow_into`](Self::follow_into).
    pub fn follow_observed_into(
        &self,
        start: &PhasePoint,
        end: f64,
        most: usize,
        crossings: &mut Vec<PhasePoint>,
        mut observer: impl FnMut(f64) -> ControlFlow<()>,
    ) -> Result<(), HamiltonianError> {
        check_finite("end", &[end])?;
        let n = start.q().len();
        let refused = |source| HamiltonianError::Run { time: start.time(), source: Box::new(source) };
        let mut field = HamiltonianField::new(self.hamiltonian, n);
        let mut state = State::new(start.time(), [start.q(), start.p()].concat())
            .map_err(|error| refused(error.with_field_error()))?;
        let surface = self.surface;
        let mut events = [Event::new(self.crossing, EventAction::Report, |t, y: &[f64]| {
            let (q, p) = y.split_at(n);
            surface.value(q, p, t)
        })];
        if most == 0 {
            return Ok(());
        }
        let (mut found, mut failure) = (0, None);
        let report = DormandPrince853::new(self.tolerance)
            .integrate_with_events(
                &mut field,
                &mut state,
                end,
                &mut events,
                |occurrence| {
                    let (q, p) = occurrence.values.split_at(n);
                    match PhasePoint::new(q, p, occurrence.time) {
                        Ok(point) => crossings.push(point),
                        Err(error) => failure = Some(error),
                    }
                    found += 1;
                    if found < most && failure.is_none() { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
                },
                |step| observer(step.time()),
            )
            .map_err(refused)?;
        match failure {
            Some(error) if report.ending == Ending::Stopped => Err(error),
            _ => Ok(()),
        }
    }
}
