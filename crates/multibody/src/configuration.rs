//! Configurations on their manifold: neutral, random, moved, compared.
//!
//! ```text
//! q ⊕ δ: numbers add; a quaternion becomes q exp(½ δ); a free joint moves along a screw
//! q ⊕ (r ⊖ q) = r
//! ```
//!
//! δ is a displacement in the tangent space of v: what constant v does in one second.

use piola_geometric::{LieGroup, RigidMotions, Rotations};
use piola_kinematics::Attitude;
use piola_numerics::Real;

use crate::error::{MultibodyError, check_finite, check_length};
use crate::link::Kind;
use crate::tree::RigidTree;

impl RigidTree {
    /// Writes the configuration at rest of all joints: zeros and unit quaternions.
    ///
    /// # Errors
    /// [`MultibodyError::WrongLength`].
    pub fn neutral_configuration<T: Real>(&self, q: &mut [T]) -> Result<(), MultibodyError> {
        check_length("q", self.coordinates, q.len())?;
        q.fill(T::zero());
        for &link in &self.quaternions {
            q[self.links[link].q] = T::one();
        }
        Ok(())
    }

    /// Writes a configuration drawn from numbers that are uniform in [0, 1).
    ///
    /// Coordinates are uniform between the joint's limits where both are finite, and else angles in [−π, π), displacements in
    /// [−1, 1) m. Rotations are uniform.
    ///
    /// # Errors
    /// [`MultibodyError::WrongLength`], [`MultibodyError::NotFinite`].
    ///
    /// # References
    /// K. Shoemake, *Uniform random rotations*, Graphics Gems III (1992) 124.
    pub fn random_configuration(&self, mut uniform: impl FnMut() -> f64, q: &mut [f64]) -> Result<(), MultibodyError> {
        check_length("q", self.coordinates, q.len())?;
        for link in &self.links {
            let limits = self.joints[link.joint].joint.limits;
            let between = |[lower, upper]: [f64; 2], u: f64| lower + (upper - lower) * u;
            let given = |default: f64| if limits.iter().all(|x| x.is_finite()) { limits } else { [-default, default] };
            let k = link.q;
            match link.kind {
                Kind::Prismatic => q[k] = between(given(1.0), uniform()),
                Kind::Spherical | Kind::Free => {
                    let [u, a, b] = [uniform(), uniform(), uniform()];
                    let turn = core::f64::consts::TAU;
                    let (s, c) = (turn * a).sin_cos();
                    let (z, w) = (turn * b).sin_cos();
                    let (small, large) = ((1.0 - u).sqrt(), u.sqrt());
                    q[k..k + 4].copy_from_slice(&[large * w, small * s, small * c, large * z]);
                    if link.kind == Kind::Free {
                        for x in &mut q[k + 4..k + 7] {
                            *x = between([-1.0, 1.0], uniform());
                        }
                    }
                }
                _ => q[k] = between(given(core::f64::consts::PI), uniform()),
            }
        }
        check_finite("q", q)
    }

    /// Moves a configuration along its manifold: q ← q ⊕ δ, with `displacement` δ of length [`freedoms`](Self::freedoms).
    ///
    /// # Errors
    /// [`MultibodyError::WrongLength`].
    ///
    /// # Accuracy
    /// Quaternions keep their length to rounding.
    ///
    /// # Example
    /// Half a turn about z.
    /// ```
    /// use piola_multibody::{BodyIndex, BodyInertia, JointKind, RigidTree, TreeJoint};
    /// let mut builder = RigidTree::builder();
    /// let ball = BodyInertia::new(1.0, [0.0; 3], [[0.4, 0.0, 0.0], [0.0, 0.4, 0.0], [0.0, 0.0, 0.4]])?;
    /// builder.attach(BodyIndex::GROUND, TreeJoint::new("socket", JointKind::Spherical), "ball", ball)?;
    /// let tree = builder.build()?;
    /// let mut q = [1.0, 0.0, 0.0, 0.0];
    /// tree.move_configuration(&mut q, &[0.0, 0.0, std::f64::consts::PI])?;
    /// assert!(q[0].abs() < 1e-15 && (q[3] - 1.0).abs() < 1e-15);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[doc(alias("integrate", "retraction", "exponential map"))]
    pub fn move_configuration<T: Real>(&self, q: &mut [T], displacement: &[T]) -> Result<(), MultibodyError> {
        check_length("q", self.coordinates, q.len())?;
        check_length("displacement", self.freedoms, displacement.len())?;
        for link in &self.links {
            let mut carry = [T::zero(); 7];
            let (q, delta) = (&mut q[link.q..], &displacement[link.v..]);
            match link.kind {
                Kind::Spherical => {
                    Rotations.advance(&mut q[..4], &mut carry[..4], &delta[..3]);
                    Rotations.renormalise(&mut q[..4], &mut carry[..4]);
                }
                Kind::Free => {
                    RigidMotions.advance(&mut q[..7], &mut carry, &delta[..6]);
                    RigidMotions.renormalise(&mut q[..7], &mut carry);
                }
                _ => q[0] += delta[0],
            }
        }
        Ok(())
    }

    /// The displacement from one configuration to another: `from` ⊕ δ = `to`, with rotations of at most π.
    ///
    /// # Errors
    /// [`MultibodyError::WrongLength`].
    #[doc(alias("logarithm", "ominus"))]
    pub fn displacement<T: Real>(&self, from: &[T], to: &[T], out: &mut [T]) -> Result<(), MultibodyError> {
        check_length("from", self.coordinates, from.len())?;
        check_length("to", self.coordinates, to.len())?;
        check_length("out", self.freedoms, out.len())?;
        for link in &self.links {
            let (k, v) = (link.q, link.v);
            match link.kind {
                Kind::Spherical | Kind::Free => {
                    let [start, end] = [from, to].map(|q| Attitude { w: q[k], x: q[k + 1], y: q[k + 2], z: q[k + 3] });
                    let theta = start.conjugate().product(end).rotation_vector();
                    out[v..v + 3].copy_from_slice(&[theta.x, theta.y, theta.z]);
                    if link.kind == Kind::Free {
                        let arm = nalgebra::Vector3::new(
                            to[k + 4] - from[k + 4],
                            to[k + 5] - from[k + 5],
                            to[k + 6] - from[k + 6],
                        );
                        let arm = start.to_body(&arm);
                        let mut linear = [arm.x, arm.y, arm.z];
                        // The inverse of the mean rotation on the way.
                        Rotations.inverse_differential(&[-theta.x, -theta.y, -theta.z], &mut linear);
                        out[v + 3..v + 6].copy_from_slice(&linear);
                    }
                }
                _ => out[v] = to[k] - from[k],
            }
        }
        Ok(())
    }

    /// The configuration at the share s of the way from one to another: `from` ⊕ s (`to` ⊖ `from`).
    ///
    /// `work` is memory for a displacement.
    ///
    /// # Errors
    /// [`MultibodyError::WrongLength`].
    pub fn interpolate<T: Real>(
        &self,
        from: &[T],
        to: &[T],
        share: T,
        work: &mut [T],
        out: &mut [T],
    ) -> Result<(), MultibodyError> {
        check_length("out", self.coordinates, out.len())?;
        self.displacement(from, to, work)?;
        for x in work.iter_mut() {
            *x *= share;
        }
        out.copy_from_slice(from);
        self.move_configuration(out, work)
    }
}
