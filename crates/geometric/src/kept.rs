//! What implicit methods keep from step to step, as it is written to a checkpoint and read from it.

use piola_integrators::{Checkpoint, IntegratorsError, Report, State};
use piola_numerics::Real;

/// Memory of a run of equal steps, of a size that the system and the method fix.
pub(crate) trait Kept<T: Real> {
    /// Shows every part to the visitor, always in the same order.
    fn visit<V: Visitor<T>>(&mut self, visitor: &mut V);

    /// The run where it stands.
    fn checkpoint(&mut self, state: &State<T>, report: Report) -> Checkpoint<T> {
        let mut written = Written { memory: Vec::new(), numbers: Vec::new() };
        self.visit(&mut written);
        Checkpoint::of(state.clone(), report, written.memory, written.numbers)
    }

    /// Goes on from a checkpoint; the method has made room for the system. Returns the report of the run so far.
    fn restore<E>(&mut self, checkpoint: &Checkpoint<T>, state: &mut State<T>) -> Result<Report, IntegratorsError<E>> {
        let mut room = Room { memory: 0, numbers: 0 };
        self.visit(&mut room);
        let (memory, numbers) = checkpoint.memory();
        // Exchanges of rows are checked before anything is changed.
        let mut checked = Checked { numbers, taken: 0, outside: None };
        if numbers.len() == room.numbers {
            self.visit(&mut checked);
        }
        if let Some((column, row, dimension)) = checked.outside {
            return Err(IntegratorsError::OutsideMatrix { quantity: "checkpoint.numbers", row, column, dimension });
        }
        checkpoint.open(state, room.memory, room.numbers, &[])?;
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

/// Looks for rows that a matrix has not.
struct Checked<'a> {
    numbers: &'a [f64],
    taken: usize,
    outside: Option<(usize, usize, usize)>,
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
        for (column, &row) in self.numbers[self.taken..][..dimension].iter().enumerate() {
            let row = row_of(row);
            if dimension <= row {
                self.outside = self.outside.or(Some((column, row, dimension)));
            }
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
        for (exchange, &row) in exchanges.iter_mut().zip(first) {
            *exchange = row_of(row);
        }
        self.numbers = rest;
    }
}

/// A row as it is written; what is none lies outside of every matrix.
fn row_of(number: f64) -> usize {
    if !(0.0 <= number && number < f64::from(u32::MAX)) {
        return usize::MAX;
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 0 and 2³²")]
    let row = number as usize;
    row
}

/// The checkpoint of a method of equal steps whose memory is the given field.
macro_rules! checkpoint_of {
    ($field:ident) => {
        /// The run where it stands, to be continued by [`resume`](Self::resume): the state and the report of a run of this method that
        /// has ended or that the observer has stopped.
        #[must_use]
        pub fn checkpoint(&mut self, state: &State<T>, report: Report) -> Checkpoint<T> {
            self.$field.checkpoint(state, report)
        }
    };
}
pub(crate) use checkpoint_of;
