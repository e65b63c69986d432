//! The chart of flows: an SVG and tables in Markdown.

use std::fmt::Write;

use super::accuracy::{Chart, Measurement, Row};
use super::history::Point;
use crate::figure::{Axis, FAINT, INK, power};

const WIDTH: f64 = 1180.0;
const HEIGHT: f64 = 860.0;
/// Left and upper edges of the panels and their common size.
const EDGES: [[f64; 2]; 4] = [[84.0, 72.0], [674.0, 72.0], [84.0, 440.0], [674.0, 440.0]];
const SIZE: [f64; 2] = [470.0, 280.0];

/// Writing to a string cannot fail.
macro_rules! put {
    ($to:expr, $($argument:tt)*) => { let _ = writeln!($to, $($argument)*); };
}

/// Colours of Okabe and Ito.
const COLOURS: [&str; 5] = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00"];
const FLUIDS: [&str; 3] = ["carreau_yasuda", "power_law", "herschel_bulkley"];
const PANELS: [(&str, &str, &str); 3] = [
    ("profile", "pipe", "profile of a pipe, 33 places"),
    ("discharge", "pipe", "discharge of a pipe"),
    ("torque", "couette", "torque of cylinders at a speed"),
];

/// The figure: three panels of error against time, and one of error against evaluations.
#[must_use]
pub fn figure(chart: &Chart) -> String {
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" width=\"{WIDTH}\" height=\"{HEIGHT}\" \
         font-family=\"Helvetica, Arial, sans-serif\" font-size=\"13\" fill=\"{INK}\">\n\
         <rect width=\"{WIDTH}\" height=\"{HEIGHT}\" fill=\"#ffffff\"/>\n\
         <text x=\"{}\" y=\"28\" font-size=\"17\" font-weight=\"bold\">Flows: error against time; a history: error against \
         evaluations</text>\n",
        EDGES[0][0]
    );
    for ((what, flow, title), edge) in PANELS.into_iter().zip(EDGES) {
        let rows: Vec<_> = chart.rows.iter().filter(|row| row.what == what && row.flow == flow).collect();
        let all =
            rows.iter().flat_map(|row| row.plain.iter().map(|(_, plain)| *plain).chain([row.ours]).chain(row.closed));
        let points: Vec<_> = all.map(|m| [m.error, m.seconds]).collect();
        let axes = axes(&mut svg, edge, title, &points, true);
        for row in rows {
            panel(&mut svg, row, &axes);
        }
    }
    history(&mut svg, chart);
    legend(&mut svg);
    svg.push_str("</svg>\n");
    svg
}

/// Both axes, drawn.
fn axes(svg: &mut String, [left, top]: [f64; 2], title: &str, points: &[[f64; 2]], is_time: bool) -> [Axis; 2] {
    let [width, height] = SIZE;
    let bottom = top + height;
    // With room for the marks themselves.
    let across = points.iter().flat_map(|point| [0.3, 3.0].map(|factor| factor * point[0].max(1e-17)));
    let up = points.iter().flat_map(|point| [0.6, 1.7].map(|factor| factor * point[1]));
    let across = Axis::around(across, [left, left + width]);
    let up = Axis::around(up, [bottom, top]);
    put!(svg, "<text x=\"{left}\" y=\"{:.1}\">{title}</text>", top - 10.0);
    for decade in across.decades() {
        let x = across.place(10.0_f64.powi(decade));
        put!(svg, "<path d=\"M{x:.1} {top}V{bottom}\" stroke=\"{FAINT}\"/>");
        if decade % 4 == 0 {
            put!(svg, "<text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>", bottom + 18.0, power(decade));
        }
    }
    for decade in up.decades() {
        let y = up.place(10.0_f64.powi(decade));
        put!(svg, "<path d=\"M{left} {y:.1}h{width}\" stroke=\"{FAINT}\"/>");
        let text = if is_time { time(10.0_f64.powi(decade)) } else { format!("{:.0}", 10.0_f64.powi(decade)) };
        put!(svg, "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{text}</text>", left - 6.0, y + 4.5);
    }
    put!(svg, "<rect x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\" fill=\"none\" stroke=\"{INK}\"/>");
    let (middle, below) = (left + 0.5 * width, bottom + 38.0);
    put!(
        svg,
        "<text x=\"{middle:.1}\" y=\"{below:.1}\" text-anchor=\"middle\">relative error (better to the left)</text>"
    );
    [across, up]
}

fn panel(svg: &mut String, row: &Row, [across, up]: &[Axis; 2]) {
    let colour = COLOURS[FLUIDS.iter().position(|fluid| *fluid == row.fluid).unwrap_or(3)];
    let place = |m: Measurement| [across.place(m.error.max(1e-17)), up.place(m.seconds)];
    let places: Vec<_> = row.plain.iter().map(|(_, plain)| place(*plain)).collect();
    put!(svg, "<g><title>{}</title>", named(row.fluid));
    line(svg, &places, colour);
    if let Some(closed) = row.closed {
        let [x, y] = place(closed);
        put!(
            svg,
            "<path d=\"M{:.1} {:.1}l9 9m0 -9l-9 9\" stroke=\"{colour}\" stroke-width=\"2.5\"/>",
            x - 4.5,
            y - 4.5
        );
    }
    diamond(svg, place(row.ours), colour);
    put!(svg, "</g>");
}

/// Hollow circles, joined by dashes.
fn line(svg: &mut String, places: &[[f64; 2]], colour: &str) {
    let mut path = String::new();
    for (number, [x, y]) in places.iter().enumerate() {
        let _ = write!(path, "{}{x:.1} {y:.1}", if number == 0 { "M" } else { "L" });
    }
    put!(svg, "<path d=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-dasharray=\"5 3\"/>");
    for [x, y] in places {
        put!(
            svg,
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3\" fill=\"#ffffff\" stroke=\"{colour}\" stroke-width=\"1.5\"/>"
        );
    }
}

fn diamond(svg: &mut String, [x, y]: [f64; 2], colour: &str) {
    put!(svg, "<path d=\"M{x:.1} {:.1}l6.5 6.5l-6.5 6.5l-6.5 -6.5z\" fill=\"{colour}\"/>", y - 6.5);
}

fn history(svg: &mut String, chart: &Chart) {
    let points: Vec<_> = chart.history.iter().map(|point| [point.error, point.evaluations as f64]).collect();
    let title = "τ of a K-BKZ fluid of three times: evaluations of its history";
    let [across, up] = axes(svg, EDGES[3], title, &points, false);
    let mut methods: Vec<&str> = chart.history.iter().map(|point| point.method).collect();
    methods.dedup();
    let mut labels = Vec::new();
    for (method, colour) in methods.into_iter().zip(COLOURS) {
        let places: Vec<_> = chart
            .history
            .iter()
            .filter(|point| point.method == method)
            .map(|point| [across.place(point.error.max(1e-17)), up.place(point.evaluations as f64)])
            .collect();
        let Some([x, y]) = places.last().copied() else { continue };
        if method.starts_with("Piola") {
            diamond(svg, [x, y], colour);
        } else {
            line(svg, &places, colour);
        }
        labels.push((method, colour));
    }
    let [left, top] = EDGES[3];
    for (number, (method, colour)) in labels.into_iter().enumerate() {
        let (x, y) = (left + 16.0, top + 20.0 + 18.0 * number as f64);
        put!(svg, "<circle cx=\"{x}\" cy=\"{:.1}\" r=\"4\" fill=\"{colour}\"/>", y - 4.5);
        put!(svg, "<text x=\"{:.1}\" y=\"{y}\">{method}</text>", x + 10.0);
    }
}

fn legend(svg: &mut String) {
    let y = HEIGHT - 40.0;
    for (number, (fluid, colour)) in FLUIDS.into_iter().zip(COLOURS).enumerate() {
        let x = EDGES[0][0] + 190.0 * number as f64;
        put!(svg, "<rect x=\"{x}\" y=\"{:.1}\" width=\"14\" height=\"10\" fill=\"{colour}\"/>", y - 10.0);
        put!(svg, "<text x=\"{:.1}\" y=\"{y}\">{}</text>", x + 20.0, named(fluid));
    }
    let left = EDGES[0][0];
    put!(
        svg,
        "<text x=\"{left}\" y=\"{:.1}\">full diamond: Piola as it is; circles: adaptive Gauss–Kronrod 7-15 of the textbook's \
         formula, tolerances 10⁻³ to 10⁻¹²; cross: closed form</text>",
        HEIGHT - 16.0
    );
}

fn named(fluid: &str) -> &str {
    match fluid {
        "carreau_yasuda" => "Carreau–Yasuda",
        "power_law" => "power law",
        "herschel_bulkley" => "Herschel–Bulkley",
        other => other,
    }
}

/// A time with its unit.
fn time(seconds: f64) -> String {
    if seconds < 0.999e-6 {
        format!("{:.0} ns", 1e9 * seconds)
    } else if seconds < 0.999e-3 {
        format!("{:.3} µs", 1e6 * seconds).replace(".000", "")
    } else {
        format!("{:.0} ms", 1e3 * seconds)
    }
}

/// The tables, with what is claimed of them.
#[must_use]
pub fn page(chart: &Chart) -> String {
    let mut page = String::from(HEAD);
    for (title, what, flow) in [
        ("Profile of a pipe, 33 places", "profile", "pipe"),
        ("Discharge of a pipe", "discharge", "pipe"),
        ("Discharge of a channel", "discharge", "channel"),
        ("Torque of cylinders at a given speed", "torque", "couette"),
    ] {
        put!(page, "\n## {title}\n");
        put!(
            page,
            "| fluid | Piola, µs | its error | its bound | closed form, µs | error | plain, 1e-6, µs | error | plain, 1e-12, µs | error |"
        );
        put!(page, "|---|---|---|---|---|---|---|---|---|---|");
        let rows = || chart.rows.iter().filter(|row| row.what == what && row.flow == flow);
        for row in rows() {
            put!(page, "{}", line_of(row));
        }
        put!(page, "\n{}", verdict(rows()));
    }
    put!(page, "\n## History of a K-BKZ fluid\n\n{HISTORY}\n");
    put!(page, "| way | setting | evaluations | µs | error |\n|---|---|---|---|---|");
    for point in &chart.history {
        let Point { method, setting, evaluations, seconds, error } = point;
        put!(page, "| {method} | {setting} | {evaluations} | {:.2} | {error:.1e} |", 1e6 * seconds);
    }
    page
}

const HEAD: &str = "# Accuracy and time of flows

Written by `cargo xtask viscometry-accuracy`: medians of 21 rounds in which all ways take turns, one core, cargo's own release
profile. Errors are true ones, relative to the largest answer: the printed formulas integrated over numbers of 31 digits.

Piola has no tolerance to choose: it integrates until only rounding is left. Plain is the textbook's formula in the radius by adaptive quadrature
with Gauss's and Kronrod's rules of 7 and 15 points and QUADPACK's estimate of the error, begun at the edge of the plug; rates at
stresses are those of the fluids of Piola. The fluids: Carreau–Yasuda (1 Pa s, 0, 2 s, n = 0.5, a = 1.25), a power law (1.5 Pa sⁿ, n = 0.4)
and Herschel–Bulkley's (0.5 Pa, 1 Pa sⁿ, n = 0.4), under stresses at the wall of 1.5 to 2.5 Pa.

![Error against time](figures/viscometry-accuracy.svg)
";

const HISTORY: &str = "The shear stress at 5 s⁻¹ of three terms of memory (0.01, 0.1 and 1 s) with Wagner's damping e^(−0.3 γ), whose closed form is the truth. \
In steady shear Piola takes equal steps of u with s = s₀ e^(u − e^(−u)), term by term: the error falls like e^(−π²/step), and the step is a fifth. \
Its evaluations are of one term each, those of the other ways of all three. A history that starts is integrated adaptively, its \
normal stress too.
";

fn line_of(row: &Row) -> String {
    let micro = |m: Measurement| format!("{:.3}", 1e6 * m.seconds);
    let closed =
        row.closed.map_or("| – | –".into(), |closed| format!("| {} | {:.1e}", micro(closed), closed.error));
    let plain = |wanted: i32| {
        let found = row.plain.iter().find(|(power, _)| *power == wanted);
        found.map_or(String::new(), |(_, plain)| format!("| {} | {:.1e}", micro(*plain), plain.error))
    };
    let bound = if row.bound.is_nan() { "–".into() } else { format!("{:.1e}", row.bound) };
    let ours = format!("| {} | {} | {:.1e} | {bound} ", named(row.fluid), micro(row.ours), row.ours.error);
    format!("{ours}{closed} {} {} |", plain(-6), plain(-12))
}

/// Whether any plain way is at once as fast and as accurate as ours, and how the times compare at 1e-12.
fn verdict<'a>(rows: impl Iterator<Item = &'a Row> + Clone) -> String {
    let beaten: Vec<_> = rows
        .clone()
        .flat_map(|row| row.beaten_by().map(|power| format!("{} at 1e{power}", named(row.fluid))))
        .collect();
    let front = if beaten.is_empty() {
        "No tolerance of plain quadrature is at once as fast and as accurate as Piola".into()
    } else {
        format!("Plain quadrature is at once as fast and as accurate as Piola for {}", beaten.join(", "))
    };
    let ratios: Vec<_> = rows
        .filter_map(|row| {
            let (_, plain) = row.plain.iter().find(|(power, _)| *power == -12)?;
            Some(format!("{:.0} × ({})", plain.seconds / row.ours.seconds, named(row.fluid)))
        })
        .collect();
    format!("{front}. Plain at 1e-12 takes {} as long.", ratios.join(", "))
}
