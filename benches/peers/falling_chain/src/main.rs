//! A chain of rods falls from the horizontal by the multibody joints of rapier3d: what becomes of its energy.
//!
//! ```sh
//! cd benches/peers/falling_chain && cargo run --release -- 100 10
//! ```
//!
//! Arguments: links, seconds. The rods are those of `cargo run --release -p piola-multibody --example falling_chain`: 1 m and 1 kg,
//! axes y, a step of 1 ms, double precision, damping zero. The error of the energy is the largest of the run, over m g l of one rod.

use std::time::Instant;

use rapier3d_f64::prelude::*;

const GRAVITY: f64 = 9.81;
const MOMENTS: [f64; 3] = [0.084, 0.084, 0.0013];

fn main() {
    let mut arguments = std::env::args().skip(1).filter_map(|argument| argument.parse::<usize>().ok());
    let (links, seconds) = (arguments.next().unwrap_or(20), arguments.next().unwrap_or(1));
    let (mut bodies, mut colliders) = (RigidBodySet::new(), ColliderSet::new());
    let (mut joints, mut impulses) = (MultibodyJointSet::new(), ImpulseJointSet::new());
    let mut parent = bodies.insert(RigidBodyBuilder::fixed());
    let mut rods = Vec::new();
    for i in 0..links {
        let inertia = MassProperties::new(Vector::new(0.0, 0.0, -0.5), 1.0, AngVector::from(MOMENTS));
        // A quarter turn about y takes −z to −x.
        let rod = RigidBodyBuilder::dynamic()
            .translation(Vector::new(-(i as f64), 0.0, 0.0))
            .rotation(AngVector::new(0.0, core::f64::consts::FRAC_PI_2, 0.0))
            .additional_mass_properties(inertia)
            .can_sleep(false);
        let rod = bodies.insert(rod);
        let end = if i == 0 { 0.0 } else { -1.0 };
        let mut joint: GenericJoint = RevoluteJointBuilder::new(Vector::Y)
            .local_anchor1(Vector::new(0.0, 0.0, end))
            .local_anchor2(Vector::new(0.0, 0.0, 0.0))
            .build()
            .into();
        joint.contacts_enabled = false;
        if i == 0 {
            // The joint's coordinate starts at zero: its frame on the ground is turned as the rods are.
            joint.local_frame1.rotation =
                Rotation::from_rotation_y(core::f64::consts::FRAC_PI_2) * joint.local_frame1.rotation;
        }
        let Some(handle) = joints.insert(parent, rod, joint, true) else { panic!("no joint {i}") };
        if let Some((multibody, _)) = joints.get_mut(handle) {
            multibody.damping_mut().fill(0.0);
        }
        rods.push(rod);
        parent = rod;
    }
    let energy = |bodies: &RigidBodySet| -> f64 {
        rods.iter()
            .map(|&rod| {
                let rod = &bodies[rod];
                let (v, w, height) = (rod.linvel(), rod.angvel(), rod.center_of_mass().z);
                // All motion is in the plane across y.
                0.5 * v.dot(v) + 0.5 * MOMENTS[1] * w.dot(w) + GRAVITY * height
            })
            .sum()
    };
    let parameters = IntegrationParameters { dt: 1e-3, ..IntegrationParameters::default() };
    let (mut pipeline, mut islands, mut ccd) = (PhysicsPipeline::new(), IslandManager::new(), CCDSolver::new());
    let (mut broad, mut narrow) = (BroadPhaseBvh::new(), NarrowPhase::new());
    let first = energy(&bodies);
    let mut worst = 0.0_f64;
    println!("| links | s | largest error of the energy, m g l | time, s |");
    println!("|---|---|---|---|");
    let clock = Instant::now();
    for step in 0..1000 * seconds {
        pipeline.step(
            Vector::new(0.0, 0.0, -GRAVITY),
            &parameters,
            &mut islands,
            &mut broad,
            &mut narrow,
            &mut bodies,
            &mut colliders,
            &mut impulses,
            &mut joints,
            &mut ccd,
            &(),
            &(),
        );
        let error = (energy(&bodies) - first).abs() / GRAVITY;
        worst = worst.max(if error.is_finite() { error } else { f64::INFINITY });
        if (step + 1) % 1000 == 0 {
            println!("| {links} | {} | {worst:.1e} | {:.1} |", (step + 1) / 1000, clock.elapsed().as_secs_f64());
        }
    }
}
