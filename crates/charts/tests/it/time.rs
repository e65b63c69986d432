//! Small positive numbers over time.

use piola_charts::{TimeCurve, colour, time_figure};

use super::drawing::{Drawing, even};

fn curves(points: &[&[(f64, f64)]]) -> Vec<TimeCurve> {
    let curve = |(k, points): (usize, &&[(f64, f64)])| TimeCurve {
        name: format!("curve {k}"),
        colour: colour(k),
        points: points.to_vec(),
    };
    points.iter().enumerate().map(curve).collect()
}

fn unit(drawing: &Drawing) -> String {
    let words = drawing.words();
    let name = words.iter().find_map(|(_, words)| words.strip_prefix("time (")).unwrap();
    name.trim_end_matches(')').to_owned()
}

/// A Julian year has 365.25 days. Times begin and end anywhere; the label times its unit is the time.
#[test]
fn times_are_labelled_in_a_unit_of_which_there_are_a_few() {
    let cases = [
        ("s", 1.0, 1.0),
        ("s", 1.0, 9000.0),
        ("hours", 3600.0, 4.0),
        ("days", 86_400.0, 4.0),
        ("years", 31_557_600.0, 5.0),
    ];
    for (name, seconds, count) in cases {
        let span = count * seconds;
        let points = [(2.0 * span, 3e-11), (2.5 * span, 4e-10), (3.0 * span, 2e-9)];
        let drawing = Drawing::of(&time_figure("drift", "change", curves(&[&points]), false));
        assert_eq!(unit(&drawing), name);
        let labelled = points.map(|(t, y)| (t / seconds, y));
        let axes = drawing.axes([even, f64::log10]);
        axes.assert_at(&drawing.curves_of(colour(0))[0].points, &labelled);
        let [left, right, bottom, top] = drawing.frame();
        // Whole decades around one and a half times the largest value.
        axes.assert_at(&[[left, bottom], [right, top]], &[(2.0 * count, 1e-11), (3.0 * count, 1e-8)]);
    }
}

/// Values that happen to be tiny do not stretch the ordinate: it ends in the decade of a hundredth of the lowest curve's peak, where they are
/// drawn.
#[test]
fn tiny_values_are_drawn_at_the_lower_end_two_decades_below_the_lowest_peak() {
    let high = [(0.0, 1e-3), (1.0, 2e-3), (2.0, 5e-3)];
    let low = [(0.0, 1e-17), (1.0, 3e-6), (2.0, 2e-7)];
    let drawing = Drawing::of(&time_figure("drift", "change", curves(&[&high, &low]), false));
    let axes = drawing.axes([even, f64::log10]);
    let [left, right, bottom, top] = drawing.frame();
    axes.assert_at(&[[left, bottom], [right, top]], &[(0.0, 1e-8), (2.0, 1e-2)]);
    // The first of these is the line of the legend's name, or the curve itself.
    let of = |k: usize| drawing.curves_of(colour(k)).into_iter().find(|path| path.points.len() == 3).unwrap();
    axes.assert_at(&of(0).points, &high);
    axes.assert_at(&of(1).points, &[(0.0, 1e-8), (1.0, 3e-6), (2.0, 2e-7)]);
    assert!(["curve 0", "curve 1"].iter().all(|name| drawing.words().iter().any(|(_, words)| words == name)));
}

/// Instants after zero are marked on a logarithmic abscissa, and none of them stands at the frame.
#[test]
fn few_instants_are_marked_over_the_logarithm_of_time() {
    let points = [(0.0, 1e-9), (7200.0, 1e-14), (36_000.0, 1e-12), (360_000.0, 1e-11)];
    let drawing = Drawing::of(&time_figure("drift", "change", curves(&[&points]), true));
    assert_eq!(unit(&drawing), "days");
    let axes = drawing.axes([f64::log10, f64::log10]);
    let centres: Vec<_> = drawing.discs().iter().map(|disc| disc.centre).collect();
    // Zero has no logarithm.
    let shown: Vec<_> = points[1..].iter().map(|(t, y)| (t / 86_400.0, *y)).collect();
    axes.assert_at(&centres, &shown);
    let [left, right, ..] = drawing.frame();
    let clear = [centres[0][0] - left, right - centres[2][0]].map(|gap| gap / (right - left));
    assert!(clear.iter().all(|gap| (0.02..0.15).contains(gap)), "{clear:?}");
}

/// One instant has no span; a figure of it has axes all the same.
#[test]
fn short_spans_far_from_zero_and_near_it_fill_the_abscissa() {
    for (start, end) in [(1e-10, 1e-5), (1e6, 1e6 + 1.0)] {
        let points = [(start, 1e-12), (end, 1e-11)];
        let drawing = Drawing::of(&time_figure("drift", "change", curves(&[&points]), false));
        let [left, right, ..] = drawing.frame();
        let curve = &drawing.curves_of(colour(0))[0].points;
        assert!((curve[0][0] - left).abs() <= 1.0 && (curve[1][0] - right).abs() <= 1.0, "{start} to {end}: {curve:?}");
    }
    let one = time_figure("drift", "change", curves(&[&[(5.0, 1e-12)]]), false);
    assert!(one.contains("time (s)") && !one.contains("could not be drawn"));
}

/// Of many thousand points the single peaks and dips are kept.
#[test]
fn long_curves_keep_their_peak() {
    let value = |i: i32| {
        if i == 12_345 {
            1e-6
        } else if i == 777 {
            3e-8
        } else {
            1e-7
        }
    };
    let points: Vec<_> = (0..20_000).map(|i| (f64::from(i), value(i))).collect();
    let drawing = Drawing::of(&time_figure("drift", "change", curves(&[&points]), false));
    let axes = drawing.axes([even, f64::log10]);
    let curve = &drawing.curves_of(colour(0))[0].points;
    assert!(curve.len() <= 1600, "{}", curve.len());
    let at = |k: fn(f64, f64) -> bool| *curve.iter().reduce(|a, b| if k(b[1], a[1]) { b } else { a }).unwrap();
    let hours = |i: f64| i / 3600.0;
    axes.assert_at(&[at(|b, a| b < a), at(|b, a| a < b)], &[(hours(12_345.0), 1e-6), (hours(777.0), 3e-8)]);
}
