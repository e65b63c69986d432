//! Angles that change over to another sequence before theirs degrades.
//!
//! ```text
//! cond W = √((1 + |m|)/(1 − |m|)),   m = e_i·f_k
//! leave the chart where  leave_above < cond W;  the best of the twelve has cond W < 2
//! ```
//!
//! Because 2 ≤ `leave_above`, the chart entered is left only after a finite turn: charts do not flutter. The
//! rates are carried over through the angular velocity, θ̇′ = W′⁻¹ W θ̇.

use crate::error::{KinematicsError, finite};
use crate::euler_angles::{EulerAngles, EulerSequence};

/// Angles and rates of a body in a chart that is changed before it degrades.
///
/// The fields are open, so that an integrator writes its step into them; after each step
/// [`change_if_degraded`](EulerChart::change_if_degraded) says whether the numbers now mean another sequence.
///
/// # Example
/// ```
/// use piola_kinematics::{EulerAngles, EulerChart};
/// // Almost upright, turning about e₁: z–y–z is about to fail.
/// let start = EulerAngles::zyz([0.0, 0.02, 0.0]);
/// let rates = start.rates_from_space(&nalgebra::Vector3::x())?.rates;
/// let mut chart = EulerChart::new(start, rates, 4.0)?;
/// let change = chart.change_if_degraded()?.expect("cond W = 100");
/// assert!(99.0 < change.condition_number_before && change.condition_number_after < 1.1);
/// // The same turn in the new angles.
/// let omega = chart.angles.angular_velocity_in_space(chart.rates);
/// assert!((omega.x - 1.0).abs() <= 100.0 * f64::EPSILON);
/// assert_eq!(chart.change_if_degraded()?, None);
/// # Ok::<(), piola_kinematics::KinematicsError>(())
/// ```
///
/// # Source
/// W(2.22–2.28).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(try_from = "Unchecked"))]
pub struct EulerChart {
    /// The angles, in the present sequence.
    pub angles: EulerAngles<f64>,
    /// θ̇ (rad/s).
    pub rates: [f64; 3],
    leave_above: f64,
}

/// A change of the sequence that has taken place.
///
/// # Example
/// See [`EulerChart`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct ChartChange {
    /// The sequence that was left.
    pub from: EulerSequence,
    /// The sequence of the new angles.
    pub to: EulerSequence,
    /// cond W where the old one was left.
    pub condition_number_before: f64,
    /// cond W of the new one.
    pub condition_number_after: f64,
}

/// What the best sequence stays below at every attitude.
const LEAST_THRESHOLD: f64 = 2.0;

impl EulerChart {
    /// Angles and rates (rad, rad/s) that leave their chart where cond W exceeds `leave_above`; 4 leaves
    /// z–y–z at 28° from its poles.
    ///
    /// # Errors
    /// [`KinematicsError::ConditionThreshold`] unless 2 ≤ `leave_above` < ∞; [`KinematicsError::NotFinite`].
    pub fn new(angles: EulerAngles<f64>, rates: [f64; 3], leave_above: f64) -> Result<Self, KinematicsError> {
        if !(LEAST_THRESHOLD <= leave_above && leave_above < f64::INFINITY) {
            return Err(KinematicsError::ConditionThreshold { threshold: leave_above, least: LEAST_THRESHOLD });
        }
        let chart = Self { angles, rates, leave_above };
        chart.check()?;
        Ok(chart)
    }

    /// cond W of the present angles.
    #[must_use]
    pub fn condition_number(&self) -> f64 {
        self.angles.condition_number()
    }

    /// Changes over to the best sequence where the present one has degraded, and says so.
    ///
    /// # Errors
    /// [`KinematicsError::NotFinite`] for what was written into the fields.
    ///
    /// # Accuracy
    /// The attitude is kept to a few ulps, the angular velocity to a few ulps of the rates, which exceed it by at
    /// most the condition number before.
    pub fn change_if_degraded(&mut self) -> Result<Option<ChartChange>, KinematicsError> {
        self.check()?;
        let condition_number_before = self.condition_number();
        if condition_number_before <= self.leave_above {
            return Ok(None);
        }
        let from = self.angles.sequence;
        let attitude = self.angles.attitude();
        let to = EulerSequence::best(attitude);
        let angles = EulerAngles::of_attitude(to, attitude).angles();
        let found = angles.rates(&self.angles.angular_velocity_in_body(self.rates))?;
        (self.angles, self.rates) = (angles, found.rates);
        let condition_number_after = found.condition_number;
        Ok(Some(ChartChange { from, to, condition_number_before, condition_number_after }))
    }

    fn check(&self) -> Result<(), KinematicsError> {
        for (quantity, values) in [("theta", &self.angles.theta), ("rates", &self.rates)] {
            finite(quantity, values)?;
        }
        Ok(())
    }
}

/// The fields before validation.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Unchecked {
    angles: EulerAngles<f64>,
    rates: [f64; 3],
    leave_above: f64,
}

#[cfg(feature = "serde")]
impl TryFrom<Unchecked> for EulerChart {
    type Error = KinematicsError;

    fn try_from(chart: Unchecked) -> Result<Self, KinematicsError> {
        Self::new(chart.angles, chart.rates, chart.leave_above)
    }
}
