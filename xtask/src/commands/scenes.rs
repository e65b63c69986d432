//! `cargo xtask scenes`

use xshell::cmd;

use super::Command;
use crate::step::Step;

pub(super) const COMMAND: Command = Command {
    name: "scenes",
    usage: "",
    help: "run every scene as the read-me says, with the binary in its release profile
Only this builds what the read-me's first command builds: optimised across crates.",
    prepare: |shell, workspace, _| {
        let folder = workspace.root.join("scenes");
        let mut scenes: Vec<_> = shell
            .read_dir(&folder)
            .map_err(|error| error.to_string())?
            .into_iter()
            .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
            .filter_map(|path| path.file_name().and_then(|name| name.to_str()).map(str::to_owned))
            .collect();
        scenes.sort();
        let step = |name: &String| {
            let (scene, out) = (format!("scenes/{name}"), format!("target/scenes/{}", name.trim_end_matches(".toml")));
            Step::program(
                &format!("scenes: {name}"),
                cmd!(shell, "cargo run --quiet --release -- run {scene} --out {out}"),
                "a scene that is shipped must run with the command of the read-me",
            )
        };
        Ok(scenes.iter().map(step).collect())
    },
};
