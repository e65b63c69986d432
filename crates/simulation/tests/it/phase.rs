//! Hamiltonians made of expressions, and questions to mechanisms, beside closed forms.

use core::f64::consts::TAU;
use core::ops::ControlFlow;

use piola_integrators::Order;
use piola_simulation::expression::{Expression, ExpressionNode as Node, Function, Operation, Variable};
use piola_simulation::forces::{Force, ForceKind};
use piola_simulation::joints::{Coordinate, Joint, JointMotion, Mechanism, Part, PartKind};
use piola_simulation::motion::{History, Method, MotionRun, System, TimeSpan, Timetable, simulate};
use piola_simulation::phase::{BracketQuestion, NewVariables, PhaseExpression, PhaseQuestions, PhaseSystem};
use piola_simulation::questions::{MechanismQuestions, Stability};
use piola_simulation::{Outcome, SimulationError};
use piola_testkit::{Tol, assert_close};

const Q: Node = Node::Variable(Variable::Coordinate(0));
const P: Node = Node::Variable(Variable::Conjugate(0));

fn expression(nodes: Vec<Node>) -> Expression {
    Expression::new(nodes).unwrap_or_else(|error| panic!("{error}"))
}

fn system(nodes: Vec<Node>, q: f64, p: f64) -> PhaseSystem {
    let names = (vec!["q".into()], vec!["p".into()]);
    PhaseSystem::new(expression(nodes), names, vec![q], vec![p]).unwrap_or_else(|error| panic!("{error}"))
}

/// ½ p² and then what follows, from node 4 on, which is added.
fn kinetic_and(rest: Vec<Node>) -> Vec<Node> {
    let half = vec![Node::Constant(0.5), P, Node::WholePower(1, 2), Node::Operation(Operation::Product, 0, 2)];
    let last = 3 + rest.len();
    half.into_iter().chain(rest).chain([Node::Operation(Operation::Sum, 3, last)]).collect()
}

/// ½ p² − cos q.
fn pendulum() -> PhaseSystem {
    system(kinetic_and(vec![Q, Node::Function(Function::Cos, 4), Node::Negative(5)]), 1.2, 0.3)
}

fn attempt(system: &PhaseSystem, method: Method, end: f64) -> MotionRun {
    let timetable = Timetable::new(TimeSpan { start: 0.0, end }, 11, &[]);
    simulate(&System::Phase(Box::new(system.clone())), method, &timetable, &mut |_| ControlFlow::Continue(()))
}

fn run(system: &PhaseSystem, method: Method, end: f64) -> MotionRun {
    let run = attempt(system, method, end);
    assert_eq!(run.outcome, Outcome::Completed);
    run
}

const FINE: Method = Method::DormandPrince { tolerance: 1e-13 };

fn drift(run: &MotionRun) -> f64 {
    run.history.drifts().energy.map_or(f64::NAN, |drift| drift.max_relative)
}

#[test]
fn methods_agree_under_a_hamiltonian_and_keep_its_energy() {
    let adaptive = run(&pendulum(), FINE, 20.0);
    let fixed = [
        Method::Composition { order: Order::Eight, step: 0.02 },
        Method::GaussLegendre { order: Order::Eight, step: 0.02 },
    ];
    for method in fixed {
        let run = run(&pendulum(), method, 20.0);
        for (one, other) in run.history.coordinates.iter().zip(&adaptive.history.coordinates) {
            assert_close("state", one, other, Tol::stated(1e-11, "both to 1e-14 a step over a thousand steps"));
        }
        assert_close("drift", &[drift(&run)], &[0.0], Tol::stated(1e-13, "rounding of a thousand steps"));
    }
    assert_eq!(adaptive.history.coordinate_names, ["q", "p"]);
    assert!(adaptive.history.names.is_empty() && adaptive.history.works.is_empty());
}

#[test]
fn a_driven_hamiltonian_gains_what_its_time_brings_in() {
    // H = ½ p² − 2 t q: p = p₀ + t², q = q₀ + p₀ t + t³/3.
    let nodes = kinetic_and(vec![
        Node::Constant(-2.0),
        Node::Variable(Variable::Time),
        Node::Operation(Operation::Product, 4, 5),
        Q,
        Node::Operation(Operation::Product, 6, 7),
    ]);
    let run = run(&system(nodes, 0.5, 0.25), FINE, 3.0);
    let last = run.history.coordinates.last().unwrap_or_else(|| panic!("no record"));
    assert_close(
        "state",
        last,
        &[0.5 + 0.75 + 9.0, 9.25],
        Tol::stated(1e-13, "of a polynomial that the method takes exactly"),
    );
    assert_close("drift", &[drift(&run)], &[0.0], Tol::stated(1e-13, "of sums of size fifty"));
    assert_eq!(run.history.work_names.len(), 1);
}

#[test]
fn a_composition_refuses_what_is_not_separable() {
    // ½ p² + p q
    let nodes = kinetic_and(vec![P, Q, Node::Operation(Operation::Product, 4, 5)]);
    let outcome = attempt(&system(nodes, 1.0, 1.0), Method::Composition { order: Order::Four, step: 0.1 }, 1.0).outcome;
    assert!(matches!(&outcome, Outcome::Failed(why) if why.contains("needs H = T(p) + V(q)")), "{outcome:?}");
    let names = || (vec!["q".to_string()], vec!["p".to_string()]);
    let refused = |expression, q, p| PhaseSystem::new(expression, names(), q, p).err();
    let wrong = SimulationError::WrongLength { quantity: "momentum", expected: 1, found: 2 };
    assert_eq!(refused(expression(vec![Q]), vec![1.0], vec![1.0, 2.0]), Some(wrong));
    let far = expression(vec![Node::Variable(Variable::Coordinate(3))]);
    let wrong = SimulationError::NoSuchCoordinate { quantity: "hamiltonian", coordinate: 3, coordinates: 1 };
    assert_eq!(refused(far, vec![1.0], vec![1.0]), Some(wrong));
}

#[test]
fn neighbours_of_a_pencil_on_its_tip_part_with_its_rate() {
    // ½ p² − ½ k q² with k = 0.25: λ = ½.
    let nodes =
        kinetic_and(vec![Node::Constant(-0.125), Q, Node::WholePower(5, 2), Node::Operation(Operation::Product, 4, 6)]);
    let mut pencil = system(nodes, 0.0, 0.0);
    pencil.questions = PhaseQuestions { exponent: true, tolerance: 1e-11, ..PhaseQuestions::default() };
    let mut shares = Vec::new();
    let (answers, outcome) = pencil.answers(TimeSpan { start: 0.0, end: 400.0 }, &History::default(), &mut |share| {
        shares.push(share);
        ControlFlow::Continue(())
    });
    assert_eq!((outcome, answers.estimates.len(), shares.len()), (Outcome::Completed, 400, 401));
    let tolerance = Tol::stated(1e-2, "the estimate converges as 1/t does, and t = 400 s");
    assert_close("exponent", &[answers.exponent.unwrap_or_default()], &[0.5], tolerance);
    let (answers, outcome) =
        pencil.answers(TimeSpan { start: 0.0, end: 400.0 }, &History::default(), &mut |_| ControlFlow::Break(()));
    assert_eq!((outcome, answers.exponent), (Outcome::Interrupted, None));
}

#[test]
fn an_oscillator_crosses_its_section_once_a_turn() {
    let nodes =
        kinetic_and(vec![Node::Constant(0.5), Q, Node::WholePower(5, 2), Node::Operation(Operation::Product, 4, 6)]);
    let mut oscillator = system(nodes, 1.0, 0.0);
    let section = Some((PhaseExpression(expression(vec![Q])), 3));
    oscillator.questions = PhaseQuestions { section, tolerance: 1e-12, ..PhaseQuestions::default() };
    let (answers, _) = oscillator
        .answers(TimeSpan { start: 0.0, end: 100.0 }, &History::default(), &mut |_| ControlFlow::Continue(()));
    let crossings = answers.crossings.unwrap_or_default();
    assert_eq!(crossings.len(), 3);
    for (turn, (t, point)) in crossings.iter().enumerate() {
        let tolerance = Tol::stated(1e-11, "the tolerance times some twenty steps");
        assert_close("time", &[*t], &[0.75 * TAU + TAU * turn as f64], tolerance);
        assert_close("point", point, &[0.0, 1.0], tolerance);
    }
}

/// A record of these values of q at 0 s, 1 s, …, with p = 1.
fn record(positions: &[f64]) -> History {
    let mut history = History::default();
    history.times = (0..positions.len()).map(|number| number as f64).collect();
    history.coordinates = positions.iter().map(|q| vec![*q, 1.0]).collect();
    history
}

#[test]
fn brackets_along_a_record_can_be_stopped_and_keep_what_they_found() {
    let mut pendulum = pendulum();
    let first = PhaseExpression(expression(vec![Q]));
    pendulum.questions.brackets = vec![BracketQuestion { name: "rate".into(), first: first.clone(), second: None }];
    pendulum.questions.section = Some((first, 3));
    pendulum.questions.tolerance = 1e-12;
    let history = record(&[0.5; 600]);
    let mut shares = Vec::new();
    let (answers, outcome) = pendulum.answers(TimeSpan { start: 0.0, end: 599.0 }, &history, &mut |share| {
        shares.push(share);
        ControlFlow::Break(())
    });
    // The section was not sought, which differs from a section without crossings.
    assert_eq!((outcome, answers.brackets.len(), answers.crossings), (Outcome::Interrupted, 256, None));
    assert_eq!(shares, [256.0 / 600.0]);
}

#[test]
fn new_variables_whose_derivatives_overflow_fail_by_name() {
    // Q = 1e160 q², P = 1e160 p: ∂Q/∂q ∂P/∂p = 2e320 q.
    let times = |nodes: Vec<Node>| {
        let last = nodes.len() - 1;
        let scaled = [Node::Constant(1e160), Node::Operation(Operation::Product, last, last + 1)];
        expression(nodes.into_iter().chain(scaled).collect())
    };
    let mut pendulum = pendulum();
    let variables = NewVariables::new(vec![times(vec![Q, Node::WholePower(0, 2)])], vec![times(vec![P])]);
    pendulum.questions.new_variables = variables.ok();
    let (answers, outcome) = pendulum
        .answers(TimeSpan { start: 0.0, end: 1.0 }, &record(&[1e-100, 1.0]), &mut |_| ControlFlow::Continue(()));
    let Outcome::Failed(why) = outcome else { panic!("{outcome:?}") };
    assert!(why.starts_with("the new variables at 1 s: products of their derivatives leave"), "{why}");
    assert_eq!(answers.canonical.map(|(t, test)| (t, test.relative)), Some((0.0, 1.0)));
}

/// A chain of two rods of 1 m with masses of 1 kg, under 10 m/s².
fn chain(angles: [f64; 2], forces: Vec<ForceKind>) -> Mechanism {
    let joint = |parent: Option<usize>, position: f64| {
        let coordinate = Coordinate { name: "q".into(), angular: true, position, velocity: 0.3 };
        let offset = [0.0, 0.0, if parent.is_some() { -1.0 } else { 0.0 }];
        Joint { parent, offset, motion: JointMotion::Revolute([0.0, -1.0, 0.0]), coordinates: vec![coordinate] }
    };
    let part = |joint| Part { joint, name: format!("m{joint}"), at: [0.0, 0.0, -1.0], kind: PartKind::Particle(1.0) };
    let named = |kind| Force { name: "it".into(), kind };
    let mut chain = Mechanism::new(
        vec![joint(None, angles[0]), joint(Some(0), angles[1])],
        vec![part(0), part(1)],
        [0.0, 0.0, -10.0],
    )
    .and_then(|chain| chain.with_forces(forces.into_iter().map(named).collect()))
    .unwrap_or_else(|error| panic!("{error}"));
    chain.questions = MechanismQuestions { equilibrium: true, modes: true, energies: true };
    chain
}

#[test]
fn a_chain_has_its_modes_and_its_stability() {
    let hanging = chain([0.2, -0.1], vec![]).answers(0.0).unwrap_or_else(|error| panic!("{error}"));
    assert_close("equilibrium", &hanging.coordinates, &[0.0, 0.0], Tol::ulps(8.0));
    let found: Vec<f64> = hanging.modes.iter().map(|mode| mode.angular_frequency.powi(2)).collect();
    let root = 2.0_f64.sqrt();
    assert_close("ω²", &found, &[10.0 * (2.0 - root), 10.0 * (2.0 + root)], Tol::ulps(64.0));
    assert_eq!(hanging.stability, Stability::Stable);
    let standing = chain([3.0, 0.1], vec![]).answers(0.0).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(standing.stability, Stability::Unstable);
    assert!(standing.modes.iter().all(|mode| 0.0 < mode.growth_rate && mode.angular_frequency <= 0.0));
}

#[test]
fn a_damped_spring_has_a_complex_mode() {
    // q̈ + 6 q̇ + 25 q = 0 on a rail: −3 ± 4 i.
    let slide = Coordinate { name: "slide".into(), angular: false, position: 1.0, velocity: 0.0 };
    let motion = JointMotion::Prismatic([1.0, 0.0, 0.0]);
    let joint = Joint { parent: None, offset: [0.0; 3], motion, coordinates: vec![slide] };
    let block = Part { joint: 0, name: "block".into(), at: [0.0; 3], kind: PartKind::Particle(2.0) };
    let kind = ForceKind::JointSpring { coordinate: 0, stiffness: 50.0, rest: 0.25, damping: 12.0 };
    let mut block = Mechanism::new(vec![joint], vec![block], [0.0; 3])
        .and_then(|block| block.with_forces(vec![Force { name: "spring".into(), kind }]))
        .unwrap_or_else(|error| panic!("{error}"));
    block.questions.modes = true;
    let answers = block.answers(0.0).unwrap_or_else(|error| panic!("{error}"));
    assert_close("equilibrium", &answers.coordinates, &[0.25], Tol::ulps(4.0));
    let mode = &answers.modes[0];
    assert_close("mode", &[mode.growth_rate, mode.angular_frequency], &[-3.0, 4.0], Tol::ulps(16.0));
    assert_eq!((answers.stability, answers.modes.len()), (Stability::Asymptotic, 1));
}

#[test]
fn energies_by_part_add_up_to_the_energy() {
    let system =
        chain([0.7, 0.4], vec![ForceKind::JointSpring { coordinate: 1, stiffness: 3.0, rest: 0.1, damping: 0.0 }]);
    let timetable = Timetable::new(TimeSpan { start: 0.0, end: 1.0 }, 6, &[]);
    let method = Method::GaussLegendre { order: Order::Eight, step: 0.05 };
    let run = simulate(&System::Mechanism(Box::new(system)), method, &timetable, &mut |_| ControlFlow::Continue(()));
    let expected = [
        "kinetic energy of m0 (J)",
        "weight of m0 (J)",
        "kinetic energy of m1 (J)",
        "weight of m1 (J)",
        "energy of it (J)",
    ];
    assert_eq!(run.history.energy_names, expected);
    let mut compared = 0;
    for (row, invariants) in run.history.energies.iter().zip(&run.history.invariants) {
        assert_close("energy", &[row.iter().sum()], &[invariants.energy], Tol::ulps(32.0));
        compared += 1;
    }
    assert_eq!(compared, 6);
}

/// ½ (p₀² + p₁²) − 1/√(q₀² + q₁²), from the pericentre of an orbit of the semi-major axis 1.
fn orbit(eccentricity: f64) -> PhaseSystem {
    let of = |variable: fn(usize) -> Variable| [Node::Variable(variable(0)), Node::Variable(variable(1))];
    let ([p0, p1], [q0, q1]) = (of(Variable::Conjugate), of(Variable::Coordinate));
    let squares = |a, b, first: usize| {
        let sum = Node::Operation(Operation::Sum, first + 1, first + 3);
        [a, Node::WholePower(first, 2), b, Node::WholePower(first + 2, 2), sum]
    };
    let mut nodes = squares(p0, p1, 0).to_vec();
    nodes.extend([Node::Constant(0.5), Node::Operation(Operation::Product, 4, 5)]);
    nodes.extend(squares(q0, q1, 7));
    nodes.extend([Node::Function(Function::Sqrt, 11), Node::WholePower(12, -1)]);
    nodes.push(Node::Operation(Operation::Difference, 6, 13));
    let names = |name: &str| vec![format!("{name}0"), format!("{name}1")];
    let speed = ((1.0 + eccentricity) / (1.0 - eccentricity)).sqrt();
    let (start, momentum) = (vec![1.0 - eccentricity, 0.0], vec![0.0, speed]);
    PhaseSystem::new(expression(nodes), (names("q"), names("p")), start, momentum).unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn a_composition_takes_an_orbit_about_a_centre_where_h_is_not_defined() {
    let kepler = orbit(0.1);
    assert!(kepler.hamiltonian.0.is_separable());
    let run = run(&kepler, Method::Composition { order: Order::Eight, step: TAU / 200.0 }, TAU);
    let [first, .., last] = &run.history.coordinates[..] else { panic!("no record") };
    assert_close("after a turn", last, first, Tol::stated(1e-11, "order eight at 200 steps a turn"));
    let half = &run.history.coordinates[5];
    assert_close("apocentre", &half[..2], &[-1.1, 0.0], Tol::stated(1e-11, "order eight at 200 steps a turn"));
}

#[test]
fn the_fastest_turn_is_found_along_the_motion() {
    // ½ p² + q⁴ from q = 0.001, p = 1: at the ends q⁴ = ½, where ∂²H/∂q² = 12 q² = 6 √2.
    let quartic = system(kinetic_and(vec![Q, Node::WholePower(4, 4)]), 0.001, 1.0);
    let span = TimeSpan { start: 0.0, end: 100.0 };
    assert!(quartic.turn(0.0).is_some_and(|turn| 1000.0 < turn));
    let expected = TAU / (6.0 * 2.0_f64.sqrt()).sqrt();
    let found = quartic.fastest_turn(span).unwrap_or_default();
    assert_close("turn", &[found], &[expected], Tol::stated(1e-2, "relative, of the nearest step to the end"));
    assert_eq!(system(kinetic_and(vec![Q]), 0.0, 1.0).fastest_turn(span), None);
}

#[test]
fn the_exponent_of_a_run_backwards_in_time_is_refused() {
    let mut pendulum = pendulum();
    pendulum.questions = PhaseQuestions { exponent: true, tolerance: 1e-11, ..PhaseQuestions::default() };
    let (answers, outcome) =
        pendulum.answers(TimeSpan { start: 10.0, end: 0.0 }, &History::default(), &mut |_| ControlFlow::Continue(()));
    assert!(matches!(&outcome, Outcome::Failed(why) if why.contains("backwards in time")), "{outcome:?}");
    assert_eq!(answers.exponent, None);
}

#[test]
fn the_quadrature_of_a_mode_is_its_shape_a_quarter_of_a_turn_later() {
    // About the hanging chain M = [5 2; 2 1], K = [30 10; 10 10], and a damper at the first joint alone.
    let damper = ForceKind::JointSpring { coordinate: 0, stiffness: 0.0, rest: 0.0, damping: 1.5 };
    let answers = chain([0.2, -0.1], vec![damper]).answers(0.0).unwrap_or_else(|error| panic!("{error}"));
    let acceleration = |q: [f64; 2], v: [f64; 2]| {
        let force = [-30.0 * q[0] - 10.0 * q[1] - 1.5 * v[0], -10.0 * q[0] - 10.0 * q[1]];
        [force[0] - 2.0 * force[1], -2.0 * force[0] + 5.0 * force[1]]
    };
    let mut compared = 0;
    for mode in answers.modes.iter().filter(|mode| 0.0 < mode.angular_frequency) {
        let (growth, turn) = (mode.growth_rate, mode.angular_frequency);
        let [shape, later] = [&mode.shape, &mode.quadrature].map(|half| [half[0], half[1]]);
        assert!(later.iter().any(|x| 1e-3 < x.abs()), "{later:?}");
        let mut y = [shape, [0, 1].map(|i| growth * shape[i] + turn * later[i])].concat();
        let (steps, rate) = (2000, |y: &[f64]| {
            let [a, b] = acceleration([y[0], y[1]], [y[2], y[3]]);
            [y[2], y[3], a, b]
        });
        let quarter = 0.25 * TAU / turn;
        let h = quarter / f64::from(steps);
        for _ in 0..steps {
            let moved = |k: &[f64; 4], by: f64| -> Vec<f64> { y.iter().zip(k).map(|(y, k)| y + by * k).collect() };
            let k1 = rate(&y);
            let k2 = rate(&moved(&k1, 0.5 * h));
            let k3 = rate(&moved(&k2, 0.5 * h));
            let k4 = rate(&moved(&k3, h));
            y = (0..4).map(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i])).collect();
        }
        let expected = later.map(|x| x * (growth * quarter).exp());
        assert_close(
            "a quarter of a turn later",
            &y[..2],
            &expected,
            Tol::stated(1e-9, "Runge and Kutta's of order four"),
        );
        compared += 1;
    }
    assert_eq!(compared, 2);
}

#[test]
fn a_light_damped_slide_beside_a_heavy_stiff_one_is_damped() {
    // ω = 1/s with half the critical damping, beside 1e6 kg on 1e9 N/m.
    let slide = |name: &str| Joint {
        parent: None,
        offset: [0.0; 3],
        motion: JointMotion::Prismatic([1.0, 0.0, 0.0]),
        coordinates: vec![Coordinate { name: name.into(), angular: false, position: 0.0, velocity: 0.0 }],
    };
    let block = |joint: usize, mass: f64| {
        let name = format!("block {joint}");
        Part { joint, name, at: [0.0; 3], kind: PartKind::Particle(mass) }
    };
    let spring = |coordinate: usize, stiffness: f64, damping: f64| {
        let kind = ForceKind::JointSpring { coordinate, stiffness, rest: 0.0, damping };
        Force { name: format!("spring {coordinate}"), kind }
    };
    let mut pair = Mechanism::new(vec![slide("light"), slide("heavy")], vec![block(0, 1e-6), block(1, 1e6)], [0.0; 3])
        .and_then(|pair| pair.with_forces(vec![spring(0, 1e-6, 1e-6), spring(1, 1e9, 0.0)]))
        .unwrap_or_else(|error| panic!("{error}"));
    pair.questions.modes = true;
    let answers = pair.answers(0.0).unwrap_or_else(|error| panic!("{error}"));
    let light = answers.modes.iter().find(|mode| mode.angular_frequency < 2.0).unwrap_or_else(|| panic!("no mode"));
    let found = [light.growth_rate, light.angular_frequency];
    assert_close("mode", &found, &[-0.5, 0.75_f64.sqrt()], Tol::stated(1e-9, "eigenvalues beside one of 30/s"));
}
