//! The commands of viscometry.

use std::path::{Path, PathBuf};

use piola_charts::{Folder, Written};
use piola_measured::MeasuredError;
use piola_measured::rheology::{self, FlowKind, FluidName, Measured, Noise, RecoveryRequest, Request, Rise, Weighting};

use crate::Exit;
use crate::arguments::{FitFlowArguments, FlowArguments, RecoverArguments};
use crate::commands::{listing, note, print, refused};

pub(crate) fn recover(arguments: &RecoverArguments) -> Exit {
    let flow = &arguments.flow;
    let mut request = RecoveryRequest::default();
    request.confidence = flow.confidence;
    request.noise = noise(flow);
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
        Ok((recovery, folder(flow, "recover", &first)?, tables))
    });
    match prepared {
        Ok((recovery, folder, tables)) => {
            let written = recovery.write(&folder, &tables);
            let text = if flow.json { recovery.summary(&tables) } else { recovery.table(&tables) };
            show(&text, flow.json, &folder, &written);
            let lost = recovery.lost();
            if 0 < lost {
                note(&format!(
                    "error: no positive value was recovered at {lost} of the rows: the noise is stronger than the flow"
                ));
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
    let prepared = load(&arguments.data, flow).and_then(|measured| {
        let fluids = match arguments.fluids.as_slice() {
            [] => FluidName::ALL.to_vec(),
            names => names.iter().map(|name| name.parse()).collect::<Result<_, _>>()?,
        };
        let mut request = Request::of(fluids);
        request.confidence = flow.confidence;
        request.noise = noise(flow);
        if arguments.equal_errors {
            request.weighting = Weighting::Equal;
        }
        let comparison = rheology::compare(&measured, &request)?;
        if let (None, Some((_, refused))) = (comparison.fits().next(), comparison.refusals().next()) {
            return Err(refused.clone().into());
        }
        Ok((comparison, folder(flow, "fit-flow", &measured.name())?, measured))
    });
    match prepared {
        Ok((comparison, folder, measured)) => {
            let written = comparison.write(&folder, &measured);
            let text = if flow.json { comparison.summary(&measured) } else { comparison.table(&measured) };
            show(&text, flow.json, &folder, &written);
            for (fluid, refusal) in comparison.refusals() {
                note(&format!("error: {fluid}: {refusal}"));
            }
            if comparison.is_complete() && written.failures.is_empty() { Exit::Done } else { Exit::Failed }
        }
        Err(error) => refused(&error, flow.json),
    }
}

fn noise(arguments: &FlowArguments) -> Noise {
    match arguments.noise {
        None => Noise::Estimated,
        Some(0.0) => Noise::Exact,
        Some(level) => Noise::Relative(level),
    }
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
    ];
    let sizes: Vec<(String, String)> =
        given.into_iter().filter_map(|(name, value)| Some((name.to_owned(), value.clone()?))).collect();
    Measured::load(path, kind, &sizes)
}

fn folder(arguments: &FlowArguments, command: &str, name: &str) -> Result<Folder, MeasuredError> {
    let beside: PathBuf = Path::new("out").join(format!("{command}-{name}"));
    Ok(Folder::prepare(arguments.out.as_ref().unwrap_or(&beside))?)
}

fn show(text: &str, json: bool, folder: &Folder, written: &Written) {
    print(text);
    if !json {
        print(&listing(folder, written));
    }
    for failure in &written.failures {
        note(&format!("error: {failure}"));
    }
}
