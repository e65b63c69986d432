//! Holonomic constraints in implicit form, φ(q, t) = 0, with multipliers.
//!
//! ```text
//! M q̈ + Gᵀ λ = f        G q̈ = −γ        G = ∂φ/∂q,   γ = d²φ/dt² at q̈ = 0
//! ```
//!
//! A closed loop of links is most easily described by too many coordinates and by what ties them together. M and
//! f are those of [`Lagrangian::equations_into`]; G and γ follow from the constraints by exact differentiation
//! in one pass. The reactions of the constraints on the coordinates are −Gᵀλ: they do no virtual work.
//!
//! | to get | call |
//! |---|---|
//! | q̈, λ, −Gᵀλ | [`Constrained::acceleration`], [`Constrained::multipliers`], [`Constrained::reactions`] |
//! | the force that holds each part | [`Constrained::part_reactions`] |
//! | a state that satisfies the constraints, near a guess | [`Constrained::assemble`] |
//! | the degrees of freedom; constraints that depend on others | [`Constrained::degrees_of_freedom`], [`Constrained::dependencies`] |
//! | the motion in time, accurately | [`Constrained::integrate`], or a field for any integrator: [`Constrained::motion`] |
//! | the motion over a long time, symplectically | [`Rattle`] |
//!
//! Constraints that depend on each other, as those of Bricard's loops, are found by a rank-revealing
//! factorisation in the inertia metric: accelerations are unique all the same, of the multipliers the smallest
//! are given. Constraints that contradict each other are refused by name.

mod acceleration;
mod assembly;
mod branch;
mod evaluation;
mod interpolation;
mod motion;
mod rattle;
mod redundancy;
mod workspace;

pub use assembly::Assembly;
pub use motion::ConstrainedMotion;
pub use rattle::Rattle;
pub use redundancy::Dependency;
pub use workspace::Workspace;

use piola_numerics::Real;

use crate::Lagrangian;

/// Conditions φ(q, t) = 0 on the coordinates, written once for any scalar.
///
/// # Example
/// ```
/// use piola_lagrangian::constraints::Constraints;
/// use piola_numerics::Real;
/// /// A particle on a circle: |x|² = r².
/// struct Circle { radius: f64 }
/// impl Constraints for Circle {
///     fn count(&self) -> usize {
///         1
///     }
///     fn residuals<T: Real>(&self, q: &[T], _t: T, out: &mut [T]) {
///         out[0] = q[0] * q[0] + q[1] * q[1] - T::lit(self.radius * self.radius);
///     }
/// }
/// let mut residual = [0.0];
/// Circle { radius: 5.0 }.residuals(&[3.0, 4.0], 0.0, &mut residual);
/// assert_eq!(residual, [0.0]);
/// ```
pub trait Constraints {
    /// Whether φ depends on time explicitly. Constraints that say no are never differentiated by it.
    const TIME_DEPENDENT: bool = false;
    /// The number of conditions.
    fn count(&self) -> usize;
    /// Writes φ(q, t), in units of your choice, to `out`, which has [`count`](Self::count) places.
    fn residuals<T: Real>(&self, q: &[T], t: T, out: &mut [T]);
    /// What a condition is called in errors and reports; nothing by default.
    fn name(&self, _constraint: usize) -> Option<&str> {
        None
    }
}

impl<C: Constraints> Constraints for &C {
    const TIME_DEPENDENT: bool = C::TIME_DEPENDENT;
    fn count(&self) -> usize {
        (**self).count()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn residuals<T: Real>(&self, q: &[T], t: T, out: &mut [T]) {
        (**self).residuals(q, t, out);
    }
    fn name(&self, constraint: usize) -> Option<&str> {
        (**self).name(constraint)
    }
}

/// What is done about constraints that depend on others.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Redundancy {
    /// They are left out where accelerations are found; the multipliers are the smallest ones.
    #[default]
    Handled,
    /// They are an error, [`ConstraintError::Redundant`](crate::ConstraintError::Redundant).
    Refused,
}

/// A Lagrangian system with constraints: see the [module](self).
///
/// # Example
/// A particle of 2 kg on a circle of 5 m under 10 m/s², let go on a level with the centre: it falls freely, and
/// nothing holds it.
/// ```
/// use nalgebra::Vector3;
/// use piola_lagrangian::constraints::Constraints;
/// use piola_lagrangian::{Holonomic, Lagrangian, Placement};
/// use piola_numerics::Real;
/// struct Bead; // q = [x, z]
/// impl Holonomic for Bead {
///     fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
///         bodies.particle(2.0, Vector3::new(q[0], T::zero(), q[1]));
///     }
/// }
/// struct Circle;
/// impl Constraints for Circle {
///     fn count(&self) -> usize {
///         1
///     }
///     fn residuals<T: Real>(&self, q: &[T], _t: T, out: &mut [T]) {
///         out[0] = (q[0] * q[0] + q[1] * q[1] - T::lit(25.0)) / T::lit(10.0);
///     }
/// }
/// let bead = Lagrangian::of(Bead).with_gravity(10.0).with_constraints(Circle);
/// let falling = bead.acceleration(&[5.0, 0.0], &[0.0, 0.0], 0.0)?;
/// assert!(falling[0].abs() < 1e-14 && (falling[1] + 10.0).abs() < 1e-14);
/// // At the bottom, with 5 m/s: ẍ = 0, z̈ = v²/r = 5 m/s²; the circle carries 2 kg (10 + 5) m/s² = 30 N.
/// let (bottom, v) = ([0.0, -5.0], [5.0, 0.0]);
/// let reactions = bead.reactions(&bottom, &v, 0.0)?;
/// assert!((reactions[1] - 30.0).abs() < 1e-14 && reactions[0].abs() < 1e-14);
/// assert_eq!(bead.degrees_of_freedom(&bottom, 0.0)?, 1);
/// # Ok::<(), piola_lagrangian::LagrangianError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Constrained<S, P, F, C> {
    lagrangian: Lagrangian<S, P, F>,
    constraints: C,
    redundancy: Redundancy,
    least_share: f64,
}

/// The part of a constraint's gradient, in the inertia metric, that must be its own.
///
/// Far above rounding, since loops are only redundant where they are closed; far below what a mechanism shows
/// outside of singular positions.
const LEAST_SHARE: f64 = 1e-7;

impl<S, P, F> Lagrangian<S, P, F> {
    /// The system with constraints φ(q, t) = 0.
    pub fn with_constraints<C: Constraints>(self, constraints: C) -> Constrained<S, P, F, C> {
        Constrained { lagrangian: self, constraints, redundancy: Redundancy::Handled, least_share: LEAST_SHARE }
    }
}

impl<S, P, F, C> Constrained<S, P, F, C> {
    /// What is done about constraints that depend on others.
    #[must_use]
    pub fn with_redundancy(mut self, redundancy: Redundancy) -> Self {
        self.redundancy = redundancy;
        self
    }
    /// A constraint depends on others where less than this part of its gradient, in the inertia metric, is its
    /// own; 10⁻⁷ by default. Values outside of 0 … 1 are brought there.
    #[must_use]
    pub fn with_least_share(mut self, share: f64) -> Self {
        self.least_share = share.clamp(0.0, 1.0);
        self
    }
    /// The system without its constraints.
    pub const fn unconstrained(&self) -> &Lagrangian<S, P, F> {
        &self.lagrangian
    }
    /// The constraints.
    pub const fn constraints(&self) -> &C {
        &self.constraints
    }
}
