//! Eulerian angles in all twelve sequences of axes: charts of the attitudes.
//!
//! z–y–z is the default and the text's. Turn by θ¹ about e₃, by θ² about the moved second axis, by θ³ about f₃:
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
//! The other [sequences](EulerSequence) are z–y–z with the axes renamed and, for those of Tait and Bryan,
//! θ² + π/2 in the place of θ² (cos θ² for s₂, −sin θ² for c₂) and a constant quarter turn at the end. The
//! formulas are therefore written once, for z–y–z, in sines and cosines.
//!
//! Each chart is singular where its first and third axis are one line (gimbal points): there only θ¹ + θ³ or
//! θ¹ − θ³ has a meaning. Ask for the [`condition_number`](EulerAngles::condition_number), and change over to
//! another chart before it is large.
//!
//! # Which one?
//! [`Attitude`] to hold and to integrate an attitude; [`EulerAngles`] to read, print or prescribe one;
//! [`EulerChart`] to follow a tumbling body in angles, in whichever sequence is well conditioned. A placement map
//! whose coordinates are angles holds the sequence as a field, `EulerAngles::new(self.sequence, [q[0], q[1], q[2]])`,
//! and is given the new one with the new coordinates.
//!
//! # References
//! W(2.22–2.28), W(5.30).

mod chart;
mod inverse;
mod sequence;

use nalgebra::{Matrix3, Vector3};
use piola_numerics::Real;

use crate::attitude::Attitude;
use sequence::Layout;

pub use chart::{ChartChange, EulerChart};
pub use inverse::{AnglesOfAttitude, EulerRates};
pub use sequence::EulerSequence;

/// Three angles (rad) about the axes of a sequence.
///
/// # Example
/// ```
/// use piola_kinematics::EulerAngles;
/// // A top that only spins: all of θ̇³ is about f₃.
/// let top = EulerAngles::zyz([0.0, 0.5, 0.0]);
/// assert_eq!(top.angular_velocity_in_body([0.0, 0.0, 7.0]).z, 7.0);
/// ```
///
/// # Source
/// W(2.22).
#[doc(alias("Euler angles", "Cardan angles"))]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(deny_unknown_fields, bound(deserialize = "T: piola_numerics::Real + serde::Deserialize<'de>"))
)]
pub struct EulerAngles<T> {
    /// The axes; z–y–z where it is not given.
    #[cfg_attr(feature = "serde", serde(default))]
    pub sequence: EulerSequence,
    /// θ¹, θ², θ³.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::finite::triple"))]
    pub theta: [T; 3],
}

impl<T> EulerAngles<T> {
    /// The angles z–y–z.
    #[inline]
    #[must_use]
    pub const fn zyz(theta: [T; 3]) -> Self {
        Self { sequence: EulerSequence::Zyz, theta }
    }

    /// Angles about the axes of a sequence.
    #[inline]
    #[must_use]
    pub const fn new(sequence: EulerSequence, theta: [T; 3]) -> Self {
        Self { sequence, theta }
    }
}

/// Sines and cosines of the z–y–z angles that a sequence amounts to: W, Q and their rates in its basis.
#[derive(Clone, Copy)]
struct Canonical<T> {
    layout: Layout,
    first: (T, T),
    second: (T, T),
    third: (T, T),
}

impl<T: Real> Canonical<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn of(angles: &EulerAngles<T>) -> Self {
        let layout = Layout::of(angles.sequence);
        let [first, (s2, c2), (s3, c3)] = angles.theta.map(Real::sin_cos);
        if layout.eulerian {
            return Self { layout, first, second: (s2, c2), third: (s3, c3) };
        }
        Self { layout, first, second: (c2, -s2), third: (s3 * T::lit(layout.third_sign()), c3) }
    }

    /// Rates of the z–y–z angles from those of the sequence, and back.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn rates(&self, [r1, r2, r3]: [T; 3]) -> [T; 3] {
        [r1, r2, r3 * T::lit(self.layout.third_sign())]
    }

    /// The columns of W that are not constant.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn columns_in_body(&self) -> [Vector3<T>; 2] {
        let ((s2, c2), (s3, c3)) = (self.second, self.third);
        [Vector3::new(-(s2 * c3), s2 * s3, c2), Vector3::new(s3, c3, T::zero())]
    }

    /// The columns of Qᵀ W that are not constant: ē₂ and f₃.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn columns_in_space(&self) -> [Vector3<T>; 2] {
        let ((s1, c1), (s2, c2)) = (self.first, self.second);
        [Vector3::new(-s1, c1, T::zero()), Vector3::new(s2 * c1, s2 * s1, c2)]
    }

    /// W θ̇.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn velocity_in_body(&self, [r1, r2, r3]: [T; 3]) -> Vector3<T> {
        let [first, second] = self.columns_in_body();
        Vector3::new(first.x * r1 + second.x * r2, first.y * r1 + second.y * r2, first.z * r1 + r3)
    }

    /// Qᵀ W θ̇.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn velocity_in_space(&self, [r1, r2, r3]: [T; 3]) -> Vector3<T> {
        let [second, third] = self.columns_in_space();
        Vector3::new(second.x * r2 + third.x * r3, second.y * r2 + third.y * r3, r1 + third.z * r3)
    }

    /// Ẇ θ̇.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn changing_in_body(&self, [r1, r2, r3]: [T; 3]) -> Vector3<T> {
        let ((s2, c2), (s3, c3)) = (self.second, self.third);
        Vector3::new(
            r1 * (s2 * s3 * r3 - c2 * c3 * r2) + r2 * c3 * r3,
            r1 * (c2 * s3 * r2 + s2 * c3 * r3) - r2 * s3 * r3,
            -(s2 * r2 * r1),
        )
    }

    /// (Qᵀ W)· θ̇.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn changing_in_space(&self, [r1, r2, r3]: [T; 3]) -> Vector3<T> {
        let ((s1, c1), (s2, c2)) = (self.first, self.second);
        Vector3::new(
            r3 * (c2 * c1 * r2 - s2 * s1 * r1) - r2 * c1 * r1,
            r3 * (c2 * s1 * r2 + s2 * c1 * r1) - r2 * s1 * r1,
            -(s2 * r2 * r3),
        )
    }
}

impl<T: Real> EulerAngles<T> {
    /// The matrix Q: `f_i = Q_ij e_j`, `v_body = Q v_space`.
    ///
    /// # Source
    /// W(2.25).
    #[must_use]
    pub fn matrix(&self) -> Matrix3<T> {
        let canonical = Canonical::of(self);
        let ((s1, c1), (s2, c2), (s3, c3)) = (canonical.first, canonical.second, canonical.third);
        let e1 = Vector3::new(c3 * c2 * c1 - s3 * s1, -(s3 * c2 * c1) - c3 * s1, s2 * c1);
        let e2 = Vector3::new(c3 * c2 * s1 + s3 * c1, c3 * c1 - s3 * c2 * s1, s2 * s1);
        let e3 = Vector3::new(-(c3 * s2), s3 * s2, c2);
        // Column j holds the body components of e_j.
        let columns = [e1, e2, e3].map(|e| canonical.layout.real_from_body(&e));
        let rows = [0, 1, 2].map(|i| Vector3::new(columns[0][i], columns[1][i], columns[2][i]));
        let [a, b, c] = rows.map(|row| canonical.layout.real_from_space(&row));
        Matrix3::new(a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z)
    }

    /// The matrix W: `ω_body = W θ̇`.
    ///
    /// # Source
    /// W(2.28).
    #[must_use]
    pub fn rate_matrix(&self) -> Matrix3<T> {
        let canonical = Canonical::of(self);
        let [first, second] = canonical.columns_in_body();
        let third = Vector3::new(T::zero(), T::zero(), T::lit(canonical.layout.third_sign()));
        Matrix3::from_columns(&[first, second, third].map(|column| canonical.layout.real_from_body(&column)))
    }

    /// The matrix of the space components: `ω_space = W_space θ̇`, `W_space = Qᵀ W`. Its columns are the axes
    /// of the three turns.
    ///
    /// # Source
    /// W(2.26).
    #[must_use]
    pub fn rate_matrix_in_space(&self) -> Matrix3<T> {
        let canonical = Canonical::of(self);
        let [second, third] = canonical.columns_in_space();
        let first = Vector3::new(T::zero(), T::zero(), T::one());
        let third = third * T::lit(canonical.layout.third_sign());
        Matrix3::from_columns(&[first, second, third].map(|column| canonical.layout.real_from_space(&column)))
    }

    /// det W: −sin θ² for z–y–z and all Eulerian sequences, ±cos θ² for those of Tait and Bryan.
    #[must_use]
    pub fn rate_matrix_determinant(&self) -> T {
        let canonical = Canonical::of(self);
        -canonical.second.0 * T::lit(canonical.layout.third_sign())
    }

    /// cond W = (1 + |c₂|)/|s₂| in the spectral norm; infinite at a gimbal point.
    #[must_use]
    pub fn condition_number(&self) -> T {
        // W has the singular values √(1 + |c₂|), 1, √(1 − |c₂|).
        let (s2, c2) = Canonical::of(self).second;
        (T::one() + c2.abs()) / s2.abs()
    }

    /// Angular velocity in body components, ω = W θ̇ (rad/s).
    ///
    /// # Source
    /// W(2.26–2.28).
    #[must_use]
    pub fn angular_velocity_in_body(&self, rates: [T; 3]) -> Vector3<T> {
        let canonical = Canonical::of(self);
        canonical.layout.real_from_body(&canonical.velocity_in_body(canonical.rates(rates)))
    }

    /// Angular velocity in space components, θ̇¹ e₃ + θ̇² ē₂ + θ̇³ f₃ (rad/s).
    ///
    /// # Source
    /// W(2.26).
    #[must_use]
    pub fn angular_velocity_in_space(&self, rates: [T; 3]) -> Vector3<T> {
        let canonical = Canonical::of(self);
        canonical.layout.real_from_space(&canonical.velocity_in_space(canonical.rates(rates)))
    }

    /// Rate of the body components of ω: ω̇ = W θ̈ + Ẇ θ̇ (rad/s²).
    ///
    /// These are also the body components of the rate of ω in space, because ω×ω = 0.
    ///
    /// # Source
    /// W(2.28), differentiated.
    #[must_use]
    pub fn angular_acceleration_in_body(&self, rates: [T; 3], second_rates: [T; 3]) -> Vector3<T> {
        let canonical = Canonical::of(self);
        let (rates, second_rates) = (canonical.rates(rates), canonical.rates(second_rates));
        canonical.layout.real_from_body(&(canonical.velocity_in_body(second_rates) + canonical.changing_in_body(rates)))
    }

    /// Rate of the space components of ω (rad/s²).
    ///
    /// # Source
    /// W(2.26), differentiated.
    #[must_use]
    pub fn angular_acceleration_in_space(&self, rates: [T; 3], second_rates: [T; 3]) -> Vector3<T> {
        let canonical = Canonical::of(self);
        let (rates, second_rates) = (canonical.rates(rates), canonical.rates(second_rates));
        canonical
            .layout
            .real_from_space(&(canonical.velocity_in_space(second_rates) + canonical.changing_in_space(rates)))
    }

    /// The attitude with these angles.
    ///
    /// # Accuracy
    /// A few ulps of one; of its vector part where all angles are small.
    ///
    /// # Source
    /// W(2.22).
    #[must_use]
    pub fn attitude(&self) -> Attitude<T> {
        let layout = Layout::of(self.sequence);
        let [first, second, third] = self.theta;
        let turned = if layout.eulerian {
            Attitude::from_euler_zyz(self.theta)
        } else {
            let tilted = Attitude::about_z(first).product(Attitude::about_y(second));
            tilted.product(Attitude::about_x(third * T::lit(layout.third_sign())))
        };
        let v = layout.real_from_space(&Vector3::new(turned.x, turned.y, turned.z));
        Attitude { w: turned.w, x: v.x, y: v.y, z: v.z }
    }
}
