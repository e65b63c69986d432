//! Many points at once, and a point over its whole history.

use core::cell::RefCell;

use nalgebra::Matrix3;
use piola_continuum::stress::tangents::FirstPiolaTangent;
use piola_continuum::{DeformationGradient, FirstPiola};
use piola_solids::memory::{History, SimpleMaterial};

use crate::error::check_bound;
use crate::{Evolution, InelasticError, InelasticPoint, StepControl};

/// Leads points of one law to new deformations in the time `dt`, s: their states, and stress and consistent tangent of each.
///
/// # Errors
/// [`InelasticError::WrongLength`] before anything is computed. [`InelasticError::AtPoint`] of the first point that fails: its state is the
/// last one, its stress and tangent NaN; all others are advanced.
pub fn advance_all<L: Evolution<S, X>, const S: usize, const X: usize>(
    law: &L,
    states: &mut [[f64; S]],
    [from, to]: [&[DeformationGradient]; 2],
    (dt, control): (f64, &StepControl),
    stresses: &mut [FirstPiola],
    tangents: &mut [FirstPiolaTangent],
) -> Result<(), InelasticError> {
    let expected = states.len();
    for (quantity, found) in [
        ("deformations before", from.len()),
        ("deformations after", to.len()),
        ("stresses", stresses.len()),
        ("tangents", tangents.len()),
    ] {
        if found != expected {
            return Err(InelasticError::WrongLength { quantity, expected, found });
        }
    }
    let mut first = None;
    for (index, state) in states.iter_mut().enumerate() {
        let advanced = InelasticPoint::with_state(law, state, &from[index])
            .and_then(|mut point| point.advance(&to[index], dt, control));
        match advanced {
            Ok(advanced) => {
                *state = advanced.state;
                (stresses[index], tangents[index]) = (advanced.first_piola, advanced.tangent);
            }
            Err(error) => {
                stresses[index] = FirstPiola(Matrix3::repeat(f64::NAN));
                tangents[index].0.components = [[f64::NAN; 9]; 9];
                if first.is_none() {
                    first = Some(InelasticError::AtPoint { index, error: Box::new(error) });
                }
            }
        }
    }
    first.map_or(Ok(()), Err)
}

/// A law with internal variables as a material with memory: the stress as a function of the history, for the checks of
/// `piola_specimens`.
///
/// The history is followed from `duration` seconds ago, when the body was as made, in steps of equal length.
///
/// # Example
/// ```
/// use piola_inelastic::{StepControl, OverHistory, ReeseGovindjee};
/// use piola_solids::NeoHookeanCiarlet;
/// use piola_solids::memory::SimpleMaterial;
/// let spring = NeoHookeanCiarlet::with_constants(1.0, 2.0)?;
/// let law = ReeseGovindjee::new(spring, spring, 0.5)?;
/// let material = OverHistory::new(&law, 1.0, 10, StepControl::one_step())?;
/// let rest = |_: f64| nalgebra::Matrix3::identity();
/// assert_eq!(material.cauchy(&rest)[(0, 0)], 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct OverHistory<'a, L, const S: usize, const X: usize> {
    law: &'a L,
    duration: f64,
    steps: u32,
    control: StepControl,
    /// Why the last history had no stress.
    failure: RefCell<Option<InelasticError>>,
}

impl<'a, L: Evolution<S, X>, const S: usize, const X: usize> OverHistory<'a, L, S, X> {
    /// Of a law, a duration, s, and the number of steps.
    ///
    /// # Errors
    /// [`InelasticError::OutOfBounds`] unless 0 < duration and 0 < steps.
    pub fn new(law: &'a L, duration: f64, steps: u32, control: StepControl) -> Result<Self, InelasticError> {
        check_bound("history", "duration", duration, "0 < duration", 0.0 < duration)?;
        check_bound("history", "steps", f64::from(steps), "0 < steps", 0 < steps)?;
        Ok(Self { law, duration, steps, control, failure: RefCell::new(None) })
    }

    /// Why the last history had no stress; none where it had.
    #[must_use]
    pub fn failure(&self) -> Option<InelasticError> {
        self.failure.borrow().clone()
    }

    fn stress(&self, history: &dyn History) -> Result<Matrix3<f64>, InelasticError> {
        let at = |step: u32| {
            let elapsed = self.duration * f64::from(self.steps - step) / f64::from(self.steps);
            DeformationGradient::new(history.gradient(elapsed))
        };
        let start = at(0)?;
        let mut point = InelasticPoint::with_state(self.law, &self.law.initial(), &start)?;
        let dt = self.duration / f64::from(self.steps);
        let mut stress = Matrix3::zeros();
        for step in 1..=self.steps {
            let f = at(step)?;
            stress = point.advance(&f, dt, &self.control)?.first_piola.cauchy(&f).0.matrix();
        }
        Ok(stress)
    }
}

impl<L: Evolution<S, X>, const S: usize, const X: usize> SimpleMaterial for OverHistory<'_, L, S, X> {
    /// T now, Pa; NaN where an update fails: see [`failure`](OverHistory::failure).
    fn cauchy(&self, history: &dyn History) -> Matrix3<f64> {
        let stress = self.stress(history);
        self.failure.replace(stress.as_ref().err().cloned());
        stress.unwrap_or(Matrix3::repeat(f64::NAN))
    }
}
