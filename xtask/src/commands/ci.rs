//! `cargo xtask ci`

use super::{Command, clippy, docs, errors, features, fmt, ledger, mpi, package, scenes, test, tidy};
use crate::options::Options;

/// In the order that fails soonest for the least time.
const PARTS: &[&Command] = &[
    &fmt::COMMAND,
    &tidy::COMMAND,
    &clippy::COMMAND,
    &test::COMMAND,
    &docs::COMMAND,
    &ledger::COMMAND,
    &errors::COMMAND,
    &features::COMMAND,
    &package::COMMAND,
    &scenes::COMMAND,
    &mpi::COMMAND,
];

pub(super) const COMMAND: Command = Command {
    name: "ci",
    usage: "[--skip COMMAND]...",
    help: "everything that must hold before a change goes in
It is the steps of fmt, tidy, clippy, test, docs, ledger, errors, features, package, scenes and mpi, in this order; `--skip test`,
say, leaves the steps of one out. clippy checks the benches, too: nothing is gained by generating their code.",
    prepare: |shell, workspace, options| {
        let skipped = options.values("--skip")?;
        if let Some(unknown) = skipped.iter().find(|name| PARTS.iter().all(|part| part.name != **name)) {
            let names: Vec<_> = PARTS.iter().map(|part| part.name).collect();
            return Err(format!("`ci` has no part `{unknown}`; its parts are {}", names.join(", ")));
        }
        let mut steps = Vec::new();
        for part in PARTS.iter().filter(|part| skipped.iter().all(|name| name != part.name)) {
            steps.extend((part.prepare)(shell, workspace, &mut Options::new(Vec::new()))?);
        }
        Ok(steps)
    },
};
