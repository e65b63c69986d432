//! Inputs at which formulas of rates usually fail.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::rates::{
    ExponentialMotion, GradientRate, HomogeneousMotion, LinearMotion, RelativeDeformation, Spin, StretchRates,
    VelocityGradient, exponential, exponential_minus_identity, logarithm,
};
use piola_continuum::{ContinuumError, DeformationGradient, DisplacementGradient};
use piola_numerics::linear::matrix3::rows_of;
use piola_testkit::{Tol, assert_close, assert_close_at_scale};

use super::cases::{assert_same, nine};

fn rate() -> GradientRate {
    GradientRate(Matrix3::new(0.5, -1.0, 0.25, 2.0, 0.75, -0.5, 1.0, 0.125, -0.25))
}

fn diagonal(a: f64, b: f64, c: f64) -> DeformationGradient {
    DeformationGradient::new(Matrix3::from_diagonal(&Vector3::new(a, b, c))).expect("0 < det F")
}

#[test]
fn rates_at_equal_stretches_equal_those_of_parts() {
    // F = λ 1: U̇ = sym Ḟ, ṘRᵀ = W, (ln U)˙ = D, and the logarithmic spin is W.
    for stretch in [1.0, 2.0, 1e-6, 1e6] {
        let f = diagonal(stretch, stretch, stretch);
        let (rates, l) = (StretchRates::of(&f, &rate()), VelocityGradient::of(&f, &rate()));
        let symmetric = (rate().0 + rate().0.transpose()) * 0.5;
        let tol = Tol::ulps(4.0);
        assert_same("U̇", &rates.right_stretch().matrix(), &symmetric, 0.0, tol);
        assert_same("V̇", &rates.left_stretch().matrix(), &symmetric, 0.0, tol);
        assert_same("ṘRᵀ", &rates.polar_spin().matrix(), &l.spin().matrix(), 0.0, tol);
        assert_same("Ω^log", &rates.logarithmic_spin().matrix(), &l.spin().matrix(), 0.0, tol);
        assert_same("(ln U)˙", &rates.hencky_material().matrix(), &l.rate_of_deformation().matrix(), 0.0, tol);
        assert_same("(ln V)˙", &rates.hencky_spatial().matrix(), &l.rate_of_deformation().matrix(), 0.0, tol);
    }
}

#[test]
fn twirls_at_equal_stretches_are_refused() {
    let error = StretchRates::of(&diagonal(2.0, 2.0, 1.0), &rate()).material_twirl().unwrap_err();
    assert_eq!(error, ContinuumError::CoalescentStretches { stretches: [2.0, 2.0, 1.0] });
    assert!(StretchRates::of(&diagonal(3.0, 1.0, 1.0), &rate()).spatial_twirl().is_err());
    assert!(StretchRates::of(&diagonal(3.0, 1.0, 1.0), &rate()).principal_stretches().is_err());
    assert!(StretchRates::of(&diagonal(3.0, 2.0, 1.0), &rate()).spatial_twirl().is_ok());
}

#[test]
fn rates_of_polar_factors_at_stretch_ratio_1e8_satisfy_their_equations() {
    // diag(1e4, 1, 1e-4), in the frame of the axes: Û̇ₖₗ = (λₖ Âₖₗ + λₗ Âₗₖ)/(λₖ + λₗ), Ωₖₗ = (Âₖₗ − Âₗₖ)/(λₖ + λₗ).
    let stretches = [1e4, 1.0, 1e-4];
    let f = diagonal(stretches[0], stretches[1], stretches[2]);
    let rates = StretchRates::of(&f, &rate());
    let a = rate().0;
    let expected =
        Matrix3::from_fn(|k, l| (stretches[k] * a[(k, l)] + stretches[l] * a[(l, k)]) / (stretches[k] + stretches[l]));
    assert_same("U̇", &rates.right_stretch().matrix(), &expected, 0.0, Tol::ulps(8.0));
    let spin = Matrix3::from_fn(|k, l| (a[(k, l)] - a[(l, k)]) / (stretches[k] + stretches[l]));
    assert_same("RᵀṘ", &rates.material_spin().matrix(), &spin, 0.0, Tol::ulps(8.0));
    let hencky = Matrix3::from_fn(|k, l| {
        let (x, y) = (stretches[k], stretches[l]);
        expected[(k, l)] * if k == l { 1.0 / x } else { (x / y).ln() / (x - y) }
    });
    assert_same("(ln U)˙", &rates.hencky_material().matrix(), &hencky, 0.0, Tol::ulps(8.0));
}

#[test]
fn rates_of_a_rigid_motion_equal_its_spin() {
    let turn = exponential(&Spin::new(Vector3::new(0.5, -1.0, 2.0)).expect("finite").matrix()).expect("finite");
    let spin = Spin::new(Vector3::new(3.0, 1.0, -2.0)).expect("finite");
    let f = DeformationGradient::new(turn).expect("0 < det F");
    let rates = StretchRates::of(&f, &GradientRate(spin.matrix() * turn));
    let tol = Tol::ulps(16.0);
    assert_same("ṘRᵀ = W", &rates.polar_spin().matrix(), &spin.matrix(), 0.0, tol);
    assert_same("Ω^log = W", &rates.logarithmic_spin().matrix(), &spin.matrix(), 0.0, tol);
    assert_same("U̇ = 0", &rates.right_stretch().matrix(), &Matrix3::zeros(), 3.0, tol);
    assert_same("(ln V)˙ = 0", &rates.hencky_spatial().matrix(), &Matrix3::zeros(), 3.0, tol);
}

#[test]
fn rates_at_tiny_displacements_equal_parts_of_velocity_gradient() {
    let displacement = DisplacementGradient::new(rate().0 * 1e-20).expect("0 < det F");
    let rates = StretchRates::of(&displacement, &rate());
    let l = VelocityGradient(rate().0);
    assert_same("U̇ = D", &rates.right_stretch().matrix(), &l.rate_of_deformation().matrix(), 0.0, Tol::ulps(4.0));
    assert_same("Ṙ = W", &rates.rotation(), &l.spin().matrix(), 0.0, Tol::ulps(4.0));
    assert_same("Ω^log = W", &rates.logarithmic_spin().matrix(), &l.spin().matrix(), 0.0, Tol::ulps(4.0));
}

#[test]
fn exponentials_of_nilpotent_tensors_equal_polynomials() {
    // In oblique frames too, with entries whose products are exact.
    let base = Matrix3::new(1.0, 2.0, 0.0, 0.0, 1.0, 0.0, 4.0, -1.0, 1.0);
    let inverse = Matrix3::new(1.0, -2.0, 0.0, 0.0, 1.0, 0.0, -4.0, 9.0, 1.0);
    assert_eq!(base * inverse, Matrix3::identity());
    for size in [1.0, 8.0, 1024.0, 1.0 / 1024.0] {
        let k = base * Matrix3::new(0.0, 0.0, 0.0, size, 0.0, 0.0, 0.0, size, 0.0) * inverse;
        assert_eq!(exponential(&k).expect("finite"), Matrix3::identity() + k + k * k * 0.5);
    }
}

#[test]
fn exponentials_far_from_one_equal_those_of_their_diagonal() {
    for diagonal in [[-50.0_f64, -50.0, -50.0], [-400.0, -390.0, -380.0], [700.0, 1.0, -700.0], [300.0, 0.0, 250.0]] {
        let e = exponential(&Matrix3::from_diagonal(&Vector3::from(diagonal))).expect("finite");
        // Rounding of the argument alone moves the result by |a| ulp.
        let largest = diagonal.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let expected = nine(&Matrix3::from_diagonal(&Vector3::from(diagonal.map(f64::exp))));
        assert_close(&format!("{diagonal:?}"), &nine(&e), &expected, Tol::ulps(2.0).times(largest));
    }
    let far = exponential_minus_identity(&Matrix3::from_diagonal(&Vector3::new(-4000.0, 1.0, 0.0))).expect("finite");
    assert_close_at_scale(
        "decay",
        &nine(&far),
        &nine(&Matrix3::from_diagonal(&Vector3::new(-1.0, 1.0_f64.exp_m1(), 0.0))),
        1.0,
        Tol::ulps(16.0),
    );
}

#[test]
fn exponentials_beyond_the_range_are_refused() {
    let big = Matrix3::from_diagonal_element(1000.0);
    assert!(matches!(exponential(&big), Err(ContinuumError::NotFinite { quantity: "exp A", index: 0, .. })));
    assert!(exponential(&Matrix3::from_element(1e308)).is_err());
    let nan = Matrix3::from_diagonal_element(f64::NAN);
    assert!(matches!(exponential(&nan), Err(ContinuumError::NotFinite { quantity: "A", index: 0, .. })));
    assert!(exponential_minus_identity(&nan).is_err());
}

#[test]
fn logarithms_that_do_not_exist_are_refused() {
    // A half turn, a reflection, a singular tensor.
    for diagonal in [[-2.0, -2.0, 0.0], [-2.0, 0.0, 0.0], [-1.0, 0.0, 0.0]] {
        let minus_identity = Matrix3::from_diagonal(&Vector3::from(diagonal));
        assert!(matches!(logarithm(&minus_identity), Err(ContinuumError::NoPrincipalLogarithm)), "{diagonal:?}");
    }
    assert!(matches!(logarithm(&Matrix3::from_element(f64::INFINITY)), Err(ContinuumError::NotFinite { .. })));
}

#[test]
fn logarithms_of_large_deformations_equal_those_of_the_diagonal() {
    let log = logarithm(&Matrix3::from_diagonal(&Vector3::new(99.0, -0.99, 0.0))).expect("positive");
    let expected = Matrix3::from_diagonal(&Vector3::new(100.0_f64.ln(), (-0.99_f64).ln_1p(), 0.0));
    assert_same("ln diag(100, 0.01, 1)", &log, &expected, 0.0, Tol::ulps(16.0));
    // A rotation by 3 rad, nearly a half turn.
    let w = Matrix3::new(0.0, -3.0, 0.0, 3.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    let log = logarithm(&exponential_minus_identity(&w).expect("finite")).expect("no negative eigenvalue");
    assert_same("ln R", &log, &w, 0.0, Tol::ulps(64.0));
}

#[test]
fn bad_rates_are_refused_by_name() {
    let mut bad = Matrix3::identity();
    bad[(1, 2)] = f64::INFINITY;
    let error = GradientRate::new(bad).unwrap_err();
    assert!(matches!(error, ContinuumError::NotFinite { quantity: "rate of F", index: 5, .. }));
    let error = VelocityGradient::new(bad).unwrap_err();
    assert!(matches!(error, ContinuumError::NotFinite { quantity: "velocity gradient", index: 5, .. }));
    assert!(Spin::new(Vector3::new(0.0, f64::NAN, 0.0)).is_err());
    assert!(LinearMotion::new(Matrix3::identity(), bad).is_err());
    assert!(LinearMotion::new(-Matrix3::identity(), Matrix3::zeros()).is_err());
    assert!(ExponentialMotion::new(bad, Matrix3::identity()).is_err());
    assert!(ExponentialMotion::new(Matrix3::zeros(), -Matrix3::identity()).is_err());
    assert!(RelativeDeformation::of_displacement(rows_of(&(Matrix3::identity() * -3.0))).is_err());
}

#[test]
fn motions_that_turn_the_body_inside_out_are_refused_at_that_time() {
    let motion = LinearMotion::new(Matrix3::identity(), Matrix3::from_diagonal_element(-1.0)).expect("1");
    assert!(motion.deformation(0.5).is_ok());
    for time in [1.0, 2.0] {
        assert!(matches!(motion.rates(time), Err(ContinuumError::NonPositiveJacobian { .. })));
        assert!(motion.velocity_gradient(time).is_err());
    }
    assert!(matches!(motion.relative(0.0, 1.5), Err(ContinuumError::NonPositiveJacobian { .. })));
    let runaway = ExponentialMotion::new(Matrix3::from_diagonal_element(1.0), Matrix3::identity()).expect("1");
    assert!(matches!(runaway.deformation(1e4), Err(ContinuumError::NotFinite { .. })));
}
