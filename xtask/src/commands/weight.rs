//! `cargo xtask weight`: what building costs.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::time::Instant;

use xshell::{Shell, cmd};

use super::Command;
use super::tidy::crates::lines_of;
use crate::step::{Outcome, Step};
use crate::workspace::{Workspace, read};

pub(super) const COMMAND: Command = Command {
    name: "weight",
    usage: "[--only NAME]... [--page]",
    help: "measure what building costs, each in an empty target folder, and hold it to its limits
Builds the README's first and second command, each library crate alone with its default features, and three programs
of a user that evaluate one law, a law of the user's own and all laws in lanes; prints wall seconds, processor seconds and lines of `src`,
and the functions with most lines of LLVM IR where `cargo llvm-lines` is installed. Takes half an hour on two cores.
--only NAME   only this row: a crate's folder, `run`, `test`, `one-law`, `own-law` or `all-laws`
--page        also write docs/measurements/weight.md",
    prepare: |shell, workspace, options| {
        let only = options.values("--only")?;
        let page = options.flag("--page");
        let target = Workspace::target(shell)?.join("weight");
        Ok(vec![Step::check(
            "weight",
            move || weigh(shell, workspace, &target, &only, page),
            "building costs more than its limit: find the cause with `cargo build --timings` and `cargo llvm-lines`",
        )])
    },
};

/// A cold build and its limit in wall seconds on two quiet cores.
struct Build {
    name: String,
    /// What a reader of the table sees.
    what: String,
    /// Arguments of cargo.
    arguments: Vec<String>,
    folder: PathBuf,
    limit: f64,
    /// The folder whose own compilation alone counts: what is built before it is not timed.
    after: Option<Vec<String>>,
}

struct Row {
    what: String,
    wall: f64,
    user: f64,
    limit: f64,
    lines: Option<usize>,
}

fn weigh(shell: &Shell, workspace: &Workspace, target: &Path, only: &[String], page: bool) -> Outcome {
    let fail = |error: String| vec![error];
    let (mut rows, mut problems) = (Vec::new(), Vec::new());
    for build in builds(workspace, target).map_err(fail)? {
        if !only.is_empty() && !only.contains(&build.name) {
            continue;
        }
        let row = measure(shell, workspace, target, &build).map_err(fail)?;
        eprintln!("{:>7.1} s  {:>7.1} s of processor  {}", row.wall, row.user, row.what);
        if row.limit < row.wall {
            problems.push(format!("{}: {:.0} s, the limit is {:.0} s", row.what, row.wall, row.limit));
        }
        rows.push(row);
    }
    let table = table(&rows, &heaviest(shell, target, only));
    eprintln!("{table}");
    if page {
        let file = workspace.root.join("docs/measurements/weight.md");
        std::fs::write(&file, table).map_err(|error| vec![format!("{}: {error}", file.display())])?;
    }
    if problems.is_empty() { Ok("all within their limits".into()) } else { Err(problems) }
}

/// Those that stand lowest and that nearly everybody builds.
const LIGHTEST: [&str; 3] = ["kinematics", "integrators", "tensor"];

fn builds(workspace: &Workspace, target: &Path) -> Result<Vec<Build>, String> {
    let words = |line: &str| line.split_whitespace().map(str::to_owned).collect::<Vec<_>>();
    let root = workspace.root.clone();
    let mut builds = vec![
        Build {
            name: "run".into(),
            what: "README's first command: `cargo run --release`".into(),
            arguments: words("build --release"),
            folder: root.clone(),
            limit: 75.0,
            after: None,
        },
        Build {
            name: "test".into(),
            what: "README's second command, without running: `cargo xtask test`".into(),
            arguments: words("test --workspace --all-features --no-run"),
            folder: root.clone(),
            limit: 900.0,
            after: None,
        },
    ];
    for member in &workspace.crates {
        if !member.path.join("src/lib.rs").is_file() || matches!(&*member.folder, "testkit" | "piola") {
            continue;
        }
        let limit = if LIGHTEST.contains(&&*member.folder) { 20.0 } else { 45.0 };
        builds.push(Build {
            name: member.folder.clone(),
            what: format!("`{}` alone", member.name),
            arguments: words(&format!("build --release --package {}", member.name)),
            folder: root.clone(),
            limit,
            after: None,
        });
    }
    for (name, what, source, limit) in PROGRAMS {
        let folder = target.join(format!("{name}-program"));
        write_program(workspace, &folder, name, source)?;
        builds.push(Build {
            name: (*name).into(),
            what: (*what).into(),
            arguments: words("build --release"),
            folder,
            limit: *limit,
            after: Some(words("build --release --package piola-solids --package piola-batch")),
        });
    }
    Ok(builds)
}

fn measure(shell: &Shell, workspace: &Workspace, target: &Path, build: &Build) -> Result<Row, String> {
    let folder = target.join(&build.name);
    if folder.exists() {
        std::fs::remove_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    }
    let _place = shell.push_dir(&build.folder);
    let cargo = |arguments: &[String]| {
        cmd!(shell, "cargo --quiet {arguments...}")
            .env("CARGO_TARGET_DIR", &folder)
            .env("CARGO_INCREMENTAL", "0")
            .quiet()
            .run()
            .map_err(|error| error.to_string())
    };
    if let Some(before) = &build.after {
        cargo(before)?;
    }
    let (start, processor) = (Instant::now(), children_seconds());
    cargo(&build.arguments)?;
    let (wall, user) = (start.elapsed().as_secs_f64(), children_seconds() - processor);
    // The next build starts from nothing; what this one left is of no use.
    std::fs::remove_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let member = workspace.member(&build.name);
    let lines = member.map(|member| lines_of(&member.path.join("src")));
    Ok(Row { what: build.what.clone(), wall, user, limit: build.limit, lines })
}

/// User seconds of all children that have ended, where the system tells (Linux); elsewhere zero.
fn children_seconds() -> f64 {
    let Ok(text) = std::fs::read_to_string("/proc/self/stat") else { return 0.0 };
    // After the name in parentheses: field 16 of proc(5) is the 14th, in hundredths of a second.
    let fields = text.rsplit(") ").next().unwrap_or_default();
    fields.split(' ').nth(13).and_then(|ticks| ticks.parse::<f64>().ok()).unwrap_or(0.0) / 100.0
}

fn table(rows: &[Row], heaviest: &str) -> String {
    let mut text = String::from(
        "# Weight\n\nCold builds in empty target folders, written by `cargo xtask weight --page`. Wall and processor seconds on two\ncores; the limits are for two quiet ones.\n\n| build | wall, s | limit, s | processor, s | lines of `src` |\n|---|---|---|---|---|\n",
    );
    for row in rows {
        let lines = row.lines.map_or_else(String::new, |lines| lines.to_string());
        // Writing to a string cannot fail.
        let _ = writeln!(text, "| {} | {:.1} | {:.0} | {:.1} | {lines} |", row.what, row.wall, row.limit, row.user);
    }
    text + heaviest
}

/// The ten functions with most lines of LLVM IR in the program that evaluates all laws.
fn heaviest(shell: &Shell, target: &Path, only: &[String]) -> String {
    if !only.is_empty() && !only.iter().any(|name| name == "all-laws") {
        return String::new();
    }
    let folder = target.join("all-laws-program");
    let _place = shell.push_dir(&folder);
    let listed = cmd!(shell, "cargo llvm-lines --release")
        .env("CARGO_TARGET_DIR", target.join("llvm-lines"))
        .quiet()
        .ignore_stderr()
        .read();
    let Ok(listed) = listed else { return String::new() };
    let mut text = String::from(
        "\nLines of LLVM IR of the program that evaluates all laws, the ten heaviest functions:\n\n```text\n",
    );
    for line in listed.lines().take(13) {
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text + "```\n"
}

fn write_program(workspace: &Workspace, folder: &Path, name: &str, source: &str) -> Result<(), String> {
    let fail = |error: std::io::Error| format!("{}: {error}", folder.display());
    std::fs::create_dir_all(folder.join("src")).map_err(fail)?;
    let path = |name: &str| workspace.root.join("crates").join(name).display().to_string();
    let manifest = format!(
        "[package]\nname = \"{name}\"\nversion = \"0.0.0\"\nedition = \"2024\"\n\n[workspace]\n\n[dependencies]\n\
         piola-continuum = {{ path = {:?} }}\npiola-batch = {{ path = {:?} }}\n\
         piola-solids = {{ path = {:?}, features = [\"batch\"] }}\nnalgebra = \"0.35\"\n",
        path("continuum"),
        path("batch"),
        path("solids"),
    );
    let of_own_laws = format!(
        "piola-laws = {{ path = {:?}, features = [\"batch\"] }}\npiola-numerics = {{ path = {:?} }}\n",
        path("laws"),
        path("numerics"),
    );
    let manifest = manifest + if source.contains("piola_laws") { &of_own_laws } else { "" };
    std::fs::write(folder.join("Cargo.toml"), manifest).map_err(fail)?;
    std::fs::write(folder.join("Cargo.lock"), read(&workspace.root.join("Cargo.lock"))?).map_err(fail)?;
    std::fs::write(folder.join("src/main.rs"), source).map_err(fail)
}

/// Programs of a user: name, what it is, source, limit in seconds for what is compiled after the libraries.
const PROGRAMS: &[(&str, &str, &str, f64)] = &[
    (
        "one-law",
        "a program that evaluates one law in lanes, after its libraries",
        include_str!("weight/one_law.rs"),
        5.0,
    ),
    (
        "own-law",
        "a program that evaluates a law of the user's own in lanes, after its libraries",
        include_str!("weight/own_law.rs"),
        8.0,
    ),
    (
        "all-laws",
        "a program that evaluates all laws in lanes, after their libraries",
        include_str!("weight/all_laws.rs"),
        60.0,
    ),
];
