//! `cargo xtask mutants`: would the tests notice a wrong formula?

use std::path::Path;

use serde_json::Value;
use xshell::{Shell, cmd};

use super::Command;
use crate::step::{Outcome, Step};
use crate::workspace::{Workspace, read};

pub(super) const COMMAND: Command = Command {
    name: "mutants",
    usage: "CRATE [--sample N] [--seed S]",
    help: "change arithmetic operators of a crate one at a time and see whether a test fails; no part of ci
Needs `cargo install cargo-mutants`. Each mutant is built and tested in a copy of the tree, by the crate's tests without
those of its documentation. Prints how many were caught, and every survivor with its place.
--sample N   how many mutants, drawn at random (40)
--seed S     the seed of the draw (1788): the same seed draws the same mutants of the same sources",
    prepare: |shell, workspace, options| {
        let number = |text: Option<String>, name: &str, otherwise: u64| match text {
            Some(text) => text.parse::<u64>().map_err(|_| format!("`{name} {text}` is no whole number")),
            None => Ok(otherwise),
        };
        let sample = number(options.value("--sample")?, "--sample", 40)?;
        let seed = number(options.value("--seed")?, "--seed", 1788)?;
        let folder = options.word().ok_or("which crate? `cargo xtask mutants kinematics`")?;
        let member = workspace.member(&folder).ok_or_else(|| format!("there is no crate `{folder}`"))?;
        let target = Workspace::target(shell)?.join("mutants").join(&folder);
        let package = member.name.clone();
        Ok(vec![Step::check(
            "mutants",
            move || try_them(shell, workspace, &package, &target, (sample, seed)),
            "a formula that may be changed unnoticed is not tested: compare it with an independent value",
        )])
    },
};

/// The operators that arithmetic is made of; comparisons and logic are the compiler's and clippy's business.
const ARITHMETIC: &str = r"replace [-+*/]=? with";

fn try_them(shell: &Shell, workspace: &Workspace, package: &str, target: &Path, (sample, seed): (u64, u64)) -> Outcome {
    let fail = |error: xshell::Error| vec![error.to_string()];
    let _place = shell.push_dir(&workspace.root);
    let listed = cmd!(shell, "cargo mutants --list --json --package {package} --re {ARITHMETIC}").quiet().read();
    let listed: Value = serde_json::from_str(&listed.map_err(fail)?).map_err(|error| vec![error.to_string()])?;
    let mut names: Vec<String> = listed
        .as_array()
        .into_iter()
        .flatten()
        .filter_map(|mutant| mutant["name"].as_str().map(str::to_owned))
        .collect();
    names.sort();
    let drawn = draw(names, sample, seed);
    if drawn.is_empty() {
        return Err(vec![format!("{package} has no arithmetic to change")]);
    }
    let mut chosen = Vec::new();
    for name in &drawn {
        chosen.extend(["--re".to_owned(), format!("^{}$", escaped(name))]);
    }
    // cargo mutants ends with an error when a mutant survives: what it wrote tells more.
    cmd!(shell, "cargo mutants --package {package} --all-features --no-shuffle --output {target} {chosen...}")
        .args(["--", "--tests"])
        .ignore_status()
        .run()
        .map_err(fail)?;
    let outcome = |file: &str| -> Vec<String> {
        let text = read(&target.join("mutants.out").join(file)).unwrap_or_default();
        text.lines().map(str::to_owned).collect()
    };
    let (caught, missed) = (outcome("caught.txt"), outcome("missed.txt"));
    let (slow, unviable) = (outcome("timeout.txt"), outcome("unviable.txt"));
    let tried = caught.len() + missed.len() + slow.len();
    let line = format!(
        "{package}: {} of {tried} caught (seed {seed}, {} do not compile, {} endless)",
        caught.len() + slow.len(),
        unviable.len(),
        slow.len()
    );
    if missed.len() * 20 <= tried {
        for survivor in &missed {
            eprintln!("survives: {survivor}");
        }
        return Ok(line);
    }
    Err(missed.into_iter().map(|survivor| format!("survives: {survivor}")).chain([line]).collect())
}

/// `count` of the names, by a generator of its own (`SplitMix64`), so that a seed means the same everywhere.
fn draw(mut names: Vec<String>, count: u64, seed: u64) -> Vec<String> {
    let mut state = seed;
    let mut next = || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    };
    let mut drawn = Vec::new();
    for _ in 0..count {
        if names.is_empty() {
            break;
        }
        let at = usize::try_from(next() % names.len() as u64).unwrap_or(0);
        drawn.push(names.swap_remove(at));
    }
    drawn.sort();
    drawn
}

/// The name as a regular expression that matches it alone.
fn escaped(name: &str) -> String {
    let mut text = String::with_capacity(name.len());
    for c in name.chars() {
        if c.is_ascii_punctuation()
            && !matches!(c, '_' | ':' | '/' | '<' | '>' | '\'' | '"' | ',' | '=' | '&' | '!' | '%' | '@' | ';' | '`')
        {
            text.push('\\');
        }
        text.push(c);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::{draw, escaped};

    #[test]
    fn a_seed_draws_the_same_names_and_none_twice() {
        let names: Vec<String> = (0..100).map(|i| format!("{i:03}")).collect();
        let drawn = draw(names.clone(), 40, 7);
        assert_eq!(drawn, draw(names.clone(), 40, 7));
        assert_ne!(drawn, draw(names.clone(), 40, 8));
        assert!(drawn.windows(2).all(|pair| pair[0] < pair[1]) && drawn.len() == 40);
        assert_eq!(draw(names, 400, 7).len(), 100);
    }

    #[test]
    fn a_name_is_matched_literally() {
        assert_eq!(escaped("src/a.rs:3:4: replace + with * in f"), r"src/a\.rs:3:4: replace \+ with \* in f");
    }
}
