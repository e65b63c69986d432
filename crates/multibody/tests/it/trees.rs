//! Trees that tests, examples and benches share.

use piola_kinematics::{Attitude, Inertia, RigidBody};
use piola_multibody::{BodyIndex, BodyInertia, JointKind, RigidTree, TreeJoint};

/// A uniform rod of 1 m and 1 kg that hangs from its joint along −z, a little thick.
pub fn rod() -> BodyInertia {
    let inertia = Inertia::principal([0.084, 0.084, 0.0013]).unwrap();
    BodyInertia::of(&RigidBody::new(1.0, inertia).unwrap(), [0.0, 0.0, -0.5])
}

/// A chain of rods, whose axes are y and x in turn.
pub fn chain(links: usize) -> RigidTree {
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

/// The arm UR5, as in the file `ur5.urdf` of the reference data.
pub fn ur5() -> RigidTree {
    const ROWS: [(&str, [f64; 3], [f64; 3], f64, [f64; 3], f64, [f64; 3]); 6] = [
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
