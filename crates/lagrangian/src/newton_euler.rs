//! Newton's equation of a particle and Euler's two laws of a rigid body, free or with its reactions put back.
//!
//! ```text
//! m a = f                                                                                     W(4.2)
//! M a^c = F                                                                                   W(4.5)
//! dH/dt = r^c×F + G     about a fixed origin                                                  W(4.6)
//! I ω̇ + ω×Iω = G        about the centre of mass, body components                              W(4.8–4.9)
//! I₁ ω̇¹ − (I₂ − I₃) ω² ω³ = G¹ and cyclic, in principal axes                                   W(4.10)
//! I (W θ̈ + Ẇ θ̇) + ω×Iω = G,  ω = W θ̇, in Eulerian angles z–y–z                                W(4.12)
//! ```
//!
//! Forces and linear accelerations have space components; moments, angular velocities and angular accelerations
//! have body components.
//!
//! [`rigid_motion`](crate::rigid_motion) integrates them; [`Lagrangian`](crate::Lagrangian) gives the same motions
//! in generalised coordinates, and the [reactions](crate::Lagrangian::reactions) that make a
//! constrained body obey these laws as if it were free.

use nalgebra::{Matrix3, Vector3};
use piola_kinematics::{EulerAngles, KinematicsError, RigidBody};
use piola_numerics::Real;
use piola_numerics::linear::matrix3::{self, cross, dot};

use crate::LagrangianError;
use crate::check::check_finite;

/// The acceleration of a particle, m/s².
///
/// ```text
/// a = f/m
/// ```
///
/// # Errors
/// [`LagrangianError::InvalidMass`] unless 0 < m < ∞; [`LagrangianError::NotFinite`].
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// let acceleration = piola_lagrangian::newton_euler::particle_acceleration(2.0, &Vector3::new(6.0, 0.0, -20.0))?;
/// assert_eq!(acceleration, Vector3::new(3.0, 0.0, -10.0));
/// # Ok::<(), piola_lagrangian::LagrangianError>(())
/// ```
///
/// # Source
/// W(4.2).
pub fn particle_acceleration<T: Real>(mass: f64, force: &Vector3<T>) -> Result<Vector3<T>, LagrangianError> {
    if !(0.0 < mass && mass < f64::INFINITY) {
        return Err(LagrangianError::InvalidMass { part: 0, mass });
    }
    check_finite("force", force.as_slice())?;
    Ok(force.map(|f| f / T::lit(mass)))
}

/// The angular acceleration in principal axes, rad/s²: Euler's equations.
///
/// ```text
/// ω̇¹ = (G¹ + (I₂ − I₃) ω² ω³)/I₁ and cyclic
/// ```
///
/// | symbol | argument | shape | unit |
/// |---|---|---|---|
/// | I₁, I₂, I₃ | `moments` | 3 | kg m² |
/// | G | `moment`, principal components | 3 | N m |
/// | ω | `angular_velocity`, principal components | 3 | rad/s |
///
/// The differences of the moments are taken exactly once, so that a body with two equal moments keeps the third
/// component of ω to the last bit.
///
/// # Errors
/// [`LagrangianError::Kinematics`] unless 0 < I₁, I₂, I₃; [`LagrangianError::NotFinite`].
///
/// # Accuracy
/// A few ulp of the larger of the two terms.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_lagrangian::newton_euler::principal_angular_acceleration;
/// let free = Vector3::zeros();
/// let rate = principal_angular_acceleration([1.0, 2.0, 4.0], &free, &Vector3::new(3.0, 5.0, 7.0))?;
/// assert_eq!(rate, Vector3::new(-70.0, 31.5, -3.75)); // −2·35/1, 3·21/2, −1·15/4
/// # Ok::<(), piola_lagrangian::LagrangianError>(())
/// ```
///
/// # Source
/// W(4.10).
pub fn principal_angular_acceleration<T: Real>(
    moments: [f64; 3],
    moment: &Vector3<T>,
    angular_velocity: &Vector3<T>,
) -> Result<Vector3<T>, LagrangianError> {
    check_finite("moments of inertia", &moments)?;
    check_finite("moment", moment.as_slice())?;
    check_finite("angular velocity", angular_velocity.as_slice())?;
    if !moments.iter().all(|&i| 0.0 < i) {
        let mut principal_moments = moments;
        principal_moments.sort_by(f64::total_cmp);
        return Err(KinematicsError::InertiaNotPositiveDefinite { principal_moments }.into());
    }
    let component = |i: usize| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let gyroscopic = T::lit(moments[j] - moments[k]) * angular_velocity[j] * angular_velocity[k];
        (moment[i] + gyroscopic) / T::lit(moments[i])
    };
    Ok(Vector3::new(component(0), component(1), component(2)))
}

/// The laws of motion of one rigid body.
///
/// Its methods are formulas of the state over any scalar: what is not finite shows in their results.
///
/// # Example
/// A ball of 2 kg and 0.5 kg m², rolling on a table, is pushed by 7 N at its centre. Friction holds it back with 2 N
/// at its lowest point, 0.5 m below: it gets 2.5 m/s² and turns with 2 rad/s².
/// ```
/// use nalgebra::Vector3;
/// use piola_lagrangian::newton_euler::NewtonEuler;
/// use piola_kinematics::{Inertia, RigidBody};
/// let ball = RigidBody::new(2.0, Inertia::principal([0.5; 3])?)?;
/// let laws = NewtonEuler::of(&ball)?;
/// let still = Vector3::zeros();
/// assert_eq!(laws.acceleration(&Vector3::new(7.0 - 2.0, 0.0, 0.0)).x, 2.5);
/// assert_eq!(laws.angular_acceleration(&Vector3::new(0.0, 0.5 * 2.0, 0.0), &still).y, 2.0);
/// assert_eq!(laws.force(&Vector3::new(0.0, 0.0, 10.0)).z, 20.0);
///
/// // Turned evenly about an axis that is none of its own, a body wants to throw itself over: (I₁ − I₃) ω³ ω¹.
/// let uneven = RigidBody::new(1.0, Inertia::principal([2.0, 3.0, 4.0])?)?;
/// let moment = NewtonEuler::of(&uneven)?.moment(&Vector3::new(1.0, 0.0, 1.0), &still);
/// assert_eq!(moment, Vector3::new(0.0, -2.0, 0.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct NewtonEuler<'a> {
    body: &'a RigidBody,
    inverse: Matrix3<f64>,
}

impl<'a> NewtonEuler<'a> {
    /// The laws of a body.
    ///
    /// # Errors
    /// [`LagrangianError::Numerics`] when the inertia tensor cannot be inverted.
    pub fn of(body: &'a RigidBody) -> Result<Self, LagrangianError> {
        Ok(Self { body, inverse: matrix3::inverse(&body.inertia().matrix())? })
    }

    /// The body.
    #[must_use]
    pub const fn body(&self) -> &'a RigidBody {
        self.body
    }

    /// The acceleration of the centre of mass, m/s²: a^c = F/M.
    ///
    /// # Source
    /// W(4.5).
    pub fn acceleration<T: Real>(&self, force: &Vector3<T>) -> Vector3<T> {
        force.map(|f| f / T::lit(self.body.mass()))
    }

    /// The angular acceleration, rad/s²: ω̇ = I⁻¹ (G − ω×Iω), in any body basis.
    ///
    /// # Accuracy
    /// A few ulp of the larger of the two terms, times the condition number of I.
    ///
    /// # Source
    /// W(4.8–4.9).
    pub fn angular_acceleration<T: Real>(&self, moment: &Vector3<T>, angular_velocity: &Vector3<T>) -> Vector3<T> {
        let spin = self.body.inertia().times(angular_velocity);
        let gyroscopic = cross((*angular_velocity).into(), spin.into());
        let rest: [T; 3] = core::array::from_fn(|k| moment[k] - gyroscopic[k]);
        let row = |k: usize| dot(core::array::from_fn(|j| T::lit(self.inverse[(k, j)])), rest);
        Vector3::new(row(0), row(1), row(2))
    }

    /// The force that an acceleration of the centre of mass needs, N: F = M a^c.
    ///
    /// # Source
    /// W(4.5).
    pub fn force<T: Real>(&self, acceleration: &Vector3<T>) -> Vector3<T> {
        acceleration.map(|a| T::lit(self.body.mass()) * a)
    }

    /// The moment about the centre of mass that a rotation needs, N m: G = I ω̇ + ω×Iω.
    ///
    /// # Source
    /// W(4.8–4.9).
    pub fn moment<T: Real>(&self, angular_velocity: &Vector3<T>, angular_acceleration: &Vector3<T>) -> Vector3<T> {
        self.body.spin_rate_in_body(angular_velocity, angular_acceleration)
    }

    /// The second rates of Eulerian angles, z–y–z or in any other sequence, rad/s².
    ///
    /// ```text
    /// θ̈ = W⁻¹ (I⁻¹ (G − ω×Iω) − Ẇ θ̇),   ω = W θ̇
    /// ```
    ///
    /// # Errors
    /// [`LagrangianError::Kinematics`] at a gimbal point and for what is not finite.
    ///
    /// # Accuracy
    /// A few ulp of the terms times the condition numbers of I and of the
    /// [chart](EulerAngles::condition_number).
    ///
    /// # Source
    /// W(4.12).
    pub fn eulerian_accelerations(
        &self,
        angles: &EulerAngles<f64>,
        rates: [f64; 3],
        moment: &Vector3<f64>,
    ) -> Result<[f64; 3], LagrangianError> {
        let angular_velocity = angles.angular_velocity_in_body(rates);
        let angular_acceleration = self.angular_acceleration(moment, &angular_velocity);
        Ok(angles.second_rates(rates, &angular_acceleration)?.rates)
    }
}

/// The moment about a fixed origin of a force at the centre of mass and a moment about it, N m, space components:
/// r^c×F + G, the rate of the angular momentum about that origin.
///
/// # Source
/// W(4.6).
pub fn moment_about_origin<T: Real>(centre: &Vector3<T>, force: &Vector3<T>, moment: &Vector3<T>) -> Vector3<T> {
    let of_force = cross((*centre).into(), (*force).into());
    Vector3::new(of_force[0] + moment[0], of_force[1] + moment[1], of_force[2] + moment[2])
}
