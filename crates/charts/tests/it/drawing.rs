//! Reads a figure as its reader does: an axis by the labels of its ticks.

use piola_charts::{FINE, INK, RGBColor};
use piola_testkit::svg::{Element, elements};

/// Half a pixel: coordinates are whole in the drawing, those of ticks as those of marks.
pub(crate) const WHOLE: f64 = 0.5 * FINE as f64;

/// A disc.
pub(crate) struct Disc {
    pub(crate) centre: [f64; 2],
    pub(crate) radius: u32,
    pub(crate) stroke: u32,
    pub(crate) fill: String,
}

/// A curve or a polygon, with its colour.
pub(crate) struct Path {
    pub(crate) points: Vec<[f64; 2]>,
    pub(crate) colour: String,
    /// Zero for a polygon.
    pub(crate) width: u32,
}

/// The elements of a figure in SVG.
pub(crate) struct Drawing {
    elements: Vec<Element>,
}

impl Drawing {
    pub(crate) fn of(svg: &str) -> Self {
        Self { elements: elements(svg) }
    }

    fn named<'a>(&'a self, name: &'a str) -> impl Iterator<Item = &'a Element> {
        self.elements.iter().filter(move |element| element.tag() == name)
    }

    pub(crate) fn discs(&self) -> Vec<Disc> {
        let disc = |e: &Element| Disc {
            centre: [e.number("cx"), e.number("cy")],
            radius: e.number("r"),
            stroke: e.number("stroke-width"),
            fill: e.get("fill").to_owned(),
        };
        self.named("circle").map(disc).collect()
    }

    pub(crate) fn curves(&self) -> Vec<Path> {
        let path = |e: &Element| Path {
            points: e.points(),
            colour: e.get("stroke").to_owned(),
            width: e.number("stroke-width"),
        };
        self.named("polyline").map(path).collect()
    }

    /// Curves of a colour.
    pub(crate) fn curves_of(&self, colour: RGBColor) -> Vec<Path> {
        self.curves().into_iter().filter(|path| path.colour == hex(colour)).collect()
    }

    /// Both ends of the single lines of a colour.
    pub(crate) fn strokes(&self, colour: RGBColor) -> Vec<[[f64; 2]; 2]> {
        let lines = self.named("line").filter(|e| e.get("stroke") == hex(colour));
        lines.map(|e| [["x1", "y1"], ["x2", "y2"]].map(|end| end.map(|name| e.number(name)))).collect()
    }

    pub(crate) fn polygons(&self) -> Vec<Path> {
        let path = |e: &Element| Path { points: e.points(), colour: e.get("fill").to_owned(), width: 0 };
        self.named("polygon").map(path).collect()
    }

    /// Upper left and lower right corners of rectangles, with their colours.
    pub(crate) fn rectangles(&self) -> Vec<([[i32; 2]; 2], String)> {
        let rectangle = |e: &Element| {
            let [x, y, w, h] = ["x", "y", "width", "height"].map(|name| e.number::<i32>(name));
            ([[x, y], [x + w, y + h]], e.get("fill").to_owned())
        };
        self.named("rect").map(rectangle).collect()
    }

    pub(crate) fn words(&self) -> Vec<([f64; 2], &str)> {
        self.named("text").map(|e| ([e.number("x"), e.number("y")], e.text())).collect()
    }

    /// Left, right, bottom and top of the frame: the longest lines in the colour of axes.
    pub(crate) fn frame(&self) -> [f64; 4] {
        let mut frame = [0.0; 4];
        for path in self.curves_of(INK).into_iter().filter(|path| path.points.len() == 2) {
            let [[x, y], [u, v]] = [path.points[0], path.points[1]];
            if frame[1] - frame[0] < u - x {
                frame[..2].copy_from_slice(&[x, u]);
            }
            if frame[2] - frame[3] < (y - v).abs() {
                frame[2..].copy_from_slice(&[y.max(v), y.min(v)]);
            }
        }
        frame
    }

    /// The axes; along each the position goes with `scale` of the value: itself, or its logarithm.
    pub(crate) fn axes(&self, scale: [fn(f64) -> f64; 2]) -> Axes {
        // Labels stand below the ticks of the abscissa, and end left of those of the ordinate.
        let anchors = [("middle", "0.76em", "x"), ("end", "0.5ex", "y")];
        let ends = anchors.map(|(anchor, shift, coordinate)| {
            let is_label =
                |e: &&Element| e.get("text-anchor") == anchor && e.get("dy") == shift && e.get("transform").is_empty();
            let labels = self.named("text").filter(is_label);
            let mut ticks: Vec<_> = labels.filter_map(|e| Some((value(e.text())?, e.number(coordinate)))).collect();
            ticks.sort_by(|a, b| a.0.total_cmp(&b.0));
            [ticks[0], ticks[ticks.len() - 1]]
        });
        for [first, last] in ends {
            assert!(first.0 < last.0, "an axis needs two ticks: {ends:?}");
        }
        Axes { scale, ends }
    }
}

/// Axes by their outer ticks, each a value with its coordinate.
#[derive(Debug)]
pub(crate) struct Axes {
    scale: [fn(f64) -> f64; 2],
    ends: [[(f64, f64); 2]; 2],
}

impl Axes {
    /// Where a point stands in the drawing.
    pub(crate) fn place(&self, point: (f64, f64)) -> [f64; 2] {
        let place = |k: usize, value: f64| {
            let (scale, [(v, x), (w, y)]) = (self.scale[k], self.ends[k]);
            x + (y - x) * (scale(value) - scale(v)) / (scale(w) - scale(v))
        };
        [place(0, point.0), place(1, point.1)]
    }

    /// Whether points of the drawing stand where the axes say.
    #[track_caller]
    pub(crate) fn assert_at(&self, found: &[[f64; 2]], points: &[(f64, f64)]) {
        assert_eq!(found.len(), points.len());
        for (found, point) in found.iter().zip(points) {
            let expected = self.place(*point);
            let off = (found[0] - expected[0]).hypot(found[1] - expected[1]);
            assert!(off <= WHOLE, "{point:?} stands at {found:?}, not at {expected:?}");
        }
    }
}

/// Itself, the scale of an even axis.
pub(crate) fn even(x: f64) -> f64 {
    x
}

/// The number of a label: −0.25, 1.00e5 or 10⁻¹³; none for words.
fn value(label: &str) -> Option<f64> {
    let digits = "⁰¹²³⁴⁵⁶⁷⁸⁹⁻";
    if let Some(exponent) = label.strip_prefix("10").filter(|rest| rest.chars().all(|c| digits.contains(c)))
        && !exponent.is_empty()
    {
        let plain = |c: char| "0123456789-".chars().nth(digits.chars().position(|d| d == c).unwrap()).unwrap();
        let exponent: i32 = exponent.chars().map(plain).collect::<String>().parse().unwrap();
        return Some(10_f64.powi(exponent));
    }
    label.replace('−', "-").parse().ok()
}

/// A colour as the drawing writes it.
pub(crate) fn hex(RGBColor(red, green, blue): RGBColor) -> String {
    format!("#{red:02X}{green:02X}{blue:02X}")
}
