//! What each test says alone, and what the others say of it.

use super::{Data, Fit, Fitted, Intervals, Model, Options, Residuals, Role, SolidParameter, State, fit_from};
use crate::FitError;

/// A law fitted to one test alone.
///
/// # Example
/// See [`alone`].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Alone {
    /// The test.
    pub test: String,
    /// The parameters that it asks for.
    pub parameters: Vec<SolidParameter>,
    /// Its RMS residual over its largest stress.
    pub relative_rms: f64,
}

/// Two tests that ask for different values of a parameter: their intervals do not meet.
///
/// # Example
/// See [`alone`].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Contradiction {
    /// The parameter.
    pub parameter: String,
    /// The tests.
    pub tests: [String; 2],
    /// What each asks for.
    pub values: [f64; 2],
    /// With which interval.
    pub intervals: [[f64; 2]; 2],
}

/// A test that a law was not fitted to, beside what the law predicts there.
///
/// # Example
/// See [`alone`].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct HeldOut {
    /// Prediction less measurement.
    pub residuals: Residuals,
}

/// The law fitted to each test alone that has more numbers than the law has parameters; from the joint fit, so that it costs little. Once `stop`
/// says so, those before come.
///
/// # Example
/// ```
/// use piola_fit::solids::{AnyModel, Data, Measure, Options, Table, Test, alone, contradictions, fit, held_out};
/// // A bar with μ = 1 and a sheet with μ = 2, each with errors of a percent.
/// let bar = [[1.5, 1.055 * 1.01], [2.0, 1.75 * 0.99], [3.0, 2.889 * 1.01]].to_vec();
/// let sheet = [[1.5, 2.407 * 0.99], [2.0, 3.75 * 1.01], [3.0, 5.926]].to_vec();
/// let bar = Test::new("bar", Table::Uniaxial(bar), Measure::FirstPiola)?;
/// let sheet = Test::new("sheet", Table::Planar(sheet), Measure::FirstPiola)?;
/// let data = Data::new(vec![bar, sheet])?;
/// let options = Options::default();
/// let joint = fit(&AnyModel::NeoHookean, &data, &options)?;
/// let found = contradictions(&alone(&AnyModel::NeoHookean, &data, &options, &joint, &|| false));
/// assert_eq!((found.len(), found[0].parameter.as_str()), (1, "mu"));
/// // The bar alone predicts half the stresses of the sheet.
/// let predicted = held_out(&AnyModel::NeoHookean, &data, &options, &|| false)?;
/// assert!((predicted[1].residuals.relative_largest - 0.5).abs() < 0.02);
/// # Ok::<(), piola_fit::FitError>(())
/// ```
#[must_use]
pub fn alone<M: Model>(model: &M, data: &Data, options: &Options, joint: &Fit, stop: &dyn Fn() -> bool) -> Vec<Alone> {
    let reach = data.largest_first_invariant();
    let searched = model.parameters(reach).into_iter().zip(joint.values());
    let start: Vec<f64> = searched.filter(|(own, _)| own.role == Role::Nonlinear).map(|(_, value)| value).collect();
    let one = |test: &super::Test| {
        if stop() || test.informative() <= joint.parameters.len() {
            return None;
        }
        let data = Data::new(vec![test.clone()]).ok()?;
        let fit = fit_from(model, &data, options, Some(vec![start.clone()]), stop).ok()?;
        if stop() {
            return None;
        }
        let relative_rms = fit.tests.first()?.relative_rms;
        Some(Alone { test: test.name().to_owned(), parameters: fit.parameters, relative_rms })
    };
    if data.tests().len() < 2 { Vec::new() } else { data.tests().iter().filter_map(one).collect() }
}

/// For each parameter, the two tests whose intervals are farthest apart, if there are such that do not meet.
#[must_use]
pub fn contradictions(alone: &[Alone]) -> Vec<Contradiction> {
    let mut found = Vec::new();
    for index in 0..alone.first().map_or(0, |first| first.parameters.len()) {
        let told = |one: &Alone| {
            let parameter = one.parameters.get(index).filter(|parameter| parameter.state == State::Determined)?;
            Some((one.test.clone(), parameter.value, parameter.interval?))
        };
        let told: Vec<(String, f64, [f64; 2])> = alone.iter().filter_map(told).collect();
        let lowest = told.iter().min_by(|a, b| a.2[1].total_cmp(&b.2[1]));
        let highest = told.iter().max_by(|a, b| a.2[0].total_cmp(&b.2[0]));
        if let (Some(low), Some(high)) = (lowest, highest)
            && low.2[1] < high.2[0]
        {
            found.push(Contradiction {
                parameter: alone[0].parameters[index].name.clone(),
                tests: [low.0.clone(), high.0.clone()],
                values: [low.1, high.1],
                intervals: [low.2, high.2],
            });
        }
    }
    found
}

/// Each test as the law predicts it that is fitted to all the others. Once `stop` says so, those before come.
///
/// # Errors
/// As [`fit`](super::fit) for the fits to the others.
pub fn held_out<M: Model>(
    model: &M,
    data: &Data,
    options: &Options,
    stop: &dyn Fn() -> bool,
) -> Result<Vec<HeldOut>, FitError> {
    // A prediction needs no intervals.
    let options = Options { intervals: Intervals::Linear, ..options.clone() };
    let mut found = Vec::new();
    for (index, test) in data.tests().iter().enumerate() {
        let others: Vec<_> =
            data.tests().iter().enumerate().filter(|(k, _)| *k != index).map(|(_, t)| t.clone()).collect();
        let fit = fit_from(model, &Data::new(others)?, &options, None, stop)?;
        if stop() {
            break;
        }
        found.push(HeldOut { residuals: test.beside(model, &fit)? });
    }
    Ok(found)
}

impl super::Test {
    /// The residuals of a fitted law in this test, whether or not it was fitted to it.
    ///
    /// # Errors
    /// [`FitError::NumberOfValues`] if the fit is that of another law.
    pub fn beside<M: Model>(&self, model: &M, fit: &Fit) -> Result<Residuals, FitError> {
        let law = Fitted::new(model, fit.values())?;
        Ok(Residuals::new(self, self.residuals(&law)))
    }
}
