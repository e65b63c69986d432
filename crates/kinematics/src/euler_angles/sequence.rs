//! The twelve sequences of axes, and how each of them amounts to z–y–z.
//!
//! Turning about the axes i, j, k in this order, each carried along by the turns before it, with j ≠ i and
//! j ≠ k. With h the axis that is neither i nor j, and the right-handed basis `(σ e_h, e_j, e_i)` called
//! (x, y, z), every sequence is one of two:
//!
//! ```text
//! k = i  (Eulerian)      A_z(θ³) A_y(θ²) A_z(θ¹)
//! k = h  (Tait–Bryan)    A_x(σθ³) A_y(θ²) A_z(θ¹) = C A_z(σθ³) A_y(θ² + π/2) A_z(θ¹),  C = A_y(−π/2)
//! ```
//!
//! and C only exchanges components: one set of formulas serves all.

use nalgebra::Vector3;
use piola_numerics::Real;

use crate::attitude::Attitude;

/// The order of the axes of three angles; each turn is about an axis of the body as turned so far.
///
/// The same angles taken in the reverse order about axes fixed in space give the same attitude: roll, pitch
/// and yaw about the fixed x, y, z are the angles (yaw, pitch, roll) of [`Zyx`](Self::Zyx).
///
/// # Example
/// ```
/// use piola_kinematics::EulerSequence;
/// assert_eq!(EulerSequence::default(), EulerSequence::Zyz);
/// assert_eq!(EulerSequence::Zyx.axes(), [2, 1, 0]);
/// assert_eq!(EulerSequence::Zyx.to_string(), "z-y-x");
/// ```
///
/// # Source
/// W(2.22) for z–y–z.
#[doc(alias("Tait-Bryan", "Cardan"))]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum EulerSequence {
    /// z–y–z, the angles of the equations cited here.
    #[default]
    Zyz,
    /// z–x–z: precession, nutation, spin of celestial mechanics.
    Zxz,
    /// x–y–x.
    Xyx,
    /// x–z–x.
    Xzx,
    /// y–x–y.
    Yxy,
    /// y–z–y.
    Yzy,
    /// x–y–z, Cardan's angles.
    Xyz,
    /// x–z–y.
    Xzy,
    /// y–x–z.
    Yxz,
    /// y–z–x.
    Yzx,
    /// z–x–y.
    Zxy,
    /// z–y–x: yaw, pitch, roll.
    #[doc(alias("yaw, pitch, roll", "roll, pitch, yaw"))]
    Zyx,
}

impl EulerSequence {
    /// All twelve: the six Eulerian ones, then the six of Tait and Bryan.
    pub const ALL: [Self; 12] = [
        Self::Zyz,
        Self::Zxz,
        Self::Xyx,
        Self::Xzx,
        Self::Yxy,
        Self::Yzy,
        Self::Xyz,
        Self::Xzy,
        Self::Yxz,
        Self::Yzx,
        Self::Zxy,
        Self::Zyx,
    ];

    /// The three axes, from 0.
    #[must_use]
    pub const fn axes(self) -> [usize; 3] {
        match self {
            Self::Zyz => [2, 1, 2],
            Self::Zxz => [2, 0, 2],
            Self::Xyx => [0, 1, 0],
            Self::Xzx => [0, 2, 0],
            Self::Yxy => [1, 0, 1],
            Self::Yzy => [1, 2, 1],
            Self::Xyz => [0, 1, 2],
            Self::Xzy => [0, 2, 1],
            Self::Yxz => [1, 0, 2],
            Self::Yzx => [1, 2, 0],
            Self::Zxy => [2, 0, 1],
            Self::Zyx => [2, 1, 0],
        }
    }

    /// Whether the third axis is the first again; otherwise all three differ (Tait–Bryan).
    ///
    /// An Eulerian sequence is singular at θ² = 0, π, one of Tait and Bryan at θ² = ±π/2.
    #[must_use]
    pub const fn is_eulerian(self) -> bool {
        let [first, _, third] = self.axes();
        first == third
    }

    /// cond W of this sequence at an attitude: how much an error of the attitude grows in θ¹ and θ³, and one
    /// of the angular velocity in the rates.
    ///
    /// ```text
    /// cond W = √((1 + |m|)/(1 − |m|)),   m = e_i·f_k
    /// ```
    ///
    /// 1 where the first and the third axis are perpendicular, infinite where they are one line.
    ///
    /// # Accuracy
    /// A few ulps × itself.
    #[must_use]
    pub fn condition_number<T: Real>(self, attitude: Attitude<T>) -> T {
        let (sine, cosine) = Layout::of(self).half_angle(attitude);
        // sin θ = 2sc and 1 + |cos θ| = 2 max(s, c)² of the half angle.
        sine.max(cosine) / sine.min(cosine)
    }

    /// The sequence whose angles are best conditioned at an attitude; of equal ones the first in
    /// [`ALL`](Self::ALL).
    ///
    /// Its condition number is below 2: of the three entries `e_i·f_k` in a row of Q one is at most 1/√3.
    #[must_use]
    pub fn best(attitude: Attitude<f64>) -> Self {
        let mut best = (Self::Zyz, Self::Zyz.condition_number(attitude));
        for sequence in Self::ALL {
            let condition_number = sequence.condition_number(attitude);
            // Differences of rounding do not outrank the order.
            if condition_number < best.1 * (1.0 - 1.0e-12) {
                best = (sequence, condition_number);
            }
        }
        best.0
    }
}

impl core::fmt::Display for EulerSequence {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let [first, second, third] = self.axes().map(|axis| ['x', 'y', 'z'][axis]);
        write!(f, "{first}-{second}-{third}")
    }
}

/// Where the components of the basis (x, y, z) of a sequence stand in the real one.
#[derive(Clone, Copy)]
pub(super) struct Layout {
    /// i, the axis z.
    first: usize,
    /// j, the axis y.
    second: usize,
    /// h, the axis ±x.
    beside: usize,
    /// σ: whether x is `e_h` or `−e_h`.
    sign: f64,
    /// k = i.
    pub(super) eulerian: bool,
}

impl Layout {
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) const fn of(sequence: EulerSequence) -> Self {
        let [first, second, _] = sequence.axes();
        let sign = if second == (first + 1) % 3 { -1.0 } else { 1.0 };
        Self { first, second, beside: 3 - first - second, sign, eulerian: sequence.is_eulerian() }
    }

    /// The factor of θ³ and its rates: the third turn of Tait and Bryan is about `σ e_h`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn third_sign(self) -> f64 {
        if self.eulerian { 1.0 } else { self.sign }
    }

    /// Components along (x, y, z) from real ones, of space.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn space<T: Real>(self, v: &Vector3<T>) -> Vector3<T> {
        Vector3::new(v[self.beside] * T::lit(self.sign), v[self.second], v[self.first])
    }

    /// Real components from those along (x, y, z), of space.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn real_from_space<T: Real>(self, v: &Vector3<T>) -> Vector3<T> {
        let mut real = Vector3::zeros();
        real[self.beside] = v.x * T::lit(self.sign);
        real[self.second] = v.y;
        real[self.first] = v.z;
        real
    }

    /// Components along (x, y, z) from real ones, of the body: the constant turn C undone.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn body<T: Real>(self, v: &Vector3<T>) -> Vector3<T> {
        let v = self.space(v);
        if self.eulerian { v } else { Vector3::new(-v.z, v.y, v.x) }
    }

    /// Real components from those along (x, y, z), of the body.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn real_from_body<T: Real>(self, v: &Vector3<T>) -> Vector3<T> {
        if self.eulerian { self.real_from_space(v) } else { self.real_from_space(&Vector3::new(v.z, v.y, -v.x)) }
    }

    /// The quaternion (w, x, y, z) of the z–y–z angles that the sequence amounts to, of any length.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn quaternion<T: Real>(self, attitude: Attitude<T>) -> [T; 4] {
        let v = self.space(&Vector3::new(attitude.x, attitude.y, attitude.z));
        let (w, x, y, z) = (attitude.w, v.x, v.y, v.z);
        // Tait–Bryan: q (1 + j), a quarter turn about y.
        if self.eulerian { [w, x, y, z] } else { [w - y, x - z, w + y, x + z] }
    }

    /// Sine and cosine of half the z–y–z angle θ², of any length.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn half_angle<T: Real>(self, attitude: Attitude<T>) -> (T, T) {
        let [w, x, y, z] = self.quaternion(attitude);
        ((x * x + y * y).sqrt(), (w * w + z * z).sqrt())
    }
}
