//! The series of Rivlin for a change of shape.

use piola_numerics::Real;

use super::Isochoric;
use crate::SolidsError;
use crate::error::{check_bound, check_finite};
use crate::integer_powers::{power, power_curvature, power_slope};

const LAW: &str = "Rivlin series";

/// C (Ī₁ − 3)^i (Ī₂ − 3)^j.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct RivlinTerm {
    /// i.
    pub first: u8,
    /// j.
    pub second: u8,
    /// C, Pa.
    pub coefficient: f64,
}

/// W̄ = Σ Cᵢⱼ (Ī₁ − 3)ⁱ (Ī₂ − 3)ʲ: the part of B(4.63) without volume, as many terms as are given.
///
/// | symbol | parameter | unit | bounds |
/// |---|---|---|---|
/// | i, j | `first`, `second` of a term | 1 | 0 < i + j |
/// | Cᵢⱼ | `coefficient` of a term | Pa | finite; 0 < C₁₀ + C₀₁ (half the shear modulus) |
///
/// # Example
/// ```
/// use piola_solids::{Hyperelastic, IncompressibleSolid, isochoric::{Rivlin, RivlinTerm}};
/// use piola_continuum::DeformationGradient;
/// let rubber = IncompressibleSolid::new(Rivlin::new(vec![
///     RivlinTerm { first: 1, second: 0, coefficient: 1.0 },
///     RivlinTerm { first: 1, second: 1, coefficient: 0.25 },
/// ])?);
/// // Ŵ(k) = k² + ¼ k⁴, T₁₂ = Ŵ′(1).
/// assert_eq!(rubber.cauchy(&DeformationGradient::simple_shear(1.0)?).0.components[3], 3.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// B(4.63–4.64).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Vec<RivlinTerm>", into = "Vec<RivlinTerm>"))]
pub struct Rivlin {
    terms: Vec<RivlinTerm>,
}

impl Rivlin {
    /// From its terms.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`], [`SolidsError::OutOfBounds`].
    pub fn new(terms: Vec<RivlinTerm>) -> Result<Self, SolidsError> {
        let mut linear = 0.0;
        for term in &terms {
            let degree = f64::from(term.first) + f64::from(term.second);
            check_bound(LAW, "degree", degree, "0 < i + j", 0.0 < degree)?;
            check_finite(LAW, "coefficient", term.coefficient)?;
            if degree < 2.0 {
                linear += term.coefficient;
            }
        }
        check_bound(LAW, "C10 + C01", linear, "0 < C10 + C01", 0.0 < linear)?;
        Ok(Self { terms })
    }

    /// From any terms, as they are: also such as no stable solid has, for parts of a sum or for a search.
    #[must_use]
    pub const fn unchecked(terms: Vec<RivlinTerm>) -> Self {
        Self { terms }
    }

    /// The terms.
    #[must_use]
    pub fn terms(&self) -> &[RivlinTerm] {
        &self.terms
    }
}

#[cfg(feature = "serde")]
impl TryFrom<Vec<RivlinTerm>> for Rivlin {
    type Error = SolidsError;

    fn try_from(terms: Vec<RivlinTerm>) -> Result<Self, SolidsError> {
        Self::new(terms)
    }
}

#[cfg(feature = "serde")]
impl From<Rivlin> for Vec<RivlinTerm> {
    fn from(law: Rivlin) -> Self {
        law.terms
    }
}

/// C xⁱ yʲ, over any scalar: the coefficient may have derivatives too.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn rivlin_term<T: Real>(coefficient: T, [i, j]: [u8; 2], first: T, second: T) -> T {
    coefficient * power(first, i) * power(second, j)
}

impl Isochoric for Rivlin {
    const SECOND: bool = true;
    const REFUSED_IS_NOT_FINITE: bool = true;
    const LIMITED: bool = false;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, first: T, second: T) -> T {
        let mut sum = T::zero();
        for term in &self.terms {
            sum += rivlin_term(T::lit(term.coefficient), [term.first, term.second], first, second);
        }
        sum
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slopes<T: Real>(&self, x: T, y: T) -> [T; 2] {
        let mut sums = [T::zero(); 2];
        for &RivlinTerm { first: i, second: j, coefficient } in &self.terms {
            let c = T::lit(coefficient);
            sums[0] += c * power_slope(x, i) * power(y, j);
            sums[1] += c * power(x, i) * power_slope(y, j);
        }
        sums
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn curvatures<T: Real>(&self, x: T, y: T) -> [T; 3] {
        let mut sums = [T::zero(); 3];
        for &RivlinTerm { first: i, second: j, coefficient } in &self.terms {
            let c = T::lit(coefficient);
            sums[0] += c * power_curvature(x, i) * power(y, j);
            sums[1] += c * power_slope(x, i) * power_slope(y, j);
            sums[2] += c * power(x, i) * power_curvature(y, j);
        }
        sums
    }
}
