//! What a loaded specimen writes.

use core::fmt::Write as _;

use piola_charts::{Folder, Panel, Written, figure};
use serde_json::json;

use crate::specimen::LoadedSpecimen;

/// Rows of the table for a reader, and points in a figure.
const ROWS: usize = 11;

/// A column as people read it.
fn spoken(name: &str, unit: &str) -> String {
    let name = name.replace('_', " ");
    if unit.is_empty() { name } else { format!("{name} ({})", unit.replace('^', "").replace("m3", "m³")) }
}

impl LoadedSpecimen {
    /// The index of a column.
    fn index(&self, name: &str) -> Option<usize> {
        self.columns.iter().position(|(other, _)| other == name)
    }

    /// The driven quantity, then the responses that a reader wants first.
    fn shown(&self) -> Vec<usize> {
        let asked = self.shown.iter().filter_map(|name| self.index(name)).filter(|&index| 0 < index);
        core::iter::once(0).chain(asked).collect()
    }

    /// A table for a reader.
    #[must_use]
    pub fn table(&self) -> String {
        let shown = self.shown();
        let mut text = format!("{} specimen\n\n", self.test);
        for &index in &shown {
            let (name, unit) = &self.columns[index];
            let _ = write!(text, "{:>22}", spoken(name, unit));
        }
        text.push('\n');
        let last = self.rows.len().saturating_sub(1);
        let mut written = None;
        for k in 0..ROWS {
            let row = k * last / (ROWS - 1);
            if written == Some(row) {
                continue;
            }
            written = Some(row);
            for &index in &shown {
                let _ = write!(text, "{:>22.6e}", self.rows[row][index]);
            }
            text.push('\n');
        }
        if let Some((value, why)) = &self.ended {
            let (name, unit) = &self.columns[0];
            let _ = write!(text, "\nThe path ends before {} = {value:.6e} {unit}: {why}\n", name.replace('_', " "));
        }
        text
    }

    /// The numbers of the last state, as they stand in `summary.json`.
    #[must_use]
    pub fn summary(&self) -> String {
        let last = self.rows.last().map_or(&[][..], Vec::as_slice);
        let state = self
            .columns
            .iter()
            .zip(last)
            .map(|((name, unit), value)| json!({ "name": name, "unit": unit, "value": value }));
        let summary = json!({
            "specimen": self.test,
            "solid": serde_json::to_value(&self.solid).unwrap_or_default(),
            "points": self.rows.len(),
            "ended": self.ended.as_ref().map(|(value, why)| json!({ "at": value, "why": why })),
            "last_state": state.collect::<Vec<_>>(),
        });
        let mut text = serde_json::to_string_pretty(&summary).unwrap_or_default();
        text.push('\n');
        text
    }

    /// Writes summary, table and figure.
    #[must_use]
    pub fn write(&self, folder: &Folder) -> Written {
        let heads = self.columns.iter().map(|(name, unit)| match *unit {
            "" => name.clone(),
            unit => format!("{name} [{unit}]"),
        });
        let mut csv = heads.collect::<Vec<_>>().join(",");
        csv.push('\n');
        for row in &self.rows {
            let _ = writeln!(csv, "{}", row.iter().map(|x| format!("{x:?}")).collect::<Vec<_>>().join(","));
        }
        let files = [("summary.json", self.summary()), ("specimen.csv", csv), ("specimen.svg", self.figure())];
        Written::of(folder, files)
    }

    /// What answers over what is changed.
    fn figure(&self) -> String {
        let abscissa = spoken(&self.columns[0].0, self.columns[0].1);
        let shown = self.shown();
        let panel = |&index: &usize| {
            let (name, unit) = &self.columns[index];
            let line: Vec<(f64, f64)> = self.rows.iter().map(|row| (row[0], row[index])).collect();
            Panel {
                name: name.replace('_', " "),
                axes: [abscissa.clone(), spoken(name, unit)],
                points: line.iter().step_by(line.len().div_ceil(ROWS - 1)).copied().collect(),
                curves: vec![line],
                is_curve: true,
            }
        };
        let panels: Vec<Panel> = shown[1..].iter().map(panel).collect();
        let rows = panels.len().div_ceil(2);
        let height = if rows < 2 { 420 } else { 760 };
        figure((860, height), &format!("{} specimen", self.test), &|area| {
            for (panel, part) in panels.iter().zip(area.split_evenly((rows, 2))) {
                panel.draw(&part)?;
            }
            Ok(())
        })
    }
}
