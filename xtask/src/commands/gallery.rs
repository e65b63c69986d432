//! `cargo xtask gallery`: a page with every scene, its plan and its figure.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use xshell::{Shell, cmd};

use super::Command;
use crate::step::{Outcome, Step};
use crate::workspace::{Workspace, read};

pub(super) const COMMAND: Command = Command {
    name: "gallery",
    usage: "[--program PATH]",
    help: "run every scene and write docs/gallery.md: what the scene is, its plan and its smallest figure of what happens
--program PATH   a program `piola` with the features `robots` and `spectral` that was built before; without it one is built
`cargo xtask tidy` checks that the page has every scene.",
    prepare: |shell, workspace, options| {
        let mut steps = Vec::new();
        let program = if let Some(path) = options.value("--program")? {
            PathBuf::from(path)
        } else {
            steps.push(Step::program(
                "gallery: program",
                cmd!(shell, "cargo build --quiet --release --package piola-cli --features robots,spectral"),
                "the program must build with its features",
            ));
            Workspace::target(shell)?.join("release/piola")
        };
        steps.push(Step::check(
            "gallery",
            move || draw(shell, workspace, &program),
            "a scene that is shipped must have a plan and run",
        ));
        Ok(steps)
    },
};

/// A figure beyond this, in bytes, is left out: the page is read on the web.
const LARGEST: u64 = 250_000;

/// The page, and the folder of its figures.
const PAGE: &str = "docs/gallery.md";
const FIGURES: &str = "docs/gallery";

fn draw(shell: &Shell, workspace: &Workspace, program: &Path) -> Outcome {
    let (mut page, mut problems) = (String::from(HEAD), Vec::new());
    // The page and its figures are replaced when every scene has run, so that a scene that fails leaves the tree as it is.
    let drawn = Workspace::target(shell).map_err(|error| vec![error])?.join("gallery-figures");
    empty(&drawn).map_err(|error| vec![error])?;
    for name in scenes(workspace) {
        match entry(shell, workspace, (program, &drawn), &name) {
            Ok(text) => page.push_str(&text),
            Err(problem) => problems.push(format!("scenes/{name}.toml: {problem}")),
        }
    }
    if !problems.is_empty() {
        return Err(problems);
    }
    replace(&workspace.root.join(FIGURES), &drawn).map_err(|error| vec![error])?;
    std::fs::write(workspace.root.join(PAGE), page).map_err(|error| vec![format!("{PAGE}: {error}")])?;
    Ok(format!("{PAGE} is written"))
}

/// Makes an empty folder, whatever was there before.
fn empty(folder: &Path) -> Result<(), String> {
    // What is not there needs no removing, and what stays is found out by the next line or overwritten.
    let _ = std::fs::remove_dir_all(folder);
    std::fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))
}

/// Replaces the files of a folder by those of another. A figure of a scene that is no longer there would stay otherwise.
fn replace(folder: &Path, by: &Path) -> Result<(), String> {
    let entries = std::fs::read_dir(by).map_err(|error| format!("{}: {error}", by.display()))?;
    empty(folder)?;
    for file in entries.flatten() {
        let kept = folder.join(file.file_name());
        std::fs::copy(file.path(), &kept).map_err(|error| format!("{}: {error}", kept.display()))?;
    }
    Ok(())
}

const HEAD: &str = "# Gallery

Every scene of the folder `scenes`, with its plan and a figure. `cargo xtask gallery` runs the scenes and writes this page. To run one
yourself: `cargo run --release -- run scenes/NAME.toml`. Scenes of `[robot]` need `--features robots`, scenes of `[box]`
`--features spectral`.
";

/// The heading, the words, the figure and the plan of a scene; the figure is copied to the folder `drawn`.
fn entry(shell: &Shell, workspace: &Workspace, (program, drawn): (&Path, &Path), name: &str) -> Result<String, String> {
    let scene = format!("scenes/{name}.toml");
    let text = read(&workspace.root.join(&scene))?;
    let plan = cmd!(shell, "{program} plan {scene}").quiet().read().map_err(|error| error.to_string())?;
    let out = Workspace::target(shell)?.join("gallery").join(name);
    let run = cmd!(shell, "{program} run {scene} --out {out}").quiet().ignore_stderr();
    run.read().map_err(|error| error.to_string())?;
    let mut entry = format!("\n## {}\n\n{}\n\n[{scene}](../{scene})\n\n", title(&text, name), words(&text));
    if let Some(figure) = smallest(&out) {
        let kept = drawn.join(format!("{name}.svg"));
        std::fs::copy(&figure, &kept).map_err(|error| format!("{}: {error}", kept.display()))?;
        let _ = writeln!(entry, "![{}](gallery/{name}.svg)\n", title(&text, name));
    }
    let _ = writeln!(entry, "```text\n{}\n```", steady(&plan));
    Ok(entry)
}

/// The plan without the line of the cost, which differs from machine to machine.
fn steady(plan: &str) -> String {
    plan.lines().filter(|line| !line.starts_with("cost ")).collect::<Vec<_>>().join("\n")
}

/// The smallest figure of a folder that is not too large for the page; one of errors only where there is no other.
fn smallest(folder: &Path) -> Option<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let figures = entries.filter(|path| path.extension().is_some_and(|extension| extension == "svg"));
    let sizes = figures.filter_map(|path| Some((shows_errors(&path), std::fs::metadata(&path).ok()?.len(), path)));
    sizes.filter(|(_, size, _)| *size <= LARGEST).min().map(|(_, _, path)| path)
}

/// Whether a figure shows errors or drifts, and not the motion.
fn shows_errors(path: &Path) -> bool {
    path.file_stem().is_some_and(|name| name == "invariants" || name == "error")
}

/// The title of a scene, or its name.
fn title(text: &str, name: &str) -> String {
    let line = text.lines().find_map(|line| line.strip_prefix("title = "));
    line.map_or_else(|| name.to_owned(), |title| title.trim_matches(['"', '\'']).to_owned())
}

/// The words at the top of a scene.
fn words(text: &str) -> String {
    let lines = text.lines().map_while(|line| line.strip_prefix('#'));
    lines.map(str::trim_start).collect::<Vec<_>>().join("\n").trim().to_owned()
}

/// The names of the scenes.
fn scenes(workspace: &Workspace) -> Vec<String> {
    let entries = std::fs::read_dir(workspace.root.join("scenes")).into_iter().flatten().flatten();
    let paths = entries.map(|entry| entry.path()).filter(|path| path.extension().is_some_and(|kind| kind == "toml"));
    let mut names: Vec<String> = paths.filter_map(|path| Some(path.file_stem()?.to_str()?.to_owned())).collect();
    names.sort();
    names
}

/// Scenes that the page lacks, and figures that it shows and that are not there.
pub(super) fn missing(workspace: &Workspace) -> Vec<String> {
    let page = read(&workspace.root.join(PAGE)).unwrap_or_default();
    let mut problems = absent(&page, &scenes(workspace));
    for figure in shown(&page) {
        if !workspace.root.join("docs").join(figure).exists() {
            problems.push(format!("{PAGE}: `{figure}` is not there; `cargo xtask gallery` makes it"));
        }
    }
    problems
}

fn absent(page: &str, names: &[String]) -> Vec<String> {
    let is_there = |name: &String| page.contains(&format!("[scenes/{name}.toml](../scenes/{name}.toml)"));
    let absent = names.iter().filter(|name| !is_there(name));
    absent.map(|name| format!("{PAGE} lacks scenes/{name}.toml; `cargo xtask gallery` writes it")).collect()
}

fn shown(page: &str) -> impl Iterator<Item = &str> {
    page.lines().filter_map(|line| line.strip_prefix("![")?.split_once("](")?.1.strip_suffix(')'))
}

#[cfg(test)]
mod tests {
    use super::{absent, empty, replace, shown, steady, title, words};

    #[test]
    fn a_scene_is_told_by_its_first_comment_and_its_title() {
        let text = "# A top,\n# spinning.\n\nname = \"top\"\ntitle = \"Heavy top\"\n# more\n";
        assert_eq!((words(text).as_str(), title(text, "top").as_str()), ("A top,\nspinning.", "Heavy top"));
        assert_eq!(title("name = \"top\"", "top"), "top");
    }

    #[test]
    fn figures_are_replaced_at_once_and_no_old_one_stays() {
        let root = std::env::temp_dir().join(format!("piola-gallery-{}", std::process::id()));
        let (shown, drawn) = (root.join("shown"), root.join("drawn"));
        let write = |path: std::path::PathBuf, text: &str| {
            std::fs::write(path, text).unwrap_or_else(|error| panic!("{error}"));
        };
        assert_eq!((empty(&shown), empty(&drawn)), (Ok(()), Ok(())));
        write(shown.join("old.svg"), "old");
        write(shown.join("top.svg"), "old");
        write(drawn.join("top.svg"), "new");
        assert_eq!(replace(&shown, &drawn), Ok(()));
        assert!(!shown.join("old.svg").exists());
        assert_eq!(std::fs::read_to_string(shown.join("top.svg")).ok().as_deref(), Some("new"));
        assert!(replace(&shown, &root.join("absent")).is_err() && shown.join("top.svg").exists());
        let _ = std::fs::remove_dir_all(&root);
    }

    #[test]
    fn scenes_that_a_page_lacks_are_named_and_the_cost_is_left_out() {
        let page = "## A\n\n[scenes/a.toml](../scenes/a.toml)\n\n![A](gallery/a.svg)\n";
        assert_eq!(absent(page, &["a".to_owned(), "b".to_owned()]).len(), 1);
        assert_eq!(shown(page).collect::<Vec<_>>(), ["gallery/a.svg"]);
        assert_eq!(steady("method    m\ncost      3 ms\nwritten   w"), "method    m\nwritten   w");
    }
}
