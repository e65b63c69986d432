//! Derivatives of inverse dynamics, in time proportional to links times depth.
//!
//! With all vectors in space about one reference point, v and a of the parent λ of a link, composite inertia 𝕀, B (see the
//! Coriolis matrix) and force f of a link with all beyond it:
//!
//! ```text
//! Ψ̇ = v_λ × S        Ψ̈ = a_λ × S + v_λ × Ψ̇        Ṡ = v × S
//! u₁ = 𝕀 S    u₂ = 2 B S + 𝕀 (Ψ̇ + Ṡ)    u₃ = 2 B Ψ̇ + 𝕀 Ψ̈ + S ×* f    u₄ = 2 Bᵀ S            of freedom j
//! ∂τ_i/∂q_j = S_i·u₃        ∂τ_j/∂q_i = Ψ̈_i·u₁ + Ψ̇_i·u₄                                        for i on the way to the ground
//! ∂τ_i/∂v_j = S_i·u₂        ∂τ_j/∂v_i = (Ψ̇ + Ṡ)_i·u₁ + S_i·u₄        ∂τ_i/∂a_j = S_i·u₁
//! ```
//!
//! Freedoms of the same joint turn with it, so that their S feels no force: in the entries of ∂τ/∂q among them S ×* f is left out.
//!
//! # References
//! S. Singh, R. P. Russell & P. M. Wensing, *Efficient analytical derivatives of rigid-body dynamics using spatial vector
//! algebra*, IEEE Robot. Autom. Lett. 7 (2022) 1776.

use piola_numerics::{Kernel, Real, dispatch};

use crate::coriolis::{add_velocity_product, by_velocity, by_velocity_transposed, own_velocity_product};
use crate::elementary::for_kind;
use crate::error::{MultibodyError, all_finite, check_length};
use crate::freedoms::{EIGHT, Eight, is_paired, product, products, put, six, sum, write};
use crate::link::{Elementary, Link, Pair};
use crate::mass_matrix::join;
use crate::space::{Runs, add_pairs, force_cross, motion_cross, own_inertia, pass_places, reference};
use crate::spatial::{Vector, add, cross, lit, scaled, sub};
use crate::tree::RigidTree;
use crate::workspace::{Composite, FreedomVectors, LinkInSpace, TreeWorkspace};

impl RigidTree {
    /// The derivatives of [`inverse_dynamics`](Self::inverse_dynamics): ∂τ/∂q on the tangent space, ∂τ/∂v, ∂τ/∂v̇ = M.
    ///
    /// Each holds n² entries, ∂τᵢ/∂xⱼ at `i + j n`.
    ///
    /// # Errors
    /// As [`inverse_dynamics`](Self::inverse_dynamics).
    ///
    /// # Accuracy
    /// A few ulp of the largest terms that are summed, times the depth of the tree.
    #[expect(clippy::too_many_arguments, reason = "three arguments and three derivatives")]
    pub fn inverse_dynamics_derivatives<T: Real>(
        &self,
        work: &mut TreeWorkspace<T>,
        q: &[T],
        v: &[T],
        a: &[T],
        by_q: &mut [T],
        by_v: &mut [T],
        by_a: &mut [T],
    ) -> Result<(), MultibodyError> {
        let n = self.freedoms;
        self.check_state(work, q, v)?;
        check_length("a", n, a.len())?;
        check_length("by_q", n * n, by_q.len())?;
        check_length("by_v", n * n, by_v.len())?;
        check_length("by_a", n * n, by_a.len())?;
        dispatch(Derivatives { tree: self, work, q, v, a, by_q: &mut *by_q, by_v: &mut *by_v, by_a: Some(by_a) });
        if all_finite(by_q) && all_finite(by_v) && self.has_unit_quaternions(q) {
            return Ok(());
        }
        self.explain(q, [("v", v), ("a", a)], ("by_q", by_q))
    }
}

/// Freedoms up to which entries are computed one after the other.
fn pairs_most(tree: &RigidTree) -> usize {
    // In eights a chain of 30 takes a tenth less time; a branched tree computes eights of which many entries are zero.
    if tree.relatives.is_chain { 16 } else { 64 }
}

/// The derivatives as a kernel.
struct Derivatives<'a, T> {
    tree: &'a RigidTree,
    work: &'a mut TreeWorkspace<T>,
    q: &'a [T],
    v: &'a [T],
    a: &'a [T],
    by_q: &'a mut [T],
    by_v: &'a mut [T],
    by_a: Option<&'a mut [T]>,
}

impl<T: Real> Kernel for Derivatives<'_, T> {
    type Output = ();
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) {
        pass_places(self.tree, &mut self.work.space, self.q);
        differentiate(self.tree, self.work, self.v, self.a, self.by_q, self.by_v, self.by_a);
    }
}

/// The derivatives without checks, where places are there.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn differentiate<T: Real>(
    tree: &RigidTree,
    work: &mut TreeWorkspace<T>,
    v: &[T],
    a: &[T],
    by_q: &mut [T],
    by_v: &mut [T],
    mut by_a: Option<&mut [T]>,
) {
    let is_paired = is_paired::<T>(tree.freedoms, pairs_most(tree));
    if tree.links.iter().any(|link| link.run != 1) {
        by_q.fill(T::zero());
        by_v.fill(T::zero());
        if let Some(by_a) = by_a.as_deref_mut() {
            by_a.fill(T::zero());
        }
    }
    let TreeWorkspace { space, subspaces, felt, motions, vectors, composite, .. } = work;
    let reference = reference(space);
    // At rest but for gravity.
    space[0].acceleration = lit([-tree.gravity[0], -tree.gravity[1], -tree.gravity[2]]);
    for (i, link) in tree.links.iter().enumerate() {
        for_kind!(
            link.kind,
            outwards::<T>(tree, link, i + 1, space, subspaces, motions, vectors, composite, reference, v, a)
        );
    }
    space[0].acceleration = [T::zero(); 3];
    for (i, link) in tree.links.iter().enumerate().rev() {
        for j in link.v..link.v + link.kind.freedoms() {
            vectors[j].feel(&motions[j], &composite[i + 1]);
            if let Some(by_a) = by_a.as_deref_mut() {
                join(tree, i + 1, j, motions, &six(pair(&vectors[j].felt)), by_a, true);
                by_a[j * (tree.freedoms + 1)] += T::lit(tree.armature[j]);
            }
            if is_paired {
                pairs(tree, (link, j), motions, vectors, by_q, by_v);
            } else {
                put(felt, j, 0, vectors[j].felt);
            }
        }
        if link.parent != 0 {
            let (before, after) = composite.split_at_mut(i + 1);
            let (parent, child) = (&mut before[link.parent], &after[0]);
            add_velocity_product(parent, child);
            parent.torque = add(parent.torque, child.torque);
            parent.force = add(parent.force, child.force);
        }
    }
    if !is_paired {
        columns(tree, work, by_q, by_v);
    }
}

/// The entries of freedom j of a link with its own joint and with all freedoms nearer to the ground, one after the other.
#[cfg_attr(not(debug_assertions), inline(always))]
fn pairs<T: Real>(
    tree: &RigidTree,
    (link, j): (&Link, usize),
    motions: &[[T; 6]],
    vectors: &[FreedomVectors<T>],
    by_q: &mut [T],
    by_v: &mut [T],
) {
    let n = tree.freedoms;
    let of = &vectors[j];
    for i in link.v..link.v + link.kind.freedoms() {
        by_q[i * n + j] = product(&vectors[i].across_by_q, &of.felt);
        by_v[j * n + i] = product(&motions[i], &of.second);
    }
    for (first, end) in Runs::of(tree, link.parent) {
        for (i, at) in vectors[first..end].iter().enumerate() {
            let i = first + i;
            by_q[j * n + i] = product(&motions[i], &of.third);
            by_v[j * n + i] = product(&motions[i], &of.second);
            by_q[i * n + j] = product(&at.across_by_q, &of.felt);
            by_v[i * n + j] = product(&at.across_by_v, &of.felt);
        }
    }
}

/// All entries of ∂τ/∂q and ∂τ/∂v, eight rows of both at a time.
#[cfg_attr(not(debug_assertions), inline(always))]
fn columns<T: Real>(tree: &RigidTree, work: &TreeWorkspace<T>, by_q: &mut [T], by_v: &mut [T]) {
    let (n, zeros) = (tree.freedoms, [T::zero(); EIGHT]);
    for (i, link) in tree.links.iter().enumerate() {
        for j in link.v..link.v + link.kind.freedoms() {
            let of = &work.vectors[j];
            let bits = tree.relatives.of(i);
            let (first, after) = (link.v / EIGHT, (link.v + link.kind.freedoms() - 1) / EIGHT + 1);
            let (column, end) = (j * n, (j + 1) * n);
            for (b, (&[before, _], s)) in bits[..first].iter().zip(&work.subspaces).enumerate() {
                if before == 0 {
                    write(by_q, column + b * EIGHT, end, &zeros);
                    write(by_v, column + b * EIGHT, end, &zeros);
                } else {
                    write(by_q, column + b * EIGHT, end, &products(before, &s.0, &of.third));
                    write(by_v, column + b * EIGHT, end, &products(before, &s.0, &of.second));
                }
            }
            for b in first..after {
                let ([before, beyond], own) = (bits[b], link.bits(b));
                let (s, felt) = (&work.subspaces[b].0, &work.felt[b].0);
                let to_q = sum(products(before, s, &of.third), products(beyond | own, felt, &of.across_by_q));
                let to_v = sum(products(before | own, s, &of.second), products(beyond, felt, &of.across_by_v));
                write(by_q, column + b * EIGHT, end, &to_q);
                write(by_v, column + b * EIGHT, end, &to_v);
            }
            for (b, (&[_, beyond], felt)) in bits.iter().zip(&work.felt).enumerate().skip(after) {
                if beyond == 0 {
                    write(by_q, column + b * EIGHT, end, &zeros);
                    write(by_v, column + b * EIGHT, end, &zeros);
                } else {
                    write(by_q, column + b * EIGHT, end, &products(beyond, &felt.0, &of.across_by_q));
                    write(by_v, column + b * EIGHT, end, &products(beyond, &felt.0, &of.across_by_v));
                }
            }
        }
    }
}

impl<T: Real> FreedomVectors<T> {
    /// Writes u₁ to u₄; the linear part of u₄ is zero.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn feel(&mut self, s: &[T; 6], beyond: &Composite<T>) {
        let (twice, s) = (T::lit(2.0), pair(s));
        let [.., x, y, z] = self.across_by_q;
        let by_s = by_velocity(beyond, scaled(twice, s.0));
        let by_rate = by_velocity(beyond, scaled(twice, [x, y, z]));
        let third = add_pairs(by_rate, beyond.momentum_of(pair(&self.across_by_q)));
        self.felt = nine(beyond.momentum_of(s), scaled(twice, by_velocity_transposed(beyond, s)));
        self.second = six(add_pairs(by_s, beyond.momentum_of(pair(&self.across_by_v))));
        self.third = six(add_pairs(third, force_cross(s, (beyond.torque, beyond.force))));
    }
}

/// The first six numbers as a pair.
#[cfg_attr(not(debug_assertions), inline(always))]
fn pair<T: Real>(x: &[T]) -> Pair<T> {
    ([x[0], x[1], x[2]], [x[3], x[4], x[5]])
}

/// Six numbers and three.
#[cfg_attr(not(debug_assertions), inline(always))]
fn nine<T: Real>((a, b): Pair<T>, c: Vector<T>) -> [T; 9] {
    [a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2]]
}

/// Motions at the reference point (in the fields of velocities and accelerations), the freedoms' vectors, and what each link
/// needs.
#[cfg_attr(not(debug_assertions), inline(always))]
#[expect(clippy::too_many_arguments, reason = "the parts of a workspace")]
fn outwards<T: Real, E: Elementary<T, N>, const N: usize>(
    tree: &RigidTree,
    link: &Link,
    state: usize,
    space: &mut [LinkInSpace<T>],
    subspaces: &mut [Eight<T, 6>],
    motions: &mut [[T; 6]],
    vectors: &mut [FreedomVectors<T>],
    composite: &mut [Composite<T>],
    reference: Vector<T>,
    v: &[T],
    a: &[T],
) {
    let parent = &space[link.parent];
    let (parent_motion, parent_acceleration) = ((parent.w, parent.velocity), (parent.alpha, parent.acceleration));
    let here = &mut space[state];
    let arm = sub(here.origin, reference);
    let zero = ([T::zero(); 3], [T::zero(); 3]);
    let (mut relative, mut relative_acceleration) = (zero, zero);
    let columns = E::turned_subspace(link, here.axes);
    let mut s = [zero; N];
    let mut k = 0;
    while k < N {
        s[k] = (columns[k].0, add(columns[k].1, cross(arm, columns[k].0)));
        let (rate, second) = (v[link.v + k], a[link.v + k]);
        relative = add_pairs(relative, (scaled(rate, s[k].0), scaled(rate, s[k].1)));
        relative_acceleration = add_pairs(relative_acceleration, (scaled(second, s[k].0), scaled(second, s[k].1)));
        k += 1;
    }
    let motion = add_pairs(parent_motion, relative);
    let acceleration = add_pairs(parent_acceleration, add_pairs(relative_acceleration, motion_cross(motion, relative)));
    k = 0;
    while k < N {
        let rate = motion_cross(parent_motion, s[k]);
        let second = add_pairs(motion_cross(parent_acceleration, s[k]), motion_cross(parent_motion, rate));
        let of = &mut vectors[link.v + k];
        if !is_paired::<T>(tree.freedoms, pairs_most(tree)) {
            put(subspaces, link.v + k, 0, six(s[k]));
        }
        motions[link.v + k] = six(s[k]);
        of.across_by_q = nine(second, rate.0);
        of.across_by_v = nine(add_pairs(rate, motion_cross(motion, s[k])), s[k].0);
        k += 1;
    }
    (here.w, here.velocity) = motion;
    (here.alpha, here.acceleration) = acceleration;
    let own = &mut composite[state];
    own_inertia(link, here, reference, own);
    own_velocity_product(own, motion);
    let needed = add_pairs(own.momentum_of(acceleration), force_cross(motion, own.momentum_of(motion)));
    own.torque = needed.0;
    own.force = needed.1;
}
