//! Differences of elementary functions that would cancel if they were formed.

use piola_numerics::internal::{excess_of_exponential, excess_over_logarithm};

#[test]
fn excess_of_exponential_equals_its_taylor_series_and_the_difference() {
    for k in 1..60 {
        let x = 10.0_f64.powf(1.0 - 0.25 * f64::from(k));
        for x in [x, -x] {
            if x.abs() < 1e-4 {
                let series = x * x * (0.5 + x * (1.0 / 6.0 + x * (1.0 / 24.0 + x / 120.0)));
                assert!((excess_of_exponential(x) / series - 1.0).abs() < 4.0 * f64::EPSILON, "{x:e}");
            } else {
                let difference = x.exp_m1() - x;
                let rounding = 8.0 * f64::EPSILON * (x.abs() + difference) / difference;
                assert!((excess_of_exponential(x) / difference - 1.0).abs() < rounding, "{x:e}");
            }
        }
    }
}

#[test]
fn excess_over_logarithm_equals_its_taylor_series_and_the_difference() {
    for k in 1..60 {
        let x = 10.0_f64.powf(-0.25 * f64::from(k));
        for x in [x, -x] {
            if x.abs() < 1e-4 {
                let series = x * x * (0.5 - x * (1.0 / 3.0 - x * (0.25 - x * 0.2)));
                assert!((excess_over_logarithm(x) / series - 1.0).abs() < 4.0 * f64::EPSILON, "{x:e}");
            } else {
                let difference = x - x.ln_1p();
                let rounding = 4.0 * f64::EPSILON * x.abs() / difference;
                assert!((excess_over_logarithm(x) / difference - 1.0).abs() < rounding, "{x:e}");
            }
        }
    }
}
