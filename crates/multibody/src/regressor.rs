//! The regressor: inverse dynamics is linear in the inertial parameters of the bodies.
//!
//! ```text
//! τ = Y(q, v, v̇) π        π of a body: m, m c (3), I about the origin (xx, xy, xz, yy, yz, zz), in the body's frame
//! ```
//!
//! # References
//! C. G. Atkeson, C. H. An & J. M. Hollerbach, *Estimation of inertial parameters of manipulator loads and links*, Int. J.
//! Robot. Res. 5 (1986) 101.

use piola_numerics::Real;

use crate::elementary::for_kind;
use crate::error::{MultibodyError, check_finite, check_length};
use crate::inverse_dynamics::pass_outwards;
use crate::link::{Elementary, Link, Pair};
use crate::spatial::{add, cross, lit, lit_matrix, product, symmetric_times, times, transposed, transposed_times};
use crate::tree::RigidTree;
use crate::turn::Turning;
use crate::workspace::{LinkForces, TreeWorkspace};

const IDENTITY: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Inertial parameters of each body.
pub const INERTIAL_PARAMETERS: usize = 10;

impl RigidTree {
    /// The inertial parameters of all bodies but the ground: ten a body, in the order of the bodies.
    ///
    /// # Errors
    /// [`MultibodyError::WrongLength`].
    pub fn inertial_parameters(&self, out: &mut [f64]) -> Result<(), MultibodyError> {
        check_length("out", INERTIAL_PARAMETERS * self.bodies(), out.len())?;
        for (inertia, out) in self.inertias[1..].iter().zip(out.chunks_exact_mut(INERTIAL_PARAMETERS)) {
            let (moment, about_origin) = inertia.seen_from(IDENTITY, [0.0; 3]);
            out[0] = inertia.mass();
            out[1..4].copy_from_slice(&moment);
            out[4..].copy_from_slice(&about_origin);
        }
        Ok(())
    }

    /// The regressor Y with τ = Y π, where π are the [`inertial_parameters`](Self::inertial_parameters).
    ///
    /// `out` holds n × 10 B entries for B bodies, (i, c) at `i + c n`. Reflected inertias of motors are no parameters of
    /// bodies: they add their part of τ. Bodies that are fixed to the ground have columns of zeros.
    ///
    /// # Errors
    /// As [`inverse_dynamics`](Self::inverse_dynamics).
    ///
    /// # Example
    /// A hinge about y, level, at rest: τ = −g m cₓ, so only the column of m cₓ is not zero but for v̇.
    /// ```
    /// use piola_multibody::{BodyIndex, BodyInertia, JointKind, RigidTree, TreeJoint};
    /// let mut builder = RigidTree::builder();
    /// let hinge = TreeJoint::new("hinge", JointKind::Revolute { axis: [0.0, 1.0, 0.0] });
    /// builder.attach(BodyIndex::GROUND, hinge, "bob", BodyInertia::particle(2.0, [0.5, 0.0, 0.0])?)?;
    /// let tree = builder.build()?;
    /// let mut regressor = [0.0; 10];
    /// tree.regressor(&mut tree.workspace(), &[0.0], &[0.0], &[3.0], &mut regressor)?;
    /// assert_eq!((regressor[1], regressor[7]), (-9.81, 3.0)); // of m cₓ and of I_yy
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[doc(alias("linear identification", "dynamic parameters"))]
    pub fn regressor<T: Real>(
        &self,
        work: &mut TreeWorkspace<T>,
        q: &[T],
        v: &[T],
        a: &[T],
        out: &mut [T],
    ) -> Result<(), MultibodyError> {
        let n = self.freedoms;
        self.check_state(work, q, v)?;
        check_length("a", n, a.len())?;
        check_length("out", INERTIAL_PARAMETERS * self.bodies() * n, out.len())?;
        for (quantity, values) in [("q", q), ("v", v), ("a", a)] {
            check_finite(quantity, values)?;
        }
        self.check_quaternions(q)?;
        pass_outwards(self, &mut work.forces, q, v, a);
        out.fill(T::zero());
        if n == 0 {
            return Ok(());
        }
        for (body, columns) in self.bodies[1..].iter().zip(out.chunks_exact_mut(INERTIAL_PARAMETERS * n)) {
            if body.link == 0 {
                continue;
            }
            let state = &work.forces[body.link];
            let (axes, origin) = (lit_matrix(body.axes), lit(body.origin));
            let w = transposed_times(axes, state.w);
            let alpha = transposed_times(axes, state.alpha);
            let at_origin = transposed_times(axes, add(state.a, times(state.gradient, origin)));
            let gradient = product(product(transposed(axes), state.gradient), axes);
            for (parameter, column) in columns.chunks_exact_mut(n).enumerate() {
                let (moment, force) = unit_wrench(parameter, w, alpha, at_origin, gradient);
                let force = times(axes, force);
                let moment = add(times(axes, moment), cross(origin, force));
                self.project_inwards(&work.forces, body.link, (moment, force), column);
            }
        }
        check_finite("out", out)
    }

    /// Writes what a moment and a force on a link ask of the joints on its way to the ground.
    fn project_inwards<T: Real>(&self, states: &[LinkForces<T>], state: usize, wrench: Pair<T>, column: &mut [T]) {
        let (mut state, mut wrench) = (state, wrench);
        while state != 0 {
            let link = &self.links[state - 1];
            wrench = for_kind!(link.kind, inwards::<T>(link, &states[state], wrench, column));
            state = link.parent;
        }
    }
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn inwards<T: Real, E: Elementary<T, N>, const N: usize>(
    link: &Link,
    state: &LinkForces<T>,
    (moment, force): Pair<T>,
    column: &mut [T],
) -> Pair<T> {
    column[link.v..link.v + N].copy_from_slice(&E::project(link, moment, force));
    let turn = E::Turn::recall(&state.turn);
    let force = turn.to_parent(force);
    (add(turn.to_parent(moment), cross(state.origin, force)), force)
}

/// The moment and the force that a body needs whose parameters are zero but for one, which is one.
fn unit_wrench<T: Real>(parameter: usize, w: [T; 3], alpha: [T; 3], a: [T; 3], gradient: [[T; 3]; 3]) -> Pair<T> {
    let zero = [T::zero(); 3];
    match parameter {
        0 => (zero, a),
        1..4 => {
            let k = parameter - 1;
            let mut unit = zero;
            unit[k] = T::one();
            (cross(unit, a), [gradient[0][k], gradient[1][k], gradient[2][k]])
        }
        _ => {
            let mut unit = [T::zero(); 6];
            unit[parameter - 4] = T::one();
            (add(symmetric_times(unit, alpha), cross(w, symmetric_times(unit, w))), zero)
        }
    }
}
