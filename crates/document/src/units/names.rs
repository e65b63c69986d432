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
const VOLUME: Dimension = Dimension { length: 3, ..Dimension::NONE };
const VISCOSITY: Dimension = Dimension { length: -1, mass: 1, time: -1, angle: 0 };

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
    named("in", 0.0254, 1.0, Dimension::LENGTH, "inch, 25.4 mm"),
    named("ft", 0.3048, 1.0, Dimension::LENGTH, "foot, 12 in"),
    named("au", 149_597_870_700.0, 1.0, Dimension::LENGTH, "astronomical unit, 149 597 870 700 m"),
    named("L", 1.0, 1e3, VOLUME, "litre, 1 dm^3"),
    named("mL", 1.0, 1e6, VOLUME, "millilitre, 1 cm^3"),
    named("uL", 1.0, 1e9, VOLUME, "microlitre, 1 mm^3"),
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
    named("mN", 1.0, 1e3, FORCE, "millinewton"),
    named("uN", 1.0, 1e6, FORCE, "micronewton"),
    named("nN", 1.0, 1e9, FORCE, "nanonewton"),
    named("dyn", 1.0, 1e5, FORCE, "dyne, 10 uN"),
    named("gf", 9.806_65, 1e3, FORCE, "gram-force"),
    named("kgf", 9.806_65, 1.0, FORCE, "kilogram-force, 9.80665 N"),
    named("lbf", 4.448_221_615_260_5, 1.0, FORCE, "pound-force, 0.45359237 kgf"),
    named("mPa", 1.0, 1e3, PRESSURE, "millipascal"),
    named("Pa", 1.0, 1.0, PRESSURE, "pascal"),
    named("kPa", 1e3, 1.0, PRESSURE, "kilopascal"),
    named("MPa", 1e6, 1.0, PRESSURE, "megapascal"),
    named("GPa", 1e9, 1.0, PRESSURE, "gigapascal"),
    named("atm", 101_325.0, 1.0, PRESSURE, "standard atmosphere, 101 325 Pa"),
    named("psi", 4.448_221_615_260_5, 0.000_645_16, PRESSURE, "pound-force per square inch"),
    named("bar", 1e5, 1.0, PRESSURE, "bar, 100 kPa"),
    named("mbar", 1e2, 1.0, PRESSURE, "millibar, 100 Pa"),
    named("P", 1.0, 10.0, VISCOSITY, "poise, 0.1 Pa s"),
    named("cP", 1.0, 1e3, VISCOSITY, "centipoise, 1 mPa s"),
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
    ("µN", "uN"),
    ("μN", "uN"),
    ("µL", "uL"),
    ("μL", "uL"),
    ("µl", "uL"),
    ("μl", "uL"),
    ("ul", "uL"),
    ("ml", "mL"),
    ("l", "L"),
    ("litre", "L"),
    ("liter", "L"),
    ("inch", "in"),
    ("foot", "ft"),
    ("dyne", "dyn"),
    ("dynes", "dyn"),
    ("poise", "P"),
    ("centipoise", "cP"),
    ("cps", "cP"),
    ("PSI", "psi"),
    ("RPM", "rpm"),
];

/// The unit of a name.
pub(super) fn find(name: &str) -> Option<Unit> {
    let name = SYNONYMS.iter().find(|(synonym, _)| *synonym == name).map_or(name, |(_, standard)| standard);
    UNITS.iter().find(|unit| unit.name == name).map(|unit| unit.unit)
}

/// The known name that a wrong one misspells, when only one can be meant. A name that begins otherwise has another prefix, and
/// with it another magnitude: `hPa` is neither `kPa` nor `mPa`, and `MN` is not `mN`.
pub(super) fn nearest(name: &str) -> Option<&'static str> {
    let begins_alike = |unit: &&NamedUnit| match (unit.name.chars().next(), name.chars().next()) {
        (Some(a), Some(b)) => a == b || a.eq_ignore_ascii_case(&b) && !"mMnNpPuUgGtT".contains(a),
        _ => false,
    };
    let only = |is_near: &dyn Fn(&NamedUnit) -> bool| {
        let mut found = UNITS.iter().filter(begins_alike).filter(|unit| is_near(unit));
        found.next().filter(|_| found.next().is_none())
    };
    let spelled_alike = UNITS.iter().filter(|unit| unit.name.eq_ignore_ascii_case(name)).count();
    let by_case = only(&|unit| spelled_alike == 1 && unit.name.eq_ignore_ascii_case(name));
    let by_edit = || only(&|unit| 3 <= name.len() && strsim::damerau_levenshtein(unit.name, name) <= 1);
    by_case.or_else(|| if spelled_alike == 0 { by_edit() } else { None }).map(|unit| unit.name)
}
