//! Width of a simultaneous confidence band of a curve.
//!
//! ```text
//! P(somewhere c < |Z(u)|) ≤ (κ₀/π) (1 + c²/ν)^(−ν/2) + P(c < |t_ν|)      κ₀ = ∫ |d/du (l/|l|)| du
//! ```
//! for the curve l(u)·ε/|l(u)| s of independent normal ε with s of ν degrees of freedom: the volume of a tube about the path of l/|l|
//! on the sphere (D. Q. Naiman, 1986; J. Sun, C. R. Loader, 1994).

use statrs::distribution::{ContinuousCDF, Normal, StudentsT};

/// Half the width of ln beyond which a band has no ends that are numbers.
pub(super) const WIDEST: f64 = 300.0;

/// P(c < |t|).
fn both_tails(c: f64, freedom: f64) -> f64 {
    let normal = || 2.0 * Normal::standard().sf(c);
    if freedom < 1e6 {
        StudentsT::new(0.0, 1.0, freedom).map_or_else(|_| normal(), |law| 2.0 * law.sf(c))
    } else {
        normal()
    }
}

/// c for a path of length κ₀.
pub(super) fn critical(length: f64, freedom: f64, confidence: f64) -> f64 {
    let exceeded = |c: f64| {
        let density = if freedom < 1e6 { -0.5 * freedom * (c * c / freedom).ln_1p() } else { -0.5 * c * c };
        length / core::f64::consts::PI * density.exp() + both_tails(c, freedom)
    };
    let (mut low, mut high) = (0.0, 1.0);
    while 1.0 - confidence < exceeded(high) && high < 1e9 {
        (low, high) = (high, 2.0 * high);
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if 1.0 - confidence < exceeded(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}

/// Factor on the width of bands of smoothed curves. λ is chosen from the same rows, which makes the curve scatter more, most of all a straight
/// curve, of two degrees of freedom. The factor was chosen with the fluids and flows of the tables of coverage.
pub(super) fn selected(freedom: f64) -> f64 {
    const MOST: f64 = 0.15;
    /// The factor reaches one at 2 + 8.5 degrees of freedom.
    const OVER: f64 = 8.5;
    1.0 + MOST * (1.0 - (freedom - 2.0) / OVER).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::{critical, selected};

    #[test]
    fn the_factor_falls_from_straight_to_curved() {
        for (freedom, factor) in [(1.0, 1.15), (2.0, 1.15), (6.25, 1.075), (10.5, 1.0), (40.0, 1.0)] {
            assert!((selected(freedom) - factor).abs() < 1e-15, "{freedom}");
        }
    }

    #[test]
    fn a_path_without_length_has_the_quantile_of_student() {
        assert!((critical(0.0, f64::INFINITY, 0.95) - 1.959_963_985).abs() < 1e-8);
        // One degree of freedom: tan(0.475 π).
        let cauchy = (0.475 * core::f64::consts::PI).tan();
        assert!((critical(0.0, 1.0, 0.95) / cauchy - 1.0).abs() < 1e-9);
        assert!(critical(0.0, 20.0, 0.95) < critical(5.0, 20.0, 0.95));
    }
}
