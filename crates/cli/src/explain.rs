//! `plan --explain TERM`: what the plan says of a term, and the keys and words of the scene format with that name.

use core::fmt;
use std::collections::BTreeSet;

use piola_document::words;
use piola_scene::plan::Item;
use piola_scene::schema::{Absent, Key, Kind, SCENE, Table};
use piola_scene::studies::StudyPlan;
use piola_scene::{Plan, SceneFile};
use serde::Serialize;

/// All that there is on a term.
#[derive(Debug, Serialize)]
pub(crate) struct Explanation {
    term: String,
    plan: Vec<Line>,
    keys: Vec<Entry>,
}

/// A line of the plan.
#[derive(Debug, Serialize)]
struct Line {
    heading: &'static str,
    what: String,
    why: String,
}

/// A key of the scene format, or a word that a key takes.
#[derive(Debug, Serialize)]
struct Entry {
    path: String,
    meaning: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    value: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    default: Option<&'static str>,
    required: bool,
    #[serde(skip_serializing_if = "<[&str]>::is_empty")]
    only_for: &'static [&'static str],
}

impl Explanation {
    /// What the plan of a scene and the scene format say of a term.
    ///
    /// # Errors
    /// That nothing has it, with names that are near.
    pub(crate) fn of(file: &SceneFile, term: &str) -> Result<Self, String> {
        let lines = lines(file);
        let mut entries = Vec::new();
        collect(&SCENE, "", &mut entries);
        let plain = term.trim().to_lowercase();
        let has = |text: &str| text.to_lowercase().contains(&plain);
        let lines = lines.into_iter().filter(|line| !plain.is_empty() && (has(&line.what) || has(&line.why)));
        let plan: Vec<Line> = lines.collect();
        let (keys, others): (Vec<_>, Vec<_>) = entries
            .into_iter()
            .partition(|(name, entry)| name.to_lowercase() == plain || entry.path.to_lowercase() == plain);
        if plan.is_empty() && keys.is_empty() {
            let names: BTreeSet<&str> = others.iter().map(|(name, _)| *name).collect();
            return Err(nothing(term, &plain, &names));
        }
        Ok(Self { term: term.to_owned(), plan, keys: keys.into_iter().map(|(_, entry)| entry).collect() })
    }
}

/// The lines of a plan: its method, its computed items, its skipped items.
fn lines(file: &SceneFile) -> Vec<Line> {
    let (method, reason, computed, skipped) = match file {
        SceneFile::Motion(scene) => {
            let plan = Plan::of(scene);
            (plan.method.to_string(), plan.reason, plan.computed, plan.skipped)
        }
        SceneFile::Study(study) => {
            let plan = StudyPlan::of(study);
            (plan.method, plan.reason, plan.computed, plan.skipped)
        }
    };
    let items =
        |heading, items: Vec<Item>| items.into_iter().map(move |item| Line { heading, what: item.what, why: item.why });
    let first = Line { heading: "method", what: method, why: reason };
    core::iter::once(first).chain(items("computed", computed)).chain(items("skipped", skipped)).collect()
}

/// Every key of a table and of the tables in it, and every word of a choice, each with its name.
fn collect(table: &Table, above: &str, entries: &mut Vec<(&'static str, Entry)>) {
    for key in table.keys {
        let path = if above.is_empty() { key.name.to_owned() } else { format!("{above}.{}", key.name) };
        entries.push((key.name, Entry::of(key, path.clone())));
        match key.kind {
            Kind::Table(inner) | Kind::Tables(inner) => collect(inner, &path, entries),
            Kind::Choice(words) => entries.extend(words.iter().map(|word| {
                let path = format!("{path} = \"{}\"", word.name);
                let (meaning, only_for) = (word.doc, key.only_for);
                (word.name, Entry { path, meaning, value: None, default: None, required: false, only_for })
            })),
            _ => {}
        }
    }
}

impl Entry {
    fn of(key: &Key, path: String) -> Self {
        let default = if let Absent::Default(text) = key.absent { Some(text) } else { None };
        let required = key.absent == Absent::Required;
        Self { path, meaning: key.doc, value: Some(key.kind.describe()), default, required, only_for: key.only_for }
    }
}

/// How many names a hint has at most.
const HINTS: usize = 8;

fn nothing(term: &str, plain: &str, names: &BTreeSet<&str>) -> String {
    let shown: String = term.chars().take(60).collect();
    let what = format!("neither the plan nor a key of scenes has `{shown}`");
    let with = |name: &&&str| !plain.is_empty() && name.contains(plain);
    let mut near: Vec<&str> = words::nearest(plain, names.iter().copied()).into_iter().collect();
    let nearest = near.first().copied();
    near.extend(names.iter().filter(with).filter(|name| Some(**name) != nearest));
    near.truncate(HINTS);
    if near.is_empty() {
        format!("{what}; `piola schema --markdown` prints all keys")
    } else {
        format!("{what}; near names: {}", near.join(", "))
    }
}

impl fmt::Display for Explanation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut last = "";
        for line in &self.plan {
            let heading = if line.heading == last { "" } else { line.heading };
            writeln!(f, "{heading:<10}{}: {}", line.what, line.why)?;
            last = line.heading;
        }
        for entry in &self.keys {
            let heading = if entry.value.is_some() { "key" } else { "word" };
            writeln!(f, "{heading:<10}{}\n          {}", entry.path, entry.meaning)?;
            if let Some(value) = &entry.value {
                let absent = match entry.default {
                    Some(default) => format!("{default} when absent"),
                    None if entry.required => "must be given".to_owned(),
                    None => "may be absent".to_owned(),
                };
                writeln!(f, "          {value}; {absent}")?;
            }
            if !entry.only_for.is_empty() {
                writeln!(f, "          only of type {}", entry.only_for.join(", "))?;
            }
        }
        Ok(())
    }
}
