//! What a registration leaves: pictures, fields, figures, a summary and a table.

use core::fmt::Write as _;
use std::path::{Path, PathBuf};

use piola_images::{DisplacementField, ImagesError, Picture, SampleType, write_npy, write_whole};
use piola_registration::{DisplacementMap, Image, Precision, Registered, RegistrationEnding};
use serde_json::json;

use super::arguments::RegisterArguments;
use super::figures::Figures;

/// The files that were written, and the errors of those that could not be.
pub(super) struct Results<'f> {
    folder: &'f Path,
    names: Vec<String>,
    pub(super) failures: Vec<String>,
}

impl<'f> Results<'f> {
    pub(super) fn new(folder: &'f Path) -> Self {
        Self { folder, names: Vec::new(), failures: Vec::new() }
    }

    /// One file; an error does not keep the others from being written.
    fn write(&mut self, name: &str, write: impl FnOnce(PathBuf) -> Result<(), ImagesError>) {
        match write(self.folder.join(name)) {
            Ok(()) => self.names.push(name.to_owned()),
            Err(error) => self.failures.push(error.to_string()),
        }
    }

    pub(super) fn listing(&self) -> String {
        format!("written to {}: {}\n", self.folder.display(), self.names.join(", "))
    }
}

/// A finished or interrupted registration.
pub(super) struct Outcome<'r, const D: usize, T> {
    pub(super) arguments: &'r RegisterArguments,
    pub(super) pictures: &'r [Picture<D>; 2],
    pub(super) found: &'r Registered<D, T>,
    pub(super) warped: &'r Image<D, T>,
    pub(super) inverse: Option<DisplacementMap<D, T>>,
    /// Before and after.
    pub(super) measures: [f64; 2],
    pub(super) seconds: f64,
}

impl<const D: usize, T: Precision> Outcome<'_, D, T> {
    pub(super) fn write(&self, results: &mut Results<'_>) {
        let [fixed, moving] = self.pictures;
        let warped = moving.with_image(self.warped);
        let name = format!("warped{}", ending(&self.arguments.moving));
        results.write(&name, |path| warped.and_then(|picture| picture.write(path)));
        let maps = [("displacement", Some(&self.found.map)), ("inverse", self.inverse.as_ref())];
        for (name, map) in maps.into_iter().filter_map(|(name, map)| Some((name, map?))) {
            let field = DisplacementField::of(map, fixed);
            for ending in ["nii.gz", "npy"] {
                let field = field.clone();
                results.write(&format!("{name}.{ending}"), |path| field.and_then(|field| field.write(path)));
            }
        }
        let jacobian = self.found.map.jacobian();
        let values: Vec<_> = jacobian.values().iter().map(|value| value.primal(0)).collect();
        results.write("jacobian.npy", |path| write_npy(path, &fixed.sizes(), &values));
        let picture = fixed.with_values(values).map(|picture| picture.with_sample_type(SampleType::F32));
        results.write("jacobian.nii.gz", |path| picture.and_then(|picture| picture.write(path)));
        let figures = Figures::of(self.pictures, self.warped, &self.found.map, self.inverse.as_ref());
        for (name, content) in figures.files() {
            results.write(&name, |path| content.and_then(|content| write_whole(path, &content)));
        }
        results.write("summary.json", |path| write_whole(path, self.summary().as_bytes()));
    }

    fn status(&self) -> &'static str {
        match self.found.ending() {
            RegistrationEnding::Converged => "converged",
            RegistrationEnding::NoFurtherDecrease => "no step decreases the measure further",
            RegistrationEnding::StepsTaken => "all steps taken",
            RegistrationEnding::Interrupted => "interrupted",
            _ => "ended",
        }
    }

    /// The largest |h(g(x)) − x| at samples and the largest |g(h(x)) − x|, mm.
    fn consistency(&self) -> Option<[f64; 2]> {
        let inverse = self.inverse.as_ref()?;
        let there = self.found.map.after(inverse).ok()?;
        let back = inverse.after(&self.found.map).ok()?;
        Some([there.largest_displacement(), back.largest_displacement()])
    }

    pub(super) fn summary(&self) -> String {
        let levels: Vec<_> = self
            .found
            .levels
            .iter()
            .map(|level| json!({ "sizes": level.grid.sizes().to_vec(), "steps": level.steps, "measure": level.measures, "regriddings": level.regriddings }))
            .collect();
        let [fixed, moving] = [&self.arguments.fixed, &self.arguments.moving].map(|path| path.display().to_string());
        let consistency = self.consistency();
        let summary = json!({
            "status": self.status(),
            "fixed": fixed,
            "moving": moving,
            "sizes": self.pictures[0].sizes().to_vec(),
            "spacing_mm": self.pictures[0].spacing().to_vec(),
            "model": self.arguments.model_name(),
            "symmetric": self.arguments.symmetric,
            "measure": self.arguments.measure_name(),
            "measure_before": self.measures[0],
            "measure_after": self.measures[1],
            "largest_displacement_mm": self.found.map.largest_displacement(),
            "least_jacobian": self.found.map.least_jacobian(),
            "inverse_error_mm": consistency.map(|[there, _]| there),
            "inverse_error_between_samples_mm": consistency.map(|[_, back]| back),
            "seconds": self.seconds,
            "levels": levels,
        });
        format!("{summary:#}\n")
    }

    pub(super) fn table(&self) -> String {
        let mut text = String::new();
        let sizes = self.pictures[0].sizes().map(|size| size.to_string()).join(" x ");
        let symmetric = if self.arguments.symmetric { ", symmetric" } else { "" };
        let steps: usize = self.found.levels.iter().map(|level| level.steps).sum();
        let _ = writeln!(
            text,
            "{sizes} samples, {}{symmetric}: {} steps on {} levels, {:.2} s, {}\n",
            self.arguments.model_name(),
            steps,
            self.found.levels.len(),
            self.seconds,
            self.status()
        );
        let mut line = |name: &str, value: String| {
            let _ = writeln!(text, "{name:<44}{value:>14}");
        };
        line(&format!("{}, before", self.arguments.measure_name()), format!("{:.5}", self.measures[0]));
        line(&format!("{}, after", self.arguments.measure_name()), format!("{:.5}", self.measures[1]));
        line("largest displacement, mm", format!("{:.4}", self.found.map.largest_displacement()));
        line("least Jacobian", format!("{:.4}", self.found.map.least_jacobian()));
        match self.consistency() {
            Some([there, back]) => {
                line("error of the inverse at samples, mm", format!("{there:.1e}"));
                line("error of the inverse between samples, mm", format!("{back:.1e}"));
            }
            None => line("inverse", "none".into()),
        }
        text.push('\n');
        text
    }
}

/// The end of the name that says the format.
fn ending(path: &Path) -> String {
    let name = path.file_name().unwrap_or_default().to_string_lossy().to_lowercase();
    let known = [".nii.gz", ".nii", ".nrrd", ".tiff", ".tif", ".png"];
    known.into_iter().find(|ending| name.ends_with(ending)).unwrap_or(".nii.gz").to_owned()
}
