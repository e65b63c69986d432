//! Compatibility of small strains.

use nalgebra::Vector3;
use piola_numerics::Real;
use piola_tensor::Symmetric;

use super::SymmetricResidual;
use super::curvature::{PAIRS, second_differences, with_second_partials};
use crate::FieldsError;
use crate::field::{Field, check_point};
use crate::frames::Material;

/// inc ε, the incompatibility of a field of linear strains, 1/m²: zero where ε = sym ∇u (Saint-Venant).
///
/// ```text
/// (inc ε)_KL = ε_KAC ε_LBD ∂²ε_CD/∂X_A∂X_B        (inc ε)₃₃ = ∂₁²ε₂₂ + ∂₂²ε₁₁ − 2 ∂₁∂₂ε₁₂
/// ```
///
/// | symbol | argument | shape | unit |
/// |---|---|---|---|
/// | ε(X, t) | `strain` | 3×3 symmetric | – |
/// | inc ε | returned, with scale | 3×3 symmetric | 1/m² |
///
/// # Errors
/// [`FieldsError::NotFinite`].
///
/// # Example
/// Growth ε₁₁ = ½ X₂² does not fit together: (inc ε)₃₃ = 1.
/// ```
/// use nalgebra::Vector3;
/// use piola_continuum::Symmetric;
/// use piola_fields::{Field, Material, compatibility::incompatibility};
/// use piola_numerics::Real;
/// struct Growth;
/// impl Field for Growth {
///     type Value = Symmetric;
///     fn at<T: Real>(&self, particle: &Vector3<T>, _time: T) -> Symmetric<T> {
///         let o = T::lit(0.0);
///         Symmetric::diagonal([T::lit(0.5) * particle.y * particle.y, o, o])
///     }
/// }
/// let residual = incompatibility(&Material(Growth), &Vector3::zeros(), 0.0)?;
/// assert_eq!(residual.value.components, [0.0, 0.0, 1.0, 0.0, 0.0, 0.0]);
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
pub fn incompatibility<T: Real>(
    strain: &Material<impl Field<Value = Symmetric>>,
    reference: &Vector3<T>,
    t: T,
) -> Result<SymmetricResidual<T>, FieldsError> {
    check_point(reference, t)?;
    let strain = with_second_partials(strain, reference, t);
    let second = |a: usize, b: usize, c: usize, d: usize| strain[c][d].partials[a].partials[b];
    // As half the metric 1 + 2ε.
    let entry = |k: usize, l: usize| second_differences(PAIRS[k], PAIRS[l], -T::one(), second);
    SymmetricResidual::of("inc", entry)
}
