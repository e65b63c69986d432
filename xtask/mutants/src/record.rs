//! What is known of the mutants: a line of JSON each, so that an interrupted run goes on where it was.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::OpenOptions;
use std::io::Write;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use crate::trial::Baseline;

/// The file, and what it says of this run.
pub(crate) struct Record {
    path: PathBuf,
    run: Run,
    pub(crate) trials: BTreeMap<u32, Trial>,
    pub(crate) baselines: BTreeMap<String, Baseline>,
    /// Those that did not compile, in the order in which this was found.
    pub(crate) refused: Vec<u32>,
    /// Those that an earlier run of the same sources did not catch: tests may have been added since.
    pub(crate) missed: BTreeMap<u32, Trial>,
}

/// What a line is true of.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Run {
    /// Sources, tests and draw.
    pub(crate) all: String,
    /// Sources and draw. Tests may have been added: what was caught is still caught.
    pub(crate) sources: String,
    /// Whether what an earlier run of the same sources caught is believed.
    pub(crate) is_repeated: bool,
}

/// What became of a mutant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Trial {
    pub(crate) fate: Fate,
    /// The test that failed.
    pub(crate) by: String,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fate {
    Caught,
    /// Caught by the time or the memory that it takes.
    Endless,
    Survived,
    /// No test comes there.
    Unreached,
}

impl Fate {
    const ALL: [(Self, &'static str); 4] = [
        (Self::Caught, "caught"),
        (Self::Endless, "endless"),
        (Self::Survived, "survived"),
        (Self::Unreached, "not reached"),
    ];

    pub(crate) fn name(self) -> &'static str {
        Self::ALL.iter().find(|(fate, _)| *fate == self).map_or("", |(_, name)| name)
    }

    pub(crate) fn is_caught(self) -> bool {
        matches!(self, Self::Caught | Self::Endless)
    }
}

impl Record {
    pub(crate) fn open(path: PathBuf, run: Run) -> Self {
        let text = std::fs::read_to_string(&path).unwrap_or_default();
        let (trials, baselines, missed) = (BTreeMap::new(), BTreeMap::new(), BTreeMap::new());
        let mut record = Self { path, run, trials, baselines, refused: Vec::new(), missed };
        // The last line may be half a line.
        for line in text.lines().filter_map(|line| serde_json::from_str::<Value>(line).ok()) {
            if line["run"] == record.run.all.as_str() {
                record.take(&line);
            } else if record.run.is_repeated && line["sources"] == record.run.sources.as_str() {
                record.take_earlier(&line);
            }
        }
        record
    }

    fn take(&mut self, line: &Value) {
        if let Some(refused) = number(&line["refused"]) {
            if !self.refused.contains(&refused) {
                self.refused.push(refused);
            }
        } else if let Some(executable) = line["executable"].as_str() {
            let reached: BTreeSet<_> = line["reached"].as_array().into_iter().flatten().filter_map(number).collect();
            let seconds = line["seconds"].as_f64().unwrap_or(0.0);
            self.baselines.insert(executable.to_owned(), Baseline { seconds, reached });
        } else if let Some((mutant, trial)) = tried(line) {
            self.trials.insert(mutant, trial);
        }
    }

    /// Of a run with other tests: what holds with more of them too, and what may not.
    fn take_earlier(&mut self, line: &Value) {
        match tried(line) {
            Some((_, trial)) if trial.fate.is_caught() => self.take(line),
            Some((mutant, trial)) => {
                self.missed.insert(mutant, trial);
            }
            None if !line["refused"].is_null() => self.take(line),
            None => {}
        }
    }

    pub(crate) fn refuse(&mut self, mutant: u32) -> Result<(), String> {
        self.add(json!({ "refused": mutant }))
    }

    pub(crate) fn baseline(&mut self, executable: &Path, baseline: &Baseline) -> Result<(), String> {
        self.add(json!({
            "executable": executable.display().to_string(),
            "seconds": baseline.seconds,
            "reached": baseline.reached,
        }))
    }

    pub(crate) fn trial(&mut self, mutant: u32, place: &str, change: &str, trial: &Trial) -> Result<(), String> {
        let fate = trial.fate.name();
        self.add(json!({ "mutant": mutant, "place": place, "change": change, "fate": fate, "by": trial.by }))
    }

    /// Remembers the line and writes it at once.
    fn add(&mut self, mut line: Value) -> Result<(), String> {
        line["run"] = self.run.all.as_str().into();
        line["sources"] = self.run.sources.as_str().into();
        self.take(&line);
        let file = OpenOptions::new().create(true).append(true).open(&self.path);
        let written = file.and_then(|mut file| file.write_all(format!("\n{line}").as_bytes()));
        written.map_err(|error| format!("{}: {error}", self.path.display()))
    }
}

fn number(value: &Value) -> Option<u32> {
    value.as_u64().and_then(|number| u32::try_from(number).ok())
}

/// What a line says of a mutant.
fn tried(line: &Value) -> Option<(u32, Trial)> {
    let (fate, _) = Fate::ALL.iter().find(|(_, name)| line["fate"] == *name)?;
    Some((number(&line["mutant"])?, Trial { fate: *fate, by: line["by"].as_str().unwrap_or("").to_owned() }))
}

/// Changes that leave every result as it was, with a reason each: they are not counted.
pub(crate) struct WithoutEffect(BTreeSet<[String; 4]>);

impl WithoutEffect {
    /// From lines of five cells: file, column, change, line of the text, reason; `#` begins a comment.
    pub(crate) fn read(text: &str) -> Result<Self, String> {
        let mut known = BTreeSet::new();
        for line in text.lines().filter(|line| !line.is_empty() && !line.starts_with('#')) {
            let cells: Vec<_> = line.split('\t').collect();
            let [file, column, change, source, reason] = cells[..] else {
                return Err(format!("`{line}` has not five cells with tabs between them"));
            };
            if reason.is_empty() {
                return Err(format!("`{line}` gives no reason"));
            }
            known.insert([file, column, change, source].map(str::to_owned));
        }
        Ok(Self(known))
    }

    /// Whether this change stands there, in a line that has not changed since.
    pub(crate) fn holds(&self, file: &str, column: usize, change: &str, source: &str) -> bool {
        self.0.contains(&[file, &column.to_string(), change, source].map(str::to_owned))
    }
}

/// A row of the page: what is known of one crate.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Row {
    pub(crate) folder: String,
    /// The operators that could be changed.
    pub(crate) operators: usize,
    /// The seed of the draw.
    pub(crate) seed: u64,
    /// Those changed, without effect, caught, not noticed and not reached.
    pub(crate) counts: [usize; 5],
}

impl Row {
    /// `without_effect` of those that were not caught have none.
    pub(crate) fn new(folder: &str, operators: usize, seed: u64, fates: &[Fate], without_effect: usize) -> Self {
        let count = |fate| fates.iter().filter(|other| **other == fate).count();
        let caught = fates.iter().filter(|fate| fate.is_caught()).count();
        let tried = fates.len() + without_effect;
        let counts = [tried, without_effect, caught, count(Fate::Survived), count(Fate::Unreached)];
        Self { folder: folder.to_owned(), operators, seed, counts }
    }

    /// Those that a test should notice.
    pub(crate) fn with_effect(&self) -> usize {
        self.counts[0] - self.counts[1]
    }

    /// A line of the page, if it is a row of a crate.
    fn read(line: &str) -> Option<Self> {
        let cells: Vec<_> = line.split('|').map(str::trim).collect();
        let [_, folder, operators, seed, changed, without, caught, survived, unreached, _, _] = cells[..] else {
            return None;
        };
        let number = |cell: &str| cell.parse::<usize>().ok();
        let counts = [number(changed)?, number(without)?, number(caught)?, number(survived)?, number(unreached)?];
        Some(Self { folder: folder.to_owned(), operators: number(operators)?, seed: seed.parse().ok()?, counts })
    }
}

impl std::fmt::Display for Row {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { folder, operators, seed, counts: [tried, without, caught, survived, unreached] } = self;
        let share = match self.with_effect() {
            0 => "–".into(),
            all => format!("{:.0} %", 100.0 * *caught as f64 / all as f64),
        };
        writeln!(
            f,
            "| {folder} | {operators} | {seed} | {tried} | {without} | {caught} | {survived} | {unreached} | {share} |"
        )
    }
}

/// The page of docs/measurements: the rows, and those of the page before whose crates were not asked for.
pub(crate) fn page(rows: &[Row], before: &str) -> String {
    let all: BTreeMap<_, _> =
        before.lines().filter_map(Row::read).chain(rows.iter().cloned()).map(|row| (row.folder.clone(), row)).collect();
    let mut page = "# Wrong formulas

Would the tests notice? In each crate arithmetic operators are drawn at random (the seed is named) among those that stand in
bodies of functions, and changed one at a time: a sum becomes a difference, a product a quotient, a sign is left out; where a
quotient does not compile, as of matrices, the product changes its sign. A change is caught when a test fails or does not end:
a test of the crate where its name was given to `cargo xtask mutants`, else any of the workspace. Tests of the documentation
do not count.

Some changes leave every result as it was: a product with ±1 made a quotient, the capacity of a list, the cost of a step.
`xtask/mutants/without_effect.tsv` lists them with a reason each. The share is that of the others. Tests were written for what this
sample showed, so it does not tell what share of all formulas is tested: another seed does. Written by
`cargo xtask mutants [CRATE…] --page`.

| crate | operators | seed | changed | without effect | caught | not noticed | not reached | share caught |
|---|---|---|---|---|---|---|---|---|
"
    .to_owned();
    for row in all.values() {
        page.push_str(&row.to_string());
    }
    page
}

#[cfg(test)]
mod tests {
    use super::{Fate, Record, Row, Run, Trial, WithoutEffect, page};
    use crate::trial::Baseline;

    #[test]
    fn a_record_is_read_as_it_was_written_and_only_of_the_same_run() {
        let path = std::env::temp_dir().join(format!("piola-mutants-{}.jsonl", std::process::id()));
        let _ = std::fs::remove_file(&path);
        let trial = Trial { fate: Fate::Endless, by: "it a::b".into() };
        let baseline = Baseline { seconds: 0.5, reached: [3, 7].into() };
        let run = |all: &str, sources: &str, is_repeated| Run { all: all.into(), sources: sources.into(), is_repeated };
        let mut record = Record::open(path.clone(), run("one", "a", false));
        let written = [
            record.refuse(5),
            record.trial(7, "a.rs:1", "a + b → a - b", &trial),
            record.trial(8, "a.rs:2", "a + b → a - b", &Trial { fate: Fate::Survived, by: String::new() }),
            record.baseline("it".as_ref(), &baseline),
        ];
        assert!(written.iter().all(Result::is_ok));
        let read = Record::open(path.clone(), run("one", "a", false));
        assert_eq!((read.refused, read.trials.get(&7)), (vec![5], Some(&trial)));
        assert_eq!(read.baselines.get("it").map(|it| (it.seconds, it.reached.len())), Some((0.5, 2)));
        assert!(Record::open(path.clone(), run("two", "a", false)).trials.is_empty());
        let again = Record::open(path.clone(), run("two", "a", true));
        assert!(again.trials.keys().eq(&[7]) && again.baselines.is_empty() && again.refused == [5]);
        assert!(again.missed.keys().eq(&[8]));
        assert!(Record::open(path.clone(), run("two", "b", true)).trials.is_empty());
        let _ = std::fs::remove_file(path);
    }

    #[test]
    fn a_change_without_effect_is_known_by_its_place_and_its_line() {
        let known = WithoutEffect::read("# why\n\na.rs\t3\ta * b → a / b\tsign * x\tthe sign is ±1\n")
            .unwrap_or_else(|error| panic!("{error}"));
        assert!(known.holds("a.rs", 3, "a * b → a / b", "sign * x"));
        assert!(!known.holds("a.rs", 3, "a * b → a / b", "sign * y"));
        assert!(!known.holds("a.rs", 5, "a * b → a / b", "sign * x"));
        assert!(WithoutEffect::read("a.rs\t3\ta * b\tx").is_err() && WithoutEffect::read("a.rs\t3\ta\tx\t").is_err());
    }

    #[test]
    fn a_row_adds_up_and_is_read_as_it_was_written() {
        let fates = [Fate::Caught, Fate::Endless, Fate::Survived, Fate::Unreached];
        let tensor = Row::new("tensor", 9, 7, &fates, 2);
        let first = page(std::slice::from_ref(&tensor), "");
        assert!(first.contains("| tensor | 9 | 7 | 6 | 2 | 2 | 1 | 1 | 50 % |\n"), "{first}");
        let both = page(&[Row::new("batch", 2, 7, &fates[..1], 0)], &first);
        assert!(
            both.ends_with(
                "| batch | 2 | 7 | 1 | 0 | 1 | 0 | 0 | 100 % |\n| tensor | 9 | 7 | 6 | 2 | 2 | 1 | 1 | 50 % |\n"
            ),
            "{both}"
        );
        assert_eq!(page(&[tensor], &both), both);
    }
}
