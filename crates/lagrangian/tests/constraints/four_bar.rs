//! A four-bar linkage in three angles against the same linkage in the crank's angle alone.

use piola_integrators::Tolerance;
use piola_lagrangian::Run;
use piola_lagrangian::constraints::Redundancy;
use piola_numerics::Jet;
use piola_testkit::{Tol, assert_close, assert_close_at_scale};

use crate::systems::{System, Ties, bar_angles, mechanism};

pub(crate) const GRAVITY: [f64; 3] = [0.0, -9.80665, 0.0];
const TIGHT: f64 = 1e-13;
/// The crank's rate at the start, rad/s: it turns round.
pub(crate) const RATE: f64 = 10.0;

/// The angles and their rates at a crank angle and its rate.
pub(crate) fn state(crank: f64, rate: f64) -> ([f64; 3], [f64; 3]) {
    let jets = bar_angles(Jet::<f64, 0>::coordinate(crank, rate, 0));
    (jets.map(|q| q.value), jets.map(|q| q.rate))
}

fn run(ties: Ties) -> Run {
    let (q, v) = state(0.5, RATE);
    let linkage = mechanism(System::FourBar, GRAVITY, 0.0).with_constraints(ties);
    linkage.integrate(&q, &v, 0.0..10.0, Tolerance::relative(TIGHT).unwrap()).unwrap()
}

#[test]
fn four_bar_in_three_angles_equals_four_bar_in_one_over_ten_seconds() {
    let run = run(Ties::FourBar);
    let crank = mechanism(System::FourBarCrank, GRAVITY, 0.0);
    let reference = crank.integrate(&[0.5], &[RATE], 0.0..10.0, Tolerance::relative(TIGHT).unwrap()).unwrap();
    let (q, v) = run.last();
    let (angle, rate) = reference.last();
    let turns = (angle[0] / core::f64::consts::TAU).floor() * core::f64::consts::TAU;
    assert!(2.0 * core::f64::consts::TAU < turns, "the crank turns round: {turns}");
    let expected = state(angle[0], rate[0]);
    let tol = Tol::stated(1e-10, "what is asked of ten seconds of motion");
    assert_close_at_scale("angles", q, &expected.0, 1.0, tol);
    assert_close("rates", v, &expected.1, tol);
    assert!(run.residual() <= 4.0 * f64::EPSILON && run.rate_residual() <= 16.0 * f64::EPSILON);
    // The sum of the moduli of all local errors.
    assert!(run.error_estimate() < 1e-9);
}

#[test]
fn four_bar_with_redundant_closure_moves_as_without() {
    let (few, many) = (run(Ties::FourBar), run(Ties::FourBarThrice));
    let tol = Tol::stated(1e-10, "what is asked of ten seconds of motion");
    assert_close_at_scale("angles", many.last().0, few.last().0, 1.0, tol);
    assert_close("rates", many.last().1, few.last().1, tol);
}

#[test]
fn redundant_closure_is_named_with_its_combination() {
    let (q, v) = state(0.5, RATE);
    let linkage = mechanism(System::FourBar, GRAVITY, 0.0).with_constraints(Ties::FourBarThrice);
    assert_eq!(linkage.degrees_of_freedom(&q, 0.0).unwrap(), 1);
    let dependencies = linkage.dependencies(&q, 0.0).unwrap();
    assert_eq!(dependencies.len(), 2);
    let gradients = linkage.jacobian(&q, 0.0);
    for dependency in &dependencies {
        let row = gradients.row(dependency.constraint).transpose();
        let mut combination = 0.0 * &row;
        for (i, &c) in dependency.combination.iter().enumerate() {
            combination += c * gradients.row(i).transpose();
        }
        assert_close("gradient", combination.as_slice(), row.as_slice(), Tol::ulps(16.0));
        assert!(dependency.name.is_some());
    }
    let error = linkage.with_redundancy(Redundancy::Refused).acceleration(&q, &v, 0.0).unwrap_err();
    assert!(error.to_string().contains("depends on others"), "{error}");
}
