//! Continued runs beside unbroken ones: the same record, to the last bit.

use core::ops::ControlFlow;

use piola_integrators::Order;
use piola_simulation::constraints::{Constraint, ConstraintKind};
use piola_simulation::expression::{Expression, ExpressionNode as Node, Function, Operation, Variable};
use piola_simulation::joints::{Coordinate, Joint, JointMotion, Mechanism, Part, PartKind};
use piola_simulation::motion::{
    Central, CheckpointKeeper, Method, MotionCheckpoint, MotionRun, Orbiter, System, TimeSpan, Timetable, resume,
    simulate,
};
use piola_simulation::phase::PhaseSystem;
use piola_simulation::{Outcome, SimulationError};

/// Keeps some of the checkpoints, as text.
#[derive(Default)]
struct Kept {
    asked: u32,
    every: u32,
    texts: Vec<String>,
}

impl CheckpointKeeper for Kept {
    fn is_due(&mut self) -> bool {
        self.asked += 1;
        self.asked.is_multiple_of(self.every)
    }
    fn keep(&mut self, checkpoint: &MotionCheckpoint) {
        self.texts.push(serde_json::to_string(checkpoint).unwrap_or_else(|error| panic!("{error}")));
    }
}

fn read(text: &str) -> MotionCheckpoint {
    serde_json::from_str(text).unwrap_or_else(|error| panic!("{error}"))
}

fn run(
    system: &System,
    (method, timetable): (Method, &Timetable),
    from: Option<MotionCheckpoint>,
    every: u32,
) -> (MotionRun, Vec<String>) {
    let mut keeper = Kept { every, ..Kept::default() };
    let run = resume(system, method, timetable, from, &mut keeper, &mut |_| ControlFlow::Continue(()))
        .unwrap_or_else(|error| panic!("{error}"));
    (run, keeper.texts)
}

/// Compares all of two runs.
fn assert_same(run: &MotionRun, unbroken: &MotionRun, what: &str) {
    assert_eq!((&run.outcome, run.time.to_bits()), (&unbroken.outcome, unbroken.time.to_bits()), "{what}");
    let counts = |run: &MotionRun| [run.steps, run.rejected, run.force_evaluations];
    assert_eq!(counts(run), counts(unbroken), "{what}");
    assert!(run.history == unbroken.history, "{what}: another record");
}

/// Compares runs continued from every checkpoint with the unbroken one; returns the number of checkpoints.
fn compare(system: &System, method: Method, timetable: &Timetable, every: u32) -> usize {
    let unbroken = simulate(system, method, timetable, &mut |_| ControlFlow::Continue(()));
    assert_eq!(unbroken.outcome, Outcome::Completed, "{method}");
    let (kept, texts) = run(system, (method, timetable), None, every);
    assert_same(&kept, &unbroken, &format!("{method} with checkpoints"));
    for text in &texts {
        let (continued, _) = run(system, (method, timetable), Some(read(text)), u32::MAX);
        assert_same(&continued, &unbroken, &format!("{method} from {} s", read(text).time()));
    }
    texts.len()
}

fn orbits() -> System {
    let body = |name: &str, mass, position, velocity| Orbiter { name: name.into(), mass, position, velocity };
    let far = body("far", 2.0, [3.0, 4.0, 0.0], [-0.2, 0.1, 0.3]);
    let near = body("near", 3.0, [-1.0, 2.0, 2.0], [0.5, 0.3, -0.2]);
    System::Central(Central { gm: 1.5, bodies: vec![far, near] })
}

#[test]
fn continued_orbits_equal_unbroken_ones_bit_by_bit_with_every_method() {
    // Two landings, and between the instants more steps of 1 ms than a piece has.
    let timetable = Timetable::new(TimeSpan { start: 1.0, end: 8.0 }, 5, &[2.25, 6.5]);
    for method in [
        Method::DormandPrince { tolerance: 1e-12 },
        Method::Verner { tolerance: 1e-12 },
        Method::Nystrom86 { tolerance: 1e-12 },
        Method::Nystrom1210 { tolerance: 1e-12 },
    ] {
        assert!(4 <= compare(&orbits(), method, &timetable, 3), "{method}");
    }
    assert_eq!(compare(&orbits(), Method::ClosedForm, &timetable, 1), 6);
    for method in [
        Method::Composition { order: Order::Eight, step: 1e-3 },
        Method::GaussLegendre { order: Order::Four, step: 1e-3 },
    ] {
        // Six instants after the start, and a piece within each of the four spans between them that are longer than 1 s.
        assert_eq!(compare(&orbits(), method, &timetable, 1), 6 + 4, "{method}");
    }
}

#[test]
fn a_run_backwards_and_one_that_was_continued_twice_equal_unbroken_ones() {
    let (method, timetable) =
        (Method::Verner { tolerance: 1e-11 }, Timetable::new(TimeSpan { start: 4.0, end: -3.0 }, 9, &[0.5]));
    let unbroken = simulate(&orbits(), method, &timetable, &mut |_| ControlFlow::Continue(()));
    let (_, first) = run(&orbits(), (method, &timetable), None, 5);
    let (_, second) = run(&orbits(), (method, &timetable), Some(read(&first[0])), 7);
    let (last, _) = run(&orbits(), (method, &timetable), Some(read(&second[0])), u32::MAX);
    assert_same(&last, &unbroken, "continued twice");
}

/// H = ½ p² − cos q · cos t, whose work is integrated with the motion.
fn driven_pendulum() -> System {
    let nodes = vec![
        Node::Constant(0.5),
        Node::Variable(Variable::Conjugate(0)),
        Node::WholePower(1, 2),
        Node::Operation(Operation::Product, 0, 2),
        Node::Variable(Variable::Coordinate(0)),
        Node::Function(Function::Cos, 4),
        Node::Variable(Variable::Time),
        Node::Function(Function::Cos, 6),
        Node::Operation(Operation::Product, 5, 7),
        Node::Negative(8),
        Node::Operation(Operation::Sum, 3, 9),
    ];
    let expression = Expression::new(nodes).unwrap_or_else(|error| panic!("{error}"));
    let system = PhaseSystem::new(expression, (vec!["q".into()], vec!["p".into()]), vec![1.2], vec![0.3]);
    System::Phase(Box::new(system.unwrap_or_else(|error| panic!("{error}"))))
}

fn double_pendulum() -> System {
    let joint = |parent, offset, name: &str, position| Joint {
        parent,
        offset,
        motion: JointMotion::Revolute([0.0, 1.0, 0.0]),
        coordinates: vec![Coordinate { name: name.into(), angular: true, position, velocity: 0.5 }],
    };
    let joints = vec![joint(None, [0.0; 3], "shoulder", 1.0), joint(Some(0), [0.0, 0.0, -1.0], "elbow", -0.4)];
    let part =
        |joint, name: &str| Part { joint, name: name.into(), at: [0.0, 0.0, -1.0], kind: PartKind::Particle(1.0) };
    let system = Mechanism::new(joints, vec![part(0, "one"), part(1, "other")], [0.0, 0.0, -9.81]);
    System::Mechanism(Box::new(system.unwrap_or_else(|error| panic!("{error}"))))
}

#[test]
fn continued_pendulums_equal_unbroken_ones_bit_by_bit() {
    let timetable = Timetable::new(TimeSpan { start: 0.0, end: 5.0 }, 6, &[]);
    for system in [driven_pendulum(), double_pendulum()] {
        for method in
            [Method::DormandPrince { tolerance: 1e-11 }, Method::GaussLegendre { order: Order::Eight, step: 0.02 }]
        {
            assert!(5 <= compare(&system, method, &timetable, 1), "{method}");
        }
    }
}

#[test]
fn continued_islands_equal_unbroken_ones_bit_by_bit() {
    let joint = |name: &str, position| Joint {
        parent: None,
        offset: [0.0; 3],
        motion: JointMotion::Revolute([0.0, 1.0, 0.0]),
        coordinates: vec![Coordinate { name: name.into(), angular: true, position, velocity: 0.5 }],
    };
    let part = |joint, name: &str, length: f64| Part {
        joint,
        name: name.into(),
        at: [0.0, 0.0, -length],
        kind: PartKind::Particle(1.0),
    };
    let parts = vec![part(0, "slow", 1.0), part(1, "fast", 0.05)];
    let system = Mechanism::new(vec![joint("slow", 1.0), joint("fast", -0.4)], parts, [0.0, 0.0, -9.81]);
    let system = System::Mechanism(Box::new(system.unwrap_or_else(|error| panic!("{error}"))));
    let timetable = Timetable::new(TimeSpan { start: 0.0, end: 5.0 }, 6, &[2.5]);
    for method in [Method::DormandPrince { tolerance: 1e-11 }, Method::Verner { tolerance: 1e-11 }] {
        assert!(20 <= compare(&system, method, &timetable, 5), "{method}");
    }
}

/// A slider on the line z = 0, tied by a rod of 1 m to a crank of 1 m: x = 2 cos φ. At φ = π/2 the rod lies on the crank.
fn slider_crank() -> System {
    let joint = |motion, name: &str, angular, position, velocity| Joint {
        parent: None,
        offset: [0.0; 3],
        motion,
        coordinates: vec![Coordinate { name: name.into(), angular, position, velocity }],
    };
    let (angle, speed) = (0.5_f64, 1.0);
    let joints = vec![
        joint(JointMotion::Revolute([0.0, -1.0, 0.0]), "crank", true, angle, speed),
        joint(JointMotion::Prismatic([1.0, 0.0, 0.0]), "slider", false, 2.0 * angle.cos(), -2.0 * speed * angle.sin()),
    ];
    let part = |joint, name: &str, at| Part { joint, name: name.into(), at, kind: PartKind::Particle(1.0) };
    let parts = vec![part(0, "pin", [1.0, 0.0, 0.0]), part(1, "block", [0.0; 3])];
    let mut system = Mechanism::new(joints, parts, [0.0; 3]).unwrap_or_else(|error| panic!("{error}"));
    let end = |joint, at| system.tree.anchor(Some(joint), at).unwrap_or_else(|error| panic!("{error}"));
    let ends = [end(0, [1.0, 0.0, 0.0]), end(1, [0.0; 3])];
    let rod = Constraint { name: "rod".into(), kind: ConstraintKind::Distance { ends, length: 1.0 } };
    system.reactions = true;
    System::Mechanism(Box::new(system.with_constraints(vec![rod]).unwrap_or_else(|error| panic!("{error}"))))
}

#[test]
fn continued_motions_under_constraints_equal_unbroken_ones_bit_by_bit() {
    let timetable = Timetable::new(TimeSpan { start: 0.0, end: 300.0 }, 31, &[100.25]);
    let method = Method::DormandPrince { tolerance: 1e-10 };
    let system = slider_crank();
    let checkpoints = compare(&system, method, &timetable, 1);
    assert!(2 <= checkpoints, "{checkpoints}");
    let unbroken = simulate(&system, method, &timetable, &mut |_| ControlFlow::Continue(()));
    // Two in each turn; they come from before and after the pieces.
    assert!(40 < unbroken.history.singular_positions.len(), "{}", unbroken.history.singular_positions.len());
    // Stopped within a piece, it goes on from the beginning of the piece.
    for stop in [3, unbroken.steps / 2, unbroken.steps - 1] {
        let mut keeper = Kept { every: u32::MAX, ..Kept::default() };
        let stopped = resume(&system, method, &timetable, None, &mut keeper, &mut |progress| {
            if progress.steps == stop { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        assert!(matches!(stopped, Ok(run) if (&run.outcome, run.steps) == (&Outcome::Interrupted, stop)));
        let [text] = &keeper.texts[..] else { panic!("{} checkpoints", keeper.texts.len()) };
        let (continued, _) = run(&system, (method, &timetable), Some(read(text)), u32::MAX);
        assert_same(&continued, &unbroken, &format!("stopped after {stop} steps"));
    }
}

#[test]
fn a_checkpoint_of_another_run_or_version_is_refused_by_name() {
    let (method, timetable) =
        (Method::Verner { tolerance: 1e-11 }, Timetable::new(TimeSpan { start: 0.0, end: 4.0 }, 9, &[]));
    let (_, texts) = run(&orbits(), (method, &timetable), None, 2);
    let checkpoint = read(&texts[0]);
    let other = |system: &System, method, timetable: &Timetable| checkpoint.check(system, method, timetable);
    assert_eq!(other(&orbits(), method, &timetable), Ok(()));
    let System::Central(mut heavier) = orbits() else { panic!() };
    heavier.gm = 1.5_f64.next_up();
    let refused = Err(SimulationError::CheckpointOfOtherRun);
    assert_eq!(other(&System::Central(heavier), method, &timetable), refused);
    assert_eq!(other(&orbits(), Method::DormandPrince { tolerance: 1e-11 }, &timetable), refused);
    assert_eq!(other(&orbits(), Method::Verner { tolerance: 1e-12 }, &timetable), refused);
    assert_eq!(other(&orbits(), method, &Timetable::new(timetable.span(), 10, &[])), refused);
    let version = env!("CARGO_PKG_VERSION");
    let text = texts[0].replace(&format!("\"version\":\"{version}\""), "\"version\":\"0.0.9\"");
    let error = read(&text).check(&orbits(), method, &timetable);
    let expected =
        SimulationError::CheckpointOfOtherVersion { found: "0.0.9".to_string(), expected: version.to_string() };
    assert_eq!(error, Err(expected.clone()));
    assert_eq!(expected.to_string(), format!("the checkpoint is of Piola 0.0.9; this is Piola {version}"));
}

#[test]
fn a_run_that_is_stopped_leaves_a_checkpoint_where_it_stopped() {
    let timetable = Timetable::new(TimeSpan { start: 1.0, end: 8.0 }, 5, &[2.25, 6.5]);
    let fixed = [
        Method::Composition { order: Order::Eight, step: 1e-3 },
        Method::GaussLegendre { order: Order::Four, step: 1e-3 },
    ];
    let others = [Method::Verner { tolerance: 1e-12 }, Method::Nystrom1210 { tolerance: 1e-12 }, Method::ClosedForm];
    for method in fixed.into_iter().chain(others) {
        let unbroken = simulate(&orbits(), method, &timetable, &mut |_| ControlFlow::Continue(()));
        for stop in [1, 3, unbroken.steps / 2, unbroken.steps - 1] {
            let mut keeper = Kept { every: u32::MAX, ..Kept::default() };
            let stopped = resume(&orbits(), method, &timetable, None, &mut keeper, &mut |progress| {
                if progress.steps == stop { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            });
            let stopped = stopped.unwrap_or_else(|error| panic!("{error}"));
            assert_eq!((stopped.outcome, stopped.steps), (Outcome::Interrupted, stop), "{method}");
            let [text] = &keeper.texts[..] else { panic!("{method}: {} checkpoints", keeper.texts.len()) };
            // A method of fixed step goes on from the last instant or the last thousand steps.
            let lost = stopped.time - read(text).time();
            let most = method.step().map_or(0.0, |step| 1000.5 * step);
            assert!((0.0..=most).contains(&lost), "{method} at {stop}: {lost} s");
            let (continued, _) = run(&orbits(), (method, &timetable), Some(read(text)), u32::MAX);
            assert_same(&continued, &unbroken, &format!("{method} stopped after {stop} steps"));
        }
    }
}

#[test]
fn a_checkpoint_that_was_changed_is_refused() {
    let timetable = Timetable::new(TimeSpan { start: 0.0, end: 4.0 }, 9, &[]);
    for method in [Method::ClosedForm, Method::Verner { tolerance: 1e-11 }] {
        let (_, texts) = run(&orbits(), (method, &timetable), None, 2);
        let whole: serde_json::Value = serde_json::from_str(&texts[0]).unwrap_or_else(|error| panic!("{error}"));
        let with = |path: &str, value: serde_json::Value| {
            let mut changed = whole.clone();
            *changed.pointer_mut(path).unwrap_or_else(|| panic!("no {path}: {whole}")) = value;
            let changed: MotionCheckpoint = serde_json::from_value(changed).unwrap_or_else(|error| panic!("{error}"));
            changed.check(&orbits(), method, &timetable)
        };
        let changes = [("/body/next", 1_000_000.into()), ("/body/landing", 7.into()), ("/body/steps", 0.into())];
        let history = ("/body/history/times", serde_json::json!([0.0]));
        for (path, value) in changes.into_iter().chain([history]) {
            assert_eq!(with(path, value), Err(SimulationError::CheckpointChanged), "{path}");
        }
        assert_eq!(with("/body/next", whole["body"]["next"].clone()), Ok(()));
    }
}
