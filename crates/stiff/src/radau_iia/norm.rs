//! The size of what a step changes or misses, relative to what is allowed.

/// The root of the mean square of x over the weights, whose pattern repeats. Components that may have no error and have none
/// do not count.
pub(super) fn norm(x: &[f64], weights: &[f64]) -> f64 {
    let mut sum = 0.0;
    for block in x.chunks_exact(weights.len().max(1)) {
        for (x, weight) in block.iter().zip(weights) {
            if x.abs() <= 0.0 {
                continue;
            }
            let ratio = x / weight;
            sum += ratio * ratio;
        }
    }
    (sum / x.len().max(1) as f64).sqrt()
}
