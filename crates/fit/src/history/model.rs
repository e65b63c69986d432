//! Laws with history that a fit may find.

use core::fmt;
use core::str::FromStr;

use piola_inelastic::{BergstromBoyce, Hardening, Mullins, PowerFlow, ReeseGovindjee, StepControl, Viscoplastic};
use piola_solids::{Hencky, NeoHookeanCiarlet};

use super::starts;
use super::test::{HistoryTest, follow};
use crate::FitError;

/// A parameter of a model: its name, whether it is in the unit of the stresses, and its bounds.
pub type HistoryParameter = (&'static str, bool, [f64; 2]);

/// A law with history whose parameters are to be found.
///
/// # Example
/// Rubber of Gent that softens as Ogden and Roxburgh say: the law of given parameters, followed along a test.
/// ```
/// use piola_fit::FitError;
/// use piola_fit::history::{HistoryModel, HistoryOptions, HistoryParameter, HistoryTest, fit_history, follow};
/// use piola_fit::sides::Loading;
/// use piola_inelastic::{Mullins, StepControl};
/// use piola_solids::{Compressible, isochoric::Gent, volumetric::Quadratic};
///
/// struct SofteningGent;
/// impl HistoryModel for SofteningGent {
///     fn name(&self) -> String {
///         "softening Gent".to_owned()
///     }
///     fn parameters(&self) -> Vec<HistoryParameter> {
///         vec![("shear_modulus", true, [0.0, f64::INFINITY]), ("softening", false, [1.0, f64::INFINITY])]
///     }
///     fn stresses(&self, p: &[f64], test: &HistoryTest, control: &StepControl) -> Result<Vec<f64>, FitError> {
///         let rubber = Compressible::new(Gent::new(p[0], 30.0)?, Quadratic::new(100.0)?);
///         follow(&Mullins::new(rubber, p[1], 0.5, 0.0)?, test, control)
///     }
/// }
///
/// let mut rows = [0.25, 0.5, 1.0, 0.75, 0.5].map(|k| [1.0, k, 0.0]); // pulled to k = 1 and back
/// let path = HistoryTest::new("cycle", Loading::SimpleShear, &rows)?;
/// let control = StepControl::one_step();
/// for (row, stress) in rows.iter_mut().zip(SofteningGent.stresses(&[2.0, 1.5], &path, &control)?) {
///     row[2] = stress;
/// }
/// let cycle = HistoryTest::new("cycle", Loading::SimpleShear, &rows)?;
/// let fit = fit_history(&SofteningGent, &[cycle], &[1.0, 3.0], &HistoryOptions::default())?;
/// assert!((fit.values()[0] - 2.0).abs() < 1e-8 && (fit.values()[1] - 1.5).abs() < 1e-8);
/// # Ok::<(), FitError>(())
/// ```
pub trait HistoryModel {
    /// Its name, for messages and reports.
    fn name(&self) -> String;

    /// Its parameters in their order.
    fn parameters(&self) -> Vec<HistoryParameter>;

    /// The stresses of the law with these parameters along the rows of a test; usually [`follow`] of the law.
    ///
    /// # Errors
    /// What the law refuses: such parameters are not taken.
    fn stresses(&self, parameters: &[f64], test: &HistoryTest, control: &StepControl) -> Result<Vec<f64>, FitError>;
}

/// A built-in law with history, its springs neo-Hookean (of metal: Hencky's).
///
/// | name | law | parameters |
/// |---|---|---|
/// | `bergstrom-boyce` | [`BergstromBoyce`] | two of each spring, then `rate`, `stress`, `stress_exponent`, `stretch_exponent`, `perturbation` |
/// | `reese-govindjee` | [`ReeseGovindjee`] | two of each spring, then `viscosity` |
/// | `ogden-roxburgh` | [`Mullins`] | two of the spring, then `softening`, `energy`, `share` |
/// | `viscoplastic` | [`Viscoplastic`] | two of the spring, then `yield_stress`, `linear`, `saturation`, `saturation_exponent`, `viscosity` |
///
/// The springs are [`NeoHookeanCiarlet`] with `shear_modulus` and `first_lame_parameter`; those of the spring that flows have the prefix
/// `overstress_`. Hold what a test does not tell, such as the first Lamé parameter in a shear, and one of `rate` and `stress`: see
/// [`HistoryOptions::with_bounds`](super::HistoryOptions::with_bounds).
///
/// # Example
/// ```
/// use piola_fit::history::{AnyHistoryModel, HistoryModel};
/// let model: AnyHistoryModel = "reese-govindjee".parse()?;
/// assert_eq!(model.parameters()[4].0, "viscosity");
/// # Ok::<(), piola_fit::FitError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[non_exhaustive]
pub enum AnyHistoryModel {
    /// Rubber whose flow is a power of the stress.
    BergstromBoyce,
    /// Finite linear viscosity.
    ReeseGovindjee,
    /// Stress softening.
    OgdenRoxburgh,
    /// Finite J₂ plasticity with viscosity.
    Viscoplastic,
}

const POSITIVE: [f64; 2] = [0.0, f64::INFINITY];
const SPRING: [HistoryParameter; 2] = [("shear_modulus", true, POSITIVE), ("first_lame_parameter", true, POSITIVE)];
const OVERSTRESS: [HistoryParameter; 2] =
    [("overstress_shear_modulus", true, POSITIVE), ("overstress_first_lame_parameter", true, POSITIVE)];

impl AnyHistoryModel {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::BergstromBoyce, Self::ReeseGovindjee, Self::OgdenRoxburgh, Self::Viscoplastic];

    /// Starts of a search about the stresses, stretches and times of tests: for [`fit_history_of_starts`](super::fit_history_of_starts). Elastic
    /// moduli begin at secants of the tests, of metal at the steepest one. First Lamé parameters, which tests with free sides hardly determine, are a hundred shear moduli; of metal one and a half (ν = 0.3).
    ///
    /// # Example
    /// ```
    /// use piola_fit::history::{AnyHistoryModel, HistoryTest};
    /// use piola_fit::sides::Loading;
    /// let test = HistoryTest::new("shear", Loading::SimpleShear, &[[1.0, 0.5, 2.0], [9.0, 0.5, 1.0]])?;
    /// let starts = AnyHistoryModel::ReeseGovindjee.starts(&[test]);
    /// assert!(starts.len() == 3 && starts[0][1] == 100.0 * starts[0][0]);
    /// # Ok::<(), piola_fit::FitError>(())
    /// ```
    #[must_use]
    pub fn starts(self, tests: &[HistoryTest]) -> Vec<Vec<f64>> {
        match self {
            Self::BergstromBoyce => starts::bergstrom_boyce(tests),
            Self::ReeseGovindjee => starts::reese_govindjee(tests),
            Self::OgdenRoxburgh => starts::ogden_roxburgh(tests),
            Self::Viscoplastic => starts::viscoplastic(tests),
        }
    }

    const fn word(self) -> &'static str {
        match self {
            Self::BergstromBoyce => "bergstrom-boyce",
            Self::ReeseGovindjee => "reese-govindjee",
            Self::OgdenRoxburgh => "ogden-roxburgh",
            Self::Viscoplastic => "viscoplastic",
        }
    }
}

impl HistoryModel for AnyHistoryModel {
    fn name(&self) -> String {
        self.word().to_owned()
    }

    fn parameters(&self) -> Vec<HistoryParameter> {
        let from_one = [1.0, f64::INFINITY];
        let own: &[HistoryParameter] = match self {
            Self::BergstromBoyce => &[
                ("rate", false, POSITIVE),
                ("stress", true, POSITIVE),
                ("stress_exponent", false, from_one),
                ("stretch_exponent", false, [-1.0, 0.0]),
                ("perturbation", false, POSITIVE),
            ],
            Self::ReeseGovindjee => &[("viscosity", false, POSITIVE)],
            Self::OgdenRoxburgh => {
                &[("softening", false, from_one), ("energy", true, POSITIVE), ("share", false, POSITIVE)]
            }
            Self::Viscoplastic => &[
                ("yield_stress", true, POSITIVE),
                ("linear", true, POSITIVE),
                ("saturation", true, POSITIVE),
                ("saturation_exponent", false, POSITIVE),
                ("viscosity", false, POSITIVE),
            ],
        };
        let flows = matches!(self, Self::BergstromBoyce | Self::ReeseGovindjee);
        let springs = SPRING.into_iter().chain(OVERSTRESS.into_iter().filter(|_| flows));
        springs.chain(own.iter().copied()).collect()
    }

    fn stresses(&self, parameters: &[f64], test: &HistoryTest, control: &StepControl) -> Result<Vec<f64>, FitError> {
        let spring = |mu: f64, lambda: f64| NeoHookeanCiarlet::with_constants(mu, lambda);
        match (self, parameters) {
            (Self::BergstromBoyce, &[a, b, c, d, rate, stress, stress_exponent, stretch_exponent, perturbation]) => {
                let flow = PowerFlow { rate, stress, stress_exponent, stretch_exponent, perturbation };
                follow(&BergstromBoyce::new(spring(a, b)?, spring(c, d)?, flow)?, test, control)
            }
            (Self::ReeseGovindjee, &[a, b, c, d, viscosity]) => {
                follow(&ReeseGovindjee::new(spring(a, b)?, spring(c, d)?, viscosity)?, test, control)
            }
            (Self::OgdenRoxburgh, &[mu, lambda, softening, energy, share]) => {
                follow(&Mullins::new(spring(mu, lambda)?, softening, energy, share)?, test, control)
            }
            (Self::Viscoplastic, &[mu, lambda, yield_stress, linear, saturation, saturation_exponent, viscosity]) => {
                let hardening = Hardening { yield_stress, linear, saturation, saturation_exponent };
                follow(&Viscoplastic::new(Hencky::new(lambda, mu)?, hardening, viscosity)?, test, control)
            }
            _ => {
                let (expected, values) = (self.parameters().len(), parameters.len());
                Err(FitError::NumberOfValues { model: self.name(), parameters: expected, values })
            }
        }
    }
}

impl fmt::Display for AnyHistoryModel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())
    }
}

impl FromStr for AnyHistoryModel {
    type Err = FitError;

    fn from_str(text: &str) -> Result<Self, FitError> {
        let found = Self::ALL.into_iter().find(|model| model.word() == text);
        found.ok_or_else(|| FitError::UnknownHistoryModel { name: text.to_owned() })
    }
}
