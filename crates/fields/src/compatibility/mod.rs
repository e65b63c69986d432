//! Compatibility: whether a field of gradients, metrics or strains belongs to a deformation.
//!
//! ```text
//! F = ∂x/∂X     ⇔  ∂F_iA/∂X_B = ∂F_iB/∂X_A                          W(14.9)    gradient_residual
//! C = FᵀF       ⇔  R_ABCD(C) = 0, the Riemann curvature of C         W(24.20)   Curvature
//! ε = sym ∇u    ⇔  inc ε = 0, (inc ε)_KL = ε_KAC ε_LBD ∂_A∂_B ε_CD              incompatibility
//! ```
//!
//! Locally, in regions without holes, the conditions are sufficient. Derivatives are exact, so what is not zero
//! to rounding is not compatible; every residual has its scale.

mod curvature;
mod linear;

pub use curvature::{Curvature, SymmetricResidual};
pub use linear::incompatibility;

use nalgebra::{Matrix3, Vector3};
use piola_numerics::Real;
use piola_numerics::linear::matrix3::from_rows;

use super::field::{Field, check_point, value_and_partials};
use super::frames::Material;
use super::residual::Residual;
use crate::FieldsError;
use crate::error::check_finite;

/// What W(14.9) leaves: three residuals for each of the three components of x.
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_fields::compatibility::GradientResidual;
/// let residual = GradientResidual { value: Matrix3::from_element(1.0), scale: Matrix3::from_element(4.0) };
/// assert_eq!(residual.relative(), 0.25);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(bound(
        serialize = "T: nalgebra::Scalar + serde::Serialize",
        deserialize = "T: Real + serde::Deserialize<'de>"
    ))
)]
pub struct GradientResidual<T = f64> {
    /// `(Curl F)ᵢ_C = ε_CBA ∂F_iA/∂X_B`, 1/m: at row i the differences ∂₂Fᵢ₃ − ∂₃Fᵢ₂, ∂₃Fᵢ₁ − ∂₁Fᵢ₃, ∂₁Fᵢ₂ − ∂₂Fᵢ₁.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::reading::finite"))]
    pub value: Matrix3<T>,
    /// The sums of the moduli of the two terms.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::reading::finite"))]
    pub scale: Matrix3<T>,
}

impl<T: Real> GradientResidual<T> {
    /// The largest component divided by the largest scale, ∈ [0, 1]; zero when all terms are.
    #[must_use]
    pub fn relative(&self) -> T {
        let largest = |m: &Matrix3<T>| m.iter().fold(T::zero(), |largest, x| largest.max(x.abs()));
        Residual { value: largest(&self.value), scale: largest(&self.scale) }.relative()
    }
}

/// `∂F_iA/∂X_B − ∂F_iB/∂X_A`, 1/m: zero where F is the gradient of a deformation, W(14.9).
///
/// | symbol | argument | shape | unit |
/// |---|---|---|---|
/// | F(X, t) | `gradient` | 3×3 | – |
/// | X, t | `reference`, `t` | 3, scalar | m, s |
///
/// # Errors
/// [`FieldsError::NotFinite`].
///
/// # Example
/// A rotation whose angle grows with X₁ is not a gradient.
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use piola_fields::{Field, Material, compatibility::gradient_residual};
/// use piola_numerics::Real;
/// struct Turn;
/// impl Field for Turn {
///     type Value = Matrix3<f64>;
///     fn at<T: Real>(&self, particle: &Vector3<T>, _time: T) -> Matrix3<T> {
///         let ((s, c), o, l) = (particle.x.sin_cos(), T::lit(0.0), T::lit(1.0));
///         Matrix3::new(c, -s, o, s, c, o, o, o, l)
///     }
/// }
/// let residual = gradient_residual(&Material(Turn), &Vector3::zeros(), 0.0)?;
/// assert_eq!(residual.value[(0, 2)], -1.0); // ∂₁F₁₂ − ∂₂F₁₁
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
pub fn gradient_residual<T: Real>(
    gradient: &Material<impl Field<Value = Matrix3<f64>>>,
    reference: &Vector3<T>,
    t: T,
) -> Result<GradientResidual<T>, FieldsError> {
    check_point(reference, t)?;
    let (_, partials) = value_and_partials(&gradient.0, reference, t);
    let difference = |i: usize, c: usize| {
        let (b, a) = ((c + 1) % 3, (c + 2) % 3);
        Residual::zero().plus(partials[b][(i, a)]).plus(-partials[a][(i, b)])
    };
    let terms = [0, 1, 2].map(|i: usize| [0, 1, 2].map(|c: usize| difference(i, c)));
    let (value, scale) = (terms.map(|row| row.map(|r| r.value)), terms.map(|row| row.map(|r| r.scale)));
    check_finite("Curl F", value.as_flattened())?;
    Ok(GradientResidual { value: from_rows(value), scale: from_rows(scale) })
}
