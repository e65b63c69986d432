//! The three-field form.

use nalgebra::Matrix3;
use piola_continuum::stress::tangents::FirstPiolaTangent;
use piola_continuum::{Deformation, FirstPiola};
use piola_numerics::Real;
use piola_numerics::linear::matrix3::{from_rows, rows_of};
use piola_solids::Hyperelastic;
use piola_tensor::FourthOrder;
use piola_tensor::internal::rows::{Rows, difference, double_contraction, scaled, sum, transpose};

use super::resized::Resized;
use crate::LawsError;

/// Energy, residuals and tangent of the three-field form at a point.
///
/// ```text
/// Π(F, θ, p) = W(F̃) + p (J − θ)        F̃ = (θ/J)^(1/3) F
/// ∂Π/∂F = c dev P̃ + p cof F            dev X = X − ⅓ (X : F) F⁻ᵀ,   c = (θ/J)^(1/3),   P̃ = P(F̃)
/// ∂Π/∂θ = (P̃ : F̃)/(3 θ) − p            ∂Π/∂p = J − θ
/// ```
/// The law may be compressible, without any split of its energy, or incompressible; of an incompressible law take θ = 1.
///
/// # Accuracy
/// That of the law's P and ∂P/∂F at F̃, and a few roundings of |P| |F| and of |∂P/∂F| |F|² beside them.
///
/// # Example
/// A neo-Hookean solid with the volume energy ½ κ (θ − 1)².
/// ```
/// use piola_continuum::DeformationGradient;
/// use piola_laws::mixed::ThreeField;
/// use piola_solids::volumetric::Quadratic;
/// use piola_solids::{Compressible, isochoric::NeoHookean};
/// let law = Compressible::new(NeoHookean::new(2.0)?, Quadratic::new(1000.0)?);
/// let shear = DeformationGradient::simple_shear(0.5)?;
/// let at = ThreeField::checked(&law, &shear, 0.25, 100.0)?; // θ = 1.25, p = 100 Pa
/// assert!((at.first_piola.0[(1, 0)] - 1.0_f64).abs() < 1e-13); // μ k: cof F has no entry there
/// assert!((at.volume_residual - 150.0_f64).abs() < 1e-11); // κ (θ − 1) − p
/// assert_eq!(at.pressure_residual, -0.25); // J − θ
/// assert!((at.bulk - 1000.0_f64).abs() < 1e-10); // κ
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias("Hu-Washizu", "mean dilatation", "u-p-theta", "Q1P0"))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThreeField<T: Real = f64> {
    /// Π, J/m³.
    pub energy: T,
    /// ∂Π/∂F, Pa: the first Piola–Kirchhoff stress.
    pub first_piola: FirstPiola<T>,
    /// ∂Π/∂θ, Pa: the mean Cauchy stress of the law, less p.
    pub volume_residual: T,
    /// ∂Π/∂p = J − θ.
    pub pressure_residual: T,
    /// ∂²Π/∂F², Pa.
    pub tangent: FirstPiolaTangent<T>,
    /// ∂²Π/∂F∂θ, Pa; zero where the law is the sum of an energy of shape and one of volume.
    pub coupling: FirstPiola<T>,
    /// ∂²Π/∂F∂p = cof F = J F⁻ᵀ.
    pub cofactor: Matrix3<T>,
    /// ∂²Π/∂θ², Pa: the bulk modulus of the law at θ. ∂²Π/∂θ∂p is −1, ∂²Π/∂p² is 0.
    pub bulk: T,
}

/// X − ⅓ (X : F) F⁻ᵀ.
#[cfg_attr(not(debug_assertions), inline(always))]
fn deviator<T: Real>(x: Rows<T>, gradient: Rows<T>, inverse_transposed: Rows<T>) -> Rows<T> {
    let third = double_contraction(x, gradient) * T::lit(1.0 / 3.0);
    difference(x, scaled(inverse_transposed, third))
}

impl<T: Real> ThreeField<T> {
    /// At F, θ − 1 and p, unchecked: for kernels over lanes or numbers with derivatives.
    ///
    /// | symbol | argument | unit |
    /// |---|---|---|
    /// | F | `deformation` | – |
    /// | θ − 1 | `volume_change` | – |
    /// | p | `mean_stress` | Pa |
    ///
    /// Where the law refuses (θ/J)^(1/3) F or θ ≤ 0 the numbers mean nothing.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn of(law: &impl Hyperelastic, deformation: &impl Deformation<T>, volume_change: T, mean_stress: T) -> Self {
        let (third, ninth) = (T::lit(1.0 / 3.0), T::lit(1.0 / 9.0));
        let resized = Resized::of(deformation, volume_change);
        let (scale, volume) = (resized.scale, resized.jacobian());
        let (energy, stress, tangent) = law.energy_first_piola_and_tangent(&resized);
        let (gradient, cofactor) = (deformation.gradient_rows(), deformation.cofactor_rows());
        let inverse_transposed = transpose(deformation.inverse_rows());
        let stress = rows_of(&stress.0);
        let dev = |x| deviator(x, gradient, inverse_transposed);

        // P̃ : F̃, Ã : F̃ and F̃ : Ã : F̃.
        let trace = double_contraction(stress, resized.gradient_rows());
        let image = tangent.0.contract(resized.gradient_rows());
        let stiffness = double_contraction(image, resized.gradient_rows());
        let deviatoric = scaled(dev(stress), scale);
        let pressure_change = deformation.volume_change() - volume_change;
        Self {
            energy: energy + mean_stress * pressure_change,
            first_piola: FirstPiola(from_rows(sum(deviatoric, scaled(cofactor, mean_stress)))),
            volume_residual: trace * third / volume - mean_stress,
            pressure_residual: pressure_change,
            tangent: FirstPiolaTangent(FourthOrder {
                components: second_derivative(
                    &tangent.0,
                    [gradient, inverse_transposed, deviatoric],
                    scale * scale,
                    [trace, mean_stress * deformation.jacobian()],
                ),
            }),
            coupling: FirstPiola(from_rows(scaled(dev(sum(stress, image)), scale * third / volume))),
            cofactor: from_rows(cofactor),
            bulk: (stiffness - trace - trace) * ninth / (volume * volume),
        }
    }
}

impl ThreeField {
    /// As [`of`](Self::of), with every argument checked.
    ///
    /// # Errors
    /// [`LawsError::OutOfBounds`] unless θ and p are finite and 0 < θ; [`LawsError::Solids`] where the law refuses
    /// (θ/J)^(1/3) F, as an incompressible law does unless θ = 1.
    pub fn checked(
        law: &impl Hyperelastic,
        deformation: &impl Deformation<f64>,
        volume_change: f64,
        mean_stress: f64,
    ) -> Result<Self, LawsError> {
        if !(volume_change.is_finite() && -1.0 < volume_change) {
            return Err(LawsError::OutOfBounds { quantity: "θ", value: 1.0 + volume_change, bound: "0 < θ" });
        }
        if !mean_stress.is_finite() {
            return Err(LawsError::OutOfBounds { quantity: "p", value: mean_stress, bound: "|p| < ∞" });
        }
        law.check(&Resized::of(deformation, volume_change))?;
        Ok(Self::of(law, deformation, volume_change, mean_stress))
    }
}

/// ∂²Π/∂F² with G = F⁻ᵀ, s = c dev P̃, t = P̃ : F̃ and q = p J.
///
/// ```text
/// c² 𝔻 : Ã : 𝔻ᵀ − ⅓ (s ⊗ G + G ⊗ s) + (q − ⅑ t) G ⊗ G + (⅓ t − q) (G_iB G_jA),   𝔻 X = dev X
/// ```
#[cfg_attr(not(debug_assertions), inline(always))]
fn second_derivative<T: Real>(
    tangent: &FourthOrder<T>,
    [gradient, inverse_transposed, deviatoric]: [Rows<T>; 3],
    square: T,
    [trace, spherical]: [T; 2],
) -> [[T; 9]; 9] {
    let third = T::lit(1.0 / 3.0);
    let right = tangent.contract(gradient);
    let left = tangent.contract_left(gradient);
    let twice = double_contraction(right, gradient) * T::lit(1.0 / 9.0);
    let (dyad, crossed) = (spherical - trace * T::lit(1.0 / 9.0), trace * third - spherical);
    let (g, s) = (inverse_transposed.as_flattened(), deviatoric.as_flattened());
    let (right, left) = (right.as_flattened(), left.as_flattened());
    let mut entries = [[T::zero(); 9]; 9];
    let mut row = 0;
    while row < 9 {
        let mut column = 0;
        while column < 9 {
            let (i, a, j, b) = (row / 3, row % 3, column / 3, column % 3);
            let projected = tangent.components[row][column] - (right[row] * g[column] + g[row] * left[column]) * third
                + twice * (g[row] * g[column]);
            entries[row][column] = square * projected - (s[row] * g[column] + g[row] * s[column]) * third
                + dyad * (g[row] * g[column])
                + crossed * (inverse_transposed[i][b] * inverse_transposed[j][a]);
            column += 1;
        }
        row += 1;
    }
    entries
}
