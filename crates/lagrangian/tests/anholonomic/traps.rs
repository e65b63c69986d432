//! What must be refused, and how it is named.

use piola_integrators::Tolerance;
use piola_lagrangian::anholonomic::rolling::{KnifeEdge, RollingDisc, RollingSphere};
use piola_lagrangian::anholonomic::{AnholonomicFrame, BodyAngularVelocity, ByCoframe, structure_coefficients};
use piola_lagrangian::{AnholonomicError, Lagrangian, LagrangianError, LagrangianFunction, Workspace};
use piola_numerics::Real;
use piola_testkit::{Tol, assert_close_at_scale};

use crate::systems::{All, Applied, Forms, Frame, System, all, body};

fn top() -> All {
    all(System::Top(body(1.0, [1.0, 1.5, 2.0])), [0.0; 3], 1.0, Applied { constant: [0.0; 3], drag: 0.0 })
}

#[test]
fn gimbal_point_is_a_singular_frame_and_names_the_combination_that_vanishes() {
    let spin = top().in_coframe(Forms::Body(BodyAngularVelocity::default()));
    let theta = [0.5, 0.0, 0.25];
    let error = spin.acceleration(&theta, &[1.0, 0.0, 0.0], 0.0).unwrap_err();
    let LagrangianError::Anholonomic(AnholonomicError::SingularFrame { index: 1, combination, .. }) = error else {
        panic!("{error}")
    };
    // Σ c_A W^A_C = 0: at θ² = 0 no rate of an angle turns about that line of the body.
    let w = piola_kinematics::EulerAngles::zyz(theta).rate_matrix();
    let sum: Vec<f64> = (0..3).map(|c| (0..3).map(|a| combination[a] * w[(a, c)]).sum()).collect();
    assert_close_at_scale("Σ c_A u^A", &sum, &[0.0; 3], 1.0, Tol::ulps(8.0));
    let error = structure_coefficients(&ByCoframe(BodyAngularVelocity::default()), &theta, 0.0).unwrap_err();
    assert!(matches!(error, LagrangianError::Anholonomic(AnholonomicError::SingularFrame { .. })));
}

#[test]
fn frame_without_vectors_or_with_dependent_ones_is_singular() {
    let nothing = top().in_frame(Frame::Nothing);
    let error = nothing.acceleration(&[0.5, 1.0, 0.0], &[1.0, 0.0, 0.0], 0.0).unwrap_err();
    assert!(matches!(error, LagrangianError::Anholonomic(AnholonomicError::SingularFrame { index: 0, .. })), "{error}");
    let error = nothing.quasi_velocities(&[0.5, 1.0, 0.0], &[1.0, 0.0, 0.0], 0.0).unwrap_err();
    assert!(matches!(error, LagrangianError::Anholonomic(AnholonomicError::SingularFrame { index: 0, .. })), "{error}");
    // All nine entries 2 sin 1 on the diagonal and off it: rows 0 and 1 are the same.
    let equal = Frame::Equal;
    let error = top().in_frame(equal).acceleration(&[0.5, 1.0, 0.0], &[1.0, 0.0, 0.0], 0.0).unwrap_err();
    let LagrangianError::Anholonomic(AnholonomicError::SingularFrame { index: 1, combination, .. }) = error else {
        panic!("{error}")
    };
    assert_close_at_scale("combination", &combination, &[-1.0, 1.0, 0.0], 1.0, Tol::ulps(8.0));
}

#[test]
fn singular_chart_below_a_regular_frame_is_a_singular_metric() {
    let error = top().in_frame(Frame::Blade).acceleration(&[0.5, 0.0, 0.0], &[1.0, 0.0, 0.0], 0.0).unwrap_err();
    assert!(matches!(error, LagrangianError::SingularMetric { .. }), "{error}");
}

#[test]
fn disc_flat_on_the_plane_is_refused() {
    let disc = RollingDisc::homogeneous(2.0, 0.5).unwrap().on_plane([0.0, 0.0, -9.8]);
    let error = disc.acceleration(&[0.0; 5], &[1.0, 0.0, 0.0], 0.0).unwrap_err();
    assert!(matches!(error, LagrangianError::SingularMetric { .. }), "{error}");
    let tolerance = Tolerance::relative(1e-10).unwrap();
    let error = disc.integrate(&[0.0; 5], &[1.0, 0.0, 0.0], 0.0..1.0, tolerance).unwrap_err();
    assert!(error.to_string().contains("the motion along"), "{error}");
    let error = disc.integrate(&[f64::NAN; 5], &[1.0, 0.0, 0.0], 0.0..1.0, tolerance).unwrap_err();
    assert!(matches!(error, LagrangianError::NotFinite { quantity: "q", index: 0, .. }), "{error}");
}

#[test]
fn held_quasi_velocities_are_checked() {
    let twice = top().in_frame(Frame::Blade).holding(&[1, 0, 1]).unwrap_err();
    assert_eq!(twice, LagrangianError::Anholonomic(AnholonomicError::HeldTwice { index: 1 }));
    let beyond = top().in_frame(Frame::Blade).holding(&[3]).unwrap();
    let error = beyond.acceleration(&[0.5, 1.0, 0.0], &[1.0, 0.0], 0.0).unwrap_err();
    assert_eq!(error, LagrangianError::Anholonomic(AnholonomicError::NoSuchQuasiVelocity { index: 3, count: 3 }));
    assert!(top().in_frame(Frame::Blade).holding_at(&[(0, f64::NAN)]).is_err());
    let held = top().in_frame(Frame::Blade).holding(&[2]).unwrap();
    let error = held.acceleration(&[0.5, 1.0, 0.0], &[1.0, 0.0, 0.0], 0.0).unwrap_err();
    assert!(matches!(error, LagrangianError::WrongLength { expected: 2, found: 3, .. }), "{error}");
}

#[test]
fn values_that_are_not_finite_are_refused_by_name() {
    let spin = top().in_coframe(Forms::Body(BodyAngularVelocity::default()));
    let named = |q: [f64; 3], u: [f64; 3]| match spin.acceleration(&q, &u, 0.0).unwrap_err() {
        LagrangianError::NotFinite { quantity, index, .. } => (quantity, index),
        error => panic!("{error}"),
    };
    assert_eq!(named([0.5, f64::NAN, 0.0], [0.0; 3]), ("q", 1));
    assert_eq!(named([0.5, 1.0, 0.0], [0.0, 0.0, f64::INFINITY]), ("u", 2));
    let error = spin.velocities(&[0.5, 1.0, 0.0], &[0.0; 3], f64::NAN).unwrap_err();
    assert!(matches!(error, LagrangianError::NotFinite { quantity: "t", index: 0, .. }));
    let error = spin.quasi_velocities(&[0.5, 1.0, 0.0], &[f64::NAN, 0.0, 0.0], 0.0).unwrap_err();
    assert!(matches!(error, LagrangianError::NotFinite { quantity: "q̇", index: 0, .. }));
    // A quaternion of no length is no attitude.
    let sphere = RollingSphere::homogeneous(1.0, 0.5).unwrap().on_plane([0.0, 0.0, -9.8]);
    assert!(sphere.acceleration(&[0.0; 6], &[1.0, 0.0, 0.0], 0.0).is_err());
}

#[test]
fn bodies_that_cannot_roll_are_refused() {
    for radius in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = RollingDisc::homogeneous(1.0, radius).unwrap_err();
        assert!(
            matches!(error, LagrangianError::Anholonomic(AnholonomicError::InvalidLength { quantity: "radius", .. })),
            "{error}"
        );
        assert!(RollingSphere::homogeneous(1.0, radius).is_err());
    }
    assert!(RollingDisc::homogeneous(-1.0, 1.0).is_err());
    assert!(RollingSphere::homogeneous(1.0, 1.0).unwrap().on_turntable(f64::NAN).is_err());
    assert!(KnifeEdge::new(1.0, 0.0, 0.5).is_err());
    assert!(KnifeEdge::new(1.0, 1.0, f64::NAN).is_err());
    assert!(RollingDisc::homogeneous(1.0, 1.0).unwrap().steady_spin(0.0, 1.0, 9.8).is_err());
}

#[cfg(feature = "serde")]
#[test]
fn what_is_read_equals_what_was_written_and_is_checked() {
    let sphere = RollingSphere::homogeneous(1.0, 0.5).unwrap().on_turntable(2.0).unwrap();
    let text = serde_json::to_string(&sphere).unwrap();
    assert_eq!(serde_json::from_str::<RollingSphere>(&text).unwrap(), sphere);
    assert!(serde_json::from_str::<RollingSphere>(&text.replace("\"radius\":0.5", "\"radius\":-0.5")).is_err());
    let disc = RollingDisc::hoop(1.0, 0.5).unwrap();
    let text = serde_json::to_string(&disc).unwrap();
    assert_eq!(serde_json::from_str::<RollingDisc>(&text).unwrap(), disc);
    assert!(serde_json::from_str::<RollingDisc>(&text.replace("\"radius\":0.5", "\"radius\":0.0")).is_err());
    let edge = KnifeEdge::new(1.0, 0.5, -0.25).unwrap();
    let text = serde_json::to_string(&edge).unwrap();
    assert_eq!(serde_json::from_str::<KnifeEdge>(&text).unwrap(), edge);
}

#[test]
fn metric_of_a_lagrangian_function_is_refused_and_its_mass_matrix_is_given() {
    struct Polar; // L = ½·2 (ṙ² + r² φ̇²)
    impl LagrangianFunction for Polar {
        fn lagrangian<T: Real>(&self, q: &[T], v: &[T], _t: T) -> T {
            v[0] * v[0] + q[0] * q[0] * v[1] * v[1]
        }
    }
    struct Unit;
    impl AnholonomicFrame for Unit {
        fn frame<T: Real>(&self, q: &[T], _t: T, rows: &mut [T]) {
            rows.copy_from_slice(&[T::one(), T::zero(), T::zero(), q[0].recip()]);
        }
    }
    let q = [3.0, 0.0];
    let (mut work, mut matrix, mut forcing) = (Workspace::default(), [0.0; 4], [0.0; 2]);
    let free = Lagrangian::from_function(Polar);
    assert_eq!(free.inertia_metric_into(&mut work, &q, 0.0, &mut matrix), Err(LagrangianError::NoParts));
    assert_eq!(free.inertia_metric(&q, 0.0).unwrap_err(), LagrangianError::NoParts);
    assert_eq!(free.christoffel_first(&q, 0.0).unwrap_err(), LagrangianError::NoParts);
    assert_eq!(free.christoffel_second(&q, 0.0).unwrap_err(), LagrangianError::NoParts);
    assert_eq!(free.lower(&q, &[1.0, 2.0], 0.0).unwrap_err(), LagrangianError::NoParts);
    free.equations_into(&mut work, &q, &[0.0, 1.0], 0.0, &mut matrix, &mut forcing).unwrap();
    assert_close_at_scale("∂²L/∂q̇∂q̇", &matrix, &[2.0, 0.0, 0.0, 18.0], 18.0, Tol::ulps(4.0));
    let framed = free.in_frame(Unit);
    assert_eq!(framed.inertia_metric(&q, 0.0).unwrap_err(), LagrangianError::NoParts);
    // The equations are those of the function: r̈ = u₂²/r.
    assert_close_at_scale(
        "u̇",
        framed.acceleration(&q, &[0.0, 6.0], 0.0).unwrap().as_slice(),
        &[12.0, 0.0],
        12.0,
        Tol::ulps(8.0),
    );
}
