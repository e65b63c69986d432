//! Nodes and weights of Kronrod's rule with 15 points and of Gauss's rule with 7 of them.
//!
//! ```text
//! ∫₋₁¹ f dx ≈ Σ_k w_k (f(x_k) + f(−x_k)),    the centre x₇ = 0 once
//! ```
//!
//! Exact for polynomials of degree 22 and 13; what the two differ by tells of the error. Gauss's nodes are those of odd
//! index.
//!
//! # Example
//! ```
//! use piola_numerics::gauss_kronrod::{GAUSS, KRONROD, NODES};
//! let integral = |f: fn(f64) -> f64| {
//!     let pairs = |k: usize| f(NODES[k]) + f(-NODES[k]);
//!     let kronrod: f64 = (0..7).map(|k| KRONROD[k] * pairs(k)).sum::<f64>() + KRONROD[7] * f(0.0);
//!     let gauss: f64 = (0..3).map(|k| GAUSS[k] * pairs(2 * k + 1)).sum::<f64>() + GAUSS[3] * f(0.0);
//!     (kronrod, gauss)
//! };
//! let (kronrod, gauss) = integral(f64::exp);
//! assert!((kronrod - 2.0 * 1.0_f64.sinh()).abs() < 1e-15 && (gauss - kronrod).abs() < 1e-12);
//! ```
//!
//! # Source
//! A. S. Kronrod, *Nodes and Weights of Quadrature Formulas* (1965).

/// The nodes that are not negative, from the outside inwards.
pub const NODES: [f64; 8] = [
    0.991_455_371_120_812_6,
    0.949_107_912_342_758_5,
    0.864_864_423_359_769_1,
    0.741_531_185_599_394_4,
    0.586_087_235_467_691_1,
    0.405_845_151_377_397_2,
    0.207_784_955_007_898_47,
    0.0,
];
/// Kronrod's weights, the centre last.
pub const KRONROD: [f64; 8] = [
    0.022_935_322_010_529_224,
    0.063_092_092_629_978_56,
    0.104_790_010_322_250_18,
    0.140_653_259_715_525_92,
    0.169_004_726_639_267_9,
    0.190_350_578_064_785_4,
    0.204_432_940_075_298_9,
    0.209_482_141_084_727_83,
];
/// Gauss's weights at the nodes of odd index, the centre last.
pub const GAUSS: [f64; 4] =
    [0.129_484_966_168_869_7, 0.279_705_391_489_276_64, 0.381_830_050_505_118_9, 0.417_959_183_673_469_4];

#[cfg(test)]
mod tests {
    use super::{GAUSS, KRONROD, NODES};

    /// ∫ xⁿ dx = 2/(n + 1) for even n: sums of a dozen rounded terms.
    #[test]
    fn powers_are_integrated_exactly() {
        for n in (0..=22).step_by(2) {
            let exact = 2.0 / f64::from(n + 1);
            let term = |k: usize, weight: f64| if k == 7 { weight } else { 2.0 * weight } * NODES[k].powi(n);
            let kronrod: f64 = (0..8).map(|k| term(k, KRONROD[k])).sum();
            assert!((kronrod - exact).abs() <= 1e-15, "{n}: {kronrod}");
            let gauss: f64 = (0..4).map(|k| term(2 * k + 1, GAUSS[k])).sum();
            assert_eq!((gauss - exact).abs() <= 1e-15, n <= 12, "{n}: {gauss}");
        }
    }
}
