//! Particles sampled in time.

use nalgebra::Vector3;
use piola_numerics::{Dual, Jet, Mask, Real};

use super::Interpolation;
use super::spline::Axis;
use crate::FieldsError;
use crate::error::check_finite;

/// Places of single particles at common times, interpolated in time by splines.
///
/// # Errors
/// Asked outside the times it refuses with [`FieldsError::OutsideSamples`], for a particle that does not exist
/// with [`FieldsError::NoSuchParticle`].
///
/// # Accuracy
/// As in [the table](super#): exact for polynomials of the degree.
///
/// # Example
/// A stone thrown upwards, seen four times.
/// ```
/// use piola_fields::{Interpolation, SampledTrajectories};
/// let times = [0.0, 0.5, 1.0, 1.5];
/// let heights = times.map(|t| [0.0, 0.0, 8.0 * t - 5.0 * t * t]);
/// let stones = SampledTrajectories::new(&times, &[&heights], Interpolation::Cubic)?;
/// assert!((stones.velocity(0, 0.25_f64)?.z - 5.5).abs() < 1e-14);
/// assert!((stones.acceleration(0, 0.25_f64)?.z + 10.0).abs() < 1e-13);
/// assert!(stones.position(1, 0.25).is_err());
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Written", into = "Written"))]
pub struct SampledTrajectories {
    interpolation: Interpolation,
    times: Axis,
    /// As given, particle after particle.
    places: Box<[[f64; 3]]>,
    /// Particle after particle.
    coefficients: Box<[[f64; 3]]>,
}

/// Trajectories as they are written: times, and the places of each particle.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    times: Vec<f64>,
    particles: Vec<Vec<[f64; 3]>>,
    interpolation: Interpolation,
}

#[cfg(feature = "serde")]
impl TryFrom<Written> for SampledTrajectories {
    type Error = FieldsError;
    fn try_from(written: Written) -> Result<Self, FieldsError> {
        let particles: Vec<&[[f64; 3]]> = written.particles.iter().map(Vec::as_slice).collect();
        Self::new(&written.times, &particles, written.interpolation)
    }
}

#[cfg(feature = "serde")]
impl From<SampledTrajectories> for Written {
    fn from(trajectories: SampledTrajectories) -> Self {
        let times = trajectories.times.nodes().to_vec();
        let particles = trajectories.places.chunks(times.len()).map(<[_]>::to_vec).collect();
        Self { times, particles, interpolation: trajectories.interpolation }
    }
}

impl SampledTrajectories {
    /// From times, s, increasing, and for each particle its places, m, at those times.
    ///
    /// # Errors
    /// [`FieldsError::WrongLength`] when there is no time or a particle has another number of places;
    /// [`FieldsError::NotFinite`]; [`FieldsError::NotIncreasing`] with the index of the time.
    pub fn new(times: &[f64], particles: &[&[[f64; 3]]], interpolation: Interpolation) -> Result<Self, FieldsError> {
        let times = Axis::new("times", times, interpolation)?;
        let mut coefficients = Vec::with_capacity(particles.len() * times.len());
        let factors = times.factor();
        for places in particles {
            if places.len() != times.len() {
                let (found, expected) = (places.len(), times.len());
                return Err(FieldsError::WrongLength { quantity: "places of a particle", found, expected });
            }
            check_finite("places of a particle", places.as_flattened())?;
            let start = coefficients.len();
            coefficients.extend_from_slice(places);
            factors.solve(&mut coefficients, start, 1);
        }
        let places = particles.concat().into();
        Ok(Self { interpolation, times, places, coefficients: coefficients.into() })
    }

    /// The number of particles.
    #[must_use]
    pub fn particles(&self) -> usize {
        self.coefficients.len() / self.times.len()
    }

    /// x(t) of a particle, m.
    ///
    /// # Errors
    /// See [the type](SampledTrajectories#errors).
    pub fn position<T: Real>(&self, particle: usize, t: T) -> Result<Vector3<T>, FieldsError> {
        check_finite("t", &[t])?;
        self.times.check(t)?;
        let count = self.particles();
        if count <= particle {
            return Err(FieldsError::NoSuchParticle { particle, count });
        }
        Ok(self.at(particle, t))
    }

    /// v(t) of a particle, m/s.
    ///
    /// # Errors
    /// See [the type](SampledTrajectories#errors).
    pub fn velocity<T: Real>(&self, particle: usize, t: T) -> Result<Vector3<T>, FieldsError> {
        Ok(self.position(particle, Dual::variable(t))?.map(|x| x.tangent))
    }

    /// a(t) of a particle, m/s².
    ///
    /// # Errors
    /// See [the type](SampledTrajectories#errors).
    pub fn acceleration<T: Real>(&self, particle: usize, t: T) -> Result<Vector3<T>, FieldsError> {
        Ok(self.position(particle, Jet::<T, 0>::time(t))?.map(|x| x.second_rate))
    }

    fn at<T: Real>(&self, particle: usize, t: T) -> Vector3<T> {
        let start = particle * self.times.len();
        let combine = |first: usize| {
            let basis = self.times.basis(first, t);
            let coefficients = &self.coefficients[start + first..start + first + self.times.width()];
            Vector3::from_fn(|i, _| {
                basis.iter().zip(coefficients).fold(T::zero(), |sum, (&b, c)| sum + b * T::lit(c[i]))
            })
        };
        let mut first = self.times.first(t.primal(0));
        let mut value = combine(first);
        for lane in 1..T::LANES {
            let other = self.times.first(t.primal(lane));
            if other == first {
                continue;
            }
            first = other;
            let (there, mask) = (combine(first), self.times.within(first, t));
            debug_assert!(mask.any(), "the lane lies in its own span");
            value = Vector3::from_fn(|i, _| T::select(mask, there[i], value[i]));
        }
        value
    }
}
