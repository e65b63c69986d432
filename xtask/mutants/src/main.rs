//! `cargo xtask mutants`: would the tests notice a wrong formula?
//!
//! All changed operators are compiled at once into a copy of the project, each behind a switch that an environment variable
//! turns on; so the project is built once, whatever the number of changes. A test program is run for a change only if it
//! comes where the change stands.
#![forbid(unsafe_code)]

mod compile;
mod draw;
mod files;
mod plan;
mod record;
mod sites;
mod trial;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use serde_json::Value;
use xshell::{Shell, cmd};

use compile::Executable;
use files::{Copy, read};
use plan::{Mutant, Plan, Rendered};
use record::{Fate, Record, Row, Run, Trial, WithoutEffect};
use trial::Ending;

/// Without formulas of their own, or not used by users.
const PASSED_OVER: [&str; 3] = ["cli", "piola", "testkit"];

/// A crate passes when at most one change in twenty is not noticed.
const NOTICED_OF: usize = 20;

fn main() -> ExitCode {
    match Options::new(std::env::args().skip(1)).and_then(|options| run(&options)) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(message) => {
            eprintln!("mutants: {message}");
            ExitCode::from(2)
        }
    }
}

struct Options {
    folders: Vec<String>,
    sample: usize,
    seed: u64,
    again: bool,
    page: bool,
}

impl Options {
    fn new(mut arguments: impl Iterator<Item = String>) -> Result<Self, String> {
        let mut options = Self { folders: Vec::new(), sample: 40, seed: 1788, again: false, page: false };
        while let Some(argument) = arguments.next() {
            let mut number = || {
                let text = arguments.next().unwrap_or_default();
                text.parse::<u64>().map_err(|_| format!("`{argument} {text}` is no whole number"))
            };
            match argument.as_str() {
                "--sample" => options.sample = usize::try_from(number()?).map_err(|error| error.to_string())?,
                "--seed" => options.seed = number()?,
                "--again" => options.again = true,
                "--page" => options.page = true,
                folder if !folder.starts_with('-') => options.folders.push(folder.to_owned()),
                unknown => return Err(format!("unknown argument `{unknown}`")),
            }
        }
        Ok(options)
    }
}

fn run(options: &Options) -> Result<bool, String> {
    let shell = Shell::new().map_err(|error| error.to_string())?;
    let (root, target) = places(&shell)?;
    shell.change_dir(&root);
    let folder = target.join("mutants");
    std::fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut plans = plans(&root, options)?;
    // All tests, or those of the crates that are named.
    let packages: Vec<_> =
        if options.folders.is_empty() { Vec::new() } else { plans.iter().map(|plan| plan.package.clone()).collect() };
    let copy = Copy::new(&shell, &root, folder.join("tree"))?;
    let draw = format!("{} {}", options.sample, options.seed);
    let [all, sources] = copy.hashes()?.map(|hash| format!("{hash:016x} {draw}"));
    // The draw of a crate does not depend on the others; which tests there are does.
    let all = format!("{all} {}", packages.join(" "));
    let mut record = Record::open(folder.join("results.jsonl"), Run { all, sources, is_repeated: options.again });
    let list = root.join("xtask/mutants/without_effect.tsv");
    let without_effect = WithoutEffect::read(&read(&list)?).map_err(|error| format!("{}: {error}", list.display()))?;
    let executables = compile::settle(
        &shell,
        (&root, &copy, &folder.join("build")),
        &mut plans,
        options.sample,
        &packages,
        &mut record,
    )?;
    for executable in &executables {
        let key = executable.path.display().to_string();
        if !record.baselines.contains_key(&key) {
            let baseline = trial::without(executable, &folder.join("seen"))?;
            eprintln!(
                "{:>7.1} s  {:>3} mutants met by {} {}",
                baseline.seconds,
                baseline.reached.len(),
                executable.package,
                executable.target
            );
            record.baseline(&executable.path, &baseline)?;
        }
    }
    let mut passes = true;
    let mut texts = Texts { root: &root, known: BTreeMap::new() };
    for plan in &plans {
        for mutant in plan.mutants() {
            let missed = record.missed.get(&mutant.number).cloned();
            if let Some(trial) = missed.filter(|_| !record.trials.contains_key(&mutant.number))
                && texts.is_without_effect(&mutant, &without_effect)?
            {
                // An earlier run tried it.
                record.trials.insert(mutant.number, trial);
            }
            if !record.trials.contains_key(&mutant.number) {
                let trial = attempt(&plan.package, &mutant, &executables, &record)?;
                eprintln!("{}: {} {}", place(&mutant), trial.fate.name(), trial.by);
                record.trial(mutant.number, &place(&mutant), &mutant.site.sign.described(mutant.change), &trial)?;
                // A failed test may leave a file: a random case to repeat, which no other mutant is to profit from.
                copy.write(&Rendered::new(&root, &plans)?.texts)?;
            }
        }
        passes &= report(&mut texts, plan, &record, &without_effect, options)?;
    }
    Ok(passes)
}

/// The root of the project, and where cargo builds it.
fn places(shell: &Shell) -> Result<(PathBuf, PathBuf), String> {
    let text = cmd!(shell, "cargo metadata --no-deps --format-version 1").quiet().read();
    let metadata: Value =
        serde_json::from_str(&text.map_err(|error| error.to_string())?).map_err(|error| error.to_string())?;
    let path = |key: &str| metadata[key].as_str().map(PathBuf::from).ok_or_else(|| format!("cargo named no {key}"));
    Ok((path("workspace_root")?, path("target_directory")?))
}

/// A plan for each crate that is asked for.
fn plans(root: &Path, options: &Options) -> Result<Vec<Plan>, String> {
    let entries = std::fs::read_dir(root.join("crates")).map_err(|error| error.to_string())?;
    let mut all: Vec<_> = entries.flatten().filter_map(|entry| entry.file_name().into_string().ok()).collect();
    all.retain(|folder| root.join("crates").join(folder).join("src/lib.rs").is_file());
    all.retain(|folder| !PASSED_OVER.contains(&folder.as_str()));
    all.sort();
    if let Some(unknown) = options.folders.iter().find(|folder| !all.contains(folder)) {
        return Err(format!("there is no crate `{unknown}` with formulas; there are {}", all.join(", ")));
    }
    let mut plans = Vec::new();
    for (index, folder) in (0..).zip(&all) {
        if options.folders.is_empty() || options.folders.contains(folder) {
            plans.push(Plan::new(root, folder, &format!("piola-{folder}"), index, options.seed)?);
        }
    }
    Ok(plans)
}

/// Runs the tests that meet the mutant until one fails: those of its crate before all others, the quick ones first.
fn attempt(package: &str, mutant: &Mutant, executables: &[Executable], record: &Record) -> Result<Trial, String> {
    let mut meeting: Vec<_> = executables
        .iter()
        .filter_map(|executable| Some((executable, record.baselines.get(&executable.path.display().to_string())?)))
        .filter(|(_, baseline)| baseline.reached.contains(&mutant.number))
        .collect();
    meeting.sort_by(|(a, base_a), (b, base_b)| {
        let is_other = |executable: &Executable| executable.package != package;
        is_other(a).cmp(&is_other(b)).then(base_a.seconds.total_cmp(&base_b.seconds))
    });
    if meeting.is_empty() {
        return Ok(Trial { fate: Fate::Unreached, by: String::new() });
    }
    for (executable, baseline) in meeting {
        let (fate, how) = match trial::with(executable, mutant.number, baseline.seconds)? {
            Ending::Passed => continue,
            Ending::Failed(test) => (Fate::Caught, test),
            Ending::Endless => (Fate::Endless, "without end".to_owned()),
            Ending::Greedy => (Fate::Endless, "without end of memory".to_owned()),
        };
        return Ok(Trial { fate, by: format!("{} {}: {how}", executable.package, executable.target) });
    }
    Ok(Trial { fate: Fate::Survived, by: String::new() })
}

fn place(mutant: &Mutant) -> String {
    let site = &mutant.site;
    format!("{}:{}:{}: {}", site.file, site.line, site.column, site.sign.described(mutant.change))
}

/// The sources, read as they are needed.
struct Texts<'r> {
    root: &'r Path,
    known: BTreeMap<String, String>,
}

impl Texts<'_> {
    /// The line that the mutant stands in.
    fn line(&mut self, mutant: &Mutant) -> Result<&str, String> {
        let site = &mutant.site;
        if !self.known.contains_key(&site.file) {
            self.known.insert(site.file.clone(), read(&self.root.join(&site.file))?);
        }
        Ok(self.known[&site.file].lines().nth(site.line - 1).unwrap_or_default().trim())
    }

    fn is_without_effect(&mut self, mutant: &Mutant, known: &WithoutEffect) -> Result<bool, String> {
        let site = &mutant.site;
        Ok(known.holds(&site.file, site.column, &site.sign.described(mutant.change), self.line(mutant)?))
    }
}

/// Prints what survives in a crate and writes its row of the page; true if the crate passes.
fn report(
    texts: &mut Texts<'_>,
    plan: &Plan,
    record: &Record,
    without_effect: &WithoutEffect,
    options: &Options,
) -> Result<bool, String> {
    let (mut fates, mut passed_over) = (Vec::new(), 0);
    eprintln!();
    for mutant in plan.mutants() {
        let Some(trial) = record.trials.get(&mutant.number) else { continue };
        if !trial.fate.is_caught() {
            if texts.is_without_effect(&mutant, without_effect)? {
                passed_over += 1;
                continue;
            }
            eprintln!("{}: {}\n    {}", trial.fate.name(), place(&mutant), texts.line(&mutant)?);
        }
        fates.push(trial.fate);
    }
    let row = Row::new(&plan.folder, plan.operators(), options.seed, &fates, passed_over);
    let [tried, without, caught, survived, unreached] = row.counts;
    let endless = fates.iter().filter(|fate| **fate == Fate::Endless).count();
    eprintln!(
        "{}: {caught} of {} caught ({endless} endless), {survived} not noticed, {unreached} not reached, {without} of {tried} \
         without effect; {} operators, seed {}",
        row.folder,
        row.with_effect(),
        row.operators,
        row.seed
    );
    let passes = (row.with_effect() - caught) * NOTICED_OF <= row.with_effect();
    if options.page {
        let path = texts.root.join("docs/measurements/mutants.md");
        // The first time there is no page.
        let before = std::fs::read_to_string(&path).unwrap_or_default();
        std::fs::write(&path, record::page(&[row], &before)).map_err(|error| error.to_string())?;
    }
    Ok(passes)
}

#[cfg(test)]
#[path = "../switch.rs"]
mod switch;

#[cfg(test)]
mod tests {
    use super::{Options, switch};

    #[test]
    fn options_are_understood_or_refused() {
        let options = |line: &str| Options::new(line.split_whitespace().map(str::to_owned));
        let given = options("kinematics --sample 3 --again --seed 5 tensor");
        assert!(
            given.is_ok_and(|given| given.folders.len() == 2 && given.again && given.sample == 3 && given.seed == 5)
        );
        for wrong in ["--sample", "--sample x", "--pgae"] {
            assert!(options(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn without_the_variable_no_mutant_is_on() {
        assert!((1..1000).all(|number| !switch::is(number)));
    }
}
