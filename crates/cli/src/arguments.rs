//! The arguments of the program.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};

/// Mechanics from scenes: run, plan, check.
#[derive(Debug, Parser)]
#[command(
    name = "piola",
    version,
    about,
    after_help = "Exit codes: 0 done; 1 failed or interrupted, what there is was written; 2 invalid input."
)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Run a scene; write its summary, tables and figures.
    Run(RunArguments),
    /// Say what a run would compute, by which method and step, and what it would skip.
    Plan(SceneArguments),
    /// Look for mistakes in a scene and show all of them.
    Check(SceneArguments),
    /// Print the JSON Schema of scenes, for editors.
    Schema(SchemaArguments),
}

#[derive(Debug, Args)]
pub(crate) struct SceneArguments {
    /// The scene, a TOML file.
    pub(crate) scene: PathBuf,
    /// Print JSON to standard output.
    #[arg(long)]
    pub(crate) json: bool,
    /// Set a value of the scene, as time.end='10 d' or body.earth.mass=6e24.
    #[arg(long = "set", value_name = "PATH=VALUE")]
    pub(crate) settings: Vec<String>,
}

#[derive(Debug, Args)]
pub(crate) struct RunArguments {
    #[command(flatten)]
    pub(crate) scene: SceneArguments,
    /// Folder of the results instead of the scene's.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct SchemaArguments {
    /// Print the reference tables of the documentation, in Markdown, instead.
    #[arg(long)]
    pub(crate) markdown: bool,
}
