//! Slider-cranks through singular positions. Where crank and rod are equal, they lie across the rail twice a turn, and the slider may
//! go on or stand still. Where the slider drives, so do its dead centres.

use piola_integrators::{DormandPrince853, Field, IntegratorsError, State, Tolerance};
use piola_lagrangian::{ConstraintError, LagrangianError};
use piola_testkit::{Tol, assert_close_at_scale};

use crate::systems::{System, Ties, mechanism};

/// The same motion by the angle of the crank alone, on the branch on which the slider goes on: T = ½ I(φ) φ̇², I = a + b sin² φ, so
/// φ̈ = −½ I′ φ̇²/I.
struct Crank {
    a: f64,
    b: f64,
}

impl Field for Crank {
    type Error = core::convert::Infallible;
    fn dimension(&self) -> usize {
        2
    }
    fn rate(&mut self, _t: f64, y: &[f64], rate: &mut [f64]) -> Result<(), Self::Error> {
        let (sine, cosine) = y[0].sin_cos();
        let inertia = self.a + self.b * sine * sine;
        rate.copy_from_slice(&[y[1], -self.b * sine * cosine * y[1] * y[1] / inertia]);
        Ok(())
    }
}

fn method(tolerance: f64) -> DormandPrince853 {
    DormandPrince853::new(Tolerance::relative(tolerance).unwrap()).with_most_steps(20_000)
}

/// A start at 0.5 rad; with the rod's angle, or without.
fn start(system: System, speed: f64) -> Vec<f64> {
    let (sine, cosine) = 0.5_f64.sin_cos();
    let (place, velocity) = (2.0 * cosine, -2.0 * sine * speed);
    match system {
        System::SliderCrank => vec![0.5, -0.5, place, speed, -speed, velocity],
        _ => vec![0.5, place, speed, velocity],
    }
}

/// Crank: 1/3 about its end. Rod: 1/12 about its centre, which moves at (9 sin² φ + cos² φ)/4. Slider of 2 kg: x = 2 cos φ.
const SYSTEMS: [(System, Ties, Crank); 2] = [
    (System::SliderCrank, Ties::SliderCrank, Crank { a: 2.0 / 3.0, b: 10.0 }),
    (System::SliderOnRod, Ties::SliderOnRod, Crank { a: 1.0 / 3.0, b: 8.0 }),
];

#[test]
fn slider_crank_passes_singular_positions_as_its_crank_alone_at_tolerances_down_to_1e_10() {
    for (system, ties, mut crank) in SYSTEMS {
        for (speed, tolerance) in [(1.0, 1e-9), (3.0, 1e-9), (1.0, 1e-10), (2.3, 1e-10), (3.0, 1e-10), (7.1, 1e-10)] {
            let constrained = mechanism(system, [0.0; 3], 0.0).with_constraints(ties.clone());
            let begin = start(system, speed);
            let n = begin.len() / 2;
            let mut motion = constrained.motion(n);
            let mut state = State::new(0.0, begin).unwrap();
            method(tolerance).integrate_to(&mut motion, &mut state, 10.0).unwrap();
            let mut alone = State::new(0.0, vec![0.5, speed]).unwrap();
            method(1e-13).integrate_to(&mut crank, &mut alone, 10.0).unwrap();
            let [angle, rate] = alone.values[..] else { panic!("{:?}", alone.values) };
            let tol = Tol::stated(
                1e4 * speed * tolerance,
                "local errors of the tolerance, over turns that grow with the speed",
            );
            let found = [state.values[0], state.values[n - 1], state.values[n]];
            assert_close_at_scale("φ, x", &found[..2], &[angle, 2.0 * angle.cos()], angle, tol);
            assert_close_at_scale("φ̇", &found[2..], &[rate], rate, tol);
            // At π/2, 3π/2, …
            let passed = (angle / core::f64::consts::PI + 0.5).floor();
            assert_eq!(
                (motion.singular_count() as f64).to_bits(),
                passed.to_bits(),
                "{n} coordinates at {speed} rad/s"
            );
        }
    }
}

/// Below, rounding beside a position may exceed the tolerance. The run then ends with the error, at a state on the branch.
#[test]
fn slider_crank_at_a_tolerance_of_1e_11_passes_or_ends_with_the_error_on_its_branch() {
    let (mut passed, mut ended) = (0, 0);
    for (system, ties, _) in SYSTEMS {
        for speed in [1.0, 2.146_063_228_500_35, 3.301_984_292_100_671_7, 10.0] {
            let constrained = mechanism(system, [0.0; 3], 0.0).with_constraints(ties.clone());
            let mut state = State::new(0.0, start(system, speed)).unwrap();
            let n = state.values.len() / 2;
            match method(1e-11).integrate_to(&mut constrained.motion(n), &mut state, 10.0) {
                Ok(_) => passed += 1,
                Err(IntegratorsError::Field {
                    source: LagrangianError::Constraint(ConstraintError::Singular { time, .. }),
                    ..
                }) => {
                    assert!(state.time < time && time < state.time + 1e-3, "{} {time}", state.time);
                    ended += 1;
                }
                Err(other) => panic!("{other}"),
            }
            let tol = Tol::stated(1e-7, "a share of a thousandth, at which steps are refused, from rounding");
            let expected = 2.0 * state.values[0].cos();
            assert_close_at_scale("x", &[state.values[n - 1]], &[expected], 1.0, tol);
        }
    }
    assert_eq!(passed + ended, 8);
    assert!(4 <= passed, "{passed} of 8");
}

/// With crank and rod along the rail, twice a turn, the rod and the drive of the slider hold the same.
#[test]
fn crank_that_is_driven_by_its_slider_passes_its_dead_centres() {
    for (rod, begin, tolerance) in [(1.5_f64, 0.5, 1e-10), (2.0, 0.8, 1e-9), (2.0, 0.9, 1e-10), (4.0, 0.8, 1e-10)] {
        let system = mechanism(System::SliderOnRod, [0.0, -9.81, 0.0], 0.0);
        let driven = system.with_constraints(Ties::DrivenSlider { rod });
        let (sine, cosine) = f64::sin_cos(begin);
        let root = (rod * rod - sine * sine).sqrt();
        let mut motion = driven.motion(2);
        let mut state = State::new(begin, vec![begin, cosine + root, 1.0, -sine - sine * cosine / root]).unwrap();
        method(tolerance).integrate_to(&mut motion, &mut state, 20.0).unwrap();
        let tol = Tol::stated(1e-9, "the drive holds the angle; near a dead centre to the root of rounding");
        assert_close_at_scale("φ", &[state.values[0]], &[20.0], 1.0, tol);
        // 0 < π, 2π, …, 6π < 20.
        assert_eq!(motion.singular_count(), 6, "rod of {rod} m");
    }
}
