//! Levels U = c of a solution in the space of events, and Huygens' principle there: for any number of coordinates, and
//! for Hamiltonians that depend on time.
//!
//! ```text
//! U = c + Δc:  the events at which ∫ L dt = Δc along the transversals of U = c                          W(13.27)
//! U = c + Δc:  the envelope of the manifolds G(q₀, t₀, q, t) = Δc, for all (q₀, t₀) with U = c          W(13.28)
//! ```
//! The second uses nothing of the transversals. An extremal leaves (q₀, t₀) with any momenta p₀; the event X at which
//! its action is Δc lies on the manifold of (q₀, t₀), whose normal there is (p, −H). X is on the envelope if it moves
//! within that manifold when (q₀, t₀) moves along the level and p₀ stays:
//!
//! ```text
//! p·δq − δS = 0 for the n displacements (δq₀, δt₀) of the level;  δq, δS at the time of X, p₀ fixed
//! ```
//! Where L vanishes, as for H of the first degree in p, no level is reached; the fronts of such a Hamiltonian at one energy
//! are [`WaveFront`](super::WaveFront)s.

use nalgebra::{DMatrix, DVector};
use piola_integrators::{DormandPrince853, State};
use piola_numerics::Dual;

use super::PrincipalFunction;
use super::events::Event;
use super::strips::slopes_of;
use super::transversals::{Transversal, Transversals};
use crate::PhaseFunction;
use crate::check::{check_finite, check_length};
use crate::partial_derivatives::Slopes;
use crate::ray::{MOST_STEPS, RayField, follow};
use crate::{HamiltonJacobiError, HamiltonianError};

/// Newton iterations after which an event is given up.
const ITERATIONS: usize = 60;
/// How often one of them is halved.
const HALVINGS: usize = 20;

/// An event of a level of a solution, with the momenta of the extremal that leads there.
///
/// # Example
/// See [`Transversals::level_point`].
///
/// # Source
/// W(13.26–13.28).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LevelPoint {
    /// (q, t).
    pub event: Event,
    /// p = ∂U/∂q.
    pub momenta: Vec<f64>,
    /// H = −∂U/∂t, J.
    pub energy: f64,
}

impl<H: PhaseFunction, U: PrincipalFunction> Transversals<'_, H, U> {
    /// The event of a transversal at which U is larger by `increment`, J s, than at its foot: the first one before or after
    /// the foot, on the way to the time `until`, s.
    ///
    /// # Errors
    /// [`HamiltonJacobiError::NotFound`] when the action does not reach the increment by then;
    /// [`HamiltonianError::NotFinite`]; [`HamiltonianError::Run`].
    ///
    /// # Accuracy
    /// About ten times the tolerance. Two passages within one step of the integration are not seen.
    ///
    /// # Example
    /// H = p²/(2 (1 + t)²), free motion that slows down: S = ½ p² t/(1 + t) from t = 0.
    /// ```
    /// use piola_hamiltonian::hamilton_jacobi::{PrincipalFunction, Transversals};
    /// use piola_hamiltonian::PhaseFunction;
    /// use piola_numerics::Real;
    /// struct Slowing;
    /// impl PhaseFunction for Slowing {
    ///     fn value<T: Real>(&self, _q: &[T], p: &[T], t: T) -> T {
    ///         let rate = (T::one() + t).recip();
    ///         T::lit(0.5) * (p[0] * p[0] + p[1] * p[1]) * rate * rate
    ///     }
    /// }
    /// struct Bowl; // U = (x² + y²)/2 at t = 0
    /// impl PrincipalFunction for Bowl {
    ///     fn value<T: Real>(&self, q: &[T], _t: T) -> T {
    ///         T::lit(0.5) * (q[0] * q[0] + q[1] * q[1])
    ///     }
    /// }
    /// let transversals = Transversals::of_values(&Slowing, &Bowl, 0.0);
    /// let start = transversals.start(&[2.0, 0.0], 0.0)?; // p = (2, 0)
    /// let point = transversals.level_point(&start, 1.0, 10.0)?; // t/(1 + t) = ½
    /// assert!((point.event.time - 1.0).abs() < 1e-12 && (point.event.coordinates[0] - 3.0).abs() < 1e-12);
    /// // The envelope of what all places emit, from momenta that are far from those of the transversal.
    /// let touched = transversals.envelope_event(&start.foot, &[1.5, 1.5], 1.0, 10.0)?;
    /// assert!((touched.event.time - 1.0).abs() < 1e-10 && touched.momenta[1].abs() < 1e-10);
    /// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
    /// ```
    ///
    /// # Source
    /// W(13.26–13.27).
    pub fn level_point(&self, start: &Transversal, increment: f64, until: f64) -> Result<LevelPoint, HamiltonianError> {
        let (time, values) = self.reached(&start.foot, &start.momenta, increment, until)?;
        Ok(self.level(time, &values))
    }

    /// The event at which the manifold G(q₀, t₀, q, t) = Δc of a foot (q₀, t₀) touches the envelope of the manifolds of all
    /// events of its level: by Huygens' principle the [`level_point`](Self::level_point) of its transversal.
    ///
    /// Only the displacements of the foot within its level are used, not that the transversal leaves the level across. The
    /// search is Newton's iteration for p₀ from `momenta`, which need not be near; those of a sense that is opposite lead to
    /// the opposite sheet. Where values at one time are given instead of a manifold, the action is counted from their value.
    ///
    /// # Errors
    /// [`HamiltonJacobiError::NotFound`] when the extremal with the guess does not reach the increment by the time `until`, or
    /// the iteration does not converge; [`HamiltonianError::NotFinite`]; [`HamiltonianError::WrongLength`];
    /// [`HamiltonianError::Run`].
    ///
    /// # Accuracy
    /// About a hundred times the tolerance.
    ///
    /// # Example
    /// See [`level_point`](Self::level_point).
    ///
    /// # Source
    /// W(13.28).
    pub fn envelope_event(
        &self,
        foot: &Event,
        momenta: &[f64],
        increment: f64,
        until: f64,
    ) -> Result<LevelPoint, HamiltonianError> {
        let n = foot.coordinates.len();
        check_length("p₀", n, momenta.len())?;
        check_finite("q", &foot.coordinates)?;
        check_finite("p₀", momenta)?;
        let foot = &Event::new(&foot.coordinates, self.foot_time(foot.time));
        let displacements = self.displacements(&foot.coordinates, foot.time);
        let (slope, _) = self.slope(&foot.coordinates, foot.time);
        let evaluate = |p0: &[f64]| -> Result<Emitted, HamiltonianError> {
            let (time, values) = self.reached(foot, p0, increment, until)?;
            let mut residual = DVector::zeros(n);
            let mut size = 0.0_f64;
            for (i, displacement) in displacements.iter().enumerate() {
                let varied = self.displaced(foot, p0, displacement, time)?;
                // U itself changes along the foot where values are given; along a level it does not.
                let along: f64 = slope.iter().zip(displacement).map(|(u, d)| u * d).sum();
                let moved: f64 = (0..n).map(|k| values[n + k] * varied[k]).sum();
                residual[i] = moved - varied[n] - along;
                let terms: f64 = (0..n).map(|k| (values[n + k] * varied[k]).abs()).sum();
                size = size.max(terms + varied[n].abs() + along.abs());
            }
            Ok(Emitted { time, values, residual, size })
        };
        let mut p0 = momenta.to_vec();
        let mut now = evaluate(&p0)?;
        let resolution = 10.0 * self.tolerance.relative_part().max(f64::EPSILON);
        let mut iterations = 0;
        while iterations < ITERATIONS && resolution * now.size < now.residual.norm() {
            iterations += 1;
            let step = self.correction(foot, &p0, &displacements, &now.residual);
            let (mut fraction, mut better) = (1.0, None);
            for _ in 0..HALVINGS {
                let trial: Vec<f64> = p0.iter().zip(&step).map(|(p, d)| p - fraction * d).collect();
                if let Ok(next) = evaluate(&trial)
                    && next.residual.norm() < (1.0 - 0.25 * fraction) * now.residual.norm()
                {
                    better = Some((trial, next));
                    break;
                }
                fraction *= 0.5;
            }
            let Some((trial, next)) = better else { break };
            (p0, now) = (trial, next);
        }
        let residual = now.residual.norm();
        if residual <= 1e3 * resolution * now.size {
            return Ok(self.level(now.time, &now.values));
        }
        Err(not_found("points of the envelope", iterations, residual))
    }

    fn level(&self, time: f64, values: &[f64]) -> LevelPoint {
        let n = values.len() / 2;
        let (q, p) = (&values[..n], &values[n..2 * n]);
        let energy = self.hamiltonian.value(q, p, time);
        LevelPoint { event: Event::new(q, time), momenta: p.to_vec(), energy }
    }

    /// Newton's correction of p₀. The residuals of the conditions are δq₀·p₀ − H(p₀) δt₀, one for each direction.
    fn correction(&self, foot: &Event, p0: &[f64], displacements: &[Vec<f64>], residual: &DVector<f64>) -> Vec<f64> {
        let n = p0.len();
        let mut slopes = Slopes::new();
        slopes_of(self.hamiltonian, &mut slopes, (&foot.coordinates, p0, foot.time));
        let slope = DMatrix::from_fn(n, n, |i, j| displacements[i][j] - slopes.partials[n + j] * displacements[i][n]);
        let solved = slope.svd(true, true).solve(residual, 1e-12);
        solved.map_or_else(|_| vec![0.0; n], |step| step.iter().copied().collect())
    }

    /// The time at which the action of the extremal from a foot is the increment, and q, p and S there.
    fn reached(
        &self,
        foot: &Event,
        momenta: &[f64],
        increment: f64,
        until: f64,
    ) -> Result<(f64, Vec<f64>), HamiltonianError> {
        check_finite("Δc", &[increment])?;
        check_finite("t", &[foot.time, until])?;
        let n = momenta.len();
        let start: Vec<f64> = foot.coordinates.iter().chain(momenta).copied().chain([0.0]).collect();
        let ray = (self.hamiltonian, n, self.tolerance);
        let mut found = (increment.abs() <= 0.0).then_some(foot.time);
        if found.is_none() {
            let mut buffer = start.clone();
            let missing = |action: f64| action - increment;
            let outcome = follow(ray, &start, (foot.time, until), |step| {
                let (mut a, mut b) = (step.start(), step.time());
                let (mut fa, fb) = (missing(step.start_values()[2 * n]), missing(step.values()[2 * n]));
                if fa * fb <= 0.0 {
                    // Bisection: the steps of Newton below do the rest.
                    for _ in 0..20 {
                        let middle = 0.5 * (a + b);
                        step.at(middle, &mut buffer)
                            .map_err(|error| HamiltonianError::Run { time: middle, source: Box::new(error) })?;
                        let fm = missing(buffer[2 * n]);
                        if fa * fm <= 0.0 { b = middle } else { (a, fa) = (middle, fm) }
                    }
                    found = Some(0.5 * (a + b));
                    // There is nothing to see beyond.
                    return Err(not_found("events of this action", 0, fb.abs()));
                }
                Ok(())
            });
            if found.is_none() {
                let end = outcome?;
                return Err(not_found("events of this action", 0, missing(end.action()).abs()));
            }
        }
        let mut time = found.unwrap_or(until);
        let mut slopes = Slopes::new();
        for _ in 0..4 {
            let end = follow(ray, &start, (foot.time, time), |_| Ok(()))?;
            slopes_of(self.hamiltonian, &mut slopes, (end.coordinates(), end.momenta(), time));
            let along: f64 = end.momenta().iter().zip(&slopes.partials[n..]).map(|(p, rate)| p * rate).sum();
            let correction = (end.action() - increment) / (along - slopes.value);
            let small = 4.0 * f64::EPSILON * (time.abs() + (time - foot.time).abs());
            if !correction.is_finite() || correction.abs() <= small {
                return Ok((time, end.values[..2 * n].to_vec()));
            }
            time -= correction;
        }
        let end = follow(ray, &start, (foot.time, time), |_| Ok(()))?;
        Ok((time, end.values[..2 * n].to_vec()))
    }

    /// (δq, δS) at a time, of extremals whose foot is displaced and whose first momenta are not.
    fn displaced(
        &self,
        foot: &Event,
        momenta: &[f64],
        displacement: &[f64],
        time: f64,
    ) -> Result<Vec<f64>, HamiltonianError> {
        let n = momenta.len();
        let mut slopes = Slopes::new();
        slopes_of(self.hamiltonian, &mut slopes, (&foot.coordinates, momenta, foot.time));
        let (h_q, h_p) = (&slopes.partials[..n], &slopes.partials[n..2 * n]);
        let later = displacement[n];
        let along: f64 = momenta.iter().zip(h_p).map(|(p, rate)| p * rate).sum();
        // From the displaced foot back along its extremal to the time t₀.
        let coordinates = (0..n).map(|i| (foot.coordinates[i], displacement[i] - h_p[i] * later));
        let momenta = (0..n).map(|i| (momenta[i], h_q[i] * later));
        let start = coordinates.chain(momenta).chain([(0.0, -(along - slopes.value) * later)]);
        let start: Vec<Dual<f64>> = start.map(|(value, tangent)| Dual { value, tangent }).collect();
        let mut field = RayField::new(self.hamiltonian, n, 0);
        let run = |error| HamiltonianError::Run { time: foot.time, source: Box::new(error) };
        let mut state = State::new(foot.time, start).map_err(|error| run(error.with_field_error()))?;
        DormandPrince853::new(self.tolerance)
            .with_most_steps(MOST_STEPS)
            .integrate_to(&mut field, &mut state, time)
            .map_err(run)?;
        Ok((0..n).chain([2 * n]).map(|i| state.values[i].tangent).collect())
    }
}

/// An emitted extremal at the event of its action.
struct Emitted {
    time: f64,
    /// (q, p).
    values: Vec<f64>,
    residual: DVector<f64>,
    /// The terms of the residual.
    size: f64,
}

const fn not_found(unknown: &'static str, iterations: usize, residual: f64) -> HamiltonianError {
    HamiltonianError::HamiltonJacobi(HamiltonJacobiError::NotFound { unknown, iterations, residual })
}
