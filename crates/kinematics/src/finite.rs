//! Reading numbers that must be finite.

use nalgebra::Vector3;
use piola_numerics::Real;
use serde::de::{Deserialize, Deserializer, Error};

use crate::error::finite;

/// Reads a vector and refuses infinite and NaN components.
pub(crate) fn vector<'de, D: Deserializer<'de>, T: Real + Deserialize<'de>>(
    deserializer: D,
) -> Result<Vector3<T>, D::Error> {
    let vector = Vector3::<T>::deserialize(deserializer)?;
    finite("component", vector.as_slice()).map_err(D::Error::custom)?;
    Ok(vector)
}

/// Reads three numbers and refuses infinite and NaN ones.
pub(crate) fn triple<'de, D: Deserializer<'de>, T: Real + Deserialize<'de>>(
    deserializer: D,
) -> Result<[T; 3], D::Error> {
    let triple = <[T; 3]>::deserialize(deserializer)?;
    finite("component", &triple).map_err(D::Error::custom)?;
    Ok(triple)
}
