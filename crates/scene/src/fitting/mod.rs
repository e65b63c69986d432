//! Parameters of laws from tables of measured stresses: files in, comparison of laws, tables and figures out.
//!
//! | stage | item |
//! |---|---|
//! | read | [`Measurements::load`]: a CSV table, every mistake with its line |
//! | ask | [`Request`]: laws, weights, bounds, stability |
//! | fit | [`compare`]: each law on the same data, by [`piola_fit::solids`] |
//! | write | [`write()`]: `summary.json`, `curves.csv`, `residuals.csv`, `fit.svg` |

mod figure;
pub(crate) mod layout;
mod mistake;
mod request;
mod tables;

pub use mistake::{TableMistake, TableReport};
pub use request::{LawBounds, Request};

pub use piola_fit::solids::{Estimate, Fit, Stability, State, Weighting};

use std::path::{Path, PathBuf};

use piola_fit::FitError;
use piola_fit::solids::{AnyModel, Data, fit};

use crate::SceneError;
use crate::output::{Folder, Written};

/// Measured stresses of one material.
///
/// # Example
/// ```
/// use piola_scene::fitting::Measurements;
/// let text = "mode,stretch,stress_MPa\nuniaxial,1.5,0.4\nuniaxial,2.0,0.6\nplanar,1.5,0.5\n";
/// let measurements = Measurements::parse("rubber.csv", text)?;
/// assert_eq!(measurements.unit.as_deref(), Some("MPa"));
/// assert_eq!(measurements.data.tests()[0].len(), 2);
/// let wrong = Measurements::parse("rubber.csv", "mode,stretch,stress\nuniaxial,-1.5,0.4\n");
/// assert!(wrong.unwrap_err().to_string().starts_with("rubber.csv:2: "));
/// # Ok::<(), piola_scene::SceneError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Measurements {
    /// The file.
    pub path: PathBuf,
    /// The unit of the stresses, as the file names it.
    pub unit: Option<String>,
    /// The numbers.
    pub data: Data,
}

impl Measurements {
    /// Reads a file.
    ///
    /// # Errors
    /// [`SceneError::Unreadable`], [`SceneError::TooLarge`], [`SceneError::NotText`]; [`SceneError::Table`] with every
    /// mistake and its line.
    pub fn load(path: &Path) -> Result<Self, SceneError> {
        Self::parse(path, &layout::read(path)?)
    }

    /// Reads the text of a file.
    ///
    /// # Errors
    /// [`SceneError::Table`].
    pub fn parse(path: impl Into<PathBuf>, text: &str) -> Result<Self, SceneError> {
        let path = path.into();
        match layout::parse(text) {
            Ok((data, unit)) => Ok(Self { path, unit, data }),
            Err(mistakes) => Err(SceneError::Table(TableReport::new(path, mistakes))),
        }
    }

    /// The name of the file without folder and ending.
    #[must_use]
    pub fn name(&self) -> String {
        self.path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
    }
}

/// A law with what came of it.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Candidate {
    /// The law.
    pub law: AnyModel,
    /// Its fit, or why there is none.
    pub fit: Result<Fit, FitError>,
}

/// Laws on the same data.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Comparison {
    /// The laws in the order of asking.
    pub candidates: Vec<Candidate>,
}

impl Comparison {
    /// The fits that there are.
    pub fn fits(&self) -> impl Iterator<Item = (AnyModel, &Fit)> {
        self.candidates.iter().filter_map(|candidate| Some((candidate.law, candidate.fit.as_ref().ok()?)))
    }

    /// Why laws have no fit.
    pub fn refusals(&self) -> impl Iterator<Item = &FitError> {
        self.candidates.iter().filter_map(|candidate| candidate.fit.as_ref().err())
    }

    /// The fit with the least `AICc`; none where no law has one, as of less than three stresses more than parameters.
    #[must_use]
    pub fn best(&self) -> Option<&Fit> {
        let judged = self.fits().filter_map(|(_, fit)| Some((fit.criteria.aicc?, fit)));
        judged.min_by(|(a, _), (b, _)| a.total_cmp(b)).map(|(_, fit)| fit)
    }

    /// Whether every law was fitted, and every search converged.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        self.candidates.iter().all(|candidate| candidate.fit.as_ref().is_ok_and(|fit| fit.outcome.is_converged()))
    }
}

/// Fits each law that is asked for.
///
/// # Errors
/// Weights of tests that are not in the data. What one law refuses stands in its [`Candidate`].
pub fn compare(measurements: &Measurements, request: &Request) -> Result<Comparison, SceneError> {
    let data = request.weighted(&measurements.data)?;
    let candidate = |&law: &AnyModel| Candidate { law, fit: fit(&law, &data, &request.options(law)) };
    Ok(Comparison { candidates: request.laws.iter().map(candidate).collect() })
}

/// The numbers of a comparison, as they stand in `summary.json`.
#[must_use]
pub fn summary(measurements: &Measurements, comparison: &Comparison) -> String {
    tables::summary(measurements, comparison)
}

/// Writes summary, tables and figure.
#[must_use]
pub fn write(folder: &Folder, measurements: &Measurements, comparison: &Comparison) -> Written {
    Written::of(
        folder,
        [
            ("summary.json", tables::summary(measurements, comparison)),
            ("curves.csv", tables::curves(measurements, comparison)),
            ("residuals.csv", tables::residuals(measurements, comparison)),
            ("fit.svg", figure::comparison(measurements, comparison)),
        ],
    )
}
