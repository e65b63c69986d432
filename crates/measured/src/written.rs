//! Laws as they are written in JSON. They are read here, once for all crates: the code that reads all laws is large.

use piola_fluids::AnyFluid;
use piola_laws::rubber::AnyRubber;
use piola_solids::AnySolid;
use serde_json::{Error, Value};

/// A fluid with its name and its parameters.
///
/// # Errors
/// Names and parameters that are not those of a fluid.
pub fn written_fluid(value: Value) -> Result<AnyFluid, Error> {
    serde_json::from_value(value)
}

/// A solid with its name and its parameters.
///
/// # Errors
/// Names and parameters that are not those of a solid.
pub fn written_solid(value: Value) -> Result<AnyRubber, Error> {
    // The name decides whose parameters follow, so that a refusal tells what is wrong with them.
    let is_own = matches!(value["law"].as_str(), Some("rubber" | "extended_tube" | "hyperfoam"));
    if is_own { serde_json::from_value(value) } else { serde_json::from_value::<AnySolid>(value).map(AnyRubber::from) }
}
