//! Derivatives of forward dynamics.
//!
//! ```text
//! ∂v̇/∂q = −M⁻¹ ∂τ/∂q        ∂v̇/∂v = −M⁻¹ ∂τ/∂v        ∂v̇/∂τ = M⁻¹        ∂τ of inverse dynamics at v̇
//! ```
//!
//! M⁻¹ and its products come from the articulated inertias of the forward dynamics. Up to 128 freedoms M⁻¹ is found from the tips, and
//! multiplies the other columns where these are not zero: up to some n³ operations. Beyond, and for states in lanes, each column is solved along
//! the tree: n times the links.

use piola_numerics::{Kernel, Mask, Real, dispatch};

use super::columns::{gains_in_space, solve_columns};
use super::dense::{invert, multiply_columns};
use super::inverse::differentiate;
use crate::elementary::for_kind;
use crate::error::{MultibodyError, all_finite, check_length};
use crate::forward_dynamics::{pass_accelerations, pass_inwards, pass_outwards};
use crate::freedoms::{DENSE, is_plain};
use crate::link::{Elementary, Link};
use crate::space::put_place;
use crate::tree::RigidTree;
use crate::turn::Turning;
use crate::workspace::{LinkArticulation, LinkInSpace, TreeWorkspace};

/// What [`RigidTree::forward_dynamics_derivatives`] writes: v̇ and its derivatives.
///
/// Each derivative holds n² entries, ∂v̇ᵢ/∂xⱼ at `i + j n`.
///
/// # Example
/// ```
/// use piola_multibody::{AccelerationDerivatives, BodyIndex, BodyInertia, JointKind, RigidTree, TreeJoint};
/// let mut builder = RigidTree::builder();
/// let hinge = TreeJoint::new("hinge", JointKind::Revolute { axis: [0.0, 1.0, 0.0] });
/// builder.attach(BodyIndex::GROUND, hinge, "bob", BodyInertia::particle(2.0, [0.0, 0.0, -0.5])?)?;
/// let tree = builder.build()?;
/// let mut out = AccelerationDerivatives::new(&tree);
/// tree.forward_dynamics_derivatives(&mut tree.workspace(), &[0.0], &[0.0], &[0.0], &mut out)?;
/// // −g/l and 1/(m l²).
/// assert_eq!((out.by_q[0], out.by_tau[0]), (-19.62, 2.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct AccelerationDerivatives<T> {
    /// v̇.
    pub acceleration: Vec<T>,
    /// ∂v̇/∂q, along the tangent space.
    pub by_q: Vec<T>,
    /// ∂v̇/∂v.
    pub by_v: Vec<T>,
    /// ∂v̇/∂τ = M⁻¹.
    pub by_tau: Vec<T>,
}

impl<T: Real> AccelerationDerivatives<T> {
    /// Memory for the derivatives of a tree.
    #[must_use]
    pub fn new(tree: &RigidTree) -> Self {
        let n = tree.freedoms;
        let matrix = vec![T::zero(); n * n];
        Self { acceleration: vec![T::zero(); n], by_q: matrix.clone(), by_v: matrix.clone(), by_tau: matrix }
    }
}

impl RigidTree {
    /// The accelerations of [`forward_dynamics`](Self::forward_dynamics) and their derivatives with respect to q (on the
    /// tangent space), v and τ.
    ///
    /// # Errors
    /// As [`forward_dynamics`](Self::forward_dynamics).
    ///
    /// # Accuracy
    /// A few ulp times the condition number of the mass matrix.
    #[doc(alias("ABA derivatives", "linearisation"))]
    pub fn forward_dynamics_derivatives<T: Real>(
        &self,
        work: &mut TreeWorkspace<T>,
        q: &[T],
        v: &[T],
        tau: &[T],
        out: &mut AccelerationDerivatives<T>,
    ) -> Result<(), MultibodyError> {
        let n = self.freedoms;
        self.check_state(work, q, v)?;
        check_length("tau", n, tau.len())?;
        check_length("out.acceleration", n, out.acceleration.len())?;
        for (quantity, found) in
            [("out.by_q", out.by_q.len()), ("out.by_v", out.by_v.len()), ("out.by_tau", out.by_tau.len())]
        {
            check_length(quantity, n * n, found)?;
        }
        let is_right = dispatch(Derivatives { tree: self, work, q, v, tau, out });
        if is_right && self.has_unit_quaternions(q) {
            return Ok(());
        }
        self.explain(q, [("v", v), ("tau", tau)], ("out", &[]))?;
        self.explain_inertia(work)?;
        self.explain(q, [("v", v), ("tau", tau)], ("out.by_q", &out.by_q))
    }
}

/// Places a link in space by the turn that forward dynamics kept.
#[cfg_attr(not(debug_assertions), inline(always))]
fn place<T: Real, E: Elementary<T, N>, const N: usize>(
    link: &Link,
    kept: &LinkArticulation<T>,
    state: usize,
    space: &mut [LinkInSpace<T>],
) {
    put_place(link, state, (E::Turn::recall(&kept.turn), kept.origin), space);
}

/// The derivatives as a kernel.
struct Derivatives<'a, T> {
    tree: &'a RigidTree,
    work: &'a mut TreeWorkspace<T>,
    q: &'a [T],
    v: &'a [T],
    tau: &'a [T],
    out: &'a mut AccelerationDerivatives<T>,
}

impl<T: Real> Kernel for Derivatives<'_, T> {
    type Output = bool;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) -> bool {
        let Self { tree, work, q, v, tau, out } = self;
        pass_outwards(tree, &mut work.articulation, q, v);
        let is_positive = pass_inwards(tree, work, tau, &mut out.acceleration);
        pass_accelerations(tree, &mut work.articulation, &work.gains, &mut out.acceleration);
        differentiate_accelerations(tree, work, v, out) && is_positive.all()
    }
}

/// The derivatives of accelerations that are there, with the articulated inertias of forward dynamics; true where all is finite.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn differentiate_accelerations<T: Real>(
    tree: &RigidTree,
    work: &mut TreeWorkspace<T>,
    v: &[T],
    out: &mut AccelerationDerivatives<T>,
) -> bool {
    let n = tree.freedoms;
    let AccelerationDerivatives { acceleration, by_q, by_v, by_tau } = out;
    let TreeWorkspace { articulation, space, .. } = &mut *work;
    for (i, link) in tree.links.iter().enumerate() {
        for_kind!(link.kind, place::<T>(link, &articulation[i + 1], i + 1, space));
    }
    differentiate(tree, work, v, acceleration, by_q, by_v, None);
    gains_in_space(tree, work, false);
    if const { is_plain::<T>() } && n <= DENSE {
        invert(tree, work, by_tau);
        multiply_columns(tree, &mut work.dense, [by_q, by_v]);
    } else {
        by_tau.fill(T::zero());
        for j in 0..n {
            by_tau[j * n + j] = T::one();
        }
        solve_columns(tree, work, &mut [&mut by_q[..], &mut by_v[..], &mut by_tau[..]], &[-1.0, -1.0, 1.0], n);
    }
    all_finite(by_q) && all_finite(by_v) && all_finite(by_tau)
}
