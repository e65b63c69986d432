//! Scenes of robots beside closed forms, and their mistakes.

use core::ops::ControlFlow;
use std::path::PathBuf;

use piola_scene::run::Outcome;
use piola_scene::studies::robot::RobotMotion;
use piola_scene::studies::{self, Findings, StudyPlan, StudyRun};
use piola_scene::{SceneError, SceneFile, Study};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};

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
    assert!(9.0 < last.q[0] && 0.1 < last.work);
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

#[test]
fn free_root_falls_as_a_stone() {
    let settings = ["robot.base=free", "robot.velocity=[1, 0, 2] m/s", "time.end=1", "integrator.tolerance=1e-12"];
    let study = load("two-link-arm.toml", &[&settings[..], &["drive.elbow.angle=0"]].concat());
    let run = run(&study);
    let last = motion(&run).samples.last().unwrap();
    let tol = Tol::stated(1e-9, "steps of a tolerance of 1e-12");
    assert_close("position", &last.q[4..7], &[1.0, 0.0, 2.0 - 0.5 * 9.81], tol);
}

#[test]
fn viewers_find_bodies_and_their_motion() {
    let study = load("two-link-arm.toml", &["output.samples=11"]);
    let run = run(&study);
    let folder = std::env::temp_dir().join(format!("piola-gltf-{}", std::process::id()));
    let written = run.write(&piola_charts::Folder::prepare(&folder).unwrap(), &study, &StudyPlan::of(&study));
    assert!(written.failures.is_empty());
    let text = std::fs::read_to_string(folder.join("motion.gltf")).unwrap();
    std::fs::remove_dir_all(&folder).unwrap();
    let file: serde_json::Value = serde_json::from_str(&text).unwrap();
    let names: Vec<&str> = file["nodes"].as_array().unwrap().iter().filter_map(|node| node["name"].as_str()).collect();
    assert_eq!(names, ["Two-link arm", "wall", "upper", "lower"]);
    let channels = file["animations"][0]["channels"].as_array().unwrap();
    assert_eq!(channels.len(), 6);
    // Rods are cylinders, the wall a box: there are no balls.
    assert_eq!(file["meshes"].as_array().unwrap().len(), 2);
    let input = &file["animations"][0]["samplers"][0]["input"];
    let times = &file["accessors"][usize::try_from(input.as_u64().unwrap()).unwrap()];
    assert_eq!((times["count"].as_u64(), times["max"][0].as_f64()), (Some(11), Some(5.0)));
}

#[test]
fn mistakes_of_robots_are_named_with_their_place_and_what_is_valid() {
    let cases: [(&str, &[&str], &[&str]); 9] = [
        ("two-link-arm.toml", &["robot.file=data/none.urdf"], &["none.urdf", "a URDF file"]),
        ("two-link-arm.toml", &["robot.file=data/double-pendulum.csv"], &["line 1"]),
        ("two-link-arm.toml", &["drive.elbow.displacement=1"], &["`displacement` of the joint `elbow`", "angle, rate"]),
        ("six-joint-arm.toml", &["drive.elbow.angle=4"], &["starts at 4, outside its limits", "from -3.14"]),
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
