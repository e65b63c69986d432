//! RATTLE: a symplectic method for constrained motion.
//!
//! ```text
//! p½ = p₀ + h/2 (F(q₀, p½) − G₀ᵀ λ)                  v = ∂H/∂p,   F = −∂H/∂q
//! q₁ = q₀ + h/2 (v(q₀, p½) + v(q₁, p½))              with φ(q₁, t₁) = 0
//! p₁ = p½ + h/2 (F(q₁, p½) − G₁ᵀ μ)                  with G₁ v(q₁, p₁) + ∂φ/∂t = 0
//! ```
//!
//! For any inertia metric that depends on q (L. O. Jay, *Symplectic partitioned Runge–Kutta methods for constrained
//! Hamiltonian systems*, SIAM J. Numer. Anal. 33 (1996)); of order two, symmetric and symplectic on the phase
//! space of the constraints. Five steps of suitable lengths compose order four (M. Suzuki, 1990).

use core::ops::ControlFlow;

use piola_integrators::{Ending, Field, IntegratorsError, Report, State, Step};
use piola_kinematics::Holonomic;
use piola_numerics::internal::{dot, zeros};

use super::workspace::Workspace;
use super::{Constrained, Constraints};
use crate::LagrangianError;
use crate::{CanonicalMotion, Forces, Potential};

/// RATTLE with steps of one length, in positions and momenta y = (q, p).
///
/// # Example
/// A bead on a circle of 5 m at 10 m/s turns at 2 rad/s; RATTLE keeps it on the circle, and its energy.
/// ```
/// use nalgebra::Vector3;
/// use piola_lagrangian::constraints::{Constraints, Rattle};
/// use piola_lagrangian::{Holonomic, Lagrangian, Placement};
/// use piola_numerics::Real;
/// struct Bead;
/// impl Holonomic for Bead {
///     fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
///         bodies.particle(2.0, Vector3::new(q[0], q[1], T::zero()));
///     }
/// }
/// struct Circle;
/// impl Constraints for Circle {
///     fn count(&self) -> usize {
///         1
///     }
///     fn residuals<T: Real>(&self, q: &[T], _t: T, out: &mut [T]) {
///         out[0] = q[0] * q[0] + q[1] * q[1] - T::lit(25.0);
///     }
/// }
/// let bead = Lagrangian::of(Bead).with_constraints(Circle);
/// let mut state = bead.canonical_state(&[5.0, 0.0], &[0.0, 10.0], 0.0)?;
/// assert_eq!(state.values, [5.0, 0.0, 0.0, 20.0]);
/// let report = Rattle::new(0.001)?.integrate_to(&bead, &mut state, 1.0)?;
/// assert_eq!(report.steps, 1000);
/// assert!((state.values[0] - 5.0 * 2.0_f64.cos()).abs() < 1e-5);
/// assert!((state.values[2].hypot(state.values[3]) - 20.0).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Rattle {
    step: f64,
    /// The lengths of the steps composed, in units of the whole one.
    parts: &'static [f64],
    work: Workspace,
    lagrangian: crate::Workspace,
    /// (q₀, p½) and (q₁, p½), and the rates there.
    start: Vec<f64>,
    end: Vec<f64>,
    rate: Vec<f64>,
    velocity: Vec<f64>,
    /// −h/2 G₀ᵀλ.
    impulse: Vec<f64>,
    residuals: Vec<f64>,
    /// A correction of positions or velocities, and the momentum of it.
    change: Vec<f64>,
    push: Vec<f64>,
    saved: Vec<f64>,
}

/// 1/(4 − ∛4).
const SUZUKI: f64 = 0.414_490_771_794_375_74;
const MOST_SWEEPS: usize = 100;

impl Rattle {
    /// RATTLE whose steps are no longer than `step` (s): of order two.
    ///
    /// # Errors
    /// [`IntegratorsError::InvalidStep`] unless 0 < step < ∞.
    pub fn new(step: f64) -> Result<Self, IntegratorsError> {
        if !(0.0 < step && step < f64::INFINITY) {
            return Err(IntegratorsError::InvalidStep { step });
        }
        let buffer = Vec::new;
        Ok(Self {
            step,
            parts: &[1.0],
            work: Workspace::default(),
            lagrangian: crate::Workspace::default(),
            start: buffer(),
            end: buffer(),
            rate: buffer(),
            velocity: buffer(),
            impulse: buffer(),
            residuals: buffer(),
            change: buffer(),
            push: buffer(),
            saved: buffer(),
        })
    }

    /// Composes five steps of RATTLE to one of order four.
    #[must_use]
    pub fn of_order_four(mut self) -> Self {
        self.parts = &[SUZUKI, SUZUKI, 1.0 - 4.0 * SUZUKI, SUZUKI, SUZUKI];
        self
    }

    /// The longest step, s.
    #[must_use]
    pub const fn step(&self) -> f64 {
        self.step
    }

    /// Integrates to `end` in equal steps, unobserved.
    ///
    /// # Errors
    /// As [`integrate`](Self::integrate).
    pub fn integrate_to<S: Holonomic, P: Potential, F: Forces, C: Constraints>(
        &mut self,
        system: &Constrained<S, P, F, C>,
        state: &mut State,
        end: f64,
    ) -> Result<Report, LagrangianError> {
        self.integrate(system, state, end, |_| ControlFlow::Continue(()))
    }

    /// Integrates to `end` in equal steps no longer than [`step`](Self::step); backwards if `end` is earlier than
    /// the state's time. The observer sees every step and may stop the run.
    ///
    /// The state is y = (q, p): begin with [`Constrained::canonical_state`]. Nothing is allocated in a step.
    ///
    /// # Errors
    /// [`LagrangianError::Run`], when the state does not fit, the equations cannot be evaluated or the equations of
    /// a step do not converge: take a smaller step. The state then stands at the last complete step.
    pub fn integrate<S: Holonomic, P: Potential, F: Forces, C: Constraints>(
        &mut self,
        system: &Constrained<S, P, F, C>,
        state: &mut State,
        end: f64,
        mut observer: impl FnMut(Step<'_>) -> ControlFlow<()>,
    ) -> Result<Report, LagrangianError> {
        let n = state.values.len() / 2;
        let mut report = Report::begin();
        let failed = |time: f64, error: IntegratorsError<LagrangianError>| LagrangianError::Run {
            time,
            source: Box::new(error),
        };
        let start = state.time;
        if state.values.len() != 2 * n {
            let found = state.values.len();
            return Err(failed(start, IntegratorsError::WrongLength { quantity: "state", expected: 2 * n, found }));
        }
        if !(end - start).is_finite() {
            return Err(failed(start, IntegratorsError::NotFinite { quantity: "time", index: 0, value: end, t: None }));
        }
        if (end - start).abs() <= 0.0 {
            return Ok(report);
        }
        let count = ((end - start).abs() / self.step * (1.0 - 4.0 * f64::EPSILON)).ceil().max(1.0);
        let h = (end - start) / count;
        if h.abs() < f64::EPSILON * start.abs().max(end.abs()) {
            return Err(failed(start, IntegratorsError::StepTooSmall { t: start, step: h }));
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count of steps")]
        let steps = count as u64;

        self.prepare(2 * n);
        let mut field = system.lagrangian.canonical_motion(n);
        hold(system, &mut self.work, &state.values[..n], &mut self.velocity, start)
            .map_err(|source| failed(start, IntegratorsError::Field { t: start, source }))?;
        for number in 1..=steps {
            let time = state.time;
            let next = if number == steps { end } else { start + h * number as f64 };
            self.saved.clone_from(&state.values);
            let mut from = time;
            for (k, &part) in self.parts.iter().enumerate() {
                let to = if k + 1 == self.parts.len() { next } else { from + part * (next - time) };
                let step = if self.parts.len() == 1 { h } else { part * h };
                if let Err(error) = self.advance(system, &mut field, &mut state.values, (from, to), step, &mut report) {
                    state.values.clone_from(&self.saved);
                    return Err(failed(time, error));
                }
                from = to;
            }
            state.time = next;
            report.steps = number;
            if observer(Step { number, time: next, values: &state.values }).is_break() {
                report.ending = Ending::Stopped;
                break;
            }
        }
        Ok(report)
    }

    fn prepare(&mut self, length: usize) {
        for buffer in [&mut self.start, &mut self.end, &mut self.rate] {
            zeros(buffer, length);
        }
        for buffer in [&mut self.velocity, &mut self.impulse, &mut self.change, &mut self.push] {
            zeros(buffer, length / 2);
        }
    }

    /// One step. `work` holds the metric and the gradients at its start, and afterwards those at its end.
    fn advance<S: Holonomic, P: Potential, F: Forces, C: Constraints>(
        &mut self,
        system: &Constrained<S, P, F, C>,
        field: &mut CanonicalMotion<'_, S, P, F>,
        y: &mut [f64],
        (from, to): (f64, f64),
        h: f64,
        report: &mut Report,
    ) -> Result<(), IntegratorsError<LagrangianError>> {
        let n = y.len() / 2;
        let at = |t: f64| move |source: LagrangianError| IntegratorsError::Field { t, source };
        let count = system.constraints.count();
        let half = 0.5 * h;
        // The impulse of the last step, along the gradients of this one, is the first guess.
        self.change.copy_from_slice(&self.impulse);
        self.work.independence.solve_metric(&mut self.change).map_err(|error| at(from)(error.into()))?;
        self.residuals.clear();
        let rows = self.work.gradients.rows.chunks_exact(n.max(1));
        self.residuals.extend(rows.map(|row| -dot(row, &self.change)));
        self.work.independence.correct(&self.residuals, &mut self.change);
        momentum_of(&self.work.mass_matrix, &self.change, &mut self.impulse);
        self.start.copy_from_slice(y);
        self.end.copy_from_slice(y);
        for (p, impulse) in self.start[n..].iter_mut().zip(&self.impulse) {
            *p += impulse;
        }
        let mut previous = f64::INFINITY;
        for sweep in 1.. {
            field.rate(from, &self.start, &mut self.rate).map_err(at(from))?;
            self.end[n..].copy_from_slice(&self.start[n..]);
            let (position, momentum) = self.end.split_at(n);
            system
                .lagrangian
                .velocities_into(&mut self.lagrangian, position, momentum, to, &mut self.velocity)
                .map_err(at(to))?;
            report.evaluations += 2;
            let mut change = 0.0_f64;
            let scale_q = largest(&self.end[..n]).max(half.abs() * largest(&self.velocity));
            for i in 0..n {
                let new = y[i] + half * (self.rate[i] + self.velocity[i]);
                change = change.max(relative(new - self.end[i], scale_q));
                self.end[i] = new;
            }
            let scale_p = largest(&self.start[n..]).max(largest(&y[n..]));
            for i in 0..n {
                let new = y[n + i] + (half * self.rate[n + i] + self.impulse[i]);
                change = change.max(relative(new - self.start[n + i], scale_p));
                self.start[n + i] = new;
            }
            // What is left of the constraints, brought to zero by impulses along G₀. Rounding of φ is a rounding of
            // the impulse times q/(h v); it is judged by what it does to q, and ends with the step.
            self.residuals.resize(count, 0.0);
            system.constraints.residuals(&self.end[..n], to, &mut self.residuals);
            self.work.independence.correct(&self.residuals, &mut self.change);
            momentum_of(&self.work.mass_matrix, &self.change, &mut self.push);
            for i in 0..n {
                self.end[i] += self.change[i];
                self.impulse[i] += self.push[i] / h;
                self.start[n + i] += self.push[i] / h;
            }
            change = change.max(relative(largest(&self.change), scale_q));
            if !change.is_finite() || sweep == MOST_SWEEPS {
                return Err(IntegratorsError::StagesDiverged { t: from, step: h, iterations: sweep, change });
            }
            // Converged when the next change would be below rounding, or when rounding has stopped the fall.
            let predicted = if previous.is_finite() { change * (change / previous).min(1.0) } else { change };
            let stalled = previous <= change && change < 64.0 * f64::EPSILON;
            if predicted <= 0.01 * f64::EPSILON || stalled {
                break;
            }
            previous = change.min(1.0);
        }
        self.end[n..].copy_from_slice(&self.start[n..]);
        field.rate(to, &self.end, &mut self.rate).map_err(at(to))?;
        report.evaluations += 1;
        for i in 0..n {
            self.end[n + i] += half * self.rate[n + i];
        }
        let (position, momentum) = self.end.split_at_mut(n);
        hold(system, &mut self.work, position, &mut self.velocity, to).map_err(at(to))?;
        // Linear in the multipliers; once more for rounding.
        for _ in 0..2 {
            system
                .lagrangian
                .velocities_into(&mut self.lagrangian, position, momentum, to, &mut self.velocity)
                .map_err(at(to))?;
            system.differentiate(&mut self.work, position, &self.velocity, to);
            self.work.independence.correct(&self.work.gradients.rates, &mut self.change);
            momentum_of(&self.work.mass_matrix, &self.change, &mut self.push);
            for (p, push) in momentum.iter_mut().zip(&self.push) {
                *p += push;
            }
        }
        if let Some(index) = self.end.iter().position(|x| !x.is_finite()) {
            return Err(IntegratorsError::NotFinite { quantity: "rate", index, value: self.end[index], t: Some(from) });
        }
        y.copy_from_slice(&self.end);
        Ok(())
    }
}

/// The metric and the gradients at a position; `velocity` is scratch.
fn hold<S: Holonomic, P: Potential, F: Forces, C: Constraints>(
    system: &Constrained<S, P, F, C>,
    work: &mut Workspace,
    q: &[f64],
    velocity: &mut [f64],
    t: f64,
) -> Result<(), LagrangianError> {
    velocity.fill(0.0);
    system.form(work, q, velocity, t)?;
    system.factor(work, false)?;
    work.independence.choose(system.least_share);
    system.refuse_redundancy(work)
}

/// M v, for n² entries of M.
fn momentum_of(mass_matrix: &[f64], v: &[f64], out: &mut [f64]) {
    for (row, out) in mass_matrix.chunks_exact(v.len().max(1)).zip(out) {
        *out = dot(row, v);
    }
}

/// The largest |x|.
fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |m, x| m.max(x.abs()))
}

/// A change relative to a scale; none is none whatever the scale.
fn relative(change: f64, scale: f64) -> f64 {
    if change.abs() <= 0.0 { 0.0 } else { change.abs() / scale }
}

impl<S: Holonomic, P: Potential, F: Forces, C: Constraints> Constrained<S, P, F, C> {
    /// The state y = (q, p) that [`Rattle`] starts from: the consistent state nearest to (q, q̇), with its momenta.
    ///
    /// [`Lagrangian::velocities_into`](crate::Lagrangian::velocities_into) leads back to velocities.
    ///
    /// # Errors
    /// As [`assemble`](Self::assemble).
    pub fn canonical_state(&self, q: &[f64], v: &[f64], t: f64) -> Result<State, LagrangianError> {
        let assembly = self.assemble(q, v, t)?;
        let momenta = self.lagrangian.momenta(&assembly.coordinates, &assembly.velocities, t)?;
        let mut values = assembly.coordinates;
        values.extend_from_slice(momenta.as_slice());
        State::new(t, values)
            .map_err(|error| LagrangianError::Run { time: t, source: Box::new(error.with_field_error()) })
    }
}
