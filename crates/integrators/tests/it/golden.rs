//! Reference trajectories, computed with 230 bits: every listed time.

use core::convert::Infallible;

use piola_integrators::{
    Composition, DormandPrince853, Field, GaussLegendre, IntegratorsError, Nystrom86, Nystrom1210, Order, Report,
    SecondOrder, Separable, State, Tolerance, Verner98,
};
use piola_testkit::golden::{self, number, text, vector};
use piola_testkit::{Tol, assert_close};

use crate::problems::{DoublePendulum, henon_heiles, kepler, three_bodies};

fn check(name: &str, mut integrate_to: impl FnMut(&mut State, f64) -> Result<Report, IntegratorsError<Infallible>>) {
    let golden = golden::load("trajectories");
    let case = golden.cases.iter().find(|case| text(&case["name"]) == name).unwrap();
    let mut state = State::new(0.0, vector(&case["initial_state"])).unwrap();
    let sensitivity = vector(&case["sensitivity"]);
    for (expected, sensitivity) in case["states"].as_array().unwrap().iter().zip(sensitivity) {
        integrate_to(&mut state, number(&expected["t"])).unwrap();
        let tol = Tol::stated(1e-11, "trajectories").or(Tol::stated(1e-14, "rounding of the input").times(sensitivity));
        assert_close(name, &state.values, &vector(&expected["state"]), tol);
    }
}

fn adaptive<F: Field<Error = Infallible>>(name: &str, mut field: F) {
    let mut method = DormandPrince853::new(Tolerance::relative(1e-15).unwrap());
    check(name, |state, end| method.integrate_to(&mut field, state, end));
}

fn verner<F: Field<Error = Infallible>>(name: &str, mut field: F) {
    let mut method = Verner98::new(Tolerance::relative(1e-15).unwrap());
    check(name, |state, end| method.integrate_to(&mut field, state, end));
}

fn nystrom<F: SecondOrder<Error = Infallible>>(name: &str, mut field: F) {
    let mut method = Nystrom86::new(Tolerance::relative(1e-14).unwrap());
    check(name, |state, end| method.integrate_to(&mut field, state, end));
    let mut method = Nystrom1210::new(Tolerance::relative(1e-15).unwrap());
    check(name, |state, end| method.integrate_to(&mut field, state, end));
}

fn collocation<F: Field<Error = Infallible>>(name: &str, mut field: F, step: f64) {
    let mut method = GaussLegendre::new(Order::Eight, step).unwrap();
    check(name, |state, end| method.integrate_to(&mut field, state, end));
}

fn composition<F: Separable<Error = Infallible>>(name: &str, mut field: F, step: f64) {
    let mut method = Composition::new(Order::Eight, step).unwrap();
    check(name, |state, end| method.integrate_to(&mut field, state, end));
}

#[test]
fn dormand_prince_follows_kepler_motions() {
    adaptive("kepler_e0.3", kepler());
    adaptive("kepler_e0.9", kepler());
    adaptive("kepler_e0.99", kepler());
}

#[test]
fn dormand_prince_follows_henon_heiles_and_the_figure_eight() {
    adaptive("henon_heiles_E_1_12", henon_heiles());
    adaptive("figure_eight", three_bodies());
}

#[test]
fn dormand_prince_follows_double_pendulums_from_rest() {
    let pendulum = |masses, lengths| DoublePendulum { masses, lengths, gravity: 9.8125 };
    adaptive("double_pendulum_low", pendulum([1.0, 1.0], [1.0, 1.0]));
    adaptive("double_pendulum_high", pendulum([1.0, 2.0], [1.0, 0.5]));
}

#[test]
fn verner_follows_the_references() {
    verner("kepler_e0.3", kepler());
    verner("kepler_e0.9", kepler());
    verner("kepler_e0.99", kepler());
    verner("henon_heiles_E_1_12", henon_heiles());
    verner("figure_eight", three_bodies());
    let low = DoublePendulum { masses: [1.0; 2], lengths: [1.0; 2], gravity: 9.8125 };
    verner("double_pendulum_low", low);
    let high = DoublePendulum { masses: [1.0, 2.0], lengths: [1.0, 0.5], gravity: 9.8125 };
    verner("double_pendulum_high", high);
}

#[test]
fn nystrom_follows_the_references() {
    nystrom("kepler_e0.3", kepler());
    nystrom("kepler_e0.9", kepler());
    nystrom("kepler_e0.99", kepler());
    nystrom("henon_heiles_E_1_12", henon_heiles());
    nystrom("figure_eight", three_bodies());
}

#[test]
fn gauss_legendre_follows_the_references() {
    collocation("kepler_e0.3", kepler(), 0.02);
    collocation("kepler_e0.9", kepler(), 0.0008);
    collocation("henon_heiles_E_1_12", henon_heiles(), 0.05);
    collocation("figure_eight", three_bodies(), 0.01);
    let low = DoublePendulum { masses: [1.0; 2], lengths: [1.0; 2], gravity: 9.8125 };
    collocation("double_pendulum_low", low, 0.01);
}

#[test]
fn composition_follows_the_references() {
    composition("kepler_e0.3", kepler(), 0.01);
    composition("kepler_e0.9", kepler(), 0.0002);
    composition("henon_heiles_E_1_12", henon_heiles(), 0.02);
    composition("figure_eight", three_bodies(), 0.005);
}
