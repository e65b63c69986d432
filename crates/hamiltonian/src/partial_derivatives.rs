//! A value and all partial derivatives, in chunks, without allocation once used.

use piola_numerics::{Gradient, Real};

/// Directions of differentiation in one pass.
const CHUNK: usize = 4;

/// The number that every formula is evaluated in.
pub(crate) type Differentiable<T> = Gradient<T, CHUNK>;

/// A value, its partial derivatives, and the room to find them.
#[derive(Clone, Debug)]
pub(crate) struct Slopes<T> {
    variables: Vec<Differentiable<T>>,
    pub(crate) value: T,
    pub(crate) partials: Vec<T>,
}

impl<T: Real> Slopes<T> {
    pub(crate) fn new() -> Self {
        Self { variables: Vec::new(), value: T::zero(), partials: Vec::new() }
    }

    /// Evaluates f and all of its derivatives.
    pub(crate) fn of(
        &mut self,
        variables: &(impl Iterator<Item = T> + Clone),
        f: impl Fn(&[Differentiable<T>]) -> Differentiable<T>,
    ) {
        self.partials.clear();
        let mut first = 0;
        loop {
            self.variables.clear();
            let numbered = variables.clone().enumerate();
            self.variables.extend(numbered.map(|(i, x)| Gradient::variable(x, i.wrapping_sub(first))));
            let count = self.variables.len();
            let found = f(&self.variables);
            self.value = found.value;
            self.partials.extend(found.partials.into_iter().take(count.saturating_sub(first)));
            first += CHUNK;
            if count <= first {
                return;
            }
        }
    }
}
