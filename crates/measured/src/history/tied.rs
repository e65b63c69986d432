//! Laws whose first Lamé parameters follow their shear moduli.

use piola_fit::FitError;
use piola_fit::history::{AnyHistoryModel, HistoryFit, HistoryModel, HistoryParameter, HistoryTest, StepControl};

/// A law with λ = ratio · μ of each spring whose λ has no bounds in the request: this holds Poisson's ratio, whatever μ is found.
///
/// Their values among the parameters are not used; [`filled`](Self::filled) puts them into a fit.
pub(super) struct TiedLaw {
    law: AnyHistoryModel,
    ratio: f64,
    /// Places of the tied λ; the shear modulus stands before each.
    places: Vec<usize>,
}

/// The first Lamé parameters of the built-in laws.
const FIRST_LAME: [&str; 2] = ["first_lame_parameter", "overstress_first_lame_parameter"];

impl TiedLaw {
    /// With λ = 100 μ (ν = 0.495), of metal λ = 1.5 μ (ν = 0.3).
    pub(super) fn new(law: AnyHistoryModel, is_bounded: impl Fn(&str) -> bool) -> Self {
        let ratio = if law == AnyHistoryModel::Viscoplastic { 1.5 } else { 100.0 };
        let is_tied = |name: &str| FIRST_LAME.contains(&name) && !is_bounded(name);
        let places = (0..).zip(law.parameters()).filter(|(_, (name, ..))| is_tied(name)).map(|(k, _)| k).collect();
        Self { law, ratio, places }
    }

    fn tie(&self, values: &mut [f64]) {
        for &k in &self.places {
            values[k] = self.ratio * values[k - 1];
        }
    }

    /// A fit with the values of the tied parameters.
    pub(super) fn filled(&self, mut fit: HistoryFit) -> HistoryFit {
        let mut values = fit.values();
        self.tie(&mut values);
        fit.parameters.iter_mut().zip(values).for_each(|(parameter, value)| parameter.value = value);
        fit
    }
}

impl HistoryModel for TiedLaw {
    fn name(&self) -> String {
        self.law.name()
    }

    fn parameters(&self) -> Vec<HistoryParameter> {
        self.law.parameters()
    }

    fn stresses(&self, parameters: &[f64], test: &HistoryTest, control: &StepControl) -> Result<Vec<f64>, FitError> {
        let mut values = parameters.to_vec();
        self.tie(&mut values);
        self.law.stresses(&values, test, control)
    }
}
