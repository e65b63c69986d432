//! The two layouts of tables of measured stresses.
//!
//! ```text
//! mode,stretch,stress                 uniaxial | equibiaxial | planar | simple shear; stress_MPa names the unit
//! mode,stress_type,F11,…,F33,S11,…,S33     F and stress by rows; stress_type PK1 or cauchy; other modes too
//! ```
//! Lines that begin with `#` are comments; `# unit: MPa` names the unit.

use core::fmt::Write as _;
use std::io::Read as _;
use std::path::Path;

use csv::{ReaderBuilder, StringRecord, Trim};
use piola_document::words;
use piola_fit::FitError;
use piola_fit::solids::{Component, Data, Measure, Table, Test};
use piola_specimens::homogeneous::Mode;

use super::TableMistake;
use crate::MeasuredError;

/// A table with more bytes than this is refused (64 MiB).
const LARGEST: u64 = 64 << 20;
/// How far the stretches across may be from those of the mode.
const SAME_STRETCH: f64 = 1e-3;
const TRACTION_FREE: usize = 2;

/// The text of a file.
pub(crate) fn read(path: &Path) -> Result<String, MeasuredError> {
    let mut bytes = Vec::new();
    std::fs::File::open(path)
        .and_then(|file| file.take(LARGEST + 1).read_to_end(&mut bytes))
        .map_err(|cause| MeasuredError::Unreadable { path: path.to_path_buf(), cause: cause.to_string() })?;
    if LARGEST < bytes.len() as u64 {
        return Err(MeasuredError::TooLarge { path: path.to_path_buf(), bytes: bytes.len() as u64, most: LARGEST });
    }
    String::from_utf8(bytes).map_err(|error| {
        let good = error.utf8_error().valid_up_to();
        let bytes = error.as_bytes();
        let before = &bytes[..good];
        let line = before.split(|byte| *byte == b'\n').count();
        let column = 1 + before.iter().rev().take_while(|byte| **byte != b'\n').count();
        MeasuredError::NotText { path: path.to_path_buf(), line, column, byte: bytes[good] }
    })
}

/// A row of a table.
struct Row {
    line: u64,
    fields: StringRecord,
}

type Read = Result<(Data, Option<String>), Vec<TableMistake>>;

/// Data and unit of a table, or all that is wrong with it.
pub(super) fn parse(text: &str) -> Read {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let unit = text.lines().find_map(unit_in).map(str::to_owned);
    let mut reader = ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .comment(Some(b'#'))
        .trim(Trim::All)
        .from_reader(text.as_bytes());
    let mut rows = Vec::new();
    for record in reader.records() {
        match record {
            Ok(fields) => rows.push(Row { line: fields.position().map_or(0, |at| line_of(text, at)), fields }),
            Err(error) => {
                let line = error.position().map_or(1, csv::Position::line);
                return Err(vec![TableMistake::new(line, error.to_string(), "comma-separated values")]);
            }
        }
    }
    let lines = u64::try_from(text.lines().count()).unwrap_or(u64::MAX).max(1);
    let Some(header) = rows.first() else {
        let valid = "a header `mode,stretch,stress` and a row for each point";
        return Err(vec![TableMistake::new(lines, "the table is empty", valid)]);
    };
    if rows.len() == 1 {
        return Err(vec![TableMistake::new(lines, "the table has a header and no rows", "a row for each point")]);
    }
    let names: Vec<&str> = header.fields.iter().collect();
    let body = &rows[1..];
    let (tests, unit) = match names.as_slice() {
        ["mode", "stretch", stress] if stress.starts_with("stress") => {
            let suffix = stress.trim_start_matches("stress").trim_start_matches('_');
            let of_header = (!suffix.is_empty()).then(|| suffix.to_owned());
            if let (Some(commented), Some(headed)) = (&unit, &of_header)
                && commented != headed
            {
                let what = format!("the header says {headed} and a comment {commented}");
                return Err(vec![TableMistake::new(header.line, what, "one unit")]);
            }
            (short(body)?, unit.or(of_header))
        }
        ["mode", "stress_type", rest @ ..] if rest == components() => (long(body)?, unit),
        _ => {
            let what = format!("the header `{}` is of no known layout", names.join(","));
            let valid = "`mode,stretch,stress`, or `mode,stress_type,F11,…,F33,S11,…,S33`";
            return Err(vec![TableMistake::new(header.line, what, valid)]);
        }
    };
    let refused = |error: FitError| vec![TableMistake::new(header.line, error.to_string(), "tests of a material")];
    Ok((Data::new(tests).map_err(refused)?, unit))
}

/// The line of a record: its position is where the one before it ends, comments and empty lines come between.
pub(crate) fn line_of(text: &str, position: &csv::Position) -> u64 {
    let start = usize::try_from(position.byte()).unwrap_or(usize::MAX);
    let between = |line: &&str| line.trim().is_empty() || line.starts_with('#');
    let skipped = text.get(start..).unwrap_or_default().lines().take_while(between).count();
    position.line() + u64::try_from(skipped).unwrap_or(0)
}

/// The unit that a comment names.
fn unit_in(line: &str) -> Option<&str> {
    line.strip_prefix('#')?.trim().strip_prefix("unit:").map(str::trim)
}

fn components() -> Vec<String> {
    let name = |letter: char, k: usize| {
        let mut name = String::from(letter);
        let _ = write!(name, "{}{}", k / 3 + 1, k % 3 + 1);
        name
    };
    (0..9).map(|k| name('F', k)).chain((0..9).map(|k| name('S', k))).collect()
}

/// The mode that a label names.
fn mode(label: &str) -> Option<Mode> {
    match label.to_ascii_lowercase().as_str() {
        "uniaxial" | "ut" => Some(Mode::Uniaxial),
        "equibiaxial" | "biaxial" | "et" => Some(Mode::Equibiaxial),
        "planar" | "pure shear" | "ps" => Some(Mode::Planar),
        "simple shear" | "ss" => Some(Mode::SimpleShear),
        _ => None,
    }
}

/// A finite number in a column.
fn number(row: &Row, column: usize, name: &str, mistakes: &mut Vec<TableMistake>) -> f64 {
    let text = row.fields.get(column).unwrap_or_default();
    match text.parse::<f64>() {
        Ok(x) if x.is_finite() => x,
        _ => {
            mistakes.push(TableMistake::new(row.line, format!("{name} is `{text}`"), "a finite number"));
            f64::NAN
        }
    }
}

/// Refuses a row with another number of fields.
fn complete(row: &Row, count: usize, mistakes: &mut Vec<TableMistake>) -> bool {
    let found = row.fields.len();
    if found != count {
        mistakes.push(TableMistake::new(row.line, format!("a row of {found} fields"), format!("{count} fields")));
    }
    found == count
}

/// Adds to the group of this key.
fn push<K: PartialEq, V>(groups: &mut Vec<(K, Vec<V>)>, key: K, value: V) {
    match groups.iter_mut().find(|(other, _)| *other == key) {
        Some((_, values)) => values.push(value),
        None => groups.push((key, vec![value])),
    }
}

/// The line, the stretch and the stress of a row.
type Point = (u64, [f64; 2]);

fn short(rows: &[Row]) -> Result<Vec<Test>, Vec<TableMistake>> {
    let mut mistakes = Vec::new();
    let mut groups: Vec<(Mode, Vec<Point>)> = Vec::new();
    for row in rows {
        if !complete(row, 3, &mut mistakes) {
            continue;
        }
        let label = &row.fields[0];
        let (stretch, stress) = (number(row, 1, "stretch", &mut mistakes), number(row, 2, "stress", &mut mistakes));
        let Some(mode) = mode(label) else {
            let valid = "uniaxial, equibiaxial, planar, simple shear";
            mistakes.push(TableMistake::new(row.line, format!("the mode is `{label}`"), valid));
            continue;
        };
        if mode != Mode::SimpleShear && stretch <= 0.0 {
            mistakes.push(TableMistake::new(row.line, format!("the stretch is {stretch}"), "0 < stretch"));
        }
        push(&mut groups, mode, (row.line, [stretch, stress]));
    }
    if !mistakes.is_empty() {
        return Err(mistakes);
    }
    let mut tests = Vec::new();
    for (mode, points) in groups {
        let (lines, points): (Vec<u64>, Vec<[f64; 2]>) = points.into_iter().unzip();
        tests.extend(test(mode.name(), &Table::of_mode(mode, points), Measure::FirstPiola, &lines, &mut mistakes));
    }
    if mistakes.is_empty() { Ok(tests) } else { Err(mistakes) }
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

/// F and stress of a row.
struct Tensors {
    line: u64,
    deformation: [[f64; 3]; 3],
    stress: [[f64; 3]; 3],
}

fn long(rows: &[Row]) -> Result<Vec<Test>, Vec<TableMistake>> {
    let mut mistakes = Vec::new();
    let mut groups: Vec<((String, Measure), Vec<Tensors>)> = Vec::new();
    let names = components();
    for row in rows {
        if !complete(row, 20, &mut mistakes) {
            continue;
        }
        let measure = match row.fields[1].to_ascii_lowercase().as_str() {
            "pk1" | "nominal" => Measure::FirstPiola,
            "cauchy" => Measure::Cauchy,
            other => {
                mistakes.push(TableMistake::new(row.line, format!("stress_type is `{other}`"), "PK1 or cauchy"));
                continue;
            }
        };
        let mut rows = |first: usize| {
            [0, 3, 6].map(|i| [0, 1, 2].map(|j| number(row, 2 + first + i + j, &names[first + i + j], &mut mistakes)))
        };
        let tensors = Tensors { line: row.line, deformation: rows(0), stress: rows(9) };
        push(&mut groups, (row.fields[0].to_owned(), measure), tensors);
    }
    if !mistakes.is_empty() {
        return Err(mistakes);
    }
    let mut tests = Vec::new();
    for ((label, measure), rows) in groups {
        let first = rows.first().map_or(1, |row| row.line);
        // A label of a mode that none of its rows has is but a name.
        let known = mode(&label).filter(|mode| rows.iter().any(|row| is_of(*mode, &row.deformation)));
        // Where the stress that keeps the width is measured too, both are fitted.
        let known = known.filter(|mode| *mode != Mode::Planar || rows.iter().all(|row| is_zero(row.stress[1][1])));
        let before = mistakes.len();
        let (name, (lines, table)) = match known {
            Some(mode) => (mode.name().to_owned(), of_mode(mode, &label, &rows, &mut mistakes)),
            None => (label, of_components(&rows, &mut mistakes)),
        };
        if tests.iter().any(|other: &Test| other.name() == name) {
            let valid = "one stress_type and one label for each test";
            mistakes.push(TableMistake::new(first, format!("there is a test `{name}` already"), valid));
        }
        if mistakes.len() == before {
            // Without any stress no component was measured.
            let lines = if lines.is_empty() { vec![first] } else { lines };
            tests.extend(test(&name, &table, measure, &lines, &mut mistakes));
        }
    }
    if mistakes.is_empty() { Ok(tests) } else { Err(mistakes) }
}

/// Whether F is that of a mode of stretches.
fn is_of(mode: Mode, deformation: &[[f64; 3]; 3]) -> bool {
    let stretch = deformation[0][0];
    let expected = mode.elongations(stretch).map(|x| x + 1.0);
    let is_same = |i: usize, j: usize| {
        let entry = if i == j { expected[i] } else { 0.0 };
        (deformation[i][j] - entry).abs() <= SAME_STRETCH * entry.max(1.0)
    };
    mode != Mode::SimpleShear && 0.0 < stretch && (0..3).all(|i| (0..3).all(|j| is_same(i, j)))
}

/// Stretch and stress along the first axis, with the line of each.
fn of_mode(mode: Mode, label: &str, rows: &[Tensors], mistakes: &mut Vec<TableMistake>) -> (Vec<u64>, Table) {
    let (mut lines, mut points) = (Vec::new(), Vec::new());
    for Tensors { line, deformation, stress } in rows {
        let stretch = deformation[0][0];
        if stretch <= 0.0 {
            mistakes.push(TableMistake::new(*line, format!("F11 is {stretch}"), "0 < F11"));
            continue;
        }
        if !is_of(mode, deformation) {
            let expected = mode.elongations(stretch).map(|x| x + 1.0);
            let what = format!("F is not that of the mode {label} at F11 = {stretch}");
            mistakes.push(TableMistake::new(*line, what, format!("the diagonal {}", words::numbers(&expected))));
        }
        check_sides(mode, label, *line, stress, mistakes);
        lines.push(*line);
        points.push([stretch, stress[0][0]]);
    }
    (lines, Table::of_mode(mode, points))
}

fn is_zero(stress: f64) -> bool {
    stress.abs() <= 0.0
}

/// The stresses beside S11 that a mode of stretches has: only S11 is fitted.
fn check_sides(mode: Mode, label: &str, line: u64, stress: &[[f64; 3]; 3], mistakes: &mut Vec<TableMistake>) {
    let first = stress[0][0];
    for (i, j) in (1..9).map(|k| (k / 3, k % 3)) {
        let found = stress[i][j];
        let is_across = (i, j) == (1, 1) && mode == Mode::Equibiaxial;
        let expected = if is_across { first } else { 0.0 };
        let share = if is_across { SAME_STRETCH } else { 0.0 };
        if share * first.abs() < (found - expected).abs() {
            let name = format!("S{}{}", i + 1, j + 1);
            let what = format!("{name} is {found}, which the mode {label} has not at S11 = {first}");
            mistakes.push(TableMistake::new(line, what, format!("{name} = {expected}")));
        }
    }
}

/// Every component that is not zero throughout, with the line of each; the third axis carries no stress.
fn of_components(rows: &[Tensors], mistakes: &mut Vec<TableMistake>) -> (Vec<u64>, Table) {
    let measured = |i: usize, j: usize| rows.iter().any(|row| 0.0 < row.stress[i][j].abs());
    let (mut lines, mut points) = (Vec::new(), Vec::new());
    for row in rows {
        let out_of_plane = row.stress[TRACTION_FREE][TRACTION_FREE];
        if 0.0 < out_of_plane.abs() {
            mistakes.push(TableMistake::new(
                row.line,
                format!("S33 is {out_of_plane}"),
                "a third face without traction",
            ));
        }
        let determinant = determinant(&row.deformation);
        if 1e-6 < (determinant - 1.0).abs() {
            let valid = "det F = 1, the material is incompressible";
            mistakes.push(TableMistake::new(row.line, format!("det F is {determinant}"), valid));
        }
        for (i, j) in (0..9).map(|k| (k / 3, k % 3)).filter(|&(i, j)| measured(i, j)) {
            lines.push(row.line);
            points.push(Component {
                deformation: row.deformation,
                component: [i, j],
                free: TRACTION_FREE,
                stress: row.stress[i][j],
            });
        }
    }
    (lines, Table::General(points))
}

fn determinant(f: &[[f64; 3]; 3]) -> f64 {
    nalgebra::Matrix3::from_fn(|i, j| f[i][j]).determinant()
}
