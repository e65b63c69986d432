//! Numbers with units, as people write them in arguments.

use piola_document::units::{Dimension, Unit};
use piola_measured::internal::spelled;

/// Reads a number with its unit and converts it to SI. A pure number has no unit.
pub(crate) fn value(text: &str, dimension: Dimension) -> Option<f64> {
    let (number, unit) = parts(text)?;
    let unit = if unit.is_empty() { Unit::ONE } else { spelled(unit)? };
    (unit.dimension == dimension).then(|| unit.to_si(number)).filter(|x| x.is_finite())
}

/// A number, and the text after it.
pub(crate) fn parts(text: &str) -> Option<(f64, &str)> {
    let text = text.trim();
    let is_number = |end: usize| text.is_char_boundary(end) && text[..end].trim_end().parse::<f64>().is_ok();
    let end = (1..=text.len()).rev().find(|&end| is_number(end))?;
    Some((text[..end].trim_end().parse().ok()?, text[end..].trim()))
}
