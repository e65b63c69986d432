//! The discrete action of a polynomial: A = h Σ bᵢ L(Qᵢ, Vᵢ, tᵢ).

use piola_integrators::IntegratorsError;
use piola_numerics::derivatives::{self, ScalarFunction, VectorFunction, Workspace};
use piola_numerics::{NumericsError, Real};

use super::VariationalSystem;
use super::rule::ActionTableau;
use super::step::{DiscreteAction, Start};

/// Memory for the derivatives of a Lagrangian.
#[derive(Clone, Debug)]
pub(super) struct Memory<T: Real> {
    derivatives: Workspace<T>,
    /// (q, v) at a point.
    point: Vec<T>,
    gradient: Vec<T>,
    /// Of 2n × 2n.
    hessian: Vec<T>,
    force: Vec<T>,
    /// Of n × 2n.
    force_jacobian: Vec<T>,
}

impl<T: Real> Memory<T> {
    pub(super) fn new(n: usize) -> Self {
        let zeros = |length| vec![T::zero(); length];
        Self {
            derivatives: Workspace::with_values(2 * n, n),
            point: zeros(2 * n),
            gradient: zeros(2 * n),
            hessian: zeros(4 * n * n),
            force: zeros(n),
            force_jacobian: zeros(2 * n * n),
        }
    }

    /// The number of coordinates it was made for.
    pub(super) fn freedom(&self) -> usize {
        self.force.len()
    }
}

/// L at a time, as a function of (q, v).
struct AtTime<'a, S>(&'a S, f64);

impl<S: VariationalSystem> ScalarFunction for AtTime<'_, S> {
    fn call<T: Real>(&self, x: &[T]) -> T {
        let (q, v) = x.split_at(x.len() / 2);
        self.0.lagrangian(q, v, T::lit(self.1))
    }
}

impl<S: VariationalSystem> VectorFunction for AtTime<'_, S> {
    fn values(&self, variables: usize) -> usize {
        variables / 2
    }
    fn call<T: Real>(&self, x: &[T], out: &mut [T]) {
        let (q, v) = x.split_at(x.len() / 2);
        self.0.force(q, v, T::lit(self.1), out);
    }
}

/// Says of which derivative a number is not finite.
fn refused(what: &'static str, t: f64) -> impl Fn(NumericsError) -> IntegratorsError {
    move |error| match error {
        NumericsError::NotFinite { index, value, .. } => {
            IntegratorsError::NotFinite { quantity: what, index, value, t: Some(t) }
        }
        // The lengths fit: nothing else is refused.
        _ => IntegratorsError::NotFinite { quantity: what, index: 0, value: f64::NAN, t: Some(t) },
    }
}

/// ∂L/∂v at (q, v, t).
pub(super) fn momenta<T: Real>(
    system: &impl VariationalSystem,
    memory: &mut Memory<T>,
    (q, v, t): (&[T], &[T], f64),
    p: &mut [T],
) -> Result<(), IntegratorsError> {
    let n = q.len();
    memory.point[..n].copy_from_slice(q);
    memory.point[n..].copy_from_slice(v);
    derivatives::gradient_into(&mut memory.derivatives, &AtTime(system, t), &memory.point, &mut memory.gradient)
        .map_err(refused("derivative of the Lagrangian", t))?;
    p.copy_from_slice(&memory.gradient[n..]);
    Ok(())
}

/// The action of a system over one step.
pub(super) struct PolynomialAction<'a, S, T: Real> {
    pub(super) system: &'a S,
    pub(super) tableau: &'a ActionTableau,
    pub(super) memory: &'a mut Memory<T>,
}

impl<S, T: Real> PolynomialAction<'_, S, T> {
    /// Writes Qᵢ and Vᵢ to the point: of increments, so that the velocity has no rounding of q.
    fn set_point(&mut self, start: &Start<'_, T>, u: &[T], i: usize) {
        let n = start.q.len();
        let (q, v) = self.memory.point.split_at_mut(n);
        for k in 0..n {
            let (mut moved, mut distance) = (start.q_carry[k], T::zero());
            for j in 0..self.tableau.degree {
                moved += T::lit(self.tableau.values[i][j]) * u[j * n + k];
                distance += T::lit(self.tableau.slopes[i][j]) * u[j * n + k];
            }
            q[k] = start.q[k] + moved;
            v[k] = distance / T::lit(start.h);
        }
    }

    /// The weight of ∂L/∂q at point i in the equation of node j, of which the last lacks the impulse.
    fn weight(&self, i: usize, j: usize, h: f64) -> T {
        let whole = if j + 1 == self.tableau.degree { 1.0 } else { 0.0 };
        T::lit(h * self.tableau.weights[i] * (self.tableau.values[i][j] - whole))
    }
}

impl<S: VariationalSystem, T: Real> DiscreteAction<T> for PolynomialAction<'_, S, T> {
    fn freedom(&self) -> usize {
        self.system.freedom()
    }

    fn equations(
        &mut self,
        start: &Start<'_, T>,
        u: &[T],
        out: &mut [T],
        impulse: &mut [T],
    ) -> Result<(), IntegratorsError> {
        let (n, h) = (start.q.len(), start.h);
        out.fill(T::zero());
        impulse.fill(T::zero());
        for i in 0..self.tableau.points {
            self.set_point(start, u, i);
            let at = AtTime(self.system, start.t + self.tableau.times[i] * h);
            let memory = &mut *self.memory;
            derivatives::gradient_into(&mut memory.derivatives, &at, &memory.point, &mut memory.gradient)
                .map_err(refused("derivative of the Lagrangian", start.t))?;
            if S::FORCED {
                VectorFunction::call(&at, &memory.point, &mut memory.force);
            }
            // Each coefficient enters as it is stored, in the node and in its equation: products of coefficients would be
            // rounded each in its own way, and momenta of symmetries would drift by it.
            let (weight, duration) = (T::lit(h * self.tableau.weights[i]), T::lit(h));
            for k in 0..n {
                if S::FORCED {
                    memory.gradient[k] += memory.force[k];
                }
                let (force, momentum) = (weight * memory.gradient[k], weight * memory.gradient[n + k] / duration);
                impulse[k] += force;
                for j in 0..self.tableau.degree {
                    out[j * n + k] +=
                        T::lit(self.tableau.slopes[i][j]) * momentum + T::lit(self.tableau.values[i][j]) * force;
                }
            }
        }
        // The momentum at the start is that at the end without the impulse.
        let last = out.len() - n;
        for (out, &impulse) in out[last..].iter_mut().zip(&*impulse) {
            *out -= impulse;
        }
        Ok(())
    }

    fn derivatives(&mut self, start: &Start<'_, T>, u: &[T], out: &mut [T]) -> Result<(), IntegratorsError> {
        let (n, h, s) = (start.q.len(), start.h, self.tableau.degree);
        out.fill(T::zero());
        for i in 0..self.tableau.points {
            self.set_point(start, u, i);
            let at = AtTime(self.system, start.t + self.tableau.times[i] * h);
            let memory = &mut *self.memory;
            let point = &memory.point;
            derivatives::hessian_into(&mut memory.derivatives, &at, point, &mut memory.gradient, &mut memory.hessian)
                .map_err(refused("second derivative of the Lagrangian", start.t))?;
            if S::FORCED {
                let (value, jacobian) = (&mut memory.force, &mut memory.force_jacobian);
                derivatives::jacobian_into(&mut memory.derivatives, &at, point, value, jacobian)
                    .map_err(refused("derivative of the force", start.t))?;
                for column in 0..2 * n {
                    for row in 0..n {
                        memory.hessian[row + column * 2 * n] += memory.force_jacobian[row + column * n];
                    }
                }
            }
            for j in 0..s {
                let (of_force, of_momentum) =
                    (self.weight(i, j, h), T::lit(self.tableau.weights[i] * self.tableau.slopes[i][j]));
                for l in 0..s {
                    let (by_q, by_v) = (T::lit(self.tableau.values[i][l]), T::lit(self.tableau.slopes[i][l] / h));
                    for column in 0..n {
                        for row in 0..n {
                            let entry = |row: usize, column: usize| self.memory.hessian[row + column * 2 * n];
                            let force = entry(row, column) * by_q + entry(row, n + column) * by_v;
                            let momentum = entry(n + row, column) * by_q + entry(n + row, n + column) * by_v;
                            out[j * n + row + (l * n + column) * s * n] += of_force * force + of_momentum * momentum;
                        }
                    }
                }
            }
        }
        Ok(())
    }
}
