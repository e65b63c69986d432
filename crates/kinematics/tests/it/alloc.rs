//! Evaluations allocate nothing.

use nalgebra::Vector3;
use piola_kinematics::curve::{Curve, Frenet};
use piola_kinematics::particle::Motion;
use piola_kinematics::placement::PlacementEvaluator;
use piola_kinematics::{
    Attitude, BodyMotion, BodyPose, BodyVelocity, EulerAngles, EulerChart, EulerSequence, Inertia, ParticleSystem,
    RotationVector,
};
use piola_numerics::Real;
use piola_testkit::allocations_in;

use crate::systems::TopOnTable;

#[test]
fn placement_evaluations_allocate_nothing() {
    let system = TopOnTable::new();
    let mut evaluator = PlacementEvaluator::new(4);
    let (q, qdot, qddot) = ([0.1, 0.7, -0.3, 1.2], [0.5, -0.2, 3.0, 0.1], [0.0, 0.1, 0.2, 0.3]);
    let (allocations, ()) = allocations_in(|| {
        let (mut x, mut pose) = ([Vector3::zeros()], [BodyPose::at_rest()]);
        let (mut v, mut velocity) = ([Vector3::zeros()], [BodyVelocity::at_rest()]);
        let (mut a, mut motion) = ([Motion::at_rest()], [BodyMotion::at_rest()]);
        for step in 0..100_i32 {
            let t = f64::from(step);
            evaluator.positions_into(&system, &q, t, &mut x, &mut pose).expect("positions");
            evaluator.velocities_into(&system, &q, &qdot, t, &mut v, &mut velocity).expect("velocities");
            evaluator.tangent_into(&system, &q, t, 4, &mut v, &mut velocity).expect("tangent");
            evaluator.motions_into(&system, &q, &qdot, &qddot, t, &mut a, &mut motion).expect("motions");
        }
    });
    assert_eq!(allocations, 0);
}

#[test]
fn attitudes_inertia_systems_and_curves_allocate_nothing() {
    struct Helix;
    impl Curve for Helix {
        fn position<T: Real>(&self, t: T) -> Vector3<T> {
            let (s, c) = t.sin_cos();
            Vector3::new(c, s, t)
        }
    }
    let points = [Vector3::new(1.0, 0.0, 0.5), Vector3::new(0.0, 2.0, 0.0), Vector3::new(-1.0, 0.3, 0.0)];
    let (allocations, ()) = allocations_in(|| {
        let attitude = Attitude::from_rotation_vector(&points[0]);
        let _ = EulerAngles::of_attitude(EulerSequence::Zyz, attitude).angles().rates(&points[1]).expect("regular");
        let chart = EulerAngles::of_attitude(EulerSequence::Zyx, attitude).angles();
        let mut chart = EulerChart::new(chart, [0.1, 0.2, 0.3], 2.0).expect("a chart");
        let _ = chart.change_if_degraded().expect("finite");
        let _ = RotationVector(points[0]).rate_from_body(&points[1]);
        let _ = Inertia::principal([1.0, 2.0, 2.5]).expect("a body").rotated(attitude).principal_axes();
        let system = ParticleSystem::new(&[1.0, 2.0, 3.0], &points, &points).expect("a system");
        let _ = (system.kinetic_energy(), system.angular_momentum(&points[0]), system.inertia_about_centre_of_mass());
        let _ = system.rates(&points, &points[0]).expect("rates");
        let _ = Frenet::of_curve(&Helix, 1.0).expect("a frame");
    });
    assert_eq!(allocations, 0);
}
