//! A sample of the table of error bars; `cargo run --release -p piola-benches --bin error-bars` makes the whole.

use piola_benches::error_bars::{Summary, sample};

#[test]
fn estimates_of_the_sample_equal_true_errors_within_three() {
    let rows = sample().unwrap();
    assert_eq!(rows.len(), 14);
    let summary = Summary::of(rows.iter());
    assert!(150 < summary.cases, "{summary:?}");
    assert_eq!(summary.within_three, summary.cases, "{summary:?}");
    assert!(0.5 <= summary.least, "{summary:?}");
}
