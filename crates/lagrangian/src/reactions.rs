//! Reactions: the forces by which a constraint holds its particles and bodies.
//!
//! ```text
//! f_c = m a − f_e        F_c = M a^c − F_e        G_c = I ω̇ + ω×Iω − G_e                      W(5.1–5.3)
//! ```
//!
//! The external part is what is known of every part: uniform gravity and the applied forces and moments. A
//! potential V(q, q̇, t) and generalised forces Q_Δ are known by their work alone, not by the parts on which they
//! act: reactions therefore hold what they do too. State a spring as a force on parts where it is to be told
//! from the constraint.

use nalgebra::Vector3;
use piola_kinematics::{Attitude, Holonomic};
use piola_numerics::{Mask, Real};

use super::workspace::Workspace;
use super::{Forces, Lagrangian, Potential};
use crate::LagrangianError;
use crate::check::{check_finite, check_length};

/// A force and a moment on one part.
///
/// On a particle the moment is zero and plays no role; on a body the force acts at the centre of mass.
///
/// # Example
/// See [`Lagrangian::virtual_work`].
///
/// # Source
/// W(5.1–5.3).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        deny_unknown_fields,
        bound(serialize = "T: Real + serde::Serialize", deserialize = "T: Real + serde::Deserialize<'de>")
    )
)]
pub struct PartForce<T: Real = f64> {
    /// N, space components.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::written::finite_vector"))]
    pub force: Vector3<T>,
    /// N m, about the centre of mass, body components.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::written::finite_vector"))]
    pub moment: Vector3<T>,
}

impl<T: Real> PartForce<T> {
    /// A force without moment.
    pub fn force(force: [T; 3]) -> Self {
        Self { force: force.into(), moment: [T::zero(); 3].into() }
    }
}

/// The reaction on one part.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_lagrangian::Reaction;
/// let held = Reaction::Particle { position: Vector3::new(2.0, 0.0, 0.0), force: Vector3::new(0.0, 0.0, 5.0) };
/// // r × f about the origin: −x f_z along y.
/// assert_eq!(held.moment_about(&Vector3::zeros()), Vector3::new(0.0, -10.0, 0.0));
///
/// // A body turned by a half turn about z: its x axis points to −x.
/// use piola_kinematics::Attitude;
/// let attitude = Attitude { w: 0.0, x: 0.0, y: 0.0, z: 1.0 };
/// let (position, force) = (Vector3::zeros(), Vector3::new(0.0, 0.0, 5.0));
/// let held = Reaction::Body { position, attitude, force, moment: Vector3::new(3.0, 0.0, 0.0) };
/// assert_eq!((held.force().z, held.moment_in_body().x, held.moment_in_space().x), (5.0, 3.0, -3.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(tag = "part", rename_all = "snake_case", deny_unknown_fields))]
#[cfg_attr(
    feature = "serde",
    serde(bound(serialize = "T: Real + serde::Serialize", deserialize = "T: Real + serde::Deserialize<'de>"))
)]
pub enum Reaction<T: Real = f64> {
    /// On a particle.
    Particle {
        /// Where it is, m.
        #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::written::finite_vector"))]
        position: Vector3<T>,
        /// f_c, N, space components.
        #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::written::finite_vector"))]
        force: Vector3<T>,
    },
    /// On a body.
    Body {
        /// The centre of mass, m.
        #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::written::finite_vector"))]
        position: Vector3<T>,
        /// Body → space.
        attitude: Attitude<T>,
        /// F_c at the centre of mass, N, space components.
        #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::written::finite_vector"))]
        force: Vector3<T>,
        /// G_c about the centre of mass, N m, body components.
        #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::written::finite_vector"))]
        moment: Vector3<T>,
    },
}

impl<T: Real> Reaction<T> {
    /// No force on a particle at the origin: what buffers are filled with.
    #[must_use]
    pub fn none() -> Self {
        let zero: Vector3<T> = [T::zero(); 3].into();
        Self::Particle { position: zero, force: zero }
    }

    /// Where the force acts: the particle or the centre of mass, m.
    #[must_use]
    pub const fn position(&self) -> &Vector3<T> {
        match self {
            Self::Particle { position, .. } | Self::Body { position, .. } => position,
        }
    }

    /// f_c or F_c, N, space components.
    ///
    /// # Source
    /// W(5.1–5.2).
    #[must_use]
    pub const fn force(&self) -> &Vector3<T> {
        match self {
            Self::Particle { force, .. } | Self::Body { force, .. } => force,
        }
    }

    /// G_c about the centre of mass, N m, body components; zero for a particle.
    ///
    /// # Source
    /// W(5.3).
    #[must_use]
    pub fn moment_in_body(&self) -> Vector3<T> {
        match self {
            Self::Particle { .. } => [T::zero(); 3].into(),
            Self::Body { moment, .. } => *moment,
        }
    }

    /// G_c about the centre of mass, N m, space components; zero for a particle.
    ///
    /// # Source
    /// W(5.3).
    #[must_use]
    pub fn moment_in_space(&self) -> Vector3<T> {
        match self {
            Self::Particle { .. } => [T::zero(); 3].into(),
            Self::Body { attitude, moment, .. } => attitude.to_space(moment),
        }
    }

    /// The moment about a point fixed in space, N m, space components: (x − o)×f_c + G_c.
    ///
    /// # Source
    /// W(4.6).
    #[must_use]
    pub fn moment_about(&self, point: &Vector3<T>) -> Vector3<T> {
        let arm = self.position() - point;
        let of_force = super::collect::cross(arm.into(), (*self.force()).into());
        self.moment_in_space() + Vector3::from(of_force)
    }

    /// A component that is not finite.
    fn first_non_finite(&self) -> Option<f64> {
        let moment = self.moment_in_body();
        let lanes = self.force().iter().chain(&moment).find(|x| !x.is_finite().all())?;
        (0..T::LANES).map(|lane| lanes.primal(lane)).find(|x| !x.is_finite())
    }
}

impl<T: Real> From<Reaction<T>> for PartForce<T> {
    fn from(reaction: Reaction<T>) -> Self {
        Self { force: *reaction.force(), moment: reaction.moment_in_body() }
    }
}

impl<S: Holonomic, P: Potential, F: Forces> Lagrangian<S, P, F> {
    /// The reactions on all parts, in the order of placement, along the motion that Lagrange's equations give.
    ///
    /// ```text
    /// f_c = m a − f_e        F_c = M a^c − F_e        G_c = I ω̇ + ω×Iω − G_e
    /// ```
    ///
    /// | symbol | argument | shape | unit |
    /// |---|---|---|---|
    /// | q, q̇ | `q`, `v` | n | the coordinates' own |
    /// | t | `t` | scalar | s |
    /// | f_c, F_c | returned, space components | 3 each | N |
    /// | G_c | returned, about the centre of mass | 3 each | N m |
    ///
    /// A placement that depends on time gives the force of the moving constraint.
    ///
    /// # Errors
    /// As [`acceleration`](Self::acceleration).
    ///
    /// # Accuracy
    /// A few ulp of the largest of m a and f_e, times the condition number of the metric scaled to unit diagonal.
    ///
    /// # Example
    /// A pendulum of 3 kg passes its lowest point: the rod holds its weight and bends its path.
    /// ```
    /// # use nalgebra::Vector3;
    /// # use piola_lagrangian::{Holonomic, Lagrangian, Placement, Workspace};
    /// # use piola_numerics::Real;
    /// struct Pendulum; // 3 kg on 2 m
    /// impl Holonomic for Pendulum {
    ///     fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
    ///         let (s, c) = q[0].sin_cos();
    ///         bodies.particle(3.0, Vector3::new(T::lit(2.0) * s, T::zero(), T::lit(-2.0) * c));
    ///     }
    /// }
    /// let pendulum = Lagrangian::of(Pendulum).with_gravity(10.0);
    /// let reactions = pendulum.reactions(&[0.0], &[4.0], 0.0)?;
    /// assert_eq!(reactions[0].force(), &Vector3::new(0.0, 0.0, 126.0)); // m g + m l q̇² = 30 + 96
    /// // The same, driven with q̈ = 1 rad/s²: m l q̈ along x.
    /// let mut held = [reactions[0]; 1];
    /// pendulum.reactions_at_acceleration_into(&mut Workspace::default(), &[0.0], &[4.0], &[1.0], 0.0, &mut held)?;
    /// assert_eq!(held[0].force(), &Vector3::new(6.0, 0.0, 126.0));
    /// # Ok::<(), piola_lagrangian::LagrangianError>(())
    /// ```
    ///
    /// # Source
    /// W(5.1–5.3).
    pub fn reactions<T: Real>(&self, q: &[T], v: &[T], t: T) -> Result<Vec<Reaction<T>>, LagrangianError> {
        let mut out = vec![Reaction::none(); self.parts(q, t)];
        self.reactions_into(&mut Workspace::default(), q, v, t, &mut out)?;
        Ok(out)
    }

    /// The number of particles and bodies.
    pub fn parts<T: Real>(&self, q: &[T], t: T) -> usize {
        let count = piola_kinematics::placement::count(&self.system, q, t);
        count.particles + count.bodies
    }

    /// [`reactions`](Self::reactions) to the caller's memory, without allocation once `work` has been used.
    ///
    /// # Errors
    /// As [`acceleration`](Self::acceleration); [`LagrangianError::WrongLength`] when `out` does not have one
    /// place for each [part](Self::parts).
    pub fn reactions_into<T: Real>(
        &self,
        work: &mut Workspace<T>,
        q: &[T],
        v: &[T],
        t: T,
        out: &mut [Reaction<T>],
    ) -> Result<(), LagrangianError> {
        self.with_acceleration(work, q, v, t, |work, a| self.reactions_at_acceleration_into(work, q, v, a, t, out))
    }

    /// The reactions along any motion, given as (q, q̇, q̈): what the constraint and the drives must do so that it
    /// happens.
    ///
    /// # Errors
    /// [`LagrangianError::WrongLength`]; [`LagrangianError::NotFinite`], which names the part where an applied
    /// force is not finite.
    pub fn reactions_at_acceleration_into<T: Real>(
        &self,
        work: &mut Workspace<T>,
        q: &[T],
        v: &[T],
        a: &[T],
        t: T,
        out: &mut [Reaction<T>],
    ) -> Result<(), LagrangianError> {
        let mut places = out.iter_mut();
        let mut first_bad = None;
        let parts = self.tour(work, (q, v, a), t, |part, state| {
            let (position, force) = (state.position.into(), state.reaction().into());
            let reaction = match state.turning {
                None => Reaction::Particle { position, force },
                Some(turning) => {
                    let moment = turning.reaction().into();
                    Reaction::Body { position, attitude: turning.attitude, force, moment }
                }
            };
            first_bad = first_bad.or(reaction.first_non_finite().map(|value| (part, value)));
            if let Some(place) = places.next() {
                *place = reaction;
            }
        })?;
        check_length("reactions", parts, out.len())?;
        let Some((index, value)) = first_bad else { return Ok(()) };
        self.check_given([("q", q), ("q̇", v)], t)?;
        check_finite("q̈", a)?;
        Err(LagrangianError::NotFinite { quantity: "reactions", index, value })
    }
}
