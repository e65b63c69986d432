//! Constraints on mechanisms beside closed forms and beside the same systems without them.

use core::ops::ControlFlow;

use piola_integrators::Order;
use piola_kinematics::{Inertia, RigidBody};
use piola_simulation::constraints::{Constraint, ConstraintKind};
use piola_simulation::expression::{Expression, ExpressionNode as Node, Function, Operation, Variable};
use piola_simulation::joints::{Coordinate, Joint, JointMotion, Mechanism, Part, PartKind};
use piola_simulation::motion::{Method, MotionRun, System, TimeSpan, Timetable, simulate};
use piola_simulation::{Outcome, SimulationError};
use piola_testkit::{Tol, assert_close};

const G: f64 = 9.81;

fn joint(parent: Option<usize>, offset: [f64; 3], motion: JointMotion, [position, velocity]: [f64; 2]) -> Joint {
    let angular = !matches!(motion, JointMotion::Prismatic(_));
    let coordinate = Coordinate { name: "q".into(), angular, position, velocity };
    Joint { parent, offset, motion, coordinates: vec![coordinate] }
}

fn particle(joint: usize, mass: f64, at: [f64; 3]) -> Part {
    Part { joint, name: format!("on {joint}"), at, kind: PartKind::Particle(mass) }
}

fn mechanism(joints: Vec<Joint>, parts: Vec<Part>) -> Mechanism {
    Mechanism::new(joints, parts, [0.0, 0.0, -G]).unwrap_or_else(|error| panic!("{error}"))
}

fn under(mechanism: Mechanism, kinds: Vec<ConstraintKind>) -> Mechanism {
    let named = |(index, kind)| Constraint { name: format!("c{index}"), kind };
    let constraints = kinds.into_iter().enumerate().map(named).collect();
    let held = mechanism.with_constraints(constraints).unwrap_or_else(|error| panic!("{error}"));
    Mechanism { reactions: true, ..held }
}

const FINE: Method = Method::DormandPrince { tolerance: 1e-13 };

fn attempt(system: &Mechanism, method: Method, end: f64) -> MotionRun {
    let timetable = Timetable::new(TimeSpan { start: 0.0, end }, 9, &[]);
    simulate(&System::Mechanism(Box::new(system.clone())), method, &timetable, &mut |_| ControlFlow::Continue(()))
}

fn run(system: &Mechanism, end: f64) -> MotionRun {
    let run = attempt(system, FINE, end);
    assert_eq!(run.outcome, Outcome::Completed);
    run
}

fn drift(run: &MotionRun) -> f64 {
    run.history.drifts().energy.map_or(f64::NAN, |drift| drift.max_relative)
}

/// A particle of 2 kg in the plane x–z, by two rails.
fn in_plane([x, z]: [f64; 2], [u, w]: [f64; 2]) -> Mechanism {
    let joints = vec![
        joint(None, [0.0; 3], JointMotion::Prismatic([1.0, 0.0, 0.0]), [x, u]),
        joint(Some(0), [0.0; 3], JointMotion::Prismatic([0.0, 0.0, 1.0]), [z, w]),
    ];
    mechanism(joints, vec![particle(1, 2.0, [0.0; 3])])
}

#[test]
fn a_particle_on_a_rod_swings_as_a_pendulum_and_pulls_as_one() {
    let angle = 0.75_f64;
    let start = [1.5 * angle.sin(), -1.5 * angle.cos()];
    let plane = in_plane(start, [0.0; 2]);
    let anchor = |joint| plane.tree.anchor(joint, [0.0; 3]).unwrap_or_else(|error| panic!("{error}"));
    let rod = ConstraintKind::Distance { ends: [anchor(None), anchor(Some(1))], length: 1.5 };
    let tied = run(&under(plane, vec![rod]), 3.0);
    let turn = joint(None, [0.0; 3], JointMotion::Revolute([0.0, -1.0, 0.0]), [angle, 0.0]);
    let pendulum = mechanism(vec![turn], vec![particle(0, 2.0, [0.0, 0.0, -1.5])]);
    let free = run(&Mechanism { reactions: true, ..pendulum }, 3.0);
    let tolerance = Tol::stated(1e-10, "the tolerance times some hundred steps");
    for (i, state) in free.history.coordinates.iter().enumerate() {
        let (sine, cosine) = state[0].sin_cos();
        assert_close("place", &tied.history.coordinates[i][..2], &[1.5 * sine, -1.5 * cosine], tolerance);
        // T = m (g cos θ + l θ̇²), along the rod
        let tension = 2.0 * (G * cosine + 1.5 * state[1] * state[1]);
        assert_close("tension", &tied.history.conditions[i], &[tension], tolerance);
        let pull = [-tension * sine, 0.0, tension * cosine];
        assert_close("reaction", &free.history.reactions[i][0].force, &pull, tolerance);
        assert_close("reaction", &tied.history.reactions[i][0].force, &pull, tolerance);
    }
    assert_eq!(tied.history.condition_names, ["tension of c0 (N)"]);
    assert_eq!(free.history.conditions, vec![Vec::<f64>::new(); 9]);
    assert_close("drift", &[drift(&tied)], &[0.0], Tol::stated(1e-11, "the tolerance times some hundred steps"));
}

#[test]
fn a_loop_that_is_not_quite_closed_starts_closed_and_stays_so() {
    // Three bars in the plane x–z from the ground to (1, 0, 0): the third direction of the loop is redundant.
    let about = JointMotion::Revolute([0.0, -1.0, 0.0]);
    let joints = vec![
        joint(None, [0.0; 3], about, [0.5, 1.0]),
        joint(Some(0), [0.0, 0.0, 0.5], about, [-1.6, 0.0]),
        joint(Some(1), [0.0, 0.0, 0.9], about, [-1.2, 0.0]),
    ];
    let ends = |i: usize| [0.0, 0.0, [0.5, 0.9, 0.7][i]];
    let bars = mechanism(joints, (0..3).map(|i| particle(i, 1.0, ends(i).map(|x| 0.5 * x))).collect());
    let anchor = |joint, at| bars.tree.anchor(joint, at).unwrap_or_else(|error| panic!("{error}"));
    let pins = [anchor(Some(2), ends(2)), anchor(None, [1.0, 0.0, 0.0])];
    let linkage = under(bars.clone(), vec![ConstraintKind::Loop { ends: pins.clone() }]);
    let run = run(&linkage, 2.0);
    let constrained = linkage.constrained();
    for (i, state) in run.history.coordinates.iter().enumerate() {
        let place = linkage.tree.place_of(&pins[0], &|i| state[i]);
        assert_close("pin", place.as_slice(), &[1.0, 0.0, 0.0], Tol::ulps(16.0));
        // All forces on the parts and the pin add up to m a − m g of the whole.
        let forces = &run.history.conditions[i];
        assert_eq!((forces.len(), forces[1].abs() <= 0.0), (3, true));
    }
    let last = run.history.coordinates.last().unwrap_or_else(|| panic!("no record"));
    assert_eq!(constrained.degrees_of_freedom(&last[..3], 2.0).ok(), Some(1));
    assert_close("drift", &[drift(&run)], &[0.0], Tol::stated(1e-10, "the tolerance times some hundred steps"));
    assert_eq!(run.history.condition_names[2], "force of c0 along z (N)");
}

#[test]
fn a_drive_turns_a_crank_as_prescribed_with_the_torque_and_the_work_that_this_takes() {
    // θ = 2 t + ¼ sin 3t of a mass on an arm of ½ m from the lowest place: τ = m l² θ̈ + m g l sin θ.
    let turn = joint(None, [0.0; 3], JointMotion::Revolute([0.0, -1.0, 0.0]), [0.1, 0.0]);
    let crank = mechanism(vec![turn], vec![particle(0, 2.0, [0.0, 0.0, -0.5])]);
    let nodes = vec![
        Node::Constant(2.0),
        Node::Variable(Variable::Time),
        Node::Operation(Operation::Product, 0, 1),
        Node::Constant(0.25),
        Node::Constant(3.0),
        Node::Variable(Variable::Time),
        Node::Operation(Operation::Product, 4, 5),
        Node::Function(Function::Sin, 6),
        Node::Operation(Operation::Product, 3, 7),
        Node::Operation(Operation::Sum, 2, 8),
    ];
    let motion = Expression::new(nodes).unwrap_or_else(|error| panic!("{error}"));
    let run = run(&under(crank, vec![ConstraintKind::Prescribed { coordinate: 0, motion }]), 3.0);
    let energy = |angle: f64, rate: f64| 0.5 * 0.5 * rate * rate - 2.0 * G * 0.5 * angle.cos();
    let mut compared = 0;
    for (i, &t) in run.history.times.iter().enumerate() {
        let angle = 2.0 * t + 0.25 * (3.0 * t).sin();
        let (rate, second) = (2.0 + 0.75 * (3.0 * t).cos(), -2.25 * (3.0 * t).sin());
        let tolerance = Tol::stated(1e-10, "the tolerance times some hundred steps");
        assert_close("state", &run.history.coordinates[i], &[angle, rate], Tol::ulps(16.0));
        assert_close(
            "torque",
            &run.history.conditions[i],
            &[0.5 * second + 2.0 * G * 0.5 * angle.sin()],
            Tol::stated(1e-13, "a difference of terms of size ten"),
        );
        assert_close("work", &run.history.works[i], &[energy(angle, rate) - energy(0.0, 2.75)], tolerance);
        compared += 1;
    }
    assert_eq!((compared, run.history.condition_names[0].as_str()), (9, "drive of c0 (N m)"));
    assert_eq!(run.history.work_names, ["prescribed motion"]);
}

#[test]
fn methods_that_do_not_project_and_constraints_that_cannot_be_are_refused() {
    let plane = in_plane([1.0, 0.0], [0.0; 2]);
    let anchor = |joint| plane.tree.anchor(joint, [0.0; 3]).unwrap_or_else(|error| panic!("{error}"));
    let rod = |length| ConstraintKind::Distance { ends: [anchor(None), anchor(Some(1))], length };
    let refused = |kind| plane.clone().with_constraints(vec![Constraint { name: "it".into(), kind }]).err();
    assert_eq!(refused(rod(0.0)), Some(SimulationError::NotPositive { quantity: "length", value: 0.0 }));
    let nan = refused(rod(f64::NAN));
    assert!(matches!(nan, Some(SimulationError::NotFinite { quantity: "length", .. })), "{nan:?}");
    let own = Expression::new(vec![Node::Variable(Variable::Coordinate(1))]).unwrap_or_else(|error| panic!("{error}"));
    let expected = SimulationError::DependsOnCoordinate { quantity: "prescribed motion", coordinate: 1 };
    assert_eq!(refused(ConstraintKind::Prescribed { coordinate: 0, motion: own }), Some(expected));
    let tied = under(plane.clone(), vec![rod(1.0)]);
    let fixed = attempt(&tied, Method::GaussLegendre { order: Order::Four, step: 0.1 }, 1.0);
    let Outcome::Failed(why) = fixed.outcome else { panic!("a fixed step kept a constraint") };
    assert!(why.contains("gauss-legendre-4 does not keep constraints"), "{why}");
    // Two rods that contradict each other.
    let torn = attempt(&under(plane.clone(), vec![rod(1.0), rod(2.0)]), FINE, 1.0);
    assert!(matches!(&torn.outcome, Outcome::Failed(why) if why.contains("c1") || why.contains("c0")), "{torn:?}");
}

#[test]
fn a_parallelogram_lists_where_its_cranks_lie_on_its_rod() {
    // Two cranks of 1 m, 2 m apart, and a rod of 2 m: at an angle of π all lie on one line, and the cranks could also cross.
    let crank = |at: f64| joint(None, [at, 0.0, 0.0], JointMotion::Revolute([0.0, -1.0, 0.0]), [0.5, 1.0]);
    let pins = [0, 1].map(|joint| particle(joint, 1.0, [1.0, 0.0, 0.0]));
    let mut cranks = mechanism(vec![crank(0.0), crank(2.0)], pins.to_vec());
    cranks.gravity = [0.0; 3];
    let ends =
        [0, 1].map(|joint| cranks.tree.anchor(Some(joint), [1.0, 0.0, 0.0]).unwrap_or_else(|error| panic!("{error}")));
    let held = under(cranks, vec![ConstraintKind::Distance { ends, length: 2.0 }]);
    let run = attempt(&held, Method::DormandPrince { tolerance: 1e-10 }, 4.0);
    assert_eq!(run.outcome, Outcome::Completed);
    let [(t, name)] = &run.history.singular_positions[..] else { panic!("{:?}", run.history.singular_positions) };
    assert_eq!(name, "c0");
    let tolerance = Tol::stated(0.1, "relative, of linear interpolation over a step of half a second");
    assert_close("time", &[*t], &[core::f64::consts::PI - 0.5], tolerance);
}

#[test]
fn wheels_on_one_axle_share_the_forces_that_rolling_does_not_determine() {
    // Two wheels of 2 kg, 0.5 m and C = 0.25 kg m² on a frame of 3 kg that does not turn: 9 ẍ = 7 m/s², each wheel holds −C ẍ/R².
    let rail = |parent, axis| joint(parent, [0.0; 3], JointMotion::Prismatic(axis), [0.0; 2]);
    let wheel = |y: f64| joint(Some(2), [0.0, y, 0.0], JointMotion::Revolute([0.0, 1.0, 0.0]), [0.0; 2]);
    let joints = vec![
        rail(None, [1.0, 0.0, 0.0]),
        rail(Some(0), [0.0, 1.0, 0.0]),
        rail(Some(1), [0.0, 0.0, 1.0]),
        wheel(0.75),
        wheel(-0.75),
    ];
    let disc = |joint| {
        let body = Inertia::principal([0.125, 0.25, 0.125]).and_then(|inertia| RigidBody::new(2.0, inertia));
        let kind = PartKind::Body(body.unwrap_or_else(|error| panic!("{error}")));
        Part { joint, name: format!("wheel {joint}"), at: [0.0; 3], kind }
    };
    let car = mechanism(joints, vec![particle(2, 3.0, [0.0; 3]), disc(3), disc(4)]);
    let car = Mechanism { gravity: [1.0, 2.0, -10.0], ..car };
    let contact = |joint| {
        let centre = car.tree.anchor(Some(joint), [0.0; 3]).unwrap_or_else(|error| panic!("{error}"));
        ConstraintKind::Rolling { centre, radius: 0.5, axis: Some([0.0, 1.0, 0.0]), normal: [0.0, 0.0, 1.0] }
    };
    let held = under(car.clone(), vec![contact(3), contact(4)]);
    for forces in &run(&held, 1.0).history.conditions {
        // Across and upwards both wheels hold together: half each.
        let each = [-7.0 / 9.0, -7.0, 35.0];
        assert_close("forces", forces, &[each, each].concat(), Tol::stated(1e-12, "of sums of size seventy"));
    }
}
