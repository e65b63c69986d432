//! Power: of what is applied, of a moving constraint, of a potential that changes with time; and the balance of
//! energy.
//!
//! ```text
//! dE/dt = P = Q_Δ q̇^Δ + Q_{n+1}                                                            W(5.17)
//! Q_{n+1} = Σ f·∂x/∂t + Σ F·∂ξ/∂t + Σ G·ω_t      f, F, G: external and constraint forces      W(5.15)
//! P = −dV/dt + ∂V/∂t      of a potential V(q, t)                                            W(7.9)
//! ```

use piola_kinematics::Holonomic;
use piola_numerics::{Dual, Gradient, Real};

use super::parts::power;
use super::workspace::Workspace;
use super::{Forces, Lagrangian, Potential};
use crate::LagrangianError;
use crate::check::{check_finite, check_length};

/// Where the power of a motion comes from, W.
///
/// # Example
/// See [`Lagrangian::power_balance`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct PowerBalance<T = f64> {
    /// dE/dt of the parts: Σ m a·v + Σ M a^c·v^c + Σ ω·(I ω̇ + ω×Iω).
    pub kinetic_energy_rate: T,
    /// Of uniform gravity: Σ m g·v.
    pub gravity: T,
    /// Of the potential's generalised forces: Q_Δ q̇^Δ with Q = d/dt(∂V/∂q̇) − ∂V/∂q.
    pub potential: T,
    /// ∂V/∂t at fixed coordinates and velocities: what the time puts into the potential energy.
    pub potential_by_time: T,
    /// Of the applied forces, moments and generalised forces.
    pub applied: T,
    /// Of the moving constraint: Σ f_c·∂x/∂t + Σ F_c·∂ξ/∂t + Σ G_c·ω_t.
    pub moving_constraint: T,
}

impl<T: Real> PowerBalance<T> {
    /// P, W: the power of all that acts. Along the motion it is dE/dt.
    ///
    /// # Source
    /// W(5.17).
    pub fn total(self) -> T {
        self.gravity + self.potential + self.applied + self.moving_constraint
    }

    /// The power that leaves or enters the system, W: of the applied forces, the moving constraint, and the time in
    /// the potential. Along the motion it is d/dt (E + V − q̇·∂V/∂q̇), gravity's energy included.
    ///
    /// # Source
    /// W(5.17), W(7.9).
    pub fn energy_rate(self) -> T {
        self.applied + self.moving_constraint + self.potential_by_time
    }

    /// dE/dt − P, W: zero to rounding along a motion that obeys Lagrange's equations.
    pub fn residual(self) -> T {
        self.kinetic_energy_rate - self.total()
    }
}

/// Q_{n+1}: the component along the time of the generalised force, W.
///
/// # Example
/// See [`Lagrangian::power_balance`].
///
/// # Source
/// W(5.15).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ForceAlongTime<T = f64> {
    /// Of gravity and of the applied forces and moments: Σ f_e·∂x/∂t + …
    pub external: T,
    /// Of the constraint: Σ f_c·∂x/∂t + …
    pub constraint: T,
}

impl<T: Real> ForceAlongTime<T> {
    /// Q_{n+1}, W.
    ///
    /// # Source
    /// W(5.15).
    pub fn total(self) -> T {
        self.external + self.constraint
    }
}

/// The power of what is applied to one part, W.
///
/// # Example
/// See [`Lagrangian::actuator_powers_into`].
///
/// # Source
/// W(5.13).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PartPower<T = f64> {
    /// f·v.
    pub force: T,
    /// G·ω; zero for a particle.
    pub moment: T,
}

impl<S: Holonomic, P: Potential, F: Forces> Lagrangian<S, P, F> {
    /// Where the power comes from, along the motion that Lagrange's equations give.
    ///
    /// ```text
    /// dE/dt = P = Q_Δ q̇^Δ + Q_{n+1}
    /// ```
    ///
    /// The power of the moving constraint is that of everything but weight and forces on parts in the motion
    /// ∂x/∂t of the constraint: what its drive supplies.
    ///
    /// # Errors
    /// As [`acceleration`](Self::acceleration).
    ///
    /// # Accuracy
    /// A few ulp of the largest term, times the condition number of the metric scaled to unit diagonal.
    ///
    /// # Example
    /// A bead of 2 kg slides out on a rod that is turned with 3 rad/s: at 1 m, with 5 m/s along the rod.
    /// ```
    /// # use nalgebra::Vector3;
    /// # use piola_lagrangian::{Holonomic, Lagrangian, Placement, Workspace};
    /// # use piola_numerics::Real;
    /// struct Bead;
    /// impl Holonomic for Bead {
    ///     const TIME_DEPENDENT: bool = true;
    ///     fn place<T: Real>(&self, q: &[T], t: T, bodies: &mut impl Placement<T>) {
    ///         let (s, c) = (T::lit(3.0) * t).sin_cos();
    ///         bodies.particle(2.0, Vector3::new(q[0] * c, q[0] * s, T::zero()));
    ///     }
    /// }
    /// let bead = Lagrangian::of(Bead);
    /// let balance = bead.power_balance(&[1.0], &[5.0], 0.0)?;
    /// // The rod pushes with 2 m Ω ṙ = 60 N across, at Ω r = 3 m/s.
    /// assert_eq!(balance.moving_constraint, 180.0);
    /// assert_eq!((balance.kinetic_energy_rate, balance.total(), balance.energy_rate()), (180.0, 180.0, 180.0));
    /// // Kept from sliding faster, r̈ = 0, it takes up half of them: a brake on it would take the rest.
    /// let even = bead.power_balance_at_acceleration(&mut Workspace::default(), &[1.0], &[5.0], &[0.0], 0.0)?;
    /// assert_eq!((even.kinetic_energy_rate, even.residual()), (90.0, -90.0));
    /// let along_time = bead.force_along_time(&[1.0], &[5.0], 0.0)?;
    /// assert_eq!((along_time.external, along_time.constraint, along_time.total()), (0.0, 180.0, 180.0));
    /// # Ok::<(), piola_lagrangian::LagrangianError>(())
    /// ```
    ///
    /// # Source
    /// W(5.13–5.17), W(7.9).
    pub fn power_balance<T: Real>(&self, q: &[T], v: &[T], t: T) -> Result<PowerBalance<T>, LagrangianError> {
        self.power_balance_with(&mut Workspace::default(), q, v, t)
    }

    /// [`power_balance`](Self::power_balance) without allocation once `work` has been used.
    ///
    /// # Errors
    /// As [`power_balance`](Self::power_balance).
    pub fn power_balance_with<T: Real>(
        &self,
        work: &mut Workspace<T>,
        q: &[T],
        v: &[T],
        t: T,
    ) -> Result<PowerBalance<T>, LagrangianError> {
        self.with_acceleration(work, q, v, t, |work, a| self.power_balance_at_acceleration(work, q, v, a, t))
    }

    /// The balance along any motion, given as (q, q̇, q̈): its [residual](PowerBalance::residual) is the power that
    /// is missing.
    ///
    /// # Errors
    /// [`LagrangianError::WrongLength`], [`LagrangianError::NotFinite`].
    pub fn power_balance_at_acceleration<T: Real>(
        &self,
        work: &mut Workspace<T>,
        q: &[T],
        v: &[T],
        a: &[T],
        t: T,
    ) -> Result<PowerBalance<T>, LagrangianError> {
        let zero = T::zero();
        let mut balance = PowerBalance {
            kinetic_energy_rate: zero,
            gravity: zero,
            potential: zero,
            potential_by_time: zero,
            applied: zero,
            moving_constraint: zero,
        };
        self.tour_with_drift(work, (q, v, a), t, |_part, part| {
            let still = [T::zero(); 3];
            balance.kinetic_energy_rate += power(part.inertia_force, part.velocity, still, still);
            balance.gravity += power(part.weight, part.velocity, still, still);
            balance.applied += power(part.force, part.velocity, still, still);
            if S::TIME_DEPENDENT {
                balance.moving_constraint += power(part.reaction(), part.drift, still, still);
            }
            if let Some(turning) = part.turning {
                let omega = turning.angular_velocity;
                balance.kinetic_energy_rate += power(still, still, turning.inertia_moment, omega);
                balance.applied += power(still, still, turning.moment, omega);
                if S::TIME_DEPENDENT {
                    balance.moving_constraint += power(still, still, turning.reaction(), turning.drift);
                }
            }
        })?;
        if F::GENERALISED {
            balance.applied += self.generalised_power(work, q, v, t);
        }
        if P::PRESENT {
            (balance.potential, balance.potential_by_time) = self.potential_power(work, (q, v, a), t);
        }
        let terms = [balance.kinetic_energy_rate, balance.total(), balance.potential_by_time];
        if let Err(error) = check_finite("power", &terms) {
            self.check_given([("q", q), ("q̇", v)], t)?;
            check_finite("q̈", a)?;
            return Err(error);
        }
        Ok(balance)
    }

    /// Q_Δ q̇^Δ of the forces that are given as generalised ones.
    fn generalised_power<T: Real>(&self, work: &mut Workspace<T>, q: &[T], v: &[T], t: T) -> T {
        work.force.clear();
        work.force.resize(q.len(), T::zero());
        self.forces.generalised(q, v, t, &mut work.force);
        work.force.iter().zip(v).fold(T::zero(), |sum, (&force, &v)| sum + force * v)
    }

    /// (Q_Δ q̇^Δ, ∂V/∂t) of the potential.
    ///
    /// ```text
    /// Q·q̇ = d/dt (q̇·∂V/∂q̇ − V) + ∂V/∂t
    /// ```
    fn potential_power<T: Real>(&self, work: &mut Workspace<T>, (q, v, a): (&[T], &[T], &[T]), t: T) -> (T, T) {
        let still = if P::VELOCITY_DEPENDENT { v } else { &[] };
        work.duals.clear();
        work.duals.extend(q.iter().chain(still).map(|&x| Dual::constant(x)));
        let (coordinates, rates) = work.duals.split_at(q.len());
        let by_time = self.potential.potential(coordinates, rates, Dual::variable(t)).tangent;
        if P::VELOCITY_DEPENDENT {
            // Outside, the motion; inside, the velocities stretched, which gives v ∂/∂v.
            let stretched = |x: T| {
                let mut gradient = Gradient::constant(x);
                gradient.partials[0] = x;
                gradient
            };
            work.mixed.clear();
            work.mixed.extend(q.iter().zip(v).map(|(&q, &v)| Dual::new(Gradient::constant(q), Gradient::constant(v))));
            work.mixed_rates.clear();
            work.mixed_rates.extend(v.iter().zip(a).map(|(&v, &a)| Dual::new(stretched(v), stretched(a))));
            let time = Dual::variable(Gradient::constant(t));
            let rate = self.potential.potential(&work.mixed, &work.mixed_rates, time).tangent;
            (rate.partials[0] - rate.value + by_time, by_time)
        } else {
            work.duals.clear();
            work.duals.extend(q.iter().zip(v).map(|(&q, &v)| Dual::new(q, v)));
            (-self.potential.potential(&work.duals, &[], Dual::constant(t)).tangent, by_time)
        }
    }

    /// Q_{n+1}, the component along the time of the generalised force, W; zero without time dependence.
    ///
    /// ```text
    /// Q_{n+1} = Σ f·∂x/∂t + Σ F·∂ξ/∂t + Σ G·ω_t
    /// ```
    ///
    /// External and constraint forces both enter: the constraint has no power in virtual displacements, but it
    /// moves.
    ///
    /// # Errors
    /// As [`acceleration`](Self::acceleration).
    ///
    /// # Source
    /// W(5.15).
    pub fn force_along_time<T: Real>(&self, q: &[T], v: &[T], t: T) -> Result<ForceAlongTime<T>, LagrangianError> {
        let mut force = ForceAlongTime { external: T::zero(), constraint: T::zero() };
        if !S::TIME_DEPENDENT {
            check_length("q̇", q.len(), v.len())?;
            return Ok(force);
        }
        let work = &mut Workspace::default();
        self.with_acceleration(work, q, v, t, |work, a| {
            self.tour_with_drift(work, (q, v, a), t, |_part, part| {
                let still = [T::zero(); 3];
                let external = core::array::from_fn(|k| part.weight[k] + part.force[k]);
                force.external += power(external, part.drift, still, still);
                force.constraint += power(part.reaction(), part.drift, still, still);
                if let Some(turning) = part.turning {
                    force.external += power(still, still, turning.moment, turning.drift);
                    force.constraint += power(still, still, turning.reaction(), turning.drift);
                }
            })
        })?;
        self.finite([("q", q), ("q̇", v)], t, ("force along time", &[force.external, force.constraint]))?;
        Ok(force)
    }

    /// The power of every applied force and moment, and of the generalised force along every coordinate: of each
    /// actuator by itself.
    ///
    /// | symbol | argument | shape | unit |
    /// |---|---|---|---|
    /// | f·v, G·ω | `parts` | one for each part | W |
    /// | Q_Δ q̇^Δ, not summed | `coordinates` | n | W |
    ///
    /// Gravity and the potential are not among them. No accelerations are computed, and nothing is allocated once
    /// `work` has been used.
    ///
    /// # Errors
    /// [`LagrangianError::WrongLength`], [`LagrangianError::NotFinite`].
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Vector3;
    /// # use piola_lagrangian::{Forces, Holonomic, Lagrangian, PartPower, Placement, Workspace};
    /// # use piola_numerics::Real;
    /// struct Cart;
    /// impl Holonomic for Cart {
    ///     fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
    ///         bodies.particle(1.0, Vector3::new(q[0], T::zero(), T::zero()));
    ///     }
    /// }
    /// struct MotorAndDrag; // 7 N along q, 2 N s/m against the motion
    /// impl Forces for MotorAndDrag {
    ///     const GENERALISED: bool = true;
    ///     const ON_PARTS: bool = true;
    ///     fn generalised<T: Real>(&self, _q: &[T], _v: &[T], _t: T, q_out: &mut [T]) {
    ///         q_out[0] += T::lit(7.0);
    ///     }
    ///     fn on_part<T: Real>(&self, _part: usize, _x: [T; 3], velocity: [T; 3], _t: T) -> [T; 3] {
    ///         velocity.map(|v| T::lit(-2.0) * v)
    ///     }
    /// }
    /// let (mut parts, mut coordinates) = ([PartPower::default()], [0.0]);
    /// let cart = Lagrangian::of(Cart).with_forces(MotorAndDrag);
    /// cart.actuator_powers_into(&mut Workspace::default(), &[0.0], &[3.0], 0.0, &mut parts, &mut coordinates)?;
    /// assert_eq!((parts[0].force, coordinates[0]), (-18.0, 21.0));
    /// # Ok::<(), piola_lagrangian::LagrangianError>(())
    /// ```
    ///
    /// # Source
    /// W(5.13).
    pub fn actuator_powers_into<T: Real>(
        &self,
        work: &mut Workspace<T>,
        q: &[T],
        v: &[T],
        t: T,
        parts: &mut [PartPower<T>],
        coordinates: &mut [T],
    ) -> Result<(), LagrangianError> {
        check_length("powers of the coordinates", q.len(), coordinates.len())?;
        let mut places = parts.iter_mut();
        // Powers of applied forces need no accelerations: any will do.
        let placed = self.tour(work, (q, v, v), t, |_part, part| {
            if let Some(place) = places.next() {
                let still = [T::zero(); 3];
                place.force = power(part.force, part.velocity, still, still);
                place.moment = match part.turning {
                    Some(turning) => power(still, still, turning.moment, turning.angular_velocity),
                    None => T::zero(),
                };
            }
        })?;
        check_length("powers of the parts", placed, parts.len())?;
        coordinates.fill(T::zero());
        if F::GENERALISED {
            self.forces.generalised(q, v, t, coordinates);
        }
        for (power, &v) in coordinates.iter_mut().zip(v) {
            *power *= v;
        }
        let state = [("q", q), ("q̇", v)];
        for power in &*parts {
            self.finite(state, t, ("powers of the parts", &[power.force, power.moment]))?;
        }
        self.finite(state, t, ("powers of the coordinates", coordinates))
    }
}
