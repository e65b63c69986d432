//! Convergence of finite differences to the exact derivatives: slopes, not errors.

use nalgebra::Vector3;
use piola_kinematics::placement::PlacementEvaluator;
use piola_kinematics::{BodyPose, BodyVelocity};
use piola_testkit::{Tol, assert_close};

use crate::systems::TopOnTable;

#[test]
fn central_differences_of_positions_converge_to_velocities_at_order_two() {
    let system = TopOnTable::new();
    let mut evaluator = PlacementEvaluator::new(4);
    let (q, qdot, t) = ([0.1, 0.7, -0.3, 1.2], [0.5, -0.2, 3.0, 0.1], 0.4);
    let (mut v, mut body) = ([Vector3::zeros()], [BodyVelocity::at_rest()]);
    evaluator.velocities_into(&system, &q, &qdot, t, &mut v, &mut body).expect("velocities");
    let mut centre = |h: f64| {
        let moved: Vec<f64> = q.iter().zip(qdot).map(|(q, v)| q + h * v).collect();
        let (mut x, mut pose) = ([Vector3::zeros()], [BodyPose::at_rest()]);
        evaluator.positions_into(&system, &moved, t + h, &mut x, &mut pose).expect("positions");
        pose[0].position
    };
    let mut error = |h: f64| ((centre(h) - centre(-h)) / (2.0 * h) - body[0].velocity).norm();
    let h = 2.0_f64.powi(-8);
    let order = (error(h) / error(0.5 * h)).log2();
    let reason =
        Tol::stated(1.0e-3, "the next term of the error is h² ≈ 1.5e-5 of the leading one, times its coefficient");
    assert_close("observed order", &[order], &[2.0], reason);
}
