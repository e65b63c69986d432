//! Curves of error against time as SVG.

use std::fmt::Write;

use crate::work_precision::{Curve, Family};

const WIDTH: f64 = 900.0;
const HEIGHT: f64 = 560.0;
/// The area of the data: left, top, right, bottom.
const AREA: [f64; 4] = [78.0, 64.0, 628.0, 492.0];
pub(crate) const INK: &str = "#222222";
pub(crate) const FAINT: &str = "#dddddd";

/// Colours of Okabe and Ito, and two of Tol's, told apart by every kind of eye.
const fn colour(family: Family) -> &'static str {
    match family {
        Family::Composition => "#0072B2",
        Family::GaussLegendre => "#56B4E9",
        Family::CanonicalGaussLegendre => "#009E73",
        Family::GaussLegendre16 => "#882255",
        Family::GaussRadau15 => "#999933",
        Family::Nystrom86 => "#44AA99",
        Family::Nystrom1210 => "#117733",
        Family::Verner => "#332288",
        Family::DormandPrince => "#D55E00",
        Family::DerivedDormandPrince => "#000000",
        Family::OdeSolvers => "#CC79A7",
        Family::DifferentialEquations => "#E69F00",
        Family::Diffsol => "#AA4499",
        Family::Russell => "#DDCC77",
        Family::WisdomHolman => "#661100",
        Family::AdaptiveMuntheKaas => "#6699CC",
        Family::MuntheKaas => "#88CCEE",
        Family::ClosedForm => "#999999",
        Family::RadauIia => "#CC6677",
    }
}

/// A logarithmic axis on a stretch of the figure.
pub(crate) struct Axis {
    /// Decimal logarithms of both ends.
    ends: [f64; 2],
    stretch: [f64; 2],
}

impl Axis {
    /// The axis that holds all values with a margin.
    pub(crate) fn around(values: impl Iterator<Item = f64> + Clone, stretch: [f64; 2]) -> Self {
        let lowest = values.clone().fold(f64::INFINITY, f64::min).log10() - 0.2;
        let highest = values.fold(0.0, f64::max).log10() + 0.2;
        Self { ends: if lowest < highest { [lowest, highest] } else { [-1.0, 1.0] }, stretch }
    }

    /// The powers of ten on the axis.
    #[expect(clippy::cast_possible_truncation, reason = "decimal exponents of doubles")]
    pub(crate) fn decades(&self) -> std::ops::RangeInclusive<i32> {
        self.ends[0].ceil() as i32..=self.ends[1].floor() as i32
    }

    fn holds(&self, value: f64) -> bool {
        self.ends[0] <= value.log10() && value.log10() <= self.ends[1]
    }

    pub(crate) fn place(&self, value: f64) -> f64 {
        let [low, high] = self.ends;
        self.stretch[0] + (value.log10() - low) / (high - low) * (self.stretch[1] - self.stretch[0])
    }
}

/// A figure of 900 by 560: errors fall to the right, fast is below. Ours are solid, peers dashed; orders have
/// their own marks. The legend stands beside the data.
#[must_use]
pub fn figure(title: &str, curves: &[Curve]) -> String {
    let points = curves.iter().flat_map(|curve| &curve.points);
    let [left, top, right, bottom] = AREA;
    let across = Axis::around(points.clone().map(|point| point.error.max(1e-17)), [right, left]);
    let up = Axis::around(points.map(|point| point.seconds), [bottom, top]);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" width=\"{WIDTH}\" height=\"{HEIGHT}\" \
         font-family=\"Helvetica, Arial, sans-serif\" font-size=\"13\" fill=\"{INK}\">\n\
         <rect width=\"{WIDTH}\" height=\"{HEIGHT}\" fill=\"#ffffff\"/>\n\
         <text x=\"{left}\" y=\"32\" font-size=\"17\" font-weight=\"bold\">{title}</text>\n"
    );
    axes(&mut svg, &across, &up);
    for curve in curves {
        draw(&mut svg, curve, &across, &up);
    }
    legend(&mut svg, curves);
    svg.push_str("</svg>\n");
    svg
}

/// Writing to a string cannot fail.
macro_rules! put {
    ($svg:expr, $($argument:tt)*) => { let _ = writeln!($svg, $($argument)*); };
}

fn axes(svg: &mut String, across: &Axis, up: &Axis) {
    let [left, top, right, bottom] = AREA;
    let every = if across.decades().count() <= 9 { 1 } else { 2 };
    for decade in across.decades() {
        let x = across.place(10.0_f64.powi(decade));
        put!(svg, "<path d=\"M{x:.1} {top}V{bottom}\" stroke=\"{FAINT}\"/>");
        if decade % every == 0 {
            let (y, power) = (bottom + 20.0, power(decade));
            put!(svg, "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"middle\">{power}</text>");
        }
    }
    for decade in up.decades() {
        let y = up.place(10.0_f64.powi(decade));
        put!(svg, "<path d=\"M{left} {y:.1}H{right}\" stroke=\"{FAINT}\"/>");
        let (text, unit) = match decade.div_euclid(3) {
            -3 => (decade + 9, "ns"),
            -2 => (decade + 6, "µs"),
            -1 => (decade + 3, "ms"),
            _ => (decade, "s"),
        };
        put!(
            svg,
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{} {unit}</text>",
            left - 8.0,
            y + 4.5,
            10.0_f64.powi(text)
        );
    }
    for decade in up.decades().start() - 1..=*up.decades().end() {
        for value in (2..10).map(|digit| f64::from(digit) * 10.0_f64.powi(decade)).filter(|value| up.holds(*value)) {
            put!(svg, "<path d=\"M{left} {:.1}h4\" stroke=\"{INK}\" stroke-width=\"0.7\"/>", up.place(value));
        }
    }
    put!(
        svg,
        "<rect x=\"{left}\" y=\"{top}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"{INK}\"/>",
        right - left,
        bottom - top
    );
    let (middle, height) = (0.5 * (left + right), 0.5 * (top + bottom));
    put!(
        svg,
        "<text x=\"{middle}\" y=\"{}\" text-anchor=\"middle\">error at the end, relative (more digits to the right)</text>",
        bottom + 46.0
    );
    put!(
        svg,
        "<text transform=\"translate(20 {height}) rotate(-90)\" text-anchor=\"middle\">time of a run, one core (faster below)</text>"
    );
}

/// A power of ten.
pub(crate) fn power(exponent: i32) -> String {
    let digits = exponent.to_string();
    let raised = digits.chars().map(|c| match c {
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        '-' => '⁻',
        digit => char::from_u32(u32::from('⁰') + digit.to_digit(10).unwrap_or(0)).unwrap_or(digit),
    });
    format!("10{}", raised.collect::<String>())
}

fn draw(svg: &mut String, curve: &Curve, across: &Axis, up: &Axis) {
    let places: Vec<[f64; 2]> =
        curve.points.iter().map(|point| [across.place(point.error.max(1e-17)), up.place(point.seconds)]).collect();
    put!(svg, "<g><title>{}</title>", curve.name);
    line(svg, curve.family, &places);
    for &place in &places {
        mark(svg, curve, place);
    }
    put!(svg, "</g>");
}

fn line(svg: &mut String, family: Family, places: &[[f64; 2]]) {
    let mut path = String::new();
    for (number, [x, y]) in places.iter().enumerate() {
        let _ = write!(path, "{}{x:.1} {y:.1}", if number == 0 { "M" } else { "L" });
    }
    let dashes = if family.is_peer() { " stroke-dasharray=\"7 4\"" } else { "" };
    put!(
        svg,
        "<path d=\"{path}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\" stroke-linejoin=\"round\"{dashes}/>",
        colour(family)
    );
}

/// The mark of an order: circles for two, triangles for four, squares for six, diamonds for eight; peers'
/// marks are hollow.
fn mark(svg: &mut String, curve: &Curve, [x, y]: [f64; 2]) {
    let shape = match curve.order {
        2 => format!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.2\""),
        4 => format!("<path d=\"M{x:.1} {:.1}l4 7h-8z\"", y - 4.3),
        6 => format!("<rect x=\"{:.1}\" y=\"{:.1}\" width=\"6\" height=\"6\"", x - 3.0, y - 3.0),
        _ => format!("<path d=\"M{x:.1} {:.1}l4.2 4.2l-4.2 4.2l-4.2 -4.2z\"", y - 4.2),
    };
    let colour = colour(curve.family);
    let fill = if curve.family.is_peer() { "#ffffff" } else { colour };
    put!(svg, "{shape} fill=\"{fill}\" stroke=\"{colour}\" stroke-width=\"1.2\"/>");
}

fn legend(svg: &mut String, curves: &[Curve]) {
    let (x, mut y) = (AREA[2] + 22.0, AREA[1] + 6.0);
    for (heading, peers) in [("Piola", false), ("Peers", true)] {
        put!(svg, "<text x=\"{x}\" y=\"{:.1}\" font-weight=\"bold\">{heading}</text>", y + 4.0);
        y += 22.0;
        for curve in curves.iter().filter(|curve| curve.family.is_peer() == peers) {
            line(svg, curve.family, &[[x, y], [x + 30.0, y]]);
            mark(svg, curve, [x + 15.0, y]);
            // A long name goes on in a second line.
            let (name, rest) = curve.name.split_once(", ").unwrap_or((&curve.name, ""));
            put!(svg, "<text x=\"{}\" y=\"{:.1}\">{name}</text>", x + 38.0, y + 4.5);
            if !rest.is_empty() {
                y += 16.0;
                put!(
                    svg,
                    "<text x=\"{}\" y=\"{:.1}\" font-size=\"12\" fill=\"#555555\">{rest}</text>",
                    x + 38.0,
                    y + 4.5
                );
            }
            y += 22.0;
        }
        y += 10.0;
    }
}
