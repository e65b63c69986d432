//! A quantity, a vector and an expression are refused, or have finite numbers and are read again as what they were.

use piola_document::units::{Dimension, Quantity, VectorQuantity};
use piola_expression::Variable;
use piola_expression::text::{ExpressionNames, NameMeaning, parse};

/// Whether one of them is accepted.
pub(super) fn run(data: &[u8]) -> bool {
    let Ok(text) = core::str::from_utf8(data) else { return false };
    let mut accepted = false;
    if let Ok(quantity) = text.parse::<Quantity>() {
        accepted = true;
        assert!(quantity.number.is_finite());
        if let Ok(value) = quantity.to_si() {
            assert!(value.is_finite(), "{text}");
        }
        let unit = quantity.unit.as_ref().map_or("", |(_, unit)| unit.as_str());
        let again: Quantity = format!("{:e} {unit}", quantity.number).parse().unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(again.number.to_bits(), quantity.number.to_bits(), "{text}");
    }
    if let Ok(values) = text.parse::<VectorQuantity>().and_then(|vector| vector.to_si()) {
        accepted = true;
        assert!(values.iter().all(|value| value.is_finite()), "{text}");
    }
    let mut names = ExpressionNames::new(true);
    names.add("x", NameMeaning::Variable(Variable::Coordinate(0)), Dimension::LENGTH);
    names.add("k", NameMeaning::Number(4.0), Dimension::NONE);
    names.add_rate("x", Variable::Conjugate(0), Dimension::LENGTH.over(Dimension::TIME));
    for expected in [Dimension::NONE, Dimension::FORCE] {
        if let Ok(expression) = parse(text, &names, expected) {
            accepted = true;
            // One pass over the nodes and one evaluation have the same value, or neither is a number.
            let value: f64 = expression.evaluate(&|_| 0.5);
            let found: f64 = piola_expression::ExpressionSlopes::of(&expression).differentiate(|_| 0.5, |_, _| ());
            let same = value.to_bits() == found.to_bits() || (value.is_nan() && found.is_nan());
            assert!(same, "{text}: {value:e} {found:e}");
        }
    }
    accepted
}
