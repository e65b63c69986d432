//! The command `register`: images from files, a registration, its results in a folder.

mod arguments;
mod drawing;
mod figures;
mod results;

pub(crate) use arguments::RegisterArguments;

use core::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::Instant;

use piola_images::{AnyPicture, ImagesError, Picture};
use piola_registration::{Precision, RegistrationEnding, RegistrationError, RegistrationProgress};

use crate::Exit;
use crate::commands::{note, print};
use crate::interrupt::Interrupt;
use crate::progress::ProgressLine;
use results::{Outcome, Results};

pub(crate) fn register(arguments: &RegisterArguments) -> Exit {
    let done = match pair(arguments) {
        Ok(Pair::Plane(pictures)) => with_precision(arguments, &pictures),
        Ok(Pair::Space(pictures)) => with_precision(arguments, &pictures),
        Err(why) => Err(why),
    };
    done.unwrap_or_else(|why| {
        if arguments.json {
            print(&format!("{:#}\n", serde_json::json!({ "valid": false, "error": why })));
        } else {
            note(&format!("error: {why}"));
        }
        Exit::Invalid
    })
}

/// The fixed and the moving picture.
enum Pair {
    Plane([Picture<2>; 2]),
    Space([Picture<3>; 2]),
}

fn pair(arguments: &RegisterArguments) -> Result<Pair, String> {
    let read = |path: &Path| AnyPicture::read(path).map_err(said);
    match (read(&arguments.fixed)?, read(&arguments.moving)?) {
        (AnyPicture::Plane(fixed), AnyPicture::Plane(moving)) => Ok(Pair::Plane(placed(arguments, fixed, moving)?)),
        (AnyPicture::Space(fixed), AnyPicture::Space(moving)) => Ok(Pair::Space(placed(arguments, fixed, moving)?)),
        _ => Err(format!(
            "`{}` and `{}`: one has two dimensions, the other three; both must have the same",
            arguments.fixed.display(),
            arguments.moving.display()
        )),
    }
}

/// Both pictures on one grid.
fn placed<const D: usize>(
    arguments: &RegisterArguments,
    mut fixed: Picture<D>,
    mut moving: Picture<D>,
) -> Result<[Picture<D>; 2], String> {
    for (path, picture) in [(&arguments.fixed, &mut fixed), (&arguments.moving, &mut moving)] {
        if picture.is_luminance() {
            note(&format!("`{}` has colours: their luminance is registered", path.display()));
        }
        if let Some(spacing) = arguments.spacing {
            let name = path.to_string_lossy().to_lowercase();
            if [".png", ".tif", ".tiff"].iter().any(|ending| name.ends_with(ending)) {
                *picture = picture.clone().with_spacing([spacing; D]).map_err(said)?;
            }
        }
    }
    if arguments.resample {
        moving = moving.resampled(&fixed).map_err(said)?;
    }
    let (sizes, others) = (fixed.sizes(), moving.sizes());
    if sizes != others {
        return Err(format!(
            "the fixed image has sizes {sizes:?}, the moving one {others:?}; both must have the same, or be brought \
             onto one grid by --resample"
        ));
    }
    let apart = fixed.distance_of_corners(&moving);
    let least = fixed.spacing().into_iter().fold(f64::INFINITY, f64::min);
    if 0.01 * least < apart {
        return Err(format!(
            "the headers place the two images up to {apart:.3} mm apart; --resample brings the moving image onto the \
             grid of the fixed one"
        ));
    }
    Ok([fixed, moving])
}

fn with_precision<const D: usize>(arguments: &RegisterArguments, pictures: &[Picture<D>; 2]) -> Result<Exit, String> {
    if arguments.single { run::<D, f32>(arguments, pictures) } else { run::<D, f64>(arguments, pictures) }
}

fn run<const D: usize, T: Precision>(
    arguments: &RegisterArguments,
    pictures: &[Picture<D>; 2],
) -> Result<Exit, String> {
    let [fixed, moving] = [pictures[0].to_image::<T>().map_err(said)?, pictures[1].to_image::<T>().map_err(said)?];
    let method = arguments.method().map_err(refused)?;
    let before = arguments.similarity().of(&fixed, &moving).map_err(refused)?;
    let folder = folder(arguments);
    prepare(&folder)?;

    let interrupt = Interrupt::listen();
    let mut progress = ProgressLine::new("register", 1);
    let begun = Instant::now();
    let found = method.run_observed(&fixed, &moving, |state| {
        progress.update(fraction::<D>(state, arguments.steps));
        if interrupt.asked() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    progress.finish();
    let found = found.map_err(refused)?;
    let seconds = begun.elapsed().as_secs_f64();

    let warped = found.map.warp(&moving, arguments.interpolant()).map_err(refused)?;
    let after = arguments.similarity().of(&fixed, &warped).map_err(refused)?;
    let inverse = found.inverse();
    let failure = inverse.as_ref().err().map(ToString::to_string);
    let outcome = Outcome {
        arguments,
        pictures,
        found: &found,
        warped: &warped,
        inverse: inverse.ok(),
        measures: [before, after],
        seconds,
    };
    let mut results = Results::new(&folder);
    outcome.write(&mut results);
    if arguments.json {
        print(&outcome.summary());
    } else {
        print(&outcome.table());
        print(&results.listing());
    }
    for failure in results.failures.iter().chain(&failure) {
        note(&format!("error: {failure}"));
    }
    let is_whole = results.failures.is_empty() && failure.is_none();
    if found.ending() == RegistrationEnding::Interrupted {
        note(&format!("interrupted: what was found until then is in {}", folder.display()));
        return Ok(Exit::Failed);
    }
    Ok(if is_whole { Exit::Done } else { Exit::Failed })
}

/// The share of the work that is done if every level takes all its steps.
fn fraction<const D: usize>(state: RegistrationProgress, steps: usize) -> f64 {
    let work = |level: usize| 0.5_f64.powi(i32::try_from(D * level).unwrap_or(i32::MAX));
    let before: f64 = (state.level + 1..state.levels).map(work).sum();
    let whole: f64 = (0..state.levels).map(work).sum();
    (before + work(state.level) * state.step as f64 / steps.max(1) as f64) / whole
}

fn folder(arguments: &RegisterArguments) -> PathBuf {
    arguments.out.clone().unwrap_or_else(|| {
        let name = arguments.moving.file_name().unwrap_or_default().to_string_lossy();
        let stem = name.split('.').next().unwrap_or_default();
        Path::new("out").join(format!("register-{stem}"))
    })
}

/// Makes the folder and tries to write into it, before the run.
fn prepare(folder: &Path) -> Result<(), String> {
    let unwritable = |cause: String| format!("cannot write to the output folder `{}`: {cause}", folder.display());
    std::fs::create_dir_all(folder).map_err(|cause| unwritable(cause.to_string()))?;
    let trial = folder.join(format!(".trial.{}", std::process::id()));
    std::fs::write(&trial, b"trial").map_err(|cause| unwritable(cause.to_string()))?;
    std::fs::remove_file(&trial).map_err(|cause| unwritable(cause.to_string()))
}

#[expect(clippy::needless_pass_by_value, reason = "for `map_err`")]
fn said(error: ImagesError) -> String {
    error.to_string()
}

#[expect(clippy::needless_pass_by_value, reason = "for `map_err`")]
fn refused(error: RegistrationError) -> String {
    error.to_string()
}
