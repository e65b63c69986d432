//! The order of a method, read off its errors at several steps.

/// The slope of ln error over ln step, by least squares: p for errors ~ hᵖ.
///
/// Give steps in the range where the method converges and rounding is still small.
///
/// # Panics
/// When there are fewer than two steps, the lengths differ, or a number is not positive and finite.
///
/// # Example
/// ```
/// let order = piola_testkit::convergence_order(&[0.5, 0.25, 0.125], &[4.0, 1.0, 0.25]);
/// assert!((order - 2.0).abs() < 8.0 * f64::EPSILON);
/// ```
#[must_use]
#[track_caller]
pub fn convergence_order(steps: &[f64], errors: &[f64]) -> f64 {
    assert_eq!(steps.len(), errors.len(), "one error for each step");
    assert!(2 <= steps.len(), "a slope needs two points");
    let logarithms = |values: &[f64]| -> Vec<f64> {
        let ln = |&x: &f64| {
            assert!(0.0 < x && x.is_finite(), "{x:e} in {values:?} has no logarithm");
            x.ln()
        };
        values.iter().map(ln).collect()
    };
    let (x, y) = (logarithms(steps), logarithms(errors));
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let (x_mean, y_mean) = (mean(&x), mean(&y));
    let covariance: f64 = x.iter().zip(&y).map(|(x, y)| (x - x_mean) * (y - y_mean)).sum();
    let variance: f64 = x.iter().map(|x| (x - x_mean).powi(2)).sum();
    covariance / variance
}

/// Asserts that the errors fall like hᵖ, with the exponent within `within` of `order`.
///
/// # Panics
/// When they do not, and as [`convergence_order`].
#[track_caller]
pub fn assert_order(what: &str, steps: &[f64], errors: &[f64], order: f64, within: f64) {
    let found = convergence_order(steps, errors);
    assert!(
        (found - order).abs() <= within,
        "{what}: order {found:.3} where {order} ± {within} is expected\n  steps  {steps:?}\n  errors {errors:?}"
    );
}
