//! The layouts of tables of measured stresses.
//!
//! ```text
//! mode,stretch,stress [MPa]       one deformation and one stress: `stretch`, `strain [%]`; engineering or true stress
//! lambda1,lambda2,P1,P2           sheets pulled unequally both ways; sigma1, sigma2 for Cauchy stresses
//! mode,stress_type,F11,…,F33,S11,…,S33     F and stress by rows; stress_type PK1 or cauchy
//! ```
//! Columns may stand in any order, with others between them. `specimen` makes a test of each specimen, `weight` weighs it (0 holds it
//! out). `# unit: MPa` and `# mode: uniaxial` say what no column says.

mod biaxial;
mod components;
mod names;
mod simple;

use piola_document::units::Dimension;
use piola_fit::FitError;
use piola_fit::solids::{Data, Measure, Table, Test};
use piola_specimens::homogeneous::Mode;

use super::TableMistake;
use crate::sheet::{Row, Sheet, spelled, units_of, unknown};
use names::Quantity;

/// A table that was read.
pub(super) struct Layout {
    pub(super) data: Data,
    pub(super) unit: Option<String>,
    /// Tests that the file holds out, with weight 0.
    pub(super) held_out: Vec<Test>,
    pub(super) notes: Vec<String>,
}

/// Tests of a layout, their unit and what a reader must know.
pub(super) struct Found {
    tests: Vec<Test>,
    held_out: Vec<Test>,
    /// The unit of the stress columns, as the header has it.
    unit: Option<String>,
    notes: Vec<String>,
}

/// Data and unit of a table, or all that is wrong with it.
pub(super) fn parse(text: &str, only: &[(String, String)]) -> Result<Layout, Vec<TableMistake>> {
    let mut sheet = Sheet::parse(text, &names::is_known)?;
    for (column, value) in only {
        sheet.keep_only(column, value).map_err(|mistake| vec![mistake])?;
    }
    if sheet.rows.is_empty() {
        return Err(vec![TableMistake::new(sheet.last, "the table has a header and no rows", "a row for each point")]);
    }
    let commented = unit(&sheet)?;
    let found = if components::find(&sheet).is_some() {
        Found { tests: components::tests(&sheet)?, held_out: Vec::new(), unit: None, notes: Vec::new() }
    } else if names::find(&sheet, Quantity::FirstStretch).is_some() {
        biaxial::tests(&sheet)?
    } else if names::find(&sheet, Quantity::Stress).or(names::find(&sheet, Quantity::TrueStress)).is_some() {
        simple::tests(&sheet)?
    } else {
        let what = format!("the header `{}` is of no known layout", sheet.names().replace(['`', ' '], ""));
        let valid = "`mode,stretch,stress`, or `lambda1,lambda2,P1,P2`, or `mode,stress_type,F11,…,F33,S11,…,S33`, with \
                     commas, semicolons or tabs";
        return Err(vec![TableMistake::new(sheet.header_line, what, valid)]);
    };
    if let (Some((commented, _)), Some(headed)) = (&commented, &found.unit)
        && commented != headed
    {
        let what = format!("the header says {headed} and a comment {commented}");
        return Err(vec![TableMistake::new(sheet.header_line, what, "one unit")]);
    }
    let unit = commented.or(found.unit.map(|unit| (unit, sheet.header_line)));
    if let Some((unit, line)) = &unit {
        check_unit(unit, *line)?;
    }
    let refused =
        |error: FitError| vec![TableMistake::new(sheet.header_line, error.to_string(), "tests of a material")];
    let data = Data::new(found.tests).map_err(refused)?;
    let mut notes = found.notes;
    notes.extend(doubtful(&data));
    Ok(Layout { data, unit: unit.map(|(unit, _)| unit), held_out: found.held_out, notes })
}

/// The unit that a comment names, with its line.
fn unit(sheet: &Sheet) -> Result<Option<(String, u64)>, Vec<TableMistake>> {
    let is_unit = |key: &str| matches!(key, "unit" | "stress unit" | "units");
    let mut found = sheet.settings.iter().filter(|setting| is_unit(&setting.key));
    let first = found.next().map(|setting| (setting.value.clone(), setting.line));
    match found.next() {
        Some(second) => {
            let line = first.map_or(1, |(_, line)| line);
            let what = format!("the unit is given a second time, after line {line}");
            Err(vec![TableMistake::new(second.line, what, "one unit")])
        }
        None => Ok(first),
    }
}

/// Refuses what is no unit of stress.
fn check_unit(unit: &str, line: u64) -> Result<(), Vec<TableMistake>> {
    match spelled(unit) {
        Some(found) if found.dimension == Dimension::PRESSURE => Ok(()),
        found => {
            let what = found.map_or_else(|| unknown(unit), |_| format!("`{unit}` is no unit of stress"));
            Err(vec![TableMistake::new(line, what, format!("one of {}", units_of(Dimension::PRESSURE)))])
        }
    }
}

/// Tests that hardly say what was measured.
fn doubtful(data: &Data) -> Vec<String> {
    let mut notes = Vec::new();
    for test in data.tests() {
        let Some((mode, points)) = test.table().mode() else { continue };
        if mode == Mode::SimpleShear {
            continue;
        }
        let name = test.name();
        let against = points.iter().filter(|[stretch, stress]| *stretch < 1.0 && 0.0 < *stress).count();
        if against == points.len() {
            notes.push(format!("{name}: all stretches are below 1 and all stresses positive: are these strains? Call the column `strain`"));
        } else if 0 < against {
            notes.push(format!("{name}: {against} stretches below 1 have positive stresses"));
        }
        if points.iter().all(|[stretch, _]| 20.0 <= *stretch) {
            notes.push(format!(
                "{name}: stretches from {}: is this percent? Call the column `stretch [%]`",
                points[0][0]
            ));
        }
    }
    notes
}

/// The mode that a label names.
fn mode(label: &str) -> Option<Mode> {
    match label.to_lowercase().as_str() {
        "uniaxial" | "ut" | "tension" | "compression" | "uc" => Some(Mode::Uniaxial),
        "equibiaxial" | "biaxial" | "et" | "eb" | "bt" => Some(Mode::Equibiaxial),
        "planar" | "pure shear" | "pure_shear" | "ps" | "pt" => Some(Mode::Planar),
        "simple shear" | "simple_shear" | "ss" => Some(Mode::SimpleShear),
        _ => None,
    }
}

/// A finite number in a column.
fn number(sheet: &Sheet, row: &Row, column: usize, name: &str, mistakes: &mut Vec<TableMistake>) -> f64 {
    let text = row.fields.get(column).unwrap_or_default();
    sheet.number(text).unwrap_or_else(|| {
        mistakes.push(TableMistake::new(row.line, format!("{name} is `{text}`"), "a finite number"));
        f64::NAN
    })
}

/// Adds to the group of this key.
fn push<K: PartialEq, V>(groups: &mut Vec<(K, Vec<V>)>, key: K, value: V) {
    match groups.iter_mut().find(|(other, _)| *other == key) {
        Some((_, values)) => values.push(value),
        None => groups.push((key, vec![value])),
    }
}

/// The test of a table whose points stand on these lines, or the mistakes of all its points.
fn test(name: &str, table: &Table, measure: Measure, lines: &[u64], mistakes: &mut Vec<TableMistake>) -> Option<Test> {
    let error = match Test::new(name, table.clone(), measure) {
        Ok(test) => return Some(test),
        Err(error) => error,
    };
    let before = mistakes.len();
    for (index, &line) in lines.iter().enumerate() {
        let Err(error) = Test::new(name, point(table, index), measure) else { continue };
        // The components of one row may all say the same.
        let mistake = refused(line, &error);
        if mistakes[before..].last() != Some(&mistake) {
            mistakes.push(mistake);
        }
    }
    if mistakes.len() == before {
        mistakes.push(refused(lines.first().copied().unwrap_or(1), &error));
    }
    None
}

/// The table of one point.
fn point(table: &Table, index: usize) -> Table {
    match (table.mode(), table) {
        (Some((mode, points)), _) => Table::of_mode(mode, points.get(index).copied().into_iter().collect()),
        (None, Table::General(points)) => Table::General(points.get(index).copied().into_iter().collect()),
        (None, other) => other.clone(),
    }
}

/// The mistake in the point of a line, with a valid value.
fn refused(line: u64, error: &FitError) -> TableMistake {
    match error {
        FitError::StretchOutOfRange { value, .. } => {
            let what = format!("at the stretch {value:e} no law has a stress");
            TableMistake::new(line, what, "a stretch or amount of shear of 1e-30 to 1e30")
        }
        FitError::NotIsochoric { determinant, .. } => TableMistake::new(
            line,
            format!("det F is {determinant}, or F has no inverse"),
            "det F = 1, the material is incompressible",
        ),
        other => TableMistake::new(line, other.to_string(), "a test of a material"),
    }
}
