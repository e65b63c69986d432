//! The exponential map of rotations, its derivative and their inverses.

use core::f64::consts::{PI, TAU};

use nalgebra::{Matrix3, Vector3};
use piola_kinematics::{Attitude, RotationVector};
use piola_numerics::{Dual, Jet, Lanes, Real};
use piola_testkit::strategies::{finite, unit_vector, vector};
use piola_testkit::{DoubleDouble, Tol, assert_close, assert_close_at_scale};
use proptest::prelude::*;

const FEW: Tol = Tol::ulps(64.0);

fn triple() -> impl Strategy<Value = Vector3<f64>> {
    vector(3, -2.0..2.0).prop_map(|v| Vector3::from_column_slice(&v))
}

/// Angles from the tiniest to nearly a full turn, dense at both ends.
fn angle() -> impl Strategy<Value = f64> {
    prop_oneof![
        finite(-300.0..0.79).prop_map(|e| 10.0_f64.powf(e)),
        finite(0.0..6.2),
        finite(-6.0..-1.0).prop_map(|e| TAU - 10.0_f64.powf(e)),
    ]
}

fn close(what: &str, actual: &Vector3<f64>, expected: &Vector3<f64>, scale: f64, tol: Tol) {
    assert_close_at_scale(what, actual.as_slice(), expected.as_slice(), scale, tol);
}

/// J = Σ (−φ×)ᵏ/(k+1)!, term by term in doubled precision: the series of its definition J = ∫₀¹ exp(−s φ×) ds.
fn derivative_by_series(phi: &Vector3<f64>) -> Matrix3<DoubleDouble> {
    let phi = phi.map(|x| DoubleDouble::lit(-x));
    let zero = DoubleDouble::lit(0.0);
    let skew = Matrix3::new(zero, -phi.z, phi.y, phi.z, zero, -phi.x, -phi.y, phi.x, zero);
    let mut term = Matrix3::<f64>::identity().map(DoubleDouble::lit);
    let mut sum = term;
    for k in 1..70_i32 {
        let share = DoubleDouble::lit(1.0) / DoubleDouble::lit(f64::from(k + 1));
        term = (term * skew).map(|x| x * share);
        sum += term;
    }
    sum
}

/// The inverse by cofactors in doubled precision.
fn inverse(m: &Matrix3<DoubleDouble>) -> Matrix3<DoubleDouble> {
    let cofactor = |i: usize, j: usize| {
        let (a, b, c, d) = ((i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3);
        m[(a, c)] * m[(b, d)] - m[(a, d)] * m[(b, c)]
    };
    let determinant = m[(0, 0)] * cofactor(0, 0) + m[(0, 1)] * cofactor(0, 1) + m[(0, 2)] * cofactor(0, 2);
    Matrix3::from_fn(|i, j| cofactor(j, i) / determinant)
}

/// Largest error of an entry over the largest entry, in units of 2⁻⁵².
fn ulps(found: &Matrix3<f64>, exact: &Matrix3<DoubleDouble>) -> f64 {
    let error = found.zip_map(exact, |found, exact| exact.rounding_of(found).abs()).max();
    error / exact.map(|x| x.primal(0).abs()).max() / f64::EPSILON
}

#[test]
fn derivative_of_exponential_equals_its_series_in_doubled_precision() {
    let axes = [Vector3::new(0.6, 0.0, 0.8), Vector3::new(1.0, -2.0, 2.0) / 3.0, Vector3::z()];
    let mut angles =
        vec![0.0, 1.0e-300, 1.0e-160, 1.0e-16, 1.0e-12, 1.0e-8, 1.0e-4, 0.01, 0.3, 0.999_999_9, 1.0, 1.000_000_1];
    angles.extend([1.5, 2.0, 2.5, 3.0, PI, 3.3, 4.0, 5.0, 6.0, 6.2]);
    for angle in angles {
        let (mut worst, mut worst_inverse) = (0.0_f64, 0.0_f64);
        for axis in axes {
            let phi = RotationVector(axis * angle);
            let exact = derivative_by_series(&phi.0);
            worst = worst.max(ulps(&phi.exponential_derivative_in_body(), &exact));
            worst = worst.max(ulps(&phi.exponential_derivative_in_space(), &exact.transpose()));
            worst_inverse = worst_inverse.max(ulps(&phi.logarithm_derivative_from_body(), &inverse(&exact)));
            worst_inverse =
                worst_inverse.max(ulps(&phi.logarithm_derivative_from_space(), &inverse(&exact).transpose()));
        }
        // The inverse grows without bound at a full turn, and with it what the rounding of a does to it.
        let condition = TAU / (TAU - angle);
        assert!(worst <= 2.0, "J at {angle:e}: {worst} ulp");
        assert!(worst_inverse <= 2.0 * condition, "J⁻¹ at {angle:e}: {worst_inverse} ulp");
    }
}

proptest! {
    #[test]
    fn angular_velocity_of_rotation_vector_equals_that_of_its_quaternion(axis in unit_vector(), angle in angle(), rate in triple(), second in triple()) {
        let phi = Vector3::from(axis) * angle;
        let jets = Vector3::from_fn(|i, _| Jet::<f64, 0> { value: phi[i], partials: [], rate: rate[i], second_rate: second[i] });
        let moving = RotationVector(jets).attitude();
        let q = moving_value(moving);
        let moving = <[Jet<f64, 0>; 4]>::from(moving);
        let phi = RotationVector(phi);
        let body = phi.angular_velocity_in_body(&rate);
        close("ω body", &body, &q.angular_velocity_in_body(moving.map(|x| x.rate)), 2.0, FEW);
        let space = phi.angular_velocity_in_space(&rate);
        close("ω space", &space, &q.angular_velocity_in_space(moving.map(|x| x.rate)), 2.0, FEW);
        close("J φ̇", &(phi.exponential_derivative_in_body() * rate), &body, 2.0, FEW);
        close("Jᵀ φ̇", &(phi.exponential_derivative_in_space() * rate), &space, 2.0, FEW);
        let acceleration = phi.angular_acceleration_in_body(&rate, &second);
        close("ω̇", &acceleration, &q.angular_velocity_in_body(moving.map(|x| x.second_rate)), 8.0, FEW);
        let condition = TAU / (TAU - angle);
        close("φ̇ of body", &phi.rate_from_body(&body), &rate, 2.0, FEW.times(condition));
        close("φ̇ of space", &phi.rate_from_space(&space), &rate, 2.0, FEW.times(condition));
    }

    #[test]
    fn derivative_of_logarithm_equals_dual_logarithm(axis in unit_vector(), angle in finite(0.0..3.1), omega in triple()) {
        let phi = RotationVector(Vector3::from(axis) * angle);
        let q = phi.attitude();
        let rate = q.rate(&omega);
        let [w, x, y, z]: [f64; 4] = q.into();
        let moving = Attitude {
            w: Dual::new(w, rate[0]), x: Dual::new(x, rate[1]), y: Dual::new(y, rate[2]), z: Dual::new(z, rate[3])
        };
        let by_duals = RotationVector::of_attitude(moving).0.map(|x| x.tangent);
        close("φ̇", &phi.rate_from_body(&omega), &by_duals, 2.0, FEW);
    }

    #[test]
    fn shortest_vector_has_the_same_attitude_and_angular_velocity(axis in unit_vector(), angle in finite(0.0..6.2), rate in triple()) {
        let phi = RotationVector(Vector3::from(axis) * angle);
        let short = phi.shortest();
        prop_assert!(short.0.norm() <= PI * (1.0 + 4.0 * f64::EPSILON));
        assert_close("Q", short.attitude().to_matrix().as_slice(), phi.attitude().to_matrix().as_slice(), FEW);
        let omega = phi.angular_velocity_in_body(&rate);
        let carried = short.rate_from_body(&omega);
        close("ω", &short.angular_velocity_in_body(&carried), &omega, 2.0, FEW);
        // The same as the derivative of the map itself.
        let moving = RotationVector(phi.0.zip_map(&rate, Dual::new)).shortest();
        prop_assume!(1.0e-3 < (angle - PI).abs());
        close("φ̇", &carried, &moving.0.map(|x| x.tangent), 8.0, FEW);
    }

    #[test]
    fn derivative_in_lanes_and_in_f32_equals_that_in_f64(axis in unit_vector(), angle in finite(0.0..6.0), rate in triple()) {
        let phi = Vector3::from(axis) * angle;
        let lanes = RotationVector(phi.map(|x| Lanes([x, 0.125 * x, 0.0, x])));
        let in_lanes = lanes.angular_velocity_in_body(&rate.map(Lanes::<f64, 4>::lit));
        let back = lanes.rate_from_body(&in_lanes);
        for (lane, factor) in [(0, 1.0), (1, 0.125), (2, 0.0)] {
            let alone = RotationVector(phi * factor);
            let expected = alone.angular_velocity_in_body(&rate);
            close("lane", &in_lanes.map(|x| x.primal(lane)), &expected, 2.0, Tol::ulps(8.0));
            close("lane back", &back.map(|x| x.primal(lane)), &rate, 2.0, FEW.times(TAU / (TAU - angle)));
        }
        let single = RotationVector(phi.map(f32::lit)).angular_velocity_in_body(&rate.map(f32::lit)).map(f64::from);
        close("f32", &single, &RotationVector(phi).angular_velocity_in_body(&rate), 2.0, Tol::ulps32(32.0));
    }
}

fn moving_value(moving: Attitude<Jet<f64, 0>>) -> Attitude<f64> {
    let [w, x, y, z] = <[Jet<f64, 0>; 4]>::from(moving).map(|x| x.value);
    Attitude { w, x, y, z }
}

#[test]
fn derivatives_of_the_derivative_at_zero_equal_its_series() {
    // Along φ = s x + y small: J = 1 − ½ φ× + ⅙ φ×φ× − …; all of the second order at φ = 0 is ⅓ φ×φ×.
    let s = Dual::new(Dual::variable(0.0_f64), Dual::constant(1.0));
    let zero = Dual::constant(Dual::constant(0.0));
    let j = RotationVector(Vector3::new(s, zero, zero)).exponential_derivative_in_body();
    let first = j.map(|x| x.tangent.value);
    let second = j.map(|x| x.tangent.tangent);
    let skew = Matrix3::new(0.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0);
    assert_close("J′", first.as_slice(), (skew * -0.5).as_slice(), Tol::ulps(1.0));
    assert_close("J″", second.as_slice(), (skew * skew / 3.0).as_slice(), Tol::ulps(1.0));
    let inverse = RotationVector(Vector3::new(s, zero, zero)).logarithm_derivative_from_body();
    let second = inverse.map(|x| x.tangent.tangent);
    assert_close("(J⁻¹)″", second.as_slice(), (skew * skew / 6.0).as_slice(), Tol::ulps(1.0));
}
