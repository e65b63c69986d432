//! Runs that are written down and continued.

use piola_integrators::{Checkpoint, IntegratorsError, Report, State};
use piola_numerics::Real;

use super::Run;
use super::extrapolation::{Aim, ROWS};
use crate::GravitationError;
use crate::checkpoint::{count_of, take};

/// The name in a checkpoint.
const NAME: &str = "Regularised";
/// The numbers before the order of the chain: when the run began, its direction, the row and the step that are aimed at, and what each row
/// found.
const NUMBERS: usize = 4 + 2 * ROWS;

/// The direction of the run that was saved.
pub(super) fn direction<T: Real>(checkpoint: &Checkpoint<T>) -> f64 {
    checkpoint.memory().1[1].signum()
}

/// Refuses a checkpoint that is not of this method or of so many bodies; else the state becomes its state.
pub(super) fn check<T: Real>(
    checkpoint: &Checkpoint<T>,
    bodies: usize,
    state: &mut State<T>,
    of_bodies: impl Fn(&State<T>) -> Result<(), IntegratorsError<GravitationError>>,
) -> Result<(), IntegratorsError<GravitationError>> {
    let links = 2 * bodies.saturating_sub(1);
    checkpoint.open(NAME, [6 * links + 9, NUMBERS + bodies], &[], state, |opened| {
        let numbers = checkpoint.memory().1;
        let refuse = |index: usize, dimension: usize| {
            let value = numbers[index];
            Err(IntegratorsError::InvalidRow { quantity: "checkpoint.numbers", index, value, dimension })
        };
        if !Aim::ROWS_AIMED_AT.map(|row| row as f64).contains(&numbers[2]) {
            return refuse(2, ROWS);
        }
        for body in 0..bodies {
            // Each body stands once in the chain.
            let is_it = |&value: &f64| value.total_cmp(&(body as f64)).is_eq();
            if !numbers[NUMBERS..].iter().any(is_it) {
                let wrong = |&index: &usize| {
                    let value = numbers[index];
                    !(0..bodies).any(|body| value.total_cmp(&(body as f64)).is_eq())
                        || numbers[NUMBERS..index].iter().any(|before| before.total_cmp(&value).is_eq())
                };
                return refuse((NUMBERS..NUMBERS + bodies).find(wrong).unwrap_or(NUMBERS), bodies);
            }
        }
        of_bodies(opened)
    })
}

impl<T: Real> Run<T> {
    /// The run where it stands.
    pub(super) fn checkpoint(&self, start: f64, state: &State<T>, report: Report) -> Checkpoint<T> {
        let triples = self.chain.vectors.iter().chain(&self.chain.carries).chain(&self.centre);
        let memory = triples.flatten().chain(&self.time).chain([&self.binding]).copied().collect();
        let (steps, work) = self.aim.found();
        // Work that is not known is infinite, and no number in a file.
        let work = work.map(|work| if work.is_finite() { work } else { 0.0 });
        let aim = [start, self.aim.step.signum(), self.aim.row as f64, self.aim.step];
        let order: Vec<f64> = self.chain.order.iter().map(|&body| body as f64).collect();
        Checkpoint::of(NAME, state.clone(), report, memory, [&aim[..], &steps, &work, &order].concat())
    }

    /// Takes back what was saved, if it goes in the same direction: returns when that run began.
    pub(super) fn restore(&mut self, checkpoint: &Checkpoint<T>, direction: f64) -> Option<f64> {
        let (mut memory, mut numbers) = checkpoint.memory();
        let [start, before, row, step]: [f64; 4] = take(&mut numbers)?;
        if before.total_cmp(&direction).is_ne() {
            return None;
        }
        let (steps, work) = (take(&mut numbers)?, take::<f64, ROWS>(&mut numbers)?);
        let index = |value: f64| usize::try_from(count_of(value)).unwrap_or(usize::MAX);
        let work = work.map(|work| if 0.0 < work { work } else { f64::INFINITY });
        self.aim = Aim::of(index(row), step, steps, work);
        for (body, &saved) in self.chain.order.iter_mut().zip(numbers) {
            *body = index(saved);
        }
        for triple in self.chain.vectors.iter_mut().chain(&mut self.chain.carries).chain(&mut self.centre) {
            *triple = take(&mut memory)?;
        }
        self.time = take(&mut memory)?;
        [self.binding] = take(&mut memory)?;
        Some(start)
    }
}
