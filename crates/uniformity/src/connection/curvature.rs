//! The curvature of a connection.

use nalgebra::Matrix3;
use piola_numerics::Real;
use piola_numerics::linear::matrix3::{from_rows, inverse, rows_of};
use piola_tensor::{Rows, Symmetric};

use crate::UniformityError;
use crate::indices::{fourth, second, sum};

/// `R^C_ABD`, 1/m², with the size of its terms; minus the common `R^C_{A,BD}`.
///
/// # Example
/// The sphere r = 2 has Ric = 1/r² of its metric on the sphere; here by components that are given.
/// ```
/// use piola_uniformity::ConnectionCurvature;
/// let mut components = [[[[0.0; 3]; 3]; 3]; 3];
/// (components[0][1][1][0], components[0][1][0][1]) = (0.25, -0.25); // R¹₂₂₁
/// (components[1][0][0][1], components[1][0][1][0]) = (0.25, -0.25); // R²₁₁₂
/// let curvature = ConnectionCurvature { components, scale: 0.25 };
/// assert_eq!(curvature.ricci()[(0, 0)], 0.25); // R^C_11C
/// ```
///
/// # Source
/// W(27.14).
#[doc(alias = "Riemann tensor")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConnectionCurvature<T = f64> {
    /// `[C][A][B][D]`.
    pub components: [[[[T; 3]; 3]; 3]; 3],
    /// The largest sum of the moduli of the terms of a component, 1/m².
    pub scale: T,
}

impl<T: Real> ConnectionCurvature<T> {
    /// The largest component, 1/m².
    #[must_use]
    pub fn largest(&self) -> T {
        let flat = self.components.as_flattened().as_flattened().as_flattened();
        crate::indices::largest(flat.iter().copied())
    }

    /// The largest component divided by the scale, ∈ [0, 1]; zero when all terms are.
    #[must_use]
    pub fn relative(&self) -> T {
        piola_fields::Residual { value: self.largest(), scale: self.scale }.relative()
    }

    /// `Ric_AB = R^C_ABC`, 1/m²: positive on spheres, symmetric without torsion.
    #[must_use]
    pub fn ricci(&self) -> Matrix3<T> {
        from_rows(second(|a, b| sum(|c| self.components[c][a][b][c])))
    }

    /// `R = M^AB Ric_AB`, 1/m², of a metric's inverse.
    #[must_use]
    pub fn scalar(&self, inverse_metric: &Symmetric<T>) -> T {
        let (ricci, inverse) = (self.ricci(), inverse_metric.rows());
        sum(|a| sum(|b| inverse[a][b] * ricci[(a, b)]))
    }

    /// The components in coordinates q, given ∂X/∂q.
    ///
    /// # Errors
    /// [`UniformityError::NotFinite`], [`UniformityError::OutOfBounds`] for a singular ∂X/∂q.
    pub fn transformed(&self, jacobian: &Matrix3<T>) -> Result<Self, UniformityError> {
        let (inverse, j) = (inverse_of(jacobian)?, rows_of(jacobian));
        // One index after the other.
        let first = fourth(|c, a, b, d| sum(|e| inverse[c][e] * self.components[e][a][b][d]));
        let second = fourth(|c, a, b, d| sum(|e| first[c][e][b][d] * j[e][a]));
        let third = fourth(|c, a, b, d| sum(|e| second[c][a][e][d] * j[e][b]));
        let components = fourth(|c, a, b, d| sum(|e| third[c][a][b][e] * j[e][d]));
        let size = |r: &Rows<T>| crate::indices::largest(r.as_flattened().iter().copied());
        let scale = self.scale * size(&inverse) * size(&j) * size(&j) * size(&j);
        Ok(Self { components, scale })
    }
}

/// J⁻¹ of a change of coordinates.
pub(super) fn inverse_of<T: Real>(jacobian: &Matrix3<T>) -> Result<Rows<T>, UniformityError> {
    crate::error::check_finite("change of coordinates", jacobian.as_slice())?;
    let refused = |_| UniformityError::OutOfBounds {
        quantity: "det ∂X/∂q",
        value: piola_numerics::linear::matrix3::determinant(rows_of(jacobian)).primal(0),
        bound: "det ∂X/∂q ≠ 0",
    };
    Ok(rows_of(&inverse(jacobian).map_err(refused)?))
}
