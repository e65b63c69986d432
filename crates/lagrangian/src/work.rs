//! Bookkeeping of work along a motion: the power integrated with the motion itself.
//!
//! ```text
//! E(t₁) + V(t₁) − E(t₀) − V(t₀) = ∫ (Q_applied·v + P_constraint + ∂V/∂t) dt                  W(5.17), W(7.9)
//! ```

use core::ops::Range;

use piola_integrators::{DormandPrince853, Field, IntegratorsError, State, Tolerance};
use piola_kinematics::Holonomic;
use piola_numerics::Real;

use super::workspace::Workspace;
use super::{Forces, Lagrangian, Potential};
use crate::LagrangianError;
use crate::check::{check_finite, check_length};

/// Works since the start, J.
///
/// # Example
/// See [`Lagrangian::motion_with_work`].
///
/// # Source
/// W(5.17), W(7.9).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Works<T = f64> {
    /// Of the applied forces, moments and generalised forces.
    pub applied: T,
    /// Of the moving constraint.
    pub moving_constraint: T,
    /// ∫ ∂V/∂t dt: what the time put into the potential energy.
    pub potential_by_time: T,
}

impl<T: Real> Works<T> {
    /// What entered the system, J.
    pub fn total(self) -> T {
        self.applied + self.moving_constraint + self.potential_by_time
    }
}

/// The motion together with the works, y = (q, q̇, W_applied, W_constraint, W_time): a field for any integrator.
///
/// # Example
/// See [`Lagrangian::motion_with_work`].
#[derive(Clone, Debug)]
pub struct MotionWithWork<'a, S, P, F, T = f64> {
    lagrangian: &'a Lagrangian<S, P, F>,
    coordinates: usize,
    energy_scale: f64,
    work: Workspace<T>,
}

impl<S: Holonomic, P: Potential, F: Forces, T: Real> MotionWithWork<'_, S, P, F, T> {
    /// The works of a state of this field.
    ///
    /// # Errors
    /// [`LagrangianError::WrongLength`].
    pub fn works(&self, y: &[T]) -> Result<Works<T>, LagrangianError> {
        check_length("y", Field::<T>::dimension(self), y.len())?;
        let works = &y[2 * self.coordinates..];
        Ok(Works { applied: works[0], moving_constraint: works[1], potential_by_time: works[2] })
    }
}

impl<S: Holonomic, P: Potential, F: Forces, T: Real> Field<T> for MotionWithWork<'_, S, P, F, T> {
    type Error = LagrangianError;
    fn dimension(&self) -> usize {
        2 * self.coordinates + 3
    }
    fn rate(&mut self, t: f64, y: &[T], rate: &mut [T]) -> Result<(), LagrangianError> {
        let n = self.coordinates;
        let (q, v) = y[..2 * n].split_at(n);
        let (velocity, rest) = rate.split_at_mut(n);
        let (acceleration, powers) = rest.split_at_mut(n);
        velocity.copy_from_slice(v);
        let t = T::lit(t);
        self.lagrangian.acceleration_into(&mut self.work, q, v, t, acceleration)?;
        let balance = self.lagrangian.power_balance_at_acceleration(&mut self.work, q, v, acceleration, t)?;
        powers.copy_from_slice(&[balance.applied, balance.moving_constraint, balance.potential_by_time]);
        Ok(())
    }
    fn magnitudes(&self, y: &[T], magnitudes: &mut [f64]) {
        let n = self.coordinates;
        let largest = |values: &[T]| {
            let lanes = values.iter().flat_map(|x| (0..T::LANES).map(|lane| x.primal(lane).abs()));
            lanes.fold(0.0, |largest, x| if x <= largest { largest } else { x })
        };
        magnitudes[..n].fill(largest(&y[..n]));
        magnitudes[n..2 * n].fill(largest(&y[n..2 * n]));
        magnitudes[2 * n..].fill(self.energy_scale.max(largest(&y[2 * n..])));
    }
}

/// The works of a run and the energy they explain.
///
/// # Example
/// See [`Lagrangian::work_account`].
///
/// # Source
/// W(5.17).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct WorkAccount {
    /// q at the end.
    pub coordinates: Vec<f64>,
    /// q̇ at the end.
    pub velocities: Vec<f64>,
    /// What entered the system, J.
    pub works: Works,
    /// The change of E + V − q̇·∂V/∂q̇, J.
    pub energy_change: f64,
    /// The larger of |E| + |V| at the start and at the end, J.
    pub energy_scale: f64,
}

impl WorkAccount {
    /// The energy that the works do not explain, relative to the energies met: the error of the run.
    #[must_use]
    pub fn imbalance(&self) -> f64 {
        let scale = self.energy_scale.max(self.works.total().abs());
        if 0.0 < scale { (self.energy_change - self.works.total()).abs() / scale } else { 0.0 }
    }
}

impl<S: Holonomic, P: Potential, F: Forces> Lagrangian<S, P, F> {
    /// The motion together with the works of what drives it, as a field y = (q, q̇, W_applied, W_constraint,
    /// W_time) of 2n + 3 components.
    ///
    /// `energy_scale` (J) is the energy against which the error of the works is relative while they are small: the
    /// kinetic energy expected, say.
    ///
    /// # Errors
    /// [`LagrangianError::NotFinite`] when the scale is not a number.
    ///
    /// # Example
    /// A block of 2 kg is pushed with 6 N for two seconds from rest: 36 J.
    /// ```
    /// # use nalgebra::Vector3;
    /// # use piola_lagrangian::{Forces, Holonomic, Lagrangian, Placement};
    /// # use piola_numerics::Real;
    /// use piola_integrators::{DormandPrince853, State, Tolerance};
    /// struct Block;
    /// impl Holonomic for Block {
    ///     fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
    ///         bodies.particle(2.0, Vector3::new(q[0], T::zero(), T::zero()));
    ///     }
    /// }
    /// struct Push;
    /// impl Forces for Push {
    ///     const GENERALISED: bool = true;
    ///     fn generalised<T: Real>(&self, _q: &[T], _v: &[T], _t: T, q_out: &mut [T]) {
    ///         q_out[0] += T::lit(6.0);
    ///     }
    /// }
    /// let block = Lagrangian::of(Block).with_forces(Push);
    /// let mut field = block.motion_with_work(1, 10.0)?;
    /// let mut state = State::new(0.0, vec![0.0; 5])?;
    /// DormandPrince853::new(Tolerance::relative(1e-12)?).integrate_to(&mut field, &mut state, 2.0)?;
    /// assert!((field.works(&state.values)?.applied - 36.0).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Source
    /// W(5.17).
    pub fn motion_with_work<T: Real>(
        &self,
        coordinates: usize,
        energy_scale: f64,
    ) -> Result<MotionWithWork<'_, S, P, F, T>, LagrangianError> {
        check_finite("energy scale", &[energy_scale])?;
        Ok(MotionWithWork { lagrangian: self, coordinates, energy_scale, work: Workspace::default() })
    }

    /// Integrates the motion from (q, q̇) with its works, and compares them with the change of energy.
    ///
    /// The method is the adaptive one of order eight.
    ///
    /// # Errors
    /// What [`check`](Self::check) refuses; [`LagrangianError::Run`].
    ///
    /// # Example
    /// A mass of 3 kg on a platform that rises with 2 m/s, under 10 m/s²: the platform works with 60 W.
    /// ```
    /// # use nalgebra::Vector3;
    /// # use piola_lagrangian::{Holonomic, Lagrangian, Placement};
    /// # use piola_numerics::Real;
    /// use piola_integrators::Tolerance;
    /// struct Platform;
    /// impl Holonomic for Platform {
    ///     const TIME_DEPENDENT: bool = true;
    ///     fn place<T: Real>(&self, q: &[T], t: T, bodies: &mut impl Placement<T>) {
    ///         bodies.particle(3.0, Vector3::new(q[0], T::zero(), T::lit(2.0) * t));
    ///     }
    /// }
    /// let account = Lagrangian::of(Platform).with_gravity(10.0).work_account(
    ///     &[0.0], &[1.0], 0.0..5.0, Tolerance::relative(1e-12)?,
    /// )?;
    /// assert!((account.works.total() - 300.0).abs() < 1e-9 && account.imbalance() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Source
    /// W(5.17), W(7.9).
    pub fn work_account(
        &self,
        q: &[f64],
        v: &[f64],
        times: Range<f64>,
        tolerance: Tolerance,
    ) -> Result<WorkAccount, LagrangianError> {
        self.check(q, v, times.start)?;
        let n = q.len();
        let (start, scale) = self.energy_and_scale(q, v, times.start)?;
        let stopped = |error: IntegratorsError| LagrangianError::Run {
            time: times.start,
            source: Box::new(error.with_field_error()),
        };
        let values = q.iter().chain(v).chain(&[0.0; 3]).copied().collect();
        let mut state = State::new(times.start, values).map_err(stopped)?;
        let mut field = self.motion_with_work(n, scale)?;
        DormandPrince853::new(tolerance)
            .integrate_to(&mut field, &mut state, times.end)
            .map_err(|error| LagrangianError::Run { time: state.time, source: Box::new(error) })?;
        let works = field.works(&state.values)?;
        let (q, v) = state.values[..2 * n].split_at(n);
        let (end, scale_at_end) = self.energy_and_scale(q, v, times.end)?;
        Ok(WorkAccount {
            coordinates: q.to_vec(),
            velocities: v.to_vec(),
            works,
            energy_change: end - start,
            energy_scale: scale.max(scale_at_end),
        })
    }

    /// E + V − q̇·∂V/∂q̇, and |E| + |V|.
    fn energy_and_scale(&self, q: &[f64], v: &[f64], t: f64) -> Result<(f64, f64), LagrangianError> {
        let energies = self.energies(q, v, t)?;
        let scale = energies.kinetic.abs() + energies.potential.abs();
        if !P::VELOCITY_DEPENDENT {
            return Ok((energies.total(), scale));
        }
        // h = q̇·∂L/∂q̇ − L counts the kinetic energy of the moving constraint otherwise; only V's part is taken of it.
        let stretched: Vec<_> = v.iter().map(|&v| piola_numerics::Dual::new(v, v)).collect();
        let still: Vec<_> = q.iter().map(|&q| piola_numerics::Dual::constant(q)).collect();
        let slope = self.potential.potential(&still, &stretched, piola_numerics::Dual::constant(t)).tangent;
        Ok((energies.total() - slope, scale))
    }
}
