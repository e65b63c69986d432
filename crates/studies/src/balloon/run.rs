//! The curve of a balloon, its limit points, states and stresses.

use core::ops::ControlFlow;

use piola_solutions::families::{Datum, Family};
use piola_solutions::{CurvePoint, LoadCurve, SolutionsError};

use super::Balloon;
use crate::StressAt;
use crate::observer::{Observer, outcome};
use crate::stresses::through;
use piola_simulation::Outcome;

/// Parts of the wall between particles whose stress is computed.
const PARTS: u32 = 48;

/// The pressure of a balloon over its stretch.
///
/// # Example
/// See [`Balloon`].
#[derive(Debug, Clone, Default)]
pub struct BalloonCurve {
    /// States of the range of stretches: the load is the pressure, Pa.
    pub curve: Vec<CurvePoint>,
    /// Where the pressure has a maximum or a minimum.
    pub limits: Vec<CurvePoint>,
    /// All states under the pressure; without one the limit points, or the last state.
    pub states: Vec<CurvePoint>,
    /// The stresses of each state through the wall.
    pub stresses: Vec<Vec<StressAt>>,
    /// The largest |2π ∫ `T_θθ` r dr − π `r_i²` p| of a half of the balloon, over 2π ∫ |`T_θθ`| r dr.
    pub imbalance: f64,
}

impl Balloon {
    /// Runs the study: the results so far and how it ended. The observer gets the finished part, from 0 to 1, and may stop it.
    #[must_use]
    pub fn run(&self, observer: &mut Observer<'_>) -> (BalloonCurve, Outcome) {
        let mut found = BalloonCurve::default();
        let result = self.solve(&mut found, observer);
        (found, outcome(result))
    }

    fn solve(&self, found: &mut BalloonCurve, observer: &mut Observer<'_>) -> Result<bool, SolutionsError> {
        let (inflation, range) = (self.inflation(), (self.stretch[0], self.stretch[1]));
        found.curve = inflation.trace(range, self.points as usize)?;
        if observer(0.3) == ControlFlow::Break(()) {
            return Ok(false);
        }
        found.limits = inflation.limit_points(range)?;
        found.states = match self.pressure {
            Some(pressure) => inflation.states_at(pressure, range)?,
            None if found.limits.is_empty() => found.curve.last().copied().into_iter().collect(),
            None => found.limits.clone(),
        };
        if observer(0.6) == ControlFlow::Break(()) {
            return Ok(false);
        }
        for state in &found.states {
            let stresses = self.stresses(state.parameter)?;
            found.imbalance = found.imbalance.max(imbalance(state.load, &stresses));
            found.stresses.push(stresses);
        }
        Ok(observer(1.0) == ControlFlow::Continue(()))
    }

    fn stresses(&self, stretch: f64) -> Result<Vec<StressAt>, SolutionsError> {
        let deformation = self.inflation().deformation(stretch)?;
        // On the equator: the colatitude is the last coordinate.
        let particle = |radius: f64| [radius, 0.0, core::f64::consts::FRAC_PI_2];
        let free = Datum::free_at(particle(self.shell.outer()));
        through(self.radii(), PARTS)
            .map(|reference| {
                let stress = deformation.stress(&self.law, &free, particle(reference))?.cauchy.0.components;
                Ok(StressAt::of(reference, deformation.place(particle(reference))[0], stress))
            })
            .collect()
    }
}

/// Equilibrium of a half of the balloon: the hoop stress of the cut against the pressure on it, by Simpson's rule.
fn imbalance(pressure: f64, stresses: &[StressAt]) -> f64 {
    let (mut force, mut size) = (0.0, 0.0);
    for triple in stresses.windows(3).step_by(2) {
        let third = (triple[2].reference - triple[0].reference) / 6.0;
        for (at, weight) in triple.iter().zip([1.0, 4.0, 1.0]) {
            // r dr = (R²/r) dR
            let share = weight * third * at.reference * at.reference / at.radius;
            force += share * at.stress[1];
            size += share * at.stress[1].abs();
        }
    }
    let inner = stresses.first().map_or(0.0, |at| at.radius);
    (2.0 * force - inner * inner * pressure).abs() / (2.0 * size).max(f64::MIN_POSITIVE)
}

/// Whether a state is stable where the pressure is held.
#[must_use]
pub fn is_stable(state: &CurvePoint) -> bool {
    0.0 < state.slope
}

impl BalloonCurve {
    /// Whether a limit point is a maximum.
    #[must_use]
    pub fn is_maximum(&self, limit: &CurvePoint) -> bool {
        self.curve
            .iter()
            .filter(|point| (point.parameter - limit.parameter).abs() <= 0.1 * limit.parameter)
            .all(|point| point.load <= limit.load)
    }
}
