//! Momentum and angular momentum of all parts, in space.
//!
//! ```text
//! L = Σ m v + Σ M v^c        H = Σ (x − o)×m v + Σ ((x^c − o)×M v^c + Iω)                      W(1.18), W(2.35), W(4.6)
//! ```
//!
//! Not to be mistaken for the generalised momenta ∂L/∂q̇: [`Lagrangian::momenta`].

use nalgebra::Vector3;
use piola_kinematics::{Attitude, Holonomic, Placement, RigidBody};
use piola_numerics::{Dual, Real};

use super::collect::{cross, inertia_times, turning};
use super::workspace::Workspace;
use super::{Forces, Lagrangian, Potential};
use crate::LagrangianError;
use crate::check::{check_finite, check_length};

/// Momentum and angular momentum, space components.
///
/// # Example
/// See [`Lagrangian`].
///
/// # Source
/// W(1.18), W(2.35).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        deny_unknown_fields,
        bound(serialize = "T: Real + serde::Serialize", deserialize = "T: Real + serde::Deserialize<'de>")
    )
)]
pub struct SystemMomentum<T: Real = f64> {
    /// Σ m v, kg m/s.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::written::finite_vector"))]
    pub momentum: Vector3<T>,
    /// Σ (x − o)×m v + Iω, kg m²/s.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::written::finite_vector"))]
    #[doc(alias = "moment of momentum")]
    pub angular_momentum: Vector3<T>,
}

struct Sums<T> {
    about: [T; 3],
    momentum: [T; 3],
    moment: [T; 3],
}

impl<T: Real> Placement<Dual<T>> for Sums<T> {
    fn particle(&mut self, mass: f64, x: Vector3<Dual<T>>) {
        let x = [x.x, x.y, x.z];
        let momentum = x.map(|x| T::lit(mass) * x.tangent);
        let arm = core::array::from_fn(|k| x[k].value - self.about[k]);
        let moment = cross(arm, momentum);
        for k in 0..3 {
            self.momentum[k] += momentum[k];
            self.moment[k] += moment[k];
        }
    }
    fn body(&mut self, body: &RigidBody, centre: Vector3<Dual<T>>, attitude: Attitude<Dual<T>>) {
        self.particle(body.mass(), centre);
        let quaternion = [attitude.w, attitude.x, attitude.y, attitude.z];
        let q = quaternion.map(|q| q.value);
        let spin = inertia_times(body, turning(q, quaternion.map(|q| q.tangent)));
        let [w, x, y, z] = q;
        let spin = Attitude { w, x, y, z }.to_space(&spin.into());
        for k in 0..3 {
            self.moment[k] += spin[k];
        }
    }
}

impl<S: Holonomic, P: Potential, F: Forces> Lagrangian<S, P, F> {
    /// The momentum of all parts, and their angular momentum about a fixed point.
    ///
    /// | symbol | argument | shape | unit |
    /// |---|---|---|---|
    /// | q, q̇, t | `q`, `v`, `t` | n, n, scalar | the coordinates' own, s |
    /// | o | `about` | 3 | m |
    /// | L | returned | 3 | kg m/s |
    /// | H | returned | 3 | kg m²/s |
    ///
    /// Their rates are the sums of all forces and of all moments about the point: weights, applied forces and
    /// reactions.
    ///
    /// # Errors
    /// [`LagrangianError::WrongLength`], [`LagrangianError::NotFinite`].
    ///
    /// # Source
    /// W(1.18), W(2.35), W(4.6).
    #[doc(alias = "moment of momentum")]
    pub fn system_momentum<T: Real>(
        &self,
        q: &[T],
        v: &[T],
        t: T,
        about: &Vector3<T>,
    ) -> Result<SystemMomentum<T>, LagrangianError> {
        self.system_momentum_with(&mut Workspace::default(), q, v, t, about)
    }

    /// [`system_momentum`](Self::system_momentum) without allocation once `work` has been used.
    ///
    /// # Errors
    /// [`LagrangianError::WrongLength`], [`LagrangianError::NotFinite`].
    pub fn system_momentum_with<T: Real>(
        &self,
        work: &mut Workspace<T>,
        q: &[T],
        v: &[T],
        t: T,
        about: &Vector3<T>,
    ) -> Result<SystemMomentum<T>, LagrangianError> {
        check_length("q̇", q.len(), v.len())?;
        work.duals.clear();
        work.duals.extend(q.iter().zip(v).map(|(&q, &v)| Dual::new(q, v)));
        let time = if S::TIME_DEPENDENT { Dual::variable(t) } else { Dual::constant(t) };
        let zero = [T::zero(); 3];
        let mut sums = Sums { about: (*about).into(), momentum: zero, moment: zero };
        self.system.place(&work.duals, time, &mut sums);
        check_finite("about", &sums.about)?;
        self.finite([("q", q), ("q̇", v)], t, ("momentum", &sums.momentum))?;
        self.finite([("q", q), ("q̇", v)], t, ("angular momentum", &sums.moment))?;
        Ok(SystemMomentum { momentum: sums.momentum.into(), angular_momentum: sums.moment.into() })
    }
}
