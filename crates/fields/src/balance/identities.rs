//! Identities of Piola, and the symmetry of stress.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::CauchyStress;
use piola_numerics::linear::matrix3::determinant;
use piola_numerics::{Gradient, Real};
use piola_tensor::internal::rows::{Rows, cofactor, product};

use super::checked_vector;
use super::flow::dot_terms;
use crate::FieldsError;
use crate::field::{Field, finite};
use crate::frames::Spatial;
use crate::motion::kernels::{place_and_gradient, variables};
use crate::motion::{Motion, check_event};
use crate::residual::{Residual, VectorResidual};

/// Div(J F⁻ᵀ), `∂(J F⁻ᵀ)ᵢ_A/∂X_A`, 1/m: zero for every motion.
///
/// # Errors
/// What the motion refuses; [`FieldsError::NotFinite`].
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_fields::{Motion, balance::cofactor_divergence};
/// use piola_numerics::Real;
/// struct Bending;
/// impl Motion for Bending {
///     fn place<T: Real>(&self, reference: &Vector3<T>, _time: T) -> Vector3<T> {
///         Vector3::new(reference.x * (T::one() + reference.y), reference.y, reference.z)
///     }
/// }
/// let residual = cofactor_divergence(&Bending, &Vector3::new(1.0, 2.0, 3.0), 0.0)?;
/// assert_eq!(residual.value, Vector3::zeros()); // ∂₁(Cof F)₂₁ + ∂₂(Cof F)₂₂ = −1 + 1 and so on
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
///
/// # Source
/// The identity behind B(4.53).
pub fn cofactor_divergence<T: Real>(
    motion: &impl Motion,
    reference: &Vector3<T>,
    t: T,
) -> Result<VectorResidual<T>, FieldsError> {
    check_event(motion, reference, t)?;
    let (_, gradient) = place_and_gradient(motion, &variables(reference), Gradient::constant(t));
    checked_vector("divergence of J F^-T", divergence(&cofactor(gradient)))
}

/// Div P − J div T for P = J T F⁻ᵀ, N/m³: Piola's identity, B(4.53), zero for every motion and stress.
///
/// | symbol | argument | unit |
/// |---|---|---|
/// | T(x, t) | `stress` | Pa |
/// | X, t | `reference`, `t` | m, s |
///
/// # Errors
/// What the motion refuses; [`FieldsError::NotFinite`].
pub fn piola_identity_residual<T: Real>(
    motion: &impl Motion,
    stress: &Spatial<impl Field<Value = CauchyStress>>,
    reference: &Vector3<T>,
    t: T,
) -> Result<VectorResidual<T>, FieldsError> {
    check_event(motion, reference, t)?;
    let instant = Gradient::constant(t);
    let (x, gradient) = place_and_gradient(motion, &variables(reference), instant);
    let first_piola = product(stress.0.at(&x, instant).rows(), cofactor(gradient));
    let place = finite::<Vector3<f64>, T>("place", x.map(|x| x.value))?;
    let jacobian = determinant(gradient.map(|row| row.map(|f| f.value)));
    let referential = divergence(&first_piola);
    let spatial = divergence(&stress.0.at(&variables(&place), instant).rows());
    checked_vector("Piola's identity", [0, 1, 2].map(|i: usize| referential[i].plus_all(spatial[i], -jacobian)))
}

/// T − Tᵀ as the vector of its entries 32, 13, 21, Pa, with its scale: zero by the balance of moment of
/// momentum, W(17.34).
#[inline]
#[must_use]
pub fn symmetry_residual<T: Real>(tensor: &Matrix3<T>) -> VectorResidual<T> {
    let entry = |i: usize, j: usize| Residual::zero().plus(tensor[(i, j)]).plus(-tensor[(j, i)]);
    [entry(2, 1), entry(0, 2), entry(1, 0)].into()
}

/// P Fᵀ − F Pᵀ as the vector of its entries 32, 13, 21, with the moduli of all products.
#[inline]
pub(super) fn two_point_symmetry<T: Real>(p: &Rows<T>, f: &Rows<T>) -> [Residual<T>; 3] {
    let entry = |i: usize, j: usize| dot_terms(p[i], f[j]).plus_all(dot_terms(p[j], f[i]), -T::one());
    [entry(2, 1), entry(0, 2), entry(1, 0)]
}

/// ∂Aᵢⱼ/∂xⱼ of a tensor with derivatives with respect to Cartesian coordinates.
#[inline]
pub(super) fn divergence<T: Real>(tensor: &Rows<Gradient<T, 3>>) -> [Residual<T>; 3] {
    tensor.map(|row| (0..3).fold(Residual::zero(), |sum, j| sum.plus(row[j].partials[j])))
}
