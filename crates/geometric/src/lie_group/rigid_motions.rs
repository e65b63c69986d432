//! Rigid motions: a rotation and a translation that depend on each other.
//!
//! By the principle of transference a twist is one vector over dual numbers, ω + ε v with ε² = 0, and a pose is a unit
//! quaternion over them, q + ½ ε x q. The formulas for rotations, evaluated over dual numbers, are those for rigid motions.

use piola_integrators::internal::compensated_add;
use piola_numerics::{Dual, Real};

use super::LieGroup;
use super::products::largest;
use super::rotations::{Rotations, excess_of_exponential, inverse_differential, product, quaternion, vector};

/// The rigid motions SE(3): a unit quaternion (w, x, y, z), body → space, then the position of the body's reference point in
/// space.
///
/// The algebra is (ω, v): the angular velocity and the velocity of the reference point, both in body components.
///
/// ```text
/// q̇ = ½ q (0, ω)        ẋ = R(q) v
/// ```
///
/// A body that moves with constant (ω, v) moves along a screw, which one step follows exactly. Where position and attitude
/// have nothing to do with each other, as for a free body about its centre of mass, [`DirectProduct`](crate::DirectProduct) of
/// [`Rotations`] and [`Translations`](crate::Translations) is the better group.
///
/// # Accuracy
/// As [`Rotations`]; the position is summed with compensation.
///
/// # Example
/// ```
/// use piola_geometric::{LieGroup, RigidMotions};
/// // Forward at 1 m/s while turning left by half a turn: a half circle of diameter 2/π to the left.
/// let (mut pose, mut carry) = ([1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0], [0.0; 7]);
/// RigidMotions.advance(&mut pose, &mut carry, &[0.0, 0.0, std::f64::consts::PI, 1.0, 0.0, 0.0]);
/// assert!(pose[4].abs() < 1e-15 && (pose[5] - std::f64::consts::FRAC_2_PI).abs() < 1e-15);
/// ```
#[doc(alias("SE(3)", "pose", "screw motion", "twist"))]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RigidMotions;

/// ω + ε v.
#[cfg_attr(not(debug_assertions), inline(always))]
fn twist<T: Real>(numbers: &[T]) -> [Dual<T>; 3] {
    core::array::from_fn(|i| Dual::new(numbers[i], numbers[i + 3]))
}

impl<T: Real> LieGroup<T> for RigidMotions {
    fn element_length(&self) -> usize {
        7
    }
    fn dimension(&self) -> usize {
        6
    }
    fn advance(&self, element: &mut [T], carry: &mut [T], displacement: &[T]) {
        let excess = excess_of_exponential(twist(displacement));
        // The position of exp(ω + ε v) in the body that moves: the vector part of 2 q_ε q*.
        let (turn, moment) = (excess.map(|x| x.value), excess.map(|x| x.tangent));
        let conjugate = [T::one() + turn[0], -turn[1], -turn[2], -turn[3]];
        let [_, forward @ ..] = product(moment, conjugate).map(|x| x * T::lit(2.0));
        let increment = to_space(quaternion(element), forward);
        for (i, &increment) in increment.iter().enumerate() {
            compensated_add(&mut element[4 + i], &mut carry[4 + i], increment);
        }
        Rotations.advance(&mut element[..4], &mut carry[..4], &displacement[..3]);
    }
    fn inverse_differential(&self, displacement: &[T], velocity: &mut [T]) {
        let rate = inverse_differential(twist(displacement), twist(velocity));
        for (i, rate) in rate.into_iter().enumerate() {
            (velocity[i], velocity[i + 3]) = (rate.value, rate.tangent);
        }
    }
    fn renormalise(&self, element: &mut [T], carry: &mut [T]) {
        Rotations.renormalise(&mut element[..4], &mut carry[..4]);
    }
    /// One for angles; for places the largest coordinate.
    fn magnitudes(&self, element: &[T], magnitudes: &mut [f64]) {
        let (angles, places) = magnitudes.split_at_mut(3);
        angles.fill(1.0);
        places.fill(largest(&element[4..7]));
    }
    fn defect(&self, element: &[T]) -> Option<(usize, f64)> {
        Rotations.defect(&element[..4])
    }
}

/// R(q) v = v + 2 w u×v + 2 u×(u×v), with q = (w, u).
#[cfg_attr(not(debug_assertions), inline(always))]
fn to_space<T: Real>(q: [T; 4], v: [T; 3]) -> [T; 3] {
    let u = vector(&q[1..]);
    let twice = super::rotations::cross(u, v).map(|x| x + x);
    let beside = super::rotations::cross(u, twice);
    core::array::from_fn(|i| v[i] + q[0] * twice[i] + beside[i])
}
