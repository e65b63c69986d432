//! Tables of tests with sides.

use piola_fit::sides::{Loading, SidesTest};

use super::columns::{
    ANGLE, Column, MODE, SIDE, SIDE_STRAIN, STRAIN, STRESS, STRETCH, field, is_known, loading, stress_unit,
};
use crate::fitting::TableMistake;
use crate::measured_tests::{MeasuredTests, Tabulated, TestsAndNotes};
use crate::sheet::{Row, Sheet};

/// Tests of one material.
///
/// # Example
/// ```
/// use piola_measured::sides::SidesMeasurements;
/// let text = "angle,strain [%],stress [kPa],lateral strain [%]\n0,10,5,-4\n0,20,14,\n90,10,3,-5\n";
/// let measurements = SidesMeasurements::parse("skin.csv", text)?;
/// assert_eq!((measurements.tests.len(), measurements.unit.as_deref()), (2, Some("kPa")));
/// assert_eq!(measurements.tests[0].rows()[0], (1.1, 5.0, Some(0.96)));
/// let strip = SidesMeasurements::parse("skin.csv", "angle,stretch,stress\n45,1.1,2\n")?;
/// assert_eq!(strip.tests[0].angle(), core::f64::consts::FRAC_PI_4);
/// let wrong = SidesMeasurements::parse("skin.csv", "angle,stretch,stress\n120,1.1,2\n");
/// assert!(wrong.unwrap_err().to_string().starts_with("skin.csv:2: "));
/// # Ok::<(), piola_measured::MeasuredError>(())
/// ```
pub type SidesMeasurements = MeasuredTests<SidesTest>;

impl Tabulated for SidesTest {
    fn tests(text: &str) -> Result<TestsAndNotes<Self>, Vec<TableMistake>> {
        tests(text)
    }
}

/// Stretch, stress and lateral stretch.
type Point = (f64, f64, Option<f64>);

fn tests(text: &str) -> Result<TestsAndNotes<SidesTest>, Vec<TableMistake>> {
    let sheet = Sheet::parse(text, &is_known)?;
    let one = |mistake| vec![mistake];
    let missing = |what: &str, valid: &'static str| vec![sheet.missing(what, valid)];
    let along = Column::of(&sheet, STRETCH, STRAIN).map_err(one)?;
    let along =
        along.ok_or_else(|| missing("stretch or a strain", "a column `stretch`, `strain [%]` or `strain [-]`"))?;
    let side = Column::of(&sheet, SIDE, SIDE_STRAIN).map_err(one)?;
    let find = |names: &[&str]| sheet.column(names).map_err(one);
    let stress = find(STRESS)?.ok_or_else(|| missing("stress", "a column `stress [MPa]`"))?;
    let (modes, angles) = (find(MODE)?, find(ANGLE)?);
    if modes.is_none() && angles.is_none() {
        return Err(missing("mode or an angle", "a column `mode`, or a column `angle` of uniaxial specimens"));
    }
    let unit = stress_unit(&sheet, stress).map_err(one)?;
    let mut mistakes = Vec::new();
    let mut groups: Vec<(Loading, f64, u64, Vec<Point>)> = Vec::new();
    for row in &sheet.rows {
        let (loading, degrees) = match specimen(&sheet, row, modes, angles) {
            Ok(specimen) => specimen,
            Err(mistake) => {
                mistakes.push(mistake);
                continue;
            }
        };
        let mut number = |at: usize, name: &str| {
            let text = row.fields.get(at).unwrap_or_default();
            let found = sheet.number(text);
            if found.is_none() {
                mistakes.push(TableMistake::new(row.line, format!("{name} is `{text}`"), "a finite number"));
            }
            found
        };
        let (x, p) = (number(along.at, "stretch"), number(stress, "stress"));
        let given = side.filter(|side| row.fields.get(side.at).is_some_and(|text| !text.trim().is_empty()));
        let lateral = given.map(|side| (side, number(side.at, "lateral stretch")));
        let (Some(x), Some(p)) = (x, p) else { continue };
        let lateral = lateral.and_then(|(side, x)| Some(side.stretch(x?, Loading::Uniaxial)));
        let x = along.stretch(x, loading);
        for (name, value) in [("stretch", Some(x)), ("lateral stretch", lateral)] {
            let value = value.filter(|value| *value <= 0.0 && (name != "stretch" || loading != Loading::SimpleShear));
            if let Some(value) = value {
                let hint = "0 < stretch; strains are in a column `strain` or `lateral strain`";
                mistakes.push(TableMistake::new(row.line, format!("the {name} is {value}"), hint));
            }
        }
        let is_same = |other: Loading, angle: f64| other == loading && angle.total_cmp(&degrees).is_eq();
        match groups.iter_mut().find(|(other, angle, ..)| is_same(*other, *angle)) {
            Some((.., points)) => points.push((x, p, lateral)),
            None => groups.push((loading, degrees, row.line, vec![(x, p, lateral)])),
        }
    }
    if !mistakes.is_empty() {
        return Err(mistakes);
    }
    let mut found = Vec::new();
    for (loading, degrees, line, points) in groups {
        let test = if 0.0 < degrees {
            SidesTest::strip(format!("strip at {degrees}°"), degrees.to_radians(), &points)
        } else {
            SidesTest::new(loading.name(), loading, &points)
        };
        found.push(test.map_err(|error| vec![TableMistake::new(line, error.to_string(), "a test of a material")])?);
    }
    if found.is_empty() {
        return Err(vec![TableMistake::new(sheet.last, "the table has a header and no rows", "a row for each point")]);
    }
    let mut notes = Vec::new();
    if along.is_strain {
        notes.push("strains are engineering strains: stretch = 1 + strain".to_owned());
    }
    let used: Vec<usize> =
        [Some(along.at), side.map(|side| side.at), Some(stress), modes, angles].into_iter().flatten().collect();
    let headings = sheet.headings.iter().enumerate();
    let others: Vec<String> = headings
        .filter(|(at, heading)| !used.contains(at) && !heading.written.is_empty())
        .map(|(_, heading)| format!("`{}`", heading.written))
        .collect();
    if !others.is_empty() {
        notes.push(format!("columns not used: {}", others.join(", ")));
    }
    Ok((unit, found, notes))
}

/// The loading of a row, and the angle of a strip between the axes, degrees.
fn specimen(
    sheet: &Sheet,
    row: &Row,
    modes: Option<usize>,
    angles: Option<usize>,
) -> Result<(Loading, f64), TableMistake> {
    let mode = loading(row, modes)?;
    let Some(text) = field(row, angles) else { return Ok((mode, 0.0)) };
    match (mode, sheet.number(text).map(f64::abs)) {
        (Loading::Uniaxial, Some(angle)) if (angle - 90.0).abs() <= 0.0 => Ok((Loading::Transverse, 0.0)),
        (Loading::Uniaxial, Some(angle)) if angle < 90.0 => Ok((Loading::Uniaxial, angle)),
        _ => {
            let what = format!("a {} specimen at the angle `{text}`", mode.name());
            Err(TableMistake::new(row.line, what, "a uniaxial specimen at 0 to 90 degrees from axis 1"))
        }
    }
}
