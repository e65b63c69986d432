//! The Coriolis matrix.
//!
//! ```text
//! C(q, v) v + g(q) = b(q, v)        Ṁ − 2 C is skew
//! C = Σ Jᵀ (𝕀 J̇ + B J)        B m = ((Σ w) × ω + h × (w × v); w × l)        for a motion m = (w, u)
//! ```
//!
//! Σ = ½ tr(I) 1 − I is the second moment of mass, l the momentum. Of the many matrices with the first property this one has
//! the second: it is that of the Christoffel symbols where v = q̇.
//!
//! # References
//! S. Echeandia & P. M. Wensing, *Numerical methods to compute the Coriolis matrix and Christoffel symbols for rigid-body
//! systems*, J. Comput. Nonlinear Dyn. 16 (2021) 091004.

use piola_numerics::Real;

use crate::error::{MultibodyError, check_finite, check_length};
use crate::mass_matrix::dots;
use crate::space::{
    RATE, Runs, SUBSPACE, add_inertia, add_pairs, momentum, motion_at, own_inertia, pass_subspaces, reference, row_pair,
};
use crate::spatial::{Matrix, Vector, add, cross, full, skew_skew, skew_times, times, transposed_times};
use crate::tree::RigidTree;
use crate::workspace::{Composite, TreeWorkspace};

impl RigidTree {
    /// The Coriolis matrix C(q, v) with C v = b(q, v) − b(q, 0) and Ṁ − 2 C skew.
    ///
    /// `out` holds n² entries, (i, j) at `i + j n`.
    ///
    /// # Errors
    /// As [`forward_velocities`](Self::forward_velocities).
    pub fn coriolis_matrix<T: Real>(
        &self,
        work: &mut TreeWorkspace<T>,
        q: &[T],
        v: &[T],
        out: &mut [T],
    ) -> Result<(), MultibodyError> {
        let n = self.freedoms;
        check_length("out", n * n, out.len())?;
        self.forward_velocities(work, q, v)?;
        pass_subspaces(self, &work.space, &mut work.rows);
        self.pass_subspace_rates(work);
        let reference = reference(&work.space);
        for (i, link) in self.links.iter().enumerate() {
            let motion = motion_at(&work.space[i + 1], reference);
            let composite = &mut work.composite[i + 1];
            own_inertia(link, &work.space[i + 1], reference, composite);
            own_velocity_product(composite, motion);
        }
        out.fill(T::zero());
        for (i, link) in self.links.iter().enumerate().rev() {
            let beyond = work.composite[i + 1];
            for j in link.v..link.v + link.kind.freedoms() {
                let s = row_pair(&work.rows, SUBSPACE, j);
                let rate = row_pair(&work.rows, RATE, j);
                let force = add_pairs(by_velocity(&beyond, s.0), beyond.momentum_of(rate));
                let by_inertia = beyond.momentum_of(s);
                let transposed = by_velocity_transposed(&beyond, s);
                for (first, end) in Runs::of(self, i + 1) {
                    dots(&work.rows, SUBSPACE, first, force.0, force.1, &mut out[j * n + first..j * n + end]);
                    // Freedoms of the same joint have their rows from the line above.
                    for t in first..end.min(link.v) {
                        let (s, rate) = (row_pair(&work.rows, SUBSPACE, t), row_pair(&work.rows, RATE, t));
                        out[t * n + j] = crate::spatial::dot(by_inertia.0, rate.0)
                            + crate::spatial::dot(by_inertia.1, rate.1)
                            + crate::spatial::dot(transposed, s.0);
                    }
                }
            }
            if link.parent != 0 {
                add_velocity_product(&mut work.composite[link.parent], &beyond);
            }
        }
        check_finite("out", out)
    }
}

impl<T: Real> Composite<T> {
    /// (angular momentum, momentum) of a motion.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn momentum_of(&self, motion: (Vector<T>, Vector<T>)) -> (Vector<T>, Vector<T>) {
        momentum(self.mass, self.moment, self.inertia, motion)
    }
}

/// B and the momentum of a link that moves.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn own_velocity_product<T: Real>(composite: &mut Composite<T>, (w, v): (Vector<T>, Vector<T>)) {
    let i = composite.inertia;
    let half_trace = T::lit(0.5) * (i[0] + i[3] + i[5]);
    let second = [half_trace - i[0], -i[1], -i[2], half_trace - i[3], -i[4], half_trace - i[5]];
    let of_mass = skew_times(w, full(second));
    let of_moment = skew_skew(composite.moment, v);
    composite.velocity_product = negative_sum(of_mass, of_moment);
    composite.momentum = composite.momentum_of((w, v)).1;
}

/// −A − B.
#[cfg_attr(not(debug_assertions), inline(always))]
fn negative_sum<T: Real>(a: Matrix<T>, b: Matrix<T>) -> Matrix<T> {
    let mut out = a;
    let mut i = 0;
    while i < 3 {
        let mut j = 0;
        while j < 3 {
            out[i][j] = -(a[i][j] + b[i][j]);
            j += 1;
        }
        i += 1;
    }
    out
}

/// Adds inertia, B and momentum of a link to its parent's.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn add_velocity_product<T: Real>(parent: &mut Composite<T>, child: &Composite<T>) {
    add_inertia(parent, child);
    let mut i = 0;
    while i < 3 {
        parent.velocity_product[i] = add(parent.velocity_product[i], child.velocity_product[i]);
        i += 1;
    }
    parent.momentum = add(parent.momentum, child.momentum);
}

/// B m, which depends on the angular part alone.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn by_velocity<T: Real>(composite: &Composite<T>, w: Vector<T>) -> (Vector<T>, Vector<T>) {
    (times(composite.velocity_product, w), cross(w, composite.momentum))
}

/// The angular part of Bᵀ m; its linear part is zero.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn by_velocity_transposed<T: Real>(composite: &Composite<T>, (w, u): (Vector<T>, Vector<T>)) -> Vector<T> {
    add(transposed_times(composite.velocity_product, w), cross(composite.momentum, u))
}
