//! `cargo xtask mutants`: would the tests notice a wrong formula?

use xshell::cmd;

use super::Command;
use crate::options::Options;
use crate::step::Step;

pub(super) const COMMAND: Command = Command {
    name: "mutants",
    usage: "[CRATE...] [--sample N] [--seed S] [--again] [--page]",
    help: "change arithmetic operators one at a time and see whether a test fails; no part of ci
All changes are compiled at once into a copy of the project in target/mutants, each behind a switch. A change is caught when a
test of the workspace fails, or of the named crates where some are named; tests of the documentation do not count. Prints
every change that no test notices; xtask/mutants/without_effect.tsv lists those that change no result. An interrupted run goes
on where it was, as long as the sources are the same.
--sample N   how many changes in each crate, drawn at random (40)
--seed S     the seed of the draw (1788): the same seed draws the same changes of the same sources
--again      believe what an earlier run caught, if only tests have changed since, and try the rest
--page       write the rows of these crates into docs/measurements/mutants.md",
    prepare: |shell, _, options| {
        let arguments = arguments(options)?;
        // The program is one of its own, so that the other commands do not wait for its parser.
        let command = cmd!(shell, "cargo run --quiet --package xtask-mutants -- {arguments...}");
        Ok(vec![Step::program(
            "mutants",
            command,
            "a formula that may be changed unnoticed is not tested: compare it with an independent value",
        )])
    },
};

/// Options first, then the crates.
fn arguments(options: &mut Options) -> Result<Vec<String>, String> {
    let mut arguments = Vec::new();
    for name in ["--sample", "--seed"] {
        if let Some(value) = options.value(name)? {
            arguments.extend([name.to_owned(), value]);
        }
    }
    for name in ["--again", "--page"] {
        if options.flag(name) {
            arguments.push(name.to_owned());
        }
    }
    while let Some(folder) = options.word() {
        arguments.push(folder);
    }
    Ok(arguments)
}

#[cfg(test)]
mod tests {
    use super::arguments;
    use crate::options::Options;

    #[test]
    fn what_is_given_is_handed_on_and_nothing_else() {
        let given = "tensor --seed=7 --page --pgae kinematics".split(' ').map(str::to_owned).collect();
        let mut given = Options::new(given);
        let expected = ["--seed", "7", "--page", "tensor", "kinematics"].map(str::to_owned).to_vec();
        assert_eq!(arguments(&mut given), Ok(expected));
        assert!(given.finish().is_err());
    }
}
