//! The motion as a field that any integrator can follow: in (q, q̇), or canonically in (q, p).

use piola_integrators::Field;
use piola_kinematics::Holonomic;
use piola_numerics::Real;
use piola_numerics::linear::ldlt;

use super::acceleration::{Workspace, check_length};
use super::energy::With;
use super::{Forces, Lagrangian, Potential};
use crate::DynamicsError;

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
    /// The motion of a system of `coordinates` degrees of freedom as a field in (q, q̇).
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Vector3;
    /// # use piola_dynamics::lagrangian::{Holonomic, Lagrangian, Placement};
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
    pub fn canonical_motion<T: Real>(&self, coordinates: usize) -> CanonicalMotion<'_, S, P, F, T> {
        CanonicalMotion { lagrangian: self, coordinates, work: Workspace::default() }
    }

    /// The velocities that belong to momenta: the inverse of the Legendre map.
    ///
    /// ```text
    /// ∂L/∂q̇ (q, q̇, t) = p
    /// ```
    ///
    /// One solve with the metric when the potential does not depend on velocities; Newton's iteration from
    /// q̇ = 0 otherwise.
    ///
    /// # Errors
    /// [`DynamicsError::DimensionMismatch`], [`DynamicsError::SingularMetric`],
    /// [`DynamicsError::LegendreNotConverged`].
    ///
    /// # Source
    /// W(9.4).
    pub fn velocities_into<T: Real>(
        &self,
        work: &mut Workspace<T>,
        q: &[T],
        p: &[T],
        t: T,
        out: &mut [T],
    ) -> Result<(), DynamicsError> {
        let n = q.len();
        check_length("p", n, p.len())?;
        check_length("q̇", n, out.len())?;
        out.fill(T::zero());
        if !S::TIME_DEPENDENT && !P::VELOCITY_DEPENDENT {
            out.copy_from_slice(p);
            return self.solve_with_metric(work, q, p, t, out);
        }
        let mut residual = core::mem::take(&mut work.linear);
        residual.resize(n, T::zero());
        let mut result = Ok(());
        for iteration in 1..=NEWTON_ITERATIONS {
            self.differentiate(work, out, q, t, With::Velocities, &mut residual);
            for (residual, &p) in residual.iter_mut().zip(p) {
                *residual = p - *residual;
            }
            if P::VELOCITY_DEPENDENT {
                // ∂²L/∂q̇∂q̇ at the newest velocities.
                self.form_inertia_metric(work, q, t);
                self.subtract_velocity_hessian(work, q, out, t);
                if let Err(error) = ldlt::factor_in_place(&mut work.metric, n) {
                    result = Err(super::acceleration::explain(error, q, p, work, n));
                    break;
                }
                ldlt::solve_in_place(&work.metric, n, &mut residual)?;
            } else if let Err(error) = self.solve_with_metric(work, q, p, t, &mut residual) {
                result = Err(error);
                break;
            }
            let (mut size, mut speed) = (0.0_f64, 0.0_f64);
            for (v, &change) in out.iter_mut().zip(&residual) {
                *v += change;
                for lane in 0..T::LANES {
                    size = size.max(change.primal(lane).abs());
                    speed = speed.max(v.primal(lane).abs());
                }
            }
            let correction = if 0.0 < speed { size / speed } else { 0.0 };
            // Without velocity-dependent potential one step is exact. Derivatives converge one step later.
            if !P::VELOCITY_DEPENDENT || (1 < iteration && correction <= 4.0 * f64::EPSILON) {
                break;
            }
            if iteration == NEWTON_ITERATIONS && !(correction <= 1e-10) {
                result = Err(DynamicsError::LegendreNotConverged { iterations: iteration, correction });
            }
        }
        work.linear = residual;
        result
    }

    /// Solves g x = b in place.
    fn solve_with_metric<T: Real>(
        &self,
        work: &mut Workspace<T>,
        q: &[T],
        p: &[T],
        t: T,
        b: &mut [T],
    ) -> Result<(), DynamicsError> {
        let n = q.len();
        self.form_inertia_metric(work, q, t);
        if let Err(error) = ldlt::factor_in_place(&mut work.metric, n) {
            return Err(super::acceleration::explain(error, q, p, work, n));
        }
        Ok(ldlt::solve_in_place(&work.metric, n, b)?)
    }
}

/// Newton steps of the inverse Legendre map after which it is given up.
const NEWTON_ITERATIONS: usize = 50;

impl<S: Holonomic, P: Potential, F: Forces, T: Real> Field<T> for Motion<'_, S, P, F, T> {
    type Error = DynamicsError;
    fn dimension(&self) -> usize {
        2 * self.coordinates
    }
    fn is_second_order(&self) -> bool {
        true
    }
    #[inline]
    fn rate(&mut self, t: f64, y: &[T], rate: &mut [T]) -> Result<(), DynamicsError> {
        let (q, v) = y.split_at(self.coordinates);
        let (velocity, acceleration) = rate.split_at_mut(self.coordinates);
        velocity.copy_from_slice(v);
        self.lagrangian.acceleration_into(&mut self.work, q, v, T::lit(t), acceleration)
    }
}

impl<S: Holonomic, P: Potential, F: Forces, T: Real> Field<T> for CanonicalMotion<'_, S, P, F, T> {
    type Error = DynamicsError;
    fn dimension(&self) -> usize {
        2 * self.coordinates
    }
    fn rate(&mut self, t: f64, y: &[T], rate: &mut [T]) -> Result<(), DynamicsError> {
        let (q, p) = y.split_at(self.coordinates);
        let (velocity, force) = rate.split_at_mut(self.coordinates);
        let t = T::lit(t);
        self.lagrangian.velocities_into(&mut self.work, q, p, t, velocity)?;
        self.lagrangian.differentiate(&mut self.work, velocity, q, t, With::Coordinates, force);
        if F::GENERALISED || F::ON_PARTS || F::MOMENTS {
            self.lagrangian.add_generalised_forces(&mut self.work, q, velocity, t, force)?;
        }
        Ok(())
    }
}
