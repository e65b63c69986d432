//! The integral conoid: all extremals that leave one event, with the action along each.
//!
//! ```text
//! V(q, t) = G(q₀, t₀, q, t)                                                                 W(13.9)
//! ```

use core::f64::consts::TAU;

use piola_integrators::Tolerance;

use super::events::Event;
use super::geodetic_distance::FINE;
use super::momentum_length::{Line, momentum_scale};
use super::morse::{ConjugatePoint, Passages};
use crate::HamiltonianError;
use crate::PhaseFunction;
use crate::check::{check_finite, check_length};
use crate::ray::follow;

/// A place on the integral conoid.
///
/// # Example
/// See [`IntegralConoid`].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ConoidPoint {
    /// q.
    pub coordinates: Vec<f64>,
    /// p = ∂V/∂q.
    pub momenta: Vec<f64>,
    /// V, J s.
    pub value: f64,
    /// H = −∂V/∂t, J.
    pub energy: f64,
    /// The number of points conjugate to the vertex before it: zero on the sheet that begins at the vertex.
    pub folds: usize,
}

/// A ray of the integral conoid.
///
/// # Example
/// See [`IntegralConoid`].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ConoidRay {
    /// p at the vertex.
    pub initial_momenta: Vec<f64>,
    /// One point for each time.
    pub points: Vec<ConoidPoint>,
    /// The points conjugate to the vertex.
    pub conjugate_points: Vec<ConjugatePoint>,
}

/// The integral conoid of an event: a mesh of rays by times.
///
/// # Accuracy
/// About ten times the tolerance.
///
/// # Example
/// Free particles of unit mass from the origin: V = |q|²/(2t).
/// ```
/// use piola_hamiltonian::hamilton_jacobi::{Event, IntegralConoid};
/// use piola_hamiltonian::PhaseFunction;
/// use piola_numerics::Real;
/// struct Free;
/// impl PhaseFunction for Free {
///     fn value<T: Real>(&self, _q: &[T], p: &[T], _t: T) -> T {
///         T::lit(0.5) * (p[0] * p[0] + p[1] * p[1])
///     }
/// }
/// let vertex = Event::new(&[0.0, 0.0], 0.0);
/// let fan = IntegralConoid::fan(&Free, &vertex, 8.0, 12)?; // |p| = 4
/// let conoid = IntegralConoid::new(&Free, &vertex, &fan, &[0.5, 1.0])?;
/// assert_eq!(conoid.rays.len(), 12);
/// assert!((conoid.rays[0].points[1].coordinates[0] - 4.0).abs() < 1e-12);
/// assert!((conoid.rays[3].points[1].value - 8.0).abs() < 1e-12);
/// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
/// ```
///
/// # Source
/// W(13.9).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct IntegralConoid {
    /// The event from which the rays leave.
    pub vertex: Event,
    /// The times of the points.
    pub times: Vec<f64>,
    /// The rays, in the order of the momenta given.
    pub rays: Vec<ConoidRay>,
}

impl IntegralConoid {
    /// The rays that leave a vertex with given momenta, at given times (in order, all after the vertex or all before).
    ///
    /// # Errors
    /// [`HamiltonianError::WrongLength`], [`HamiltonianError::NotFinite`], [`HamiltonianError::TimesNotIncreasing`],
    /// [`HamiltonianError::Run`].
    pub fn new<H: PhaseFunction>(
        hamiltonian: &H,
        vertex: &Event,
        momenta: &[Vec<f64>],
        times: &[f64],
    ) -> Result<Self, HamiltonianError> {
        check_finite("q", &vertex.coordinates)?;
        check_finite("t", &[vertex.time])?;
        check_finite("t", times)?;
        let direction = times.first().map_or(1.0, |first| (first - vertex.time).signum());
        let mut before = vertex.time;
        for (index, &time) in times.iter().enumerate() {
            if direction * time <= direction * before {
                return Err(HamiltonianError::TimesNotIncreasing { index, time, before });
            }
            before = time;
        }
        let ray = |momenta: &Vec<f64>| conoid_ray((hamiltonian, FINE), vertex, momenta, times);
        let rays = momenta.iter().map(ray).collect::<Result<Vec<_>, HamiltonianError>>()?;
        Ok(Self { vertex: vertex.clone(), times: times.to_vec(), rays })
    }

    /// Momenta at a vertex of two degrees of freedom in `count` equally spaced directions, of the length that gives
    /// them an energy: H(q₀, p, t₀) = E.
    ///
    /// # Errors
    /// [`HamiltonianError::WrongLength`], [`HamiltonianError::NotFinite`]; [`HamiltonJacobiError::NotFound`](crate::HamiltonJacobiError::NotFound) where H does
    /// not reach the energy in some direction.
    pub fn fan<H: PhaseFunction>(
        hamiltonian: &H,
        vertex: &Event,
        energy: f64,
        count: usize,
    ) -> Result<Vec<Vec<f64>>, HamiltonianError> {
        check_length("q", 2, vertex.coordinates.len())?;
        check_finite("q", &vertex.coordinates)?;
        check_finite("t", &[vertex.time])?;
        check_finite("E", &[energy])?;
        let mut fan = Vec::with_capacity(count);
        let mut guess = 1.0;
        for i in 0..count {
            let (s, c) = (TAU * i as f64 / count as f64).sin_cos();
            let line = Line { direction: &[c, s], rate: 0.0, energy };
            (guess, _) = momentum_scale(hamiltonian, (&vertex.coordinates, vertex.time), line, guess)?;
            fan.push(vec![guess * c, guess * s]);
        }
        Ok(fan)
    }
}

fn conoid_ray<H: PhaseFunction>(
    (hamiltonian, tolerance): (&H, Tolerance),
    vertex: &Event,
    momenta: &[f64],
    times: &[f64],
) -> Result<ConoidRay, HamiltonianError> {
    let n = vertex.coordinates.len();
    check_length("p", n, momenta.len())?;
    check_finite("p", momenta)?;
    let mut ray = ConoidRay { initial_momenta: momenta.to_vec(), points: Vec::new(), conjugate_points: Vec::new() };
    let Some(&last) = times.last() else { return Ok(ray) };
    let mut start: Vec<f64> = vertex.coordinates.iter().chain(momenta).copied().chain([0.0]).collect();
    for j in 0..n {
        start.extend((0..2 * n).map(|i| f64::from(u8::from(i == n + j))));
    }
    let (parts, span) = ((hamiltonian, n, tolerance), (vertex.time, last));
    let end = follow(parts, &start, span, |_| Ok(()))?;
    let scale = end.sizes[4] / end.sizes[3] * (last - vertex.time).signum();
    let mut passages = Passages::new(n, scale, vertex.time);
    let mut y = vec![0.0; start.len()];
    follow(parts, &start, span, |step| {
        while let Some(&time) = times.get(ray.points.len())
            && step.contains(time)
        {
            step.at(time, &mut y).map_err(|error| HamiltonianError::Run { time, source: Box::new(error) })?;
            let (q, p) = (&y[..n], &y[n..2 * n]);
            let (coordinates, momenta) = (q.to_vec(), p.to_vec());
            let energy = hamiltonian.value(q, p, time);
            ray.points.push(ConoidPoint { coordinates, momenta, value: y[2 * n], energy, folds: 0 });
        }
        passages.inspect(step)
    })?;
    let forwards = (last - vertex.time).signum();
    for (point, time) in ray.points.iter_mut().zip(times) {
        let passed = passages.points.iter().filter(|fold| forwards * fold.time < forwards * time);
        point.folds = passed.map(|fold| fold.multiplicity).sum();
    }
    ray.conjugate_points = passages.points;
    Ok(ray)
}
