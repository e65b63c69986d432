//! `cargo xtask bench`

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use serde_json::{Map, Value, json};
use xshell::{Cmd, Shell, cmd};

use super::Command;
use crate::step::{Outcome, Step};
use crate::workspace::{Workspace, read};

pub(super) const COMMAND: Command = Command {
    name: "bench",
    usage: "[--json FILE] [--filter NAME] [--peers]",
    help: "run the benches in cargo's own release profile, on one core where `taskset` exists
--filter NAME   only the benches whose `group/name` matches the regular expression NAME; where it begins with the name
                of a group, only that group is compiled
--json FILE     write the results as a list of {group, name, ns_per_item, items, error?, peer?}:
                nanoseconds per item (median), items in one iteration, the error of the result where the bench
                states one, and the peer's name where it is a peer that ran
--peers         also the peers in crates of their own, `benches/peers/*`: they are fetched, built and run, each in
                turn with ours, and are among the results; with `--filter` only the peers' benches of that name",
    prepare: |shell, _, options| {
        let json = options.value("--json")?;
        let filter = options.value("--filter")?;
        let peers = options.flag("--peers");
        let target = Workspace::target(shell)?;
        let (criterion, notes) = (target.join("criterion"), target.join("bench-notes"));
        let start = SystemTime::now();
        let targets = targets(filter.as_deref());
        let run = run(shell, &targets, filter.as_deref())
            .env("CRITERION_HOME", &criterion)
            // Where a bench states the error of its result and whether it is a peer's: see `benches/src/notes.rs`.
            .env("PIOLA_BENCH_NOTES", &notes);
        let mut steps = vec![compile(shell, &targets), Step::program("bench: run", run, "a bench failed")];
        if peers {
            for manifest in PEERS {
                let run = peer(shell, manifest, filter.as_deref())
                    .env("CARGO_TARGET_DIR", target.join("peers"))
                    .env("CRITERION_HOME", &criterion)
                    .env("PIOLA_BENCH_NOTES", &notes);
                steps.push(Step::program("bench: peers", run, "a peer does not build or run"));
            }
        }
        if let Some(file) = json {
            steps.push(Step::check(
                "bench: collect",
                move || collect(&criterion, &notes, start, Path::new(&file)),
                "the results could not be collected",
            ));
        }
        Ok(steps)
    },
};

/// Each is a file of that name in `benches/benches`, and its group has the same name.
const GROUPS: [&str; 16] = [
    "numerics",
    "nbody",
    "multibody",
    "lagrangian",
    "hamiltonian",
    "hamilton_jacobi",
    "integrators",
    "continuum",
    "constitutive",
    "own_law",
    "own_law_with_history",
    "floor",
    "viscometry",
    "solutions",
    "uniformity",
    "spectral",
];

/// What to tell cargo: the one bench whose name begins the filter, or all of them.
fn targets(filter: Option<&str>) -> Vec<&'static str> {
    let group = filter.and_then(|name| name.split('/').next());
    match GROUPS.into_iter().find(|known| group == Some(*known)) {
        Some(known) => vec!["--bench", known],
        None => vec!["--benches"],
    }
}

fn compile<'a>(shell: &'a Shell, targets: &[&str]) -> Step<'a> {
    Step::program(
        "bench: compile",
        cmd!(shell, "cargo bench --package piola-benches --no-run").args(targets),
        "the benches do not compile",
    )
}

fn run<'a>(shell: &'a Shell, targets: &[&str], filter: Option<&str>) -> Cmd<'a> {
    let command = pinned(shell).args(["bench", "--package", "piola-benches"]).args(targets);
    match filter {
        Some(name) => command.args(["--", name]),
        None => command,
    }
}

/// The peers that the workspace excludes.
const PEERS: [&str; 1] = ["benches/peers/conspire/Cargo.toml"];

/// A peer's bench, in which ours and the peer's rows follow one another.
fn peer<'a>(shell: &'a Shell, manifest: &str, filter: Option<&str>) -> Cmd<'a> {
    let command = pinned(shell)
        .args(["bench", "--manifest-path", manifest, "--benches"])
        // conspire uses a feature of the compiler that is not stable, and declares it only to a nightly one.
        .env("RUSTC_BOOTSTRAP", "1")
        .env("RUSTFLAGS", "-Zcrate-attr=feature(float_algebraic)");
    match filter {
        Some(name) => command.args(["--", name]),
        None => command,
    }
}

/// cargo on one core: a thread that wanders between cores meets cold caches and other clock rates.
fn pinned(shell: &Shell) -> Cmd<'_> {
    let pinned = cmd!(shell, "taskset --version").quiet().ignore_stdout().ignore_stderr().run().is_ok();
    let last_core = std::thread::available_parallelism().map_or(0, |count| count.get() - 1).to_string();
    if pinned { cmd!(shell, "taskset --cpu-list {last_core} cargo") } else { cmd!(shell, "cargo") }
}

/// Writes what criterion measured since `start`.
fn collect(criterion: &Path, notes: &Path, start: SystemTime, file: &Path) -> Outcome {
    let mut folders = Vec::new();
    find_results(criterion, start, &mut folders);
    folders.sort();
    let mut notes_of = BTreeMap::new();
    let (mut results, mut problems) = (Vec::new(), Vec::new());
    for folder in folders {
        let result = (|| {
            let benchmark: Value = parse(&folder.join("benchmark.json"))?;
            let estimates: Value = parse(&folder.join("estimates.json"))?;
            let group = benchmark["group_id"].as_str().unwrap_or_default().to_owned();
            let notes = notes_of.entry(group.clone()).or_insert_with(|| notes_of_group(notes, &group));
            record(&group, &benchmark, &estimates, notes)
        })();
        match result {
            Ok(record) => results.push(record),
            Err(problem) => problems.push(problem),
        }
    }
    if !problems.is_empty() {
        return Err(problems);
    }
    if results.is_empty() {
        return Err(vec!["no bench ran: does the filter match a `group/name`?".into()]);
    }
    let count = results.len();
    let text = serde_json::to_string_pretty(&results).map_err(|error| vec![error.to_string()])?;
    std::fs::write(file, text + "\n").map_err(|error| vec![format!("{}: {error}", file.display())])?;
    Ok(format!("{count} results in {}", file.display()))
}

/// The notes of a group, those of its peers in crates of their own among them.
fn notes_of_group(folder: &Path, group: &str) -> Value {
    let mut all = Map::new();
    for file in [format!("{group}.json"), format!("{group}-peers.json")] {
        if let Ok(Value::Object(notes)) = parse(&folder.join(file)) {
            all.extend(notes);
        }
    }
    Value::Object(all)
}

fn record(group: &str, benchmark: &Value, estimates: &Value, notes: &Value) -> Result<Value, String> {
    let part = |key: &str| benchmark[key].as_str().map(str::to_owned);
    let name = [part("function_id"), part("value_str")].into_iter().flatten().collect::<Vec<_>>().join("/");
    // A throughput in elements, whatever the version of criterion calls it, says how many items one iteration holds.
    let throughput = benchmark["throughput"].as_object();
    let items = throughput.and_then(|counts| counts.values().find_map(Value::as_u64)).unwrap_or(1);
    let median = estimates["median"]["point_estimate"].as_f64();
    let median = median.ok_or_else(|| format!("{group}/{name}: no median"))?;
    let mut record = Map::new();
    record.insert("group".into(), json!(group));
    record.insert("name".into(), json!(name));
    record.insert("ns_per_item".into(), json!(median / (items.max(1) as f64)));
    record.insert("items".into(), json!(items));
    for key in ["error", "peer"] {
        if let Some(value) = notes.get(&name).and_then(|note| note.get(key)) {
            record.insert(key.into(), value.clone());
        }
    }
    Ok(Value::Object(record))
}

fn find_results(folder: &Path, start: SystemTime, found: &mut Vec<PathBuf>) {
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    for path in entries.filter_map(|entry| entry.ok().map(|entry| entry.path())).filter(|path| path.is_dir()) {
        let estimates = path.join("estimates.json");
        if path.file_name().is_some_and(|name| name == "new") && estimates.is_file() {
            let modified = std::fs::metadata(&estimates).and_then(|data| data.modified());
            if modified.is_ok_and(|time| start <= time) {
                found.push(path);
            }
        } else {
            find_results(&path, start, found);
        }
    }
}

fn parse(path: &Path) -> Result<Value, String> {
    serde_json::from_str(&read(path)?).map_err(|error| format!("{}: {error}", path.display()))
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::{GROUPS, record, targets};

    #[test]
    fn a_filter_that_names_a_group_compiles_it_alone() {
        assert_eq!(targets(Some("continuum")), ["--bench", "continuum"]);
        assert_eq!(targets(Some("constitutive/mooney_rivlin/.*/1k")), ["--bench", "constitutive"]);
        for filter in [None, Some("con"), Some(".*/first_piola")] {
            assert_eq!(targets(filter), ["--benches"]);
        }
        let benches = concat!(env!("CARGO_MANIFEST_DIR"), "/../benches/benches");
        let found = std::fs::read_dir(benches).expect("the benches").count();
        assert_eq!(found, GROUPS.len());
    }

    #[test]
    fn a_record_divides_the_median_by_the_items_and_carries_the_notes() {
        let benchmark =
            json!({"group_id": "nbody", "function_id": "direct", "value_str": "8", "throughput": {"Elements": 4}});
        let estimates = json!({"median": {"point_estimate": 10.0}});
        let notes = json!({"direct/8": {"error": 1e-16, "peer": "other 1.0"}});
        let expected = json!({"group": "nbody", "name": "direct/8", "ns_per_item": 2.5, "items": 4, "error": 1e-16, "peer": "other 1.0"});
        assert_eq!(record("nbody", &benchmark, &estimates, &notes), Ok(expected));
    }

    #[test]
    fn a_result_without_a_median_is_refused() {
        assert!(record("g", &json!({"function_id": "f"}), &json!({}), &json!(null)).is_err());
    }
}
