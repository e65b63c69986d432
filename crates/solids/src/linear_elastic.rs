//! Linear elasticity of isotropic solids.

use piola_continuum::strain::LinearStrain;
use piola_continuum::stress::tangents::{FirstPiolaTangent, MaterialTangent, TruesdellTangent};
use piola_continuum::{CauchyStress, Deformation, FirstPiola, KirchhoffStress, SecondPiola, Symmetric};
use piola_numerics::Real;
use piola_numerics::internal::Lanewise;
use piola_tensor::voigt::{ComplianceMatrix, StiffnessMatrix, VoigtOrder};
use piola_tensor::{FourthOrder, MajorSymmetric};

use super::strain_energy::linear_numbers;
use super::{ElasticConstants, Hyperelastic, packed};
use crate::SolidsError;

const LAW: &str = "linear elastic";

/// An isotropic linear elastic solid, Hooke's law.
///
/// ```text
/// T = λ tr ε 1 + 2 μ ε        W = ½ λ (tr ε)² + μ ε : ε        ε = sym ∇u
/// σ = M ε   with M = [λ + 2μ on the diagonal of the normals, λ beside it, μ for the engineering shears]
/// ```
/// For small strain and small rotation, where all measures of stress are T and all tangents λ 1 ⊗ 1 + 2 μ: each method
/// of [`Hyperelastic`] returns these. It is not frame-indifferent: a turned body is taken for a strained one.
///
/// Of an incompressible solid see [`MixedLinearElastic`].
///
/// # Accuracy
/// 3 ulp of the norm, from ∇u.
///
/// # Example
/// ```
/// use piola_solids::{ElasticConstants, LinearElastic};
/// use piola_continuum::strain::LinearStrain;
/// use piola_tensor::voigt::BroNielsen;
/// let steel = LinearElastic::new(ElasticConstants::from_young_poisson(200e9, 0.25)?)?;
/// let strain = LinearStrain::new(1e-3, 0.0, 0.0, 0.5e-3, 0.0, 0.0)?;
/// let stress = steel.stress(&strain).0.components;
/// assert_eq!(stress.map(f64::round), [240e6, 80e6, 80e6, 80e6, 0.0, 0.0]);
/// assert_eq!(steel.material_matrix::<BroNielsen>().entries[0], [240e9, 80e9, 80e9, 0.0, 0.0, 0.0]); // B(4.77)
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// B(4.71–4.77).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "ElasticConstants", into = "ElasticConstants"))]
pub struct LinearElastic {
    constants: ElasticConstants,
    lambda: f64,
}

impl LinearElastic {
    /// With constants of a compressible solid.
    ///
    /// # Errors
    /// [`SolidsError::OutOfBounds`] where ν = ½: strain does not determine the stress.
    pub fn new(constants: ElasticConstants) -> Result<Self, SolidsError> {
        let Some(lambda) = constants.first_lame_parameter() else {
            return Err(SolidsError::OutOfBounds {
                law: LAW, parameter: "poisson_ratio", value: 0.5, bound: "ν < ½"
            });
        };
        Ok(Self { constants, lambda })
    }

    /// The constants.
    #[must_use]
    pub const fn constants(&self) -> &ElasticConstants {
        &self.constants
    }

    /// T = λ tr ε 1 + 2 μ ε.
    ///
    /// # Source
    /// B(4.72).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn stress<T: Real>(&self, strain: &LinearStrain<T>) -> CauchyStress<T> {
        CauchyStress(self.hooke(&strain.0))
    }

    /// ε of T, the inverse.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn strain<T: Real>(&self, stress: &CauchyStress<T>) -> LinearStrain<T> {
        strain_of(&self.constants, stress)
    }

    /// W = ½ T : ε.
    ///
    /// # Source
    /// B(4.76).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn energy_density<T: Real>(&self, strain: &LinearStrain<T>) -> T {
        let trace = strain.0.trace();
        T::lit(0.5 * self.lambda) * (trace * trace)
            + T::lit(self.constants.shear_modulus()) * strain.0.double_contraction(&strain.0)
    }

    /// The tangent λ 1 ⊗ 1 + 2 μ.
    #[must_use]
    pub fn stiffness<T: Real>(&self) -> MajorSymmetric<T> {
        MajorSymmetric::isotropic(T::lit(self.lambda), T::lit(self.constants.shear_modulus()))
    }

    /// The material matrix M of σ = M ε in an order of components, such as
    /// [`Piola`](piola_tensor::voigt::Piola) or that of the text,
    /// [`BroNielsen`](piola_tensor::voigt::BroNielsen).
    ///
    /// # Source
    /// B(4.77).
    #[must_use]
    pub fn material_matrix<O: VoigtOrder>(&self) -> StiffnessMatrix<f64, O> {
        StiffnessMatrix::of(&self.stiffness())
    }

    /// M⁻¹, from E, ν and G.
    #[must_use]
    pub fn compliance_matrix<O: VoigtOrder>(&self) -> ComplianceMatrix<f64, O> {
        compliance_matrix(&self.constants)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn hooke<T: Real>(&self, strain: &Symmetric<T>) -> Symmetric<T> {
        Symmetric::identity() * (T::lit(self.lambda) * strain.trace())
            + *strain * T::lit(2.0 * self.constants.shear_modulus())
    }
}

impl TryFrom<ElasticConstants> for LinearElastic {
    type Error = SolidsError;

    fn try_from(constants: ElasticConstants) -> Result<Self, SolidsError> {
        Self::new(constants)
    }
}

impl From<LinearElastic> for ElasticConstants {
    fn from(law: LinearElastic) -> Self {
        law.constants
    }
}

/// ε = dev T/(2 μ) + tr T/(9 K) 1, also where 1/K = 0.
#[cfg_attr(not(debug_assertions), inline(always))]
fn strain_of<T: Real>(constants: &ElasticConstants, stress: &CauchyStress<T>) -> LinearStrain<T> {
    let mean = stress.0.trace() * T::lit(constants.compressibility() / 9.0);
    LinearStrain(stress.0.deviator() * T::lit(0.5 / constants.shear_modulus()) + Symmetric::identity() * mean)
}

fn compliance_matrix<O: VoigtOrder>(constants: &ElasticConstants) -> ComplianceMatrix<f64, O> {
    let (nu, young) = (constants.poisson_ratio(), constants.young_modulus());
    // (1 + ν)/E = 1/(2 μ).
    ComplianceMatrix::of(&MajorSymmetric::isotropic(-nu / young, 0.25 / constants.shear_modulus()))
}

/// P and ∂P/∂F of F and ∇u.
struct Both(LinearElastic);

impl Lanewise<18, 54> for Both {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<T: Real>(&self, inputs: [T; 18]) -> [T; 54] {
        let [_, h] = packed::gradients(inputs);
        linear_numbers(&self.0.hooke(&Symmetric::symmetric_part(h)), &self.0.stiffness())
    }
}

impl Hyperelastic for LinearElastic {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        self.energy_density(&LinearStrain::of(deformation))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn first_piola<T: Real>(&self, deformation: &impl Deformation<T>) -> FirstPiola<T> {
        FirstPiola(self.hooke(&LinearStrain::of(deformation).0).matrix())
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn second_piola<T: Real>(&self, deformation: &impl Deformation<T>) -> SecondPiola<T> {
        SecondPiola(self.hooke(&LinearStrain::of(deformation).0))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn kirchhoff<T: Real>(&self, deformation: &impl Deformation<T>) -> KirchhoffStress<T> {
        KirchhoffStress(self.hooke(&LinearStrain::of(deformation).0))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn cauchy<T: Real>(&self, deformation: &impl Deformation<T>) -> CauchyStress<T> {
        self.stress(&LinearStrain::of(deformation))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn material_tangent<T: Real>(&self, _deformation: &impl Deformation<T>) -> MaterialTangent<T> {
        MaterialTangent(self.stiffness())
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn truesdell_tangent<T: Real>(&self, _deformation: &impl Deformation<T>) -> TruesdellTangent<T> {
        TruesdellTangent(self.stiffness())
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn first_piola_and_upper_triangle<T: Real>(&self, deformation: &impl Deformation<T>) -> [T; 54] {
        T::lanewise(&Both(*self), packed::of_deformation(deformation))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn first_piola_tangent<T: Real>(&self, _deformation: &impl Deformation<T>) -> FirstPiolaTangent<T> {
        let (lambda, mu) = (T::lit(self.lambda), T::lit(self.constants.shear_modulus()));
        let mut components = [[T::zero(); 9]; 9];
        for i in 0..3 {
            for j in 0..3 {
                components[4 * i][4 * j] += lambda;
                components[3 * i + j][3 * i + j] += mu;
                components[3 * i + j][3 * j + i] += mu;
            }
        }
        FirstPiolaTangent(FourthOrder { components })
    }

    crate::strain_energy::linear_pairs!();
}

/// Linear elasticity with the pressure as an unknown of its own: one form for all ν ≤ ½.
///
/// ```text
/// T = −p 1 + 2 μ dev ε        tr ε + p/K = 0        1/K = 0 where ν = ½
/// ```
/// Nothing grows as ν → ½: the second equation turns into the constraint of incompressibility.
///
/// # Example
/// ```
/// use piola_solids::{ElasticConstants, MixedLinearElastic};
/// use piola_continuum::strain::LinearStrain;
/// let rubber = MixedLinearElastic::new(ElasticConstants::incompressible(1e6)?);
/// let strain = LinearStrain::new(2e-3, -1e-3, -1e-3, 0.0, 0.0, 0.0)?;
/// // Pulled with its sides free: p = −2 μ 1e-3, so that T₂₂ = 0.
/// let stress = rubber.stress(&strain, -2e3).0.components;
/// assert_eq!(stress.map(f64::round), [6e3, 0.0, 0.0, 0.0, 0.0, 0.0]); // E ε₁₁ with E = 3 μ
/// assert_eq!(rubber.volume_residual(&strain, -2e3), 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// B(4.72), B(4.64) with its multiplier, linearised.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(transparent))]
pub struct MixedLinearElastic {
    constants: ElasticConstants,
}

impl MixedLinearElastic {
    /// With any constants.
    #[must_use]
    pub const fn new(constants: ElasticConstants) -> Self {
        Self { constants }
    }

    /// The constants.
    #[must_use]
    pub const fn constants(&self) -> &ElasticConstants {
        &self.constants
    }

    /// T = −p 1 + 2 μ dev ε.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn stress<T: Real>(&self, strain: &LinearStrain<T>, pressure: T) -> CauchyStress<T> {
        let deviator = strain.0.deviator() * T::lit(2.0 * self.constants.shear_modulus());
        CauchyStress(deviator - Symmetric::identity() * pressure)
    }

    /// tr ε + p/K: zero where p is the pressure of the strain.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn volume_residual<T: Real>(&self, strain: &LinearStrain<T>, pressure: T) -> T {
        strain.0.trace() + pressure * T::lit(self.constants.compressibility())
    }

    /// ε of T, also of an incompressible solid.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn strain<T: Real>(&self, stress: &CauchyStress<T>) -> LinearStrain<T> {
        strain_of(&self.constants, stress)
    }

    /// M⁻¹; singular, but finite, where ν = ½.
    #[must_use]
    pub fn compliance_matrix<O: VoigtOrder>(&self) -> ComplianceMatrix<f64, O> {
        compliance_matrix(&self.constants)
    }
}
