//! The rotation of one rigid body about its centre of mass, by Euler's second law and unit quaternions.
//!
//! ```text
//! q̇ = ½ q ∘ ω        I ω̇ + ω × I ω = G                                               W(4.8–4.9)
//! ```
//!
//! The state is y = (w, x, y, z; ω₁, ω₂, ω₃), components of ω in the body basis. There is no chart and so no
//! singular attitude.

use nalgebra::Vector3;
use piola_integrators::Field;
use piola_kinematics::{Attitude, RigidBody};
use piola_numerics::Real;

use crate::LagrangianError;
use crate::newton_euler::NewtonEuler;

/// The moment that acts on a body.
///
/// Any system of moments G(t, attitude, ω), N m, body components; [`Torque::moment`] is written once for any
/// scalar.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_lagrangian::rigid_motion::{RigidRotation, Torque};
/// use piola_kinematics::{Attitude, Inertia, RigidBody};
/// use piola_numerics::Real;
/// /// A moment of 6 N m about the vertical of space.
/// struct Wrench;
/// impl Torque for Wrench {
///     fn moment<T: Real>(&self, _t: T, attitude: Attitude<T>, _angular_velocity: Vector3<T>) -> Vector3<T> {
///         attitude.to_body(&Vector3::new(T::zero(), T::zero(), T::lit(6.0)))
///     }
/// }
/// let body = RigidBody::new(1.0, Inertia::principal([1.0, 2.0, 2.5])?)?;
/// // Lying on its side, so that f₂ points up: ω̇² = 6/2.
/// let lying = Attitude::about_x(std::f64::consts::FRAC_PI_2);
/// let rotation = RigidRotation::driven(&body, Wrench)?;
/// let rate = rotation.angular_acceleration(0.0, lying, Vector3::zeros());
/// assert!((rate.y - 3.0).abs() < 1e-15 && rate.z.abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// W(4.8).
pub trait Torque {
    /// The moment about the centre of mass.
    fn moment<T: Real>(&self, t: T, attitude: Attitude<T>, angular_velocity: Vector3<T>) -> Vector3<T>;
}

/// No moment: free rotation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct NoTorque;

impl Torque for NoTorque {
    fn moment<T: Real>(&self, _t: T, _attitude: Attitude<T>, _angular_velocity: Vector3<T>) -> Vector3<T> {
        Vector3::new(T::zero(), T::zero(), T::zero())
    }
}

/// The rotation of a rigid body as a field.
///
/// # Example
/// ```
/// use piola_lagrangian::rigid_motion::RigidRotation;
/// use piola_integrators::{DormandPrince853, State, Tolerance};
/// use piola_kinematics::{Inertia, RigidBody};
/// let body = RigidBody::new(1.0, Inertia::principal([1.0, 2.0, 2.5])?)?;
/// // Turning about a principal axis with 1 rad/s for half a turn: the attitude is the quaternion k.
/// let mut state = State::<f64>::new(0.0, vec![1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0])?;
/// let mut method = DormandPrince853::new(Tolerance::relative(1e-13)?);
/// method.integrate_to(&mut RigidRotation::free(&body)?, &mut state, std::f64::consts::PI)?;
/// assert!((state.values[3] - 1.0).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct RigidRotation<'a, G = NoTorque> {
    laws: NewtonEuler<'a>,
    torque: G,
}

impl<'a> RigidRotation<'a> {
    /// Free rotation.
    ///
    /// # Errors
    /// [`LagrangianError::Numerics`] when the inertia tensor cannot be inverted.
    pub fn free(body: &'a RigidBody) -> Result<Self, LagrangianError> {
        Self::driven(body, NoTorque)
    }
}

impl<'a, G: Torque> RigidRotation<'a, G> {
    /// Rotation under a moment.
    ///
    /// # Errors
    /// [`LagrangianError::Numerics`] when the inertia tensor cannot be inverted.
    pub fn driven(body: &'a RigidBody, torque: G) -> Result<Self, LagrangianError> {
        Ok(Self { laws: NewtonEuler::of(body)?, torque })
    }

    /// The angular acceleration ω̇ = I⁻¹(G − ω × I ω), rad/s², body components.
    ///
    /// # Source
    /// W(4.9).
    pub fn angular_acceleration<T: Real>(
        &self,
        t: T,
        attitude: Attitude<T>,
        angular_velocity: Vector3<T>,
    ) -> Vector3<T> {
        let moment = self.torque.moment(t, attitude, angular_velocity);
        self.laws.angular_acceleration(&moment, &angular_velocity)
    }
}

impl<G: Torque, T: Real> Field<T> for RigidRotation<'_, G> {
    type Error = LagrangianError;
    fn dimension(&self) -> usize {
        7
    }
    fn rate(&mut self, t: f64, y: &[T], rate: &mut [T]) -> Result<(), LagrangianError> {
        let attitude = Attitude { w: y[0], x: y[1], y: y[2], z: y[3] };
        let omega = Vector3::new(y[4], y[5], y[6]);
        rate[..4].copy_from_slice(&attitude.rate(&omega));
        rate[4..].copy_from_slice(self.angular_acceleration(T::lit(t), attitude, omega).as_slice());
        Ok(())
    }
    fn magnitudes(&self, y: &[T], magnitudes: &mut [f64]) {
        // The quaternion has length one; the angular velocity its own size.
        let size = (4..7).map(|i| y[i].primal(0).abs()).fold(0.0, f64::max);
        magnitudes[..4].fill(1.0);
        magnitudes[4..].fill(size);
    }
}
