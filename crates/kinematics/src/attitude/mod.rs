//! Attitude of a rigid body as a unit quaternion, over any [`Real`].
//!
//! Space basis e, body basis f. The quaternion q = (w, x, y, z) is the active rotation that carries e to f
//! (Hamilton's product, i j = k); it takes body components of a vector to space components:
//!
//! ```text
//! f_i = q e_i q*        v_space = q v_body q*        f_i = Q_ij e_j,  v_body = Q v_space
//! q̇ = ½ q ω_body = ½ ω_space q        ω_body = 2 q* q̇        ω_space = 2 q̇ q*
//! ```
//!
//! The default state of a body: it has no singular attitude, unlike three angles (whose determinant
//! det W = −sin θ² vanishes at θ² = 0, π). q and −q are the same attitude.
//!
//! # References
//! W(2.10–2.14), W(2.22).

mod conversions;

pub(crate) use conversions::products;

use nalgebra::{Matrix3, Vector3};
use piola_numerics::{Mask, Real};

use crate::vector::{cross, dot, scaled};

/// The attitude of a body: a unit quaternion w + x i + y j + z k that takes body to space components.
///
/// The fields are open because formulas need them; whoever fills them keeps w² + x² + y² + z² = 1
/// ([`from_quaternion`](Attitude::from_quaternion) checks). All methods keep it to rounding.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_kinematics::Attitude;
/// // A quarter turn about z carries f₁ to e₂.
/// let attitude = Attitude::about_z(std::f64::consts::FRAC_PI_2);
/// let f1 = attitude.to_space(&Vector3::x());
/// assert!((f1 - Vector3::y()).norm() <= f64::EPSILON);
/// // A turn of 1 rad/s about it: q̇ = ½ q ω.
/// let rate = attitude.rate(&Vector3::z());
/// assert_eq!(attitude.angular_velocity_in_body(rate).z.round(), 1.0);
/// ```
///
/// # Source
/// W(2.10), W(2.13).
#[doc(alias("quaternion", "orientation", "rotation"))]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "[T; 4]",
        into = "[T; 4]",
        bound(serialize = "T: Real + serde::Serialize", deserialize = "T: Real + serde::Deserialize<'de>")
    )
)]
pub struct Attitude<T> {
    /// Scalar part, cos(angle/2).
    pub w: T,
    /// First component of the vector part, sin(angle/2) times the axis.
    pub x: T,
    /// Second component of the vector part.
    pub y: T,
    /// Third component of the vector part.
    pub z: T,
}

impl<T: Real> Attitude<T> {
    /// The attitude whose body basis is the space basis: q = 1.
    #[inline]
    #[must_use]
    pub fn identity() -> Self {
        Self { w: T::one(), x: T::zero(), y: T::zero(), z: T::zero() }
    }

    /// Rotation by `angle` (rad) about the first axis.
    #[inline]
    #[must_use]
    pub fn about_x(angle: T) -> Self {
        let (s, c) = (angle * T::lit(0.5)).sin_cos();
        Self { w: c, x: s, y: T::zero(), z: T::zero() }
    }

    /// Rotation by `angle` (rad) about the second axis.
    #[inline]
    #[must_use]
    pub fn about_y(angle: T) -> Self {
        let (s, c) = (angle * T::lit(0.5)).sin_cos();
        Self { w: c, x: T::zero(), y: s, z: T::zero() }
    }

    /// Rotation by `angle` (rad) about the third axis.
    #[inline]
    #[must_use]
    pub fn about_z(angle: T) -> Self {
        let (s, c) = (angle * T::lit(0.5)).sin_cos();
        Self { w: c, x: T::zero(), y: T::zero(), z: s }
    }

    /// Eulerian angles z–y–z: turn by θ¹ about e₃, by θ² about the moved second axis, by θ³ about f₃.
    ///
    /// ```text
    /// q = q_z(θ¹) q_y(θ²) q_z(θ³)        Q = A₃(θ³) A₂(θ²) A₁(θ¹)
    /// ```
    ///
    /// Other sequences: [`EulerAngles::attitude`](crate::EulerAngles::attitude).
    ///
    /// # Source
    /// W(2.22–2.25).
    #[inline]
    #[must_use]
    pub fn from_euler_zyz(theta: [T; 3]) -> Self {
        let half = T::lit(0.5);
        let (s2, c2) = (theta[1] * half).sin_cos();
        let (s_sum, c_sum) = ((theta[0] + theta[2]) * half).sin_cos();
        let (s_difference, c_difference) = ((theta[2] - theta[0]) * half).sin_cos();
        Self { w: c2 * c_sum, x: s2 * s_difference, y: s2 * c_difference, z: c2 * s_sum }
    }

    /// The rotation by |φ| about φ: the exponential of the rotation vector φ (rad).
    ///
    /// ```text
    /// q = ( cos(|φ|/2),  φ sin(|φ|/2)/|φ| )
    /// ```
    ///
    /// Its derivative and the inverse of that: [`RotationVector`](crate::RotationVector).
    ///
    /// Both functions are entire in φ·φ and are computed as such below one radian, so that values and
    /// derivatives of any order are right at φ = 0 as well.
    ///
    /// # Accuracy
    /// A few ulps at any angle; no cancellation at small ones.
    #[doc(alias = "exponential map")]
    #[inline]
    #[must_use]
    pub fn from_rotation_vector(phi: &Vector3<T>) -> Self {
        let (cosine, half_sinc) = half_angle_functions(dot(phi, phi));
        Self { w: cosine, x: phi.x * half_sinc, y: phi.y * half_sinc, z: phi.z * half_sinc }
    }

    /// The rotation vector of least length, |φ| ≤ π: the logarithm of the attitude (rad).
    ///
    /// ```text
    /// φ = 2 arctan(|v|/w) v/|v|,   v = (x, y, z),  q replaced by −q where w < 0
    /// ```
    ///
    /// The inverse of [`from_rotation_vector`](Attitude::from_rotation_vector) for |φ| < π; at |φ| = π
    /// one of the two vectors ±φ.
    ///
    /// # Accuracy
    /// A few ulps, also for tiny rotations; derivatives are finite at the identity.
    #[doc(alias = "logarithm")]
    #[must_use]
    pub fn rotation_vector(self) -> Vector3<T> {
        let negative = self.w.less_than(T::zero());
        let sign = T::select(negative, T::lit(-1.0), T::one());
        let (w, v) = (self.w * sign, scaled(&self.vector(), sign));
        let squared = dot(&v, &v);
        // arctan(√t)/√t = Σ (−t)ᵏ/(2k+1) with t = |v|²/w²; twelve terms leave 64⁻¹² below t = 1/64.
        let small = (squared * T::lit(64.0)).less_than(w * w);
        let safe_w = T::select(small, w, T::one());
        let t = T::select(small, squared, T::zero()) / (safe_w * safe_w);
        let mut series = T::lit(-1.0 / 23.0);
        for k in (0..11_i32).rev() {
            let coefficient = 1.0 / f64::from(2 * k + 1);
            series = series * t + T::lit(if k % 2 == 0 { coefficient } else { -coefficient });
        }
        let near = series / safe_w;
        let length = T::select(small, T::one(), squared).sqrt();
        let far = length.atan2(w) / length;
        scaled(&v, T::select(small, near, far) * T::lit(2.0))
    }

    /// The attitude reached by turning first as `other` says and then, in space, as `self` says: the
    /// Hamilton product q p. Equivalently `other` is taken about the axes that `self` has reached.
    #[inline]
    #[must_use]
    pub fn product(self, other: Self) -> Self {
        let [w, x, y, z] = hamilton_product(self.into(), other.into());
        Self { w, x, y, z }
    }

    /// The inverse rotation, q*.
    #[inline]
    #[must_use]
    pub fn conjugate(self) -> Self {
        Self { w: self.w, x: -self.x, y: -self.y, z: -self.z }
    }

    /// Space components of a vector given by its body components: `v_space = q v_body q*`.
    ///
    /// ```text
    /// v_space = v + 2 w u×v + 2 u×(u×v),   u = (x, y, z)
    /// ```
    #[inline]
    #[must_use]
    pub fn to_space(self, in_body: &Vector3<T>) -> Vector3<T> {
        let u = self.vector();
        let twice = cross(&u, in_body).map(|x| x + x);
        in_body + scaled(&twice, self.w) + cross(&u, &twice)
    }

    /// Body components of a vector given by its space components: `v_body = Q v_space = q* v_space q`.
    #[inline]
    #[must_use]
    pub fn to_body(self, in_space: &Vector3<T>) -> Vector3<T> {
        self.conjugate().to_space(in_space)
    }

    /// The matrix Q of the attitude: `f_i = Q_ij e_j` and `v_body = Q v_space`. Row i holds the space
    /// components of `f_i`.
    ///
    /// Mind the direction: nalgebra's rotation of the same attitude, body to space, is Qᵀ.
    ///
    /// # Source
    /// W(2.22).
    #[doc(alias("direction cosine matrix", "rotation matrix"))]
    #[must_use]
    pub fn to_matrix(self) -> Matrix3<T> {
        let Self { w, x, y, z } = self;
        let (one, two) = (T::one(), T::lit(2.0));
        Matrix3::new(
            one - two * (y * y + z * z),
            two * (x * y + w * z),
            two * (x * z - w * y),
            two * (x * y - w * z),
            one - two * (x * x + z * z),
            two * (y * z + w * x),
            two * (x * z + w * y),
            two * (y * z - w * x),
            one - two * (x * x + y * y),
        )
    }

    /// Angular velocity in body components from the quaternion's rate (w, x, y, z)·: ω = 2 q* q̇.
    ///
    /// The rate may be the derivative along any parameter: with ∂q/∂q^Δ the result is the angular
    /// velocity `ω_Δ` of the tangent vector `h_Δ`. With q̈ it is ω̇, since q̇* q̇ has no vector part.
    ///
    /// # Source
    /// W(2.13–2.14).
    #[doc(alias = "spin")]
    #[inline]
    #[must_use]
    pub fn angular_velocity_in_body(self, rate: [T; 4]) -> Vector3<T> {
        let [_, x, y, z] = hamilton_product(self.conjugate().into(), rate);
        scaled(&Vector3::new(x, y, z), T::lit(2.0))
    }

    /// Angular velocity in space components from the quaternion's rate (w, x, y, z)·: ω = 2 q̇ q*.
    ///
    /// # Source
    /// W(2.13–2.14).
    #[doc(alias = "spin")]
    #[inline]
    #[must_use]
    pub fn angular_velocity_in_space(self, rate: [T; 4]) -> Vector3<T> {
        let [_, x, y, z] = hamilton_product(rate, self.conjugate().into());
        scaled(&Vector3::new(x, y, z), T::lit(2.0))
    }

    /// The quaternion's rate (w, x, y, z)· at an angular velocity in body components: q̇ = ½ q ω.
    ///
    /// # Source
    /// W(2.13).
    #[inline]
    #[must_use]
    pub fn rate(self, angular_velocity_in_body: &Vector3<T>) -> [T; 4] {
        let half = scaled(angular_velocity_in_body, T::lit(0.5));
        hamilton_product(self.into(), [T::zero(), half.x, half.y, half.z])
    }

    /// The nearest unit quaternion q/|q|: takes away what rounding or an integrator has added.
    ///
    /// A quaternion of length zero has no nearest attitude: the result is not finite. Data from outside
    /// goes through [`from_quaternion`](Attitude::from_quaternion), which refuses it.
    #[inline]
    #[must_use]
    pub fn normalise(self) -> Self {
        let factor = self.squared_length().sqrt().recip();
        Self { w: self.w * factor, x: self.x * factor, y: self.y * factor, z: self.z * factor }
    }

    /// w² + x² + y² + z²: one, but for rounding.
    #[inline]
    #[must_use]
    pub fn squared_length(self) -> T {
        self.w * self.w + self.x * self.x + self.y * self.y + self.z * self.z
    }

    /// A constant attitude in another scalar: all derivatives zero, the same in every lane.
    #[inline]
    #[must_use]
    pub fn constant(attitude: Attitude<f64>) -> Self {
        Self { w: T::lit(attitude.w), x: T::lit(attitude.x), y: T::lit(attitude.y), z: T::lit(attitude.z) }
    }

    /// Vector part of the quaternion.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn vector(self) -> Vector3<T> {
        Vector3::new(self.x, self.y, self.z)
    }
}

/// q p of two quaternions (w, x, y, z), Hamilton's i j = k.
#[cfg_attr(not(debug_assertions), inline(always))]
fn hamilton_product<T: Real>(q: [T; 4], p: [T; 4]) -> [T; 4] {
    [
        q[0] * p[0] - q[1] * p[1] - q[2] * p[2] - q[3] * p[3],
        q[0] * p[1] + q[1] * p[0] + q[2] * p[3] - q[3] * p[2],
        q[0] * p[2] - q[1] * p[3] + q[2] * p[0] + q[3] * p[1],
        q[0] * p[3] + q[1] * p[2] - q[2] * p[1] + q[3] * p[0],
    ]
}

/// (cos(a/2), sin(a/2)/a) as functions of a² ≥ 0, smooth at zero.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn half_angle_functions<T: Real>(squared_angle: T) -> (T, T) {
    // Below a² = 1 the power series in h = a²/4: eleven terms leave 4⁻¹¹/22! ≈ 2·10⁻²⁸.
    let small = squared_angle.less_than(T::one());
    let h = squared_angle * T::lit(0.25);
    let (mut cosine, mut sinc) = (T::one(), T::one());
    for k in (1..11_i32).rev() {
        let k = f64::from(k);
        cosine = T::one() - h * cosine * T::lit(1.0 / (2.0 * k * (2.0 * k - 1.0)));
        sinc = T::one() - h * sinc * T::lit(1.0 / (2.0 * k * (2.0 * k + 1.0)));
    }
    if small.all() {
        return (cosine, sinc * T::lit(0.5));
    }
    // The root is taken of one where the series serves, so that its derivative is finite there.
    let angle = T::select(small, T::one(), squared_angle).sqrt();
    let (s, c) = (angle * T::lit(0.5)).sin_cos();
    (T::select(small, cosine, c), T::select(small, sinc * T::lit(0.5), s / angle))
}
