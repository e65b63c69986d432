//! Material cards of finite-element programs from fitted laws.
//!
//! | program | neo-Hookean, Mooney–Rivlin, Yeoh, polynomial | Ogden |
//! |---|---|---|
//! | Abaqus, `CalculiX` | W = Σ Cᵢⱼ (I₁ − 3)ⁱ (I₂ − 3)ʲ + Σ (J − 1)²ⁱ/Dᵢ, D₁ = 2/K | W = Σ 2μ/α² (λ₁ᵅ + λ₂ᵅ + λ₃ᵅ − 3) |
//! | Ansys | the same with dᵢ | W = Σ μ/α (λ₁ᵅ + λ₂ᵅ + λ₃ᵅ − 3) |
//! | LS-DYNA | `077_H`: W = Σ Cᵢⱼ (I₁ − 3)ⁱ (I₂ − 3)ʲ, up to C₃₀, K from ν | `077_O`: W = Σ μ/α (…), K from ν |
//! | Abaqus, Ansys | van der Waals (Abaqus), extended tube (Ansys): see below | |
//! | `FEBio` | W = c₁ (I₁ − 3) + c₂ (I₂ − 3) + ½ k ln² J; no Yeoh or polynomial | W = Σ c/m² (λ₁ᵐ + λ₂ᵐ + λ₃ᵐ − 3) |
//!
//! ```text
//! Abaqus VAN DER WAALS   W = μ (−(λm² − 3)(ln(1 − η) + η) − ⅔ a (x/2)^(3/2)) + ((J² − 1)/2 − ln J)/D       μ, λm, a, β, D = 2/K
//! Ansys ETUBE            W = ½ Gc (…) + 2 Ge/β² Σ (λ^(−β) − 1) + (J − 1)²/d                               Gc, Ge, β, δ, d = 2/K
//! ```
//! Stretches and invariants are those of F/J^(1/3). Numbers are in the unit of the fitted stresses, which must be that of the model.
//!
//! `CalculiX` reads at most three terms and the first twenty characters of a number. It replaces a Dᵢ below 10⁻¹⁰ by (0.1/μ)ⁱ, which is
//! Poisson's ratio 0.475 (subroutine `hyperelastics` of its source of 2023, file `hyperelastics.f`). Therefore its cards have thirteen digits,
//! and 10³⁰ for the Dᵢ that Abaqus' cards leave zero.

use core::fmt::Write as _;
use core::str::FromStr;

use piola_fit::solids::{AnyModel, Fit};

use crate::MeasuredError;

/// A finite-element program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Program {
    /// Abaqus.
    Abaqus,
    /// `CalculiX`, whose cards are those of Abaqus in numbers of twenty characters.
    CalculiX,
    /// Ansys Mechanical APDL.
    Ansys,
    /// LS-DYNA.
    LsDyna,
    /// `FEBio`.
    FeBio,
}

impl FromStr for Program {
    type Err = MeasuredError;

    fn from_str(text: &str) -> Result<Self, MeasuredError> {
        match text.to_ascii_lowercase().as_str() {
            "abaqus" => Ok(Self::Abaqus),
            "calculix" => Ok(Self::CalculiX),
            "ansys" => Ok(Self::Ansys),
            "ls-dyna" => Ok(Self::LsDyna),
            "febio" => Ok(Self::FeBio),
            _ => Err(MeasuredError::Argument {
                argument: text.to_owned(),
                valid: "abaqus, ansys, calculix, febio or ls-dyna",
            }),
        }
    }
}

impl core::fmt::Display for Program {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::Abaqus => "Abaqus",
            Self::CalculiX => "CalculiX",
            Self::Ansys => "Ansys",
            Self::LsDyna => "LS-DYNA",
            Self::FeBio => "FEBio",
        })
    }
}

impl Program {
    /// The ending of its files.
    #[must_use]
    pub const fn ending(self) -> &'static str {
        match self {
            Self::Abaqus | Self::CalculiX => "inp",
            Self::Ansys => "mac",
            Self::LsDyna => "k",
            Self::FeBio => "xml",
        }
    }
}

/// What a fit does not tell of a material.
///
/// # Example
/// See [`card`].
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Bulk {
    /// K, in the unit of the stresses.
    pub modulus: f64,
    /// ρ, in the units of the model; LS-DYNA needs it.
    pub density: Option<f64>,
}

impl Bulk {
    /// With a bulk modulus, in the unit of the stresses.
    ///
    /// # Errors
    /// [`MeasuredError::Argument`] unless it is positive and finite.
    pub fn new(modulus: f64) -> Result<Self, MeasuredError> {
        positive("bulk modulus", modulus).map(|modulus| Self { modulus, density: None })
    }

    /// With a density, in the units of the model.
    ///
    /// # Errors
    /// [`MeasuredError::Argument`] unless it is positive and finite.
    pub fn with_density(self, density: f64) -> Result<Self, MeasuredError> {
        positive("density", density).map(|density| Self { density: Some(density), ..self })
    }

    /// Refuses programs whose cards need what is not given.
    ///
    /// # Errors
    /// [`MeasuredError::Argument`] for LS-DYNA without a density.
    pub fn check(&self, program: Program) -> Result<(), MeasuredError> {
        if program == Program::LsDyna && self.density.is_none() {
            let argument = "a card of LS-DYNA without a density".to_owned();
            return Err(MeasuredError::Argument {
                argument,
                valid: "a density in the units of the model, as 1.1e-9 t/mm³",
            });
        }
        Ok(())
    }
}

fn positive(name: &str, value: f64) -> Result<f64, MeasuredError> {
    if 0.0 < value && value.is_finite() {
        return Ok(value);
    }
    let argument = format!("{name} {value:?}");
    Err(MeasuredError::Argument { argument, valid: "a positive number in the units of the model" })
}

/// Coefficients of (I₁ − 3)ⁱ (I₂ − 3)ʲ by i and j, or μ and α of Ogden's terms.
enum Law {
    Powers(Vec<([u8; 2], f64)>),
    Stretches(Vec<[f64; 2]>),
    /// μ, λₘ, a and β.
    VanDerWaals([f64; 4]),
    /// Gc, Ge, β and δ.
    ExtendedTube([f64; 4]),
}

fn law(model: AnyModel, values: &[f64]) -> Option<Law> {
    Some(match model {
        AnyModel::NeoHookean => Law::Powers(vec![([1, 0], 0.5 * values.first()?)]),
        AnyModel::MooneyRivlin => Law::Powers(vec![([1, 0], *values.first()?), ([0, 1], *values.get(1)?)]),
        AnyModel::Yeoh => Law::Powers((1..).zip(values).map(|(i, value)| ([i, 0], *value)).collect()),
        AnyModel::Polynomial(series) => Law::Powers(series.powers().zip(values.iter().copied()).collect()),
        AnyModel::Ogden(_) => Law::Stretches(values.chunks_exact(2).map(|term| [term[0], term[1]]).collect()),
        AnyModel::VanDerWaals => Law::VanDerWaals(values.try_into().ok()?),
        AnyModel::ExtendedTube => {
            let [crosslinks, inextensibility, confinement, exponent] = values.try_into().ok()?;
            Law::ExtendedTube([crosslinks, confinement, exponent, inextensibility])
        }
        _ => return None,
    })
}

/// The card of a fitted law.
///
/// # Errors
/// [`MeasuredError::NoCard`] for a law that the program does not have; [`MeasuredError::Argument`] for LS-DYNA without a density, and in
/// `CalculiX` for more than three terms or a bulk modulus above 2·10¹⁰.
///
/// # Example
/// ```
/// use piola_measured::fitting::{Bulk, Measurements, Program, Request, card, compare};
/// let text = "mode,stretch,stress_MPa\nuniaxial,2,1.75\nuniaxial,3,2.8888889\n"; // μ = 1 MPa
/// let comparison = compare(&Measurements::parse("rubber.csv", text)?, &Request::of(vec!["neo-hookean".parse()?]))?;
/// let (law, fit) = comparison.fits().next().expect("a fit");
/// let card = card(Program::Abaqus, law, fit, Bulk::new(1000.0)?)?;
/// assert!(card.contains("*HYPERELASTIC, NEO HOOKE\n0.5") && card.contains(", 0.002")); // C₁₀ = μ/2, D₁ = 2/K
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn card(program: Program, model: AnyModel, fit: &Fit, bulk: Bulk) -> Result<String, MeasuredError> {
    bulk.check(program)?;
    let none = || MeasuredError::NoCard { law: model.to_string(), program: program.to_string() };
    let law = law(model, &fit.values()).ok_or_else(none)?;
    let name = model.to_string().replace(':', "-");
    match (program, law) {
        (Program::Abaqus, Law::VanDerWaals(four)) => {
            let numbers: Vec<f64> = four.into_iter().chain([2.0 / bulk.modulus]).collect();
            Ok(format!("*MATERIAL, NAME={name}\n*HYPERELASTIC, VAN DER WAALS\n{}\n", joined(&numbers)))
        }
        (Program::Abaqus, law) => abaqus(&name, &law, 2.0 / bulk.modulus, 0.0, &lines).ok_or_else(none),
        (Program::CalculiX, law) => calculix(&name, &law, bulk)?.ok_or_else(none),
        (Program::Ansys, law) => ansys(&name, &law, bulk).ok_or_else(none),
        (Program::LsDyna, law) => dyna(&name, &law, fit.initial_shear_modulus, bulk).ok_or_else(none),
        (Program::FeBio, law) => febio(&name, &law, bulk).ok_or_else(none),
    }
}

/// A number with all its digits.
fn number(x: f64) -> String {
    format!("{x:?}")
}

fn joined(numbers: &[f64]) -> String {
    numbers.iter().map(|x| number(*x)).collect::<Vec<_>>().join(", ")
}

/// Lines of at most eight numbers.
pub(crate) fn lines(numbers: &[f64]) -> String {
    numbers.chunks(8).map(joined).collect::<Vec<_>>().join(",\n")
}

/// The same with numbers of at most twenty characters: `CalculiX` reads no more of them.
pub(crate) fn short_lines(numbers: &[f64]) -> String {
    let joined = |line: &[f64]| line.iter().map(|x| format!("{x:.12e}")).collect::<Vec<_>>().join(", ");
    numbers.chunks(8).map(joined).collect::<Vec<_>>().join(",\n")
}

/// The most terms of `CalculiX`.
pub(crate) const MOST_OF_CALCULIX: usize = 3;

fn calculix(name: &str, law: &Law, bulk: Bulk) -> Result<Option<String>, MeasuredError> {
    /// A Dᵢ whose term counts nothing.
    const NOTHING: f64 = 1e30;
    /// A Dᵢ below which `CalculiX` takes another.
    const LEAST: f64 = 1e-10;
    let terms = match law {
        Law::Powers(powers) => usize::from(degree(powers)),
        Law::Stretches(all) => all.len(),
        _ => return Ok(None),
    };
    let inverse = 2.0 / bulk.modulus;
    let valid = match (terms <= MOST_OF_CALCULIX, LEAST <= inverse) {
        (false, _) => "laws of at most three terms",
        (_, false) => {
            "a bulk modulus of at most 2e10 in the unit of the stresses: CalculiX replaces D = 2/K below 1e-10"
        }
        _ => return Ok(abaqus(name, law, inverse, NOTHING, &short_lines)),
    };
    Err(MeasuredError::Argument { argument: format!("a card of CalculiX for {name}"), valid })
}

/// The degree of a polynomial.
fn degree(powers: &[([u8; 2], f64)]) -> u8 {
    powers.iter().map(|([i, j], _)| i + j).max().unwrap_or(1)
}

/// Whether all powers are of I₁ alone.
fn is_reduced(powers: &[([u8; 2], f64)]) -> bool {
    powers.iter().all(|([_, j], _)| *j == 0)
}

/// With D₁ and the other Dᵢ, and lines of numbers.
fn abaqus(name: &str, law: &Law, first: f64, others: f64, lines: &dyn Fn(&[f64]) -> String) -> Option<String> {
    let mut text = format!("*MATERIAL, NAME={name}\n");
    let volumetric = |terms: u8| core::iter::once(first).chain((1..terms).map(|_| others));
    match law {
        Law::Powers(powers) => {
            let terms = degree(powers);
            let kind = match (terms, is_reduced(powers)) {
                (1, true) => "NEO HOOKE".to_owned(),
                (1, false) => "MOONEY-RIVLIN".to_owned(),
                (3, true) => "YEOH".to_owned(),
                (terms, _) => format!("POLYNOMIAL, N={terms}"),
            };
            let numbers: Vec<f64> = powers.iter().map(|(_, value)| *value).chain(volumetric(terms)).collect();
            let _ = writeln!(text, "*HYPERELASTIC, {kind}\n{}", lines(&numbers));
        }
        Law::Stretches(all) => {
            // 2μ/α² is the μ/α of the fit.
            let numbers: Vec<f64> = all.iter().flat_map(|[mu, alpha]| [0.5 * mu * alpha, *alpha]).collect();
            let terms = u8::try_from(all.len()).unwrap_or(u8::MAX);
            let numbers: Vec<f64> = numbers.into_iter().chain(volumetric(terms)).collect();
            let _ = writeln!(text, "*HYPERELASTIC, OGDEN, N={terms}\n{}", lines(&numbers));
        }
        Law::VanDerWaals(_) | Law::ExtendedTube(_) => return None,
    }
    Some(text)
}

fn ansys(name: &str, law: &Law, bulk: Bulk) -> Option<String> {
    let inverse = 2.0 / bulk.modulus;
    let (kind, terms, numbers) = match law {
        Law::Powers(powers) => {
            let terms = degree(powers);
            let numbers: Vec<f64> = powers.iter().map(|(_, value)| *value).collect();
            match (terms, is_reduced(powers)) {
                // The constant of NEO is μ.
                (1, true) => ("NEO", 1, numbers.iter().map(|x| 2.0 * x).collect()),
                (1, false) => ("MOONEY", 2, numbers),
                (terms, true) => ("YEOH", terms, numbers),
                (terms, false) => ("POLY", terms, numbers),
            }
        }
        Law::Stretches(all) => {
            ("OGDEN", u8::try_from(all.len()).unwrap_or(u8::MAX), all.iter().flatten().copied().collect::<Vec<f64>>())
        }
        Law::ExtendedTube(four) => ("ETUBE", 5, four.to_vec()),
        Law::VanDerWaals(_) => return None,
    };
    let volumes = if matches!(kind, "MOONEY" | "ETUBE") { 1 } else { terms };
    let all: Vec<f64> = numbers.into_iter().chain(core::iter::once(inverse)).chain((1..volumes).map(|_| 0.0)).collect();
    let mut text = format!("! {name}\nTB,HYPER,1,1,{terms},{kind}\n");
    for (index, six) in all.chunks(6).enumerate() {
        let _ =
            writeln!(text, "TBDATA,{},{}", 6 * index + 1, six.iter().map(|x| number(*x)).collect::<Vec<_>>().join(","));
    }
    Some(text)
}

fn dyna(name: &str, law: &Law, shear: f64, bulk: Bulk) -> Option<String> {
    let poisson = (3.0 * bulk.modulus - 2.0 * shear) / (2.0 * (3.0 * bulk.modulus + shear));
    let head = format!("1, {}, {}, 0", number(bulk.density?), number(poisson));
    match law {
        Law::Powers(powers) => {
            // C10, C01, C11, C20, C02, C30.
            const PLACES: [[u8; 2]; 6] = [[1, 0], [0, 1], [1, 1], [2, 0], [0, 2], [3, 0]];
            if powers.iter().any(|(power, _)| !PLACES.contains(power)) {
                return None;
            }
            let of = |place: &[u8; 2]| powers.iter().find(|(power, _)| power == place).map_or(0.0, |(_, value)| *value);
            let numbers: Vec<f64> = PLACES.iter().map(of).collect();
            Some(format!("*MAT_HYPERELASTIC_RUBBER_TITLE\n{name}\n{head}\n{}\n", joined(&numbers)))
        }
        Law::Stretches(all) => {
            let row = |k: usize| {
                let numbers: Vec<f64> = (0..8).map(|index| all.get(index).map_or(0.0, |term| term[k])).collect();
                joined(&numbers)
            };
            Some(format!("*MAT_OGDEN_RUBBER_TITLE\n{name}\n{head}\n{}\n{}\n", row(0), row(1)))
        }
        Law::VanDerWaals(_) | Law::ExtendedTube(_) => None,
    }
}

fn febio(name: &str, law: &Law, bulk: Bulk) -> Option<String> {
    let mut body = String::new();
    let mut element = |tag: &str, value: f64| {
        let _ = writeln!(body, "  <{tag}>{}</{tag}>", number(value));
    };
    let kind = match law {
        Law::Powers(powers) if degree(powers) == 1 => {
            let of = |place: [u8; 2]| powers.iter().find(|(power, _)| *power == place).map_or(0.0, |(_, value)| *value);
            element("c1", of([1, 0]));
            element("c2", of([0, 1]));
            "Mooney-Rivlin"
        }
        Law::Powers(_) | Law::VanDerWaals(_) | Law::ExtendedTube(_) => return None,
        Law::Stretches(all) => {
            for (index, [mu, alpha]) in (1..).zip(all) {
                // c/m² is the μ/α of the fit.
                element(&format!("c{index}"), mu * alpha);
                element(&format!("m{index}"), *alpha);
            }
            "Ogden"
        }
    };
    element("k", bulk.modulus);
    Some(format!("<material id=\"1\" name=\"{name}\" type=\"{kind}\">\n{body}</material>\n"))
}
