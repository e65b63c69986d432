//! States of many points in the caller's memory, in either layout.

use piola::inelastic::MOST_STATE;

use super::StateLayout;

/// Reads the state of a point.
pub(super) fn gather(layout: StateLayout, states: &[f64], index: usize, state: &mut [f64]) {
    let length = state.len();
    match layout {
        StateLayout::Rows => state.copy_from_slice(&states[length * index..][..length]),
        StateLayout::Components => {
            let count = states.len() / length;
            for (k, value) in state.iter_mut().enumerate() {
                *value = states[count * k + index];
            }
        }
    }
}

/// Where states of some of the points go.
#[expect(clippy::large_enum_variant, reason = "one value a batch, on the stack: nothing is allocated")]
pub(super) enum After<'a> {
    Rows { length: usize, states: &'a mut [f64] },
    Components([&'a mut [f64]; MOST_STATE]),
}

impl<'a> After<'a> {
    pub(super) fn of(layout: StateLayout, length: usize, states: &'a mut [f64]) -> Self {
        match layout {
            StateLayout::Rows => Self::Rows { length, states },
            StateLayout::Components => {
                let count = states.len() / length;
                let mut rest = states;
                Self::Components(core::array::from_fn(|_| {
                    let (component, others) =
                        core::mem::take(&mut rest).split_at_mut_checked(count).unwrap_or_default();
                    rest = others;
                    component
                }))
            }
        }
    }

    /// Those of the first points, and of the others.
    #[cfg(feature = "rayon")]
    pub(super) fn split(self, middle: usize) -> (Self, Self) {
        match self {
            Self::Rows { length, states } => {
                let (states, others) = states.split_at_mut(length * middle);
                (Self::Rows { length, states }, Self::Rows { length, states: others })
            }
            Self::Components(states) => {
                let mut others: [&'a mut [f64]; MOST_STATE] = Default::default();
                let mut pairs = states.into_iter().zip(&mut others);
                let first = core::array::from_fn(|_| match pairs.next() {
                    Some((states, other)) => {
                        let (head, tail) = states.split_at_mut(middle.min(states.len()));
                        *other = tail;
                        head
                    }
                    None => &mut [],
                });
                (Self::Components(first), Self::Components(others))
            }
        }
    }

    /// Writes the state of a point of these.
    pub(super) fn write(&mut self, point: usize, state: &[f64]) {
        match self {
            Self::Rows { length, states } => states[*length * point..][..*length].copy_from_slice(state),
            Self::Components(states) => {
                for (component, value) in states.iter_mut().zip(state) {
                    component[point] = *value;
                }
            }
        }
    }
}
