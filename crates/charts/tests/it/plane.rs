//! Plane figures true to scale.

use piola_charts::{
    Canvas, Color, FINE, RGBColor, Window, colour, discs, figure, length_unit, line, plane_chart, thinned,
};

use super::drawing::{Drawing, even, hex};

const RED: RGBColor = RGBColor(255, 0, 0);

/// Marks at points of a window, in a figure of the window's own size.
fn marked(window: Window, width: u32, points: &[[f64; 2]]) -> Drawing {
    let svg = figure(window.size(width), "marks", &|area| {
        let mut canvas = Canvas::metres(area, window, ("x", "y"))?;
        points.iter().try_for_each(|point| canvas.mark(*point, 4, RED))
    });
    Drawing::of(&svg)
}

/// In millimetres, metres and kilometres the label times the unit is the coordinate.
#[test]
fn marks_stand_where_the_labels_say_in_every_unit() {
    for (size, name, metres) in [(1e-3, "mm", 1e-3), (2.0, "m", 1.0), (3e6, "km", 1e3)] {
        assert_eq!(length_unit(1.5 * size), (name, metres));
        let window = Window { low: [-0.5 * size, -size], high: [1.5 * size, 0.25 * size] };
        let points = [[0.0, 0.0], [-0.25 * size, 0.125 * size], [1.375 * size, -0.75 * size]];
        let drawing = marked(window, 600, &points);
        let (rims, marks): (Vec<_>, Vec<_>) = drawing.discs().into_iter().partition(|disc| disc.fill == "#FFFFFF");
        let centres: Vec<_> = marks.iter().map(|disc| disc.centre).collect();
        let labelled = points.map(|[x, y]| (x / metres, y / metres));
        drawing.axes([even; 2]).assert_at(&centres, &labelled);
        // The rim is a pixel wide.
        assert_eq!([rims.len(), marks.len()], [3; 2]);
        for (rim, mark) in rims.iter().zip(&marks) {
            assert_eq!((rim.centre, rim.radius - mark.radius), (mark.centre, FINE));
            assert_eq!((mark.radius, mark.fill.clone()), (4 * FINE, hex(RED)));
        }
        assert!(drawing.words().iter().any(|(_, words)| *words == format!("x ({name})")));
    }
}

/// The direction in which the window is tight fills the frame; in the other the window is in the middle.
#[test]
fn window_fills_the_frame_in_one_direction_and_is_centred_in_the_other() {
    for (side, tight) in [([4.0, 1.0], 0), ([0.5, 2.0], 1)] {
        let window = Window { low: [3.0, -1.0], high: [3.0 + side[0], -1.0 + side[1]] };
        let svg = figure((500, 500), "window", &|area| {
            let mut canvas = Canvas::metres(area, window, ("x", "y"))?;
            canvas.mark(window.low, 1, RED)?;
            canvas.mark(window.high, 1, RED)
        });
        let drawing = Drawing::of(&svg);
        let corners: Vec<_> = drawing.discs().into_iter().filter(|disc| disc.fill == hex(RED)).collect();
        let [left, right, bottom, top] = drawing.frame();
        let (frame, [low, high]) = ([[left, bottom], [right, top]], [corners[0].centre, corners[1].centre]);
        let loose = 1 - tight;
        // Coordinates are whole.
        assert!((low[tight] - frame[0][tight]).abs() <= 1.0 && (high[tight] - frame[1][tight]).abs() <= 1.0);
        assert!((low[loose] + high[loose] - frame[0][loose] - frame[1][loose]).abs() <= 2.0);
        // One pixel of a hundred.
        let [across, up] = [0, 1].map(|k| (high[k] - low[k]).abs() / side[k]);
        assert!((across / up - 1.0).abs() < 1.0 / 80.0, "{across} and {up} for a metre");
    }
}

/// The size depends on the sides of the window, not on where it is, and leaves it little air in either direction.
#[test]
fn figure_has_the_shape_of_its_window_wherever_that_is() {
    let at = |x: f64, y: f64| Window { low: [x, y], high: [x + 4.0, y + 3.0] };
    let sizes = [at(0.0, 0.0), at(-2.0, -1.5), at(16.0, -8.0), at(-64.0, 32.0)].map(|window| window.size(640));
    assert_eq!(sizes, [sizes[0]; 4]);
    let window = at(16.0, -8.0);
    let drawing = marked(window, 640, &[window.low, window.high]);
    let [left, right, bottom, top] = drawing.frame();
    let discs = drawing.discs();
    let [low, high] = [discs[0].centre, discs[2].centre];
    let filled = [(high[0] - low[0]) / (right - left), (low[1] - high[1]) / (bottom - top)];
    assert!(filled.iter().all(|share| 0.95 < *share && *share < 1.01), "{filled:?}");
}

#[test]
fn window_around_points_leaves_them_air_on_all_sides() {
    let points = [[1.0, 5.0], [3.0, 1.0], [f64::NAN, 100.0], [2.0, 2.0]];
    let window = Window::around(points.into_iter());
    let air = [1.0 - window.low[0], 1.0 - window.low[1], window.high[0] - 3.0, window.high[1] - 5.0];
    // The same on all sides, between a hundredth and a tenth of the longer side, which is 4.
    for air in air {
        assert!((air - (1.0 - window.low[0])).abs() < 8.0 * f64::EPSILON && 0.04 < air && air < 0.4, "{air}");
    }
}

/// Points of a curve are a pixel and a half apart, the last one is kept.
#[test]
fn dense_curves_keep_a_point_every_pixel_and_a_half() {
    let window = Window { low: [0.0; 2], high: [2000.0; 2] };
    let points: Vec<[f64; 2]> = (0..=20_000).map(|i| [0.1 * f64::from(i); 2]).collect();
    let svg = figure((500, 500), "curve", &|area| {
        Canvas::metres(area, window, ("x", "y"))?.curve(&points, RED.stroke_width(FINE))
    });
    let drawing = Drawing::of(&svg);
    let [curve] = &drawing.curves_of(RED)[..] else { panic!("one curve") };
    let axes = drawing.axes([even; 2]);
    let ends = [curve.points[0], curve.points[curve.points.len() - 1]];
    axes.assert_at(&ends, &[(0.0, 0.0), (2000.0, 2000.0)]);
    let steps: Vec<f64> = curve.points.windows(2).map(|p| (p[1][0] - p[0][0]).hypot(p[1][1] - p[0][1])).collect();
    let (_, whole) = steps.split_last().unwrap();
    assert!(100 < whole.len());
    // Coordinates are whole, and the points themselves a seventh of a pixel apart.
    let expected = 1.5 * f64::from(FINE);
    assert!(whole.iter().all(|step| (step - expected).abs() < 3.0), "{whole:?}");
}

#[test]
fn thinned_points_are_at_least_the_distance_apart() {
    let points = [(0.0, 0.0), (3.0, 0.0), (3.0, 4.0), (f64::NAN, 0.0), (3.0, 4.5), (9.0, 12.0), (9.0, 12.5)];
    assert_eq!(thinned(points.into_iter(), 5.0), [(0.0, 0.0), (3.0, 4.0), (9.0, 12.0), (9.0, 12.5)]);
}

/// What lies outside of the curve is a polygon with the curve as its hole.
#[test]
fn cover_leaves_the_inside_of_a_curve_free() {
    let window = Window { low: [0.0; 2], high: [4000.0; 2] };
    let square = [[1000.0, 1000.0], [3000.0, 1000.0], [3000.0, 2000.0], [1000.0, 2000.0], [1000.0, 1000.0]];
    let svg = figure((400, 400), "cover", &|area| {
        let mut canvas = Canvas::metres(area, window, ("x", "y"))?;
        canvas.fill(&square, colour(3))?;
        canvas.cover_outside(&square)
    });
    let drawing = Drawing::of(&svg);
    let polygons = drawing.polygons();
    assert_eq!(polygons.len(), 2);
    let [left, right, bottom, top] = drawing.frame();
    let corners = [[left, bottom], [right, bottom], [right, top], [left, top], [left, bottom]];
    let off = |a: &[f64; 2], b: &[f64; 2]| (a[0] - b[0]).abs().max((a[1] - b[1]).abs());
    assert!(polygons[1].points.iter().zip(&corners).all(|(a, b)| off(a, b) <= 1.0));
    let inner: Vec<_> = polygons[1].points[5..].iter().rev().copied().collect();
    let axes = drawing.axes([even; 2]);
    axes.assert_at(&inner, &square.map(|[x, y]| (x, y)));
    let mut filled = polygons[0].points.clone();
    filled.dedup();
    axes.assert_at(&filled, &square.map(|[x, y]| (x, y)));
}

#[test]
fn chart_of_a_plane_shows_lines_and_discs_at_their_coordinates() {
    let points = vec![(-0.5, 10.0), (0.25, 35.0), (1.5, -15.0)];
    let svg = figure((500, 400), "plane", &|area| {
        let names = ("angle".to_owned(), "rate".to_owned());
        let mut chart = plane_chart(area, (-1.0..2.0, -20.0..40.0), names)?;
        line(&mut chart, points.clone(), RED.stroke_width(FINE))?;
        discs(&mut chart, points.clone(), 3, RED)
    });
    let drawing = Drawing::of(&svg);
    let axes = drawing.axes([even; 2]);
    let [left, right, bottom, top] = drawing.frame();
    axes.assert_at(&[[left, bottom], [right, top]], &[(-1.0, -20.0), (2.0, 40.0)]);
    axes.assert_at(&drawing.curves_of(RED)[0].points, &points);
    let centres: Vec<_> = drawing.discs().iter().map(|disc| disc.centre).collect();
    axes.assert_at(&centres, &points);
}
