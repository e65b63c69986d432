//! The arm UR5 against reference values made with another program.

use piola_testkit::{Tol, assert_close, golden};

use crate::trees::ur5;

const ROUNDING: Tol = Tol::stated(1e-12, "the reference was computed in double precision");

#[test]
fn robot_has_the_accelerations_and_forces_of_the_reference() {
    let tree = ur5();
    let mut work = tree.workspace();
    let data = golden::load("robots");
    for state in data.cases[0]["states"].as_array().unwrap() {
        let [q, v, a, tau] = ["q", "v", "a", "tau"].map(|key| golden::vector(&state[key]));
        let mut out = vec![0.0; 6];
        tree.inverse_dynamics(&mut work, &q, &v, &a, &mut out).unwrap();
        assert_close("inverse dynamics", &out, &golden::vector(&state["rnea_torque"]), ROUNDING);
        tree.bias_forces(&mut work, &q, &v, &mut out).unwrap();
        assert_close("bias forces", &out, &golden::vector(&state["nonlinear_effects"]), ROUNDING);
        tree.gravity_forces(&mut work, &q, &mut out).unwrap();
        assert_close("gravity forces", &out, &golden::vector(&state["gravity"]), ROUNDING);
        tree.forward_dynamics(&mut work, &q, &v, &tau, &mut out).unwrap();
        assert_close("forward dynamics", &out, &golden::vector(&state["aba_acceleration"]), ROUNDING);
        let mut mass_matrix = vec![0.0; 36];
        tree.mass_matrix(&mut work, &q, &mut mass_matrix).unwrap();
        let expected = golden::matrix(&state["mass_matrix"]).concat();
        assert_close("mass matrix", &mass_matrix, &expected, ROUNDING);
    }
}
