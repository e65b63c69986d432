//! Tables and the figure.

use core::fmt::Write as _;

use piola_charts::{Canvas, Color as _, FINE, Lattice, RGBColor, WHITE, Window, between, colour, figure};

use super::{CausticMark, Fronts, Source, Wavefront};

/// Steps of the shade of the medium.
const SHADES: u32 = 12;
const CAUSTIC: RGBColor = RGBColor(200, 40, 20);
const RAY: RGBColor = RGBColor(150, 150, 150);

/// A file of the plan by its name.
pub(in crate::studies) fn file(found: &Fronts, asked: &Wavefront, title: &str, name: &str) -> Option<String> {
    match name {
        "fronts.csv" => Some(fronts_table(found)),
        "caustic.csv" => Some(caustic_table(found)),
        "fronts.svg" => Some(drawing(found, asked, title)),
        _ => None,
    }
}

fn fronts_table(found: &Fronts) -> String {
    let mut text = String::from("optical_length_m,piece,x_m,y_m\n");
    for front in &found.fronts {
        for (number, piece) in front.pieces.iter().enumerate() {
            for [x, y] in piece {
                let _ = writeln!(text, "{:?},{number},{x:?},{y:?}", front.length);
            }
        }
    }
    text
}

fn caustic_table(found: &Fronts) -> String {
    let mut text = String::from("ray,order,optical_length_m,x_m,y_m\n");
    for mark in &found.caustic {
        let [x, y] = mark.place;
        let _ = writeln!(text, "{:?},{},{:?},{x:?},{y:?}", mark.parameter, mark.order, mark.length);
    }
    text
}

/// Caustics as curves: the places where neighbouring rays touch their first caustic, their second, and so on.
fn branches(found: &Fronts, gap: f64) -> Vec<Vec<[f64; 2]>> {
    let mut marks: Vec<&CausticMark> = found.caustic.iter().collect();
    marks.sort_by(|a, b| a.order.cmp(&b.order).then(a.parameter.total_cmp(&b.parameter)));
    let together = |a: &&CausticMark, b: &&CausticMark| a.order == b.order && b.parameter - a.parameter < gap;
    marks.chunk_by(together).map(|branch| branch.iter().map(|mark| mark.place).collect()).collect()
}

fn drawing(found: &Fronts, asked: &Wavefront, title: &str) -> String {
    let source: Vec<[f64; 2]> = match asked.source {
        Source::Plane { middle: [x, y], direction: [u, v], width } => {
            [-0.5, 0.5].map(|side| [x - side * width * v, y + side * width * u]).to_vec()
        }
        Source::Point { place, .. } => vec![place],
    };
    let points = found.fronts.iter().flat_map(|front| front.pieces.iter().flatten()).chain(&source).copied();
    let window = Window::around(points);
    figure(window.size(980), title, &|area| {
        let mut canvas = Canvas::metres(area, window, ("x", "y"))?;
        let medium = Lattice::of(window.low, window.high, [161, 161], |place| asked.medium.index(place));
        let (low, high) = medium.range();
        if 1e-9 * high < high - low {
            let share = |step: u32| f64::from(step) / f64::from(SHADES);
            let thresholds: Vec<f64> = (1..SHADES).map(|step| low + share(step) * (high - low)).collect();
            let shades: Vec<RGBColor> =
                (1..SHADES).map(|step| between(WHITE, RGBColor(150, 196, 226), share(step))).collect();
            canvas.bands(&medium, &thresholds, &shades, WHITE)?;
        }
        for ray in &found.rays {
            canvas.curve(ray, RAY.stroke_width(FINE / 2))?;
        }
        let blue = colour(0);
        for front in &found.fronts {
            for piece in &front.pieces {
                canvas.curve(piece, blue.stroke_width(5 * FINE / 4))?;
            }
        }
        canvas.curve(&source, blue.stroke_width(3 * FINE))?;
        let (from, to) = asked.source.range();
        for branch in branches(found, 2.5 * (to - from) / f64::from(asked.rays)) {
            canvas.curve(&branch, CAUSTIC.stroke_width(2 * FINE))?;
        }
        if let Some(first) = found.first_caustic() {
            canvas.mark(first.place, 4, CAUSTIC)?;
        }
        Ok(())
    })
}
