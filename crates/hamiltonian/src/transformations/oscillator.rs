//! Angle and action of a harmonic oscillator.

use piola_numerics::Real;

use super::check_action;
use crate::HamiltonianError;
use crate::check::{check_finite, check_length};
use crate::{InvertiblePhaseMap, PhaseMap};

/// (q, p) ↦ (angle, action) of H = p²/2m + ½ m ω² q², in each of any number of coordinates alike.
///
/// ```text
/// Q = atan2(m ω q, p)        P = ½ (p²/(m ω) + m ω q²)        H = ω P
/// ```
///
/// # Errors
/// [`HamiltonianError::WrongLength`]; back, [`HamiltonianError::InvalidAction`] for a negative action. At rest at the centre the angle has no derivatives.
///
/// # Example
/// ```
/// use piola_hamiltonian::{OscillatorActionAngle, PhaseMap};
/// let map = OscillatorActionAngle::new(2.0, 0.5)?; // m ω = 1
/// let mut new = [0.0; 2];
/// map.map(&[3.0], &[4.0], 0.0, &mut new)?;
/// assert_eq!(new, [f64::atan2(3.0, 4.0), 12.5]);
/// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Written"))]
pub struct OscillatorActionAngle {
    mass: f64,
    angular_frequency: f64,
}

/// What is read before it is checked.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    mass: f64,
    angular_frequency: f64,
}

#[cfg(feature = "serde")]
impl TryFrom<Written> for OscillatorActionAngle {
    type Error = HamiltonianError;
    fn try_from(written: Written) -> Result<Self, HamiltonianError> {
        Self::new(written.mass, written.angular_frequency)
    }
}

impl OscillatorActionAngle {
    /// For a mass m, kg, and an angular frequency ω, rad/s.
    ///
    /// # Errors
    /// [`HamiltonianError::NotFinite`]; [`HamiltonianError::NotPositive`].
    pub fn new(mass: f64, angular_frequency: f64) -> Result<Self, HamiltonianError> {
        for (quantity, value) in [("mass", mass), ("angular frequency", angular_frequency)] {
            check_finite(quantity, &[value])?;
            if value <= 0.0 {
                return Err(HamiltonianError::NotPositive { quantity, value });
            }
        }
        Ok(Self { mass, angular_frequency })
    }

    /// m ω.
    fn impedance<T: Real>(self) -> T {
        T::lit(self.mass * self.angular_frequency)
    }
}

impl PhaseMap for OscillatorActionAngle {
    fn map<T: Real>(&self, q: &[T], p: &[T], _t: T, new: &mut [T]) -> Result<(), HamiltonianError> {
        let n = q.len();
        check_length("p", n, p.len())?;
        check_length("the image", 2 * n, new.len())?;
        let impedance = self.impedance::<T>();
        for i in 0..n {
            new[i] = (impedance * q[i]).atan2(p[i]);
            new[n + i] = T::lit(0.5) * (p[i] * p[i] / impedance + impedance * q[i] * q[i]);
        }
        Ok(())
    }
}

impl InvertiblePhaseMap for OscillatorActionAngle {
    fn invert<T: Real>(&self, new_q: &[T], new_p: &[T], _t: T, old: &mut [T]) -> Result<(), HamiltonianError> {
        let n = new_q.len();
        check_length("P", n, new_p.len())?;
        check_length("(q, p)", 2 * n, old.len())?;
        for (index, &action) in new_p.iter().enumerate() {
            check_action(index, action, (0.0, f64::INFINITY))?;
        }
        let impedance = self.impedance::<T>();
        for i in 0..n {
            let (s, c) = new_q[i].sin_cos();
            let twice = new_p[i] + new_p[i];
            old[i] = (twice / impedance).sqrt() * s;
            old[n + i] = (twice * impedance).sqrt() * c;
        }
        Ok(())
    }
}
