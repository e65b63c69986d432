//! The ends of what a solid can do, for messages.

use piola_solutions::SolutionsError;

/// The largest number up to `high` at which a test succeeds, where it does at `low` and not at `high`.
pub(super) fn reach((low, high): (f64, f64), succeeds: impl Fn(f64) -> bool) -> f64 {
    let (mut good, mut bad) = (low, high);
    for _ in 0..40 {
        let middle = f64::midpoint(good, bad);
        if succeeds(middle) {
            good = middle;
        } else {
            bad = middle;
        }
    }
    good
}

/// The loads that a curve reaches, in words.
pub(super) fn load_limit(error: &SolutionsError, unit: &str) -> String {
    match error {
        SolutionsError::BeyondLimitPoint { value, limit, .. } => {
            let side = if limit < value { "at most" } else { "at least" };
            format!("{side} {limit:.6e} {unit}, the load of the limit point")
        }
        SolutionsError::NotReached { value, nearest, parameter, .. } => {
            let side = if nearest < value { "at most" } else { "at least" };
            format!("{side} {nearest:.6e} {unit}, or another range of the {parameter}")
        }
        _ => "a load within the range of the curve".to_string(),
    }
}
