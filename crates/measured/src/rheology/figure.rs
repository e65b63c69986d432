//! Figures of flow curves: logarithmic, with residuals beside.

use piola_charts::{FINE, LogPanel, RGBColor, colour, figure, legend, residuals as of_residuals};

use super::{Answering, Comparison, Correction, FittedFluid, FluidModel, Function, Measured, Point, RecoveredCurve};

/// The axes of a curve for a reader.
fn axes(function: Function) -> [String; 2] {
    function.axes().map(|(name, unit)| format!("{} ({unit})", name.replace('_', " ")))
}

/// The name of a column as people write it: "discharge (m³/s)" of `discharge [m^3/s]`.
fn written(column: &str) -> String {
    column.replace('_', " ").replace('[', "(").replace(']', ")").replace("^2", "²").replace("^3", "³")
}

/// Fluids with a curve, at most: those with the least sums of squares.
const DRAWN: usize = 5;

/// The fluids that are drawn, in the order of the table.
fn drawn(comparison: &Comparison) -> Vec<(FluidModel, &FittedFluid)> {
    let mut all: Vec<(FluidModel, &FittedFluid)> = comparison.fits().collect();
    let mut squares: Vec<f64> = all.iter().map(|(_, fit)| fit.squares).collect();
    squares.sort_by(f64::total_cmp);
    if let Some(&most) = squares.get(DRAWN) {
        all.retain(|(_, fit)| fit.squares < most);
    }
    all
}

/// Marks of a panel, at most: of more rows some are drawn, evenly.
const MARKS: usize = 600;

/// Some of many, evenly.
fn some<T: Copy>(rows: &[T]) -> impl Iterator<Item = T> + '_ {
    rows.iter().step_by(rows.len().div_ceil(MARKS).max(1)).copied()
}

/// Sizes of points and band: logarithms are drawn.
fn sizes(points: &[Point]) -> Vec<(f64, f64)> {
    points.iter().map(|point| (point.at, point.value.abs())).collect()
}

/// A recovered curve with its band.
fn of_curve<'a>(curve: &RecoveredCurve, title: &'a str, axes: [&'a str; 2]) -> LogPanel<'a> {
    let band = |point: &Point| {
        let [low, high] = point.band?;
        Some((point.at, if point.value < 0.0 { [-high, -low] } else { [low, high] }))
    };
    LogPanel {
        title,
        axes,
        marks: sizes(&some(&curve.rows).collect::<Vec<_>>()),
        curves: vec![sizes(&curve.points)],
        band: curve.points.iter().filter_map(band).collect(),
    }
}

/// A curve with its band, and the residuals of the rows.
pub(super) fn recovery(measured: &Measured, curve: &RecoveredCurve, what: Answering) -> String {
    let axes = axes(curve.function);
    let title =
        if curve.function.is_flow_curve() { "flow curve with its band" } else { "normal stresses with their band" };
    let flow = of_curve(curve, title, [&axes[0], &axes[1]]);
    let names = measured.columns(what).map(|name| written(&name));
    let rows: &[[f64; 2]] =
        measured.answers.iter().find(|answer| answer.what == what).map_or(&[], |answer| &answer.rows);
    let smooth = |([drive, response], residual): (&[f64; 2], &f64)| (*drive, response / (1.0 + residual));
    let few: Vec<[f64; 2]> = some(rows).collect();
    let residuals = vec![some(&curve.residuals).collect::<Vec<_>>()];
    let data = LogPanel {
        title: "measured and smoothed",
        axes: [&names[0], &names[1]],
        marks: few.iter().map(|[drive, response]| (*drive, *response)).collect(),
        curves: vec![few.iter().zip(&residuals[0]).map(smooth).collect()],
        band: Vec::new(),
    };
    let title = format!("{}: the fluid behind it", measured.name());
    figure((1130, 420), &title, &|area| {
        let parts = area.split_evenly((1, 3));
        flow.draw(&parts[0])?;
        data.draw(&parts[1])?;
        of_residuals(&parts[2], (&names[0], &few), &residuals, "measured/smoothed − 1")
    })
}

/// The flow curve that several tables tell, what they seem to tell, and what they are corrected for.
pub(super) fn correction(tables: &[Measured], curve: &RecoveredCurve, correction: &Correction) -> String {
    let axes = axes(curve.function);
    let flow = of_curve(curve, "flow curve with its band", [&axes[0], &axes[1]]);
    let apparent = |measured: &Measured| -> Vec<(f64, f64)> {
        measured.rows().iter().map(|row| measured.flow.apparent(*row).into()).collect()
    };
    let raw = LogPanel {
        title: "without correction",
        axes: ["shear stress (Pa)", "4Q/(πR³) (1/s)"],
        marks: tables.iter().flat_map(apparent).collect(),
        curves: tables.iter().map(apparent).collect(),
        band: Vec::new(),
    };
    let (title, name, marks): (_, _, Vec<(f64, f64)>) = match correction {
        Correction::Slip(slip) => (
            "slip at the walls",
            "slip velocity (m/s)",
            slip.points.iter().map(|point| (point.wall_stress, point.slip_velocity)).collect(),
        ),
        Correction::Ends(ends) => (
            "pressure lost at the ends",
            "pressure (Pa)",
            ends.points.iter().map(|point| (point.wall_stress, point.end_pressure)).collect(),
        ),
    };
    // What is negative by noise has no logarithm.
    let marks = marks.into_iter().filter(|(_, y)| 0.0 < *y).collect();
    let lost = LogPanel { title, axes: ["shear stress (Pa)", name], marks, curves: Vec::new(), band: Vec::new() };
    let names: Vec<String> = tables.iter().map(Measured::name).collect();
    figure((1290, 420), &format!("{}: the fluid behind them", names.join(", ")), &|area| {
        let (width, _) = area.dim_in_pixel();
        let (plots, side) = area.split_horizontally(width - 160 * FINE);
        let entries: Vec<(&str, RGBColor)> =
            names.iter().enumerate().map(|(k, name)| (name.as_str(), colour(k))).collect();
        legend(&side, &entries)?;
        let parts = plots.split_evenly((1, 3));
        flow.draw(&parts[0])?;
        raw.draw(&parts[1])?;
        lost.draw(&parts[2])
    })
}

/// Measured answers with those of each fluid, and their residuals.
pub(super) fn comparison(measured: &Measured, comparison: &Comparison) -> String {
    let [drive, response] = measured.first_columns().map(|name| written(&name));
    let fits = drawn(comparison);
    let answers = |residuals: &[f64]| {
        some(measured.rows()).zip(some(residuals)).map(|([drive, response], r)| (drive, response * r.exp())).collect()
    };
    let data = LogPanel {
        title: "measured and fitted",
        axes: [&drive, &response],
        marks: some(measured.rows()).map(|[drive, response]| (drive, response)).collect(),
        curves: fits.iter().map(|(_, fit)| answers(&fit.residuals)).collect(),
        band: Vec::new(),
    };
    let flow = LogPanel {
        title: "viscosity",
        axes: ["shear rate (1/s)", "viscosity (Pa s)"],
        marks: Vec::new(),
        curves: fits.iter().map(|(_, fit)| fit.curve.iter().map(|[k, stress]| (*k, stress / k)).collect()).collect(),
        band: Vec::new(),
    };
    let residuals: Vec<Vec<f64>> = fits.iter().map(|(_, fit)| some(&fit.residuals).collect()).collect();
    let rows: Vec<[f64; 2]> = some(measured.rows()).collect();
    let names: Vec<String> = fits.iter().map(|(fluid, _)| fluid.to_string()).collect();
    let title = format!("{}: measured and fitted", measured.name());
    figure((1290, 420), &title, &|area| {
        let (width, _) = area.dim_in_pixel();
        let (plots, side) = area.split_horizontally(width - 160 * FINE);
        let parts = plots.split_evenly((1, 3));
        data.draw(&parts[0])?;
        flow.draw(&parts[1])?;
        of_residuals(&parts[2], (&drive, &rows), &residuals, "ln(fitted/measured)")?;
        let entries: Vec<(&str, RGBColor)> =
            names.iter().enumerate().map(|(k, name)| (name.as_str(), colour(k))).collect();
        legend(&side, &entries)
    })
}
