//! Panels of measurements: points beside curves, and residuals.

use piola_charts::{LogPanel, Panel, colour, figure, format_short, power_of_ten, residuals};

use super::drawing::{Drawing, even, hex};

/// The ends of the drawn curves, left, right, lower and upper: zero is the left or lower side of the frame, one the opposite side.
fn shares(drawing: &Drawing, places: &[[f64; 2]]) -> [f64; 4] {
    let [left, right, bottom, top] = drawing.frame();
    let along = places.iter().map(|[x, _]| (x - left) / (right - left));
    let up = places.iter().map(|[_, y]| (y - bottom) / (top - bottom));
    let (low, high) = (|values: f64, x: f64| values.min(x), |values: f64, x: f64| values.max(x));
    [
        along.clone().fold(f64::MAX, low),
        along.fold(f64::MIN, high),
        up.clone().fold(f64::MAX, low),
        up.fold(f64::MIN, high),
    ]
}

fn centres(drawing: &Drawing) -> Vec<[f64; 2]> {
    drawing.discs().iter().map(|disc| disc.centre).collect()
}

fn panel(points: Vec<(f64, f64)>, curves: Vec<Vec<(f64, f64)>>, is_curve: bool) -> Drawing {
    let axes = ["stretch".into(), "stress".into()];
    let panel = Panel { name: "uniaxial".into(), axes, points, curves, is_curve };
    Drawing::of(&figure((500, 400), "rubber", &|area| panel.draw(area)))
}

/// Wide and narrow ranges, in tension and in compression: all points are in the frame, and fill most of it.
#[test]
fn measured_points_fill_the_panel_and_stand_where_its_axes_say() {
    let families = [
        vec![(10.0, 0.0), (60.0, 2.5), (110.0, 4.0)],
        vec![(0.9, -3.0), (0.95, -1.0), (1.0, 0.0)],
        vec![(0.5, -2.0), (1.0, 0.0), (2.5, 6.0)],
    ];
    for points in families {
        let drawing = panel(points.clone(), vec![points.clone()], true);
        let places = centres(&drawing);
        let axes = drawing.axes([even; 2]);
        axes.assert_at(&places, &points);
        axes.assert_at(&drawing.curves_of(colour(0))[0].points, &points);
        let [left, right, bottom, top] = shares(&drawing, &places);
        // A hundredth to a twentieth of air beside the points, up to a seventh above and below them.
        assert!((0.01..0.05).contains(&left) && (0.95..0.99).contains(&right), "{points:?}: {left} to {right}");
        let compressed = points[0].1 < 0.0;
        assert!(if compressed { (0.05..0.15).contains(&bottom) } else { bottom.abs() < 1e-3 }, "{points:?}: {bottom}");
        assert!((0.85..0.95).contains(&top), "{points:?}: {top}");
        // Rings a pixel and a half thick.
        assert!(drawing.discs().iter().all(|disc| disc.stroke == 12 && disc.radius == 24));
    }
}

#[test]
fn answers_at_the_points_are_crosses_and_what_leaves_the_panel_is_left_out() {
    let points = vec![(1.0, 1.0), (2.0, 2.0), (3.0, 4.0)];
    let answers = vec![vec![(1.0, 1.5), (2.0, 2.5), (3.0, 400.0)]];
    let drawing = panel(points.clone(), answers, false);
    drawing.axes([even; 2]).assert_at(&centres(&drawing), &points);
    let strokes = drawing.strokes(colour(0));
    // Two strokes for each of two crosses, which meet at the answer.
    assert_eq!(strokes.len(), 4);
    let middles: Vec<_> = strokes.iter().map(|[from, to]| [0, 1].map(|k| 0.5 * (from[k] + to[k]))).collect();
    let answers = [(1.0, 1.5), (1.0, 1.5), (2.0, 2.5), (2.0, 2.5)];
    drawing.axes([even; 2]).assert_at(&middles, &answers);
}

#[test]
fn logarithmic_panel_holds_marks_curves_and_band() {
    let marks = vec![(0.02, 300.0), (3.0, 40.0), (4000.0, 0.5)];
    let band: Vec<_> = marks.iter().map(|(x, y)| (*x, [0.9 * y, 1.1 * y])).collect();
    let curves = vec![vec![(-1.0, 5.0), (0.02, 310.0), (4000.0, 0.6)]];
    let panel = LogPanel { title: "viscosity", axes: ["rate", "viscosity"], marks: marks.clone(), curves, band };
    let drawing = Drawing::of(&figure((500, 400), "fluid", &|area| panel.draw(area)));
    let axes = drawing.axes([f64::log10; 2]);
    let places = centres(&drawing);
    axes.assert_at(&places, &marks);
    // What is not positive is left out.
    axes.assert_at(&drawing.curves_of(colour(0))[0].points, &[(0.02, 310.0), (4000.0, 0.6)]);
    let [band] = &drawing.polygons()[..] else { panic!("one band") };
    let upper = marks.iter().map(|(x, y)| (*x, 1.1 * y));
    let outline: Vec<_> = upper.chain(marks.iter().rev().map(|(x, y)| (*x, 0.9 * y))).collect();
    axes.assert_at(&band.points, &outline);
    for (k, share) in shares(&drawing, &places).into_iter().enumerate() {
        let clear = if k % 2 == 0 { share } else { 1.0 - share };
        assert!((0.01..0.1).contains(&clear), "side {k}: {share}");
    }
    assert!(drawing.discs().iter().all(|disc| disc.stroke == 12));
}

#[test]
fn residuals_stand_in_percent_over_the_logarithm_of_the_drive() {
    let rows = [[30.0, 0.0], [200.0, 0.0], [5000.0, 0.0]];
    let sets = [vec![0.02, -0.05, 0.01], vec![-0.01, f64::NAN, 0.04]];
    let drawing = Drawing::of(&figure((500, 400), "fit", &|area| residuals(area, ("rate", &rows), &sets, "residual")));
    let percents: Vec<_> = drawing.words().into_iter().filter(|(_, words)| words.ends_with(" %")).collect();
    assert!(3 < percents.len());
    // Ticks at the ordinate, read in percent: the first and the last one give the scale.
    let percent = |(at, words): &([f64; 2], &str)| {
        (words.trim_end_matches(" %").replace('−', "-").parse::<f64>().unwrap(), at[1])
    };
    let (low, high) = (percent(&percents[0]), percent(&percents[percents.len() - 1]));
    let abscissas: Vec<_> = drawing.words().into_iter().filter(|(_, words)| words.starts_with("10")).collect();
    assert_eq!(abscissas.iter().map(|(_, words)| *words).collect::<Vec<_>>(), ["10²", "10³"]);
    let [hundred, thousand] = [0, 1].map(|k| abscissas[k].0[0]);
    let expected = [(30.0, 2.0, 0), (200.0, -5.0, 0), (5000.0, 1.0, 0), (30.0, -1.0, 1), (5000.0, 4.0, 1)];
    let discs = drawing.discs();
    assert_eq!(discs.len(), expected.len());
    for (disc, (drive, percent, set)) in discs.iter().zip(expected) {
        let x = hundred + (thousand - hundred) * (f64::log10(drive) - 2.0);
        let y = low.1 + (high.1 - low.1) * (percent - low.0) / (high.0 - low.0);
        let off = (disc.centre[0] - x).hypot(disc.centre[1] - y);
        assert!(off < 8.0 && disc.fill == hex(colour(set)), "({drive}, {percent} %) at {:?}", disc.centre);
    }
    let [left, right, bottom, top] = shares(&drawing, &centres(&drawing));
    assert!((0.01..0.1).contains(&left) && (0.9..0.99).contains(&right), "{left} to {right}");
    // The largest residual is 1/1.1 of half the frame below its middle.
    assert!((bottom - 0.5 / 11.0).abs() < 2e-3 && top < 1.0, "{bottom} to {top}");
}

#[test]
fn labels_are_short_numbers_and_powers_of_ten() {
    let numbers = [0.0, -0.000_01, 0.25, -1.5, 12.0, 0.123_45, 99_999.5, -250_000.0, 1e7];
    let expected = ["0", "0", "0.25", "−1.5", "12", "0.1235", "99999.5", "-2.50e5", "1.00e7"];
    assert_eq!(numbers.map(format_short), expected);
    assert_eq!([1e-13, 1.0, 4.6e8, 2e20].map(power_of_ten), ["10⁻¹³", "10⁰", "10⁹", "10²⁰"]);
}
