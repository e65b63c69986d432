//! Gragg's extrapolation of the leapfrog to steps of length zero, with order and step chosen by their work.

/// Substeps of each row, by Bulirsch: the best entry of seven rows is a sum of leapfrogs whose weights add up to 7 in size.
/// Those of 2, 4, 6, 8, 10, 12, 14 add up to 56, and enlarge rounding as much.
pub(super) const SUBSTEPS: [u32; ROWS] = [2, 4, 6, 8, 12, 16, 24, 32, 48];
pub(super) const ROWS: usize = 9;

/// Chooses the row to aim at and the step, as Hairer, Nørsett & Wanner do, *Solving Ordinary Differential Equations I*, II.9.
#[derive(Clone, Copy, Debug)]
pub(super) struct Aim {
    /// The row, from 0, whose last entry is to be good enough.
    pub(super) row: usize,
    /// The step, in the unit of the fictitious time.
    pub(super) step: f64,
    steps: [f64; ROWS],
    work: [f64; ROWS],
}

/// What a row's error means for the step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Verdict {
    Accepted,
    /// Another row may do.
    Waiting,
    Rejected,
}

/// The rows that are aimed at.
const FIRST: usize = 2;
const LAST: usize = ROWS - 2;

impl Aim {
    /// The rows that can be aimed at.
    pub(super) const ROWS_AIMED_AT: [usize; LAST - FIRST + 1] = {
        let mut rows = [FIRST; LAST - FIRST + 1];
        let mut row = FIRST;
        while row <= LAST {
            rows[row - FIRST] = row;
            row += 1;
        }
        rows
    };

    /// As it was saved: with what each row found, the best step and the work.
    pub(super) const fn of(row: usize, step: f64, steps: [f64; ROWS], work: [f64; ROWS]) -> Self {
        Self { row, step, steps, work }
    }

    /// What each row found.
    pub(super) const fn found(&self) -> ([f64; ROWS], [f64; ROWS]) {
        (self.steps, self.work)
    }

    pub(super) fn new(tolerance: f64, step: f64) -> Self {
        // Two digits a row.
        let row = (-0.6 * tolerance.log10()).clamp(FIRST as f64, LAST as f64);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 2 and 8")]
        let row = row as usize;
        Self { row, step, steps: [step; ROWS], work: [f64::INFINITY; ROWS] }
    }

    /// Judges row `row` by its error over the tolerance.
    pub(super) fn judge(&mut self, row: usize, error: f64, step: f64) -> Verdict {
        let power = 1.0 / (2 * row + 1) as f64;
        let factor = (0.94 * (0.65 / error.max(1e-30)).powf(power)).clamp(0.02, 4.0);
        self.steps[row] = step * factor;
        self.work[row] = cost(row) / self.steps[row].abs();
        // Of two rows alone both may be wrong in the same way, as where a step is longer than a revolution.
        if row + 1 < self.row || row < FIRST {
            return Verdict::Waiting;
        }
        if error <= 1.0 {
            return Verdict::Accepted;
        }
        // What the rows up to the one after the aim can be hoped to gain.
        let hoped: f64 =
            (row + 1..=self.row + 1).map(|row| (f64::from(SUBSTEPS[row]) / f64::from(SUBSTEPS[0])).powi(2)).product();
        if row <= self.row && error <= hoped { Verdict::Waiting } else { Verdict::Rejected }
    }

    /// After a step that row `row` ended.
    pub(super) fn after_success(&mut self, row: usize, was_rejected: bool) {
        let best = if self.work[row - 1] < 0.9 * self.work[row] {
            row - 1
        } else if self.work[row] < 0.9 * self.work[row - 1] && !was_rejected {
            row + 1
        } else {
            row
        };
        let best = best.clamp(FIRST, LAST);
        let known = best.min(row);
        let step = self.steps[known] * cost(best) / cost(known);
        self.step = if was_rejected { shorter(step, self.step) } else { step };
        self.row = best;
    }

    /// After a step whose row `row` was not good enough.
    pub(super) fn after_failure(&mut self, row: usize) {
        let row = row.min(self.row);
        let best = if FIRST < row && self.work[row - 1] < 0.9 * self.work[row] { row - 1 } else { row };
        self.row = best.clamp(FIRST, LAST);
        self.step = shorter(self.steps[best.min(row)], 0.7 * self.step);
    }
}

fn shorter(a: f64, b: f64) -> f64 {
    if a.abs() < b.abs() { a } else { b }
}

/// Attractions up to and with a row.
fn cost(row: usize) -> f64 {
    SUBSTEPS[..=row].iter().map(|&count| f64::from(count)).sum()
}
