//! The commands of viscometry.

use core::fmt::Display;
use core::ops::ControlFlow;
use std::path::{Path, PathBuf};

use piola_charts::{Folder, Written};
use piola_forward::{FlowRequest, ForwardError};
use piola_measured::MeasuredError;
use piola_measured::comparison::{Comparison, Judged, Watch};
use piola_measured::rheology::{
    self, FlowKind, FluidModel, Measured, Noise, Reading, RecoveryRequest, Request, Rise, Weighting,
};

use crate::Exit;
use crate::arguments::{FitFlowArguments, FlowArguments, RecoverArguments, SolveArguments};
use crate::commands::{listing, note, print, refused, refused_forward};
use crate::interrupt::Interrupt;
use crate::progress::ProgressLine;

pub(crate) fn recover(arguments: &RecoverArguments) -> Exit {
    let flow = &arguments.flow;
    let mut request = RecoveryRequest::default();
    request.confidence = flow.confidence;
    request.noise = match noise(flow) {
        Ok(noise) => noise,
        Err(error) => return refused(&error, flow.json),
    };
    request.rise = if arguments.rising { Rise::Enforced } else { Rise::Reported };
    let load_all = || arguments.data.iter().map(|path| load(path, flow)).collect::<Result<Vec<_>, _>>();
    let prepared = load_all().and_then(|tables| {
        let recovery = match tables.as_slice() {
            tables if arguments.slip => rheology::recover_without_slip(tables, &request)?,
            [single] => rheology::recover(single, &request)?,
            several => rheology::recover_without_ends(several, &request)
                .map_err(|error| if flow.flow == "capillary" { error } else { too_many(several) })?,
        };
        let first = tables.first().map(Measured::name).unwrap_or_default();
        Ok((recovery, Folder::prepare(&out(flow.out.as_deref(), "recover", &first))?, tables))
    });
    match prepared {
        Ok((recovery, folder, tables)) => {
            let written = recovery.write(&folder, &tables);
            let text = if flow.json { recovery.summary(&tables) } else { recovery.table(&tables) };
            show(&text, flow.json, &folder, &written);
            let lost = recovery.lost();
            if 0 < lost {
                let why = recovery.why_lost().unwrap_or_default();
                note(&format!("error: nothing is known at {lost} of the rows: {why}"));
            }
            if lost == 0 && written.failures.is_empty() { Exit::Done } else { Exit::Failed }
        }
        Err(error) => refused(&error, flow.json),
    }
}

/// Several tables of a flow that takes one.
fn too_many(tables: &[Measured]) -> MeasuredError {
    let argument = format!("{} files", tables.len());
    MeasuredError::Argument { argument, valid: "one file, or several with --slip or --flow capillary" }
}

pub(crate) fn fit(arguments: &FitFlowArguments) -> Exit {
    let flow = &arguments.flow;
    let interrupt = Interrupt::listen();
    let prepared = load(&arguments.data, flow).and_then(|measured| {
        let fluids = match arguments.fluids.as_slice() {
            [] => FluidModel::usual(),
            names => names.iter().map(|name| name.parse()).collect::<Result<_, _>>()?,
        };
        let mut request = Request::of(fluids);
        request.confidence = flow.confidence;
        request.noise = noise(flow)?;
        if arguments.equal_errors {
            request.weighting = Weighting::Equal;
        }
        request.intervals = arguments.intervals.kind()?;
        let found = watched(&measured.name(), &interrupt, |watch| rheology::compare_until(&measured, &request, watch))?;
        Ok((measured, found))
    });
    match prepared {
        Ok((measured, found)) => {
            let results = Results {
                table: &|| found.table(&measured),
                summary: &|| found.summary(&measured),
                write: &|folder| found.write(folder, &measured),
            };
            let out = out(flow.out.as_deref(), "fit-flow", &measured.name());
            finished(&found, &results, &out, (flow.json, !arguments.fluids.is_empty()))
        }
        Err(error) => refused(&error, flow.json),
    }
}

pub(crate) fn solve(arguments: &SolveArguments) -> Exit {
    let prepared = piola_forward::fluid(&arguments.fluid).and_then(|fluid| {
        let Some((name, value)) = arguments.given.split_once('=') else {
            return Err(ForwardError::Argument {
                argument: format!("--given {}", arguments.given),
                valid: "NAME=VALUE, as 'discharge=3 mL/s'",
            });
        };
        let sizes = [
            ("radius", &arguments.radius),
            ("half_width", &arguments.half_width),
            ("inner_radius", &arguments.inner_radius),
            ("outer_radius", &arguments.outer_radius),
            ("gap", &arguments.gap),
            ("angle", &arguments.angle),
            ("density", &arguments.density),
            ("inclination", &arguments.inclination),
        ];
        let sizes: Vec<(&str, &str)> =
            sizes.into_iter().filter_map(|(name, value)| Some((name, value.as_deref()?))).collect();
        let request = FlowRequest::new(&arguments.flow, fluid, &sizes, (name.trim(), value.trim()));
        let solved = piola_forward::solve(&request)?;
        let beside = || Path::new("out").join(format!("flow-{}", arguments.flow));
        let folder = Folder::prepare(&arguments.out.clone().unwrap_or_else(beside))?;
        Ok((solved, folder))
    });
    match prepared {
        Ok((solved, folder)) => {
            let written = solved.write(&folder);
            let text = if arguments.json { solved.summary() } else { format!("{}\n", solved.table()) };
            show(&text, arguments.json, &folder, &written);
            if written.failures.is_empty() { Exit::Done } else { Exit::Failed }
        }
        Err(error) => refused_forward(&error, arguments.json),
    }
}

/// Runs a comparison with a line of progress; a signal ends it.
pub(crate) fn watched<T>(name: &str, interrupt: &Interrupt, run: impl FnOnce(Watch<'_>) -> T) -> T {
    /// Evaluations between two looks at the clock.
    const STRIDE: u64 = 16;
    let mut progress = ProgressLine::new(name, STRIDE);
    let result = run(&mut |fraction| {
        progress.update(fraction);
        if interrupt.asked() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    progress.finish();
    result
}

/// The results of a comparison: a table for a reader, `summary.json`, and all files.
pub(crate) struct Results<'r> {
    pub(crate) table: &'r dyn Fn() -> String,
    pub(crate) summary: &'r dyn Fn() -> String,
    pub(crate) write: &'r dyn Fn(&Folder) -> Written,
}

/// Shows and writes the results of a comparison. Where no model has a fit, it is refused for the reason of the first model.
pub(crate) fn finished<M: Copy + PartialEq + Display, F: Judged, E: Clone + Display>(
    comparison: &Comparison<M, F, E>,
    results: &Results<'_>,
    out: &Path,
    (json, are_named): (bool, bool),
) -> Exit
where
    MeasuredError: From<E>,
{
    if let (None, Some((_, why))) = (comparison.fits().next(), comparison.refusals().next()) {
        return refused(&why.clone().into(), json);
    }
    let folder = match Folder::prepare(out) {
        Ok(folder) => folder,
        Err(error) => return refused(&error.into(), json),
    };
    let written = (results.write)(&folder);
    let text = if json { (results.summary)() } else { (results.table)() };
    show(&text, json, &folder, &written);
    settled(comparison, comparison.is_complete(), &comparison.refusals_in_words(), are_named, &written)
}

/// The exit of a comparison. Models that nobody named do not decide it, unless one of them is the best.
pub(crate) fn settled<M: Copy + PartialEq, F: Judged, E>(
    comparison: &Comparison<M, F, E>,
    is_complete: bool,
    refusals: &[String],
    are_named: bool,
    written: &Written,
) -> Exit {
    let word = if are_named { "error" } else { "note" };
    for refusal in refusals {
        note(&format!("{word}: {refusal}"));
    }
    if comparison.interrupted {
        note("interrupted: what was fitted until then is written");
    } else if are_named && !is_complete && refusals.is_empty() {
        note("error: the search of a model that was named did not converge");
    } else if !comparison.is_settled() {
        note("error: no search of a best model converged");
    }
    let is_settled = if are_named { is_complete } else { comparison.is_settled() };
    if is_settled && written.failures.is_empty() { Exit::Done } else { Exit::Failed }
}

fn noise(arguments: &FlowArguments) -> Result<Noise, MeasuredError> {
    /// Beyond this noise nothing is measured.
    const MOST: f64 = 1.0;
    let Some(text) = &arguments.noise else { return Ok(Noise::Estimated) };
    let (number, unit) = text.trim().strip_suffix('%').map_or((text.trim(), 1.0), |number| (number.trim(), 100.0));
    match number.parse::<f64>().map(|x| x / unit) {
        Ok(level) if 0.0 < level && level <= MOST => Ok(Noise::Relative(level)),
        Ok(level) if level.abs() <= 0.0 => Ok(Noise::Exact),
        _ => Err(MeasuredError::Argument {
            argument: format!("--noise {text}"),
            valid: "a share from 0 to 1, as 0.02 or 2%",
        }),
    }
}

/// `COLUMN=VALUE`.
pub(crate) fn only(texts: &[String]) -> Result<Vec<(String, String)>, MeasuredError> {
    let pair = |text: &String| {
        let (column, value) = text.split_once('=')?;
        Some((column.trim().to_owned(), value.trim().to_owned()))
    };
    let wrong = |text: &String| MeasuredError::Argument {
        argument: format!("--only {text}"),
        valid: "COLUMN=VALUE, as conc=4",
    };
    texts.iter().map(|text| pair(text).ok_or_else(|| wrong(text))).collect()
}

fn load(path: &Path, arguments: &FlowArguments) -> Result<Measured, MeasuredError> {
    let kind: FlowKind = arguments.flow.parse()?;
    let given = [
        ("radius", &arguments.radius),
        ("half_width", &arguments.half_width),
        ("inner_radius", &arguments.inner_radius),
        ("outer_radius", &arguments.outer_radius),
        ("gap", &arguments.gap),
        ("angle", &arguments.angle),
        ("length", &arguments.length),
        ("height", &arguments.height),
    ];
    let mut reading = Reading::default();
    reading.sizes = given.into_iter().filter_map(|(name, value)| Some((name.to_owned(), value.clone()?))).collect();
    reading.sweep = arguments.sweep.parse()?;
    reading.only = only(&arguments.only)?;
    Measured::load_as(path, kind, &reading)
}

/// The folder that is given, or out/COMMAND-NAME.
pub(crate) fn out(given: Option<&Path>, command: &str, name: &str) -> PathBuf {
    given.map_or_else(|| Path::new("out").join(format!("{command}-{name}")), Path::to_owned)
}

pub(crate) fn show(text: &str, json: bool, folder: &Folder, written: &Written) {
    print(text);
    if !json {
        print(&listing(folder, written));
    }
    for failure in &written.failures {
        note(&format!("error: {failure}"));
    }
}
