//! Forward dynamics: the accelerations under given forces, by articulated bodies.
//!
//! ```text
//! outwards   ω, bias c of each link, p = (ω × I ω, ω × (ω × h))
//! inwards    U = 𝕀 S    D = Sᵀ U + armature    Y = U D⁻¹    u = τ − Sᵀ p
//!            the parent gets 𝕀 − Y Uᵀ and p + 𝕀 c + Y (u − Uᵀ c)
//! outwards   v̇ = D⁻¹ u − Yᵀ A'    A' = X A + c    A = A' + S v̇        A = (0, −g) on the ground
//! ```
//!
//! 𝕀 is the articulated inertia of a link: what force it needs to accelerate when the joints beyond it are free.
//!
//! # References
//! R. Featherstone, *Rigid Body Dynamics Algorithms*, chapter 7, here with accelerations of origins in place of spatial
//! accelerations.

use piola_numerics::{Mask, Real};

use crate::articulation::{inverse_of, moved_to_parent, reduce, sum, with_own};
use crate::elementary::for_kind;
use crate::error::{MultibodyError, all_finite, check_length};
use crate::inverse_dynamics::AppliedWrench;
use crate::link::{Articulated, Elementary, Link, Pair, take};
use crate::spatial::{add, cross, dot, lit, lit_symmetric, sub, symmetric_times};
use crate::tree::{BodyIndex, BodyInertia, RigidTree};
use crate::turn::{Turning, wrench_to_parent};
use crate::workspace::{LinkArticulation, TreeWorkspace};

impl RigidTree {
    /// The accelerations under generalised forces: forward dynamics, in time proportional to the links. It is the faster of both ways at
    /// every size that was measured, 1 to 100 freedoms (example `two_ways`).
    ///
    /// ```text
    /// v̇ = M(q)⁻¹ (τ − b(q, v))
    /// ```
    /// | symbol | argument | length | unit |
    /// |---|---|---|---|
    /// | q | `q` | [`coordinates`](Self::coordinates) | m, rad, unit quaternions |
    /// | v | `v` | [`freedoms`](Self::freedoms) | m/s, rad/s |
    /// | τ | `tau` | [`freedoms`](Self::freedoms) | N, N m |
    /// | v̇ | `out` | [`freedoms`](Self::freedoms) | m/s², rad/s² |
    ///
    /// # Errors
    /// [`MultibodyError::WrongLength`], [`MultibodyError::NotFinite`], [`MultibodyError::NotUnitQuaternion`], [`MultibodyError::OtherWorkspace`];
    /// [`MultibodyError::NoInertia`] or [`MultibodyError::TooLightBody`] unless every reduced inertia is positive.
    ///
    /// # Accuracy
    /// A few ulp times the condition number of the mass matrix: see the page on accuracy.
    #[doc(alias("ABA", "articulated body algorithm"))]
    pub fn forward_dynamics<T: Real>(
        &self,
        work: &mut TreeWorkspace<T>,
        q: &[T],
        v: &[T],
        tau: &[T],
        out: &mut [T],
    ) -> Result<(), MultibodyError> {
        self.forward_dynamics_under(work, q, v, tau, &[], out)
    }

    /// [`forward_dynamics`](Self::forward_dynamics) under forces and moments from outside.
    ///
    /// # Errors
    /// Also [`MultibodyError::NoSuchIndex`].
    pub fn forward_dynamics_under<T: Real>(
        &self,
        work: &mut TreeWorkspace<T>,
        q: &[T],
        v: &[T],
        tau: &[T],
        wrenches: &[AppliedWrench<T>],
        out: &mut [T],
    ) -> Result<(), MultibodyError> {
        self.check_state(work, q, v)?;
        check_length("tau", self.freedoms, tau.len())?;
        check_length("out", self.freedoms, out.len())?;
        pass_outwards(self, &mut work.articulation, q, v);
        for wrench in wrenches {
            let (link, moment, force) = self.on_link(wrench)?;
            // What acts on the ground moves nothing.
            if link != 0 {
                let needed = &mut work.articulation[link].needed;
                *needed = (sub(needed.0, moment), sub(needed.1, force));
            }
        }
        let is_positive = pass_inwards(self, work, tau, out);
        pass_accelerations(self, &mut work.articulation, &work.gains, out);
        if is_positive.all() && all_finite(out) && self.has_unit_quaternions(q) {
            return Ok(());
        }
        self.explain(q, [("v", v), ("tau", tau)], ("out", &[]))?;
        self.explain_inertia(work)?;
        self.explain(q, [("v", v), ("tau", tau)], ("out", out))
    }

    /// Names the joint whose reduced inertia is not positive.
    #[cold]
    pub(crate) fn explain_inertia<T: Real>(&self, work: &TreeWorkspace<T>) -> Result<(), MultibodyError> {
        // From the tips: the first one spoils those before it.
        for link in self.links.iter().rev() {
            let n = link.kind.freedoms();
            for k in 0..n {
                let inverse = work.inverses[link.square + k * (n + 1)];
                for lane in 0..T::LANES {
                    let value = inverse.primal(lane);
                    if !(0.0 < value && value < f64::INFINITY) {
                        return Err(self.no_inertia(link, value.recip()));
                    }
                }
            }
        }
        Ok(())
    }
}

impl RigidTree {
    /// What is wrong with a joint that meets no inertia: joints beyond it leave it free, or there is none that could carry it.
    #[cold]
    pub(crate) fn no_inertia(&self, link: &Link, inertia: f64) -> MultibodyError {
        let joint = self.joint_of(link);
        let first = self.links.iter().position(|other| other.v == link.v).unwrap_or(0);
        let mut is_beyond = vec![false; self.links.len()];
        is_beyond[first] = true;
        // Of the links behind other joints than this one.
        let mut mass = 0.0;
        for i in first..self.links.len() {
            let other = &self.links[i];
            is_beyond[i] |= other.parent != 0 && is_beyond[other.parent - 1];
            mass += if is_beyond[i] && other.joint != link.joint { other.mass } else { 0.0 };
        }
        if mass <= 0.0 {
            return MultibodyError::NoInertia { joint, inertia };
        }
        let child = self.joints.get(link.joint).map_or(BodyIndex::GROUND, |place| place.child);
        let mass = self.inertias.get(child.index()).map_or(0.0, BodyInertia::mass);
        MultibodyError::TooLightBody { body: self.body_name(child).to_owned(), joint, mass, inertia }
    }
}

/// Angular velocities, biases and what the links need at v̇ = 0.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn pass_outwards<T: Real>(tree: &RigidTree, states: &mut [LinkArticulation<T>], q: &[T], v: &[T]) {
    states[0].needed.1 = lit([-tree.gravity[0], -tree.gravity[1], -tree.gravity[2]]);
    for (i, link) in tree.links.iter().enumerate() {
        for_kind!(link.kind, outwards::<T>(link, i + 1, states, q, v));
    }
}

/// Articulated inertias. Writes D⁻¹ u to `out`; true where all D are positive.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn pass_inwards<T: Real>(
    tree: &RigidTree,
    work: &mut TreeWorkspace<T>,
    tau: &[T],
    out: &mut [T],
) -> T::Mask {
    let mut is_positive = T::Mask::splat(true);
    let TreeWorkspace { articulation, gains, inverses, .. } = work;
    for (i, link) in tree.links.iter().enumerate().rev() {
        let armature = &tree.armature;
        is_positive = is_positive
            & for_kind!(link.kind, inwards::<T>(link, i + 1, articulation, gains, inverses, armature, tau, out));
    }
    is_positive
}

/// Accelerations from the ground to the tips; `out` holds D⁻¹ u.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn pass_accelerations<T: Real>(
    tree: &RigidTree,
    states: &mut [LinkArticulation<T>],
    gains: &[Pair<T>],
    out: &mut [T],
) {
    for (i, link) in tree.links.iter().enumerate() {
        for_kind!(link.kind, accelerations::<T>(link, i + 1, states, gains, out));
    }
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn outwards<T: Real, E: Elementary<T, N>, const N: usize>(
    link: &Link,
    state: usize,
    states: &mut [LinkArticulation<T>],
    q: &[T],
    v: &[T],
) {
    outwards_from::<T, E, N>(link, state, states, E::place(link, q), v);
}

/// Outwards again, where the joint may stand as it did.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn outwards_again<T: Real, E: Elementary<T, N>, const N: usize>(
    link: &Link,
    state: usize,
    states: &mut [LinkArticulation<T>],
    is_placed: bool,
    (q, v): (&[T], &[T]),
) {
    let child = &states[state];
    let place = if is_placed { (E::Turn::recall(&child.turn), child.origin) } else { E::place(link, q) };
    outwards_from::<T, E, N>(link, state, states, place, v);
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn outwards_from<T: Real, E: Elementary<T, N>, const N: usize>(
    link: &Link,
    state: usize,
    states: &mut [LinkArticulation<T>],
    (turn, origin): (E::Turn, [T; 3]),
    v: &[T],
) {
    let rate = take::<T, N>(v, link.v);
    let parent_w = states[link.parent].w;
    let from_parent = turn.to_child(parent_w);
    let mut w = from_parent;
    E::add_angular(link, rate, &mut w);
    let mut bias = ([T::zero(); 3], turn.to_child(cross(parent_w, cross(parent_w, origin))));
    E::add_bias(link, from_parent, w, rate, &mut bias.0, &mut bias.1);
    let child = &mut states[state];
    turn.keep(&mut child.turn);
    child.origin = origin;
    child.w = w;
    child.bias = bias;
    child.needed = (cross(w, symmetric_times(lit_symmetric(link.inertia), w)), cross(w, cross(w, lit(link.moment))));
}

#[cfg_attr(not(debug_assertions), inline(always))]
#[expect(clippy::too_many_arguments, reason = "the parts of a workspace")]
fn inwards<T: Real, E: Elementary<T, N>, const N: usize>(
    link: &Link,
    state: usize,
    states: &mut [LinkArticulation<T>],
    gains: &mut [Pair<T>],
    inverses: &mut [T],
    armature: &[f64],
    tau: &[T],
    out: &mut [T],
) -> T::Mask {
    let child = &states[state];
    let inertia = with_own(link, child);
    let (joint, is_positive) = articulate::<T, E, N>(link, &inertia, armature, gains, inverses);
    let (moment, force) = felt::<T, E, N>(link, child, &inertia, &joint, tau, out);
    if link.parent == 0 {
        return is_positive;
    }
    let moved = to_parent::<T, E, N>(child, &inertia, &joint);
    let parent = &mut states[link.parent];
    parent.needed = (add(parent.needed.0, moment), add(parent.needed.1, force));
    receive(parent, link.is_first_met, &moved);
    is_positive
}

/// U, D⁻¹ and Y of a joint.
pub(crate) struct Articulation<T, const N: usize> {
    columns: [Pair<T>; N],
    inverse: [[T; N]; N],
    gain: [Pair<T>; N],
}

/// U, D⁻¹ and Y, which is U D⁻¹; and where D is positive.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn articulate<T: Real, E: Elementary<T, N>, const N: usize>(
    link: &Link,
    inertia: &Articulated<T>,
    armature: &[f64],
    gains: &mut [Pair<T>],
    inverses: &mut [T],
) -> (Articulation<T, N>, T::Mask) {
    let columns = E::columns(link, inertia);
    let mut d = [[T::zero(); N]; N];
    let mut k = 0;
    while k < N {
        d[k] = E::project(link, columns[k].0, columns[k].1);
        d[k][k] += T::lit(armature[link.v + k]);
        k += 1;
    }
    let (inverse, is_positive) = inverse_of(d);
    let mut gain = [([T::zero(); 3], [T::zero(); 3]); N];
    let mut i = 0;
    while i < N {
        let mut j = 0;
        while j < N {
            let entry = inverse[i][j];
            let mut c = 0;
            while c < 3 {
                gain[i].0[c] += entry * columns[j].0[c];
                gain[i].1[c] += entry * columns[j].1[c];
                c += 1;
            }
            inverses[link.square + i * N + j] = entry;
            j += 1;
        }
        gains[link.v + i] = gain[i];
        i += 1;
    }
    (Articulation { columns, inverse, gain }, is_positive)
}

/// What [`articulate`] found for the same inertia.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn recall<T: Real, E: Elementary<T, N>, const N: usize>(
    link: &Link,
    inertia: &Articulated<T>,
    gains: &[Pair<T>],
    inverses: &[T],
) -> Articulation<T, N> {
    let mut inverse = [[T::zero(); N]; N];
    let mut gain = [([T::zero(); 3], [T::zero(); 3]); N];
    let mut i = 0;
    while i < N {
        let from = link.square + i * N;
        inverse[i].copy_from_slice(&inverses[from..from + N]);
        gain[i] = gains[link.v + i];
        i += 1;
    }
    Articulation { columns: E::columns(link, inertia), inverse, gain }
}

/// Writes D⁻¹ u; what the parent feels: p + 𝕀 c + Y (u − Uᵀ c).
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn felt<T: Real, E: Elementary<T, N>, const N: usize>(
    link: &Link,
    child: &LinkArticulation<T>,
    inertia: &Articulated<T>,
    joint: &Articulation<T, N>,
    tau: &[T],
    out: &mut [T],
) -> Pair<T> {
    let needed = child.needed;
    let felt = E::project(link, needed.0, needed.1);
    let mut effort = [T::zero(); N];
    let mut k = 0;
    while k < N {
        effort[k] = tau[link.v + k] - felt[k];
        k += 1;
    }
    let mut i = 0;
    while i < N {
        let mut rate = T::zero();
        let mut j = 0;
        while j < N {
            rate += joint.inverse[i][j] * effort[j];
            j += 1;
        }
        out[link.v + i] = rate;
        i += 1;
    }
    // 𝕀 before it loses Y Uᵀ.
    let bias = child.bias;
    let by_bias = inertia.times(bias);
    let mut moment = add(needed.0, by_bias.0);
    let mut force = add(needed.1, by_bias.1);
    k = 0;
    while k < N {
        let (columns, gain) = (joint.columns[k], joint.gain[k]);
        let rest = effort[k] - dot(columns.0, bias.0) - dot(columns.1, bias.1);
        let mut c = 0;
        while c < 3 {
            moment[c] += gain.0[c] * rest;
            force[c] += gain.1[c] * rest;
            c += 1;
        }
        k += 1;
    }
    wrench_to_parent(E::Turn::recall(&child.turn), child.origin, (moment, force))
}

/// 𝕀 − Y Uᵀ, as the parent feels it.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn to_parent<T: Real, E: Elementary<T, N>, const N: usize>(
    child: &LinkArticulation<T>,
    inertia: &Articulated<T>,
    joint: &Articulation<T, N>,
) -> Articulated<T> {
    let mut reduced = *inertia;
    let mut k = 0;
    while k < N {
        reduce(&mut reduced, joint.gain[k], joint.columns[k]);
        k += 1;
    }
    moved_to_parent(E::Turn::recall(&child.turn), child.origin, &reduced)
}

/// Adds what a child adds to the inertia of its parent, to which the first one met writes.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn receive<T: Real>(parent: &mut LinkArticulation<T>, is_first_met: bool, moved: &Articulated<T>) {
    if is_first_met {
        parent.j = moved.j;
        parent.h = moved.h;
        parent.m = moved.m;
    } else {
        parent.j = sum(parent.j, moved.j);
        parent.m = sum(parent.m, moved.m);
        parent.h = [add(parent.h[0], moved.h[0]), add(parent.h[1], moved.h[1]), add(parent.h[2], moved.h[2])];
    }
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn accelerations<T: Real, E: Elementary<T, N>, const N: usize>(
    link: &Link,
    state: usize,
    states: &mut [LinkArticulation<T>],
    gains: &[Pair<T>],
    out: &mut [T],
) {
    let parent = states[link.parent].needed;
    let child = &mut states[state];
    let turn = E::Turn::recall(&child.turn);
    let mut alpha = add(turn.to_child(parent.0), child.bias.0);
    let mut linear = add(turn.to_child(add(parent.1, cross(parent.0, child.origin))), child.bias.1);
    let mut rate = [T::zero(); N];
    let mut k = 0;
    while k < N {
        let gain = gains[link.v + k];
        rate[k] = out[link.v + k] - dot(gain.0, alpha) - dot(gain.1, linear);
        out[link.v + k] = rate[k];
        k += 1;
    }
    E::add_angular(link, rate, &mut alpha);
    E::add_linear(link, rate, &mut linear);
    child.needed = (alpha, linear);
}
