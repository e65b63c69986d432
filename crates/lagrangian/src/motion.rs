//! The motion as a field that any integrator can follow: in (q, q̇), or canonically in (q, p).

use piola_integrators::{Field, SecondOrder};
use piola_kinematics::Holonomic;
use piola_numerics::Real;

use super::energy::With;
use super::workspace::Workspace;
use super::{Forces, Lagrangian, Potential};
use crate::LagrangianError;

/// The motion in positions and velocities, y = (q, q̇): W(7.23).
///
/// # Example
/// See [`Lagrangian::motion`].
#[derive(Clone, Debug)]
pub struct Motion<'a, S, P, F, T = f64> {
    lagrangian: &'a Lagrangian<S, P, F>,
    coordinates: usize,
    work: Workspace<T>,
}

/// The motion in positions and momenta, y = (q, p): Hamilton's equations of a Lagrangian that is quadratic
/// in the velocities.
///
/// ```text
/// q̇ = g⁻¹ (p − b)        ṗ = ∂L/∂q + Q
/// ```
///
/// Symplectic methods are symplectic in these variables.
#[derive(Clone, Debug)]
pub struct CanonicalMotion<'a, S, P, F, T = f64> {
    lagrangian: &'a Lagrangian<S, P, F>,
    coordinates: usize,
    work: Workspace<T>,
}

impl<S: Holonomic, P: Potential, F: Forces> Lagrangian<S, P, F> {
    /// The motion of a system of `coordinates` degrees of freedom as a field in (q, q̇), and as one of second order.
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Vector3;
    /// # use piola_lagrangian::{Holonomic, Lagrangian, Placement};
    /// # use piola_numerics::Real;
    /// use piola_integrators::{DormandPrince853, State, Tolerance};
    /// # struct Stone;
    /// # impl Holonomic for Stone {
    /// #     fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
    /// #         bodies.particle(2.0, Vector3::new(T::zero(), T::zero(), q[0]));
    /// #     }
    /// # }
    /// // A stone thrown up with 10 m/s under 10 m/s² is back after two seconds.
    /// let stone = Lagrangian::of(Stone).with_gravity(10.0);
    /// let mut state = State::new(0.0, vec![0.0, 10.0])?;
    /// let mut method = DormandPrince853::new(Tolerance::relative(1e-12)?);
    /// method.integrate_to(&mut stone.motion(1), &mut state, 2.0)?;
    /// assert!(state.values[0].abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn motion<T: Real>(&self, coordinates: usize) -> Motion<'_, S, P, F, T> {
        Motion { lagrangian: self, coordinates, work: Workspace::default() }
    }

    /// The motion as a field in (q, p), for symplectic integration.
    ///
    /// Start it with [`momenta`](Self::momenta); [`velocities_into`](Self::velocities_into) leads back.
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Vector3;
    /// # use piola_lagrangian::{Holonomic, Lagrangian, Placement};
    /// # use piola_numerics::Real;
    /// use piola_integrators::{GaussLegendre, Order, State};
    /// struct Polar; // q = [r, φ], 2 kg
    /// impl Holonomic for Polar {
    ///     fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
    ///         let (s, c) = q[1].sin_cos();
    ///         bodies.particle(2.0, Vector3::new(q[0] * c, q[0] * s, T::zero()));
    ///     }
    /// }
    /// // Past the origin at 3 m with 4 m/s across: p = (0, m r² φ̇) = (0, 24). After a second it is 5 m away.
    /// let polar = Lagrangian::of(Polar);
    /// let mut state = State::new(0.0, vec![3.0, 0.0, 0.0, 24.0])?;
    /// GaussLegendre::new(Order::Eight, 0.05)?.integrate_to(&mut polar.canonical_motion(2), &mut state, 1.0)?;
    /// assert!((state.values[0] - 5.0).abs() < 1e-9 && (state.values[3] - 24.0).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Source
    /// W(9.10).
    pub fn canonical_motion<T: Real>(&self, coordinates: usize) -> CanonicalMotion<'_, S, P, F, T> {
        CanonicalMotion { lagrangian: self, coordinates, work: Workspace::default() }
    }
}

impl<S: Holonomic, P: Potential, F: Forces, T: Real> Field<T> for Motion<'_, S, P, F, T> {
    type Error = LagrangianError;
    fn dimension(&self) -> usize {
        2 * self.coordinates
    }
    fn is_second_order(&self) -> bool {
        true
    }
    #[inline]
    fn rate(&mut self, t: f64, y: &[T], rate: &mut [T]) -> Result<(), LagrangianError> {
        let (q, v) = y.split_at(self.coordinates);
        let (velocity, acceleration) = rate.split_at_mut(self.coordinates);
        velocity.copy_from_slice(v);
        self.lagrangian.acceleration_into(&mut self.work, q, v, T::lit(t), acceleration)
    }
}

impl<S: Holonomic, P: Potential, F: Forces, T: Real> SecondOrder<T> for Motion<'_, S, P, F, T> {
    type Error = LagrangianError;
    fn freedom(&self) -> usize {
        self.coordinates
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn acceleration(&mut self, t: T, q: &[T], v: &[T], acceleration: &mut [T]) -> Result<(), LagrangianError> {
        self.lagrangian.accelerate(&mut self.work, q, v, t, acceleration)
    }
}

impl<S: Holonomic, P: Potential, F: Forces, T: Real> Field<T> for CanonicalMotion<'_, S, P, F, T> {
    type Error = LagrangianError;
    fn dimension(&self) -> usize {
        2 * self.coordinates
    }
    fn rate(&mut self, t: f64, y: &[T], rate: &mut [T]) -> Result<(), LagrangianError> {
        let (q, p) = y.split_at(self.coordinates);
        let (velocity, force) = rate.split_at_mut(self.coordinates);
        let t = T::lit(t);
        self.lagrangian.velocities_into(&mut self.work, q, p, t, velocity)?;
        self.lagrangian.differentiate(&mut self.work, q, velocity, t, With::Coordinates, force);
        if F::GENERALISED || F::ON_PARTS || F::MOMENTS {
            self.lagrangian.add_generalised_forces(&mut self.work, q, velocity, t, force)?;
        }
        Ok(())
    }
}
