//! Laws with history: made from a text, a fit or numbers, advanced at many points.
//!
//! Each item names the feature `history`, so that the header guards it by `PIOLA_HISTORY`.

use std::ffi::c_char;

use piola::inelastic::AnyInelastic;

use super::PiolaStatus;
use super::memory::{
    check_apart, choice, hand_over, handle, optional_text, points, points_mut, put, slice, slice_mut, text, texts,
};
use super::status::answer;
use crate::history::text::{history_from_fit, history_from_json};
use crate::history::{DeformationIncrement, StateLayout, States, advance, initial_states};
use crate::materials::material_state_length;
use crate::named;
use crate::points::{StressMeasure, TangentMeasure, VoigtNumbering};

/// A law with history. Made by `piola_history_from_*`, freed by `piola_history_free`.
#[cfg(feature = "history")]
#[derive(Debug)]
pub struct PiolaHistory(AnyInelastic);

/// How the states of n points stand in memory; S is the number of internal variables.
#[cfg(feature = "history")]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub enum PiolaLayout {
    /// The state of a point in one piece: number k of point i at S i + k.
    Rows = 0,
    /// Each internal variable of all points in one piece: number k of point i at n k + i.
    Components = 1,
}

/// Makes a law with history from JSON, such as `{"law": "in_series", "first": {...}, "second": {...}, "viscosity": 0.5}`.
///
/// # Safety
/// See the [module](super).
#[cfg(feature = "history")]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_history_from_json(json: *const c_char, made: *mut *mut PiolaHistory) -> PiolaStatus {
    // SAFETY: as the caller promises.
    answer(|| unsafe { hand_over(made, || Ok(PiolaHistory(history_from_json(text("json", json)?)?))) })
}

/// Makes the law of a fit of laws with history from the text of its `summary.json`.
///
/// `model` chooses one of its laws, such as `reese-govindjee`; a null pointer chooses the best by `aicc`. Parameters are converted from the
/// `stress_unit` of the summary to Pa.
///
/// # Safety
/// See the [module](super).
#[cfg(feature = "history")]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_history_from_fit(
    summary: *const c_char,
    model: *const c_char,
    made: *mut *mut PiolaHistory,
) -> PiolaStatus {
    let make = || {
        // SAFETY: as the caller promises.
        let (summary, model) = unsafe { (text("summary", summary)?, optional_text("model", model)?) };
        Ok(PiolaHistory(history_from_fit(summary, model)?))
    };
    // SAFETY: as the caller promises.
    answer(|| unsafe { hand_over(made, make) })
}

/// Makes a law with history from its name, such as `mullins-neo_hookean-lame`, and its parameters in the order of the reference.
///
/// # Safety
/// See the [module](super).
#[cfg(feature = "history")]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_history_from_values(
    name: *const c_char,
    values: *const f64,
    count: usize,
    made: *mut *mut PiolaHistory,
) -> PiolaStatus {
    // SAFETY: as the caller promises.
    let make = || unsafe { Ok(PiolaHistory(named::history(text("name", name)?, slice("values", values, count)?)?)) };
    // SAFETY: as the caller promises.
    answer(|| unsafe { hand_over(made, make) })
}

/// Makes a law with history from its name and `count` parameters by name, such as `overstress.shear_modulus`, in any order.
///
/// # Safety
/// See the [module](super).
#[cfg(feature = "history")]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_history_from_names(
    name: *const c_char,
    names: *const *const c_char,
    values: *const f64,
    count: usize,
    made: *mut *mut PiolaHistory,
) -> PiolaStatus {
    let make = || {
        // SAFETY: as the caller promises.
        let (name, names, values) =
            unsafe { (text("name", name)?, texts("names", names, count)?, slice("values", values, count)?) };
        Ok(PiolaHistory(named::history_with_names(name, &names, values)?))
    };
    // SAFETY: as the caller promises.
    answer(|| unsafe { hand_over(made, make) })
}

/// Frees a law with history; a null pointer is no fault.
///
/// # Safety
/// The law comes from this library and was not freed.
#[cfg(feature = "history")]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_history_free(history: *mut PiolaHistory) {
    if !history.is_null() {
        // SAFETY: made by `hand_over`, as the caller promises.
        drop(unsafe { Box::from_raw(history) });
    }
}

/// The number of internal variables of a law.
///
/// # Safety
/// See the [module](super).
#[cfg(feature = "history")]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_history_state_length(history: *const PiolaHistory, length: *mut usize) -> PiolaStatus {
    // SAFETY: as the caller promises.
    answer(|| unsafe { put("length", length, handle("history", history)?.0.state_length()) })
}

/// The number of internal variables of the law with this name, NSTATV of Abaqus: that of a law, such as `kinematic-hencky-lame-hencky-lame`,
/// or of a file in the folder `PIOLA_MATERIALS`; 0 of an elastic law.
///
/// # Safety
/// See the [module](super).
#[cfg(feature = "history")]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_history_state_length_of(name: *const c_char, length: *mut usize) -> PiolaStatus {
    // SAFETY: as the caller promises.
    answer(|| unsafe { put("length", length, material_state_length(text("name", name)?)?) })
}

/// Writes the states of n points of the body as it was made; `layout` is a `PiolaLayout`.
///
/// # Safety
/// See the [module](super).
#[cfg(feature = "history")]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_history_initial_states(
    history: *const PiolaHistory,
    layout: i32,
    states: *mut f64,
    states_length: usize,
) -> PiolaStatus {
    answer(|| {
        // SAFETY: as the caller promises.
        let (history, states) = unsafe { (handle("history", history)?, slice_mut("states", states, states_length)?) };
        initial_states(&history.0, choice("layout of states", &StateLayout::ALL, layout)?, states)
    })
}

/// One increment at n points: stresses, consistent tangents and new states.
///
/// `stress` is a `PiolaStress`, `tangent` a `PiolaTangent`, `voigt` a `PiolaVoigt`, `layout` a `PiolaLayout`. The deformation gradients
/// `from` and `to`, 9 n numbers by rows, are those at the start and the end; the increment takes `dt` s. `tolerance` bounds the estimated
/// error of the internal variables; with 0 the increment is one implicit step. `before` and `after` have n states. Outputs that overlap
/// inputs or one another are refused: `after` is other memory than `before`.
/// `tangents` gets 81 or 36 numbers a point, by rows, without major symmetry in general. With a null pointer and the length 0 no tangent is
/// computed.
///
/// After `PIOLA_STATUS_BAD_POINTS` stresses and tangents of the points that failed are NaN and their new states those before; the message
/// names the first of them, and the share of the increment up to which an update was found. All others are advanced.
///
/// # Safety
/// See the [module](super).
#[cfg(feature = "history")]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn piola_history_advance(
    history: *const PiolaHistory,
    stress: i32,
    tangent: i32,
    voigt: i32,
    layout: i32,
    dt: f64,
    tolerance: f64,
    from: *const f64,
    to: *const f64,
    f_length: usize,
    before: *const f64,
    after: *mut f64,
    states_length: usize,
    stresses: *mut f64,
    stresses_length: usize,
    tangents: *mut f64,
    tangents_length: usize,
) -> PiolaStatus {
    answer(|| {
        check_apart(
            &[
                ("after", after, states_length),
                ("stresses", stresses, stresses_length),
                ("tangents", tangents, tangents_length),
            ],
            &[("from", from, f_length), ("to", to, f_length), ("before", before, states_length)],
        )?;
        // SAFETY: as the caller promises.
        let (history, from, to) =
            unsafe { (handle("history", history)?, slice("from", from, f_length)?, slice("to", to, f_length)?) };
        // SAFETY: as the caller promises.
        let (before, after) =
            unsafe { (slice("before", before, states_length)?, slice_mut("after", after, states_length)?) };
        // SAFETY: as the caller promises.
        let (stresses, tangents) = unsafe {
            (slice_mut("stresses", stresses, stresses_length)?, slice_mut("tangents", tangents, tangents_length)?)
        };
        let measure = choice("stress", &StressMeasure::ALL, stress)?;
        let (tangent, numbering) =
            (choice("tangent", &TangentMeasure::ALL, tangent)?, choice("Voigt order", &VoigtNumbering::ALL, voigt)?);
        let layout = choice("layout of states", &StateLayout::ALL, layout)?;
        let wanted = if tangents.is_empty() { None } else { Some((tangent, numbering, tangents)) };
        let tolerance = if tolerance.to_bits() << 1 == 0 { None } else { Some(tolerance) };
        let increment = DeformationIncrement { from: points("from", from)?, to: points("to", to)?, dt, tolerance };
        let states = States { layout, before, after };
        advance(&history.0, increment, states, measure, points_mut("stresses", stresses)?, wanted)
    })
}
