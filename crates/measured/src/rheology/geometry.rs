//! The geometry of an instrument, from the arguments and from what a file says of it.

use piola_document::units::{Dimension, Quantity};
use piola_viscometry::recover::ConeGeometry;

use super::kind::{Flow, FlowKind};
use super::oilfield::{Bob, Rotor, Spring};
use crate::fitting::TableMistake;
use crate::sheet::{Setting, Sheet, spelled};

/// Words for a size, in small letters, each with its share: a radius is half a diameter.
const WORDS: [(&str, &[&str], f64); 14] = [
    ("radius", &["radius", "r", "plate radius", "cone radius", "pipe radius", "capillary radius", "die radius"], 1.0),
    ("radius", &["diameter", "plate diameter", "cone diameter", "pipe diameter", "capillary diameter"], 0.5),
    ("radius", &["die diameter"], 0.5),
    ("length", &["length", "capillary length", "pipe length", "die length"], 1.0),
    ("half_width", &["half width", "half height"], 1.0),
    ("half_width", &["slit height", "channel height"], 0.5),
    ("inner_radius", &["inner radius", "bob radius", "ri", "r1"], 1.0),
    ("inner_radius", &["inner diameter", "bob diameter"], 0.5),
    ("outer_radius", &["outer radius", "cup radius", "rotor radius", "ro", "r2"], 1.0),
    ("outer_radius", &["outer diameter", "cup diameter"], 0.5),
    ("gap", &["gap", "gap size", "plate gap", "measuring gap", "gap width"], 1.0),
    ("angle", &["angle", "cone angle"], 1.0),
    ("height", &["height", "bob height", "bob length", "effective height", "immersed height"], 1.0),
    ("spring", &["spring", "torsion spring"], 1.0),
];

/// The share of a size that a key says; none for another key.
fn share(name: &str, key: &str) -> Option<f64> {
    let of = |words: &&(&str, &[&str], f64)| words.0 == name && words.1.contains(&key);
    WORDS.iter().find(of).map(|(_, _, share)| *share)
}

/// Lengths, m, that a rheometer may have: powers of others leave the range of doubles.
const LENGTHS: [f64; 2] = [1e-9, 1e3];

/// What a length may be, in words.
pub(super) const LENGTH_IN_WORDS: &str = "a length from 1 nm to 1 km";

/// A length, m, from 1 nm to 1 km, or a positive angle, rad, with its unit.
pub(super) fn size(text: &str, dimension: Dimension) -> Option<f64> {
    let text = text.trim();
    let value = match text.parse::<Quantity>() {
        Ok(quantity) if quantity.dimension() == Some(dimension) => quantity.to_si().ok()?,
        Ok(_) => return None,
        // `1,5 mm`, `25 mm (nominal)`, spellings of units.
        Err(_) => {
            let end = text.find(|c: char| !(c.is_ascii_digit() || matches!(c, '.' | ',' | '+'))).unwrap_or(text.len());
            let number: f64 = text[..end].replace(',', ".").parse().ok()?;
            let unit = spelled(&text[end..]).filter(|unit| unit.dimension == dimension)?;
            unit.to_si(number)
        }
    };
    let [least, most] = if dimension == Dimension::ANGLE { [f64::MIN_POSITIVE, f64::MAX] } else { LENGTHS };
    (least..=most).contains(&value).then_some(value)
}

/// The sizes of a flow with where they stand.
pub(super) struct Geometry<'s> {
    sheet: &'s Sheet,
    given: &'s [(String, f64)],
    /// The line of the last size that the file states: where sizes do not go together, this one is wrong.
    last: u64,
}

impl<'s> Geometry<'s> {
    pub(super) fn new(sheet: &'s Sheet, given: &'s [(String, f64)]) -> Self {
        Self { sheet, given, last: 1 }
    }

    /// The one setting with this key; a second one is a mistake.
    fn setting(&self, is_key: &dyn Fn(&str) -> bool, mistakes: &mut Vec<TableMistake>) -> Option<&'s Setting> {
        let found: Vec<&Setting> = self.sheet.settings.iter().filter(|setting| is_key(&setting.key)).collect();
        if let [first, second, ..] = found.as_slice() {
            let what = format!("{} is given a second time, after line {}", second.key, first.line);
            mistakes.push(TableMistake::new(second.line, what, "each size once"));
        }
        found.first().copied()
    }

    /// A size; nothing if neither the arguments nor the file have it.
    pub(super) fn find(&mut self, name: &str, dimension: Dimension, mistakes: &mut Vec<TableMistake>) -> Option<f64> {
        if let Some((_, value)) = self.given.iter().find(|(other, _)| other == name) {
            return Some(*value);
        }
        let setting = self.setting(&|key| share(name, key).is_some(), mistakes)?;
        self.last = setting.line;
        let found = size(&setting.value, dimension);
        if found.is_none() {
            let is_number = setting.value.replace(',', ".").parse::<f64>().is_ok_and(|x| 0.0 < x);
            let valid = match (dimension == Dimension::ANGLE, is_number) {
                (true, false) => "a positive angle".to_owned(),
                (false, false) => LENGTH_IN_WORDS.to_owned(),
                (true, true) => format!("its unit with it, as `{} deg`", setting.value),
                (false, true) => format!("its unit with it, as `{} mm`", setting.value),
            };
            mistakes.push(TableMistake::new(setting.line, format!("{name} is `{}`", setting.value), valid));
        }
        Some(found? * share(name, &setting.key).unwrap_or(1.0))
    }

    /// A size that the flow must have.
    fn required(&mut self, name: &str, dimension: Dimension, mistakes: &mut Vec<TableMistake>) -> Option<f64> {
        let before = mistakes.len();
        let found = self.find(name, dimension, mistakes);
        if found.is_none() && mistakes.len() == before {
            let example = if dimension == Dimension::ANGLE { "2 deg" } else { "2 mm" };
            let valid = format!("a comment `# {name}: {example}`, or the argument --{}", name.replace('_', "-"));
            mistakes.push(TableMistake::new(1, format!("{name} is not given"), valid));
        }
        found
    }

    /// The bob, rotor and spring of an oilfield viscometer.
    pub(super) fn oilfield(&mut self, mistakes: &mut Vec<TableMistake>) -> Option<(Bob, Rotor, Spring)> {
        let word = |name: &str, mistakes: &mut Vec<TableMistake>| {
            let setting = self.setting(&|key| key == name || name == "spring" && key == "torsion spring", mistakes);
            setting.map(|setting| (setting.line, setting.value.clone()))
        };
        let [bob, rotor, spring] = ["bob", "rotor", "spring"].map(|name| word(name, mistakes));
        let Some((line, bob)) = bob else {
            let valid = "a comment `# bob: B1` (with `# rotor: R1` and `# spring: F1`), or `# inner_radius`, `# outer_radius` and torques";
            mistakes.push(TableMistake::new(1, "the bob of the dial readings is not given", valid));
            return None;
        };
        let mut refuse = |line: u64, what: String, valid: &str| mistakes.push(TableMistake::new(line, what, valid));
        let bob_found = Bob::of(&bob);
        if bob_found.is_none() {
            refuse(line, format!("bob is `{bob}`"), "B1, B2 or B3");
        }
        let rotor = rotor.map_or(Some(Rotor::Standard), |(line, text)| {
            let found = Rotor::of(&text);
            if found.is_none() {
                refuse(line, format!("rotor is `{text}`"), "R1, R2 or R3");
            }
            found
        });
        let spring = spring.map_or(Some(Spring::STANDARD), |(line, text)| {
            let found = Spring::of(&text);
            if found.is_none() {
                refuse(line, format!("spring is `{text}`"), "F0.2, F0.5, F1, F2, F3, F4, F5 or F10");
            }
            found
        });
        Some((bob_found?, rotor?, spring?))
    }

    /// The flow.
    pub(super) fn flow(&mut self, kind: FlowKind, mistakes: &mut Vec<TableMistake>) -> Option<Flow> {
        let mut found = Vec::new();
        for (name, dimension) in kind.sizes() {
            if let Some(value) = self.required(name, *dimension, mistakes) {
                found.push((*name, value));
            }
        }
        if let Some((what, valid)) = mismatch(kind, &found) {
            mistakes.push(TableMistake::new(self.last, what, valid));
            return None;
        }
        let found: Vec<f64> = found.into_iter().map(|(_, value)| value).collect();
        match (kind, found.as_slice()) {
            (FlowKind::Pipe, [radius]) => Some(Flow::Pipe { radius: *radius }),
            (FlowKind::Capillary, [radius, length]) => Some(Flow::Capillary { radius: *radius, length: *length }),
            (FlowKind::Plates, [radius, gap]) => Some(Flow::Plates { radius: *radius, gap: *gap }),
            (FlowKind::Cone, [radius, angle]) => Some(Flow::Cone { radius: *radius, angle: *angle }),
            (FlowKind::Channel, [half_width]) => Some(Flow::Channel { half_width: *half_width }),
            (FlowKind::Couette, [inner_radius, outer_radius]) => {
                Some(Flow::Couette { inner_radius: *inner_radius, outer_radius: *outer_radius })
            }
            (FlowKind::Curve, _) => Some(Flow::Curve),
            _ => None,
        }
    }
}

/// Why sizes that are known do not go together: what is wrong, and what would be valid.
pub(super) fn mismatch<N: AsRef<str>>(kind: FlowKind, sizes: &[(N, f64)]) -> Option<(String, &'static str)> {
    let of = |name: &str| sizes.iter().find(|(other, _)| other.as_ref() == name).map(|(_, value)| *value);
    match kind {
        FlowKind::Couette => {
            let (inner, outer) = (of("inner_radius")?, of("outer_radius")?);
            let what = || format!("inner_radius = {inner} m, outer_radius = {outer} m");
            (outer <= inner).then(|| (what(), "inner_radius < outer_radius"))
        }
        FlowKind::Cone => {
            let refused = ConeGeometry::new(1.0, of("angle")?).err()?;
            Some((refused.to_string(), "an angle below 90 deg"))
        }
        _ => None,
    }
}
