//! What a recovered curve writes: summary, tables, figure.

use core::fmt::Write as _;

use piola_charts::{Folder, Written};
use piola_viscometry::recover::{Criterion, Monotonicity};
use serde_json::{Map, Value, json};

use super::recovery::{Correction, Point, RecoveredCurve, Recovery, assumption};
use super::{Answering, Measured, figure};

/// Rows of a table for a reader, and rows in a summary, at most; of more rows some are taken, evenly.
const SHOWN: usize = 80;
const LISTED: usize = 2000;

impl RecoveredCurve {
    /// The numbers, as they stand in `summary.json`.
    fn summary(&self) -> Value {
        let rising = match self.monotonicity {
            Monotonicity::Rising => json!(true),
            Monotonicity::Falling { from, to } => {
                json!({ "falls_from": from, "to": to, "between_lines": self.falls_between_lines })
            }
        };
        let [(abscissa, _), (value, _)] = self.function.axes();
        let point = |point: &Point| {
            let mut fields = Map::new();
            fields.insert(abscissa.into(), json!(point.at));
            fields.insert(value.into(), json!(point.value));
            fields.insert("band".into(), json!(point.band));
            fields.insert("determined".into(), json!(point.is_determined()));
            Value::Object(fields)
        };
        json!({
            "confidence_of_band": self.confidence,
            "band_is": "simultaneous",
            "band_of": value,
            "smoothing": serde_json::to_value(&self.smoothing).unwrap_or_default(),
            "below_the_smallest_drive": serde_json::to_value(self.below_smallest).unwrap_or_default(),
            "rises": rising,
            "rows": self.rows.len(),
            "points": self.rows.iter().step_by(self.rows.len().div_ceil(LISTED).max(1)).map(point).collect::<Vec<_>>(),
        })
    }

    /// A table for a reader: one line a row.
    fn table(&self) -> String {
        let mut text = String::new();
        for (index, smoothing) in self.smoothing.iter().enumerate() {
            let which = if 1 < self.smoothing.len() { format!("table {}: ", index + 1) } else { String::new() };
            let criterion = match smoothing.criterion {
                Criterion::Interpolation => "interpolated between all rows",
                Criterion::KnownNoise => "smoothed for the stated noise",
                _ => "smoothed by generalised cross-validation",
            };
            let _ = writeln!(text, "{which}{criterion}, noise {:.1e} of the response", smoothing.noise);
        }
        if let Some(assumed) = assumption(self.below_smallest) {
            let _ = writeln!(text, "assumed below the smallest torque: {assumed}");
        }
        let [(abscissa, unit), (value, other)] = self.function.axes();
        if let Monotonicity::Falling { from, to } = self.monotonicity {
            let why = if self.function.is_flow_curve() { ": no steady shear is stable there" } else { "" };
            let of = self.falls_between_lines.map(|[a, b]| format!(", lines {a} and {b} of the table"));
            let of = of.unwrap_or_default();
            let _ = writeln!(text, "{value} falls between {from:.4e} and {to:.4e} {unit}{of}{why}");
        }
        let _ = write!(text, "\n{:>18}  {:>30}", format!("{abscissa} {unit}"), format!("{value} {other}"));
        if self.function.is_flow_curve() {
            let _ = write!(text, "{:>16}", "viscosity Pa s");
        }
        let _ = writeln!(text, "  band of the whole curve, {:.0} %", 100.0 * self.confidence);
        let stride = self.rows.len().div_ceil(SHOWN).max(1);
        for point in self.rows.iter().step_by(stride) {
            let _ = write!(text, "{:>18.5e}  {:>30.5e}", point.at, point.value);
            if self.function.is_flow_curve() {
                let _ = write!(text, "{:>16.5e}", self.function.viscosity(point));
            }
            match point.band {
                Some(_) if !point.is_determined() => {
                    text.push_str("  not determined: the band reaches by more than a factor of ten");
                }
                Some([low, high]) => {
                    let _ = write!(text, "  [{low:.5e}, {high:.5e}]");
                }
                None => {}
            }
            text.push('\n');
        }
        if 1 < stride {
            let _ = writeln!(text, "every {stride}th of {} rows is shown", self.rows.len());
        }
        text.push_str(
            "The band holds the whole curve at once with that confidence; an interval for a single row would be narrower.\n",
        );
        text
    }

    /// Its points, closely, as CSV.
    fn csv(&self) -> String {
        let [(abscissa, unit), (value, other)] = self.function.axes();
        let mut text = format!("{abscissa} [{unit}],{value} [{other}],low [{other}],high [{other}]");
        text.push_str(if self.function.is_flow_curve() { ",viscosity [Pa s]\n" } else { "\n" });
        for point in &self.points {
            let [low, high] = point.band.unwrap_or([f64::NAN; 2]);
            let _ = write!(text, "{:?},{:?},{low:?},{high:?}", point.at, point.value);
            if self.function.is_flow_curve() {
                let _ = write!(text, ",{:?}", self.function.viscosity(point));
            }
            text.push('\n');
        }
        text
    }
}

impl Correction {
    /// Its points, as CSV.
    fn csv(&self) -> String {
        let error = |error: Option<f64>| error.map_or_else(String::new, |error| format!("{error:?}"));
        let mut text = String::new();
        match self {
            Self::Slip(slip) => {
                text.push_str(
                    "wall_stress [Pa],slip_velocity [m/s],standard error [m/s],apparent_rate without slip [1/s]\n",
                );
                for p in &slip.points {
                    let (stress, speed, rate) = (p.wall_stress, p.slip_velocity, p.apparent_rate);
                    let _ = writeln!(text, "{stress:?},{speed:?},{},{rate:?}", error(p.slip_error));
                }
            }
            Self::Ends(ends) => {
                text.push_str(
                    "discharge [m^3/s],wall_stress [Pa],end_pressure [Pa],standard error [Pa],end_length [radii]\n",
                );
                for p in &ends.points {
                    let (q, stress, lost, length) = (p.discharge, p.wall_stress, p.end_pressure, p.end_length);
                    let _ = writeln!(text, "{q:?},{stress:?},{lost:?},{},{length:?}", error(p.end_error));
                }
            }
        }
        text
    }

    /// A table for a reader.
    fn table(&self) -> String {
        let error = |error: Option<f64>| error.map_or_else(String::new, |error| format!(" ± {error:.1e}"));
        let mut text = String::new();
        match self {
            Self::Slip(slip) => {
                let _ = writeln!(text, "\n{:>14}  slip m/s (standard error by what Mooney's line leaves)", "stress Pa");
                for p in &slip.points {
                    let _ = writeln!(text, "{:>14.5e}  {:.5e}{}", p.wall_stress, p.slip_velocity, error(p.slip_error));
                }
            }
            Self::Ends(ends) => {
                let _ = writeln!(
                    text,
                    "\n{:>14}  pressure lost at the ends Pa (standard error by what Bagley's line leaves), in radii",
                    "stress Pa"
                );
                for p in &ends.points {
                    let (stress, lost, length) = (p.wall_stress, p.end_pressure, p.end_length);
                    let _ = writeln!(text, "{stress:>14.5e}  {lost:.5e}{}, {length:.3}", error(p.end_error));
                }
            }
        }
        text
    }
}

impl Recovery {
    /// Rows at which nothing is recovered, or nothing is known to a factor of ten.
    #[must_use]
    pub fn lost(&self) -> usize {
        let unknown = |curve: &RecoveredCurve| curve.rows.iter().filter(|point| !point.is_determined()).count();
        self.curves.iter().map(|curve| curve.lost + unknown(curve)).sum()
    }

    /// Why the first of the lost rows is lost, in words.
    #[must_use]
    pub fn why_lost(&self) -> Option<String> {
        let why = self.curves.iter().find_map(|curve| curve.why_lost.as_ref());
        why.map(ToString::to_string).or_else(|| {
            (0 < self.lost()).then(|| "the band reaches by more than a factor of ten on each side".to_owned())
        })
    }

    /// The numbers, as they stand in `summary.json`.
    #[must_use]
    pub fn summary(&self, tables: &[Measured]) -> String {
        let data: Vec<Value> = tables
            .iter()
            .map(|measured| json!({ "path": measured.path.display().to_string(), "rows": measured.rows().len() }))
            .collect();
        let mut summary = Map::new();
        summary.insert("data".into(), Value::Array(data));
        summary.insert("flow".into(), json!(tables.first().map(|measured| measured.flow.kind().name())));
        for curve in &self.curves {
            summary.insert(curve.function.name().replace('-', "_"), curve.summary());
        }
        match &self.correction {
            Some(Correction::Slip(slip)) => {
                summary.insert("slip".into(), serde_json::to_value(&slip.points).unwrap_or_default());
            }
            Some(Correction::Ends(ends)) => {
                summary.insert("ends".into(), serde_json::to_value(&ends.points).unwrap_or_default());
            }
            None => {}
        }
        let mut text = serde_json::to_string_pretty(&Value::Object(summary)).unwrap_or_default();
        text.push('\n');
        text
    }

    /// A table for a reader: one line a row.
    #[must_use]
    pub fn table(&self, tables: &[Measured]) -> String {
        let mut text = String::new();
        for measured in tables {
            let _ = writeln!(text, "{}", measured.merged().heading());
        }
        for curve in &self.curves {
            text.push_str(&curve.table());
        }
        if let Some(correction) = &self.correction {
            text.push_str(&correction.table());
        }
        text
    }

    /// Writes summary, tables and figures.
    #[must_use]
    pub fn write(&self, folder: &Folder, tables: &[Measured]) -> Written {
        let mut files = vec![("summary.json", self.summary(tables))];
        for curve in &self.curves {
            let [csv, svg, residuals] = if curve.function.is_flow_curve() {
                ["flow-curve.csv", "flow-curve.svg", "residuals.csv"]
            } else {
                ["normal-stress.csv", "normal-stress.svg", "normal-stress-residuals.csv"]
            };
            files.push((csv, curve.csv()));
            if let (Some(measured), Some(what)) = (tables.first(), curve.answering) {
                let merged = measured.merged();
                files.push((residuals, of_residuals(&merged, curve, what)));
                files.push((svg, figure::recovery(&merged, curve, what)));
            }
        }
        if let (Some(correction), Some(curve)) = (&self.correction, self.curves.first()) {
            let name = if matches!(correction, Correction::Slip(_)) { "slip.csv" } else { "ends.csv" };
            files.push((name, correction.csv()));
            files.push(("flow-curve.svg", figure::correction(tables, curve, correction)));
        }
        Written::of(folder, files)
    }
}

/// The rows of a column with their residuals, as CSV.
fn of_residuals(measured: &Measured, curve: &RecoveredCurve, what: Answering) -> String {
    let [drive, response] = measured.columns(what);
    let mut text = format!("{drive},{response},relative residual\n");
    let answer = measured.answers.iter().find(|answer| answer.what == what);
    for (answer, ([drive, response], residual)) in
        answer.into_iter().flat_map(|answer| answer.rows.iter().zip(&curve.residuals).map(move |row| (answer, row)))
    {
        let _ = writeln!(text, "{drive:?},{:?},{residual:?}", answer.sign() * response);
    }
    text
}
