//! L, its parts, and the rates of R, U, V, ln U and ln V.

use nalgebra::{Matrix3, Vector3};
use num_dual::Dual64;
use piola_continuum::polar::StretchAnalysis;
use piola_continuum::rates::{
    AccelerationGradient, GradientRate, GradientSecondRate, StretchRates, VelocityGradient, strain,
};
use piola_continuum::{Deformation, DeformationGradient, DisplacementGradient};
use piola_numerics::Real;
use piola_numerics::linear::matrix3::from_rows;
use piola_testkit::strategies::{random_cases, vector};
use piola_testkit::{DoubleDouble, Tol};
use proptest::prelude::*;

use super::super::cases::{assert_same, distinct, gap, path};

fn derivative(a: &Matrix3<Dual64>) -> Matrix3<f64> {
    a.map(|x| x.eps)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(10_000)))]

    #[test]
    fn velocity_gradient_times_gradient_equals_its_rate(path in path()) {
        let (f, l) = (path.deformation(), path.velocity_gradient());
        let tol = Tol::ulps(8.0).times(path.condition());
        let back = GradientRate::of(&f, &l);
        assert_same("L F = Ḟ", &back.0, &path.gradient[1], 1.0, tol);
        let displaced = DisplacementGradient::new(f.matrix() - Matrix3::identity()).expect("0 < det F");
        assert_same("L (1 + ∇u) = Ḟ", &GradientRate::of(&displaced, &l).0, &path.gradient[1], 1.0, tol);
        let parts = VelocityGradient::of_parts(&l.rate_of_deformation(), &l.spin());
        assert_same("D + W = L", &parts.0, &l.0, 0.0, Tol::ulps(1.0));
        let curl = l.spin().vorticity();
        let entries = [l.0[(2, 1)] - l.0[(1, 2)], l.0[(0, 2)] - l.0[(2, 0)], l.0[(1, 0)] - l.0[(0, 1)]];
        piola_testkit::assert_close("curl v", curl.as_slice(), &entries, Tol::ulps(0.0));
    }

    #[test]
    fn second_rate_equals_that_of_the_acceleration(path in path()) {
        let f = path.deformation();
        let second = GradientSecondRate(path.gradient[2] * 2.0);
        let (l, a) = (path.velocity_gradient(), AccelerationGradient::of(&f, &second));
        let back = a.gradient_second_rate(&f);
        assert_same("(grad a) F = F̈", &back.0, &second.0, 1.0, Tol::ulps(16.0).times(path.condition()));
        // L̇ by the derivative of Ḟ F⁻¹.
        let time = Dual64::from(0.0).derivative();
        let gradient = DeformationGradient::new(path.at(time)).expect("0 < det F");
        let rate = path.gradient[1].map(Dual64::from) + path.gradient[2].map(|x| Dual64::from(2.0 * x)) * time;
        let expected = derivative(&VelocityGradient::of(&gradient, &GradientRate(rate)).0);
        let size = a.0.norm() + l.0.norm().powi(2);
        let tol = Tol::ulps(32.0).times(path.condition());
        assert_same("L̇ = grad a − L²", &a.velocity_gradient_rate(&l), &expected, size, tol);
        assert_same("grad a = L̇ + L²", &AccelerationGradient::of_rate(&l, &expected).0, &a.0, size, tol);
    }

    #[test]
    fn rates_of_strain_equal_derivatives_of_strain(path in path()) {
        let (f, rate, l) = (path.deformation(), path.rate(), path.velocity_gradient());
        let moving = path.at(Dual64::from(0.0).derivative());
        let right = derivative(&(moving.transpose() * moving));
        assert_same("Ċ", &strain::right_cauchy_green_rate(&f, &rate).matrix(), &right, 3.0, Tol::ulps(8.0));
        assert_same("Ė", &(strain::green_rate(&f, &rate).matrix() * 2.0), &right, 3.0, Tol::ulps(8.0));
        let stretching = l.rate_of_deformation().matrix();
        let pulled = f.matrix().transpose() * stretching * f.matrix();
        let tol = Tol::ulps(16.0).times(path.condition());
        assert_same("Fᵀ D F = Ė", &pulled, &(right * 0.5), 3.0, tol);
        let left = derivative(&(moving * moving.transpose()));
        assert_same("Ḃ", &strain::left_cauchy_green_rate(&f, &rate).matrix(), &left, 3.0, Tol::ulps(8.0));
        let inverse = piola_numerics::linear::matrix3::inverse(&moving).expect("regular");
        let almansi = derivative(&(inverse.transpose() * inverse)) * -0.5;
        let tol = Tol::ulps(16.0).times(path.condition().powi(2));
        assert_same("ė", &strain::almansi_rate(&f, &l).matrix(), &almansi, 1.0, tol);
        let jacobian = piola_numerics::linear::matrix3::determinant(DeformationGradient::new(moving).expect("0 < J").gradient_rows());
        let scale = path.condition() * f.jacobian();
        piola_testkit::assert_close_at_scale("J̇", &[strain::jacobian_rate(&f, &rate)], &[jacobian.eps], scale, Tol::ulps(16.0));
        piola_testkit::assert_close_at_scale("J tr L", &[l.jacobian_rate(&f)], &[jacobian.eps], scale, Tol::ulps(16.0).times(path.condition()));
    }

    #[test]
    fn rates_of_polar_factors_satisfy_their_equations(path in path()) {
        let f = path.deformation();
        let rates = StretchRates::of(&f, &path.rate());
        let analysis = rates.analysis();
        let (r, u, v) = (from_rows(analysis.rotation()), analysis.right_stretch().matrix(), analysis.left_stretch().matrix());
        let (dr, du, dv) = (rates.rotation(), rates.right_stretch().matrix(), rates.left_stretch().matrix());
        let rate = path.gradient[1];
        let size = f.matrix().norm();
        let tol = Tol::ulps(16.0);
        assert_same("U̇U + UU̇ = Ċ", &(du * u + u * du), &strain::right_cauchy_green_rate(&f, &path.rate()).matrix(), size, tol);
        assert_same("V̇V + VV̇ = Ḃ", &(dv * v + v * dv), &strain::left_cauchy_green_rate(&f, &path.rate()).matrix(), size, tol);
        let condition = path.condition();
        assert_same("ṘU + RU̇ = Ḟ", &(dr * u + r * du), &rate, size, tol.times(condition));
        assert_same("V̇R + VṘ = Ḟ", &(dv * r + v * dr), &rate, size, tol.times(condition));
        let (polar, material) = (rates.polar_spin().matrix(), rates.material_spin().matrix());
        let scale = polar.norm().max(1.0);
        assert_same("ṘRᵀ", &polar, &(dr * r.transpose()), scale, tol);
        assert_same("RᵀṘ", &material, &(r.transpose() * dr), scale, tol);
        let inverse = u.try_inverse().expect("regular");
        let l = path.velocity_gradient();
        let sum = polar + r * du * inverse * r.transpose();
        assert_same("L = ṘRᵀ + RU̇U⁻¹Rᵀ", &sum, &l.0, 1.0, tol.times(condition));
        assert_same("L of the frame", &rates.velocity_gradient().0, &l.0, 1.0, tol.times(condition));
    }

    #[test]
    fn rates_of_polar_factors_equal_derivatives_of_polar_factors(path in path()) {
        let rates = StretchRates::of(&path.deformation(), &path.rate());
        let moving = DeformationGradient::new(path.at(Dual64::from(0.0).derivative())).expect("0 < det F");
        let analysis = StretchAnalysis::of(&moving);
        let tol = Tol::ulps(32.0).times(path.condition());
        assert_same("Ṙ", &rates.rotation(), &derivative(&from_rows(analysis.rotation())), 1.0, tol);
        assert_same("U̇", &rates.right_stretch().matrix(), &derivative(&analysis.right_stretch().matrix()), 1.0, tol);
        assert_same("V̇", &rates.left_stretch().matrix(), &derivative(&analysis.left_stretch().matrix()), 1.0, tol);
        assert_same("(ln U)˙", &rates.hencky_material().matrix(), &derivative(&analysis.hencky_material().matrix()), 1.0, tol);
        assert_same("(ln V)˙", &rates.hencky_spatial().matrix(), &derivative(&analysis.hencky_spatial().matrix()), 1.0, tol);
    }

    #[test]
    fn logarithmic_rate_of_spatial_hencky_strain_equals_stretching(path in path()) {
        let rates = StretchRates::of(&path.deformation(), &path.rate());
        // The material rate of ln V from differentiable numbers: no formula of rates is used for it.
        let moving = DeformationGradient::new(path.at(Dual64::from(0.0).derivative())).expect("0 < det F");
        let hencky = StretchAnalysis::of(&moving).hencky_spatial().matrix();
        let (strain, rate) = (hencky.map(|x| x.re), derivative(&hencky));
        let spin = rates.logarithmic_spin().matrix();
        let objective = rate - spin * strain + strain * spin;
        let stretching = path.velocity_gradient().rate_of_deformation().matrix();
        assert_same("(ln V)° = D", &objective, &stretching, 1.0, Tol::ulps(32.0).times(path.condition()));
    }

    #[test]
    fn twirls_equal_rates_of_principal_axes(path in distinct()) {
        let rates = StretchRates::of(&path.deformation(), &path.rate());
        let gap = gap(&path);
        let moving = DeformationGradient::new(path.at(Dual64::from(0.0).derivative())).expect("0 < det F");
        let analysis = StretchAnalysis::of(&moving);
        let tol = Tol::ulps_because(256.0, "rates of axes: three products and two gaps").times((1.0 / gap).powi(2) * path.condition());
        let axes = |rows: [[Dual64; 3]; 3]| from_rows(rows).transpose();
        let (material, spatial) = (axes(analysis.material_axes()), axes(analysis.spatial_axes()));
        let twirl = rates.material_twirl().expect("distinct").matrix();
        assert_same("N̂̇ = ω × N̂", &(twirl * material.map(|x| x.re)), &derivative(&material), 1.0, tol);
        let twirl = rates.spatial_twirl().expect("distinct").matrix();
        assert_same("n̂̇ = ω × n̂", &(twirl * spatial.map(|x| x.re)), &derivative(&spatial), 1.0, tol);
        let expected = analysis.principal_stretches().map(|x| x.eps);
        let tol = Tol::ulps(64.0).times(1.0 / gap);
        piola_testkit::assert_close_at_scale("λ̇", &rates.principal_stretches().expect("distinct"), &expected, 1.0, tol);
    }

    #[test]
    fn rates_of_a_small_displacement_equal_those_of_its_gradient(path in path(), exponent in 1..14_i32) {
        let size = 10.0_f64.powi(-exponent);
        let displacement = DisplacementGradient::new(path.gradient[2] * (size / 4.0)).expect("0 < det F");
        let rates = StretchRates::of(&displacement, &path.rate());
        // Ω − W and U̇ − D vanish with the strain, in proportion.
        let l = VelocityGradient::of(&displacement, &path.rate());
        let excess = rates.polar_spin().matrix() - l.spin().matrix();
        prop_assert!(excess.norm() <= 4.0 * size + 16.0 * f64::EPSILON, "{}", excess.norm());
        let whole = DeformationGradient::new(displacement.matrix() + Matrix3::identity()).expect("0 < det F");
        let other = StretchRates::of(&whole, &path.rate());
        let tol = Tol::ulps(16.0);
        assert_same("U̇", &rates.right_stretch().matrix(), &other.right_stretch().matrix(), 1.0, tol);
        assert_same("(ln U)˙", &rates.hencky_material().matrix(), &other.hencky_material().matrix(), 1.0, tol);
        assert_same("ṘRᵀ", &rates.polar_spin().matrix(), &other.polar_spin().matrix(), 1.0, tol);
    }

    #[test]
    fn rates_at_large_stretch_ratios_equal_those_in_twice_the_precision(path in path(), exponents in vector(3, -3.0..3.0)) {
        // R₁ diag(10^x) R₂ with the frames of the path: ratios up to 10⁶.
        let frames = path.gradient[0].svd(true, true);
        let (left, right) = (frames.u.expect("asked for"), frames.v_t.expect("asked for"));
        let stretches = Vector3::new(10.0_f64.powf(exponents[0]), 10.0_f64.powf(exponents[1]), 10.0_f64.powf(exponents[2]));
        let mut gradient = left * Matrix3::from_diagonal(&stretches) * right;
        gradient *= gradient.determinant().signum();
        let rates = StretchRates::of(&DeformationGradient::new(gradient).expect("0 < det F"), &path.rate());
        let wide = |m: &Matrix3<f64>| m.map(DoubleDouble::lit);
        let f = DeformationGradient::new(wide(&gradient)).expect("0 < det F");
        let reference = StretchRates::of(&f, &GradientRate(wide(&path.gradient[1])));
        let narrow = |m: Matrix3<DoubleDouble>| m.map(|x| x.primal(0));
        let [a, b, c] = rates.analysis().principal_stretches();
        let size = path.gradient[1].norm();
        let tol = Tol::ulps(8.0);
        let (turning, inverse) = (1.0 + a / (b + c), 1.0 + a / c);
        assert_same("U̇", &rates.right_stretch().matrix(), &narrow(reference.right_stretch().matrix()), size, tol.times(turning));
        assert_same("V̇", &rates.left_stretch().matrix(), &narrow(reference.left_stretch().matrix()), size, tol.times(turning));
        let spin = size / (b + c);
        assert_same("ṘRᵀ", &rates.polar_spin().matrix(), &narrow(reference.polar_spin().matrix()), spin, tol.times(turning));
        assert_same("RᵀṘ", &rates.material_spin().matrix(), &narrow(reference.material_spin().matrix()), spin, tol.times(turning));
        assert_same("(ln U)˙", &rates.hencky_material().matrix(), &narrow(reference.hencky_material().matrix()), size / c, tol.times(inverse));
        assert_same("(ln V)˙", &rates.hencky_spatial().matrix(), &narrow(reference.hencky_spatial().matrix()), size / c, tol.times(inverse));
        assert_same("Ω^log", &rates.logarithmic_spin().matrix(), &narrow(reference.logarithmic_spin().matrix()), size / c, tol.times(inverse));
    }
}
