//! What UMAT and VUMAT of laws with history need, on plain arrays in Abaqus' layouts.
//!
//! | | UMAT | VUMAT |
//! |---|---|---|
//! | deformation | F before and after, by columns | U before and after, in the corotated frame |
//! | stress | T: 11, 22, 33, 12, 13, 23 | Rᵀ T R: 11, 22, 33, 12, 23, 13 |
//! | tangent | of Jaumann's rate of τ, over J: `DDSDDE`, consistent, not symmetric in general | – |
//! | state | `STATEV` | `stateOld` to `stateNew`, each variable an array |
//!
//! Each increment is one implicit step. A state of zeros alone, with which Abaqus begins, is that of the body as it was made. The state of
//! `thermal` is the temperature at the end of the increment, which Abaqus gives: there any number counts, zero too.

use piola::inelastic::{AnyInelastic, MOST_STATE};

use super::{DeformationIncrement, StateLayout, States, advance};
use crate::FfiError;
use crate::abaqus::check_components;
use crate::error::{check_finite, check_length};
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

/// An increment of one point for UMAT.
///
/// # Example
/// See [`umat`].
#[derive(Clone, Copy, Debug)]
pub struct PointIncrement<'a> {
    /// F by columns before and after: `DFGRD0` and `DFGRD1`.
    pub f: [&'a [f64; 9]; 2],
    /// The time that it takes, s: `DTIME`.
    pub dt: f64,
    /// The temperature after, in the unit of the law's reference temperature: `TEMP` + `DTEMP`. Only `thermal` uses it.
    pub temperature: f64,
}

/// T, `DDSDDE` and the new state of one point.
///
/// | argument | meaning | length |
/// |---|---|---|
/// | `components` | numbers of direct and of shear components | |
/// | `increment` | F before and after, time, temperature | |
/// | `state` | `STATEV` | the law's [`state_length`](AnyInelastic::state_length) |
/// | `stress_out` | `STRESS` | `NTENS` |
/// | `tangent_out` | `DDSDDE` by columns | `NTENS²` |
///
/// # Errors
/// [`FfiError::Components`], [`FfiError::WrongLength`], [`FfiError::NotFinite`]; [`FfiError::BadIncrements`] where the law has no
/// answer: all is left as it is.
///
/// # Example
/// ```
/// use piola_ffi::history::abaqus::{PointIncrement, umat};
/// let law = piola_ffi::named::history("viscoplastic-hencky-lame", &[1.0, 1.0, 0.01, 0.0, 0.01, 0.0, 0.0])?;
/// let (mut state, mut stress, mut tangent) = ([0.0; 10], [0.0; 6], [0.0; 36]);
/// let still = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
/// let sheared = [1.0, 0.0, 0.0, 0.1, 1.0, 0.0, 0.0, 0.0, 1.0];
/// let increment = PointIncrement { f: [&still, &sheared], dt: 1.0, temperature: 293.15 };
/// umat(&law, [3, 3], increment, &mut state, &mut stress, &mut tangent)?;
/// assert!((stress[3] - 0.01 / 3.0_f64.sqrt()).abs() < 1e-4 && 0.0 < state[9]); // σ₀/√3
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn umat(
    law: &AnyInelastic,
    components: [usize; 2],
    PointIncrement { f, dt, temperature }: PointIncrement<'_>,
    state: &mut [f64],
    stress_out: &mut [f64],
    tangent_out: &mut [f64],
) -> Result<(), FfiError> {
    let [direct, shear] = components;
    check_components(direct, shear)?;
    let count = direct + shear;
    check_length("STATEV", law.state_length(), state.len())?;
    check_length("STRESS", count, stress_out.len())?;
    check_length("DDSDDE", count * count, tangent_out.len())?;
    check_finite("temperature", &[temperature])?;
    let by_rows = |[a, b, c, d, e, g, h, i, j]: [f64; 9]| [[a, d, h, b, e, i, c, g, j]];
    let (from, to) = (by_rows(*f[0]), by_rows(*f[1]));
    let (mut before, mut after) = ([0.0; MOST_STATE], [0.0; MOST_STATE]);
    let (before, after) = (&mut before[..state.len()], &mut after[..state.len()]);
    before.copy_from_slice(state);
    begun(law, Some(temperature), before)?;
    let (mut stress, mut tangent) = ([[0.0; 9]], [0.0; 36]);
    let increment = DeformationIncrement { from: &from, to: &to, dt, tolerance: None };
    let states = States { layout: StateLayout::Rows, before, after };
    let wanted = (TangentMeasure::Jaumann, VoigtNumbering::Abaqus, &mut tangent[..]);
    advance(law, increment, states, StressMeasure::Cauchy, &mut stress, Some(wanted))?;
    state.copy_from_slice(after);
    let [[t11, t12, t13, _, t22, t23, _, _, t33]] = stress;
    for (out, component) in stress_out.iter_mut().zip([t11, t22, t33, t12, t13, t23]) {
        *out = component;
    }
    for (place, out) in tangent_out.iter_mut().enumerate() {
        *out = tangent[6 * (place % count) + place / count];
    }
    Ok(())
}

/// Points of a block.
const BLOCK: usize = 64;

/// An increment of many points for VUMAT.
///
/// # Example
/// See [`vumat`].
#[derive(Clone, Copy, Debug)]
pub struct Stretching<'a> {
    /// U before: `stretchOld`; 1 where it is empty.
    pub before: &'a [f64],
    /// U after: `stretchNew`.
    pub after: &'a [f64],
    /// This number is added to the diagonal of `after`: 0 where `after` holds stretches U, 1 where it holds strains U − 1, as in the first call
    /// of a run.
    pub added: f64,
    /// The time that it takes, s.
    pub dt: f64,
    /// The temperatures after: `tempNew`; that of the state where it is empty, and where that is zero the reference temperature. Only `thermal`
    /// uses them.
    pub temperatures: &'a [f64],
}

/// Rᵀ T R and the new states of many points from their stretches.
///
/// ```text
/// component k of point i at k n + i      U: `stretchOld`, `stretchNew`      states: `stateOld`, `stateNew`
/// ```
///
/// # Errors
/// [`FfiError::Components`], [`FfiError::WrongLength`], [`FfiError::NotFinite`]; [`FfiError::BadIncrements`] where the law has no
/// answer: the stresses of these points are NaN.
///
/// # Example
/// ```
/// use piola_ffi::history::abaqus::{Stretching, vumat};
/// let law = piola_ffi::named::history("viscoplastic-hencky-lame", &[1.0, 1.0, 0.01, 0.0, 0.01, 0.0, 0.0])?;
/// let (old, mut new, mut stress) = ([0.0; 10], [0.0; 10], [0.0; 4]); // one point in plane strain
/// let stretching = Stretching { before: &[], after: &[1.1, 0.9, 1.0, 0.0], added: 0.0, dt: 1.0, temperatures: &[] };
/// vumat(&law, [3, 1], stretching, (&old, &mut new), &mut stress)?;
/// assert!((stress[0] - stress[1] - 2.0 * 0.01 / 3.0_f64.sqrt()).abs() < 1e-3); // T₁₁ − T₂₂ = 2 σ₀/√3
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn vumat(
    law: &AnyInelastic,
    components: [usize; 2],
    stretching: Stretching<'_>,
    (old, new): (&[f64], &mut [f64]),
    stress_out: &mut [f64],
) -> Result<(), FfiError> {
    let [direct, shear] = components;
    check_components(direct, shear)?;
    let Stretching { before, after, added, dt, temperatures } = stretching;
    let (count, length) = (direct + shear, law.state_length());
    let points = after.len() / count;
    check_length("stretchNew", points * count, after.len())?;
    if !before.is_empty() {
        check_length("stretchOld", after.len(), before.len())?;
    }
    if !temperatures.is_empty() {
        check_length("tempNew", points, temperatures.len())?;
    }
    check_length("stressNew", after.len(), stress_out.len())?;
    check_length("stateOld", points * length, old.len())?;
    check_length("stateNew", points * length, new.len())?;
    check_finite("stretchOld", before)?;
    check_finite("stretchNew", after)?;
    check_finite("tempNew", temperatures)?;
    check_finite("stateOld", old)?;
    let (mut failed, mut first_error) = (0, None);
    let still = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    let (mut from, mut to, mut stresses) = ([still; BLOCK], [still; BLOCK], [[0.0; 9]; BLOCK]);
    let (mut states, mut ends) = ([0.0; BLOCK * MOST_STATE], [0.0; BLOCK * MOST_STATE]);
    let stretch = |all: &[f64], index: usize, added: f64| {
        let u = |k: usize| if k < count { all[k * points + index] } else { 0.0 };
        let (u11, u22, u33) = (u(0) + added, u(1) + added, u(2) + added);
        [u11, u(3), u(5), u(3), u22, u(4), u(5), u(4), u33]
    };
    for start in (0..points).step_by(BLOCK) {
        let here = BLOCK.min(points - start);
        let (states, ends) = (&mut states[..here * length], &mut ends[..here * length]);
        for (point, state) in states.chunks_mut(length).enumerate() {
            for (k, value) in state.iter_mut().enumerate() {
                *value = old[k * points + start + point];
            }
            begun(law, temperatures.get(start + point).copied(), state)?;
            if !before.is_empty() {
                from[point] = stretch(before, start + point, 0.0);
            }
            to[point] = stretch(after, start + point, added);
        }
        let increment = DeformationIncrement { from: &from[..here], to: &to[..here], dt, tolerance: None };
        let rows = States { layout: StateLayout::Rows, before: states, after: &mut *ends };
        match advance(law, increment, rows, StressMeasure::Cauchy, &mut stresses[..here], None) {
            Err(FfiError::BadIncrements { bad, index, error, .. }) => {
                failed += bad;
                first_error.get_or_insert((start + index, error));
            }
            result => result?,
        }
        for (point, state) in ends.chunks(length).enumerate() {
            for (k, value) in state.iter().enumerate() {
                new[k * points + start + point] = *value;
            }
            let [t11, t12, t13, _, t22, t23, _, _, t33] = stresses[point];
            for (k, component) in [t11, t22, t33, t12, t23, t13].into_iter().take(count).enumerate() {
                stress_out[k * points + start + point] = component;
            }
        }
    }
    match first_error {
        None => Ok(()),
        Some((index, error)) => Err(FfiError::BadIncrements { bad: failed, count: points, index, error }),
    }
}
