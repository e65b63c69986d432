//! Momenta p = ∂L/∂v and slopes ∂L/∂q of the Lagrangian, in one pass each way.
//!
//! ```text
//! p = S·h        ∂L/∂q = S·(g − v_λ ×* h)        h, g: momentum and weight of a link with all beyond it
//! ```

use piola_numerics::Real;

use crate::elementary::for_kind;
use crate::link::{Elementary, Link, take};
use crate::space::{force_cross, momentum};
use crate::spatial::{add, cross, lit, lit_symmetric, scaled, sub};
use crate::tree::RigidTree;
use crate::turn::{Turning, wrench_to_parent};
use crate::workspace::LinkForces;

/// p = ∂L/∂v = M v and ∂L/∂q along the tangent space.
///
/// The fields of forces of the links hold: velocity of the origin in `alpha`, gravity in `a`, momentum in the first two rows
/// of `gradient`, and the weight in `moment` and `force`.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn momenta_and_slopes<T: Real>(
    tree: &RigidTree,
    states: &mut [LinkForces<T>],
    q: &[T],
    v: &[T],
    p: &mut [T],
    slopes: &mut [T],
) {
    states[0].a = lit(tree.gravity);
    states[0].alpha = [T::zero(); 3];
    for (i, link) in tree.links.iter().enumerate() {
        for_kind!(link.kind, outwards::<T>(link, i + 1, states, q, v));
    }
    for (i, link) in tree.links.iter().enumerate().rev() {
        for_kind!(link.kind, inwards::<T>(link, i + 1, states, &tree.armature, v, p, slopes));
    }
    states[0].alpha = [T::zero(); 3];
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn outwards<T: Real, E: Elementary<T, N>, const N: usize>(
    link: &Link,
    state: usize,
    states: &mut [LinkForces<T>],
    q: &[T],
    v: &[T],
) {
    let (turn, origin) = E::place(link, q);
    let rate = take::<T, N>(v, link.v);
    let parent = &states[link.parent];
    let mut w = turn.to_child(parent.w);
    let mut velocity = turn.to_child(add(parent.alpha, cross(parent.w, origin)));
    let gravity = turn.to_child(parent.a);
    E::add_angular(link, rate, &mut w);
    E::add_linear(link, rate, &mut velocity);
    let (mass, h) = (T::lit(link.mass), lit(link.moment));
    let own = momentum(mass, h, lit_symmetric(link.inertia), (w, velocity));
    let child = &mut states[state];
    turn.keep(&mut child.turn);
    child.origin = origin;
    child.w = w;
    child.alpha = velocity;
    child.a = gravity;
    child.gradient[0] = own.0;
    child.gradient[1] = own.1;
    child.moment = cross(h, gravity);
    child.force = scaled(mass, gravity);
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn inwards<T: Real, E: Elementary<T, N>, const N: usize>(
    link: &Link,
    state: usize,
    states: &mut [LinkForces<T>],
    armature: &[f64],
    v: &[T],
    p: &mut [T],
    slopes: &mut [T],
) {
    let child = &states[state];
    let turn = E::Turn::recall(&child.turn);
    let (momentum, sum) = ((child.gradient[0], child.gradient[1]), (child.moment, child.force));
    // The parent's motion at the child's origin: the child's less that of the joint.
    let (mut w, mut velocity) = ([T::zero(); 3], [T::zero(); 3]);
    E::add_angular(link, take::<T, N>(v, link.v), &mut w);
    E::add_linear(link, take::<T, N>(v, link.v), &mut velocity);
    let parents = (sub(child.w, w), sub(child.alpha, velocity));
    let carried = force_cross(parents, momentum);
    let momenta = E::project(link, momentum.0, momentum.1);
    let slope = E::project(link, sub(sum.0, carried.0), sub(sum.1, carried.1));
    let mut k = 0;
    while k < N {
        p[link.v + k] = momenta[k] + T::lit(armature[link.v + k]) * v[link.v + k];
        slopes[link.v + k] = slope[k];
        k += 1;
    }
    if link.parent == 0 {
        return;
    }
    let origin = child.origin;
    let (momentum, sum) = (wrench_to_parent(turn, origin, momentum), wrench_to_parent(turn, origin, sum));
    let parent = &mut states[link.parent];
    parent.gradient[0] = add(parent.gradient[0], momentum.0);
    parent.gradient[1] = add(parent.gradient[1], momentum.1);
    parent.moment = add(parent.moment, sum.0);
    parent.force = add(parent.force, sum.1);
}
