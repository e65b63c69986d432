//! Frames that turn about the z axis.

use piola_numerics::Real;

use crate::HamiltonianError;
use crate::check::{check_finite, check_length};
use crate::{InvertiblePhaseMap, PhaseMap};

/// Components in a frame that turns with the angular velocity Ω about the z axis, in a plane or in space.
///
/// ```text
/// Q = R(−Ω t) q        P = R(−Ω t) p        F = −Ω (x p_y − y p_x)
/// ```
///
/// Momenta stay those of the frame at rest, in turned components: P is not m Q̇.
///
/// # Errors
/// [`HamiltonianError::WrongLength`] for other than 2 or 3 coordinates.
///
/// # Example
/// ```
/// use piola_hamiltonian::{PhaseMap, RotatingFrame};
/// let quarter = RotatingFrame::new(std::f64::consts::FRAC_PI_2)?;
/// let mut new = [0.0_f64; 4];
/// quarter.map(&[1.0, 0.0], &[0.0, 2.0], 1.0, &mut new)?;
/// assert!((new[1] + 1.0).abs() < 1e-15 && (new[2] - 2.0).abs() < 1e-15);
/// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
/// ```
///
/// # Source
/// W(10.25), W(10.28).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "f64", into = "f64"))]
pub struct RotatingFrame {
    angular_velocity: f64,
}

impl RotatingFrame {
    /// A frame that turns with Ω, rad/s.
    ///
    /// # Errors
    /// [`HamiltonianError::NotFinite`].
    pub fn new(angular_velocity: f64) -> Result<Self, HamiltonianError> {
        check_finite("angular velocity", &[angular_velocity])?;
        Ok(Self { angular_velocity })
    }

    /// Ω, rad/s.
    #[must_use]
    pub const fn angular_velocity(self) -> f64 {
        self.angular_velocity
    }

    /// Turns both halves of a point by ±Ω t.
    fn turn<T: Real>(self, sign: f64, (q, p, t): (&[T], &[T], T), out: &mut [T]) -> Result<(), HamiltonianError> {
        let n = q.len();
        check_length("q", n.clamp(2, 3), n)?;
        check_length("p", n, p.len())?;
        check_length("the image", 2 * n, out.len())?;
        let (s, c) = (T::lit(sign * self.angular_velocity) * t).sin_cos();
        for (old, new) in [q, p].into_iter().zip(out.chunks_exact_mut(n)) {
            new.copy_from_slice(old);
            new[0] = c * old[0] - s * old[1];
            new[1] = s * old[0] + c * old[1];
        }
        Ok(())
    }
}

impl TryFrom<f64> for RotatingFrame {
    type Error = HamiltonianError;
    fn try_from(angular_velocity: f64) -> Result<Self, HamiltonianError> {
        Self::new(angular_velocity)
    }
}

impl From<RotatingFrame> for f64 {
    fn from(frame: RotatingFrame) -> Self {
        frame.angular_velocity
    }
}

impl PhaseMap for RotatingFrame {
    const TIME_DEPENDENT: bool = true;
    fn map<T: Real>(&self, q: &[T], p: &[T], t: T, new: &mut [T]) -> Result<(), HamiltonianError> {
        self.turn(-1.0, (q, p, t), new)
    }
    fn excess<T: Real>(&self, q: &[T], p: &[T], _t: T) -> Result<T, HamiltonianError> {
        check_length("q", q.len().clamp(2, 3), q.len())?;
        check_length("p", q.len(), p.len())?;
        Ok(-T::lit(self.angular_velocity) * (q[0] * p[1] - q[1] * p[0]))
    }
}

impl InvertiblePhaseMap for RotatingFrame {
    fn invert<T: Real>(&self, new_q: &[T], new_p: &[T], t: T, old: &mut [T]) -> Result<(), HamiltonianError> {
        self.turn(1.0, (new_q, new_p, t), old)
    }
}
