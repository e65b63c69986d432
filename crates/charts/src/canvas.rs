//! Plane figures true to scale, and their colours.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::contour::{Lattice, area};
use crate::figure::{Area, Drawn, FINE, FONT, INK, format_short, length_unit, pixels};
use crate::plane::{Plane, plane_chart, plane_in, thinned};

/// A rectangle of the plane.
///
/// # Example
/// ```
/// let window = piola_charts::Window::around([[0.0, 0.0], [2.0, 1.0]].into_iter());
/// assert!(window.low[0] < 0.0 && 2.0 < window.high[0]);
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Window {
    /// The least coordinates.
    pub low: [f64; 2],
    /// The largest coordinates.
    pub high: [f64; 2],
}

impl Window {
    /// The smallest one that holds all points, with some air.
    #[must_use]
    pub fn around(points: impl Iterator<Item = [f64; 2]>) -> Self {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        // Differences and squares of larger numbers would overflow.
        for point in points.filter(|point| point.iter().all(|x| x.abs() < 1e100)) {
            for k in 0..2 {
                low[k] = low[k].min(point[k]);
                high[k] = high[k].max(point[k]);
            }
        }
        if !(low[0] <= high[0] && low[1] <= high[1]) {
            (low, high) = ([-1.0; 2], [1.0; 2]);
        }
        let air = 0.03 * (high[0] - low[0]).max(high[1] - low[1]).max(f64::MIN_POSITIVE);
        Self { low: low.map(|x| x - air), high: high.map(|x| x + air) }
    }

    /// The size of a figure of about a width in which one scale holds for both axes.
    #[must_use]
    pub fn size(&self, width: u32) -> (u32, u32) {
        let ratio = (self.high[1] - self.low[1]) / (self.high[0] - self.low[0]);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 260 and 1200")]
        let height = (f64::from(width - 140) * ratio + 130.0).clamp(260.0, 1200.0) as u32;
        (width, height)
    }
}

/// Curves and areas over a window, one scale for both axes. The README has an example.
#[expect(missing_debug_implementations, reason = "the chart of plotters has none")]
pub struct Canvas<'a> {
    chart: Plane<'a>,
    /// The unit of a length in metres.
    unit: f64,
    /// Length of the plane that a coordinate of the drawing makes, in the unit.
    grain: f64,
}

impl<'a> Canvas<'a> {
    /// Axes in metres, or whatever suits them, with their names.
    ///
    /// # Errors
    /// Those of the drawing.
    pub fn metres(
        area: &Area<'a>,
        window: Window,
        (across, up): (&str, &str),
    ) -> Result<Self, Box<dyn core::error::Error>> {
        let largest = window.low.iter().chain(&window.high).fold(0.0, |m: f64, x| m.max(x.abs()));
        let (name, unit) = length_unit(largest);
        let (width, height) = area.dim_in_pixel();
        let [wide, tall] = plane_in(width, height);
        let Window { low, high } = window;
        let grain = ((high[0] - low[0]) / wide).max((high[1] - low[1]) / tall) / unit;
        let range = |k: usize, pixels: f64| {
            let middle = 0.5 * (low[k] + high[k]) / unit;
            middle - 0.5 * grain * pixels..middle + 0.5 * grain * pixels
        };
        let named = |axis: &str| format!("{axis} ({name})");
        let chart = plane_chart(area, (range(0, wide), range(1, tall)), (named(across), named(up)))?;
        Ok(Self { chart, unit, grain })
    }

    fn scaled(&self, points: &[[f64; 2]]) -> Vec<(f64, f64)> {
        thinned(points.iter().map(|[x, y]| (x / self.unit, y / self.unit)), 1.5 * f64::from(FINE) * self.grain)
    }

    /// A curve; what leaves the window ends at its border.
    ///
    /// # Errors
    /// Those of the drawing.
    pub fn curve(&mut self, points: &[[f64; 2]], style: ShapeStyle) -> Drawn {
        let points = self.scaled(points);
        self.chart.draw_series(LineSeries::new(points, style))?;
        Ok(())
    }

    /// A filled polygon.
    ///
    /// # Errors
    /// Those of the drawing.
    pub fn fill(&mut self, polygon: &[[f64; 2]], colour: RGBColor) -> Drawn {
        let points = self.scaled(polygon);
        if 2 < points.len() {
            self.chart.draw_series([Polygon::new(points, colour.filled())])?;
        }
        Ok(())
    }

    /// White over everything outside of a closed curve.
    ///
    /// # Errors
    /// Those of the drawing.
    pub fn cover_outside(&mut self, curve: &[[f64; 2]]) -> Drawn {
        let (x, y) = (self.chart.x_range(), self.chart.y_range());
        let corners = [(x.start, y.start), (x.end, y.start), (x.end, y.end), (x.start, y.end), (x.start, y.start)];
        let inner: Vec<(f64, f64)> = curve.iter().rev().map(|[x, y]| (x / self.unit, y / self.unit)).collect();
        // One polygon: around the window, in to the curve, around it the other way.
        let ring: Vec<(f64, f64)> = corners.into_iter().chain(inner).collect();
        self.chart.draw_series([Polygon::new(ring, WHITE.filled())])?;
        Ok(())
    }

    /// A disc with a white rim.
    ///
    /// # Errors
    /// Those of the drawing.
    pub fn mark(&mut self, [x, y]: [f64; 2], radius: u32, colour: RGBColor) -> Drawn {
        let place = (x / self.unit, y / self.unit);
        self.chart.draw_series([Circle::new(place, pixels(radius + 1), WHITE.filled())])?;
        self.chart.draw_series([Circle::new(place, pixels(radius), colour.filled())])?;
        Ok(())
    }

    /// The values of a lattice in steps of colour, from `beneath` up.
    ///
    /// # Errors
    /// Those of the drawing.
    pub fn bands(&mut self, lattice: &Lattice, thresholds: &[f64], colours: &[RGBColor], beneath: RGBColor) -> Drawn {
        for (index, (threshold, colour)) in thresholds.iter().zip(colours).enumerate() {
            for polygon in lattice.region(*threshold) {
                let hole = area(&polygon) < 0.0;
                let below = index.checked_sub(1).map_or(beneath, |below| colours[below]);
                self.fill(&polygon, if hole { below } else { *colour })?;
            }
        }
        Ok(())
    }
}

/// Colours with the values at their borders, in a narrow area.
///
/// # Errors
/// Those of the drawing.
pub fn colour_bar(area: &Area<'_>, name: &str, colours: &[RGBColor], (low, high): (f64, f64)) -> Drawn {
    let (_, height) = area.dim_in_pixel();
    let (top, bottom) = (pixels(40), i32::try_from(height)? - pixels(70));
    let count = i32::try_from(colours.len().max(1))?;
    let style = (FONT, pixels(14)).into_font().color(&INK).pos(Pos::new(HPos::Left, VPos::Center));
    area.draw(&Text::new(name.to_string(), (pixels(4), pixels(20)), style.clone()))?;
    for (index, colour) in (0..).zip(colours) {
        let place = |index: i32| bottom - (bottom - top) * index / count;
        area.draw(&Rectangle::new([(pixels(6), place(index + 1)), (pixels(26), place(index))], colour.filled()))?;
    }
    for step in 0..=4 {
        let value = low + f64::from(step) / 4.0 * (high - low);
        let y = bottom - (bottom - top) * step / 4;
        area.draw(&Text::new(format_short(value), (pixels(32), y), style.clone()))?;
    }
    Ok(())
}

/// A colour between two.
#[must_use]
pub fn between(a: RGBColor, b: RGBColor, share: f64) -> RGBColor {
    let share = share.clamp(0.0, 1.0);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between two bytes")]
    let mixed = |a: u8, b: u8| (f64::from(a) + share * (f64::from(b) - f64::from(a))).round() as u8;
    RGBColor(mixed(a.0, b.0), mixed(a.1, b.1), mixed(a.2, b.2))
}

/// From dark blue over green to yellow, evenly lighter: told apart by everyone, and in grey.
#[must_use]
pub fn viridis(share: f64) -> RGBColor {
    const STOPS: [RGBColor; 9] = [
        RGBColor(68, 1, 84),
        RGBColor(71, 44, 122),
        RGBColor(59, 81, 139),
        RGBColor(44, 113, 142),
        RGBColor(33, 144, 141),
        RGBColor(39, 173, 129),
        RGBColor(92, 200, 99),
        RGBColor(170, 220, 50),
        RGBColor(253, 231, 37),
    ];
    let place = share.clamp(0.0, 1.0) * (STOPS.len() - 1) as f64;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between zero and eight")]
    let index = (place as usize).min(STOPS.len() - 2);
    between(STOPS[index], STOPS[index + 1], place - index as f64)
}
