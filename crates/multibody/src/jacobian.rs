//! Jacobians of bodies and frames and their rates.
//!
//! ```text
//! (ω; ẋ) = J v        (α; ẍ) = J v̇ + J̇ v        space axes, x the origin of the frame
//! ```

use piola_numerics::Real;

use crate::error::{MultibodyError, check_length};
use crate::kinematics::arm;
use crate::space::{RATE, Runs, SUBSPACE, motion_at, motion_cross, pass_subspaces, put_pair, reference, row_pair};
use crate::spatial::{add, cross, sub};
use crate::tree::{BodyIndex, FrameIndex, Mounted, RigidTree};
use crate::workspace::TreeWorkspace;

impl RigidTree {
    /// The Jacobian of a body's frame, 6×n: angular velocity, then velocity of the origin, in space axes.
    ///
    /// `out` holds 6 n entries, (i, j) at `i + 6 j`.
    ///
    /// # Errors
    /// As [`forward_kinematics`](Self::forward_kinematics); [`MultibodyError::NoSuchIndex`].
    ///
    /// # Example
    /// ```
    /// use piola_multibody::{BodyIndex, BodyInertia, JointKind, RigidTree, TreeJoint};
    /// let mut builder = RigidTree::builder();
    /// let rails = TreeJoint::new("rails", JointKind::Prismatic { axis: [1.0, 0.0, 0.0] });
    /// let cart = builder.attach(BodyIndex::GROUND, rails, "cart", BodyInertia::particle(2.0, [0.0; 3])?)?;
    /// let tree = builder.build()?;
    /// let mut jacobian = [0.0; 6];
    /// tree.jacobian(&mut tree.workspace(), &[0.3], cart, &mut jacobian)?;
    /// assert_eq!(jacobian, [0.0, 0.0, 0.0, 1.0, 0.0, 0.0]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn jacobian<T: Real>(
        &self,
        work: &mut TreeWorkspace<T>,
        q: &[T],
        body: BodyIndex,
        out: &mut [T],
    ) -> Result<(), MultibodyError> {
        check_length("out", 6 * self.freedoms, out.len())?;
        let mounted = self.mounted(body)?;
        self.forward_kinematics(work, q)?;
        self.fill_jacobian(work, mounted, out);
        Ok(())
    }

    /// The Jacobian of a frame: see [`jacobian`](Self::jacobian).
    ///
    /// # Errors
    /// As [`jacobian`](Self::jacobian).
    pub fn jacobian_of_frame<T: Real>(
        &self,
        work: &mut TreeWorkspace<T>,
        q: &[T],
        frame: FrameIndex,
        out: &mut [T],
    ) -> Result<(), MultibodyError> {
        check_length("out", 6 * self.freedoms, out.len())?;
        let mounted = self.mounted_frame(frame)?;
        self.forward_kinematics(work, q)?;
        self.fill_jacobian(work, mounted, out);
        Ok(())
    }

    /// The rate J̇(q, v) of the Jacobian of a body's frame.
    ///
    /// # Errors
    /// As [`jacobian`](Self::jacobian).
    pub fn jacobian_rate<T: Real>(
        &self,
        work: &mut TreeWorkspace<T>,
        q: &[T],
        v: &[T],
        body: BodyIndex,
        out: &mut [T],
    ) -> Result<(), MultibodyError> {
        check_length("out", 6 * self.freedoms, out.len())?;
        let mounted = self.mounted(body)?;
        self.forward_velocities(work, q, v)?;
        self.fill_jacobian_rate(work, mounted, out);
        Ok(())
    }

    /// The rate J̇(q, v) of the Jacobian of a frame.
    ///
    /// # Errors
    /// As [`jacobian`](Self::jacobian).
    pub fn jacobian_rate_of_frame<T: Real>(
        &self,
        work: &mut TreeWorkspace<T>,
        q: &[T],
        v: &[T],
        frame: FrameIndex,
        out: &mut [T],
    ) -> Result<(), MultibodyError> {
        check_length("out", 6 * self.freedoms, out.len())?;
        let mounted = self.mounted_frame(frame)?;
        self.forward_velocities(work, q, v)?;
        self.fill_jacobian_rate(work, mounted, out);
        Ok(())
    }

    /// The Jacobian at the origin of a frame; places must be there.
    pub(crate) fn fill_jacobian<T: Real>(&self, work: &mut TreeWorkspace<T>, mounted: &Mounted, out: &mut [T]) {
        pass_subspaces(self, &work.space, &mut work.rows);
        let reference = reference(&work.space);
        let link = &work.space[mounted.link];
        let point = sub(add(link.origin, arm(link.axes, mounted)), reference);
        out.fill(T::zero());
        for (first, end) in Runs::of(self, mounted.link) {
            for j in first..end {
                let (angular, linear) = row_pair(&work.rows, SUBSPACE, j);
                let linear = add(linear, cross(angular, point));
                out[6 * j..6 * j + 3].copy_from_slice(&angular);
                out[6 * j + 3..6 * j + 6].copy_from_slice(&linear);
            }
        }
    }

    /// The rate of the Jacobian at the origin of a frame; places and velocities must be there.
    fn fill_jacobian_rate<T: Real>(&self, work: &mut TreeWorkspace<T>, mounted: &Mounted, out: &mut [T]) {
        pass_subspaces(self, &work.space, &mut work.rows);
        self.pass_subspace_rates(work);
        let reference = reference(&work.space);
        let link = &work.space[mounted.link];
        let arm = arm(link.axes, mounted);
        let point = sub(add(link.origin, arm), reference);
        let velocity = add(link.velocity, cross(link.w, arm));
        out.fill(T::zero());
        for (first, end) in Runs::of(self, mounted.link) {
            for j in first..end {
                let (angular, _) = row_pair(&work.rows, SUBSPACE, j);
                let (angular_rate, linear_rate) = row_pair(&work.rows, RATE, j);
                // d/dt (s_v + s_ω × (x − o)) with the moving point x.
                let linear = add(linear_rate, add(cross(angular_rate, point), cross(angular, velocity)));
                out[6 * j..6 * j + 3].copy_from_slice(&angular_rate);
                out[6 * j + 3..6 * j + 6].copy_from_slice(&linear);
            }
        }
    }

    /// Ṡ = v × S of all freedoms; their S, places and velocities must be there.
    pub(crate) fn pass_subspace_rates<T: Real>(&self, work: &mut TreeWorkspace<T>) {
        let reference = reference(&work.space);
        for (i, link) in self.links.iter().enumerate() {
            let motion = motion_at(&work.space[i + 1], reference);
            for j in link.v..link.v + link.kind.freedoms() {
                let rate = motion_cross(motion, row_pair(&work.rows, SUBSPACE, j));
                put_pair(&mut work.rows, RATE, j, rate);
            }
        }
    }
}
