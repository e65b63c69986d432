//! Discrete Lagrangians that are given themselves.

use core::ops::ControlFlow;

use piola_integrators::internal::{DIRECTIONS as D, check_run, check_step};
use piola_integrators::{Checkpoint, IntegratorsError, Report, State, Step, resumed_run, unobserved};
use piola_numerics::{Gradient, Real};

use super::step::{DiscreteAction, Start, Stepper};
use crate::fixed_step::take_equal_steps;
use crate::kept::{Kept, checkpoint_of};

/// One step between two positions.
#[derive(Clone, Copy, Debug)]
pub struct Chord<'a, T> {
    /// q₀.
    pub start: &'a [T],
    /// q₁.
    pub end: &'a [T],
    /// q₁ − q₀, more exact than the difference of the two rounded positions. Compute velocities from it.
    pub change: &'a [T],
    /// The time at the start, s.
    pub t: f64,
    /// The step h, s; negative backwards.
    pub step: f64,
}

/// A discrete Lagrangian `L_d(q₀, q₁, t, h)`, an approximation of the action over one step, with discrete forces.
///
/// ```text
/// p₀ = −D₁L_d − F⁻        p₁ = D₂L_d + F⁺
/// ```
///
/// # Example
/// The midpoint rule for an oscillator, `L_d = h (½ (q₁ − q₀)²/h² − ½ (q₀ + q₁)²/4)`.
/// ```
/// use piola_geometric::{Chord, DiscreteEulerLagrange, DiscreteLagrangian};
/// use piola_integrators::State;
/// use piola_numerics::Real;
/// struct Oscillator;
/// impl DiscreteLagrangian for Oscillator {
///     fn freedom(&self) -> usize {
///         1
///     }
///     fn discrete_lagrangian<T: Real>(&self, chord: Chord<'_, T>) -> T {
///         let (half, h) = (T::lit(0.5), T::lit(chord.step));
///         let (middle, v) = (half * (chord.start[0] + chord.end[0]), chord.change[0] / h);
///         h * half * (v * v - middle * middle)
///     }
/// }
/// // One step h = 2 of the midpoint rule turns by 2 atan(h/2) = π/2.
/// let mut state = State::new(0.0, vec![1.0, 0.0])?;
/// DiscreteEulerLagrange::new(2.0)?.integrate_to(&Oscillator, &mut state, 2.0)?;
/// assert!(state.values[0].abs() < 1e-15 && (state.values[1] + 1.0).abs() < 1e-15);
/// # Ok::<(), piola_integrators::IntegratorsError>(())
/// ```
pub trait DiscreteLagrangian {
    /// Whether there are discrete forces.
    const FORCED: bool = false;
    /// The number n of coordinates.
    fn freedom(&self) -> usize;
    /// `L_d(q₀, q₁, t, h)`, J s.
    fn discrete_lagrangian<T: Real>(&self, chord: Chord<'_, T>) -> T;
    /// Writes the impulses F⁻ at q₀ and F⁺ at q₁, J s/\[q\]. It is called only if [`FORCED`](Self::FORCED).
    fn discrete_forces<T: Real>(&self, _chord: Chord<'_, T>, at_start: &mut [T], at_end: &mut [T]) {
        at_start.fill(T::zero());
        at_end.fill(T::zero());
    }
}

/// The discrete Euler–Lagrange equations of a [`DiscreteLagrangian`] in position–momentum form, with a fixed step.
///
/// # Accuracy
/// The order is that to which `L_d` approximates the action. The map (q₀, p₀) → (q₁, p₁) is symplectic without forces, and
/// keeps the momentum p·ξ(q) of every symmetry ξ of `L_d`, both to rounding.
///
/// # Example
/// See [`DiscreteLagrangian`].
#[doc(alias("variational integrator", "discrete mechanics", "DEL"))]
#[derive(Clone, Debug)]
pub struct DiscreteEulerLagrange<T = f64> {
    step: f64,
    stepper: Stepper<T>,
    memory: Memory<T>,
}

/// q₀, q₁ and q₁ − q₀ over numbers with derivatives.
#[derive(Clone, Debug)]
struct Memory<T> {
    seeds: [Vec<Gradient<T, D>>; 3],
    nested: [Vec<Gradient<Gradient<T, D>, D>>; 3],
    forces: [Vec<T>; 2],
    forces_of_seeds: [Vec<Gradient<T, D>>; 2],
    values: [Vec<T>; 3],
    gradient: Vec<T>,
}

impl<T: Real> DiscreteEulerLagrange<T> {
    /// The method with steps no longer than `step` (s).
    ///
    /// # Errors
    /// [`IntegratorsError::InvalidStep`] unless 0 < step < ∞.
    pub fn new(step: f64) -> Result<Self, IntegratorsError> {
        check_step(step)?;
        let memory = Memory {
            seeds: [Vec::new(), Vec::new(), Vec::new()],
            nested: [Vec::new(), Vec::new(), Vec::new()],
            forces: [Vec::new(), Vec::new()],
            forces_of_seeds: [Vec::new(), Vec::new()],
            values: [Vec::new(), Vec::new(), Vec::new()],
            gradient: Vec::new(),
        };
        Ok(Self { step, stepper: Stepper::new(), memory })
    }

    /// The longest step, s.
    #[must_use]
    pub const fn step(&self) -> f64 {
        self.step
    }

    /// Integrates to `end` in equal steps no longer than [`step`](Self::step), unobserved.
    ///
    /// # Errors
    /// As [`integrate`](Self::integrate).
    pub fn integrate_to<L: DiscreteLagrangian>(
        &mut self,
        lagrangian: &L,
        state: &mut State<T>,
        end: f64,
    ) -> Result<Report, IntegratorsError> {
        self.integrate(lagrangian, state, end, unobserved)
    }

    /// Integrates (q, p) to `end` in equal steps no longer than [`step`](Self::step); backwards if `end` is earlier than
    /// the state's time. The observer sees every step and may stop the run.
    ///
    /// # Errors
    /// The state does not fit or is not finite, a derivative of `L_d` is not finite, or the equations do not converge or have
    /// a singular matrix D₁D₂`L_d`: take a smaller step. The state then stands at the last complete step.
    pub fn integrate<L: DiscreteLagrangian>(
        &mut self,
        lagrangian: &L,
        state: &mut State<T>,
        end: f64,
        observer: impl FnMut(Step<'_, T>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError> {
        self.run(lagrangian, None, state, end, observer)
    }

    checkpoint_of!(stepper, "DiscreteEulerLagrange");

    resumed_run!(<L> [L: DiscreteLagrangian] lagrangian: &L, IntegratorsError);

    fn run<L: DiscreteLagrangian>(
        &mut self,
        lagrangian: &L,
        resumed: Option<&Checkpoint<T>>,
        state: &mut State<T>,
        end: f64,
        observer: impl FnMut(Step<'_, T>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError> {
        let n = lagrangian.freedom();
        self.memory.resize(n);
        let (stepper, memory) = (&mut self.stepper, &mut self.memory);
        stepper.begin(n, 1);
        let before = stepper.start(Self::NAME, resumed, state, |state| check_run(2 * n, state, end))?;
        take_equal_steps((before, self.step), state, end, observer, |state, h| {
            stepper.advance(&mut GivenAction { lagrangian, memory }, state, h)
        })
    }
}

impl<T: Real> Memory<T> {
    fn resize(&mut self, n: usize) {
        let zero = Gradient::constant(T::zero());
        for vector in &mut self.seeds {
            vector.resize(n, zero);
        }
        for vector in &mut self.nested {
            vector.resize(n, Gradient::constant(zero));
        }
        for vector in self.forces.iter_mut().chain(&mut self.values) {
            vector.resize(n, T::zero());
        }
        for vector in &mut self.forces_of_seeds {
            vector.resize(n, zero);
        }
        self.gradient.resize(2 * n, T::zero());
    }
}

/// Writes q₀, q₁ and q₁ − q₀ of which the variables q₀, then U, from `first` on are differentiated.
fn seed<U: Real>(
    chord: &mut [Vec<Gradient<U, D>>; 3],
    n: usize,
    first: usize,
    value: impl Fn(usize) -> [U; 3],
    variable_of_start: bool,
) {
    let [starts, ends, changes] = chord;
    for (i, ((at_start, at_end), moving)) in starts.iter_mut().zip(ends).zip(changes).enumerate() {
        let [start, end, change] = value(i);
        *at_start = Gradient::variable(start, if variable_of_start { i.wrapping_sub(first) } else { usize::MAX });
        let offset = if variable_of_start { n } else { 0 };
        *moving = Gradient::variable(change, (i + offset).wrapping_sub(first));
        // q₁ moves with both.
        *at_end = Gradient::constant(end);
        for (k, partial) in at_end.partials.iter_mut().enumerate() {
            *partial = at_start.partials[k] + moving.partials[k];
        }
    }
}

fn chord_of<U>(vectors: &[Vec<U>; 3], t: f64, step: f64) -> Chord<'_, U> {
    Chord { start: &vectors[0], end: &vectors[1], change: &vectors[2], t, step }
}

struct GivenAction<'a, L, T> {
    lagrangian: &'a L,
    memory: &'a mut Memory<T>,
}

impl<L: DiscreteLagrangian, T: Real> GivenAction<'_, L, T> {
    fn set_values(&mut self, start: &Start<'_, T>, u: &[T]) {
        for (i, &u) in u.iter().enumerate() {
            self.memory.values[0][i] = start.q[i];
            self.memory.values[1][i] = start.q[i] + (start.q_carry[i] + u);
            self.memory.values[2][i] = u;
        }
    }
}

impl<L: DiscreteLagrangian, T: Real> DiscreteAction<T> for GivenAction<'_, L, T> {
    fn freedom(&self) -> usize {
        self.lagrangian.freedom()
    }

    fn equations(
        &mut self,
        start: &Start<'_, T>,
        u: &[T],
        out: &mut [T],
        impulse: &mut [T],
    ) -> Result<(), IntegratorsError> {
        let n = u.len();
        self.set_values(start, u);
        let Memory { seeds, values, gradient, forces, .. } = &mut *self.memory;
        for first in (0..2 * n).step_by(D) {
            seed(seeds, n, first, |i| [values[0][i], values[1][i], values[2][i]], true);
            let action = self.lagrangian.discrete_lagrangian(chord_of(seeds, start.t, start.h));
            for (out, &partial) in gradient[first..].iter_mut().zip(&action.partials) {
                *out = partial;
            }
        }
        if L::FORCED {
            let [at_start, at_end] = forces;
            self.lagrangian.discrete_forces(chord_of(values, start.t, start.h), at_start, at_end);
        }
        for k in 0..n {
            impulse[k] = gradient[k];
            out[k] = gradient[n + k] - gradient[k];
            if L::FORCED {
                impulse[k] += forces[0][k] + forces[1][k];
                out[k] -= forces[0][k];
            }
        }
        Ok(())
    }

    fn derivatives(&mut self, start: &Start<'_, T>, u: &[T], out: &mut [T]) -> Result<(), IntegratorsError> {
        let n = u.len();
        self.set_values(start, u);
        let Memory { seeds, nested, values, forces_of_seeds, .. } = &mut *self.memory;
        out.fill(T::zero());
        for first in (0..n).step_by(D) {
            seed(seeds, n, first, |i| [values[0][i], values[1][i], values[2][i]], false);
            for row in (0..2 * n).step_by(D) {
                seed(nested, n, row, |i| [seeds[0][i], seeds[1][i], seeds[2][i]], true);
                let action = self.lagrangian.discrete_lagrangian(chord_of(nested, start.t, start.h));
                for (variable, partial) in (row..2 * n).zip(&action.partials) {
                    for (column, &second) in (first..n).zip(&partial.partials) {
                        let (row, sign) = if variable < n { (variable, -T::one()) } else { (variable - n, T::one()) };
                        out[row + column * n] += sign * second;
                    }
                }
            }
            if L::FORCED {
                let [at_start, at_end] = forces_of_seeds;
                self.lagrangian.discrete_forces(chord_of(seeds, start.t, start.h), at_start, at_end);
                for (row, force) in at_start.iter().enumerate() {
                    for (column, &partial) in (first..n).zip(&force.partials) {
                        out[row + column * n] -= partial;
                    }
                }
            }
        }
        Ok(())
    }
}
