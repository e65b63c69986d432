//! What is read of results is finite.

use serde::de::Error;
use serde::{Deserialize, Deserializer};

use crate::error::check_finite;
use crate::integrand::Integrand;

/// Reads a value and refuses it when a component is infinite or NaN.
pub(super) fn finite<'de, D: Deserializer<'de>, V: Integrand + Deserialize<'de>>(source: D) -> Result<V, D::Error> {
    let value = V::deserialize(source)?;
    check_finite("component", value.components()).map_err(D::Error::custom)?;
    Ok(value)
}
