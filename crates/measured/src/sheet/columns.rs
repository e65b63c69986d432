//! Columns of a table by their names, with their units.

use piola_document::units::Dimension;

use super::{Sheet, spelled, units_of, unknown};
use crate::fitting::TableMistake;

/// A column of numbers, and how they become SI.
#[derive(Clone, Copy)]
pub(crate) struct NumberColumn {
    pub(crate) at: usize,
    pub(crate) factor: f64,
}

impl Sheet {
    /// The column of a quantity, by its names; two of them are a mistake.
    pub(crate) fn column(&self, names: &[&str]) -> Result<Option<usize>, TableMistake> {
        let found: Vec<usize> = self.columns(&|plain| names.contains(&plain)).collect();
        match found.as_slice() {
            [] => Ok(None),
            [only] => Ok(Some(*only)),
            several => {
                let written: Vec<String> =
                    several.iter().map(|&at| format!("`{}`", self.headings[at].written)).collect();
                let what = format!("{} columns are the {}: {}", several.len(), names[0], written.join(", "));
                Err(TableMistake::new(self.header_line, what, "one such column; rename the others"))
            }
        }
    }

    /// The mistake of a table without a column of a quantity.
    pub(crate) fn missing(&self, what: &str, valid: &'static str) -> TableMistake {
        let what = format!("no column is a {what}: the columns are {}", self.names());
        TableMistake::new(self.header_line, what, valid)
    }

    /// A column with its unit. Without one it is in SI, and a note says so. `valid` are the units in words.
    pub(crate) fn in_units(
        &self,
        at: usize,
        dimension: Dimension,
        (si, valid): (&str, &str),
        notes: &mut Vec<String>,
    ) -> Result<NumberColumn, TableMistake> {
        let heading = &self.headings[at];
        let Some(text) = heading.unit.as_deref() else {
            notes.push(format!("`{}` has no unit: read as {si}", heading.written));
            return Ok(NumberColumn { at, factor: 1.0 });
        };
        let unit = spelled(text).filter(|unit| unit.dimension == dimension);
        let unit = unit.ok_or_else(|| TableMistake::new(self.header_line, unknown(text), valid))?;
        Ok(NumberColumn { at, factor: unit.to_si(1.0) })
    }
}

/// The names of all units of a quantity: "one of mPa, Pa, …"; its SI unit where there is no list.
pub(crate) fn valid_units(dimension: Dimension, si: &str) -> String {
    let units = units_of(dimension);
    if units.is_empty() { si.to_owned() } else { format!("one of {units}") }
}
