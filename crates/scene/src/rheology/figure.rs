//! Figures of flow curves: logarithmic, with residuals beside.

use plotters::prelude::*;

use super::{Answering, Comparison, Correction, Function, Measured, Point, RecoveredCurve};
use crate::output::figures::{Area, Drawn, FINE, FONT, GRID, INK, colour, figure, legend, pixels, power_of_ten};

/// Curves and marks of a panel with logarithmic axes.
struct Panel<'a> {
    title: &'a str,
    axes: [&'a str; 2],
    marks: Vec<(f64, f64)>,
    curves: Vec<Vec<(f64, f64)>>,
    /// Lower and upper ends at abscissas.
    band: Vec<(f64, [f64; 2])>,
}

/// The axes of a curve for a reader.
fn axes(function: Function) -> [String; 2] {
    function.axes().map(|(name, unit)| format!("{} ({unit})", name.replace('_', " ")))
}

/// Sizes of points and band: logarithms are drawn.
fn sizes(points: &[Point]) -> Vec<(f64, f64)> {
    points.iter().map(|point| (point.at, point.value.abs())).collect()
}

/// A recovered curve with its band.
fn of_curve<'a>(curve: &RecoveredCurve, title: &'a str, axes: [&'a str; 2]) -> Panel<'a> {
    let band = |point: &Point| {
        let [low, high] = point.band?;
        Some((point.at, if point.value < 0.0 { [-high, -low] } else { [low, high] }))
    };
    Panel {
        title,
        axes,
        marks: sizes(&curve.rows),
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
    let names = measured.columns(what);
    let rows: &[[f64; 2]] =
        measured.answers.iter().find(|answer| answer.what == what).map_or(&[], |answer| &answer.rows);
    let smooth = |([drive, response], residual): (&[f64; 2], &f64)| (*drive, response / (1.0 + residual));
    let data = Panel {
        title: "measured and smoothed",
        axes: [&names[0], &names[1]],
        marks: rows.iter().map(|[drive, response]| (*drive, *response)).collect(),
        curves: vec![rows.iter().zip(&curve.residuals).map(smooth).collect()],
        band: Vec::new(),
    };
    let residuals = vec![curve.residuals.clone()];
    let title = format!("{}: the fluid behind it", measured.name());
    figure((1130, 420), &title, &|area| {
        let parts = area.split_evenly((1, 3));
        logarithmic(&parts[0], &flow)?;
        logarithmic(&parts[1], &data)?;
        of_residuals(&parts[2], (&names[0], rows), &residuals, "measured/smoothed − 1")
    })
}

/// The flow curve that several tables tell, what they seem to tell, and what they are corrected for.
pub(super) fn correction(tables: &[Measured], curve: &RecoveredCurve, correction: &Correction) -> String {
    let axes = axes(curve.function);
    let flow = of_curve(curve, "flow curve with its band", [&axes[0], &axes[1]]);
    let apparent = |measured: &Measured| -> Vec<(f64, f64)> {
        measured.rows().iter().map(|row| measured.flow.apparent(*row).into()).collect()
    };
    let raw = Panel {
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
    let lost = Panel { title, axes: ["shear stress (Pa)", name], marks, curves: Vec::new(), band: Vec::new() };
    let names: Vec<String> = tables.iter().map(Measured::name).collect();
    figure((1130, 420), &format!("{}: the fluid behind them", names.join(", ")), &|area| {
        let parts = area.split_evenly((1, 3));
        logarithmic(&parts[0], &flow)?;
        logarithmic(&parts[1], &raw)?;
        logarithmic(&parts[2], &lost)
    })
}

/// Measured answers with those of each fluid, and their residuals.
pub(super) fn comparison(measured: &Measured, comparison: &Comparison) -> String {
    let [drive, response] = measured.first_columns();
    let answers = |residuals: &[f64]| {
        measured.rows().iter().zip(residuals).map(|([drive, response], r)| (*drive, response * r.exp())).collect()
    };
    let data = Panel {
        title: "measured and fitted",
        axes: [&drive, &response],
        marks: measured.rows().iter().map(|[drive, response]| (*drive, *response)).collect(),
        curves: comparison.fits().map(|(_, fit)| answers(&fit.residuals)).collect(),
        band: Vec::new(),
    };
    let flow = Panel {
        title: "viscosity",
        axes: ["shear rate (1/s)", "viscosity (Pa s)"],
        marks: Vec::new(),
        curves: comparison
            .fits()
            .map(|(_, fit)| fit.curve.iter().map(|[k, stress]| (*k, stress / k)).collect())
            .collect(),
        band: Vec::new(),
    };
    let residuals: Vec<Vec<f64>> = comparison.fits().map(|(_, fit)| fit.residuals.clone()).collect();
    let names: Vec<String> = comparison.fits().map(|(fluid, _)| fluid.to_string()).collect();
    let title = format!("{}: measured and fitted", measured.name());
    figure((1290, 420), &title, &|area| {
        let (width, _) = area.dim_in_pixel();
        let (plots, side) = area.split_horizontally(width - 160 * FINE);
        let parts = plots.split_evenly((1, 3));
        logarithmic(&parts[0], &data)?;
        logarithmic(&parts[1], &flow)?;
        of_residuals(&parts[2], (&drive, measured.rows()), &residuals, "ln(fitted/measured)")?;
        let entries: Vec<(&str, RGBColor)> =
            names.iter().enumerate().map(|(k, name)| (name.as_str(), colour(k))).collect();
        legend(&side, &entries)
    })
}

fn logarithmic(area: &Area<'_>, panel: &Panel<'_>) -> Drawn {
    let all = || panel.marks.iter().chain(panel.curves.iter().flatten()).filter(|(x, y)| 0.0 < *x && 0.0 < *y);
    let range = |pick: fn(&(f64, f64)) -> f64| {
        let (low, high) = all().map(pick).fold((f64::INFINITY, 0.0_f64), |(low, high), x| (low.min(x), high.max(x)));
        if low < high { 0.8 * low..1.25 * high } else { 0.1..10.0 }
    };
    let mut chart = ChartBuilder::on(area)
        .caption(panel.title, (FONT, pixels(16)).into_font().color(&INK))
        .margin(pixels(8))
        .x_label_area_size(pixels(46))
        .y_label_area_size(pixels(70))
        .build_cartesian_2d(range(|p| p.0).log_scale(), range(|p| p.1).log_scale())?;
    let power = |x: &f64| power_of_ten(*x);
    chart
        .configure_mesh()
        .set_all_tick_mark_size(pixels(5))
        .x_labels(6)
        .y_labels(6)
        .light_line_style(WHITE)
        .bold_line_style(GRID.stroke_width(FINE))
        .axis_style(INK.stroke_width(FINE))
        .label_style((FONT, pixels(13)).into_font().color(&INK))
        .axis_desc_style((FONT, pixels(14)).into_font().color(&INK))
        .x_desc(panel.axes[0])
        .y_desc(panel.axes[1])
        .x_label_formatter(&power)
        .y_label_formatter(&power)
        .draw()?;
    let upper = panel.band.iter().map(|(x, [_, high])| (*x, *high));
    let lower = panel.band.iter().rev().map(|(x, [low, _])| (*x, low.max(f64::MIN_POSITIVE)));
    let outline: Vec<(f64, f64)> = upper.chain(lower).collect();
    if !outline.is_empty() {
        chart.draw_series(core::iter::once(Polygon::new(outline, colour(0).mix(0.25))))?;
    }
    for (index, curve) in panel.curves.iter().enumerate() {
        let shown = curve.iter().copied().filter(|(x, y)| 0.0 < *x && 0.0 < *y);
        chart.draw_series(LineSeries::new(shown, colour(index).stroke_width(2 * FINE)))?;
    }
    chart
        .draw_series(panel.marks.iter().map(|point| Circle::new(*point, pixels(3), INK.stroke_width(3 * FINE / 2))))?;
    Ok(())
}

fn of_residuals(area: &Area<'_>, (drive, rows): (&str, &[[f64; 2]]), residuals: &[Vec<f64>], name: &str) -> Drawn {
    let drives = || rows.iter().map(|row| row[0]);
    let (left, right) = (drives().fold(f64::INFINITY, f64::min), drives().fold(0.0, f64::max));
    let size = residuals.iter().flatten().filter(|r| r.is_finite()).fold(1e-15_f64, |size, r| size.max(r.abs()));
    let mut chart = ChartBuilder::on(area)
        .caption("residuals", (FONT, pixels(16)).into_font().color(&INK))
        .margin(pixels(8))
        .x_label_area_size(pixels(46))
        .y_label_area_size(pixels(76))
        .build_cartesian_2d((0.8 * left..1.25 * right).log_scale(), -1.1 * size..1.1 * size)?;
    let power = |x: &f64| power_of_ten(*x);
    let percent = |y: &f64| if 1e-4 < size { format!("{:.2} %", 100.0 * y) } else { format!("{y:.0e}") };
    chart
        .configure_mesh()
        .set_all_tick_mark_size(pixels(5))
        .x_labels(6)
        .y_labels(6)
        .light_line_style(WHITE)
        .bold_line_style(GRID.stroke_width(FINE))
        .axis_style(INK.stroke_width(FINE))
        .label_style((FONT, pixels(13)).into_font().color(&INK))
        .axis_desc_style((FONT, pixels(14)).into_font().color(&INK))
        .x_desc(drive)
        .y_desc(name)
        .x_label_formatter(&power)
        .y_label_formatter(&percent)
        .draw()?;
    for (index, set) in residuals.iter().enumerate() {
        let points = drives().zip(set).filter(|(_, r)| r.is_finite()).map(|(x, r)| (x, *r));
        chart.draw_series(points.map(|point| Circle::new(point, pixels(3), colour(index).filled())))?;
    }
    Ok(())
}
