//! Hamilton's equations of any Hamiltonian H(q, p, t), by exact derivatives.
//!
//! ```text
//! q̇ = ∂H/∂p        ṗ = −∂H/∂q                                                           W(9.10)
//! ```

use piola_integrators::Field;
use piola_numerics::{Gradient, Real};

use crate::DynamicsError;

/// Directions of differentiation in one pass.
const CHUNK: usize = 4;

/// A Hamiltonian, written once for any scalar.
///
/// # Example
/// ```
/// use piola_dynamics::hamiltonian::{Hamiltonian, HamiltonianField};
/// use piola_integrators::Field;
/// use piola_numerics::Real;
/// /// H = (p² + q²)/2.
/// struct Oscillator;
/// impl Hamiltonian for Oscillator {
///     fn hamiltonian<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
///         T::lit(0.5) * (p[0] * p[0] + q[0] * q[0])
///     }
/// }
/// let mut rate = [0.0; 2];
/// HamiltonianField::new(&Oscillator, 1).rate(0.0, &[3.0, 4.0], &mut rate)?;
/// assert_eq!(rate, [4.0, -3.0]);
/// # Ok::<(), piola_dynamics::DynamicsError>(())
/// ```
pub trait Hamiltonian {
    /// H(q, p, t), J.
    fn hamiltonian<T: Real>(&self, q: &[T], p: &[T], t: T) -> T;
}

/// The Hamiltonian vector field on phase space, y = (q, p), for any integrator.
///
/// # Source
/// W(9.10), W(9.13).
#[derive(Clone, Debug)]
pub struct HamiltonianField<'a, H, T = f64> {
    hamiltonian: &'a H,
    freedom: usize,
    state: Vec<Gradient<T, CHUNK>>,
}

impl<'a, H: Hamiltonian, T: Real> HamiltonianField<'a, H, T> {
    /// The field of a Hamiltonian of n degrees of freedom.
    pub fn new(hamiltonian: &'a H, freedom: usize) -> Self {
        Self { hamiltonian, freedom, state: Vec::with_capacity(2 * freedom) }
    }
}

impl<H: Hamiltonian, T: Real> Field<T> for HamiltonianField<'_, H, T> {
    type Error = DynamicsError;
    fn dimension(&self) -> usize {
        2 * self.freedom
    }
    fn rate(&mut self, t: f64, y: &[T], rate: &mut [T]) -> Result<(), DynamicsError> {
        let n = self.freedom;
        for first in (0..2 * n).step_by(CHUNK) {
            self.state.clear();
            self.state.extend(y.iter().enumerate().map(|(i, &y)| Gradient::variable(y, i.wrapping_sub(first))));
            let (q, p) = self.state.split_at(n);
            let value = self.hamiltonian.hamiltonian(q, p, Gradient::constant(T::lit(t)));
            for (direction, partial) in (first..2 * n).zip(value.partials) {
                if direction < n {
                    rate[n + direction] = -partial;
                } else {
                    rate[direction - n] = partial;
                }
            }
        }
        Ok(())
    }
}
