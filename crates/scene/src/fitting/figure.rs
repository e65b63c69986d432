//! The figure of a comparison: measured points and fitted curves, a panel for each test.

use plotters::prelude::*;

use super::tables::curve;
use super::{Comparison, Measurements};
use crate::output::figures::{Area, Drawn, FINE, FONT, GRID, INK, colour, figure, format_short, legend, pixels};

/// Panels beside each other.
const ACROSS: usize = 3;
/// Size of a panel and width of the legend, pixels.
const PANEL: (usize, usize) = (330, 330);
const LEGEND: usize = 190;

struct Panel {
    name: String,
    abscissa: &'static str,
    points: Vec<(f64, f64)>,
    /// A curve for each law, or its answers at the points.
    curves: Vec<Vec<(f64, f64)>>,
    is_curve: bool,
}

pub(super) fn comparison(measurements: &Measurements, comparison: &Comparison) -> String {
    let tests = measurements.data.tests();
    let panels: Vec<Panel> = tests
        .iter()
        .enumerate()
        .map(|(index, test)| {
            let is_curve = test.table().mode().is_some();
            let points: Vec<(f64, f64)> = test.abscissas().zip(test.stresses()).collect();
            let answers = |fit: &piola_fit::solids::Fit| {
                points.iter().zip(&fit.tests[index].residuals).map(|((x, y), residual)| (*x, y + residual)).collect()
            };
            let curves =
                comparison.fits().map(|(law, fit)| if is_curve { curve(law, fit, test) } else { answers(fit) });
            let curves = curves.collect();
            let abscissa = match test.table().mode() {
                Some((piola_specimens::homogeneous::Mode::SimpleShear, _)) => "amount of shear",
                Some(_) => "stretch",
                None => "largest stretch",
            };
            Panel { name: test.name().to_owned(), abscissa, points, curves, is_curve }
        })
        .collect();
    let across = panels.len().clamp(1, ACROSS);
    let down = panels.len().div_ceil(across).max(1);
    let size = |count: usize, each: usize, more: usize| u32::try_from(count * each + more).unwrap_or(u32::MAX);
    let unit = measurements.unit.as_ref().map_or_else(String::new, |unit| format!(" ({unit})"));
    let title = format!("{}: measured and fitted", measurements.name());
    let names: Vec<String> =
        comparison.fits().map(|(law, fit)| label(&law.to_string(), fit.worst_relative_rms())).collect();
    figure((size(across, PANEL.0, LEGEND + 24), size(down, PANEL.1, 56)), &title, &|area| {
        let (width, _) = area.dim_in_pixel();
        let (plots, side) = area.split_horizontally(width - size(1, LEGEND, 0) * FINE);
        for (panel, part) in panels.iter().zip(plots.split_evenly((down, across))) {
            draw(&part, panel, &unit)?;
        }
        let entries: Vec<(&str, RGBColor)> =
            names.iter().enumerate().map(|(k, name)| (name.as_str(), colour(k))).collect();
        legend(&side, &entries)
    })
}

/// The law with its largest relative residual.
fn label(law: &str, residual: f64) -> String {
    format!("{law}  {:.1} %", 100.0 * residual)
}

fn draw(area: &Area<'_>, panel: &Panel, unit: &str) -> Drawn {
    let all = || panel.points.iter().chain(panel.curves.iter().flatten()).filter(|(_, y)| y.is_finite());
    let (left, right) =
        all().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), (x, _)| (low.min(*x), high.max(*x)));
    let measured = panel.points.iter().fold((0.0_f64, 0.0_f64), |(low, high), (_, y)| (low.min(*y), high.max(*y)));
    // A curve that leaves the measured range far behind does not press it flat.
    let room = 0.12 * (measured.1 - measured.0).max(f64::MIN_POSITIVE);
    let (bottom, top) = (measured.0 - if measured.0 < 0.0 { room } else { 0.0 }, measured.1 + room);
    let margin = 0.02 * (right - left).max(1e-9);
    let short = |x: &f64| format_short(*x);
    let mut chart = ChartBuilder::on(area)
        .caption(&panel.name, (FONT, pixels(16)).into_font().color(&INK))
        .margin(pixels(8))
        .x_label_area_size(pixels(46))
        .y_label_area_size(pixels(62))
        .build_cartesian_2d(left - margin..right + margin, bottom..top)?;
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
        .x_desc(panel.abscissa)
        .y_desc(format!("stress{unit}"))
        .x_label_formatter(&short)
        .y_label_formatter(&short)
        .draw()?;
    for (index, curve) in panel.curves.iter().enumerate() {
        let shown = curve.iter().copied().filter(|(_, y)| y.is_finite() && bottom <= *y && *y <= top);
        if panel.is_curve {
            chart.draw_series(LineSeries::new(shown, colour(index).stroke_width(2 * FINE)))?;
        } else {
            chart.draw_series(shown.map(|point| Cross::new(point, pixels(3), colour(index).stroke_width(FINE))))?;
        }
    }
    chart
        .draw_series(panel.points.iter().map(|point| Circle::new(*point, pixels(3), INK.stroke_width(3 * FINE / 2))))?;
    Ok(())
}
