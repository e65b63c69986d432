//! Forces on mechanisms, made of data: springs, dampers, drag, fields, motors and expressions.
//!
//! ```text
//! V = Σ Vᵢ(q, t)                        stored energy, J
//! Q_Δ = −∂V/∂q^Δ + Σ Fᵢ·∂x/∂q^Δ          generalised forces
//! E(t) − W(t) = const,   Ẇ = Σ Pᵢ        balance of energy
//! ```
//!
//! What a force stores belongs to the energy. What it takes or gives, as a damper or a motor does, is its power Pᵢ; a
//! potential that depends on time has the power ∂V/∂t.

mod build;
mod kinds;
mod work;

pub use kinds::{Force, ForceKind, Weighted};

pub(crate) use build::{exists, in_coordinates};
pub(crate) use work::working;

use nalgebra::Vector3;
use piola_lagrangian::{Forces, Lagrangian, Potential};
use piola_numerics::{Dual, Real};

use crate::expression::Variable;
use crate::joints::{Anchor, JointTree, Mechanism};

/// The stored energy of all forces of a mechanism: a potential.
///
/// # Example
/// See [`Mechanism::lagrangian`].
#[derive(Debug, Clone, Copy)]
pub struct MechanismPotential<'m>(&'m Mechanism);

/// All forces of a mechanism that no potential has.
///
/// # Example
/// See [`Mechanism::lagrangian`].
#[derive(Debug, Clone, Copy)]
pub struct AppliedForces<'m>(&'m Mechanism);

/// Lagrange's equations of a mechanism with its forces.
///
/// # Example
/// See [`Mechanism::lagrangian`].
pub type MechanismLagrangian<'m> = Lagrangian<&'m JointTree, MechanismPotential<'m>, AppliedForces<'m>>;

impl Mechanism {
    /// Lagrange's equations of the mechanism with gravity and all its forces.
    ///
    /// # Example
    /// See [`with_forces`](Self::with_forces).
    #[must_use]
    pub fn lagrangian(&self) -> MechanismLagrangian<'_> {
        self.lagrangian_on(&self.tree)
    }

    /// Lagrange's equations with the parts of another tree of the same motion.
    pub(crate) fn lagrangian_on<'m>(&'m self, tree: &'m JointTree) -> MechanismLagrangian<'m> {
        Lagrangian::of(tree)
            .with_uniform_gravity(self.gravity)
            .with_potential(MechanismPotential(self))
            .with_forces(AppliedForces(self))
    }
}

impl Potential for MechanismPotential<'_> {
    fn potential<T: Real>(&self, q: &[T], _v: &[T], t: T) -> T {
        let mut sum = T::zero();
        for force in &self.0.forces {
            if force.kind.stores() {
                sum += force.kind.energy(&self.0.tree, &|i| q[i], t);
            }
        }
        sum
    }
}

impl Forces for AppliedForces<'_> {
    const GENERALISED: bool = true;
    fn generalised<T: Real>(&self, q: &[T], v: &[T], t: T, q_out: &mut [T]) {
        for force in &self.0.forces {
            force.kind.add_applied(&self.0.tree, q, v, t, q_out);
        }
    }
}

impl ForceKind {
    /// Whether it stores energy.
    #[must_use]
    pub fn stores(&self) -> bool {
        match self {
            Self::Spring { stiffness, .. } | Self::JointSpring { stiffness, .. } => 0.0 < *stiffness,
            Self::Uniform { .. } | Self::Central { .. } | Self::Potential { .. } => true,
            Self::Drag { .. } | Self::Motor { .. } => false,
        }
    }

    /// The stored energy, J, where `q` gives the coordinates by index.
    pub fn energy<T: Real>(&self, tree: &JointTree, q: &dyn Fn(usize) -> T, t: T) -> T {
        match self {
            Self::Spring { ends, stiffness, length, .. } => {
                let half = T::lit(0.5 * stiffness);
                if 0.0 < *length {
                    let stretch = distance(tree, ends, q) - T::lit(*length);
                    half * stretch * stretch
                } else {
                    let [x, y, z] = between(tree, ends, q).into();
                    half * (x * x + y * y + z * z)
                }
            }
            Self::JointSpring { coordinate, stiffness, rest, .. } => {
                let stretch = q(*coordinate) - T::lit(*rest);
                T::lit(0.5 * stiffness) * stretch * stretch
            }
            Self::Uniform { points, field } => {
                let mut sum = T::zero();
                for (anchor, weight) in points {
                    let place = tree.place_of(anchor, q);
                    for i in 0..3 {
                        sum -= T::lit(weight * field[i]) * place[i];
                    }
                }
                sum
            }
            Self::Central { points, centre, gm } => {
                let mut sum = T::zero();
                for (anchor, mass) in points {
                    let place = tree.place_of(anchor, q);
                    sum -= T::lit(mass * gm) / norm([0, 1, 2].map(|i| place[i] - T::lit(centre[i])));
                }
                sum
            }
            Self::Potential { energy } => energy.evaluate(&|variable| match variable {
                Variable::Coordinate(i) => q(i),
                Variable::Time => t,
                Variable::Conjugate(_) => T::zero(), // refused when it is made
            }),
            Self::Drag { .. } | Self::Motor { .. } => T::zero(),
        }
    }

    /// Adds the generalised forces that do not come from the stored energy.
    fn add_applied<T: Real>(&self, tree: &JointTree, q: &[T], v: &[T], t: T, out: &mut [T]) {
        match self {
            Self::Spring { ends, damping, .. } if 0.0 < *damping => {
                let force = T::lit(-damping) * rate_of_distance(tree, ends, q, v);
                // A coordinate below both ends moves them together: it does not change their distance.
                for [one, other] in [[0, 1], [1, 0]] {
                    let shared = |i: usize| tree.coordinates_of(&ends[other]).any(|below| below == i);
                    for i in tree.coordinates_of(&ends[one]).filter(|&i| !shared(i)) {
                        out[i] += force * distance(tree, ends, &seeded(q, i)).tangent;
                    }
                }
            }
            Self::JointSpring { coordinate, damping, .. } => out[*coordinate] -= T::lit(*damping) * v[*coordinate],
            Self::Drag { points, linear, quadratic, wind } => {
                for anchor in points {
                    let velocity = velocity(tree, anchor, q, v);
                    let force = drag(velocity, *linear, *quadratic, *wind);
                    for i in tree.coordinates_of(anchor) {
                        let place = tree.place_of(anchor, &seeded(q, i));
                        for k in 0..3 {
                            out[i] += force[k] * place[k].tangent;
                        }
                    }
                }
            }
            Self::Motor { coordinate, force } => out[*coordinate] += force.evaluate(&reader(q, v, t)),
            Self::Spring { .. } | Self::Uniform { .. } | Self::Central { .. } | Self::Potential { .. } => {}
        }
    }
}

/// Reads the variables of an expression.
fn reader<'r, T: Real>(q: &'r [T], v: &'r [T], t: T) -> impl Fn(Variable) -> T + 'r {
    move |variable| match variable {
        Variable::Coordinate(i) => q[i],
        Variable::Conjugate(i) => v[i],
        Variable::Time => t,
    }
}

/// Coordinates with the derivative by one of them.
fn seeded<T: Real>(q: &[T], by: usize) -> impl Fn(usize) -> Dual<T> + '_ {
    move |i| if i == by { Dual::variable(q[i]) } else { Dual::constant(q[i]) }
}

/// Coordinates with their derivatives by time.
fn moving<'r, T: Real>(q: &'r [T], v: &'r [T]) -> impl Fn(usize) -> Dual<T> + 'r {
    move |i| Dual::new(q[i], v[i])
}

/// The vector from the first end to the second one.
fn between<T: Real>(tree: &JointTree, ends: &[Anchor; 2], q: &dyn Fn(usize) -> T) -> Vector3<T> {
    tree.place_of(&ends[1], q) - tree.place_of(&ends[0], q)
}

/// r = |x₂ − x₁|.
fn distance<T: Real>(tree: &JointTree, ends: &[Anchor; 2], q: &dyn Fn(usize) -> T) -> T {
    norm(between(tree, ends, q).into())
}

/// ṙ.
fn rate_of_distance<T: Real>(tree: &JointTree, ends: &[Anchor; 2], q: &[T], v: &[T]) -> T {
    distance(tree, ends, &moving(q, v)).tangent
}

/// The velocity of an anchor.
fn velocity<T: Real>(tree: &JointTree, anchor: &Anchor, q: &[T], v: &[T]) -> [T; 3] {
    let place = tree.place_of(anchor, &moving(q, v));
    [place.x.tangent, place.y.tangent, place.z.tangent]
}

/// −(c₁ + c₂ |u|) u with u = v − w.
fn drag<T: Real>(velocity: [T; 3], linear: f64, quadratic: f64, wind: [f64; 3]) -> [T; 3] {
    let [u, v, w] = [0, 1, 2].map(|i| velocity[i] - T::lit(wind[i]));
    let square = u * u + v * v + w * w;
    // At rest |u| u is zero with its first derivatives; the root has none there.
    let speed = T::select(square.at_most(T::zero()), T::zero(), square.sqrt());
    let factor = -(T::lit(linear) + T::lit(quadratic) * speed);
    [factor * u, factor * v, factor * w]
}

fn norm<T: Real>([x, y, z]: [T; 3]) -> T {
    (x * x + y * y + z * z).sqrt()
}
