//! Trees that tests, examples and benches share.

use piola_kinematics::{Attitude, Inertia, RigidBody};
use piola_multibody::{BodyIndex, BodyInertia, JointKind, RigidTree, TreeJoint};

/// A uniform rod of 1 m and 1 kg that hangs from its joint along −z, a little thick.
pub(crate) fn rod() -> BodyInertia {
    let inertia = Inertia::principal([0.084, 0.084, 0.0013]).unwrap();
    BodyInertia::of(&RigidBody::new(1.0, inertia).unwrap(), [0.0, 0.0, -0.5])
}

/// A chain of rods, whose axes are y and x in turn.
pub(crate) fn chain(links: usize) -> RigidTree {
    let mut builder = RigidTree::builder();
    let mut parent = BodyIndex::GROUND;
    for i in 0..links {
        let axis = if i % 2 == 0 { [0.0, 1.0, 0.0] } else { [1.0, 0.0, 0.0] };
        let joint = TreeJoint::new(format!("joint {i}"), JointKind::Revolute { axis });
        let joint = if i == 0 { joint } else { joint.at([0.0, 0.0, -1.0]) };
        parent = builder.attach(parent, joint, format!("rod {i}"), rod()).unwrap();
    }
    builder.build().unwrap()
}

/// Name, origin, axis, pitch, moments of inertia, mass, centre of mass.
type Row = (&'static str, [f64; 3], [f64; 3], f64, [f64; 3], f64, [f64; 3]);

/// The arm UR5, as in the file `ur5.urdf` of the reference data.
pub(crate) fn ur5() -> RigidTree {
    #[expect(clippy::approx_constant, reason = "the digits of the file")]
    const ROWS: [Row; 6] = [
        (
            "shoulder_pan_joint",
            [0.0, 0.0, 0.089_159],
            [0.0, 0.0, 1.0],
            0.0,
            [0.010_267_495_893, 0.010_267_495_893, 0.006_66],
            3.7,
            [0.0, 0.0, 0.0],
        ),
        (
            "shoulder_lift_joint",
            [0.0, 0.135_85, 0.0],
            [0.0, 1.0, 0.0],
            1.570_796_326_79,
            [0.226_890_675_91, 0.226_890_675_91, 0.015_107_4],
            8.393,
            [0.0, 0.0, 0.28],
        ),
        (
            "elbow_joint",
            [0.0, -0.1197, 0.425],
            [0.0, 1.0, 0.0],
            0.0,
            [0.049_443_313_556, 0.049_443_313_556, 0.004_095],
            2.275,
            [0.0, 0.0, 0.25],
        ),
        (
            "wrist_1_joint",
            [0.0, 0.0, 0.392_25],
            [0.0, 1.0, 0.0],
            1.570_796_326_79,
            [0.111_172_755_531, 0.111_172_755_531, 0.219_42],
            1.219,
            [0.0, 0.0, 0.0],
        ),
        (
            "wrist_2_joint",
            [0.0, 0.093, 0.0],
            [0.0, 0.0, 1.0],
            0.0,
            [0.111_172_755_531, 0.111_172_755_531, 0.219_42],
            1.219,
            [0.0, 0.0, 0.0],
        ),
        (
            "wrist_3_joint",
            [0.0, 0.0, 0.094_65],
            [0.0, 1.0, 0.0],
            0.0,
            [0.017_136_473_145_4, 0.017_136_473_145_4, 0.033_822],
            0.1879,
            [0.0, 0.0, 0.0],
        ),
    ];
    let mut builder = RigidTree::builder();
    let mut parent = BodyIndex::GROUND;
    for (name, origin, axis, pitch, moments, mass, centre) in ROWS {
        let joint = TreeJoint::new(name, JointKind::Revolute { axis }).at(origin).turned(Attitude::about_y(pitch));
        let about_centre = [[moments[0], 0.0, 0.0], [0.0, moments[1], 0.0], [0.0, 0.0, moments[2]]];
        let inertia = BodyInertia::as_given(mass, centre, about_centre).unwrap();
        parent = builder.attach(parent, joint, format!("link of {name}"), inertia).unwrap();
    }
    builder.build().unwrap()
}

/// A tree of equal rods: of each its parent, counted from 1 with the ground as 0, and its joint. `x`, `y`, `z` turn about an axis,
/// `s` slides along y, `f` is free.
fn robot(joints: &[(usize, char)]) -> RigidTree {
    let mut builder = RigidTree::builder();
    let mut bodies = vec![BodyIndex::GROUND];
    for (i, &(parent, letter)) in joints.iter().enumerate() {
        let kind = match letter {
            'x' => JointKind::Revolute { axis: [1.0, 0.0, 0.0] },
            'y' => JointKind::Revolute { axis: [0.0, 1.0, 0.0] },
            'z' => JointKind::Revolute { axis: [0.0, 0.0, 1.0] },
            's' => JointKind::Prismatic { axis: [0.0, 1.0, 0.0] },
            _ => JointKind::Free,
        };
        let joint = TreeJoint::new(format!("joint {i}"), kind);
        let joint = if parent == 0 { joint } else { joint.at([0.1, 0.05, -0.3]) };
        bodies.push(builder.attach(bodies[parent], joint, format!("rod {i}"), rod()).unwrap());
    }
    builder.build().unwrap()
}

/// A limb: joints in series.
fn limb(joints: &mut Vec<(usize, char)>, parent: usize, letters: &str) -> usize {
    letters.chars().fold(parent, |parent, letter| {
        joints.push((parent, letter));
        joints.len()
    })
}

/// An arm of seven joints with a gripper of two fingers that slide: 9 freedoms.
pub(crate) fn gripper_arm() -> RigidTree {
    let mut joints = Vec::new();
    let hand = limb(&mut joints, 0, "zyzyzyz");
    limb(&mut joints, hand, "s");
    limb(&mut joints, hand, "s");
    robot(&joints)
}

/// A free trunk with four legs of three joints: 18 freedoms.
pub(crate) fn quadruped() -> RigidTree {
    let mut joints = Vec::new();
    let trunk = limb(&mut joints, 0, "f");
    for _ in 0..4 {
        limb(&mut joints, trunk, "xyy");
    }
    robot(&joints)
}

/// A free pelvis with two legs of six joints, a torso of two, a head of two, two arms of seven, on each a hand of three fingers with
/// seven joints: 50 freedoms.
pub(crate) fn humanoid() -> RigidTree {
    let mut joints = Vec::new();
    let pelvis = limb(&mut joints, 0, "f");
    for _ in 0..2 {
        limb(&mut joints, pelvis, "zxyyyx");
    }
    let torso = limb(&mut joints, pelvis, "zy");
    limb(&mut joints, torso, "zy");
    for _ in 0..2 {
        let hand = limb(&mut joints, torso, "yxzyzyx");
        limb(&mut joints, hand, "yy");
        limb(&mut joints, hand, "yy");
        limb(&mut joints, hand, "zyy");
    }
    robot(&joints)
}

/// A state of a tree: configuration, velocities, accelerations (or forces).
pub(crate) struct State {
    pub(crate) q: Vec<f64>,
    pub(crate) v: Vec<f64>,
    pub(crate) a: Vec<f64>,
}

/// Numbers that are spread over [0, 1), the same for the same seed.
pub(crate) fn uniform(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
    move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// A random state of a tree.
pub(crate) fn state_of(tree: &RigidTree, seed: u64) -> State {
    let mut next = uniform(seed);
    let mut q = vec![0.0; tree.coordinates()];
    tree.random_configuration(&mut next, &mut q).unwrap();
    let mut vector = || (0..tree.freedoms()).map(|_| 2.0 * next() - 1.0).collect();
    State { q, v: vector(), a: vector() }
}

/// A body without symmetry.
pub(crate) fn odd_body(seed: u64) -> BodyInertia {
    let mut next = uniform(seed);
    let moments = [0.1 + 0.1 * next(), 0.15 + 0.1 * next(), 0.2 + 0.04 * next()];
    let axis = nalgebra::Vector3::new(next(), next(), 1.0);
    let attitude = Attitude::from_axis_angle(&axis, 3.0 * next()).unwrap();
    let inertia = Inertia::principal(moments).unwrap().rotated(attitude);
    BodyInertia::of(&RigidBody::new(0.5 + next(), inertia).unwrap(), [next() - 0.5, next() - 0.5, next() - 0.5])
}

/// A unit vector.
fn direction(next: &mut impl FnMut() -> f64) -> [f64; 3] {
    let a = [next() - 0.5, next() - 0.5, next() + 0.1];
    let length = (a[0] * a[0] + a[1] * a[1] + a[2] * a[2]).sqrt();
    a.map(|x| x / length)
}

/// A free body with arms of several joints, some with motors: all kinds of joints at places turned anyhow.
pub(crate) fn tree_of(kinds: &[JointKind], parents: &[usize], seed: u64) -> RigidTree {
    let mut next = uniform(seed);
    let mut builder = RigidTree::builder();
    let mut bodies = vec![BodyIndex::GROUND];
    for (i, (&kind, &parent)) in kinds.iter().zip(parents).enumerate() {
        let attitude = Attitude::from_axis_angle(&nalgebra::Vector3::from(direction(&mut next)), 3.0 * next()).unwrap();
        let joint = TreeJoint::new(format!("joint {i}"), kind)
            .at([next() - 0.5, next() - 0.5, next() - 0.5])
            .turned(attitude)
            .with_armature(if i % 3 == 1 && kind != JointKind::Free { 0.1 } else { 0.0 });
        let body = odd_body(seed + 17 * i as u64 + 1);
        bodies.push(builder.attach(bodies[parent], joint, format!("body {i}"), body).unwrap());
    }
    builder.build().unwrap()
}

/// A free trunk with two legs and a tail.
pub(crate) fn branched() -> RigidTree {
    let x = JointKind::Revolute { axis: [1.0, 0.0, 0.0] };
    let y = JointKind::Revolute { axis: [0.0, 1.0, 0.0] };
    tree_of(&[JointKind::Free, x, y, x, y, y, x], &[0, 1, 2, 1, 4, 5, 1], 11)
}

/// A free body with many branches, whose bodies are attached to one branch and another in turn.
pub(crate) fn bush(bodies: usize) -> RigidTree {
    let mut next = uniform(41);
    let kinds: Vec<JointKind> = (0..bodies)
        .map(|i| match i % 7 {
            _ if i == 0 => JointKind::Free,
            1 => JointKind::Spherical,
            2 => JointKind::Prismatic { axis: direction(&mut next) },
            3 => JointKind::Revolute { axis: direction(&mut next) },
            _ => JointKind::Revolute { axis: [0.0, 1.0, 0.0] },
        })
        .collect();
    let parents: Vec<usize> = (0..bodies).map(|i| if i < 4 { i } else { i - 3 }).collect();
    tree_of(&kinds, &parents, 47)
}

/// All kinds of joints in one tree.
pub(crate) fn mixed() -> RigidTree {
    let mut next = uniform(5);
    let [a, b, c, d, e] = [(); 5].map(|()| direction(&mut next));
    let kinds = [
        JointKind::Planar,
        JointKind::Spherical,
        JointKind::Revolute { axis: a },
        JointKind::Prismatic { axis: b },
        JointKind::Helical { axis: c, pitch: 0.3 },
        JointKind::Universal { first: [1.0, 0.0, 0.0], second: d },
        JointKind::Cylindrical { axis: e },
        JointKind::Free,
        JointKind::Fixed,
        JointKind::Revolute { axis: [0.0, 0.0, -1.0] },
        JointKind::Spherical,
    ];
    tree_of(&kinds, &[0, 1, 2, 1, 4, 3, 5, 7, 8, 9, 9], 23)
}
