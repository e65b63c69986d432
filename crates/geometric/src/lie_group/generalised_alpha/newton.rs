//! One step of the generalised-α method: Newton's iteration for the acceleration at its end.

use piola_integrators::internal::{DIRECTIONS, check_finite, compensated_add, largest_lane};
use piola_integrators::{IntegratorsError, State};
use piola_numerics::linear::lu;
use piola_numerics::sums::unit_in_last_place;
use piola_numerics::{Gradient, NumericsError, Real};

use super::super::LieGroup;
use super::super::run::Trial;
use super::{GroupMotion, Parameters};
use crate::kept::{Kept, Visitor};

/// Iterations after which a step is given up.
const MOST_ITERATIONS: usize = 30;
/// The part of the rounding error of an acceleration that may be left out of it.
const UNROUNDED: f64 = 1e-4;
/// Changes that no longer fall are rounding where they are below this part of the acceleration.
const STALLED: f64 = 1e-6;
/// Changes that no longer fall are rounding, too, where they move the element by no more than so many units in the last place.
const STALLED_ULPS: f64 = 16.0;

/// Numbers with derivatives with respect to four of the accelerations.
type Lifted<T> = Gradient<T, DIRECTIONS>;

#[derive(Clone, Debug)]
pub(super) struct Workspace<T> {
    /// v̇ at the start of the step.
    acceleration: Vec<T>,
    /// a at the start of the step.
    algorithmic: Vec<T>,
    /// v̇ at the end of the step, which is solved for.
    unknown: Vec<T>,
    /// The residual, then what is subtracted from the unknown.
    correction: Vec<T>,
    /// ∂(residual)/∂(unknown) down its columns, then its factors.
    jacobian: Vec<T>,
    exchanges: Vec<usize>,
    displacement: Vec<T>,
    trial: Trial<T>,
    lifted: Point<Lifted<T>>,
}

/// Where the residual is evaluated.
#[derive(Clone, Debug)]
struct Point<S> {
    element: Vec<S>,
    carry: Vec<S>,
    displacement: Vec<S>,
    velocity: Vec<S>,
    acceleration: Vec<S>,
    residual: Vec<S>,
}

/// The length of an element and the dimension of a group that is one over two scalars.
pub(super) fn lengths<T: Real, G: LieGroup<T>>(group: &G) -> (usize, usize) {
    (group.element_length(), group.dimension())
}

impl<T: Real> Kept<T> for Workspace<T> {
    fn visit<V: Visitor<T>>(&mut self, visitor: &mut V) {
        visitor.values(&mut self.acceleration);
        visitor.values(&mut self.algorithmic);
    }
}

impl<T: Real> Workspace<T> {
    pub(super) const fn new() -> Self {
        Self {
            acceleration: Vec::new(),
            algorithmic: Vec::new(),
            unknown: Vec::new(),
            correction: Vec::new(),
            jacobian: Vec::new(),
            exchanges: Vec::new(),
            displacement: Vec::new(),
            trial: Trial::new(),
            lifted: Point {
                element: Vec::new(),
                carry: Vec::new(),
                displacement: Vec::new(),
                velocity: Vec::new(),
                acceleration: Vec::new(),
                residual: Vec::new(),
            },
        }
    }

    pub(super) fn resize(&mut self, length: usize, n: usize) {
        for vector in [
            &mut self.acceleration,
            &mut self.algorithmic,
            &mut self.unknown,
            &mut self.correction,
            &mut self.displacement,
        ] {
            vector.resize(n, T::zero());
        }
        self.jacobian.resize(n * n, T::zero());
        self.exchanges.resize(n, 0);
        self.trial.resize(length + n);
        let Point { element, carry, displacement, velocity, acceleration, residual } = &mut self.lifted;
        let zero = Lifted::constant(T::zero());
        for vector in [element, carry] {
            vector.resize(length, zero);
        }
        for vector in [displacement, velocity, acceleration, residual] {
            vector.resize(n, zero);
        }
    }

    /// Begins a run: solves for v̇ at the state, and lets a be the same. Returns the evaluations.
    pub(super) fn begin<F>(
        &mut self,
        parameters: Parameters,
        system: &mut F,
        state: &State<T>,
    ) -> Result<u64, IntegratorsError<F::Error>>
    where
        F: GroupMotion<Lifted<T>, Group: LieGroup<T>>,
    {
        for vector in [&mut self.acceleration, &mut self.algorithmic, &mut self.unknown] {
            vector.fill(T::zero());
        }
        // A step of length zero moves nothing.
        let evaluations = self.solve(parameters, system, state, 0.0)?;
        self.acceleration.copy_from_slice(&self.unknown);
        self.algorithmic.copy_from_slice(&self.unknown);
        Ok(evaluations)
    }

    /// Makes one step; the state changes only when it is complete. Returns the evaluations.
    pub(super) fn advance<F>(
        &mut self,
        parameters: Parameters,
        system: &mut F,
        state: &mut State<T>,
        h: f64,
    ) -> Result<u64, IntegratorsError<F::Error>>
    where
        F: GroupMotion<Lifted<T>, Group: LieGroup<T>>,
    {
        self.unknown.copy_from_slice(&self.acceleration);
        let evaluations = self.solve(parameters, system, state, h)?;
        let length = self.lifted.element.len();
        self.trial.begin(state);
        let (element, velocity) = self.trial.element.split_at_mut(length);
        let (carry, velocity_carry) = self.trial.carry.split_at_mut(length);
        // From here on the step cannot fail but by a state that is not finite, with which the run ends.
        for (i, (v, carry)) in velocity.iter_mut().zip(velocity_carry).enumerate() {
            let (displacement, increment, next) =
                parameters.increments(h, *v, self.algorithmic[i], self.acceleration[i], self.unknown[i]);
            self.displacement[i] = displacement;
            self.algorithmic[i] = next;
            compensated_add(v, carry, increment);
        }
        LieGroup::<T>::advance(system.group(), element, carry, &self.displacement);
        LieGroup::<T>::renormalise(system.group(), element, carry);
        core::mem::swap(&mut self.acceleration, &mut self.unknown);
        self.trial.replace(state)?;
        Ok(evaluations)
    }

    /// Solves for the acceleration at the end of a step of length h from the guess in `unknown`.
    fn solve<F>(
        &mut self,
        parameters: Parameters,
        system: &mut F,
        state: &State<T>,
        h: f64,
    ) -> Result<u64, IntegratorsError<F::Error>>
    where
        F: GroupMotion<Lifted<T>, Group: LieGroup<T>>,
    {
        let (length, t) = (self.lifted.element.len(), state.time);
        let ulp = unit_in_last_place::<T>();
        let (element, velocity) = state.values.split_at(length);
        let speed = if h.abs() <= 0.0 { 0.0 } else { largest(velocity) / h.abs() };
        // What has decayed so far that numbers of its size have lost digits is rounding, too.
        let smallest = if ulp < 1e-10 { f64::MIN_POSITIVE } else { f64::from(f32::MIN_POSITIVE) };
        let noise = STALLED_ULPS * (ulp * largest(element)).max(smallest);
        let displacing = parameters.beta * h * h;
        let (mut evaluations, mut previous) = (0, f64::INFINITY);
        // Once the values have converged each iteration brings in one more order of derivatives.
        let mut derivatives = T::ORDER;
        let mut iteration = 0;
        loop {
            iteration += 1;
            evaluations += self.evaluate(parameters, system, state, h)?;
            check_finite("residual", Some(t), &self.correction)?;
            lu::factor_in_place(&mut self.jacobian, &mut self.exchanges)
                .and_then(|()| lu::solve_in_place(&self.jacobian, &self.exchanges, &mut self.correction))
                .map_err(|error| IntegratorsError::SingularMatrix { t, step: h, pivot: pivot_of(&error) })?;
            for (unknown, &correction) in self.unknown.iter_mut().zip(&self.correction) {
                *unknown -= correction;
            }
            let (change, size) = (largest(&self.correction), largest(&self.unknown) + speed);
            // The iteration converges quadratically: the next change is this one times the square of their ratio.
            let ratio = if previous.is_finite() { (change / previous).min(1.0) } else { 1.0 };
            let predicted = if change <= 0.0 { 0.0 } else { change * ratio * ratio };
            let stalled = previous <= 2.0 * change
                && (change <= STALLED * size || change <= smallest || 0.0 < displacing && displacing * change <= noise);
            if predicted <= UNROUNDED * ulp * size || stalled {
                if derivatives == 0 {
                    return Ok(evaluations);
                }
                derivatives -= 1;
            }
            if iteration == MOST_ITERATIONS {
                let change = change / size;
                return Err(IntegratorsError::StagesDiverged { t, step: h, iterations: iteration, change });
            }
            previous = change;
        }
    }

    /// Writes the residual to `correction` and its Jacobian to `jacobian`; returns the number of evaluations.
    fn evaluate<F>(
        &mut self,
        parameters: Parameters,
        system: &mut F,
        state: &State<T>,
        h: f64,
    ) -> Result<u64, IntegratorsError<F::Error>>
    where
        F: GroupMotion<Lifted<T>, Group: LieGroup<T>>,
    {
        let (length, n, t) = (self.lifted.element.len(), self.unknown.len(), state.time + h);
        let Point { element, carry, displacement, velocity, acceleration, residual } = &mut self.lifted;
        let mut evaluations = 0;
        for first in (0..n).step_by(DIRECTIONS) {
            for i in 0..n {
                // Before `first` the difference wraps to a number that is no direction.
                acceleration[i] = Lifted::variable(self.unknown[i], i.wrapping_sub(first));
                let [v, low, a, start] =
                    [state.values[length + i], state.carry[length + i], self.algorithmic[i], self.acceleration[i]]
                        .map(Lifted::constant);
                let (moved, increment, _) = parameters.increments(h, v, a, start, acceleration[i]);
                displacement[i] = moved;
                velocity[i] = v + (low + increment);
            }
            for i in 0..length {
                [element[i], carry[i]] = [state.values[i], state.carry[i]].map(Lifted::constant);
            }
            LieGroup::<Lifted<T>>::advance(system.group(), element, carry, displacement);
            system
                .residual(t, element, velocity, acceleration, residual)
                .map_err(|source| IntegratorsError::Field { t, source })?;
            evaluations += 1;
            for (i, residual) in residual.iter().enumerate() {
                self.correction[i] = residual.value;
                for (column, &partial) in (first..n).zip(&residual.partials) {
                    self.jacobian[i + column * n] = partial;
                }
            }
        }
        Ok(evaluations)
    }
}

/// The largest modulus in any lane; NaN when there is one.
#[cfg_attr(not(debug_assertions), inline(always))]
fn largest<T: Real>(values: &[T]) -> f64 {
    values
        .iter()
        .map(|&x| largest_lane(x))
        .fold(0.0, |largest: f64, x| if x <= largest || largest.is_nan() { largest } else { x })
}

/// The pivot at which a decomposition ended.
fn pivot_of(error: &NumericsError) -> usize {
    if let NumericsError::Singular { pivot, .. } = error { *pivot } else { 0 }
}
