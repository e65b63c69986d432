//! Mixed colours, the scale of colours, the bar beside a figure and the legend.

use piola_charts::{FINE, RGBColor, between, colour, colour_bar, figure, legend, pixels, viridis};

use super::drawing::{Drawing, hex};

fn bytes(RGBColor(red, green, blue): RGBColor) -> [u8; 3] {
    [red, green, blue]
}

#[test]
fn colour_between_two_divides_each_part_in_the_same_ratio() {
    let (a, b) = (RGBColor(100, 10, 200), RGBColor(200, 110, 0));
    assert_eq!(bytes(between(a, b, 0.25)), [125, 35, 150]);
    assert_eq!(bytes(between(b, a, 0.75)), [125, 35, 150]);
    assert_eq!([bytes(between(a, b, -1.0)), bytes(between(a, b, 2.0))], [bytes(a), bytes(b)]);
}

/// Entries 0, 64, 128, 191 and 255 of viridis (Smith and van der Walt 2015), within two of 255; in between straight lines
/// of eighths, so that a sixteenth is the mean of its neighbours.
#[test]
fn viridis_has_the_published_colours() {
    let published = [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]];
    for (quarter, expected) in (0..).zip(published) {
        let found = bytes(viridis(f64::from(quarter) / 4.0));
        let off = found.iter().zip(expected).map(|(a, b)| a.abs_diff(b)).max();
        assert!(off <= Some(2), "{quarter}/4: {found:?}, not {expected:?}");
    }
    for eighth in 0..8 {
        let [low, middle, high] = [0, 1, 2].map(|k| bytes(viridis(f64::from(2 * eighth + k) / 16.0)).map(i32::from));
        for part in 0..3 {
            let off = (2 * middle[part] - low[part] - high[part]).abs();
            assert!(off <= 1, "{eighth}/8: {low:?}, {middle:?}, {high:?}");
        }
    }
}

/// The area of a figure of 100 by 372 pixels begins 44 below the top and ends 8 above the bottom. The bar leaves 40 above and
/// 70 below, so it runs from 84 to 294 pixels: 70 for each of three colours, 52.5 from label to label.
#[test]
fn colour_bar_has_equal_colours_and_labels_at_quarters() {
    let colours = [0, 1, 2].map(colour);
    let svg = figure((100, 372), "bar", &|area| colour_bar(area, "stress", &colours, (-1.0, 3.0)));
    let drawing = Drawing::of(&svg);
    let bars: Vec<_> = drawing.rectangles().into_iter().skip(1).collect();
    assert_eq!(bars.len(), 3);
    for ((index, ([upper, lower], fill)), colour) in (0..).zip(bars).zip(colours) {
        let bottom = pixels(294 - 70 * index);
        assert_eq!([upper, lower], [[pixels(18), bottom - pixels(70)], [pixels(38), bottom]]);
        assert_eq!(fill, hex(colour));
    }
    let labels: Vec<_> =
        drawing.words().into_iter().skip(2).map(|([_, y], words)| (y / f64::from(FINE), words)).collect();
    assert_eq!(labels, [(294.0, "−1"), (241.5, "0"), (189.0, "1"), (136.5, "2"), (84.0, "3")]);
}

#[test]
fn legend_shows_a_line_of_three_pixels_beside_each_name() {
    let entries = [("neo-Hooke", colour(0)), ("Ogden", colour(1))];
    let drawing_of = figure((200, 200), "laws", &|area| legend(area, &entries));
    let drawing = Drawing::of(&drawing_of);
    let names: Vec<_> = drawing.words().into_iter().skip(1).collect();
    assert_eq!(names.len(), 2);
    for ((at, words), (name, colour)) in names.into_iter().zip(entries) {
        assert_eq!(words, name);
        let [line] = &drawing.curves_of(colour)[..] else { panic!("one line for {name}") };
        assert_eq!(line.width, 3 * FINE);
        assert!(
            line.points.iter().all(|[x, y]| *x < at[0] && (*y - at[1]).abs() < 1.0),
            "{:?} beside {at:?}",
            line.points
        );
    }
}
