//! Identities between the passes, for random trees of all joints.

use piola_multibody::{
    AppliedWrench, BodyIndex, INERTIAL_PARAMETERS, JointKind, JointReaction, RigidTree, TreeFactors,
};
use piola_numerics::Dual;
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use proptest::prelude::*;

use crate::trees::{State, state_of, tree_of, uniform};

/// Passes that sum in another order, over some ten links.
const SUMS: Tol = Tol::ulps_because(4096.0, "sums over links, of terms that are larger than what is left");

/// A whole number below n.
fn pick(next: &mut impl FnMut() -> f64, n: usize) -> usize {
    let u = next();
    (1..n).filter(|&k| k as f64 <= u * n as f64).count()
}

/// A random tree of one to nine bodies with any joints.
fn random_tree(seed: u64) -> RigidTree {
    let mut next = uniform(seed);
    let mut pick = |n: usize| pick(&mut next, n);
    let axes = [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.6, 0.0, 0.8], [0.0, 0.0, 1.0]];
    let count = 1 + pick(9);
    let (mut kinds, mut parents) = (Vec::new(), Vec::new());
    for i in 0..count {
        let axis = axes[pick(4)];
        kinds.push(match pick(9) {
            0 | 1 => JointKind::Revolute { axis },
            2 => JointKind::Prismatic { axis },
            3 => JointKind::Helical { axis, pitch: 0.2 },
            4 => JointKind::Universal { first: [0.0, 0.8, 0.6], second: [1.0, 0.0, 0.0] },
            5 => JointKind::Cylindrical { axis },
            6 => JointKind::Planar,
            7 => JointKind::Spherical,
            _ => JointKind::Free,
        });
        parents.push(pick(i + 1));
    }
    tree_of(&kinds, &parents, seed)
}

fn product(matrix: &[f64], rows: usize, x: &[f64]) -> Vec<f64> {
    let mut out = vec![0.0; rows];
    for (column, &x) in matrix.chunks_exact(rows).zip(x) {
        for (out, &entry) in out.iter_mut().zip(column) {
            *out += entry * x;
        }
    }
    out
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |largest, x| largest.max(x.abs()))
}

/// The state a moment along its motion, as dual numbers.
fn along_motion(tree: &RigidTree, state: &State) -> [Vec<Dual<f64>>; 2] {
    let mut q: Vec<_> = state.q.iter().map(|&x| Dual::constant(x)).collect();
    let step: Vec<_> = state.v.iter().map(|&v| Dual::new(0.0, v)).collect();
    tree.move_configuration(&mut q, &step).unwrap();
    [q, state.v.iter().zip(&state.a).map(|(&v, &a)| Dual::new(v, a)).collect()]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn forward_dynamics_inverts_inverse_dynamics_by_both_ways(seed in 0_u64..1 << 40) {
        let tree = random_tree(seed);
        let (state, n) = (state_of(&tree, seed), tree.freedoms());
        let mut work = tree.workspace();
        let (mut tau, mut back) = (vec![0.0; n], vec![0.0; n]);
        let wrench = AppliedWrench { body: tree.body("body 0").unwrap(), moment: [0.3, -0.2, 0.5], force: [1.0, 2.0, -3.0] };
        tree.inverse_dynamics_under(&mut work, &state.q, &state.v, &state.a, &[wrench], &mut tau).unwrap();
        tree.forward_dynamics_under(&mut work, &state.q, &state.v, &tau, &[wrench], &mut back).unwrap();
        let round = Tol::ulps_because(1e5, "times the condition number of the mass matrix, 10³ or less here");
        assert_close("articulated bodies", &back, &state.a, round);
        tree.inverse_dynamics(&mut work, &state.q, &state.v, &state.a, &mut tau).unwrap();
        let mut factors = TreeFactors::new(&tree);
        tree.forward_dynamics_by_mass_matrix(&mut work, &mut factors, &state.q, &state.v, &tau, &mut back).unwrap();
        assert_close("mass matrix", &back, &state.a, round);
    }

    #[test]
    fn mass_matrix_times_accelerations_and_bias_equal_inverse_dynamics(seed in 0_u64..1 << 40) {
        let tree = random_tree(seed);
        let (state, n) = (state_of(&tree, seed), tree.freedoms());
        let mut work = tree.workspace();
        let (mut tau, mut bias, mut matrix) = (vec![0.0; n], vec![0.0; n], vec![0.0; n * n]);
        tree.inverse_dynamics(&mut work, &state.q, &state.v, &state.a, &mut tau).unwrap();
        tree.bias_forces(&mut work, &state.q, &state.v, &mut bias).unwrap();
        tree.mass_matrix(&mut work, &state.q, &mut matrix).unwrap();
        let sum: Vec<f64> = product(&matrix, n, &state.a).iter().zip(&bias).map(|(x, y)| x + y).collect();
        assert_close("M a + b", &sum, &tau, SUMS);
        let kinetic: f64 = product(&matrix, n, &state.v).iter().zip(&state.v).map(|(p, v)| 0.5 * p * v).sum();
        let energies = tree.tree_energies(&mut work, &state.q, &state.v).unwrap();
        assert_close("½ vᵀ M v", &[kinetic], &[energies.kinetic], SUMS);
    }

    #[test]
    fn coriolis_matrix_gives_the_bias_and_a_skew_difference(seed in 0_u64..1 << 40) {
        let tree = random_tree(seed);
        let (state, n) = (state_of(&tree, seed), tree.freedoms());
        let mut work = tree.workspace();
        let (mut bias, mut gravity, mut c) = (vec![0.0; n], vec![0.0; n], vec![0.0; n * n]);
        tree.bias_forces(&mut work, &state.q, &state.v, &mut bias).unwrap();
        tree.gravity_forces(&mut work, &state.q, &mut gravity).unwrap();
        tree.coriolis_matrix(&mut work, &state.q, &state.v, &mut c).unwrap();
        let sum: Vec<f64> = product(&c, n, &state.v).iter().zip(&gravity).map(|(x, y)| x + y).collect();
        assert_close("C v + g", &sum, &bias, SUMS);
        let [q, _] = along_motion(&tree, &state);
        let mut matrix = vec![Dual::constant(0.0); n * n];
        tree.mass_matrix(&mut tree.workspace(), &q, &mut matrix).unwrap();
        for i in 0..n {
            for j in 0..n {
                let difference = |i: usize, j: usize| matrix[i + j * n].tangent - 2.0 * c[i + j * n];
                let sum = difference(i, j) + difference(j, i);
                assert_close_at_scale("Ṁ − 2 C", &[sum], &[0.0], largest(&c).max(1.0), SUMS);
            }
        }
    }

    #[test]
    fn jacobians_give_velocities_and_accelerations(seed in 0_u64..1 << 40) {
        let tree = random_tree(seed);
        let (state, n) = (state_of(&tree, seed), tree.freedoms());
        let mut work = tree.workspace();
        let body = tree.body(&format!("body {}", tree.bodies() - 1)).unwrap();
        let (mut jacobian, mut rate) = (vec![0.0; 6 * n], vec![0.0; 6 * n]);
        tree.jacobian(&mut work, &state.q, body, &mut jacobian).unwrap();
        tree.jacobian_rate(&mut work, &state.q, &state.v, body, &mut rate).unwrap();
        tree.forward_accelerations(&mut work, &state.q, &state.v, &state.a).unwrap();
        let velocity = tree.velocity_of(&work, body).unwrap();
        assert_close("J v", &product(&jacobian, 6, &state.v), &[velocity.angular, velocity.linear].concat(), SUMS);
        let acceleration = tree.acceleration_of(&work, body).unwrap();
        let expected = [acceleration.angular, acceleration.linear].concat();
        let sum: Vec<f64> =
            product(&jacobian, 6, &state.a).iter().zip(product(&rate, 6, &state.v)).map(|(x, y)| x + y).collect();
        assert_close("J a + J̇ v", &sum, &expected, SUMS);
        // The origin moves at the velocity.
        let [q, _] = along_motion(&tree, &state);
        let mut work = tree.workspace();
        tree.forward_kinematics(&mut work, &q).unwrap();
        let origin = tree.place_of(&work, body).unwrap().origin;
        assert_close("ẋ", &origin.map(|x| x.tangent), &velocity.linear, SUMS);
    }

    #[test]
    fn momentum_has_its_matrix_and_its_rate(seed in 0_u64..1 << 40) {
        let tree = random_tree(seed);
        let (state, n) = (state_of(&tree, seed), tree.freedoms());
        let mut work = tree.workspace();
        let mut matrix = vec![0.0; 6 * n];
        tree.centroidal_momentum_matrix(&mut work, &state.q, &mut matrix).unwrap();
        let h = tree.centroidal_momentum(&mut work, &state.q, &state.v).unwrap();
        assert_close("A v", &product(&matrix, 6, &state.v), &[h.angular, h.linear].concat(), SUMS);
        let centre = tree.mass_centre(&mut work, &state.q, &state.v).unwrap();
        assert_close("m ċ", &centre.velocity.map(|v| v * centre.mass), &h.linear, SUMS);
        let rate = tree.centroidal_momentum_rate(&mut work, &state.q, &state.v, &state.a).unwrap();
        let [q, v] = along_motion(&tree, &state);
        let h = tree.centroidal_momentum(&mut tree.workspace(), &q, &v).unwrap();
        let expected = [h.angular, h.linear].concat().iter().map(|x| x.tangent).collect::<Vec<_>>();
        assert_close("ḣ", &[rate.angular, rate.linear].concat(), &expected, SUMS);
    }

    #[test]
    fn power_of_the_forces_is_the_rate_of_the_energy(seed in 0_u64..1 << 40) {
        let tree = random_tree(seed);
        let (state, n) = (state_of(&tree, seed), tree.freedoms());
        let mut tau = vec![0.0; n];
        tree.inverse_dynamics(&mut tree.workspace(), &state.q, &state.v, &state.a, &mut tau).unwrap();
        let [q, v] = along_motion(&tree, &state);
        let energies = tree.tree_energies(&mut tree.workspace(), &q, &v).unwrap();
        let power: f64 = tau.iter().zip(&state.v).map(|(tau, v)| tau * v).sum();
        let rate = energies.kinetic.tangent + energies.potential.tangent;
        let scale: f64 = tau.iter().zip(&state.v).map(|(tau, v)| (tau * v).abs()).sum();
        assert_close_at_scale("Ė", &[power], &[rate], scale, SUMS);
    }

    #[test]
    fn reactions_on_the_ground_are_the_rate_of_momentum_less_the_weight(seed in 0_u64..1 << 40) {
        let tree = random_tree(seed);
        let state = state_of(&tree, seed);
        let mut work = tree.workspace();
        let rate = tree.centroidal_momentum_rate(&mut work, &state.q, &state.v, &state.a).unwrap();
        let none = JointReaction { point: [0.0; 3], moment: [0.0; 3], force: [0.0; 3] };
        let joints: Vec<usize> = (0..tree.joints().len()).collect();
        let mut reactions = vec![none; joints.len()];
        tree.joint_reactions(&mut work, &state.q, &state.v, &state.a, &[], &joints, &mut reactions).unwrap();
        // The joints on the ground carry all: the others pass on what they carry.
        let mut sum = [0.0, 0.0, -9.81 * tree.total_mass()];
        for (reaction, place) in reactions.iter().zip(tree.joints()) {
            if tree.parent_of(place.child).unwrap() == BodyIndex::GROUND {
                for (sum, force) in sum.iter_mut().zip(reaction.force) {
                    *sum += force;
                }
            }
        }
        assert_close("Σ f", &sum, &rate.linear, SUMS);
    }

    #[test]
    fn regressor_times_parameters_equals_inverse_dynamics(seed in 0_u64..1 << 40) {
        let tree = random_tree(seed);
        let (state, n) = (state_of(&tree, seed), tree.freedoms());
        let mut work = tree.workspace();
        let mut tau = vec![0.0; n];
        tree.inverse_dynamics(&mut work, &state.q, &state.v, &state.a, &mut tau).unwrap();
        for place in tree.joints() {
            let range = place.first_freedom..place.first_freedom + place.joint.kind.freedoms();
            for (tau, a) in tau[range.clone()].iter_mut().zip(&state.a[range]) {
                *tau -= place.joint.armature * a;
            }
        }
        let mut regressor = vec![0.0; n * INERTIAL_PARAMETERS * tree.bodies()];
        tree.regressor(&mut work, &state.q, &state.v, &state.a, &mut regressor).unwrap();
        let mut parameters = vec![0.0; INERTIAL_PARAMETERS * tree.bodies()];
        tree.inertial_parameters(&mut parameters).unwrap();
        assert_close("Y π", &product(&regressor, n, &parameters), &tau, SUMS);
    }

    #[test]
    fn displacement_inverts_motion_along_the_manifold(seed in 0_u64..1 << 40) {
        let tree = random_tree(seed);
        let (from, to) = (state_of(&tree, seed).q, state_of(&tree, seed + 1).q);
        let mut delta = vec![0.0; tree.freedoms()];
        tree.displacement(&from, &to, &mut delta).unwrap();
        let mut moved = from.clone();
        tree.move_configuration(&mut moved, &delta).unwrap();
        let mut again = vec![0.0; tree.freedoms()];
        tree.displacement(&from, &moved, &mut again).unwrap();
        // Where rotations are near π the logarithm loses digits.
        assert_close("δ", &again, &delta, Tol::ulps_because(1e5, "logarithms of rotations near half a turn"));
        let mut half = vec![0.0; tree.coordinates()];
        tree.interpolate(&from, &to, 0.5, &mut again, &mut half).unwrap();
        tree.displacement(&from, &half, &mut again).unwrap();
        let expected: Vec<f64> = delta.iter().map(|x| 0.5 * x).collect();
        assert_close("½ δ", &again, &expected, SUMS);
    }
}

#[test]
fn places_do_not_change_the_dynamics_of_a_free_tree() {
    let tree = crate::trees::branched();
    let (mut state, n) = (state_of(&tree, 9), tree.freedoms());
    let mut work = tree.workspace();
    let (mut near, mut far) = (vec![0.0; n * n], vec![0.0; n * n]);
    tree.mass_matrix(&mut work, &state.q, &mut near).unwrap();
    state.q[4] += 1e6;
    tree.mass_matrix(&mut work, &state.q, &mut far).unwrap();
    assert_close("a thousand kilometres away", &far, &near, Tol::stated(1e-8, "places keep 10⁻¹⁰ m at 10⁶ m"));
    assert_eq!(tree.body_name(BodyIndex::GROUND), "ground");
}
