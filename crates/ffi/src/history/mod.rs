//! Laws with history at many points: one increment of each, its state in the caller's memory.
//!
//! ```text
//! F at the start and the end of the increment, Δt, state  →  stress, consistent tangent, new state
//! ```
//! Points are advanced one after the other; with feature `rayon`, those of a large batch on all threads. An increment allocates nothing.
//!
//! ```
//! use piola_ffi::history::{DeformationIncrement, StateLayout, States, advance, initial_states};
//! use piola_ffi::points::{StressMeasure, TangentMeasure, VoigtNumbering};
//! let spring = [1.0, 2.0]; // shear_modulus, bulk_modulus of the volumetric part, Pa
//! let values = [spring, spring, [0.5, 0.0]].concat(); // viscosity, Pa s, and bulk_fluidity
//! let law = piola_ffi::named::history("reese_govindjee-neo_hookean-simo_taylor-neo_hookean-simo_taylor", &values)?;
//! let still = [[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]; 100];
//! let sheared = [[1.0, 0.3, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]; 100];
//! let (mut before, mut after) = (vec![0.0; 900], vec![0.0; 900]);
//! initial_states(&law, StateLayout::Rows, &mut before)?;
//! let mut stresses = [[0.0; 9]; 100];
//! let increment = DeformationIncrement { from: &still, to: &sheared, dt: 1e-6, tolerance: None };
//! let states = States { layout: StateLayout::Rows, before: &before, after: &mut after };
//! advance(&law, increment, states, StressMeasure::Cauchy, &mut stresses, None)?;
//! assert!((stresses[99][1] - 0.6).abs() < 1e-5); // 2 μ k
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub(crate) mod abaqus;
mod conversions;
pub(crate) mod named;
pub mod text;
mod views;

use piola::continuum::DeformationGradient;
use piola::inelastic::{AnyInelastic, InelasticError, MOST_STATE, StepControl};

use crate::FfiError;
use crate::error::{Bad, check_finite, check_length};
use crate::points::{StressMeasure, TangentMeasure, VoigtNumbering};
use views::{After, gather};

/// Points from which on, with feature `rayon`, a batch runs on all threads.
#[cfg(feature = "rayon")]
const PARALLEL: usize = 1 << 9;

/// How the states of many points stand in memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StateLayout {
    /// The state of a point in one piece: number k of point i at S i + k.
    Rows,
    /// Each internal variable of all points in one piece: number k of point i at n k + i.
    Components,
}

impl StateLayout {
    /// The layouts by name.
    pub const ALL: [(&'static str, Self); 2] = [("rows", Self::Rows), ("components", Self::Components)];
}

/// An increment of many points.
///
/// # Example
/// See the [module](self).
#[derive(Clone, Copy, Debug)]
pub struct DeformationIncrement<'a> {
    /// F at the start by rows.
    pub from: &'a [[f64; 9]],
    /// F at the end by rows.
    pub to: &'a [[f64; 9]],
    /// The time that it takes, s.
    pub dt: f64,
    /// The largest estimated error of the internal variables; one implicit step where it is none.
    pub tolerance: Option<f64>,
}

/// The states of many points.
///
/// # Example
/// See the [module](self).
#[derive(Debug)]
pub struct States<'a> {
    /// How they stand in memory.
    pub layout: StateLayout,
    /// At the start of the increment.
    pub before: &'a [f64],
    /// At its end.
    pub after: &'a mut [f64],
}

/// The tangents that are asked for, and memory for them.
pub type Tangents<'a> = (TangentMeasure, VoigtNumbering, &'a mut [f64]);

/// Writes the states of points of the body as it was made.
///
/// # Errors
/// [`FfiError::WrongLength`] unless the memory holds states of whole points.
pub fn initial_states(law: &AnyInelastic, layout: StateLayout, states: &mut [f64]) -> Result<(), FfiError> {
    let length = law.state_length();
    let count = states.len() / length;
    check_length("states", count * length, states.len())?;
    let mut memory = [0.0; MOST_STATE];
    let initial = &mut memory[..length];
    law.initial_into(initial)?;
    let mut after = After::of(layout, length, states);
    for index in 0..count {
        after.write(index, initial);
    }
    Ok(())
}

/// One increment at each point: the stress, nine components by rows, the consistent tangent if it is asked for, and the new state.
///
/// | argument | shape |
/// |---|---|
/// | `increment` | F: n × 9 |
/// | `states` | n S each, S the law's [`state_length`](AnyInelastic::state_length) |
/// | `stresses` | n × 9 |
/// | `tangents` | n × 81 or n × 36, as for elastic laws; they lack the major symmetry in general |
///
/// # Errors
/// [`FfiError::WrongLength`], [`FfiError::NotFinite`] of the states and of the time, before anything is computed.
/// [`FfiError::BadIncrements`] where F is no deformation, Newton's method fails or the law has no answer: stress and tangent of
/// these points are NaN, their new state is the one before, and the message says of the first of them up to which share of the increment
/// an update was found; all others are advanced.
///
/// # Accuracy
/// That of `StepControl`; conversions add what those of elastic laws add.
///
/// # Example
/// See the [module](self).
pub fn advance(
    law: &AnyInelastic,
    increment: DeformationIncrement<'_>,
    states: States<'_>,
    stress: StressMeasure,
    stresses: &mut [[f64; 9]],
    tangents: Option<Tangents<'_>>,
) -> Result<(), FfiError> {
    let States { layout, before, after } = states;
    let (count, length) = (increment.from.len(), law.state_length());
    check_length("deformations after", count, increment.to.len())?;
    check_length("states before", count * length, before.len())?;
    check_length("states after", count * length, after.len())?;
    check_length("stresses", count, stresses.len())?;
    check_finite("dt", &[increment.dt])?;
    if increment.dt < 0.0 {
        let (law, parameter, bound) = ("increment", "dt", "0 ≤ dt");
        return Err(InelasticError::OutOfBounds { law, parameter, value: increment.dt, bound }.into());
    }
    check_finite("states before", before)?;
    let control = match increment.tolerance {
        Some(tolerance) => StepControl::new(tolerance)?,
        None => StepControl::one_step(),
    };
    let (tangent, numbers) = match tangents {
        Some((measure, numbering, out)) => {
            check_length("tangents", count.saturating_mul(measure.numbers()), out.len())?;
            (Some((measure, numbering)), out)
        }
        None => (None, &mut [][..]),
    };
    let batch = Batch { law, increment, control, layout, before, stress, tangent };
    let after = After::of(layout, length, after);
    let bad = batch.run(Part { first: 0, after, stresses, tangents: numbers });
    bad.finish(|bad, index, error| FfiError::BadIncrements { bad, count, index, error: Box::new(error) })
}

/// What all points share.
struct Batch<'a> {
    law: &'a AnyInelastic,
    increment: DeformationIncrement<'a>,
    control: StepControl,
    layout: StateLayout,
    before: &'a [f64],
    stress: StressMeasure,
    tangent: Option<(TangentMeasure, VoigtNumbering)>,
}

/// Some of the points, from number `first` on.
struct Part<'a> {
    first: usize,
    after: After<'a>,
    stresses: &'a mut [[f64; 9]],
    tangents: &'a mut [f64],
}

impl Batch<'_> {
    /// Numbers of a tangent.
    fn numbers(&self) -> usize {
        self.tangent.map_or(0, |(measure, _)| measure.numbers())
    }

    #[cfg(feature = "rayon")]
    fn run(&self, part: Part<'_>) -> Bad<InelasticError> {
        if part.stresses.len() < PARALLEL || rayon::current_num_threads() < 2 {
            return self.points(part);
        }
        let half = part.stresses.len() / 2;
        let (after, other_after) = part.after.split(half);
        let (stresses, other_stresses) = part.stresses.split_at_mut(half);
        let (tangents, other_tangents) = part.tangents.split_at_mut(half * self.numbers());
        let head = Part { first: part.first, after, stresses, tangents };
        let tail =
            Part { first: part.first + half, after: other_after, stresses: other_stresses, tangents: other_tangents };
        let (head, tail) = rayon::join(|| self.run(head), || self.run(tail));
        head.and(tail)
    }

    #[cfg(not(feature = "rayon"))]
    fn run(&self, part: Part<'_>) -> Bad<InelasticError> {
        self.points(part)
    }

    fn points(&self, mut part: Part<'_>) -> Bad<InelasticError> {
        let (numbers, length) = (self.numbers(), self.law.state_length());
        let mut bad = Bad::default();
        let mut memory = [0.0; MOST_STATE];
        let state = &mut memory[..length];
        for (point, stress) in part.stresses.iter_mut().enumerate() {
            let index = part.first + point;
            let tangent = &mut part.tangents[numbers * point..][..numbers];
            gather(self.layout, self.before, index, state);
            if let Err(error) = self.point(index, state, stress, tangent) {
                bad.note(index, error);
                gather(self.layout, self.before, index, state);
                stress.fill(f64::NAN);
                tangent.fill(f64::NAN);
            }
            part.after.write(point, state);
        }
        bad
    }

    fn point(
        &self,
        index: usize,
        state: &mut [f64],
        stress: &mut [f64; 9],
        tangent: &mut [f64],
    ) -> Result<(), InelasticError> {
        let DeformationIncrement { from, to, dt, .. } = self.increment;
        let to = deformation(&to[index])?;
        let path = [&deformation(&from[index])?, &to];
        match self.tangent {
            None => {
                let (first_piola, _) = self.law.advance_stress(state, path, dt, &self.control)?;
                conversions::stress(&first_piola, self.stress, &to, stress);
            }
            Some((measure, numbering)) => {
                let advanced = self.law.advance(state, path, dt, &self.control)?;
                conversions::stress(&advanced.first_piola, self.stress, &to, stress);
                conversions::tangent(&advanced, measure, numbering, &to, tangent);
            }
        }
        match stress.iter().chain(&*tangent).position(|x| !x.is_finite()) {
            Some(index) => {
                let value = if index < 9 { stress[index] } else { tangent[index - 9] };
                Err(InelasticError::NotFinite { quantity: "stress and tangent", index, value })
            }
            None => Ok(()),
        }
    }
}

/// F of nine numbers by rows.
fn deformation(f: &[f64; 9]) -> Result<DeformationGradient, InelasticError> {
    let [a, b, c, d, e, g, h, i, j] = *f;
    Ok(DeformationGradient::from_rows([[a, b, c], [d, e, g], [h, i, j]])?)
}
