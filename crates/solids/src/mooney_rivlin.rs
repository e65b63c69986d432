//! The compressible Mooney–Rivlin solid of the text.

use piola_continuum::Deformation;
use piola_numerics::Real;

use super::invariant::{
    Curvatures, InvariantEnergy, Invariants, Slopes, first_excess_beside, hyperelastic_of_invariants,
    second_excess_beside, volume_excess,
};
use crate::SolidsError;
use crate::error::{check_bound, check_finite};

const LAW: &str = "Mooney–Rivlin";

/// The compressible Mooney–Rivlin solid.
///
/// ```text
/// W = C₁₀ (I₁ − 3) + C₀₁ (I₂ − 3) + c J² − d ln J
/// T = J⁻¹ [2 C₁₀ B + 2 C₀₁ (I₁ B − B²) + (2 c J² − d) 1]
/// ```
/// The reference is free of stress if d = 2 (C₁₀ + 2 C₀₁ + c), which [`stress_free`](Self::stress_free) sees to.
///
/// | symbol | parameter | unit | bounds |
/// |---|---|---|---|
/// | C₁₀, C₀₁ | `c10`, `c01` | Pa | 0 < C₁₀ + C₀₁ (half the shear modulus) |
/// | c | `square_coefficient` | Pa | 0 ≤ c |
/// | d | `logarithm_coefficient` | Pa | – |
///
/// # Accuracy
/// P, S, τ relative 1e-13 down to ∇u = 1e-16 where the reference is free of stress; tangents a few ulp of their norm.
///
/// # Example
/// ```
/// use piola_solids::{Hyperelastic, MooneyRivlin};
/// use piola_continuum::DeformationGradient;
/// let rubber = MooneyRivlin::stress_free(0.5, 0.25, 1.0)?;
/// assert_eq!(rubber.logarithm_coefficient(), 4.0);
/// let shear = DeformationGradient::simple_shear(0.5)?;
/// assert_eq!(rubber.cauchy(&shear).0.components[3], 0.75); // μ k with μ = 2 (C₁₀ + C₀₁)
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// B(4.65), W(24.17).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Written", into = "Written"))]
pub struct MooneyRivlin {
    c10: f64,
    c01: f64,
    square_coefficient: f64,
    logarithm_coefficient: f64,
    /// 2 C₁₀ + 4 C₀₁ + 2 c − d, Pa: zero to the last bit where it is meant to be.
    residual: f64,
}

impl MooneyRivlin {
    /// C₁₀, C₀₁, c and d as they are; the reference carries the stress (2 C₁₀ + 4 C₀₁ + 2 c − d) 1, see
    /// [`reference_stress`](super::Hyperelastic::reference_stress).
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`], [`SolidsError::OutOfBounds`].
    pub fn new(c10: f64, c01: f64, square_coefficient: f64, logarithm_coefficient: f64) -> Result<Self, SolidsError> {
        check_finite(LAW, "logarithm_coefficient", logarithm_coefficient)?;
        let residual = 2.0 * c10 + 4.0 * c01 + 2.0 * square_coefficient - logarithm_coefficient;
        Self { c10, c01, square_coefficient, logarithm_coefficient, residual }.checked()
    }

    /// d = 2 (C₁₀ + 2 C₀₁ + c), so that the reference is free of stress.
    ///
    /// # Errors
    /// As [`new`](Self::new); and unless the bulk modulus λ + ⅔ μ of the reference is positive and 0 ≤ d, without which
    /// W would fall without bound as J → 0.
    pub fn stress_free(c10: f64, c01: f64, square_coefficient: f64) -> Result<Self, SolidsError> {
        let (c, d) = (square_coefficient, 2.0 * (c10 + 2.0 * c01 + square_coefficient));
        let law = Self { c10, c01, square_coefficient, logarithm_coefficient: d, residual: 0.0 }.checked()?;
        // λ = 4 (c + C₀₁), μ = 2 (C₁₀ + C₀₁).
        let bulk = 4.0 * (c + c01) + 4.0 / 3.0 * (c10 + c01);
        check_bound(LAW, "square_coefficient", c, "0 < λ + ⅔ μ = 4 (c + C01) + 4/3 (C10 + C01)", 0.0 < bulk)?;
        check_bound(LAW, "logarithm_coefficient", d, "0 ≤ d = 2 (C10 + 2 C01 + c)", 0.0 <= d)?;
        Ok(law)
    }

    fn checked(self) -> Result<Self, SolidsError> {
        check_finite(LAW, "C01", self.c01)?;
        check_bound(LAW, "C10", self.c10, "0 < C10 + C01", 0.0 < self.c10 + self.c01)?;
        check_bound(LAW, "square_coefficient", self.square_coefficient, "0 ≤ c", 0.0 <= self.square_coefficient)?;
        // Sums of finite parameters can overflow.
        check_finite(LAW, "logarithm_coefficient", self.logarithm_coefficient)?;
        check_finite(LAW, "2 C10 + 4 C01 + 2 c − d", self.residual)?;
        check_finite(LAW, "C10 + C01", self.c10 + self.c01)?;
        Ok(self)
    }

    /// C₁₀, Pa.
    #[must_use]
    pub const fn c10(&self) -> f64 {
        self.c10
    }

    /// C₀₁, Pa.
    #[must_use]
    pub const fn c01(&self) -> f64 {
        self.c01
    }

    /// c, Pa.
    #[doc(alias = "c")]
    #[must_use]
    pub const fn square_coefficient(&self) -> f64 {
        self.square_coefficient
    }

    /// d, Pa.
    #[doc(alias = "d")]
    #[must_use]
    pub const fn logarithm_coefficient(&self) -> f64 {
        self.logarithm_coefficient
    }

    /// The shear modulus 2 (C₁₀ + C₀₁), Pa.
    #[must_use]
    pub fn shear_modulus(&self) -> f64 {
        2.0 * (self.c10 + self.c01)
    }
}

impl InvariantEnergy for MooneyRivlin {
    const SECOND: bool = true;
    const STRAIGHT: bool = true;
    const CURVED: bool = false;

    /// C₁₀ (I₁ − 3 − 2 ln J) + C₀₁ (I₂ − 3 − 4 ln J) + c ((J − 1)² + 2 (J − 1 − ln J)) + r ln J, r the stress of the reference.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        let (change, excess) = (deformation.volume_change(), volume_excess(deformation));
        let energy = T::lit(self.c10) * first_excess_beside(deformation, excess)
            + T::lit(self.c01) * second_excess_beside(deformation, excess)
            + T::lit(self.square_coefficient) * (change * change + T::lit(2.0) * excess);
        if self.residual == 0.0 { energy } else { energy + T::lit(self.residual) * deformation.ln_jacobian() }
    }

    fn reference_energy(&self) -> f64 {
        self.square_coefficient
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slopes<T: Real>(&self, invariants: &Invariants<T>) -> Slopes<T> {
        let change = invariants.change;
        Slopes {
            first: T::lit(self.c10),
            second: T::lit(self.c01),
            // 2 c (J² − 1), and what a reference with stress has.
            residual: T::lit(2.0 * self.square_coefficient) * (change * (change + T::lit(2.0))) + T::lit(self.residual),
            volume: T::lit(2.0 * self.square_coefficient) * (invariants.jacobian * invariants.jacobian)
                - T::lit(self.logarithm_coefficient),
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn curvatures<T: Real>(&self, invariants: &Invariants<T>) -> Curvatures<T> {
        let reciprocal = invariants.jacobian.recip();
        Curvatures::of_volume(
            T::lit(2.0 * self.square_coefficient) + T::lit(self.logarithm_coefficient) * (reciprocal * reciprocal),
        )
    }
}

hyperelastic_of_invariants!(MooneyRivlin);

/// The parameters as they are written.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    c10: f64,
    c01: f64,
    #[serde(alias = "c")]
    square_coefficient: f64,
    /// That of a stress-free reference when it is left out.
    #[serde(alias = "d", default, skip_serializing_if = "Option::is_none")]
    logarithm_coefficient: Option<f64>,
}

#[cfg(feature = "serde")]
impl TryFrom<Written> for MooneyRivlin {
    type Error = SolidsError;

    fn try_from(written: Written) -> Result<Self, SolidsError> {
        let Written { c10, c01, square_coefficient, logarithm_coefficient } = written;
        match logarithm_coefficient {
            Some(d) => Self::new(c10, c01, square_coefficient, d),
            None => Self::stress_free(c10, c01, square_coefficient),
        }
    }
}

#[cfg(feature = "serde")]
impl From<MooneyRivlin> for Written {
    fn from(MooneyRivlin { c10, c01, square_coefficient, logarithm_coefficient: d, residual }: MooneyRivlin) -> Self {
        let free = residual.to_bits() == 0.0_f64.to_bits();
        Self { c10, c01, square_coefficient, logarithm_coefficient: (!free).then_some(d) }
    }
}
