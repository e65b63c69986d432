//! A connection in other coordinates.

use nalgebra::Vector3;
use piola_fields::Coordinates;
use piola_numerics::Real;
use piola_numerics::linear::matrix3::{from_rows, inverse_and_determinant};

use super::curvature::inverse_of;
use super::{AffineConnection, ConnectionCoefficients};
use crate::UniformityError;
use crate::indices::{second, sum, third, variables};

/// The same connection in coordinates q with X = X(q), W(27.18).
///
/// # Errors
/// [`UniformityError::OutOfBounds`] where ∂X/∂q is singular, and what coordinates and connection refuse.
///
/// # Example
/// Euclid's connection in cylindrical coordinates: `Γ^r_θθ = −r`.
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use piola_fields::Cylindrical;
/// use piola_uniformity::{AffineConnection, ConnectionIn, ConstantMap, MaterialConnection};
/// let euclid = MaterialConnection::of_crystal(ConstantMap(Matrix3::identity()));
/// let polar = ConnectionIn { connection: euclid, coordinates: Cylindrical };
/// let gamma = polar.coefficients(&Vector3::new(2.0, 0.5, 0.0))?.components;
/// assert!((gamma[0][1][1] + 2.0_f64).abs() < 1e-15);
/// # Ok::<(), piola_uniformity::UniformityError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ConnectionIn<C, Q> {
    /// Γ in the coordinates X.
    pub connection: C,
    /// X(q).
    pub coordinates: Q,
}

impl<C: AffineConnection, Q: Coordinates> AffineConnection for ConnectionIn<C, Q> {
    fn at<T: Real>(&self, place: &Vector3<T>) -> ConnectionCoefficients<T> {
        let x = self.coordinates.place(&variables(&variables(place)));
        let jacobian = second(|i, j| x[i].partials[j].value);
        let inverse = inverse_and_determinant(jacobian).0;
        let gamma = self.connection.at(&x.map(|x| x.value.value)).components;
        let inner = third(|c, a, b| {
            let carried = sum(|e| sum(|f| gamma[c][e][f] * jacobian[e][a] * jacobian[f][b]));
            carried + x[c].partials[a].partials[b]
        });
        ConnectionCoefficients { components: third(|c, a, b| sum(|e| inverse[c][e] * inner[e][a][b])) }
    }

    fn check_domain<T: Real>(&self, place: &Vector3<T>) -> Result<(), UniformityError> {
        self.coordinates.check_domain(place)?;
        let x = self.coordinates.place(&variables(place));
        inverse_of(&from_rows(second(|i, j| x[i].partials[j])))?;
        self.connection.check_domain(&x.map(|x| x.value))
    }
}
