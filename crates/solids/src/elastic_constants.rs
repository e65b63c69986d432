//! The two constants of an isotropic linear solid, from any pair of the six in use.

use crate::SolidsError;
use crate::error::{check_bound, check_finite};

const LAW: &str = "elastic constants";

/// Sign of Poisson's ratio, for pairs of constants that leave it open.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PoissonSign {
    /// 0 ≤ ν: nearly every solid.
    NonNegative,
    /// ν < 0: auxetic solids.
    Negative,
}

/// The constants of an isotropic linear solid; ν = ½ included.
///
/// | symbol | name | of λ and μ | incompressible |
/// |---|---|---|---|
/// | μ = G | shear modulus | μ | μ |
/// | λ | Lamé's first constant | λ | none |
/// | K | bulk modulus | λ + ⅔ μ | none |
/// | 1/K | compressibility | | 0 |
/// | E | Young's modulus | μ (3 λ + 2 μ)/(λ + μ) | 3 μ |
/// | ν | Poisson's ratio | λ/(2 (λ + μ)) | ½ |
/// | M | modulus of uniaxial strain (pressure waves) | λ + 2 μ | none |
///
/// All fifteen pairs determine the others, within 0 < μ and 0 < K, that is −1 < ν ≤ ½. A pair at ν = ½ gives
/// an incompressible solid: λ, K and M are then `None`, not infinite, and what needs the pressure takes it as an argument,
/// see [`MixedLinearElastic`](super::MixedLinearElastic).
///
/// # Errors
/// Each pair: [`SolidsError::NotFinite`], [`SolidsError::OutOfBounds`] beyond the bounds it states.
///
/// # Accuracy
/// A few ulp × the condition number of the pair, which is that of 1 − 2ν near ν = ½: sums that would cancel are
/// rationalised.
///
/// # Example
/// ```
/// use piola_solids::ElasticConstants;
/// let steel = ElasticConstants::from_young_poisson(200e9, 0.25)?;
/// assert_eq!((steel.shear_modulus(), steel.first_lame_parameter()), (80e9, Some(80e9)));
/// let rubber = ElasticConstants::from_young_poisson(3e6, 0.5)?;
/// assert_eq!((rubber.shear_modulus(), rubber.bulk_modulus(), rubber.compressibility()), (1e6, None, 0.0));
/// # Ok::<(), piola_solids::SolidsError>(())
/// ```
///
/// # Source
/// B(4.72), B(4.77).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Written", into = "Written"))]
pub struct ElasticConstants {
    mu: f64,
    lambda: Option<f64>,
}

fn check_positive(parameter: &'static str, value: f64, bound: &'static str) -> Result<(), SolidsError> {
    check_bound(LAW, parameter, value, bound, 0.0 < value)
}

fn check_poisson(nu: f64) -> Result<(), SolidsError> {
    check_bound(LAW, "poisson_ratio", nu, "−1 < ν ≤ ½", -1.0 < nu && nu <= 0.5)
}

fn check_compressible(nu: f64) -> Result<(), SolidsError> {
    check_bound(LAW, "poisson_ratio", nu, "−1 < ν < ½", -1.0 < nu && nu < 0.5)
}

#[expect(clippy::missing_errors_doc, reason = "they are those of all pairs, said at the type")]
impl ElasticConstants {
    /// From λ and μ that have been checked.
    /// A pair can overflow them: near ν = ½ λ is as large as the number allows.
    fn of(lambda: f64, mu: f64) -> Result<Self, SolidsError> {
        check_finite(LAW, "first_lame_parameter", lambda)?;
        check_positive("shear_modulus", mu, "0 < μ")?;
        check_finite(LAW, "3 λ + 2 μ", 3.0 * lambda + 2.0 * mu)?;
        Ok(Self { mu, lambda: Some(lambda) })
    }

    /// λ and μ: 0 < μ, 0 < 3 λ + 2 μ.
    pub fn from_lame(first_lame_parameter: f64, shear_modulus: f64) -> Result<Self, SolidsError> {
        let (lambda, mu) = (first_lame_parameter, shear_modulus);
        check_positive("shear_modulus", mu, "0 < μ")?;
        check_bound(LAW, "first_lame_parameter", lambda, "0 < 3 λ + 2 μ", 0.0 < 3.0 * lambda + 2.0 * mu)?;
        Self::of(lambda, mu)
    }

    /// An incompressible solid: ν = ½.
    pub fn incompressible(shear_modulus: f64) -> Result<Self, SolidsError> {
        check_positive("shear_modulus", shear_modulus, "0 < μ")?;
        Ok(Self { mu: shear_modulus, lambda: None })
    }

    /// E and ν: 0 < E, −1 < ν ≤ ½.
    pub fn from_young_poisson(young_modulus: f64, poisson_ratio: f64) -> Result<Self, SolidsError> {
        let (young, nu) = (young_modulus, poisson_ratio);
        check_positive("young_modulus", young, "0 < E")?;
        check_poisson(nu)?;
        let mu = 0.5 * young / (1.0 + nu);
        let beyond = 1.0 - 2.0 * nu;
        if 0.0 < beyond { Self::of(2.0 * mu * nu / beyond, mu) } else { Ok(Self { mu, lambda: None }) }
    }

    /// G and ν: 0 < G, −1 < ν ≤ ½.
    pub fn from_shear_poisson(shear_modulus: f64, poisson_ratio: f64) -> Result<Self, SolidsError> {
        let (mu, nu) = (shear_modulus, poisson_ratio);
        check_positive("shear_modulus", mu, "0 < G")?;
        check_poisson(nu)?;
        let beyond = 1.0 - 2.0 * nu;
        if 0.0 < beyond { Self::of(2.0 * mu * nu / beyond, mu) } else { Ok(Self { mu, lambda: None }) }
    }

    /// E and G: 0 < E ≤ 3 G, incompressible where they are equal.
    pub fn from_young_shear(young_modulus: f64, shear_modulus: f64) -> Result<Self, SolidsError> {
        let (young, mu) = (young_modulus, shear_modulus);
        check_positive("shear_modulus", mu, "0 < G")?;
        check_bound(LAW, "young_modulus", young, "0 < E ≤ 3 G", 0.0 < young && young <= 3.0 * mu)?;
        let beyond = 3.0 * mu - young;
        if 0.0 < beyond { Self::of(mu * (young - 2.0 * mu) / beyond, mu) } else { Ok(Self { mu, lambda: None }) }
    }

    /// K and G: 0 < K, 0 < G.
    pub fn from_bulk_shear(bulk_modulus: f64, shear_modulus: f64) -> Result<Self, SolidsError> {
        let (bulk, mu) = (bulk_modulus, shear_modulus);
        check_positive("bulk_modulus", bulk, "0 < K")?;
        check_positive("shear_modulus", mu, "0 < G")?;
        Self::of(bulk - 2.0 / 3.0 * mu, mu)
    }

    /// K and ν: 0 < K, −1 < ν < ½. At ½ a finite K would be that of a fluid.
    pub fn from_bulk_poisson(bulk_modulus: f64, poisson_ratio: f64) -> Result<Self, SolidsError> {
        let (bulk, nu) = (bulk_modulus, poisson_ratio);
        check_positive("bulk_modulus", bulk, "0 < K")?;
        check_compressible(nu)?;
        let share = 3.0 * bulk / (1.0 + nu);
        Self::of(share * nu, 0.5 * share * (1.0 - 2.0 * nu))
    }

    /// K and E: 0 < K, 0 < E < 9 K.
    pub fn from_bulk_young(bulk_modulus: f64, young_modulus: f64) -> Result<Self, SolidsError> {
        let (bulk, young) = (bulk_modulus, young_modulus);
        check_positive("bulk_modulus", bulk, "0 < K")?;
        check_bound(LAW, "young_modulus", young, "0 < E < 9 K", 0.0 < young && young < 9.0 * bulk)?;
        let share = 3.0 * bulk / (9.0 * bulk - young);
        Self::of(share * (3.0 * bulk - young), share * young)
    }

    /// λ and E: 0 < E, any λ.
    pub fn from_lame_young(first_lame_parameter: f64, young_modulus: f64) -> Result<Self, SolidsError> {
        let (lambda, young) = (first_lame_parameter, young_modulus);
        check_positive("young_modulus", young, "0 < E")?;
        check_bound(LAW, "first_lame_parameter", lambda, "finite", true)?;
        // 2 μ² + (3 λ − E) μ − λ E = 0; the root with the sum that does not cancel.
        let root = (young * young + 9.0 * lambda * lambda + 2.0 * young * lambda).sqrt();
        let linear = 3.0 * lambda - young;
        let mu = if 0.0 < linear { 2.0 * lambda * young / (root + linear) } else { 0.25 * (root - linear) };
        Self::from_lame(lambda, mu)
    }

    /// λ and ν, both of one sign and not zero: 0 < λ/ν, −1 < ν < ½.
    pub fn from_lame_poisson(first_lame_parameter: f64, poisson_ratio: f64) -> Result<Self, SolidsError> {
        let (lambda, nu) = (first_lame_parameter, poisson_ratio);
        check_compressible(nu)?;
        check_bound(LAW, "first_lame_parameter", lambda, "0 < λ/ν", 0.0 < lambda / nu)?;
        Self::of(lambda, 0.5 * (lambda / nu) * (1.0 - 2.0 * nu))
    }

    /// λ and K: 0 < K, λ < K.
    pub fn from_lame_bulk(first_lame_parameter: f64, bulk_modulus: f64) -> Result<Self, SolidsError> {
        let (lambda, bulk) = (first_lame_parameter, bulk_modulus);
        check_positive("bulk_modulus", bulk, "0 < K")?;
        check_bound(LAW, "first_lame_parameter", lambda, "λ < K", lambda < bulk)?;
        Self::of(lambda, 1.5 * (bulk - lambda))
    }

    /// λ and M: λ < M, 0 < 2 λ + M.
    pub fn from_lame_uniaxial(first_lame_parameter: f64, uniaxial_modulus: f64) -> Result<Self, SolidsError> {
        let (lambda, uniaxial) = (first_lame_parameter, uniaxial_modulus);
        check_positive("uniaxial_modulus", uniaxial, "0 < M")?;
        let holds = lambda < uniaxial && 0.0 < 2.0 * lambda + uniaxial;
        check_bound(LAW, "first_lame_parameter", lambda, "−½ M < λ < M", holds)?;
        Self::of(lambda, 0.5 * (uniaxial - lambda))
    }

    /// G and M: 0 < G, 4/3 G < M.
    pub fn from_shear_uniaxial(shear_modulus: f64, uniaxial_modulus: f64) -> Result<Self, SolidsError> {
        let (mu, uniaxial) = (shear_modulus, uniaxial_modulus);
        check_positive("shear_modulus", mu, "0 < G")?;
        check_bound(LAW, "uniaxial_modulus", uniaxial, "4/3 G < M", 4.0 * mu < 3.0 * uniaxial)?;
        Self::of(uniaxial - 2.0 * mu, mu)
    }

    /// K and M: 0 < K < M.
    pub fn from_bulk_uniaxial(bulk_modulus: f64, uniaxial_modulus: f64) -> Result<Self, SolidsError> {
        let (bulk, uniaxial) = (bulk_modulus, uniaxial_modulus);
        check_positive("bulk_modulus", bulk, "0 < K")?;
        check_bound(LAW, "uniaxial_modulus", uniaxial, "K < M", bulk < uniaxial)?;
        Self::of(0.5 * (3.0 * bulk - uniaxial), 0.75 * (uniaxial - bulk))
    }

    /// ν and M: −1 < ν < ½, 0 < M.
    pub fn from_poisson_uniaxial(poisson_ratio: f64, uniaxial_modulus: f64) -> Result<Self, SolidsError> {
        let (nu, uniaxial) = (poisson_ratio, uniaxial_modulus);
        check_positive("uniaxial_modulus", uniaxial, "0 < M")?;
        check_compressible(nu)?;
        let share = uniaxial / (1.0 - nu);
        Self::of(share * nu, 0.5 * share * (1.0 - 2.0 * nu))
    }

    /// E and M: 0 < E ≤ M. Two solids have them; the sign of ν chooses.
    pub fn from_young_uniaxial(
        young_modulus: f64,
        uniaxial_modulus: f64,
        sign: PoissonSign,
    ) -> Result<Self, SolidsError> {
        let (young, uniaxial) = (young_modulus, uniaxial_modulus);
        check_positive("uniaxial_modulus", uniaxial, "0 < M")?;
        check_bound(LAW, "young_modulus", young, "0 < E ≤ M", 0.0 < young && young <= uniaxial)?;
        // S² = (E − M)(E − 9 M); in each branch the root without a difference.
        let beyond = uniaxial - young;
        let root = (beyond * (9.0 * uniaxial - young)).sqrt();
        match sign {
            PoissonSign::NonNegative => {
                Self::of(0.25 * (beyond + root), 2.0 * young * uniaxial / (3.0 * uniaxial + young + root))
            }
            PoissonSign::Negative => {
                let share = if 0.0 < beyond { beyond / (beyond + root) } else { 0.0 };
                Self::from_lame(-2.0 * uniaxial * share, 0.125 * (3.0 * uniaxial + young + root))
            }
        }
    }

    /// μ = G, Pa.
    #[must_use]
    pub const fn shear_modulus(&self) -> f64 {
        self.mu
    }

    /// λ, Pa; none of an incompressible solid.
    #[doc(alias = "lambda")]
    #[must_use]
    pub const fn first_lame_parameter(&self) -> Option<f64> {
        self.lambda
    }

    /// K = λ + ⅔ μ, Pa; none of an incompressible solid.
    #[must_use]
    pub fn bulk_modulus(&self) -> Option<f64> {
        self.lambda.map(|lambda| lambda + 2.0 / 3.0 * self.mu)
    }

    /// 1/K, 1/Pa; zero of an incompressible solid.
    #[must_use]
    pub fn compressibility(&self) -> f64 {
        self.bulk_modulus().map_or(0.0, f64::recip)
    }

    /// E, Pa.
    #[must_use]
    pub fn young_modulus(&self) -> f64 {
        self.lambda.map_or(3.0 * self.mu, |lambda| self.mu * ((3.0 * lambda + 2.0 * self.mu) / (lambda + self.mu)))
    }

    /// ν.
    #[must_use]
    pub fn poisson_ratio(&self) -> f64 {
        self.lambda.map_or(0.5, |lambda| 0.5 * lambda / (lambda + self.mu))
    }

    /// M = λ + 2 μ, Pa; none of an incompressible solid.
    #[must_use]
    pub fn uniaxial_modulus(&self) -> Option<f64> {
        self.lambda.map(|lambda| lambda + 2.0 * self.mu)
    }

    /// True if ν = ½.
    #[must_use]
    pub const fn is_incompressible(&self) -> bool {
        self.lambda.is_none()
    }
}

/// The constants as they are written: the shear modulus alone is an incompressible solid.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    #[serde(alias = "mu")]
    shear_modulus: f64,
    #[serde(alias = "lambda", default, skip_serializing_if = "Option::is_none")]
    first_lame_parameter: Option<f64>,
}

#[cfg(feature = "serde")]
impl TryFrom<Written> for ElasticConstants {
    type Error = SolidsError;

    fn try_from(written: Written) -> Result<Self, SolidsError> {
        match written.first_lame_parameter {
            Some(lambda) => Self::from_lame(lambda, written.shear_modulus),
            None => Self::incompressible(written.shear_modulus),
        }
    }
}

#[cfg(feature = "serde")]
impl From<ElasticConstants> for Written {
    fn from(constants: ElasticConstants) -> Self {
        Self { shear_modulus: constants.mu, first_lame_parameter: constants.lambda }
    }
}
