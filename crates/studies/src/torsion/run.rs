//! Curves of a twisted rod, its states under a torque, and stresses.

use core::ops::ControlFlow;

use piola_solutions::families::{Datum, Family};
use piola_solutions::loads::TwistedTube;
use piola_solutions::{CurvePoint, LoadCurve, SolutionsError};

use super::TwistedRod;
use crate::StressAt;
use crate::observer::{Observer, outcome};
use crate::stresses::through;
use piola_simulation::Outcome;

/// Parts of the radius between particles whose stress is computed.
const PARTS: u32 = 48;

/// The two rods at one twist.
///
/// # Example
/// See [`TwistedRod`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TwistedState {
    /// Held at the axial stretch.
    pub held: TwistedTube,
    /// Under the axial force.
    pub pulled: TwistedTube,
}

/// Torque, axial force and axial stretch over the twist.
///
/// # Example
/// See [`TwistedRod`].
#[derive(Debug, Clone, Default)]
pub struct RodCurves {
    /// From no twist to the largest one.
    pub states: Vec<TwistedState>,
    /// All states under the torque and the axial force.
    pub under_torque: Vec<CurvePoint>,
    /// Names of rods with their stresses from the inner face or the axis to the outer face.
    pub stresses: Vec<(String, Vec<StressAt>)>,
}

impl TwistedRod {
    /// Runs the study: the results so far and how it ended. The observer gets the finished part, from 0 to 1, and may stop it.
    #[must_use]
    pub fn run(&self, observer: &mut Observer<'_>) -> (RodCurves, Outcome) {
        let mut found = RodCurves::default();
        let result = self.solve(&mut found, observer);
        (found, outcome(result))
    }

    fn solve(&self, found: &mut RodCurves, observer: &mut Observer<'_>) -> Result<bool, SolutionsError> {
        for index in 0..=self.points {
            let share = f64::from(index) / f64::from(self.points);
            let twist = self.twist * share;
            found.states.push(TwistedState { held: self.held().state(twist)?, pulled: self.pulled().state(twist)? });
            if observer(0.8 * share) == ControlFlow::Break(()) {
                return Ok(false);
            }
        }
        if let Some(torque) = self.torque {
            found.under_torque = self.pulled().states_at(torque, (0.0, self.twist))?;
            for point in &found.under_torque {
                let state = self.pulled().state(point.parameter)?;
                found.stresses.push((format!("pulled, {:.4} rad/m", state.twist), self.stresses(&state)?));
            }
        } else if let Some(last) = found.states.last() {
            found.stresses.push(("held".to_string(), self.stresses(&last.held)?));
            found.stresses.push(("pulled".to_string(), self.stresses(&last.pulled)?));
        }
        Ok(observer(1.0) == ControlFlow::Continue(()))
    }

    fn stresses(&self, state: &TwistedTube) -> Result<Vec<StressAt>, SolutionsError> {
        let outer = self.tube.outer();
        // A solid rod has no coordinates on its axis: the first particle is beside it.
        let inner = if self.tube.is_solid() { 1e-6 * outer } else { self.tube.inner() };
        let free = Datum::free_at([outer, 0.0, 0.0]);
        through([inner, outer], PARTS)
            .map(|reference| {
                let particle = [reference, 0.0, 0.0];
                let stress = state.deformation.stress(&self.law, &free, particle)?.cauchy.0.components;
                Ok(StressAt::of(reference, state.deformation.place(particle)[0], stress))
            })
            .collect()
    }
}
