//! Scenes of robots beside closed forms, and their mistakes.

use core::ops::ControlFlow;
use std::path::{Path, PathBuf};

use piola_scene::run::Outcome;
use piola_scene::studies::robot::RobotMotion;
use piola_scene::studies::{self, Findings, StudyPlan, StudyRun, Subject};
use piola_scene::{SceneError, SceneFile, Study};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use serde_json::Value;

fn scene(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../scenes").join(name)
}

fn load(name: &str, settings: &[&str]) -> Study {
    let settings: Vec<String> = settings.iter().map(ToString::to_string).collect();
    match SceneFile::load(&scene(name), &settings) {
        Ok(SceneFile::Study(study)) => study,
        Ok(_) => panic!("a study"),
        Err(error) => panic!("{error}"),
    }
}

fn run(study: &Study) -> StudyRun {
    let run = studies::run(study, |_| ControlFlow::Continue(()));
    assert_eq!(run.outcome, Outcome::Completed);
    run
}

fn motion(run: &StudyRun) -> &RobotMotion {
    match &run.findings {
        Findings::Robot(found) => found,
        other => panic!("{other:?}"),
    }
}

fn mistake(name: &str, settings: &[&str]) -> String {
    let settings: Vec<String> = settings.iter().map(ToString::to_string).collect();
    match SceneFile::load(&scene(name), &settings) {
        Err(SceneError::Invalid(report)) => report.to_string(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn falling_arm_keeps_its_energy_and_names_its_joints() {
    let study = load("two-link-arm.toml", &[]);
    let run = run(&study);
    let found = motion(&run);
    assert_eq!(found.samples.len(), 1001);
    let tol = Tol::stated(1e-8, "five seconds of steps with a tolerance of 1e-11");
    assert_close_at_scale("energy", &[found.energy_error], &[0.0], 1.0, tol);
    assert!(0.1 < found.samples[100].energies[0]);
    let folder = std::env::temp_dir().join(format!("piola-robot-{}", std::process::id()));
    let plan = StudyPlan::of(&study);
    let written = run.write(&piola_charts::Folder::prepare(&folder).unwrap(), &study, &plan);
    assert!(written.failures.is_empty());
    for file in ["summary.json", "coordinates.csv", "energies.csv", "coordinates.svg", "energies.svg", "motion.gltf"] {
        assert!(folder.join(file).is_file(), "{file}");
        assert!(plan.files.iter().any(|planned| planned == file), "{file}");
    }
    let table = std::fs::read_to_string(folder.join("coordinates.csv")).unwrap();
    assert!(
        table.starts_with("time_s,shoulder,elbow,rate of shoulder,rate of elbow\n0.0,0.0,1.57"),
        "{}",
        &table[..80]
    );
    std::fs::remove_dir_all(&folder).unwrap();
}

/// The first angle of a rod with a spring alone: harmonic, of the frequency √(k/I).
#[test]
fn locked_arm_on_a_spring_swings_with_the_frequency_of_its_inertia() {
    let settings = [
        "robot.gravity=[0, 0, 0]",
        "drive.elbow.angle=0",
        "drive.elbow.locked=true",
        "drive.shoulder.angle=0.3",
        "drive.shoulder.stiffness=7.0",
    ];
    let study = load("two-link-arm.toml", &settings);
    let run = run(&study);
    let upper = 2.0 * (3.0 * 0.04 * 0.04 + 1.0) / 12.0 + 2.0 * 0.25;
    let lower = (3.0 * 0.03 * 0.03 + 0.64) / 12.0 + 1.4 * 1.4;
    let frequency = (7.0_f64 / (upper + lower)).sqrt();
    let tol = Tol::stated(1e-8, "five seconds of steps with a tolerance of 1e-11");
    for sample in motion(&run).samples.iter().step_by(100) {
        let expected = [0.3 * (frequency * sample.t).cos(), 0.0];
        assert_close_at_scale("angles", &sample.q, &expected, 0.3, tol);
    }
}

/// A constant torque on a damped joint: its rate tends to torque over damping.
#[test]
fn damped_joint_under_a_torque_reaches_its_rate_and_the_work_is_balanced() {
    let settings = [
        "robot.gravity=[0, 0, 0]",
        "drive.elbow.angle=0",
        "drive.elbow.locked=true",
        "drive.shoulder.torque=6.0",
        "drive.shoulder.damping=12.0",
        "time.end=20",
    ];
    let run = run(&load("two-link-arm.toml", &settings));
    let found = motion(&run);
    let last = found.samples.last().unwrap();
    assert_close("rate", &last.v[..1], &[0.5], Tol::stated(1e-9, "e^(−20 s · 12/2.7 s) is nothing"));
    assert!(9.0 < last.q[0] && 0.1 < last.works.iter().sum::<f64>());
    assert_close_at_scale("balance", &[found.energy_error], &[0.0], 1.0, Tol::stated(1e-9, "steps of 1e-11"));
}

#[test]
fn four_bar_starts_closed_and_stays_closed() {
    let run = run(&load("four-bar.toml", &[]));
    let found = motion(&run);
    let tol = Tol::stated(1e-7, "interpolation within steps of a tolerance of 1e-9");
    for sample in found.samples.iter().step_by(50) {
        let [crank, pin, rocker] = sample.q[..] else { panic!("{sample:?}") };
        let coupler = crank + pin;
        let gap = [
            0.1 * crank.cos() + 0.35 * coupler.cos() - 0.3 * rocker.cos() - 0.4,
            0.1 * crank.sin() + 0.35 * coupler.sin() - 0.3 * rocker.sin(),
        ];
        assert_close_at_scale("closure", &gap, &[0.0; 2], 1.0, tol);
    }
    assert!(6.0 < found.samples.last().unwrap().q[0]); // the crank turns round
    assert_close_at_scale("balance", &[found.energy_error], &[0.0], 1.0, Tol::stated(1e-6, "steps of 1e-9"));
    assert!(found.singular_positions.is_empty());
}

/// An MJCF file: its ball joint, its spring at rest where the elbow starts, its gear and its placement.
#[test]
fn arm_of_an_mjcf_file_starts_where_the_file_places_it_and_keeps_its_gear() {
    let study = load("swing-arm.toml", &["output.samples=40", "time.end=1"]);
    let plan = StudyPlan::of(&study).to_string();
    for words in ["5 freedoms from swing-arm.xml", "1 condition, by multipliers", "are about a coordinate axis"] {
        assert!(plan.contains(words), "{words} in {plan}");
    }
    let run = run(&study);
    let found = motion(&run);
    let bent = 20.0_f64.to_radians();
    assert_close("start", &found.samples[0].q, &[1.0, 0.0, 0.0, 0.0, bent, 0.0], Tol::ulps(64.0));
    let tol = Tol::stated(1e-7, "interpolation within steps of a tolerance of 1e-9");
    for sample in &found.samples {
        let gear = sample.q[5] + 0.5 * (sample.q[4] - bent);
        assert_close_at_scale("gear", &[gear], &[0.0], 1.0, tol);
    }
    let last = found.samples.last().unwrap();
    assert!((last.q[4] - bent).abs() > 0.01 && last.works[1] < -1e-4);
    assert_close_at_scale("balance", &[found.energy_error], &[0.0], 1.0, Tol::stated(1e-6, "steps of 1e-9"));
    assert!(
        mistake("swing-arm.toml", &["robot.base=free"]).contains("a free base besides the free joints of the file")
    );
}

/// Gravity, springs and motors of an MJCF file, and each of them that the scene replaces.
#[test]
fn mjcf_files_have_their_gravity_and_each_key_of_a_spring_replaces_its_own() {
    let folder = folder("given");
    let model = "<mujoco><compiler angle='radian'/><option GRAVITY/><worldbody><body><joint name='hinge' stiffness='3' \
        springref='0.5' damping='0.2'/><geom size='0.1' pos='1 0 0'/></body></worldbody><actuator><motor joint='hinge'/>\
        </actuator></mujoco>";
    let study = |gravity: &str, rest: &str| {
        std::fs::write(folder.join("m.xml"), model.replace("GRAVITY", gravity)).unwrap();
        let scene = format!("[robot]\nfile = \"m.xml\"\n{rest}\n[time]\nend = \"1 s\"\n");
        std::fs::write(folder.join("m.toml"), scene).unwrap();
        match SceneFile::load(&folder.join("m.toml"), &[]) {
            Ok(SceneFile::Study(study)) => study,
            other => panic!("{other:?}"),
        }
    };
    let robot = |study: &Study| match &study.subject {
        Subject::Robot(robot) => (robot.closed.tree().gravity(), robot.closed.tree().joints()[0].joint.clone()),
        other => panic!("{other:?}"),
    };
    let (gravity, joint) = robot(&study("gravity='0 0 0'", ""));
    let exact = Tol::ulps(0.0);
    assert_close("gravity of the file", &gravity, &[0.0; 3], exact);
    assert_eq!((joint.stiffness, joint.rest, joint.damping), (3.0, 0.5, 0.2));
    assert_close("gravity of MuJoCo", &robot(&study("", "")).0, &[0.0, 0.0, -9.81], exact);
    let replaced = robot(&study("gravity='0 0 0'", "gravity = [0, 1, 0]")).0;
    assert_close("gravity of the scene", &replaced, &[0.0, 1.0, 0.0], exact);
    let drive = |key: &str| robot(&study("", &format!("[[drive]]\nname = \"hinge\"\n{key}"))).1;
    let found = ["stiffness = 7", "rest = 0.25", "damping = 0"].map(drive);
    let found = found.map(|joint| (joint.stiffness, joint.rest, joint.damping));
    assert_eq!(found, [(7.0, 0.5, 0.2), (3.0, 0.25, 0.2), (3.0, 0.5, 0.0)]);
    let plan = StudyPlan::of(&study("", "")).to_string();
    assert!(plan.contains("motors of the file") && plan.contains("sets a torque or force: hinge"), "{plan}");
    std::fs::remove_dir_all(&folder).unwrap();
    let Subject::Robot(arm) = load("six-joint-arm.toml", &[]).subject else { panic!("a robot") };
    assert_close("standard gravity", &arm.closed.tree().gravity(), &[0.0, 0.0, -9.80665], exact);
}

/// A rotor of 1 kg m² on a joint with the data of a file.
fn rotor(folder: &Path, dynamics: &str, rest: &str) -> Study {
    let inertial = "<inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1'/></inertial>";
    let robot = format!(
        "<robot name='r'><link name='a'/><link name='b'>{inertial}</link><joint name='bearing' type='continuous'>\
         <parent link='a'/><child link='b'/><axis xyz='0 0 1'/><dynamics {dynamics}/></joint></robot>"
    );
    std::fs::write(folder.join("rotor.urdf"), robot).unwrap();
    let scene =
        format!("[robot]\nfile = \"rotor.urdf\"\n{rest}\n[output]\nsamples = 26\n[integrator]\ntolerance = 1e-11\n");
    std::fs::write(folder.join("rotor.toml"), scene).unwrap();
    match SceneFile::load(&folder.join("rotor.toml"), &[]) {
        Ok(SceneFile::Study(study)) => study,
        other => panic!("{other:?}"),
    }
}

/// v̇ = −f tanh(v/w) has the solution sinh(v/w) = sinh(v₀/w) exp(−f t/w); the work of friction is what the energy loses.
#[test]
fn friction_of_a_file_brings_a_rotor_to_rest_as_its_closed_form() {
    let folder = folder("rotor");
    let start = "slip_rate = 0.1\n[[drive]]\nname = \"bearing\"\nrate = \"1 rad/s\"\n[time]\nend = \"2.5 s\"";
    let study = rotor(&folder, "friction='0.5'", start);
    let plan = StudyPlan::of(&study).to_string();
    assert!(plan.contains("forces of joints: friction, smoothed below 0.1: bearing"), "{plan}");
    let run = run(&study);
    let tol = Tol::stated(1e-8, "interpolation within steps of a tolerance of 1e-11");
    for sample in &motion(&run).samples {
        let rate = 0.1 * ((1.0_f64 / 0.1).sinh() * (-0.5 * sample.t / 0.1).exp()).asinh();
        assert_close_at_scale("rate", &sample.v, &[rate], 1.0, tol);
        assert_close_at_scale("works", &sample.works, &[0.0, 0.0, 0.5 * (rate * rate - 1.0)], 1.0, tol);
    }
    assert_close_at_scale("balance", &[motion(&run).energy_error], &[0.0], 1.0, tol);
    std::fs::remove_dir_all(&folder).unwrap();
}

/// The file's damping is 2 N m s: v = v₀ exp(−2 t). With `joint_forces = "none"` it does not act; a drive's does.
#[test]
fn joint_forces_of_a_file_can_be_turned_off_and_replaced() {
    let folder = folder("bare");
    let none = "joint_forces = \"none\"\n";
    let driven = |more: &str| format!("[[drive]]\nname = \"bearing\"\nrate = 1.0\n{more}\n[time]\nend = \"1 s\"");
    let cases = [
        (driven(""), 2.0, "forces of joints: dampers: bearing"),
        (
            format!("{none}{}", driven("")),
            0.0,
            "springs, dampers and friction of the file: robot.joint_forces = \"none\"",
        ),
        (format!("{none}{}", driven("damping = 3.0")), 3.0, "forces of joints: dampers: bearing"),
    ];
    for (rest, damping, words) in cases {
        let study = rotor(&folder, "damping='2' friction='0'", &rest);
        let plan = StudyPlan::of(&study).to_string();
        assert!(plan.contains(words), "{words} in {plan}");
        let run = run(&study);
        let last = motion(&run).samples.last().unwrap();
        let rate = f64::exp(-damping);
        let tol = Tol::stated(1e-9, "steps of a tolerance of 1e-11");
        assert_close_at_scale("rate", &last.v, &[rate], 1.0, tol);
        assert_close_at_scale("works", &last.works, &[0.0, 0.5 * (rate * rate - 1.0), 0.0], 1.0, tol);
    }
    let study = rotor(&folder, "", &driven(""));
    let plan = StudyPlan::of(&study).to_string();
    assert!(plan.contains("forces of joints: neither the file nor a [[drive]] gives"), "{plan}");
    std::fs::remove_dir_all(&folder).unwrap();
}

/// An arm with a spring, dampers, friction and a torque: all works and energies together are constant.
#[test]
fn energy_is_balanced_by_the_works_of_torques_damping_and_friction() {
    let settings = [
        "drive.shoulder.torque=4.0",
        "drive.shoulder.damping=0.3",
        "drive.shoulder.friction=0.8",
        "drive.elbow.stiffness=6.0",
        "drive.elbow.rest=0.5",
        "drive.elbow.friction=0.4",
        "robot.slip_rate=0.05",
        "time.end=3",
    ];
    let study = load("two-link-arm.toml", &settings);
    let plan = StudyPlan::of(&study).to_string();
    let words = "springs: elbow; dampers: shoulder; friction, smoothed below 0.05: shoulder, elbow";
    assert!(plan.contains(words), "{plan}");
    let run = run(&study);
    let found = motion(&run);
    let tol = Tol::stated(1e-8, "interpolation within steps of a tolerance of 1e-11");
    assert_close_at_scale("balance", &[found.energy_error], &[0.0], 1.0, tol);
    let last = found.samples.last().unwrap();
    assert!(last.works.iter().all(|work| 0.05 < work.abs()) && 0.01 < last.energies[2], "{last:?}");
    assert!(last.works[1] < 0.0 && last.works[2] < 0.0, "{last:?}");
}

#[test]
fn six_joint_arm_is_planned_and_its_locked_joint_stays() {
    let study = load("six-joint-arm.toml", &["output.samples=50"]);
    let plan = StudyPlan::of(&study).to_string();
    for words in ["6 freedoms from six-joint-arm.urdf", "1 condition, by multipliers", "motion.gltf", "tolerance 1e-9"]
    {
        assert!(plan.contains(words), "{words} in {plan}");
    }
    let run = run(&study);
    let found = motion(&run);
    assert_eq!(found.samples.len(), 50);
    let start = 20.0_f64.to_radians();
    for sample in &found.samples {
        assert_close("wrist roll", &sample.q[5..], &[start], Tol::stated(1e-9, "projected steps"));
    }
}

/// The arm on a wall that is free: without a mass of its own the wall could turn about the hinge alone, and is named.
#[test]
fn free_root_falls_as_a_stone() {
    let settings = ["robot.base=free", "robot.velocity=[1, 0, 2] m/s", "time.end=1", "integrator.tolerance=1e-12"];
    let settings = [&settings[..], &["drive.elbow.angle=0"]].concat();
    let light = studies::run(&load("two-link-arm.toml", &settings), |_| ControlFlow::Continue(()));
    let Outcome::Failed(reason) = light.outcome else { panic!("a wall without mass") };
    assert!(reason.contains("a motion of body `wall` by joint `ground to wall` meets no inertia"), "{reason}");
    let folder = folder("stone");
    let inertial = "<inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1'/></inertial>";
    let heavy = format!("<link name=\"wall\">{inertial}</link>");
    let text = |name: &str| std::fs::read_to_string(scene(name)).unwrap();
    let robot = text("data/two-link-arm.urdf").replace("<link name=\"wall\"/>", &heavy);
    std::fs::write(folder.join("arm.urdf"), robot).unwrap();
    let of_stone = text("two-link-arm.toml").replace("data/two-link-arm.urdf", "arm.urdf");
    std::fs::write(folder.join("stone.toml"), of_stone).unwrap();
    let settings: Vec<String> = settings.iter().map(ToString::to_string).collect();
    let Ok(SceneFile::Study(study)) = SceneFile::load(&folder.join("stone.toml"), &settings) else { panic!("a study") };
    let run = run(&study);
    let last = motion(&run).samples.last().unwrap();
    let tol = Tol::stated(1e-9, "steps of a tolerance of 1e-12");
    assert_close("position", &last.q[4..7], &[1.0, 0.0, 2.0 - 0.5 * 9.81], tol);
}

fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("piola-{name}-{}", std::process::id()));
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// The animation that a study writes.
fn animation(study: &Study, folder: &Path) -> Value {
    let written = run(study).write(&piola_charts::Folder::prepare(folder).unwrap(), study, &StudyPlan::of(study));
    assert!(written.failures.is_empty());
    let text = std::fs::read_to_string(folder.join("motion.gltf")).unwrap();
    std::fs::remove_dir_all(folder).unwrap();
    serde_json::from_str(&text).unwrap()
}

#[test]
fn viewers_find_bodies_and_their_motion() {
    let file = animation(&load("two-link-arm.toml", &["output.samples=11"]), &folder("gltf"));
    let names: Vec<&str> = file["nodes"].as_array().unwrap().iter().filter_map(|node| node["name"].as_str()).collect();
    assert_eq!(names, ["Two-link arm", "wall", "upper", "lower"]);
    let channels = file["animations"][0]["channels"].as_array().unwrap();
    assert_eq!(channels.len(), 6);
    // Rods are cylinders, the wall a box: there are no balls.
    assert_eq!(file["meshes"].as_array().unwrap().len(), 2);
    let input = &file["animations"][0]["samplers"][0]["input"];
    let times = &file["accessors"][index(input)];
    assert_eq!((times["count"].as_u64(), times["max"][0].as_f64()), (Some(11), Some(5.0)));
}

fn index(value: &Value) -> usize {
    usize::try_from(value.as_u64().unwrap()).unwrap()
}

fn bytes_of(base64: &str) -> Vec<u8> {
    let letters: Vec<char> = ('A'..='Z').chain('a'..='z').chain('0'..='9').chain(['+', '/']).collect();
    let mut bytes = Vec::new();
    for four in base64.as_bytes().chunks(4) {
        let place = |&letter: &u8| letters.iter().position(|&known| known == char::from(letter));
        let known: Vec<usize> = four.iter().filter_map(place).collect();
        let bits = known.iter().fold(0, |bits, &place| bits << 6 | place) << (6 * (4 - known.len()));
        bytes.extend((1..known.len()).map(|k| u8::try_from(bits >> (24 - 8 * k) & 255).unwrap()));
    }
    bytes
}

/// The triangles of boxes, cylinders and balls are counterclockwise from outside, where their normals point.
#[test]
fn surfaces_show_their_outside_to_viewers() {
    let folder = folder("surfaces");
    let body =
        |name: &str, shape: &str| format!("<link name='{name}'><visual><geometry>{shape}</geometry></visual></link>");
    let hinge =
        "<joint name='hinge' type='continuous'><parent link='a'/><child link='b'/><dynamics damping='1'/></joint>";
    let inertial = "<inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1'/></inertial>";
    let shapes = [
        body("a", "<box size='1 2 3'/>"),
        body("b", "<cylinder radius='1' length='2'/>").replace("<visual>", &format!("{inertial}<visual>")),
        body("c", "<sphere radius='1'/>"),
    ];
    let fixed = "<joint name='fixed' type='fixed'><parent link='b'/><child link='c'/></joint>";
    std::fs::write(folder.join("shapes.urdf"), format!("<robot name='r'>{}{hinge}{fixed}</robot>", shapes.concat()))
        .unwrap();
    let scene = "[robot]\nfile = \"shapes.urdf\"\nanimation = true\n[time]\nend = \"1 s\"\n[output]\nsamples = 2\n";
    std::fs::write(folder.join("shapes.toml"), scene).unwrap();
    let Ok(SceneFile::Study(study)) = SceneFile::load(&folder.join("shapes.toml"), &[]) else { panic!("a study") };
    let file = animation(&study, &folder);
    let data = bytes_of(file["buffers"][0]["uri"].as_str().unwrap().split_once("base64,").unwrap().1);
    assert_eq!(data.len(), index(&file["buffers"][0]["byteLength"]));
    let bytes = |accessor: &Value| {
        let view = &file["bufferViews"][index(&file["accessors"][index(accessor)]["bufferView"])];
        let start = index(&view["byteOffset"]);
        data[start..start + index(&view["byteLength"])].to_vec()
    };
    let vectors = |accessor: &Value| -> Vec<[f32; 3]> {
        let number = |four: &[u8]| f32::from_le_bytes(four.try_into().unwrap());
        bytes(accessor).chunks(12).map(|twelve| [0, 4, 8].map(|k| number(&twelve[k..k + 4]))).collect()
    };
    let mut counts = Vec::new();
    for mesh in file["meshes"].as_array().unwrap() {
        let surface = &mesh["primitives"][0];
        let places = vectors(&surface["attributes"]["POSITION"]);
        let normals = vectors(&surface["attributes"]["NORMAL"]);
        let corners = bytes(&surface["indices"]);
        let corners: Vec<usize> = corners.chunks(2).map(|two| u16::from_le_bytes([two[0], two[1]]).into()).collect();
        let mut count = 0;
        for triangle in corners.chunks(3) {
            let [a, b, c] = [0, 1, 2].map(|k| places[triangle[k]]);
            let [p, q] = [b, c].map(|end| [0, 1, 2].map(|k| end[k] - a[k]));
            let area = [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
            // At the middle of a cap and at the poles of a ball triangles have no area.
            if 1e-6 < area.iter().map(|x| x * x).sum::<f32>().sqrt() {
                count += 1;
                for &corner in triangle {
                    let along: f32 = area.iter().zip(normals[corner]).map(|(x, n)| x * n).sum();
                    assert!(0.0 < along, "{triangle:?} of {mesh}");
                }
            }
        }
        counts.push(count);
    }
    assert_eq!(counts, [12, 4 * 24, 22 * 24]); // box, cylinder, ball
}

/// Two closures, one of whose names begins with the other's: the mistake stands at the one that does not close.
#[test]
fn closure_that_does_not_close_is_named_and_no_other() {
    let folder = folder("closures");
    let second =
        "\n[[closure]]\nname = \"rocker pin 2\"\nfirst = \"coupler\"\nsecond = \"ground\"\nsecond_at = [9, 0, 0]\n";
    let text = std::fs::read_to_string(scene("four-bar.toml")).unwrap();
    std::fs::write(folder.join("four-bar.toml"), format!("{text}{second}")).unwrap();
    std::fs::create_dir(folder.join("data")).unwrap();
    std::fs::copy(scene("data/four-bar.urdf"), folder.join("data/four-bar.urdf")).unwrap();
    let loaded = SceneFile::load(&folder.join("four-bar.toml"), &[]);
    std::fs::remove_dir_all(&folder).unwrap();
    let Err(SceneError::Invalid(report)) = loaded else { panic!("{loaded:?}") };
    let report = report.to_string();
    for word in ["closes `rocker pin 2`", "name = \"rocker pin 2\""] {
        assert!(report.contains(word), "`{word}` in {report}");
    }
}

#[test]
fn plan_tells_how_far_closures_move_the_start() {
    let study = load("four-bar.toml", &[]);
    let Subject::Robot(robot) = &study.subject else { panic!("{:?}", study.subject) };
    let given = [30.0_f64, 20.0, 100.0].map(f64::to_radians);
    let moves = robot.start.0.iter().zip(given).map(|(a, b)| (a - b).abs());
    let most = moves.fold(0.0, f64::max);
    assert!(0.01 < most && most < 0.5, "{most}");
    let plan = StudyPlan::of(&study).to_string();
    assert!(plan.contains(&format!("coordinates move by at most {most:.1e} to satisfy them")), "{plan}");
    assert!(plan.contains("relative and absolute tolerance 1e-9"), "{plan}");
}

#[test]
fn mistakes_of_robots_are_named_with_their_place_and_what_is_valid() {
    let cases: [(&str, &[&str], &[&str]); 11] = [
        ("two-link-arm.toml", &["robot.file=data/none.urdf"], &["none.urdf", "a URDF or MJCF file"]),
        ("two-link-arm.toml", &["robot.file=data/double-pendulum.csv"], &["line 1"]),
        ("two-link-arm.toml", &["drive.elbow.displacement=1"], &["`displacement` of the joint `elbow`", "angle, rate"]),
        ("six-joint-arm.toml", &["drive.elbow.angle=4"], &["starts at 4, outside its limits", "from -3.14"]),
        (
            "six-joint-arm.toml",
            &["drive.wrist roll.rate=1 rad/s"],
            &["`rate` of the locked joint `wrist roll`", "without a rate or speed"],
        ),
        (
            "six-joint-arm.toml",
            &["robot.base=free", "drive.wrist roll.locked=false", "output.samples=1000000"],
            &["1000000 samples of 32 numbers are more than 25000000", "samples = at most 781250"],
        ),
        ("two-link-arm.toml", &["robot.velocity=[1, 0, 0]"], &["a root that is fixed", "free"]),
        ("four-bar.toml", &["closure.rocker pin.second=rokcer"], &["no link is named `rokcer`", "rocker"]),
        (
            "four-bar.toml",
            &["closure.rocker pin.first_at=[3, 0, 0]"],
            &["name = \"rocker pin\"", "near those at which the loops close"],
        ),
        ("two-link-arm.toml", &["integrator.method=verner-98"], &["`method` in a scene of [robot]"]),
        ("two-link-arm.toml", &["reference.closed_form=kepler"], &["[reference] in a scene of [robot]"]),
    ];
    for (name, settings, words) in cases {
        let report = mistake(name, settings);
        for word in words {
            assert!(report.contains(word), "`{word}` in {report}");
        }
    }
}
