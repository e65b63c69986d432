//! Evaluations with a workspace allocate nothing once it has been used.

use piola_integrators::Field;
use piola_lagrangian::Reaction;
use piola_lagrangian::anholonomic::rolling::RollingDisc;
use piola_lagrangian::anholonomic::{BodyAngularVelocity, Workspace};
use piola_testkit::allocations_in;

use crate::systems::{Applied, Forms, Frame, System, all, body};

#[test]
fn evaluations_with_a_workspace_allocate_nothing() {
    let disc = RollingDisc::homogeneous(2.0, 0.5).unwrap().on_plane([0.0, 0.0, -9.8]);
    let applied = || Applied { constant: [0.5; 3], drag: 0.25 };
    let top = all(System::Top(body(1.0, [1.0, 1.5, 2.0])), [0.0; 3], 1.0, applied());
    let top = top.in_coframe(Forms::Body(BodyAngularVelocity::default()));
    let bent = all(System::Bent(1.0), [0.0; 3], 1.0, applied()).in_frame(Frame::Smooth);
    let (q, w) = ([0.0, 0.0, 0.3, 1.2, 0.0], [0.5, 0.25, 6.0]);
    let (theta, u) = ([0.25, 0.75, -0.5], [1.0, -2.0, 3.0]);
    let y: Vec<f64> = q.iter().chain(&w).copied().collect();
    let mut work = Workspace::default();
    let mut motion = disc.motion(5);
    let (mut three, mut two, mut rate) = ([0.0; 3], [0.0; 2], [0.0; 8]);
    let mut held = [Reaction::none()];
    let mut evaluate = || {
        disc.acceleration_into(&mut work, &q, &w, 0.0, &mut three).unwrap();
        disc.reactions_into(&mut work, &q, &w, 0.0, &mut two).unwrap();
        disc.part_reactions_into(&mut work, &q, &w, 0.0, &mut held).unwrap();
        motion.rate(0.0, &y, &mut rate).unwrap();
        top.acceleration_into(&mut work, &theta, &u, 0.0, &mut three).unwrap();
        bent.acceleration_into(&mut work, &theta, &u, 0.0, &mut three).unwrap();
        bent.velocities_into(&mut work, &theta, &u, 0.0, &mut three).unwrap();
    };
    evaluate();
    assert_eq!(allocations_in(evaluate).0, 0);
}
