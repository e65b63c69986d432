//! Tables of time, stretch and stress.

use std::collections::HashMap;

use piola_document::units::Dimension;
use piola_fit::FitError;
use piola_fit::history::HistoryTest;
use piola_fit::sides::Loading;

use crate::fitting::TableMistake;
use crate::measured_tests::{MeasuredTests, Tabulated, TestsAndNotes};
use crate::sheet::{NumberColumn, Row, Sheet};
use crate::sides::columns::{self as words, Column};

/// Tests of one material along time.
///
/// # Example
/// ```
/// use piola_measured::history::HistoryMeasurements;
/// let text = "time [min],strain [%],stress [kPa]\n0,0,0\n1,10,5\n2,10,4\n";
/// let measurements = HistoryMeasurements::parse("skin.csv", text)?;
/// assert_eq!(measurements.tests[0].rows(), [[0.0, 1.0, 0.0], [60.0, 1.1, 5.0], [120.0, 1.1, 4.0]]);
/// assert_eq!(measurements.unit.as_deref(), Some("kPa"));
/// let wrong = HistoryMeasurements::parse("skin.csv", "time [s],stretch,stress\n2,1.1,2\n1,1.2,3\n");
/// assert!(wrong.unwrap_err().to_string().starts_with("skin.csv:3: "));
/// # Ok::<(), piola_measured::MeasuredError>(())
/// ```
pub type HistoryMeasurements = MeasuredTests<HistoryTest>;

impl Tabulated for HistoryTest {
    fn tests(text: &str) -> Result<TestsAndNotes<Self>, Vec<TableMistake>> {
        tests(text)
    }
}

const TIME: &[&str] = &["time", "t"];
const SPECIMEN: &[&str] = &["specimen", "sample"];
const SHEAR: &[&str] = &["shear", "amount of shear", "shear strain", "gamma", "γ"];

fn is_known(plain: &str) -> bool {
    let names = [TIME, SPECIMEN, SHEAR, words::MODE, words::STRETCH, words::STRAIN, words::STRESS];
    names.iter().any(|names| names.contains(&plain))
}

/// The rows of one test, with the line of each.
struct Group {
    loading: Loading,
    specimen: String,
    rows: Vec<(u64, [f64; 3])>,
}

fn tests(text: &str) -> Result<TestsAndNotes<HistoryTest>, Vec<TableMistake>> {
    let sheet = Sheet::parse(text, &is_known)?;
    let one = |mistake| vec![mistake];
    let missing = |what: &str, valid: &'static str| vec![sheet.missing(what, valid)];
    let mut notes = Vec::new();
    let find = |names: &[&str]| sheet.column(names).map_err(one);
    let time = find(TIME)?.ok_or_else(|| missing("time", "a column `time [s]`"))?;
    let time = sheet.in_units(time, Dimension::TIME, ("s", "s, ms, min or h"), &mut notes).map_err(one)?;
    let shear = find(SHEAR)?;
    let along = match shear {
        Some(_) => Column::of(&sheet, SHEAR, &[]),
        None => Column::of(&sheet, words::STRETCH, words::STRAIN),
    };
    let along = along.map_err(one)?;
    let along = along.ok_or_else(|| {
        missing("stretch or a strain", "`stretch`, `strain [%]`, or in simple shear `amount of shear`")
    })?;
    let stress = find(words::STRESS)?.ok_or_else(|| missing("stress", "a column `stress [MPa]`"))?;
    let unit = words::stress_unit(&sheet, stress).map_err(one)?;
    let (mode, specimen) = (find(words::MODE)?, find(SPECIMEN)?);
    let mut mistakes = Vec::new();
    let mut groups: Vec<Group> = Vec::new();
    let mut places: HashMap<(&str, String), usize> = HashMap::new();
    for row in &sheet.rows {
        let loading = match (mode, shear) {
            (None, Some(_)) => Ok(Loading::SimpleShear),
            _ => words::loading(row, mode),
        };
        let read = loading.and_then(|loading| Ok((loading, numbers(&sheet, row, time, along, stress)?)));
        let (loading, [t, x, p]) = match read {
            Ok(read) => read,
            Err(mistake) => {
                mistakes.push(mistake);
                continue;
            }
        };
        let specimen = specimen.and_then(|at| row.fields.get(at)).unwrap_or_default();
        let point = (row.line, [t, along.stretch(x, loading), p]);
        let place = *places.entry((loading.name(), specimen.to_owned())).or_insert(groups.len());
        if place == groups.len() {
            groups.push(Group { loading, specimen: specimen.to_owned(), rows: Vec::new() });
        }
        groups[place].rows.push(point);
    }
    let mut tests = Vec::new();
    for Group { loading, specimen, rows } in groups {
        let name =
            if specimen.is_empty() { loading.name().to_owned() } else { format!("{} {specimen}", loading.name()) };
        let numbers: Vec<[f64; 3]> = rows.iter().map(|(_, numbers)| *numbers).collect();
        match HistoryTest::new(&*name, loading, &numbers) {
            Ok(test) => tests.push(test),
            Err(error) => {
                let index = match error {
                    FitError::TimeOutOfOrder { index, .. }
                    | FitError::StretchNotPositive { index, .. }
                    | FitError::StressNotFinite { index, .. } => index,
                    _ => 0,
                };
                let line = rows.get(index).map_or(sheet.header_line, |(line, _)| *line);
                let valid = "uniaxial, equibiaxial, planar or simple shear; times that do not fall; 0 < stretch";
                mistakes.push(TableMistake::new(line, error.to_string(), valid));
            }
        }
    }
    if tests.is_empty() && mistakes.is_empty() {
        mistakes.push(TableMistake::new(sheet.last, "the table has a header and no rows", "a row for each point"));
    }
    if !mistakes.is_empty() {
        return Err(mistakes);
    }
    if along.is_strain {
        notes.push("strains are engineering strains: stretch = 1 + strain".to_owned());
    }
    Ok((unit, tests, notes))
}

/// Time in seconds, deformation and stress of a row.
fn numbers(
    sheet: &Sheet,
    row: &Row,
    time: NumberColumn,
    along: Column,
    stress: usize,
) -> Result<[f64; 3], TableMistake> {
    let number = |at: usize| {
        let text = row.fields.get(at).unwrap_or_default();
        let wrong = || {
            let what = format!("`{}` is `{text}`", sheet.headings[at].written);
            TableMistake::new(row.line, what, "a finite number")
        };
        sheet.number(text).ok_or_else(wrong)
    };
    Ok([time.factor * number(time.at)?, number(along.at)?, number(stress)?])
}
