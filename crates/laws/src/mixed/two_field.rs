//! The u–p form.

use nalgebra::Matrix3;
use piola_continuum::stress::tangents::FirstPiolaTangent;
use piola_continuum::{Deformation, FirstPiola};
use piola_numerics::Real;
use piola_numerics::linear::matrix3::{from_rows, rows_of};
use piola_solids::Hyperelastic;
use piola_tensor::internal::rows::scaled;

use super::ThreeField;
use crate::LawsError;

/// Energy, residuals and tangent of the u–p form at a point.
///
/// ```text
/// Π(F, p) = stationary value over θ of W((θ/J)^(1/3) F) + p (J − θ)
/// ```
/// # Example
/// See [`two_field`].
#[doc(alias("displacement-pressure", "perturbed Lagrangian", "Taylor-Hood"))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoField<T: Real = f64> {
    /// Π, J/m³.
    pub energy: T,
    /// ∂Π/∂F, Pa: the first Piola–Kirchhoff stress.
    pub first_piola: FirstPiola<T>,
    /// ∂Π/∂p = J − θ.
    pub pressure_residual: T,
    /// ∂²Π/∂F², Pa.
    pub tangent: FirstPiolaTangent<T>,
    /// ∂²Π/∂F∂p: cof F, and the change of θ with F at constant p.
    pub cofactor: Matrix3<T>,
    /// 1/h, 1/Pa: −∂²Π/∂p². Zero where the law is incompressible.
    pub compliance: T,
}

/// Iterations for θ.
const MOST_ITERATIONS: usize = 50;

/// The u–p form of a law at F and p; of an incompressible law θ = 1, of any other θ is the volume at which its mean stress is p.
///
/// | symbol | argument | unit |
/// |---|---|---|
/// | F | `deformation` | – |
/// | p | `mean_stress`, positive in tension | Pa |
///
/// # Errors
/// [`LawsError::OutOfBounds`] unless p is finite; [`LawsError::NoVolume`] where no θ is found, with the best one;
/// [`LawsError::Solids`] where the law refuses.
///
/// # Accuracy
/// θ by Newton's method to rounding; the rest as [`ThreeField`].
///
/// # Example
/// ```
/// use piola_continuum::DeformationGradient;
/// use piola_laws::mixed::two_field;
/// use piola_solids::volumetric::Quadratic;
/// use piola_solids::{Compressible, IncompressibleSolid, isochoric::NeoHookean};
/// let shear = DeformationGradient::simple_shear(0.5)?;
/// let rubber = Compressible::new(NeoHookean::new(2.0)?, Quadratic::new(1000.0)?);
/// let at = two_field(&rubber, &shear, 100.0)?;
/// assert!((at.pressure_residual + 0.1).abs() < 1e-14); // J − θ with θ = 1 + p/κ
/// assert!((at.compliance - 1e-3).abs() < 1e-15); // 1/κ
/// let limit = two_field(&IncompressibleSolid::new(NeoHookean::new(2.0)?), &shear, 100.0)?;
/// assert_eq!((limit.pressure_residual, limit.compliance), (0.0, 0.0)); // J − 1
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn two_field(
    law: &impl Hyperelastic,
    deformation: &impl Deformation<f64>,
    mean_stress: f64,
) -> Result<TwoField, LawsError> {
    if law.is_incompressible() {
        let at = ThreeField::checked(law, deformation, 0.0, mean_stress)?;
        return Ok(TwoField {
            energy: at.energy,
            first_piola: at.first_piola,
            pressure_residual: at.pressure_residual,
            tangent: at.tangent,
            cofactor: at.cofactor,
            compliance: 0.0,
        });
    }
    let mut volume_change = deformation.volume_change();
    let mut best = (f64::INFINITY, f64::NAN);
    let mut is_close = false;
    for _ in 0..MOST_ITERATIONS {
        let at = ThreeField::checked(law, deformation, volume_change, mean_stress)?;
        if at.volume_residual.abs() < best.0 {
            best = (at.volume_residual.abs(), 1.0 + volume_change);
        }
        let step = -at.volume_residual / at.bulk;
        if !(step.is_finite() && 0.0 < at.bulk) {
            break;
        }
        if is_close {
            // What the last step left, some 1e-16, is eliminated with the linearised equation of θ.
            return Ok(at.condensed());
        }
        // No step changes the volume by more than its half. The error of the next is the square of a small step.
        let volume = 1.0 + volume_change;
        is_close = step.abs() <= 1e-8 * volume;
        volume_change += step.clamp(-0.5 * volume, 0.5 * volume);
    }
    Err(LawsError::NoVolume { mean_stress, volume: best.1, residual: best.0 })
}

impl<T: Real> ThreeField<T> {
    /// The u–p form: θ is eliminated from the linearised equations, its residual included.
    ///
    /// ```text
    /// K − g ⊗ g/h        cof F + g/h        −1/h        g = ∂²Π/∂F∂θ,   h = ∂²Π/∂θ²
    /// ```
    /// After a step (δF, δp) the volume changes by `δθ = (δp − g : δF − ∂Π/∂θ)/h`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn condensed(&self) -> TwoField<T> {
        let compliance = self.bulk.recip();
        let coupling = self.coupling.0;
        let step = self.volume_residual * compliance;
        let rows = scaled(rows_of(&coupling), compliance);
        let mut tangent = self.tangent;
        let (left, right) = (rows.as_flattened(), rows_of(&coupling));
        let right = right.as_flattened();
        let mut r = 0;
        while r < 9 {
            let mut s = 0;
            while s < 9 {
                tangent.0.components[r][s] -= left[r] * right[s];
                s += 1;
            }
            r += 1;
        }
        TwoField {
            energy: self.energy - self.volume_residual * step * T::lit(0.5),
            first_piola: FirstPiola(self.first_piola.0 - coupling * step),
            pressure_residual: self.pressure_residual + step,
            tangent,
            cofactor: self.cofactor + from_rows(rows),
            compliance,
        }
    }
}
