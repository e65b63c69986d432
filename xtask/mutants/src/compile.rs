//! Building all mutants at once, without those that do not compile.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use serde_json::Value;
use xshell::{Cmd, Shell, cmd};

use crate::files::Copy;
use crate::plan::{Plan, Rendered};
use crate::record::Record;
use crate::sites::Bytes;

/// A program that runs tests.
pub(crate) struct Executable {
    pub(crate) path: PathBuf,
    pub(crate) package: String,
    /// Such as `it`.
    pub(crate) target: String,
    /// The folder of its package, where cargo would run it.
    pub(crate) directory: PathBuf,
}

/// Checks the libraries, then builds the tests of `packages` (of all when there are none), refusing mutants until both work.
pub(crate) fn settle(
    shell: &Shell,
    (root, copy, build): (&Path, &Copy, &Path),
    plans: &mut [Plan],
    sample: usize,
    packages: &[String],
    record: &mut Record,
) -> Result<Vec<Executable>, String> {
    for plan in plans.iter_mut() {
        plan.fill(sample);
    }
    for number in &record.refused {
        refuse(plans, *number, sample);
    }
    let _target = shell.push_env("CARGO_TARGET_DIR", build);
    let _incremental = shell.push_env("CARGO_INCREMENTAL", "0");
    std::fs::create_dir_all(&copy.root).map_err(|error| error.to_string())?;
    let _place = shell.push_dir(&copy.root);
    let format = "--message-format=json";
    let tested = if packages.is_empty() {
        ["--workspace", "--exclude", "xtask", "--exclude", "xtask-mutants"].map(str::to_owned).to_vec()
    } else {
        packages.iter().flat_map(|package| ["--package".to_owned(), package.clone()]).collect()
    };
    let libraries: Vec<_> = plans.iter().flat_map(|plan| ["--package".to_owned(), plan.package.clone()]).collect();
    let mut is_checked = false;
    loop {
        let rendered = Rendered::new(root, plans)?;
        copy.write(&rendered.texts)?;
        let command = if is_checked {
            cmd!(shell, "cargo test --no-run --all-features {format}").args(&tested)
        } else {
            cmd!(shell, "cargo check --lib --all-features --keep-going {format}").args(&libraries)
        };
        let (messages, passed) = run(command)?;
        if passed && is_checked {
            return Ok(messages.iter().filter_map(executable).collect());
        }
        if passed {
            is_checked = true;
            continue;
        }
        let refused = refused(&messages, &rendered)?;
        eprintln!("{} mutants do not compile", refused.len());
        for number in refused {
            record.refuse(number)?;
            refuse(plans, number, sample);
        }
        is_checked = false;
    }
}

/// The crate tries the fallback, or draws another.
fn refuse(plans: &mut [Plan], number: u32, sample: usize) {
    if let Some(plan) = plans.iter_mut().find(|plan| plan.holds(number)) {
        plan.refuse(number);
        plan.fill(sample);
    }
}

/// What cargo says, a message a line, and whether it was content.
fn run(command: Cmd<'_>) -> Result<(Vec<Value>, bool), String> {
    eprintln!("$ {command}");
    let output = command.quiet().ignore_status().output().map_err(|error| error.to_string())?;
    let text = String::from_utf8_lossy(&output.stdout);
    let messages = text.lines().filter_map(|line| serde_json::from_str(line).ok()).collect();
    Ok((messages, output.status.success()))
}

fn executable(message: &Value) -> Option<Executable> {
    if message["profile"]["test"].as_bool() != Some(true) {
        return None;
    }
    let manifest = PathBuf::from(message["manifest_path"].as_str()?);
    let directory = manifest.parent()?.to_path_buf();
    Some(Executable {
        path: PathBuf::from(message["executable"].as_str()?),
        package: package_of(message["package_id"].as_str()?).to_owned(),
        target: message["target"]["name"].as_str()?.to_owned(),
        directory,
    })
}

/// `piola-numerics` of `path+file:///crates/numerics#piola-numerics@0.1.0`, and `xtask` of `path+file:///xtask#0.1.0`.
fn package_of(id: &str) -> &str {
    let (place, version) = id.rsplit_once('#').unwrap_or((id, ""));
    version.split_once('@').map_or_else(|| place.rsplit('/').next().unwrap_or(place), |(name, _)| name)
}

/// The mutants that the errors are about.
fn refused(messages: &[Value], rendered: &Rendered) -> Result<BTreeSet<u32>, String> {
    let mut refused = BTreeSet::new();
    let mut unexplained = Vec::new();
    for message in messages.iter().map(|message| &message["message"]) {
        if message["level"] != "error" || message["spans"].as_array().is_none_or(Vec::is_empty) {
            continue;
        }
        let guilty = guilty(message, &rendered.places);
        if guilty.is_empty() {
            unexplained.push(message["rendered"].as_str().unwrap_or_default());
        }
        refused.extend(guilty);
    }
    if refused.is_empty() {
        return Err(format!("the copy does not compile, and no mutant is the reason:\n{}", unexplained.join("\n")));
    }
    Ok(refused)
}

/// Those that hold a place which the message is about; else those that such a place holds.
fn guilty(message: &Value, places: &BTreeMap<String, Vec<(u32, Bytes)>>) -> BTreeSet<u32> {
    let primary: Vec<_> =
        spans(message).into_iter().filter(|(span, _)| span["is_primary"] == true).map(|(_, place)| place).collect();
    let children = message["children"].as_array().into_iter().flatten().flat_map(spans);
    let all: Vec<_> = spans(message).into_iter().chain(children).map(|(_, place)| place).collect();
    let found = |spans: &[(String, Bytes)], touches: fn(Bytes, Bytes) -> bool| -> BTreeSet<u32> {
        let inside = spans.iter().flat_map(|(file, span)| {
            let of_file = places.get(file).into_iter().flatten();
            of_file.filter(|(_, place)| touches(*place, *span)).map(|(number, _)| *number)
        });
        inside.collect()
    };
    let tries = [
        found(&primary, Bytes::contains),
        found(&all, Bytes::contains),
        found(&primary, Bytes::overlaps),
        found(&all, Bytes::overlaps),
    ];
    if let Some(found) = tries.into_iter().find(|found| !found.is_empty()) {
        return found;
    }
    // An effect of a mutant that stands before, as of a type that is not found any more.
    let nearest = primary.iter().filter_map(|(file, span)| {
        let before = places.get(file)?.iter().filter(|(_, place)| place.end <= span.start);
        before.max_by_key(|(_, place)| place.end).map(|(number, _)| *number)
    });
    nearest.collect()
}

fn spans(message: &Value) -> Vec<(&Value, (String, Bytes))> {
    let spans = message["spans"].as_array().into_iter().flatten();
    spans
        .filter_map(|span| {
            let byte = |name: &str| span[name].as_u64().and_then(|at| usize::try_from(at).ok());
            let place = Bytes { start: byte("byte_start")?, end: byte("byte_end")? };
            Some((span, (span["file_name"].as_str()?.replace('\\', "/"), place)))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use serde_json::json;

    use super::{guilty, package_of};
    use crate::sites::Bytes;

    #[test]
    fn an_error_is_of_the_mutant_that_holds_it_or_of_the_nearest_before() {
        let places = [(7, Bytes { start: 10, end: 20 }), (8, Bytes { start: 30, end: 40 })];
        let places = BTreeMap::from([("a.rs".to_owned(), places.to_vec())]);
        let at = |start: u32, end: u32| {
            let span = json!({ "file_name": "a.rs", "byte_start": start, "byte_end": end, "is_primary": true });
            guilty(&json!({ "spans": [span] }), &places).into_iter().collect::<Vec<_>>()
        };
        assert_eq!(at(12, 14), [7]);
        assert_eq!(at(15, 32), [7, 8]);
        assert_eq!(at(50, 52), [8]);
        assert!(at(2, 4).is_empty());
    }

    #[test]
    fn a_package_is_named_in_its_id() {
        assert_eq!(package_of("path+file:///a/crates/numerics#piola-numerics@0.1.0"), "piola-numerics");
        assert_eq!(package_of("path+file:///a/xtask#0.1.0"), "xtask");
    }
}
