//! Poses in glam's types against the same poses in nalgebra's.

use glam::{DQuat, DVec3};
use nalgebra::Vector3;
use piola_kinematics::{Attitude, BodyPose, Pose};
use piola_testkit::strategies::{rotation, vector};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use proptest::prelude::*;

const FEW: Tol = Tol::ulps(16.0);

fn pose() -> impl Strategy<Value = BodyPose<f64>> {
    (vector(3, -2.0..2.0), rotation()).prop_map(|(x, q)| BodyPose {
        position: Vector3::from_column_slice(&x),
        attitude: Attitude::from_quaternion(q).expect("a unit quaternion"),
    })
}

fn close(what: &str, actual: Pose, expected: &BodyPose<f64>) {
    let back = BodyPose::from(actual);
    assert_close_at_scale(what, back.position.as_slice(), expected.position.as_slice(), 8.0, FEW);
    assert_close(what, &<[f64; 4]>::from(back.attitude), &<[f64; 4]>::from(expected.attitude), FEW);
}

proptest! {
    #[test]
    fn pose_in_glam_equals_pose_in_nalgebra(a in pose(), b in pose(), y in vector(3, -2.0..2.0)) {
        let (first, second) = (Pose::from(a), Pose::from(b));
        close("there and back", first, &a);
        close("product", first.product(second), &a.product(&b));
        close("inverse", first.inverse(), &a.inverse());
        let (point, in_glam) = (Vector3::from_column_slice(&y), DVec3::new(y[0], y[1], y[2]));
        let expected = a.embedded_point(&point);
        assert_close_at_scale("to space", &first.to_space(in_glam).to_array(), expected.as_slice(), 8.0, FEW);
        let expected = a.point_in_body(&point);
        assert_close_at_scale("to body", &first.to_body(in_glam).to_array(), expected.as_slice(), 8.0, FEW);
    }
}

#[test]
fn quaternion_of_glam_is_stored_with_the_scalar_last() {
    let attitude = Attitude { w: 0.5, x: -0.5, y: 0.5, z: -0.5 };
    let rotation = DQuat::from(attitude);
    assert_eq!(rotation.to_array().map(f64::to_bits), [-0.5_f64, 0.5, -0.5, 0.5].map(f64::to_bits));
    assert_eq!(Attitude::from(rotation), attitude);
}
