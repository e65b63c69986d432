//! Small positive numbers over time: drifts and errors.

use core::ops::Range;

use plotters::coord::ranged1d::{AsRangedCoord, ValueFormatter};
use plotters::prelude::*;

use crate::figure::{
    Area, Drawn, FINE, FONT, GRID, INK, MOST_NAMED, figure, format_short, legend, pixels, power_of_ten,
};

/// A curve over time.
#[derive(Debug, Clone)]
pub struct TimeCurve {
    /// Its name in the legend.
    pub name: String,
    /// Its colour.
    pub colour: RGBColor,
    /// Times in seconds, with the numbers.
    pub points: Vec<(f64, f64)>,
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

/// Curves over time with a logarithmic ordinate; few instants have marks, and a logarithmic abscissa if none is before zero.
///
/// # Example
/// ```
/// use piola_charts::{TimeCurve, colour, time_figure};
/// let drift = TimeCurve { name: "energy".into(), colour: colour(0), points: vec![(0.0, 1e-16), (1.0, 1e-15)] };
/// assert!(time_figure("drift", "relative change", vec![drift], false).contains("10⁻¹⁵"));
/// ```
#[must_use]
pub fn time_figure(title: &str, ordinate: &str, mut curves: Vec<TimeCurve>, few: bool) -> String {
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
    let peak = |curve: &TimeCurve| curve.points.iter().map(|p| p.1).reduce(f64::max);
    let lowest_peak = curves.iter().filter_map(peak).reduce(f64::min).unwrap_or(high);
    let tail = if few { low } else { low.max(1e-2 * lowest_peak).min(high) };
    let bottom = decades(tail, false).min(top / 10.0);
    let start = extreme(|p| p.0, f64::min).unwrap_or(0.0);
    let end = extreme(|p| p.0, f64::max).unwrap_or(1.0).max(start + 1e-9 * start.abs() + f64::MIN_POSITIVE);
    let (unit, second) = time_unit(end - start);
    // One curve has no legend: its name stands at the axis.
    let ordinate = match curves.as_slice() {
        [one] if !one.name.is_empty() => &format!("{ordinate}: {}", one.name),
        _ => ordinate,
    };
    figure((960, 560), title, &|area| {
        let named = 1 < curves.len() && curves.len() <= MOST_NAMED;
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
    curves: &[TimeCurve],
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
