//! A trajectory from integrals alone: its path is where they keep their values, its time follows by one equation.
//!
//! ```text
//! K_A(q, p) = const, A = 1…2n−1        dσ/dt = τ·h(z(σ))                                W(9.23–9.24)
//! ```
//!
//! σ counts along the tangent τ of the path at some of its points; z(σ) is found from the integrals by Newton's
//! iteration, so that no point leaves the path by more than rounding.

use core::cell::Cell;
use core::ops::ControlFlow;

use piola_integrators::{DormandPrince853, Field, State, Tolerance};
use piola_numerics::linear::lu;

use super::PhaseFunction;
use super::differential::{check_result, differentiate_at};
use super::integrals::{PhaseFunctions, PhasePoint, differentials_into, rates_and_magnitudes};
use crate::HamiltonianError;
use crate::check::{check_finite, check_length};

/// How far a rate may be from zero for a function to pass as an integral, relative to its terms.
const INTEGRAL: f64 = 1e-8;
/// The cosine of the angle between path and chart below which another chart is made.
const TURNED: f64 = 0.8;
/// The same below which a point is not taken for one of this chart.
const LOST: f64 = 0.3;
/// What is sought.
const CONDITION: &str = "the integrals that make a path";
/// Steps of Newton's iteration for a point of the path.
const ITERATIONS: usize = 20;
/// How often the way to a point is halved, or gone on from where it led.
const WAYS: usize = 200;
/// The longest way at once, in units of the distance of the point from the origin: other branches that are farther
/// from the path than about half its square are not mistaken for it.
const REACH: f64 = 0.05;
/// The ratio of one correction to the one before that is allowed.
const CONTRACTION: f64 = 0.1;

/// The path near one of its points, by the distance along its tangent there.
struct Chart<'a, K, H> {
    integrals: &'a K,
    hamiltonian: &'a H,
    constants: &'a [f64],
    time: f64,
    origin: Vec<f64>,
    tangent: Vec<f64>,
    /// The point sought.
    point: Vec<f64>,
    /// The point found last, and its σ.
    found: (Vec<f64>, f64),
    /// The one before.
    before: (Vec<f64>, f64),
    /// h there.
    velocity: Vec<f64>,
    values: Vec<f64>,
    slopes: Vec<f64>,
    jacobian: Vec<f64>,
    exchanges: Vec<usize>,
    step: Vec<f64>,
    /// Whether the path has turned away from the tangent.
    turned: &'a Cell<bool>,
}

impl<K: PhaseFunctions, H: PhaseFunction> Chart<'_, K, H> {
    /// h at the point found last.
    fn find_velocity(&mut self) -> Result<(), HamiltonianError> {
        let n = self.point.len() / 2;
        let (q, p) = self.found.0.split_at(n);
        differentiate_at(self.hamiltonian, (q, p, self.time), &mut self.velocity);
        check_result((q, p, self.time), "dH", &self.velocity)?;
        for i in 0..n {
            (self.velocity[i], self.velocity[n + i]) = (self.velocity[n + i], -self.velocity[i]);
        }
        Ok(())
    }

    /// Makes the point found last the origin.
    fn restart(&mut self) -> Result<(), HamiltonianError> {
        self.find_velocity()?;
        let speed = length(&self.velocity);
        self.origin.copy_from_slice(&self.found.0);
        self.found.1 = 0.0;
        for (tangent, velocity) in self.tangent.iter_mut().zip(&self.velocity) {
            *tangent = if speed <= 0.0 { 0.0 } else { velocity / speed };
        }
        Ok(())
    }

    /// Finds z(σ), by as many smaller ways as Newton's iteration needs to contract at once.
    fn find(&mut self, sigma: f64) -> Result<(), HamiltonianError> {
        let longest = REACH * length(&self.origin);
        let towards =
            |from: f64| if (sigma - from).abs() <= longest { sigma } else { from + longest.copysign(sigma - from) };
        let mut target = towards(self.found.1);
        for _ in 0..WAYS {
            match self.reach(target) {
                Ok(()) if target.to_bits() == sigma.to_bits() => return Ok(()),
                Ok(()) => {
                    self.find_velocity()?;
                    target = towards(self.found.1);
                }
                Err(error @ HamiltonianError::NotFinite { .. }) => return Err(error),
                Err(_) => target = self.found.1 + 0.5 * (target - self.found.1),
            }
        }
        self.reach(sigma)
    }

    /// Finds z(σ) from the point found last, where the iteration contracts from its first step on: else it might end on
    /// another branch.
    fn reach(&mut self, sigma: f64) -> Result<(), HamiltonianError> {
        let (d, count) = (self.point.len(), self.constants.len());
        let along: f64 = self.tangent.iter().zip(&self.velocity).map(|(t, h)| t * h).sum();
        let ahead = (sigma - self.found.1) / along;
        for ((z, found), velocity) in self.point.iter_mut().zip(&self.found.0).zip(&self.velocity) {
            *z = found + ahead * velocity;
        }
        let mut previous = f64::INFINITY;
        for iteration in 0..ITERATIONS {
            let (q, p) = self.point.split_at(d / 2);
            differentials_into(self.integrals, (q, p, self.time), &mut self.values, &mut self.slopes);
            check_result((q, p, self.time), "dK", &self.slopes)?;
            for column in 0..d {
                let from = column * count;
                self.jacobian[column * d..column * d + count].copy_from_slice(&self.slopes[from..from + count]);
                self.jacobian[column * d + count] = self.tangent[column];
            }
            for ((step, value), constant) in self.step.iter_mut().zip(&self.values).zip(self.constants) {
                *step = value - constant;
            }
            let along: f64 =
                self.tangent.iter().zip(&self.point).zip(&self.origin).map(|((t, z), o)| t * (z - o)).sum();
            self.step[count] = along - sigma;
            lu::factor_in_place(&mut self.jacobian, &mut self.exchanges)?;
            lu::solve_in_place(&self.jacobian, &self.exchanges, &mut self.step)?;
            for (z, step) in self.point.iter_mut().zip(&self.step) {
                *z -= step;
            }
            let correction = length(&self.step) / length(&self.point).max(f64::MIN_POSITIVE);
            if correction <= 2.0 * f64::EPSILON || (correction <= 1e-10 && previous <= 2.0 * correction) {
                self.found.0.copy_from_slice(&self.point);
                self.found.1 = sigma;
                return Ok(());
            }
            if 0 < iteration && 1e-10 < correction && CONTRACTION * previous < correction {
                break;
            }
            previous = correction;
        }
        let residual = self.values.iter().zip(self.constants).map(|(v, c)| (v - c).abs()).fold(0.0, f64::max);
        Err(HamiltonianError::NotSolved { condition: CONDITION, residual, correction: previous })
    }
}

impl<K: PhaseFunctions, H: PhaseFunction> Field for Chart<'_, K, H> {
    type Error = HamiltonianError;
    fn dimension(&self) -> usize {
        1
    }
    fn rate(&mut self, _t: f64, sigma: &[f64], rate: &mut [f64]) -> Result<(), HamiltonianError> {
        self.before.0.copy_from_slice(&self.found.0);
        self.before.1 = self.found.1;
        self.find(sigma[0])?;
        self.find_velocity()?;
        rate[0] = self.tangent.iter().zip(&self.velocity).map(|(t, h)| t * h).sum();
        let cosine = rate[0] / length(&self.velocity);
        if cosine < TURNED {
            self.turned.set(true);
        }
        if cosine.is_nan() || cosine <= LOST {
            // Elsewhere on the path the same σ may come again: that is not where the motion is.
            core::mem::swap(&mut self.found, &mut self.before);
            self.find_velocity()?;
            return Err(HamiltonianError::NotSolved { condition: CONDITION, residual: 1.0 - cosine, correction: 0.0 });
        }
        Ok(())
    }
    fn magnitudes(&self, _sigma: &[f64], magnitudes: &mut [f64]) {
        // σ is zero at every origin: its errors are those of the point.
        magnitudes.fill(length(&self.found.0));
    }
}

fn length(vector: &[f64]) -> f64 {
    vector.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// The points of a trajectory at given times, from 2n − 1 independent integrals that do not depend on time.
///
/// The path through `start` is where the integrals keep their values; where on it the motion is, a single equation of
/// first order says. `times` increase from that of the start.
///
/// # Errors
/// [`HamiltonianError::WrongLength`] for another number of integrals; [`HamiltonianError::NotAnIntegral`] with the index
/// of one that is none; [`HamiltonianError::Numerics`] where they depend on each other; [`HamiltonianError::TimesNotIncreasing`];
/// [`HamiltonianError::Run`].
///
/// # Accuracy
/// Points lie on the path to some ulp times the condition number of the integrals; the error along it is that of the
/// tolerance.
///
/// # Example
/// The one integral of an oscillator is its energy:
/// ```
/// use piola_hamiltonian::{PhaseFunction, PhaseFunctions, PhasePoint, trajectory_from_integrals};
/// use piola_integrators::Tolerance;
/// use piola_numerics::Real;
/// struct Oscillator;
/// impl PhaseFunction for Oscillator {
///     fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
///         T::lit(0.5) * (p[0] * p[0] + q[0] * q[0])
///     }
/// }
/// struct Energy;
/// impl PhaseFunctions for Energy {
///     fn count(&self) -> usize {
///         1
///     }
///     fn values<T: Real>(&self, q: &[T], p: &[T], t: T, out: &mut [T]) {
///         out[0] = Oscillator.value(q, p, t);
///     }
/// }
/// let start = PhasePoint::new(&[1.0], &[0.0], 0.0)?;
/// let points = trajectory_from_integrals(&Energy, &Oscillator, &start, &[1.0, 7.0], Tolerance::relative(1e-12)?)?;
/// assert!((points[0].q()[0] - 1.0_f64.cos()).abs() < 1e-11 && (points[1].q()[0] - 7.0_f64.cos()).abs() < 1e-10);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// W(9.23–9.24).
pub fn trajectory_from_integrals(
    integrals: &impl PhaseFunctions,
    hamiltonian: &impl PhaseFunction,
    start: &PhasePoint,
    times: &[f64],
    tolerance: Tolerance,
) -> Result<Vec<PhasePoint>, HamiltonianError> {
    let (n, count, time) = (start.q().len(), integrals.count(), start.time());
    check_length("integrals", (2 * n).saturating_sub(1), count)?;
    check_finite("times", times)?;
    for (index, (rate, magnitude)) in rates_and_magnitudes(integrals, hamiltonian, start)?.into_iter().enumerate() {
        if INTEGRAL * magnitude < rate.abs() {
            return Err(HamiltonianError::NotAnIntegral { index, relative: rate.abs() / magnitude });
        }
    }
    let mut constants = vec![0.0; count];
    integrals.values(start.q(), start.p(), time, &mut constants);
    let d = 2 * n;
    let point = [start.q(), start.p()].concat();
    let turned = Cell::new(false);
    let mut chart = Chart {
        integrals,
        hamiltonian,
        constants: &constants,
        time,
        origin: point.clone(),
        tangent: vec![0.0; d],
        found: (point.clone(), 0.0),
        before: (point.clone(), 0.0),
        point,
        velocity: vec![0.0; d],
        values: vec![0.0; count],
        slopes: vec![0.0; count * d],
        jacobian: vec![0.0; d * d],
        exchanges: vec![0; d],
        step: vec![0.0; d],
        turned: &turned,
    };
    chart.restart()?;
    let mut reached = time;
    let mut points = Vec::with_capacity(times.len());
    for (index, &wanted) in times.iter().enumerate() {
        if wanted < reached {
            return Err(HamiltonianError::TimesNotIncreasing { index, time: wanted, before: reached });
        }
        // A state at rest stays where it is.
        while reached < wanted && 0.0 < length(&chart.velocity) {
            let refused = |source| HamiltonianError::Run { time: reached, source: Box::new(source) };
            let mut state = State::new(reached, vec![0.0]).map_err(|_| HamiltonianError::NotFinite {
                quantity: "times",
                index,
                value: reached,
            })?;
            turned.set(false);
            DormandPrince853::new(tolerance)
                .integrate(&mut chart, &mut state, wanted, |_| {
                    if turned.get() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
                })
                .map_err(refused)?;
            chart.find(state.values[0])?;
            chart.restart()?;
            reached = state.time;
        }
        let (q, p) = chart.found.0.split_at(n);
        points.push(PhasePoint::new(q, p, wanted)?);
        reached = wanted;
    }
    Ok(points)
}
