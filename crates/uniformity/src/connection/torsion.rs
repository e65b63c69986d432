//! The torsion of a connection.

use nalgebra::{Matrix3, Vector3};
use piola_numerics::Real;
use piola_numerics::linear::matrix3::{from_rows, rows_of};

use crate::UniformityError;
use crate::indices::{second, sum, third};

/// `Y^C_AB = Γ^C_AB − Γ^C_BA`, 1/m, with the size of its terms.
///
/// # Example
/// ```
/// use piola_uniformity::ConnectionCoefficients;
/// let mut components = [[[0.0; 3]; 3]; 3];
/// components[2][0][1] = 1.0;
/// components[2][1][0] = -1.0;
/// let torsion = ConnectionCoefficients { components }.torsion();
/// assert_eq!(torsion.components[2][0][1], 2.0);
/// assert_eq!(torsion.relative(), 1.0); // |2|/(|1| + |−1|)
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Torsion<T = f64> {
    /// `[C][A][B]`.
    pub components: [[[T; 3]; 3]; 3],
    /// The largest `|Γ^C_AB| + |Γ^C_BA|`, 1/m.
    pub scale: T,
}

impl<T: Real> Torsion<T> {
    /// The largest component, 1/m.
    #[must_use]
    pub fn largest(&self) -> T {
        crate::indices::largest(self.components.as_flattened().as_flattened().iter().copied())
    }

    /// The largest component divided by the scale, ∈ [0, 1]; zero when all terms are.
    #[must_use]
    pub fn relative(&self) -> T {
        piola_fields::Residual { value: self.largest(), scale: self.scale }.relative()
    }

    /// The components in coordinates q, given ∂X/∂q: `Y^c_ab = ∂q^c/∂X^C ∂X^A/∂q^a ∂X^B/∂q^b Y^C_AB`.
    ///
    /// # Errors
    /// [`UniformityError::NotFinite`], [`UniformityError::OutOfBounds`] for a singular ∂X/∂q.
    pub fn transformed(&self, jacobian: &Matrix3<T>) -> Result<Self, UniformityError> {
        let (inverse, j) = (super::curvature::inverse_of(jacobian)?, rows_of(jacobian));
        let old = &self.components;
        let lower = third(|c, a, b| sum(|e| sum(|f| old[c][e][f] * j[e][a] * j[f][b])));
        let components = third(|c, a, b| sum(|e| inverse[c][e] * lower[e][a][b]));
        let size = |r: &[[T; 3]; 3]| crate::indices::largest(r.as_flattened().iter().copied());
        let scale = self.scale * size(&inverse) * size(&j) * size(&j);
        Ok(Self { components, scale })
    }

    /// Y as a second-order tensor: `½ ε^DAB Y^C_AB` in Cartesian components, `[(C, D)]`; the torsion vector through a plane with
    /// normal N is this times N.
    #[must_use]
    pub fn axial(&self) -> Matrix3<T> {
        let y = &self.components;
        from_rows(second(|c, d| y[c][(d + 1) % 3][(d + 2) % 3]))
    }

    /// `Y^C_AC`, the trace, 1/m.
    #[must_use]
    pub fn trace(&self) -> Vector3<T> {
        let y = &self.components;
        Vector3::from([0, 1, 2].map(|a: usize| sum(|c| y[c][a][c])))
    }
}
