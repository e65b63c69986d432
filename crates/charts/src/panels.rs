//! Panels of measurements: points beside curves, and residuals.

use plotters::prelude::*;

use crate::figure::{Area, Drawn, FINE, FONT, GRID, INK, colour, format_short, pixels};
use crate::ticks;

/// Measured points and a curve for each model, on even scales.
///
/// # Example
/// ```
/// use piola_charts::{Panel, figure};
/// let panel = Panel {
///     name: "uniaxial".into(),
///     axes: ["stretch".into(), "stress (MPa)".into()],
///     points: vec![(1.0, 0.0), (2.0, 0.6)],
///     curves: vec![vec![(1.0, 0.0), (1.5, 0.4), (2.0, 0.6)]],
///     is_curve: true,
/// };
/// assert!(figure((400, 400), "rubber", &|area| panel.draw(area)).contains("stress (MPa)"));
/// ```
#[derive(Debug, Clone)]
pub struct Panel {
    /// The words above it.
    pub name: String,
    /// The names of abscissa and ordinate.
    pub axes: [String; 2],
    /// The measured points.
    pub points: Vec<(f64, f64)>,
    /// A curve for each model, or its answers at the points.
    pub curves: Vec<Vec<(f64, f64)>>,
    /// Whether `curves` are curves, and not answers.
    pub is_curve: bool,
}

/// Curves and marks of a panel with logarithmic axes.
///
/// # Example
/// ```
/// use piola_charts::{LogPanel, figure};
/// let panel = LogPanel {
///     title: "viscosity",
///     axes: ["shear rate (1/s)", "viscosity (Pa s)"],
///     marks: vec![(0.1, 3.0), (1.0, 2.0), (10.0, 1.0)],
///     curves: Vec::new(),
///     band: Vec::new(),
/// };
/// assert!(figure((400, 400), "fluid", &|area| panel.draw(area)).contains("10⁻¹"));
/// ```
#[derive(Debug, Clone)]
pub struct LogPanel<'a> {
    /// The words above it.
    pub title: &'a str,
    /// The names of abscissa and ordinate.
    pub axes: [&'a str; 2],
    /// The measured points.
    pub marks: Vec<(f64, f64)>,
    /// The curves.
    pub curves: Vec<Vec<(f64, f64)>>,
    /// Lower and upper ends at abscissas.
    pub band: Vec<(f64, [f64; 2])>,
}

impl Panel {
    /// Draws it.
    ///
    /// # Errors
    /// Those of the drawing.
    pub fn draw(&self, area: &Area<'_>) -> Drawn {
        let all = || self.points.iter().chain(self.curves.iter().flatten()).filter(|(_, y)| y.is_finite());
        let (left, right) =
            all().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), (x, _)| (low.min(*x), high.max(*x)));
        let measured = self.points.iter().fold((0.0_f64, 0.0_f64), |(low, high), (_, y)| (low.min(*y), high.max(*y)));
        // A curve that leaves the measured range far behind does not press it flat.
        let room = 0.12 * (measured.1 - measured.0).max(f64::MIN_POSITIVE);
        let (bottom, top) = (measured.0 - if measured.0 < 0.0 { room } else { 0.0 }, measured.1 + room);
        let margin = 0.02 * (right - left).max(1e-9);
        let short = |x: &f64| format_short(*x);
        let mut chart = ChartBuilder::on(area)
            .caption(&self.name, (FONT, pixels(16)).into_font().color(&INK))
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
            .x_desc(&self.axes[0])
            .y_desc(&self.axes[1])
            .x_label_formatter(&short)
            .y_label_formatter(&short)
            .draw()?;
        for (index, curve) in self.curves.iter().enumerate() {
            let shown = curve.iter().copied().filter(|(_, y)| y.is_finite() && bottom <= *y && *y <= top);
            if self.is_curve {
                chart.draw_series(LineSeries::new(shown, colour(index).stroke_width(2 * FINE)))?;
            } else {
                chart.draw_series(shown.map(|point| Cross::new(point, pixels(3), colour(index).stroke_width(FINE))))?;
            }
        }
        chart.draw_series(
            self.points.iter().map(|point| Circle::new(*point, pixels(3), INK.stroke_width(3 * FINE / 2))),
        )?;
        Ok(())
    }
}

impl LogPanel<'_> {
    /// Draws it; what is not positive has no logarithm and is left out.
    ///
    /// # Errors
    /// Those of the drawing.
    pub fn draw(&self, area: &Area<'_>) -> Drawn {
        let all = || self.marks.iter().chain(self.curves.iter().flatten()).filter(|(x, y)| 0.0 < *x && 0.0 < *y);
        let range = |pick: fn(&(f64, f64)) -> f64| {
            let (low, high) =
                all().map(pick).fold((f64::INFINITY, 0.0_f64), |(low, high), x| (low.min(x), high.max(x)));
            if low < high { 0.8 * low..1.25 * high } else { 0.1..10.0 }
        };
        let mut chart = ChartBuilder::on(area)
            .caption(self.title, (FONT, pixels(16)).into_font().color(&INK))
            .margin(pixels(8))
            .x_label_area_size(pixels(46))
            .y_label_area_size(pixels(70))
            .build_cartesian_2d(ticks::logarithmic(range(|p| p.0)), ticks::logarithmic(range(|p| p.1)))?;
        let power = |x: &f64| ticks::label(*x);
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
            .x_desc(self.axes[0])
            .y_desc(self.axes[1])
            .x_label_formatter(&power)
            .y_label_formatter(&power)
            .draw()?;
        let upper = self.band.iter().map(|(x, [_, high])| (*x, *high));
        let lower = self.band.iter().rev().map(|(x, [low, _])| (*x, low.max(f64::MIN_POSITIVE)));
        let outline: Vec<(f64, f64)> = upper.chain(lower).collect();
        if !outline.is_empty() {
            chart.draw_series(core::iter::once(Polygon::new(outline, colour(0).mix(0.25))))?;
        }
        for (index, curve) in self.curves.iter().enumerate() {
            let shown = curve.iter().copied().filter(|(x, y)| 0.0 < *x && 0.0 < *y);
            chart.draw_series(LineSeries::new(shown, colour(index).stroke_width(2 * FINE)))?;
        }
        chart.draw_series(
            self.marks.iter().map(|point| Circle::new(*point, pixels(3), INK.stroke_width(3 * FINE / 2))),
        )?;
        Ok(())
    }
}

/// The largest residual of the models that fit well: those whose largest one is within five times the least of these. Others do not press
/// them flat.
fn scale(sets: &[Vec<f64>]) -> f64 {
    const WITHIN: f64 = 5.0;
    let largest = |set: &Vec<f64>| set.iter().filter(|r| r.is_finite()).fold(1e-15_f64, |size, r| size.max(r.abs()));
    let all: Vec<f64> = sets.iter().map(largest).collect();
    let least = all.iter().copied().fold(f64::INFINITY, f64::min);
    all.into_iter().filter(|size| *size <= WITHIN * least).fold(1e-15, f64::max)
}

/// Residuals over the logarithm of what was set, a colour for each model: `drive` names the first numbers of `rows`, `name` the
/// residuals. The scale is that of the models that fit well; residuals beyond it are not drawn.
///
/// # Errors
/// Those of the drawing.
pub fn residuals(area: &Area<'_>, (drive, rows): (&str, &[[f64; 2]]), sets: &[Vec<f64>], name: &str) -> Drawn {
    let drives = || rows.iter().map(|row| row[0]);
    let (left, right) = (drives().fold(f64::INFINITY, f64::min), drives().fold(0.0, f64::max));
    let size = scale(sets);
    let mut chart = ChartBuilder::on(area)
        .caption("residuals", (FONT, pixels(16)).into_font().color(&INK))
        .margin(pixels(8))
        .x_label_area_size(pixels(46))
        .y_label_area_size(pixels(76))
        .build_cartesian_2d(ticks::logarithmic(0.8 * left..1.25 * right), -1.1 * size..1.1 * size)?;
    let power = |x: &f64| ticks::label(*x);
    let percent = |y: &f64| {
        let text = if 1e-4 < size { format!("{:.2} %", 100.0 * y) } else { format!("{y:.0e}") };
        text.replace('-', "−")
    };
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
    for (index, set) in sets.iter().enumerate() {
        let points = drives().zip(set).filter(|(_, r)| r.abs() <= 1.1 * size).map(|(x, r)| (x, *r));
        chart.draw_series(points.map(|point| Circle::new(point, pixels(3), colour(index).filled())))?;
    }
    Ok(())
}
