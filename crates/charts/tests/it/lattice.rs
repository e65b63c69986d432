//! The regions of a grid above a threshold.

use piola_charts::{Canvas, Lattice, Window, colour, figure};

use super::drawing::{Drawing, even, hex};

/// Twice the area, positive when counterclockwise, from triangles with the first point.
fn twice_area(polygon: &[[f64; 2]]) -> f64 {
    let [u, v] = polygon[0];
    let triangles = polygon.windows(2).map(|pair| {
        let [[a, b], [c, d]] = [pair[0], pair[1]];
        (a - u) * (d - v) - (b - v) * (c - u)
    });
    triangles.sum()
}

/// x + y ≥ 1 on the rectangle from (−1, 0) to (2, 2), whose lower left corner it leaves out: the line goes from (1, 0) to (−1, 2).
#[test]
fn region_above_a_plane_ends_at_its_line_and_at_the_rectangle() {
    let lattice = Lattice::of([-1.0, 0.0], [2.0, 2.0], [7, 9], |[x, y]| x + y);
    let [border] = &lattice.region(1.0)[..] else { panic!("one region") };
    // 6 less the triangle of 2.
    assert!((twice_area(border) - 8.0).abs() < 64.0 * f64::EPSILON, "{}", twice_area(border));
    for [x, y] in border {
        let is_zero = |x: f64| x.abs() < 4.0 * f64::EPSILON;
        let is_on_line = is_zero(x + y - 1.0);
        let is_on_side = is_zero(x - 2.0) || is_zero(y - 2.0) || (is_zero(*y) && 1.0 <= *x);
        assert!(is_on_line || is_on_side, "({x}, {y})");
    }
    for corner in [[1.0, 0.0], [2.0, 0.0], [2.0, 2.0], [-1.0, 2.0]] {
        assert!(border.contains(&corner), "{corner:?} in {border:?}");
    }
}

/// A small hill that comes first on the grid, and a large one with a hollow, far from the axes.
fn hills([x, y]: [f64; 2]) -> f64 {
    let hill = |a: f64, b: f64, radius: f64| radius - (x - a).hypot(y - b);
    hill(101.0, -3.0, 0.6).max(hill(104.0, 0.0, 2.0).min(-hill(104.0, 0.0, 0.9)))
}

#[test]
fn borders_come_by_size_and_holes_go_clockwise() {
    let lattice = Lattice::of([100.0, -4.0], [107.0, 3.0], [141, 141], hills);
    let areas: Vec<f64> = lattice.region(0.0).iter().map(|border| 0.5 * twice_area(border)).collect();
    let expected = [2.0, -0.9, 0.6].map(|radius: f64| std::f64::consts::PI * radius * radius.abs());
    assert_eq!(areas.len(), 3);
    for (found, expected) in areas.iter().zip(expected) {
        // Chords within 1/20 of a circle, and linear interpolation, miss about h²/r² of the area.
        assert!((found / expected - 1.0).abs() < 0.01, "{found}, not {expected}");
    }
}

/// The disc around the hollow has the colour of the band beneath.
#[test]
fn bands_fill_holes_with_the_colour_beneath() {
    let lattice = Lattice::of([100.0, -4.0], [107.0, 3.0], [71, 71], hills);
    let window = Window { low: [100.0, -4.0], high: [107.0, 3.0] };
    let svg = figure((500, 500), "hills", &|area| {
        let mut canvas = Canvas::metres(area, window, ("x", "y"))?;
        canvas.bands(&lattice, &[0.0, 0.4], &[colour(0), colour(1)], colour(2))
    });
    let drawing = Drawing::of(&svg);
    let polygons = drawing.polygons();
    let axes = drawing.axes([even; 2]);
    // Without the hill of 0.6: above 0.4 the ring lies between 1.3 and 1.6.
    let expected = [(0, 2.0), (2, 0.9), (0, 0.6), (1, 1.6), (0, 1.3), (1, 0.2)];
    assert_eq!(polygons.len(), expected.len());
    for (polygon, (index, radius)) in polygons.iter().zip(expected) {
        assert_eq!(polygon.colour, hex(colour(index)), "radius {radius}");
        let (left, right) = polygon.points.iter().fold((f64::MAX, 0.0_f64), |(l, r), [x, _]| (l.min(*x), r.max(*x)));
        let [width, none] = [axes.place((104.0 + radius, 0.0)), axes.place((104.0 - radius, 0.0))].map(|p| p[0]);
        // A point of the border may be left out, a pixel and a half from the next.
        assert!((right - left - (width - none)).abs() < 4.0 * super::drawing::WHOLE, "radius {radius}");
    }
}
