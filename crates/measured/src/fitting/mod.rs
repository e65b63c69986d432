//! Parameters of laws from tables of measured stresses: files in, comparison of laws, tables and figures out.
//!
//! | stage | item |
//! |---|---|
//! | read | [`Measurements::load`]: a CSV table, every mistake with its line |
//! | ask | [`Request`]: laws, weights, bounds, stability |
//! | fit | [`compare`]: each law on the same data, by [`piola_fit::solids`] |
//! | write | [`Comparison::write`]: `summary.json`, `curves.csv`, `residuals.csv`, `fit.svg` |

mod cards;
mod figure;
mod layout;
mod mistake;
mod request;
mod tables;

pub use cards::{Bulk, Program, card};
pub(crate) use cards::{MOST_OF_CALCULIX, lines, short_lines};
pub use mistake::{TableMistake, TableReport};
#[cfg(feature = "history")]
pub(crate) use request::bound;
pub use request::{LawBounds, Request};

pub use piola_fit::solids::{
    AnyModel, Contradiction, Fit, Intervals, Residuals, SolidParameter, Stability, State, Test, Weighting,
};

use std::path::{Path, PathBuf};

use piola_charts::{Folder, Written};
use piola_fit::FitError;
use piola_fit::solids::{Data, contradictions};

use crate::MeasuredError;
use crate::comparison::{self, Judged, Watch};
use crate::sheet::read;

/// Measured stresses of one material.
///
/// # Example
/// ```
/// use piola_measured::fitting::Measurements;
/// let text = "mode,stretch,stress_MPa\nuniaxial,1.5,0.4\nuniaxial,2.0,0.6\nplanar,1.5,0.5\n";
/// let measurements = Measurements::parse("rubber.csv", text)?;
/// assert_eq!(measurements.unit.as_deref(), Some("MPa"));
/// assert_eq!(measurements.data.tests()[0].len(), 2);
/// let wrong = Measurements::parse("rubber.csv", "mode,stretch,stress\nuniaxial,-1.5,0.4\n");
/// assert!(wrong.unwrap_err().to_string().starts_with("rubber.csv:2: "));
/// # Ok::<(), piola_measured::MeasuredError>(())
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
    /// Tests that the file holds out: laws are not fitted to them, but compared with them.
    pub held_out: Vec<Test>,
    /// What was read in a way that a reader must know, as sentences without a full stop.
    pub notes: Vec<String>,
}

impl Measurements {
    /// Reads a file.
    ///
    /// # Errors
    /// [`MeasuredError::Unreadable`], [`MeasuredError::TooLarge`], [`MeasuredError::NotText`]; [`MeasuredError::Table`] with every
    /// mistake and its line.
    pub fn load(path: &Path) -> Result<Self, MeasuredError> {
        Self::load_only(path, &[])
    }

    /// Reads those rows of a file whose columns have these texts or numbers, as `("batch", "7")`.
    ///
    /// # Errors
    /// As [`load`](Self::load).
    pub fn load_only(path: &Path, only: &[(String, String)]) -> Result<Self, MeasuredError> {
        Self::of(path, &read(path)?, only)
    }

    /// Reads the text of a file.
    ///
    /// # Errors
    /// [`MeasuredError::Table`].
    pub fn parse(path: impl Into<PathBuf>, text: &str) -> Result<Self, MeasuredError> {
        Self::of(path, text, &[])
    }

    fn of(path: impl Into<PathBuf>, text: &str, only: &[(String, String)]) -> Result<Self, MeasuredError> {
        let path = path.into();
        match layout::parse(text, only) {
            Ok(layout::Layout { data, unit, held_out, notes }) => Ok(Self { path, unit, data, held_out, notes }),
            Err(mistakes) => Err(MeasuredError::Table(TableReport::new(path, mistakes))),
        }
    }

    /// The name of the file without folder and ending.
    #[must_use]
    pub fn name(&self) -> String {
        self.path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
    }
}

/// A fitted law with what the tests say of it one by one.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct FittedLaw {
    /// The fit to all tests that are not held out.
    pub fit: Fit,
    /// Parameters for which two tests alone ask for different values.
    pub contradictions: Vec<Contradiction>,
    /// What the law predicts for tests that are held out.
    pub predicted: Vec<Residuals>,
    /// Each test as the law predicts it that is fitted to all the others, if that was asked for.
    pub left_out: Vec<Residuals>,
}

impl core::ops::Deref for FittedLaw {
    type Target = Fit;

    fn deref(&self) -> &Fit {
        &self.fit
    }
}

/// Laws fitted to the same stresses.
pub type Comparison = comparison::Comparison<AnyModel, FittedLaw, FitError>;

impl Judged for FittedLaw {
    fn aicc(&self) -> Option<f64> {
        self.fit.criteria.aicc
    }
    fn is_converged(&self) -> bool {
        self.fit.outcome.is_converged()
    }
    fn widening(&self) -> f64 {
        self.fit.autocorrelation.map_or(1.0, |found| found.widening)
    }
}

/// Fits each law that is asked for.
///
/// # Errors
/// Weights of tests that are not in the data; bounds that no value of a parameter fulfils. The refusal of a single law stands in its
/// [`Candidate`](crate::comparison::Candidate).
pub fn compare(measurements: &Measurements, request: &Request) -> Result<Comparison, MeasuredError> {
    compare_until(measurements, request, &mut |_| core::ops::ControlFlow::Continue(()))
}

/// The same while `watch` lets it go on; it is told the finished part of the laws.
///
/// # Errors
/// As [`compare`].
pub fn compare_until(
    measurements: &Measurements,
    request: &Request,
    watch: Watch<'_>,
) -> Result<Comparison, MeasuredError> {
    let (data, held) = request.weighted(measurements)?;
    request.check_bounds(&data)?;
    Ok(Comparison::of(&request.laws, watch, |law, stop| {
        let options = request.options(law);
        let fit = law.fit_until(&data, &options, stop)?;
        let predicted = held.iter().map(|test| law.residuals(test, &fit)).collect::<Result<_, _>>()?;
        let left_out = if request.cross_validation && 1 < data.tests().len() && !stop() {
            law.held_out(&data, &options, stop)
                .map_or_else(|_| Vec::new(), |tests| tests.into_iter().map(|test| test.residuals).collect())
        } else {
            Vec::new()
        };
        let contradictions = contradictions(&law.alone(&data, &options, &fit, stop));
        Ok(FittedLaw { fit, contradictions, predicted, left_out })
    }))
}

impl Comparison {
    /// The numbers, as they stand in `summary.json`.
    #[must_use]
    pub fn summary(&self, measurements: &Measurements) -> String {
        tables::summary(measurements, self)
    }

    /// Writes summary, tables and figure.
    #[must_use]
    pub fn write(&self, folder: &Folder, measurements: &Measurements) -> Written {
        Written::of(
            folder,
            [
                ("summary.json", tables::summary(measurements, self)),
                ("curves.csv", tables::curves(measurements, self)),
                ("residuals.csv", tables::residuals(measurements, self)),
                ("fit.svg", figure::comparison(measurements, self)),
            ],
        )
    }

    /// Stresses of every law from rest to `stretch` in each mode that was measured, with pointwise intervals: CSV with the columns
    /// `law,mode,stretch,stress,low,high,beyond the data`.
    ///
    /// # Errors
    /// [`MeasuredError::Argument`] unless the stretch is positive and finite.
    pub fn predictions(&self, measurements: &Measurements, stretch: f64) -> Result<String, MeasuredError> {
        tables::predictions(measurements, self, stretch)
    }
}
