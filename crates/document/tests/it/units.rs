//! Quantities: values, dimensions, and texts that are none.

use piola_document::units::{Dimension, Quantity, UNITS, Unit, UnitError, VectorQuantity};
use piola_testkit::{Tol, assert_close};
use proptest::prelude::*;

fn si(text: &str) -> (f64, Option<Dimension>) {
    let quantity: Quantity = text.parse().unwrap_or_else(|error| panic!("{text}: {error}"));
    (quantity.to_si().unwrap_or_else(|error| panic!("{text}: {error}")), quantity.dimension())
}

fn refused(text: &str) -> UnitError {
    match text.parse::<Quantity>() {
        Err(error) => error,
        Ok(quantity) => panic!("{text} is read as {quantity:?}"),
    }
}

#[test]
fn values_in_si_equal_hand_conversions() {
    let cases = [
        ("9.81 m/s^2", 9.81, Dimension::ACCELERATION),
        ("3650 d", 315_360_000.0, Dimension::TIME),
        ("398600.4418 km^3/s^2", 3.986_004_418e14, Dimension::GRAVITATIONAL_PARAMETER),
        ("36 km/h", 10.0, Dimension::SPEED),
        ("180 deg", core::f64::consts::PI, Dimension::ANGLE),
        ("60 rpm", core::f64::consts::TAU, Dimension::ANGULAR_RATE),
        ("1 au", 149_597_870_700.0, Dimension::LENGTH),
        ("2.5 kg m²", 2.5, Dimension::INERTIA),
        ("2.5 kg*m^2", 2.5, Dimension::INERTIA),
        ("1 kg m/(s^2)", 1.0, Dimension { mass: 1, ..Dimension::ACCELERATION }),
        ("-1.5e-3 m", -1.5e-3, Dimension::LENGTH),
        ("1_000 g", 1.0, Dimension::MASS),
        ("4 s⁻¹", 4.0, Dimension { time: -1, ..Dimension::NONE }),
        ("4 1/s", 4.0, Dimension { time: -1, ..Dimension::NONE }),
        ("5 J/(kg m)", 5.0, Dimension::ACCELERATION),
        ("3 kN km", 3e6, Dimension::MOMENT),
        ("2 t km^2", 2e9, Dimension::INERTIA),
        ("4 g cm²", 4e-7, Dimension::INERTIA),
        ("1 kN/km^2", 1e-3, Dimension::PRESSURE),
    ];
    for (text, value, dimension) in cases {
        let (found, unit) = si(text);
        assert_eq!(unit, Some(dimension), "{text}");
        assert_close(text, &[found], &[value], Tol::ulps(2.0));
    }
}

#[test]
fn exact_conversions_have_no_rounding() {
    let exact = |text: &str, value: f64| assert_eq!(si(text).0.to_bits(), value.to_bits(), "{text}");
    exact("36 km/h", 10.0);
    exact("3 mm", 0.003);
    exact("0.1 km", 100.0);
    exact("1.327124400409446e+20 m^3/s^2", 1.327_124_400_409_446e20);
}

#[test]
fn texts_that_are_no_quantities_are_told_apart() {
    assert!(matches!(refused("m"), UnitError::NoNumber { .. }));
    assert!(matches!(refused(""), UnitError::NoNumber { .. }));
    assert!(matches!(refused("- m"), UnitError::NoNumber { .. }));
    assert!(matches!(refused("nan m"), UnitError::NotFinite { .. }));
    assert!(matches!(refused("1e400 m"), UnitError::NotFinite { .. }));
    assert_eq!(refused("inf m"), UnitError::NotFinite { number: f64::INFINITY });
    assert_eq!(refused("-inf m"), UnitError::NotFinite { number: f64::NEG_INFINITY });
    assert!(matches!(refused("1 parsec"), UnitError::UnknownUnit { .. }));
    assert!(matches!(refused("1 J/kg K"), UnitError::AmbiguousDivision { .. } | UnitError::UnknownUnit { .. }));
    assert!(matches!(refused("1 J/kg m"), UnitError::AmbiguousDivision { .. }));
    assert!(matches!(refused("1 m^"), UnitError::BadExponent { .. }));
    assert!(matches!(refused("1 m^100"), UnitError::BadExponent { .. }));
    assert!(matches!(refused("1 J/(kg m"), UnitError::UnmatchedBracket { .. }));
    assert!(matches!(refused("1 kg)"), UnitError::UnmatchedBracket { .. }));
    assert!(matches!(refused("1 m!"), UnitError::UnexpectedText { .. }));
    assert!(matches!(refused("1 m/"), UnitError::UnexpectedText { .. }));
    assert!("1e300 km^3".parse::<Quantity>().is_ok_and(|quantity| quantity.to_si().is_err()));
    assert!("[1, 2 m".parse::<VectorQuantity>().is_err());
    assert!("[1, , 2] m".parse::<VectorQuantity>().is_err());
}

#[test]
fn an_exponent_has_digits_or_its_letter_begins_a_unit() {
    // What follows the number is read as a unit: none is named `e` or `E`.
    for (text, unit) in [("3 e5", "e"), ("3e m", "e"), ("3e-m", "e"), ("3E+ m", "E"), ("3.5e- 2", "e")] {
        assert!(matches!(refused(text), UnitError::UnknownUnit { name, .. } if name == unit), "{text}");
    }
    for (text, value) in [("3e2 m", 300.0), ("3E+2 m", 300.0), ("25e-1 m", 2.5), ("2.5 m", 2.5), (".5e1m", 5.0)] {
        assert_eq!(si(text), (value, Some(Dimension::LENGTH)), "{text}");
    }
}

#[test]
fn a_hint_never_names_a_unit_of_another_magnitude() {
    let hint = |text: &str| match refused(&format!("1 {text}")) {
        UnitError::UnknownUnit { nearest, .. } => nearest,
        error => panic!("{text}: {error}"),
    };
    for (wrong, right) in [("KM", "km"), ("arcmn", "arcmin"), ("kpa", "kPa")] {
        assert_eq!(hint(wrong), Some(right), "{wrong}");
    }
    for wrong in ["hPa", "mpa", "MN", "NN", "MW", "pPa", "dPa", "Mm"] {
        assert_eq!(hint(wrong), None, "{wrong}");
    }
    for unit in ["mPa", "mN", "uN", "L", "mL", "dyn", "P", "cP", "psi", "ft", "lbf", "gf", "atm"] {
        assert!(unit.parse::<Unit>().is_ok(), "{unit}");
    }
}

#[test]
fn brackets_of_a_unit_are_counted_up_and_down() {
    let nested = |depth: usize| format!("1 {}m{}", "(".repeat(depth), ")".repeat(depth));
    assert_eq!(si(&nested(8)), (1.0, Some(Dimension::LENGTH)));
    assert!(matches!(refused(&nested(9)), UnitError::UnexpectedText { .. }));
    // Many beside each other are no deeper than one.
    let beside = format!("1 {}", ["(m)"; 20].join(" "));
    assert_eq!(si(&beside), (1.0, Some(Dimension::LENGTH.power(20))));
}

#[test]
fn every_unit_is_read_back_and_every_dimension_is_written_as_a_unit() {
    for named in UNITS {
        let unit: Unit = named.name.parse().unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(unit, named.unit);
        let written: Unit = named.unit.dimension.si_unit().parse().unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(written.dimension, named.unit.dimension);
    }
}

#[test]
fn dimensions_are_written_with_their_powers_above_and_below_the_line() {
    let dimension = |length, mass, time, angle| Dimension { length, mass, time, angle };
    let cases = [
        (dimension(0, 0, 0, 0), "", "a pure number"),
        (dimension(2, 0, 0, 0), "m^2", "length^2"),
        (dimension(2, 1, 0, 0), "kg m^2", "mass length^2"),
        (dimension(3, 0, -2, 0), "m^3/s^2", "length^3/time^2"),
        (dimension(0, 0, -1, 0), "1/s", "1/time"),
        (dimension(-3, 0, -2, 0), "1/(m^3 s^2)", "1/(length^3 time^2)"),
        (dimension(-3, 1, 0, 0), "kg/m^3", "mass/length^3"),
        (dimension(2, 1, -2, -1), "kg m^2/(rad s^2)", "mass length^2/(angle time^2)"),
        (dimension(-1, 1, -2, 0), "Pa", "mass/(length time^2)"),
    ];
    for (dimension, unit, words) in cases {
        assert_eq!((dimension.si_unit().as_str(), dimension.to_string().as_str()), (unit, words));
    }
}

proptest! {
    #[test]
    fn any_text_is_read_or_refused_without_panic(text in "\\PC{0,40}") {
        match text.parse::<Quantity>() {
            Ok(quantity) => prop_assert!(quantity.number.is_finite() && text.contains(|c: char| c.is_ascii_digit())),
            Err(error) => prop_assert!(!error.to_string().is_empty()),
        }
        match text.parse::<VectorQuantity>() {
            Ok(vector) => prop_assert!(!vector.numbers.is_empty() && vector.numbers.iter().all(|x| x.is_finite())),
            Err(error) => prop_assert!(!error.to_string().is_empty()),
        }
        match text.parse::<Unit>() {
            Ok(unit) => prop_assert!(0.0 < unit.numerator && 0.0 < unit.denominator),
            Err(error) => prop_assert!(!error.to_string().is_empty()),
        }
    }

    #[test]
    fn number_in_metres_equals_plain_number(x in -1e300_f64..1e300) {
        let text = format!("{x:?} m");
        prop_assert_eq!(si(&text).0.to_bits(), x.to_bits());
    }

    #[test]
    fn dimension_of_product_equals_sum_of_exponents(a in 0..UNITS.len(), b in 0..UNITS.len(), n in -3_i16..4) {
        let text = format!("{} {}^{n}", UNITS[a].name, UNITS[b].name);
        let unit: Unit = text.parse().unwrap_or_else(|error| panic!("{text}: {error}"));
        prop_assert_eq!(unit.dimension, UNITS[a].unit.dimension.times(UNITS[b].unit.dimension.power(n)));
    }
}

#[test]
fn powers_of_powers_are_refused_before_they_overflow() {
    for text in ["((m^99)^99)^99", "(m^50 s)^2", "m^60 m^60", "kg^-99/kg", "1/(s^99 s)", "((m^-99)^99)^-99 · kg"] {
        let refused = text.parse::<Unit>();
        assert_eq!(refused, Err(UnitError::DimensionTooLarge { found: text.to_owned() }), "{text}");
    }
    assert_eq!("(m^33)^3".parse::<Unit>().map(|unit| unit.dimension.length), Ok(99));
    // In code exponents stop at those of the type.
    let most = Dimension::LENGTH.power(i16::MAX);
    assert_eq!(most.times(Dimension::LENGTH), most);
    assert_eq!(most.power(-2).length, i16::MIN);
}
