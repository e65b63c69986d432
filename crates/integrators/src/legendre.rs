//! Integrals of Legendre polynomials.

/// `∫₀^θ P_k` and `∬₀^θ P_k` of the Legendre polynomials on [0, 1].
///
/// ```text
/// ∫₀^θ P_k = (P_{k+1} − P_{k−1}) / 2(2k + 1),  k ≥ 1
/// ```
pub(crate) fn integrals(theta: f64) -> ([f64; 8], [f64; 8]) {
    let x = 2.0 * theta - 1.0;
    let mut p = [1.0; 10];
    p[1] = x;
    for k in 1..9 {
        let m = k as f64;
        p[k + 1] = ((2.0 * m + 1.0) * x * p[k] - m * p[k - 1]) / (m + 1.0);
    }
    let mut once = [theta; 9];
    for k in 1..9 {
        once[k] = (p[k + 1] - p[k - 1]) / (2.0 * (2.0 * k as f64 + 1.0));
    }
    let mut twice = [0.5 * theta * theta; 8];
    for k in 1..8 {
        twice[k] = (once[k + 1] - once[k - 1]) / (2.0 * (2.0 * k as f64 + 1.0));
    }
    (core::array::from_fn(|k| once[k]), twice)
}
