//! Transversals of an initial manifold, and the solution of the Hamilton–Jacobi equation that they carry.
//!
//! ```text
//! U(q₀, t₀) = c:   p₀ = λ U_q,   −H(q₀, p₀, t₀) = λ U_t                                   W(13.10–13.13)
//! U(q, t) = c + ∫ L dt along the transversal that ends in (q, t)                            W(13.14)
//! ```
//!
//! The solution is regular until transversals meet: until the Jacobian of the map from the manifold to configuration
//! space, at a fixed time, is zero. Beyond such a caustic several sheets lie over one place.

use nalgebra::{DMatrix, DVector};
use piola_integrators::Tolerance;
use piola_numerics::{Dual, Gradient, Real};

use super::PrincipalFunction;
use super::events::Event;
use super::geodetic_distance::{FINE, distance};
use super::momentum_length::{Line, momentum_scale};
use super::morse::{ConjugatePoint, Passages};
use super::strips::slopes_of;
use crate::PhaseFunction;
use crate::check::{check_finite, check_length};
use crate::partial_derivatives::Slopes;
use crate::ray::{RayEnd, follow};
use crate::{HamiltonJacobiError, HamiltonianError};

/// Newton iterations after which a foot is given up.
const ITERATIONS: usize = 40;
/// How often one of them is halved.
const HALVINGS: usize = 20;
/// Below this part of its terms the rate of U along an extremal is zero.
const TOUCHING: f64 = 1e-7;
/// Below this ratio of the Jacobian to that of the start, a point is on a caustic.
const CAUSTIC: f64 = 1e-9;

/// Where the transversals start.
#[derive(Clone, Copy, Debug)]
enum Start {
    /// A level U(q, t) = c in the space of events; λ is sought from this guess.
    Manifold { guess: f64 },
    /// All of configuration space at one time, with the values of U there.
    Values { time: f64 },
}

/// A transversal at its start.
///
/// # Example
/// See [`Transversals`].
///
/// # Source
/// W(13.13).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Transversal {
    /// (q₀, t₀).
    pub foot: Event,
    /// p₀.
    pub momenta: Vec<f64>,
    /// U at the foot, J s.
    pub value: f64,
    /// λ in p₀ = λ U_q; one where values are given.
    pub scale: f64,
    /// The n independent displacements (δq₀, δt₀) of the foot, row by row.
    directions: Vec<Vec<f64>>,
    /// (q, p, 0, δq, δp of each displacement at the fixed time t₀).
    state: Vec<f64>,
}

/// A transversal at a later (or earlier) time.
///
/// # Example
/// See [`Transversals`].
///
/// # Source
/// W(13.14).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TransversalPoint {
    /// q.
    pub coordinates: Vec<f64>,
    /// p = ∂U/∂q.
    pub momenta: Vec<f64>,
    /// U, J s.
    pub value: f64,
    /// H = −∂U/∂t, J.
    pub energy: f64,
    /// The Jacobian of the ray map at a fixed time, relative to that of the start: it changes sign at a simple caustic.
    pub jacobian: f64,
    /// The caustics touched on the way. Empty: the solution is regular from the manifold to here.
    pub caustics: Vec<ConjugatePoint>,
    /// The event from which the transversal comes.
    pub foot: Event,
}

/// The transversals of an initial manifold.
///
/// # Accuracy
/// U to about ten times the tolerance of its terms; p and the foot to that divided by the
/// [Jacobian](TransversalPoint::jacobian).
///
/// # Example
/// Free particles with U = q²/2 at t = 0, m = 1: U = q²/(2(1 + t)).
/// ```
/// use piola_hamiltonian::hamilton_jacobi::{Event, PrincipalFunction, Transversals};
/// use piola_hamiltonian::PhaseFunction;
/// use piola_numerics::Real;
/// struct Free;
/// impl PhaseFunction for Free {
///     fn value<T: Real>(&self, _q: &[T], p: &[T], _t: T) -> T {
///         T::lit(0.5) * p[0] * p[0]
///     }
/// }
/// struct Parabola;
/// impl PrincipalFunction for Parabola {
///     fn value<T: Real>(&self, q: &[T], _t: T) -> T {
///         T::lit(0.5) * q[0] * q[0]
///     }
/// }
/// let transversals = Transversals::of_values(&Free, &Parabola, 0.0);
/// let point = transversals.solution(&Event::new(&[3.0], 0.5), &Event::new(&[3.0], 0.0))?;
/// assert!((point.value - 3.0).abs() < 1e-12 && (point.momenta[0] - 2.0).abs() < 1e-12);
/// assert!((point.jacobian - 1.5).abs() < 1e-12 && point.caustics.is_empty());
/// // Backwards they all meet at t = −1.
/// let start = transversals.start(&[3.0], 0.0)?;
/// let behind = transversals.follow(&start, -1.5)?;
/// assert!((behind.caustics[0].time + 1.0).abs() < 1e-12 && (behind.jacobian + 0.5).abs() < 1e-12);
/// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
/// ```
///
/// # Source
/// W(13.10–13.18).
#[derive(Clone, Debug)]
pub struct Transversals<'a, H, U> {
    pub(super) hamiltonian: &'a H,
    function: &'a U,
    start: Start,
    pub(super) tolerance: Tolerance,
}

impl<'a, H: PhaseFunction, U: PrincipalFunction> Transversals<'a, H, U> {
    /// The transversals of the manifolds U(q, t) = c.
    ///
    /// λ is sought from a guess, since the condition has as many roots as H(q, p, t) + λ U_t = 0 along the normal:
    /// of the two of a kinetic energy, one for each sense, and λ = 0 where H vanishes with p.
    #[must_use]
    pub fn of_manifold(hamiltonian: &'a H, function: &'a U, guess: f64) -> Self {
        Self { hamiltonian, function, start: Start::Manifold { guess }, tolerance: FINE }
    }

    /// The characteristics of the values of U at one time: p₀ = ∂U/∂q.
    #[must_use]
    pub fn of_values(hamiltonian: &'a H, function: &'a U, t: f64) -> Self {
        Self { hamiltonian, function, start: Start::Values { time: t }, tolerance: FINE }
    }

    /// Sets the tolerance of the integration.
    #[must_use]
    pub const fn with_tolerance(mut self, tolerance: Tolerance) -> Self {
        self.tolerance = tolerance;
        self
    }

    /// The transversal that starts at an event; where values are given, at their time whatever `t` is.
    ///
    /// # Errors
    /// [`HamiltonianError::NotFinite`]; [`HamiltonJacobiError::NotFound`] when there is no λ near the guess;
    /// [`HamiltonJacobiError::NotTransversal`] where the extremal touches the manifold.
    pub fn start(&self, q: &[f64], t: f64) -> Result<Transversal, HamiltonianError> {
        check_finite("q", q)?;
        let n = q.len();
        let t = self.foot_time(t);
        check_finite("t", &[t])?;
        let (momenta, scale) = self.momenta(q, t)?;
        let (slope, value) = self.slope(q, t);
        check_finite("p₀", &momenta)?;
        check_finite("U", &[value])?;
        let mut slopes = Slopes::new();
        slopes_of(self.hamiltonian, &mut slopes, (q, &momenta, t));
        check_finite("∂H/∂(q, p, t)", &slopes.partials)?;
        let (h_q, h_p) = (&slopes.partials[..n], &slopes.partials[n..2 * n]);
        if let Start::Manifold { .. } = self.start {
            let along: f64 = (0..n).map(|i| slope[i] * h_p[i]).sum();
            let terms = |a: &[f64]| a.iter().map(|x| x * x).sum::<f64>().sqrt();
            let (rate, size) = (along + slope[n], terms(&slope[..n]) * terms(h_p) + slope[n].abs());
            if rate.is_nan() || rate.abs() <= TOUCHING * size {
                return Err(HamiltonianError::HamiltonJacobi(HamiltonJacobiError::NotTransversal {
                    rate,
                    scale: size,
                }));
            }
        }
        let directions = self.displacements(q, t);
        let mut state: Vec<f64> = q.iter().chain(&momenta).copied().chain([0.0]).collect();
        for direction in &directions {
            let direction: &Vec<f64> = direction;
            let lifted: Vec<Dual<f64>> =
                q.iter().zip(direction).map(|(&value, &tangent)| Dual { value, tangent }).collect();
            let (varied, _) = self.momenta(&lifted, Dual { value: t, tangent: direction[n] })?;
            // From the displaced foot back along its ray to the time t₀.
            state.extend((0..n).map(|i| direction[i] - h_p[i] * direction[n]));
            state.extend((0..n).map(|i| varied[i].tangent + h_q[i] * direction[n]));
        }
        let foot = Event::new(q, t);
        Ok(Transversal { foot, momenta, value, scale: scale.primal(0), directions, state })
    }

    /// The time of a foot: that of the values where these are given.
    pub(super) const fn foot_time(&self, t: f64) -> f64 {
        match self.start {
            Start::Manifold { .. } => t,
            Start::Values { time } => time,
        }
    }

    /// n independent displacements (δq₀, δt₀) of a foot: within the level through it, or at one time.
    pub(super) fn displacements(&self, q: &[f64], t: f64) -> Vec<Vec<f64>> {
        match self.start {
            Start::Values { .. } => {
                let unit = |i: usize, j: usize| f64::from(u8::from(i == j));
                (0..q.len()).map(|j| (0..=q.len()).map(|i| unit(i, j)).collect()).collect()
            }
            Start::Manifold { .. } => tangents(&self.slope(q, t).0),
        }
    }

    /// (U_q, U_t) and U.
    pub(super) fn slope<T: Real>(&self, q: &[T], t: T) -> (Vec<T>, T) {
        let mut slopes = Slopes::new();
        slopes.of(&q.iter().copied().chain([t]), |x| {
            let (t, q) = x.split_last().map_or((Gradient::constant(T::zero()), x), |(t, q)| (*t, q));
            self.function.value(q, t)
        });
        (slopes.partials, slopes.value)
    }

    /// p₀ and λ, with all derivatives.
    fn momenta<T: Real>(&self, q: &[T], t: T) -> Result<(Vec<T>, T), HamiltonianError> {
        let (mut slope, _) = self.slope(q, t);
        let rate = slope.pop().unwrap_or(T::zero());
        match self.start {
            Start::Values { .. } => Ok((slope, T::one())),
            Start::Manifold { guess } => {
                let line = Line { direction: &slope, rate, energy: T::zero() };
                let (scale, _) = momentum_scale(self.hamiltonian, (q, t), line, guess)?;
                for p in &mut slope {
                    *p *= scale;
                }
                Ok((slope, scale))
            }
        }
    }

    /// Follows a transversal to a time.
    ///
    /// # Errors
    /// [`HamiltonianError::NotFinite`]; [`HamiltonianError::Run`].
    pub fn follow(&self, start: &Transversal, t: f64) -> Result<TransversalPoint, HamiltonianError> {
        check_finite("t", &[t])?;
        let (n, from) = (start.foot.coordinates.len(), start.foot.time);
        let ray = (self.hamiltonian, n, self.tolerance);
        let end = follow(ray, &start.state, (from, t), |_| Ok(()))?;
        // Units apart, P and sX are then of one size.
        let ratio = end.sizes[4] / end.sizes[3];
        let scale = if 0.0 < ratio && ratio.is_finite() { ratio } else { 1.0 } * (t - from).signum();
        let mut passages = Passages::of_manifold(n, scale, from, &start.state);
        follow(ray, &start.state, (from, t), |step| passages.inspect(step))?;
        Ok(self.point(start, &end, t, passages.points))
    }

    fn point(&self, start: &Transversal, end: &RayEnd, time: f64, caustics: Vec<ConjugatePoint>) -> TransversalPoint {
        let begin = RayEnd { freedom: end.freedom, values: start.state.clone(), sizes: end.sizes };
        TransversalPoint {
            coordinates: end.coordinates().to_vec(),
            momenta: end.momenta().to_vec(),
            value: start.value + end.action(),
            energy: self.hamiltonian.value(end.coordinates(), end.momenta(), time),
            jacobian: map_of(end).determinant() / map_of(&begin).determinant(),
            caustics,
            foot: start.foot.clone(),
        }
    }

    /// The solution U(q, t) at an event, by the transversal whose foot is near a guess: Newton's iteration for the
    /// foot on the manifold.
    ///
    /// Which of several sheets is found depends on the guess; [`caustics`](TransversalPoint::caustics) tells whether it
    /// is the one that is regular down to the manifold.
    ///
    /// # Errors
    /// As [`start`](Self::start) and [`follow`](Self::follow); [`HamiltonJacobiError::OnCaustic`];
    /// [`HamiltonJacobiError::NoExtremal`] with the least miss when no transversal was brought to the event.
    pub fn solution(&self, event: &Event, guess: &Event) -> Result<TransversalPoint, HamiltonianError> {
        let n = event.coordinates.len();
        check_length("guess", n, guess.coordinates.len())?;
        check_finite("q", &event.coordinates)?;
        check_finite("t", &[event.time])?;
        let level = self.slope(&guess.coordinates, guess.time).1;
        let shoot = |foot: &Event| -> Result<(Transversal, RayEnd, f64), HamiltonianError> {
            let start = self.start(&foot.coordinates, foot.time)?;
            let ray = (self.hamiltonian, n, self.tolerance);
            let end = follow(ray, &start.state, (start.foot.time, event.time), |_| Ok(()))?;
            let miss = distance(end.coordinates(), &event.coordinates);
            Ok((start, end, miss))
        };
        let mut now = shoot(guess)?;
        let resolution = 10.0 * self.tolerance.relative_part().max(f64::EPSILON);
        for _ in 0..ITERATIONS {
            let (start, end, miss) = &now;
            let size = end.sizes[0].max(event.coordinates.iter().fold(0.0, |m, q| m.max(q.abs())));
            let close = *miss <= resolution * size;
            let off = DVector::from_fn(n, |i, _| event.coordinates[i] - end.coordinates()[i]);
            let step = map_of(end).svd(true, true).solve(&off, 1e-12 * end.sizes[3]).unwrap_or_else(|_| off.clone());
            let (mut fraction, mut next) = (1.0, None);
            for _ in 0..HALVINGS {
                let foot = self.moved(start, &step, fraction, level);
                if let Ok(trial) = shoot(&foot)
                    && trial.2 < (1.0 - 0.25 * fraction) * miss
                {
                    next = Some(trial);
                    break;
                }
                if close {
                    break;
                }
                fraction *= 0.5;
            }
            let stalled = next.is_none();
            let good = *miss <= 1e3 * resolution * size;
            if let Some(next) = next {
                now = next;
            }
            if close || stalled {
                if !good {
                    break;
                }
                let mut point = self.follow(&now.0, event.time)?;
                // What is left of the way: the slope of U is p.
                for ((reached, wanted), p) in point.coordinates.iter().zip(&event.coordinates).zip(&point.momenta) {
                    point.value += p * (wanted - reached);
                }
                if point.jacobian.is_nan() || point.jacobian.abs() <= CAUSTIC {
                    return Err(HamiltonianError::HamiltonJacobi(HamiltonJacobiError::OnCaustic {
                        ratio: point.jacobian,
                    }));
                }
                return Ok(point);
            }
        }
        Err(HamiltonianError::HamiltonJacobi(HamiltonJacobiError::NoExtremal { miss: now.2, starts: 1 }))
    }

    /// A foot displaced within its manifold.
    fn moved(&self, start: &Transversal, step: &DVector<f64>, fraction: f64, level: f64) -> Event {
        let mut foot = start.foot.clone();
        for (direction, step) in start.directions.iter().zip(step.iter()) {
            let (time, place) = direction.split_last().map_or((0.0, &direction[..]), |(time, place)| (*time, place));
            for (q, d) in foot.coordinates.iter_mut().zip(place) {
                *q += fraction * step * d;
            }
            foot.time += fraction * step * time;
        }
        if matches!(self.start, Start::Manifold { .. }) {
            // Back to the level along its normal.
            for _ in 0..8 {
                let (slope, value) = self.slope(&foot.coordinates, foot.time);
                let square: f64 = slope.iter().map(|x| x * x).sum();
                let back = (level - value) / square;
                if !back.is_finite() {
                    break;
                }
                for (q, d) in foot.coordinates.iter_mut().chain([&mut foot.time]).zip(&slope) {
                    *q += back * d;
                }
            }
        }
        foot
    }
}

/// The derivative of q by the displacements of the foot.
fn map_of(end: &RayEnd) -> DMatrix<f64> {
    DMatrix::from_fn(end.freedom, end.freedom, |i, j| end.variation(j, i))
}

/// n orthonormal vectors across a covector of n + 1 components: the reflection that takes it to an axis.
fn tangents(normal: &[f64]) -> Vec<Vec<f64>> {
    let n = normal.len() - 1;
    let length = normal.iter().map(|x| x * x).sum::<f64>().sqrt();
    let mut mirror: Vec<f64> = normal.iter().map(|x| x / length).collect();
    mirror[n] += mirror[n].signum();
    let square: f64 = mirror.iter().map(|x| x * x).sum();
    (0..n)
        .map(|j| (0..=n).map(|i| f64::from(u8::from(i == j)) - 2.0 * mirror[i] * mirror[j] / square).collect())
        .collect()
}
