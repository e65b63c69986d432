//! Many points at once, and a point over its whole history.

use core::cell::RefCell;

use nalgebra::Matrix3;
use piola_continuum::stress::tangents::FirstPiolaTangent;
use piola_continuum::{DeformationGradient, FirstPiola};
use piola_solids::memory::{History, SimpleMaterial};

use crate::error::check_bound;
use crate::{Advanced, Evolution, InelasticError, InelasticPoint, StepControl};

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
    let outputs = (stresses, tangents);
    let count = states.len();
    check_lengths(count, [from.len(), to.len(), outputs.0.len(), outputs.1.len()])?;
    let mut first = None;
    for (index, state) in states.iter_mut().enumerate() {
        let advanced = InelasticPoint::with_state(law, state, &from[index])
            .and_then(|mut point| point.advance(&to[index], dt, control));
        if let Some(after) = write_point(index, advanced, outputs.0, outputs.1, &mut first) {
            *state = after;
        }
    }
    first.map_or(Ok(()), Err)
}

/// As [`advance_all`], each internal variable of all points an array of its own, and with a law for each point: `law` returns that of
/// an index, so that parameters may differ from element to element.
///
/// # Errors
/// Those of [`advance_all`], and of `law`, which count as those of its point.
///
/// # Example
/// Two points whose viscosities differ, held for a second after a fast shear.
/// ```
/// use piola_continuum::stress::tangents::FirstPiolaTangent;
/// use piola_continuum::{DeformationGradient, FirstPiola};
/// use piola_inelastic::{Evolution, ReeseGovindjee, StepControl, advance_components};
/// use piola_solids::NeoHookeanCiarlet;
/// use piola_tensor::FourthOrder;
/// let spring = NeoHookeanCiarlet::with_constants(1.0, 2.0)?;
/// let viscosities = [1e-3, 1e6]; // Pa s
/// let law = |index: usize| ReeseGovindjee::new(spring, spring, viscosities[index]);
/// let initial = law(0)?.initial();
/// let mut arrays: Vec<Vec<f64>> = initial.iter().map(|value| vec![*value; 2]).collect();
/// let mut states: Vec<&mut [f64]> = arrays.iter_mut().map(Vec::as_mut_slice).collect();
/// let states: &mut [&mut [f64]; 9] = states.as_mut_slice().try_into()?;
/// let sheared = [DeformationGradient::simple_shear(0.3)?; 2];
/// let mut stresses = [FirstPiola::zero(); 2];
/// let mut tangents = [FirstPiolaTangent(FourthOrder::zero()); 2];
/// let control = StepControl::one_step();
/// advance_components(law, states, [&sheared, &sheared], (1.0, &control), &mut stresses, &mut tangents)?;
/// assert!((stresses[0].0[(0, 1)] - 0.3_f64).abs() < 1e-3); // μ k: the second spring has flown
/// assert!((stresses[1].0[(0, 1)] - 0.6_f64).abs() < 1e-3); // 2 μ k: it has not
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn advance_components<L: Evolution<S, X>, const S: usize, const X: usize>(
    law: impl Fn(usize) -> Result<L, InelasticError>,
    states: &mut [&mut [f64]; S],
    [from, to]: [&[DeformationGradient]; 2],
    (dt, control): (f64, &StepControl),
    stresses: &mut [FirstPiola],
    tangents: &mut [FirstPiolaTangent],
) -> Result<(), InelasticError> {
    let outputs = (stresses, tangents);
    check_arrays(states, [from, to], outputs.0.len(), outputs.1.len())?;
    let mut first = None;
    for index in 0..from.len() {
        let mut state = [0.0; S];
        for (value, all) in state.iter_mut().zip(&*states) {
            *value = all[index];
        }
        let advanced = law(index).and_then(|law| {
            InelasticPoint::with_state(&law, &state, &from[index])
                .and_then(|mut point| point.advance(&to[index], dt, control))
        });
        if let Some(after) = write_point(index, advanced, outputs.0, outputs.1, &mut first) {
            for (value, all) in after.iter().zip(&mut *states) {
                all[index] = *value;
            }
        }
    }
    first.map_or(Ok(()), Err)
}

/// Refuses arrays of unlike lengths.
pub(crate) fn check_arrays<const S: usize>(
    states: &[&mut [f64]; S],
    [from, to]: [&[DeformationGradient]; 2],
    stresses: usize,
    tangents: usize,
) -> Result<(), InelasticError> {
    let expected = from.len();
    for found in states.iter().map(|states| states.len()) {
        if found != expected {
            return Err(InelasticError::WrongLength { quantity: "states", expected, found });
        }
    }
    check_lengths(expected, [expected, to.len(), stresses, tangents])
}

fn check_lengths(expected: usize, found: [usize; 4]) -> Result<(), InelasticError> {
    for (quantity, found) in
        ["deformations before", "deformations after", "stresses", "tangents"].into_iter().zip(found)
    {
        if found != expected {
            return Err(InelasticError::WrongLength { quantity, expected, found });
        }
    }
    Ok(())
}

/// Writes stress and tangent of a point and returns its new state; of a point that failed NaN, and notes the first such error.
pub(crate) fn write_point<const S: usize>(
    index: usize,
    advanced: Result<Advanced<S>, InelasticError>,
    stresses: &mut [FirstPiola],
    tangents: &mut [FirstPiolaTangent],
    first: &mut Option<InelasticError>,
) -> Option<[f64; S]> {
    match advanced {
        Ok(advanced) => {
            (stresses[index], tangents[index]) = (advanced.first_piola, advanced.tangent);
            Some(advanced.state)
        }
        Err(error) => {
            stresses[index] = FirstPiola(Matrix3::repeat(f64::NAN));
            tangents[index].0.components = [[f64::NAN; 9]; 9];
            if first.is_none() {
                *first = Some(InelasticError::AtPoint { index, error: Box::new(error) });
            }
            None
        }
    }
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
            stress = point.advance_stress(&f, dt, &self.control)?.0.cauchy(&f).0.matrix();
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
