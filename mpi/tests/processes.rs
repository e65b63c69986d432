//! Sweeps on the processes of `mpirun`. Where it is not installed the tests say so and pass.

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("piola-mpi-{}-{name}", std::process::id()));
        let _ = std::fs::remove_dir_all(&path);
        std::fs::create_dir_all(&path).unwrap_or_else(|error| panic!("{error}"));
        Self(path)
    }

    /// The program on some processes, or alone.
    fn command(&self, processes: Option<u32>, arguments: &[&str]) -> Command {
        let program = env!("CARGO_BIN_EXE_piola");
        let mut command = match processes {
            None => Command::new(program),
            Some(count) => {
                let mut command = Command::new("mpirun");
                command.args(["--oversubscribe", "--bind-to", "none", "-n", &count.to_string(), program]);
                command.env("OMPI_ALLOW_RUN_AS_ROOT", "1").env("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1");
                command
            }
        };
        command.args(arguments).current_dir(&self.0);
        command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
        command
    }

    fn run(&self, processes: Option<u32>, arguments: &[&str]) -> (Option<i32>, String, String) {
        let Output { status, stdout, stderr } =
            self.command(processes, arguments).output().unwrap_or_else(|error| panic!("{error}"));
        (status.code(), String::from_utf8_lossy(&stdout).into_owned(), String::from_utf8_lossy(&stderr).into_owned())
    }

    fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.0.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// Whether `mpirun` is there.
fn is_installed(test: &str) -> bool {
    let found = Command::new("mpirun").arg("--version").output().is_ok_and(|output| output.status.success());
    if !found {
        println!("1 test skipped: {test}: `mpirun` is not installed");
    }
    found
}

fn scene() -> String {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes/double-pendulum.toml").display().to_string()
}

const SWEEP: [&str; 4] = ["--vary", "joint.elbow.angle=0:1.5:400 rad", "--threads", "2"];
const FILES: [&str; 3] = ["members.csv", "summary.json", "members.svg"];

fn sweep<'a>(scene: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    [&["sweep", scene, "--set", "time.end=2 s"], &SWEEP[..], more].concat()
}

#[test]
fn any_number_of_processes_writes_the_same_bytes() {
    if !is_installed("any_number_of_processes_writes_the_same_bytes") {
        return;
    }
    let (folder, scene) = (Folder::new("same"), scene());
    let (code, told, noted) = folder.run(None, &sweep(&scene, &["--out", "alone"]));
    assert_eq!(code, Some(0), "{told}{noted}");
    for count in [1, 2, 3] {
        let out = format!("of{count}");
        let (code, told, noted) = folder.run(Some(count), &sweep(&scene, &["--out", &out]));
        assert_eq!(code, Some(0), "{told}{noted}");
        // One process reports.
        assert_eq!(told.matches("400 members of").count(), 1, "{told}");
        for file in FILES {
            assert_eq!(folder.read(&format!("{out}/{file}")), folder.read(&format!("alone/{file}")), "{count}: {file}");
        }
    }
}

#[test]
fn a_killed_run_goes_on_with_another_number_of_processes() {
    if !is_installed("a_killed_run_goes_on_with_another_number_of_processes") {
        return;
    }
    let (folder, scene) = (Folder::new("killed"), scene());
    assert_eq!(folder.run(None, &sweep(&scene, &["--out", "whole"])).0, Some(0));
    let mut child =
        folder.command(Some(2), &sweep(&scene, &["--out", "cut"])).spawn().unwrap_or_else(|error| panic!("{error}"));
    let journal = folder.0.join("cut/members-1-of-1.journal");
    let lines = || std::fs::read_to_string(&journal).map_or(0, |text| text.matches('\n').count());
    let begun = Instant::now();
    while lines() < 40 && begun.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(1));
    }
    child.kill().and_then(|()| child.wait()).unwrap_or_else(|error| panic!("{error}"));
    // The processes end after `mpirun`, which they miss.
    let mut before = 0;
    while before < lines() {
        before = lines();
        std::thread::sleep(Duration::from_secs(2));
    }
    assert!(40 <= before && before <= 401, "{before}");
    let (code, told, noted) = folder.run(Some(3), &sweep(&scene, &["--out", "cut", "--resume"]));
    assert_eq!(code, Some(0), "{told}{noted}");
    for file in FILES {
        assert_eq!(folder.read(&format!("cut/{file}")), folder.read(&format!("whole/{file}")), "{file}");
    }
    // Nothing is done twice: the ensemble, and each member once.
    assert_eq!(lines(), 401);
}

#[test]
fn what_cannot_begin_is_refused_once_for_all_processes() {
    if !is_installed("what_cannot_begin_is_refused_once_for_all_processes") {
        return;
    }
    let (folder, scene) = (Folder::new("refused"), scene());
    let cases: [(&[&str], &str); 4] = [
        (&["run", &scene], "2 processes were started; only `sweep` takes more than one"),
        (&["sweep", &scene, "--vary", "joint.elbow.angle=0:1"], "valid: PATH=FROM:TO:COUNT UNIT"),
        (&["sweep", "missing.toml", "--vary", "joint.elbow.angle=0:1:2"], "missing.toml"),
        (&["sweep", &scene, "--colour"], "unexpected argument '--colour'"),
    ];
    for (arguments, expected) in cases {
        let (code, _, noted) = folder.run(Some(2), arguments);
        assert_eq!(code, Some(2), "{noted}");
        assert!(noted.matches(expected).count() == 1, "{noted}");
    }
    assert!(!folder.0.join("out").exists());
}
