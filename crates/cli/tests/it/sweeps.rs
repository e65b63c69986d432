//! Tests of the command `sweep`: a run that is killed and continued, runs in parts, refused arguments.

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("piola-sweep-{}-{name}", std::process::id()));
        let _ = std::fs::remove_dir_all(&path);
        std::fs::create_dir_all(&path).unwrap_or_else(|error| panic!("{error}"));
        Self(path)
    }

    fn command(&self, arguments: &[&str]) -> Command {
        let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/double-pendulum.toml");
        let mut command = Command::new(env!("CARGO_BIN_EXE_piola"));
        command.arg("sweep").arg(scene).args(["--set", "time.end=1 s"]).args(arguments).current_dir(&self.0);
        command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
        command
    }

    fn sweep(&self, arguments: &[&str]) -> (Option<i32>, String, String) {
        let Output { status, stdout, stderr } =
            self.command(arguments).output().unwrap_or_else(|error| panic!("{error}"));
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

const ANGLES: [&str; 4] = ["--vary", "joint.elbow.angle=0:1.5:150 rad", "--vary", "particle.lower bob.mass=1:2:2 kg"];

#[test]
fn a_sweep_that_is_killed_goes_on_and_writes_the_same_bytes() {
    let folder = Folder::new("killed");
    let whole = folder.sweep(&[ANGLES.as_slice(), &["--out", "whole"]].concat());
    assert_eq!(whole.0, Some(0), "{}{}", whole.1, whole.2);
    assert!(whole.1.contains("300 members of"), "{}", whole.1);
    let cost = whole.2.lines().find(|line| line.contains("300 members, about")).unwrap_or_default();
    assert!(cost.contains("of one core") && cost.ends_with("bytes of table"), "told before it runs: {}", whole.2);
    let cut = [ANGLES.as_slice(), &["--out", "cut", "--threads", "1"]].concat();
    let mut child = folder.command(&cut).spawn().unwrap_or_else(|error| panic!("{error}"));
    let journal = folder.0.join("cut/members-1-of-1.journal");
    let lines = || std::fs::read_to_string(&journal).map_or(0, |text| text.lines().count());
    let begun = Instant::now();
    while lines() < 20 && begun.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(1));
    }
    child.kill().and_then(|()| child.wait()).unwrap_or_else(|error| panic!("{error}"));
    assert!(20 <= lines(), "{}", lines());
    let again = folder.sweep(&[cut.as_slice(), &["--resume"]].concat());
    assert_eq!(again.0, Some(0), "{}{}", again.1, again.2);
    for file in ["members.csv", "summary.json", "members.svg"] {
        assert_eq!(folder.read(&format!("cut/{file}")), folder.read(&format!("whole/{file}")), "{file}");
    }
    let rows = folder.read("whole/members.csv");
    assert!(rows.starts_with("member,joint.elbow.angle (rad),particle.lower bob.mass (kg),time (s),"), "{rows}");
    assert_eq!(rows.lines().count(), 301);
}

#[test]
fn parts_of_a_sweep_end_with_the_results() {
    let folder = Folder::new("parts");
    let random = ["--random", "joint.elbow.angle=normal(0.5, 0.1) rad", "--members", "9", "--seed", "4"];
    let (code, _, told) = folder.sweep(&[random.as_slice(), &["--part", "2/2", "--out", "parts"]].concat());
    assert_eq!(code, Some(0));
    assert!(told.contains("4 members of this part are done; other parts are not"), "{told}");
    let (code, shown, _) = folder.sweep(&[random.as_slice(), &["--part", "1/2", "--out", "parts"]].concat());
    assert_eq!(code, Some(0));
    assert!(shown.contains("9 members of"), "{shown}");
    assert_eq!(folder.sweep(&[random.as_slice(), &["--out", "whole"]].concat()).0, Some(0));
    assert_eq!(folder.read("parts/members.csv"), folder.read("whole/members.csv"));
}

#[test]
fn what_cannot_be_swept_exits_with_2_and_writes_nothing() {
    let folder = Folder::new("refused");
    let cases: [(&[&str], &str); 5] = [
        (&["--vary", "joint.elbow.angle=0:1"], "valid: PATH=FROM:TO:COUNT UNIT"),
        (&["--vary", "joint.elbow.colour=0:1:2"], "unknown key `colour`"),
        (&["--random", "joint.elbow.angle=cauchy(0, 1)"], "valid: PATH=normal(MEAN, DEVIATION) UNIT"),
        (&["--vary", "joint.elbow.angle=0:1:100000", "--vary", "particle.lower bob.mass=1:2:100000"], "are too many"),
        (&["--vary", "joint.elbow.angle=0:1:3", "--part", "4/3"], "valid: K/N with 1 ≤ K ≤ N"),
    ];
    for (arguments, expected) in cases {
        let (code, _, told) = folder.sweep(arguments);
        assert_eq!(code, Some(2), "{told}");
        assert!(told.contains(expected), "{told}");
    }
    let long = ["--set", "time.end=100 d", "--vary", "joint.elbow.angle=0:1:1000000"];
    let (code, _, told) = folder.sweep(&long);
    assert_eq!(code, Some(2), "{told}");
    assert!(told.contains("days on") && told.contains("--yes"), "{told}");
    assert!(!folder.0.join("out").exists());
}

#[test]
fn a_table_in_parquet_is_written_beside_the_csv_or_refused_by_the_feature() {
    let folder = Folder::new("parquet");
    let (code, shown, told) = folder.sweep(&["--vary", "joint.elbow.angle=0:1:3 rad", "--parquet", "--out", "three"]);
    let path = folder.0.join("three/members.parquet");
    if cfg!(feature = "parquet") {
        assert_eq!(code, Some(0), "{told}");
        assert!(shown.contains("members.parquet"), "{shown}");
        let content = std::fs::read(path).unwrap_or_else(|error| panic!("{error}"));
        assert!(content.starts_with(b"PAR1") && content.ends_with(b"PAR1"));
        // Without it the next sweep leaves no table of this one.
        let (code, ..) = folder.sweep(&["--vary", "joint.elbow.angle=0:1:4 rad", "--out", "three"]);
        assert_eq!(code, Some(0));
        assert!(!folder.0.join("three/members.parquet").exists());
    } else {
        assert_eq!(code, Some(2), "{shown}");
        assert!(told.contains("build it with the feature `parquet`"), "{told}");
        assert!(!path.exists());
    }
}
