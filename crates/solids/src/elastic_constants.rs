//! The two constants of an isotropic linear solid, from any pair of the six in use.

use crate::SolidsError;
use crate::error::{check_bound, check_finite};

const LAW: &str = "elastic constants";

/// Whether Poisson's ratio is below zero, where a pair of constants leaves it open.
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
/// # Accuracy
/// A few ulp × the condition number of the pair, which is that of 1 − 2ν near ν = ½: sums that would cancel are
/// rationalised.
///
/// # Example
/// ```
/// use piola_solids::ElasticConstants;
/// let steel = ElasticConstants::from_young_poisson(200e9, 0.25)?;
/// assert_eq!((steel.shear_modulus(), steel.lame()), (80e9, Some(80e9)));
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
    check_bound(LAW, "nu", nu, "−1 < ν ≤ ½", -1.0 < nu && nu <= 0.5)
}

fn check_compressible(nu: f64) -> Result<(), SolidsError> {
    check_bound(LAW, "nu", nu, "−1 < ν < ½", -1.0 < nu && nu < 0.5)
}

impl ElasticConstants {
    /// From λ and μ that have been checked.
    /// A pair can overflow them: near ν = ½ λ is as large as the number allows.
    fn of(lambda: f64, mu: f64) -> Result<Self, SolidsError> {
        check_finite(LAW, "lambda", lambda)?;
        check_positive("mu", mu, "0 < μ")?;
        check_finite(LAW, "3 λ + 2 μ", 3.0 * lambda + 2.0 * mu)?;
        Ok(Self { mu, lambda: Some(lambda) })
    }

    /// λ and μ: 0 < μ, 0 < 3 λ + 2 μ.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`], [`SolidsError::OutOfBounds`]; so of all pairs.
    pub fn from_lame(lambda: f64, mu: f64) -> Result<Self, SolidsError> {
        check_positive("mu", mu, "0 < μ")?;
        check_bound(LAW, "lambda", lambda, "0 < 3 λ + 2 μ", 0.0 < 3.0 * lambda + 2.0 * mu)?;
        Self::of(lambda, mu)
    }

    /// An incompressible solid: ν = ½.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`], [`SolidsError::OutOfBounds`].
    pub fn incompressible(mu: f64) -> Result<Self, SolidsError> {
        check_positive("mu", mu, "0 < μ")?;
        Ok(Self { mu, lambda: None })
    }

    /// E and ν: 0 < E, −1 < ν ≤ ½.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`], [`SolidsError::OutOfBounds`].
    pub fn from_young_poisson(young: f64, nu: f64) -> Result<Self, SolidsError> {
        check_positive("E", young, "0 < E")?;
        check_poisson(nu)?;
        let mu = 0.5 * young / (1.0 + nu);
        let beyond = 1.0 - 2.0 * nu;
        if 0.0 < beyond { Self::of(2.0 * mu * nu / beyond, mu) } else { Ok(Self { mu, lambda: None }) }
    }

    /// G and ν: 0 < G, −1 < ν ≤ ½.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`], [`SolidsError::OutOfBounds`].
    pub fn from_shear_poisson(mu: f64, nu: f64) -> Result<Self, SolidsError> {
        check_positive("G", mu, "0 < G")?;
        check_poisson(nu)?;
        let beyond = 1.0 - 2.0 * nu;
        if 0.0 < beyond { Self::of(2.0 * mu * nu / beyond, mu) } else { Ok(Self { mu, lambda: None }) }
    }

    /// E and G: 0 < E ≤ 3 G, incompressible where they are equal.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`], [`SolidsError::OutOfBounds`].
    pub fn from_young_shear(young: f64, mu: f64) -> Result<Self, SolidsError> {
        check_positive("G", mu, "0 < G")?;
        check_bound(LAW, "E", young, "0 < E ≤ 3 G", 0.0 < young && young <= 3.0 * mu)?;
        let beyond = 3.0 * mu - young;
        if 0.0 < beyond { Self::of(mu * (young - 2.0 * mu) / beyond, mu) } else { Ok(Self { mu, lambda: None }) }
    }

    /// K and G: 0 < K, 0 < G.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`], [`SolidsError::OutOfBounds`].
    pub fn from_bulk_shear(bulk: f64, mu: f64) -> Result<Self, SolidsError> {
        check_positive("K", bulk, "0 < K")?;
        check_positive("G", mu, "0 < G")?;
        Self::of(bulk - 2.0 / 3.0 * mu, mu)
    }

    /// K and ν: 0 < K, −1 < ν < ½. At ½ a finite K would be that of a fluid.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`], [`SolidsError::OutOfBounds`].
    pub fn from_bulk_poisson(bulk: f64, nu: f64) -> Result<Self, SolidsError> {
        check_positive("K", bulk, "0 < K")?;
        check_compressible(nu)?;
        let share = 3.0 * bulk / (1.0 + nu);
        Self::of(share * nu, 0.5 * share * (1.0 - 2.0 * nu))
    }

    /// K and E: 0 < K, 0 < E < 9 K.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`], [`SolidsError::OutOfBounds`].
    pub fn from_bulk_young(bulk: f64, young: f64) -> Result<Self, SolidsError> {
        check_positive("K", bulk, "0 < K")?;
        check_bound(LAW, "E", young, "0 < E < 9 K", 0.0 < young && young < 9.0 * bulk)?;
        let share = 3.0 * bulk / (9.0 * bulk - young);
        Self::of(share * (3.0 * bulk - young), share * young)
    }

    /// λ and E: 0 < E, any λ.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`], [`SolidsError::OutOfBounds`].
    pub fn from_lame_young(lambda: f64, young: f64) -> Result<Self, SolidsError> {
        check_positive("E", young, "0 < E")?;
        check_bound(LAW, "lambda", lambda, "finite", true)?;
        // 2 μ² + (3 λ − E) μ − λ E = 0; the root with the sum that does not cancel.
        let root = (young * young + 9.0 * lambda * lambda + 2.0 * young * lambda).sqrt();
        let linear = 3.0 * lambda - young;
        let mu = if 0.0 < linear { 2.0 * lambda * young / (root + linear) } else { 0.25 * (root - linear) };
        Self::from_lame(lambda, mu)
    }

    /// λ and ν, both of one sign and not zero: 0 < λ/ν, −1 < ν < ½.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`], [`SolidsError::OutOfBounds`].
    pub fn from_lame_poisson(lambda: f64, nu: f64) -> Result<Self, SolidsError> {
        check_compressible(nu)?;
        check_bound(LAW, "lambda", lambda, "0 < λ/ν", 0.0 < lambda / nu)?;
        Self::of(lambda, 0.5 * (lambda / nu) * (1.0 - 2.0 * nu))
    }

    /// λ and K: 0 < K, λ < K.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`], [`SolidsError::OutOfBounds`].
    pub fn from_lame_bulk(lambda: f64, bulk: f64) -> Result<Self, SolidsError> {
        check_positive("K", bulk, "0 < K")?;
        check_bound(LAW, "lambda", lambda, "λ < K", lambda < bulk)?;
        Self::of(lambda, 1.5 * (bulk - lambda))
    }

    /// λ and M: λ < M, 0 < 2 λ + M.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`], [`SolidsError::OutOfBounds`].
    pub fn from_lame_uniaxial(lambda: f64, uniaxial: f64) -> Result<Self, SolidsError> {
        check_positive("M", uniaxial, "0 < M")?;
        let holds = lambda < uniaxial && 0.0 < 2.0 * lambda + uniaxial;
        check_bound(LAW, "lambda", lambda, "−½ M < λ < M", holds)?;
        Self::of(lambda, 0.5 * (uniaxial - lambda))
    }

    /// G and M: 0 < G, 4/3 G < M.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`], [`SolidsError::OutOfBounds`].
    pub fn from_shear_uniaxial(mu: f64, uniaxial: f64) -> Result<Self, SolidsError> {
        check_positive("G", mu, "0 < G")?;
        check_bound(LAW, "M", uniaxial, "4/3 G < M", 4.0 * mu < 3.0 * uniaxial)?;
        Self::of(uniaxial - 2.0 * mu, mu)
    }

    /// K and M: 0 < K < M.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`], [`SolidsError::OutOfBounds`].
    pub fn from_bulk_uniaxial(bulk: f64, uniaxial: f64) -> Result<Self, SolidsError> {
        check_positive("K", bulk, "0 < K")?;
        check_bound(LAW, "M", uniaxial, "K < M", bulk < uniaxial)?;
        Self::of(0.5 * (3.0 * bulk - uniaxial), 0.75 * (uniaxial - bulk))
    }

    /// ν and M: −1 < ν < ½, 0 < M.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`], [`SolidsError::OutOfBounds`].
    pub fn from_poisson_uniaxial(nu: f64, uniaxial: f64) -> Result<Self, SolidsError> {
        check_positive("M", uniaxial, "0 < M")?;
        check_compressible(nu)?;
        let share = uniaxial / (1.0 - nu);
        Self::of(share * nu, 0.5 * share * (1.0 - 2.0 * nu))
    }

    /// E and M: 0 < E ≤ M. Two solids have them; the sign of ν chooses.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`], [`SolidsError::OutOfBounds`].
    ///
    /// # Example
    /// ```
    /// use piola_solids::{ElasticConstants, PoissonSign};
    /// let steel = ElasticConstants::from_young_uniaxial(200e9, 240e9, PoissonSign::NonNegative)?;
    /// assert!((steel.poisson_ratio() - 0.25).abs() < 1e-15);
    /// # Ok::<(), piola_solids::SolidsError>(())
    /// ```
    pub fn from_young_uniaxial(young: f64, uniaxial: f64, sign: PoissonSign) -> Result<Self, SolidsError> {
        check_positive("M", uniaxial, "0 < M")?;
        check_bound(LAW, "E", young, "0 < E ≤ M", 0.0 < young && young <= uniaxial)?;
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
    #[must_use]
    pub const fn lame(&self) -> Option<f64> {
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

    /// Whether ν = ½.
    #[must_use]
    pub const fn is_incompressible(&self) -> bool {
        self.lambda.is_none()
    }
}

/// The constants as they are written: `mu` alone is an incompressible solid.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    mu: f64,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    lambda: Option<f64>,
}

#[cfg(feature = "serde")]
impl TryFrom<Written> for ElasticConstants {
    type Error = SolidsError;

    fn try_from(written: Written) -> Result<Self, SolidsError> {
        match written.lambda {
            Some(lambda) => Self::from_lame(lambda, written.mu),
            None => Self::incompressible(written.mu),
        }
    }
}

#[cfg(feature = "serde")]
impl From<ElasticConstants> for Written {
    fn from(constants: ElasticConstants) -> Self {
        Self { mu: constants.mu, lambda: constants.lambda }
    }
}
