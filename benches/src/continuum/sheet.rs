//! The chart of accuracy against time: an SVG and tables in Markdown.

use std::fmt::Write;

use super::accuracy::{Chart, Measurement, Method, Task};
use crate::figure::{Axis, FAINT, INK, power};

const WIDTH: f64 = 1180.0;
const HEIGHT: f64 = 470.0;
/// Left edges of the panels and their common size.
const LEFT: [f64; 3] = [70.0, 440.0, 810.0];
const SIZE: [f64; 2] = [330.0, 290.0];
const TOP: f64 = 64.0;

/// Writing to a string cannot fail.
macro_rules! put {
    ($to:expr, $($argument:tt)*) => { let _ = writeln!($to, $($argument)*); };
}

/// Colours of Okabe and Ito, in the order of the methods.
const COLOURS: [&str; 5] = ["#0072B2", "#009E73", "#D55E00", "#CC79A7", "#E69F00"];

/// The figure: three panels, error to the right, time upwards; hollow marks where λ₁/λ₃ ≤ 10, full ones on the full set.
#[must_use]
pub fn figure(chart: &Chart) -> String {
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" width=\"{WIDTH}\" height=\"{HEIGHT}\" \
         font-family=\"Helvetica, Arial, sans-serif\" font-size=\"13\" fill=\"{INK}\">\n\
         <rect width=\"{WIDTH}\" height=\"{HEIGHT}\" fill=\"#ffffff\"/>\n\
         <text x=\"{}\" y=\"28\" font-size=\"17\" font-weight=\"bold\">3×3 decompositions: time and worst error</text>\n",
        LEFT[0]
    );
    let all = chart.tasks.iter().flat_map(|task| &task.methods).flat_map(|method| [method.ordinary, method.full]);
    for (task, left) in chart.tasks.iter().zip(LEFT) {
        // With room for the marks themselves.
        let errors = all.clone().flat_map(|m| [0.3, 3.0].map(|factor| factor * m.error.max(1e-17)));
        let times = all.clone().flat_map(|m| [0.9, 1.1].map(|factor| factor * m.nanoseconds));
        let across = Axis::around(errors, [left, left + SIZE[0]]);
        let up = Axis::around(times, [TOP + SIZE[1], TOP]);
        panel(&mut svg, task, left, &across, &up);
    }
    legend(&mut svg, chart);
    svg.push_str("</svg>\n");
    svg
}

fn panel(svg: &mut String, task: &Task, left: f64, across: &Axis, up: &Axis) {
    let [width, height] = SIZE;
    let bottom = TOP + height;
    put!(svg, "<text x=\"{left}\" y=\"{:.1}\">{}</text>", TOP - 10.0, task.title);
    for decade in across.decades() {
        let x = across.place(10.0_f64.powi(decade));
        put!(svg, "<path d=\"M{x:.1} {TOP}V{bottom}\" stroke=\"{FAINT}\"/>");
        if decade % 4 == 0 {
            put!(svg, "<text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>", bottom + 18.0, power(decade));
        }
    }
    for decade in up.decades() {
        let y = up.place(10.0_f64.powi(decade));
        put!(svg, "<path d=\"M{left} {y:.1}h{width}\" stroke=\"{FAINT}\"/>");
        let value = 10.0_f64.powi(decade);
        put!(svg, "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{value} ns</text>", left - 6.0, y + 4.5);
    }
    put!(svg, "<rect x=\"{left}\" y=\"{TOP}\" width=\"{width}\" height=\"{height}\" fill=\"none\" stroke=\"{INK}\"/>");
    put!(
        svg,
        "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">worst relative error (better to the left)</text>",
        left + 0.5 * width,
        bottom + 38.0
    );
    for (method, colour) in task.methods.iter().zip(COLOURS) {
        let place = |m: Measurement| [across.place(m.error.max(1e-17)), up.place(m.nanoseconds)];
        let ([x1, y1], [x2, y2]) = (place(method.ordinary), place(method.full));
        put!(svg, "<g><title>{}</title>", method.name);
        put!(svg, "<path d=\"M{x1:.1} {y1:.1}L{x2:.1} {y2:.1}\" stroke=\"{colour}\" stroke-dasharray=\"3 3\"/>");
        put!(
            svg,
            "<circle cx=\"{x1:.1}\" cy=\"{y1:.1}\" r=\"5\" fill=\"#ffffff\" stroke=\"{colour}\" stroke-width=\"2\"/>"
        );
        put!(
            svg,
            "<circle cx=\"{x2:.1}\" cy=\"{y2:.1}\" r=\"5\" fill=\"{colour}\" stroke=\"{colour}\" stroke-width=\"2\"/>"
        );
        put!(svg, "</g>");
    }
}

fn legend(svg: &mut String, chart: &Chart) {
    let Some(task) = chart.tasks.first() else { return };
    let y = HEIGHT - 44.0;
    for (number, (method, colour)) in task.methods.iter().zip(COLOURS).enumerate() {
        let x = LEFT[0] + 222.0 * number as f64;
        put!(svg, "<circle cx=\"{x}\" cy=\"{y}\" r=\"5\" fill=\"{colour}\"/>");
        put!(svg, "<text x=\"{:.1}\" y=\"{:.1}\">{}</text>", x + 10.0, y + 4.5, method.name);
    }
    let (slow, all) = chart.slow_path.iter().fold((0, 0), |sum, row| (sum.0 + row.2, sum.1 + row.1));
    put!(
        svg,
        "<text x=\"{}\" y=\"{:.1}\">hollow: the {} points with λ₁/λ₃ ≤ 10; full: all {} adversarial points, of which {slow} \
         ({:.1} %) take Piola's slow path; 10¹: not finite</text>",
        LEFT[0],
        HEIGHT - 16.0,
        chart.points[0],
        chart.points[1],
        100.0 * slow as f64 / f64::from(u32::try_from(all.max(1)).unwrap_or(u32::MAX))
    );
}

/// The tables, with what is claimed of them.
#[must_use]
pub fn page(chart: &Chart) -> String {
    let mut page = String::from(HEAD);
    for task in &chart.tasks {
        put!(page, "\n## {}\n", capital(task.title));
        put!(page, "| method | ns, λ₁/λ₃ ≤ 10 | worst error | ns, full set | worst error |\n|---|---|---|---|---|");
        for method in &task.methods {
            put!(
                page,
                "| {} | {:.1} | {:.1e} | {:.1} | {:.1e} |",
                method.name,
                method.ordinary.nanoseconds,
                method.ordinary.error,
                method.full.nanoseconds,
                method.full.error
            );
        }
        put!(page, "\n{}", verdict(task));
    }
    put!(page, "\n## Points that take the slow path\n\n| deformations | points | slow path |\n|---|---|---|");
    for (kind, points, slow) in &chart.slow_path {
        put!(page, "| {kind} | {points} | {slow} |");
    }
    let (slow, all) = chart.slow_path.iter().fold((0, 0), |sum, row| (sum.0 + row.2, sum.1 + row.1));
    put!(page, "| all | {all} | {slow} ({:.1} %) |", 100.0 * slow as f64 / all.max(1) as f64);
    page
}

const HEAD: &str = "# Accuracy and time of decompositions

Written by `cargo xtask continuum-accuracy`: medians of 41 rounds in which all methods take turns, one core, cargo's own
release profile. Errors are norm-wise against 31 digits, the input taken as exact: of R absolute, of U and ln U relative
to their own size (for pure rotations, whose ln U is rounding, absolute), of eigenpairs the largest of the residual, the
departure from orthogonality and the error of the values, relative to the tensor. 1e1 stands for a result that is not
finite.

![Time and worst error](figures/continuum-accuracy.svg)
";

/// Ratios of times and whether any other method is at once as fast and as accurate.
fn verdict(task: &Task) -> String {
    let named = |name: &str| task.methods.iter().find(|method| method.name.starts_with(name));
    let (Some(one), Some(batch), Some(svd)) = (named("Piola, one"), named("Piola, batch"), named("nalgebra, SVD"))
    else {
        return String::new();
    };
    let ratio = |a: &Method, b: &Method| a.ordinary.nanoseconds / b.ordinary.nanoseconds;
    let front = if beaten(task).next().is_none() { "is" } else { "is not" };
    format!(
        "One point is {:.1} × as fast as nalgebra's SVD where λ₁/λ₃ ≤ 10, the batch {:.1} × as fast as one point. Piola {front} \
         on the Pareto front of both sets.",
        ratio(svd, one),
        ratio(one, batch)
    )
}

/// Methods of ours that a peer beats: no slower, no less accurate, and better in one.
pub fn beaten(task: &Task) -> impl Iterator<Item = (&Method, &Method)> {
    let better = |a: Measurement, b: Measurement| {
        a.nanoseconds <= b.nanoseconds && a.error <= b.error && (a.nanoseconds < b.nanoseconds || a.error < b.error)
    };
    let ours = task.methods.iter().filter(|method| method.ours);
    ours.flat_map(move |ours| {
        let peers = task.methods.iter().filter(|method| !method.ours);
        peers
            .filter(move |peer| better(peer.ordinary, ours.ordinary) || better(peer.full, ours.full))
            .map(move |peer| (ours, peer))
    })
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}
