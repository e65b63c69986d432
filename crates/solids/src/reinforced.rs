//! A neo-Hookean matrix with one family of fibres.

use piola_continuum::internal::strain as kernels;
use piola_continuum::{Deformation, Symmetric};
use piola_numerics::{Real, parameters};
use piola_tensor::MajorSymmetric;

use super::Fibre;
use super::invariant::first_excess;
use super::strain_energy::{StrainEnergy, constant, hyperelastic_of_strain, inverse_metric};

parameters! {
    SolidsError;
    /// The standard reinforcing model: a neo-Hookean matrix with one family of fibres, transversely isotropic.
    ///
    /// ```text
    /// W = ½ μ (I₁ − 3 − 2 ln J) + ½ λ (ln J)² + ½ k (I₄ − 1)²        I₄ = a · C a
    /// S = μ (1 − C⁻¹) + λ ln J C⁻¹ + 2 k (I₄ − 1) a ⊗ a
    /// ```
    ///
    /// | symbol | parameter | unit | bounds |
    /// |---|---|---|---|
    /// | μ | `shear_modulus` | Pa | 0 < μ |
    /// | λ | `first_lame_parameter` | Pa | 0 < λ + ⅔ μ |
    /// | k | `fibre_modulus` | Pa | 0 ≤ k (4 k is the stiffness that the fibres add at the reference) |
    /// | a | `fibre` | – | a unit vector, normalised |
    ///
    /// The fibres bear compression too; beyond some shortening the law loses ellipticity, which is how they kink.
    ///
    /// # Accuracy
    /// Stresses relative 1e-13 down to ∇u = 1e-16, tangents a few ulp of their norm.
    ///
    /// # Example
    /// ```
    /// use piola_solids::{Fibre, Hyperelastic, ReinforcedNeoHookean};
    /// use piola_continuum::DeformationGradient;
    /// let law = ReinforcedNeoHookean::new(1.0, 0.0, 3.0, Fibre::new([0.0, 2.0, 0.0])?)?;
    /// let shear = DeformationGradient::simple_shear(0.5)?; // C₁₁ = 1 + k², the fibres keep their length
    /// assert_eq!(law.cauchy(&shear).0.components, [0.0, 0.25, 0.0, 0.5, 0.0, 0.0]); // μ (B − 1)
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Source
    /// G. Y. Qiu and T. J. Pence, J. Elasticity 49 (1997) 1–30.
    pub struct ReinforcedNeoHookean("reinforced neo-Hookean") {
        /// μ, Pa.
        shear_modulus as "mu": "0 < μ" => 0.0 < shear_modulus,
        /// λ, Pa.
        first_lame_parameter as "lambda": "0 < λ + ⅔ μ" => 0.0 < first_lame_parameter + 2.0 / 3.0 * shear_modulus,
        /// k, Pa.
        fibre_modulus as "k": "0 ≤ k" => 0.0 <= fibre_modulus,
    }
    with {
        /// a.
        fibre: Fibre,
    }
}

impl ReinforcedNeoHookean {
    /// a ⊗ a and I₄ − 1.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn stretch<T: Real>(&self, deformation: &impl Deformation<T>) -> (Symmetric<T>, T) {
        let structure = constant(&self.fibre.structure());
        let change = kernels::right_cauchy_green_minus_one(deformation.displacement_rows());
        (structure, change.double_contraction(&structure))
    }

    /// W of I₄ − 1 and ln J.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn parts<T: Real>(&self, stretch: T, volume: T, deformation: &impl Deformation<T>) -> T {
        T::lit(0.5 * self.shear_modulus) * first_excess(deformation)
            + T::lit(0.5 * self.first_lame_parameter) * (volume * volume)
            + T::lit(0.5 * self.fibre_modulus) * (stretch * stretch)
    }
}

impl StrainEnergy for ReinforcedNeoHookean {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        self.parts(self.stretch(deformation).1, deformation.ln_jacobian(), deformation)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn stress<T: Real>(&self, deformation: &impl Deformation<T>) -> Symmetric<T> {
        self.stress_and_tangent(deformation).0
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn tangent<T: Real>(&self, deformation: &impl Deformation<T>) -> MajorSymmetric<T> {
        self.stress_and_tangent(deformation).1
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn stress_and_tangent<T: Real>(&self, deformation: &impl Deformation<T>) -> (Symmetric<T>, MajorSymmetric<T>) {
        let (_, stress, tangent) = self.energy_stress_and_tangent(deformation);
        (stress, tangent)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy_stress_and_tangent<T: Real>(
        &self,
        deformation: &impl Deformation<T>,
    ) -> (T, Symmetric<T>, MajorSymmetric<T>) {
        let (structure, stretch) = self.stretch(deformation);
        let (inverse, less_inverse) = inverse_metric(deformation);
        let (lambda, logarithm) = (T::lit(self.first_lame_parameter), deformation.ln_jacobian());
        let volume = lambda * logarithm;
        let stress = less_inverse * T::lit(self.shear_modulus)
            + inverse * volume
            + structure * (T::lit(2.0 * self.fibre_modulus) * stretch);
        let tangent = MajorSymmetric::dyad(&inverse) * lambda
            + MajorSymmetric::square_dyad(&inverse) * (T::lit(2.0) * (T::lit(self.shear_modulus) - volume))
            + MajorSymmetric::dyad(&structure) * T::lit(4.0 * self.fibre_modulus);
        (self.parts(stretch, logarithm, deformation), stress, tangent)
    }
}

hyperelastic_of_strain!(ReinforcedNeoHookean);
