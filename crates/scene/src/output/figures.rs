//! SVG figures: trajectories, drift of invariants, error against the reference.
//!
//! Colours are told apart by the colour-blind (Okabe & Ito 2008, then Tol's muted scheme). Text is SVG text in the reader's
//! sans-serif font, so that no font is needed to draw.

use core::ops::Range;

use plotters::coord::Shift;
use plotters::coord::ranged1d::{AsRangedCoord, ValueFormatter};
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::run::{History, Run};

const PALETTE: [RGBColor; 12] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(51, 34, 136),
    RGBColor(136, 34, 85),
    RGBColor(17, 119, 51),
    RGBColor(153, 153, 51),
    RGBColor(170, 68, 153),
    RGBColor(85, 85, 85),
];
pub(crate) const INK: RGBColor = RGBColor(40, 40, 40);
pub(crate) const GRID: RGBColor = RGBColor(225, 225, 225);
pub(crate) const FONT: &str = "sans-serif";
/// Coordinates are whole in the drawing; this many of them make a pixel, so that curves are smooth.
pub(crate) const FINE: u32 = 8;
/// Beyond this many curves a legend helps nobody.
const NAMED: usize = 24;

pub(crate) type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
pub(crate) type Drawn = Result<(), Box<dyn core::error::Error>>;

pub(crate) fn colour(index: usize) -> RGBColor {
    PALETTE[index % PALETTE.len()]
}

/// A figure of a size, with a title; one that cannot be drawn says so instead of being lost.
pub(crate) fn figure(size: (u32, u32), title: &str, draw: &dyn Fn(&Area<'_>) -> Drawn) -> String {
    let mut text = String::new();
    let attempt = |text: &mut String, draw: &dyn Fn(&Area<'_>) -> Drawn| -> Drawn {
        let area = SVGBackend::with_string(text, (FINE * size.0, FINE * size.1)).into_drawing_area();
        area.fill(&WHITE)?;
        let style = (FONT, pixels(21)).into_font().color(&INK).pos(Pos::new(HPos::Left, VPos::Top));
        area.draw(&Text::new(title.to_string(), (pixels(24), pixels(14)), style))?;
        draw(&area.margin(pixels(44), pixels(8), pixels(12), pixels(12)))?;
        area.present()?;
        Ok(())
    };
    let drawn = attempt(&mut text, draw);
    if let Err(error) = drawn {
        text.clear();
        let message = format!("this figure could not be drawn: {error}");
        let _ = attempt(&mut text, &|area: &Area<'_>| {
            Ok(area.draw(&Text::new(
                message.clone(),
                (pixels(24), pixels(40)),
                (FONT, pixels(15)).into_font().color(&INK),
            ))?)
        });
    }
    // The view box keeps the fine coordinates; the size is that of the figure.
    let fine = format!("width=\"{}\" height=\"{}\"", FINE * size.0, FINE * size.1);
    let shown = format!("width=\"{}\" height=\"{}\"", size.0, size.1);
    text.replacen(&fine, &shown, 1)
}

/// Pixels in the coordinates of the drawing.
pub(crate) fn pixels(count: u32) -> i32 {
    i32::try_from(count * FINE).unwrap_or(i32::MAX)
}

/// A unit for lengths of this size: name and metres.
pub(crate) fn length_unit(largest: f64) -> (&'static str, f64) {
    match largest {
        x if 1e10 <= x => ("au", 149_597_870_700.0),
        x if 1e5 <= x => ("km", 1e3),
        x if x < 1e-2 => ("mm", 1e-3),
        _ => ("m", 1.0),
    }
}

/// A unit for times of this length: name and seconds.
fn time_unit(span: f64) -> (&'static str, f64) {
    match span {
        x if 3.0 * 31_557_600.0 <= x => ("years", 31_557_600.0),
        x if 3.0 * 86_400.0 <= x => ("days", 86_400.0),
        x if 3.0 * 3600.0 <= x => ("hours", 3600.0),
        _ => ("s", 1.0),
    }
}

/// The largest distance of each body from the origin, m.
fn reach(history: &History) -> Vec<f64> {
    let mut reach = vec![0.0; history.names.len()];
    for positions in &history.positions {
        for (reach, x) in reach.iter_mut().zip(positions) {
            *reach = f64::max(*reach, x.iter().map(|x| x * x).sum::<f64>().sqrt());
        }
    }
    reach
}

/// Paths in the plane in which they extend most; in two panels, near and all, when bodies are of very different reach.
pub(super) fn trajectory(title: &str, history: &History, gravity: Option<[f64; 3]>) -> String {
    let reach = reach(history);
    let (across, up) = plane(history, gravity);
    let mut sorted: Vec<f64> = reach.iter().copied().filter(|x| 0.0 < *x && x.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    let largest = sorted.last().copied().unwrap_or(1.0);
    // A body that hardly moves, as a sun, does not make a panel of its own.
    let several = |radius: f64| 1 < sorted.iter().filter(|x| **x <= radius && 0.05 * radius < **x).count();
    let gap = sorted
        .windows(2)
        .filter(|pair| 2.5 < pair[1] / pair[0] && 8.0 < largest / pair[0] && several(pair[0]))
        .max_by(|a, b| (a[1] / a[0]).total_cmp(&(b[1] / b[0])));
    let panels: Vec<f64> = gap.map(|pair| pair[0]).into_iter().chain([largest]).collect();
    let size = if panels.len() == 2 { (1180, 600) } else { (780, 640) };
    figure(size, title, &|area| {
        let legend = if history.names.len() <= NAMED { 130 * FINE } else { 0 };
        let (width, height) = area.dim_in_pixel();
        let (plots, names) = area.split_horizontally(width - legend);
        let each = (width - legend) / u32::try_from(panels.len())?;
        for (index, &radius) in panels.iter().enumerate() {
            let (part, _) = plots.split_horizontally(each * (u32::try_from(index)? + 1));
            let (_, part) = part.split_horizontally(each * u32::try_from(index)?);
            panel(&part, (each, height), history, &reach, (across, up), radius)?;
        }
        if 0 < legend {
            let labels: Vec<&str> = history.names.iter().map(String::as_str).collect();
            draw_legend(&names, &labels)?;
        }
        Ok(())
    })
}

/// A chart of a plane.
pub(crate) type Plane<'a> = ChartContext<'a, SVGBackend<'a>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// A chart over ranges of the plane, with its axes drawn and named.
pub(crate) fn plane_chart<'a>(
    area: &Area<'a>,
    (across, up): (Range<f64>, Range<f64>),
    (across_name, up_name): (String, String),
) -> Result<Plane<'a>, Box<dyn core::error::Error>> {
    let mut chart = ChartBuilder::on(area)
        .margin(pixels(10))
        .x_label_area_size(pixels(50))
        .y_label_area_size(pixels(70))
        .build_cartesian_2d(across, up)?;
    let short = |x: &f64| format_short(*x);
    chart
        .configure_mesh()
        .set_all_tick_mark_size(pixels(5))
        .x_labels(7)
        .y_labels(7)
        .max_light_lines(0)
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

/// One panel with the bodies that stay within a radius, true to scale.
fn panel(
    area: &Area<'_>,
    (width, height): (u32, u32),
    history: &History,
    reach: &[f64],
    (across, up): (usize, usize),
    radius: f64,
) -> Drawn {
    let (unit, metre) = length_unit(radius);
    let shown: Vec<usize> = (0..reach.len()).filter(|body| reach[*body] <= radius).collect();
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for positions in &history.positions {
        for &body in &shown {
            for (k, axis) in [across, up].into_iter().enumerate() {
                let x = positions[body][axis] / metre;
                if x.is_finite() {
                    low[k] = low[k].min(x);
                    high[k] = high[k].max(x);
                }
            }
        }
    }
    if !(low[0] <= high[0] && low[1] <= high[1]) {
        (low, high) = ([-1.0; 2], [1.0; 2]);
    }
    // One scale for both axes: the plot area is what margins and labels leave.
    let (wide, tall) = (
        f64::from(width.saturating_sub(100 * FINE).max(50 * FINE)),
        f64::from(height.saturating_sub(75 * FINE).max(50 * FINE)),
    );
    let scale = 1.08 * ((high[0] - low[0]) / wide).max((high[1] - low[1]) / tall).max(1e-12 * (1.0 + radius / metre));
    let range = |k: usize, pixels: f64| {
        let middle = 0.5 * (low[k] + high[k]);
        middle - 0.5 * scale * pixels..middle + 0.5 * scale * pixels
    };
    let names = ["x", "y", "z"].map(|name| format!("{name} ({unit})"));
    let ranges = (range(0, wide), range(1, tall));
    let mut chart = plane_chart(area, ranges, (names[across].clone(), names[up].clone()))?;
    for &body in &shown {
        let at = |positions: &Vec<[f64; 3]>| (positions[body][across] / metre, positions[body][up] / metre);
        let points: Vec<(f64, f64)> = history.positions.iter().map(at).collect();
        if jumps(&points, 0.15 * scale * wide.min(tall)) {
            let marks = scattered(&points, 2.0 * f64::from(FINE) * scale);
            chart.draw_series(marks.into_iter().map(|point| Circle::new(point, pixels(1), colour(body).filled())))?;
        } else {
            let style = colour(body).stroke_width(if history.names.len() == 1 { FINE } else { 3 * FINE / 2 });
            chart.draw_series(LineSeries::new(thinned(points.into_iter(), 3.0 * scale), style))?;
        }
        if let Some(last) = history.positions.last() {
            chart.draw_series([Circle::new(at(last), pixels(4), colour(body).filled())])?;
        }
    }
    Ok(())
}

/// The two axes along which paths extend most; up is against gravity when there is any.
fn plane(history: &History, gravity: Option<[f64; 3]>) -> (usize, usize) {
    let mut low = [f64::INFINITY; 3];
    let mut high = [f64::NEG_INFINITY; 3];
    for x in history.positions.iter().flatten() {
        for k in 0..3 {
            low[k] = low[k].min(x[k]);
            high[k] = high[k].max(x[k]);
        }
    }
    let extent = |k: &usize| high[*k] - low[*k];
    let by_extent = |a: &usize, b: &usize| extent(b).total_cmp(&extent(a)).then(a.cmp(b));
    let mut axes = [0, 1, 2];
    axes.sort_by(by_extent);
    let vertical = gravity.and_then(|g| (0..3).find(|k| 0.9 * g.iter().map(|x| x * x).sum::<f64>() < g[*k] * g[*k]));
    match vertical {
        // A path that hardly rises is seen from above.
        Some(up) if 0.3 * extent(&axes[0]) < extent(&up) => {
            let across = axes.into_iter().find(|k| *k != up).unwrap_or(0);
            (across, up)
        }
        _ => (axes[0].min(axes[1]), axes[0].max(axes[1])),
    }
}

/// Points of which each is at least a distance from the one before.
pub(crate) fn thinned(points: impl Iterator<Item = (f64, f64)>, least: f64) -> Vec<(f64, f64)> {
    let mut kept: Vec<(f64, f64)> = Vec::new();
    let mut last = None;
    for point in points.filter(|(x, y)| x.is_finite() && y.is_finite()) {
        last = Some(point);
        match kept.last() {
            Some((x, y)) if (point.0 - x).hypot(point.1 - y) < least => {}
            _ => kept.push(point),
        }
    }
    kept.extend(last);
    kept
}

/// Whether successive points are so far apart that lines between them would show what is not there.
fn jumps(points: &[(f64, f64)], far: f64) -> bool {
    let long = points.windows(2).filter(|pair| far < (pair[1].0 - pair[0].0).hypot(pair[1].1 - pair[0].1)).count();
    points.len() < 50 * long
}

/// One point for each occupied cell of a grid.
fn scattered(points: &[(f64, f64)], cell: f64) -> Vec<(f64, f64)> {
    let mut occupied = std::collections::BTreeSet::new();
    #[expect(clippy::cast_possible_truncation, reason = "cells of a figure are few, and the cast saturates")]
    let mut free = |(x, y): &(f64, f64)| occupied.insert(((x / cell).round() as i64, (y / cell).round() as i64));
    points.iter().filter(|(x, y)| x.is_finite() && y.is_finite()).filter(|point| free(point)).copied().collect()
}

struct Curve {
    name: String,
    colour: RGBColor,
    points: Vec<(f64, f64)>,
}

/// The relative drift of each invariant over time.
pub(super) fn invariants(title: &str, history: &History) -> String {
    let series = history.drift_series();
    let curve = |name: &str, index: usize, pick: fn(&crate::run::DriftAt) -> Option<f64>| Curve {
        name: name.to_string(),
        colour: colour(index),
        points: series.iter().filter_map(|drift| Some((drift.time, pick(drift)?))).collect(),
    };
    let mut curves = vec![
        curve("energy", 0, |drift| Some(drift.energy)),
        curve("post-Newtonian energy", 1, |drift| drift.post_newtonian_energy),
        curve("momentum", 2, |drift| drift.momentum),
        curve("angular momentum", 3, |drift| drift.angular_momentum),
    ];
    curves.retain(|curve| !curve.points.is_empty());
    log_figure(&format!("{title}: drift of invariants"), "relative change since the start", curves, false)
}

/// The relative error of each body over time.
pub(super) fn error(title: &str, run: &Run) -> String {
    let Some(errors) = &run.errors else { return figure((780, 520), title, &|_| Ok(())) };
    let curves: Vec<Curve> = errors
        .bodies
        .iter()
        .map(|body| Curve {
            name: body.name.clone(),
            colour: colour(body.body),
            points: body.at.iter().map(|at| (at.time, at.relative)).collect(),
        })
        .collect();
    let few = curves.iter().all(|curve| curve.points.len() <= 12);
    log_figure(&format!("{title}: difference from {}", errors.label), "relative error of position", curves, few)
}

/// Curves over time with a logarithmic ordinate; few instants have marks, and a logarithmic abscissa if none is before zero.
fn log_figure(title: &str, ordinate: &str, mut curves: Vec<Curve>, few: bool) -> String {
    /// Below this a relative change is nothing but the last bit.
    const FLOOR: f64 = 1e-18;
    let spread = few && curves.iter().flat_map(|curve| &curve.points).all(|(t, _)| 0.0 <= *t);
    for curve in &mut curves {
        curve.points.retain(|(t, y)| t.is_finite() && y.is_finite() && FLOOR < *y && (!spread || 0.0 < *t));
    }
    let all = || curves.iter().flat_map(|curve| &curve.points);
    let extreme = |pick: fn(&(f64, f64)) -> f64, fold: fn(f64, f64) -> f64| all().map(pick).reduce(fold);
    let low = extreme(|p| p.1, f64::min).unwrap_or(1e-16);
    let high = extreme(|p| p.1, f64::max).unwrap_or(1e-15);
    let decades = |x: f64, up: bool| 10_f64.powf(if up { x.log10().ceil() } else { x.log10().floor() });
    // Half a decade of air, and no long tail of values that happen to be tiny: two decades below the lowest curve's peak.
    let top = decades(1.5 * high, true);
    let peak = |curve: &Curve| curve.points.iter().map(|p| p.1).reduce(f64::max);
    let lowest_peak = curves.iter().filter_map(peak).reduce(f64::min).unwrap_or(high);
    let tail = if few { low } else { low.max(1e-2 * lowest_peak).min(high) };
    let bottom = decades(tail, false).min(top / 10.0);
    let start = extreme(|p| p.0, f64::min).unwrap_or(0.0);
    let end = extreme(|p| p.0, f64::max).unwrap_or(1.0).max(start + 1e-9 * start.abs() + f64::MIN_POSITIVE);
    let (unit, second) = time_unit(end - start);
    figure((960, 560), title, &|area| {
        let named = 1 < curves.len() && curves.len() <= NAMED;
        let (width, _) = area.dim_in_pixel();
        let (plot, names) = area.split_horizontally(if named { width - 190 * FINE } else { width });
        let description = format!("time ({unit})");
        if spread {
            // Marks stand clear of the frame.
            let range = (0.7 * start / second..1.4 * end / second).log_scale();
            log_chart(&plot, range, bottom..top, (&description, ordinate), &curves, second, true)?;
        } else {
            let range = start / second..end / second;
            log_chart(&plot, range, bottom..top, (&description, ordinate), &curves, second, few)?;
        }
        if named {
            let labels: Vec<(&str, RGBColor)> =
                curves.iter().map(|curve| (curve.name.as_str(), curve.colour)).collect();
            legend(&names, &labels)?;
        }
        Ok(())
    })
}

fn log_chart<X>(
    area: &Area<'_>,
    abscissa: X,
    ordinate: Range<f64>,
    (x_name, y_name): (&str, &str),
    curves: &[Curve],
    second: f64,
    marks: bool,
) -> Drawn
where
    X: AsRangedCoord<Value = f64>,
    X::CoordDescType: ValueFormatter<f64>,
{
    let bottom = ordinate.start;
    let mut chart = ChartBuilder::on(area)
        .margin(pixels(10))
        .x_label_area_size(pixels(52))
        .y_label_area_size(pixels(86))
        .build_cartesian_2d(abscissa, ordinate.log_scale())?;
    let power = |y: &f64| power_of_ten(*y);
    let short = |x: &f64| format_short(*x);
    chart
        .configure_mesh()
        .set_all_tick_mark_size(pixels(5))
        .x_labels(9)
        .y_labels(10)
        .light_line_style(WHITE)
        .bold_line_style(GRID.stroke_width(FINE))
        .axis_style(INK.stroke_width(FINE))
        .label_style((FONT, pixels(14)).into_font().color(&INK))
        .axis_desc_style((FONT, pixels(16)).into_font().color(&INK))
        .x_desc(x_name)
        .y_desc(y_name)
        .x_label_formatter(&short)
        .y_label_formatter(&power)
        .draw()?;
    for curve in curves {
        let points: Vec<(f64, f64)> =
            peaks(&curve.points).into_iter().map(|(t, y)| (t / second, y.max(bottom))).collect();
        let width = if marks || points.len() < 200 { 2 * FINE } else { FINE };
        chart.draw_series(LineSeries::new(points.clone(), curve.colour.stroke_width(width)))?;
        if marks {
            chart.draw_series(points.into_iter().map(|point| Circle::new(point, pixels(4), curve.colour.filled())))?;
        }
    }
    Ok(())
}

/// At most a few thousand points; of each stretch the smallest and the largest, so that no peak is lost.
fn peaks(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    const STRETCHES: usize = 800;
    if points.len() <= 2 * STRETCHES {
        return points.to_vec();
    }
    let length = points.len().div_ceil(STRETCHES);
    let mut kept = Vec::with_capacity(2 * STRETCHES);
    for stretch in points.chunks(length) {
        let by = |a: &&(f64, f64), b: &&(f64, f64)| a.1.total_cmp(&b.1);
        let (least, most) = (stretch.iter().min_by(by), stretch.iter().max_by(by));
        let mut pair: Vec<(f64, f64)> = least.into_iter().chain(most).copied().collect();
        pair.sort_by(|a, b| a.0.total_cmp(&b.0));
        kept.append(&mut pair);
    }
    kept
}

fn draw_legend(area: &Area<'_>, names: &[&str]) -> Drawn {
    let entries: Vec<(&str, RGBColor)> = names.iter().enumerate().map(|(index, name)| (*name, colour(index))).collect();
    legend(area, &entries)
}

pub(crate) fn legend(area: &Area<'_>, entries: &[(&str, RGBColor)]) -> Drawn {
    let mut y = pixels(20);
    for (name, colour) in entries {
        area.draw(&PathElement::new(vec![(pixels(8), y), (pixels(30), y)], colour.stroke_width(3 * FINE)))?;
        let style = (FONT, pixels(15)).into_font().color(&INK).pos(Pos::new(HPos::Left, VPos::Center));
        area.draw(&Text::new((*name).to_string(), (pixels(38), y), style))?;
        y += pixels(22);
    }
    Ok(())
}

/// 1e-13 as 10⁻¹³.
pub(crate) fn power_of_ten(y: f64) -> String {
    #[expect(clippy::cast_possible_truncation, reason = "an exponent of a double")]
    let exponent = y.log10().round() as i32;
    let digit = |c: char| match c {
        '-' => '⁻',
        '0' => '⁰',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        '4' => '⁴',
        '5' => '⁵',
        '6' => '⁶',
        '7' => '⁷',
        '8' => '⁸',
        _ => '⁹',
    };
    format!("10{}", exponent.to_string().chars().map(digit).collect::<String>())
}

/// A number with as many digits as it needs, at most four.
pub(crate) fn format_short(x: f64) -> String {
    let rounded = format!("{x:.4}");
    let trimmed = rounded.trim_end_matches('0').trim_end_matches('.');
    match trimmed {
        "-0" | "" => "0".to_string(),
        _ if 1e5 <= x.abs() => format!("{x:.2e}"),
        _ => trimmed.replace('-', "−"),
    }
}
