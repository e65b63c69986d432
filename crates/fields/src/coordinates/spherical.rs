//! Spherical coordinates.

use nalgebra::Vector3;
use piola_numerics::Real;
use piola_tensor::internal::rows::Rows;

use super::{Coordinates, check_radius};
use crate::FieldsError;
use crate::residual::Residual;

/// Spherical coordinates r, θ, φ with θ the *azimuth* and φ the *colatitude*:
/// x = (r sin φ cos θ, r sin φ sin θ, r cos φ), 0 < r, 0 < φ < π.
///
/// In this order the basis is left-handed.
///
/// ```text
/// (div T)_r = ∂T_rr/∂r + ∂T_rθ/∂θ/(r sin φ) + ∂T_rφ/∂φ/r + (2 T_rr − T_θθ − T_φφ + T_rφ cot φ)/r
/// (div T)_θ = ∂T_θr/∂r + ∂T_θθ/∂θ/(r sin φ) + ∂T_θφ/∂φ/r + (T_rθ + 2 T_θr + (T_φθ + T_θφ) cot φ)/r      W(25.10)
/// (div T)_φ = ∂T_φr/∂r + ∂T_φθ/∂θ/(r sin φ) + ∂T_φφ/∂φ/r + (T_rφ + 2 T_φr + (T_φφ − T_θθ) cot φ)/r
/// ```
///
/// At the centre and the poles there is no basis: [`FieldsError::SingularCoordinates`]; use
/// [`Cartesian`](super::Cartesian) there. φ = π in double precision is not the pole (sin φ = 1.2e−16): it is
/// accepted, and 1/sin φ magnifies what the field has there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Spherical;

impl Coordinates for Spherical {
    #[inline]
    fn place<T: Real>(&self, coordinates: &Vector3<T>) -> Vector3<T> {
        let ((sin_theta, cos_theta), (sin_phi, cos_phi)) = (coordinates[1].sin_cos(), coordinates[2].sin_cos());
        let radius = coordinates[0] * sin_phi;
        Vector3::new(radius * cos_theta, radius * sin_theta, coordinates[0] * cos_phi)
    }

    #[inline]
    fn check_domain<T: Real>(&self, coordinates: &Vector3<T>) -> Result<(), FieldsError> {
        check_radius(coordinates, coordinates[0])?;
        check_radius(coordinates, coordinates[0] * coordinates[2].sin())
    }

    #[inline]
    fn scale_factors<T: Real>(&self, coordinates: &Vector3<T>) -> Result<[T; 3], FieldsError> {
        let (r, s, _) = radii(coordinates)?;
        Ok([T::one(), s, r])
    }

    #[inline]
    fn divergence_terms<T: Real>(
        &self,
        coordinates: &Vector3<T>,
        tensor: &Rows<T>,
        partials: &[Rows<T>; 3],
    ) -> Result<[Residual<T>; 3], FieldsError> {
        let (r, s, cotangent) = radii(coordinates)?;
        let ([dr, dtheta, dphi], t) = (partials, tensor);
        let two = T::lit(2.0);
        let common = |i: usize| {
            let slopes = Residual::zero().plus(dr[i][0]).plus(dtheta[i][1] / s).plus(dphi[i][2] / r);
            slopes.plus(two * t[i][0] / r).plus(t[i][2] * cotangent)
        };
        Ok([
            common(0).plus(-(t[1][1] / r)).plus(-(t[2][2] / r)),
            common(1).plus(t[0][1] / r).plus(t[2][1] * cotangent),
            common(2).plus(t[0][2] / r).plus(-(t[1][1] * cotangent)),
        ])
    }

    #[inline]
    fn gradient_from_partials<T: Real>(
        &self,
        coordinates: &Vector3<T>,
        vector: &[T; 3],
        partials: &[[T; 3]; 3],
    ) -> Result<Rows<T>, FieldsError> {
        let (r, s, cotangent) = radii(coordinates)?;
        let ([dr, dtheta, dphi], v) = (partials, vector);
        Ok([
            [dr[0], dtheta[0] / s - v[1] / r, (dphi[0] - v[2]) / r],
            [dr[1], dtheta[1] / s + v[0] / r + v[2] * cotangent, dphi[1] / r],
            [dr[2], dtheta[2] / s - v[1] * cotangent, (dphi[2] + v[0]) / r],
        ])
    }
}

/// (r, r sin φ, cot φ/r).
#[inline]
fn radii<T: Real>(coordinates: &Vector3<T>) -> Result<(T, T, T), FieldsError> {
    let r = coordinates[0];
    let (sin, cos) = coordinates[2].sin_cos();
    check_radius(coordinates, r)?;
    check_radius(coordinates, r * sin)?;
    Ok((r, r * sin, cos / (r * sin)))
}
