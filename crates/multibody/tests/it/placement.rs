//! Trees against the placement path: the same bodies as particles, by Lagrange's equations.

use nalgebra::{Matrix3, Vector3};
use piola_lagrangian::{Holonomic, Lagrangian, Placement, Reaction, Workspace};
use piola_multibody::{BodyIndex, BodyInertia, JointKind, JointReaction, RigidTree, TreeJoint};
use piola_numerics::Real;
use piola_testkit::{Tol, assert_close};

use crate::trees::{State, odd_body, state_of};

/// A tree in coordinates δ about a configuration: six particles in the place of each body.
struct Particles {
    tree: RigidTree,
    q: Vec<f64>,
    bodies: Vec<(BodyIndex, BodyInertia)>,
}

impl Holonomic for Particles {
    fn place<T: Real>(&self, delta: &[T], _t: T, bodies: &mut impl Placement<T>) {
        let mut q: Vec<T> = self.q.iter().map(|&q| T::lit(q)).collect();
        self.tree.move_configuration(&mut q, delta).unwrap();
        let mut work = self.tree.workspace();
        self.tree.forward_kinematics(&mut work, &q).unwrap();
        for (body, inertia) in &self.bodies {
            let place = self.tree.place_of(&work, *body).unwrap();
            // Σ mᵢ rᵢ rᵢᵀ = ½ tr(I) 1 − I: two particles of m/6 on each principal axis.
            let about_centre = Matrix3::from(inertia.about_centre());
            let second = Matrix3::identity() * (0.5 * about_centre.trace()) - about_centre;
            let eigen = second.symmetric_eigen();
            for (axis, value) in eigen.eigenvectors.column_iter().zip(eigen.eigenvalues.iter()) {
                for sign in [1.0, -1.0] {
                    let distance = sign * (3.0 * value / inertia.mass()).sqrt();
                    let point: [f64; 3] = core::array::from_fn(|i| inertia.centre()[i] + distance * axis[i]);
                    let at =
                        |i: usize| (0..3).fold(place.origin[i], |sum, k| sum + place.rotation[i][k] * T::lit(point[k]));
                    bodies.particle(inertia.mass() / 6.0, Vector3::new(at(0), at(1), at(2)));
                }
            }
        }
    }
}

fn compare(kinds: &[JointKind], parents: &[usize]) {
    let mut builder = RigidTree::builder();
    let mut bodies: Vec<(BodyIndex, BodyInertia)> = Vec::new();
    for (i, (&kind, &parent)) in kinds.iter().zip(parents).enumerate() {
        let parent = if parent == 0 { BodyIndex::GROUND } else { bodies[parent - 1].0 };
        let turn = piola_kinematics::Attitude::from_euler_zyz([0.3 + i as f64, 0.7, -0.4]);
        let joint = TreeJoint::new(format!("joint {i}"), kind).at([0.1, -0.3, 0.4]).turned(turn);
        let inertia = odd_body(i as u64 + 40);
        bodies.push((builder.attach(parent, joint, format!("body {i}"), inertia).unwrap(), inertia));
    }
    let tree = builder.build().unwrap();
    let state = state_of(&tree, 77);
    let n = tree.freedoms();
    let lagrangian = Lagrangian::of(Particles { tree: tree.clone(), q: state.q.clone(), bodies }).with_gravity(9.81);
    let mut work = tree.workspace();
    let (mut tau, mut a) = (vec![0.0; n], vec![0.0; n]);
    let zero = vec![0.0; n];
    tree.inverse_dynamics(&mut work, &state.q, &state.v, &state.a, &mut tau).unwrap();
    let expected = lagrangian.driving_forces(&zero, &state.v, &state.a, 0.0).unwrap();
    let rounding = Tol::ulps_because(4096.0, "both sides sum over bodies or particles");
    assert_close("forces", &tau, expected.as_slice(), rounding);
    tree.forward_dynamics(&mut work, &state.q, &state.v, &zero, &mut a).unwrap();
    let expected = lagrangian.acceleration(&zero, &state.v, 0.0).unwrap();
    assert_close("accelerations", &a, expected.as_slice(), Tol::stated(1e-12, "ulp times κ, about 10³"));
    compare_reactions(&tree, &lagrangian, kinds, parents, &state);
}

/// What a joint carries is the sum of the reactions on the particles of all bodies beyond it.
fn compare_reactions(
    tree: &RigidTree,
    lagrangian: &Lagrangian<Particles>,
    kinds: &[JointKind],
    parents: &[usize],
    state: &State,
) {
    let zero = vec![0.0; tree.freedoms()];
    let mut on_particles = vec![Reaction::none(); 6 * kinds.len()];
    lagrangian
        .reactions_at_acceleration_into(&mut Workspace::default(), &zero, &state.v, &state.a, 0.0, &mut on_particles)
        .unwrap();
    let mut compared = 0;
    for joint in (0..kinds.len()).filter(|&joint| kinds[joint] != JointKind::Fixed) {
        let mut found = [JointReaction { point: [0.0; 3], moment: [0.0; 3], force: [0.0; 3] }];
        let mut work = tree.workspace();
        tree.joint_reactions(&mut work, &state.q, &state.v, &state.a, &[], &[joint], &mut found).unwrap();
        let [JointReaction { point, moment, force }] = found;
        let is_beyond = |mut body: usize| loop {
            match parents[body] {
                _ if body == joint => break true,
                0 => break false,
                parent => body = parent - 1,
            }
        };
        let mut sums = [Vector3::zeros(); 2];
        for (body, particles) in on_particles.chunks_exact(6).enumerate().filter(|&(body, _)| is_beyond(body)) {
            for particle in particles {
                sums[0] += particle.force();
                sums[1] += particle.moment_about(&Vector3::from(point));
            }
            compared += usize::from(body == joint);
        }
        let rounding = Tol::ulps_because(4096.0, "both sides sum over bodies or particles");
        assert_close("reaction", &force, sums[0].as_slice(), rounding);
        assert_close("moment of the reaction", &moment, sums[1].as_slice(), rounding);
    }
    assert!(2 <= compared);
}

const AXIS: [f64; 3] = [0.48, 0.6, 0.64];

#[test]
fn chain_of_hinges_and_slides_equals_the_placement() {
    let hinge = JointKind::Revolute { axis: AXIS };
    let slide = JointKind::Prismatic { axis: AXIS };
    compare(&[hinge, slide, JointKind::Revolute { axis: [0.0, 1.0, 0.0] }, hinge], &[0, 1, 2, 3]);
}

#[test]
fn screws_and_joints_of_two_freedoms_equal_the_placement() {
    let helical = JointKind::Helical { axis: AXIS, pitch: 0.3 };
    let universal = JointKind::Universal { first: AXIS, second: [0.0, 0.0, 1.0] };
    compare(&[helical, universal, JointKind::Cylindrical { axis: AXIS }], &[0, 1, 1]);
}

#[test]
fn planar_spherical_and_free_joints_equal_the_placement() {
    compare(&[JointKind::Planar, JointKind::Spherical, JointKind::Free], &[0, 1, 1]);
    compare(&[JointKind::Free, JointKind::Spherical, JointKind::Fixed], &[0, 1, 2]);
}
