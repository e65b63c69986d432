//! Exponentials and the differentials of their inverses, at small and at large angles.

use piola_geometric::{DirectPower, DirectProduct, LieGroup, RigidMotions, Rotations, Translations};
use piola_numerics::{Dual, Real};
use piola_testkit::{DoubleDouble, Tol, assert_close, assert_close_at_scale, assert_each_close};

use super::cross;

/// Angles from nothing to several turns, on both sides of the ends of the power series, of a half turn and of a whole one.
const ANGLES: [f64; 16] =
    [1e-160, 1e-20, 1e-8, 1e-3, 0.3, 0.999, 1.001, 2.0, 3.0, core::f64::consts::PI, 3.3, 5.0, 6.2, 6.3, 9.5, 40.0];
/// A unit vector, but for rounding.
const AXIS: [f64; 3] = [0.36, -0.48, 0.8];

fn about_axis(angle: f64) -> [f64; 3] {
    AXIS.map(|x| x * angle)
}

#[test]
fn exponential_less_one_equals_its_closed_form_at_any_angle() {
    for angle in ANGLES {
        let theta = about_axis(angle);
        let (mut q, mut carry) = ([1.0, 0.0, 0.0, 0.0], [0.0; 4]);
        Rotations.advance(&mut q, &mut carry, &theta);
        // q and its carry together are one plus the excess, which the sum has not rounded.
        let excess = [(q[0] - 1.0) + carry[0], q[1] + carry[1], q[2] + carry[2], q[3] + carry[3]];
        let half = theta.map(|x| DoubleDouble::lit(0.5 * x));
        // At 1e-160 the square of the angle is no number; sin x/x is one there.
        let a = if angle < 1e-100 {
            DoubleDouble::lit(0.5 * angle)
        } else {
            (half[0] * half[0] + half[1] * half[1] + half[2] * half[2]).sqrt()
        };
        let (s, _) = (a * DoubleDouble::lit(0.5)).sin_cos();
        let sinc = if angle < 1e-10 { DoubleDouble::lit(1.0) } else { a.sin_cos().0 / a };
        let expected = [-(s * s + s * s), half[0] * sinc, half[1] * sinc, half[2] * sinc].map(|x| x.primal(0));
        if angle < 1e-100 {
            assert_each_close("vector", &excess[1..], &expected[1..], Tol::ulps(4.0));
        } else {
            // Near a whole turn the vector part is the small difference of a sine from zero.
            let tol = Tol::ulps(8.0).times(if 5.0 < angle { angle / a.sin_cos().0.primal(0).abs() } else { 1.0 });
            assert_each_close(&format!("angle {angle}"), &excess, &expected, tol);
        }
    }
}

/// The velocity in the frame of the body of a pose that moves with the derivative of its numbers.
fn body_velocity(pose: &[Dual<f64>]) -> [f64; 6] {
    let (q, rate): (Vec<f64>, Vec<f64>) = pose[..4].iter().map(|x| (x.value, x.tangent)).unzip();
    let (u, du) = ([q[1], q[2], q[3]], [rate[1], rate[2], rate[3]]);
    // ω = 2 q* q̇.
    let side = cross(u, du);
    let omega: [f64; 3] = core::array::from_fn(|i| 2.0 * (q[0] * du[i] - rate[0] * u[i] - side[i]));
    // v = Rᵀ ẋ.
    let x: [f64; 3] = core::array::from_fn(|i| pose[4 + i].tangent);
    let twice = cross(u, x).map(|x| -2.0 * x);
    let beside = cross(u, twice);
    let v: [f64; 3] = core::array::from_fn(|i| x[i] + q[0] * twice[i] - beside[i]);
    [omega[0], omega[1], omega[2], v[0], v[1], v[2]]
}

/// With exact derivatives of the exponential: θ̇ → velocity in the body → θ̇, of twists and so of rotations, too.
#[test]
fn inverse_differential_inverts_the_derivative_of_the_exponential() {
    let mut compared = 0;
    for angle in ANGLES {
        for rate in
            [[0.5, 0.25, -1.0, 0.125, 2.0, 0.75], [0.36, -0.48, 0.8, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0, 0.5, 0.25]]
        {
            let [a, b, c] = about_axis(angle);
            let displacement = [a, b, c, 1.5, -0.5, 0.25];
            let moving: [Dual<f64>; 6] = core::array::from_fn(|i| Dual::new(displacement[i], rate[i]));
            let mut pose = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0].map(Dual::constant);
            RigidMotions.advance(&mut pose, &mut [Dual::constant(0.0); 7], &moving);
            let velocity = body_velocity(&pose);
            let mut found = velocity;
            RigidMotions.inverse_differential(&displacement, &mut found);
            // The differential is singular at whole turns, its inverse and the derivative of that grow as 1/δ and 1/δ².
            let turn = core::f64::consts::TAU;
            let distance = (1..8).map(|n| (angle - f64::from(n) * turn).abs()).fold(turn, f64::min) / turn;
            let condition = angle.max(1.0) / (distance * distance);
            assert_close(&format!("twist, {angle}"), &found, &rate, Tol::ulps(16.0).times(condition));
            let mut omega = [velocity[0], velocity[1], velocity[2]];
            Rotations.inverse_differential(&displacement[..3], &mut omega);
            assert_close(&format!("rotation, {angle}"), &omega, &rate[..3], Tol::ulps(16.0).times(condition));
            compared += 1;
        }
    }
    assert_eq!(compared, 48);
}

/// exp ξ = (exp ξ/n)ⁿ: with the derivative above, which is that along ξ too, this makes it the exponential.
#[test]
fn exponential_equals_the_power_of_its_parts() {
    for angle in [0.5, 3.0, 8.0] {
        let [a, b, c] = about_axis(angle);
        let twist = [a, b, c, 1.5, -0.5, 0.25];
        let mut whole = ([1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0], [0.0; 7]);
        let mut parts = whole;
        RigidMotions.advance(&mut whole.0, &mut whole.1, &twist);
        for _ in 0..64 {
            RigidMotions.advance(&mut parts.0, &mut parts.1, &twist.map(|x| x / 64.0));
        }
        assert_close(&format!("{angle}"), &parts.0, &whole.0, Tol::ulps(16.0));
    }
}

#[test]
fn products_of_groups_move_their_factors_side_by_side() {
    let group =
        DirectProduct(DirectPower { factor: Rotations, count: 2 }, DirectProduct(Translations(2), RigidMotions));
    assert_eq!((LieGroup::<f64>::element_length(&group), LieGroup::<f64>::dimension(&group)), (17, 14));
    let displacement: [f64; 14] = core::array::from_fn(|i| 0.1 * (i as f64) - 0.3);
    let one = [1.0, 0.0, 0.0, 0.0];
    let start: Vec<f64> = [&one[..], &one, &[0.5, 0.25], &one, &[1.0, 2.0, 3.0]].concat();
    let (mut element, mut carry) = (start.clone(), [0.0; 17]);
    group.advance(&mut element, &mut carry, &displacement);
    let mut velocity = [0.25; 14];
    group.inverse_differential(&displacement, &mut velocity);
    let (mut apart, mut apart_carry, mut apart_velocity) = (start.clone(), [0.0; 17], [0.25; 14]);
    for (at, from) in [(0, 0), (4, 3)] {
        Rotations.advance(&mut apart[at..at + 4], &mut apart_carry[at..at + 4], &displacement[from..from + 3]);
        Rotations.inverse_differential(&displacement[from..from + 3], &mut apart_velocity[from..from + 3]);
    }
    Translations(2).advance(&mut apart[8..10], &mut apart_carry[8..10], &displacement[6..8]);
    RigidMotions.advance(&mut apart[10..], &mut apart_carry[10..], &displacement[8..]);
    RigidMotions.inverse_differential(&displacement[8..], &mut apart_velocity[8..]);
    assert_eq!((&element, carry, velocity), (&apart, apart_carry, apart_velocity));
    // Defects are found where they are, and removed there.
    assert_eq!(group.defect(&start), None);
    for (first, at) in [(0, 1), (4, 4), (10, 12)] {
        let mut off = start.clone();
        off[at] += 0.5;
        let (index, defect) = group.defect(&off).unwrap();
        assert_eq!(index, first);
        let expected = if at == 4 { 0.5 * (1.5 * 1.5 - 1.0) } else { 0.125 };
        assert_close("defect", &[defect], &[expected], Tol::ulps(2.0));
        let mut near = start.clone();
        near[first] += 1e-12;
        group.renormalise(&mut near, &mut [0.0; 17]);
        assert_close_at_scale("renormalised", &near, &start, 1.0, Tol::ulps(1.0));
    }
}

/// What the length of a quaternion misses one by is removed, its direction is not touched.
#[test]
fn renormalised_quaternion_has_length_one_and_its_direction() {
    let direction: [f64; 4] = [0.1, -0.7, 0.5, 0.5];
    for defect in [1e-9, -1e-12, 1e-15] {
        let start = direction.map(|x| x * (1.0 + defect));
        let (mut q, mut carry) = (start, [0.0; 4]);
        assert_eq!(Rotations.defect(&q), None);
        Rotations.renormalise(&mut q, &mut carry);
        let exact: Vec<DoubleDouble> = (0..4).map(|i| DoubleDouble::of_sum(q[i], carry[i])).collect();
        let excess = exact.iter().fold(DoubleDouble::lit(-1.0), |sum, &x| sum + x * x).primal(0);
        assert!(excess.abs() <= 4.0 * defect * defect + 1e-31, "{defect}: {excess:e}");
        assert_close("direction", &q.map(|x| x / q[1]), &start.map(|x| x / start[1]), Tol::ulps(2.0));
    }
}
