//! Names of measured quantities, and how the drive and the responses of a flow follow from the columns of a table.

use piola_document::units::{Dimension, Unit};

use super::kind::{Answering, FlowKind, RATE, STRESS, TORQUE};
use super::oilfield::torque_per_length;
use super::{geometry::Geometry, kind::Flow};
use crate::fitting::TableMistake;
use crate::sheet::{Sheet, spelled, units_of};

const VISCOSITY: Dimension = Dimension { length: -1, mass: 1, time: -1, angle: 0 };

/// Words of the quantities, in small letters; the first is the name in messages.
const WORDS: [(&str, &[&str]); 14] = [
    ("shear_rate", &["shear rate", "shearrate", "rate", "gamma dot", "gammadot", "γ̇", "d"]),
    ("shear_stress", &["shear stress", "shearstress", "stress", "tau", "τ", "sigma", "σ"]),
    ("viscosity", &["viscosity", "apparent viscosity", "shear viscosity", "dynamic viscosity", "eta", "η"]),
    ("pressure_gradient", &["pressure gradient"]),
    ("pressure_difference", &["pressure difference", "pressure drop", "differential pressure", "delta p", "δp", "dp"]),
    ("discharge", &["discharge", "flow rate", "flowrate", "volume flow", "volumetric flow rate", "q"]),
    ("discharge_per_width", &["discharge per width"]),
    ("torque_per_length", &["torque per length"]),
    ("torque", &["torque", "moment"]),
    ("dial_reading", &["dial reading", "dial", "dial deflection", "reading", "theta", "θ"]),
    ("speed_difference", &["speed difference"]),
    (
        "angular_velocity",
        &["angular velocity", "angular speed", "speed", "rotational speed", "rotation speed", "omega", "ω", "n", "rpm"],
    ),
    ("radial_stress_difference", &["radial stress difference"]),
    ("thrust", &["thrust", "normal force", "axial force", "fn"]),
];

/// The quantity that a plain name means.
fn quantity(plain: &str) -> Option<&'static str> {
    WORDS.iter().find(|(_, words)| words.contains(&plain)).map(|(name, _)| *name)
}

/// Whether a plain name is that of a measured quantity.
pub(super) fn is_known(plain: &str) -> bool {
    quantity(plain).is_some()
}

/// A column with its unit.
#[derive(Debug, Clone, Copy)]
pub(super) struct Column {
    at: usize,
    unit: Option<Unit>,
    pub(super) name: &'static str,
}

/// How a quantity follows from columns.
#[derive(Debug, Clone, Copy)]
pub(super) enum Source {
    /// It stands there.
    Column(Column),
    /// A column times a factor.
    Scaled(Column, f64),
    /// The product of two columns.
    Product(Column, Column),
}

impl Source {
    /// The columns that it takes.
    fn columns(&self) -> impl Iterator<Item = Column> {
        let (first, second) = match self {
            Self::Column(column) | Self::Scaled(column, _) => (*column, None),
            Self::Product(first, second) => (*first, Some(*second)),
        };
        core::iter::once(first).chain(second)
    }

    /// The value in SI; the name and text of the field that is no number otherwise.
    pub(super) fn value(self, sheet: &Sheet, row: usize) -> Result<f64, (&'static str, String)> {
        let number = |column: Column| {
            let field = sheet.rows[row].fields.get(column.at).unwrap_or_default();
            let number = sheet.number(field).map(|x| column.unit.map_or(x, |unit| unit.to_si(x)));
            number.ok_or_else(|| (column.name, if field.is_empty() { "missing".to_owned() } else { field.to_owned() }))
        };
        match self {
            Self::Column(column) => number(column),
            Self::Scaled(column, factor) => Ok(factor * number(column)?),
            Self::Product(first, second) => Ok(number(first)? * number(second)?),
        }
    }

    /// As the field stands in the file, for a message.
    pub(super) fn written(self, sheet: &Sheet, row: usize) -> (&'static str, String) {
        let column = self.columns().next();
        let of = |column: Column| (column.name, sheet.rows[row].fields.get(column.at).unwrap_or_default().to_owned());
        column.map_or(("value", String::new()), of)
    }
}

/// The sources of a table: of the drive, and of each response.
pub(super) struct Sources {
    pub(super) flow: Option<Flow>,
    pub(super) drive: Option<Source>,
    pub(super) answers: Vec<(Answering, Source)>,
    /// What was read in a way that a reader must know.
    pub(super) notes: Vec<String>,
}

/// Finds columns by name.
struct Finder<'s> {
    sheet: &'s Sheet,
    used: Vec<usize>,
    /// Quantities whose column states no unit.
    plain: Vec<String>,
}

impl Finder<'_> {
    /// The one column of a quantity; a second one is a mistake.
    fn find(
        &mut self,
        name: &'static str,
        dimension: Dimension,
        si: &str,
        mistakes: &mut Vec<TableMistake>,
    ) -> Option<Column> {
        let is_named = |plain: &str| quantity(plain) == Some(name);
        let found: Vec<usize> = self.sheet.columns(&is_named).collect();
        let at = *found.first()?;
        if let Some(second) = found.get(1) {
            let what = format!("column {} is `{}` again", second + 1, self.sheet.headings[*second].written);
            mistakes.push(TableMistake::new(self.sheet.header_line, what, "each once"));
        }
        self.used.push(at);
        let heading = &self.sheet.headings[at];
        let implied = (heading.plain == "rpm").then(|| "rpm".to_owned());
        let Some(text) = heading.unit.clone().or(implied) else {
            self.plain.push(format!("{} in {si}", heading.written));
            return Some(Column { at, unit: None, name });
        };
        let unit = match spelled(&text) {
            // Speeds in 1/min are revolutions.
            Some(unit) if unit.dimension == RATE && dimension == Dimension::ANGULAR_RATE && text.contains("min") => {
                Some(Unit { numerator: core::f64::consts::TAU * unit.numerator, dimension, ..unit })
            }
            Some(unit) if unit.dimension == dimension => Some(unit),
            Some(_) => {
                let what = format!("`{text}` is no unit of {name}");
                mistakes.push(TableMistake::new(self.sheet.header_line, what, format!("a unit such as {si}")));
                None
            }
            None => {
                let error = crate::sheet::unknown(&text);
                let valid = format!("a unit such as {}", units_of(dimension));
                mistakes.push(TableMistake::new(self.sheet.header_line, error, valid));
                None
            }
        };
        Some(Column { at, unit, name })
    }
}

/// The column of an angular velocity, by any of its names.
fn speed(finder: &mut Finder<'_>, mistakes: &mut Vec<TableMistake>) -> Option<Column> {
    let own = finder.find("speed_difference", Dimension::ANGULAR_RATE, "rad/s", mistakes);
    own.or_else(|| finder.find("angular_velocity", Dimension::ANGULAR_RATE, "rad/s", mistakes))
}

/// Sources for a kind of flow; what is missing is a mistake.
pub(super) fn sources(
    sheet: &Sheet,
    kind: FlowKind,
    given: &[(String, f64)],
    mistakes: &mut Vec<TableMistake>,
) -> Sources {
    let mut finder = Finder { sheet, used: Vec::new(), plain: Vec::new() };
    let mut geometry = Geometry::new(sheet, given);
    let mut notes = Vec::new();
    let mut flow = None;
    let (name, dimension, si) = kind.drive();
    let mut drive = match kind {
        FlowKind::Plates | FlowKind::Cone => speed(&mut finder, mistakes).map(Source::Column),
        _ => finder.find(name, dimension, si, mistakes).map(Source::Column),
    };
    if drive.is_none() {
        match kind {
            FlowKind::Pipe | FlowKind::Channel => {
                let pressure = finder.find("pressure_difference", STRESS, "Pa", mistakes);
                let length = pressure.and_then(|_| geometry.find("length", Dimension::LENGTH, mistakes));
                if pressure.is_some() && length.is_none() {
                    let valid = "a comment `# length: 1 m` of the distance over which the pressure falls";
                    mistakes.push(TableMistake::new(
                        sheet.header_line,
                        "the length of the pressure difference is not given",
                        valid,
                    ));
                }
                drive = pressure.map(|column| Source::Scaled(column, 1.0 / length.unwrap_or(1.0)));
            }
            FlowKind::Couette => {
                if let Some(column) = finder.find("torque", TORQUE, "N m", mistakes) {
                    let height = geometry.find("height", Dimension::LENGTH, mistakes);
                    if height.is_none() {
                        let valid = "a comment `# height: 40 mm`, or a column torque_per_length";
                        mistakes.push(TableMistake::new(
                            sheet.header_line,
                            "the height of the inner cylinder is not given",
                            valid,
                        ));
                    }
                    drive = Some(Source::Scaled(column, 1.0 / height.unwrap_or(1.0)));
                } else if let Some(column) = finder.find("dial_reading", Dimension::ANGLE, "deg", mistakes) {
                    if let Some((bob, rotor, spring)) = geometry.oilfield(mistakes) {
                        // A reading without a unit is in degrees.
                        let degree = column.unit.map_or(1.0, |_| 180.0 / core::f64::consts::PI);
                        drive = Some(Source::Scaled(column, degree * torque_per_length(bob, spring)));
                        flow = Some(Flow::Couette { inner_radius: bob.radius(), outer_radius: rotor.radius() });
                        notes.push(format!("dial readings are degrees of the spring, with bob {bob:?}"));
                    } else {
                        drive = Some(Source::Column(column));
                        flow = Some(Flow::Curve);
                    }
                    finder.plain.retain(|text| !text.ends_with(" in deg"));
                }
            }
            _ => {}
        }
    }
    if flow.is_none() {
        flow = geometry.flow(kind, mistakes);
    }
    let mut answers = Vec::new();
    for &what in kind.answers() {
        let (name, dimension, si) = what.column();
        let column = match what {
            Answering::SpeedDifference => speed(&mut finder, mistakes),
            _ => finder.find(name, dimension, si, mistakes),
        };
        answers.extend(column.map(|column| (what, Source::Column(column))));
    }
    if let (FlowKind::Curve, true, Some(Source::Column(rate))) = (kind, answers.is_empty(), drive)
        && let Some(column) = finder.find("viscosity", VISCOSITY, "Pa s", mistakes)
    {
        answers.push((Answering::ShearStress, Source::Product(column, rate)));
        notes.push("stresses are viscosity times shear rate".to_owned());
    }
    // Answers stand in the order of their columns.
    answers.sort_by_key(|(_, source)| source.columns().map(|column| column.at).min());
    missing(sheet, kind, drive.is_none(), answers.is_empty(), mistakes);
    if !finder.plain.is_empty() {
        notes.push(format!("without a unit in the file, SI is supposed: {}", finder.plain.join(", ")));
    }
    let others = sheet
        .headings
        .iter()
        .enumerate()
        .filter(|(at, heading)| !finder.used.contains(at) && !heading.written.is_empty());
    let others: Vec<String> = others.map(|(_, heading)| format!("`{}`", heading.written)).collect();
    if !others.is_empty() {
        notes.push(format!("columns not used: {}", others.join(", ")));
    }
    Sources { flow, drive, answers, notes }
}

/// The mistakes of columns that are not there.
fn missing(sheet: &Sheet, kind: FlowKind, no_drive: bool, no_answer: bool, mistakes: &mut Vec<TableMistake>) {
    let line = sheet.header_line;
    let mut refuse = |what: &str, mut valid: String| {
        let listed: Vec<&str> = sheet.headings.iter().map(|heading| heading.plain.as_str()).collect();
        if listed.len() == 1 {
            valid += "; fields are separated by commas, semicolons or tabs";
        }
        if kind != FlowKind::Curve && ["shear rate", "shear stress"].iter().all(|name| listed.contains(name)) {
            valid += "; shear rates and stresses are read with --flow curve";
        }
        let what = format!("no column is {what}: the columns are {}", sheet.names());
        mistakes.push(TableMistake::new(line, what, valid));
    };
    let unit =
        |(name, dimension, _): super::kind::Named| format!("`{name}` with a unit such as {}", units_of(dimension));
    if no_drive {
        let more = match kind {
            FlowKind::Couette => ", or `torque` with `# height`, or `dial_reading` with `# bob`",
            FlowKind::Pipe | FlowKind::Channel => ", or `pressure_difference` with `# length`",
            _ => "",
        };
        refuse("the drive of this flow", format!("{}{more}", unit(kind.drive())));
    }
    if no_answer {
        let names: Vec<String> = kind.answers().iter().map(|what| unit(what.column())).collect();
        let more = if kind == FlowKind::Curve { ", or `viscosity`" } else { "" };
        refuse("a response of this flow", format!("{}{more}", names.join(" or ")));
    }
}

#[cfg(test)]
mod tests {
    use super::super::kind::DISCHARGE;
    use super::{is_known, quantity};
    use crate::sheet::{Heading, spelled};

    #[test]
    fn usual_headings_are_read_with_name_and_unit() {
        let cases = [
            ("Shear rate [1/s]", "shear_rate", "1/s"),
            ("shear_rate_1_s", "shear_rate", "1/s"),
            ("Shear Stress (Pa)", "shear_stress", "Pa"),
            ("Stress / mPa", "shear_stress", "mPa"),
            ("viscosity_Pa_s", "viscosity", "Pa s"),
            ("Viscosity, cP", "viscosity", "cP"),
            ("Torque in µNm", "torque", "µNm"),
            ("speed_rpm", "angular_velocity", "rpm"),
            ("η (mPa.s)", "viscosity", "mPa.s"),
        ];
        for (written, name, unit) in cases {
            let heading = Heading::parse(written, &is_known);
            assert_eq!((quantity(&heading.plain), heading.unit.as_deref()), (Some(name), Some(unit)), "{written}");
        }
        assert_eq!(spelled("mL/min").map(|unit| unit.dimension), Some(DISCHARGE));
    }
}
