//! Forward kinematics: where bodies and frames are, how they move and accelerate.
//!
//! All vectors are in space axes; velocities and accelerations are those of the origin of the body's frame.

use piola_numerics::Real;

use crate::error::{MultibodyError, check_finite, check_length};
use crate::space::{pass_accelerations, pass_places, pass_velocities};
use crate::spatial::{Matrix, Vector, add, cross, lit, lit_matrix, product, times};
use crate::tree::{BodyIndex, FrameIndex, Mounted, RigidTree};
use crate::workspace::TreeWorkspace;

/// The place of a body's frame in space.
///
/// # Example
/// See [`RigidTree::forward_kinematics`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FramePlace<T> {
    /// The rows of the rotation that takes components in the frame's axes to space.
    pub rotation: [[T; 3]; 3],
    /// The origin, m.
    pub origin: [T; 3],
}

/// The velocity of a body's frame, in space axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameVelocity<T> {
    /// Angular velocity, rad/s.
    pub angular: [T; 3],
    /// Velocity of the origin, m/s.
    pub linear: [T; 3],
}

/// The acceleration of a body's frame, in space axes: without gravity, so that a frame at rest has none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameAcceleration<T> {
    /// Angular acceleration, rad/s².
    pub angular: [T; 3],
    /// Acceleration of the origin, m/s².
    pub linear: [T; 3],
}

impl RigidTree {
    /// Computes where all bodies are: read the results by [`place_of`](Self::place_of).
    ///
    /// # Errors
    /// [`MultibodyError::WrongLength`], [`MultibodyError::NotFinite`], [`MultibodyError::NotUnitQuaternion`],
    /// [`MultibodyError::OtherWorkspace`].
    ///
    /// # Example
    /// A quarter turn about y takes a particle at x = 0.5 m to z = −0.5 m.
    /// ```
    /// use piola_kinematics::Attitude;
    /// use piola_multibody::{BodyIndex, BodyInertia, JointKind, RigidTree, TreeJoint};
    /// let mut builder = RigidTree::builder();
    /// let hinge = TreeJoint::new("hinge", JointKind::Revolute { axis: [0.0, 1.0, 0.0] });
    /// let bob = builder.attach(BodyIndex::GROUND, hinge, "bob", BodyInertia::particle(2.0, [0.5, 0.0, 0.0])?)?;
    /// let tip = builder.add_frame(bob, "tip", [0.5, 0.0, 0.0], Attitude::identity())?;
    /// let tree = builder.build()?;
    /// let mut work = tree.workspace();
    /// tree.forward_kinematics(&mut work, &[std::f64::consts::FRAC_PI_2])?;
    /// let place = tree.place_of_frame(&work, tip)?;
    /// assert!((place.origin[2] + 0.5).abs() < 1e-15 && place.origin[0].abs() < 1e-15);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn forward_kinematics<T: Real>(&self, work: &mut TreeWorkspace<T>, q: &[T]) -> Result<(), MultibodyError> {
        self.check_workspace(work)?;
        check_length("q", self.coordinates, q.len())?;
        check_finite("q", q)?;
        self.check_quaternions(q)?;
        pass_places(self, &mut work.space, q);
        Ok(())
    }

    /// Computes where all bodies are and how they move: read the results by [`velocity_of`](Self::velocity_of).
    ///
    /// # Errors
    /// As [`forward_kinematics`](Self::forward_kinematics).
    pub fn forward_velocities<T: Real>(
        &self,
        work: &mut TreeWorkspace<T>,
        q: &[T],
        v: &[T],
    ) -> Result<(), MultibodyError> {
        check_length("v", self.freedoms, v.len())?;
        check_finite("v", v)?;
        self.forward_kinematics(work, q)?;
        pass_velocities(self, &mut work.space, v);
        Ok(())
    }

    /// Computes where all bodies are, how they move and accelerate: read the results by
    /// [`acceleration_of`](Self::acceleration_of).
    ///
    /// # Errors
    /// As [`forward_kinematics`](Self::forward_kinematics).
    pub fn forward_accelerations<T: Real>(
        &self,
        work: &mut TreeWorkspace<T>,
        q: &[T],
        v: &[T],
        a: &[T],
    ) -> Result<(), MultibodyError> {
        check_length("a", self.freedoms, a.len())?;
        check_finite("a", a)?;
        self.forward_velocities(work, q, v)?;
        pass_accelerations(self, &mut work.space, v, a);
        Ok(())
    }

    /// The place of a body after [`forward_kinematics`](Self::forward_kinematics).
    ///
    /// # Errors
    /// [`MultibodyError::NoSuchIndex`].
    pub fn place_of<T: Real>(&self, work: &TreeWorkspace<T>, body: BodyIndex) -> Result<FramePlace<T>, MultibodyError> {
        Ok(place(work, self.mounted(body)?))
    }

    /// The place of a frame after [`forward_kinematics`](Self::forward_kinematics).
    ///
    /// # Errors
    /// [`MultibodyError::NoSuchIndex`].
    pub fn place_of_frame<T: Real>(
        &self,
        work: &TreeWorkspace<T>,
        frame: FrameIndex,
    ) -> Result<FramePlace<T>, MultibodyError> {
        Ok(place(work, self.mounted_frame(frame)?))
    }

    /// The velocity of a body after [`forward_velocities`](Self::forward_velocities).
    ///
    /// # Errors
    /// [`MultibodyError::NoSuchIndex`].
    pub fn velocity_of<T: Real>(
        &self,
        work: &TreeWorkspace<T>,
        body: BodyIndex,
    ) -> Result<FrameVelocity<T>, MultibodyError> {
        Ok(velocity(work, self.mounted(body)?))
    }

    /// The velocity of a frame after [`forward_velocities`](Self::forward_velocities).
    ///
    /// # Errors
    /// [`MultibodyError::NoSuchIndex`].
    pub fn velocity_of_frame<T: Real>(
        &self,
        work: &TreeWorkspace<T>,
        frame: FrameIndex,
    ) -> Result<FrameVelocity<T>, MultibodyError> {
        Ok(velocity(work, self.mounted_frame(frame)?))
    }

    /// The acceleration of a body after [`forward_accelerations`](Self::forward_accelerations).
    ///
    /// # Errors
    /// [`MultibodyError::NoSuchIndex`].
    pub fn acceleration_of<T: Real>(
        &self,
        work: &TreeWorkspace<T>,
        body: BodyIndex,
    ) -> Result<FrameAcceleration<T>, MultibodyError> {
        Ok(acceleration(work, self.mounted(body)?))
    }

    /// The acceleration of a frame after [`forward_accelerations`](Self::forward_accelerations).
    ///
    /// # Errors
    /// [`MultibodyError::NoSuchIndex`].
    pub fn acceleration_of_frame<T: Real>(
        &self,
        work: &TreeWorkspace<T>,
        frame: FrameIndex,
    ) -> Result<FrameAcceleration<T>, MultibodyError> {
        Ok(acceleration(work, self.mounted_frame(frame)?))
    }
}

/// From the link's origin to the frame's, in space axes.
pub(crate) fn arm<T: Real>(axes: Matrix<T>, mounted: &Mounted) -> Vector<T> {
    times(axes, lit(mounted.origin))
}

fn place<T: Real>(work: &TreeWorkspace<T>, mounted: &Mounted) -> FramePlace<T> {
    let link = &work.space[mounted.link];
    FramePlace {
        rotation: product(link.axes, lit_matrix(mounted.axes)),
        origin: add(link.origin, arm(link.axes, mounted)),
    }
}

fn velocity<T: Real>(work: &TreeWorkspace<T>, mounted: &Mounted) -> FrameVelocity<T> {
    let link = &work.space[mounted.link];
    FrameVelocity { angular: link.w, linear: add(link.velocity, cross(link.w, arm(link.axes, mounted))) }
}

fn acceleration<T: Real>(work: &TreeWorkspace<T>, mounted: &Mounted) -> FrameAcceleration<T> {
    let link = &work.space[mounted.link];
    let arm = arm(link.axes, mounted);
    let carried = add(cross(link.alpha, arm), cross(link.w, cross(link.w, arm)));
    FrameAcceleration { angular: link.alpha, linear: add(link.acceleration, carried) }
}
