//! Collocation of eight stages in lanes: its coefficients, its order, its steps, its refusals.

use core::convert::Infallible;
use core::ops::ControlFlow;

use piola_integrators::{GaussLegendre16, SecondOrder, State, Tolerance};
use piola_numerics::{Lanes, Real};
use piola_testkit::golden::{self, number, text, vector};
use piola_testkit::{Tol, assert_close, assert_order};

use crate::collocation::{Oscillator, Power};
use crate::problems::{DoublePendulum, henon_heiles, kepler, kepler_at, kepler_energy, three_bodies};

type Stages = Lanes<f64, 8>;

fn adaptive(tolerance: f64) -> GaussLegendre16 {
    GaussLegendre16::new(Tolerance::relative(tolerance).unwrap())
}

/// q̈ = −2βq̇, damped by its velocity alone.
struct Damped(f64);
impl<T: Real> SecondOrder<T> for Damped {
    type Error = Infallible;
    fn freedom(&self) -> usize {
        1
    }
    fn acceleration(&mut self, _t: T, _q: &[T], v: &[T], acceleration: &mut [T]) -> Result<(), Infallible> {
        acceleration[0] = T::lit(-2.0 * self.0) * v[0];
        Ok(())
    }
}

#[test]
fn one_step_equals_the_integrals_of_powers_to_degree_fifteen() {
    for k in 0..=15 {
        let mut state = State::new(0.0, vec![0.0, 0.0]).unwrap();
        GaussLegendre16::with_step(1.0).unwrap().integrate_to(&mut Power(k), &mut state, 1.0).unwrap();
        let k = f64::from(k);
        // Positions are exact to degree fourteen: ∫(1 − t) tᵏ has degree k + 1.
        let position = if k < 15.0 { 1.0 / ((k + 1.0) * (k + 2.0)) } else { state.values[0] };
        assert_close("powers", &state.values, &[position, 1.0 / (k + 1.0)], Tol::ulps(4.0));
    }
}

#[test]
fn dense_output_equals_the_integrals_of_powers_to_degree_seven() {
    for k in 0..=7 {
        let mut state = State::new(0.0, vec![0.25, 0.5]).unwrap();
        let mut method = GaussLegendre16::with_step(1.0).unwrap();
        let run = method.integrate(&mut Power(k), &mut state, 1.0, |step| {
            for t in [0.0, 0.1, 0.5, 0.77, 1.0_f64] {
                let mut y = [0.0; 2];
                step.at(t, &mut y).unwrap();
                let n = f64::from(k);
                let expected =
                    [0.25 + 0.5 * t + t.powi(k + 2) / ((n + 1.0) * (n + 2.0)), 0.5 + t.powi(k + 1) / (n + 1.0)];
                assert_close("dense", &y, &expected, Tol::ulps(8.0));
            }
            assert!(step.at(1.1, &mut [0.0; 2]).is_err() && step.at(0.5, &mut [0.0; 3]).is_err());
            ControlFlow::Continue(())
        });
        run.unwrap();
    }
}

/// The diagonal Padé approximant of degree eight of e^(ix): a polynomial N(ix)/N(−ix).
fn pade(x: f64) -> (f64, f64) {
    let mut coefficient = 1.0;
    let (mut re, mut im) = (0.0, 0.0);
    let mut power = (1.0, 0.0);
    for k in 0..=8 {
        re += coefficient * power.0;
        im += coefficient * power.1;
        let k = f64::from(k);
        coefficient *= (8.0 - k) / ((16.0 - k) * (k + 1.0));
        power = (-power.1 * x, power.0 * x);
    }
    // N(ix)/conj N(ix) = N²/|N|².
    let square = re * re + im * im;
    ((re * re - im * im) / square, 2.0 * re * im / square)
}

#[test]
fn one_step_of_an_oscillator_equals_the_pade_approximant() {
    // Every entry of A² takes part, and the Padé approximant belongs to Gauss's nodes alone.
    for omega in [0.5, 1.0, 2.0, 3.0] {
        let mut state = State::new(0.0, vec![1.0, 0.5 * omega]).unwrap();
        GaussLegendre16::with_step(1.0).unwrap().integrate_to(&mut Oscillator(omega), &mut state, 1.0).unwrap();
        let (cosine, sine) = pade(omega);
        let expected = [cosine + 0.5 * sine, omega * (0.5 * cosine - sine)];
        assert_close("oscillator", &state.values, &expected, Tol::ulps(16.0));
    }
}

#[test]
fn one_step_of_damping_equals_the_pade_approximant() {
    // The same for every entry of A.
    for beta in [0.25, 0.5, 1.0] {
        let mut state = State::new(0.0, vec![0.0, 1.0]).unwrap();
        GaussLegendre16::with_step(1.0).unwrap().integrate_to(&mut Damped(beta), &mut state, 1.0).unwrap();
        let (mut up, mut down, mut term, x) = (0.0, 0.0, 1.0, -2.0 * beta);
        for k in 0..=8 {
            up += term;
            down += if k % 2 == 0 { term } else { -term };
            let k = f64::from(k);
            term *= x * (8.0 - k) / ((16.0 - k) * (k + 1.0));
        }
        let velocity = up / down;
        assert_close("damping", &state.values, &[(1.0 - velocity) / (2.0 * beta), velocity], Tol::ulps(16.0));
    }
}

#[test]
fn error_falls_with_order_sixteen() {
    // Fourteen revolutions in 18, 20 and 23 steps.
    let steps = [5.0, 4.5, 90.0 / 23.0];
    let errors = steps.map(|h| {
        let mut state = State::new(0.0, vec![1.0, 0.0]).unwrap();
        GaussLegendre16::with_step(h).unwrap().integrate_to(&mut Oscillator(1.0), &mut state, 90.0).unwrap();
        (state.values[0] - 90.0_f64.cos()).hypot(state.values[1] + 90.0_f64.sin())
    });
    assert_order("collocation", &steps, &errors, 16.0, 1.0);
}

fn follow<F: SecondOrder<Stages, Error = Infallible>>(name: &str, mut field: F) {
    let golden = golden::load("trajectories");
    let case = golden.cases.iter().find(|case| text(&case["name"]) == name).unwrap();
    let mut state = State::new(0.0, vector(&case["initial_state"])).unwrap();
    let sensitivity = vector(&case["sensitivity"]);
    let mut method = adaptive(1e-16);
    for (expected, sensitivity) in case["states"].as_array().unwrap().iter().zip(sensitivity) {
        method.integrate_to(&mut field, &mut state, number(&expected["t"])).unwrap();
        let tol = Tol::stated(1e-11, "trajectories").or(Tol::stated(1e-14, "rounding of the input").times(sensitivity));
        assert_close(name, &state.values, &vector(&expected["state"]), tol);
    }
}

#[test]
fn adaptive_steps_follow_the_references() {
    follow("kepler_e0.3", kepler());
    follow("kepler_e0.9", kepler());
    follow("kepler_e0.99", kepler());
    follow("henon_heiles_E_1_12", henon_heiles());
    follow("figure_eight", three_bodies());
    let pendulum = |masses, lengths| DoublePendulum { masses, lengths, gravity: 9.8125 };
    follow("double_pendulum_low", pendulum([1.0, 1.0], [1.0, 1.0]));
    follow("double_pendulum_high", pendulum([1.0, 2.0], [1.0, 0.5]));
}

#[test]
fn errors_follow_the_tolerance() {
    for tolerance in [1e-4, 1e-6, 1e-8, 1e-10, 1e-12] {
        let mut state = State::new(0.0, kepler_at(0.5, 0.0).to_vec()).unwrap();
        let report = adaptive(tolerance).integrate_to(&mut kepler(), &mut state, 20.0).unwrap();
        assert!(report.steps < 120, "{report:?}");
        let tol = Tol::stated(20.0 * tolerance, "three revolutions");
        assert_close("tolerance", &state.values, &kepler_at(0.5, 20.0), tol);
    }
}

#[test]
fn energy_of_a_thousand_revolutions_is_kept_to_rounding() {
    // Random rounding of each of some 30,000 steps leaves √30,000 of 1e-16.
    for mut method in [adaptive(1e-17), GaussLegendre16::with_step(0.25).unwrap()] {
        let mut state = State::new(0.0, kepler_at(0.3, 0.0).to_vec()).unwrap();
        let before = kepler_energy(&state.values);
        let mut worst = 0.0_f64;
        let run = method.integrate(&mut kepler(), &mut state, 2000.0 * core::f64::consts::PI, |step| {
            worst = worst.max((kepler_energy(step.values()) - before).abs());
            ControlFlow::Continue(())
        });
        run.unwrap();
        assert_close(
            "energy",
            &[worst],
            &[0.0],
            Tol::stated(4e-14, "rounding at random, the largest of 25,000 states"),
        );
    }
}
