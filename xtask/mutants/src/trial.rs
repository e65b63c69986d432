//! Running the tests with a mutant, or with none.

use std::collections::BTreeSet;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

use crate::compile::Executable;

/// How a run of tests ended.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Ending {
    Passed,
    /// With the name of a test, where the program tells it.
    Failed(String),
    /// Longer than it was given.
    Endless,
    /// It took more memory than any test needs.
    Greedy,
}

/// What a run without a mutant tells.
pub(crate) struct Baseline {
    pub(crate) seconds: f64,
    /// The mutants that it met.
    pub(crate) reached: BTreeSet<u32>,
}

/// Pages of 4 KiB.
const MOST_PAGES: u64 = 1 << 20;

/// Runs with no mutant; the numbers of those that it meets are left in `seen`.
pub(crate) fn without(executable: &Executable, seen: &Path) -> Result<Baseline, String> {
    let fail = |error: std::io::Error| format!("{}: {error}", seen.display());
    if seen.exists() {
        std::fs::remove_dir_all(seen).map_err(fail)?;
    }
    std::fs::create_dir_all(seen).map_err(fail)?;
    let began = Instant::now();
    let mut command = command(executable);
    command.env("PIOLA_MUTANT_SEEN", seen);
    match run(command, Duration::from_secs(3600))? {
        Ending::Passed => {}
        ending => {
            return Err(format!(
                "{} {} does not pass without a mutant: {ending:?}",
                executable.package, executable.target
            ));
        }
    }
    let seconds = began.elapsed().as_secs_f64();
    let numbers = std::fs::read_dir(seen).map_err(fail)?.flatten();
    let reached = numbers.filter_map(|entry| entry.file_name().to_str()?.parse().ok()).collect();
    Ok(Baseline { seconds, reached })
}

/// Runs with the mutant, ten times as long as without and twenty seconds.
pub(crate) fn with(executable: &Executable, number: u32, baseline: f64) -> Result<Ending, String> {
    let mut command = command(executable);
    command.env("PIOLA_MUTANT", number.to_string());
    run(command, Duration::from_secs_f64(10.0 * baseline + 20.0))
}

fn command(executable: &Executable) -> Command {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let mut command = Command::new(&executable.path);
    command
        .current_dir(&executable.directory)
        .env("CARGO_MANIFEST_DIR", &executable.directory)
        .env("RUST_TEST_THREADS", threads.to_string())
        .env("RUST_BACKTRACE", "0")
        // A mutant that a random case shows is caught: the simplest such case is of no interest.
        .env("PROPTEST_MAX_SHRINK_ITERS", "0")
        .env_remove("PIOLA_MUTANT")
        .env_remove("PIOLA_MUTANT_SEEN")
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::null());
    command
}

/// Runs until the first failure.
fn run(mut command: Command, limit: Duration) -> Result<Ending, String> {
    let began = Instant::now();
    let mut child = command.spawn().map_err(|error| format!("{}: {error}", command.get_program().display()))?;
    let failures = failures(&mut child);
    loop {
        let failed = failures.recv_timeout(Duration::from_millis(20)).ok();
        if let Some(name) = failed {
            kill(&mut child);
            return Ok(Ending::Failed(name));
        }
        if let Some(status) = child.try_wait().map_err(|error| error.to_string())? {
            if status.success() {
                return Ok(Ending::Passed);
            }
            let last = failures.recv_timeout(Duration::from_millis(200));
            return Ok(Ending::Failed(last.unwrap_or_else(|_| status.to_string())));
        }
        let ending = if limit < began.elapsed() {
            Ending::Endless
        } else if MOST_PAGES < resident_pages(child.id()) {
            Ending::Greedy
        } else {
            // The channel closes when the program closes its output, and would not wait any more.
            std::thread::sleep(Duration::from_millis(2));
            continue;
        };
        kill(&mut child);
        return Ok(ending);
    }
}

/// The names of tests as they fail.
fn failures(child: &mut Child) -> Receiver<String> {
    let (sender, receiver) = channel();
    if let Some(output) = child.stdout.take() {
        std::thread::spawn(move || {
            for line in BufReader::new(output).split(b'\n').map_while(Result::ok) {
                let line = String::from_utf8_lossy(&line);
                let name = line.strip_prefix("test ").and_then(|line| line.trim_end().strip_suffix(" ... FAILED"));
                if name.is_some_and(|name| sender.send(name.to_owned()).is_err()) {
                    break;
                }
            }
        });
    }
    receiver
}

/// Ends the program and those that it started.
fn kill(child: &mut Child) {
    for started in descendants(child.id()) {
        // Only the standard `kill` reaches a process that is not ours; where there is none, nothing was listed.
        let _ = Command::new("kill").args(["-KILL", &started.to_string()]).stderr(Stdio::null()).status();
    }
    let _ = child.kill();
    let _ = child.wait();
}

/// What `process` started, and what that started: none where the system does not show processes as files.
fn descendants(process: u32) -> Vec<u32> {
    let mut parents = Vec::new();
    for entry in std::fs::read_dir("/proc").into_iter().flatten().flatten() {
        let Some(id) = entry.file_name().to_str().and_then(|name| name.parse::<u32>().ok()) else { continue };
        let status = std::fs::read_to_string(entry.path().join("status")).unwrap_or_default();
        let parent = status.lines().find_map(|line| line.strip_prefix("PPid:")?.trim().parse::<u32>().ok());
        parents.extend(parent.map(|parent| (id, parent)));
    }
    let mut found = vec![process];
    let mut at = 0;
    while let Some(above) = found.get(at).copied() {
        found.extend(parents.iter().filter(|(_, parent)| *parent == above).map(|(id, _)| *id));
        at += 1;
    }
    found.split_off(1)
}

/// The memory that a process holds; none where the system does not say.
fn resident_pages(process: u32) -> u64 {
    let text = std::fs::read_to_string(format!("/proc/{process}/statm")).unwrap_or_default();
    text.split_whitespace().nth(1).and_then(|pages| pages.parse().ok()).unwrap_or(0)
}
