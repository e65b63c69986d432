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
use piola_numerics::{Dual, Jet, Real};

use crate::attitude::Attitude;
use crate::error::{KinematicsError, finite, length};
use crate::particle::Motion;
use crate::placement::{Holonomic, PartCount, Placement};
use crate::rigid_body::{BodyMotion, BodyPose, BodyVelocity, RigidBody};
use crate::vector::first_non_finite;

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
    #[must_use]
    pub fn new(coordinates: usize) -> Self {
        Self { duals: vec![Dual::constant(T::zero()); coordinates], jets: vec![Jet::constant(T::zero()); coordinates] }
    }

    /// Number of generalised coordinates.
    #[must_use]
    pub fn coordinates(&self) -> usize {
        self.duals.len()
    }

    /// Where the parts are at q (m or rad) and t (s).
    ///
    /// # Errors
    /// [`KinematicsError::WrongLength`] when `q` or a buffer has the wrong length;
    /// [`KinematicsError::NotFinite`] when q, t or a resulting position is not finite.
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
    /// # Source
    /// W(3.7–3.13), W(3.28–3.31).
    pub fn velocities_into<S: Holonomic>(
        &mut self,
        system: &S,
        q: &[T],
        v: &[T],
        t: T,
        particles: &mut [Vector3<T>],
        bodies: &mut [BodyVelocity<T>],
    ) -> Result<(), KinematicsError> {
        self.check(&[("coordinates", q), ("generalised velocities", v)], t)?;
        for ((seed, &q), &v) in self.duals.iter_mut().zip(q).zip(v) {
            *seed = Dual::new(q, v);
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
    /// # Source
    /// W(3.7–3.13), W(3.28–3.31), differentiated.
    #[expect(clippy::too_many_arguments, reason = "the state and its derivatives, and two kinds of parts")]
    pub fn motions_into<S: Holonomic>(
        &mut self,
        system: &S,
        q: &[T],
        v: &[T],
        a: &[T],
        t: T,
        particles: &mut [Motion<T>],
        bodies: &mut [BodyMotion<T>],
    ) -> Result<(), KinematicsError> {
        self.check(&[("coordinates", q), ("generalised velocities", v), ("generalised accelerations", a)], t)?;
        for (index, seed) in self.jets.iter_mut().enumerate() {
            *seed = Jet { value: q[index], partials: [], rate: v[index], second_rate: a[index] };
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
            length(quantity, values.len(), self.coordinates())?;
            finite(quantity, values)?;
        }
        finite("t", &[t])
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
            if let (None, Some((_, value))) = (self.first_bad, first_non_finite(&[(self.key)(*x)])) {
                self.first_bad = Some((quantity, index, value));
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
    length("particle buffer", room.particles, placed.particles)?;
    length("body buffer", room.bodies, placed.bodies)?;
    match collector.first_bad {
        Some((quantity, index, value)) => Err(KinematicsError::NotFinite { quantity, index, value }),
        None => Ok(()),
    }
}
