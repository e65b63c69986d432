//! States kept at some steps of a run, so that the run can be walked backwards in bounded memory.
//!
//! On the way forwards the state at every k-th step is kept. When the memory is full, every second one is dropped and k doubles. On
//! the way backwards the states between are made again. Where they are kept in turn follows the binomial schedule, which makes the
//! fewest steps again:
//!
//! ```text
//! t(l, c) = min over m of [ m + t(l − m, c − 1) + t(m, c) ],    t(1, c) = 0,    t(l, 1) = l (l − 1)/2
//! ```
//!
//! for l steps with c states, the start among them.
//!
//! # References
//! A. Griewank, A. Walther, *Algorithm 799: revolve*, ACM Trans. Math. Softw. 26 (2000) 19–45.

use piola_numerics::Real;

/// States by the numbers of the steps that begin there, ascending.
#[derive(Clone, Debug)]
pub(super) struct Checkpoints<T> {
    /// The most states kept, at least one.
    capacity: usize,
    /// k.
    spacing: usize,
    numbers: Vec<usize>,
    /// y and what rounding left of it, for each number.
    states: Vec<T>,
    n: usize,
}

impl<T: Real> Checkpoints<T> {
    /// At most `beside_start` states, and the start.
    pub(super) const fn new(beside_start: usize) -> Self {
        let capacity = beside_start.saturating_add(1);
        Self { capacity, spacing: 1, numbers: Vec::new(), states: Vec::new(), n: 0 }
    }

    /// Forgets all states; the next ones have n components.
    pub(super) fn clear(&mut self, n: usize) {
        self.numbers.clear();
        self.states.clear();
        (self.spacing, self.n) = (1, n);
    }

    /// Whether there is room for no other state.
    pub(super) const fn is_full(&self) -> bool {
        self.capacity <= self.numbers.len()
    }

    /// The number of states kept.
    pub(super) const fn count(&self) -> usize {
        self.numbers.len()
    }

    /// On the way forwards: keeps the state at the start of a step if its turn has come.
    pub(super) fn offer(&mut self, number: usize, y: &[T], carry: &[T]) {
        while number.is_multiple_of(self.spacing) && self.is_full() {
            if self.capacity < 2 {
                return;
            }
            self.thin();
        }
        if number.is_multiple_of(self.spacing) {
            self.push(number, y, carry);
        }
    }

    /// Keeps a state whose number is above all others.
    pub(super) fn push(&mut self, number: usize, y: &[T], carry: &[T]) {
        self.numbers.push(number);
        self.states.extend_from_slice(y);
        self.states.extend_from_slice(carry);
    }

    /// The last number, whose state is written to y and `carry`.
    pub(super) fn read_last(&self, y: &mut [T], carry: &mut [T]) -> Option<usize> {
        let number = *self.numbers.last()?;
        let (values, carries) = self.states.get(self.states.len() - 2 * self.n..)?.split_at(self.n);
        y.copy_from_slice(values);
        carry.copy_from_slice(carries);
        Some(number)
    }

    /// Forgets the states from a number on, except the first of all.
    pub(super) fn forget_from(&mut self, number: usize) {
        while 1 < self.numbers.len() && self.numbers.last().is_some_and(|&last| number <= last) {
            self.numbers.pop();
            self.states.truncate(self.states.len() - 2 * self.n);
        }
    }

    /// Doubles the distance of the states.
    fn thin(&mut self) {
        self.spacing *= 2;
        let (size, mut kept) = (2 * self.n, 0);
        for place in 0..self.numbers.len() {
            if self.numbers[place].is_multiple_of(self.spacing) {
                self.numbers[kept] = self.numbers[place];
                self.states.copy_within(place * size..(place + 1) * size, kept * size);
                kept += 1;
            }
        }
        self.numbers.truncate(kept);
        self.states.truncate(kept * size);
    }

    /// Of `length` steps to be made again from the last kept state: the number of steps after which the next state is kept (m above).
    pub(super) fn next_distance(&self, length: usize) -> usize {
        let c = (self.capacity - self.numbers.len() + 1) as u128;
        let length = length as u128;
        // (c + r − 2 over c), (c + r − 1 over c) and (c + r over c), for r = 1.
        let (mut r, mut lower, mut middle, mut upper) = (1_u128, 0_u128, 1_u128, c + 1);
        while upper < length {
            r += 1;
            (lower, middle, upper) = (middle, upper, upper * (c + r) / r);
        }
        // (c + r − 2 over c − 1) is the difference of two of them.
        let distance = middle.min(length - (middle - lower));
        usize::try_from(distance).unwrap_or(usize::MAX)
    }
}
