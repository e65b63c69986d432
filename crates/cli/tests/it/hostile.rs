//! Input that is absurd or malicious, full disks, folders that are used twice.

use std::fs::File;
use std::process::Stdio;

use crate::end_to_end::{Folder, ORBIT, err, json, out, read};

/// A double pendulum.
const PENDULUM: &str = "[mechanism]\n[[joint]]\nname = 'hinge'\ntype = 'revolute'\naxis = [0, -1, 0]\nangle = '1 rad'\n\
                        [[particle]]\nname = 'bob'\njoint = 'hinge'\nmass = '1 kg'\nat = '[0, 0, -1] m'\n[time]\nend = '10 s'\n";

/// Two bodies that attract each other.
const PAIR: &str = "[gravity]\n[[body]]\nname = 'one'\ngm = 1.0\nposition = [0.0, 0.0, 0.0]\nvelocity = [0.0, 0.0, 0.0]\n\
                    [[body]]\nname = 'two'\ngm = 1.0\nposition = [1.0, 0.0, 0.0]\nvelocity = [0.0, 1.0, 0.0]\n[time]\nend = 1.0\n";

#[test]
#[cfg(target_os = "linux")]
fn results_that_cannot_be_printed_exit_with_1() {
    let folder = Folder::new("full");
    folder.scene(ORBIT);
    for arguments in
        [&["schema"][..], &["plan", "orbit.toml"], &["check", "orbit.toml"], &["run", "orbit.toml", "--json"]]
    {
        let full = File::options().write(true).open("/dev/full").unwrap();
        let output = folder.command(arguments).stdout(Stdio::from(full)).output().unwrap();
        assert_eq!(output.status.code(), Some(1), "{arguments:?}: {}", err(&output));
        assert!(err(&output).contains("standard output"), "{}", err(&output));
    }
}

#[test]
fn what_a_run_refuses_at_its_start_plan_and_check_refuse_too() {
    let folder = Folder::new("start");
    for (scene, setting, why) in [
        (PENDULUM, "integrator.method='composition-4'", "positions alone"),
        (PENDULUM, "integrator.tolerance=1e-300", "below rounding"),
        (PENDULUM, "integrator.step=1e-18", "step"),
        (PENDULUM, "time.start=1e17", "step"),
        (PAIR, "gravity.post_newtonian=true", ""),
        (PAIR, "body.two.velocity=[0, 1e10, 0]", ""),
    ] {
        folder.scene(scene);
        let valid = why.is_empty();
        for command in ["plan", "check", "run"] {
            let output = folder.piola(&[command, "orbit.toml", "--set", setting]);
            assert_eq!(output.status.code(), Some(if valid { 0 } else { 2 }), "{command} {setting}: {}", err(&output));
            assert!(err(&output).contains(why), "{command} {setting}: {}", err(&output));
        }
    }
    folder.scene(PAIR);
    let fast =
        ["plan", "orbit.toml", "--set", "gravity.post_newtonian=true", "--set", "body.two.velocity=[0, 1e10, 0]"];
    let output = folder.piola(&fast);
    assert_eq!(output.status.code(), Some(2));
    assert!(err(&output).contains("speed of light"), "{}", err(&output));
}

#[test]
fn runs_of_more_than_a_day_need_a_confirmation_and_plans_tell_the_cost() {
    let folder = Folder::new("long");
    folder.scene(ORBIT);
    let plan = json(&out(&folder.piola(&["plan", "orbit.toml", "--json"])));
    let (seconds, evaluations) = (&plan["cost"]["seconds"], &plan["cost"]["force_evaluations"]);
    assert!(seconds.as_f64().is_some_and(|s| 0.0 < s && s < 60.0), "{plan}");
    assert!(evaluations.as_f64().is_some_and(|n| 100.0 < n && n < 1e6), "{plan}");
    let endless = ["run", "orbit.toml", "--set", "time.revolutions=4000000000"];
    let output = folder.piola(&endless);
    assert_eq!(output.status.code(), Some(2), "{}", err(&output));
    assert!(err(&output).contains("--yes") && err(&output).contains("days"), "{}", err(&output));
    assert!(!folder.0.join("out/orbit/summary.json").exists());
}

#[test]
fn numbers_beyond_doubles_are_a_failure_and_not_a_result() {
    let folder = Folder::new("beyond");
    folder.scene(PAIR);
    let output = folder.piola(&["run", "orbit.toml", "--set", "body.two.velocity=[0, 1e300, 0]"]);
    assert_eq!(output.status.code(), Some(1), "{}{}", out(&output), err(&output));
    assert!(err(&output).contains("range of doubles"), "{}", err(&output));
    assert_eq!(json(&read(&folder.0.join("out/orbit/summary.json")))["status"], "failed");
}

#[test]
fn texts_without_units_are_refused() {
    let folder = Folder::new("units");
    folder.scene(&PENDULUM.replace("'1 kg'", "'1e12'"));
    let output = folder.piola(&["check", "orbit.toml"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(err(&output).contains("without a unit") && err(&output).contains("1e12 kg"), "{}", err(&output));
}

#[test]
fn names_and_paths_cannot_command_the_terminal() {
    let folder = Folder::new("escape");
    folder.scene(&ORBIT.replace("closed_form = 'kepler'", "file = \"red\\u001b[31m\\u202e.csv\""));
    for command in ["check", "plan"] {
        let output = folder.piola(&[command, "orbit.toml"]);
        let shown = format!("{}{}", out(&output), err(&output));
        assert!(shown.contains("\\u001b"), "{shown}");
        assert!(!shown.contains(['\u{1b}', '\u{202e}']), "{shown:?}");
    }
}

#[test]
fn files_of_another_scene_do_not_stay_in_the_folder() {
    let folder = Folder::new("stale");
    folder.scene(PENDULUM);
    let into = |scene: &str| {
        folder.scene(scene);
        let output = folder.piola(&["run", "orbit.toml", "--out", "results"]);
        assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    };
    let exists = |name: &str| folder.0.join("results").join(name).exists();
    std::fs::create_dir_all(folder.0.join("results")).unwrap();
    // A file of the user, and one that a killed program left: process numbers end before this one.
    std::fs::write(folder.0.join("results/notes.txt"), "mine").unwrap();
    std::fs::write(folder.0.join("results/.summary.json.4294967295.tmp"), "half").unwrap();
    into(PENDULUM);
    assert!(exists("coordinates.csv") && exists("summary.json") && exists("notes.txt"));
    assert_eq!(exists(".summary.json.4294967295.tmp"), !cfg!(target_os = "linux"));
    into(PAIR);
    assert!(!exists("coordinates.csv") && exists("trajectory.csv") && exists("summary.json") && exists("notes.txt"));
}

#[test]
fn rooms_of_absurd_size_or_speed_are_refused() {
    let folder = Folder::new("room");
    let room = "[room]\ntype = 'ellipse'\nsemi_axes = [5.0, 3.0]\nspeed = 343.0\n";
    folder.scene(room);
    let output = folder.piola(&["check", "orbit.toml"]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    let output = folder.piola(&["run", "orbit.toml", "--set", "room.semi_axes=[1e308, 3]"]);
    assert_eq!(output.status.code(), Some(2), "{}", err(&output));
    assert!(err(&output).contains("1000 times"), "{}", err(&output));
    let output = folder.piola(&["plan", "orbit.toml", "--set", "room.speed_gradient=[68.59999999, 0]"]);
    assert_eq!(output.status.code(), Some(2), "{}", err(&output));
    assert!(err(&output).contains("1e-5 of the largest speed"), "{}", err(&output));
}

#[test]
#[cfg(unix)]
fn a_slow_room_obeys_a_signal() {
    let folder = Folder::new("slow-room");
    // Tens of thousands of characteristics.
    folder.scene("[room]\ntype = 'ellipse'\nsemi_axes = [5.0, 3.0]\nspeed = 343.0\nresolution = 1e-12\n");
    let mut run = folder.command(&["run", "orbit.toml"]).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    std::thread::sleep(std::time::Duration::from_millis(1500));
    if run.try_wait().unwrap().is_none() {
        let sent = std::process::Command::new("kill").args(["-INT", &run.id().to_string()]).status().unwrap();
        assert!(sent.success());
    }
    let begun = std::time::Instant::now();
    while run.try_wait().unwrap().is_none() {
        if 30 < begun.elapsed().as_secs() {
            run.kill().unwrap();
            panic!("the signal was not heard");
        }
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    assert_eq!(run.wait().unwrap().code(), Some(1));
    assert_eq!(json(&read(&folder.0.join("out/orbit/summary.json")))["status"], "interrupted");
}
