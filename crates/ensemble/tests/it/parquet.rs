//! The table of members in Parquet, read back: the values of the CSV.

use std::fs::File;
use std::path::Path;

use parquet::file::reader::{FileReader as _, SerializedFileReader};
use parquet::record::Field;
use piola_ensemble::{Ensemble, Options, Results};

use crate::journal::{Folder, ensemble, orbit, run};

/// The heads of a table and its rows, numbers as their bits.
type Table = (Vec<String>, Vec<Vec<Cell>>);

#[derive(Debug, PartialEq, Eq)]
enum Cell {
    Empty,
    Number(u64),
    Text(String),
}

fn of_parquet(path: &Path) -> Table {
    let file = File::open(path).unwrap_or_else(|error| panic!("{error}"));
    let reader = SerializedFileReader::new(file).unwrap_or_else(|error| panic!("{error}"));
    let schema = reader.metadata().file_metadata().schema();
    let heads = schema.get_fields().iter().map(|field| field.name().to_owned()).collect();
    let rows = reader.get_row_iter(None).unwrap_or_else(|error| panic!("{error}"));
    let cell = |field: &Field| match field {
        Field::Null => Cell::Empty,
        #[expect(clippy::cast_precision_loss, reason = "the number of a member")]
        Field::Long(member) => Cell::Number((*member as f64).to_bits()),
        Field::Double(value) => Cell::Number(value.to_bits()),
        Field::Str(text) => Cell::Text(text.clone()),
        other => panic!("{other:?}"),
    };
    let rows = rows.map(|row| row.unwrap_or_else(|error| panic!("{error}")));
    (heads, rows.map(|row| row.get_column_iter().map(|(_, field)| cell(field)).collect()).collect())
}

/// Without quotes, which these tables do not need.
fn of_csv(text: &str) -> Table {
    let mut lines = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let heads = lines.next().into_iter().flatten().map(str::to_owned).collect();
    let cell = |text: &&str| match (text.is_empty(), text.parse::<f64>()) {
        (true, _) => Cell::Empty,
        (false, Ok(value)) => Cell::Number(value.to_bits()),
        (false, Err(_)) => Cell::Text((*text).to_owned()),
    };
    (heads, lines.map(|line| line.iter().map(cell).collect()).collect())
}

fn compare(ensemble: &Ensemble, name: &str) -> Table {
    let folder = Folder::new(name);
    run(ensemble, &folder, Options::default());
    let results = Results::collect(ensemble, folder.path()).unwrap_or_else(|error| panic!("{error}"));
    let content = results.parquet().unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(results.parquet().as_ref(), Ok(&content));
    let path = folder.path().join("members.parquet");
    std::fs::write(&path, content).unwrap_or_else(|error| panic!("{error}"));
    let found = of_parquet(&path);
    assert_eq!(found, of_csv(&results.table()));
    found
}

#[test]
fn parquet_has_the_columns_and_the_bits_of_the_csv() {
    let (heads, rows) = compare(&ensemble(), "parquet");
    assert_eq!(heads[..3], ["member", "body.comet.semi_major_axis", "body.comet.eccentricity"]);
    assert_eq!(rows.len(), 40);
    assert!(rows.iter().all(|row| row.last() == Some(&Cell::Empty)));
}

/// An eccentricity beyond 1 is no ellipse.
#[test]
fn members_that_fail_have_null_in_parquet_and_say_why() {
    let ranges = vec!["body.comet.eccentricity=0.5:1.5:3".parse().unwrap_or_else(|error| panic!("{error}"))];
    let ensemble = Ensemble::new(orbit(), ranges, Vec::new(), 1, 0).unwrap_or_else(|error| panic!("{error}"));
    let (_, rows) = compare(&ensemble, "parquet-failing");
    assert_eq!(rows[2][1], Cell::Number(1.5_f64.to_bits()));
    assert_eq!(rows[2][2], Cell::Empty);
    assert!(matches!(rows[2].last(), Some(Cell::Text(why)) if !why.is_empty()));
}
