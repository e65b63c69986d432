//! The same system in other coordinates.
//!
//! ```text
//! q^Δ = c^Δ(q̄, t)
//! q̇ = (∂c/∂q̄) q̄̇ + ∂c/∂t        ḡ_ΔΓ = g_ΘΣ ∂q^Θ/∂q̄^Δ ∂q^Σ/∂q̄^Γ                            W(3.17–3.22)
//! Q̄_Δ = Q_Γ ∂q^Γ/∂q̄^Δ                                                                     W(5.12)
//! ```
//!
//! Placement, potential and forces are all seen through the change; nothing else has to be rewritten. With fewer
//! new coordinates than old ones the change is one more holonomic constraint.

use piola_kinematics::{Holonomic, Placement};
use piola_numerics::{Dual, Jet, Real};

use super::{Forces, Lagrangian, Potential};

/// A smooth change of coordinates q = c(q̄, t) to N old coordinates, written once for any scalar.
///
/// # Example
/// The angles of a double pendulum from the vertical, in terms of the first and the angle at the joint:
/// ```
/// use piola_lagrangian::ChangeOfCoordinates;
/// use piola_numerics::Real;
/// struct Relative;
/// impl ChangeOfCoordinates<2> for Relative {
///     fn old_coordinates<T: Real>(&self, new: &[T], _t: T) -> [T; 2] {
///         [new[0], new[0] + new[1]]
///     }
/// }
/// assert_eq!(Relative.old_coordinates(&[1.0, 0.5], 0.0), [1.0, 1.5]);
/// let moving = Relative.old_motion(&[1.0, 0.5], &[2.0, 3.0], &[4.0, 5.0], 0.0);
/// assert_eq!(moving.map(|q| (q.rate, q.second_rate)), [(2.0, 4.0), (5.0, 9.0)]); // q̇ and q̈
/// ```
pub trait ChangeOfCoordinates<const N: usize> {
    /// Whether c depends on time: then also the system in the new coordinates does.
    const TIME_DEPENDENT: bool = false;

    /// q = c(q̄, t).
    fn old_coordinates<T: Real>(&self, new: &[T], t: T) -> [T; N];

    /// The motion in old coordinates: q, q̇ and q̈ as value, rate and second rate of each.
    ///
    /// ```text
    /// q̈ = (∂c/∂q̄) q̄̈ + ∂²c/∂q̄∂q̄ q̄̇ q̄̇ + 2 ∂²c/∂q̄∂t q̄̇ + ∂²c/∂t²
    /// ```
    ///
    /// Slices longer than N, or than the shortest, are cut: a change has at most N new coordinates.
    ///
    /// # Accuracy
    /// Derivatives are exact to rounding.
    ///
    /// # Source
    /// W(3.19–3.20), differentiated.
    fn old_motion<T: Real>(&self, new: &[T], rates: &[T], second_rates: &[T], t: T) -> [Jet<T, 0>; N] {
        let mut moving = [Jet::constant(T::zero()); N];
        let mut length = 0;
        for (((jet, &value), &rate), &second_rate) in moving.iter_mut().zip(new).zip(rates).zip(second_rates) {
            *jet = Jet { value, partials: [], rate, second_rate };
            length += 1;
        }
        let time = if Self::TIME_DEPENDENT { Jet::time(t) } else { Jet::constant(t) };
        self.old_coordinates(&moving[..length], time)
    }

    /// ∂q^Γ/∂q̄^Δ at fixed time, for all Γ.
    ///
    /// # Source
    /// W(3.20).
    fn tangent<T: Real>(&self, new: &[T], t: T, direction: usize) -> [T; N] {
        let mut seeds = [Dual::constant(T::zero()); N];
        for (i, (seed, &x)) in seeds.iter_mut().zip(new).enumerate() {
            *seed = if i == direction { Dual::variable(x) } else { Dual::constant(x) };
        }
        self.old_coordinates(&seeds[..new.len().min(N)], Dual::constant(t)).map(|q| q.tangent)
    }
}

impl<C: ChangeOfCoordinates<N>, const N: usize> ChangeOfCoordinates<N> for &C {
    const TIME_DEPENDENT: bool = C::TIME_DEPENDENT;
    fn old_coordinates<T: Real>(&self, new: &[T], t: T) -> [T; N] {
        (**self).old_coordinates(new, t)
    }
}

/// A placement, a potential or forces, known in N old coordinates, in new ones.
///
/// # Example
/// The inertia metric is a covariant tensor: a mass of 4 kg in Cartesian coordinates, seen in polar ones.
/// ```
/// use nalgebra::Vector3;
/// use piola_lagrangian::{ChangeOfCoordinates, Holonomic, InCoordinates, Lagrangian, Placement};
/// use piola_numerics::Real;
/// struct Cartesian;
/// impl Holonomic for Cartesian {
///     fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
///         bodies.particle(4.0, Vector3::new(q[0], q[1], T::zero()));
///     }
/// }
/// #[derive(Clone)]
/// struct Polar; // q̄ = [r, φ]
/// impl ChangeOfCoordinates<2> for Polar {
///     fn old_coordinates<T: Real>(&self, new: &[T], _t: T) -> [T; 2] {
///         let (s, c) = new[1].sin_cos();
///         [new[0] * c, new[0] * s]
///     }
/// }
/// let seen = InCoordinates::new(Cartesian, Polar);
/// assert_eq!(seen.change().old_coordinates(&[3.0, 0.0], 0.0), [3.0, 0.0]);
/// let metric = Lagrangian::of(seen).inertia_metric(&[3.0, 0.0], 0.0)?;
/// assert_eq!((metric[(0, 0)], metric[(0, 1)], metric[(1, 1)]), (4.0, 0.0, 36.0));
/// assert_eq!(Polar.tangent(&[3.0, 0.0], 0.0, 1), [0.0, 3.0]); // ∂x/∂φ, ∂y/∂φ
/// let whole = Lagrangian::of(Cartesian).in_coordinates(Polar); // with what acts on it
/// assert_eq!(whole.acceleration(&[3.0, 0.0], &[0.0, 2.0], 0.0)?[0], 12.0); // r̈ = r φ̇²
/// # Ok::<(), piola_lagrangian::LagrangianError>(())
/// ```
///
/// # Source
/// W(3.17–3.22), W(5.11–5.12).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InCoordinates<S, C, const N: usize> {
    old: S,
    change: C,
}

impl<S, C: ChangeOfCoordinates<N>, const N: usize> InCoordinates<S, C, N> {
    /// The thing `old` seen through the change.
    pub const fn new(old: S, change: C) -> Self {
        Self { old, change }
    }

    /// What is seen.
    pub const fn old(&self) -> &S {
        &self.old
    }

    /// The change.
    pub const fn change(&self) -> &C {
        &self.change
    }

    /// The velocities in the old coordinates.
    fn old_velocities<T: Real>(&self, q: &[T], v: &[T], t: T) -> [T; N] {
        let mut moving = [Dual::constant(T::zero()); N];
        for ((dual, &q), &v) in moving.iter_mut().zip(q).zip(v) {
            *dual = Dual::new(q, v);
        }
        let time = if C::TIME_DEPENDENT { Dual::variable(t) } else { Dual::constant(t) };
        self.change.old_coordinates(&moving[..q.len().min(N)], time).map(|q| q.tangent)
    }
}

impl<S: Holonomic, C: ChangeOfCoordinates<N>, const N: usize> Holonomic for InCoordinates<S, C, N> {
    const TIME_DEPENDENT: bool = S::TIME_DEPENDENT || C::TIME_DEPENDENT;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn place<T: Real>(&self, q: &[T], t: T, bodies: &mut impl Placement<T>) {
        self.old.place(&self.change.old_coordinates(q, t), t, bodies);
    }
}

impl<P: Potential, C: ChangeOfCoordinates<N>, const N: usize> Potential for InCoordinates<P, C, N> {
    const VELOCITY_DEPENDENT: bool = P::VELOCITY_DEPENDENT;
    const LINEAR_IN_VELOCITIES: bool = P::LINEAR_IN_VELOCITIES;
    const PRESENT: bool = P::PRESENT;
    fn potential<T: Real>(&self, q: &[T], v: &[T], t: T) -> T {
        let old = self.change.old_coordinates(q, t);
        if P::VELOCITY_DEPENDENT {
            self.old.potential(&old, &self.old_velocities(q, v, t), t)
        } else {
            self.old.potential(&old, &[], t)
        }
    }
}

impl<F: Forces, C: ChangeOfCoordinates<N>, const N: usize> Forces for InCoordinates<F, C, N> {
    const GENERALISED: bool = F::GENERALISED;
    const ON_PARTS: bool = F::ON_PARTS;
    const MOMENTS: bool = F::MOMENTS;

    fn generalised<T: Real>(&self, q: &[T], v: &[T], t: T, q_out: &mut [T]) {
        let mut force = [T::zero(); N];
        let old = self.change.old_coordinates(q, t);
        self.old.generalised(&old, &self.old_velocities(q, v, t), t, &mut force);
        for (direction, out) in q_out.iter_mut().enumerate().take(N) {
            for (&force, slope) in force.iter().zip(self.change.tangent(q, t, direction)) {
                *out += force * slope;
            }
        }
    }
    fn on_part<T: Real>(&self, part: usize, position: [T; 3], velocity: [T; 3], t: T) -> [T; 3] {
        self.old.on_part(part, position, velocity, t)
    }
    fn moment_on_body<T: Real>(
        &self,
        part: usize,
        attitude: piola_kinematics::Attitude<T>,
        angular_velocity: [T; 3],
        t: T,
    ) -> [T; 3] {
        self.old.moment_on_body(part, attitude, angular_velocity, t)
    }
}

impl<S: Holonomic, P: Potential, F: Forces> Lagrangian<S, P, F> {
    /// The same system with all that acts on it, in new coordinates q̄ with q = c(q̄, t).
    ///
    /// # Source
    /// W(3.17–3.22), W(5.11–5.12).
    pub fn in_coordinates<C: ChangeOfCoordinates<N> + Clone, const N: usize>(
        self,
        change: C,
    ) -> Lagrangian<InCoordinates<S, C, N>, InCoordinates<P, C, N>, InCoordinates<F, C, N>> {
        Lagrangian {
            system: InCoordinates::new(self.system, change.clone()),
            gravity: self.gravity,
            potential: InCoordinates::new(self.potential, change.clone()),
            forces: InCoordinates::new(self.forces, change),
        }
    }
}
