//! Registers two files and writes the warped image and the displacement field beside each other.
//!
//! `cargo run --release -p piola-images --features rayon --example register_files -- FIXED MOVING elastic|fluid FOLDER [LEVELS]`
#![expect(clippy::print_stdout, reason = "an example shows what it found")]

use std::error::Error;
use std::path::Path;
use std::time::Instant;

use piola_images::{AnyPicture, DisplacementField, Picture};
use piola_registration::{Interpolant, Registration, RegistrationModel};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [fixed, moving, model, folder, levels @ ..] = &arguments[..] else {
        return Err("four arguments are needed: FIXED MOVING elastic|fluid FOLDER [LEVELS]".into());
    };
    let model = match model.as_str() {
        "elastic" => RegistrationModel::elastic(0.0, 0.05)?,
        "fluid" => RegistrationModel::viscous_fluid(0.0, 1.0)?,
        other => return Err(format!("the model `{other}`; elastic and fluid are valid").into()),
    };
    let mut method = Registration::new(model);
    if let Some(levels) = levels.first() {
        method = method.with_levels(levels.parse()?);
    }
    let folder = Path::new(folder);
    match (AnyPicture::read(fixed)?, AnyPicture::read(moving)?) {
        (AnyPicture::Plane(fixed), AnyPicture::Plane(moving)) => register(&fixed, &moving, method, folder),
        (AnyPicture::Space(fixed), AnyPicture::Space(moving)) => register(&fixed, &moving, method, folder),
        _ => Err("both images must have the same number of dimensions".into()),
    }
}

fn register<const D: usize>(
    fixed: &Picture<D>,
    moving: &Picture<D>,
    method: Registration,
    folder: &Path,
) -> Result<(), Box<dyn Error>> {
    let images = [fixed.to_image::<f64>()?, moving.to_image::<f64>()?];
    let begun = Instant::now();
    let found = method.run(&images[0], &images[1])?;
    println!("{:.3} s", begun.elapsed().as_secs_f64());
    let warped = found.map.warp(&images[1], Interpolant::Linear)?;
    moving.with_image(&warped)?.write(folder.join("warped.nii.gz"))?;
    DisplacementField::of(&found.map, fixed)?.write(folder.join("displacement.nii.gz"))?;
    Ok(())
}
