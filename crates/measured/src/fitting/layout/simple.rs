//! One deformation and one stress in a row.

use piola_document::units::Dimension;
use piola_fit::solids::{Measure, Table, Test};
use piola_specimens::homogeneous::Mode;

use super::names::{Quantity, find, not_used};
use super::{Found, mode, number, push, test};
use crate::fitting::TableMistake;
use crate::sheet::{Sheet, spelled};

/// A strain beyond this without a unit may be percent.
const PLAIN_STRAIN: f64 = 10.0;

/// How the deformation is written.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Stretch,
    Strain,
    Logarithmic,
    Shear,
}

/// The column of the deformation.
struct Deformation {
    at: usize,
    kind: Kind,
    /// 0.01 for percent.
    unit: f64,
}

impl Deformation {
    fn find(sheet: &Sheet) -> Result<Self, TableMistake> {
        let kinds = [
            (Quantity::Stretch, Kind::Stretch),
            (Quantity::Strain, Kind::Strain),
            (Quantity::LogarithmicStrain, Kind::Logarithmic),
            (Quantity::Shear, Kind::Shear),
        ];
        let found = kinds.into_iter().find_map(|(quantity, kind)| Some((find(sheet, quantity)?, kind)));
        let Some((at, kind)) = found else {
            return Err(sheet.missing("stretch or a strain", "a column `stretch`, `strain [%]` or `strain [-]`"));
        };
        let unit = match &sheet.headings[at].unit {
            None => None,
            Some(text) => match spelled(text) {
                Some(unit) if unit.dimension == Dimension::NONE => Some(unit.to_si(1.0)),
                _ => {
                    let what = format!("`{text}` is no unit of a stretch or strain");
                    return Err(TableMistake::new(sheet.header_line, what, "%, or - for a pure number"));
                }
            },
        };
        if unit.is_none() && kind != Kind::Stretch {
            let values = sheet.rows.iter().filter_map(|row| sheet.number(row.fields.get(at)?));
            let most = values.fold(0.0_f64, |most, x| most.max(x.abs()));
            if PLAIN_STRAIN < most {
                let name = &sheet.headings[at].written;
                let what = format!("`{name}` reaches {most} and has no unit");
                let valid = format!("`{name} [%]` for percent, `{name} [-]` for a pure number");
                return Err(TableMistake::new(sheet.header_line, what, valid));
            }
        }
        Ok(Self { at, kind, unit: unit.unwrap_or(1.0) })
    }

    fn name(&self) -> &'static str {
        match self.kind {
            Kind::Stretch => "stretch",
            Kind::Strain | Kind::Logarithmic => "strain",
            Kind::Shear => "shear",
        }
    }

    /// The stretch, or the amount of shear.
    fn value(&self, mode: Mode, x: f64) -> f64 {
        let x = self.unit * x;
        match self.kind {
            Kind::Strain if mode != Mode::SimpleShear => 1.0 + x,
            Kind::Logarithmic if mode != Mode::SimpleShear => x.exp(),
            _ => x,
        }
    }

    /// What a reader must know.
    fn note(&self) -> Option<String> {
        let percent = if self.unit < 1.0 { " in percent" } else { "" };
        match self.kind {
            Kind::Strain => Some(format!("strains{percent} are engineering strains: stretch = 1 + strain")),
            Kind::Logarithmic => Some(format!("strains{percent} are logarithmic: stretch = exp(strain)")),
            Kind::Stretch if self.unit < 1.0 => Some("stretches are in percent".to_owned()),
            _ => None,
        }
    }
}

/// The column of the stresses with its measure and its unit.
fn stress(sheet: &Sheet, notes: &mut Vec<String>) -> Result<(usize, Measure, Option<String>), TableMistake> {
    let all: Vec<(usize, Measure)> = [(Quantity::Stress, Measure::FirstPiola), (Quantity::TrueStress, Measure::Cauchy)]
        .into_iter()
        .flat_map(|(wanted, measure)| {
            let is_wanted = move |plain: &str| super::names::quantity(plain) == Some(wanted);
            let places: Vec<usize> = sheet.columns(&is_wanted).collect();
            places.into_iter().map(move |at| (at, measure))
        })
        .collect();
    let unit = |at: usize| sheet.headings[at].unit.clone();
    let first = all.first().copied().unwrap_or((0, Measure::FirstPiola));
    let of_measure: Vec<usize> = all.iter().filter(|(_, measure)| *measure == first.1).map(|(at, _)| *at).collect();
    let chosen = match of_measure.as_slice() {
        [_] | [] => first.0,
        several => {
            // The same stress in two units: that in pascals.
            let is_pascal = |at: &&usize| unit(**at).is_some_and(|unit| unit.ends_with("Pa"));
            let mut found = several.iter().filter(is_pascal);
            let (Some(one), None) = (found.next(), found.next()) else {
                let names: Vec<String> =
                    several.iter().map(|at| format!("`{}`", sheet.headings[*at].written)).collect();
                let what = format!("several columns are stresses: {}", names.join(", "));
                return Err(TableMistake::new(sheet.header_line, what, "one column of stresses"));
            };
            *one
        }
    };
    if first.1 == Measure::Cauchy {
        notes.push("stresses are Cauchy stresses, force for each deformed area".to_owned());
    }
    Ok((chosen, first.1, unit(chosen)))
}

/// A mode with the name of a test, of a label such as `uniaxial`, `UT_C` or `uniaxial compression`.
fn labelled(label: &str) -> Option<(Mode, String)> {
    if let Some(mode) = mode(label) {
        return Some((mode, mode.name().to_owned()));
    }
    let splits: Vec<(usize, &str)> = label.match_indices(['_', ' ', '/', ':', '-']).collect();
    let (at, _) = splits.into_iter().rfind(|(at, _)| mode(&label[..*at]).is_some())?;
    Some((mode(&label[..at])?, label.to_owned()))
}

/// The line, the weight, the stretch and the stress of a row.
type Point = (u64, Option<f64>, [f64; 2]);

pub(super) fn tests(sheet: &Sheet) -> Result<Found, Vec<TableMistake>> {
    let mut notes = Vec::new();
    let one = |mistake| vec![mistake];
    let deformation = Deformation::find(sheet).map_err(one)?;
    let (at, measure, unit) = stress(sheet, &mut notes).map_err(one)?;
    notes.extend(deformation.note());
    let [modes, specimens, weights] =
        [Quantity::Mode, Quantity::Specimen, Quantity::Weight].map(|wanted| find(sheet, wanted));
    let stated =
        sheet.settings.iter().find(|setting| matches!(setting.key.as_str(), "mode" | "test" | "test type" | "loading"));
    if modes.is_none() && stated.is_none() {
        let valid = "a column `mode` or a comment `# mode: uniaxial` (equibiaxial, planar, simple shear)";
        return Err(vec![TableMistake::new(sheet.header_line, "the mode of the test is not given", valid)]);
    }
    let used: Vec<usize> = [Some(deformation.at), Some(at), modes, specimens, weights].into_iter().flatten().collect();
    notes.extend(not_used(sheet, &used));
    let mut mistakes = Vec::new();
    let mut groups: Vec<((Mode, String), Vec<Point>)> = Vec::new();
    let mut was_biaxial = false;
    for row in &sheet.rows {
        if let Some(mistake) = sheet.incomplete(row) {
            mistakes.push(mistake);
            continue;
        }
        let x = number(sheet, row, deformation.at, deformation.name(), &mut mistakes);
        let stress = number(sheet, row, at, "stress", &mut mistakes);
        let weight = weights.map(|column| number(sheet, row, column, "weight", &mut mistakes));
        let label =
            modes.map_or_else(|| stated.map_or("", |setting| setting.value.as_str()), |column| &row.fields[column]);
        let Some((mode, mut name)) = labelled(label) else {
            let valid = "uniaxial, equibiaxial, planar, simple shear";
            let line = if modes.is_some() { row.line } else { stated.map_or(row.line, |setting| setting.line) };
            let mistake = TableMistake::new(line, format!("the mode is `{label}`"), valid);
            if mistakes.last() != Some(&mistake) {
                mistakes.push(mistake);
            }
            continue;
        };
        was_biaxial |= matches!(label.to_lowercase().as_str(), "biaxial" | "bt");
        if let Some(specimen) = specimens.and_then(|column| row.fields.get(column)).filter(|text| !text.is_empty()) {
            name = format!("{name} {specimen}");
        }
        let stretch = deformation.value(mode, x);
        if mode != Mode::SimpleShear && stretch <= 0.0 {
            let hint = if x.abs() <= 0.0 { "; strains are in a column `strain`" } else { "" };
            mistakes.push(TableMistake::new(
                row.line,
                format!("the stretch is {stretch}"),
                format!("0 < stretch{hint}"),
            ));
        }
        push(&mut groups, (mode, name), (row.line, weight, [stretch, stress]));
    }
    if !mistakes.is_empty() {
        return Err(mistakes);
    }
    if was_biaxial {
        notes.push(
            "`biaxial` is read as equibiaxial; unequal stretches stand in columns lambda1, lambda2, P1, P2".to_owned(),
        );
    }
    let mut found = Found { tests: Vec::new(), held_out: Vec::new(), unit, notes };
    for ((mode, name), points) in groups {
        let lines: Vec<u64> = points.iter().map(|(line, _, _)| *line).collect();
        let table = Table::of_mode(mode, points.iter().map(|(_, _, point)| *point).collect());
        let made = test(&name, &table, measure, &lines, &mut mistakes);
        let weights: Vec<(u64, f64)> =
            points.iter().filter_map(|(line, weight, _)| Some((*line, (*weight)?))).collect();
        found.add(made, &weights, &mut mistakes);
    }
    if mistakes.is_empty() { Ok(found) } else { Err(mistakes) }
}

impl Found {
    /// Adds a test with the weight of its rows; 0 holds it out.
    pub(super) fn add(&mut self, test: Option<Test>, weights: &[(u64, f64)], mistakes: &mut Vec<TableMistake>) {
        let Some(test) = test else { return };
        let Some((_, weight)) = weights.first().copied() else {
            self.tests.push(test);
            return;
        };
        if let Some((line, other)) = weights.iter().find(|(_, other)| other.total_cmp(&weight).is_ne()) {
            let what = format!("the weight of `{}` is {other}, and {weight} in an earlier row", test.name());
            mistakes.push(TableMistake::new(*line, what, "one weight for all rows of a test"));
        } else if weight.abs() <= 0.0 {
            self.held_out.push(test);
        } else {
            match test.with_weight(weight) {
                Ok(test) => self.tests.push(test),
                Err(error) => mistakes.push(TableMistake::new(
                    weights[0].0,
                    error.to_string(),
                    "0 < weight, or 0 to hold the test out",
                )),
            }
        }
    }
}
