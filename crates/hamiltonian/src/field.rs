//! Hamilton's equations of any function H(q, p, t), by exact derivatives.
//!
//! ```text
//! q̇ = ∂H/∂p        ṗ = −∂H/∂q                                                           W(9.10)
//! ```

use piola_integrators::Field;
use piola_numerics::{Gradient, Real};

use super::PhaseFunction;
use super::differential::{CHUNK, check_result, differentiate, differentiate_at_once};
use crate::HamiltonianError;

/// The Hamiltonian vector field on phase space, y = (q, p), for any integrator.
///
/// # Example
/// ```
/// use piola_hamiltonian::{HamiltonianField, PhaseFunction};
/// use piola_integrators::Field;
/// use piola_numerics::Real;
/// /// H = (p² + q²)/2.
/// struct Oscillator;
/// impl PhaseFunction for Oscillator {
///     fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
///         T::lit(0.5) * (p[0] * p[0] + q[0] * q[0])
///     }
/// }
/// let mut rate = [0.0; 2];
/// HamiltonianField::new(&Oscillator, 1).rate(0.0, &[3.0, 4.0], &mut rate)?;
/// assert_eq!(rate, [4.0, -3.0]);
/// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
/// ```
///
/// # Source
/// W(9.10), W(9.13).
#[derive(Clone, Debug)]
pub struct HamiltonianField<'a, H, T = f64> {
    hamiltonian: &'a H,
    freedom: usize,
    seeds: Vec<Gradient<T, CHUNK>>,
    differential: Vec<T>,
}

impl<'a, H: PhaseFunction, T: Real> HamiltonianField<'a, H, T> {
    /// The field of a Hamiltonian of n degrees of freedom.
    pub fn new(hamiltonian: &'a H, freedom: usize) -> Self {
        let seeds = vec![Gradient::constant(T::zero()); 2 * freedom];
        Self { hamiltonian, freedom, seeds, differential: vec![T::zero(); 2 * freedom] }
    }
}

impl<H: PhaseFunction, T: Real> Field<T> for HamiltonianField<'_, H, T> {
    type Error = HamiltonianError;
    fn dimension(&self) -> usize {
        2 * self.freedom
    }
    #[inline]
    fn rate(&mut self, t: f64, y: &[T], rate: &mut [T]) -> Result<(), HamiltonianError> {
        let n = self.freedom;
        let (q, p) = y.split_at(n);
        let point = (q, p, T::lit(t));
        // Few degrees of freedom go in one pass of numbers of that size, about twice as fast.
        let (hamiltonian, out) = (self.hamiltonian, &mut self.differential[..]);
        match n {
            1 => differentiate_at_once::<T, 2>(hamiltonian, point, out),
            2 => differentiate_at_once::<T, 4>(hamiltonian, point, out),
            3 => differentiate_at_once::<T, 6>(hamiltonian, point, out),
            _ => {
                differentiate(hamiltonian, point, &mut self.seeds, out);
            }
        }
        let (velocity, force) = rate.split_at_mut(n);
        for i in 0..n {
            velocity[i] = self.differential[n + i];
            force[i] = -self.differential[i];
        }
        check_result(point, "dH", &self.differential)
    }
}
