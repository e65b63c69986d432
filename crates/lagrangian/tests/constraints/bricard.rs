//! Bricard's loop of six equal links with right-angle twists, closed by six equations of rank five, against its
//! symmetric motion in one parameter.
//!
//! In the symmetric motion alternate joint angles are equal, (θ, φ, θ, φ, θ, φ), and
//!
//! ```text
//! cos θ + cos φ + cos θ cos φ = 0        that is        cos θ/2 cos φ/2 = 1/2
//! ```

use piola_integrators::Tolerance;
use piola_lagrangian::Run;
use piola_lagrangian::constraints::{Constrained, Redundancy};
use piola_numerics::Jet;
use piola_testkit::{Tol, assert_close, assert_close_at_scale};

use crate::systems::{Drive, Spring, System, Ties, loop_angles, mechanism};

/// So directed that nothing of the loop's symmetry is left.
pub(crate) const GRAVITY: [f64; 3] = [0.5, -1.5, 2.0];
const TIGHT: f64 = 1e-13;

/// The joint angles and their rates at a parameter and its rate.
pub(crate) fn state(psi: f64, rate: f64) -> ([f64; 6], [f64; 6]) {
    let jets = loop_angles(Jet::<f64, 0>::coordinate(psi, rate, 0));
    (jets.map(|q| q.value), jets.map(|q| q.rate))
}

pub(crate) fn bricard() -> Constrained<System, Spring, Drive, Ties> {
    mechanism(System::Bricard { sixth: false }, GRAVITY, 0.0).with_constraints(Ties::Bricard)
}

fn compare(psi: f64, rate: f64) -> (Run, f64) {
    let (q, v) = state(psi, rate);
    let tolerance = Tolerance::relative(TIGHT).unwrap();
    let run = bricard().integrate(&q, &v, 0.0..10.0, tolerance).unwrap();
    let symmetric = mechanism(System::BricardSymmetric, GRAVITY, 0.0);
    let reference = symmetric.integrate(&[psi], &[rate], 0.0..10.0, tolerance).unwrap();
    let (end, end_rate) = (reference.last().0[0], reference.last().1[0]);
    let expected = state(end, end_rate);
    let tol = Tol::stated(1e-10, "what is asked of ten seconds of motion");
    assert_close_at_scale("angles", run.last().0, &expected.0, 1.0, tol);
    assert_close_at_scale("rates", run.last().1, &expected.1, 1.0, tol);
    assert!(run.residual() <= 8.0 * f64::EPSILON && run.rate_residual() <= 16.0 * f64::EPSILON);
    (run, end)
}

#[test]
fn bricard_loop_in_six_angles_equals_bricard_loop_in_one_parameter_over_ten_seconds() {
    // It swings between the positions where its energy is used up.
    compare(0.6, 0.5);
}

#[test]
fn bricard_loop_turning_inside_out_equals_the_same_in_one_parameter() {
    let (run, end) = compare(0.6, 4.0);
    assert!(core::f64::consts::TAU < end, "it turns round: {end}");
    // The sum of the moduli of all local errors.
    assert!(run.error_estimate() < 1e-9);
}

#[test]
fn bricard_loop_has_six_equations_of_rank_five_all_round() {
    let loops = bricard();
    for k in 0..24 {
        let (q, _) = state(f64::from(k) * 0.25 + 0.1, 0.0);
        let residuals = loops.residuals(&q, 0.0);
        assert_close_at_scale("closure", residuals.as_slice(), &[0.0; 6], 1.0, Tol::ulps(24.0));
        assert_eq!(loops.degrees_of_freedom(&q, 0.0).unwrap(), 1, "at {q:?}");
        let [theta, phi] = [q[0], q[1]];
        let closure = theta.cos() + phi.cos() + theta.cos() * phi.cos();
        assert_close_at_scale("cos θ + cos φ + cos θ cos φ", &[closure], &[0.0], 1.0, Tol::ulps(8.0));
        let dependencies = loops.dependencies(&q, 0.0).unwrap();
        assert_eq!(dependencies.len(), 1);
        let gradients = loops.jacobian(&q, 0.0);
        let combination: Vec<f64> =
            (0..6).map(|j| (0..6).map(|i| dependencies[0].combination[i] * gradients[(i, j)]).sum()).collect();
        let row: Vec<f64> = gradients.row(dependencies[0].constraint).iter().copied().collect();
        assert_close("gradient", &combination, &row, Tol::stated(1e-12, "ulps by the condition of five gradients"));
    }
}

#[test]
fn bricard_loop_assembles_from_a_rough_guess() {
    let (q, v) = state(0.9, 1.0);
    let guess: Vec<f64> = q.iter().zip([0.1, -0.05, 0.08, 0.1, -0.1, 0.02]).map(|(q, off)| q + off).collect();
    let assembly = bricard().assemble(&guess, &v, 0.0).unwrap();
    assert!(assembly.residual <= 2.0 * f64::EPSILON && assembly.rate_residual <= 8.0 * f64::EPSILON);
    let [theta, phi, ..] = assembly.coordinates[..] else { unreachable!() };
    assert_close(
        "alternate angles",
        &[assembly.coordinates[2], assembly.coordinates[3]],
        &[theta, phi],
        Tol::ulps(64.0),
    );
    let residual = theta.cos() + phi.cos() + theta.cos() * phi.cos();
    assert_close_at_scale("closure relation", &[residual], &[0.0], 1.0, Tol::ulps(16.0));
}

#[test]
fn bricard_loop_is_refused_where_redundancy_is() {
    let (q, v) = state(0.9, 1.0);
    let error = bricard().with_redundancy(Redundancy::Refused).acceleration(&q, &v, 0.0).unwrap_err();
    assert!(error.to_string().contains("depends on others"), "{error}");
}
