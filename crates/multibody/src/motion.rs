//! The motion of a tree in time, for the explicit methods of the integrators.
//!
//! ```text
//! q̇ = v for coordinates,  q̇ = ½ q (0, ω) for quaternions,  ẋ = R v for positions        v̇ = forward dynamics
//! ```

use piola_geometric::{DirectProduct, GroupField, Translations};
use piola_integrators::Field;
use piola_numerics::Real;

use crate::error::{MultibodyError, check_length};
use crate::group::TreeGroup;
use crate::link::Kind;
use crate::tree::RigidTree;
use crate::workspace::TreeWorkspace;

/// The motion y = (q, v) of a tree under forces.
///
/// It is a [`Field`], whose steps end with unit quaternions where the method projects, and a [`GroupField`] for the methods on
/// Lie groups.
///
/// # Example
/// A pendulum of length l = 9.81 m swings through 1 mm in 2π s.
/// ```
/// use piola_integrators::{DormandPrince853, State, Tolerance};
/// use piola_multibody::{BodyIndex, BodyInertia, JointKind, RigidTree, TreeJoint};
/// let mut builder = RigidTree::builder();
/// let hinge = TreeJoint::new("hinge", JointKind::Revolute { axis: [0.0, 1.0, 0.0] });
/// builder.attach(BodyIndex::GROUND, hinge, "bob", BodyInertia::particle(1.0, [0.0, 0.0, -9.81])?)?;
/// let tree = builder.build()?;
/// let mut motion = tree.motion(|_t, _q, _v, tau| tau.fill(0.0));
/// let mut state = State::new(0.0, vec![1e-4_f64, 0.0])?;
/// let period = 2.0 * std::f64::consts::PI;
/// DormandPrince853::new(Tolerance::relative(1e-12)?).integrate_to(&mut motion, &mut state, period)?;
/// assert!((state.values[0] / 1e-4 - 1.0).abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct TreeMotion<'a, F, T = f64> {
    tree: &'a RigidTree,
    group: DirectProduct<TreeGroup<'a>, Translations>,
    work: TreeWorkspace<T>,
    tau: Vec<T>,
    forces: F,
}

impl RigidTree {
    /// The motion under forces τ(t, q, v), written to the last argument.
    pub fn motion<T: Real, F: FnMut(f64, &[T], &[T], &mut [T])>(&self, forces: F) -> TreeMotion<'_, F, T> {
        let group = DirectProduct(TreeGroup(self), Translations(self.freedoms));
        TreeMotion { tree: self, group, work: self.workspace(), tau: vec![T::zero(); self.freedoms], forces }
    }

    /// The rates q̇ of the coordinates.
    ///
    /// # Errors
    /// [`MultibodyError::WrongLength`].
    pub fn coordinate_rates<T: Real>(&self, q: &[T], v: &[T], out: &mut [T]) -> Result<(), MultibodyError> {
        check_length("q", self.coordinates, q.len())?;
        check_length("v", self.freedoms, v.len())?;
        check_length("out", self.coordinates, out.len())?;
        for link in &self.links {
            let (k, v) = (link.q, &v[link.v..]);
            match link.kind {
                Kind::Spherical | Kind::Free => {
                    let attitude = piola_kinematics::Attitude { w: q[k], x: q[k + 1], y: q[k + 2], z: q[k + 3] };
                    let rate = attitude.rate(&nalgebra::Vector3::new(v[0], v[1], v[2]));
                    out[k..k + 4].copy_from_slice(&rate);
                    if link.kind == Kind::Free {
                        let velocity = attitude.to_space(&nalgebra::Vector3::new(v[3], v[4], v[5]));
                        out[k + 4..k + 7].copy_from_slice(velocity.as_slice());
                    }
                }
                _ => out[k] = v[0],
            }
        }
        Ok(())
    }

    /// Gives all quaternions of a configuration unit length.
    ///
    /// # Errors
    /// [`MultibodyError::WrongLength`].
    pub fn normalise<T: Real>(&self, q: &mut [T]) -> Result<(), MultibodyError> {
        check_length("q", self.coordinates, q.len())?;
        for &link in &self.quaternions {
            let k = self.links[link].q;
            let squared = q[k] * q[k] + q[k + 1] * q[k + 1] + q[k + 2] * q[k + 2] + q[k + 3] * q[k + 3];
            let reciprocal = squared.sqrt().recip();
            for x in &mut q[k..k + 4] {
                *x *= reciprocal;
            }
        }
        Ok(())
    }
}

impl<T: Real, F: FnMut(f64, &[T], &[T], &mut [T])> Field<T> for TreeMotion<'_, F, T> {
    type Error = MultibodyError;
    fn dimension(&self) -> usize {
        self.tree.coordinates + self.tree.freedoms
    }
    fn rate(&mut self, t: f64, y: &[T], rate: &mut [T]) -> Result<(), MultibodyError> {
        let (q, v) = y.split_at(self.tree.coordinates);
        let (q_rate, v_rate) = rate.split_at_mut(self.tree.coordinates);
        (self.forces)(t, q, v, &mut self.tau);
        self.tree.coordinate_rates(q, v, q_rate)?;
        self.tree.forward_dynamics(&mut self.work, q, v, &self.tau, v_rate)
    }
    fn is_second_order(&self) -> bool {
        self.tree.quaternions.is_empty()
    }
    fn project(&mut self, _t: f64, y: &mut [T]) -> Result<(), MultibodyError> {
        self.tree.normalise(&mut y[..self.tree.coordinates])
    }
}

impl<'a, T: Real, F: FnMut(f64, &[T], &[T], &mut [T])> GroupField<T> for TreeMotion<'a, F, T> {
    type Error = MultibodyError;
    type Group = DirectProduct<TreeGroup<'a>, Translations>;
    fn group(&self) -> &Self::Group {
        &self.group
    }
    fn velocity(&mut self, t: f64, element: &[T], velocity: &mut [T]) -> Result<(), MultibodyError> {
        let (q, v) = element.split_at(self.tree.coordinates);
        let (of_q, of_v) = velocity.split_at_mut(self.tree.freedoms);
        (self.forces)(t, q, v, &mut self.tau);
        of_q.copy_from_slice(v);
        self.tree.forward_dynamics(&mut self.work, q, v, &self.tau, of_v)
    }
}
