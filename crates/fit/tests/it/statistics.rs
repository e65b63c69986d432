//! Quantiles of Student's law.

use piola_fit::student;

#[test]
fn quantiles_of_student_equal_closed_forms() {
    let close = |degrees, expected: f64| {
        let t = student(0.95, degrees).unwrap_or(f64::NAN);
        assert!((t / expected - 1.0).abs() < 1e-9, "{degrees}: {t} {expected}");
    };
    // One degree: tan(0.475 π); two: with q = 0.95, q √(2/(1 − q²)).
    close(1, (0.475 * core::f64::consts::PI).tan());
    close(2, 0.95 * (2.0_f64 / (1.0 - 0.9025)).sqrt());
    // Forty, of tables; many: the normal law.
    close(40, 2.021_075_390_306_273);
    let far = student(0.95, 100_000_000).unwrap_or(f64::NAN);
    assert!((far - 1.959_963_985).abs() < 1e-7, "{far}");
}
