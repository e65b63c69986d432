//! The elementary joints: their turns, their directions S, and what moves with them.

use piola_numerics::Real;

use crate::link::{Articulated, Elementary, Link, Pair};
use crate::spatial::{Matrix, Vector, add, cross, dot, lit, lit_matrix, scaled, symmetric_times, times};
use crate::turn::{About, AnyTurn, NoTurn, Turning};

/// About coordinate axis A, without a constant turn.
pub(crate) struct Revolute<const A: usize>;

impl<T: Real, const A: usize> Elementary<T, 1> for Revolute<A> {
    type Turn = About<T, A>;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn turned_subspace(link: &Link, axes: Matrix<T>) -> [Pair<T>; 1] {
        let axis = [axes[0][A], axes[1][A], axes[2][A]];
        [(scaled(T::lit(link.sign), axis), [T::zero(); 3])]
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn place(link: &Link, q: &[T]) -> (About<T, A>, Vector<T>) {
        Self::place_by(link, q, q[link.q].sin_cos())
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn place_by(link: &Link, _q: &[T], (sine, cosine): (T, T)) -> (About<T, A>, Vector<T>) {
        (About { cosine, sine: T::lit(link.sign) * sine }, lit(link.origin))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add_angular(link: &Link, x: [T; 1], angular: &mut Vector<T>) {
        angular[A] += T::lit(link.sign) * x[0];
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add_bias(
        link: &Link,
        w: Vector<T>,
        _child: Vector<T>,
        rate: [T; 1],
        angular: &mut Vector<T>,
        _linear: &mut Vector<T>,
    ) {
        let (i, j) = ((A + 1) % 3, (A + 2) % 3);
        let rate = T::lit(link.sign) * rate[0];
        // w × rate e_A: e_i × e_A = −e_j, e_j × e_A = e_i.
        angular[i] += w[j] * rate;
        angular[j] -= w[i] * rate;
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn project(link: &Link, moment: Vector<T>, _force: Vector<T>) -> [T; 1] {
        [T::lit(link.sign) * moment[A]]
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn columns(link: &Link, inertia: &Articulated<T>) -> [Pair<T>; 1] {
        let entry = &crate::spatial::ENTRY[A];
        let sign = T::lit(link.sign);
        let j = [inertia.j[entry[0]], inertia.j[entry[1]], inertia.j[entry[2]]];
        [(scaled(sign, j), scaled(sign, inertia.h[A]))]
    }
}

/// R_constant times a turn about z by the angle.
#[cfg_attr(not(debug_assertions), inline(always))]
fn turned_about_z<T: Real>(link: &Link, (sine, cosine): (T, T)) -> AnyTurn<T> {
    AnyTurn(About::<T, 2> { cosine, sine }.after(lit_matrix(link.turn)))
}

/// About z, after a constant turn.
pub(crate) struct RevoluteTurned;

impl<T: Real> Elementary<T, 1> for RevoluteTurned {
    type Turn = AnyTurn<T>;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn turned_subspace(_link: &Link, axes: Matrix<T>) -> [Pair<T>; 1] {
        [([axes[0][2], axes[1][2], axes[2][2]], [T::zero(); 3])]
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn place(link: &Link, q: &[T]) -> (AnyTurn<T>, Vector<T>) {
        Self::place_by(link, q, q[link.q].sin_cos())
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn place_by(link: &Link, _q: &[T], sine_cosine: (T, T)) -> (AnyTurn<T>, Vector<T>) {
        (turned_about_z(link, sine_cosine), lit(link.origin))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add_angular(_link: &Link, x: [T; 1], angular: &mut Vector<T>) {
        angular[2] += x[0];
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add_bias(
        _link: &Link,
        w: Vector<T>,
        _child: Vector<T>,
        rate: [T; 1],
        angular: &mut Vector<T>,
        _linear: &mut Vector<T>,
    ) {
        angular[0] += w[1] * rate[0];
        angular[1] -= w[0] * rate[0];
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn project(_link: &Link, moment: Vector<T>, _force: Vector<T>) -> [T; 1] {
        [moment[2]]
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn columns(_link: &Link, inertia: &Articulated<T>) -> [Pair<T>; 1] {
        [([inertia.j[2], inertia.j[4], inertia.j[5]], inertia.h[2])]
    }
}

/// Along an axis.
pub(crate) struct Prismatic;

impl<T: Real> Elementary<T, 1> for Prismatic {
    type Turn = NoTurn;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn turned_subspace(link: &Link, axes: Matrix<T>) -> [Pair<T>; 1] {
        [([T::zero(); 3], times(axes, lit(link.axis)))]
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn place(link: &Link, q: &[T]) -> (NoTurn, Vector<T>) {
        (NoTurn, add(lit(link.origin), scaled(q[link.q], lit(link.axis))))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add_linear(link: &Link, x: [T; 1], linear: &mut Vector<T>) {
        *linear = add(*linear, scaled(x[0], lit(link.axis)));
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add_bias(
        link: &Link,
        w: Vector<T>,
        _child: Vector<T>,
        rate: [T; 1],
        _angular: &mut Vector<T>,
        linear: &mut Vector<T>,
    ) {
        *linear = add(*linear, cross(scaled(T::lit(2.0) * rate[0], w), lit(link.axis)));
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn project(link: &Link, _moment: Vector<T>, force: Vector<T>) -> [T; 1] {
        [dot(lit(link.axis), force)]
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn columns(link: &Link, inertia: &Articulated<T>) -> [Pair<T>; 1] {
        let axis = lit(link.axis);
        [(times(inertia.h, axis), symmetric_times(inertia.m, axis))]
    }
}

/// About and along z, after a constant turn.
pub(crate) struct Helical;

impl<T: Real> Elementary<T, 1> for Helical {
    type Turn = AnyTurn<T>;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn place(link: &Link, q: &[T]) -> (AnyTurn<T>, Vector<T>) {
        let advance = scaled(T::lit(link.pitch) * q[link.q], lit(link.axis));
        (turned_about_z(link, q[link.q].sin_cos()), add(lit(link.origin), advance))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add_angular(_link: &Link, x: [T; 1], angular: &mut Vector<T>) {
        angular[2] += x[0];
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add_linear(link: &Link, x: [T; 1], linear: &mut Vector<T>) {
        linear[2] += T::lit(link.pitch) * x[0];
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add_bias(
        link: &Link,
        w: Vector<T>,
        child: Vector<T>,
        rate: [T; 1],
        angular: &mut Vector<T>,
        linear: &mut Vector<T>,
    ) {
        angular[0] += w[1] * rate[0];
        angular[1] -= w[0] * rate[0];
        let speed = T::lit(link.pitch) * rate[0];
        linear[0] += (w[1] + child[1]) * speed;
        linear[1] -= (w[0] + child[0]) * speed;
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn project(link: &Link, moment: Vector<T>, force: Vector<T>) -> [T; 1] {
        [moment[2] + T::lit(link.pitch) * force[2]]
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn columns(link: &Link, inertia: &Articulated<T>) -> [Pair<T>; 1] {
        let axis = [T::zero(), T::zero(), T::one()];
        [inertia.times((axis, scaled(T::lit(link.pitch), axis)))]
    }
}

/// R_constant times the rotation of a unit quaternion (w, x, y, z).
#[cfg_attr(not(debug_assertions), inline(always))]
fn turned_by_quaternion<T: Real>(link: &Link, [w, x, y, z]: [T; 4]) -> AnyTurn<T> {
    let two = T::lit(2.0);
    let one = T::one();
    let rows = [
        [one - two * (y * y + z * z), two * (x * y - w * z), two * (x * z + w * y)],
        [two * (x * y + w * z), one - two * (x * x + z * z), two * (y * z - w * x)],
        [two * (x * z - w * y), two * (y * z + w * x), one - two * (x * x + y * y)],
    ];
    AnyTurn(crate::spatial::product(lit_matrix(link.turn), rows))
}

/// Any rotation: q is a unit quaternion, v the angular velocity in the child's axes.
pub(crate) struct Spherical;

impl<T: Real> Elementary<T, 3> for Spherical {
    type Turn = AnyTurn<T>;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn place(link: &Link, q: &[T]) -> (AnyTurn<T>, Vector<T>) {
        let k = link.q;
        (turned_by_quaternion(link, [q[k], q[k + 1], q[k + 2], q[k + 3]]), lit(link.origin))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add_angular(_link: &Link, x: [T; 3], angular: &mut Vector<T>) {
        *angular = add(*angular, x);
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add_bias(
        _link: &Link,
        w: Vector<T>,
        _child: Vector<T>,
        rate: [T; 3],
        angular: &mut Vector<T>,
        _linear: &mut Vector<T>,
    ) {
        *angular = add(*angular, cross(w, rate));
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn project(_link: &Link, moment: Vector<T>, _force: Vector<T>) -> [T; 3] {
        moment
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn columns(_link: &Link, inertia: &Articulated<T>) -> [Pair<T>; 3] {
        let j = inertia.j;
        [([j[0], j[1], j[2]], inertia.h[0]), ([j[1], j[3], j[4]], inertia.h[1]), ([j[2], j[4], j[5]], inertia.h[2])]
    }
}

/// Any rigid motion: q is a unit quaternion and the position in the joint's frame, v the angular velocity and the velocity of
/// the origin, both in the child's axes.
pub(crate) struct Free;

impl<T: Real> Elementary<T, 6> for Free {
    type Turn = AnyTurn<T>;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn place(link: &Link, q: &[T]) -> (AnyTurn<T>, Vector<T>) {
        let k = link.q;
        let position = times(lit_matrix(link.turn), [q[k + 4], q[k + 5], q[k + 6]]);
        (turned_by_quaternion(link, [q[k], q[k + 1], q[k + 2], q[k + 3]]), add(lit(link.origin), position))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add_angular(_link: &Link, x: [T; 6], angular: &mut Vector<T>) {
        *angular = add(*angular, [x[0], x[1], x[2]]);
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add_linear(_link: &Link, x: [T; 6], linear: &mut Vector<T>) {
        *linear = add(*linear, [x[3], x[4], x[5]]);
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add_bias(
        _link: &Link,
        w: Vector<T>,
        child: Vector<T>,
        rate: [T; 6],
        angular: &mut Vector<T>,
        linear: &mut Vector<T>,
    ) {
        *angular = add(*angular, cross(w, [rate[0], rate[1], rate[2]]));
        *linear = add(*linear, cross(add(w, child), [rate[3], rate[4], rate[5]]));
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn project(_link: &Link, moment: Vector<T>, force: Vector<T>) -> [T; 6] {
        [moment[0], moment[1], moment[2], force[0], force[1], force[2]]
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn columns(_link: &Link, inertia: &Articulated<T>) -> [Pair<T>; 6] {
        let (j, h, m) = (inertia.j, inertia.h, inertia.m);
        let column = |k: usize| [h[0][k], h[1][k], h[2][k]];
        [
            ([j[0], j[1], j[2]], h[0]),
            ([j[1], j[3], j[4]], h[1]),
            ([j[2], j[4], j[5]], h[2]),
            (column(0), [m[0], m[1], m[2]]),
            (column(1), [m[1], m[3], m[4]]),
            (column(2), [m[2], m[4], m[5]]),
        ]
    }
}

/// Calls a function, generic over the elementary joint E and its freedoms N, for the kind of a link.
macro_rules! for_kind {
    ($kind:expr, $function:ident::<$t:ty>($($argument:expr),* $(,)?)) => {{
        use $crate::elementary::{Free, Helical, Prismatic, Revolute, RevoluteTurned, Spherical};
        use $crate::link::Kind;
        match $kind {
            Kind::RevoluteX => $function::<$t, Revolute<0>, 1>($($argument),*),
            Kind::RevoluteY => $function::<$t, Revolute<1>, 1>($($argument),*),
            Kind::RevoluteZ => $function::<$t, Revolute<2>, 1>($($argument),*),
            Kind::RevoluteTurned => $function::<$t, RevoluteTurned, 1>($($argument),*),
            Kind::Prismatic => $function::<$t, Prismatic, 1>($($argument),*),
            Kind::Helical => $function::<$t, Helical, 1>($($argument),*),
            Kind::Spherical => $function::<$t, Spherical, 3>($($argument),*),
            Kind::Free => $function::<$t, Free, 6>($($argument),*),
        }
    }};
}
pub(crate) use for_kind;
