//! Spans of time and the instants that are recorded.

use core::cmp::Ordering;

use piola_simulation::motion::{TimeSpan, Timetable};

#[test]
fn samples_divide_a_span_evenly_wherever_it_starts() {
    let instants = |start, end| Timetable::new(TimeSpan { start, end }, 5, &[]).instants().to_vec();
    assert_eq!(instants(1.0, 3.0), [1.0, 1.5, 2.0, 2.5, 3.0]);
    assert_eq!(instants(3.0, -1.0), [3.0, 2.0, 1.0, 0.0, -1.0]);
}

#[test]
fn instants_of_opposite_sign_are_two_and_those_that_differ_by_rounding_are_one() {
    let span = TimeSpan { start: -1.0, end: 1.0 };
    let instants = |landings: &[f64]| Timetable::new(span, 2, landings).instants().to_vec();
    assert_eq!(instants(&[-0.25, 0.25]), [-1.0, -0.25, 0.25, 1.0]);
    // A landing next to a sample takes its place.
    let landing = 0.5 + f64::EPSILON;
    assert_eq!(Timetable::new(span, 5, &[landing]).instants(), [-1.0, -0.5, 0.0, landing, 1.0]);
}

#[test]
fn span_holds_what_lies_outside_by_a_part_in_a_million_million() {
    for span in [TimeSpan { start: 2.0, end: 1002.0 }, TimeSpan { start: 1002.0, end: 2.0 }] {
        // 10⁻¹² of 1000 s.
        assert!(span.holds(2.0 - 0.9e-9) && span.holds(1002.0 + 0.9e-9));
        assert!(!span.holds(2.0 - 1.1e-9) && !span.holds(1002.0 + 1.1e-9));
        assert!(span.holds(2.0 + 1.1e-9) && span.holds(1002.0 - 1.1e-9));
    }
}

#[test]
fn the_two_zeros_are_one_instant() {
    for span in [TimeSpan { start: -1.0, end: 1.0 }, TimeSpan { start: 1.0, end: -1.0 }] {
        assert_eq!((span.order(-0.0, 0.0), span.order(0.0, -0.0)), (Ordering::Equal, Ordering::Equal));
    }
}
