//! Positions, velocities, accelerations and tangent vectors of the parts of a holonomic system.
//!
//! ```text
//! v = h_Δ q̇^Δ + ∂x/∂t                                         W(3.7–3.13), W(3.28–3.31)
//! ω = ω_Δ q̇^Δ + ω_t,    ω_Δ = 2 q* ∂q/∂q^Δ (body components)
//! ```
//!
//! Each is one pass of the placement map over dual numbers or jets: exact to rounding. A system that does
//! not depend on time is placed at a constant time.

use nalgebra::Vector3;
use piola_numerics::{Dual, Jet, Mask, Real};

use crate::attitude::Attitude;
use crate::error::KinematicsError;
use crate::particle::Motion;
use crate::placement::{Holonomic, PartCount, Placement};
use crate::rigid_body::{BodyMotion, BodyPose, BodyVelocity, RigidBody};

/// Evaluates the placement of systems with a given number of coordinates, into the caller's buffers.
///
/// Holds the seeds of the coordinates, so that evaluations allocate nothing.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_kinematics::{Holonomic, Placement, particle::Motion, placement::PlacementEvaluator};
/// use piola_numerics::Real;
///
/// struct Pendulum { length: f64 }
/// impl Holonomic for Pendulum {
///     fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
///         let (s, c) = q[0].sin_cos();
///         let length = T::lit(self.length);
///         bodies.particle(1.0, Vector3::new(length * s, T::zero(), -length * c));
///     }
/// }
/// // At the lowest point with 3 rad/s on 2 m: v = 6 m/s, a = 3²·2 m/s² upwards.
/// let mut motion = [Motion::at_rest()];
/// PlacementEvaluator::new(1).motions_into(&Pendulum { length: 2.0 }, &[0.0], &[3.0], &[0.0], 0.0, &mut motion, &mut [])?;
/// assert_eq!((motion[0].velocity.x, motion[0].acceleration.z), (6.0, 18.0));
/// # Ok::<(), piola_kinematics::KinematicsError>(())
/// ```
///
/// # Source
/// W(3.2–3.13), W(3.24–3.31).
#[derive(Clone, Debug)]
pub struct PlacementEvaluator<T: Real = f64> {
    duals: Vec<Dual<T>>,
    jets: Vec<Jet<T, 0>>,
}

impl<T: Real> PlacementEvaluator<T> {
    /// An evaluator for systems of `coordinates` generalised coordinates. The only step that allocates.
    ///
    /// # Example
    /// See [`PlacementEvaluator`].
    #[must_use]
    pub fn new(coordinates: usize) -> Self {
        Self { duals: vec![Dual::constant(T::zero()); coordinates], jets: vec![Jet::constant(T::zero()); coordinates] }
    }

    /// Number of generalised coordinates.
    ///
    /// # Example
    /// ```
    /// # use piola_kinematics::placement::PlacementEvaluator;
    /// assert_eq!(PlacementEvaluator::<f64>::new(3).coordinates(), 3);
    /// ```
    #[must_use]
    pub fn coordinates(&self) -> usize {
        self.duals.len()
    }

    /// Where the parts are at q (m or rad) and t (s).
    ///
    /// # Errors
    /// [`KinematicsError::Count`] when `q` or a buffer has the wrong length;
    /// [`KinematicsError::NotFinite`] when q, t or a resulting position is not finite.
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Vector3;
    /// # use piola_kinematics::{Holonomic, Placement, placement::PlacementEvaluator};
    /// # use piola_numerics::Real;
    /// # struct Free;
    /// # impl Holonomic for Free {
    /// #     fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
    /// #         bodies.particle(1.0, Vector3::new(q[0], q[1], q[2]));
    /// #     }
    /// # }
    /// let mut position = [Vector3::zeros()];
    /// PlacementEvaluator::new(3).positions_into(&Free, &[1.0, 2.0, 3.0], 0.0, &mut position, &mut [])?;
    /// assert_eq!(position[0], Vector3::new(1.0, 2.0, 3.0));
    /// # Ok::<(), piola_kinematics::KinematicsError>(())
    /// ```
    ///
    /// # Source
    /// W(3.2), W(3.24).
    pub fn positions_into(
        &mut self,
        system: &impl Holonomic,
        q: &[T],
        t: T,
        particles: &mut [Vector3<T>],
        bodies: &mut [BodyPose<T>],
    ) -> Result<(), KinematicsError> {
        self.check(&[("coordinates", q)], t)?;
        let place = |particle: &mut Vector3<T>, position: Vector3<T>| *particle = position;
        let pose = |body: &mut BodyPose<T>, position: Vector3<T>, attitude: Attitude<T>| {
            *body = BodyPose { position, attitude };
        };
        collect(system, q, t, (particles, place), (bodies, pose), |x| x)
    }

    /// Velocities of the parts at generalised velocities q̇: ∂x/∂q^Δ q̇^Δ + ∂x/∂t, and ω in body components.
    ///
    /// # Errors
    /// As [`positions_into`](Self::positions_into).
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Vector3;
    /// # use piola_kinematics::{Holonomic, Placement, placement::PlacementEvaluator};
    /// # use piola_numerics::Real;
    /// /// A bead on a rod that turns with 3 rad/s; q = [distance].
    /// struct Bead;
    /// impl Holonomic for Bead {
    ///     const TIME_DEPENDENT: bool = true;
    ///     fn place<T: Real>(&self, q: &[T], t: T, bodies: &mut impl Placement<T>) {
    ///         let (s, c) = (T::lit(3.0) * t).sin_cos();
    ///         bodies.particle(1.0, Vector3::new(q[0] * c, q[0] * s, T::zero()));
    ///     }
    /// }
    /// let mut velocity = [Vector3::zeros()];
    /// PlacementEvaluator::new(1).velocities_into(&Bead, &[2.0], &[1.0], 0.0, &mut velocity, &mut [])?;
    /// assert_eq!(velocity[0], Vector3::new(1.0, 6.0, 0.0)); // along the rod, and ω r across
    /// # Ok::<(), piola_kinematics::KinematicsError>(())
    /// ```
    ///
    /// # Source
    /// W(3.7–3.13), W(3.28–3.31).
    pub fn velocities_into<S: Holonomic>(
        &mut self,
        system: &S,
        q: &[T],
        qdot: &[T],
        t: T,
        particles: &mut [Vector3<T>],
        bodies: &mut [BodyVelocity<T>],
    ) -> Result<(), KinematicsError> {
        self.check(&[("coordinates", q), ("generalised velocities", qdot)], t)?;
        for ((seed, &q), &qdot) in self.duals.iter_mut().zip(q).zip(qdot) {
            *seed = Dual::new(q, qdot);
        }
        let t = if S::TIME_DEPENDENT { Dual::variable(t) } else { Dual::constant(t) };
        self.tangents(system, t, particles, bodies)
    }

    /// The tangent vector `h_Δ` of a coordinate: ∂x/∂q^Δ of the particles, ∂x^c/∂q^Δ and `ω_Δ` of the bodies.
    ///
    /// A time-dependent system has one direction more, the time, after the coordinates: it gives ∂x/∂t.
    ///
    /// # Errors
    /// [`KinematicsError::NoSuchDirection`]; as [`positions_into`](Self::positions_into).
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Vector3;
    /// # use piola_kinematics::{BodyVelocity, Holonomic, Placement, Solid, placement::PlacementEvaluator};
    /// # use piola_kinematics::{Attitude, RigidBody};
    /// # use piola_numerics::Real;
    /// /// A wheel that rolls along x; q = [angle about y].
    /// struct Wheel { body: RigidBody, radius: f64 }
    /// impl Holonomic for Wheel {
    ///     fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
    ///         let centre = Vector3::new(T::lit(self.radius) * q[0], T::zero(), T::lit(self.radius));
    ///         bodies.body(&self.body, centre, Attitude::about_y(q[0]));
    ///     }
    /// }
    /// let wheel = Wheel { body: Solid::Sphere { radius: 2.0 }.body(1.0)?, radius: 2.0 };
    /// let mut tangent = [BodyVelocity::at_rest()];
    /// PlacementEvaluator::new(1).tangent_into(&wheel, &[0.0], 0.0, 0, &mut [], &mut tangent)?;
    /// assert_eq!((tangent[0].velocity.x, tangent[0].angular_velocity.y), (2.0, 1.0));
    /// # Ok::<(), piola_kinematics::KinematicsError>(())
    /// ```
    ///
    /// # Source
    /// W(3.4–3.5).
    pub fn tangent_into<S: Holonomic>(
        &mut self,
        system: &S,
        q: &[T],
        t: T,
        direction: usize,
        particles: &mut [Vector3<T>],
        bodies: &mut [BodyVelocity<T>],
    ) -> Result<(), KinematicsError> {
        self.check(&[("coordinates", q)], t)?;
        let directions = self.coordinates() + usize::from(S::TIME_DEPENDENT);
        if directions <= direction {
            return Err(KinematicsError::NoSuchDirection { direction, directions });
        }
        for (index, (seed, &q)) in self.duals.iter_mut().zip(q).enumerate() {
            *seed = if index == direction { Dual::variable(q) } else { Dual::constant(q) };
        }
        let along_time = direction == self.coordinates();
        let t = if along_time { Dual::variable(t) } else { Dual::constant(t) };
        self.tangents(system, t, particles, bodies)
    }

    /// Positions, velocities and accelerations of all parts at q, q̇, q̈ and t.
    ///
    /// # Errors
    /// As [`positions_into`](Self::positions_into).
    ///
    /// # Example
    /// See [`PlacementEvaluator`].
    ///
    /// # Source
    /// W(3.7–3.13), W(3.28–3.31), differentiated.
    #[expect(clippy::too_many_arguments, reason = "the state and its derivatives, and two kinds of parts")]
    pub fn motions_into<S: Holonomic>(
        &mut self,
        system: &S,
        q: &[T],
        qdot: &[T],
        qddot: &[T],
        t: T,
        particles: &mut [Motion<T>],
        bodies: &mut [BodyMotion<T>],
    ) -> Result<(), KinematicsError> {
        self.check(&[("coordinates", q), ("generalised velocities", qdot), ("generalised accelerations", qddot)], t)?;
        for (index, seed) in self.jets.iter_mut().enumerate() {
            *seed = Jet { value: q[index], partials: [], rate: qdot[index], second_rate: qddot[index] };
        }
        let t = if S::TIME_DEPENDENT { Jet::time(t) } else { Jet::constant(t) };
        let motion = |particle: &mut Motion<T>, position: Vector3<Jet<T, 0>>| *particle = Motion::from_jet(&position);
        let body_motion = |body: &mut BodyMotion<T>, position: Vector3<Jet<T, 0>>, attitude: Attitude<Jet<T, 0>>| {
            let position = Motion::from_jet(&position);
            let [value, rate, second_rate] = [
                <[Jet<T, 0>; 4]>::from(attitude).map(|x| x.value),
                <[Jet<T, 0>; 4]>::from(attitude).map(|x| x.rate),
                <[Jet<T, 0>; 4]>::from(attitude).map(|x| x.second_rate),
            ];
            let [w, x, y, z] = value;
            let attitude = Attitude { w, x, y, z };
            *body = BodyMotion {
                position: position.position,
                attitude,
                velocity: position.velocity,
                angular_velocity: attitude.angular_velocity_in_body(rate),
                acceleration: position.acceleration,
                // ω = 2 q* q̇, and q̇* q̇ has no vector part: ω̇ = 2 (q* q̈)_vector.
                angular_acceleration: attitude.angular_velocity_in_body(second_rate),
            };
        };
        collect(system, &self.jets, t, (particles, motion), (bodies, body_motion), |x| x.value)
    }

    fn tangents<S: Holonomic>(
        &self,
        system: &S,
        t: Dual<T>,
        particles: &mut [Vector3<T>],
        bodies: &mut [BodyVelocity<T>],
    ) -> Result<(), KinematicsError> {
        let tangent = |particle: &mut Vector3<T>, position: Vector3<Dual<T>>| *particle = position.map(|x| x.tangent);
        let body_tangent = |body: &mut BodyVelocity<T>, position: Vector3<Dual<T>>, attitude: Attitude<Dual<T>>| {
            let [w, x, y, z] = <[Dual<T>; 4]>::from(attitude);
            let value = Attitude { w: w.value, x: x.value, y: y.value, z: z.value };
            let rate = [w.tangent, x.tangent, y.tangent, z.tangent];
            *body = BodyVelocity {
                velocity: position.map(|x| x.tangent),
                angular_velocity: value.angular_velocity_in_body(rate),
            };
        };
        collect(system, &self.duals, t, (particles, tangent), (bodies, body_tangent), |x| x.tangent)
    }

    /// Lengths and finiteness of the state.
    fn check(&self, state: &[(&'static str, &[T])], t: T) -> Result<(), KinematicsError> {
        for &(quantity, values) in state {
            if values.len() != self.coordinates() {
                return Err(KinematicsError::Count { quantity, expected: self.coordinates(), found: values.len() });
            }
            if let Some(index) = values.iter().position(|x| !x.is_finite().all()) {
                return Err(KinematicsError::NotFinite { quantity, index, value: values[index].primal(0) });
            }
        }
        if !t.is_finite().all() {
            return Err(KinematicsError::NotFinite { quantity: "time", index: 0, value: t.primal(0) });
        }
        Ok(())
    }
}

/// Hands each placed part to the next slot of a buffer.
struct Collector<'a, U, P, F, B, G, K> {
    particles: core::slice::IterMut<'a, P>,
    bodies: core::slice::IterMut<'a, B>,
    on_particle: F,
    on_body: G,
    key: K,
    placed: PartCount,
    first_bad: Option<(&'static str, usize, f64)>,
    scalar: core::marker::PhantomData<U>,
}

impl<T, U, P, F, B, G, K> Collector<'_, U, P, F, B, G, K>
where
    T: Real,
    U: Real,
    K: Fn(U) -> T,
{
    /// Remembers the first position that is not finite.
    fn inspect(&mut self, quantity: &'static str, index: usize, position: &Vector3<U>) {
        for x in position.iter() {
            let x = (self.key)(*x);
            if self.first_bad.is_none() && !x.is_finite().all() {
                self.first_bad = Some((quantity, index, x.primal(0)));
            }
        }
    }
}

impl<T, U, P, F, B, G, K> Placement<U> for Collector<'_, U, P, F, B, G, K>
where
    T: Real,
    U: Real,
    F: Fn(&mut P, Vector3<U>),
    G: Fn(&mut B, Vector3<U>, Attitude<U>),
    K: Fn(U) -> T,
{
    fn particle(&mut self, _mass: f64, position: Vector3<U>) {
        self.inspect("placed particle", self.placed.particles, &position);
        self.placed.particles += 1;
        if let Some(slot) = self.particles.next() {
            (self.on_particle)(slot, position);
        }
    }
    fn body(&mut self, _body: &RigidBody, centre: Vector3<U>, attitude: Attitude<U>) {
        self.inspect("placed body", self.placed.bodies, &centre);
        self.placed.bodies += 1;
        if let Some(slot) = self.bodies.next() {
            (self.on_body)(slot, centre, attitude);
        }
    }
}

/// Places the system and writes each part to its slot; `key` is the number that must come out finite.
fn collect<T: Real, U: Real, P, B>(
    system: &impl Holonomic,
    q: &[U],
    t: U,
    (particles, on_particle): (&mut [P], impl Fn(&mut P, Vector3<U>)),
    (bodies, on_body): (&mut [B], impl Fn(&mut B, Vector3<U>, Attitude<U>)),
    key: impl Fn(U) -> T,
) -> Result<(), KinematicsError> {
    let room = PartCount { particles: particles.len(), bodies: bodies.len() };
    let mut collector = Collector {
        particles: particles.iter_mut(),
        bodies: bodies.iter_mut(),
        on_particle,
        on_body,
        key,
        placed: PartCount::default(),
        first_bad: None,
        scalar: core::marker::PhantomData,
    };
    system.place(q, t, &mut collector);
    let placed = collector.placed;
    for (quantity, expected, found) in
        [("particle buffer", placed.particles, room.particles), ("body buffer", placed.bodies, room.bodies)]
    {
        if expected != found {
            return Err(KinematicsError::Count { quantity, expected, found });
        }
    }
    match collector.first_bad {
        Some((quantity, index, value)) => Err(KinematicsError::NotFinite { quantity, index, value }),
        None => Ok(()),
    }
}
