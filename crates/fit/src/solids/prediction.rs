//! Stresses of a fitted law at any stretch, with their uncertainty.

use piola_numerics::Gradient;
use piola_specimens::homogeneous::{Mode, first_piola};

use super::model::Fitted;
use super::{Fit, Measure, Model, student};
use crate::FitError;

/// Parameters of one evaluation.
const CHUNK: usize = 4;

/// A stress of a fitted law.
///
/// # Example
/// See [`predict`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Prediction {
    /// The stretch, or the amount of shear.
    pub stretch: f64,
    /// The stress.
    pub stress: f64,
    /// Half the width of its pointwise interval with the confidence of the fit; none where a parameter on which it depends is not
    /// determined.
    pub half_width: Option<f64>,
}

/// Stresses of a fitted law in a mode, within the data or beyond, with pointwise intervals.
///
/// ```text
/// half width = t √(g·Cov g)      g = ∂P/∂θ,   t of Student, widened where residuals are correlated
/// ```
/// The intervals tell what the errors of the parameters do to the stress, if the law is true. They say nothing of the law where nothing
/// was measured.
///
/// # Errors
/// [`FitError::NumberOfValues`] if the fit is that of another law.
///
/// # Example
/// ```
/// use piola_fit::solids::{AnyModel, Data, Measure, Options, Table, Test, fit, predict};
/// use piola_specimens::homogeneous::Mode;
/// let bar = Table::Uniaxial(vec![[1.5, 1.1], [2.0, 1.7], [3.0, 2.95]]);
/// let data = Data::new(vec![Test::new("bar", bar, Measure::FirstPiola)?])?;
/// let rubber = fit(&AnyModel::NeoHookean, &data, &Options::default())?;
/// let mu = rubber.parameters[0].value;
/// let sheet = predict(&AnyModel::NeoHookean, &rubber, Mode::Equibiaxial, Measure::FirstPiola, &[2.0])?;
/// assert!((sheet[0].stress - mu * (2.0 - 1.0 / 32.0)).abs() < 1e-14); // μ (λ − λ⁻⁵)
/// // P is proportional to μ: so is its interval.
/// let error = rubber.parameters[0].standard_error.expect("two degrees of freedom");
/// let half = sheet[0].half_width.expect("determined");
/// assert!((half / (4.302_652_729_911 * error) - (2.0 - 1.0 / 32.0)).abs() < 1e-8);
/// # Ok::<(), piola_fit::FitError>(())
/// ```
pub fn predict<M: Model>(
    model: &M,
    fit: &Fit,
    mode: Mode,
    measure: Measure,
    stretches: &[f64],
) -> Result<Vec<Prediction>, FitError> {
    let theta = fit.values();
    // The number is checked once.
    let plain = Fitted::new(model, theta.iter().copied())?;
    let widening = fit.autocorrelation.map_or(1.0, |found| found.widening);
    let quantile = student(fit.confidence, fit.degrees_of_freedom).map(|t| t * widening);
    let one = |&stretch: &f64| {
        let factor = super::test::factor(mode, measure, stretch);
        let stress = factor * first_piola(mode, stretch, &plain);
        let mut slopes = vec![0.0; theta.len()];
        for begin in (0..theta.len()).step_by(CHUNK) {
            let lifted = theta
                .iter()
                .enumerate()
                .map(|(k, x)| Gradient::<f64, CHUNK>::variable(*x, if k < begin { CHUNK } else { k - begin }));
            let law = Fitted::trusted(model, lifted);
            let found = first_piola(mode, Gradient::constant(stretch), &law);
            for (slope, partial) in slopes[begin..].iter_mut().zip(found.partials) {
                *slope = factor * partial;
            }
        }
        let half_width = quantile.and_then(|quantile| Some(quantile * deviation(fit, &slopes)?));
        Prediction { stretch, stress, half_width }
    };
    Ok(stretches.iter().map(one).collect())
}

/// √(g·Cov g); nothing where g is not zero for a parameter that is free but not determined.
fn deviation(fit: &Fit, slopes: &[f64]) -> Option<f64> {
    let covariance = fit.covariance.as_ref()?;
    for (k, parameter) in fit.parameters.iter().enumerate() {
        let matters = 1e-9 < (slopes[k] * parameter.value).abs();
        if parameter.state == super::State::Undetermined && matters {
            return None;
        }
    }
    let mut variance = 0.0;
    for (i, row) in covariance.parameters.iter().zip(&covariance.matrix) {
        for (j, entry) in covariance.parameters.iter().zip(row) {
            variance += slopes[*i] * entry * slopes[*j];
        }
    }
    Some(variance.max(0.0).sqrt())
}
