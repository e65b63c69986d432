//! The laws of tests with sides.

use core::fmt;
use core::str::FromStr;

use piola_laws::rubber::{AnyRubber, FoamTerm, Hyperfoam, internal};
use piola_numerics::Real;
use piola_solids::{AnySolid, Fibre, HolzapfelGasserOgden};

use super::ANGLES;
use crate::FitError;
use crate::solids::Series;

/// A law of foam or of fibres, written `hyperfoam:n` (n from 1 to 6) or `holzapfel-gasser-ogden`.
///
/// # Example
/// ```
/// use piola_fit::sides::SidesModel;
/// let foam: SidesModel = "hyperfoam:2".parse()?;
/// let names: Vec<String> = foam.parameters().into_iter().map(|(name, _, _)| name).collect();
/// assert_eq!(names, ["mu1", "alpha1", "nu1", "mu2", "alpha2", "nu2"]);
/// assert!("hyperfoam:0".parse::<SidesModel>().is_err());
/// # Ok::<(), piola_fit::FitError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum SidesModel {
    /// Storåkers' foam, with so many terms.
    Hyperfoam(Series),
    /// Two families of fibres at ±γ from axis 1 in the plane 1–2, in a body that keeps its volume.
    HolzapfelGasserOgden,
}

impl SidesModel {
    /// Whether it keeps its volume.
    pub(super) const fn keeps_volume(self) -> bool {
        matches!(self, Self::HolzapfelGasserOgden)
    }

    /// Name, whether it is a stress, and bounds of each parameter.
    #[must_use]
    pub fn parameters(self) -> Vec<(String, bool, [f64; 2])> {
        const POSITIVE: [f64; 2] = [0.0, f64::INFINITY];
        match self {
            Self::Hyperfoam(series) => (1..=series.count())
                .flat_map(|k| {
                    [
                        (format!("mu{k}"), true, POSITIVE),
                        (format!("alpha{k}"), false, [-30.0, 30.0]),
                        (format!("nu{k}"), false, [-0.9, 0.499]),
                    ]
                })
                .collect(),
            Self::HolzapfelGasserOgden => vec![
                ("mu".to_owned(), true, POSITIVE),
                ("k1".to_owned(), true, POSITIVE),
                ("k2".to_owned(), false, POSITIVE),
                ("angle".to_owned(), false, ANGLES),
                ("dispersion".to_owned(), false, [0.0, 1.0 / 3.0]),
            ],
        }
    }

    /// W at the logarithms of the stretches along the axes.
    pub(super) fn energy<T: Real>(self, logarithms: [T; 3], parameters: &[T]) -> T {
        match self {
            Self::Hyperfoam(_) => {
                let mut energy = T::zero();
                for term in parameters.chunks_exact(3) {
                    energy += internal::hyperfoam_term([term[0], term[1], term[2]], logarithms);
                }
                energy
            }
            Self::HolzapfelGasserOgden => {
                let [a, b, c] = logarithms.map(|x| (T::lit(2.0) * x).exp_m1());
                let (sine, cosine) = parameters[3].sin_cos();
                // Both families have the same strain.
                fibrous(a + b + c, [cosine * cosine * a + sine * sine * b; 2], parameters)
            }
        }
    }

    /// Where a search starts, for stresses of this size.
    pub(super) fn starts(self, stress: f64) -> Vec<Vec<f64>> {
        /// Starts, at most.
        const STARTS: usize = 30;
        match self {
            Self::Hyperfoam(series) => {
                const LIST: [f64; 7] = [2.0, -2.0, 8.0, 16.0, -8.0, 4.0, -16.0];
                let modulus = stress / series.count() as f64;
                let mut starts = Vec::new();
                for choice in 0_usize..1 << LIST.len() {
                    if choice.count_ones() as usize == series.count() {
                        let chosen = (0..LIST.len()).filter(|k| choice >> k & 1 == 1);
                        starts.push(chosen.flat_map(|k| [modulus, LIST[k], 0.2]).collect());
                    }
                }
                let stride = starts.len().div_ceil(STARTS).max(1);
                starts.into_iter().step_by(stride).collect()
            }
            Self::HolzapfelGasserOgden => {
                let mut starts = Vec::new();
                for exponent in [0.3, 3.0, 30.0] {
                    for angle in [0.3, 0.8, 1.2] {
                        for share in [0.5, 0.05] {
                            starts.push(vec![share * stress, share * stress, exponent, angle, 0.1]);
                        }
                    }
                }
                starts
            }
        }
    }

    /// Terms of a foam by falling exponents.
    pub(super) fn ordered(self, parameters: Vec<f64>) -> Vec<f64> {
        match self {
            Self::Hyperfoam(_) => {
                let mut terms: Vec<&[f64]> = parameters.chunks_exact(3).collect();
                terms.sort_by(|a, b| b[1].total_cmp(&a[1]));
                terms.concat()
            }
            Self::HolzapfelGasserOgden => parameters,
        }
    }

    /// The law with these parameters; a foam has its own law of volumes, and needs no bulk modulus.
    ///
    /// # Errors
    /// [`FitError::NumberOfValues`]; what the law's constructor refuses.
    pub fn law(self, parameters: &[f64], bulk_modulus: f64) -> Result<AnyRubber, FitError> {
        let (expected, values) = (self.parameters().len(), parameters.len());
        if expected != values {
            return Err(FitError::NumberOfValues { model: self.to_string(), parameters: expected, values });
        }
        Ok(match self {
            Self::Hyperfoam(_) => {
                let term = |term: &[f64]| FoamTerm { modulus: term[0], exponent: term[1], poisson_ratio: term[2] };
                Hyperfoam::new(&parameters.chunks_exact(3).map(term).collect::<Vec<_>>())?.into()
            }
            Self::HolzapfelGasserOgden => {
                let (sine, cosine) = parameters[3].sin_cos();
                let fibres = [Fibre::new([cosine, sine, 0.0])?, Fibre::new([cosine, -sine, 0.0])?];
                let [mu, k1, k2, d] = [parameters[0], parameters[1], parameters[2], parameters[4]];
                AnySolid::from(HolzapfelGasserOgden::new(mu, bulk_modulus, k1, k2, d, fibres)?).into()
            }
        })
    }
}

/// W of a strip that was cut at an angle from axis 1 and is pulled along itself, at the logarithms of its stretch and of its width,
/// and at its shear s: F = ((λ, s), (0, m)) in the plane, 1/(λ m) across it. It is that of Holzapfel, Gasser and Ogden's law; a foam has no directions.
pub(super) fn oblique_energy<T: Real>(from_axis: f64, [x, width, shear]: [T; 3], parameters: &[T]) -> T {
    let two = T::lit(2.0);
    let (a, b) = ((two * x).exp_m1(), (two * width).exp_m1() + shear * shear);
    let (mixed, across) = (x.exp() * shear, (-two * (x + width)).exp_m1());
    let family = |sign: f64| {
        let (sine, cosine) = (T::lit(sign) * parameters[3] - T::lit(from_axis)).sin_cos();
        cosine * cosine * a + two * cosine * sine * mixed + sine * sine * b
    };
    fibrous(a + b + across, [family(1.0), family(-1.0)], parameters)
}

/// W of Holzapfel, Gasser and Ogden's law at I₁ − 3 and at I₄ − 1 of both families.
fn fibrous<T: Real>(first: T, along: [T; 2], parameters: &[T]) -> T {
    let [mu, k1, k2, dispersion] = [0, 1, 2, 4].map(|k| parameters[k]);
    let (one, half) = (T::one(), T::lit(0.5));
    let family = |along: T| {
        let strain = dispersion * first + (one - T::lit(3.0) * dispersion) * along;
        let tension = T::select(T::zero().less_than(strain), strain, T::zero());
        (k2 * tension * tension).exp_m1()
    };
    half * mu * first + half * k1 / k2 * (family(along[0]) + family(along[1]))
}

impl fmt::Display for SidesModel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Hyperfoam(series) => write!(f, "hyperfoam:{}", series.count()),
            Self::HolzapfelGasserOgden => f.write_str("holzapfel-gasser-ogden"),
        }
    }
}

impl FromStr for SidesModel {
    type Err = FitError;

    fn from_str(text: &str) -> Result<Self, FitError> {
        let unknown = || FitError::UnknownSidesModel { name: text.to_owned() };
        match text.split_once(':') {
            Some(("hyperfoam", count)) => Ok(Self::Hyperfoam(Series::new(count.parse().map_err(|_| unknown())?)?)),
            None if text == "holzapfel-gasser-ogden" => Ok(Self::HolzapfelGasserOgden),
            _ => Err(unknown()),
        }
    }
}
