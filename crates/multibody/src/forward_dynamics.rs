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

use crate::error::{MultibodyError, all_finite, check_length};
use crate::inverse_dynamics::AppliedWrench;
use crate::link::{Articulated, Elementary, Link, Pair, for_kind, take};
use crate::spatial::{ENTRY, Matrix, Symmetric, add, cross, dot, lit, lit_symmetric, skew, sub, symmetric_times};
use crate::tree::RigidTree;
use crate::turn::Turning;
use crate::workspace::{LinkArticulation, TreeWorkspace};

impl RigidTree {
    /// The accelerations under generalised forces: forward dynamics, in time proportional to the links.
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
    /// [`MultibodyError::WrongLength`], [`MultibodyError::NotFinite`], [`MultibodyError::NotUnitQuaternion`],
    /// [`MultibodyError::OtherWorkspace`]; [`MultibodyError::NoInertia`] unless every reduced inertia is positive.
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
                        return Err(MultibodyError::NoInertia { joint: self.joint_of(link), inertia: value.recip() });
                    }
                }
            }
        }
        Ok(())
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
    let (turn, origin) = E::place(link, q);
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

/// D⁻¹ of a symmetric matrix, and where it is positive definite.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn inverse_of<T: Real, const N: usize>(d: [[T; N]; N]) -> ([[T; N]; N], T::Mask) {
    let mut inverse = [[T::zero(); N]; N];
    if N == 1 {
        inverse[0][0] = d[0][0].recip();
        return (inverse, T::zero().less_than(d[0][0]));
    }
    // D = L diag Lᵀ, then a column of the identity at a time.
    let mut l = d;
    let mut is_positive = T::Mask::splat(true);
    for j in 0..N {
        for k in 0..j {
            let scaled = l[j][k] * l[k][k];
            for i in j..N {
                let entry = l[i][k] * scaled;
                l[i][j] -= entry;
            }
        }
        is_positive = is_positive & T::zero().less_than(l[j][j]);
        let reciprocal = l[j][j].recip();
        for i in j + 1..N {
            l[i][j] *= reciprocal;
        }
    }
    for c in 0..N {
        let mut x = [T::zero(); N];
        x[c] = T::one();
        for i in 0..N {
            for k in 0..i {
                let part = l[i][k] * x[k];
                x[i] -= part;
            }
        }
        for i in (0..N).rev() {
            x[i] /= l[i][i];
            for k in i + 1..N {
                let part = l[k][i] * x[k];
                x[i] -= part;
            }
        }
        for i in 0..N {
            inverse[i][c] = x[i];
        }
    }
    (inverse, is_positive)
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
    let needed = child.needed;
    let columns = E::columns(link, &inertia);
    let mut d = [[T::zero(); N]; N];
    let mut k = 0;
    while k < N {
        d[k] = E::project(link, columns[k].0, columns[k].1);
        d[k][k] += T::lit(armature[link.v + k]);
        k += 1;
    }
    let (inverse, is_positive) = inverse_of(d);
    let felt = E::project(link, needed.0, needed.1);
    let mut effort = [T::zero(); N];
    k = 0;
    while k < N {
        effort[k] = tau[link.v + k] - felt[k];
        k += 1;
    }
    // Y = U D⁻¹, v̇ = D⁻¹ u − …
    let mut gain = [([T::zero(); 3], [T::zero(); 3]); N];
    let mut i = 0;
    while i < N {
        let mut rate = T::zero();
        let mut j = 0;
        while j < N {
            let entry = inverse[i][j];
            rate += entry * effort[j];
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
        out[link.v + i] = rate;
        i += 1;
    }
    if link.parent == 0 {
        return is_positive;
    }
    // What the parent feels: p + 𝕀 c + Y (u − Uᵀ c), with 𝕀 before it loses Y Uᵀ.
    let bias = child.bias;
    let by_bias = inertia.times(bias);
    let mut moment = add(needed.0, by_bias.0);
    let mut force = add(needed.1, by_bias.1);
    let mut reduced = inertia;
    k = 0;
    while k < N {
        let rest = effort[k] - dot(columns[k].0, bias.0) - dot(columns[k].1, bias.1);
        let mut c = 0;
        while c < 3 {
            moment[c] += gain[k].0[c] * rest;
            force[c] += gain[k].1[c] * rest;
            c += 1;
        }
        reduce(&mut reduced, gain[k], columns[k]);
        k += 1;
    }
    let turn = E::Turn::recall(&child.turn);
    let origin = child.origin;
    let force = turn.to_parent(force);
    let moment = add(turn.to_parent(moment), cross(origin, force));
    let moved = moved_to_parent(turn, origin, &reduced);
    let parent = &mut states[link.parent];
    parent.needed = (add(parent.needed.0, moment), add(parent.needed.1, force));
    if link.is_first_met {
        parent.j = moved.j;
        parent.h = moved.h;
        parent.m = moved.m;
    } else {
        parent.j = sum(parent.j, moved.j);
        parent.m = sum(parent.m, moved.m);
        parent.h = [add(parent.h[0], moved.h[0]), add(parent.h[1], moved.h[1]), add(parent.h[2], moved.h[2])];
    }
    is_positive
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn sum<T: Real>(a: Symmetric<T>, b: Symmetric<T>) -> Symmetric<T> {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3], a[4] + b[4], a[5] + b[5]]
}

/// The link's own inertia and that which its children added.
#[cfg_attr(not(debug_assertions), inline(always))]
fn with_own<T: Real>(link: &Link, state: &LinkArticulation<T>) -> Articulated<T> {
    let own = lit_symmetric(link.inertia);
    let (mass, h) = (T::lit(link.mass), lit(link.moment));
    if link.is_leaf {
        let zero = T::zero();
        return Articulated { j: own, h: skew(h), m: [mass, zero, zero, mass, zero, mass] };
    }
    let mut inertia = Articulated { j: sum(own, state.j), h: state.h, m: state.m };
    inertia.h[0][1] -= h[2];
    inertia.h[0][2] += h[1];
    inertia.h[1][0] += h[2];
    inertia.h[1][2] -= h[0];
    inertia.h[2][0] -= h[1];
    inertia.h[2][1] += h[0];
    inertia.m[0] += mass;
    inertia.m[3] += mass;
    inertia.m[5] += mass;
    inertia
}

/// 𝕀 − Y Uᵀ, one column of each.
#[cfg_attr(not(debug_assertions), inline(always))]
fn reduce<T: Real>(inertia: &mut Articulated<T>, gain: Pair<T>, column: Pair<T>) {
    let mut i = 0;
    while i < 3 {
        let mut j = 0;
        while j < 3 {
            if i <= j {
                inertia.j[ENTRY[i][j]] -= gain.0[i] * column.0[j];
                inertia.m[ENTRY[i][j]] -= gain.1[i] * column.1[j];
            }
            inertia.h[i][j] -= gain.0[i] * column.1[j];
            j += 1;
        }
        i += 1;
    }
}

/// Xᵀ 𝕀 X: in the parent's axes, about its origin.
///
/// ```text
/// H' = H + [r]× M        J' = J + [r]× H'ᵀ − H [r]×        of the turned H, M, J
/// ```
#[cfg_attr(not(debug_assertions), inline(always))]
fn moved_to_parent<T: Real, R: Turning<T>>(turn: R, r: [T; 3], inertia: &Articulated<T>) -> Articulated<T> {
    let m = turn.symmetric_to_parent(inertia.m);
    let h = turn.matrix_to_parent(inertia.h);
    let mut j = turn.symmetric_to_parent(inertia.j);
    // [r]× M: row by row, r × on the columns of M, which are its rows.
    let columns = [cross(r, [m[0], m[1], m[2]]), cross(r, [m[1], m[3], m[4]]), cross(r, [m[2], m[4], m[5]])];
    let mut moved: Matrix<T> = h;
    let mut i = 0;
    while i < 3 {
        let mut k = 0;
        while k < 3 {
            moved[i][k] += columns[k][i];
            k += 1;
        }
        i += 1;
    }
    // ([r]× H'ᵀ)_ij = (r × row j of H')_i and (H [r]×)_ij = −(r × row i of H)_j.
    let by_moved = [cross(r, moved[0]), cross(r, moved[1]), cross(r, moved[2])];
    let by_old = [cross(r, h[0]), cross(r, h[1]), cross(r, h[2])];
    i = 0;
    while i < 3 {
        let mut k = i;
        while k < 3 {
            j[ENTRY[i][k]] += by_moved[k][i] + by_old[i][k];
            k += 1;
        }
        i += 1;
    }
    Articulated { j, h: moved, m }
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn accelerations<T: Real, E: Elementary<T, N>, const N: usize>(
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
