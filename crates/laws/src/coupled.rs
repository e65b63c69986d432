//! Coupled forms of the literature: energies of I₁, J and I₄ that do not split into a shape and a volume.

use piola_numerics::{Real, parameters};
use piola_solids::{Fibre, SolidsError};

use crate::{EnergyOfInvariants, Excesses};

parameters! {
    SolidsError;
    /// Gent's energy in its coupled form; [`OfInvariants`](crate::OfInvariants) makes the law of it.
    ///
    /// ```text
    /// W = −½ μ m ln(1 − (I₁ − 3)/m) − μ ln J + ½ λ (ln J)²
    /// ```
    /// The reference is free of stress; Lamé's constants there are λ + 2 μ/m and μ. For m → ∞ it is the neo-Hookean law.
    ///
    /// | symbol | parameter | unit | bounds |
    /// |---|---|---|---|
    /// | μ | `shear_modulus` | Pa | 0 < μ |
    /// | m | `limit` of I₁ − 3 | – | 0 < m |
    /// | λ | `first_lame_parameter` | Pa | 0 < λ + ⅔ μ |
    ///
    /// # Example
    /// ```
    /// use piola_continuum::DeformationGradient;
    /// use piola_laws::{OfInvariants, coupled::GentCoupled};
    /// use piola_solids::Hyperelastic;
    /// let law = OfInvariants(GentCoupled::new(1.0, 2.0, 3.0)?);
    /// let shear = DeformationGradient::simple_shear(1.0)?; // I₁ − 3 = k² = 1
    /// assert!((law.cauchy(&shear).0.components[3] - 2.0_f64).abs() < 1e-15); // μ k/(1 − k²/m)
    /// assert!(law.check(&DeformationGradient::simple_shear(1.5)?).is_err()); // k² = 2.25
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Source
    /// A. N. Gent, Rubber Chem. Technol. 69 (1996) 59–61.
    pub struct GentCoupled("coupled Gent") {
        /// μ, Pa.
        shear_modulus as "mu": "0 < μ" => 0.0 < shear_modulus,
        /// m.
        limit: "0 < m" => 0.0 < limit,
        /// λ, Pa.
        first_lame_parameter as "lambda": "0 < λ + ⅔ μ" => 0.0 < first_lame_parameter + 2.0 / 3.0 * shear_modulus,
    }
}

/// −ln(1 − x) − x, of second order, of x below 1.
#[cfg_attr(not(debug_assertions), inline(always))]
fn excess<T: Real>(x: T) -> T {
    piola_numerics::internal::excess_over_logarithm(-x)
}

impl EnergyOfInvariants for GentCoupled {
    const SECOND: bool = false;

    /// ½ μ (I₁ − 3 − 2 ln J) and what the limit adds, ½ μ m (−ln(1 − x) − x), x = (I₁ − 3)/m.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, at: &impl Excesses<T>) -> T {
        let volume = at.ln_jacobian();
        let share = at.first() * T::lit(1.0 / self.limit());
        T::lit(0.5 * self.shear_modulus()) * (at.first_excess() + T::lit(self.limit()) * excess(share))
            + T::lit(0.5 * self.first_lame_parameter()) * volume * volume
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn check<T: Real>(&self, at: &impl Excesses<T>) -> Result<(), SolidsError> {
        below(Self::NAME, "I₁ − 3", at.first(), self.limit())
    }
}

/// Refuses a value that is not below its limit, in any lane.
#[cfg_attr(not(debug_assertions), inline(always))]
fn below<T: Real>(law: &'static str, quantity: &'static str, value: T, limit: f64) -> Result<(), SolidsError> {
    for lane in 0..T::LANES {
        let value = value.primal(lane);
        if limit <= value || value.is_nan() {
            return Err(SolidsError::BeyondLimit { law, quantity, value, limit });
        }
    }
    Ok(())
}

parameters! {
    SolidsError;
    /// A coupled neo-Hookean matrix with one family of stiffening fibres (Holzapfel's exponential, one fibre);
    /// [`OfInvariants`](crate::OfInvariants) makes the law of it.
    ///
    /// ```text
    /// W = ½ μ (I₁ − 3 − 2 ln J) + ½ λ (ln J)² + k₁/(2 k₂) (exp(k₂ ⟨I₄ − 1⟩²) − 1)        ⟨x⟩ = max(x, 0)
    /// ```
    /// The reference is free of stress; fibres that are pressed do not answer.
    ///
    /// | symbol | parameter | unit | bounds |
    /// |---|---|---|---|
    /// | μ | `shear_modulus` | Pa | 0 < μ |
    /// | λ | `first_lame_parameter` | Pa | 0 < λ + ⅔ μ |
    /// | k₁ | `fibre_modulus` | Pa | 0 ≤ k₁ |
    /// | k₂ | `fibre_exponent` | – | 0 < k₂ |
    /// | a | `fibre` | – | a unit vector, normalised |
    ///
    /// # Example
    /// ```
    /// use piola_continuum::DeformationGradient;
    /// use piola_laws::{OfInvariants, coupled::HolzapfelCoupled};
    /// use piola_solids::{Fibre, Hyperelastic};
    /// let law = OfInvariants(HolzapfelCoupled::new(1.0, 0.0, 2.0, 1.0, Fibre::new([1.0, 0.0, 0.0])?)?);
    /// let bar = DeformationGradient::diagonal([2.0_f64.sqrt(), 1.0, 1.0])?; // I₄ − 1 = 1
    /// let stress = law.second_piola(&bar).0.components[0];
    /// assert!((stress - (0.5 + 4.0 * 1.0_f64.exp())).abs() < 1e-14); // μ (1 − 1/2) + 2 k₁ (I₄ − 1) e^(k₂ (I₄ − 1)²)
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Source
    /// G. A. Holzapfel, T. C. Gasser and R. W. Ogden, J. Elasticity 61 (2000) 1–48.
    pub struct HolzapfelCoupled("coupled one-fibre Holzapfel") {
        /// μ, Pa.
        shear_modulus as "mu": "0 < μ" => 0.0 < shear_modulus,
        /// λ, Pa.
        first_lame_parameter as "lambda": "0 < λ + ⅔ μ" => 0.0 < first_lame_parameter + 2.0 / 3.0 * shear_modulus,
        /// k₁, Pa.
        fibre_modulus as "k1": "0 ≤ k1" => 0.0 <= fibre_modulus,
        /// k₂.
        fibre_exponent as "k2": "0 < k2" => 0.0 < fibre_exponent,
    }
    with {
        /// a.
        fibre: Fibre,
    }
}

impl EnergyOfInvariants for HolzapfelCoupled {
    const FIBRES: usize = 1;
    const SECOND: bool = false;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, at: &impl Excesses<T>) -> T {
        let (volume, strain) = (at.ln_jacobian(), at.fourth(0));
        let tension = T::select(T::zero().less_than(strain), strain, T::zero());
        let growth = (T::lit(self.fibre_exponent()) * tension * tension).exp_m1();
        T::lit(0.5 * self.shear_modulus()) * at.first_excess()
            + T::lit(0.5 * self.first_lame_parameter()) * volume * volume
            + T::lit(0.5 * self.fibre_modulus() / self.fibre_exponent()) * growth
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn fibre(&self, _family: usize) -> [f64; 3] {
        self.fibre.direction()
    }
}
