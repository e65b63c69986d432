//! The arguments of the program.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};

use crate::intervals::IntervalArguments;

/// Mechanics from scenes: run, plan, check.
#[derive(Debug, Parser)]
#[command(
    name = "piola",
    version,
    about,
    next_line_help = true,
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
    /// Show the plan of a run: its method and step, computed and skipped quantities.
    Plan(PlanArguments),
    /// Look for mistakes in a scene and show all of them.
    Check(SceneArguments),
    /// Run a scene many times on all cores, with other values or random ones; killed, it goes on with --resume.
    ///
    /// The program of the folder `mpi` runs on several machines, as `mpirun -n 8 piola sweep SCENE ...`.
    Sweep(SweepArguments),
    /// Fit laws of rubber to measured stresses; compare them in a table, a summary and a figure.
    Fit(FitArguments),
    /// Recover a fluid's flow curve and normal stresses, with bands, from discharges, speeds, torques and thrusts.
    ///
    /// --flow capillary takes capillaries of several lengths, a file each, and corrects for the pressure lost at their ends, after
    /// Bagley.
    Recover(RecoverArguments),
    /// Fit fluids to a flow curve, or straight to discharges or speeds; compare them in a table, a summary and a figure.
    FitFlow(FitFlowArguments),
    /// Solve a flow of any fluid: its drive or an answer in, all answers with their error bounds, the profile and a figure out.
    Flow(SolveArguments),
    /// Find the relaxation spectrum of a material from G′ and G″, from G(t) or from creep J(t), at one temperature or at several, with
    /// shifts, a master curve and Prony series.
    Spectrum(crate::spectra::SpectrumArguments),
    /// Fit viscoelastic fluids to start-up of shear and extension, steady flows and normal stresses; compare them in a table, a summary
    /// and a figure. Needs the feature `nonlinear` of the program.
    Nonlinear(crate::nonlinear::NonlinearArguments),
    /// Load a specimen of any solid along a path of stretches or loads: all components of strain and stress and a figure out.
    /// Needs the feature `specimens` of the program.
    Specimen(crate::specimens::SpecimenArguments),
    /// Register two images: find the map that deforms one into the other. Needs the feature `register` of the program.
    Register(crate::register::RegisterArguments),
    /// Print the JSON Schema of scenes, for editors.
    Schema(SchemaArguments),
    /// Print completions for a shell, as `piola completions bash > ~/.local/share/bash-completion/completions/piola`.
    Completions(crate::shell::CompletionsArguments),
    /// Print a page of the manual, as `piola manual > ~/.local/share/man/man1/piola.1`.
    Manual(crate::shell::ManualArguments),
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
pub(crate) struct PlanArguments {
    #[command(flatten)]
    pub(crate) scene: SceneArguments,
    /// Show instead what the plan says of a term, and the keys and words of scenes that have it for a name.
    #[arg(long, value_name = "TERM")]
    pub(crate) explain: Option<String>,
}

#[derive(Debug, Args)]
#[expect(clippy::struct_excessive_bools, reason = "each is a flag of the command line")]
pub(crate) struct SweepArguments {
    #[command(flatten)]
    pub(crate) scene: SceneArguments,
    /// A value that takes evenly spaced values, as 'joint.elbow.angle=0:90:10 deg'; several times for all combinations.
    #[arg(long = "vary", value_name = "PATH=FROM:TO:COUNT", allow_hyphen_values = true)]
    pub(crate) ranges: Vec<String>,
    /// A random value, as 'particle.bob.mass=normal(1, 0.1) kg' or 'joint.elbow.angle=uniform(0, 90) deg'.
    #[arg(long = "random", value_name = "PATH=LAW")]
    pub(crate) random: Vec<String>,
    /// Members of each combination, with other random values.
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub(crate) members: u64,
    /// The seed of the random values.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(crate) seed: u64,
    /// Threads instead of one for each core.
    #[arg(long, value_name = "N")]
    pub(crate) threads: Option<usize>,
    /// Compute one of several parts, each on its own machine, as 2/8; the last one writes the results.
    #[arg(long, value_name = "K/N")]
    pub(crate) part: Option<String>,
    /// Keep the members that a run before has computed.
    #[arg(long)]
    pub(crate) resume: bool,
    /// Write members.parquet too: the table of members in Apache Parquet. Needs the feature `parquet` of the program.
    #[arg(long)]
    pub(crate) parquet: bool,
    /// Write report.html too: figures, tables and inputs in one file.
    #[arg(long)]
    pub(crate) report: bool,
    /// Start a sweep of more than a day, too.
    #[arg(long)]
    pub(crate) yes: bool,
    /// Folder of the results instead of out/sweep-SCENE.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct RunArguments {
    #[command(flatten)]
    pub(crate) scene: SceneArguments,
    /// Folder of the results instead of the scene's.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Write report.html too: figures, tables, plan and inputs in one file.
    #[arg(long)]
    pub(crate) report: bool,
    /// Start even a run that takes more than a day.
    #[arg(long)]
    pub(crate) yes: bool,
    /// Go on from the last checkpoint of a run of this scene that was killed or interrupted, if there is one in the folder.
    #[arg(long)]
    pub(crate) resume: bool,
    /// Time between two checkpoints of a motion, in seconds; 30 when absent.
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub(crate) checkpoint: Option<f64>,
}

/// A pause that the clock knows.
fn seconds(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(seconds) if (0.0..=1e9).contains(&seconds) => Ok(seconds),
        _ => Err("a number of seconds from 0 to 1e9 is needed".to_owned()),
    }
}

#[derive(Debug, Args)]
#[expect(clippy::struct_excessive_bools, reason = "each is a flag of the command line")]
pub(crate) struct FitArguments {
    /// The measured stresses: a table with the columns mode, stretch (or strain) and stress, or lambda1, lambda2, P1, P2, or F and stress
    /// by components.
    pub(crate) data: PathBuf,
    /// A law: neo-hookean, mooney-rivlin, yeoh, gent, arruda-boyce, carroll, lopez-pamies, van-der-waals, extended-tube, polynomial:n,
    /// ogden:n. Without any, the usual ones. Or, of tests with lateral stretches: hyperfoam:n, holzapfel-gasser-ogden. Or, of tests along
    /// time: bergstrom-boyce, reese-govindjee, ogden-roxburgh, viscoplastic; they need the feature `history` of the program.
    #[arg(long = "law", value_name = "LAW")]
    pub(crate) laws: Vec<String>,
    /// Weights of tests, as uniaxial=2,planar=0.5; 0 holds a test out and compares the laws with it.
    #[arg(long, value_name = "TEST=WEIGHT,...")]
    pub(crate) mode_weights: Option<String>,
    /// Bounds of a parameter, as gent.Jm=60..200 or gent.Jm=60..
    #[arg(long = "bound", value_name = "LAW.PARAMETER=LEAST..GREATEST", allow_hyphen_values = true)]
    pub(crate) bounds: Vec<String>,
    /// Suppose errors of one size in all tests, instead of a part of each test's largest stress.
    #[arg(long)]
    pub(crate) equal_errors: bool,
    /// Allow unstable laws. Their instability is still reported.
    #[arg(long)]
    pub(crate) allow_unstable: bool,
    /// Use only the rows whose column has this text or number, as batch=7.
    #[arg(long, value_name = "COLUMN=VALUE")]
    pub(crate) only: Vec<String>,
    /// Leave out each test in turn and predict it from the others.
    #[arg(long)]
    pub(crate) cross_validate: bool,
    /// Write the stresses of every law up to this stretch, within the data or beyond, to predictions.csv.
    #[arg(long, value_name = "STRETCH")]
    pub(crate) to: Option<f64>,
    #[command(flatten)]
    pub(crate) intervals: IntervalArguments,
    /// Write a material card of each law for a program: abaqus, ansys, calculix, febio or ls-dyna. Needs
    /// --bulk-modulus, but for a foam.
    #[arg(long = "card", value_name = "PROGRAM")]
    pub(crate) cards: Vec<String>,
    /// The bulk modulus of the material cards, in the unit of the stresses.
    #[arg(long, value_name = "NUMBER")]
    pub(crate) bulk_modulus: Option<f64>,
    /// The density of the material cards, in the units of the model; ls-dyna needs it.
    #[arg(long, value_name = "NUMBER", requires = "bulk_modulus")]
    pub(crate) density: Option<f64>,
    /// The probability of the intervals.
    #[arg(long, value_name = "PROBABILITY", default_value_t = 0.95)]
    pub(crate) confidence: f64,
    /// Folder of the results instead of out/fit-DATA.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Print JSON to standard output.
    #[arg(long)]
    pub(crate) json: bool,
}

/// How viscometric measurements were made.
#[derive(Debug, Args)]
pub(crate) struct FlowArguments {
    /// The kind of measurement: pipe, channel, couette, plates or cone; capillary (recover only); curve (fit-flow only).
    #[arg(long)]
    pub(crate) flow: String,
    /// Radius of the pipe, the plates or the cone, as 2mm, instead of the file's.
    #[arg(long, value_name = "LENGTH")]
    pub(crate) radius: Option<String>,
    /// Half the width of the channel instead of the file's.
    #[arg(long, value_name = "LENGTH")]
    pub(crate) half_width: Option<String>,
    /// Radius of the inner cylinder instead of the file's.
    #[arg(long, value_name = "LENGTH")]
    pub(crate) inner_radius: Option<String>,
    /// Radius of the outer cylinder instead of the file's.
    #[arg(long, value_name = "LENGTH")]
    pub(crate) outer_radius: Option<String>,
    /// Distance of the plates instead of the file's.
    #[arg(long, value_name = "LENGTH")]
    pub(crate) gap: Option<String>,
    /// Angle between cone and plate, as 2deg, instead of the file's.
    #[arg(long, value_name = "ANGLE")]
    pub(crate) angle: Option<String>,
    /// Length of the pipe or channel over which the pressure falls, for tables of pressure differences.
    #[arg(long, value_name = "LENGTH")]
    pub(crate) length: Option<String>,
    /// Height of the inner cylinder, for tables of torques.
    #[arg(long, value_name = "LENGTH")]
    pub(crate) height: Option<String>,
    /// Relative standard deviation of the measured responses, as 0.02 or 2%; 0 for exact data. Estimated if absent.
    #[arg(long, value_name = "SHARE")]
    pub(crate) noise: Option<String>,
    /// Rows of a table with rising and falling sweeps that are used: rising, falling or all.
    #[arg(long, value_name = "SWEEP", default_value = "rising")]
    pub(crate) sweep: String,
    /// Use only the rows whose column has this text or number, as conc=4.
    #[arg(long, value_name = "COLUMN=VALUE")]
    pub(crate) only: Vec<String>,
    /// The probability of the band or the intervals.
    #[arg(long, value_name = "PROBABILITY", default_value_t = 0.95)]
    pub(crate) confidence: f64,
    /// Folder of the results instead of out/COMMAND-DATA.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Print JSON to standard output.
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct RecoverArguments {
    /// The measurements: CSV with units in the header and the geometry in comments, as `# radius: 2 mm`. Several files for
    /// --slip and for --flow capillary.
    #[arg(required = true)]
    pub(crate) data: Vec<PathBuf>,
    #[command(flatten)]
    pub(crate) flow: FlowArguments,
    /// Correct for slip at the walls, after Mooney: pipes of several radii, a file each.
    #[arg(long)]
    pub(crate) slip: bool,
    /// Smooth until the shear rate rises with the stress.
    #[arg(long)]
    pub(crate) rising: bool,
}

#[derive(Debug, Args)]
pub(crate) struct FitFlowArguments {
    /// The measurements: CSV with units in the header and the geometry in comments, as `# radius: 2 mm`.
    pub(crate) data: PathBuf,
    #[command(flatten)]
    pub(crate) flow: FlowArguments,
    /// A fluid: newtonian, power-law, bingham, casson, herschel-bulkley, papanastasiou, eyring, sisko, ellis, cross,
    /// carreau-yasuda. Without any, all of them but papanastasiou, which is a regularisation.
    #[arg(long = "fluid", value_name = "FLUID")]
    pub(crate) fluids: Vec<String>,
    /// Suppose errors of one size in all rows, instead of a part of each answer.
    #[arg(long)]
    pub(crate) equal_errors: bool,
    #[command(flatten)]
    pub(crate) intervals: IntervalArguments,
}

#[derive(Debug, Args)]
pub(crate) struct SolveArguments {
    /// The flow: pipe, channel, annulus, couette, plates, cone or film.
    pub(crate) flow: String,
    /// The fluid, as `bingham:yield_stress=3 Pa,plastic_viscosity=50 mPa s`, a JSON file of a fluid, or the summary.json of a fit-flow,
    /// with #NAME for one of its fluids.
    #[arg(long, value_name = "FLUID")]
    pub(crate) fluid: String,
    /// The drive or an answer, as `pressure_gradient=10 kPa/m` or `discharge=3 mL/s`.
    #[arg(long, value_name = "NAME=VALUE", allow_hyphen_values = true)]
    pub(crate) given: String,
    /// Radius of the pipe, the plates or the cone.
    #[arg(long, value_name = "LENGTH")]
    pub(crate) radius: Option<String>,
    /// Half the width of the channel.
    #[arg(long, value_name = "LENGTH")]
    pub(crate) half_width: Option<String>,
    /// Radius of the inner cylinder.
    #[arg(long, value_name = "LENGTH")]
    pub(crate) inner_radius: Option<String>,
    /// Radius of the outer cylinder.
    #[arg(long, value_name = "LENGTH")]
    pub(crate) outer_radius: Option<String>,
    /// Distance of the plates.
    #[arg(long, value_name = "LENGTH")]
    pub(crate) gap: Option<String>,
    /// Angle between cone and plate.
    #[arg(long, value_name = "ANGLE")]
    pub(crate) angle: Option<String>,
    /// Density of the film.
    #[arg(long, value_name = "DENSITY")]
    pub(crate) density: Option<String>,
    /// Inclination of the film against the horizontal.
    #[arg(long, value_name = "ANGLE")]
    pub(crate) inclination: Option<String>,
    /// Folder of the results instead of out/flow-FLOW.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Print JSON to standard output.
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct SchemaArguments {
    /// Print the reference tables of the documentation, in Markdown, instead.
    #[arg(long)]
    pub(crate) markdown: bool,
}
