//! Bricard's loop and Andrews' squeezing mechanism as trees with cut joints, to the digits that placement maps reach.

use nalgebra::Vector3;
use piola_integrators::{DormandPrince853, State, Tolerance};
use piola_kinematics::{Attitude, Inertia, RigidBody};
use piola_lagrangian::{Holonomic, Lagrangian, Placement};
use piola_multibody::{BodyIndex, BodyInertia, BodyPoint, ClosedTree, JointKind, LoopClosure, RigidTree, TreeJoint};
use piola_numerics::{Jet, Real};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use serde_json::Value;

const HINGE: JointKind = JointKind::Revolute { axis: [0.0, 0.0, 1.0] };
const RIGHT: f64 = core::f64::consts::FRAC_PI_2;

/// The length of Bricard's links, m, and a direction of gravity that leaves nothing of the loop's symmetry.
const LINK: f64 = 0.5;
const GRAVITY: [f64; 3] = [0.5, -1.5, 2.0];
/// The centre of mass of a link.
const CENTRE: [f64; 3] = [0.5 * LINK, 0.05, -0.02];

fn isotropic(mass: f64, moment: f64) -> RigidBody {
    RigidBody::new(mass, Inertia::principal([moment; 3]).unwrap()).unwrap()
}

fn link(i: usize) -> RigidBody {
    let mass = 1.0 + 0.25 * i as f64;
    isotropic(mass, 0.02 * mass)
}

/// By how much z turns about x from link i to the next.
fn twist(i: usize) -> f64 {
    if i.is_multiple_of(2) { RIGHT } else { -RIGHT }
}

/// The joint angles (θ, φ, θ, φ, θ) of the symmetric motion: cos θ/2 cos φ/2 = 1/2.
fn loop_angles<T: Real>(psi: T) -> [T; 5] {
    let (s, c) = psi.sin_cos();
    let (root, two) = (T::lit(3.0_f64.sqrt()), T::lit(2.0));
    let theta = two * (root * c).atan();
    let phi = two * (root * s / (T::one() + T::lit(3.0) * c * c).sqrt()).atan();
    [theta, phi, theta, phi, theta]
}

/// Bricard's loop by the one parameter of its symmetric motion.
struct Symmetric;

impl Holonomic for Symmetric {
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        let mut place = Vector3::new(T::zero(), T::zero(), T::zero());
        let mut attitude = Attitude::identity();
        for (i, &angle) in loop_angles(q[0]).iter().enumerate() {
            attitude = attitude.product(Attitude::about_z(angle));
            let centre = Vector3::from(CENTRE.map(T::lit));
            bodies.body(&link(i), place + attitude.to_space(&centre), attitude);
            place += attitude.to_space(&Vector3::new(T::lit(LINK), T::zero(), T::zero()));
            attitude = attitude.product(Attitude::about_x(T::lit(twist(i))));
        }
    }
}

/// Five links from the ground; the sixth is the ground, on which the cut hinge lies.
fn bricard() -> ClosedTree {
    let mut builder = RigidTree::builder().with_gravity(GRAVITY).unwrap();
    let mut last = BodyIndex::GROUND;
    for i in 0..5 {
        let joint = TreeJoint::new(format!("joint {i}"), HINGE);
        let joint = if i == 0 { joint } else { joint.at([LINK, 0.0, 0.0]).turned(Attitude::about_x(twist(i - 1))) };
        last = builder.attach(last, joint, format!("link {i}"), BodyInertia::of(&link(i), CENTRE)).unwrap();
    }
    let mut closed = ClosedTree::new(builder.build().unwrap());
    let first = BodyPoint::new(last, [LINK, 0.0, 0.0]);
    let second = BodyPoint::new(BodyIndex::GROUND, [-LINK, 0.0, 0.0]);
    closed.close("place of the cut hinge", LoopClosure::Point { first, second }).unwrap();
    let axis = [0.0, -1.0, 0.0];
    let parallel = LoopClosure::Axis { first: last, first_axis: axis, second: BodyIndex::GROUND, second_axis: axis };
    closed.close("axis of the cut hinge", parallel).unwrap();
    closed
}

fn loop_state(psi: f64, rate: f64) -> ([f64; 5], [f64; 5]) {
    let jets = loop_angles(Jet::<f64, 0>::coordinate(psi, rate, 0));
    (jets.map(|q| q.value), jets.map(|q| q.rate))
}

#[test]
fn bricard_loop_with_a_cut_hinge_accelerates_and_moves_as_by_its_parameter() {
    let closed = bricard();
    let symmetric = Lagrangian::of(Symmetric).with_uniform_gravity(GRAVITY);
    let mut work = closed.workspace();
    let mut found = [0.0; 5];
    for k in 0..12 {
        let psi = 0.5 * f64::from(k) + 0.1;
        let (q, v) = loop_state(psi, 1.5);
        closed.accelerations(&mut work, &q, &v, &[0.0; 5], 0.0, &mut found).unwrap();
        // Five conditions, of which four are independent all round.
        assert_eq!(work.rank(), 4, "at ψ = {psi}");
        assert_close_at_scale("closure", work.residuals(), &[0.0; 5], 1.0, Tol::ulps(24.0));
        let second = symmetric.acceleration(&[psi], &[1.5], 0.0).unwrap()[0];
        let twice = loop_angles(Jet::<Jet<f64, 0>, 0>::coordinate(
            Jet::coordinate(psi, 1.5, 0),
            Jet::coordinate(1.5, second, 0),
            0,
        ));
        let expected = twice.map(|q| q.rate.rate);
        assert_close(
            "accelerations",
            &found,
            &expected,
            Tol::stated(1e-11, "ulps by the condition of four conditions"),
        );
    }
    let (q, v) = loop_state(0.6, 4.0);
    let tolerance = Tolerance::relative(1e-13).unwrap();
    let mut motion = closed.motion(|_t, _q, _v, tau| tau.fill(0.0));
    let mut state = State::new(0.0, [q, v].concat()).unwrap();
    DormandPrince853::new(tolerance).integrate_to(&mut motion, &mut state, 10.0).unwrap();
    let reference = symmetric.integrate(&[0.6], &[4.0], 0.0..10.0, tolerance).unwrap();
    let (end, rate) = reference.last();
    assert!(core::f64::consts::TAU < end[0], "it turns inside out: {}", end[0]);
    let expected = loop_state(end[0], rate[0]);
    let asked = Tol::stated(1e-10, "what is asked of ten seconds of motion");
    assert_close_at_scale("angles", &state.values[..5], &expected.0, 1.0, asked);
    assert_close_at_scale("rates", &state.values[5..], &expected.1, 1.0, asked);
    assert_eq!(motion.singular_count(), 0);
}

/// The squeezer as a tree; coordinates (β, Θ, γ, δ, Φ, ε, Ω).
struct Squeezer {
    closed: ClosedTree,
    parameters: Value,
    start: Vec<f64>,
    precise: Vec<f64>,
}

/// Where the coordinates of the tree stand in the published order.
const ORDER: [usize; 7] = [0, 1, 2, 4, 3, 6, 5];

impl Squeezer {
    fn published() -> Self {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../testdata/reference/andrews_squeezer.json");
        let file: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
        let numbers = |list: &Value| -> Vec<f64> {
            list.as_array().unwrap().iter().map(|x| x.as_str().unwrap().parse().unwrap()).collect()
        };
        let parameters = file["parameters"].clone();
        let p = |name: &str| parameters[name].as_f64().unwrap();
        let mut builder = RigidTree::builder().with_gravity([0.0; 3]).unwrap();
        let mut attach = |parent, name: &str, at: [f64; 2], number: usize, centre: [f64; 2]| {
            let body = isotropic(p(&format!("m{number}")), p(&format!("i{number}")));
            let joint = TreeJoint::new(format!("joint of {name}"), HINGE).at([at[0], at[1], 0.0]);
            builder.attach(parent, joint, name, BodyInertia::of(&body, [centre[0], centre[1], 0.0])).unwrap()
        };
        let (a, b) = ([p("xa"), p("ya")], [p("xb"), p("yb")]);
        let crank = attach(BodyIndex::GROUND, "K1", [0.0; 2], 1, [p("ra"), 0.0]);
        let slider = attach(crank, "K2", [p("rr"), 0.0], 2, [-p("da"), 0.0]);
        let third = attach(BodyIndex::GROUND, "K3", b, 3, [p("sb"), -p("sa")]);
        let fifth = attach(BodyIndex::GROUND, "K5", a, 5, [p("ta"), -p("tb")]);
        let fourth = attach(fifth, "K4", [p("zt"), 0.0], 4, [0.0, p("ea") - p("e")]);
        let seventh = attach(BodyIndex::GROUND, "K7", a, 7, [p("ub"), -p("ua")]);
        let sixth = attach(seventh, "K6", [0.0, -p("u")], 6, [p("zf") - p("fa"), 0.0]);
        let mut closed = ClosedTree::new(builder.build().unwrap());
        let first = BodyPoint::new(slider, [-p("d"), 0.0, 0.0]);
        for (name, body, at) in [
            ("slider and K3", third, [0.0, -p("ss"), 0.0]),
            ("slider and K4", fourth, [0.0, -p("e"), 0.0]),
            ("slider and K6", sixth, [p("zf"), 0.0, 0.0]),
        ] {
            closed.close(name, LoopClosure::Point { first, second: BodyPoint::new(body, at) }).unwrap();
        }
        let start = numbers(&file["initial_state"]);
        let precise = numbers(&file["own_reference_t003"]["state"]);
        Self { closed, parameters, start, precise }
    }

    /// The motor's moment on the crank, and the moment of the spring on K3.
    fn forces(&self) -> impl Fn(&[f64], &mut [f64]) {
        let p = |name: &str| self.parameters[name].as_f64().unwrap();
        let [moment, stiffness, natural] = [p("mom"), p("c0"), p("l0")];
        let (pivot, fixed, at) = ([p("xb"), p("yb")], [p("xc"), p("yc")], [p("sd"), -p("sc")]);
        move |q: &[f64], tau: &mut [f64]| {
            tau.fill(0.0);
            tau[0] = moment;
            let (s, c) = q[2].sin_cos();
            let arm = [c * at[0] - s * at[1], s * at[0] + c * at[1]];
            let (x, y) = (pivot[0] + arm[0] - fixed[0], pivot[1] + arm[1] - fixed[1]);
            let length = x.hypot(y);
            let pull = -stiffness * (length - natural) / length;
            tau[2] = pull * (arm[0] * y - arm[1] * x);
        }
    }
}

fn in_tree(published: &[f64]) -> Vec<f64> {
    ORDER.iter().map(|&k| published[k]).collect()
}

#[test]
fn squeezer_with_cut_joints_starts_with_the_published_accelerations() {
    let squeezer = Squeezer::published();
    let [q, v, expected] = [0, 7, 14].map(|first| in_tree(&squeezer.start[first..first + 7]));
    let (mut tau, mut found) = ([0.0; 7], [0.0; 7]);
    squeezer.forces()(&q, &mut tau);
    let mut work = squeezer.closed.workspace();
    squeezer.closed.accelerations(&mut work, &q, &v, &tau, 0.0, &mut found).unwrap();
    assert_eq!(work.rank(), 6);
    assert_close("v̇", &found, &expected, Tol::stated(1e-13, "the start is given to sixteen digits and more"));
}

#[test]
fn squeezer_with_cut_joints_moves_as_the_solution_in_thirty_digits() {
    let squeezer = Squeezer::published();
    let [q, v] = [0, 7].map(|first| in_tree(&squeezer.start[first..first + 7]));
    let forces = squeezer.forces();
    let mut motion = squeezer.closed.motion(|_t, q, _v, tau| forces(q, tau));
    let mut state = State::new(0.0, [q, v].concat()).unwrap();
    DormandPrince853::new(Tolerance::relative(1e-14).unwrap()).integrate_to(&mut motion, &mut state, 0.03).unwrap();
    for (k, &published) in ORDER.iter().enumerate() {
        let rounding = |size| Tol::stated(size, "rounding of a third of a thousand steps");
        let (angle, rate) = (squeezer.precise[published], squeezer.precise[7 + published]);
        assert_close(&format!("angle {k}"), &state.values[k..=k], &[angle], rounding(1e-12));
        assert_close(&format!("rate {k}"), &state.values[7 + k..8 + k], &[rate], rounding(1e-10));
    }
}
