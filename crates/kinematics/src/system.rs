//! Systems of particles: centre of mass, momentum, angular momentum, energy, and König's splits.
//!
//! ```text
//! M = Σm      r^c = Σ m x / M     r^{αc} = x^α − r^c     v^{αc} = v^α − v^c
//! Σ m r^{αc} = Σ m v^{αc} = 0                                        W(1.21)
//! L = M v^c                              dL/dt = M a^c               W(1.18–1.19)
//! H = M r^c×v^c + Σ m r^{αc}×v^{αc}      dH/dt = M r^c×a^c + Σ m r^{αc}×a^{αc}    W(1.22–1.23)
//! E = ½M v^c·v^c + Σ ½m|v^{αc}|²         dE/dt = M v^c·a^c + Σ m v^{αc}·a^{αc}    W(1.24–1.25)
//! ```
//!
//! The parts relative to the centre of mass are summed relative to it, with compensation: far from the
//! origin (|r^c| ≫ spread) they would drown otherwise. That is why splits are returned as two parts; add
//! them with `total` only if the sum is what is wanted.
//!
//! # References
//! W(1.18–1.26).

use nalgebra::{Matrix3, Vector3};
use piola_numerics::Real;
use piola_numerics::sums::CompensatedSum;

use crate::error::{KinematicsError, length};
use crate::vector::{cross, dot, first_non_finite, scaled};

/// A system of particles in a state of motion: a view of the caller's data with its centre of mass.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_kinematics::ParticleSystem;
/// let positions = [Vector3::new(0.0, 0.0, 0.0), Vector3::new(4.0, 0.0, 0.0)];
/// let velocities = [Vector3::new(0.0, 0.0, 0.0), Vector3::new(0.0, 4.0, 0.0)];
/// let system = ParticleSystem::new(&[1.0, 3.0], &positions, &velocities)?;
/// assert_eq!(system.centre_of_mass().x, 3.0);
/// let energy = system.kinetic_energy();
/// assert_eq!((energy.of_centre_of_mass, energy.relative), (18.0, 6.0)); // ½·4·3², ½(1·3² + 3·1²)
/// # Ok::<(), piola_kinematics::KinematicsError>(())
/// ```
///
/// # Source
/// W(1.18–1.25).
#[derive(Clone, Copy, Debug)]
pub struct ParticleSystem<'a, T: Real = f64> {
    masses: &'a [f64],
    positions: &'a [Vector3<T>],
    velocities: &'a [Vector3<T>],
    mass: f64,
    position: Mean<T>,
    velocity: Mean<T>,
}

/// A mean in two parts, so that differences from it are as exact as the data.
#[derive(Clone, Copy, Debug)]
struct Mean<T: Real> {
    estimate: Vector3<T>,
    correction: Vector3<T>,
}

/// A quantity as the part of the centre of mass and the part relative to it.
///
/// # Example
/// ```
/// use piola_kinematics::system::Split;
/// assert_eq!(Split { of_centre_of_mass: 18.0, relative: 6.0 }.total(), 24.0);
/// ```
///
/// # Source
/// W(1.22), W(1.24): König's theorems.
#[doc(alias("Koenig", "König"))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Split<Q> {
    /// What the whole mass, moving with the centre of mass, would have.
    pub of_centre_of_mass: Q,
    /// What the motion relative to the centre of mass has.
    pub relative: Q,
}

impl<Q: core::ops::Add<Output = Q>> Split<Q> {
    /// The sum of both parts.
    pub fn total(self) -> Q {
        self.of_centre_of_mass + self.relative
    }
}

/// Rates of momentum, angular momentum about the origin, and kinetic energy.
///
/// # Example
/// See [`ParticleSystem::rates`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SystemRates<T: Real> {
    /// a^c (m/s²).
    pub acceleration_of_centre_of_mass: Vector3<T>,
    /// dL/dt (N).
    pub momentum: Vector3<T>,
    /// dH/dt (N m).
    pub angular_momentum: Split<Vector3<T>>,
    /// dE/dt (W).
    pub kinetic_energy: Split<T>,
}

/// The pair of particles whose distance changes most.
///
/// # Example
/// See [`largest_distance_change`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DistanceChange {
    /// Indices of the two particles, ascending.
    pub pair: (usize, usize),
    /// (new distance − old distance)/largest old distance.
    pub relative_change: f64,
}

impl<'a, T: Real> ParticleSystem<'a, T> {
    /// A system of particles with masses (kg), positions (m) and velocities (m/s) in space components.
    ///
    /// # Errors
    /// [`KinematicsError::NoParticles`]; [`KinematicsError::WrongLength`] for unequal lengths;
    /// [`KinematicsError::NonPositiveMass`]; [`KinematicsError::NotFinite`], with the index 3α + i of
    /// component i of particle α, from 0.
    pub fn new(
        masses: &'a [f64],
        positions: &'a [Vector3<T>],
        velocities: &'a [Vector3<T>],
    ) -> Result<Self, KinematicsError> {
        if masses.is_empty() {
            return Err(KinematicsError::NoParticles);
        }
        for (quantity, vectors) in [("positions", positions), ("velocities", velocities)] {
            check_vectors(quantity, masses.len(), vectors)?;
        }
        let mut mass = CompensatedSum::new();
        for &m in masses {
            crate::error::positive_mass(m)?;
            mass.add(m);
        }
        let mass = mass.value();
        let position = Mean::of(masses, mass, positions);
        let velocity = Mean::of(masses, mass, velocities);
        Ok(Self { masses, positions, velocities, mass, position, velocity })
    }

    /// M (kg).
    #[must_use]
    pub fn mass(&self) -> f64 {
        self.mass
    }

    /// r^c (m).
    #[doc(alias("center of mass", "barycentre", "centre of gravity"))]
    #[must_use]
    pub fn centre_of_mass(&self) -> Vector3<T> {
        self.position.rounded()
    }

    /// v^c (m/s).
    #[must_use]
    pub fn velocity_of_centre_of_mass(&self) -> Vector3<T> {
        self.velocity.rounded()
    }

    /// Position of a particle relative to the centre of mass, r^{αc} (m).
    ///
    /// # Errors
    /// [`KinematicsError::WrongLength`] when there is no such particle.
    ///
    /// # Accuracy
    /// A few ulps of itself, however far the system is from the origin.
    pub fn relative_position(&self, particle: usize) -> Result<Vector3<T>, KinematicsError> {
        match self.positions.get(particle) {
            Some(x) => Ok(self.position.to(x)),
            None => Err(KinematicsError::WrongLength {
                quantity: "particles",
                expected: particle.saturating_add(1),
                found: self.positions.len(),
            }),
        }
    }

    /// Momentum L = M v^c (kg m/s).
    ///
    /// # Source
    /// W(1.18).
    #[must_use]
    pub fn momentum(&self) -> Vector3<T> {
        scaled(&self.velocity.rounded(), T::lit(self.mass))
    }

    /// Angular momentum about a fixed point (kg m²/s): the relative part is that about the centre of mass.
    ///
    /// ```text
    /// H = M (r^c − o)×v^c + Σ m r^{αc}×v^{αc}
    /// ```
    ///
    /// # Source
    /// W(1.22).
    #[doc(alias = "moment of momentum")]
    #[must_use]
    pub fn angular_momentum(&self, about: &Vector3<T>) -> Split<Vector3<T>> {
        let relative = self.sum_vector(|index, m| {
            let r = self.position.to(&self.positions[index]);
            scaled(&cross(&r, &self.velocity.to(&self.velocities[index])), m)
        });
        let arm = self.position.to(about);
        let of_centre_of_mass = scaled(&cross(&self.velocity.rounded(), &arm), T::lit(self.mass));
        Split { of_centre_of_mass, relative }
    }

    /// Kinetic energy (J).
    ///
    /// ```text
    /// E = ½M v^c·v^c + Σ ½m|v^{αc}|²
    /// ```
    ///
    /// # Source
    /// W(1.24).
    #[must_use]
    pub fn kinetic_energy(&self) -> Split<T> {
        let relative = self.sum(|index, m| {
            let v = self.velocity.to(&self.velocities[index]);
            T::lit(0.5) * m * dot(&v, &v)
        });
        let v = self.velocity.rounded();
        Split { of_centre_of_mass: T::lit(0.5 * self.mass) * dot(&v, &v), relative }
    }

    /// Inertia tensor of the instantaneous configuration about the centre of mass (kg m², space components).
    ///
    /// # Source
    /// W(2.33).
    #[must_use]
    pub fn inertia_about_centre_of_mass(&self) -> Matrix3<T> {
        let relative = |index: usize| self.position.to(&self.positions[index]);
        let diagonal = self.sum_vector(|index, m| {
            let r = relative(index);
            let (xx, yy, zz) = (r.x * r.x, r.y * r.y, r.z * r.z);
            scaled(&Vector3::new(yy + zz, zz + xx, xx + yy), m)
        });
        let beside = self.sum_vector(|index, m| {
            let r = relative(index);
            scaled(&Vector3::new(r.y * r.z, r.z * r.x, r.x * r.y), -m)
        });
        let (d, b) = (diagonal, beside);
        Matrix3::new(d.x, b.z, b.y, b.z, d.y, b.x, b.y, b.x, d.z)
    }

    /// Rates of momentum, angular momentum about the fixed point `about`, and energy at given
    /// accelerations (m/s²).
    ///
    /// ```text
    /// dL/dt = M a^c    dH/dt = M (r^c − o)×a^c + Σ m r^{αc}×a^{αc}    dE/dt = M v^c·a^c + Σ m v^{αc}·a^{αc}
    /// ```
    ///
    /// # Errors
    /// [`KinematicsError::WrongLength`]; [`KinematicsError::NotFinite`].
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Vector3;
    /// # use piola_kinematics::ParticleSystem;
    /// let positions = [Vector3::<f64>::x(), -Vector3::x()];
    /// let at_rest = [Vector3::zeros(); 2];
    /// let system = ParticleSystem::new(&[2.0, 2.0], &positions, &at_rest)?;
    /// let rates = system.rates(&[Vector3::y(), -Vector3::y()], &Vector3::zeros())?;
    /// assert_eq!(rates.angular_momentum.relative.z, 4.0);
    /// # Ok::<(), piola_kinematics::KinematicsError>(())
    /// ```
    ///
    /// # Source
    /// W(1.19), W(1.23), W(1.25).
    pub fn rates(&self, accelerations: &[Vector3<T>], about: &Vector3<T>) -> Result<SystemRates<T>, KinematicsError> {
        check_vectors("accelerations", self.masses.len(), accelerations)?;
        let acceleration = Mean::of(self.masses, self.mass, accelerations);
        let turning = self.sum_vector(|index, m| {
            let r = self.position.to(&self.positions[index]);
            scaled(&cross(&r, &acceleration.to(&accelerations[index])), m)
        });
        let power = self.sum(|index, m| {
            let v = self.velocity.to(&self.velocities[index]);
            m * dot(&v, &acceleration.to(&accelerations[index]))
        });
        let a = acceleration.rounded();
        let mass = T::lit(self.mass);
        Ok(SystemRates {
            acceleration_of_centre_of_mass: a,
            momentum: scaled(&a, mass),
            angular_momentum: Split {
                of_centre_of_mass: scaled(&cross(&a, &self.position.to(about)), mass),
                relative: turning,
            },
            kinetic_energy: Split { of_centre_of_mass: mass * dot(&self.velocity.rounded(), &a), relative: power },
        })
    }

    fn sum(&self, mut term: impl FnMut(usize, T) -> T) -> T {
        let mut sum = CompensatedSum::new();
        for (index, &mass) in self.masses.iter().enumerate() {
            sum.add(term(index, T::lit(mass)));
        }
        sum.value()
    }

    fn sum_vector(&self, term: impl FnMut(usize, T) -> Vector3<T>) -> Vector3<T> {
        sum_vectors(self.masses, term)
    }
}

impl<T: Real> Mean<T> {
    /// Σ m x / M: first the plain mean, then the mean of the differences from it.
    fn of(masses: &[f64], mass: f64, vectors: &[Vector3<T>]) -> Self {
        let share = T::lit(mass.recip());
        let estimate = scaled(&sum_vectors(masses, |index, m| scaled(&vectors[index], m)), share);
        let correction = scaled(&sum_vectors(masses, |index, m| scaled(&(vectors[index] - estimate), m)), share);
        Self { estimate, correction }
    }
    /// x − mean.
    fn to(&self, x: &Vector3<T>) -> Vector3<T> {
        (x - self.estimate) - self.correction
    }
    fn rounded(&self) -> Vector3<T> {
        self.estimate + self.correction
    }
}

fn sum_vectors<T: Real>(masses: &[f64], mut term: impl FnMut(usize, T) -> Vector3<T>) -> Vector3<T> {
    let mut sums = [CompensatedSum::new(); 3];
    for (index, &mass) in masses.iter().enumerate() {
        let vector = term(index, T::lit(mass));
        sums[0].add(vector.x);
        sums[1].add(vector.y);
        sums[2].add(vector.z);
    }
    let [x, y, z] = sums.map(CompensatedSum::value);
    Vector3::new(x, y, z)
}

fn check_vectors<T: Real>(
    quantity: &'static str,
    expected: usize,
    vectors: &[Vector3<T>],
) -> Result<(), KinematicsError> {
    length(quantity, vectors.len(), expected)?;
    for (particle, vector) in vectors.iter().enumerate() {
        if let Some((component, value)) = first_non_finite(vector.as_slice()) {
            return Err(KinematicsError::NotFinite { quantity, index: 3 * particle + component, value });
        }
    }
    Ok(())
}

/// The pair of particles whose distance differs most between two configurations: a system moves rigidly
/// when this is zero to rounding. `None` for a single particle. Takes n²/2 steps.
///
/// # Errors
/// [`KinematicsError::NoParticles`]; [`KinematicsError::WrongLength`]; [`KinematicsError::NotFinite`].
///
/// # Accuracy
/// ε |x|/largest distance: absolute positions limit it.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_kinematics::system::largest_distance_change;
/// let before = [Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)];
/// let after = [Vector3::zeros(), Vector3::new(0.0, 3.0, 0.0)];
/// let change = largest_distance_change(&before, &after)?.map(|c| (c.pair, c.relative_change));
/// assert_eq!(change, Some(((0, 1), 0.5)));
/// # Ok::<(), piola_kinematics::KinematicsError>(())
/// ```
///
/// # Source
/// W(1.26).
pub fn largest_distance_change(
    before: &[Vector3<f64>],
    after: &[Vector3<f64>],
) -> Result<Option<DistanceChange>, KinematicsError> {
    if before.is_empty() {
        return Err(KinematicsError::NoParticles);
    }
    check_vectors("positions before", before.len(), before)?;
    check_vectors("positions after", before.len(), after)?;
    let mut largest_distance = 0.0_f64;
    let mut most: Option<DistanceChange> = None;
    for j in 1..before.len() {
        for i in 0..j {
            let distance = (before[j] - before[i]).norm();
            largest_distance = largest_distance.max(distance);
            let change = (after[j] - after[i]).norm() - distance;
            if most.is_none_or(|most| most.relative_change.abs() < change.abs()) {
                most = Some(DistanceChange { pair: (i, j), relative_change: change });
            }
        }
    }
    Ok(most.map(|change| {
        // All particles in one place: any change is infinite on that scale, none is zero.
        let relative_change =
            if change.relative_change.abs() <= 0.0 { 0.0 } else { change.relative_change / largest_distance };
        DistanceChange { relative_change, ..change }
    }))
}
