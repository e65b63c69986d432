//! The geodetic distance between two events: the action along the extremals that join them, one sheet for each.
//!
//! ```text
//! G(q₀, t₀, q₁, t₁) = ∫ L dt = ∫ (p·q̇ − H) dt                                              W(13.1)
//! dG = p₁·dq₁ − p₀·dq₀ − H₁ dt₁ + H₀ dt₀                                                    W(13.8)
//! ```
//!
//! The two-point problem is solved by shooting: q(t₁; p₀) = q₁ by Newton's iteration with the exact variations of the
//! extremal, and where that fails by moving the target from where a ray ends to where it should.

use nalgebra::{DMatrix, DVector};
use piola_integrators::Tolerance;

use super::events::Event;
use super::morse::{ConjugatePoint, Passages};
use crate::PhaseFunction;
use crate::check::{check_finite, check_length};
use crate::ray::{MOST_STEPS, RayEnd, follow, follow_within};
use crate::{HamiltonJacobiError, HamiltonianError};

/// Newton iterations after which a start is given up.
const ITERATIONS: usize = 30;
/// How often a step is halved.
const HALVINGS: usize = 12;
/// Below this ratio of ∂q₁/∂p₀ to the largest ∂q/∂p₀ on the way, events are conjugate.
const CONJUGATE: f64 = 1e-7;
/// The shortest part of the way of the target in continuation.
const SHORTEST_PART: f64 = 1.0 / 1024.0;

/// An extremal that joins two events: one sheet of the geodetic distance there, with its derivatives.
///
/// # Example
/// See [`GeodeticDistance`].
///
/// # Source
/// W(13.1–13.8).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Extremal {
    /// G, J s.
    pub distance: f64,
    /// p₀ = −∂G/∂q₀.
    pub initial_momenta: Vec<f64>,
    /// p₁ = ∂G/∂q₁.
    pub final_momenta: Vec<f64>,
    /// H₀ = ∂G/∂t₀, J.
    pub initial_energy: f64,
    /// H₁ = −∂G/∂t₁, J.
    pub final_energy: f64,
    /// ∂²G/∂q₀∂q₁ = −(∂q₁/∂p₀)⁻¹, row by q₀ and column by q₁.
    #[cfg_attr(feature = "serde", serde(with = "piola_lagrangian::internal::matrix"))]
    pub mixed_hessian: DMatrix<f64>,
    /// ∂²G/∂q₀∂q₀.
    #[cfg_attr(feature = "serde", serde(with = "piola_lagrangian::internal::matrix"))]
    pub initial_hessian: DMatrix<f64>,
    /// ∂²G/∂q₁∂q₁.
    #[cfg_attr(feature = "serde", serde(with = "piola_lagrangian::internal::matrix"))]
    pub final_hessian: DMatrix<f64>,
    /// The points conjugate to the start, in the order of the way; the end itself is not one of them.
    pub conjugate_points: Vec<ConjugatePoint>,
    /// |q(t₁) − q₁|: what shooting left.
    pub miss: f64,
    /// The smallest singular value of ∂q₁/∂p₀ over the largest ∂q/∂p₀ on the way: zero at a conjugate end.
    pub distance_from_conjugate: f64,
}

impl Extremal {
    /// The Morse index: the number of independent variations with fixed ends that lower the action.
    ///
    /// Zero for a minimum. Where H_pp is positive definite it is the number of conjugate points with their
    /// multiplicity.
    #[must_use]
    pub fn morse_index(&self) -> usize {
        self.conjugate_points.iter().map(|point| point.multiplicity).sum()
    }
}

/// The two-point problem of a Hamiltonian.
///
/// # Accuracy
/// G and its four gradients to about ten times the tolerance times the largest terms, divided by
/// [`distance_from_conjugate`](Extremal::distance_from_conjugate) for the momenta.
///
/// # Example
/// A throw of one second to the same height: G = −m g² t³/24 with m = 1 and g = 12.
/// ```
/// use piola_hamiltonian::hamilton_jacobi::{Event, GeodeticDistance};
/// use piola_hamiltonian::PhaseFunction;
/// use piola_numerics::Real;
/// struct Stone;
/// impl PhaseFunction for Stone {
///     fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
///         T::lit(0.5) * p[0] * p[0] + T::lit(12.0) * q[0]
///     }
/// }
/// let distance = GeodeticDistance::new(&Stone);
/// let throw = distance.between(&Event::new(&[0.0], 0.0), &Event::new(&[0.0], 1.0), &[0.0])?;
/// assert!((throw.distance + 6.0).abs() < 1e-11);
/// assert!((throw.initial_momenta[0] - 6.0).abs() < 1e-11);
/// assert!((throw.mixed_hessian[(0, 0)] + 1.0).abs() < 1e-11); // −m/t
/// assert_eq!(throw.morse_index(), 0);
/// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
/// ```
///
/// # Source
/// W(13.1), W(13.8).
#[derive(Clone, Copy, Debug)]
pub struct GeodeticDistance<'a, H> {
    pub(super) hamiltonian: &'a H,
    pub(super) tolerance: Tolerance,
}

impl<'a, H: PhaseFunction> GeodeticDistance<'a, H> {
    /// The problem of a Hamiltonian, with the relative tolerance 1e-13.
    #[must_use]
    pub fn new(hamiltonian: &'a H) -> Self {
        Self { hamiltonian, tolerance: FINE }
    }

    /// Sets the tolerance of the integration.
    #[must_use]
    pub const fn with_tolerance(mut self, tolerance: Tolerance) -> Self {
        self.tolerance = tolerance;
        self
    }

    /// The extremal to which an initial momentum leads.
    ///
    /// Newton's iteration from the guess, damped; where it fails, continuation of the target from the place where
    /// the guess arrives. Which sheet is found depends on the guess; for all of them see
    /// [`all_between`](Self::all_between).
    ///
    /// # Errors
    /// [`HamiltonianError::WrongLength`], [`HamiltonianError::NotFinite`], [`HamiltonJacobiError::EventsAtOneTime`];
    /// [`HamiltonJacobiError::NoExtremal`] with the best miss; [`HamiltonJacobiError::ConjugateEvents`].
    pub fn between(&self, from: &Event, to: &Event, momenta: &[f64]) -> Result<Extremal, HamiltonianError> {
        check_events(from, to, momenta.len())?;
        check_finite("p", momenta)?;
        let problem = self.problem(from, to);
        let mut miss = f64::INFINITY;
        match problem.solve(momenta, &mut miss) {
            Some((momenta, end)) => problem.certify(&momenta, end.sizes),
            None => Err(HamiltonianError::HamiltonJacobi(HamiltonJacobiError::NoExtremal { miss, starts: 1 })),
        }
    }

    pub(super) const fn problem<'p>(&'p self, from: &'p Event, to: &'p Event) -> Problem<'p, 'a, H> {
        Problem { distance: self, from, to, most_steps: MOST_STEPS }
    }
}

/// The relative tolerance 1e-13.
pub(super) const FINE: Tolerance = match Tolerance::relative(1e-13) {
    Ok(tolerance) => tolerance,
    Err(_) => unreachable!(),
};

pub(super) fn check_events(from: &Event, to: &Event, momenta: usize) -> Result<(), HamiltonianError> {
    check_length("q₁", from.coordinates.len(), to.coordinates.len())?;
    check_length("p₀", from.coordinates.len(), momenta)?;
    from.check()?;
    to.check()?;
    if (from.time - to.time).abs() <= 0.0 {
        Err(HamiltonianError::HamiltonJacobi(HamiltonJacobiError::EventsAtOneTime { time: from.time }))
    } else {
        Ok(())
    }
}

/// Two events and what is needed to join them.
pub(super) struct Problem<'p, 'a, H> {
    pub(super) distance: &'p GeodeticDistance<'a, H>,
    pub(super) from: &'p Event,
    pub(super) to: &'p Event,
    /// Steps after which a ray is given up.
    pub(super) most_steps: u64,
}

impl<H: PhaseFunction> Problem<'_, '_, H> {
    pub(super) fn freedom(&self) -> usize {
        self.from.coordinates.len()
    }

    /// The state at the start, with variations of p₀, and of q₀ when `both`.
    fn start(&self, momenta: &[f64], both: bool) -> Vec<f64> {
        let n = self.freedom();
        let mut y: Vec<f64> = self.from.coordinates.iter().chain(momenta).copied().chain([0.0]).collect();
        for j in 0..n {
            y.extend((0..2 * n).map(|i| f64::from(u8::from(i == n + j))));
        }
        for j in 0..if both { n } else { 0 } {
            y.extend((0..2 * n).map(|i| f64::from(u8::from(i == j))));
        }
        y
    }

    pub(super) fn target(&self) -> &[f64] {
        &self.to.coordinates
    }

    pub(super) fn shoot(&self, momenta: &[f64]) -> Option<RayEnd> {
        let GeodeticDistance { hamiltonian, tolerance } = *self.distance;
        let times = (self.from.time, self.to.time);
        let ray = (hamiltonian, self.freedom(), tolerance);
        follow_within(self.most_steps, ray, &self.start(momenta, false), times, |_| Ok(())).ok()
    }

    /// p₀ from a guess, directly or by continuation; `miss` becomes the least distance met from the event.
    pub(super) fn solve(&self, guess: &[f64], miss: &mut f64) -> Option<(Vec<f64>, RayEnd)> {
        let start = self.shoot(guess)?;
        let target = &self.to.coordinates;
        if let Some(found) = self.newton(guess, start.clone(), target, miss) {
            return Some(found);
        }
        let (mut part, mut step) = (0.0, 0.25);
        let (mut momenta, mut end) = (guess.to_vec(), start.clone());
        while SHORTEST_PART <= step {
            let next = f64::min(part + step, 1.0);
            let towards: Vec<f64> = start.coordinates().iter().zip(target).map(|(a, b)| a + next * (b - a)).collect();
            let mut unused = f64::INFINITY;
            match self.newton(&momenta, end.clone(), &towards, &mut unused) {
                Some((found, reached)) => {
                    *miss = miss.min(distance(reached.coordinates(), target));
                    if 1.0 <= next {
                        return Some((found, reached));
                    }
                    (part, step) = (next, 2.0 * step);
                    (momenta, end) = (found, reached);
                }
                None => step *= 0.25,
            }
        }
        None
    }

    /// Newton's iteration for q(t₁; p₀) = target.
    pub(super) fn newton(
        &self,
        guess: &[f64],
        mut end: RayEnd,
        target: &[f64],
        miss: &mut f64,
    ) -> Option<(Vec<f64>, RayEnd)> {
        let mut momenta = guess.to_vec();
        let mut left = distance(end.coordinates(), target);
        let resolution = 10.0 * self.distance.tolerance.relative_part().max(f64::EPSILON);
        for _ in 0..ITERATIONS {
            *miss = miss.min(left);
            let size = end.sizes[0].max(target.iter().fold(0.0, |m, q| m.max(q.abs())));
            let close = left <= resolution * size;
            let step = self.correction(&end, target)?;
            let (mut fraction, mut better) = (1.0, None);
            for _ in 0..HALVINGS {
                let trial: Vec<f64> = momenta.iter().zip(step.iter()).map(|(p, s)| p + fraction * s).collect();
                if let Some(reached) = self.shoot(&trial) {
                    let now = distance(reached.coordinates(), target);
                    if now < (1.0 - 0.25 * fraction) * left {
                        better = Some((trial, reached, now));
                        break;
                    }
                }
                if close {
                    break;
                }
                fraction *= 0.5;
            }
            match better {
                Some((trial, reached, now)) => (momenta, end, left) = (trial, reached, now),
                // Rounding and the tolerance leave this much.
                None if left <= 1e3 * resolution * size => return Some((momenta, end)),
                None => return None,
            }
            if close {
                *miss = miss.min(left);
                return Some((momenta, end));
            }
        }
        None
    }

    /// The change of p₀ that should bring the end to the target; least where ∂q₁/∂p₀ is singular.
    fn correction(&self, end: &RayEnd, target: &[f64]) -> Option<DVector<f64>> {
        let n = self.freedom();
        let map = DMatrix::from_fn(n, n, |i, j| end.variation(j, i));
        let miss = DVector::from_fn(n, |i, _| target[i] - end.coordinates()[i]);
        map.svd(true, true).solve(&miss, 1e-12 * end.sizes[3]).ok()
    }

    /// The extremal with all that is known of it, once its initial momentum has been found.
    ///
    /// The sizes are those of its ray with the variations by momenta alone: those by coordinates have other units.
    pub(super) fn certify(&self, momenta: &[f64], sizes: [f64; 5]) -> Result<Extremal, HamiltonianError> {
        let n = self.freedom();
        let GeodeticDistance { hamiltonian, tolerance } = *self.distance;
        let (t0, t1) = (self.from.time, self.to.time);
        let ray = (hamiltonian, n, tolerance);
        let end = follow(ray, &self.start(momenta, true), (t0, t1), |_| Ok(()))?;
        let by_momenta = DMatrix::from_fn(n, n, |i, j| end.variation(j, i));
        let by_coordinates = DMatrix::from_fn(n, n, |i, j| end.variation(n + j, i));
        let momenta_by_momenta = DMatrix::from_fn(n, n, |i, j| end.variation(j, n + i));
        let [.., largest, largest_momentum] = sizes;
        let ratio = by_momenta.singular_values().min() / largest;
        if ratio.is_nan() || ratio <= CONJUGATE {
            return Err(HamiltonianError::HamiltonJacobi(HamiltonJacobiError::ConjugateEvents { ratio }));
        }
        let Some(inverse) = by_momenta.try_inverse() else {
            return Err(HamiltonianError::HamiltonJacobi(HamiltonJacobiError::ConjugateEvents { ratio }));
        };
        // Units apart, P and sX are then of one size.
        let scale = largest_momentum / largest * (t1 - t0).signum();
        let mut passages = Passages::new(n, scale, t0);
        follow(ray, &self.start(momenta, false), (t0, t1), |step| passages.inspect(step))?;
        let energy = |q: &[f64], p: &[f64], t: f64| hamiltonian.value(q, p, t);
        // What is left of the way: the slope of G is p₁.
        let rest = self.to.coordinates.iter().zip(end.coordinates()).zip(end.momenta());
        let extremal = Extremal {
            distance: end.action() + rest.map(|((wanted, reached), p)| p * (wanted - reached)).sum::<f64>(),
            initial_momenta: momenta.to_vec(),
            final_momenta: end.momenta().to_vec(),
            initial_energy: energy(&self.from.coordinates, momenta, t0),
            final_energy: energy(end.coordinates(), end.momenta(), t1),
            mixed_hessian: -&inverse,
            initial_hessian: &inverse * by_coordinates,
            final_hessian: momenta_by_momenta * &inverse,
            conjugate_points: passages.points,
            miss: distance(end.coordinates(), &self.to.coordinates),
            distance_from_conjugate: ratio,
        };
        check_finite("G", &[extremal.distance, extremal.initial_energy, extremal.final_energy])?;
        Ok(extremal)
    }
}

pub(super) fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}
