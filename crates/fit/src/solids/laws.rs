//! The models that are built in.

use core::fmt;
use core::str::FromStr;

use piola_laws::rubber::{self, AnyRubber, RubberShape};
use piola_numerics::Real;
use piola_numerics::internal::outlined;
use piola_solids::isochoric::{self, RivlinTerm};
use piola_solids::{
    AnyIsochoric, AnyVolumetric, Compressible, IncompressibleOgden, IncompressibleSolid, IsochoricOgden, OgdenTerm,
    internal,
};

use super::{Embedding, Model, Parameter, StableSign};
use crate::FitError;

/// The largest number of terms, or degree, of a series.
const MOST: usize = 6;
/// Exponents of Ogden's terms stay within this.
const EXPONENTS: [f64; 2] = [-30.0, 30.0];
/// Exponents of Lopez-Pamies' terms: from ½ on they are convex in F.
const LOPEZ_PAMIES: [f64; 2] = [0.5, 30.0];
/// Where their search starts.
const LOPEZ_PAMIES_STARTS: [[f64; 2]; 6] = [[3.0, 0.7], [1.5, 0.5], [5.0, 1.0], [9.0, 0.6], [2.0, 1.0], [14.0, 1.2]];
/// The least locking stretch of the van der Waals law: 3 < λₘ².
const LEAST_LOCKING: f64 = 1.733;
/// Exponents of tubes.
const TUBES: [f64; 2] = [1e-3, 1.0];
/// Starts of a search, at most.
const STARTS: usize = 48;

/// A built-in model, written `neo-hookean`, `mooney-rivlin`, `yeoh`, `gent`, `arruda-boyce`, `carroll`, `lopez-pamies`, `van-der-waals`,
/// `extended-tube`, `polynomial:n`, `ogden:n`.
///
/// | model | W | parameters |
/// |---|---|---|
/// | `NeoHookean` | ½ μ (I₁ − 3) | μ |
/// | `MooneyRivlin` | C₁₀ (I₁ − 3) + C₀₁ (I₂ − 3) | C₁₀, C₀₁ |
/// | `Yeoh` | Σ Cᵢ (I₁ − 3)ⁱ, i = 1, 2, 3 | Cᵢ |
/// | `Gent` | −½ μ Jₘ ln(1 − (I₁ − 3)/Jₘ) | μ, Jₘ |
/// | `ArrudaBoyce` | n N (β λ − ln(sinh β/β)), λ = √(I₁/3N), ℒ(β) = λ | n, N |
/// | `Carroll` | A (I₁ − 3) + B (I₁⁴ − 81) + C (√I₂ − √3) | A, B, C |
/// | `LopezPamies` | Σ 3^(1−αᵣ)/(2 αᵣ) μᵣ (I₁^αᵣ − 3^αᵣ), r = 1, 2 | μᵣ, αᵣ |
/// | `VanDerWaals` | μ (−(λₘ² − 3)(ln(1 − η) + η) − ⅔ a (x/2)^(3/2)), x = (1 − β)(I₁ − 3) + β (I₂ − 3) | μ, λₘ, a, β |
/// | `ExtendedTube` | ½ Gc ((1 − δ²) x/(1 − δ² x) + ln(1 − δ² x)) + 2 Ge/β² Σ (λₐ^(−β) − 1), x = I₁ − 3 | Gc, δ, Ge, β |
/// | `Polynomial(n)` | Σ Cᵢⱼ (I₁ − 3)ⁱ (I₂ − 3)ʲ, 1 ≤ i + j ≤ n | Cᵢⱼ |
/// | `Ogden(n)` | Σ μₚ/αₚ (λ₁^αₚ + λ₂^αₚ + λ₃^αₚ − 3) | μₚ, αₚ |
///
/// The energies are those of the laws of [`piola_solids`] and [`piola_laws::rubber`], the same functions over numbers that have derivatives with respect to the
/// parameters; [`law`](Self::law) and [`compressible`](Self::compressible) make laws of fitted parameters.
///
/// They are stable by the signs of their parameters: μ, n, C₁₀, C₀₁, A, B, C, Gc and Ge not negative, and 0 ≤ μₚ αₚ. Yeoh's and the
/// polynomial have no such signs that are necessary: their stability is looked at where there are data.
///
/// # Example
/// ```
/// use piola_fit::solids::{AnyModel, Model};
/// let ogden: AnyModel = "ogden:2".parse()?;
/// let names: Vec<_> = ogden.parameters(5.0).into_iter().map(|parameter| parameter.name).collect();
/// assert_eq!(names, ["mu1", "alpha1", "mu2", "alpha2"]);
/// let energy: f64 = ogden.energy([2.0, 1.0, 0.5], &[3.0, 2.0, 1.0, -2.0]); // I₁ = I₂ = 5.25
/// assert!((energy - (3.375 - 1.125)).abs() < 1e-15);
/// assert!("ogden:0".parse::<AnyModel>().is_err());
/// # Ok::<(), piola_fit::FitError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "String", into = "String"))]
#[non_exhaustive]
pub enum AnyModel {
    /// ½ μ (I₁ − 3).
    NeoHookean,
    /// C₁₀ (I₁ − 3) + C₀₁ (I₂ − 3).
    MooneyRivlin,
    /// Three powers of I₁ − 3.
    Yeoh,
    /// A logarithm with a limit of I₁.
    Gent,
    /// Eight chains.
    ArrudaBoyce,
    /// I₁, I₁⁴ and √I₂.
    Carroll,
    /// Two powers of I₁.
    LopezPamies,
    /// Chains that end and attract each other (Kilian).
    VanDerWaals,
    /// Cross-links and tubes (Kaliske, Heinrich).
    ExtendedTube,
    /// Powers of I₁ − 3 and I₂ − 3 up to a degree, from 1 to 6.
    Polynomial(Series),
    /// Powers of the stretches, from 1 to 6 of them.
    Ogden(Series),
}

/// The number of terms, or the degree, of a series: from 1 to 6.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Series(usize);

impl Series {
    /// Of a number.
    ///
    /// # Errors
    /// [`FitError::SeriesLength`].
    pub const fn new(count: usize) -> Result<Self, FitError> {
        if 1 <= count && count <= MOST { Ok(Self(count)) } else { Err(FitError::SeriesLength { value: count }) }
    }

    /// The number.
    #[must_use]
    pub const fn count(self) -> usize {
        self.0
    }

    /// (i, j) with 1 ≤ i + j ≤ n, by degree, powers of I₁ − 3 first: those of the coefficients Cᵢⱼ of a polynomial.
    pub fn powers(self) -> impl Iterator<Item = [u8; 2]> {
        let degrees = (1_u8..).take(self.0);
        degrees.flat_map(|degree| (0..=degree).map(move |j| [degree - j, j]))
    }
}

/// What a model with its parameters says of a change of shape.
enum Shape {
    Invariants(AnyIsochoric),
    Stretches(Vec<OgdenTerm>),
    Rubber(RubberShape),
    Tube(rubber::ExtendedTube),
}

impl AnyModel {
    /// All names that can be parsed.
    pub const NAMES: [&'static str; 11] = [
        "neo-hookean",
        "mooney-rivlin",
        "yeoh",
        "gent",
        "arruda-boyce",
        "carroll",
        "lopez-pamies",
        "van-der-waals",
        "extended-tube",
        "polynomial:n",
        "ogden:n",
    ];

    /// The incompressible law with these parameters, without excess pressure.
    ///
    /// # Errors
    /// [`FitError::NumberOfValues`]; what the law's constructor refuses, such as a modulus that is not positive.
    ///
    /// # Example
    /// See [`Fit::law`](super::Fit::law).
    pub fn law(&self, parameters: &[f64]) -> Result<AnyRubber, FitError> {
        Ok(match self.shape(parameters)? {
            Shape::Invariants(isochoric) => IncompressibleSolid::new(isochoric).into(),
            Shape::Stretches(terms) => IncompressibleOgden::new(&terms)?.into(),
            Shape::Rubber(shape) => AnyRubber::of_shape(shape, None)?,
            Shape::Tube(tube) => AnyRubber::of_tube(tube, None)?,
        })
    }

    /// The compressible law whose energy of the change of shape has these parameters.
    ///
    /// # Errors
    /// As [`law`](Self::law).
    pub fn compressible(
        &self,
        parameters: &[f64],
        volumetric: impl Into<AnyVolumetric>,
    ) -> Result<AnyRubber, FitError> {
        let volumetric = volumetric.into();
        Ok(match self.shape(parameters)? {
            Shape::Invariants(isochoric) => Compressible::checked(isochoric, volumetric)?.into(),
            Shape::Stretches(terms) => IsochoricOgden::with_volumetric(&terms, volumetric)?.into(),
            Shape::Rubber(shape) => AnyRubber::of_shape(shape, Some(volumetric))?,
            Shape::Tube(tube) => AnyRubber::of_tube(tube, Some(volumetric))?,
        })
    }

    fn shape(&self, parameters: &[f64]) -> Result<Shape, FitError> {
        // The number of parameters is the same for any data; 3 is the invariant of the reference.
        let (values, expected) = (parameters.len(), self.parameters(3.0).len());
        if values != expected {
            return Err(FitError::NumberOfValues { model: self.to_string(), parameters: expected, values });
        }
        let p = parameters;
        Ok(Shape::Invariants(match self {
            Self::NeoHookean => isochoric::NeoHookean::new(p[0])?.into(),
            Self::MooneyRivlin => isochoric::MooneyRivlin::new(p[0], p[1])?.into(),
            Self::Yeoh => isochoric::Yeoh::new(p[0], p[1], p[2])?.into(),
            Self::Gent => isochoric::Gent::new(p[0], p[1])?.into(),
            Self::ArrudaBoyce => isochoric::ArrudaBoyce::new(p[0], p[1])?.into(),
            Self::Polynomial(series) => {
                let term = |([first, second], &coefficient): ([u8; 2], &f64)| RivlinTerm { first, second, coefficient };
                isochoric::Rivlin::new(series.powers().zip(p).map(term).collect())?.into()
            }
            Self::Carroll => return Ok(Shape::Rubber(rubber::Carroll::new(p[0], p[1], p[2])?.into())),
            Self::LopezPamies => return Ok(Shape::Rubber(rubber::LopezPamies::new(p[0], p[1], p[2], p[3])?.into())),
            Self::VanDerWaals => return Ok(Shape::Rubber(rubber::VanDerWaals::new(p[0], p[1], p[2], p[3])?.into())),
            Self::ExtendedTube => return Ok(Shape::Tube(rubber::ExtendedTube::new(p[0], p[1], p[2], p[3])?)),
            Self::Ogden(_) => {
                let terms = p.chunks_exact(2).map(|term| OgdenTerm { modulus: term[0], exponent: term[1] });
                return Ok(Shape::Stretches(terms.collect()));
            }
        }))
    }
}

impl fmt::Display for AnyModel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NeoHookean => f.write_str("neo-hookean"),
            Self::MooneyRivlin => f.write_str("mooney-rivlin"),
            Self::Yeoh => f.write_str("yeoh"),
            Self::Gent => f.write_str("gent"),
            Self::ArrudaBoyce => f.write_str("arruda-boyce"),
            Self::Carroll => f.write_str("carroll"),
            Self::LopezPamies => f.write_str("lopez-pamies"),
            Self::VanDerWaals => f.write_str("van-der-waals"),
            Self::ExtendedTube => f.write_str("extended-tube"),
            Self::Polynomial(series) => write!(f, "polynomial:{}", series.0),
            Self::Ogden(series) => write!(f, "ogden:{}", series.0),
        }
    }
}

impl FromStr for AnyModel {
    type Err = FitError;

    fn from_str(text: &str) -> Result<Self, FitError> {
        let unknown = || FitError::UnknownModel { name: text.to_owned() };
        let series = |count: &str| Series::new(count.parse().map_err(|_| unknown())?);
        match text.split_once(':') {
            None => match text {
                "neo-hookean" => Ok(Self::NeoHookean),
                "mooney-rivlin" => Ok(Self::MooneyRivlin),
                "yeoh" => Ok(Self::Yeoh),
                "gent" => Ok(Self::Gent),
                "arruda-boyce" => Ok(Self::ArrudaBoyce),
                "carroll" => Ok(Self::Carroll),
                "lopez-pamies" => Ok(Self::LopezPamies),
                "van-der-waals" => Ok(Self::VanDerWaals),
                "extended-tube" => Ok(Self::ExtendedTube),
                _ => Err(unknown()),
            },
            Some(("polynomial", count)) => Ok(Self::Polynomial(series(count)?)),
            Some(("ogden", count)) => Ok(Self::Ogden(series(count)?)),
            Some(_) => Err(unknown()),
        }
    }
}

impl TryFrom<String> for AnyModel {
    type Error = FitError;

    fn try_from(text: String) -> Result<Self, FitError> {
        text.parse()
    }
}

impl From<AnyModel> for String {
    fn from(model: AnyModel) -> Self {
        model.to_string()
    }
}

impl Model for AnyModel {
    fn name(&self) -> String {
        self.to_string()
    }

    fn parameters(&self, largest_first_invariant: f64) -> Vec<Parameter> {
        let positive = |name: &str| Parameter::factor(name).stable_if(StableSign::NotNegative);
        match self {
            Self::NeoHookean => vec![positive("mu")],
            Self::MooneyRivlin => vec![positive("C10"), positive("C01")],
            Self::Yeoh => ["C10", "C20", "C30"].map(Parameter::factor).into(),
            Self::Gent => vec![positive("mu"), Parameter::number("Jm", [largest_first_invariant - 3.0, f64::INFINITY])],
            Self::ArrudaBoyce => {
                let links = (largest_first_invariant / 3.0).max(1.0);
                vec![positive("n"), Parameter::number("N", [links, f64::INFINITY])]
            }
            Self::Carroll => ["A", "B", "C"].map(positive).into(),
            Self::LopezPamies => {
                let exponent = |name: &str| Parameter::number(name, LOPEZ_PAMIES);
                vec![positive("mu1"), exponent("alpha1"), positive("mu2"), exponent("alpha2")]
            }
            Self::VanDerWaals => vec![
                positive("mu"),
                Parameter::number("lambda_m", [LEAST_LOCKING, f64::INFINITY]),
                Parameter::number("a", [0.0, f64::INFINITY]),
                Parameter::number("beta", [0.0, 1.0]),
            ],
            Self::ExtendedTube => vec![
                positive("Gc"),
                Parameter::number("delta", [0.0, most_inextensible(largest_first_invariant)]),
                positive("Ge"),
                Parameter::number("beta", TUBES),
            ],
            Self::Polynomial(series) => series.powers().map(|[i, j]| Parameter::factor(format!("C{i}{j}"))).collect(),
            Self::Ogden(series) => (0..series.0)
                .flat_map(|p| {
                    let exponent = StableSign::SameAs(2 * p + 1);
                    [
                        Parameter::factor(format!("mu{}", p + 1)).stable_if(exponent),
                        Parameter::number(format!("alpha{}", p + 1), EXPONENTS),
                    ]
                })
                .collect(),
        }
    }

    fn energy<T: Real>(&self, stretches: [T; 3], parameters: &[T]) -> T {
        let [a, b, c] = stretches.map(|x| x * x);
        let three = T::lit(3.0);
        let first = a + b + c - three;
        let second = || a * b + b * c + c * a - three;
        match self {
            Self::NeoHookean => internal::neo_hookean(parameters[0], first),
            Self::MooneyRivlin => internal::mooney_rivlin([parameters[0], parameters[1]], first, second()),
            Self::Yeoh => internal::yeoh([parameters[0], parameters[1], parameters[2]], first),
            Self::Gent => outlined(|| internal::gent(parameters[0], parameters[1], first)),
            Self::ArrudaBoyce => outlined(|| internal::arruda_boyce(parameters[0], parameters[1], first)),
            Self::Carroll => {
                outlined(|| rubber::internal::carroll([parameters[0], parameters[1], parameters[2]], first, second()))
            }
            Self::LopezPamies => {
                let term = |at: usize| {
                    outlined(|| rubber::internal::lopez_pamies_term(parameters[at], parameters[at + 1], first))
                };
                term(0) + term(2)
            }
            Self::VanDerWaals => outlined(|| {
                let four = [parameters[0], parameters[1], parameters[2], parameters[3]];
                rubber::internal::van_der_waals(four, first, second())
            }),
            Self::ExtendedTube => {
                let [a, b, c] =
                    stretches.map(|x| outlined(|| rubber::internal::tube(parameters[2], parameters[3], x.ln())));
                outlined(|| rubber::internal::crosslinked_network(parameters[0], parameters[1], first)) + (a + b + c)
            }
            Self::Polynomial(series) => {
                let second = second();
                let mut energy = T::zero();
                for (powers, factor) in series.powers().zip(parameters) {
                    energy += outlined(|| internal::rivlin_term(*factor, powers, first, second));
                }
                energy
            }
            Self::Ogden(_) => {
                let logarithms = stretches.map(|x| outlined(|| x.ln()));
                let mut energy = T::zero();
                for term in parameters.chunks_exact(2) {
                    let [a, b, c] = logarithms.map(|x| outlined(|| internal::ogden_term(term[0], term[1], x)));
                    energy += a + b + c;
                }
                energy
            }
        }
    }

    fn starts(&self, largest_first_invariant: f64) -> Vec<Vec<f64>> {
        /// Beyond the limit of extensibility that the data show.
        const BEYOND: [f64; 5] = [1.02, 1.2, 2.0, 8.0, 100.0];
        match self {
            Self::Gent => BEYOND.iter().map(|x| vec![x * (largest_first_invariant - 3.0).max(0.1)]).collect(),
            Self::ArrudaBoyce => BEYOND.iter().map(|x| vec![x * (largest_first_invariant / 3.0).max(1.0)]).collect(),
            Self::LopezPamies => LOPEZ_PAMIES_STARTS.iter().map(|pair| pair.to_vec()).collect(),
            Self::VanDerWaals => {
                let mut starts = Vec::new();
                for beyond in [1.05, 1.3, 2.0, 6.0] {
                    for (a, beta) in [(0.1, 1e-3), (0.3, 0.05), (0.3, 0.3), (1.0, 0.9)] {
                        starts.push(vec![beyond * largest_first_invariant.sqrt(), a, beta]);
                    }
                }
                starts
            }
            Self::ExtendedTube => {
                let most = most_inextensible(largest_first_invariant);
                let pairs = [0.3, 0.7, 0.95].into_iter().flat_map(|part| [0.1, 0.4, 0.9].map(|beta| (part, beta)));
                pairs.map(|(part, beta)| vec![part * most, beta]).collect()
            }
            Self::Ogden(series) => exponents(series.0),
            _ => vec![vec![]],
        }
    }

    fn contained(&self) -> Vec<(Self, Vec<Embedding>)> {
        use Embedding::{Constant, Parameter};
        match *self {
            Self::NeoHookean | Self::Gent | Self::ArrudaBoyce | Self::VanDerWaals => Vec::new(),
            Self::LopezPamies => {
                let places = vec![Parameter(0, 1.0), Constant(1.0), Constant(0.0), Constant(2.0)];
                vec![(Self::NeoHookean, places)]
            }
            Self::ExtendedTube => {
                let places = vec![Parameter(0, 1.0), Constant(0.0), Constant(0.0), Constant(1.0)];
                vec![(Self::NeoHookean, places)]
            }
            Self::MooneyRivlin => vec![(Self::NeoHookean, vec![Parameter(0, 0.5), Constant(0.0)])],
            Self::Yeoh | Self::Carroll => {
                vec![(Self::NeoHookean, vec![Parameter(0, 0.5), Constant(0.0), Constant(0.0)])]
            }
            Self::Polynomial(series) => {
                let count = series.powers().count();
                let fill = |mut places: Vec<Embedding>| {
                    places.resize(count, Constant(0.0));
                    places
                };
                let own = |n: usize| (0..n).map(|k| Parameter(k, 1.0)).collect::<Vec<_>>();
                if series.0 == 1 {
                    return vec![(Self::MooneyRivlin, own(2))];
                }
                let lower = Series(series.0 - 1);
                let mut contained = vec![(Self::Polynomial(lower), fill(own(lower.powers().count())))];
                if series.0 == 3 {
                    // C10, C20 and C30 are the first of each degree.
                    let mut places = fill(Vec::new());
                    (places[0], places[2], places[5]) = (Parameter(0, 1.0), Parameter(1, 1.0), Parameter(2, 1.0));
                    contained.push((Self::Yeoh, places));
                }
                contained
            }
            Self::Ogden(series) if series.0 == 1 => vec![(Self::NeoHookean, vec![Parameter(0, 1.0), Constant(2.0)])],
            Self::Ogden(series) => {
                let mut places: Vec<Embedding> = (0..2 * (series.0 - 1)).map(|k| Parameter(k, 1.0)).collect();
                places.extend([Constant(0.0), Constant(1.0)]);
                let mut contained = vec![(Self::Ogden(Series(series.0 - 1)), places)];
                if series.0 == 2 {
                    let terms = vec![Parameter(0, 2.0), Constant(2.0), Parameter(1, -2.0), Constant(-2.0)];
                    contained.push((Self::MooneyRivlin, terms));
                }
                contained
            }
        }
    }

    /// Terms by falling exponents.
    fn order(&self, parameters: &mut [f64]) {
        if let Self::Ogden(_) | Self::LopezPamies = self {
            let mut terms: Vec<[f64; 2]> = parameters.chunks_exact(2).map(|term| [term[0], term[1]]).collect();
            terms.sort_by(|a, b| b[1].total_cmp(&a[1]));
            for (place, term) in parameters.chunks_exact_mut(2).zip(terms) {
                place.copy_from_slice(&term);
            }
        }
    }
}

/// The largest δ of an extended tube: 2 δ² < 1, and δ² (I₁ − 3) < 1 at all data.
fn most_inextensible(largest_first_invariant: f64) -> f64 {
    (largest_first_invariant - 3.0).max(2.1).sqrt().recip()
}

/// Sets of different exponents, evenly from all that can be chosen of a list.
fn exponents(terms: usize) -> Vec<Vec<f64>> {
    const LIST: [f64; 9] = [2.0, -2.0, 1.0, 6.0, 4.0, -1.0, 9.0, -4.0, 14.0];
    let mut sets = Vec::new();
    for choice in 0_usize..1 << LIST.len() {
        if choice.count_ones() as usize == terms {
            sets.push((0..LIST.len()).filter(|k| choice >> k & 1 == 1).map(|k| LIST[k]).collect());
        }
    }
    let stride = sets.len().div_ceil(STARTS).max(1);
    sets.into_iter().step_by(stride).collect()
}
