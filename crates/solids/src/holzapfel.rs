//! The law of Holzapfel, Gasser and Ogden for arterial walls.

use piola_continuum::internal::strain as kernels;
use piola_continuum::strain::invariants;
use piola_continuum::{Deformation, Symmetric};
use piola_numerics::{Mask, Real, parameters};
use piola_tensor::MajorSymmetric;

use super::Fibre;
use super::exponent_range::check_exponent;
use super::isochoric_factor::Unimodular;
use super::strain_energy::{StrainEnergy, constant, hyperelastic_of_strain, inverse_metric};
use crate::SolidsError;

parameters! {
    SolidsError;
    /// A soft matrix with two families of dispersed fibres that stiffen exponentially and bear tension only.
    ///
    /// ```text
    /// W = ½ μ (Ī₁ − 3) + ½ κ (J − 1)² + k₁/(2 k₂) Σₐ (e^(k₂ ⟨Eₐ⟩²) − 1)
    /// Eₐ = d (Ī₁ − 3) + (1 − 3 d)(Ī₄ₐ − 1)        Ī₄ₐ = J^(−2/3) aₐ · C aₐ        ⟨E⟩ = max(E, 0)
    /// ```
    ///
    /// | symbol | parameter | unit | bounds |
    /// |---|---|---|---|
    /// | μ | `shear_modulus` | Pa | 0 < μ (the shear modulus of the matrix) |
    /// | κ | `bulk_modulus` | Pa | 0 ≤ κ (the bulk modulus) |
    /// | k₁ | `fibre_modulus` | Pa | 0 ≤ k₁ |
    /// | k₂ | `fibre_exponent` | – | 0 < k₂ |
    /// | d | `dispersion` | – | 0 ≤ d ≤ ⅓: aligned … without direction |
    /// | aₐ | `fibres` | – | unit vectors, normalised |
    ///
    /// A family answers where Eₐ is positive: without dispersion, where it is longer than in the reference. The stress is
    /// continuous there; the tangent jumps by 4 k₁ h ⊗ h, h = ∂Eₐ/∂C. At the jump itself the tangent is that of fibres at rest.
    /// [`check`](super::Hyperelastic::check) refuses k₂ Eₐ² at which the tangent leaves the range of the scalar: some 700 in
    /// double precision, 80 in single.
    ///
    /// # Accuracy
    /// Stresses relative 1e-13 down to ∇u = 1e-16 beside the jump.
    ///
    /// # Example
    /// ```
    /// use piola_solids::{Fibre, HolzapfelGasserOgden, Hyperelastic};
    /// use piola_continuum::DeformationGradient;
    /// let fibres = [Fibre::new([1.0, 0.0, 0.0])?, Fibre::new([0.0, 1.0, 0.0])?];
    /// let wall = HolzapfelGasserOgden::new(1.0, 50.0, 2.0, 3.0, 0.0, fibres)?;
    /// // Along the third axis both families are shortened: only the matrix answers, μ (λ² − 1/λ) less the pressure.
    /// let pulled = DeformationGradient::diagonal([0.5, 0.5, 4.0])?;
    /// let stress = wall.cauchy(&pulled).0.components;
    /// assert!((stress[2] - stress[0] - 15.75_f64).abs() < 1e-13); // λ² − 1/λ = 16 − 1/4
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Source
    /// T. C. Gasser, R. W. Ogden and G. A. Holzapfel, J. R. Soc. Interface 3 (2006) 15–35; without dispersion Holzapfel, Gasser
    /// and Ogden, J. Elasticity 61 (2000) 1–48.
    pub struct HolzapfelGasserOgden("Holzapfel–Gasser–Ogden") {
        /// μ of the matrix, Pa.
        shear_modulus as "mu": "0 < μ" => 0.0 < shear_modulus,
        /// κ, Pa.
        bulk_modulus as "kappa": "0 ≤ κ" => 0.0 <= bulk_modulus,
        /// k₁, Pa.
        fibre_modulus as "k1": "0 ≤ k1" => 0.0 <= fibre_modulus,
        /// k₂.
        fibre_exponent as "k2": "0 < k2" => 0.0 < fibre_exponent,
        /// d.
        dispersion: "0 ≤ dispersion ≤ 1/3" => (0.0..=1.0 / 3.0).contains(&dispersion),
    }
    with {
        /// The two families.
        fibres: [Fibre; 2],
    }
}

impl HolzapfelGasserOgden {
    /// H = d 1 + (1 − 3 d) a ⊗ a, tr H = 1: Eₐ = J^(−2/3) C : H − 1.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn structure(&self, family: usize) -> Symmetric {
        let [x, y, z] = self.fibres[family].direction();
        let (d, rest) = (self.dispersion, 1.0 - 3.0 * self.dispersion);
        let along = |x: f64| d + rest * (x * x);
        Symmetric::new(along(x), along(y), along(z), rest * (x * y), rest * (y * z), rest * (x * z))
    }

    /// ⟨E⟩, 1 where it answers, and k₂ ⟨E⟩².
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn tension<T: Real>(&self, strain: T) -> (T, T, T) {
        let taut = T::zero().less_than(strain);
        let tension = T::select(taut, strain, T::zero());
        let answers = T::select(taut, T::one(), T::zero());
        (tension, answers, T::lit(self.fibre_exponent) * (tension * tension))
    }

    /// S and ∂S/∂E; e^x of each family's exponent is given.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn of_metric<T: Real>(
        &self,
        metric: &Metric<T>,
        volume: [T; 2],
        powers: [T; 2],
    ) -> (Symmetric<T>, MajorSymmetric<T>) {
        let [jacobian, change] = volume;
        let kappa = T::lit(self.bulk_modulus);
        let mean = kappa * (jacobian * change);
        let matrix = metric.invariant(&Symmetric::identity(), WHOLE);
        let mut stress = matrix.slope * T::lit(self.shear_modulus) + metric.inverse * mean;
        let mut tangent = metric.curvature(&matrix, WHOLE) * T::lit(2.0 * self.shear_modulus)
            + MajorSymmetric::dyad(&metric.inverse) * (kappa * (jacobian * (jacobian + change)))
            - MajorSymmetric::square_dyad(&metric.inverse) * (T::lit(2.0) * mean);
        for (family, power) in powers.into_iter().enumerate() {
            let fibres = metric.invariant(&self.structure(family), 1.0);
            let (tension, answers, exponent) = self.tension(fibres.excess);
            let slope = T::lit(2.0 * self.fibre_modulus) * (tension * power);
            let rate = T::one() + T::lit(2.0) * exponent;
            let curvature = T::lit(4.0 * self.fibre_modulus) * (answers * power * rate);
            stress += fibres.slope * slope;
            tangent = tangent
                + MajorSymmetric::dyad(&fibres.slope) * curvature
                + metric.curvature(&fibres, 1.0) * (T::lit(2.0) * slope);
        }
        (stress, tangent)
    }

    /// k₂ ⟨E⟩² of each family.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn exponents<T: Real>(&self, metric: &Metric<T>) -> [T; 2] {
        [self.tension(metric.excess(&self.structure(0), 1.0)).2, self.tension(metric.excess(&self.structure(1), 1.0)).2]
    }

    /// W of e^x − 1 of each family's exponent.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn parts<T: Real>(&self, deformation: &impl Deformation<T>, change: T, growth: [T; 2]) -> T {
        T::lit(0.5 * self.shear_modulus) * invariants::isochoric_first_minus_three(deformation)
            + T::lit(0.5 * self.bulk_modulus) * (change * change)
            + T::lit(0.5 * self.fibre_modulus / self.fibre_exponent) * (growth[0] + growth[1])
    }
}

/// The terms of the isochoric invariants J^(−2/3) C : H.
struct Metric<T: Real> {
    /// C, C − 1, C⁻¹ and 1 − C⁻¹.
    whole: Symmetric<T>,
    change: Symmetric<T>,
    inverse: Symmetric<T>,
    less_inverse: Symmetric<T>,
    /// J^(−2/3) and its difference from 1.
    scale: T,
    scale_change: T,
    /// Mask of volumes near that of the reference. Elsewhere differences from the reference would lose the digits.
    near: T::Mask,
}

/// J^(−2/3) C : H − tr H with its derivatives by C.
struct Invariant<T> {
    excess: T,
    slope: Symmetric<T>,
}

impl<T: Real> Metric<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn of(deformation: &impl Deformation<T>) -> Self {
        let (inverse, less_inverse) = inverse_metric(deformation);
        let change = deformation.volume_change();
        let Unimodular { two_thirds, two_thirds_change, .. } = Unimodular::of(change, deformation.jacobian());
        Self {
            whole: kernels::right_cauchy_green(deformation.gradient_rows()),
            near: change.abs().at_most(T::lit(0.5)),
            change: kernels::right_cauchy_green_minus_one(deformation.displacement_rows()),
            inverse,
            less_inverse,
            scale: two_thirds,
            scale_change: two_thirds_change,
        }
    }

    /// J^(−2/3) C : H − tr H, given tr H.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn excess(&self, structure: &Symmetric, trace: f64) -> T {
        let part = self.change.double_contraction(&constant(structure));
        self.selected(part, structure, trace).0
    }

    /// J^(−2/3) C : H − tr H and C : H, of (C − 1) : H near the volume of the reference.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn selected(&self, part: T, structure: &Symmetric, trace: f64) -> (T, T) {
        let trace = T::lit(trace);
        let excess = self.scale * part + self.scale_change * trace;
        if self.near.all() {
            return (excess, part + trace);
        }
        let whole = self.whole.double_contraction(&constant(structure));
        (T::select(self.near, excess, self.scale * whole - trace), T::select(self.near, part + trace, whole))
    }

    /// With the slope J^(−2/3) (H − ⅓ (C : H) C⁻¹).
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn invariant(&self, structure: &Symmetric, trace: f64) -> Invariant<T> {
        let third = T::lit(1.0 / 3.0);
        let h = constant::<T>(structure);
        let part = self.change.double_contraction(&h);
        let deviator = h - Symmetric::identity() * T::lit(trace / 3.0);
        let mut slope = deviator + (self.less_inverse * T::lit(trace) - self.inverse * part) * third;
        let (excess, whole) = self.selected(part, structure, trace);
        if !self.near.all() {
            let plain = h - self.inverse * (whole * third);
            let mut k = 0;
            while k < 6 {
                slope.components[k] = T::select(self.near, slope.components[k], plain.components[k]);
                k += 1;
            }
        }
        Invariant { excess, slope: slope * self.scale }
    }

    /// The second derivative of an invariant: −⅓ (h ⊗ C⁻¹ + C⁻¹ ⊗ h) − c/9 C⁻¹ ⊗ C⁻¹ + c/3 C⁻¹ ⊙ C⁻¹, c = J^(−2/3) C : H.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn curvature(&self, invariant: &Invariant<T>, trace: f64) -> MajorSymmetric<T> {
        let whole = invariant.excess + T::lit(trace);
        MajorSymmetric::symmetric_dyad(&invariant.slope, &self.inverse) * T::lit(-2.0 / 3.0)
            - MajorSymmetric::dyad(&self.inverse) * (whole * T::lit(1.0 / 9.0))
            + MajorSymmetric::square_dyad(&self.inverse) * (whole * T::lit(1.0 / 3.0))
    }
}

/// Tr 1.
const WHOLE: f64 = 3.0;

impl StrainEnergy for HolzapfelGasserOgden {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        let [first, second] = self.exponents(&Metric::of(deformation));
        self.parts(deformation, deformation.volume_change(), [first.exp_m1(), second.exp_m1()])
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
        let metric = Metric::of(deformation);
        let [first, second] = self.exponents(&metric);
        self.of_metric(&metric, [deformation.jacobian(), deformation.volume_change()], [first.exp(), second.exp()])
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy_stress_and_tangent<T: Real>(
        &self,
        deformation: &impl Deformation<T>,
    ) -> (T, Symmetric<T>, MajorSymmetric<T>) {
        let (metric, change) = (Metric::of(deformation), deformation.volume_change());
        let [first, second] = self.exponents(&metric);
        let [first, second] = [first.exp_m1(), second.exp_m1()];
        let powers = [T::one() + first, T::one() + second];
        let (stress, tangent) = self.of_metric(&metric, [deformation.jacobian(), change], powers);
        (self.parts(deformation, change, [first, second]), stress, tangent)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn check<T: Real>(&self, deformation: &impl Deformation<T>) -> Result<(), SolidsError> {
        let metric = Metric::of(deformation);
        // |∂E/∂C| ≤ J^(−2/3) (1 + |C| |C⁻¹|), and F stands twice beside the tangent.
        let square = metric.change.trace() + T::lit(WHOLE);
        let slope = metric.scale * (T::one() + square * metric.inverse.trace());
        let size = slope * slope * (T::one() + square);
        for family in 0..2 {
            let (_, _, exponent) = self.tension(metric.excess(&self.structure(family), 1.0));
            let growth = T::one() + T::lit(2.0) * exponent;
            check_exponent(
                Self::NAME,
                "k2 E²",
                exponent,
                T::lit(4.0 * self.fibre_modulus + self.fibre_modulus / self.fibre_exponent) * (growth * size),
            )?;
        }
        Ok(())
    }
}

hyperelastic_of_strain!(HolzapfelGasserOgden);
