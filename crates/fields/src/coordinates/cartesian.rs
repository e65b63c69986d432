//! Cartesian coordinates.

use nalgebra::Vector3;
use piola_numerics::Real;
use piola_tensor::internal::rows::{Rows, transpose};

use super::Coordinates;
use crate::FieldsError;
use crate::error::check_finite;
use crate::residual::Residual;

/// Cartesian coordinates x, y, z.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Cartesian;

impl Coordinates for Cartesian {
    #[inline]
    fn place<T: Real>(&self, coordinates: &Vector3<T>) -> Vector3<T> {
        *coordinates
    }

    #[inline]
    fn scale_factors<T: Real>(&self, coordinates: &Vector3<T>) -> Result<[T; 3], FieldsError> {
        check_finite("coordinates", coordinates.as_slice())?;
        Ok([T::one(); 3])
    }

    /// (div T)ᵢ = ∂Tᵢⱼ/∂xⱼ, W(17.12).
    #[inline]
    fn divergence_terms<T: Real>(
        &self,
        coordinates: &Vector3<T>,
        _tensor: &Rows<T>,
        partials: &[Rows<T>; 3],
    ) -> Result<[Residual<T>; 3], FieldsError> {
        check_finite("coordinates", coordinates.as_slice())?;
        let [x, y, z] = partials;
        Ok([0, 1, 2].map(|i: usize| Residual::zero().plus(x[i][0]).plus(y[i][1]).plus(z[i][2])))
    }

    #[inline]
    fn gradient_from_partials<T: Real>(
        &self,
        coordinates: &Vector3<T>,
        _vector: &[T; 3],
        partials: &[[T; 3]; 3],
    ) -> Result<Rows<T>, FieldsError> {
        check_finite("coordinates", coordinates.as_slice())?;
        Ok(transpose(*partials))
    }
}
