//! Laws with a constant stiffness of any symmetry: linear, and of St. Venant and Kirchhoff.

use piola_continuum::strain::{GreenStrain, LinearStrain};
use piola_continuum::stress::tangents::{FirstPiolaTangent, MaterialTangent, TruesdellTangent};
use piola_continuum::{CauchyStress, Deformation, FirstPiola, KirchhoffStress, SecondPiola, Symmetric};
use piola_numerics::Real;
use piola_numerics::internal::Lanewise;
use piola_tensor::{MajorSymmetric, PairSymmetric};

use super::strain_energy::{GreenEnergy, StrainEnergy, constant_tangent, hyperelastic_of_strain, linear_numbers};
use super::{Hyperelastic, Stiffness, packed};

/// Linear elasticity of any symmetry.
///
/// ```text
/// W = ½ ε : C : ε        T = C : ε        ε = sym ∇u
/// ```
/// For small strain and small rotation, where all measures of stress are T: each method returns C : ε. A large rotation
/// is a strain to it.
///
/// # Accuracy
/// 8 ulp of |C| |ε|, from ∇u.
///
/// # Example
/// ```
/// use piola_solids::{AnisotropicLinear, Fibre, Hyperelastic, Stiffness, TransverseConstants};
/// use piola_continuum::DisplacementGradient;
/// let ply = TransverseConstants {
///     young_along: 100.0, young_across: 10.0, poisson_along: 0.0, poisson_across: 0.0, shear_along: 4.0,
/// };
/// let law = AnisotropicLinear::new(Stiffness::transversely_isotropic(&ply, Fibre::new([1.0, 0.0, 0.0])?)?);
/// let pulled = DisplacementGradient::diagonal([0.25, 0.0, 0.0])?;
/// assert!((law.cauchy(&pulled).0.components[0] - 25.0_f64).abs() < 1e-14); // E_a ε
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// B(4.71–4.77).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct AnisotropicLinear {
    stiffness: Stiffness,
}

impl AnisotropicLinear {
    /// Of a stiffness in Pa.
    #[must_use]
    pub const fn new(stiffness: Stiffness) -> Self {
        Self { stiffness }
    }

    /// C, Pa.
    #[must_use]
    pub const fn stiffness(&self) -> &Stiffness {
        &self.stiffness
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn tensor<T: Real>(&self) -> MajorSymmetric<T> {
        constant_tangent(self.stiffness.tensor())
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn stress<T: Real>(&self, deformation: &impl Deformation<T>) -> Symmetric<T> {
        let [[a, b, c], [d, e, f], [g, h, i]] = deformation.displacement_rows();
        Symmetric { components: T::lanewise(&Linear(*self), [a, b, c, d, e, f, g, h, i]) }
    }
}

/// P and ∂P/∂F of F and ∇u.
struct Linear(AnisotropicLinear);

impl Lanewise<18, 54> for Linear {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<T: Real>(&self, inputs: [T; 18]) -> [T; 54] {
        let [_, h] = packed::gradients(inputs);
        let tensor = self.0.tensor();
        linear_numbers(&tensor.contract(&Symmetric::symmetric_part(h)), &tensor)
    }
}

impl Lanewise<9, 6> for Linear {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<T: Real>(&self, [a, b, c, d, e, f, g, h, i]: [T; 9]) -> [T; 6] {
        self.0.tensor().contract(&Symmetric::symmetric_part([[a, b, c], [d, e, f], [g, h, i]])).components
    }
}

impl Hyperelastic for AnisotropicLinear {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        let strain = LinearStrain::of(deformation).0;
        T::lit(0.5) * self.tensor().quadratic_form(&strain, &strain)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn first_piola<T: Real>(&self, deformation: &impl Deformation<T>) -> FirstPiola<T> {
        FirstPiola(self.stress(deformation).matrix())
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn second_piola<T: Real>(&self, deformation: &impl Deformation<T>) -> SecondPiola<T> {
        SecondPiola(self.stress(deformation))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn kirchhoff<T: Real>(&self, deformation: &impl Deformation<T>) -> KirchhoffStress<T> {
        KirchhoffStress(self.stress(deformation))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn cauchy<T: Real>(&self, deformation: &impl Deformation<T>) -> CauchyStress<T> {
        CauchyStress(self.stress(deformation))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn first_piola_tangent<T: Real>(&self, _deformation: &impl Deformation<T>) -> FirstPiolaTangent<T> {
        FirstPiolaTangent(self.tensor().general())
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn material_tangent<T: Real>(&self, _deformation: &impl Deformation<T>) -> MaterialTangent<T> {
        MaterialTangent(self.tensor())
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn truesdell_tangent<T: Real>(&self, _deformation: &impl Deformation<T>) -> TruesdellTangent<T> {
        TruesdellTangent(self.tensor())
    }
    crate::strain_energy::linear_pairs!();
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn first_piola_and_upper_triangle<T: Real>(&self, deformation: &impl Deformation<T>) -> [T; 54] {
        T::lanewise(&Linear(*self), packed::of_deformation(deformation))
    }
}

/// St. Venant and Kirchhoff's law of any symmetry: Hooke's law between E and S.
///
/// ```text
/// W = ½ E : C : E        S = C : E        ∂S/∂E = C
/// ```
/// For large rotations at small strain: composites, wood, crystals. In compression it loses ellipticity, as the isotropic
/// one does.
///
/// # Accuracy
/// S and P relative 1e-13 down to ∇u = 1e-16, from E; tangents 12 ulp of their norm.
///
/// # Example
/// ```
/// use piola_solids::{AnisotropicSaintVenantKirchhoff, Hyperelastic, Stiffness};
/// use piola_continuum::DeformationGradient;
/// let law = AnisotropicSaintVenantKirchhoff::new(Stiffness::isotropic(1.0, 2.0)?);
/// let bar = DeformationGradient::diagonal([2.0, 1.0, 1.0])?; // E₁₁ = 3/2
/// assert_eq!(law.second_piola(&bar).0.components[0], 7.5); // (λ + 2μ) E₁₁
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// B(4.68), B(4.69), with the stiffness of any symmetry.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct AnisotropicSaintVenantKirchhoff {
    stiffness: Stiffness,
}

impl AnisotropicSaintVenantKirchhoff {
    /// Of a stiffness in Pa.
    #[must_use]
    pub const fn new(stiffness: Stiffness) -> Self {
        Self { stiffness }
    }

    /// C, Pa.
    #[must_use]
    pub const fn stiffness(&self) -> &Stiffness {
        &self.stiffness
    }
}

impl GreenEnergy for AnisotropicSaintVenantKirchhoff {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn green_stress<T: Real>(&self, strain: &Symmetric<T>) -> Symmetric<T> {
        constant_tangent(self.stiffness.tensor()).contract(strain)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn green_stress_and_tangent<T: Real>(&self, strain: &Symmetric<T>) -> (Symmetric<T>, MajorSymmetric<T>) {
        let tangent = constant_tangent(self.stiffness.tensor());
        (tangent.contract(strain), tangent)
    }
}

impl StrainEnergy for AnisotropicSaintVenantKirchhoff {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        let strain = GreenStrain::of(deformation).0;
        T::lit(0.5) * constant_tangent(self.stiffness.tensor()).quadratic_form(&strain, &strain)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn stress<T: Real>(&self, deformation: &impl Deformation<T>) -> Symmetric<T> {
        self.green_stress(&GreenStrain::of(deformation).0)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn tangent<T: Real>(&self, _deformation: &impl Deformation<T>) -> MajorSymmetric<T> {
        constant_tangent(self.stiffness.tensor())
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn upper_triangle<T: Real>(&self, deformation: &impl Deformation<T>) -> [T; 54] {
        self.both_in_lanes(deformation)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn first_piola<T: Real>(&self, deformation: &impl Deformation<T>) -> FirstPiola<T> {
        self.in_lanes(deformation)
    }
    /// W = ½ S : E.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy_stress_and_tangent<T: Real>(
        &self,
        deformation: &impl Deformation<T>,
    ) -> (T, Symmetric<T>, MajorSymmetric<T>) {
        let (strain, tangent) = (GreenStrain::of(deformation).0, self.tangent(deformation));
        let stress = tangent.contract(&strain);
        (T::lit(0.5) * stress.double_contraction(&strain), stress, tangent)
    }
}

hyperelastic_of_strain!(AnisotropicSaintVenantKirchhoff);
