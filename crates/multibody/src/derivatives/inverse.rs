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
//! # References
//! S. Singh, R. P. Russell & P. M. Wensing, *Efficient analytical derivatives of rigid-body dynamics using spatial vector
//! algebra*, IEEE Robot. Autom. Lett. 7 (2022) 1776.

use piola_numerics::{Kernel, Real, dispatch};

use crate::coriolis::{add_velocity_product, by_velocity, by_velocity_transposed, own_velocity_product};
use crate::elementary::for_kind;
use crate::error::{MultibodyError, all_finite, check_length};
use crate::link::{Elementary, Link, Pair};
use crate::mass_matrix::dots;
use crate::space::{
    BOTH_RATES, RATE, Runs, SECOND_RATE, SUBSPACE, add_pairs, force_cross, motion_cross, own_inertia, pass_places,
    put_pair, reference, row_pair,
};
use crate::spatial::{Vector, add, cross, lit, scaled, sub};
use crate::tree::RigidTree;
use crate::workspace::{Composite, LinkInSpace, Rows, TreeWorkspace};

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
    ///
    /// # Example
    /// A hanging pendulum, m = 2 kg, l = 0.5 m: ∂τ/∂q = m g l = 9.81 N m at rest.
    /// ```
    /// use piola_multibody::{BodyIndex, BodyInertia, JointKind, RigidTree, TreeJoint};
    /// let mut builder = RigidTree::builder();
    /// let hinge = TreeJoint::new("hinge", JointKind::Revolute { axis: [0.0, 1.0, 0.0] });
    /// builder.attach(BodyIndex::GROUND, hinge, "bob", BodyInertia::particle(2.0, [0.0, 0.0, -0.5])?)?;
    /// let tree = builder.build()?;
    /// let (mut by_q, mut by_v, mut by_a) = ([0.0], [0.0], [0.0]);
    /// let mut work = tree.workspace();
    /// tree.inverse_dynamics_derivatives(&mut work, &[0.0], &[0.0], &[0.0], &mut by_q, &mut by_v, &mut by_a)?;
    /// assert_eq!((by_q, by_v, by_a), ([9.81], [0.0], [0.5]));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
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
    let n = tree.freedoms;
    let TreeWorkspace { space, rows, composite, column, .. } = work;
    let reference = reference(space);
    // At rest but for gravity.
    space[0].acceleration = lit([-tree.gravity[0], -tree.gravity[1], -tree.gravity[2]]);
    for (i, link) in tree.links.iter().enumerate() {
        for_kind!(link.kind, outwards::<T>(link, i + 1, space, rows, composite, reference, v, a));
    }
    space[0].acceleration = [T::zero(); 3];
    if tree.links.iter().any(|link| link.run != 1) {
        by_q.fill(T::zero());
        by_v.fill(T::zero());
        if let Some(by_a) = by_a.as_deref_mut() {
            by_a.fill(T::zero());
        }
    }
    for (i, link) in tree.links.iter().enumerate().rev() {
        let freedoms = link.kind.freedoms();
        let mut k = 0;
        while k < freedoms {
            let j = link.v + k;
            let of = Vectors::of(&composite[i + 1], rows, j);
            for (first, end) in Runs::of(tree, i + 1) {
                let before = end.min(link.v);
                dots(rows, SUBSPACE, first, of.second.0, of.second.1, &mut by_v[j * n + first..j * n + end]);
                if first < before {
                    dots(rows, SUBSPACE, first, of.third.0, of.third.1, &mut by_q[j * n + first..j * n + before]);
                    across(rows, first, &of, &mut column[first..before], false);
                    for t in first..before {
                        by_v[t * n + j] = column[t];
                    }
                }
                // Freedoms of the same joint turn with it, so that their S feels no force: S ×* f is left out.
                across(rows, first, &of, &mut column[first..end], true);
                for t in first..end {
                    by_q[t * n + j] = column[t];
                }
                if let Some(by_a) = by_a.as_deref_mut() {
                    dots(rows, SUBSPACE, first, of.first.0, of.first.1, &mut by_a[j * n + first..j * n + end]);
                    for t in first..end {
                        by_a[t * n + j] = by_a[j * n + t];
                    }
                }
            }
            if let Some(by_a) = by_a.as_deref_mut() {
                by_a[j * n + j] += T::lit(tree.armature[j]);
            }
            k += 1;
        }
        if link.parent != 0 {
            let (before, after) = composite.split_at_mut(i + 1);
            let (parent, child) = (&mut before[link.parent], &after[0]);
            add_velocity_product(parent, child);
            parent.torque = add(parent.torque, child.torque);
            parent.force = add(parent.force, child.force);
        }
    }
}

/// u₁ to u₄ of a freedom.
struct Vectors<T> {
    first: Pair<T>,
    second: Pair<T>,
    third: Pair<T>,
    /// Its linear part is zero.
    fourth: Vector<T>,
}

impl<T: Real> Vectors<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn of(beyond: &Composite<T>, rows: &Rows<T>, freedom: usize) -> Self {
        let s = row_pair(rows, SUBSPACE, freedom);
        let rate = row_pair(rows, RATE, freedom);
        let twice = T::lit(2.0);
        let by_s = by_velocity(beyond, scaled(twice, s.0));
        let by_rate = by_velocity(beyond, scaled(twice, rate.0));
        let second = add_pairs(by_s, beyond.momentum_of(row_pair(rows, BOTH_RATES, freedom)));
        let third = add_pairs(by_rate, beyond.momentum_of(row_pair(rows, SECOND_RATE, freedom)));
        let third = add_pairs(third, force_cross(s, (beyond.torque, beyond.force)));
        let fourth = scaled(twice, by_velocity_transposed(beyond, s));
        Self { first: beyond.momentum_of(s), second, third, fourth }
    }
}

/// The derivatives of one τ with respect to freedoms nearer to the ground, from `first`: by q, or by v.
#[cfg_attr(not(debug_assertions), inline(always))]
fn across<T: Real>(rows: &Rows<T>, first: usize, of: &Vectors<T>, out: &mut [T], by_q: bool) {
    let count = out.len();
    let row = |k: usize| &rows.row(k)[first..first + count];
    let (with_first, with_fourth) = if by_q { (SECOND_RATE, RATE) } else { (BOTH_RATES, SUBSPACE) };
    let (x, y, z) = (row(with_first), row(with_first + 1), row(with_first + 2));
    let (u, v, w) = (row(with_first + 3), row(with_first + 4), row(with_first + 5));
    let (a, b, c) = (row(with_fourth), row(with_fourth + 1), row(with_fourth + 2));
    let (moment, force, fourth) = (of.first.0, of.first.1, of.fourth);
    for i in 0..count {
        out[i] = (x[i] * moment[0] + y[i] * moment[1] + z[i] * moment[2])
            + (u[i] * force[0] + v[i] * force[1] + w[i] * force[2])
            + (a[i] * fourth[0] + b[i] * fourth[1] + c[i] * fourth[2]);
    }
}

/// Motions at the reference point (in the fields of velocities and accelerations), the freedoms' vectors, and what each link
/// needs.
#[cfg_attr(not(debug_assertions), inline(always))]
#[expect(clippy::too_many_arguments, reason = "the parts of a workspace")]
fn outwards<T: Real, E: Elementary<T, N>, const N: usize>(
    link: &Link,
    state: usize,
    space: &mut [LinkInSpace<T>],
    rows: &mut Rows<T>,
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
        put_pair(rows, SUBSPACE, link.v + k, s[k]);
        put_pair(rows, RATE, link.v + k, rate);
        put_pair(rows, SECOND_RATE, link.v + k, second);
        put_pair(rows, BOTH_RATES, link.v + k, add_pairs(rate, motion_cross(motion, s[k])));
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
