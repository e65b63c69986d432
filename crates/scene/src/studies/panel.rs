//! Panels of a figure: curves, marks and their names over linear axes.

use core::ops::Range;

use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use piola_charts::{Area, Drawn, FINE, FONT, INK, Plane, colour, format_short, pixels, plane_chart};

/// Curves and marks over two axes.
#[derive(Default)]
pub(super) struct Panel {
    title: String,
    axes: [String; 2],
    curves: Vec<Curve>,
    marks: Vec<Mark>,
    /// Whether zero is shown on the upright axis.
    has_zero: bool,
}

struct Curve {
    name: String,
    points: Vec<(f64, f64)>,
    colour: RGBColor,
    is_dashed: bool,
}

struct Mark {
    name: String,
    place: (f64, f64),
    colour: RGBColor,
    is_filled: bool,
    is_below: bool,
}

/// How far the pieces of a dashed curve reach, and the gaps between them.
const DASH: u32 = 7;
const GAP: u32 = 5;

impl Panel {
    pub(super) fn new(title: &str, across: impl Into<String>, up: impl Into<String>) -> Self {
        Self { title: title.to_string(), axes: [across.into(), up.into()], ..Self::default() }
    }

    /// Adds a curve in a colour of the palette; one without a name is not in the legend.
    pub(super) fn curve(mut self, name: &str, index: usize, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let points = finite(points);
        self.curves.push(Curve { name: name.to_string(), points, colour: colour(index), is_dashed: false });
        self
    }

    /// Adds a curve of dashes.
    pub(super) fn dashed(mut self, name: &str, index: usize, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let points = finite(points);
        self.curves.push(Curve { name: name.to_string(), points, colour: colour(index), is_dashed: true });
        self
    }

    /// Shows zero on the upright axis.
    pub(super) const fn with_zero(mut self) -> Self {
        self.has_zero = true;
        self
    }

    /// Adds a disc with a name below it.
    #[cfg(feature = "solutions")]
    pub(super) fn mark_below(self, name: &str, index: usize, place: (f64, f64)) -> Self {
        let mut panel = self.mark(name, index, place, true);
        if let Some(mark) = panel.marks.last_mut() {
            mark.is_below = true;
        }
        panel
    }

    /// Adds a disc with a name above it, or a ring.
    pub(super) fn mark(mut self, name: &str, index: usize, place: (f64, f64), is_filled: bool) -> Self {
        if place.0.is_finite() && place.1.is_finite() {
            self.marks.push(Mark { name: name.to_string(), place, colour: colour(index), is_filled, is_below: false });
        }
        self
    }

    pub(super) fn draw(&self, area: &Area<'_>) -> Drawn {
        let (width, _) = area.dim_in_pixel();
        let rows = self.rows(width);
        let head = 26 + 20 * u32::try_from(rows.len())?;
        let (top, plot) = area.split_vertically(head * FINE);
        self.head(&top, &rows)?;
        let points = || {
            let curves = self.curves.iter().flat_map(|curve| &curve.points);
            curves.chain(self.marks.iter().map(|mark| &mark.place))
        };
        let ranges = (
            range(points().map(|p| p.0), 0.02),
            range(points().map(|p| p.1).chain(self.has_zero.then_some(0.0)), 0.06),
        );
        let [across, up] = self.axes.clone();
        let mut chart = plane_chart(&plot, ranges, (across, up))?;
        for curve in &self.curves {
            let style = curve.colour.stroke_width(2 * FINE);
            if curve.is_dashed {
                let element = DashedPathElement::new(curve.points.clone(), pixels(DASH), pixels(GAP), style);
                chart.draw_series([element])?;
            } else {
                chart.draw_series(LineSeries::new(curve.points.iter().copied(), style))?;
            }
        }
        for mark in &self.marks {
            draw_mark(&mut chart, mark)?;
        }
        Ok(())
    }

    /// Names of curves, as many in a row as fit.
    fn rows(&self, width: u32) -> Vec<Vec<&Curve>> {
        let mut rows: Vec<Vec<&Curve>> = Vec::new();
        let mut free = 0;
        for curve in self.curves.iter().filter(|curve| !curve.name.is_empty()) {
            let needed = entry_width(&curve.name);
            if let Some(row) = rows.last_mut().filter(|_| needed <= free) {
                row.push(curve);
            } else {
                rows.push(vec![curve]);
                free = (width / FINE).saturating_sub(START);
            }
            free = free.saturating_sub(needed);
        }
        rows
    }

    fn head(&self, area: &Area<'_>, rows: &[Vec<&Curve>]) -> Drawn {
        let style = |size: u32| (FONT, pixels(size)).into_font().color(&INK).pos(Pos::new(HPos::Left, VPos::Center));
        area.draw(&Text::new(self.title.clone(), (pixels(START), pixels(12)), style(17)))?;
        let mut y = 34;
        for row in rows {
            let mut x = START;
            for curve in row {
                let line = vec![(pixels(x), pixels(y)), (pixels(x + 24), pixels(y))];
                let stroke = curve.colour.stroke_width(3 * FINE);
                if curve.is_dashed {
                    area.draw(&DashedPathElement::new(line, pixels(DASH), pixels(GAP), stroke))?;
                } else {
                    area.draw(&PathElement::new(line, stroke))?;
                }
                area.draw(&Text::new(curve.name.clone(), (pixels(x + 30), pixels(y)), style(14)))?;
                x += entry_width(&curve.name);
            }
            y += 20;
        }
        Ok(())
    }
}

/// Where titles and legends begin: at the axis.
const START: u32 = 80;

/// Pixels of an entry of the legend: its line, and a name in the reader's own font, of which the width is guessed.
fn entry_width(name: &str) -> u32 {
    let letters = u32::try_from(name.chars().filter(|c| !('\u{300}'..'\u{370}').contains(c)).count()).unwrap_or(40);
    46 + 15 * letters / 2
}

fn finite(points: impl IntoIterator<Item = (f64, f64)>) -> Vec<(f64, f64)> {
    points.into_iter().filter(|(x, y)| x.is_finite() && y.is_finite()).collect()
}

/// The range of some numbers with a share of air.
fn range(numbers: impl Iterator<Item = f64>, air: f64) -> Range<f64> {
    let (low, high) = numbers.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
    if low < high {
        let air = air * (high - low);
        return low - air..high + air;
    }
    let middle = if low.is_finite() { low } else { 0.0 };
    let air = 0.1 * middle.abs().max(1e-9);
    middle - air..middle + air
}

fn draw_mark(chart: &mut Plane<'_>, mark: &Mark) -> Drawn {
    let inside = if mark.is_filled { mark.colour } else { WHITE };
    // Towards the middle, so that no name is cut.
    let range = chart.x_range();
    let is_right = 0.6 * (range.end - range.start) < mark.place.0 - range.start;
    let (side, shift) = if is_right { (HPos::Right, -pixels(8)) } else { (HPos::Left, pixels(8)) };
    let (level, rise) = if mark.is_below { (VPos::Top, pixels(6)) } else { (VPos::Bottom, -pixels(6)) };
    let style = (FONT, pixels(14)).into_font().color(&mark.colour).pos(Pos::new(side, level));
    chart.draw_series([EmptyElement::at(mark.place)
        + Circle::new((0, 0), pixels(6), mark.colour.filled())
        + Circle::new((0, 0), pixels(4), inside.filled())
        + Text::new(mark.name.clone(), (shift, rise), style)])?;
    Ok(())
}

/// A multiple of a unit that suits numbers of a size: its name, and what it is in the unit.
pub(super) fn prefixed(unit: &str, largest: f64) -> (String, f64) {
    const PREFIXES: [(&str, f64); 7] =
        [("n", 1e-9), ("µ", 1e-6), ("m", 1e-3), ("", 1.0), ("k", 1e3), ("M", 1e6), ("G", 1e9)];
    let fitting = PREFIXES.iter().rev().find(|(_, size)| 0.8 * size <= largest.abs());
    let (prefix, size) = fitting.copied().unwrap_or(("", 1.0));
    (format!("{prefix}{unit}"), size)
}

/// A quantity in words: `4.5 mm`, `1.06 MPa`.
pub(super) fn quantity(unit: &str, value: f64) -> String {
    let (name, size) = prefixed(unit, value);
    format!("{} {name}", format_short(value / size))
}

/// The largest size of some numbers.
pub(super) fn largest(numbers: impl IntoIterator<Item = f64>) -> f64 {
    numbers.into_iter().filter(|x| x.is_finite()).fold(0.0, |size, x| size.max(x.abs()))
}
