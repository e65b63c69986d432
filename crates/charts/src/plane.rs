//! Charts of a plane, with axes and names.

use core::ops::Range;

use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;

use crate::figure::{Area, Drawn, FINE, FONT, GRID, INK, format_short, pixels};

/// Pixels around a chart, for the labels below it and for those beside it.
const MARGIN: u32 = 10;
const BELOW: u32 = 50;
const BESIDE: u32 = 70;

/// The pixels of a chart in an area of so many.
pub(crate) fn plane_in(width: u32, height: u32) -> [f64; 2] {
    let within = |whole: u32, labels: u32| f64::from(whole.saturating_sub((labels + 2 * MARGIN) * FINE).max(1));
    [within(width, BESIDE), within(height, BELOW)]
}

/// A chart of a plane.
pub type Plane<'a> = ChartContext<'a, SVGBackend<'a>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// A chart over ranges of the plane, with its axes drawn and named.
///
/// # Errors
/// Those of the drawing.
pub fn plane_chart<'a>(
    area: &Area<'a>,
    (across, up): (Range<f64>, Range<f64>),
    (across_name, up_name): (String, String),
) -> Result<Plane<'a>, Box<dyn core::error::Error>> {
    let mut chart = ChartBuilder::on(area)
        .margin(pixels(MARGIN))
        .x_label_area_size(pixels(BELOW))
        .y_label_area_size(pixels(BESIDE))
        .build_cartesian_2d(across, up)?;
    let short = |x: &f64| format_short(*x);
    chart
        .configure_mesh()
        .set_all_tick_mark_size(pixels(5))
        .x_labels(7)
        .y_labels(7)
        .light_line_style(WHITE)
        .bold_line_style(GRID.stroke_width(FINE))
        .axis_style(INK.stroke_width(FINE))
        .label_style((FONT, pixels(14)).into_font().color(&INK))
        .axis_desc_style((FONT, pixels(16)).into_font().color(&INK))
        .x_desc(across_name)
        .y_desc(up_name)
        .x_label_formatter(&short)
        .y_label_formatter(&short)
        .draw()?;
    Ok(chart)
}

/// A curve through points of a chart.
///
/// # Errors
/// Those of the drawing.
pub fn line(chart: &mut Plane<'_>, points: Vec<(f64, f64)>, style: ShapeStyle) -> Drawn {
    chart.draw_series(LineSeries::new(points, style))?;
    Ok(())
}

/// Discs of a radius in pixels at points of a chart.
///
/// # Errors
/// Those of the drawing.
pub fn discs(chart: &mut Plane<'_>, points: Vec<(f64, f64)>, radius: u32, colour: RGBColor) -> Drawn {
    chart.draw_series(points.into_iter().map(|point| Circle::new(point, pixels(radius), colour.filled())))?;
    Ok(())
}

/// Points of which each is at least a distance from the one before.
pub fn thinned(points: impl Iterator<Item = (f64, f64)>, least: f64) -> Vec<(f64, f64)> {
    let mut kept: Vec<(f64, f64)> = Vec::new();
    let mut last = None;
    for point in points.filter(|(x, y)| x.is_finite() && y.is_finite()) {
        last = Some(point);
        match kept.last() {
            Some((x, y)) if (point.0 - x).hypot(point.1 - y) < least => {}
            _ => kept.push(point),
        }
    }
    // The last point ends the curve, however near it is.
    kept.extend(last.filter(|last| kept.last() != Some(last)));
    kept
}
