//! Forces on mechanisms beside closed forms, and the balance of energy and work.

use core::ops::ControlFlow;

use piola_integrators::Order;
use piola_simulation::expression::{Expression, ExpressionNode as Node, Function, Operation, Variable};
use piola_simulation::forces::{Force, ForceKind};
use piola_simulation::joints::{Coordinate, Joint, JointMotion, Mechanism, Part, PartKind};
use piola_simulation::motion::{Method, MotionRun, System, TimeSpan, Timetable, simulate};
use piola_simulation::{Outcome, SimulationError};
use piola_testkit::{Tol, allocations_in, assert_close};

fn joint(parent: Option<usize>, offset: [f64; 3], motion: JointMotion, state: &[[f64; 2]]) -> Joint {
    let angular = !matches!(motion, JointMotion::Prismatic(_));
    let coordinate = |(index, &[position, velocity]): (usize, &[f64; 2])| Coordinate {
        name: format!("q{index}"),
        angular,
        position,
        velocity,
    };
    Joint { parent, offset, motion, coordinates: state.iter().enumerate().map(coordinate).collect() }
}

fn particle(joint: usize, mass: f64, at: [f64; 3]) -> Part {
    Part { joint, name: format!("on {joint}"), at, kind: PartKind::Particle(mass) }
}

fn mechanism(joints: Vec<Joint>, parts: Vec<Part>, gravity: f64) -> Mechanism {
    Mechanism::new(joints, parts, [0.0, 0.0, -gravity]).unwrap_or_else(|error| panic!("{error}"))
}

fn with(mechanism: &Mechanism, kinds: Vec<ForceKind>) -> Mechanism {
    let named = |(index, kind)| Force { name: format!("force {index}"), kind };
    let forces = kinds.into_iter().enumerate().map(named).collect();
    mechanism.clone().with_forces(forces).unwrap_or_else(|error| panic!("{error}"))
}

/// A mass on a rail along x.
fn block(mass: f64, place: f64, speed: f64) -> Mechanism {
    let rail = joint(None, [0.0; 3], JointMotion::Prismatic([1.0, 0.0, 0.0]), &[[place, speed]]);
    mechanism(vec![rail], vec![particle(0, mass, [0.0; 3])], 0.0)
}

/// Two rods in the plane x–z.
fn double_pendulum() -> Mechanism {
    let about = JointMotion::Revolute([0.0, -1.0, 0.0]);
    let joints =
        vec![joint(None, [0.0; 3], about, &[[0.7, -0.4]]), joint(Some(0), [0.0, 0.0, -1.0], about, &[[0.5, 1.1]])];
    mechanism(joints, vec![particle(0, 1.0, [0.0, 0.0, -1.0]), particle(1, 2.0, [0.0, 0.0, -0.5])], 9.81)
}

fn run(system: &Mechanism, method: Method, end: f64) -> MotionRun {
    let timetable = Timetable::new(TimeSpan { start: 0.0, end }, 5, &[]);
    let run =
        simulate(&System::Mechanism(Box::new(system.clone())), method, &timetable, &mut |_| ControlFlow::Continue(()));
    assert_eq!(run.outcome, Outcome::Completed);
    run
}

const FINE: Method = Method::DormandPrince { tolerance: 1e-14 };

fn drift(run: &MotionRun) -> f64 {
    run.history.drifts().energy.map_or(f64::NAN, |drift| drift.max_relative)
}

/// 3 cos(2 t), as a force.
fn cosine(amplitude: f64, rate: f64) -> Expression {
    let nodes = vec![
        Node::Constant(amplitude),
        Node::Constant(rate),
        Node::Variable(Variable::Time),
        Node::Operation(Operation::Product, 1, 2),
        Node::Function(Function::Cos, 3),
        Node::Operation(Operation::Product, 0, 4),
    ];
    Expression::new(nodes).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn a_damped_oscillator_follows_its_closed_form_and_loses_what_the_damper_takes() {
    // ẍ + 2 δ ẋ + ω₀² x = 0 with δ = c/2m = 0.2, ω₀² = k/m = 4; from x = 1, ẋ = 0.
    let kind = ForceKind::JointSpring { coordinate: 0, stiffness: 8.0, rest: 0.0, damping: 0.8 };
    let system = with(&block(2.0, 1.0, 0.0), vec![kind]);
    let (delta, omega) = (0.2_f64, (4.0_f64 - 0.04).sqrt());
    for method in [FINE, Method::GaussLegendre { order: Order::Eight, step: 0.05 }] {
        let run = run(&system, method, 6.0);
        let mut compared = 0;
        for ((t, state), works) in run.history.times.iter().zip(&run.history.coordinates).zip(&run.history.works) {
            let (sine, cosine) = (omega * t).sin_cos();
            let decay = (-delta * t).exp();
            let place = decay * (cosine + delta / omega * sine);
            let speed = -decay * 4.0 / omega * sine;
            assert_close("state", state, &[place, speed], Tol::stated(1e-12, "the tolerance times some hundred steps"));
            let energy = 0.5 * 2.0 * speed * speed + 0.5 * 8.0 * place * place;
            assert_close("work", works, &[energy - 4.0], Tol::stated(1e-11, "as the state, relative to 4 J"));
            compared += 1;
        }
        assert_eq!(compared, 5);
        assert_eq!(run.history.work_names, ["force 0"]);
        assert_close("drift", &[drift(&run)], &[0.0], Tol::stated(1e-12, "the tolerance times the steps"));
    }
}

#[test]
fn a_body_that_falls_through_air_comes_to_its_terminal_speed() {
    // v = √(m g/c) tanh(√(g c/m) t)
    let rail = joint(None, [0.0; 3], JointMotion::Prismatic([0.0, 0.0, -1.0]), &[[0.0, 0.0]]);
    let stone = mechanism(vec![rail], vec![particle(0, 3.0, [0.0; 3])], 9.81);
    let points = vec![stone.tree.anchor(Some(0), [0.0; 3]).unwrap_or_else(|error| panic!("{error}"))];
    let drag = ForceKind::Drag { points, linear: 0.0, quadratic: 0.5, wind: [0.0; 3] };
    let run = run(&with(&stone, vec![drag]), FINE, 4.0);
    let (terminal, rate) = ((3.0_f64 * 9.81 / 0.5).sqrt(), (9.81_f64 * 0.5 / 3.0).sqrt());
    let last = run.history.coordinates.last().unwrap_or_else(|| panic!("no record"));
    let tolerance = Tol::stated(1e-12, "the tolerance times the steps");
    assert_close("speed", &last[1..], &[terminal * (4.0 * rate).tanh()], tolerance);
    assert_close("depth", &last[..1], &[terminal / rate * (4.0 * rate).cosh().ln()], tolerance);
    assert_close("drift", &[drift(&run)], &[0.0], Tol::stated(1e-12, "the tolerance times the steps"));
}

#[test]
fn wind_carries_a_free_body_along() {
    // v = w (1 − e^(−c t/m))
    let system = block(2.0, 0.0, 0.0);
    let points = vec![system.tree.anchor(Some(0), [0.0; 3]).unwrap_or_else(|error| panic!("{error}"))];
    let drag = ForceKind::Drag { points, linear: 0.5, quadratic: 0.0, wind: [3.0, 7.0, 0.0] };
    let run = run(&with(&system, vec![drag]), FINE, 2.0);
    let last = run.history.coordinates.last().unwrap_or_else(|| panic!("no record"));
    let tolerance = Tol::stated(1e-13, "the tolerance times the steps");
    assert_close("speed", &last[1..], &[3.0 * (1.0 - (-0.5_f64).exp())], tolerance);
}

#[test]
fn a_motor_and_a_potential_that_depends_on_time_do_the_same() {
    // m v̇ = 3 cos 2t, as a force and as V = −3 cos(2t) x: one state, and what enters differs by V.
    let motor = ForceKind::Motor { coordinate: 0, force: cosine(3.0, 2.0) };
    let force = cosine(-3.0, 2.0);
    let field = force
        .nodes()
        .iter()
        .copied()
        .chain([Node::Variable(Variable::Coordinate(0)), Node::Operation(Operation::Product, 5, 6)]);
    let energy = Expression::new(field.collect()).unwrap_or_else(|error| panic!("{error}"));
    let by_motor = run(&with(&block(2.0, 0.0, 0.0), vec![motor]), FINE, 3.0);
    let by_field = run(&with(&block(2.0, 0.0, 0.0), vec![ForceKind::Potential { energy }]), FINE, 3.0);
    for (one, other) in by_motor.history.coordinates.iter().zip(&by_field.history.coordinates) {
        assert_close("state", one, other, Tol::stated(1e-13, "the tolerance times the steps"));
    }
    let last = by_motor.history.coordinates.last().unwrap_or_else(|| panic!("no record"));
    assert_close("speed", &last[1..], &[0.75 * 6.0_f64.sin()], Tol::stated(1e-13, "the tolerance times the steps"));
    for run in [&by_motor, &by_field] {
        assert_close("drift", &[drift(run)], &[0.0], Tol::stated(1e-12, "the tolerance times the steps"));
    }
    // W = ∫ 6 sin 2t x dt with x = ⅜ (1 − cos 2t)
    let entered = 2.25 * (1.0 - 6.0_f64.cos()).powi(2) / 4.0;
    let tolerance = Tol::stated(1e-10, "1e-13 of the energies met, of which this is a thousandth");
    assert_close("work", &by_field.history.works[4], &[entered], tolerance);
}

#[test]
fn the_pull_of_a_spring_equals_its_stretch_along_the_line() {
    // From (1, 0, 0) to the second bob, k = 5 N/m, l = 0.25 m: Q = f·∂x/∂q by hand.
    let system = double_pendulum();
    let anchor = |joint, at| system.tree.anchor(joint, at).unwrap_or_else(|error| panic!("{error}"));
    let ends = [anchor(None, [1.0, 0.0, 0.0]), anchor(Some(1), [0.0, 0.0, -0.5])];
    let (stiffness, length, damping) = (5.0, 0.25, 0.75);
    let sprung = with(&system, vec![ForceKind::Spring { ends, stiffness, length, damping }]);
    let (q, v) = ([0.7_f64, 0.5], [-0.4, 1.1]);
    let ((s, c), (s2, c2)) = (q[0].sin_cos(), (q[0] + q[1]).sin_cos());
    let place = [s + 0.5 * s2, -c - 0.5 * c2];
    let columns = [[c + 0.5 * c2, s + 0.5 * s2], [0.5 * c2, 0.5 * s2]];
    let line = [place[0] - 1.0, place[1]];
    let distance = line[0].hypot(line[1]);
    let along = |column: [f64; 2]| (column[0] * line[0] + column[1] * line[1]) / distance;
    let rate = v[0] * along(columns[0]) + v[1] * along(columns[1]);
    let pull = -(stiffness * (distance - length) + damping * rate);
    let forcing = |system: &Mechanism| {
        let (mut metric, mut forcing) = ([0.0; 4], [0.0; 2]);
        let work = &mut piola_lagrangian::Workspace::default();
        let formed = system.lagrangian().equations_into(work, &q, &v, 0.0, &mut metric, &mut forcing);
        formed.unwrap_or_else(|error| panic!("{error}"));
        forcing
    };
    let (free, all) = (forcing(&system), forcing(&sprung));
    let difference = [all[0] - free[0], all[1] - free[1]];
    assert_close("forces", &difference, &[pull * along(columns[0]), pull * along(columns[1])], Tol::ulps(64.0));
    assert_close(
        "power",
        &[sprung.forces[0].kind.power(&sprung.tree, &q, &v, 0.0)],
        &[-damping * rate * rate],
        Tol::ulps(16.0),
    );
}

/// A double pendulum with every kind of force.
fn everything() -> Mechanism {
    let system = double_pendulum();
    let anchor = |joint, at| system.tree.anchor(joint, at).unwrap_or_else(|error| panic!("{error}"));
    let (first, second) = (anchor(Some(0), [0.0, 0.0, -1.0]), anchor(Some(1), [0.0, 0.0, -0.5]));
    let weighted = vec![(first.clone(), 1.0), (second.clone(), 2.0)];
    let ends = [first.clone(), second.clone()];
    with(
        &system,
        vec![
            ForceKind::Spring {
                ends: [anchor(None, [1.0, 0.5, 0.0]), second.clone()],
                stiffness: 5.0,
                length: 0.2,
                damping: 0.3,
            },
            ForceKind::Spring { ends, stiffness: 2.0, length: 0.0, damping: 0.0 },
            ForceKind::JointSpring { coordinate: 1, stiffness: 1.5, rest: 0.2, damping: 0.1 },
            ForceKind::Uniform { points: weighted.clone(), field: [0.5, 0.25, 0.0] },
            ForceKind::Central { points: weighted, centre: [3.0, 0.0, 1.0], gm: 4.0 },
            ForceKind::Drag { points: vec![first, second], linear: 0.1, quadratic: 0.2, wind: [1.0, 0.0, 0.0] },
            ForceKind::Motor { coordinate: 0, force: cosine(0.5, 3.0) },
        ],
    )
}

#[test]
fn energy_less_work_is_kept_under_every_kind_of_force() {
    let system = everything();
    let adaptive = run(&system, Method::Verner { tolerance: 1e-14 }, 5.0);
    assert_close("drift", &[drift(&adaptive)], &[0.0], Tol::stated(1e-12, "the tolerance times the steps"));
    let fixed = run(&system, Method::GaussLegendre { order: Order::Eight, step: 0.005 }, 5.0);
    for (one, other) in adaptive.history.coordinates.iter().zip(&fixed.history.coordinates) {
        assert_close("state", one, other, Tol::stated(1e-9, "both methods to 1e-13 a step, in a chaotic motion"));
    }
    assert_eq!(adaptive.history.work_names, ["force 0", "force 2", "force 5", "force 6"]);
}

#[test]
fn powers_equal_the_applied_forces_times_the_velocities() {
    let system = everything();
    let lagrangian = system.lagrangian();
    let mut compared = 0;
    for i in 0..20 {
        let x = f64::from(i);
        let (q, v, t) = ([0.3 * x - 2.0, 1.0 - 0.2 * x], [0.5 - 0.1 * x, 0.07 * x], 0.11 * x);
        let balance = lagrangian.power_balance(&q, &v, t).unwrap_or_else(|error| panic!("{error}"));
        let powers: f64 = system.forces.iter().map(|force| force.kind.power(&system.tree, &q, &v, t)).sum();
        assert_close("power", &[powers], &[balance.applied], Tol::stated(1e-13, "sums of some ten terms of size 10"));
        compared += 1;
    }
    assert_eq!(compared, 20);
}

#[test]
fn evaluations_of_forces_allocate_nothing() {
    use piola_lagrangian::{Forces as _, Potential as _};
    let system = everything();
    let lagrangian = system.lagrangian();
    let (q, v, mut out) = ([0.3, -0.2], [0.5, 0.7], [0.0; 2]);
    let (count, sum) = allocations_in(|| {
        lagrangian.forces().generalised(&q, &v, 0.5, &mut out);
        let powers: f64 = system.forces.iter().map(|force| force.kind.power(&system.tree, &q, &v, 0.5)).sum();
        lagrangian.potential().potential(&q, &[], 0.5) + powers
    });
    assert!(sum.is_finite() && out.iter().all(|force| force.is_finite()));
    assert_eq!(count, 0);
}

#[test]
fn forces_that_cannot_be_are_refused_by_name() {
    let system = block(1.0, 0.0, 0.0);
    let refused = |kind| system.clone().with_forces(vec![Force { name: "it".into(), kind }]).err();
    let spring = |stiffness, rest| ForceKind::JointSpring { coordinate: 0, stiffness, rest, damping: 0.0 };
    assert_eq!(refused(spring(-1.0, 0.0)), Some(SimulationError::Negative { quantity: "stiffness", value: -1.0 }));
    let not_finite = SimulationError::NotFinite { quantity: "rest", index: 0, value: f64::INFINITY };
    assert_eq!(refused(spring(1.0, f64::INFINITY)), Some(not_finite));
    let motor = |node| ForceKind::Motor {
        coordinate: 0,
        force: Expression::new(vec![node]).unwrap_or_else(|error| panic!("{error}")),
    };
    let third = Node::Variable(Variable::Conjugate(2));
    assert_eq!(
        refused(motor(third)),
        Some(SimulationError::NoSuchCoordinate { quantity: "force", coordinate: 2, coordinates: 1 })
    );
    let own = Node::Variable(Variable::Conjugate(0));
    let energy = Expression::new(vec![own]).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(
        refused(ForceKind::Potential { energy }),
        Some(SimulationError::DependsOnRate { quantity: "energy", coordinate: 0 })
    );
    let far = double_pendulum().tree.anchor(Some(1), [0.0; 3]).unwrap_or_else(|error| panic!("{error}"));
    let elsewhere = ForceKind::Uniform { points: vec![(far, 1.0)], field: [0.0; 3] };
    assert_eq!(refused(elsewhere), Some(SimulationError::NoSuchJoint { joint: 1, joints: 1 }));
}
