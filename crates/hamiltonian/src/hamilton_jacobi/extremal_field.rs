//! The extremals of a given solution U(q, t): its action is the increment of U.
//!
//! ```text
//! p = ∂U/∂q,   q̇ = H_p(q, ∂U/∂q, t)        ∫ (p·q̇ − H) dt = U(q₁, t₁) − U(q₀, t₀)    W(13.19–13.27)
//! ```

use piola_integrators::{DormandPrince853, Field, State, Tolerance};
use piola_numerics::{Gradient, Real};

use super::PrincipalFunction;
use super::strips::slopes_of;
use crate::HamiltonianError;
use crate::PhaseFunction;
use crate::check::check_finite;
use crate::partial_derivatives::Slopes;

/// The field of extremals of a solution U, y = (q, action), for any integrator.
///
/// # Example
/// The free particles that left q = 0 at t = 0: U = q²/(2t), q̇ = q/t.
/// ```
/// use piola_hamiltonian::hamilton_jacobi::{ExtremalField, PrincipalFunction};
/// use piola_hamiltonian::PhaseFunction;
/// use piola_integrators::Tolerance;
/// use piola_numerics::Real;
/// struct Free;
/// impl PhaseFunction for Free {
///     fn value<T: Real>(&self, _q: &[T], p: &[T], _t: T) -> T {
///         T::lit(0.5) * p[0] * p[0]
///     }
/// }
/// struct Action;
/// impl PrincipalFunction for Action {
///     fn value<T: Real>(&self, q: &[T], t: T) -> T {
///         q[0] * q[0] / (t + t)
///     }
/// }
/// let extremal = ExtremalField::new(&Free, &Action, 1).follow(&[3.0], 1.0, 2.0, Tolerance::relative(1e-13)?)?;
/// assert!((extremal.coordinates[0] - 6.0).abs() < 1e-12);
/// assert!((extremal.action - 4.5).abs() < 1e-12); // ½ · 9 · 1
/// assert!((extremal.increment - 4.5).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// W(13.19–13.27).
#[derive(Clone, Debug)]
pub struct ExtremalField<'a, H, U, T = f64> {
    hamiltonian: &'a H,
    solution: &'a U,
    freedom: usize,
    of_solution: Slopes<T>,
    of_hamiltonian: Slopes<T>,
}

/// The end of an extremal of a solution U.
///
/// # Example
/// See [`ExtremalField`].
///
/// # Source
/// W(13.27).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FieldExtremal {
    /// q₁.
    pub coordinates: Vec<f64>,
    /// p₁ = ∂U/∂q.
    pub momenta: Vec<f64>,
    /// ∫ (p·q̇ − H) dt, J s.
    pub action: f64,
    /// U(q₁, t₁) − U(q₀, t₀), J s: equal to the action when U solves the Hamilton–Jacobi equation.
    pub increment: f64,
}

impl<'a, H: PhaseFunction, U: PrincipalFunction, T: Real> ExtremalField<'a, H, U, T> {
    /// The extremals of a solution for a Hamiltonian of n degrees of freedom.
    #[must_use]
    pub fn new(hamiltonian: &'a H, solution: &'a U, freedom: usize) -> Self {
        Self { hamiltonian, solution, freedom, of_solution: Slopes::new(), of_hamiltonian: Slopes::new() }
    }

    fn evaluate(&mut self, q: &[T], t: T) {
        let Self { solution, of_solution, of_hamiltonian, hamiltonian, .. } = self;
        of_solution.of(&q.iter().copied(), |q| solution.value(q, Gradient::constant(t)));
        slopes_of(*hamiltonian, of_hamiltonian, (q, &of_solution.partials, t));
    }
}

impl<H: PhaseFunction, U: PrincipalFunction> ExtremalField<'_, H, U> {
    /// Follows the extremal through (q₀, t₀) to t₁.
    ///
    /// # Errors
    /// [`HamiltonianError::NotFinite`]; [`HamiltonianError::Run`] where the field ends, as at a caustic of U.
    ///
    /// # Accuracy
    /// That of the tolerance, times what neighbouring extremals spread.
    pub fn follow(
        mut self,
        q: &[f64],
        t0: f64,
        t1: f64,
        tolerance: Tolerance,
    ) -> Result<FieldExtremal, HamiltonianError> {
        check_finite("q", q)?;
        check_finite("t", &[t0, t1])?;
        let n = self.freedom;
        let mut start = q.to_vec();
        start.push(0.0);
        let run = |error| HamiltonianError::Run { time: t0, source: Box::new(error) };
        let mut state = State::new(t0, start).map_err(|error| run(error.with_field_error()))?;
        DormandPrince853::new(tolerance).integrate_to(&mut self, &mut state, t1).map_err(run)?;
        self.evaluate(q, t0);
        let before = self.of_solution.value;
        self.evaluate(&state.values[..n], t1);
        let increment = self.of_solution.value - before;
        check_finite("U", &[increment])?;
        Ok(FieldExtremal {
            coordinates: state.values[..n].to_vec(),
            momenta: self.of_solution.partials.clone(),
            action: state.values[n],
            increment,
        })
    }
}

impl<H: PhaseFunction, U: PrincipalFunction, T: Real> Field<T> for ExtremalField<'_, H, U, T> {
    type Error = HamiltonianError;
    fn dimension(&self) -> usize {
        self.freedom + 1
    }
    fn rate(&mut self, t: f64, y: &[T], rate: &mut [T]) -> Result<(), HamiltonianError> {
        let n = self.freedom;
        self.evaluate(&y[..n], T::lit(t));
        let velocity = &self.of_hamiltonian.partials[n..2 * n];
        rate[..n].copy_from_slice(velocity);
        let mut along = -self.of_hamiltonian.value;
        for (&p, &v) in self.of_solution.partials.iter().zip(velocity) {
            along += p * v;
        }
        rate[n] = along;
        Ok(())
    }
    fn magnitudes(&self, y: &[T], magnitudes: &mut [f64]) {
        let n = self.freedom;
        let largest = |values: &[T]| {
            let lanes = values.iter().flat_map(|x| (0..T::LANES).map(|lane| x.primal(lane).abs()));
            lanes.fold(0.0, f64::max)
        };
        magnitudes[..n].fill(largest(&y[..n]));
        // The action may pass through zero; p·q is its size.
        let momentum = largest(&self.of_solution.partials);
        magnitudes[n] = largest(&y[n..]).max(largest(&y[..n]) * momentum);
    }
}
