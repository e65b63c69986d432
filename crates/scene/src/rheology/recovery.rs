//! Flow curves out of discharges and speeds.

use core::fmt::Write as _;

use piola_viscometry::recover::{
    self, BelowSmallest, FlowCurve, FlowCurvePoint, FlowTable, Monotonicity, Noise, Options, Rise,
};
use serde_json::json;

use super::{Flow, Measured, figure};
use crate::SceneError;
use crate::output::{Folder, Written};

/// Points of a curve between the first and the last row.
const POINTS: u32 = 160;

/// How to recover.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct RecoveryRequest {
    /// The probability that the band holds the whole curve.
    pub confidence: f64,
    /// What is known of the noise.
    pub noise: Noise,
    /// What to do about a curve that does not rise.
    pub rise: Rise,
}

impl Default for RecoveryRequest {
    fn default() -> Self {
        Self { confidence: 0.95, noise: Noise::Estimated, rise: Rise::Reported }
    }
}

/// A flow curve with what it was recovered by.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Recovery {
    /// The curve with its band.
    pub curve: FlowCurve,
    /// Its points at the rows.
    pub rows: Vec<FlowCurvePoint>,
    /// Its points, closely.
    pub points: Vec<FlowCurvePoint>,
}

/// The flow curve of a table of discharges or speeds.
///
/// # Errors
/// [`SceneError::Table`] with the line of a row, [`SceneError::Viscometry`], [`SceneError::Argument`] for a table that is a flow curve
/// already.
///
/// # Example
/// ```
/// use piola_scene::rheology::{FlowKind, Measured, RecoveryRequest, recover};
/// let mut text = String::from("# radius: 1 m\npressure_gradient,discharge\n");
/// for c in 1..=12 {
///     text += &format!("{c},{}\n", core::f64::consts::PI * f64::from(c) / 16.0); // a Newtonian fluid of viscosity 2
/// }
/// let measured = Measured::parse("pipe.csv", &text, FlowKind::Pipe, &[])?;
/// let recovery = recover(&measured, &RecoveryRequest::default())?;
/// assert!((recovery.curve.viscosity(3.0)? - 2.0).abs() < 1e-10);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn recover(measured: &Measured, request: &RecoveryRequest) -> Result<Recovery, SceneError> {
    let options = Options { rise: request.rise, ..Options::default() };
    let rows = &measured.rows;
    let curve = match measured.flow {
        Flow::Pipe { radius } => FlowTable::pipe(radius, rows)
            .and_then(|table| recover::pipe_with(&table.with_noise(request.noise)?, options)),
        Flow::Channel { half_width } => FlowTable::channel(half_width, rows)
            .and_then(|table| recover::channel_with(&table.with_noise(request.noise)?, options)),
        Flow::Couette { inner_radius, outer_radius } => FlowTable::couette(inner_radius, outer_radius, rows)
            .and_then(|table| recover::couette_with(&table.with_noise(request.noise)?, options)),
        Flow::Curve => {
            return Err(SceneError::Argument { argument: "--flow curve".into(), valid: "pipe, channel or couette" });
        }
    };
    let curve = curve.and_then(|curve| curve.with_band(request.confidence)).map_err(|error| measured.refused(error))?;
    let rows: Vec<FlowCurvePoint> = curve.points().filter_map(Result::ok).collect();
    let ends = rows.first().zip(rows.last()).map(|(first, last)| (first.shear_stress, last.shear_stress));
    let Some((low, high)) = ends else {
        let at = curve.points().find_map(Result::err);
        return Err(at.map_or(SceneError::Argument { argument: measured.name(), valid: "rows" }, SceneError::from));
    };
    let point = |k: u32| {
        let share = f64::from(k) / f64::from(POINTS);
        curve.at((low * (high / low).powf(share)).clamp(low, high)).ok()
    };
    let points = (0..=POINTS).filter_map(point).collect();
    Ok(Recovery { curve, rows, points })
}

impl Recovery {
    /// The numbers, as they stand in `summary.json`.
    #[must_use]
    pub fn summary(&self, measured: &Measured) -> String {
        let below = serde_json::to_value(self.curve.below_smallest()).unwrap_or_default();
        let rising = match self.curve.monotonicity() {
            Monotonicity::Rising => json!(true),
            Monotonicity::Falling { from, to } => json!({ "falls_from": from, "to": to }),
        };
        let summary = json!({
            "data": measured.path.display().to_string(),
            "flow": measured.flow.kind().name(),
            "rows": measured.rows.len(),
            "recovered": self.rows.len(),
            "confidence_of_band": self.curve.confidence(),
            "smoothing": serde_json::to_value(self.curve.smoothing()).unwrap_or_default(),
            "below_the_smallest_drive": below,
            "rises": rising,
            "flow_curve": serde_json::to_value(&self.rows).unwrap_or_default(),
        });
        let mut text = serde_json::to_string_pretty(&summary).unwrap_or_default();
        text.push('\n');
        text
    }

    /// A table for a reader: one line a row.
    #[must_use]
    pub fn table(&self, measured: &Measured) -> String {
        let mut text = String::new();
        let smoothing = self.curve.smoothing();
        let confidence = self.curve.confidence().map_or(0.0, |share| 100.0 * share);
        let _ = writeln!(text, "{}: {} rows of {}", measured.name(), measured.rows.len(), measured.flow.kind().name());
        let _ = writeln!(text, "smoothed by {:?}, noise {:.1e} of the response", smoothing.criterion, smoothing.noise);
        match self.curve.below_smallest() {
            BelowSmallest::NotNeeded => {}
            assumed => {
                let _ = writeln!(text, "assumed below the smallest drive: {assumed:?}");
            }
        }
        if let Monotonicity::Falling { from, to } = self.curve.monotonicity() {
            let _ = writeln!(
                text,
                "the shear rate falls between {from:.4e} and {to:.4e} Pa: no steady shear is stable there"
            );
        }
        let _ =
            writeln!(text, "\n{:>14}{:>14}{:>16}  {confidence:.0} % band", "stress Pa", "rate 1/s", "viscosity Pa s");
        for point in &self.rows {
            let FlowCurvePoint { shear_stress, shear_rate, band, .. } = *point;
            let _ = write!(text, "{shear_stress:>14.5e}{shear_rate:>14.5e}{:>16.5e}", shear_stress / shear_rate);
            if let Some([low, high]) = band {
                let _ = write!(text, "  [{low:.5e}, {high:.5e}]");
            }
            text.push('\n');
        }
        text
    }

    /// Writes summary, tables and figure.
    #[must_use]
    pub fn write(&self, folder: &Folder, measured: &Measured) -> Written {
        let mut curve = String::from("shear_stress [Pa],shear_rate [1/s],low [1/s],high [1/s],viscosity [Pa s]\n");
        for FlowCurvePoint { shear_stress, shear_rate, band, .. } in &self.points {
            let [low, high] = band.unwrap_or([f64::NAN; 2]);
            let _ = writeln!(curve, "{shear_stress:?},{shear_rate:?},{low:?},{high:?},{:?}", shear_stress / shear_rate);
        }
        let [drive, response] = measured.columns();
        let mut residuals = format!("{drive},{response},relative residual\n");
        for ([drive, response], residual) in measured.rows.iter().zip(self.curve.residuals()) {
            let _ = writeln!(residuals, "{drive:?},{response:?},{residual:?}");
        }
        Written::of(
            folder,
            [
                ("summary.json", self.summary(measured)),
                ("flow-curve.csv", curve),
                ("residuals.csv", residuals),
                ("flow-curve.svg", figure::recovery(measured, self)),
            ],
        )
    }
}
