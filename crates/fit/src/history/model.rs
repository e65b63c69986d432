//! Laws with history that a fit may find.

use core::fmt;
use core::str::FromStr;

use piola_inelastic::{BergstromBoyce, Hardening, Mullins, PowerFlow, ReeseGovindjee, StepControl, Viscoplastic};
use piola_solids::{Hencky, NeoHookeanCiarlet};

use super::test::{HistoryTest, follow};
use crate::FitError;
use crate::sides::Loading;

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

/// n of P = μ (λ − λ⁻ⁿ), the stress of an incompressible neo-Hookean solid.
const fn thinning(loading: Loading) -> i32 {
    match loading {
        Loading::Equibiaxial => 5,
        Loading::Planar => 3,
        _ => 2,
    }
}

/// λ̄ = √(I₁/3) of the row of a test with the largest one, for constant volume.
fn chain_stretch(test: &HistoryTest) -> f64 {
    let first_invariant = |x: f64| match test.loading() {
        Loading::SimpleShear => 3.0 + x * x,
        Loading::Equibiaxial => 2.0 * x * x + x.powi(-4),
        Loading::Planar => x * x + 1.0 + x.powi(-2),
        _ => x * x + 2.0 / x,
    };
    test.rows().iter().map(|row| (first_invariant(row[1]) / 3.0).sqrt()).fold(1.0, f64::max)
}

impl AnyHistoryModel {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::BergstromBoyce, Self::ReeseGovindjee, Self::OgdenRoxburgh, Self::Viscoplastic];

    /// Starts of a search about the stresses, stretches and times of tests: for [`fit_history`](super::fit_history), which searches from
    /// one. First Lamé parameters, which tests with free sides hardly determine, are a hundred shear moduli; of metal one and a half (ν = 0.3).
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
        // P = μ (λ − λ⁻ⁿ) of a neo-Hookean solid that keeps its volume; the row of the largest stress of each test.
        let modulus = |test: &HistoryTest| {
            let [_, stretch, stress] = *test.rows().iter().max_by(|a, b| a[2].abs().total_cmp(&b[2].abs()))?;
            let strain = match test.loading() {
                Loading::SimpleShear => stretch,
                loading => stretch - stretch.powi(-thinning(loading)),
            };
            Some((stress / strain).abs()).filter(|modulus| 0.0 < *modulus && modulus.is_finite())
        };
        let mu = tests.iter().filter_map(modulus).fold(0.0, f64::max);
        let mu = if 0.0 < mu { mu } else { 1.0 };
        let largest = tests.iter().map(HistoryTest::largest_stress).fold(0.0, f64::max);
        let duration = tests.iter().filter_map(|test| Some(test.rows().last()?[0])).fold(0.0, f64::max);
        let duration = if 0.0 < duration { duration } else { 1.0 };
        let first = tests.iter().flat_map(|test| test.rows().windows(2)).map(|rows| rows[1][0] - rows[0][0]);
        let shortest = first.filter(|step| 0.0 < *step).fold(duration, f64::min);
        // A time of relaxation near the shortest step, near the duration, and between them.
        let times = [3.0 * shortest, (shortest * duration).sqrt(), 0.3 * duration];
        let bulk = 100.0 * mu;
        match self {
            Self::BergstromBoyce => {
                // γ̇ = γ̇₀ (λ̄ − 1 + ξ)^c (τ/τ₀)^m is about 1/T: with γ̇₀ = 1/s, τ₀ = τ (T (λ̄ − 1 + ξ)^c)^(1/m).
                let (power, slowing, perturbation) = (4.0, -0.5, 0.01);
                let stretch = tests.iter().map(chain_stretch).fold(1.0, f64::max);
                let resistance = (stretch - 1.0 + perturbation).powf(slowing);
                let start = |time: &f64| {
                    let stress = largest * (time * resistance).powf(1.0 / power);
                    vec![mu, bulk, mu, bulk, 1.0, stress, power, slowing, perturbation]
                };
                times.iter().map(start).collect()
            }
            Self::ReeseGovindjee => times.iter().map(|time| vec![mu, bulk, mu, bulk, mu * time]).collect(),
            Self::OgdenRoxburgh => {
                [1.5, 3.0].iter().map(|softening| vec![mu, bulk, *softening, 0.1 * largest, 0.1]).collect()
            }
            Self::Viscoplastic => {
                // A test beyond the yield stress shows less than the elastic modulus.
                let steep = |test: &HistoryTest| {
                    let rows = test.rows().iter().find(|row| 0.1 * test.largest_stress() < row[2].abs())?;
                    // P = E (λ − 1) with E/μ at ν = 0.3: 2 (1 + ν), of equal stretches 2 (1 + ν)/(1 − ν), of a sheet 2/(1 − ν).
                    let strain = match test.loading() {
                        Loading::SimpleShear => rows[1],
                        Loading::Equibiaxial => 2.6 / 0.7 * (rows[1] - 1.0),
                        Loading::Planar => 2.0 / 0.7 * (rows[1] - 1.0),
                        _ => 2.6 * (rows[1] - 1.0),
                    };
                    Some((rows[2] / strain).abs()).filter(|modulus| modulus.is_finite())
                };
                let mu = tests.iter().filter_map(steep).fold(mu, f64::max);
                times
                    .iter()
                    .map(|time| {
                        // The saturation stress is at least the yield stress.
                        vec![mu, 1.5 * mu, 0.7 * largest, 0.1 * largest, 0.9 * largest, 5.0, 0.1 * largest * time]
                    })
                    .collect()
            }
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
