//! Laws with history from tables of time, stretch and stress: rates, holds and cycles.
//!
//! ```text
//! time [s],stretch,stress [MPa]                    the rows follow the motion, from the body at rest
//! specimen,mode,time [s],strain [%],stress [MPa]   several specimens, each from its own rest
//! ```
//! | column | meaning |
//! |---|---|
//! | `time` | of the specimen, from zero; it does not fall |
//! | `stretch`, `strain`, or in simple shear `amount of shear` | along the load; between two rows it changes in proportion to time |
//! | `stress` | first Piola–Kirchhoff stress |
//! | `mode` | uniaxial (without the column), equibiaxial, planar, simple shear |
//! | `specimen` | each is a test of its own |

mod output;
mod table;
mod tied;

pub use piola_fit::history::{AnyHistoryModel, HistoryFit, HistoryOptions, HistoryTest};
pub use table::HistoryMeasurements;

use core::ops::ControlFlow;

use piola_fit::history::{HistoryModel as _, fit_history_of_starts};
use piola_fit::{FitError, Intervals};

use crate::MeasuredError;
use crate::comparison::{Comparison, Judged, Watch};
use crate::fitting::bound;

use tied::TiedLaw;

/// Laws with history to compare, and how.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct HistoryRequest {
    /// The laws.
    pub laws: Vec<AnyHistoryModel>,
    /// Bounds of parameters: law, parameter, least and greatest value. Equal ends hold a parameter.
    pub bounds: Vec<(AnyHistoryModel, String, [f64; 2])>,
    /// The probability of the intervals.
    pub confidence: f64,
    /// How intervals are found.
    pub intervals: Intervals,
}

impl HistoryRequest {
    /// A request for some laws.
    #[must_use]
    pub const fn of(laws: Vec<AnyHistoryModel>) -> Self {
        Self { laws, bounds: Vec::new(), confidence: 0.95, intervals: Intervals::Linear }
    }

    /// Adds a bound written `bergstrom-boyce.stress_exponent=2..8`.
    ///
    /// # Errors
    /// [`MeasuredError::Argument`] for another text; [`MeasuredError::Fit`] for an unknown law or parameter.
    ///
    /// # Example
    /// ```
    /// use piola_measured::history::{AnyHistoryModel, HistoryRequest};
    /// let request = HistoryRequest::of(vec![AnyHistoryModel::OgdenRoxburgh]);
    /// let request = request.with_bound("ogden-roxburgh.share=0..0")?;
    /// assert_eq!(request.bounds[0].2, [0.0, 0.0]);
    /// assert!(request.with_bound("ogden-roxburgh.shape=1..2").is_err());
    /// # Ok::<(), piola_measured::MeasuredError>(())
    /// ```
    pub fn with_bound(mut self, text: &str) -> Result<Self, MeasuredError> {
        let valid = "LAW.PARAMETER=LEAST..GREATEST, as bergstrom-boyce.stress_exponent=2..8";
        let (law, parameter, range) = bound(text, valid)?;
        let law: AnyHistoryModel = law.parse()?;
        if law.parameters().iter().all(|(name, ..)| *name != parameter) {
            let (model, parameter) = (law.to_string(), parameter.to_owned());
            return Err(FitError::UnknownParameter { model, parameter }.into());
        }
        self.bounds.push((law, parameter.to_owned(), range));
        Ok(self)
    }
}

/// Laws with history fitted to the same tests.
pub type HistoryComparison = Comparison<AnyHistoryModel, HistoryFit, FitError>;

impl Judged for HistoryFit {
    fn aicc(&self) -> Option<f64> {
        self.criteria.aicc
    }
    fn is_converged(&self) -> bool {
        self.outcome.is_converged()
    }
    fn widening(&self) -> f64 {
        self.autocorrelation.map_or(1.0, |found| found.widening)
    }
}

/// Parameters that are held unless the request bounds them: tests with free sides hardly determine the Lamé parameters, and only a
/// combination of `rate` and `stress` is determined.
const HELD: [&str; 4] = ["first_lame_parameter", "overstress_first_lame_parameter", "rate", "perturbation"];

/// Fits each law to all tests at once, from the best of a few starts about the sizes of the data.
///
/// Held, unless the request has bounds for them: the first Lamé parameters at 100 times the shear modulus of their spring that is fitted
/// (ν = 0.495; of metal 1.5 times, ν = 0.3), the `rate` of Bergström and Boyce's law at 1/s, and its `perturbation` at 0.01. Their state is
/// [`State::Held`](piola_fit::State::Held), as that of parameters with equal bounds.
///
/// # Errors
/// [`MeasuredError::Argument`] for bounds of a law that is not fitted; [`MeasuredError::Fit`] for a confidence that is not between 0 and 1.
/// The refusal of a single law stands in its [`Candidate`](crate::comparison::Candidate).
///
/// # Example
/// ```
/// use piola_measured::history::{HistoryMeasurements, HistoryRequest, compare_histories};
/// // Pulled to k = 1 and back, then further: the first rows, and the last ones that go further, show 1 MPa.
/// let text = "time [s],shear,stress [MPa]\n1,0.5,0.5\n2,1,1\n3,0.75,0.456\n4,0.25,0.126\n5,1,1\n6,1.25,1.25\n7,0.75,0.3768\n";
/// let measurements = HistoryMeasurements::parse("cycles.csv", text)?;
/// let request = HistoryRequest::of(vec!["ogden-roxburgh".parse()?]).with_bound("ogden-roxburgh.share=0..0")?;
/// let found = compare_histories(&measurements, &request)?;
/// let (_, fit) = found.fits().next().expect("a fit");
/// assert!((fit.values()[0] - 1.0).abs() < 0.05);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn compare_histories(
    measurements: &HistoryMeasurements,
    request: &HistoryRequest,
) -> Result<HistoryComparison, MeasuredError> {
    compare_histories_until(measurements, request, &mut |_| ControlFlow::Continue(()))
}

/// The same while `watch`, which is told the finished part of the laws, lets it go on.
///
/// # Errors
/// As [`compare_histories`].
pub fn compare_histories_until(
    measurements: &HistoryMeasurements,
    request: &HistoryRequest,
    watch: Watch<'_>,
) -> Result<HistoryComparison, MeasuredError> {
    if !(0.0 < request.confidence && request.confidence < 1.0) {
        return Err(FitError::ConfidenceOutOfRange { value: request.confidence }.into());
    }
    if let Some((law, parameter, _)) = request.bounds.iter().find(|(law, ..)| !request.laws.contains(law)) {
        return Err(MeasuredError::Argument {
            argument: format!("{law}.{parameter}"),
            valid: "bounds of a law that is fitted: name it with --law",
        });
    }
    Ok(Comparison::of(&request.laws, watch, |law, stop| fitted(measurements, request, law, stop)))
}

/// The best fit of all starts; the refusal of the first where none has a fit.
fn fitted(
    measurements: &HistoryMeasurements,
    request: &HistoryRequest,
    law: AnyHistoryModel,
    stop: &dyn Fn() -> bool,
) -> Result<HistoryFit, FitError> {
    let given: Vec<&(AnyHistoryModel, String, [f64; 2])> =
        request.bounds.iter().filter(|(other, ..)| *other == law).collect();
    let is_bounded = |name: &str| given.iter().any(|(_, parameter, _)| parameter == name);
    let tied = TiedLaw::new(law, is_bounded);
    let mut options = HistoryOptions::default();
    options.confidence = request.confidence;
    options.intervals = request.intervals;
    options.bounds = given.iter().map(|(_, parameter, range)| (parameter.clone(), *range)).collect();
    let hold: Vec<&str> = HELD.into_iter().filter(|name| !is_bounded(name)).collect();
    let starts = law.starts(&measurements.tests);
    Ok(tied.filled(fit_history_of_starts(&tied, &measurements.tests, &starts, &hold, &options, stop)?))
}
