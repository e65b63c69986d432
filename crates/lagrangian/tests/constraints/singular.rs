//! Singular positions: parallelograms whose bars align twice a turn.

use core::f64::consts::{FRAC_PI_2, PI};

use piola_integrators::{DormandPrince853, Field, IntegratorsError, State, Tolerance};
use piola_lagrangian::constraints::{Constrained, Constraints};
use piola_lagrangian::{ConstraintError, LagrangianError};
use piola_testkit::{Tol, allocations_in, assert_close_at_scale};

use crate::systems::{Drive, Spring, System, Ties, mechanism};

type Ladder = Constrained<System, Spring, Drive, Ties>;

fn ladder(n: usize, turn: f64) -> Ladder {
    let (sine, cosine) = turn.sin_cos();
    mechanism(System::Ladder { turn }, [9.81 * sine, -9.81 * cosine, 0.0], 0.0)
        .with_constraints(Ties::Ladder { n, turn })
}

/// Posts across the ground, rungs along it: they fall to the right.
fn start(n: usize, turn: f64) -> Vec<f64> {
    let q = (0..=2 * n).map(|k| if k % 2 == 0 { FRAC_PI_2 + turn } else { turn });
    let v = (0..=2 * n).map(|k| if k % 2 == 0 { -1.0 } else { 0.0 });
    q.chain(v).collect()
}

fn method(tolerance: f64) -> DormandPrince853 {
    DormandPrince853::new(Tolerance::relative(tolerance).unwrap()).with_most_steps(2000)
}

/// The ladder as the pendulum that it is on its smooth branch: α̈ = −(m g c / I) cos α.
struct Pendulum {
    stiffness: f64,
}

impl Pendulum {
    fn of(n: usize) -> Self {
        let (posts, rungs) = (n as f64 + 1.0, n as f64);
        Self { stiffness: 9.81 * (0.5 * posts + rungs) / (posts / 3.0 + rungs) }
    }
    /// The angle from the ground.
    fn at(&mut self, t: f64) -> f64 {
        let mut state = State::new(0.0, vec![FRAC_PI_2, -1.0]).unwrap();
        method(1e-13).integrate_to(self, &mut state, t).unwrap();
        state.values[0]
    }
}

impl Field for Pendulum {
    type Error = core::convert::Infallible;
    fn dimension(&self) -> usize {
        2
    }
    fn rate(&mut self, _t: f64, y: &[f64], rate: &mut [f64]) -> Result<(), Self::Error> {
        rate.copy_from_slice(&[y[1], -self.stiffness * y[0].cos()]);
        Ok(())
    }
}

fn ladder_swings_as_its_pendulum(n: usize, turn: f64, tolerance: f64) {
    let system = ladder(n, turn);
    let count = 2 * n + 1;
    let mut motion = system.motion(count);
    let mut state = State::new(0.0, start(n, turn)).unwrap();
    let energy = |values: &[f64]| {
        let (q, v) = values.split_at(count);
        system.unconstrained().energies(q, v, 0.0).unwrap().total()
    };
    let before = energy(&state.values);
    method(tolerance).integrate_to(&mut motion, &mut state, 10.0).unwrap();
    let change = energy(&state.values) - before;
    let asked = Tol::stated(1e-8, "what is asked of ten seconds through ten singular positions");
    assert_close_at_scale("energy", &[change], &[0.0], before.abs(), asked);
    assert_eq!(motion.singular_count(), 10, "ladder of {n}");

    let mut pendulum = Pendulum::of(n);
    let angle = turn + pendulum.at(10.0);
    let expected: Vec<f64> = (0..count).map(|k| if k % 2 == 0 { angle } else { turn }).collect();
    let tol = Tol::stated(1e4 * tolerance, "ten seconds with local errors of the tolerance");
    assert_close_at_scale("angles", &state.values[..count], &expected, 1.0, tol);
    for (k, position) in motion.singular_positions().iter().enumerate() {
        let tol = Tol::stated(5e-2, "linear interpolation over a step of 0.1 s");
        let angle = pendulum.at(position.t);
        assert_close_at_scale("singular angle", &[angle], &[-PI * k as f64], 1.0, tol);
    }
}

#[test]
fn parallelogram_passes_aligned_positions_as_its_pendulum() {
    for (turn, tolerance) in [(0.0, 1e-9), (0.4, 1e-9), (0.0, 1e-11), (0.4, 1e-11)] {
        ladder_swings_as_its_pendulum(1, turn, tolerance);
    }
}

#[test]
fn ladder_of_two_passes_aligned_positions_as_its_pendulum() {
    for turn in [0.0, 0.4] {
        ladder_swings_as_its_pendulum(2, turn, 1e-9);
    }
}

#[test]
fn ladder_of_eight_passes_aligned_positions_as_its_pendulum() {
    ladder_swings_as_its_pendulum(8, 0.0, 1e-9);
}

#[test]
fn run_lists_its_singular_positions_by_the_names_of_constraints() {
    let system = ladder(1, 0.0);
    let start = start(1, 0.0);
    let (q, v) = start.split_at(3);
    let run = system.integrate(q, v, 0.0..2.0, Tolerance::relative(1e-9).unwrap()).unwrap();
    let [first, second] = run.singular_positions() else { panic!("{:?}", run.singular_positions()) };
    let mut pendulum = Pendulum::of(1);
    for (position, angle) in [(first, 0.0), (second, -PI)] {
        let tol = Tol::stated(5e-2, "linear interpolation over a step of 0.1 s");
        assert_close_at_scale("angle", &[pendulum.at(position.t)], &[angle], 1.0, tol);
        // Bars along x: their gradients along y still differ.
        assert_eq!(system.constraints().name(position.condition), Some("loop along x"));
    }
    assert!(run.error_estimate() < 1e-6, "{}", run.error_estimate());
}

#[test]
fn motion_that_is_to_stop_at_singular_positions_ends_before_the_first() {
    let system = ladder(2, 0.4);
    let mut motion = system.motion(5).stopping_at_singular_positions();
    let mut state = State::new(0.0, start(2, 0.4)).unwrap();
    let error = method(1e-9).integrate_to(&mut motion, &mut state, 10.0).unwrap_err();
    let IntegratorsError::Field {
        source: LagrangianError::Constraint(ConstraintError::Singular { name, time, .. }),
        ..
    } = error
    else {
        panic!("{error}")
    };
    assert!(name.is_some_and(|name| name.starts_with("loop along")));
    assert!(state.time < time && time < state.time + 0.1, "stopped at {} before {time}", state.time);
    assert!(0.4 < state.values[0] && state.values[0] < 1.0, "{}", state.values[0]);
    assert_eq!(motion.singular_count(), 0);
}

/// With the bars along each other nothing tells the branches apart.
#[test]
fn motion_from_a_singular_position_ends_with_the_error() {
    let system = ladder(1, 0.0);
    let mut motion = system.motion(3);
    let mut state = State::new(0.0, vec![0.0, 0.0, 0.0, 1.0, 0.0, 1.0]).unwrap();
    let error = method(1e-9).integrate_to(&mut motion, &mut state, 1.0).unwrap_err();
    let IntegratorsError::Field { source: LagrangianError::Constraint(ConstraintError::Singular { .. }), .. } = error
    else {
        panic!("{error}")
    };
}

/// Bars aligned but for 10⁻⁴, along x and along y: the first such step is refused, by the constraint whose gradient vanishes.
#[test]
fn step_that_ends_close_by_a_singular_position_is_refused_with_the_name_of_its_constraint() {
    for (turn, expected) in [(0.0, "loop along x"), (FRAC_PI_2, "loop along y")] {
        let system = ladder(1, turn);
        let mut motion = system.motion(3);
        let at = |angle: f64| [turn + angle, turn, turn + angle, -2.0, 0.0, -2.0];
        motion.rate(0.0, &at(0.5), &mut [0.0; 6]).unwrap();
        let error = motion.project(0.25, &mut at(1e-4)).unwrap_err();
        let LagrangianError::Constraint(ConstraintError::Singular { name, time, .. }) = error else {
            panic!("{error}")
        };
        assert_eq!((name.as_deref(), time), (Some(expected), 0.25));
    }
}

/// Tolerances near rounding: the run passes or ends with the error, within few steps.
#[test]
fn run_with_too_tight_a_tolerance_passes_or_ends_with_the_error_within_few_steps() {
    for tolerance in [1e-13, 1e-14] {
        let system = ladder(2, 0.0);
        let mut motion = system.motion(5);
        let mut state = State::new(0.0, start(2, 0.0)).unwrap();
        match method(tolerance).with_most_steps(1000).integrate_to(&mut motion, &mut state, 1.0) {
            Ok(_) => assert_eq!(motion.singular_count(), 1),
            Err(IntegratorsError::Field {
                source: LagrangianError::Constraint(ConstraintError::Singular { .. }),
                ..
            }) => assert!(state.time < 1.0),
            Err(other) => panic!("{tolerance:e}: {other}"),
        }
    }
}

/// A motion that is begun anew knows nothing of the run before.
#[test]
fn restarted_motion_lists_the_positions_of_its_own_run() {
    let system = ladder(1, 0.0);
    let mut motion = system.motion(3);
    let mut ends = Vec::new();
    for _ in 0..2 {
        motion.restart();
        assert!(motion.singular_positions().is_empty() && motion.singular_count() == 0);
        let mut state = State::new(0.0, start(1, 0.0)).unwrap();
        method(1e-9).integrate_to(&mut motion, &mut state, 2.0).unwrap();
        ends.push((state, motion.singular_positions().to_vec()));
    }
    assert_eq!(ends[0], ends[1]);
    assert_eq!(ends[0].1.len(), 2);
}

/// A run may end where the bars are aligned but for 10⁻⁶: the state is accepted as it is.
#[test]
fn run_may_end_close_by_a_singular_position() {
    let (mut early, mut late) = (0.70, 0.72);
    let mut pendulum = Pendulum::of(1);
    while 1e-13 < late - early {
        let middle = 0.5 * (early + late);
        *(if 1e-6 < pendulum.at(middle) { &mut early } else { &mut late }) = middle;
    }
    let system = ladder(1, 0.0);
    let mut motion = system.motion(3);
    let mut state = State::new(0.0, start(1, 0.0)).unwrap();
    method(1e-10).integrate_to(&mut motion, &mut state, late).unwrap();
    assert_close_at_scale("angle", &state.values[..1], &[1e-6], 1.0, Tol::stated(1e-8, "a hundred tolerances"));
}

#[test]
fn steps_beside_and_through_a_singular_position_allocate_nothing() {
    let system = ladder(1, 0.4);
    let mut motion = system.motion(3);
    // Before, beside, and behind the position in which the post lies along the ground.
    let at = |angle: f64| [0.4 + angle, 0.4, 0.4 + angle, -2.0, 0.0, -2.0];
    let mut rate = [0.0; 6];
    motion.rate(0.0, &at(0.5), &mut rate).unwrap();
    let mut pass = |states: [(f64, f64); 2]| {
        for (t, angle) in states {
            motion.project(t, &mut at(angle)).unwrap();
            motion.rate(t, &at(angle), &mut rate).unwrap();
        }
    };
    pass([(0.1, 0.3), (0.2, 0.1)]);
    let (count, ()) = allocations_in(|| pass([(0.25, 0.1), (0.35, -0.1)]));
    assert_eq!(count, 0);
    assert_eq!(motion.singular_count(), 1);
    let found = motion.singular_positions()[0].t;
    assert_close_at_scale("t", &[found], &[0.3], 1.0, Tol::stated(1e-2, "about the middle of a step of 0.1 s"));
}
