//! Trees of joints: places by Rodrigues' formula, and coordinates that depend on each other.

use core::ops::ControlFlow;

use piola_integrators::Order;
use piola_simulation::joints::{Coordinate, Joint, JointMotion, Mechanism, Part, PartKind};
use piola_simulation::motion::{Method, System, TimeSpan, Timetable, simulate};
use piola_testkit::{Tol, assert_close};

fn joint(parent: Option<usize>, offset: [f64; 3], motion: JointMotion, positions: &[f64]) -> Joint {
    let coordinate = |(index, position): (usize, &f64)| {
        let (name, angular) = (format!("q{index}"), !matches!(motion, JointMotion::Prismatic(_)));
        Coordinate { name, angular, position: *position, velocity: 0.0 }
    };
    Joint { parent, offset, motion, coordinates: positions.iter().enumerate().map(coordinate).collect() }
}

fn particle(joint: usize, mass: f64, at: [f64; 3]) -> Part {
    Part { joint, name: format!("on {joint}"), at, kind: PartKind::Particle(mass) }
}

fn mechanism(joints: Vec<Joint>, parts: Vec<Part>) -> Mechanism {
    match Mechanism::new(joints, parts, [0.0, 0.0, -9.81]) {
        Ok(mechanism) => mechanism,
        Err(error) => panic!("{error}"),
    }
}

/// A vector turned by an angle about a unit axis: x cos φ + k × x sin φ + k (k·x)(1 − cos φ).
fn turned([x, y, z]: [f64; 3], [a, b, c]: [f64; 3], angle: f64) -> [f64; 3] {
    let (sine, cosine) = angle.sin_cos();
    let along = (a * x + b * y + c * z) * (1.0 - cosine);
    let across = [b * z - c * y, c * x - a * z, a * y - b * x];
    [
        x * cosine + across[0] * sine + a * along,
        y * cosine + across[1] * sine + b * along,
        z * cosine + across[2] * sine + c * along,
    ]
}

fn sum(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

#[test]
fn parts_of_a_crane_are_where_its_joints_carry_them() {
    // A mast that turns, an arm that slides out of it, and a hook that turns about two axes.
    let (mast, arm, first, second) = ([0.48, 0.6, 0.64], [0.6, 0.0, 0.8], [0.0, 0.6, -0.8], [0.8, 0.6, 0.0]);
    let joints = vec![
        joint(None, [1.0, 2.0, 3.0], JointMotion::Revolute(mast), &[0.7]),
        joint(Some(0), [0.0, 0.5, -0.25], JointMotion::Prismatic(arm), &[2.5]),
        joint(Some(1), [-1.0, 0.25, 0.5], JointMotion::Universal(first, second), &[-0.4, 1.1]),
    ];
    let (on_mast, on_arm, on_hook) = ([0.5, -0.5, 0.25], [0.25, 1.5, -2.0], [0.75, 0.5, -1.0]);
    let parts = vec![particle(0, 1.0, on_mast), particle(1, 2.0, on_arm), particle(2, 3.0, on_hook)];
    let system = System::Mechanism(Box::new(mechanism(joints, parts)));
    let method = Method::GaussLegendre { order: Order::Four, step: 0.1 };
    let timetable = Timetable::new(TimeSpan { start: 0.0, end: 1.0 }, 2, &[]);
    let run = simulate(&system, method, &timetable, &mut |_| ControlFlow::Break(()));

    let slid = sum([0.0, 0.5, -0.25], arm.map(|x| 2.5 * x));
    let hung = turned(turned(on_hook, second, 1.1), first, -0.4);
    let in_mast = [on_mast, sum(slid, on_arm), sum(slid, sum([-1.0, 0.25, 0.5], hung))];
    let expected = in_mast.map(|place| sum([1.0, 2.0, 3.0], turned(place, mast, 0.7)));
    for (found, expected) in run.history.positions[0].iter().zip(&expected) {
        assert_close("place", found, expected, Tol::ulps(8.0));
    }
    assert_eq!(run.history.positions[0].len(), 3);
}

#[test]
fn coordinates_that_move_the_same_things_or_nothing_are_found() {
    let along = JointMotion::Prismatic([0.6, 0.8, 0.0]);
    let about = JointMotion::Revolute([0.0, 0.0, 1.0]);
    let chain = |third: JointMotion, at: [f64; 3]| {
        let joints = vec![
            joint(None, [0.0; 3], along, &[1.0]),
            joint(Some(0), [0.0; 3], about, &[0.3]),
            joint(Some(1), [0.0; 3], third, &[2.0]),
        ];
        let mechanism = mechanism(joints, vec![particle(2, 5.0, at)]);
        mechanism.tree.dependent_coordinates(&mechanism.position)
    };
    // A second rail that rises moves differently from the first one; the two are one where they are parallel.
    assert!(chain(JointMotion::Prismatic([0.0, 0.6, 0.8]), [0.0, 0.0, 1.0]).is_empty());
    let (sine, cosine) = 0.3_f64.sin_cos();
    let back = [0.6 * cosine + 0.8 * sine, 0.8 * cosine - 0.6 * sine, 0.0];
    assert_eq!(chain(JointMotion::Prismatic(back), [0.0, 0.0, 1.0]), [[0, 2]]);
    // A particle on the axis feels neither turn; elsewhere two turns about one axis are one.
    assert_eq!(chain(about, [0.0, 0.0, 1.0]), [[1], [2]]);
    assert_eq!(chain(about, [0.5, 0.0, 1.0]), [[1, 2]]);
}
