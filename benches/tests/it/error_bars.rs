//! A sample of the table of error bars; `cargo run --release -p piola-benches --bin error-bars` makes the whole.

use piola_benches::error_bars::{Summary, sample};

#[test]
fn estimates_equal_true_errors_within_three_in_nine_cases_of_ten() {
    let rows = sample().unwrap();
    assert_eq!(rows.len(), 14);
    let summary = Summary::of(rows.iter());
    assert!(150 < summary.cases, "{summary:?}");
    assert!(0.9 * summary.cases as f64 <= summary.within_three as f64, "{summary:?}");
    assert!(0.1 <= summary.least, "{summary:?}");
}
