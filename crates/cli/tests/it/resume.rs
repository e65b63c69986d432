//! Runs that are killed and continued.

use std::path::Path;
use std::process::Stdio;
use std::time::{Duration, Instant};

use crate::end_to_end::{Folder, err};

/// A double pendulum whose steps are fixed, an orbit whose steps adapt, two pendulums with steps of their own, and a slider-crank with a
/// rod as constraint, which goes through singular positions: each takes about a second and records 2001 instants.
const SCENES: [(&str, &str); 4] = [
    (
        "double-pendulum",
        "[mechanism]\n[[joint]]\nname = 'shoulder'\ntype = 'revolute'\naxis = [0, 1, 0]\nangle = 1.5\n\
         [[joint]]\nname = 'elbow'\nparent = 'shoulder'\ntype = 'revolute'\naxis = [0, 1, 0]\noffset = [0, 0, -1]\nangle = 1.0\n\
         [[particle]]\nname = 'upper'\njoint = 'shoulder'\nmass = 1.0\nat = [0, 0, -1]\n\
         [[particle]]\nname = 'lower'\njoint = 'elbow'\nmass = 1.0\nat = [0, 0, -1]\n\
         [time]\nend = 100\n[integrator]\nstep = 0.01\n[output]\nsamples = 2001\n",
    ),
    (
        "orbit",
        "[central]\ngm = 1.0\n[[body]]\nname = 'comet'\nsemi_major_axis = 1.0\neccentricity = 0.9\n\
         [time]\nrevolutions = 1500\n[integrator]\nmethod = 'verner-98'\n[output]\nsamples = 2001\n",
    ),
    (
        "two-pendulums",
        "[mechanism]\n[[joint]]\nname = 'slow'\ntype = 'revolute'\naxis = [0, 1, 0]\nangle = 1.5\n\
         [[joint]]\nname = 'fast'\ntype = 'revolute'\naxis = [0, 1, 0]\nangle = 1.0\n\
         [[particle]]\nname = 'upper'\njoint = 'slow'\nmass = 1.0\nat = [0, 0, -1]\n\
         [[particle]]\nname = 'lower'\njoint = 'fast'\nmass = 1.0\nat = [0, 0, -0.1]\n\
         [time]\nend = 1000\n[output]\nsamples = 2001\n",
    ),
    (
        "slider-crank",
        "[mechanism]\ngravity = [0, 0, 0]\n[[joint]]\nname = 'crank'\ntype = 'revolute'\naxis = [0, -1, 0]\nangle = 0.5\nrate = 1\n\
         [[joint]]\nname = 'slider'\ntype = 'prismatic'\naxis = [1, 0, 0]\ndisplacement = 1.7551651237807455\nspeed = -0.958851077208406\n\
         [[particle]]\nname = 'pin'\njoint = 'crank'\nmass = 1.0\nat = [1, 0, 0]\n\
         [[particle]]\nname = 'block'\njoint = 'slider'\nmass = 1.0\n\
         [[constraint]]\nname = 'rod'\ntype = 'distance'\nfrom = 'crank'\nfrom_at = [1, 0, 0]\nto = 'slider'\nlength = 1\n\
         [time]\nend = 1000\n[integrator]\nmethod = 'dormand-prince-853'\ntolerance = 1e-10\n[output]\nsamples = 2001\n",
    ),
];

/// The files of a folder that a run has written, without the line of the wall time.
fn files(folder: &Path) -> Vec<(String, String)> {
    let entries = std::fs::read_dir(folder).unwrap_or_else(|error| panic!("{error}"));
    let mut files: Vec<_> = entries
        .map(|entry| {
            let path = entry.unwrap_or_else(|error| panic!("{error}")).path();
            let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{error}"));
            let lines = text.lines().filter(|line| !line.contains("\"wall_time_s\""));
            (path.file_name().unwrap_or_default().to_string_lossy().into_owned(), lines.collect::<Vec<_>>().join("\n"))
        })
        .collect();
    files.sort();
    files
}

/// Runs a scene whole, and again killed as soon as it has a first checkpoint, and then as soon as it has another one.
fn compare_killed(folder: &Folder, scene: &str, name: &str) {
    let whole = folder.piola(&["run", scene, "--out", "whole"]);
    assert_eq!(whole.status.code(), Some(0), "{}", err(&whole));
    let checkpoint = folder.0.join("cut/.piola-checkpoint");
    let cut = ["run", scene, "--out", "cut", "--checkpoint", "0.01", "--resume"];
    for _ in 0..3 {
        let before = std::fs::read(&checkpoint).ok();
        let mut child = folder.command(&cut).stdout(Stdio::null()).stderr(Stdio::null()).spawn();
        let begun = Instant::now();
        while std::fs::read(&checkpoint).ok() == before && begun.elapsed() < Duration::from_secs(60) {
            std::thread::sleep(Duration::from_millis(1));
        }
        let killed = child.as_mut().map(|child| child.kill().and_then(|()| child.wait()));
        assert!(matches!(killed, Ok(Ok(status)) if status.code().is_none()), "{name}: not killed while it ran");
        assert!(!folder.0.join("cut/summary.json").exists());
    }
    let last = folder.piola(&cut);
    assert_eq!(last.status.code(), Some(0), "{}", err(&last));
    assert!(err(&last).contains("the run goes on at "), "{}", err(&last));
    assert!(!checkpoint.exists());
    assert_eq!(files(&folder.0.join("cut")), files(&folder.0.join("whole")), "{name}");
}

#[test]
fn a_run_that_is_killed_several_times_goes_on_and_writes_the_same_bytes() {
    for (name, text) in SCENES {
        let folder = Folder::new(&format!("resume-{name}"));
        let scene = folder.scene(text);
        compare_killed(&folder, scene.to_str().unwrap_or_default(), name);
    }
}

/// A tree without loops, and one with a loop that goes on around.
#[cfg(feature = "robots")]
#[test]
fn a_robot_that_is_killed_several_times_goes_on_and_writes_the_same_bytes() {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    for (name, end) in [("two-link-arm", "end = 200"), ("four-bar", "end = 100")] {
        let folder = Folder::new(&format!("resume-{name}"));
        let text = std::fs::read_to_string(data.join(format!("{name}.toml"))).unwrap_or_else(|error| panic!("{error}"));
        let text = text.replace("file = \"data", &format!("file = \"{}/data", data.display()));
        let text = text.replace("animation = true\n", "").replace("end = \"5 s\"", end);
        let scene = folder.scene(&format!("{text}\n[output]\nsamples = 401\n"));
        compare_killed(&folder, scene.to_str().unwrap_or_default(), name);
    }
}

/// A motion of modes that is recorded often, and a flow of many steps.
#[cfg(feature = "spectral")]
#[test]
fn fields_on_a_box_that_are_killed_several_times_go_on_and_write_the_same_bytes() {
    let scene = "[box]\nsides = '[1, 1] m'\n";
    let motion = "type = 'motion'\nmodes = [24, 24]\nfirst_lame_parameter = '2 Pa'\nshear_modulus = '1 Pa'\n\
        density = '1 kg/m^3'\nduration = '40 s'\ninterval = '0.02 s'\n[[start]]\ntype = 'gaussian'\n\
        displacement = '[0.001, 0] m'\nat = '[0.4, 0.5] m'\nradius = '0.1 m'\n";
    let flow = "type = 'flow'\npoints = [32, 32]\nshear_viscosity = '1 Pa s'\nsecond_viscosity = '0 Pa s'\nduration = '2 s'\n\
        step = '0.002 s'\n[[load]]\ntype = 'gaussian'\nforce_per_volume = '[5, 1] N/m^3'\nat = '[0.4, 0.5] m'\nradius = '0.2 m'\n";
    for (name, kind) in [("box-motion", motion), ("box-flow", flow)] {
        let folder = Folder::new(&format!("resume-{name}"));
        let scene = folder.scene(&format!("{scene}{kind}"));
        compare_killed(&folder, scene.to_str().unwrap_or_default(), name);
    }
}

#[test]
fn a_checkpoint_of_another_scene_or_version_and_one_that_is_torn_are_refused() {
    let folder = Folder::new("resume-refused");
    let scene = folder.scene(SCENES[1].1);
    let scene = scene.to_str().unwrap_or_default();
    let run = ["run", scene, "--out", "out", "--resume", "--checkpoint", "0.01"];
    let mut child = folder.command(&run).stdout(Stdio::null()).stderr(Stdio::null()).spawn();
    let checkpoint = folder.0.join("out/.piola-checkpoint");
    let begun = Instant::now();
    while !checkpoint.exists() && begun.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(1));
    }
    let killed = child.as_mut().map(|child| child.kill().and_then(|()| child.wait()));
    assert!(matches!(killed, Ok(Ok(_))));
    let refused = |more: &[&str], why: &str| {
        let output = folder.piola(&[run.as_slice(), more].concat());
        assert_eq!(output.status.code(), Some(2), "{}", err(&output));
        assert!(err(&output).contains(why), "{}", err(&output));
    };
    refused(&["--set", "body.comet.eccentricity=0.8"], "the checkpoint is of another run");
    let text = std::fs::read_to_string(&checkpoint).unwrap_or_else(|error| panic!("{error}"));
    let version = concat!("\"version\":\"", env!("CARGO_PKG_VERSION"), "\"");
    assert!(text.contains(version));
    let write = |text: &str| std::fs::write(&checkpoint, text).unwrap_or_else(|error| panic!("{error}"));
    write(&text.replacen(version, "\"version\":\"0.0.9\"", 1));
    refused(&[], "the checkpoint is of Piola 0.0.9");
    write(&text[..text.len() / 2]);
    refused(&[], "cannot be read");
    write(&text);
    refused(&["--set", "time.revolutions=1501"], "the checkpoint is of another run");
    refused(&["--set", "integrator.tolerance=1e-11"], "the checkpoint is of another run");
    let negative = folder.piola(&["run", scene, "--checkpoint=-1"]);
    assert_eq!(negative.status.code(), Some(2));
    assert!(err(&negative).contains("a number of seconds from 0 to 1e9 is needed"), "{}", err(&negative));
}

#[test]
fn a_run_without_a_checkpoint_says_so_and_begins_at_its_start() {
    let folder = Folder::new("resume-absent");
    let short = SCENES[1].1.replace("1500", "3");
    let scene = folder.scene(&short);
    let output = folder.piola(&["run", scene.to_str().unwrap_or_default(), "--out", "out", "--resume"]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    assert!(err(&output).contains("there is no checkpoint"), "{}", err(&output));
    let study = folder.scene("[wavefront]\ntype = 'point'\nlength = 1.0\n[[medium]]\ntype = 'uniform'\n");
    let output = folder.piola(&["run", study.to_str().unwrap_or_default(), "--out", "out", "--resume"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(err(&output).contains("this study takes seconds and leaves no checkpoints"), "{}", err(&output));
    let output = folder.piola(&["run", study.to_str().unwrap_or_default(), "--out", "out", "--checkpoint", "5"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(err(&output).contains("run it without --checkpoint"), "{}", err(&output));
}

#[test]
fn a_run_without_resume_removes_the_checkpoint_of_a_run_before() {
    let folder = Folder::new("resume-old");
    // It would take minutes.
    let scene = folder.scene(&SCENES[1].1.replace("1500", "1500000"));
    let checkpoint = folder.0.join("out/.piola-checkpoint");
    std::fs::create_dir_all(folder.0.join("out")).unwrap_or_else(|error| panic!("{error}"));
    std::fs::write(&checkpoint, "of a run before").unwrap_or_else(|error| panic!("{error}"));
    let run = ["run", scene.to_str().unwrap_or_default(), "--out", "out"];
    let mut child = folder.command(&run).stdout(Stdio::null()).stderr(Stdio::null()).spawn();
    let begun = Instant::now();
    let is_old = || std::fs::read_to_string(&checkpoint).is_ok_and(|text| text == "of a run before");
    while is_old() && begun.elapsed() < Duration::from_secs(20) {
        std::thread::sleep(Duration::from_millis(1));
    }
    let killed = child.as_mut().map(|child| child.kill().and_then(|()| child.wait()));
    assert!(matches!(killed, Ok(Ok(status)) if status.code().is_none()), "not killed while it ran");
    assert!(!is_old());
}
