//! Requests: laws, weights, bounds, stability.

use core::str::FromStr;

use piola_fit::FitError;
use piola_fit::solids::{AnyModel, Data, Intervals, Model as _, Options, Stability, Test, Weighting};

use super::Measurements;
use crate::MeasuredError;

/// Bounds of a parameter of one law, written `gent.Jm=60..200`; either end may be left out.
///
/// # Example
/// ```
/// use piola_measured::fitting::LawBounds;
/// let bounds: LawBounds = "ogden:2.alpha1=0..8".parse()?;
/// assert_eq!((bounds.parameter.as_str(), bounds.range), ("alpha1", [0.0, 8.0]));
/// assert!("gent.Jm=large".parse::<LawBounds>().is_err());
/// # Ok::<(), piola_measured::MeasuredError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct LawBounds {
    /// The law.
    pub law: AnyModel,
    /// The parameter.
    pub parameter: String,
    /// The least and the greatest value.
    pub range: [f64; 2],
}

impl FromStr for LawBounds {
    type Err = MeasuredError;

    fn from_str(text: &str) -> Result<Self, MeasuredError> {
        let valid = "LAW.PARAMETER=LEAST..GREATEST, as gent.Jm=60..200 or gent.Jm=60..";
        let (law, parameter, range) = bound(text, valid)?;
        Ok(Self { law: law.parse()?, parameter: parameter.to_owned(), range })
    }
}

/// Law, parameter and range of a bound written `LAW.PARAMETER=LEAST..GREATEST`; either end may be left out.
pub(crate) fn bound<'t>(text: &'t str, valid: &'static str) -> Result<(&'t str, &'t str, [f64; 2]), MeasuredError> {
    let parts = || {
        let end = |text: &str, missing: f64| if text.trim().is_empty() { Some(missing) } else { number(text) };
        let (name, range) = text.split_once('=')?;
        let (law, parameter) = name.rsplit_once('.')?;
        let (low, high) = range.split_once("..")?;
        Some((law.trim(), parameter.trim(), [end(low, f64::NEG_INFINITY)?, end(high, f64::INFINITY)?]))
    };
    parts().ok_or_else(|| MeasuredError::Argument { argument: text.to_owned(), valid })
}

fn number(text: &str) -> Option<f64> {
    text.trim().parse().ok().filter(|x: &f64| x.is_finite())
}

/// Laws to compare, and how.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Request {
    /// The laws.
    pub laws: Vec<AnyModel>,
    /// Weights of tests by name; others weigh 1.
    pub weights: Vec<(String, f64)>,
    /// Bounds of parameters.
    pub bounds: Vec<LawBounds>,
    /// The scale of residuals.
    pub weighting: Weighting,
    /// Whether laws must be stable.
    pub stability: Stability,
    /// The probability of the intervals.
    pub confidence: f64,
    /// How intervals are found.
    pub intervals: Intervals,
    /// Whether each test is predicted by the law that is fitted to all the others.
    pub cross_validation: bool,
}

impl Request {
    /// A request for some laws, with everything else by default.
    #[must_use]
    pub fn of(laws: Vec<AnyModel>) -> Self {
        let Options { weighting, stability, confidence, intervals, .. } = Options::default();
        let (weights, bounds) = (Vec::new(), Vec::new());
        Self { laws, weights, bounds, weighting, stability, confidence, intervals, cross_validation: false }
    }

    /// Laws that are compared when none is named.
    ///
    /// # Errors
    /// None: the names are right.
    pub fn usual_laws() -> Result<Vec<AnyModel>, MeasuredError> {
        const NAMES: [&str; 9] = [
            "neo-hookean",
            "mooney-rivlin",
            "yeoh",
            "gent",
            "arruda-boyce",
            "polynomial:2",
            "ogden:1",
            "ogden:2",
            "ogden:3",
        ];
        NAMES.iter().map(|name| Ok(name.parse()?)).collect()
    }

    /// Weights written `uniaxial=2,planar=0.5`; 0 holds a test out.
    ///
    /// # Errors
    /// [`MeasuredError::Argument`].
    pub fn weights(text: &str) -> Result<Vec<(String, f64)>, MeasuredError> {
        let weight = |part: &str| {
            let (name, value) = part.split_once('=')?;
            let value = number(value).filter(|value| 0.0 <= *value)?;
            Some((name.trim().to_owned(), value))
        };
        let wrong = |part: &str| MeasuredError::Argument {
            argument: part.to_owned(),
            valid: "TEST=WEIGHT,…, as uniaxial=2,planar=0.5, weights not below 0; 0 holds a test out",
        };
        text.split(',').map(|part| weight(part).ok_or_else(|| wrong(part))).collect()
    }

    pub(super) fn options(&self, law: AnyModel) -> Options {
        let of_law = self.bounds.iter().filter(|bounds| bounds.law == law);
        Options {
            weighting: self.weighting,
            stability: self.stability,
            bounds: of_law.map(|bounds| (bounds.parameter.clone(), bounds.range)).collect(),
            confidence: self.confidence,
            intervals: self.intervals,
            ..Options::default()
        }
    }

    /// Refuses bounds that no law can have, before anything is fitted.
    pub(super) fn check_bounds(&self, data: &Data) -> Result<(), MeasuredError> {
        let reach = data.largest_first_invariant();
        for LawBounds { law, parameter, range: [low, high] } in &self.bounds {
            let own = law.parameters(reach);
            let Some(found) = own.iter().find(|own| own.name == *parameter) else {
                return Err(FitError::UnknownParameter { model: law.to_string(), parameter: parameter.clone() }.into());
            };
            let (lower, upper) = (low.max(found.bounds[0]), high.min(found.bounds[1]));
            if upper < lower {
                let (model, parameter) = (law.to_string(), parameter.clone());
                return Err(FitError::ImpossibleBounds { model, parameter, lower, upper }.into());
            }
        }
        Ok(())
    }

    /// The tests that are fitted, with their weights, and those that are held out.
    pub(super) fn weighted(&self, measurements: &Measurements) -> Result<(Data, Vec<Test>), MeasuredError> {
        let all = || measurements.data.tests().iter().chain(&measurements.held_out);
        for (name, _) in &self.weights {
            if all().all(|test| test.name() != name) {
                let tests = all().map(|test| test.name().to_owned()).collect();
                return Err(MeasuredError::NoSuchTest { name: name.clone(), tests });
            }
        }
        for bounds in &self.bounds {
            if !self.laws.contains(&bounds.law) {
                return Err(MeasuredError::Argument {
                    argument: format!("{}.{}", bounds.law, bounds.parameter),
                    valid: "bounds of a law that is fitted: name it with --law",
                });
            }
        }
        let given = |test: &Test| self.weights.iter().find(|(name, _)| name == test.name()).map(|(_, weight)| *weight);
        let (mut fitted, mut held) = (Vec::new(), Vec::new());
        for (test, own) in measurements
            .data
            .tests()
            .iter()
            .map(|test| (test, None))
            .chain(measurements.held_out.iter().map(|test| (test, Some(0.0))))
        {
            match given(test).or(own) {
                Some(weight) if weight <= 0.0 => held.push(test.clone()),
                Some(weight) => fitted.push(test.clone().with_weight(weight)?),
                None => fitted.push(test.clone()),
            }
        }
        Ok((Data::new(fitted)?, held))
    }
}
