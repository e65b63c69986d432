//! The command `sweep`.

use core::ops::ControlFlow;
use std::path::{Path, PathBuf};

use piola_charts::Folder;
use piola_ensemble::{
    Ensemble, EnsembleError, Options, Portion, Ranks, Results, agree, compute_across, predicted_cost,
};
use piola_scene::{Document, SceneError};

use crate::arguments::SweepArguments;
use crate::commands::{MOST_SECONDS, failure, listing, note, print};
use crate::interrupt::Interrupt;
use crate::progress::ProgressLine;
use crate::{Exit, html};

pub(crate) fn sweep(arguments: &SweepArguments, ranks: &dyn Ranks) -> Exit {
    if arguments.parquet && cfg!(not(feature = "parquet")) {
        return refused(ranks);
    }
    let interrupt = Interrupt::listen();
    let prepared = prepare(arguments, ranks);
    let agreed = agree(ranks, prepared.as_ref().map(|prepared| &prepared.0).map_err(ToString::to_string));
    let (ensemble, folder, options) = match prepared.and_then(|prepared| agreed.map(|()| prepared)) {
        Ok(prepared) => prepared,
        Err(error) => {
            if ranks.rank() == 0 {
                failure(&error, arguments.scene.json);
            }
            return Exit::Invalid;
        }
    };
    let Some(folder) = folder else {
        // Process 0 tells what there is to tell.
        let computed = compute_across(&ensemble, Path::new(""), options, ranks, |_| ControlFlow::Continue(()));
        return if computed.is_ok() { Exit::Done } else { Exit::Failed };
    };
    let mut progress = ProgressLine::new("sweep", 1);
    let computed = compute_across(&ensemble, folder.path(), options, ranks, |share| {
        progress.update(share);
        if interrupt.asked() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    progress.finish();
    let collected = computed.and_then(|computed| {
        if computed.interrupted {
            return Ok((computed, None));
        }
        match Results::collect(&ensemble, folder.path()) {
            Ok(results) => Ok((computed, Some(results))),
            // Other parts are still computing.
            Err(EnsembleError::Missing { .. }) if options.part != Portion::WHOLE => Ok((computed, None)),
            Err(error) => Err(error),
        }
    });
    match collected {
        Ok((_, Some(results))) => {
            let parquet = match parquet(arguments, &results) {
                Ok(content) => content.map(|content| ("members.parquet", content)),
                Err(error) => {
                    failure(&error, arguments.scene.json);
                    return Exit::Failed;
                }
            };
            let mut written = results.write_with(&folder, parquet);
            if arguments.report {
                let title = format!("Sweep of {}", arguments.scene.scene.display());
                html::add(&arguments.scene, &title, &[("Results", results.report())], (&folder, &mut written));
            }
            if arguments.scene.json {
                print(&results.summary());
            } else {
                print(&format!("{}\n", results.report()));
                print(&listing(&folder, &written));
            }
            for failure in &written.failures {
                note(&format!("error: {failure}"));
            }
            if written.failures.is_empty() { Exit::Done } else { Exit::Failed }
        }
        Ok((computed, None)) if computed.interrupted => {
            let done = computed.kept + computed.computed;
            note(&format!("interrupted after {done} members; the same command with --resume goes on"));
            Exit::Failed
        }
        Ok((computed, None)) => {
            note(&format!("{} members of this part are done; other parts are not", computed.kept + computed.computed));
            Exit::Done
        }
        Err(error) => {
            failure(&error, arguments.scene.json);
            Exit::Failed
        }
    }
}

/// Without the feature.
fn refused(ranks: &dyn Ranks) -> Exit {
    if ranks.rank() == 0 {
        note(
            "error: this program is built without Parquet; build it with the feature `parquet`:\n\
             cargo run --release --features parquet -- sweep SCENE --vary PATH=FROM:TO:COUNT --parquet",
        );
    }
    Exit::Invalid
}

/// The bytes of `members.parquet`, if it is asked for.
#[cfg(feature = "parquet")]
fn parquet(arguments: &SweepArguments, results: &Results<'_>) -> Result<Option<Vec<u8>>, EnsembleError> {
    arguments.parquet.then(|| results.parquet()).transpose()
}

#[cfg(not(feature = "parquet"))]
#[expect(clippy::unnecessary_wraps, reason = "as with the feature")]
const fn parquet(_: &SweepArguments, _: &Results<'_>) -> Result<Option<Vec<u8>>, EnsembleError> {
    Ok(None)
}

/// The ensemble, the folder of process 0, and how to compute.
fn prepare(
    arguments: &SweepArguments,
    ranks: &dyn Ranks,
) -> Result<(Ensemble, Option<Folder>, Options), EnsembleError> {
    let ranges = arguments.ranges.iter().map(|text| text.parse()).collect::<Result<Vec<_>, _>>()?;
    let random = arguments.random.iter().map(|text| text.parse()).collect::<Result<Vec<_>, _>>()?;
    let path = &arguments.scene.scene;
    let document = Document::read_with(path, &arguments.scene.settings).map_err(SceneError::from)?;
    let ensemble = Ensemble::new(document, ranges, random, arguments.members, arguments.seed)?;
    let mut options = Options::default();
    if let Some(threads) = arguments.threads {
        options = options.with_threads(threads);
    }
    if let Some(part) = &arguments.part {
        options = options.with_part(part.parse()?);
    }
    if arguments.resume {
        options = options.with_resume();
    }
    if ranks.rank() != 0 {
        return Ok((ensemble, None, options));
    }
    let cores = options.threads.or_else(|| std::thread::available_parallelism().ok().map(usize::from)).unwrap_or(1)
        * ranks.count();
    let cost = predicted_cost(&ensemble, options.part)?;
    if let Some(seconds) = cost.seconds
        && !arguments.yes
        && MOST_SECONDS < seconds / cores as f64
    {
        let argument = format!("a sweep of about {:.1} days on {cores} cores", seconds / cores as f64 / MOST_SECONDS);
        return Err(EnsembleError::Argument { argument, valid: "less than a day, or --yes" });
    }
    note(&cost.to_string());
    let name = path.file_stem().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let beside: PathBuf = Path::new("out").join(format!("sweep-{name}"));
    let folder = Folder::prepare(arguments.out.as_ref().unwrap_or(&beside))?;
    Ok((ensemble, Some(folder), options))
}
