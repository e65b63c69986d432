//! The curve of a bent block, its states under a moment, and stresses.

use core::ops::ControlFlow;

use piola_solutions::families::{Datum, Family};
use piola_solutions::loads::BentBlock;
use piola_solutions::{LoadCurve, SolutionsError};

use super::BentBlockStudy;
use crate::StressAt;
use crate::observer::{Observer, outcome};
use crate::stresses::through;
use piola_simulation::Outcome;

/// Parts of the thickness between particles whose stress is computed.
const PARTS: u32 = 48;

/// The moment on a block over the angle.
///
/// # Example
/// See [`BentBlockStudy`].
#[derive(Debug, Clone, Default)]
pub struct BendingCurve {
    /// Angles, rad, none of them zero.
    pub angles: Vec<f64>,
    /// The block at each angle.
    pub states: Vec<BentBlock>,
    /// Angles under the moment, rad; without one the largest angle.
    pub shown: Vec<f64>,
    /// The block at these angles.
    pub shown_states: Vec<BentBlock>,
    /// Its stresses there, through the thickness.
    pub stresses: Vec<Vec<StressAt>>,
    /// Length of the block, m: its fibres at the radius length/angle are not stretched.
    pub length: f64,
}

impl BentBlockStudy {
    /// Runs the study: the results so far and how it ended. The observer gets the finished part, from 0 to 1, and may stop it.
    #[must_use]
    pub fn run(&self, observer: &mut Observer<'_>) -> (BendingCurve, Outcome) {
        let mut found = BendingCurve { length: self.block.length(), ..BendingCurve::default() };
        let result = self.solve(&mut found, observer);
        (found, outcome(result))
    }

    fn solve(&self, found: &mut BendingCurve, observer: &mut Observer<'_>) -> Result<bool, SolutionsError> {
        let bending = self.bending();
        for index in 1..=self.points {
            let share = f64::from(index) / f64::from(self.points);
            found.angles.push(self.angle * share);
            found.states.push(bending.state(self.angle * share)?);
            if observer(0.8 * share) == ControlFlow::Break(()) {
                return Ok(false);
            }
        }
        found.shown = match self.moment {
            Some(moment) => bending.states_at(moment, self.range())?.iter().map(|point| point.parameter).collect(),
            None => vec![self.angle],
        };
        for angle in &found.shown {
            let state = bending.state(*angle)?;
            found.stresses.push(self.stresses(&state)?);
            found.shown_states.push(state);
        }
        Ok(observer(1.0) == ControlFlow::Continue(()))
    }

    fn stresses(&self, state: &BentBlock) -> Result<Vec<StressAt>, SolutionsError> {
        let free = Datum::free_at([state.faces[1], 0.0, 0.0]);
        through(state.faces, PARTS)
            .map(|reference| {
                let particle = [reference, 0.0, 0.0];
                let stress = state.deformation.stress(&self.law, &free, particle)?.cauchy.0.components;
                // X is counted from the inner face.
                Ok(StressAt::of(reference - state.faces[0], state.deformation.place(particle)[0], stress))
            })
            .collect()
    }
}
