//! Numbers of a checked document that are replaced: those of settings, to the last bit.

use piola_document::schema::{Absent, Kind, Range};
use piola_document::units::Dimension;
use piola_document::{Document, Record, table};

table! {
    /// A wheel.
    static WHEEL = "wheel" {
        /// Its name.
        name: Kind::Name, Absent::Required;
        /// How wide it is.
        width: Kind::Quantity(Dimension::LENGTH, Range::Positive), Absent::Default("\"20 cm\"");
        /// Where it is.
        place: Kind::Numbers(Dimension::LENGTH, &[3]), Absent::Required;
        /// Its spokes.
        spokes: Kind::Count { least: 3, most: 40 }, Absent::Default("8");
    }
}

table! {
    /// A cart.
    static CART = "cart" {
        /// Its wheels.
        wheel: Kind::Tables(&WHEEL), Absent::Optional;
        /// Numbers with names.
        parameters: Kind::Parameters, Absent::Optional;
    }
}

const TEXT: &str = "
[parameters]
load = '2 kg'
[[wheel]]
name = 'left'
place = [0, 0.1, 0.2]
[[wheel]]
name = 'right'
place = '[0, 1, 2] cm'
width = '1 ft'
";

fn cart(settings: &[String]) -> Document {
    let mut document = Document::parse("cart.toml", TEXT);
    for setting in settings {
        document.set(setting);
    }
    document
}

/// All numbers of a cart, by their bits.
fn bits(record: &Record) -> Vec<u64> {
    let wheels = record
        .records("wheel")
        .iter()
        .flat_map(|wheel| wheel.numbers("place").into_iter().flatten().copied().chain(wheel.number("width")));
    let parameters = record.parameters("parameters").iter().map(|parameter| parameter.value);
    wheels.chain(parameters).map(f64::to_bits).collect()
}

#[test]
fn replaced_numbers_are_those_of_settings() {
    let paths =
        [("wheel.right.width", "ft"), ("wheel[0].place[1]", "cm"), ("parameters.load", "g"), ("wheel.left.width", "")];
    let setting = |numbers: &[f64]| -> Vec<String> {
        paths.iter().zip(numbers).map(|((path, unit), x)| format!("{path}={x:?} {unit}")).collect()
    };
    let varied = cart(&setting(&[1.0; 4])).varied(&CART, &paths).unwrap_or_else(|| panic!("numbers"));
    for numbers in [[0.1, -0.0, 1e-9, 3.0], [1e16, 0.3, -2.5e300, 0.7], [7.0, 1.0 / 3.0, 0.0, 1e-300]] {
        let (expected, mistakes) = cart(&setting(&numbers)).records(&CART);
        assert!(mistakes.is_empty());
        let found = varied.record(&numbers).unwrap_or_else(|| panic!("{numbers:?}"));
        assert_eq!(bits(&found), bits(&expected), "{numbers:?}");
    }
    // Out of its range, lost in its unit, not finite, not of this number.
    for wrong in [[-1.0, 0.0, 0.0, 1.0], [1.0, f64::NAN, 0.0, 1.0], [1.0, 0.0, 1.0, 0.0], [1.0, 5e-324, 1.0, 1.0]] {
        assert!(varied.record(&wrong).is_none(), "{wrong:?}");
    }
    assert!(varied.record(&[1.0; 3]).is_none());
}

/// A path to a name, a count, a key that is not written or a unit of another dimension varies nothing, nor does a document with mistakes.
#[test]
fn what_is_no_quantity_is_not_replaced() {
    let base = || cart(&[]);
    for (path, unit) in [
        ("wheel.left.width", "m"),
        ("wheel.left.spokes", ""),
        ("wheel.left.name", ""),
        ("wheel.left", ""),
        ("wheel.third.width", "m"),
        ("wheel.right.width", "kg"),
        ("wheel[0].place", "m"),
        ("wheel[0].place[3]", "m"),
        ("parameters.load", "m"),
        ("parameters.none", "kg"),
        ("wheel.right.width.more", "m"),
        ("wheel.right.width", "no unit"),
    ] {
        assert!(base().varied(&CART, &[(path, unit)]).is_none(), "{path} in {unit}");
    }
    assert!(base().varied(&CART, &[("wheel.right.width", "m")]).is_some());
    assert!(cart(&["wheel.left.colour=3".to_owned()]).varied(&CART, &[("wheel.right.width", "m")]).is_none());
}
