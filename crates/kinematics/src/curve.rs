//! Geometry of the path of a particle: speed, Frenet frame, curvature and torsion.
//!
//! ```text
//! v = ṡ s        a = s̈ s + v² κ n        b = s × n              W(1.10–1.12)
//! κ = |v×a|/|v|³     τ = (v×a)·j/|v×a|²     j = da/dt
//! ```
//!
//! Where v = 0 there is no tangent, where κ = 0 no normal: the result says so ([`Frenet`]) and nothing is
//! divided by zero. Torsion is positive for a right-handed helix.
//!
//! # Which one?
//! [`Frenet::of_curve`] for a path given as a formula; [`Frenet::from_derivatives`] for derivatives
//! already at hand; [`Frenet::from_derivatives_resolved`] when the velocity carries a known error.
//!
//! # References
//! W(1.10–1.12).

use nalgebra::Vector3;
use piola_numerics::{Dual, Jet, Real};

use crate::error::{KinematicsError, finite};

/// A path x(t) for any scalar, so that its derivatives are exact.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_kinematics::curve::Curve;
/// use piola_numerics::Real;
/// struct Circle { radius: f64 }
/// impl Curve for Circle {
///     fn position<T: Real>(&self, t: T) -> Vector3<T> {
///         let (s, c) = t.sin_cos();
///         Vector3::new(T::lit(self.radius) * c, T::lit(self.radius) * s, T::zero())
///     }
/// }
/// assert_eq!(Circle { radius: 2.0 }.position(0.0).x, 2.0);
/// ```
pub trait Curve {
    /// The position (m) at the time `t` (s).
    fn position<T: Real>(&self, t: T) -> Vector3<T>;
}

/// Position and its first three derivatives.
///
/// # Example
/// ```
/// # use nalgebra::Vector3;
/// # use piola_kinematics::curve::{Curve, Derivatives};
/// # use piola_numerics::Real;
/// struct Cubic;
/// impl Curve for Cubic {
///     fn position<T: Real>(&self, t: T) -> Vector3<T> {
///         Vector3::new(t * t * t, t, T::zero())
///     }
/// }
/// let at_two = Derivatives::of_curve(&Cubic, 2.0);
/// assert_eq!((at_two.velocity.x, at_two.acceleration.x, at_two.jerk.x), (12.0, 12.0, 6.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Derivatives {
    /// x (m).
    pub position: Vector3<f64>,
    /// v = ẋ (m/s).
    pub velocity: Vector3<f64>,
    /// a = ẍ (m/s²).
    pub acceleration: Vector3<f64>,
    /// da/dt (m/s³).
    pub jerk: Vector3<f64>,
}

impl Derivatives {
    /// The derivatives of a path at the time `t`, exact to rounding.
    #[must_use]
    pub fn of_curve(curve: &impl Curve, t: f64) -> Self {
        // The dual part differentiates the two derivatives of the jet once more.
        let x = curve.position(Dual::new(Jet::<f64, 0>::time(t), Jet::constant(1.0)));
        Self {
            position: x.map(|x| x.value.value),
            velocity: x.map(|x| x.value.rate),
            acceleration: x.map(|x| x.value.second_rate),
            jerk: x.map(|x| x.tangent.second_rate),
        }
    }
}

/// What a path looks like near a point, as far as it exists there.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_kinematics::curve::Frenet;
/// // Uniform motion along x: a tangent, but no normal.
/// let frenet = Frenet::from_derivatives(&Vector3::x(), &Vector3::zeros(), &Vector3::zeros())?;
/// assert!(matches!(frenet, Frenet::Straight { speed, .. } if speed == 1.0));
/// # Ok::<(), piola_kinematics::KinematicsError>(())
/// ```
///
/// # Source
/// W(1.10–1.12).
#[doc(alias = "Serret")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Frenet {
    /// v = 0: neither tangent nor normal.
    Rest {
        /// |v| as found, at or below the resolution (m/s).
        speed: f64,
    },
    /// v×a = 0: a tangent, no curvature, hence no normal and no torsion.
    Straight {
        /// ṡ (m/s).
        speed: f64,
        /// s, of length one.
        tangent: Vector3<f64>,
        /// s̈ (m/s²).
        tangential_acceleration: f64,
    },
    /// The full frame.
    Curved(CurvedPath),
}

/// Frenet data where the path is curved.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_kinematics::curve::Frenet;
/// // A circle of radius 2 m at 4 m/s: a = v²/r = 8 m/s² towards the centre.
/// let v = Vector3::new(0.0, 4.0, 0.0);
/// let a = Vector3::new(-8.0, 0.0, 0.0);
/// let j = Vector3::new(0.0, -16.0, 0.0);
/// let Frenet::Curved(path) = Frenet::from_derivatives(&v, &a, &j)? else { return Ok(()) };
/// assert_eq!((path.curvature, path.normal.x, path.torsion), (0.5, -1.0, 0.0));
/// # Ok::<(), piola_kinematics::KinematicsError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvedPath {
    /// ṡ (m/s).
    pub speed: f64,
    /// s, of length one.
    pub tangent: Vector3<f64>,
    /// n, of length one, towards the centre of curvature.
    pub normal: Vector3<f64>,
    /// b = s × n.
    pub binormal: Vector3<f64>,
    /// s̈ (m/s²).
    pub tangential_acceleration: f64,
    /// v² κ (m/s²).
    pub normal_acceleration: f64,
    /// κ (1/m).
    pub curvature: f64,
    /// τ (1/m), positive for a right-handed helix.
    pub torsion: f64,
}

impl CurvedPath {
    /// 1/κ (m).
    #[must_use]
    pub fn radius_of_curvature(&self) -> f64 {
        self.curvature.recip()
    }
}

/// |s×a| up to this multiple of |a| is the rounding of a cross product of parallel vectors.
const PARALLEL: f64 = 8.0 * f64::EPSILON;

impl Frenet {
    /// Frenet data of a path at the time `t`.
    ///
    /// The path counts as at rest where |v| is within what rounding of `t` alone makes of it,
    /// |v| ≤ 8 ε |a t|: so a cusp is found at t = 2π as well as at t = 0.
    ///
    /// # Errors
    /// [`KinematicsError::NotFinite`] when the path or a derivative is not finite at `t`.
    ///
    /// # Accuracy
    /// Tangent and acceleration to a few ulps; curvature and normal to a few ulps × |a|/(v²κ); torsion
    /// loses as much again.
    ///
    /// # Source
    /// W(1.10–1.12).
    pub fn of_curve(curve: &impl Curve, t: f64) -> Result<Self, KinematicsError> {
        let x = Derivatives::of_curve(curve, t);
        let resolution = 8.0 * f64::EPSILON * (x.acceleration.norm() * t).abs();
        finite("position", x.position.as_slice())?;
        Self::from_derivatives_resolved(&x.velocity, &x.acceleration, &x.jerk, resolution)
    }

    /// Frenet data from exact velocity, acceleration and jerk: at rest only when v = 0.
    ///
    /// # Errors
    /// [`KinematicsError::NotFinite`].
    ///
    /// # Source
    /// W(1.10–1.12).
    pub fn from_derivatives(
        velocity: &Vector3<f64>,
        acceleration: &Vector3<f64>,
        jerk: &Vector3<f64>,
    ) -> Result<Self, KinematicsError> {
        Self::from_derivatives_resolved(velocity, acceleration, jerk, 0.0)
    }

    /// Frenet data when |v| up to `speed_resolution` (m/s) cannot be told from rest.
    ///
    /// # Errors
    /// [`KinematicsError::NotFinite`].
    pub fn from_derivatives_resolved(
        velocity: &Vector3<f64>,
        acceleration: &Vector3<f64>,
        jerk: &Vector3<f64>,
        speed_resolution: f64,
    ) -> Result<Self, KinematicsError> {
        finite("velocity", velocity.as_slice())?;
        finite("acceleration", acceleration.as_slice())?;
        finite("jerk", jerk.as_slice())?;
        if speed_resolution.is_nan() {
            return Err(KinematicsError::NotFinite { quantity: "speed resolution", index: 0, value: speed_resolution });
        }
        let (speed, tangent) = length_and_direction(velocity);
        if speed <= speed_resolution.max(0.0) {
            return Ok(Self::Rest { speed });
        }
        let (a, j) = (acceleration, jerk);
        let tangential_acceleration = a.dot(&tangent);
        let (normal_acceleration, binormal) = length_and_direction(&tangent.cross(a));
        if normal_acceleration <= PARALLEL * a.norm() {
            return Ok(Self::Straight { speed, tangent, tangential_acceleration });
        }
        Ok(Self::Curved(CurvedPath {
            speed,
            tangent,
            normal: binormal.cross(&tangent),
            binormal,
            tangential_acceleration,
            normal_acceleration,
            // (a/v)/v: v² would leave the range before κ does.
            curvature: normal_acceleration / speed / speed,
            torsion: j.dot(&binormal) / speed / normal_acceleration,
        }))
    }
}

/// Length and direction of a vector, without overflow or underflow of squares; direction 0 at length 0.
fn length_and_direction(v: &Vector3<f64>) -> (f64, Vector3<f64>) {
    let largest = v.amax();
    if largest <= 0.0 {
        return (0.0, Vector3::zeros());
    }
    // Subnormal lengths: the reciprocal would overflow, the quotient does not.
    let scaled = v / largest;
    let length = scaled.norm();
    (largest * length, scaled / length)
}
