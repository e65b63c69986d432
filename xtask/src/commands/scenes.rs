//! `cargo xtask scenes`

use xshell::cmd;

use super::Command;
use crate::step::Step;

pub(super) const COMMAND: Command = Command {
    name: "scenes",
    usage: "",
    help:
        "run every scene as the read-me says, with the binary in its release profile
Only this builds what the read-me's first command builds. Scenes of robots and of fields on a box run last: they need a feature more.",
    prepare: |shell, workspace, _| {
        let folder = workspace.root.join("scenes");
        let mut scenes: Vec<_> = shell
            .read_dir(&folder)
            .map_err(|error| error.to_string())?
            .into_iter()
            .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
            .filter_map(|path| path.file_name().and_then(|name| name.to_str()).map(str::to_owned))
            .collect();
        let feature = |name: &String| {
            let text = shell.read_file(folder.join(name)).unwrap_or_default();
            let has = |header: &str| text.lines().any(|line| line.trim_end() == header);
            [("[robot]", "robots"), ("[box]", "spectral")].into_iter().find_map(|(header, feature)| has(header).then_some(feature))
        };
        scenes.sort_by_key(|name| (feature(name), name.clone()));
        let step = |name: &String| {
            let (scene, out) = (format!("scenes/{name}"), format!("target/scenes/{}", name.trim_end_matches(".toml")));
            let features: &[&str] = &feature(name).map_or_else(Vec::new, |feature| vec!["--features", feature]);
            Step::program(
                &format!("scenes: {name}"),
                cmd!(shell, "cargo run --quiet --release {features...} -- run {scene} --out {out}"),
                "a scene that is shipped must run with the command of the read-me",
            )
        };
        Ok(scenes.iter().map(step).collect())
    },
};
