//! The units that a document may name.

use super::{Dimension, Unit};

/// A unit with its name.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NamedUnit {
    /// The name as written in a document.
    pub name: &'static str,
    /// Factor and dimension.
    pub unit: Unit,
    /// Description.
    pub doc: &'static str,
}

const FORCE: Dimension = Dimension { mass: 1, ..Dimension::ACCELERATION };
const PRESSURE: Dimension = Dimension { length: -1, mass: 1, time: -2, angle: 0 };
const ENERGY: Dimension = Dimension { length: 2, ..FORCE };
const POWER: Dimension = Dimension { time: -3, ..ENERGY };

/// `numerator/denominator` SI units of a dimension under a name.
const fn named(
    name: &'static str,
    numerator: f64,
    denominator: f64,
    dimension: Dimension,
    doc: &'static str,
) -> NamedUnit {
    NamedUnit { name, unit: Unit { numerator, denominator, dimension }, doc }
}

/// Every unit that can be named, in the order in which they are documented.
///
/// The astronomical unit is the IAU's of 2012, the year is Julian.
pub const UNITS: &[NamedUnit] = &[
    named("m", 1.0, 1.0, Dimension::LENGTH, "metre"),
    named("km", 1e3, 1.0, Dimension::LENGTH, "kilometre"),
    named("cm", 1.0, 1e2, Dimension::LENGTH, "centimetre"),
    named("mm", 1.0, 1e3, Dimension::LENGTH, "millimetre"),
    named("um", 1.0, 1e6, Dimension::LENGTH, "micrometre"),
    named("au", 149_597_870_700.0, 1.0, Dimension::LENGTH, "astronomical unit, 149 597 870 700 m"),
    named("kg", 1.0, 1.0, Dimension::MASS, "kilogram"),
    named("g", 1.0, 1e3, Dimension::MASS, "gram"),
    named("t", 1e3, 1.0, Dimension::MASS, "tonne, 1000 kg"),
    named("s", 1.0, 1.0, Dimension::TIME, "second"),
    named("ms", 1.0, 1e3, Dimension::TIME, "millisecond"),
    named("us", 1.0, 1e6, Dimension::TIME, "microsecond"),
    named("min", 60.0, 1.0, Dimension::TIME, "minute"),
    named("h", 3600.0, 1.0, Dimension::TIME, "hour"),
    named("d", 86_400.0, 1.0, Dimension::TIME, "day, 86 400 s"),
    named("yr", 31_557_600.0, 1.0, Dimension::TIME, "Julian year, 365.25 d"),
    named("rad", 1.0, 1.0, Dimension::ANGLE, "radian"),
    named("mrad", 1.0, 1e3, Dimension::ANGLE, "milliradian"),
    named("deg", core::f64::consts::PI, 180.0, Dimension::ANGLE, "degree, π/180 rad"),
    named("arcmin", core::f64::consts::PI, 10_800.0, Dimension::ANGLE, "minute of arc"),
    named("arcsec", core::f64::consts::PI, 648_000.0, Dimension::ANGLE, "second of arc"),
    named("rev", core::f64::consts::TAU, 1.0, Dimension::ANGLE, "revolution, 2π rad"),
    named("rpm", core::f64::consts::TAU, 60.0, Dimension::ANGULAR_RATE, "revolutions per minute"),
    named("Hz", 1.0, 1.0, Dimension { time: -1, ..Dimension::NONE }, "hertz, 1/s"),
    named("N", 1.0, 1.0, FORCE, "newton"),
    named("kN", 1e3, 1.0, FORCE, "kilonewton"),
    named("Pa", 1.0, 1.0, PRESSURE, "pascal"),
    named("kPa", 1e3, 1.0, PRESSURE, "kilopascal"),
    named("MPa", 1e6, 1.0, PRESSURE, "megapascal"),
    named("bar", 1e5, 1.0, PRESSURE, "bar, 100 kPa"),
    named("J", 1.0, 1.0, ENERGY, "joule"),
    named("kJ", 1e3, 1.0, ENERGY, "kilojoule"),
    named("W", 1.0, 1.0, POWER, "watt"),
    named("kW", 1e3, 1.0, POWER, "kilowatt"),
];

/// Other words for the same units, accepted but not advertised.
const SYNONYMS: &[(&str, &str)] = &[
    ("metre", "m"),
    ("meter", "m"),
    ("sec", "s"),
    ("second", "s"),
    ("seconds", "s"),
    ("minute", "min"),
    ("minutes", "min"),
    ("hour", "h"),
    ("hours", "h"),
    ("hr", "h"),
    ("day", "d"),
    ("days", "d"),
    ("year", "yr"),
    ("years", "yr"),
    ("degree", "deg"),
    ("degrees", "deg"),
    ("°", "deg"),
    ("radian", "rad"),
    ("radians", "rad"),
    ("µm", "um"),
    ("μm", "um"),
    ("µs", "us"),
    ("μs", "us"),
    ("AU", "au"),
];

/// The unit of a name.
pub(super) fn find(name: &str) -> Option<Unit> {
    let name = SYNONYMS.iter().find(|(synonym, _)| *synonym == name).map_or(name, |(_, standard)| standard);
    UNITS.iter().find(|unit| unit.name == name).map(|unit| unit.unit)
}

/// The known name closest to a wrong one, when it differs by one letter's case or by a small edit.
pub(super) fn nearest(name: &str) -> Option<&'static str> {
    let by_case = UNITS.iter().find(|unit| unit.name.eq_ignore_ascii_case(name));
    let by_edit = || UNITS.iter().find(|unit| 3 <= name.len() && strsim::damerau_levenshtein(unit.name, name) <= 1);
    by_case.or_else(by_edit).map(|unit| unit.name)
}
