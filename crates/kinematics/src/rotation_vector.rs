//! Rotation vectors: the exponential map of rotations, its derivative and their inverses.
//!
//! The attitude exp φ is the rotation by a = |φ| about φ. As φ moves, it turns with
//!
//! ```text
//! ω_body = J φ̇,   ω_space = Jᵀ φ̇,   J = 1 − B φ× + C φ×φ×,   det J = 2B = (2 sin(a/2)/a)²
//! φ̇ = J⁻¹ ω_body = J⁻ᵀ ω_space,      J⁻¹ = 1 + ½ φ× + D φ×φ×
//! A = sin a/a     B = (1 − cos a)/a²     C = (a − sin a)/a³     D = (1 − (a/2) cot(a/2))/a²
//! ```
//!
//! J is also known as the right Jacobian of the rotation group, Jᵀ as the left one. A, B, C are entire functions
//! of φ·φ and D is regular for a < 2π; they are computed as such, so that nothing cancels at small angles and
//! derivatives of any order, in dual numbers nested at will, are right at φ = 0.
//!
//! # Which one?
//! A rotation vector is a chart of the attitudes, as Eulerian angles are: regular at and around the identity,
//! singular at |φ| = 2π. It is the natural unknown for increments of an attitude. To hold an attitude over time use
//! an [`Attitude`]; to bring a rotation vector back into |φ| ≤ π use [`shortest`](RotationVector::shortest).
//!
//! # References
//! W(2.10–2.14); the exponential of a skew tensor: O. Rodrigues, J. Math. Pures Appl. 5, 380–440 (1840).

use nalgebra::{Matrix3, Vector3};
use piola_numerics::{Dual, Mask, Real};

use crate::attitude::Attitude;
use crate::vector::{cross, dot, scaled};

/// The rotation by |φ| (rad) about φ.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_kinematics::RotationVector;
/// // Turning on about the same axis: ω is the rate of the angle.
/// let phi = RotationVector(Vector3::new(0.0, 0.0, 0.5_f64));
/// let omega = phi.angular_velocity_in_body(&Vector3::new(0.0, 0.0, 2.0));
/// assert_eq!(omega, Vector3::new(0.0, 0.0, 2.0));
/// ```
///
/// # Source
/// W(2.13).
#[doc(alias("axis-angle", "exponential coordinates", "SO(3)"))]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(transparent, bound(deserialize = "T: Real + serde::Deserialize<'de>")))]
pub struct RotationVector<T: Real>(
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::finite::vector"))] pub Vector3<T>,
);

/// B, C and D at a² ≥ 0.
struct Coefficients<T> {
    b: T,
    c: T,
    d: T,
}

impl<T: Real> RotationVector<T> {
    /// The shortest rotation vector of an attitude, |φ| ≤ π: its logarithm.
    #[inline]
    #[must_use]
    pub fn of_attitude(attitude: Attitude<T>) -> Self {
        Self(attitude.rotation_vector())
    }

    /// The attitude exp φ.
    #[inline]
    #[must_use]
    pub fn attitude(&self) -> Attitude<T> {
        Attitude::from_rotation_vector(&self.0)
    }

    /// The vector of the same attitude with |φ| ≤ π, where this one has |φ| < 3π.
    ///
    /// The rates are carried over by [`rate_from_body`](RotationVector::rate_from_body) of the new vector at the
    /// angular velocity of the old.
    #[must_use]
    pub fn shortest(&self) -> Self {
        use core::f64::consts::{PI, TAU};
        let squared = dot(&self.0, &self.0);
        let long = T::lit(PI * PI).less_than(squared);
        let angle = T::select(long, squared, T::one()).sqrt();
        Self(scaled(&self.0, T::select(long, T::one() - T::lit(TAU) / angle, T::one())))
    }

    /// J, the derivative of the exponential in body components: `ω_body = J φ̇`.
    ///
    /// ```text
    /// J = 1 − B φ× + C φ×φ×
    /// ```
    ///
    /// # Accuracy
    /// A few ulps of its largest entry for any φ.
    ///
    /// # Source
    /// W(2.14), along φ.
    #[doc(alias = "right Jacobian")]
    #[must_use]
    pub fn exponential_derivative_in_body(&self) -> Matrix3<T> {
        let Coefficients { b, c, .. } = self.coefficients();
        polynomial(&self.0, -b, c)
    }

    /// Jᵀ, the derivative of the exponential in space components: `ω_space = Jᵀ φ̇`.
    ///
    /// # Accuracy
    /// As [`exponential_derivative_in_body`](Self::exponential_derivative_in_body).
    ///
    /// # Source
    /// W(2.13), along φ.
    #[doc(alias = "left Jacobian")]
    #[must_use]
    pub fn exponential_derivative_in_space(&self) -> Matrix3<T> {
        let Coefficients { b, c, .. } = self.coefficients();
        polynomial(&self.0, b, c)
    }

    /// J⁻¹, the derivative of the logarithm: φ̇ = J⁻¹ `ω_body`.
    ///
    /// Valid for |φ| < 2π; not finite at 2π, where exp has no local inverse.
    ///
    /// # Accuracy
    /// A few ulps × 2π/(2π − |φ|).
    ///
    /// # Source
    /// W(2.14), along φ and inverted.
    #[doc(alias = "inverse right Jacobian")]
    #[must_use]
    pub fn logarithm_derivative_from_body(&self) -> Matrix3<T> {
        polynomial(&self.0, T::lit(0.5), self.coefficients().d)
    }

    /// J⁻ᵀ, the derivative of the logarithm: φ̇ = J⁻ᵀ `ω_space`.
    ///
    /// Valid for |φ| < 2π; not finite at 2π.
    ///
    /// # Accuracy
    /// As [`logarithm_derivative_from_body`](Self::logarithm_derivative_from_body).
    ///
    /// # Source
    /// W(2.13), along φ and inverted.
    #[doc(alias = "inverse left Jacobian")]
    #[must_use]
    pub fn logarithm_derivative_from_space(&self) -> Matrix3<T> {
        polynomial(&self.0, T::lit(-0.5), self.coefficients().d)
    }

    /// Angular velocity in body components at the rate φ̇ of the vector: ω = J φ̇ (rad/s).
    ///
    /// # Source
    /// W(2.14), along φ.
    #[inline]
    #[must_use]
    pub fn angular_velocity_in_body(&self, rate: &Vector3<T>) -> Vector3<T> {
        let Coefficients { b, c, .. } = self.coefficients();
        apply(&self.0, -b, c, rate)
    }

    /// Angular velocity in space components at the rate φ̇ of the vector: ω = Jᵀ φ̇ (rad/s).
    ///
    /// # Source
    /// W(2.13), along φ.
    #[inline]
    #[must_use]
    pub fn angular_velocity_in_space(&self, rate: &Vector3<T>) -> Vector3<T> {
        let Coefficients { b, c, .. } = self.coefficients();
        apply(&self.0, b, c, rate)
    }

    /// Rate φ̇ of the vector at an angular velocity in body components: φ̇ = J⁻¹ ω. Valid for |φ| < 2π.
    ///
    /// # Source
    /// W(2.14), along φ and inverted.
    #[inline]
    #[must_use]
    pub fn rate_from_body(&self, angular_velocity: &Vector3<T>) -> Vector3<T> {
        apply(&self.0, T::lit(0.5), self.coefficients().d, angular_velocity)
    }

    /// Rate φ̇ of the vector at an angular velocity in space components: φ̇ = J⁻ᵀ ω. Valid for |φ| < 2π.
    ///
    /// # Source
    /// W(2.13), along φ and inverted.
    #[inline]
    #[must_use]
    pub fn rate_from_space(&self, angular_velocity: &Vector3<T>) -> Vector3<T> {
        apply(&self.0, T::lit(-0.5), self.coefficients().d, angular_velocity)
    }

    /// Angular acceleration in body components: ω̇ = J φ̈ + J̇ φ̇ (rad/s²), by the exact derivative of J.
    ///
    /// # Source
    /// W(2.14), differentiated.
    #[must_use]
    pub fn angular_acceleration_in_body(&self, rate: &Vector3<T>, second_rate: &Vector3<T>) -> Vector3<T> {
        let moving = RotationVector(self.0.zip_map(rate, Dual::new));
        moving.angular_velocity_in_body(&rate.zip_map(second_rate, Dual::new)).map(|x| x.tangent)
    }

    /// B, C, D: by their power series below one radian, by closed forms that do not cancel above.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn coefficients(&self) -> Coefficients<T> {
        let t = dot(&self.0, &self.0);
        let (cosine, half_sinc) = crate::attitude::half_angle_functions(t);
        // 1 − cos a = 2 sin²(a/2), sin a = 2 sin(a/2) cos(a/2).
        let b = half_sinc * half_sinc * T::lit(2.0);
        let sinc = half_sinc * cosine * T::lit(2.0);
        let small = t.less_than(T::one());
        // C = Σ (−t)ᵏ/(2k+3)!  and  E = (2B − A)/t = Σ 2(k+1) (−t)ᵏ/(2k+4)!; eleven terms leave 1e-24.
        let (mut c, mut e) = (T::one(), T::one());
        for k in (1..11_i32).rev() {
            let k = f64::from(k);
            c = T::one() - t * c * T::lit(1.0 / ((2.0 * k + 2.0) * (2.0 * k + 3.0)));
            e = T::one() - t * e * T::lit((k + 1.0) / (k * (2.0 * k + 3.0) * (2.0 * k + 4.0)));
        }
        let (c, e) = (c * T::lit(1.0 / 6.0), e * T::lit(1.0 / 12.0));
        if small.all() {
            return Coefficients { b, c, d: e / (b * T::lit(2.0)) };
        }
        let safe = T::select(small, T::one(), t);
        let c = T::select(small, c, (T::one() - sinc) / safe);
        let e = T::select(small, e, (b * T::lit(2.0) - sinc) / safe);
        Coefficients { b, c, d: e / (b * T::lit(2.0)) }
    }
}

/// (1 + α φ× + β φ×φ×) v.
#[cfg_attr(not(debug_assertions), inline(always))]
fn apply<T: Real>(phi: &Vector3<T>, alpha: T, beta: T, v: &Vector3<T>) -> Vector3<T> {
    let once = cross(phi, v);
    v + scaled(&once, alpha) + scaled(&cross(phi, &once), beta)
}

/// 1 + α φ× + β φ×φ×.
#[cfg_attr(not(debug_assertions), inline(always))]
fn polynomial<T: Real>(phi: &Vector3<T>, alpha: T, beta: T) -> Matrix3<T> {
    let (x, y, z) = (phi.x, phi.y, phi.z);
    let one = T::one();
    let (xx, yy, zz) = (x * x, y * y, z * z);
    Matrix3::new(
        one - beta * (yy + zz),
        beta * x * y - alpha * z,
        beta * x * z + alpha * y,
        beta * x * y + alpha * z,
        one - beta * (zz + xx),
        beta * y * z - alpha * x,
        beta * x * z - alpha * y,
        beta * y * z + alpha * x,
        one - beta * (xx + yy),
    )
}
