//! F and the stress by components.

use core::fmt::Write as _;

use piola_document::words;
use piola_fit::solids::{Component, Measure, Table, Test};
use piola_specimens::homogeneous::Mode;

use super::{mode, number, push, test};
use crate::fitting::TableMistake;
use crate::sheet::Sheet;

/// How far the stretches across may be from those of the mode.
const SAME_STRETCH: f64 = 1e-3;
const TRACTION_FREE: usize = 2;

fn components() -> Vec<String> {
    let name = |letter: char, k: usize| {
        let mut name = String::from(letter);
        let _ = write!(name, "{}{}", k / 3 + 1, k % 3 + 1);
        name
    };
    (0..9).map(|k| name('F', k)).chain((0..9).map(|k| name('S', k))).collect()
}

/// The columns of mode, stress type and components; nothing unless all are there.
pub(super) fn find(sheet: &Sheet) -> Option<Vec<usize>> {
    let at = |name: &str| sheet.headings.iter().position(|heading| heading.plain == name);
    let wanted = ["mode", "stress type"].map(str::to_owned).into_iter().chain(components());
    wanted.map(|name| at(&name.to_lowercase())).collect()
}

fn places(sheet: &Sheet) -> Vec<usize> {
    find(sheet).unwrap_or_default()
}

/// F and stress of a row.
struct Tensors {
    line: u64,
    deformation: [[f64; 3]; 3],
    stress: [[f64; 3]; 3],
}

pub(super) fn tests(sheet: &Sheet) -> Result<Vec<Test>, Vec<TableMistake>> {
    let mut mistakes = Vec::new();
    let mut groups: Vec<((String, Measure), Vec<Tensors>)> = Vec::new();
    let (names, places) = (components(), places(sheet));
    for row in &sheet.rows {
        if let Some(mistake) = sheet.incomplete(row) {
            mistakes.push(mistake);
            continue;
        }
        let measure = match row.fields[places[1]].to_ascii_lowercase().as_str() {
            "pk1" | "nominal" => Measure::FirstPiola,
            "cauchy" => Measure::Cauchy,
            other => {
                mistakes.push(TableMistake::new(row.line, format!("stress_type is `{other}`"), "PK1 or cauchy"));
                continue;
            }
        };
        let mut rows = |first: usize| {
            [0, 3, 6].map(|i| {
                [0, 1, 2].map(|j| number(sheet, row, places[2 + first + i + j], &names[first + i + j], &mut mistakes))
            })
        };
        let tensors = Tensors { line: row.line, deformation: rows(0), stress: rows(9) };
        push(&mut groups, (row.fields[places[0]].to_owned(), measure), tensors);
    }
    if !mistakes.is_empty() {
        return Err(mistakes);
    }
    let mut tests = Vec::new();
    for ((label, measure), rows) in groups {
        let first = rows.first().map_or(1, |row| row.line);
        // A label of a mode that none of its rows has is but a name.
        let is_of_all = |mode: &Mode| match label.to_ascii_lowercase().as_str() {
            // Most sheets pulled both ways are pulled unequally.
            "biaxial" | "bt" => rows.iter().all(|row| is_of(*mode, &row.deformation)),
            _ => rows.iter().any(|row| is_of(*mode, &row.deformation)),
        };
        let known = mode(&label).filter(is_of_all);
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
