//! Analytic derivatives against dual numbers.

use nalgebra::DMatrix;
use piola_multibody::{AccelerationDerivatives, RigidTree};
use piola_numerics::Dual;
use piola_testkit::{Tol, assert_close};

use crate::trees::{State, branched, bush, chain, gripper_arm, humanoid, mixed, quadruped, state_of, ur5};

const ROUNDING: Tol = Tol::stated(1e-11, "the project's bound on derivatives");

/// The configuration moved along freedom j, and v and a, as dual numbers.
fn seeded(tree: &RigidTree, state: &State, by: usize, j: usize) -> [Vec<Dual<f64>>; 3] {
    let mut q: Vec<_> = state.q.iter().map(|&x| Dual::constant(x)).collect();
    let [mut v, mut a] = [&state.v, &state.a].map(|x| x.iter().map(|&x| Dual::constant(x)).collect::<Vec<_>>());
    match by {
        0 => {
            let mut delta = vec![Dual::constant(0.0); tree.freedoms()];
            delta[j] = Dual::variable(0.0);
            tree.move_configuration(&mut q, &delta).unwrap();
        }
        1 => v[j] = Dual::variable(state.v[j]),
        _ => a[j] = Dual::variable(state.a[j]),
    }
    [q, v, a]
}

fn trees() -> [(&'static str, RigidTree); 9] {
    [
        // Entries in eights: beyond 64 freedoms, and beyond 16 of a chain.
        ("bush", bush(54)),
        ("chain of 21", chain(21)),
        ("ur5", ur5()),
        ("chain", chain(9)),
        ("branched", branched()),
        ("mixed", mixed()),
        ("arm with gripper", gripper_arm()),
        ("quadruped", quadruped()),
        ("humanoid", humanoid()),
    ]
}

#[test]
fn derivatives_of_inverse_dynamics_equal_dual_numbers() {
    for (name, tree) in trees() {
        let n = tree.freedoms();
        let state = state_of(&tree, 3);
        let mut out = [vec![0.0; n * n], vec![0.0; n * n], vec![0.0; n * n]];
        let [by_q, by_v, by_a] = &mut out;
        let mut work = tree.workspace();
        tree.inverse_dynamics_derivatives(&mut work, &state.q, &state.v, &state.a, by_q, by_v, by_a).unwrap();
        let mut work = tree.workspace();
        for (by, matrix) in out.iter().enumerate() {
            let mut expected = Vec::new();
            for j in 0..n {
                let [q, v, a] = seeded(&tree, &state, by, j);
                let mut tau = vec![Dual::constant(0.0); n];
                tree.inverse_dynamics(&mut work, &q, &v, &a, &mut tau).unwrap();
                expected.extend(tau.iter().map(|tau| tau.tangent));
            }
            assert_close(&format!("{name} {by}"), matrix, &expected, ROUNDING);
        }
    }
}

#[test]
fn second_derivatives_by_dual_numbers_equal_nested_dual_numbers() {
    let tree = ur5();
    let n = tree.freedoms();
    let state = state_of(&tree, 8);
    // ∂²τ/∂q_j∂v_k: the analytic derivative along v_k, and both by dual numbers.
    let (mut work, mut nested) = (tree.workspace(), tree.workspace());
    let zero = Dual::constant(0.0);
    for k in 0..n {
        let [q, v, a] = seeded(&tree, &state, 1, k);
        let mut out = [vec![zero; n * n], vec![zero; n * n], vec![zero; n * n]];
        let [by_q, by_v, by_a] = &mut out;
        tree.inverse_dynamics_derivatives(&mut work, &q, &v, &a, by_q, by_v, by_a).unwrap();
        for j in 0..n {
            let inner = |x: &[f64], seed: Option<usize>, outer: Option<usize>| -> Vec<Dual<Dual<f64>>> {
                let unit = |index: Option<usize>, i: usize| f64::from(u8::from(index == Some(i)));
                let each =
                    |(i, &x): (usize, &f64)| Dual::new(Dual::new(x, unit(seed, i)), Dual::constant(unit(outer, i)));
                x.iter().enumerate().map(each).collect()
            };
            let (q, v) = (inner(&state.q, None, Some(j)), inner(&state.v, Some(k), None));
            let a = inner(&state.a, None, None);
            let mut tau = vec![Dual::constant(zero); n];
            tree.inverse_dynamics(&mut nested, &q, &v, &a, &mut tau).unwrap();
            let expected: Vec<f64> = tau.iter().map(|tau| tau.tangent.tangent).collect();
            let found: Vec<f64> = out[0][j * n..(j + 1) * n].iter().map(|x| x.tangent).collect();
            // Relative to the derivatives of all forces, of which some are zero.
            piola_testkit::assert_close_at_scale("∂²τ/∂q∂v", &found, &expected, 10.0, ROUNDING);
        }
    }
}

#[test]
fn derivatives_of_forward_dynamics_equal_dual_numbers() {
    for (name, tree) in trees() {
        let n = tree.freedoms();
        let state = state_of(&tree, 5);
        let mut out = AccelerationDerivatives::new(&tree);
        tree.forward_dynamics_derivatives(&mut tree.workspace(), &state.q, &state.v, &state.a, &mut out).unwrap();
        let mut work = tree.workspace();
        for (by, matrix) in [&out.by_q, &out.by_v, &out.by_tau].into_iter().enumerate() {
            let mut expected = Vec::new();
            for j in 0..n {
                let [q, v, tau] = seeded(&tree, &state, by, j);
                let mut a = vec![Dual::constant(0.0); n];
                tree.forward_dynamics(&mut work, &q, &v, &tau, &mut a).unwrap();
                expected.extend(a.iter().map(|a| a.tangent));
            }
            assert_close(&format!("{name} {by}"), matrix, &expected, ROUNDING);
        }
    }
}

/// Up to 128 freedoms M⁻¹ multiplies, beyond that each column is solved along the tree.
#[test]
fn mass_matrix_times_derivatives_of_accelerations_equals_those_of_forces() {
    for bodies in [30, 54, 90, 110] {
        let tree = bush(bodies);
        let n = tree.freedoms();
        let state = state_of(&tree, 5);
        let (mut work, mut out) = (tree.workspace(), AccelerationDerivatives::new(&tree));
        tree.forward_dynamics_derivatives(&mut work, &state.q, &state.v, &state.a, &mut out).unwrap();
        let mut mass_matrix = vec![0.0; n * n];
        tree.mass_matrix(&mut work, &state.q, &mut mass_matrix).unwrap();
        let [mut by_q, mut by_v, mut by_a] = [(); 3].map(|()| vec![0.0; n * n]);
        let a = &out.acceleration;
        tree.inverse_dynamics_derivatives(&mut work, &state.q, &state.v, a, &mut by_q, &mut by_v, &mut by_a).unwrap();
        let m = DMatrix::from_column_slice(n, n, &mass_matrix);
        let times = |x: &[f64]| (&m * DMatrix::from_column_slice(n, n, x)).as_slice().to_vec();
        let minus = |x: &[f64]| x.iter().map(|x| -x).collect::<Vec<_>>();
        assert_close(&format!("{n} by q"), &times(&out.by_q), &minus(&by_q), ROUNDING);
        assert_close(&format!("{n} by v"), &times(&out.by_v), &minus(&by_v), ROUNDING);
        assert_close(&format!("{n} by τ"), &times(&out.by_tau), DMatrix::identity(n, n).as_slice(), ROUNDING);
        assert_close(&format!("{n} by a"), &by_a, &mass_matrix, Tol::ulps_because(512.0, "other orders of sums"));
    }
}
