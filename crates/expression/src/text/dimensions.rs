//! Dimensions of the parts of an expression.

use piola_document::units::Dimension;

use super::ExpressionMistake;

/// Angles count as pure numbers: a torque times an angle is an energy.
pub(super) fn plain(dimension: Dimension) -> Dimension {
    Dimension { angle: 0, ..dimension }
}

/// A dimension in words.
pub(super) fn words(dimension: Dimension) -> String {
    if dimension == Dimension::NONE { "a pure number".to_string() } else { format!("{dimension}") }
}

/// An error unless the dimension is that of a pure number.
pub(super) fn pure(what: &str, dimension: Dimension) -> Result<(), ExpressionMistake> {
    if dimension == Dimension::NONE {
        return Ok(());
    }
    Err(ExpressionMistake::new(
        format!("{what} has the dimension {dimension}"),
        "a pure number: divide by a quantity of the same dimension",
    ))
}

/// The dimension of `base` to the power `exponent`; none if it is no whole power of metre, kilogram and second.
pub(super) fn power(base: Dimension, exponent: f64) -> Option<Dimension> {
    let of = |exponents: i16| {
        let exponent = f64::from(exponents) * exponent;
        #[expect(clippy::cast_possible_truncation, reason = "a whole number of at most four digits")]
        let whole = exponent.round() as i16;
        ((exponent - f64::from(whole)).abs() < 1e-9 && exponent.abs() < 1000.0).then_some(whole)
    };
    Some(Dimension { length: of(base.length)?, mass: of(base.mass)?, time: of(base.time)?, angle: of(base.angle)? })
}
