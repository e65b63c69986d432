//! What steps do not evaluate: parts that stand still, fixed joints, other islands, a top with a closed form. Each beside the run that
//! evaluates it.

use core::ops::ControlFlow;

use piola_kinematics::{Attitude, Inertia, RigidBody};
use piola_lagrangian::Lagrangian;
use piola_simulation::constraints::{Constraint, ConstraintKind};
use piola_simulation::forces::{Force, ForceKind};
use piola_simulation::joints::{Coordinate, Joint, JointMotion, Mechanism, Part, PartKind};
use piola_simulation::motion::{History, Method, MotionRun, PartReaction, System, TimeSpan, Timetable, simulate};
use piola_simulation::{Outcome, SimulationError};
use piola_testkit::{Tol, assert_close};

const GRAVITY: [f64; 3] = [0.0, 0.0, -9.81];

fn turning(parent: Option<usize>, offset: [f64; 3], name: &str, position: f64) -> Joint {
    let coordinate = Coordinate { name: name.into(), angular: true, position, velocity: 0.0 };
    Joint { parent, offset, motion: JointMotion::Revolute([0.0, 1.0, 0.0]), coordinates: vec![coordinate] }
}

fn fixed(parent: Option<usize>, offset: [f64; 3]) -> Joint {
    Joint { parent, offset, motion: JointMotion::Fixed, coordinates: Vec::new() }
}

fn particle(joint: usize, name: &str, at: [f64; 3]) -> Part {
    Part { joint, name: name.into(), at, kind: PartKind::Particle(1.5) }
}

fn body(joint: usize, name: &str, at: [f64; 3], moments: [f64; 3]) -> Part {
    let body = Inertia::principal(moments).and_then(|inertia| RigidBody::new(2.0, inertia));
    Part { joint, name: name.into(), at, kind: PartKind::Body(body.unwrap_or_else(|error| panic!("{error}"))) }
}

fn mechanism(joints: Vec<Joint>, parts: Vec<Part>) -> Mechanism {
    Mechanism::new(joints, parts, GRAVITY).unwrap_or_else(|error| panic!("{error}"))
}

fn run(system: &Mechanism, method: Method, end: f64) -> MotionRun {
    let timetable = Timetable::new(TimeSpan { start: 0.5, end: 0.5 + end }, 21, &[]);
    let system = System::Mechanism(Box::new(system.clone()));
    let run = simulate(&system, method, &timetable, &mut |_| ControlFlow::Continue(()));
    assert_eq!(run.outcome, Outcome::Completed);
    run
}

const FINE: Method = Method::Verner { tolerance: 1e-14 };

fn assert_same_motion(found: &History, expected: &History, tolerance: Tol) {
    assert_eq!((&found.names, &found.times), (&expected.names, &expected.times));
    for (found, expected) in found.coordinates.iter().zip(&expected.coordinates) {
        assert_close("state", found, expected, tolerance);
    }
    for (found, expected) in found.positions.iter().zip(&expected.positions) {
        assert_close("places", found.as_flattened(), expected.as_flattened(), tolerance);
    }
}

/// A pendulum of two turning joints with fixed joints on them, and parts on the ground.
fn with_fixed_joints() -> Mechanism {
    let joints = vec![
        fixed(None, [0.0, 0.0, 2.0]),
        turning(Some(0), [0.5, 0.0, 0.0], "upper", 0.7),
        fixed(Some(1), [0.1, 0.2, -1.0]),
        turning(Some(2), [0.0, 0.0, -0.5], "lower", -0.4),
        fixed(Some(3), [0.0, 0.1, -0.5]),
        fixed(Some(4), [0.2, 0.0, 0.0]),
    ];
    let parts = vec![
        body(0, "post", [0.0; 3], [1.0, 1.0, 1.0]),
        body(2, "arm", [0.0, 0.0, 0.4], [0.3, 0.4, 0.2]),
        particle(1, "pin", [0.0, 0.1, 0.2]),
        body(5, "hand", [0.1, 0.0, 0.0], [0.1, 0.2, 0.15]),
        particle(3, "bob", [0.0, 0.0, -0.2]),
        particle(0, "foot", [0.0, 0.0, -2.0]),
    ];
    mechanism(joints, parts)
}

#[test]
fn accelerations_of_the_reduced_tree_equal_those_of_all_parts() {
    let whole = with_fixed_joints();
    let reduced = whole.reduction();
    let still: Vec<&str> = reduced.still.iter().map(|part| whole.parts[*part].name.as_str()).collect();
    assert_eq!((still, reduced.merged_joints, reduced.merged_parts), (vec!["post", "foot"], 3, 2));
    let lean = Lagrangian::of(&reduced.tree).with_uniform_gravity(GRAVITY);
    for (q, v) in [([0.7, -0.4], [0.0, 0.0]), ([1.9, 2.3], [-3.0, 0.7]), ([-0.2, 3.0], [0.4, 5.0])] {
        let found = lean.acceleration(&q, &v, 0.0).unwrap_or_else(|error| panic!("{error}"));
        let expected = whole.lagrangian().acceleration(&q, &v, 0.0).unwrap_or_else(|error| panic!("{error}"));
        assert_close("accelerations", found.as_slice(), expected.as_slice(), Tol::ulps(64.0));
    }
}

#[test]
fn a_run_on_the_reduced_tree_keeps_the_energy_of_all_parts() {
    let run = run(&with_fixed_joints(), FINE, 5.0);
    let drift = run.history.drifts().energy.map_or(f64::NAN, |drift| drift.max_relative);
    assert_close("drift", &[drift], &[0.0], Tol::stated(1e-12, "the tolerance 1e-14 times some hundred steps"));
    let places: Vec<[f64; 3]> = run.history.positions.iter().map(|places| places[0]).collect();
    assert_eq!(places, vec![[0.0, 0.0, 2.0]; 21]);
}

/// A slow double pendulum and a fast one; a spring ties the fast one to the ground, and drag acts on all.
fn slow_and_fast(spring: bool) -> Mechanism {
    let joints = vec![
        turning(None, [0.0; 3], "a", 1.0),
        fixed(None, [3.0, 0.0, 0.0]),
        turning(Some(1), [0.0; 3], "c", 0.8),
        turning(Some(0), [0.0, 0.0, -1.0], "b", 0.5),
        turning(Some(2), [0.0, 0.0, -0.02], "d", 0.4),
    ];
    let parts = vec![
        particle(0, "p", [0.0, 0.0, -1.0]),
        particle(2, "r", [0.0, 0.0, -0.02]),
        particle(3, "q", [0.0, 0.0, -1.0]),
        particle(4, "s", [0.0, 0.0, -0.02]),
        particle(1, "hook", [0.0; 3]),
    ];
    let system = mechanism(joints, parts);
    let anchor = |joint: Option<usize>, at| system.tree.anchor(joint, at).unwrap_or_else(|error| panic!("{error}"));
    let points = vec![anchor(Some(3), [0.0, 0.0, -1.0]), anchor(Some(4), [0.0, 0.0, -0.02])];
    let mut forces = vec![
        Force { name: "air".into(), kind: ForceKind::Drag { points, linear: 0.05, quadratic: 0.0, wind: [0.0; 3] } },
        Force {
            name: "hinge".into(),
            kind: ForceKind::JointSpring { coordinate: 3, stiffness: 0.01, rest: 0.1, damping: 0.0 },
        },
    ];
    if spring {
        let ends = [anchor(Some(0), [0.0, 0.0, -1.0]), anchor(Some(2), [0.0, 0.0, -0.02])];
        forces.push(Force {
            name: "tie".into(),
            kind: ForceKind::Spring { ends, stiffness: 1.0, length: 3.0, damping: 0.0 },
        });
    }
    let mut system = system.with_forces(forces).unwrap_or_else(|error| panic!("{error}"));
    system.questions.energies = true;
    system.reactions = true;
    system
}

#[test]
fn islands_are_integrated_as_if_alone_and_recorded_together() {
    let system = slow_and_fast(false);
    let islands = system.islands();
    let parts: Vec<&[usize]> = islands.iter().map(|island| &island.parts[..]).collect();
    // In the order of placement: p, q, hook, r, s.
    assert_eq!(parts, [&[0, 1, 2][..], &[3, 4][..]]);
    assert_eq!(islands[1].mechanism.coordinates, ["c", "d"]);
    let split = run(&system, FINE, 3.0);
    let whole = run(&Mechanism { simplify: false, ..system.clone() }, FINE, 3.0);
    let tolerance =
        Tol::stated(1e-9, "errors of the tolerance 1e-14, which thirty swings of the fast pendulum magnify");
    assert_same_motion(&split.history, &whole.history, tolerance);
    assert_same_rows("works", [&split.history.works, &whole.history.works], tolerance);
    assert_same_rows("energies", [&split.history.energies, &whole.history.energies], tolerance);
    assert_same_rows("reactions", [&reactions(&split.history), &reactions(&whole.history)], tolerance);
    assert_eq!(split.history.energy_names, whole.history.energy_names);
    // Each island by itself takes these steps and evaluations: none is made for the other.
    let alone = islands.iter().map(|island| run(&island.mechanism, FINE, 3.0));
    let sums = alone.fold([0; 2], |sum, run| [sum[0] + run.steps, sum[1] + run.force_evaluations]);
    assert_eq!([split.steps, split.force_evaluations], sums);
    let drift = split.history.drifts().energy.map_or(f64::NAN, |drift| drift.max_relative);
    assert_close("drift", &[drift], &[0.0], Tol::stated(1e-12, "the tolerance 1e-14 times some hundred steps"));
}

/// Each of the 21 rows.
fn assert_same_rows(name: &str, [found, expected]: [&[Vec<f64>]; 2], tolerance: Tol) {
    assert_eq!((found.len(), expected.len()), (21, 21), "{name}");
    for (row, (found, expected)) in found.iter().zip(expected).enumerate() {
        assert!(!expected.is_empty(), "{name}");
        assert_close(&format!("{name}, row {row}"), found, expected, tolerance);
    }
}

/// Forces and moments of all parts, one row an instant.
fn reactions(history: &History) -> Vec<Vec<f64>> {
    let of_one = |held: &Vec<PartReaction>| held.iter().flat_map(|part| [part.force, part.moment].concat()).collect();
    history.reactions.iter().map(of_one).collect()
}

#[test]
fn islands_with_constraints_keep_the_order_of_conditions_and_of_singular_positions() {
    // Two parallelograms of cranks of 1 m that turn evenly at 1 and 1.5 rad/s: each is aligned at an angle of π.
    let crank = |at: f64, name: &str, rate: f64| {
        let turn = Coordinate { name: name.into(), angular: true, position: 0.5, velocity: rate };
        Joint {
            parent: None,
            offset: [at, 0.0, 0.0],
            motion: JointMotion::Revolute([0.0, 1.0, 0.0]),
            coordinates: vec![turn],
        }
    };
    // The joints of both stand among each other.
    let joints = vec![crank(0.0, "a", 1.0), crank(10.0, "c", 1.5), crank(2.0, "b", 1.0), crank(12.0, "d", 1.5)];
    let pins = (0..4).map(|joint| particle(joint, ["p", "r", "q", "s"][joint], [1.0, 0.0, 0.0])).collect();
    let system = Mechanism { gravity: [0.0; 3], ..mechanism(joints, pins) };
    let rod = |name: &str, ends: [usize; 2]| {
        let anchor = |joint| system.tree.anchor(Some(joint), [1.0, 0.0, 0.0]);
        let ends = ends.map(|joint| anchor(joint).unwrap_or_else(|error| panic!("{error}")));
        Constraint { name: name.into(), kind: ConstraintKind::Distance { ends, length: 2.0 } }
    };
    let rods = vec![rod("fast", [1, 3]), rod("slow", [0, 2])];
    let mut system = system.clone().with_constraints(rods).unwrap_or_else(|error| panic!("{error}"));
    system.reactions = true;
    assert_eq!(system.islands().len(), 2);
    let split = run(&system, Method::DormandPrince { tolerance: 1e-10 }, 3.0);
    assert_eq!(split.history.condition_names, ["tension of fast (N)", "tension of slow (N)"]);
    assert_eq!((split.history.conditions.len(), split.history.reactions.len()), (21, 21));
    let tolerance = Tol::stated(1e-6, "runs with a tolerance of 1e-10 through a singular position");
    for (k, t) in split.history.times.iter().enumerate() {
        let expected = [1.0, 1.5, 1.0, 1.5].map(|rate| 0.5 + rate * (t - 0.5));
        assert_close("angles", &split.history.coordinates[k][..4], &expected, tolerance);
        // No force acts along the rods; each crank carries its particle around.
        for (part, rate) in [1.0, 1.5, 1.0, 1.5].into_iter().enumerate() {
            let (sine, cosine) = expected[part].sin_cos();
            let force = 1.5 * rate * rate;
            let held = split.history.reactions[k][part].force;
            assert_close("reaction", &held, &[-force * cosine, 0.0, force * sine], tolerance);
        }
    }
    let [first, second] = &split.history.singular_positions[..] else {
        panic!("{:?}", split.history.singular_positions)
    };
    assert_eq!([&first.1[..], &second.1], ["fast", "slow"]);
    let expected = [1.5, 1.0].map(|rate| 0.5 + (core::f64::consts::PI - 0.5) / rate);
    let tolerance = Tol::stated(0.1, "relative, of linear interpolation over a step of half a second");
    assert_close("singular positions", &[first.0, second.0], &expected, tolerance);
}

/// Of many pendulums each island copies its own joint, not those of the others.
#[test]
fn an_island_holds_its_own_joints_and_those_of_the_ground_alone() {
    let (count, frame) = (50, 0);
    let joints = (0..count).map(|k| match k {
        0 => fixed(None, [0.0, 1.0, 0.0]),
        _ => turning(Some(frame), [f64::from(k), 0.0, 0.0], &format!("turn {k}"), 0.1),
    });
    let bobs = (1..50).map(|joint| particle(joint, &format!("bob {joint}"), [0.0, 0.0, -1.0])).collect();
    let islands = mechanism(joints.collect(), bobs).islands();
    assert_eq!(islands.len(), 49);
    for (k, island) in islands.iter().enumerate() {
        assert_eq!(island.parts, [k]);
        let refused = island.mechanism.tree.anchor(Some(2), [0.0; 3]);
        assert_eq!(refused.err(), Some(SimulationError::NoSuchJoint { joint: 2, joints: 2 }));
        // The bob hangs below its own place.
        let end = island.mechanism.tree.anchor(Some(1), [0.0, 0.0, -1.0]).unwrap_or_else(|error| panic!("{error}"));
        let place = island.mechanism.tree.place_of(&end, &|_| 0.0);
        assert_eq!([place.x, place.y, place.z].map(f64::to_bits), [k as f64 + 1.0, 1.0, -1.0].map(f64::to_bits));
    }
}

#[test]
fn what_a_spring_or_a_fixed_step_holds_together_is_one_island() {
    assert_eq!(slow_and_fast(true).islands().len(), 1);
    let system = slow_and_fast(false);
    let fixed = Method::GaussLegendre { order: piola_integrators::Order::Eight, step: 0.01 };
    let run = run(&system, fixed, 0.5);
    assert_eq!(run.steps, 60); // 20 instants, each after three steps of at most 0.01 s
}

#[test]
fn a_run_of_islands_that_is_stopped_has_a_record() {
    let system = System::Mechanism(Box::new(slow_and_fast(false)));
    let timetable = Timetable::new(TimeSpan { start: 0.0, end: 3.0 }, 21, &[]);
    let stop = &mut |progress: piola_simulation::motion::Progress| {
        if 40 <= progress.steps { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let run = simulate(&system, FINE, &timetable, stop);
    assert_eq!((run.outcome, run.steps), (Outcome::Interrupted, 40));
    assert!(!run.history.times.is_empty() && run.history.times.len() == run.history.positions.len());
    assert!(!run.history.invariants.is_empty());
    // All islands reach the last instant that the one that was stopped has recorded, also where it is the first one.
    let System::Mechanism(mechanism) = &system else { return };
    let whole = run_of(&system, u64::MAX);
    let first = simulate_alone(&mechanism.islands()[0].mechanism).steps;
    for stop in [first / 2, u64::midpoint(first, whole.steps)] {
        let stopped = run_of(&system, stop);
        let recorded = stopped.history.times.len();
        assert_eq!((&stopped.outcome, stopped.steps), (&Outcome::Interrupted, stop));
        assert!(1 < recorded && recorded < 21, "{recorded}");
        assert_eq!(stopped.history.coordinates, whole.history.coordinates[..recorded]);
        assert_eq!(stopped.history.energies, whole.history.energies[..recorded]);
    }
}

fn run_of(system: &System, stop: u64) -> MotionRun {
    let timetable = Timetable::new(TimeSpan { start: 0.0, end: 3.0 }, 21, &[]);
    simulate(system, FINE, &timetable, &mut |progress| {
        if stop <= progress.steps { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    })
}

fn simulate_alone(mechanism: &Mechanism) -> MotionRun {
    run_of(&System::Mechanism(Box::new(mechanism.clone())), u64::MAX)
}

#[test]
fn columns_of_islands_with_equal_names_are_those_of_their_parts() {
    let mut system = slow_and_fast(false);
    for part in &mut system.parts {
        part.name = "bob".into();
    }
    let split = run(&system, FINE, 1.0);
    let whole = run(&Mechanism { simplify: false, ..system }, FINE, 1.0);
    let tolerance = Tol::stated(1e-9, "errors of the tolerance 1e-14, which swings of the fast pendulum magnify");
    assert_close("energies", &split.history.energies.concat(), &whole.history.energies.concat(), tolerance);
}

fn top(angles: [f64; 3], rates: [f64; 3], height: f64) -> Mechanism {
    let coordinates = [0, 1, 2].map(|i| Coordinate {
        name: format!("angle {i}"),
        angular: true,
        position: angles[i],
        velocity: rates[i],
    });
    let base = fixed(None, [0.5, -0.25, 1.0]);
    let tip =
        Joint { parent: Some(0), offset: [0.0; 3], motion: JointMotion::Spherical, coordinates: coordinates.into() };
    let rim = fixed(Some(1), [0.0, 0.0, 0.5 * height]);
    mechanism(vec![base, tip, rim], parts_of_a_top(height).into())
}

fn parts_of_a_top(height: f64) -> [Part; 2] {
    [body(1, "disc", [0.0, 0.0, height], [0.3, 0.3, 0.5]), body(2, "axle", [0.0; 3], [0.2, 0.2, 0.01])]
}

#[test]
fn a_top_in_closed_form_evaluates_no_force_and_agrees_with_an_integration() {
    let cases = [
        ([0.3, 0.5, -0.2], [0.0, 0.0, 60.0], 0.5),
        ([0.0, 1.2, 0.0], [0.5, -1.0, 8.0], 0.5),
        // Hanging, with the precession against the spin.
        ([7.0, 0.9, -20.0], [1.5, 0.4, -5.0], -0.4),
        ([0.0, 2.8, 0.0], [2.0, 0.1, 0.0], -0.4),
    ];
    for (angles, rates, height) in cases {
        let system = top(angles, rates, height);
        assert!(system.has_closed_form());
        let closed = run(&system, Method::ClosedForm, 4.0);
        assert_eq!((closed.force_evaluations, closed.steps, closed.rejected), (0, 20, 0));
        let integrated = run(&system, FINE, 4.0);
        // With all whole turns: the angles grow by up to 240 rad.
        let tolerance = Tol::stated(1e-10, "of the integration, whose errors grow with the turns");
        assert_same_motion(&closed.history, &integrated.history, tolerance);
        let drift = closed.history.drifts().energy.map_or(f64::NAN, |drift| drift.max_relative);
        assert_close("drift", &[drift], &[0.0], Tol::stated(1e-13, "of the rounding of angles of a hundred turns"));
    }
}

/// A top that moves in the vertical plane of its first angle, through the vertical below and above, is the pendulum of its moment.
#[test]
fn a_top_in_closed_form_that_swings_through_the_vertical_is_a_pendulum() {
    for (theta, rate, height) in [(2.0, 0.0, 0.5), (1.0, 12.0, 0.5), (0.5, -0.5, -0.4), (0.5, -15.0, -0.4)] {
        let closed = run(&top([0.3, theta, -0.2], [0.0, rate, 0.0], height), Method::ClosedForm, 4.0);
        let (sine, cosine) = 0.3_f64.sin_cos();
        let turn = Coordinate { name: "theta".into(), angular: true, position: theta, velocity: rate };
        let hinge = Joint {
            parent: Some(0),
            offset: [0.0; 3],
            motion: JointMotion::Revolute([-sine, cosine, 0.0]),
            coordinates: vec![turn],
        };
        let joints = vec![fixed(None, [0.5, -0.25, 1.0]), hinge, fixed(Some(1), [0.0, 0.0, 0.5 * height])];
        let pendulum = run(&mechanism(joints, parts_of_a_top(height).into()), FINE, 4.0);
        let tolerance = Tol::stated(1e-10, "of the integration");
        let matrix = |angles: [f64; 3]| Attitude::<f64>::from_euler_zyz(angles).to_matrix();
        let mut lowest_and_highest = [f64::INFINITY, f64::NEG_INFINITY];
        for (found, expected) in closed.history.coordinates.iter().zip(&pendulum.history.coordinates) {
            let (found, expected) = (matrix([found[0], found[1], found[2]]), matrix([0.3, expected[0], -0.2]));
            assert_close("attitude", found.as_slice(), expected.as_slice(), tolerance);
        }
        for state in &pendulum.history.coordinates {
            lowest_and_highest = [lowest_and_highest[0].min(state[0]), lowest_and_highest[1].max(state[0])];
        }
        let whole = |angle: f64| (angle / core::f64::consts::PI).floor();
        assert!(whole(lowest_and_highest[0]) < whole(lowest_and_highest[1]), "{lowest_and_highest:?}");
        for (found, expected) in closed.history.positions.iter().zip(&pendulum.history.positions) {
            assert_close("places", found.as_flattened(), expected.as_flattened(), tolerance);
        }
    }
}

#[test]
fn what_is_no_symmetric_top_has_no_closed_form() {
    let start = ([0.3, 0.5, -0.2], [0.0, 0.0, 60.0]);
    let system = top(start.0, start.1, 0.5);
    let pushed = Force {
        name: "push".into(),
        kind: ForceKind::JointSpring { coordinate: 0, stiffness: 1.0, rest: 0.0, damping: 0.0 },
    };
    let pushed = system.clone().with_forces(vec![pushed]).unwrap_or_else(|error| panic!("{error}"));
    let tilted = Mechanism { gravity: [1.0, 0.0, -9.81], ..system.clone() };
    let beyond = [-0.5, 4.0].map(|theta| top([0.3, theta, -0.2], start.1, 0.5));
    // Other parts: of unequal moments, beside the axis, and on a joint of its own.
    let [disc, axle] = parts_of_a_top(0.5);
    let spin =
        |i: usize| Coordinate { name: format!("angle {i}"), angular: true, position: start.0[i], velocity: start.1[i] };
    let carried = |joints: &[Joint], parts: Vec<Part>| {
        let coordinates = [0, 1, 2].map(spin).into();
        let tip = Joint { parent: None, offset: [0.0; 3], motion: JointMotion::Spherical, coordinates };
        let base = fixed(None, [0.5, -0.25, 1.0]);
        let tip = Joint { parent: Some(0), ..tip };
        mechanism([&[base, tip, fixed(Some(1), [0.0, 0.0, 0.25])], joints].concat(), parts)
    };
    assert!(carried(&[], vec![disc.clone(), axle.clone()]).has_closed_form());
    let unequal = carried(&[], vec![body(1, "disc", [0.0, 0.0, 0.5], [0.3, 0.35, 0.5]), axle.clone()]);
    let lopsided = carried(&[], vec![body(1, "disc", [0.01, 0.0, 0.5], [0.3, 0.3, 0.5]), axle.clone()]);
    let child = turning(Some(1), [0.0, 0.0, 0.5], "child", 0.0);
    let with_child = carried(&[child], vec![disc.clone(), axle.clone(), particle(3, "bob", [0.0, 0.0, 0.1])]);
    let other = turning(None, [3.0, 0.0, 0.0], "other", 0.1);
    let with_other = carried(&[other], vec![disc, axle, particle(3, "bob", [0.0, 0.0, -1.0])]);
    let shapes = [unequal, lopsided, with_child, with_other];
    for other in [pushed, tilted].into_iter().chain(beyond).chain(shapes) {
        assert!(!other.has_closed_form());
        let timetable = Timetable::new(TimeSpan { start: 0.0, end: 1.0 }, 3, &[]);
        let run = simulate(&System::Mechanism(Box::new(other)), Method::ClosedForm, &timetable, &mut |_| {
            ControlFlow::Continue(())
        });
        assert!(matches!(&run.outcome, Outcome::Failed(why) if why.contains("symmetric top")), "{:?}", run.outcome);
    }
}
