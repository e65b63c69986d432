//! Sheets that are pulled unequally both ways.

use piola_fit::solids::{Component, Measure, Table};

use super::names::{Quantity, find, not_used};
use super::{Found, number, push, test};
use crate::fitting::TableMistake;
use crate::sheet::Sheet;

/// The line, the weight and the components of a row.
type Point = (u64, Option<f64>, Vec<Component>);

/// λ₁, λ₂ with one or two stresses; the third axis carries none, and λ₃ = 1/(λ₁ λ₂).
pub(super) fn tests(sheet: &Sheet) -> Result<Found, Vec<TableMistake>> {
    let mut mistakes = Vec::new();
    let columns = |wanted: [Quantity; 2]| wanted.map(|wanted| find(sheet, wanted));
    let [Some(first), Some(second)] = columns([Quantity::FirstStretch, Quantity::SecondStretch]) else {
        let what = format!("one of the stretches is missing: the columns are {}", sheet.names());
        return Err(vec![TableMistake::new(sheet.header_line, what, "the columns lambda1 and lambda2")]);
    };
    let (nominal, truth) = (
        columns([Quantity::FirstStress, Quantity::SecondStress]),
        columns([Quantity::FirstTrueStress, Quantity::SecondTrueStress]),
    );
    let (measure, stresses) =
        if nominal == [None, None] { (Measure::Cauchy, truth) } else { (Measure::FirstPiola, nominal) };
    if stresses == [None, None] {
        return Err(vec![sheet.missing("stress", "P1 and P2, or sigma1 and sigma2 for Cauchy stresses")]);
    }
    let units: Vec<String> = stresses.into_iter().flatten().filter_map(|at| sheet.headings[at].unit.clone()).collect();
    if let [a, b] = units.as_slice()
        && a != b
    {
        return Err(vec![TableMistake::new(sheet.header_line, format!("the stresses are in {a} and {b}"), "one unit")]);
    }
    let [modes, specimens, weights] =
        [Quantity::Mode, Quantity::Specimen, Quantity::Weight].map(|wanted| find(sheet, wanted));
    let used = [Some(first), Some(second), stresses[0], stresses[1], modes, specimens, weights];
    let used: Vec<usize> = used.into_iter().flatten().collect();
    let mut groups: Vec<(String, Vec<Point>)> = Vec::new();
    for row in &sheet.rows {
        if let Some(mistake) = sheet.incomplete(row) {
            mistakes.push(mistake);
            continue;
        }
        let before = mistakes.len();
        let stretches =
            [(first, "lambda1"), (second, "lambda2")].map(|(at, name)| number(sheet, row, at, name, &mut mistakes));
        for (name, stretch) in ["lambda1", "lambda2"].into_iter().zip(stretches) {
            if stretch <= 0.0 {
                mistakes.push(TableMistake::new(row.line, format!("{name} is {stretch}"), format!("0 < {name}")));
            }
        }
        let [a, b] = stretches;
        let deformation = [[a, 0.0, 0.0], [0.0, b, 0.0], [0.0, 0.0, 1.0 / (a * b)]];
        let mut components = Vec::new();
        for (axis, at) in stresses.into_iter().enumerate() {
            let Some(at) = at else { continue };
            let stress = number(sheet, row, at, &sheet.headings[at].written, &mut mistakes);
            components.push(Component { deformation, component: [axis, axis], free: 2, stress });
        }
        let weight = weights.map(|column| number(sheet, row, column, "weight", &mut mistakes));
        if before < mistakes.len() {
            continue;
        }
        let label = |column: Option<usize>| column.and_then(|at| row.fields.get(at)).filter(|text| !text.is_empty());
        let name = match (label(modes), label(specimens)) {
            (Some(mode), Some(specimen)) => format!("{mode} {specimen}"),
            (Some(name), None) | (None, Some(name)) => name.to_owned(),
            (None, None) => "biaxial".to_owned(),
        };
        push(&mut groups, name, (row.line, weight, components));
    }
    let unit = units.into_iter().next();
    let mut found = Found { tests: Vec::new(), held_out: Vec::new(), unit, notes: Vec::new() };
    found.notes.extend(not_used(sheet, &used));
    if measure == Measure::Cauchy {
        found.notes.push("stresses are Cauchy stresses, force for each deformed area".to_owned());
    }
    for (name, rows) in groups {
        let weights: Vec<(u64, f64)> = rows.iter().filter_map(|(line, weight, _)| Some((*line, (*weight)?))).collect();
        let lines: Vec<u64> =
            rows.iter().flat_map(|(line, _, parts)| core::iter::repeat_n(*line, parts.len())).collect();
        let table = Table::General(rows.into_iter().flat_map(|(_, _, parts)| parts).collect());
        let made = test(&name, &table, measure, &lines, &mut mistakes);
        found.add(made, &weights, &mut mistakes);
    }
    if mistakes.is_empty() { Ok(found) } else { Err(mistakes) }
}
