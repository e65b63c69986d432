//! The commands of viscometry.

use std::path::{Path, PathBuf};

use piola_scene::SceneError;
use piola_scene::output::{Folder, Written};
use piola_scene::rheology::{self, FlowKind, FluidName, Measured, Noise, RecoveryRequest, Request, Rise, Weighting};

use crate::Exit;
use crate::arguments::{FitFlowArguments, FlowArguments, RecoverArguments};
use crate::commands::{invalid, listing, note, print};

pub(crate) fn recover(arguments: &RecoverArguments) -> Exit {
    let flow = &arguments.flow;
    let mut request = RecoveryRequest::default();
    request.confidence = flow.confidence;
    request.noise = match arguments.noise {
        None => Noise::Estimated,
        Some(0.0) => Noise::Exact,
        Some(level) => Noise::Relative(level),
    };
    request.rise = if arguments.rising { Rise::Enforced } else { Rise::Reported };
    let prepared = load(flow).and_then(|measured| {
        let recovery = rheology::recover(&measured, &request)?;
        Ok((recovery, folder(flow, "recover", &measured)?, measured))
    });
    match prepared {
        Ok((recovery, folder, measured)) => {
            let written = recovery.write(&folder, &measured);
            let text = if flow.json { recovery.summary(&measured) } else { recovery.table(&measured) };
            show(&text, flow.json, &folder, &written);
            let whole = recovery.rows.len() == measured.rows.len();
            if !whole {
                let lost = measured.rows.len() - recovery.rows.len();
                note(&format!("error: nothing positive is recovered at {lost} rows: noise is stronger than the flow"));
            }
            if whole && written.failures.is_empty() { Exit::Done } else { Exit::Failed }
        }
        Err(error) => invalid(&error, flow.json),
    }
}

pub(crate) fn fit(arguments: &FitFlowArguments) -> Exit {
    let flow = &arguments.flow;
    let prepared = load(flow).and_then(|measured| {
        let fluids = match arguments.fluids.as_slice() {
            [] => FluidName::ALL.to_vec(),
            names => names.iter().map(|name| name.parse()).collect::<Result<_, _>>()?,
        };
        let mut request = Request::of(fluids);
        request.confidence = flow.confidence;
        if arguments.equal_errors {
            request.weighting = Weighting::Equal;
        }
        let comparison = rheology::compare(&measured, &request)?;
        if let (None, Some((_, refused))) = (comparison.fits().next(), comparison.refusals().next()) {
            return Err(refused.clone().into());
        }
        Ok((comparison, folder(flow, "fit-flow", &measured)?, measured))
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
        Err(error) => invalid(&error, flow.json),
    }
}

fn load(arguments: &FlowArguments) -> Result<Measured, SceneError> {
    let kind: FlowKind = arguments.flow.parse()?;
    let given = [
        ("radius", &arguments.radius),
        ("half_width", &arguments.half_width),
        ("inner_radius", &arguments.inner_radius),
        ("outer_radius", &arguments.outer_radius),
    ];
    let lengths: Vec<(String, String)> =
        given.into_iter().filter_map(|(name, value)| Some((name.to_owned(), value.clone()?))).collect();
    Measured::load(&arguments.data, kind, &lengths)
}

fn folder(arguments: &FlowArguments, command: &str, measured: &Measured) -> Result<Folder, SceneError> {
    let beside: PathBuf = Path::new("out").join(format!("{command}-{}", measured.name()));
    Folder::prepare(arguments.out.as_ref().unwrap_or(&beside))
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
