//! Singular positions: parallelograms whose bars align twice a turn.

use piola_integrators::{DormandPrince853, Field, IntegratorsError, State, Tolerance};
use piola_multibody::{
    BodyIndex, BodyInertia, BodyPoint, ClosedTree, JointKind, LoopClosure, MultibodyError, RigidTree, TreeJoint,
};
use piola_testkit::{Tol, allocations_in, assert_close_at_scale};

const HINGE: JointKind = JointKind::Revolute { axis: [0.0, 0.0, 1.0] };

/// N parallelograms side by side: N + 1 rods that stand on the ground, and N that join their tips; all of 1 kg and 1 m.
fn ladder(n: usize, turn: f64) -> ClosedTree {
    let (sine, cosine) = turn.sin_cos();
    let gravity = [9.81 * sine, -9.81 * cosine, 0.0];
    let mut builder = RigidTree::builder().with_gravity(gravity).unwrap();
    let rod = || {
        let moment = 1.0 / 12.0;
        BodyInertia::new(1.0, [0.5, 0.0, 0.0], [[0.01, 0.0, 0.0], [0.0, moment, 0.0], [0.0, 0.0, moment]]).unwrap()
    };
    for k in 0..=n {
        let foot = TreeJoint::new(format!("foot {k}"), HINGE).at([k as f64 * cosine, k as f64 * sine, 0.0]);
        let post = builder.attach(BodyIndex::GROUND, foot, format!("post {k}"), rod()).unwrap();
        if k < n {
            let knee = TreeJoint::new(format!("knee {k}"), HINGE).at([1.0, 0.0, 0.0]);
            builder.attach(post, knee, format!("rung {k}"), rod()).unwrap();
        }
    }
    let tree = builder.build().unwrap();
    let mut closed = ClosedTree::new(tree);
    for k in 0..n {
        let rung = closed.tree().body(&format!("rung {k}")).unwrap();
        let post = closed.tree().body(&format!("post {}", k + 1)).unwrap();
        let first = BodyPoint::new(rung, [1.0, 0.0, 0.0]);
        let second = BodyPoint::new(post, [1.0, 0.0, 0.0]);
        closed.close(format!("loop {k}"), LoopClosure::Point { first, second }).unwrap();
    }
    closed
}

fn start(n: usize, turn: f64) -> Vec<f64> {
    let right = core::f64::consts::FRAC_PI_2;
    let (mut q, mut v) = (Vec::new(), Vec::new());
    for k in 0..=n {
        q.push(right + turn);
        v.push(-1.0);
        if k < n {
            q.push(-right);
            v.push(1.0);
        }
    }
    [q, v].concat()
}

/// The ladder as the pendulum that it is on its smooth branch: posts turn, rungs only move.
fn pendulum(n: usize, turn: f64) -> RigidTree {
    let (posts, rungs) = (n as f64 + 1.0, n as f64);
    let mass = posts + rungs;
    let centre = (0.5 * posts + rungs) / mass;
    let moment = posts / 3.0 + rungs - mass * centre * centre;
    let inertia =
        BodyInertia::new(mass, [centre, 0.0, 0.0], [[0.5 * moment, 0.0, 0.0], [0.0, moment, 0.0], [0.0, 0.0, moment]]);
    let (sine, cosine) = turn.sin_cos();
    let mut builder = RigidTree::builder().with_gravity([9.81 * sine, -9.81 * cosine, 0.0]).unwrap();
    builder.attach(BodyIndex::GROUND, TreeJoint::new("foot", HINGE), "post", inertia.unwrap()).unwrap();
    builder.build().unwrap()
}

fn method(tolerance: f64) -> DormandPrince853 {
    DormandPrince853::new(Tolerance::relative(tolerance).unwrap()).with_most_steps(2000)
}

fn energy(tree: &RigidTree, values: &[f64]) -> f64 {
    let (q, v) = values.split_at(tree.freedoms());
    let energies = tree.tree_energies(&mut tree.workspace(), q, v).unwrap();
    energies.kinetic + energies.potential
}

fn ladder_swings_as_its_pendulum(n: usize, turn: f64, tolerance: f64) {
    let closed = ladder(n, turn);
    let mut motion = closed.motion(|_t, _q, _v, tau| tau.fill(0.0));
    let mut state = State::new(0.0, start(n, turn)).unwrap();
    let before = energy(closed.tree(), &state.values);
    method(tolerance).integrate_to(&mut motion, &mut state, 10.0).unwrap();
    let change = energy(closed.tree(), &state.values) - before;
    let asked = Tol::stated(1e-8, "what is asked of ten seconds through ten singular positions");
    assert_close_at_scale("energy", &[change], &[0.0], before.abs(), asked);
    assert_eq!(motion.singular_count(), 10, "ladder of {n}");

    let tree = pendulum(n, turn);
    let mut swinging = tree.motion(|_t, _q, _v, tau| tau.fill(0.0));
    let mut single = State::new(0.0, start(0, turn)).unwrap();
    method(1e-11).integrate_to(&mut swinging, &mut single, 10.0).unwrap();
    let angle = single.values[0];
    let expected: Vec<f64> = (0..=2 * n).map(|k| if k % 2 == 0 { angle } else { turn - angle }).collect();
    let tol = Tol::stated(1e4 * tolerance, "ten seconds with local errors of the tolerance");
    assert_close_at_scale("angles", &state.values[..=2 * n], &expected, 1.0, tol);

    // The positions: the posts lie along the ground.
    for (k, position) in motion.singular_positions().iter().enumerate() {
        let mut at = State::new(0.0, start(0, turn)).unwrap();
        method(1e-11).integrate_to(&mut swinging, &mut at, position.t).unwrap();
        let expected = turn - core::f64::consts::PI * k as f64;
        let tol = Tol::stated(2e-2, "linear interpolation over a step of 0.1 s");
        assert_close_at_scale("singular angle", &at.values[..1], &[expected], 1.0, tol);
        assert!(closed.closure_of(position.condition).starts_with("loop"));
    }
}

#[test]
fn parallelogram_passes_aligned_positions_as_its_pendulum() {
    for turn in [0.0, 0.4] {
        ladder_swings_as_its_pendulum(1, turn, 1e-11);
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
fn motion_that_is_to_stop_at_singular_positions_ends_before_the_first() {
    let closed = ladder(1, 0.4);
    let mut motion = closed.motion(|_t, _q, _v, tau| tau.fill(0.0)).stopping_at_singular_positions();
    let mut state = State::new(0.0, start(1, 0.4)).unwrap();
    let error = method(1e-11).integrate_to(&mut motion, &mut state, 10.0).unwrap_err();
    let IntegratorsError::Field { source: MultibodyError::SingularConstraint { closure, t, .. }, .. } = error else {
        panic!("{error}")
    };
    assert_eq!(closure, "loop 0");
    assert!(state.time < t && t < state.time + 0.1, "stopped at {} before {t}", state.time);
    assert!(0.4 < state.values[0] && state.values[0] < 1.0, "{}", state.values[0]);
    assert_eq!(motion.singular_count(), 0);
}

/// A motion that is begun anew knows nothing of the run before.
#[test]
fn restarted_motion_lists_the_positions_of_its_own_run() {
    let closed = ladder(1, 0.0);
    let mut motion = closed.motion(|_t, _q, _v, tau| tau.fill(0.0));
    let mut ends = Vec::new();
    for _ in 0..2 {
        motion.restart();
        assert!(motion.singular_positions().is_empty() && motion.singular_count() == 0);
        let mut state = State::new(0.0, start(1, 0.0)).unwrap();
        method(1e-9).integrate_to(&mut motion, &mut state, 2.0).unwrap();
        assert!(0 < motion.singular_count());
        ends.push((state, motion.singular_positions().to_vec()));
    }
    assert_eq!(ends[0], ends[1]);
}

/// Near an aligned position the run before, from the position in which the loop is most independent, must leave no trace.
#[test]
fn restarted_motion_equals_a_new_one() {
    let closed = ladder(1, 0.0);
    let forces = |_t: f64, _q: &[f64], _v: &[f64], tau: &mut [f64]| tau.fill(0.0);
    let run = |motion: &mut piola_multibody::ClosedMotion<'_, _>, start: Vec<f64>| {
        let mut state = State::new(0.0, start).unwrap();
        let report = method(1e-9).integrate_to(motion, &mut state, 1.0).unwrap();
        (state, report.steps, motion.singular_positions().to_vec())
    };
    let near = vec![0.15, -0.15, 0.15, -2.0, 2.0, -2.0];
    let (mut anew, mut new) = (closed.motion(forces), closed.motion(forces));
    run(&mut anew, start(1, 0.0));
    anew.restart();
    assert_eq!(run(&mut anew, near.clone()), run(&mut new, near));
}

#[test]
fn motion_is_apart_where_its_conditions_are_nearly_as_independent_as_they_were() {
    let closed = ladder(1, 0.4);
    let mut motion = closed.motion(|_t, _q, _v, tau| tau.fill(0.0));
    let at = |angle: f64| [0.4 + angle, -angle, 0.4 + angle, -2.0, 2.0, -2.0];
    let mut rate = [0.0; 6];
    motion.rate(0.0, &at(1.5), &mut rate).unwrap();
    for (t, angle, apart) in [(0.1, 1.4, true), (0.2, 0.4, true), (0.3, 0.2, false), (0.4, 1.4, true)] {
        motion.project(t, &mut at(angle)).unwrap();
        motion.rate(t, &at(angle), &mut rate).unwrap();
        assert_eq!(motion.is_apart(), apart, "{angle}");
    }
}

#[test]
fn steps_beside_and_through_a_singular_position_allocate_nothing() {
    let closed = ladder(1, 0.4);
    let mut motion = closed.motion(|_t, _q, _v, tau| tau.fill(0.0));
    // Before, beside, and behind the position in which the post lies along the ground.
    let at = |angle: f64| [0.4 + angle, -angle, 0.4 + angle, -2.0, 2.0, -2.0];
    let mut rate = [0.0; 6];
    motion.rate(0.0, &at(0.5), &mut rate).unwrap();
    let (count, ()) = allocations_in(|| {
        for (t, angle) in [(0.2, 0.1), (0.3, -0.1)] {
            motion.project(t, &mut at(angle)).unwrap();
            motion.rate(t, &at(angle), &mut rate).unwrap();
        }
    });
    assert_eq!(count, 0);
    assert_eq!(motion.singular_count(), 1);
    let found = motion.singular_positions()[0].t;
    assert_close_at_scale("t", &[found], &[0.25], 1.0, Tol::stated(1e-2, "about the middle of a step of 0.1 s"));
}

/// Rounding beside the positions exceeds some of these tolerances: such a run ends with the error, soon and with its energy.
#[test]
fn runs_with_tight_tolerances_pass_or_end_with_the_error_within_few_steps() {
    for (n, tolerance, passes) in
        [(1, 1e-11, true), (1, 1e-12, false), (2, 1e-11, true), (2, 1e-12, false), (8, 1e-10, true), (8, 1e-12, false)]
    {
        let closed = ladder(n, 0.0);
        let mut motion = closed.motion(|_t, _q, _v, tau| tau.fill(0.0));
        let mut state = State::new(0.0, start(n, 0.0)).unwrap();
        let before = energy(closed.tree(), &state.values);
        match method(tolerance).with_most_steps(1000).integrate_to(&mut motion, &mut state, 10.0) {
            Ok(_) => assert_eq!(motion.singular_count(), 10),
            Err(IntegratorsError::Field { source: MultibodyError::SingularConstraint { .. }, .. }) => assert!(!passes),
            Err(error) => panic!("ladder of {n} at {tolerance:e}: {error}"),
        }
        let change = energy(closed.tree(), &state.values) - before;
        let asked = Tol::stated(1e-9, "what is asked as far as the run came");
        assert_close_at_scale("energy", &[change], &[0.0], before.abs(), asked);
    }
}
