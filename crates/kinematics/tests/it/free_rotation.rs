//! Free rotation in closed form: against its reference, the laws of conservation, and the closed forms of symmetric bodies.

use nalgebra::{Matrix3, Vector3};
use piola_kinematics::{Attitude, FreeRotation, Inertia, KinematicsError};
use piola_testkit::strategies::{rotation, vector};
use piola_testkit::{Tol, assert_close, assert_close_at_scale, golden};
use proptest::prelude::*;

const INERTIAS: [[f64; 3]; 7] = [
    [1.0, 2.0, 2.5],
    [2.5, 1.0, 2.0],
    [1.0, 1.0, 1.5],
    [1.0, 2.0, 2.0],
    [1.0, 1.0 + 1e-9, 1.5],
    [1.0, 2.0 - 1e-12, 2.0],
    [1.0, 1.0, 1.0],
];

fn motion(moments: [f64; 3], omega: [f64; 3]) -> FreeRotation {
    FreeRotation::new(&Inertia::principal(moments).unwrap(), Attitude::identity(), Vector3::from(omega)).unwrap()
}

#[test]
fn motion_follows_its_reference() {
    let golden = golden::load("trajectories");
    let mut compared = 0;
    for case in golden.cases.iter().filter(|case| golden::text(&case["system"]) == "free_rigid_body") {
        let start = golden::vector(&case["initial_state"]);
        let inertia = Inertia::principal([1.0, 2.0, 3.0]).unwrap();
        let attitude = Attitude::from_matrix(&Matrix3::from_row_slice(&start[3..])).unwrap();
        let motion = FreeRotation::new(&inertia, attitude, Vector3::from_column_slice(&start[..3])).unwrap();
        for (index, state) in case["states"].as_array().unwrap().iter().enumerate() {
            let expected = golden::vector(&state["state"]);
            let (attitude, omega) = motion.at(golden::number(&state["t"]));
            let sensitivity = golden::number(&case["sensitivity"][index]).max(1.0);
            let tolerance = Tol::ulps(16.0).times(sensitivity);
            assert_close("ω", omega.as_slice(), &expected[..3], tolerance);
            assert_close("Q", attitude.to_matrix().transpose().as_slice(), &expected[3..], tolerance);
            compared += 1;
        }
    }
    assert_eq!(compared, 8);
}

/// The invariants of the reference, and its closed form in Jacobi's functions by period and parameter.
#[test]
fn invariants_and_period_are_those_of_the_reference() {
    let golden = golden::load("trajectories");
    let mut compared = 0;
    for case in golden.cases.iter().filter(|case| golden::text(&case["system"]) == "free_rigid_body") {
        let start = golden::vector(&case["initial_state"]);
        let inertia = Inertia::principal([1.0, 2.0, 3.0]).unwrap();
        let attitude = Attitude::from_matrix(&Matrix3::from_row_slice(&start[3..])).unwrap();
        let motion = FreeRotation::new(&inertia, attitude, Vector3::from_column_slice(&start[..3])).unwrap();
        let expected = &case["invariants"];
        for t in [0.0, 0.1, 1.0, 5.0, 10.0] {
            let (attitude, omega) = motion.at(t);
            let spin = inertia.times(&omega);
            let energy = 0.5 * omega.dot(&spin);
            let tolerance = Tol::ulps(32.0);
            assert_close("energy", &[energy], &[golden::number(&expected["energy"])], tolerance);
            assert_close("|H|²", &[spin.norm_squared()], &[golden::number(&expected["H_squared"])], tolerance);
            let in_space = attitude.to_space(&spin);
            assert_close("H", in_space.as_slice(), &golden::vector(&expected["H_space"]), tolerance);
            compared += 1;
        }
        let jacobi = &case["jacobi"];
        let of = |name: &str| golden::number(&jacobi[name]);
        // 4K(m)/p by the arithmetic-geometric mean.
        let (mut a, mut b) = (1.0, (1.0 - of("m_parameter")).sqrt());
        for _ in 0..6 {
            (a, b) = (0.5 * (a + b), f64::sqrt(a * b));
        }
        let period = 2.0 * std::f64::consts::PI / (a * of("rate"));
        let tolerance = Tol::ulps(16.0).times(1.0 / (1.0 - of("m_parameter")));
        assert_close("period", &[motion.period()], &[period], tolerance);
        let (size, half) = ([of("w1m"), of("w2m"), of("w3m")], motion.at(0.5 * motion.period()).1);
        for i in 0..3 {
            assert!(half[i].abs() <= size[i] * (1.0 + 64.0 * f64::EPSILON), "ω{i} = {} of {}", half[i], size[i]);
        }
        assert!(golden::text(&jacobi["form"]).contains("cn") && of("u0").is_finite());
    }
    assert_eq!(compared, 10);
}

/// Ten million steps of a hundredth of a radian, each evaluated from the start; every thousandth is looked at.
#[test]
fn energy_and_angular_momentum_are_kept_for_ten_million_steps() {
    for (moments, omega) in [([1.0, 2.0, 2.5], [0.3, 1.0, 0.2]), ([1.0, 2.0, 3.0], [1.0 / 64.0, 2.0, 1.0 / 32.0])] {
        let inertia = Inertia::principal(moments).unwrap();
        let motion = motion(moments, omega);
        let spin = |omega: Vector3<f64>| inertia.times(&omega);
        let (before, energy) = (spin(Vector3::from(omega)), Vector3::from(omega).dot(&spin(Vector3::from(omega))));
        for step in (0..10_000_000).step_by(1000) {
            let (attitude, omega) = motion.at(0.01 * f64::from(step));
            let now = spin(omega);
            assert!((omega.dot(&now) / energy - 1.0).abs() < 1e-14);
            assert!((now.norm() / before.norm() - 1.0).abs() < 1e-14);
            assert!((attitude.to_space(&now) - before).norm() < 1e-14 * before.norm());
        }
    }
}

/// About its axis a symmetric body precesses: in space about H with H/I₁, in itself about the axis with (1/I₃ − 1/I₁) H₃.
#[test]
fn symmetric_bodies_precess_regularly() {
    for omega in [[0.6, -0.8, 2.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0], [1.0, 0.5, 1e-9]] {
        let (side, top) = (1.0, 1.5);
        let motion = motion([side, side, top], omega);
        let spin = Vector3::new(side * omega[0], side * omega[1], top * omega[2]);
        for t in [0.0, 0.1, 3.0, 17.0, -5.0] {
            let precession = Attitude::from_rotation_vector(&(spin * (t / side)));
            let own = Attitude::about_z((1.0 / top - 1.0 / side) * spin.z * t);
            let (attitude, after) = motion.at(t);
            let tolerance = Tol::ulps(64.0);
            let (found, expected) = (attitude.to_matrix(), precession.product(own).to_matrix());
            assert_close(&format!("{omega:?} after {t}"), found.as_slice(), expected.as_slice(), tolerance);
            let expected = own.to_body(&Vector3::from(omega));
            assert_close("ω", after.as_slice(), expected.as_slice(), tolerance);
        }
    }
}

#[test]
fn spins_about_principal_axes_stay_and_rest_stays_rest() {
    for moments in INERTIAS {
        for axis in 0..3 {
            let mut omega = [0.0; 3];
            omega[axis] = -1.5;
            let motion = motion(moments, omega);
            let (attitude, after) = motion.at(7.0);
            assert_close("ω", after.as_slice(), &omega, Tol::ulps(4.0));
            let expected = Attitude::from_rotation_vector(&(Vector3::from(omega) * 7.0));
            assert_close("Q", attitude.to_matrix().as_slice(), expected.to_matrix().as_slice(), Tol::ulps(64.0));
        }
        let (attitude, after) = motion(moments, [0.0; 3]).at(7.0);
        assert_eq!((attitude, after), (Attitude::identity(), Vector3::zeros()));
    }
}

/// On the boundary between the two kinds of motion ω tends to the middle axis: there tanh and 1/cosh rule.
#[test]
fn motion_that_tends_to_the_middle_axis_is_that_of_hyperbolic_functions() {
    // I = 1, 2, 3: H² = 2E I₂ where H₁² (I₂ − I₁)/I₁ = H₃² (I₃ − I₂)/I₃: ω₁² = 3 ω₃² … of exact doubles: ω₁ = 3k, I₁ = 1, I₃ = 9/4.
    let motion = motion([1.0, 2.0, 2.25], [0.5, 0.0, 2.0 / 3.0]);
    let period = motion.period();
    assert!(period.is_infinite() || 80.0 < period, "{period}");
    // ω₂ = Ω tanh(pt), 2Ω = H.
    let size = 0.25_f64 + 2.25;
    let (spin, rate) = (size.sqrt() / 2.0, 0.5 * (2.0_f64 / 3.0) * (2.25 - 1.0) / 2.0 / (size.sqrt() / 2.0));
    for t in [0.5, 2.0, 5.0, -3.0] {
        let (_, omega) = motion.at(t);
        let expected = [0.5 / (rate * t).cosh(), spin * (rate * t).tanh(), 2.0 / 3.0 / (rate * t).cosh()];
        assert_close_at_scale("ω", omega.as_slice(), &expected, 1.0, Tol::ulps(256.0));
    }
}

#[test]
fn period_is_the_time_after_which_the_angular_velocity_returns() {
    for moments in INERTIAS {
        let motion = motion(moments, [0.5, 0.25, -1.0]);
        let period = motion.period();
        if period.is_finite() {
            let (_, after) = motion.at(period);
            assert_close("ω", after.as_slice(), &[0.5, 0.25, -1.0], Tol::ulps(64.0));
            let (_, half) = motion.at(0.5 * period);
            assert!(0.1 < (half - Vector3::new(0.5, 0.25, -1.0)).norm());
        }
    }
}

#[test]
fn what_is_not_finite_is_refused() {
    let inertia = Inertia::principal([1.0, 2.0, 2.5]).unwrap();
    let refused = FreeRotation::new(&inertia, Attitude::identity(), Vector3::new(1.0, f64::NAN, 0.0));
    assert!(matches!(refused, Err(KinematicsError::NotFinite { quantity: "angular velocity", index: 1, .. })));
    let broken = Attitude { w: f64::INFINITY, x: 0.0, y: 0.0, z: 0.0 };
    assert!(matches!(
        FreeRotation::new(&inertia, broken, Vector3::zeros()),
        Err(KinematicsError::NotFinite { quantity: "attitude", index: 0, .. })
    ));
}

proptest! {
    /// The motion from what it has come to is the rest of the motion, in any body axes, from any attitude.
    #[test]
    fn motion_goes_on_from_where_it_is(
        kind in 0_usize..7, turned in rotation(), start in rotation(), omega in vector(3, -2.0..2.0), t in -3.0_f64..3.0,
    ) {
        let inertia = Inertia::principal(INERTIAS[kind]).unwrap().rotated(Attitude::from_quaternion(turned).unwrap());
        let attitude = Attitude::from_quaternion(start).unwrap();
        let motion = FreeRotation::new(&inertia, attitude, Vector3::from_column_slice(&omega)).unwrap();
        let (middle, velocity) = motion.at(t);
        let (end, after) = motion.at(2.5 * t);
        let rest = FreeRotation::new(&inertia, middle, velocity).unwrap();
        let (other, other_after) = rest.at(1.5 * t);
        let tolerance = Tol::stated(1e-12, "rounding of the start and of the axes, which the motion enlarges");
        assert_close_at_scale("Q", other.to_matrix().as_slice(), end.to_matrix().as_slice(), 1.0, tolerance);
        assert_close_at_scale("ω", other_after.as_slice(), after.as_slice(), 1.0, tolerance);
        // Euler's equations, by a central difference of H in space.
        let spin = |(attitude, omega): (Attitude<f64>, Vector3<f64>)| attitude.to_space(&inertia.times(&omega));
        let scale = inertia.times(&velocity).norm();
        prop_assert!((spin((end, after)) - spin((middle, velocity))).norm() <= 1e-13 * scale.max(1e-3));
        let h = 1e-4;
        let [back, on] = [motion.at(t - h).0, motion.at(t + h).0];
        let turned = back.conjugate().product(on).rotation_vector() / (2.0 * h);
        prop_assert!((turned - velocity).norm() < 1e-6, "{turned} and {velocity}");
    }
}
