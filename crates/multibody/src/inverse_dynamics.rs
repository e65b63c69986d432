//! Inverse dynamics: the generalised forces of given accelerations, by the recursion of Newton and Euler.
//!
//! ```text
//! outwards   ω, α, a of each link's origin (see the elementary joints), a = −g on the ground
//!            f = m a + U h          n = h × a + I α + ω × I ω          U = [α]× + [ω]×²,  h = m c
//! inwards    τ = Sᵀ (n, f) + armature v̇          the parent gets (R n + r × R f, R f)
//! ```
//!
//! With angular velocities and the accelerations of origins in place of spatial velocities, no velocity of an origin is
//! needed.
//!
//! # References
//! J. Y. S. Luh, M. W. Walker & R. P. C. Paul, *On-line computational scheme for mechanical manipulators*, J. Dyn. Syst.
//! Meas. Control 102 (1980) 69; R. Featherstone, *Rigid Body Dynamics Algorithms*, chapter 5.

use piola_numerics::Real;

use crate::elementary::for_kind;
use crate::error::{MultibodyError, all_finite, check_finite, check_length};
use crate::link::{Elementary, Link, Pair, take};
use crate::spatial::{acceleration_gradient, add, cross, lit, lit_symmetric, scaled, sub, symmetric_times, times};
use crate::tree::{BodyIndex, RigidTree};
use crate::turn::{Turning, wrench_to_parent};
use crate::workspace::{LinkForces, TreeWorkspace};

/// A force and a moment that act on a body from outside.
///
/// # Example
/// A weight of 2 kg at 0.5 m on a horizontal arm needs −9.81 N m; lifted by 9.81 N, half of it.
/// ```
/// use piola_multibody::{AppliedWrench, BodyIndex, BodyInertia, JointKind, RigidTree, TreeJoint};
/// let mut builder = RigidTree::builder();
/// let hinge = TreeJoint::new("hinge", JointKind::Revolute { axis: [0.0, 1.0, 0.0] });
/// let bob = builder.attach(BodyIndex::GROUND, hinge, "bob", BodyInertia::particle(2.0, [0.5, 0.0, 0.0])?)?;
/// let tree = builder.build()?;
/// let lift = AppliedWrench::force_at(bob, [0.0, 0.0, 9.81], [0.5, 0.0, 0.0]);
/// let mut torque = [0.0_f64];
/// tree.inverse_dynamics_under(&mut tree.workspace(), &[0.0], &[0.0], &[0.0], &[lift], &mut torque)?;
/// assert!((torque[0] + 0.5 * 9.81).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AppliedWrench<T> {
    /// The body.
    pub body: BodyIndex,
    /// The moment about the origin of the body's frame, N m, in the body's axes.
    pub moment: [T; 3],
    /// The force, N, in the body's axes.
    pub force: [T; 3],
}

impl<T: Real> AppliedWrench<T> {
    /// A force (N) at a point of the body (m), both in the body's frame.
    #[must_use]
    pub fn force_at(body: BodyIndex, force: [T; 3], point: [T; 3]) -> Self {
        Self { body, moment: cross(point, force), force }
    }
}

impl RigidTree {
    /// The generalised forces τ of accelerations: inverse dynamics.
    ///
    /// ```text
    /// τ = M(q) v̇ + b(q, v)
    /// ```
    /// | symbol | argument | length | unit |
    /// |---|---|---|---|
    /// | q | `q` | [`coordinates`](Self::coordinates) | m, rad, unit quaternions |
    /// | v, v̇ | `v`, `a` | [`freedoms`](Self::freedoms) | m/s, rad/s and per second |
    /// | τ | `tau` | [`freedoms`](Self::freedoms) | N, N m |
    ///
    /// # Errors
    /// [`MultibodyError::WrongLength`], [`MultibodyError::NotFinite`], [`MultibodyError::NotUnitQuaternion`],
    /// [`MultibodyError::OtherWorkspace`].
    ///
    /// # Accuracy
    /// A few ulp of the largest terms that are summed, times the depth of the tree.
    #[doc(alias("RNEA", "computed torque"))]
    pub fn inverse_dynamics<T: Real>(
        &self,
        work: &mut TreeWorkspace<T>,
        q: &[T],
        v: &[T],
        a: &[T],
        tau: &mut [T],
    ) -> Result<(), MultibodyError> {
        self.inverse_dynamics_under(work, q, v, a, &[], tau)
    }

    /// [`inverse_dynamics`](Self::inverse_dynamics) under forces and moments from outside: τ = M v̇ + b − Σ Jᵀ f.
    ///
    /// # Errors
    /// Also [`MultibodyError::NoSuchIndex`].
    pub fn inverse_dynamics_under<T: Real>(
        &self,
        work: &mut TreeWorkspace<T>,
        q: &[T],
        v: &[T],
        a: &[T],
        wrenches: &[AppliedWrench<T>],
        tau: &mut [T],
    ) -> Result<(), MultibodyError> {
        self.check_state(work, q, v)?;
        check_length("a", self.freedoms, a.len())?;
        check_length("tau", self.freedoms, tau.len())?;
        pass_outwards(self, &mut work.forces, q, v, a);
        for wrench in wrenches {
            let (link, moment, force) = self.on_link(wrench)?;
            let state = &mut work.forces[link];
            state.moment = sub(state.moment, moment);
            state.force = sub(state.force, force);
        }
        pass_inwards(self, &mut work.forces, a, tau);
        if all_finite(tau) && self.has_unit_quaternions(q) {
            return Ok(());
        }
        self.explain(q, [("v", v), ("a", a)], ("tau", tau))
    }

    /// The forces that v̇ = 0 needs: b(q, v), with centrifugal, Coriolis and gravity forces.
    ///
    /// # Errors
    /// As [`inverse_dynamics`](Self::inverse_dynamics).
    #[doc(alias("nonlinear effects", "bias force"))]
    pub fn bias_forces<T: Real>(
        &self,
        work: &mut TreeWorkspace<T>,
        q: &[T],
        v: &[T],
        out: &mut [T],
    ) -> Result<(), MultibodyError> {
        let zero = core::mem::take(&mut work.column);
        let mut zero = zero;
        zero.fill(T::zero());
        let result = self.inverse_dynamics(work, q, v, &zero, out);
        work.column = zero;
        result
    }

    /// The forces that hold the tree at rest against gravity: b(q, 0).
    ///
    /// # Errors
    /// As [`inverse_dynamics`](Self::inverse_dynamics).
    pub fn gravity_forces<T: Real>(
        &self,
        work: &mut TreeWorkspace<T>,
        q: &[T],
        out: &mut [T],
    ) -> Result<(), MultibodyError> {
        let mut zero = core::mem::take(&mut work.column);
        zero.fill(T::zero());
        let result = self.inverse_dynamics(work, q, &zero, &zero, out);
        work.column = zero;
        result
    }

    /// Refuses a workspace and slices that do not fit.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn check_state<T: Real>(&self, work: &TreeWorkspace<T>, q: &[T], v: &[T]) -> Result<(), MultibodyError> {
        self.check_workspace(work)?;
        check_length("q", self.coordinates, q.len())?;
        check_length("v", self.freedoms, v.len())
    }

    /// The reason why a result is not finite or a quaternion is wrong.
    #[cold]
    pub(crate) fn explain<T: Real>(
        &self,
        q: &[T],
        given: [(&'static str, &[T]); 2],
        result: (&'static str, &[T]),
    ) -> Result<(), MultibodyError> {
        check_finite("q", q)?;
        for (quantity, values) in given {
            check_finite(quantity, values)?;
        }
        self.check_quaternions(q)?;
        check_finite(result.0, result.1)
    }

    /// The state of the link with the wrench in its frame.
    pub(crate) fn on_link<T: Real>(
        &self,
        wrench: &AppliedWrench<T>,
    ) -> Result<(usize, [T; 3], [T; 3]), MultibodyError> {
        check_finite("moment", &wrench.moment)?;
        check_finite("force", &wrench.force)?;
        let body = self.mounted(wrench.body)?;
        let axes = crate::spatial::lit_matrix(body.axes);
        let force = times(axes, wrench.force);
        let moment = add(times(axes, wrench.moment), cross(lit(body.origin), force));
        Ok((body.link, moment, force))
    }
}

/// Accelerations of the links, and the forces that they need.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn pass_outwards<T: Real>(tree: &RigidTree, states: &mut [LinkForces<T>], q: &[T], v: &[T], a: &[T]) {
    states[0].a = lit([-tree.gravity[0], -tree.gravity[1], -tree.gravity[2]]);
    for (i, link) in tree.links.iter().enumerate() {
        for_kind!(link.kind, outwards::<T>(link, i + 1, states, q, v, a));
    }
}

/// Forces of the joints from the tips to the ground.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn pass_inwards<T: Real>(tree: &RigidTree, states: &mut [LinkForces<T>], a: &[T], tau: &mut [T]) {
    for (i, link) in tree.links.iter().enumerate().rev() {
        for_kind!(link.kind, inwards::<T>(link, i + 1, states, &tree.armature, a, tau));
    }
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn outwards<T: Real, E: Elementary<T, N>, const N: usize>(
    link: &Link,
    state: usize,
    states: &mut [LinkForces<T>],
    q: &[T],
    v: &[T],
    a: &[T],
) {
    outwards_from::<T, E, N>(link, state, states, E::place(link, q), v, a);
}

/// Outwards again, where the joint may stand as it did.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn outwards_again<T: Real, E: Elementary<T, N>, const N: usize>(
    link: &Link,
    state: usize,
    states: &mut [LinkForces<T>],
    is_placed: bool,
    (q, v, a): (&[T], &[T], &[T]),
) {
    let child = &states[state];
    let place = if is_placed { (E::Turn::recall(&child.turn), child.origin) } else { E::place(link, q) };
    outwards_from::<T, E, N>(link, state, states, place, v, a);
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn outwards_from<T: Real, E: Elementary<T, N>, const N: usize>(
    link: &Link,
    state: usize,
    states: &mut [LinkForces<T>],
    (turn, origin): (E::Turn, [T; 3]),
    v: &[T],
    a: &[T],
) {
    let (rate, second_rate) = (take::<T, N>(v, link.v), take::<T, N>(a, link.v));
    let parent = &states[link.parent];
    let from_parent = turn.to_child(parent.w);
    let mut w = from_parent;
    E::add_angular(link, rate, &mut w);
    let mut alpha = turn.to_child(parent.alpha);
    let mut linear = turn.to_child(add(parent.a, times(parent.gradient, origin)));
    E::add_bias(link, from_parent, w, rate, &mut alpha, &mut linear);
    E::add_angular(link, second_rate, &mut alpha);
    E::add_linear(link, second_rate, &mut linear);
    let gradient = acceleration_gradient(w, alpha);
    let h = lit(link.moment);
    let inertia = lit_symmetric(link.inertia);
    let child = &mut states[state];
    turn.keep(&mut child.turn);
    child.force = add(scaled(T::lit(link.mass), linear), times(gradient, h));
    child.moment = add(add(cross(h, linear), symmetric_times(inertia, alpha)), cross(w, symmetric_times(inertia, w)));
    child.origin = origin;
    child.w = w;
    child.alpha = alpha;
    child.a = linear;
    child.gradient = gradient;
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn inwards<T: Real, E: Elementary<T, N>, const N: usize>(
    link: &Link,
    state: usize,
    states: &mut [LinkForces<T>],
    armature: &[f64],
    a: &[T],
    tau: &mut [T],
) {
    let (moment, force) = felt::<T, E, N>(link, &states[state], armature, a, tau);
    if link.parent != 0 {
        let parent = &mut states[link.parent];
        parent.force = add(parent.force, force);
        parent.moment = add(parent.moment, moment);
    }
}

/// Writes the forces of a joint; what its parent feels.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn felt<T: Real, E: Elementary<T, N>, const N: usize>(
    link: &Link,
    child: &LinkForces<T>,
    armature: &[f64],
    a: &[T],
    tau: &mut [T],
) -> Pair<T> {
    let efforts = E::project(link, child.moment, child.force);
    let mut k = 0;
    while k < N {
        tau[link.v + k] = efforts[k] + T::lit(armature[link.v + k]) * a[link.v + k];
        k += 1;
    }
    wrench_to_parent(E::Turn::recall(&child.turn), child.origin, (child.moment, child.force))
}
