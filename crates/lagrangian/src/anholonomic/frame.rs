//! What is given of a frame: its vectors, or the quasi-velocities themselves.

use piola_numerics::Real;

/// n vectors that span the velocities, as functions of the coordinates.
///
/// ```text
/// q̇^C = k_A^C u^A + d^C                                                              W(6.12), W(6.15)
/// ```
///
/// The quasi-velocities u are the components of q̇ in the frame. A drift d, rarely needed, is the velocity at
/// u = 0: that of a moving floor, say.
///
/// # Example
/// See [`InFrame`](super::InFrame).
///
/// # Source
/// W(6.12).
pub trait AnholonomicFrame {
    /// Whether frame or drift depend on time; otherwise `t` must not be used.
    const TIME_DEPENDENT: bool = false;
    /// Whether [`drift`](Self::drift) is to be called.
    const DRIFT: bool = false;
    /// Writes k_A^C to `rows[A n + C]`: one vector after the other, all n² entries.
    fn frame<T: Real>(&self, q: &[T], t: T, rows: &mut [T]);
    /// Writes d, all n entries.
    fn drift<T: Real>(&self, _q: &[T], _t: T, _drift: &mut [T]) {}
}

/// n quasi-velocities that are linear in the velocities, as functions of the coordinates.
///
/// ```text
/// u^A = A^A_C(q, t) q̇^C + a^A(q, t)                                                         W(6.15)
/// ```
///
/// Rolling conditions come as rows of A: what slips. The frame is the inverse matrix.
///
/// # Example
/// See [`Nonholonomic`](super::Nonholonomic).
///
/// # Source
/// W(6.15).
pub trait Coframe {
    /// Whether A or a depend on time; otherwise `t` must not be used.
    const TIME_DEPENDENT: bool = false;
    /// Whether [`drift`](Self::drift) is to be called.
    const DRIFT: bool = false;
    /// Writes A^A_C to `rows[A n + C]`: one quasi-velocity after the other, all n² entries.
    fn coframe<T: Real>(&self, q: &[T], t: T, rows: &mut [T]);
    /// Writes a, all n entries: u at q̇ = 0, that of a floor moving below, say.
    fn drift<T: Real>(&self, _q: &[T], _t: T, _drift: &mut [T]) {}
}

/// Either of the two, as the equations take them: [`ByFrame`] or [`ByCoframe`].
///
/// # Example
/// See [`structure_coefficients`](super::structure_coefficients).
pub trait QuasiVelocities {
    /// Whether the matrix is the coframe.
    const COFRAME: bool;
    /// Whether there is dependence on time.
    const TIME_DEPENDENT: bool;
    /// Whether there is a drift.
    const DRIFT: bool;
    /// Writes the matrix, row after row.
    fn matrix<T: Real>(&self, q: &[T], t: T, rows: &mut [T]);
    /// Writes the drift; it is zero before.
    fn drift<T: Real>(&self, q: &[T], t: T, drift: &mut [T]);
}

/// Quasi-velocities by the vectors of an [`AnholonomicFrame`].
///
/// # Example
/// See [`structure_coefficients`](super::structure_coefficients).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ByFrame<K>(pub K);

/// Quasi-velocities as a [`Coframe`] gives them.
///
/// # Example
/// See [`BodyAngularVelocity`](super::BodyAngularVelocity).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ByCoframe<C>(pub C);

impl<K: AnholonomicFrame> QuasiVelocities for ByFrame<K> {
    const COFRAME: bool = false;
    const TIME_DEPENDENT: bool = K::TIME_DEPENDENT;
    const DRIFT: bool = K::DRIFT;
    #[inline]
    fn matrix<T: Real>(&self, q: &[T], t: T, rows: &mut [T]) {
        self.0.frame(q, t, rows);
    }
    #[inline]
    fn drift<T: Real>(&self, q: &[T], t: T, drift: &mut [T]) {
        self.0.drift(q, t, drift);
    }
}

impl<C: Coframe> QuasiVelocities for ByCoframe<C> {
    const COFRAME: bool = true;
    const TIME_DEPENDENT: bool = C::TIME_DEPENDENT;
    const DRIFT: bool = C::DRIFT;
    #[inline]
    fn matrix<T: Real>(&self, q: &[T], t: T, rows: &mut [T]) {
        self.0.coframe(q, t, rows);
    }
    #[inline]
    fn drift<T: Real>(&self, q: &[T], t: T, drift: &mut [T]) {
        self.0.drift(q, t, drift);
    }
}
