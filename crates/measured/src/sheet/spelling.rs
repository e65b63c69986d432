//! The usual spellings of units.

use piola_document::units::{self, Dimension, UNITS, Unit};

/// The unit of a text in one of its usual spellings: `mPa.s`, `mPas`, `s-1`, `1/s`, `dyn/cm2`, `lbf/100 ft²`, `µNm`.
#[must_use]
pub fn spelled(text: &str) -> Option<Unit> {
    units::spelled(text).ok()
}

/// Why a text is no unit, in words.
pub(crate) fn unknown(text: &str) -> String {
    units::spelled(text).err().map_or_else(|| format!("`{text}` is another unit"), |error| error.to_string())
}

/// "Pa, kPa, MPa": units of a dimension, for a message.
pub(crate) fn units_of(dimension: Dimension) -> String {
    /// Products of names that people use.
    const PRODUCTS: [&str; 24] = [
        "dyn/cm^2",
        "lbf/100 ft^2",
        "N/mm^2",
        "kgf/cm^2",
        "Pa s",
        "mPa s",
        "N m",
        "mN m",
        "uN m",
        "dyn cm",
        "1/s",
        "1/min",
        "rad/s",
        "m^3/s",
        "mL/s",
        "mL/min",
        "mm^3/s",
        "L/min",
        "cm^3/s",
        "Pa/m",
        "kPa/m",
        "bar/m",
        "m^2/s",
        "mm^2/s",
    ];
    let named = UNITS.iter().filter(|unit| unit.unit.dimension == dimension).map(|unit| unit.name);
    let products = PRODUCTS.into_iter().filter(|text| spelled(text).is_some_and(|unit| unit.dimension == dimension));
    named.chain(products).collect::<Vec<_>>().join(", ")
}
