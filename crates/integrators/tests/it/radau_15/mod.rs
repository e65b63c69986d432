//! Gauss–Radau collocation of order 15: its coefficients and its runs; what it shares with the other collocation method is tested
//! in `collocation`.

mod coefficients;
mod runs;

use core::convert::Infallible;

use piola_integrators::SecondOrder;
use piola_numerics::Real;

/// q̈ = f(t, q, q̇) by a function, in one scalar.
struct By<F>(usize, F);
impl<T: Real, F: FnMut(T, &[T], &[T], &mut [T])> SecondOrder<T> for By<F> {
    type Error = Infallible;
    fn freedom(&self) -> usize {
        self.0
    }
    fn acceleration(&mut self, t: T, q: &[T], v: &[T], acceleration: &mut [T]) -> Result<(), Infallible> {
        (self.1)(t, q, v, acceleration);
        Ok(())
    }
}

fn by<T: Real, F: FnMut(T, &[T], &[T], &mut [T])>(freedom: usize, function: F) -> By<F> {
    By(freedom, function)
}
