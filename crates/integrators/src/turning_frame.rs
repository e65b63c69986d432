//! Equations in a frame that turns, solved in the frame at rest.

use piola_numerics::Real;

use crate::state::check_finite;
use crate::{IntegratorsError, SecondOrder, State};

/// Forces that are known in a frame that turns at a constant rate, as equations of the frame at rest.
///
/// ```text
/// turning:   q̈ = f(t, q) − 2Ω × q̇ − Ω × (Ω × q)
/// at rest:   r = R q,    r̈ = R f(t, Rᵀ r),    R = turn about the third axis by the angle Ωt
/// ```
///
/// In the frame at rest accelerations do not depend on velocities: Nyström pairs apply, and [`GaussLegendre16`](crate::GaussLegendre16)
/// needs fewer sweeps. Write f without centrifugal and Coriolis' forces. Examples are the restricted problem of three
/// bodies, and bodies over the turning Earth.
///
/// | symbol | argument | shape | unit |
/// |---|---|---|---|
/// | Ω | `rate` | scalar, about the third axis | rad/s |
/// | q, r | coordinates of points in turn, in the plane (x, y) or in space (x, y, z) | 2 or 3 a point | m |
///
/// Errors are compared with the largest position and velocity in the frame at rest: [`SecondOrder::magnitudes`] of the forces is not
/// asked.
///
/// # Example
/// ```
/// use core::convert::Infallible;
/// use piola_integrators::{Nystrom86, SecondOrder, State, Tolerance, TurningFrame};
/// use piola_numerics::Real;
/// struct NoForce;
/// impl<T: Real> SecondOrder<T> for NoForce {
///     type Error = Infallible;
///     const VELOCITY_DEPENDENT: bool = false;
///     fn freedom(&self) -> usize {
///         2
///     }
///     fn acceleration(&mut self, _t: T, _q: &[T], _v: &[T], acceleration: &mut [T]) -> Result<(), Infallible> {
///         acceleration.fill(T::zero());
///         Ok(())
///     }
/// }
/// // Left at rest at (1, 0) on a disc that turns by 1 rad/s: seen from the disc it goes backwards and outwards.
/// let mut frame = TurningFrame::in_plane(NoForce, 1.0)?;
/// let mut state = State::new(0.0, vec![1.0, 0.0, 0.0, 0.0])?;
/// frame.to_rest(&mut state)?;
/// Nystrom86::new(Tolerance::relative(1e-12)?).integrate_to(&mut frame, &mut state, 2.0)?;
/// frame.to_turning(&mut state)?;
/// let (sine, cosine) = 2.0_f64.sin_cos();
/// assert!((state.values[0] - (cosine + 2.0 * sine)).abs() < 1e-14);
/// assert!((state.values[1] - (2.0 * cosine - sine)).abs() < 1e-14);
/// # Ok::<(), piola_integrators::IntegratorsError>(())
/// ```
///
/// # Source
/// W(4.26), the motion in a moving frame.
#[doc(alias("rotating frame", "Coriolis", "restricted three-body problem", "synodic"))]
#[derive(Clone, Debug)]
pub struct TurningFrame<F, T = f64> {
    field: F,
    rate: f64,
    /// Coordinates of a point.
    dimension: usize,
    /// Positions in the turning frame.
    turned: Vec<T>,
    /// The time of the last evaluation with sine and cosine there: sweeps of a step share their times.
    angle: Option<[T; 3]>,
}

impl<F: SecondOrder<T>, T: Real> TurningFrame<F, T> {
    /// Points in the plane.
    ///
    /// # Errors
    /// [`IntegratorsError::NotFinite`] for the rate; [`IntegratorsError::VelocityDependent`] for forces that depend on
    /// velocities; [`IntegratorsError::WrongLength`] unless the field has whole points.
    pub fn in_plane(field: F, rate: f64) -> Result<Self, IntegratorsError> {
        Self::new(field, rate, 2)
    }

    /// Points in space.
    ///
    /// # Errors
    /// As [`in_plane`](Self::in_plane).
    pub fn in_space(field: F, rate: f64) -> Result<Self, IntegratorsError> {
        Self::new(field, rate, 3)
    }

    fn new(field: F, rate: f64, dimension: usize) -> Result<Self, IntegratorsError> {
        check_finite("rate", None, &[rate])?;
        if field.is_velocity_dependent() {
            return Err(IntegratorsError::VelocityDependent);
        }
        whole_points("field", field.freedom(), dimension)?;
        Ok(Self { field, rate, dimension, turned: Vec::new(), angle: None })
    }

    /// The forces.
    pub const fn field(&self) -> &F {
        &self.field
    }

    /// Turns a state (q, q̇) of the turning frame into (r, ṙ) at its time.
    ///
    /// # Errors
    /// [`IntegratorsError::WrongLength`] unless the state holds whole points.
    pub fn to_rest(&self, state: &mut State) -> Result<(), IntegratorsError> {
        self.turn(state, 1.0)
    }

    /// Turns a state (r, ṙ) of the frame at rest into (q, q̇) at its time.
    ///
    /// # Errors
    /// As [`to_rest`](Self::to_rest).
    pub fn to_turning(&self, state: &mut State) -> Result<(), IntegratorsError> {
        self.turn(state, -1.0)
    }

    fn turn(&self, state: &mut State, sense: f64) -> Result<(), IntegratorsError> {
        let found = state.values.len();
        whole_points("state", found, 2 * self.dimension)?;
        let (sine, cosine) = (sense * self.rate * state.time).sin_cos();
        let turned = |[x, y]: [f64; 2]| [cosine * x - sine * y, sine * x + cosine * y];
        for part in [&mut state.values, &mut state.carry] {
            let (positions, velocities) = part.split_at_mut(found / 2);
            for (q, v) in positions.chunks_exact_mut(self.dimension).zip(velocities.chunks_exact_mut(self.dimension)) {
                let (x, y) = (q[0], q[1]);
                [q[0], q[1]] = turned([x, y]);
                // ṙ = R (q̇ + Ω × q), q̇ = Rᵀ ṙ − Ω × q.
                [v[0], v[1]] = turned([v[0], v[1]]);
                let (x, y) = (q[0], q[1]);
                (v[0], v[1]) = (v[0] - sense * self.rate * y, v[1] + sense * self.rate * x);
            }
        }
        Ok(())
    }
}

fn whole_points(quantity: &'static str, found: usize, whole: usize) -> Result<(), IntegratorsError> {
    if found.is_multiple_of(whole) {
        return Ok(());
    }
    Err(IntegratorsError::WrongLength { quantity, expected: found.div_ceil(whole) * whole, found })
}

impl<T: Real, F: SecondOrder<T>> SecondOrder<T> for TurningFrame<F, T> {
    type Error = F::Error;
    const VELOCITY_DEPENDENT: bool = false;
    const FREEDOM: Option<usize> = F::FREEDOM;

    fn freedom(&self) -> usize {
        self.field.freedom()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn acceleration(&mut self, t: T, q: &[T], v: &[T], acceleration: &mut [T]) -> Result<(), F::Error> {
        let (sine, cosine) = match self.angle {
            Some([known, sine, cosine]) if known == t => (sine, cosine),
            _ => {
                let (sine, cosine) = (T::lit(self.rate) * t).sin_cos();
                self.angle = Some([t, sine, cosine]);
                (sine, cosine)
            }
        };
        let n = F::FREEDOM.unwrap_or(q.len());
        if self.turned.len() != n {
            self.turned.resize(n, T::zero());
        }
        let turned = &mut self.turned[..n];
        turned.copy_from_slice(&q[..n]);
        for q in turned.chunks_exact_mut(self.dimension) {
            let (x, y) = (q[0], q[1]);
            (q[0], q[1]) = (cosine * x + sine * y, cosine * y - sine * x);
        }
        self.field.acceleration(t, turned, v, acceleration)?;
        for a in acceleration[..n].chunks_exact_mut(self.dimension) {
            let (x, y) = (a[0], a[1]);
            (a[0], a[1]) = (cosine * x - sine * y, sine * x + cosine * y);
        }
        Ok(())
    }
}
