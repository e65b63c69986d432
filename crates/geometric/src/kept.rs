//! What implicit methods keep from step to step, as it is written to a checkpoint and read from it.

use piola_integrators::{Checkpoint, IntegratorsError, Report, State};
use piola_numerics::Real;

/// Memory of a run of equal steps, of a size that the system and the method fix.
pub(crate) trait Kept<T: Real>: Clone {
    /// Shows every part to the visitor, always in the same order.
    fn visit<V: Visitor<T>>(&mut self, visitor: &mut V);

    /// The run of the `method` where it stands.
    fn checkpoint(&self, method: &'static str, state: &State<T>, report: Report) -> Checkpoint<T> {
        let mut written = Written { memory: Vec::new(), numbers: Vec::new() };
        // One visit for writing and reading: the one that writes sees a copy.
        self.clone().visit(&mut written);
        Checkpoint::of(method, state.clone(), report, written.memory, written.numbers)
    }

    /// Begins a run of the `method` anew or from a checkpoint, in a memory that has room for the system, from a state that `check`
    /// accepts. Returns the report of the run so far.
    fn start<E>(
        &mut self,
        method: &'static str,
        resumed: Option<&Checkpoint<T>>,
        state: &mut State<T>,
        check: impl FnOnce(&mut State<T>) -> Result<(), IntegratorsError<E>>,
    ) -> Result<Report, IntegratorsError<E>> {
        let Some(checkpoint) = resumed else {
            check(state)?;
            return Ok(Report::begin());
        };
        let mut room = Room { memory: 0, numbers: 0 };
        self.visit(&mut room);
        let (memory, numbers) = checkpoint.memory();
        checkpoint.open(method, [room.memory, room.numbers], &[], state, |state| {
            // Exchanges of rows are checked before anything is changed.
            let mut checked = Checked { numbers, taken: 0, outside: None };
            self.visit(&mut checked);
            if let Some((index, dimension)) = checked.outside {
                let (quantity, value) = ("checkpoint.numbers", numbers[index]);
                return Err(IntegratorsError::InvalidRow { quantity, index, value, dimension });
            }
            check(state)
        })?;
        self.visit(&mut Read { memory, numbers });
        Ok(checkpoint.report().continued())
    }
}

/// What is done with the parts of a memory.
pub(crate) trait Visitor<T> {
    fn values(&mut self, values: &mut [T]);
    fn numbers(&mut self, numbers: &mut [f64]);
    fn flag(&mut self, flag: &mut bool);
    /// Exchanges of the rows of a matrix.
    fn exchanges(&mut self, exchanges: &mut [usize]);
}

struct Written<T> {
    memory: Vec<T>,
    numbers: Vec<f64>,
}

impl<T: Real> Visitor<T> for Written<T> {
    fn values(&mut self, values: &mut [T]) {
        self.memory.extend_from_slice(values);
    }
    fn numbers(&mut self, numbers: &mut [f64]) {
        self.numbers.extend_from_slice(numbers);
    }
    fn flag(&mut self, flag: &mut bool) {
        self.numbers.push(f64::from(u8::from(*flag)));
    }
    fn exchanges(&mut self, exchanges: &mut [usize]) {
        self.numbers.extend(exchanges.iter().map(|&row| row as f64));
    }
}

/// Counts.
struct Room {
    memory: usize,
    numbers: usize,
}

impl<T> Visitor<T> for Room {
    fn values(&mut self, values: &mut [T]) {
        self.memory += values.len();
    }
    fn numbers(&mut self, numbers: &mut [f64]) {
        self.numbers += numbers.len();
    }
    fn flag(&mut self, _flag: &mut bool) {
        self.numbers += 1;
    }
    fn exchanges(&mut self, exchanges: &mut [usize]) {
        self.numbers += exchanges.len();
    }
}

/// Finds row numbers outside the matrix.
struct Checked<'a> {
    numbers: &'a [f64],
    taken: usize,
    /// The index of the first of them, and the number of rows.
    outside: Option<(usize, usize)>,
}

impl<T> Visitor<T> for Checked<'_> {
    fn values(&mut self, _values: &mut [T]) {}
    fn numbers(&mut self, numbers: &mut [f64]) {
        self.taken += numbers.len();
    }
    fn flag(&mut self, _flag: &mut bool) {
        self.taken += 1;
    }
    fn exchanges(&mut self, exchanges: &mut [usize]) {
        let dimension = exchanges.len();
        let rows = &self.numbers[self.taken..][..dimension];
        if let Some(column) = rows.iter().position(|&row| row_of(row, dimension).is_none()) {
            self.outside = self.outside.or(Some((self.taken + column, dimension)));
        }
        self.taken += dimension;
    }
}

struct Read<'a, T> {
    memory: &'a [T],
    numbers: &'a [f64],
}

impl<T: Real> Visitor<T> for Read<'_, T> {
    fn values(&mut self, values: &mut [T]) {
        let (first, rest) = self.memory.split_at(values.len());
        values.copy_from_slice(first);
        self.memory = rest;
    }
    fn numbers(&mut self, numbers: &mut [f64]) {
        let (first, rest) = self.numbers.split_at(numbers.len());
        numbers.copy_from_slice(first);
        self.numbers = rest;
    }
    fn flag(&mut self, flag: &mut bool) {
        let (first, rest) = self.numbers.split_at(1);
        *flag = 0.0 < first[0];
        self.numbers = rest;
    }
    fn exchanges(&mut self, exchanges: &mut [usize]) {
        let (first, rest) = self.numbers.split_at(exchanges.len());
        let dimension = exchanges.len();
        for (exchange, &row) in exchanges.iter_mut().zip(first) {
            // They were checked.
            *exchange = row_of(row, dimension).unwrap_or_default();
        }
        self.numbers = rest;
    }
}

/// A row as it is written, if it is one of so many.
fn row_of(number: f64, dimension: usize) -> Option<usize> {
    if !(0.0 <= number && number < dimension as f64 && number.fract().abs() <= 0.0) {
        return None;
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a whole number below the dimension")]
    let row = number as usize;
    Some(row)
}

/// The checkpoint of the method of this name, of equal steps, whose memory is the given field.
macro_rules! checkpoint_of {
    ($field:ident, $name:literal) => {
        const NAME: &str = $name;

        /// The run where it stands, to be continued by [`resume`](Self::resume): the state and the report of a run of this method that
        /// has ended or that the observer has stopped.
        #[must_use]
        pub fn checkpoint(&self, state: &State<T>, report: Report) -> Checkpoint<T> {
            self.$field.checkpoint(Self::NAME, state, report)
        }
    };
}
pub(crate) use checkpoint_of;
