//! Newtonian flows of every rheometer, whose discharges, speeds and torques are known in closed form.

use core::f64::consts::PI;

use piola_charts::Folder;
use piola_measured::MeasuredError;
use piola_measured::rheology::{FlowKind, Measured, RecoveryRequest, Request, compare, recover};
use piola_testkit::{Tol, assert_close, assert_each_close};

use crate::rheology::csv;

/// A rheometer of millimetres: its table's head, and the row at which the largest stress and shear rate of a Newtonian fluid are these.
struct Rheometer {
    kind: FlowKind,
    head: &'static str,
    row: fn(f64, f64) -> [f64; 2],
}

const PIPE: Rheometer = Rheometer {
    kind: FlowKind::Pipe,
    head: "# radius: 2 mm\npressure_gradient,discharge",
    row: |stress, rate| [stress / 1e-3, PI * 8e-9 * rate / 4.0],
};
const CHANNEL: Rheometer = Rheometer {
    kind: FlowKind::Channel,
    head: "# half_width: 2 mm\npressure_gradient,discharge_per_width",
    row: |stress, rate| [stress / 2e-3, 4e-6 * rate / 1.5],
};
const CYLINDERS: Rheometer = Rheometer {
    kind: FlowKind::Couette,
    head: "# inner_radius: 6 mm\n# outer_radius: 10 mm\ntorque_per_length,speed_difference",
    row: |stress, rate| [2.0 * PI * 36e-6 * stress, 0.5 * rate * (1.0 - 0.36)],
};
const PLATES: Rheometer = Rheometer {
    kind: FlowKind::Plates,
    head: "# radius: 20 mm\n# gap: 0.5 mm\nangular_velocity,torque",
    row: |stress, rate| [0.025 * rate, 0.5 * PI * 8e-6 * stress],
};
const CONE: Rheometer = Rheometer {
    kind: FlowKind::Cone,
    head: "# radius: 20 mm\n# angle: 0.02 rad\nangular_velocity,torque",
    row: |stress, rate| [0.02 * rate, 2.0 * PI * 8e-6 * stress / 3.0],
};

const ALL: [Rheometer; 5] = [PIPE, CHANNEL, CYLINDERS, PLATES, CONE];

/// Thirteen rates from 0.5/s to 500/s, evenly in the logarithm.
fn rates() -> impl Iterator<Item = f64> {
    (0..13).map(|i| 0.5 * 10.0_f64.powf(0.25 * f64::from(i)))
}

impl Rheometer {
    /// The table of a fluid of this viscosity.
    fn measured(&self, viscosity: f64) -> Result<Measured, MeasuredError> {
        let rows = rates().map(|rate| (self.row)(viscosity * rate, rate));
        Measured::parse(format!("{}.csv", self.kind.name()), &csv(self.head, rows), self.kind, &[])
    }
}

/// The files that `write` writes into a folder of this name, by their names.
pub(crate) fn written<const N: usize>(
    name: &str,
    files: [&str; N],
    write: impl Fn(&Folder) -> piola_charts::Written,
) -> [String; N] {
    let path = std::env::temp_dir().join(format!("piola-measured-{name}-{}", std::process::id()));
    let folder = Folder::prepare(&path).unwrap_or_else(|error| panic!("{error}"));
    let written = write(&folder);
    assert!(written.failures.is_empty(), "{:?}", written.failures);
    let texts = files.map(|file| std::fs::read_to_string(path.join(file)).unwrap_or_else(|error| panic!("{error}")));
    let _ = std::fs::remove_dir_all(path);
    texts
}

/// The numbers of the last columns of a table after its header, row by row.
pub(crate) fn numbers<const N: usize>(csv: &str) -> Vec<[f64; N]> {
    let row = |line: &str| {
        let fields: Vec<&str> = line.split(',').collect();
        let last = fields[fields.len() - N..].iter().map(|field| field.parse().unwrap_or_else(|_| panic!("{line}")));
        last.collect::<Vec<f64>>().try_into().unwrap_or_else(|_| panic!("{line}"))
    };
    csv.lines().skip(1).map(row).collect()
}

/// From `low` to `high` in as many steps, evenly in the logarithm.
fn evenly(low: f64, high: f64, steps: u32) -> Vec<f64> {
    (0..=steps).map(|k| (low.ln() + (high / low).ln() * f64::from(k) / f64::from(steps)).exp()).collect()
}

const SPACED: Tol = Tol::ulps(64.0);

#[test]
fn curve_of_a_fitted_fluid_runs_evenly_over_the_rates_at_the_wall() -> Result<(), MeasuredError> {
    let viscosity = 0.7;
    for rheometer in &ALL {
        let name = rheometer.kind.name();
        let measured = rheometer.measured(viscosity)?;
        let comparison = compare(&measured, &Request::of(vec!["newtonian".parse()?]))?;
        let (_, fit) = comparison.best().expect("thirteen rows");
        let tolerance = Tol::stated(1e-10, "the accuracy of the answers of flows");
        assert_close(name, &[fit.parameters[0].value], &[viscosity], tolerance);
        let [csv] = written(name, ["curves.csv"], |folder| comparison.write(folder, &measured));
        let curve: Vec<[f64; 3]> = numbers(&csv);
        let column = |k: usize| curve.iter().map(|row| row[k]).collect::<Vec<f64>>();
        let expected = evenly(0.5, 500.0, 120);
        assert_each_close(&format!("{name}: rates"), &column(0), &expected, SPACED);
        let stresses: Vec<f64> = expected.iter().map(|rate| viscosity * rate).collect();
        assert_each_close(&format!("{name}: stresses"), &column(1), &stresses, tolerance);
        assert_each_close(&format!("{name}: viscosities"), &column(2), &vec![viscosity; 121], tolerance);
    }
    Ok(())
}

#[test]
fn recovered_curves_run_evenly_from_the_first_row_to_the_last_with_their_viscosity() -> Result<(), MeasuredError> {
    let viscosity = 0.7;
    for rheometer in &ALL {
        let name = rheometer.kind.name();
        let measured = rheometer.measured(viscosity)?;
        let recovery = recover(&measured, &RecoveryRequest::default())?;
        let tables = core::slice::from_ref(&measured);
        let [csv] = written(&format!("{name}-curve"), ["flow-curve.csv"], |folder| recovery.write(folder, tables));
        let curve: Vec<[f64; 5]> = numbers(&csv);
        let column = |k: usize| curve.iter().map(|row| row[k]).collect::<Vec<f64>>();
        // Torques give stresses at rates, everything else rates at stresses.
        let is_of_rates = csv.starts_with("shear_rate [1/s],shear_stress [Pa],");
        assert_eq!(is_of_rates, matches!(rheometer.kind, FlowKind::Plates | FlowKind::Cone), "{name}");
        let scale = if is_of_rates { 1.0 } else { viscosity };
        assert_each_close(&format!("{name}: abscissas"), &column(0), &evenly(0.5 * scale, 500.0 * scale, 160), SPACED);
        let tolerance = Tol::stated(1e-9, "the derivative of a straight line through the logarithms of the rows");
        assert_each_close(&format!("{name}: viscosities"), &column(4), &vec![viscosity; 161], tolerance);
        let text = recovery.table(tables);
        let viscosities: Vec<&str> = text.lines().filter_map(|line| line.split_whitespace().nth(2)).collect();
        assert_eq!(viscosities.iter().filter(|word| **word == "7.00000e-1").count(), 13, "{name}: {text}");
    }
    Ok(())
}

#[test]
fn root_mean_square_of_residuals_is_told_in_percent() -> Result<(), MeasuredError> {
    // Stresses e^±0.02 off k: the mean of their logarithms is that of a viscosity of 1.
    let row = |(rate, sign): (f64, f64)| format!("{rate},{:?}\n", rate * (0.02 * sign).exp());
    let rows: String = [(1.0, 1.0), (2.0, -1.0), (4.0, -1.0), (8.0, 1.0)].into_iter().map(row).collect();
    let measured = Measured::parse("four.csv", &format!("shear_rate,shear_stress\n{rows}"), FlowKind::Curve, &[])?;
    let comparison = compare(&measured, &Request::of(vec!["newtonian".parse()?]))?;
    let fit = comparison.fits().next().expect("four rows").1;
    let tolerance = Tol::stated(1e-12, "rounding of logarithms near 1, over residuals of 0.02");
    assert_close("residuals", &fit.residuals, &[-0.02, 0.02, 0.02, -0.02], tolerance);
    let table = comparison.table(&measured);
    assert!(table.contains(" 2.00 % "), "{table}");
    let summary: serde_json::Value = serde_json::from_str(&comparison.summary(&measured)).expect("a summary is JSON");
    let told = summary["fluids"][0]["rms_residual"].as_f64().expect("a number");
    assert_close("told", &[told], &[0.02], tolerance);
    Ok(())
}
