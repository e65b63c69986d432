//! Cylindrical coordinates.

use nalgebra::Vector3;
use piola_numerics::Real;
use piola_tensor::internal::rows::Rows;

use super::{Coordinates, check_radius};
use crate::FieldsError;
use crate::residual::Residual;

/// Cylindrical coordinates r, θ, z: x = (r cos θ, r sin θ, z), 0 < r.
///
/// ```text
/// (div T)_r = ∂T_rr/∂r + (1/r) ∂T_rθ/∂θ + ∂T_rz/∂z + (T_rr − T_θθ)/r
/// (div T)_θ = ∂T_θr/∂r + (1/r) ∂T_θθ/∂θ + ∂T_θz/∂z + (T_rθ + T_θr)/r        W(23.56)
/// (div T)_z = ∂T_zr/∂r + (1/r) ∂T_zθ/∂θ + ∂T_zz/∂z + T_zr/r
/// ```
///
/// On the axis r = 0 there is no basis: [`FieldsError::SingularCoordinates`]; use [`Cartesian`](super::Cartesian)
/// there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Cylindrical;

impl Coordinates for Cylindrical {
    #[inline]
    fn place<T: Real>(&self, coordinates: &Vector3<T>) -> Vector3<T> {
        let (sin, cos) = coordinates[1].sin_cos();
        Vector3::new(coordinates[0] * cos, coordinates[0] * sin, coordinates[2])
    }

    #[inline]
    fn check_domain<T: Real>(&self, coordinates: &Vector3<T>) -> Result<(), FieldsError> {
        check_radius(coordinates, coordinates[0])
    }

    #[inline]
    fn scale_factors<T: Real>(&self, coordinates: &Vector3<T>) -> Result<[T; 3], FieldsError> {
        self.check_domain(coordinates)?;
        Ok([T::one(), coordinates[0], T::one()])
    }

    #[inline]
    fn divergence_terms<T: Real>(
        &self,
        coordinates: &Vector3<T>,
        tensor: &Rows<T>,
        partials: &[Rows<T>; 3],
    ) -> Result<[Residual<T>; 3], FieldsError> {
        self.check_domain(coordinates)?;
        let r = coordinates[0];
        let ([dr, dtheta, dz], t) = (partials, tensor);
        let common = |i: usize| Residual::zero().plus(dr[i][0]).plus(dtheta[i][1] / r).plus(dz[i][2]).plus(t[i][0] / r);
        Ok([common(0).plus(-(t[1][1] / r)), common(1).plus(t[0][1] / r), common(2)])
    }

    #[inline]
    fn gradient_from_partials<T: Real>(
        &self,
        coordinates: &Vector3<T>,
        vector: &[T; 3],
        partials: &[[T; 3]; 3],
    ) -> Result<Rows<T>, FieldsError> {
        self.check_domain(coordinates)?;
        let r = coordinates[0];
        let ([dr, dtheta, dz], v) = (partials, vector);
        Ok([
            [dr[0], (dtheta[0] - v[1]) / r, dz[0]],
            [dr[1], (dtheta[1] + v[0]) / r, dz[1]],
            [dr[2], dtheta[2] / r, dz[2]],
        ])
    }
}
