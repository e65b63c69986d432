//! URDF files: the arm UR5 against the reference, and what is refused, with its line.

use std::path::Path;

use piola_multibody::{FileFault, FileInertias, MultibodyError, Urdf, UrdfBase, UrdfOptions, VisualShape};
use piola_testkit::{Tol, assert_close, golden};

const ROUNDING: Tol = Tol::stated(1e-12, "the reference was computed in double precision");
const AS_GIVEN: UrdfOptions = UrdfOptions { base: UrdfBase::Fixed, inertias: FileInertias::AsGiven };

fn path() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../testdata/golden/ur5.urdf")
}

#[test]
fn robot_from_its_file_has_the_values_of_the_reference() {
    let robot = Urdf::read(&path(), AS_GIVEN).unwrap();
    let tree = &robot.tree;
    assert_eq!((robot.name.as_str(), tree.freedoms(), robot.mimics.len()), ("ur5", 6, 0));
    let mut work = tree.workspace();
    let data = golden::load("robots");
    let case = &data.cases[0];
    let moving: Vec<_> = tree.joints().iter().filter(|place| place.joint.kind.freedoms() != 0).collect();
    for (place, expected) in moving.iter().zip(case["joints"].as_array().unwrap()) {
        assert_eq!(place.joint.name, golden::text(&expected["name"]));
    }
    for state in case["states"].as_array().unwrap() {
        let [q, v, a, tau] = ["q", "v", "a", "tau"].map(|key| golden::vector(&state[key]));
        let mut out = vec![0.0; 6];
        tree.inverse_dynamics(&mut work, &q, &v, &a, &mut out).unwrap();
        assert_close("inverse dynamics", &out, &golden::vector(&state["rnea_torque"]), ROUNDING);
        tree.forward_dynamics(&mut work, &q, &v, &tau, &mut out).unwrap();
        assert_close("forward dynamics", &out, &golden::vector(&state["aba_acceleration"]), ROUNDING);
        let centre = tree.mass_centre(&mut work, &q, &v).unwrap();
        assert_close("centre of mass", &centre.position, &golden::vector(&state["com"]), ROUNDING);
        assert_close("its velocity", &centre.velocity, &golden::vector(&state["com_velocity"]), ROUNDING);
        assert_close("mass", &[centre.mass], &[golden::number(&state["total_mass"])], ROUNDING);
        let energies = tree.tree_energies(&mut work, &q, &v).unwrap();
        let expected = [golden::number(&state["kinetic_energy"]), golden::number(&state["potential_energy"])];
        assert_close("energies", &[energies.kinetic, energies.potential], &expected, ROUNDING);
        let h = tree.centroidal_momentum(&mut work, &q, &v).unwrap();
        let expected = golden::vector(&state["centroidal_momentum"]);
        assert_close("momentum", &[h.linear, h.angular].concat(), &expected, ROUNDING);
        tree.forward_kinematics(&mut work, &q).unwrap();
        for (place, expected) in moving.iter().zip(state["joint_placements"].as_array().unwrap()) {
            let found = tree.place_of(&work, place.child).unwrap();
            assert_close("origin", &found.origin, &golden::vector(&expected["translation"]), ROUNDING);
            let rotation = golden::matrix(&expected["rotation"]).concat();
            assert_close("rotation", found.rotation.as_flattened(), &rotation, ROUNDING);
        }
    }
}

/// A robot of two links with some text in the place of the joint or of the inertia.
fn robot(joint: &str, inertial: &str) -> String {
    format!(
        "<robot name=\"r\">\n<link name=\"base\"/>\n<link name=\"arm\">\n<inertial>\n{inertial}\n</inertial>\n</link>\n{joint}\n</robot>"
    )
}

const JOINT: &str =
    "<joint name=\"j\" type=\"revolute\"><parent link=\"base\"/><child link=\"arm\"/><axis xyz=\"0 0 1\"/></joint>";
const INERTIAL: &str = "<mass value=\"1\"/><inertia ixx=\"1\" iyy=\"1\" izz=\"1\"/>";

fn fault(text: &str) -> (usize, FileFault) {
    match Urdf::parse(text, UrdfOptions::default()) {
        Err(MultibodyError::InFile { line, fault }) => (line, fault),
        other => panic!("not a fault at a line: {other:?}"),
    }
}

#[test]
fn files_are_refused_with_the_line_and_the_reason() {
    assert!(Urdf::parse(&robot(JOINT, INERTIAL), UrdfOptions::default()).is_ok());
    let planar = JOINT.replace("revolute", "planar");
    let unsupported = |element: &str| FileFault::Unsupported { element: element.to_owned() };
    assert_eq!(fault(&robot(&planar, INERTIAL)), (8, unsupported("joint of type planar")));
    assert_eq!(fault(&robot(&format!("{JOINT}\n<sensor/>"), INERTIAL)), (9, unsupported("sensor")));
    let (line, found) = fault(&robot(JOINT, "<mass value=\"1\"/><inertia ixx=\"1\" iyy=\"1\" izz=\"3\"/>"));
    assert!(line == 4 && matches!(found, FileFault::Invalid { .. }), "{line} {found}");
    let (line, found) = fault(&robot(JOINT, "<mass value=\"0\"/><inertia ixx=\"0\" iyy=\"0\" izz=\"0\"/>"));
    assert!(line == 4 && matches!(found, FileFault::Invalid { .. }), "{line} {found}");
    let text = INERTIAL.replace("value=\"1\"", "value=\"one\"");
    assert_eq!(fault(&robot(JOINT, &text)), (5, FileFault::NotNumbers { attribute: "value", text: "one".to_owned() }));
    let stray = JOINT.replace("link=\"arm\"", "link=\"leg\"");
    let source = Box::new(MultibodyError::NoSuchName { what: "link", name: "leg".to_owned() });
    assert_eq!(fault(&robot(&stray, INERTIAL)), (8, FileFault::Invalid { source }));
    let second = JOINT.replace("name=\"j\"", "name=\"k\"");
    let twice = fault(&robot(&format!("{JOINT}\n{second}"), INERTIAL));
    assert_eq!(twice, (9, FileFault::TwoParents { link: "arm".to_owned() }));
    let back = second
        .replace("link=\"arm\"", "link=\"x\"")
        .replace("link=\"base\"", "link=\"arm\"")
        .replace("\"x\"", "\"base\"");
    assert_eq!(fault(&robot(&format!("{JOINT}\n{back}"), INERTIAL)).1, FileFault::NoRoot);
    let roots = fault(&robot("", INERTIAL));
    assert_eq!(roots, (3, FileFault::TwoRoots { first: "base".to_owned(), second: "arm".to_owned() }));
    assert!(matches!(fault("<robot>\n<link>").1, FileFault::Syntax { .. }));
    let nameless = fault("<robot>\n<link/></robot>");
    assert_eq!(nameless, (2, FileFault::Missing { what: "name", element: "link".to_owned() }));
}

/// Pictures are no mechanics: a shape that is not known leaves the tree as it is. One that is known must have lengths.
#[test]
fn visuals_without_a_known_shape_are_left_out_and_negative_lengths_refused() {
    let drawn = |visual: &str| format!("<robot name=\"r\">\n<link name=\"post\">\n{visual}\n</link></robot>");
    let shape = |shape: &str| drawn(&format!("<visual><geometry>{shape}</geometry></visual>"));
    let ball = "<visual><geometry><sphere radius=\"0.5\"/></geometry></visual>";
    for left_out in [
        "<visual/>",
        "<visual><geometry/></visual>",
        "<visual><geometry><capsule radius=\"1\" length=\"2\"/></geometry></visual>",
        "<visual><origin xyz=\"here\"/></visual>",
    ] {
        let found = Urdf::parse(&drawn(&format!("{left_out}{ball}")), UrdfOptions::default()).unwrap();
        assert_eq!((found.tree.bodies(), found.visuals.len()), (1, 1), "{left_out}");
        assert_eq!(found.visuals[0].shape, VisualShape::Sphere { radius: 0.5 });
    }
    let negative = |attribute, value| (3, FileFault::Negative { attribute, value });
    assert_eq!(fault(&shape("<sphere radius=\"-1\"/>")), negative("radius", -1.0));
    assert_eq!(fault(&shape("<cylinder radius=\"1\" length=\"-2\"/>")), negative("length", -2.0));
    assert_eq!(fault(&shape("<box size=\"1 -3 1\"/>")), negative("size", -3.0));
    assert!(matches!(fault(&shape("<sphere radius=\"wide\"/>")).1, FileFault::NotNumbers { .. }));
}

#[test]
fn what_is_no_file_and_files_that_are_too_long_are_refused() {
    let folder = std::env::temp_dir();
    for path in [folder.as_path(), Path::new("/dev/zero"), Path::new("none.urdf")] {
        let error = Urdf::read(path, AS_GIVEN).unwrap_err();
        assert!(matches!(error, MultibodyError::UnreadableFile { .. }), "{error}");
    }
    let path = folder.join(format!("piola-long-{}.urdf", std::process::id()));
    let text = "<robot name=\"r\"><link name=\"post\"/></robot>";
    let longest = format!("{text}{}", " ".repeat((16 << 20) - text.len()));
    std::fs::write(&path, &longest).unwrap();
    let found = Urdf::read(&path, AS_GIVEN);
    std::fs::write(&path, longest + " ").unwrap();
    let longer = Urdf::read(&path, AS_GIVEN);
    std::fs::remove_file(&path).unwrap();
    assert!(found.is_ok());
    let expected = MultibodyError::FileTooLong { path: path.display().to_string(), limit: 16_777_216 };
    assert_eq!(longer.unwrap_err(), expected);
}

#[test]
fn circles_beside_the_root_are_refused() {
    let joint = |name: &str, parent: &str, child: &str| {
        format!("<joint name=\"{name}\" type=\"fixed\"><parent link=\"{parent}\"/><child link=\"{child}\"/></joint>")
    };
    let text = format!(
        "<robot><link name=\"a\"/><link name=\"b\"/><link name=\"c\"/>{}{}</robot>",
        joint("x", "b", "c"),
        joint("y", "c", "b")
    );
    assert_eq!(fault(&text).1, FileFault::Cycle { links: 2 });
}

#[test]
fn mimic_joints_are_named_and_free_bases_move() {
    let text = robot(&JOINT.replace("</joint>", "<mimic joint=\"k\" multiplier=\"2\"/></joint>"), INERTIAL);
    let found = Urdf::parse(&text, UrdfOptions { base: UrdfBase::Free, ..AS_GIVEN }).unwrap();
    assert_eq!(found.tree.freedoms(), 7);
    let mimic = &found.mimics[0];
    assert_eq!((mimic.joint.as_str(), mimic.follows.as_str(), mimic.multiplier, mimic.offset), ("j", "k", 2.0, 0.0));
    let error = found.with_mimics().unwrap_err();
    assert!(matches!(error, MultibodyError::NoSuchName { what: "joint", name } if name == "k"));
    let hand = robot(
        &format!(
            "{JOINT}<link name=\"finger\"><inertial>{INERTIAL}</inertial></link>{}",
            JOINT
                .replace("name=\"j\"", "name=\"k\"")
                .replace("link=\"arm\"", "link=\"finger\"")
                .replace("</joint>", "<mimic joint=\"j\" multiplier=\"-3\"/></joint>")
        ),
        INERTIAL,
    );
    let closed = Urdf::parse(&hand, UrdfOptions::default()).unwrap().with_mimics().unwrap();
    let mut out = [0.0; 2];
    closed.accelerations(&mut closed.workspace(), &[0.0; 2], &[0.0; 2], &[1.0, 0.0], 0.0, &mut out).unwrap();
    // 1/(1 + 9)
    assert_close("mimic", &out, &[0.1, -0.3], Tol::ulps(8.0));
    let missing = Urdf::read(Path::new("nowhere.urdf"), AS_GIVEN).unwrap_err();
    assert!(matches!(missing, MultibodyError::UnreadableFile { path, .. } if path == "nowhere.urdf"));
}
