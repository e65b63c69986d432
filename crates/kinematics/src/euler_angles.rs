//! Eulerian angles z–y–z: a chart of the attitudes.
//!
//! Turn by θ¹ about e₃, by θ² about the moved second axis, by θ³ about f₃:
//!
//! ```text
//! f_i = Q_ij e_j,  Q = A₃ A₂ A₁                                           W(2.22–2.25)
//!      ⎡ c₁ s₁ 0⎤       ⎡c₂ 0 −s₂⎤       ⎡ c₃ s₃ 0⎤
//! A₁ = ⎢−s₁ c₁ 0⎥  A₂ = ⎢ 0 1  0 ⎥  A₃ = ⎢−s₃ c₃ 0⎥
//!      ⎣ 0  0  1⎦       ⎣s₂ 0  c₂⎦       ⎣ 0  0  1⎦
//!
//!                           ⎡−s₂c₃ s₃ 0⎤
//! ω_body = W θ̇,         W = ⎢ s₂s₃ c₃ 0⎥,   det W = −s₂                  W(2.26–2.28)
//!                           ⎣ c₂   0  1⎦
//! ω = θ̇¹ e₃ + θ̇² ē₂ + θ̇³ f₃
//! cond W = (1 + |c₂|)/|s₂|
//! ```
//!
//! The chart is singular at θ² = 0, π (gimbal points): there only θ¹ ± θ³ has a meaning. Ask
//! [`condition_number`](EulerZyz::condition_number) and change over to an [`Attitude`] before it is large.
//! Each sequence of axes is a type of its own, named after it.
//!
//! # References
//! W(2.22–2.28), W(5.30).

use nalgebra::{Matrix3, Vector3};
use piola_numerics::Real;

use crate::attitude::Attitude;
use crate::error::KinematicsError;

/// Eulerian angles z–y–z (rad).
///
/// # Example
/// ```
/// use piola_kinematics::EulerZyz;
/// // A top that only spins: all of θ̇³ is about f₃.
/// let top = EulerZyz { theta: [0.0, 0.5, 0.0] };
/// assert_eq!(top.angular_velocity_in_body([0.0, 0.0, 7.0]).z, 7.0);
/// ```
///
/// # Source
/// W(2.22).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(deny_unknown_fields, bound(deserialize = "T: piola_numerics::Real + serde::Deserialize<'de>"))
)]
pub struct EulerZyz<T> {
    /// θ¹, θ², θ³.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::finite::triple"))]
    pub theta: [T; 3],
}

/// The Eulerian angles of an attitude, as far as they are determined.
///
/// # Example
/// ```
/// use piola_kinematics::{Attitude, EulerZyz, euler_angles::AnglesOfAttitude};
/// let upright = EulerZyz::of_attitude(Attitude::about_z(0.5));
/// // θ² = 0: only θ¹ + θ³ = 0.5 is determined.
/// assert!(matches!(upright, AnglesOfAttitude::Gimbal { sum, .. } if (sum - 0.5).abs() < 1.0e-15));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AnglesOfAttitude {
    /// All three angles are determined.
    Regular {
        /// θ¹, θ³ in (−π, π], θ² in (0, π).
        angles: EulerZyz<f64>,
        /// (1 + |c₂|)/|s₂|: how much an error of the attitude grows in θ¹ and θ³.
        condition_number: f64,
    },
    /// θ² = 0 within rounding: only the sum of the outer angles is determined.
    Gimbal {
        /// One choice: θ³ = 0.
        angles: EulerZyz<f64>,
        /// θ¹ + θ³.
        sum: f64,
    },
    /// θ² = π within rounding: only the difference of the outer angles is determined.
    ReversedGimbal {
        /// One choice: θ³ = 0.
        angles: EulerZyz<f64>,
        /// θ¹ − θ³.
        difference: f64,
    },
}

impl AnglesOfAttitude {
    /// The angles, with the choice θ³ = 0 at a gimbal point.
    ///
    /// # Example
    /// ```
    /// # use piola_kinematics::{Attitude, EulerZyz};
    /// let angles = EulerZyz::of_attitude(Attitude::about_y(0.5)).angles();
    /// assert!((angles.theta[1] - 0.5).abs() <= f64::EPSILON);
    /// ```
    #[must_use]
    pub fn angles(&self) -> EulerZyz<f64> {
        match *self {
            Self::Regular { angles, .. } | Self::Gimbal { angles, .. } | Self::ReversedGimbal { angles, .. } => angles,
        }
    }
}

/// Rates of the angles at an angular velocity, and how well they are determined.
///
/// # Example
/// ```
/// # use nalgebra::Vector3;
/// # use piola_kinematics::EulerZyz;
/// let level = EulerZyz { theta: [0.0, std::f64::consts::FRAC_PI_2, 0.0] };
/// assert_eq!(level.rates(&Vector3::new(-2.0, 0.0, 0.0))?.condition_number.round(), 1.0);
/// # Ok::<(), piola_kinematics::KinematicsError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EulerRates {
    /// θ̇ (rad/s).
    pub rates: [f64; 3],
    /// cond W = (1 + |c₂|)/|s₂|.
    pub condition_number: f64,
}

impl<T: Real> EulerZyz<T> {
    /// The matrix Q: `f_i = Q_ij e_j`, `v_body = Q v_space`.
    ///
    /// # Example
    /// ```
    /// # use piola_kinematics::EulerZyz;
    /// let q = EulerZyz { theta: [0.0, 0.5, 0.0] }.matrix();
    /// assert_eq!(q[(2, 0)], 0.5_f64.sin()); // f₃ leans towards e₁
    /// ```
    ///
    /// # Source
    /// W(2.25).
    #[must_use]
    pub fn matrix(&self) -> Matrix3<T> {
        let [(s1, c1), (s2, c2), (s3, c3)] = self.theta.map(Real::sin_cos);
        Matrix3::new(
            c3 * c2 * c1 - s3 * s1,
            c3 * c2 * s1 + s3 * c1,
            -(c3 * s2),
            -(s3 * c2 * c1) - c3 * s1,
            c3 * c1 - s3 * c2 * s1,
            s3 * s2,
            s2 * c1,
            s2 * s1,
            c2,
        )
    }

    /// The matrix W: `ω_body = W θ̇`.
    ///
    /// # Example
    /// ```
    /// # use piola_kinematics::EulerZyz;
    /// let w = EulerZyz { theta: [0.3, 0.5, 0.0] }.rate_matrix();
    /// assert_eq!(w[(2, 0)], 0.5_f64.cos());
    /// ```
    ///
    /// # Source
    /// W(2.28).
    #[must_use]
    pub fn rate_matrix(&self) -> Matrix3<T> {
        let [_, (s2, c2), (s3, c3)] = self.theta.map(Real::sin_cos);
        let (zero, one) = (T::zero(), T::one());
        Matrix3::new(-(s2 * c3), s3, zero, s2 * s3, c3, zero, c2, zero, one)
    }

    /// det W = −sin θ².
    ///
    /// # Example
    /// ```
    /// # use piola_kinematics::EulerZyz;
    /// assert_eq!(EulerZyz { theta: [0.3, 0.0, 0.2] }.rate_matrix_determinant(), 0.0);
    /// ```
    #[must_use]
    pub fn rate_matrix_determinant(&self) -> T {
        -self.theta[1].sin()
    }

    /// cond W = (1 + |c₂|)/|s₂| in the spectral norm; infinite at θ² = 0.
    ///
    /// # Example
    /// ```
    /// # use piola_kinematics::EulerZyz;
    /// let near_gimbal = EulerZyz { theta: [0.0, 1.0e-8_f64, 0.0] };
    /// assert!((near_gimbal.condition_number() / 2.0e8 - 1.0).abs() <= f64::EPSILON);
    /// ```
    #[must_use]
    pub fn condition_number(&self) -> T {
        // W has the singular values √(1 + |c₂|), 1, √(1 − |c₂|).
        let (s2, c2) = self.theta[1].sin_cos();
        (T::one() + c2.abs()) / s2.abs()
    }

    /// Angular velocity in body components, ω = W θ̇ (rad/s).
    ///
    /// # Example
    /// See [`EulerZyz`].
    ///
    /// # Source
    /// W(2.26–2.28).
    #[must_use]
    pub fn angular_velocity_in_body(&self, rates: [T; 3]) -> Vector3<T> {
        let [_, (s2, c2), (s3, c3)] = self.theta.map(Real::sin_cos);
        let [r1, r2, r3] = rates;
        Vector3::new(s3 * r2 - s2 * c3 * r1, s2 * s3 * r1 + c3 * r2, c2 * r1 + r3)
    }

    /// Angular velocity in space components, θ̇¹ e₃ + θ̇² ē₂ + θ̇³ f₃ (rad/s).
    ///
    /// # Example
    /// ```
    /// # use piola_kinematics::EulerZyz;
    /// let top = EulerZyz { theta: [0.4, 0.5, 0.6] };
    /// assert_eq!(top.angular_velocity_in_space([7.0, 0.0, 0.0]).z, 7.0);
    /// ```
    ///
    /// # Source
    /// W(2.26).
    #[must_use]
    pub fn angular_velocity_in_space(&self, rates: [T; 3]) -> Vector3<T> {
        let [(s1, c1), (s2, c2), _] = self.theta.map(Real::sin_cos);
        let [r1, r2, r3] = rates;
        Vector3::new(s2 * c1 * r3 - s1 * r2, s2 * s1 * r3 + c1 * r2, r1 + c2 * r3)
    }

    /// Rate of the body components of ω: ω̇ = W θ̈ + Ẇ θ̇ (rad/s²).
    ///
    /// These are also the body components of the rate of ω in space, because ω×ω = 0.
    ///
    /// # Example
    /// ```
    /// # use piola_kinematics::EulerZyz;
    /// // Steady precession of a spinning top: ω̇ = θ̇¹ e₃ × θ̇³ f₃.
    /// let top = EulerZyz { theta: [0.0, std::f64::consts::FRAC_PI_2, 0.0] };
    /// let rate = top.angular_acceleration_in_body([2.0, 0.0, 3.0], [0.0; 3]);
    /// assert_eq!(rate.y, 6.0);
    /// ```
    ///
    /// # Source
    /// W(2.28), differentiated.
    #[must_use]
    pub fn angular_acceleration_in_body(&self, rates: [T; 3], second_rates: [T; 3]) -> Vector3<T> {
        let [_, (s2, c2), (s3, c3)] = self.theta.map(Real::sin_cos);
        let [r1, r2, r3] = rates;
        let changing = Vector3::new(
            r1 * (s2 * s3 * r3 - c2 * c3 * r2) + r2 * c3 * r3,
            r1 * (c2 * s3 * r2 + s2 * c3 * r3) - r2 * s3 * r3,
            -(s2 * r2 * r1),
        );
        self.angular_velocity_in_body(second_rates) + changing
    }

    /// Rate of the space components of ω (rad/s²).
    ///
    /// # Example
    /// ```
    /// # use piola_kinematics::EulerZyz;
    /// let top = EulerZyz { theta: [0.0, std::f64::consts::FRAC_PI_2, 0.0] };
    /// let rate = top.angular_acceleration_in_space([2.0, 0.0, 3.0], [0.0; 3]);
    /// assert_eq!(rate.y, 6.0);
    /// ```
    ///
    /// # Source
    /// W(2.26), differentiated.
    #[must_use]
    pub fn angular_acceleration_in_space(&self, rates: [T; 3], second_rates: [T; 3]) -> Vector3<T> {
        let [(s1, c1), (s2, c2), _] = self.theta.map(Real::sin_cos);
        let [r1, r2, r3] = rates;
        let changing = Vector3::new(
            r3 * (c2 * c1 * r2 - s2 * s1 * r1) - r2 * c1 * r1,
            r3 * (c2 * s1 * r2 + s2 * c1 * r1) - r2 * s1 * r1,
            -(s2 * r2 * r3),
        );
        self.angular_velocity_in_space(second_rates) + changing
    }

    /// The attitude with these angles.
    ///
    /// # Example
    /// ```
    /// # use piola_kinematics::{Attitude, EulerZyz};
    /// assert_eq!(EulerZyz { theta: [0.0_f64; 3] }.attitude(), Attitude::identity());
    /// ```
    #[must_use]
    pub fn attitude(&self) -> Attitude<T> {
        Attitude::from_euler_zyz(self.theta)
    }
}

/// Half angles up to this are zero to the rounding of a quaternion.
const GIMBAL: f64 = 4.0 * f64::EPSILON;

impl EulerZyz<f64> {
    /// Rates of the angles at an angular velocity in body components: θ̇ = W⁻¹ ω.
    ///
    /// # Errors
    /// [`KinematicsError::GimbalPoint`] where cond W exceeds 1/ε, so that no digit would be right;
    /// [`KinematicsError::NotFinite`].
    ///
    /// # Accuracy
    /// A few ulps × `condition_number`.
    ///
    /// # Example
    /// See [`EulerRates`].
    ///
    /// # Source
    /// W(2.28), inverted.
    pub fn rates(&self, angular_velocity_in_body: &Vector3<f64>) -> Result<EulerRates, KinematicsError> {
        for (quantity, values) in
            [("theta", &self.theta[..]), ("angular velocity", angular_velocity_in_body.as_slice())]
        {
            if let Some((index, value)) = crate::vector::first_non_finite(values) {
                return Err(KinematicsError::NotFinite { quantity, index, value });
            }
        }
        let condition_number = self.condition_number();
        if f64::EPSILON.recip() <= condition_number {
            return Err(KinematicsError::GimbalPoint { theta2: self.theta[1], condition_number });
        }
        let [_, (s2, c2), (s3, c3)] = self.theta.map(f64::sin_cos);
        let omega = angular_velocity_in_body;
        let first = (s3 * omega.y - c3 * omega.x) / s2;
        let rates = [first, s3 * omega.x + c3 * omega.y, omega.z - c2 * first];
        Ok(EulerRates { rates, condition_number })
    }

    /// The angles of an attitude; gimbal points are reported, not guessed.
    ///
    /// ```text
    /// θ² = 2 arctan(√(x²+y²)/√(w²+z²))   ½(θ³+θ¹) = arctan(z/w)   ½(θ³−θ¹) = arctan(x/y)
    /// ```
    ///
    /// # Accuracy
    /// θ² to a few ulps everywhere, also near 0 and π; θ¹ and θ³ to a few ulps × `condition_number`.
    ///
    /// # Example
    /// See [`AnglesOfAttitude`].
    ///
    /// # Source
    /// W(2.22–2.25), inverted.
    #[must_use]
    pub fn of_attitude(attitude: Attitude<f64>) -> AnglesOfAttitude {
        let Attitude { w, x, y, z } = attitude;
        let (sine, cosine) = (x.hypot(y), w.hypot(z));
        let second = 2.0 * sine.atan2(cosine);
        if sine <= GIMBAL {
            let sum = wrapped(2.0 * z.atan2(w));
            return AnglesOfAttitude::Gimbal { angles: Self { theta: [sum, second, 0.0] }, sum };
        }
        if cosine <= GIMBAL {
            let difference = wrapped(-2.0 * x.atan2(y));
            return AnglesOfAttitude::ReversedGimbal { angles: Self { theta: [difference, second, 0.0] }, difference };
        }
        let (half_sum, half_difference) = (z.atan2(w), x.atan2(y));
        let angles = Self { theta: [wrapped(half_sum - half_difference), second, wrapped(half_sum + half_difference)] };
        AnglesOfAttitude::Regular { angles, condition_number: angles.condition_number() }
    }
}

/// The angle in (−π, π] of a sum of two arctangents, which lies in (−2π, 2π].
fn wrapped(angle: f64) -> f64 {
    use core::f64::consts::{PI, TAU};
    if PI < angle {
        angle - TAU
    } else if angle <= -PI {
        angle + TAU
    } else {
        angle
    }
}
