//! Energies, momenta and the Jacobi integral.

use nalgebra::DVector;
use piola_kinematics::Holonomic;
use piola_numerics::{Dual, Gradient, Jet, Real};

use super::collect::{AppliedSums, EnergySums};
use super::directions::{CHUNK, with_directions};
use super::workspace::Workspace;
use super::{Forces, Lagrangian, NoForces, NoPotential, Potential};
use crate::LagrangianError;
use crate::check::check_length;

/// The energies of a state, J.
///
/// # Example
/// See [`Lagrangian::energies`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Energies<T = f64> {
    /// E.
    pub kinetic: T,
    /// V, of gravity and of the potential; velocity-dependent parts included.
    pub potential: T,
}

impl<T: Real> Energies<T> {
    /// E + V.
    pub fn total(self) -> T {
        self.kinetic + self.potential
    }
    /// L = E − V.
    pub fn lagrangian(self) -> T {
        self.kinetic - self.potential
    }
}

/// The parts of E = ½ g q̇ q̇ + b·q̇ + E₀ of a time-dependent placement.
///
/// # Example
/// See [`Lagrangian::energies`].
#[derive(Clone, Debug, PartialEq)]
pub struct KineticEnergyParts<T: Real = f64> {
    /// b_Δ = Σ m ∂x/∂t·∂x/∂q^Δ + …: zero without time dependence.
    pub linear: DVector<T>,
    /// E₀ = ½ Σ m |∂x/∂t|² + …: zero without time dependence.
    pub constant: T,
}

/// Which arguments of L carry the directions of differentiation.
#[derive(Clone, Copy)]
pub(super) enum With {
    Coordinates,
    Velocities,
}

impl<S: Holonomic, P: Potential, F: Forces> Lagrangian<S, P, F> {
    /// The kinetic and the potential energy of a state.
    ///
    /// # Errors
    /// [`LagrangianError::WrongLength`], [`LagrangianError::NotFinite`].
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Vector3;
    /// # use piola_lagrangian::{Holonomic, Lagrangian, Placement};
    /// # use piola_numerics::Real;
    /// struct Lift; // 2 kg; q is the height above a floor that rises with 3 m/s
    /// impl Holonomic for Lift {
    ///     const TIME_DEPENDENT: bool = true;
    ///     fn place<T: Real>(&self, q: &[T], t: T, bodies: &mut impl Placement<T>) {
    ///         bodies.particle(2.0, Vector3::new(T::zero(), T::zero(), q[0] + T::lit(3.0) * t));
    ///     }
    /// }
    /// let (lift, q, v) = (Lagrangian::of(Lift).with_gravity(10.0), [5.0], [1.0]);
    /// let energies = lift.energies(&q, &v, 0.0)?;
    /// assert_eq!((energies.kinetic, energies.potential), (16.0, 100.0)); // ½·2 (q̇ + 3)² = q̇² + 6 q̇ + 9
    /// assert_eq!((energies.total(), energies.lagrangian()), (116.0, -84.0)); // E + V and E − V
    /// let parts = lift.kinetic_energy_parts(&q, 0.0);
    /// assert_eq!((parts.linear[0], parts.constant), (6.0, 9.0));
    /// assert_eq!(lift.jacobi_integral(&q, &v, 0.0)?, 92.0); // q̇² − 9 + V, which is not E + V
    /// assert_eq!(lift.time_derivative(&q, &v, 0.0)?, -60.0); // ∂L/∂t: it is lifted with 3 m/s against 20 N
    /// # Ok::<(), piola_lagrangian::LagrangianError>(())
    /// ```
    ///
    /// # Source
    /// W(3.16), W(7.22).
    pub fn energies<T: Real>(&self, q: &[T], v: &[T], t: T) -> Result<Energies<T>, LagrangianError> {
        self.energies_with(&mut Workspace::default(), q, v, t)
    }

    /// [`energies`](Self::energies) without allocation once `work` has been used.
    ///
    /// # Errors
    /// As [`energies`](Self::energies).
    pub fn energies_with<T: Real>(
        &self,
        work: &mut Workspace<T>,
        q: &[T],
        v: &[T],
        t: T,
    ) -> Result<Energies<T>, LagrangianError> {
        check_length("q̇", q.len(), v.len())?;
        work.duals.clear();
        work.duals.extend(q.iter().zip(v).map(|(&q, &v)| Dual::new(q, v)));
        let energies = self.energies_over(&work.duals, q, v, t);
        self.finite([("q", q), ("q̇", v)], t, ("energies", &[energies.kinetic, energies.potential]))?;
        Ok(energies)
    }

    /// The energies from coordinates that carry their rates.
    fn energies_over<T: Real>(&self, moving: &[Dual<T>], q: &[T], v: &[T], t: T) -> Energies<T> {
        let time = if S::TIME_DEPENDENT { Dual::variable(t) } else { Dual::constant(t) };
        let mut sums = EnergySums::new(self.gravity);
        self.system.place(moving, time, &mut sums);
        let mut potential = sums.gravitational;
        if P::PRESENT {
            potential += self.potential.potential(q, if P::VELOCITY_DEPENDENT { v } else { &[] }, t);
        }
        Energies { kinetic: sums.kinetic, potential }
    }

    /// The linear and constant parts of the kinetic energy in the velocities; the quadratic part is the
    /// inertia metric.
    ///
    /// # Source
    /// W(3.32).
    pub fn kinetic_energy_parts<T: Real>(&self, q: &[T], t: T) -> KineticEnergyParts<T> {
        let n = q.len();
        let mut linear = DVector::from_element(n, T::zero());
        let zeros = vec![T::zero(); n];
        if !S::TIME_DEPENDENT {
            return KineticEnergyParts { linear, constant: T::zero() };
        }
        let mut work = Workspace::default();
        let bare = self.without_actions();
        bare.differentiate(&mut work, q, &zeros, t, With::Velocities, linear.as_mut_slice());
        let moving: Vec<Dual<T>> = q.iter().map(|&q| Dual::constant(q)).collect();
        KineticEnergyParts { linear, constant: bare.energies_over(&moving, q, &zeros, t).kinetic }
    }

    /// The same placement with nothing acting on it.
    pub(super) fn without_actions(&self) -> Lagrangian<&S, NoPotential, NoForces> {
        Lagrangian { system: &self.system, gravity: [0.0; 3], potential: NoPotential, forces: NoForces }
    }

    /// The generalised momenta p_Δ = ∂L/∂q̇^Δ.
    ///
    /// # Errors
    /// [`LagrangianError::WrongLength`], [`LagrangianError::NotFinite`].
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Vector3;
    /// # use piola_lagrangian::{Holonomic, Lagrangian, Placement};
    /// # use piola_numerics::Real;
    /// struct Polar; // q = [r, φ], 4 kg
    /// impl Holonomic for Polar {
    ///     fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
    ///         let (s, c) = q[1].sin_cos();
    ///         bodies.particle(4.0, Vector3::new(q[0] * c, q[0] * s, T::zero()));
    ///     }
    /// }
    /// // m ṙ and m r² φ̇, at r = 2 with 3 m/s and 0.5 rad/s.
    /// let (polar, q, v) = (Lagrangian::of(Polar), [2.0, 0.0], [3.0, 0.5]);
    /// assert_eq!(polar.momenta(&q, &v, 0.0)?.as_slice(), [12.0, 8.0]);
    /// assert_eq!(polar.coordinate_gradient(&q, &v, 0.0)?.as_slice(), [2.0, 0.0]); // m r φ̇²: the centrifugal force
    /// # Ok::<(), piola_lagrangian::LagrangianError>(())
    /// ```
    ///
    /// # Source
    /// W(9.3).
    pub fn momenta<T: Real>(&self, q: &[T], v: &[T], t: T) -> Result<DVector<T>, LagrangianError> {
        let mut out = DVector::from_element(q.len(), T::zero());
        self.momenta_into(&mut Workspace::default(), q, v, t, out.as_mut_slice())?;
        Ok(out)
    }

    /// [`momenta`](Self::momenta) without allocation once `work` has been used.
    ///
    /// # Errors
    /// As [`momenta`](Self::momenta).
    pub fn momenta_into<T: Real>(
        &self,
        work: &mut Workspace<T>,
        q: &[T],
        v: &[T],
        t: T,
        out: &mut [T],
    ) -> Result<(), LagrangianError> {
        check_length("q̇", q.len(), v.len())?;
        check_length("p", q.len(), out.len())?;
        self.differentiate(work, q, v, t, With::Velocities, out);
        self.finite([("q", q), ("q̇", v)], t, ("p", out))
    }

    /// ∂L/∂q at fixed velocities.
    ///
    /// # Errors
    /// [`LagrangianError::WrongLength`], [`LagrangianError::NotFinite`].
    ///
    /// # Source
    /// W(7.3).
    pub fn coordinate_gradient<T: Real>(&self, q: &[T], v: &[T], t: T) -> Result<DVector<T>, LagrangianError> {
        check_length("q̇", q.len(), v.len())?;
        let mut out = DVector::from_element(q.len(), T::zero());
        self.differentiate(&mut Workspace::default(), q, v, t, With::Coordinates, out.as_mut_slice());
        self.finite([("q", q), ("q̇", v)], t, ("∂L/∂q", out.as_slice()))?;
        Ok(out)
    }

    /// ∂L/∂t at fixed coordinates and velocities, J/s.
    ///
    /// # Errors
    /// [`LagrangianError::WrongLength`], [`LagrangianError::NotFinite`].
    ///
    /// # Source
    /// W(7.20).
    pub fn time_derivative<T: Real>(&self, q: &[T], v: &[T], t: T) -> Result<T, LagrangianError> {
        let constants = |x: &[T]| x.iter().map(|&x| Dual::constant(x)).collect::<Vec<_>>();
        Ok(self.energies(&constants(q), &constants(v), Dual::variable(t))?.lagrangian().tangent)
    }

    /// The Jacobi integral h = q̇·∂L/∂q̇ − L, J: kept when neither L depends on time nor anything is applied.
    /// It is E + V when the placement does not depend on time and the potential not on velocities.
    ///
    /// # Errors
    /// [`LagrangianError::WrongLength`], [`LagrangianError::NotFinite`].
    ///
    /// # Source
    /// W(7.19–7.22).
    pub fn jacobi_integral<T: Real>(&self, q: &[T], v: &[T], t: T) -> Result<T, LagrangianError> {
        let mut h = -self.energies(q, v, t)?.lagrangian();
        for (&p, &v) in self.momenta(q, v, t)?.iter().zip(v) {
            h += p * v;
        }
        Ok(h)
    }

    /// The generalised forces Q_Δ of the applied forces alone: not of gravity, nor of the potential.
    ///
    /// # Errors
    /// [`LagrangianError::WrongLength`], [`LagrangianError::NotFinite`].
    ///
    /// # Source
    /// W(5.9).
    pub fn generalised_forces<T: Real>(&self, q: &[T], v: &[T], t: T) -> Result<DVector<T>, LagrangianError> {
        let mut out = DVector::from_element(q.len(), T::zero());
        self.add_generalised_forces(&mut Workspace::default(), q, v, t, out.as_mut_slice())?;
        self.finite([("q", q), ("q̇", v)], t, ("Q", out.as_slice()))?;
        Ok(out)
    }

    /// Adds the generalised forces to `out`, without allocation once `work` has been used.
    pub(super) fn add_generalised_forces<T: Real>(
        &self,
        work: &mut Workspace<T>,
        q: &[T],
        v: &[T],
        t: T,
        out: &mut [T],
    ) -> Result<(), LagrangianError> {
        let n = q.len();
        check_length("q̇", n, v.len())?;
        if F::ON_PARTS || F::MOMENTS {
            let time = if S::TIME_DEPENDENT { Jet::time(t) } else { Jet::constant(t) };
            for first in (0..n).step_by(CHUNK) {
                let jet = |(i, (&q, &v)): (usize, (&T, &T))| Jet::coordinate(q, v, i.wrapping_sub(first));
                work.jets.clear();
                work.jets.extend(q.iter().zip(v).enumerate().map(jet));
                let mut sums = AppliedSums { forces: &self.forces, generalised: [T::zero(); CHUNK], t, part: 0 };
                self.system.place(&work.jets, time, &mut sums);
                for (out, sum) in out[first..].iter_mut().zip(sums.generalised) {
                    *out += sum;
                }
            }
        }
        if F::GENERALISED {
            self.forces.generalised(q, v, t, out);
        }
        Ok(())
    }

    /// The derivatives of L with respect to the coordinates or the velocities.
    pub(super) fn differentiate<T: Real>(
        &self,
        work: &mut Workspace<T>,
        q: &[T],
        v: &[T],
        t: T,
        with: With,
        out: &mut [T],
    ) {
        with_directions!(q.len(), N => self.differentiate_in_one_pass::<T, N>(q, v, t, with, out), beyond =>
            for first in (0..q.len()).step_by(CHUNK) {
                let seed = |on: bool, (i, &x): (usize, &T)| {
                    if on { Gradient::variable(x, i.wrapping_sub(first)) } else { Gradient::constant(x) }
                };
                let (on_q, on_v) = (matches!(with, With::Coordinates), matches!(with, With::Velocities));
                work.coordinates.clear();
                work.coordinates.extend(q.iter().enumerate().map(|x| seed(on_q, x)));
                work.constants.clear();
                work.constants.extend(v.iter().enumerate().map(|x| seed(on_v, x)));
                work.mixed.clear();
                work.mixed.extend(work.coordinates.iter().zip(&work.constants).map(|(&q, &v)| Dual::new(q, v)));
                let time = Gradient::constant(t);
                let energies = self.energies_over(&work.mixed, &work.coordinates, &work.constants, time);
                for (out, partial) in out[first..].iter_mut().zip(energies.lagrangian().partials) {
                    *out = partial;
                }
            }
        );
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn differentiate_in_one_pass<T: Real, const N: usize>(&self, q: &[T], v: &[T], t: T, with: With, out: &mut [T]) {
        let n = q.len();
        let zero = Gradient::<T, N>::constant(T::zero());
        let (mut coordinates, mut rates) = ([zero; N], [zero; N]);
        let mut moving = [Dual::constant(zero); N];
        for i in 0..n {
            (coordinates[i], rates[i]) = match with {
                With::Coordinates => (Gradient::variable(q[i], i), Gradient::constant(v[i])),
                With::Velocities => (Gradient::constant(q[i]), Gradient::variable(v[i], i)),
            };
            moving[i] = Dual::new(coordinates[i], rates[i]);
        }
        let energies = self.energies_over(&moving[..n], &coordinates[..n], &rates[..n], Gradient::constant(t));
        out.copy_from_slice(&energies.lagrangian().partials[..n]);
    }
}
