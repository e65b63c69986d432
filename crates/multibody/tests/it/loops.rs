//! Closed loops: a four-bar linkage as a tree with a cut joint against its closed form, and what is wrong with loops.

use nalgebra::Vector3;
use piola_integrators::{DormandPrince853, State, Tolerance};
use piola_kinematics::{Attitude, Inertia, RigidBody};
use piola_lagrangian::{Holonomic, Lagrangian, Placement};
use piola_multibody::{
    BodyIndex, BodyInertia, BodyPoint, ClosedTree, JointKind, LoopClosure, MultibodyError, RigidTree, TreeJoint,
};
use piola_numerics::{Jet, Real};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};

/// Crank, coupler, rocker and frame, m: the crank turns round, the rocker swings.
const BARS: [f64; 4] = [0.1, 0.35, 0.3, 0.4];
const MASSES: [f64; 3] = [1.0, 3.0, 2.0];
const MOMENTS: [f64; 3] = [0.2, 0.03, 0.015];
const GRAVITY: f64 = 9.80665;

fn rigid(k: usize) -> RigidBody {
    RigidBody::new(MASSES[k], Inertia::principal([MOMENTS[k]; 3]).unwrap()).unwrap()
}

/// The angles of crank, coupler and rocker against x, in the plane x–y, the coupler above.
fn bar_angles<T: Real>(crank: T) -> [T; 3] {
    let [a, b, c, d] = BARS.map(T::lit);
    let (sine, cosine) = crank.sin_cos();
    let (x, y) = (d - a * cosine, -(a * sine));
    let squared = x * x + y * y;
    let diagonal = squared.sqrt();
    let coupler = y.atan2(x) + ((squared + b * b - c * c) / (T::lit(2.0) * b * diagonal)).acos();
    let (s, k) = coupler.sin_cos();
    [crank, coupler, (b * s - y).atan2(b * k - x)]
}

/// The linkage by the crank's angle alone.
struct Crank;

impl Holonomic for Crank {
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        let [crank, coupler, rocker] = bar_angles(q[0]);
        let along = |length: f64, angle: T| {
            let (s, c) = angle.sin_cos();
            Vector3::new(T::lit(length) * c, T::lit(length) * s, T::zero())
        };
        let [a, b, c, d] = BARS;
        bodies.body(&rigid(0), along(0.5 * a, crank), Attitude::about_z(crank));
        bodies.body(&rigid(1), along(a, crank) + along(0.5 * b, coupler), Attitude::about_z(coupler));
        let pivot = Vector3::new(T::lit(d), T::zero(), T::zero());
        bodies.body(&rigid(2), pivot + along(0.5 * c, rocker), Attitude::about_z(rocker));
    }
}

const HINGE: JointKind = JointKind::Revolute { axis: [0.0, 0.0, 1.0] };

/// The linkage as a tree, cut between coupler and rocker; q = (crank, coupler against crank, rocker).
fn tree() -> (RigidTree, [BodyPoint; 2]) {
    let [a, b, c, d] = BARS;
    let mut builder = RigidTree::builder().with_gravity([0.0, -GRAVITY, 0.0]).unwrap();
    let bar = |k: usize, length: f64| BodyInertia::of(&rigid(k), [0.5 * length, 0.0, 0.0]);
    let crank = builder.attach(BodyIndex::GROUND, TreeJoint::new("a", HINGE), "crank", bar(0, a)).unwrap();
    let joint = TreeJoint::new("b", HINGE).at([a, 0.0, 0.0]);
    let coupler = builder.attach(crank, joint, "coupler", bar(1, b)).unwrap();
    let joint = TreeJoint::new("d", HINGE).at([d, 0.0, 0.0]);
    let rocker = builder.attach(BodyIndex::GROUND, joint, "rocker", bar(2, c)).unwrap();
    let ends = [BodyPoint::new(coupler, [b, 0.0, 0.0]), BodyPoint::new(rocker, [c, 0.0, 0.0])];
    (builder.build().unwrap(), ends)
}

fn closed() -> ClosedTree {
    let (tree, [first, second]) = tree();
    let mut closed = ClosedTree::new(tree);
    closed.close("cut", LoopClosure::Point { first, second }).unwrap();
    closed
}

/// Coordinates of the tree and their rates at a crank angle and its rate.
fn state(crank: f64, rate: f64) -> ([f64; 3], [f64; 3]) {
    let [a, b, c] = bar_angles(Jet::<f64, 0>::coordinate(crank, rate, 0));
    let q = [a, b - a, c];
    (q.map(|q| q.value), q.map(|q| q.rate))
}

#[test]
fn four_bar_with_a_cut_joint_accelerates_as_by_its_crank() {
    let closed = closed();
    let lagrangian = Lagrangian::of(Crank).with_uniform_gravity([0.0, -GRAVITY, 0.0]);
    let mut work = closed.workspace();
    let mut found = [0.0; 3];
    for k in 0..12 {
        let (q, v) = state(0.5 * f64::from(k), 3.0);
        closed.accelerations(&mut work, &q, &v, &[0.0; 3], 0.0, &mut found).unwrap();
        let expected = lagrangian.acceleration(&[q[0]], &[3.0], 0.0).unwrap();
        assert_close("crank", &found[..1], expected.as_slice(), Tol::ulps_because(4096.0, "two ways round a loop"));
        assert_eq!((work.rank(), work.redundant().len()), (2, 1));
    }
}

#[test]
fn four_bar_with_a_cut_joint_moves_as_by_its_crank() {
    let closed = closed();
    let (q, v) = state(0.5, 10.0);
    let mut motion = closed.motion(|_t, _q, _v, tau| tau.fill(0.0));
    let mut moving = State::new(0.0, [q, v].concat()).unwrap();
    let tolerance = Tolerance::relative(1e-13).unwrap();
    DormandPrince853::new(tolerance).integrate_to(&mut motion, &mut moving, 2.0).unwrap();
    let lagrangian = Lagrangian::of(Crank).with_uniform_gravity([0.0, -GRAVITY, 0.0]);
    let run = lagrangian.integrate(&[0.5], &[10.0], 0.0..2.0, tolerance).unwrap();
    let (angle, rate) = run.last();
    let asked = Tol::stated(1e-10, "what is asked of the motion of loops");
    assert_close_at_scale("crank", &moving.values[..1], angle, 1.0, asked);
    assert_close("rate", &moving.values[3..4], rate, asked);
    let mut work = closed.workspace();
    let (mut q, mut v) = (moving.values[..3].to_vec(), moving.values[3..].to_vec());
    closed.project(&mut work, &mut q, &mut v, 0.0).unwrap();
    assert!(work.residuals().iter().all(|x| x.abs() <= 4.0 * f64::EPSILON));
}

#[test]
fn driven_crank_needs_the_torque_of_its_equation() {
    let (tree, [first, second]) = tree();
    let mut closed = ClosedTree::new(tree);
    closed.close("cut", LoopClosure::Point { first, second }).unwrap();
    let motion = |t: f64| [0.5 + 2.0 * t + 0.15 * t * t, 2.0 + 0.3 * t, 0.3];
    closed.close("motor", LoopClosure::Prescribed { freedom: 0, motion }).unwrap();
    let (q, v) = state(0.5, 2.0);
    let mut work = closed.workspace();
    let mut found = [0.0; 3];
    closed.accelerations(&mut work, &q, &v, &[0.0; 3], 0.0, &mut found).unwrap();
    let lagrangian = Lagrangian::of(Crank).with_uniform_gravity([0.0, -GRAVITY, 0.0]);
    let torque = lagrangian.driving_forces(&[0.5], &[2.0], &[0.3], 0.0).unwrap();
    let condition = closed.first_condition("motor").unwrap();
    let rounding = Tol::ulps_because(4096.0, "two ways round a loop");
    assert_close("torque", &work.multipliers()[condition..=condition], torque.as_slice(), rounding);
    assert_close("acceleration", &found[..1], &[0.3], rounding);
}

#[test]
fn rod_and_hinges_and_frames_hold_what_points_hold() {
    // The rocker as a massless rod: the same as a distance. Two points of the coupler held as a frame.
    let mut builder = RigidTree::builder();
    let free = builder
        .attach(BodyIndex::GROUND, TreeJoint::new("free", JointKind::Free), "body", crate::trees::odd_body(3))
        .unwrap();
    let frame = builder.add_frame(free, "tip", [0.1, 0.2, 0.3], Attitude::about_x(0.4)).unwrap();
    let mut at_rest = [0.0; 7];
    let tree = {
        let place = Attitude::about_x(0.4);
        let ground = builder.add_frame(BodyIndex::GROUND, "wall", [0.1, 0.2, 0.3], place).unwrap();
        let tree = builder.build().unwrap();
        tree.neutral_configuration(&mut at_rest).unwrap();
        let mut closed = ClosedTree::new(tree.clone());
        closed.close("weld", LoopClosure::Frame { first: frame, second: ground }).unwrap();
        let mut work = closed.workspace();
        let mut out = [1.0; 6];
        closed.accelerations(&mut work, &at_rest, &[0.0; 6], &[0.0; 6], 0.0, &mut out).unwrap();
        assert_close_at_scale("welded", &out, &[0.0; 6], 9.81, Tol::ulps(64.0));
        // The weld carries the weight.
        assert_close("weight", &work.multipliers()[2..3], &[9.81 * tree.total_mass()], Tol::ulps(64.0));
        tree
    };
    // A hinge: a point and an axis leave one freedom, as the joint itself.
    let mut closed = ClosedTree::new(tree);
    let pin = BodyPoint::new(free, [0.0; 3]);
    let wall = BodyPoint::new(BodyIndex::GROUND, [0.0; 3]);
    closed.close("pin", LoopClosure::Point { first: pin, second: wall }).unwrap();
    let axis = [0.0, 1.0, 0.0];
    let parallel = LoopClosure::Axis { first: free, first_axis: axis, second: BodyIndex::GROUND, second_axis: axis };
    closed.close("axis", parallel).unwrap();
    let v = [0.0, 2.0, 0.0, 0.0, 0.0, 0.0];
    let mut out = [0.0; 6];
    closed.accelerations(&mut closed.workspace(), &at_rest, &v, &[0.0; 6], 0.0, &mut out).unwrap();
    let mut builder = RigidTree::builder();
    let joint = TreeJoint::new("hinge", JointKind::Revolute { axis });
    builder.attach(BodyIndex::GROUND, joint, "body", crate::trees::odd_body(3)).unwrap();
    let hinged = builder.build().unwrap();
    let mut expected = [0.0];
    hinged.forward_dynamics(&mut hinged.workspace(), &[0.0], &[2.0], &[0.0], &mut expected).unwrap();
    assert_close("hinge", &out[1..2], &expected, Tol::ulps_because(256.0, "five conditions"));
}

#[test]
fn gears_share_the_inertia_of_what_they_drive() {
    let mut builder = RigidTree::builder();
    let wheel =
        |moment: f64| BodyInertia::new(1.0, [0.0; 3], [[moment, 0.0, 0.0], [0.0, moment, 0.0], [0.0, 0.0, moment]]);
    builder.attach(BodyIndex::GROUND, TreeJoint::new("a", HINGE), "pinion", wheel(2.0).unwrap()).unwrap();
    builder.attach(BodyIndex::GROUND, TreeJoint::new("b", HINGE), "gear", wheel(8.0).unwrap()).unwrap();
    let mut closed = ClosedTree::new(builder.build().unwrap());
    closed.close("mesh", LoopClosure::Gear { follower: 1, leader: 0, ratio: -0.5, offset: 0.0 }).unwrap();
    let mut out = [0.0; 2];
    closed.accelerations(&mut closed.workspace(), &[0.0; 2], &[0.0; 2], &[1.0, 0.0], 0.0, &mut out).unwrap();
    // 1/(2 + 8/4)
    assert_close("gears", &out, &[0.25, -0.125], Tol::ulps(8.0));
}

#[test]
fn distances_hold_as_the_rods_that_they_replace() {
    let mut builder = RigidTree::builder();
    let slide = TreeJoint::new("plane", JointKind::Planar);
    let bob = builder
        .attach(
            BodyIndex::GROUND,
            slide,
            "bob",
            BodyInertia::new(1.0, [0.0; 3], [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]).unwrap(),
        )
        .unwrap();
    let mut closed = ClosedTree::new(builder.with_gravity([0.0, -10.0, 0.0]).unwrap().build().unwrap());
    let first = BodyPoint::new(bob, [0.0; 3]);
    let second = BodyPoint::new(BodyIndex::GROUND, [0.0; 3]);
    closed.close("rod", LoopClosure::Distance { first, second, length: 2.0 }).unwrap();
    let mut work = closed.workspace();
    let mut out = [0.0; 3];
    // At the bottom with 4 m/s: v²/l = 8 m/s² up, the rod pulls with 18 N.
    closed.accelerations(&mut work, &[0.0, -2.0, 0.0], &[4.0, 0.0, 0.0], &[0.0; 3], 0.0, &mut out).unwrap();
    assert_close("ẍ", &out, &[0.0, 8.0, 0.0], Tol::ulps(16.0));
    assert_close("pull", work.multipliers(), &[-18.0], Tol::ulps(16.0));
    let (mut q, mut v) = ([0.3, -2.1, 0.0], [4.0, 1.0, 0.0]);
    closed.project(&mut work, &mut q, &mut v, 0.0).unwrap();
    assert!((q[0].hypot(q[1]) - 2.0).abs() < 1e-15 && (q[0] * v[0] + q[1] * v[1]).abs() < 1e-14);
}

#[test]
fn contradictions_and_states_that_cannot_close_are_named() {
    let (tree, [first, second]) = tree();
    let mut closed = ClosedTree::new(tree);
    closed.close("motor", LoopClosure::Prescribed { freedom: 0, motion: |_| [0.0, 0.0, 1.0] }).unwrap();
    closed.close("brake", LoopClosure::Prescribed { freedom: 0, motion: |_| [0.0, 0.0, 0.0] }).unwrap();
    let error =
        closed.accelerations(&mut closed.workspace(), &[0.0; 3], &[0.0; 3], &[0.0; 3], 0.0, &mut [0.0; 3]).unwrap_err();
    assert!(matches!(error, MultibodyError::Contradiction { closure, .. } if closure == "brake" || closure == "motor"));
    // Twice the same loop is no contradiction.
    let (tree, _) = super::loops::tree();
    let mut twice = ClosedTree::new(tree);
    twice.close("cut", LoopClosure::Point { first, second }).unwrap();
    twice.close("again", LoopClosure::Point { first, second }).unwrap();
    let (q, v) = state(0.7, 1.0);
    let (mut once, mut out) = ([0.0; 3], [0.0; 3]);
    let mut work = twice.workspace();
    twice.accelerations(&mut work, &q, &v, &[0.0; 3], 0.0, &mut out).unwrap();
    super::loops::closed()
        .accelerations(&mut super::loops::closed().workspace(), &q, &v, &[0.0; 3], 0.0, &mut once)
        .unwrap();
    assert_close("the same motion", &out, &once, Tol::ulps_because(4096.0, "two ways round a loop"));
    assert_eq!(work.rank(), 2);
    // Both carry half.
    assert_close("halves", &work.multipliers()[..2], &work.multipliers()[3..5], Tol::ulps_because(4096.0, "as above"));
    // A rocker that is out of reach.
    let (tree, [first, _]) = super::loops::tree();
    let mut apart = ClosedTree::new(tree);
    let second = BodyPoint::new(BodyIndex::GROUND, [5.0, 0.0, 0.0]);
    apart.close("nowhere", LoopClosure::Point { first, second }).unwrap();
    let (mut q, mut v) = state(0.7, 1.0);
    let before = (q, v);
    let error = apart.project(&mut apart.workspace(), &mut q, &mut v, 0.0).unwrap_err();
    assert!(
        matches!(error, MultibodyError::NoClosedState { closure, residual } if closure == "nowhere" && 1.0 < residual.abs())
    );
    assert_eq!((q, v), before);
}
