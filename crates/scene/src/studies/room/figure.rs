//! Tables and the figure.

use core::f64::consts::TAU;
use core::fmt::Write as _;

use piola_charts::{Canvas, Color as _, FINE, INK, RGBColor, WHITE, Window, colour_bar, figure, viridis};

use super::{Arrivals, Outline, Room};
use crate::studies::samples::lattice;

/// Steps of colour.
const BANDS: u32 = 24;
const CAUSTIC: RGBColor = RGBColor(220, 50, 30);

/// Points on a closed curve.
fn closed(outline: &Outline) -> Vec<[f64; 2]> {
    (0..=400).map(|i| outline.place(TAU * f64::from(i) / 400.0)).collect()
}

/// A file of the plan by its name.
pub(in crate::studies) fn file(found: &Arrivals, asked: &Room, title: &str, name: &str) -> Option<String> {
    match name {
        "arrival.csv" => Some(arrival_table(found)),
        "caustic.csv" => Some(caustic_table(found)),
        "arrival.svg" => Some(drawing(found, asked, title)),
        _ => None,
    }
}

fn arrival_table(found: &Arrivals) -> String {
    let mut text = String::from("x_m,y_m,first_arrival_s\n");
    for ([x, y], time) in &found.arrival {
        if let Some(time) = time {
            let _ = writeln!(text, "{x:?},{y:?},{time:?}");
        }
    }
    text
}

fn caustic_table(found: &Arrivals) -> String {
    let mut text = String::from("piece,x_m,y_m\n");
    for (number, piece) in found.caustic.iter().enumerate() {
        for [x, y] in piece {
            let _ = writeln!(text, "{number},{x:?},{y:?}");
        }
    }
    text
}

fn drawing(found: &Arrivals, asked: &Room, title: &str) -> String {
    let wall = closed(&asked.outline);
    let window = Window::around(wall.iter().copied());
    let latest = found.arrival.iter().filter_map(|(_, time)| *time).fold(0.0, f64::max);
    let share = |band: u32| f64::from(band) / f64::from(BANDS);
    let colours: Vec<RGBColor> = (0..BANDS).map(|band| viridis(share(band))).collect();
    let (wide, tall) = window.size(980);
    figure((wide + 90, tall), title, &|area| {
        let (width, _) = area.dim_in_pixel();
        let (plot, bar) = area.split_horizontally(width - 80 * FINE);
        let mut canvas = Canvas::metres(&plot, window, ("x", "y"))?;
        canvas.fill(&wall, colours[0])?;
        if let Some(field) = &found.field {
            let lattice = &lattice(field);
            let thresholds: Vec<f64> = (1..BANDS).map(|band| share(band) * latest).collect();
            canvas.bands(lattice, &thresholds, &colours[1..], colours[0])?;
        }
        canvas.cover_outside(&wall)?;
        for curve in &found.characteristics {
            canvas.curve(curve, WHITE.mix(0.55).stroke_width(FINE / 2))?;
        }
        for piece in &found.caustic {
            canvas.curve(piece, CAUSTIC.stroke_width(2 * FINE))?;
        }
        canvas.curve(&wall, INK.stroke_width(3 * FINE))?;
        if let Some(circle) = &asked.circle {
            canvas.curve(&closed(circle), WHITE.stroke_width(2 * FINE))?;
        }
        if let Some(loss) = &found.first_loss {
            canvas.mark(loss.place, 5, CAUSTIC)?;
        }
        colour_bar(&bar, "u (s)", &colours, (0.0, latest))
    })
}
