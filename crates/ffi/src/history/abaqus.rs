//! Laws with history in Abaqus: the states with which increments begin, and increments of one implicit step.

use piola::inelastic::{AnyInelastic, MOST_STATE};

use super::{DeformationIncrement, StateLayout, States, advance};
use crate::FfiError;
use crate::blocks::BLOCK;
use crate::points::{StressMeasure, TangentMeasure, VoigtNumbering};

/// The state with which an increment begins: the temperature of `thermal`, and of the body as it was made in the place of zeros alone.
fn begun(law: &AnyInelastic, temperature: Option<f64>, state: &mut [f64]) -> Result<(), FfiError> {
    if let (AnyInelastic::Thermal(_), Some(temperature)) = (law, temperature) {
        state.fill(temperature);
    } else if state.iter().all(|value| value.to_bits() << 1 == 0) {
        law.initial_into(state)?;
    }
    Ok(())
}

/// T by rows, Jaumann's tangent in Abaqus' order by rows, and the new state of one point, which stays where the law has no answer.
pub(crate) fn point(
    law: &AnyInelastic,
    [from, to]: [&[[f64; 9]; 1]; 2],
    (dt, temperature): (f64, f64),
    state: &mut [f64],
    stress: &mut [[f64; 9]; 1],
    tangent: &mut [f64; 36],
) -> Result<(), FfiError> {
    let (mut before, mut after) = ([0.0; MOST_STATE], [0.0; MOST_STATE]);
    let (before, after) = (&mut before[..state.len()], &mut after[..state.len()]);
    before.copy_from_slice(state);
    begun(law, Some(temperature), before)?;
    let increment = DeformationIncrement { from, to, dt, tolerance: None };
    let states = States { layout: StateLayout::Rows, before, after };
    let wanted = (TangentMeasure::Jaumann, VoigtNumbering::Abaqus, &mut tangent[..]);
    advance(law, increment, states, StressMeasure::Cauchy, stress, Some(wanted))?;
    state.copy_from_slice(after);
    Ok(())
}

/// T by rows and new states of a block of points, from number `start` of `points`.
pub(crate) fn block(
    law: &AnyInelastic,
    increment: DeformationIncrement<'_>,
    (start, points): (usize, usize),
    temperatures: &[f64],
    (old, new): (&[f64], &mut [f64]),
    stresses: &mut [[f64; 9]],
) -> Result<(), FfiError> {
    let (length, here) = (law.state_length(), stresses.len());
    let (mut states, mut ends) = ([0.0; BLOCK * MOST_STATE], [0.0; BLOCK * MOST_STATE]);
    let (states, ends) = (&mut states[..here * length], &mut ends[..here * length]);
    for (point, state) in states.chunks_mut(length).enumerate() {
        for (k, value) in state.iter_mut().enumerate() {
            *value = old[k * points + start + point];
        }
        begun(law, temperatures.get(start + point).copied(), state)?;
    }
    let rows = States { layout: StateLayout::Rows, before: states, after: &mut *ends };
    let result = advance(law, increment, rows, StressMeasure::Cauchy, stresses, None);
    if matches!(result, Ok(()) | Err(FfiError::BadIncrements { .. })) {
        for (point, state) in ends.chunks(length).enumerate() {
            for (k, value) in state.iter().enumerate() {
                new[k * points + start + point] = *value;
            }
        }
    }
    result
}
