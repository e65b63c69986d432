//! From attitudes to angles and from angular velocities to rates: where the charts can fail.

use nalgebra::Vector3;
use piola_numerics::Real;

use super::sequence::Layout;
use super::{Canonical, EulerAngles, EulerSequence};
use crate::attitude::Attitude;
use crate::error::{KinematicsError, finite};

/// The angles of an attitude, as far as they are determined.
///
/// # Example
/// ```
/// use piola_kinematics::{Attitude, EulerAngles, EulerSequence, euler_angles::AnglesOfAttitude};
/// let upright = EulerAngles::of_attitude(EulerSequence::Zyz, Attitude::about_z(0.5));
/// // θ² = 0: only θ¹ + θ³ = 0.5 is determined.
/// assert!(matches!(upright, AnglesOfAttitude::Gimbal { sum, .. } if (sum - 0.5).abs() < 1.0e-15));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(tag = "chart", rename_all = "snake_case", deny_unknown_fields))]
pub enum AnglesOfAttitude {
    /// All three angles are determined.
    Regular {
        /// θ¹, θ³ in (−π, π]; θ² in (0, π) for Eulerian sequences, in (−π/2, π/2) for those of Tait and Bryan.
        angles: EulerAngles<f64>,
        /// cond W: how much an error of the attitude grows in θ¹ and θ³.
        condition_number: f64,
    },
    /// The first and the third axis are parallel within rounding, as for z–y–z at θ² = 0: only the sum of the
    /// outer angles is determined.
    Gimbal {
        /// One choice: θ³ = 0.
        angles: EulerAngles<f64>,
        /// θ¹ + θ³.
        sum: f64,
    },
    /// The first and the third axis are opposite within rounding, as for z–y–z at θ² = π: only the difference
    /// of the outer angles is determined.
    ReversedGimbal {
        /// One choice: θ³ = 0.
        angles: EulerAngles<f64>,
        /// θ¹ − θ³.
        difference: f64,
    },
}

impl AnglesOfAttitude {
    /// The angles, with the choice θ³ = 0 at a gimbal point.
    #[must_use]
    pub fn angles(&self) -> EulerAngles<f64> {
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
/// # use piola_kinematics::EulerAngles;
/// let level = EulerAngles::zyz([0.0, std::f64::consts::FRAC_PI_2, 0.0]);
/// assert_eq!(level.rates(&Vector3::new(-2.0, 0.0, 0.0))?.condition_number.round(), 1.0);
/// # Ok::<(), piola_kinematics::KinematicsError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct EulerRates {
    /// θ̇ (rad/s).
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::finite::triple"))]
    pub rates: [f64; 3],
    /// cond W = (1 + |c₂|)/|s₂|.
    pub condition_number: f64,
}

/// Ratios of the sine to the cosine of a half angle up to this are zero to the rounding of a quaternion.
const GIMBAL: f64 = 4.0 * f64::EPSILON;

impl<T: Real> Canonical<T> {
    /// W⁻¹ ω.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn rates_of(&self, in_body: &Vector3<T>) -> [T; 3] {
        let ((s2, c2), (s3, c3)) = (self.second, self.third);
        let first = (s3 * in_body.y - c3 * in_body.x) / s2;
        self.rates([first, s3 * in_body.x + c3 * in_body.y, in_body.z - c2 * first])
    }

    /// W⁻¹ Q ω.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn rates_of_space(&self, in_space: &Vector3<T>) -> [T; 3] {
        let ((s1, c1), (s2, c2)) = (self.first, self.second);
        let third = (c1 * in_space.x + s1 * in_space.y) / s2;
        self.rates([in_space.z - c2 * third, c1 * in_space.y - s1 * in_space.x, third])
    }
}

impl<T: Real> EulerAngles<T> {
    /// The angles of an attitude away from gimbal points, over any scalar: with dual numbers also their rates.
    ///
    /// ```text
    /// θ² = 2 arctan(s/c),  s = √(x²+y²),  c = √(w²+z²)   ½(θ³+θ¹) = arctan(z/w)   ½(θ³−θ¹) = arctan(x/y)
    /// ```
    ///
    /// in the axes of the sequence; for those of Tait and Bryan with the quaternion q (1 + j) and
    /// θ² = arctan(2(wy − xz)/(s c)). Outer angles in (−π, π].
    ///
    /// At a gimbal point the derivatives are not finite and one outer angle is arbitrary;
    /// [`of_attitude`](EulerAngles::of_attitude) says so.
    ///
    /// # Accuracy
    /// θ² to a few ulps of one, for Eulerian sequences of itself also near 0; θ¹ and θ³ to a few ulps ×
    /// `condition_number`, with errors such that the angles together give the attitude to a few ulps.
    ///
    /// # Source
    /// W(2.22–2.25), inverted.
    #[must_use]
    pub fn away_from_gimbal(sequence: EulerSequence, attitude: Attitude<T>) -> Self {
        let layout = Layout::of(sequence);
        let [w, x, y, z] = layout.quaternion(attitude);
        let (half_sum, half_difference) = (z.atan2(w), x.atan2(y));
        let third = (half_sum + half_difference) * T::lit(layout.third_sign());
        Self { sequence, theta: [wrapped(half_sum - half_difference), middle(layout, attitude), wrapped(third)] }
    }
}

/// θ² of an attitude, to a few ulps also where the chart is singular.
fn middle<T: Real>(layout: Layout, attitude: Attitude<T>) -> T {
    let (sine, cosine) = layout.half_angle(attitude);
    if layout.eulerian {
        return sine.atan2(cosine) * T::lit(2.0);
    }
    // sin θ² from the components themselves: θ² = 2 arctan(s/c) − π/2 would cancel where it is small.
    let v = layout.space(&Vector3::new(attitude.x, attitude.y, attitude.z));
    ((attitude.w * v.y - v.x * v.z) * T::lit(2.0)).atan2(sine * cosine)
}

impl EulerAngles<f64> {
    /// Rates of the angles at an angular velocity in body components: θ̇ = W⁻¹ ω.
    ///
    /// # Errors
    /// [`KinematicsError::GimbalPoint`] where cond W exceeds 1/ε, so that no digit would be right;
    /// [`KinematicsError::NotFinite`].
    ///
    /// # Accuracy
    /// A few ulps × `condition_number`.
    ///
    /// # Source
    /// W(2.28), inverted.
    pub fn rates(&self, angular_velocity_in_body: &Vector3<f64>) -> Result<EulerRates, KinematicsError> {
        let condition_number = self.checked("angular velocity", angular_velocity_in_body)?;
        let canonical = Canonical::of(self);
        let rates = canonical.rates_of(&canonical.layout.body(angular_velocity_in_body));
        Ok(EulerRates { rates, condition_number })
    }

    /// Rates of the angles at an angular velocity in space components: θ̇ = W⁻¹ Q ω.
    ///
    /// # Errors
    /// As [`rates`](EulerAngles::rates).
    ///
    /// # Accuracy
    /// A few ulps × `condition_number`.
    ///
    /// # Source
    /// W(2.26), inverted.
    pub fn rates_from_space(&self, angular_velocity_in_space: &Vector3<f64>) -> Result<EulerRates, KinematicsError> {
        let condition_number = self.checked("angular velocity", angular_velocity_in_space)?;
        let canonical = Canonical::of(self);
        let rates = canonical.rates_of_space(&canonical.layout.space(angular_velocity_in_space));
        Ok(EulerRates { rates, condition_number })
    }

    /// Second rates of the angles at an angular acceleration in body components: θ̈ = W⁻¹ (ω̇ − Ẇ θ̇).
    ///
    /// # Errors
    /// As [`rates`](EulerAngles::rates).
    ///
    /// # Accuracy
    /// A few ulps × `condition_number`, of the larger of ω̇ and Ẇ θ̇.
    ///
    /// # Source
    /// W(2.28), differentiated and inverted.
    pub fn second_rates(
        &self,
        rates: [f64; 3],
        angular_acceleration_in_body: &Vector3<f64>,
    ) -> Result<EulerRates, KinematicsError> {
        finite("rates", &rates)?;
        let condition_number = self.checked("angular acceleration", angular_acceleration_in_body)?;
        let canonical = Canonical::of(self);
        let changing = canonical.changing_in_body(canonical.rates(rates));
        let second_rates = canonical.rates_of(&(canonical.layout.body(angular_acceleration_in_body) - changing));
        Ok(EulerRates { rates: second_rates, condition_number })
    }

    /// The angles of an attitude; gimbal points are reported, not guessed.
    ///
    /// # Accuracy
    /// As [`away_from_gimbal`](EulerAngles::away_from_gimbal).
    ///
    /// # Source
    /// W(2.22–2.25), inverted.
    #[must_use]
    pub fn of_attitude(sequence: EulerSequence, attitude: Attitude<f64>) -> AnglesOfAttitude {
        let layout = Layout::of(sequence);
        let (sine, cosine) = layout.half_angle(attitude);
        let parallel = sine <= GIMBAL * cosine;
        let opposite = cosine <= GIMBAL * sine;
        if !parallel && !opposite {
            let angles = Self::away_from_gimbal(sequence, attitude);
            return AnglesOfAttitude::Regular { angles, condition_number: sequence.condition_number(attitude) };
        }
        let [w, x, y, z] = layout.quaternion(attitude);
        let first = wrapped(2.0 * if parallel { z.atan2(w) } else { -x.atan2(y) });
        let angles = Self { sequence, theta: [first, middle(layout, attitude), 0.0] };
        if parallel == (0.0 < layout.third_sign()) {
            AnglesOfAttitude::Gimbal { angles, sum: first }
        } else {
            AnglesOfAttitude::ReversedGimbal { angles, difference: first }
        }
    }

    /// The same attitude in the angles of another sequence.
    #[must_use]
    pub fn in_sequence(&self, sequence: EulerSequence) -> AnglesOfAttitude {
        Self::of_attitude(sequence, self.attitude())
    }

    /// cond W, where everything is finite and it is below 1/ε.
    fn checked(&self, quantity: &'static str, vector: &Vector3<f64>) -> Result<f64, KinematicsError> {
        for (quantity, values) in [("theta", &self.theta[..]), (quantity, vector.as_slice())] {
            finite(quantity, values)?;
        }
        let condition_number = self.condition_number();
        if f64::EPSILON.recip() <= condition_number {
            return Err(KinematicsError::GimbalPoint { theta2: self.theta[1], condition_number });
        }
        Ok(condition_number)
    }
}

/// The angle in (−π, π] of a sum of two arctangents, which lies in [−2π, 2π].
fn wrapped<T: Real>(angle: T) -> T {
    use core::f64::consts::{PI, TAU};
    let above = T::select(T::lit(PI).less_than(angle), angle - T::lit(TAU), angle);
    T::select(angle.at_most(T::lit(-PI)), angle + T::lit(TAU), above)
}
