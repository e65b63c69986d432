//! Quantiles of Student's law.

use piola_fit::student;
use piola_testkit::{Tol, assert_close};

#[test]
fn quantiles_of_student_equal_closed_forms() {
    let close = |degrees, expected: f64| {
        let t = student(0.95, degrees).expect("a degree of freedom");
        let search = Tol::stated(1e-9, "the search for the quantile, as its documentation says");
        assert_close(&format!("{degrees} degrees of freedom"), &[t], &[expected], search);
    };
    // One degree: tan(0.475 π); two: with q = 0.95, q √(2/(1 − q²)).
    close(1, (0.475 * core::f64::consts::PI).tan());
    close(2, 0.95 * (2.0_f64 / (1.0 - 0.9025)).sqrt());
    // Forty, by the incomplete beta function at 30 digits; many: the normal law, √2 erf⁻¹(0.95).
    close(40, 2.021_075_390_306_273_4);
    let far = student(0.95, 100_000_000).expect("degrees of freedom");
    let normal = Tol::stated(2e-8, "(z² + 1)/(4 ν) of ν = 10⁸ degrees, 1.2e-8");
    assert_close("many", &[far], &[1.959_963_984_540_054], normal);
}
