//! Figures with a title, their colours, texts and legends.
//!
//! Colours are told apart by the colour-blind (Okabe & Ito 2008, then Tol's muted scheme). Text is SVG text in the reader's
//! sans-serif font, so that no font is needed to draw.

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

const PALETTE: [RGBColor; 12] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(51, 34, 136),
    RGBColor(136, 34, 85),
    RGBColor(17, 119, 51),
    RGBColor(153, 153, 51),
    RGBColor(170, 68, 153),
    RGBColor(85, 85, 85),
];
/// The colour of texts and axes.
pub const INK: RGBColor = RGBColor(40, 40, 40);
/// The colour of the lines of a grid.
pub const GRID: RGBColor = RGBColor(225, 225, 225);
/// The font of all texts.
pub const FONT: &str = "sans-serif";
/// Coordinates are whole in the drawing; this many of them make a pixel, so that curves are smooth.
pub const FINE: u32 = 8;
/// Beyond this many curves a legend helps nobody.
pub const MOST_NAMED: usize = 24;

/// A part of a figure.
pub type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
/// The end of an attempt to draw.
pub type Drawn = Result<(), Box<dyn core::error::Error>>;

/// The colour of a curve by its index; twelve, then from the first again.
#[must_use]
pub fn colour(index: usize) -> RGBColor {
    PALETTE[index % PALETTE.len()]
}

/// A figure of a size in pixels, with a title; one that cannot be drawn says so instead of being lost.
///
/// # Example
/// ```
/// let svg = piola_charts::figure((300, 200), "nothing yet", &|_| Ok(()));
/// assert!(svg.contains("nothing yet") && svg.contains("width=\"300\""));
/// ```
#[must_use]
pub fn figure(size: (u32, u32), title: &str, draw: &dyn Fn(&Area<'_>) -> Drawn) -> String {
    let mut text = String::new();
    let attempt = |text: &mut String, draw: &dyn Fn(&Area<'_>) -> Drawn| -> Drawn {
        let area = SVGBackend::with_string(text, (FINE * size.0, FINE * size.1)).into_drawing_area();
        area.fill(&WHITE)?;
        let style = (FONT, pixels(21)).into_font().color(&INK).pos(Pos::new(HPos::Left, VPos::Top));
        area.draw(&Text::new(title.to_string(), (pixels(24), pixels(14)), style))?;
        draw(&area.margin(pixels(44), pixels(8), pixels(12), pixels(12)))?;
        area.present()?;
        Ok(())
    };
    let drawn = attempt(&mut text, draw);
    if let Err(error) = drawn {
        text.clear();
        let message = format!("this figure could not be drawn: {error}");
        let _ = attempt(&mut text, &|area: &Area<'_>| {
            Ok(area.draw(&Text::new(
                message.clone(),
                (pixels(24), pixels(40)),
                (FONT, pixels(15)).into_font().color(&INK),
            ))?)
        });
    }
    // The view box keeps the fine coordinates; the size is that of the figure.
    let fine = format!("width=\"{}\" height=\"{}\"", FINE * size.0, FINE * size.1);
    let shown = format!("width=\"{}\" height=\"{}\"", size.0, size.1);
    text.replacen(&fine, &shown, 1)
}

/// Pixels in the coordinates of the drawing.
#[must_use]
pub fn pixels(count: u32) -> i32 {
    i32::try_from(count * FINE).unwrap_or(i32::MAX)
}

/// A unit for lengths of this size: name and metres.
#[must_use]
pub fn length_unit(largest: f64) -> (&'static str, f64) {
    match largest {
        x if 1e10 <= x => ("au", 149_597_870_700.0),
        x if 1e5 <= x => ("km", 1e3),
        x if x < 1e-2 => ("mm", 1e-3),
        _ => ("m", 1.0),
    }
}

/// Names with their colours, below each other.
///
/// # Errors
/// Those of the drawing.
pub fn legend(area: &Area<'_>, entries: &[(&str, RGBColor)]) -> Drawn {
    let mut y = pixels(20);
    for (name, colour) in entries {
        area.draw(&PathElement::new(vec![(pixels(8), y), (pixels(30), y)], colour.stroke_width(3 * FINE)))?;
        let style = (FONT, pixels(15)).into_font().color(&INK).pos(Pos::new(HPos::Left, VPos::Center));
        area.draw(&Text::new((*name).to_string(), (pixels(38), y), style))?;
        y += pixels(22);
    }
    Ok(())
}

/// 1e-13 as 10⁻¹³.
#[must_use]
pub fn power_of_ten(y: f64) -> String {
    #[expect(clippy::cast_possible_truncation, reason = "an exponent of a double")]
    let exponent = y.log10().round() as i32;
    let digit = |c: char| match c {
        '-' => '⁻',
        '0' => '⁰',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        '4' => '⁴',
        '5' => '⁵',
        '6' => '⁶',
        '7' => '⁷',
        '8' => '⁸',
        _ => '⁹',
    };
    format!("10{}", exponent.to_string().chars().map(digit).collect::<String>())
}

/// A number with as many digits as it needs, at most four.
#[must_use]
pub fn format_short(x: f64) -> String {
    let rounded = format!("{x:.4}");
    let trimmed = rounded.trim_end_matches('0').trim_end_matches('.');
    match trimmed {
        "-0" | "" => "0".to_string(),
        _ if 1e5 <= x.abs() => format!("{x:.2e}"),
        _ => trimmed.replace('-', "−"),
    }
}
