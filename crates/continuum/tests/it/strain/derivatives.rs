//! Derivatives with respect to F and C: closed against differentiated, against differences, and at coalescence.

use nalgebra::Matrix3;
use num_dual::Dual64;
use piola_continuum::strain::{
    AlmansiStrain, BiotStrain, GreenStrain, HenckyStrain, LeftCauchyGreen, LeftStretch, LinearStrain, RightCauchyGreen,
    RightStretch, Rotation, SethHill, SethHillStrain, SpatialHenckyStrain, SpatialSethHillStrain, invariants,
};
use piola_continuum::{Deformation, DeformationGradient, Symmetric};
use piola_numerics::Real;
use piola_numerics::linear::matrix3::rows_of;
use piola_tensor::PAIR;
use piola_testkit::spectral::polar_reference;
use piola_testkit::strategies::random_cases;
use piola_testkit::{Tol, assert_close_at_scale, difference_quotient};
use proptest::prelude::*;

use super::cases::{analysis, coalescent, deformation, direction, flat, nine, right_stretch, spatial_hencky};

const ROUNDING: Tol = Tol::ulps(64.0);
const DIFFERENCES: Tol = Tol::stated(1e-11, "differences of sixth order of values with 16 digits");

fn gradient(x: &[f64]) -> DeformationGradient {
    DeformationGradient::new(Matrix3::from_row_slice(x)).expect("0 < det F")
}

fn scale(m: f64) -> SethHill {
    SethHill::new(m).expect("finite")
}

/// A 6×9 derivative times a direction.
fn applied(matrix: &[[f64; 9]; 6], direction: &Matrix3<f64>) -> Vec<f64> {
    let d = flat(direction);
    let components = matrix.map(|row| row.iter().zip(&d).map(|(a, b)| a * b).sum());
    nine(&Symmetric { components })
}

/// A 6×6 derivative times a symmetric direction: shears count twice.
fn contracted(slots: &[[f64; 6]; 6], x: &Symmetric) -> Vec<f64> {
    let weight = |place: usize| if PAIR[place].0 == PAIR[place].1 { 1.0 } else { 2.0 };
    let components = slots.map(|row| (0..6).map(|k| row[k] * weight(k) * x.components[k]).sum());
    nine(&Symmetric { components })
}

/// Any measure over num-dual's scalars: an independent differentiation of the same formula.
fn tangent_of(
    f: &DeformationGradient,
    d: &Matrix3<f64>,
    measure: impl Fn(&DeformationGradient<Dual64>) -> Symmetric<Dual64>,
) -> Vec<f64> {
    let moving = f.matrix().zip_map(d, Dual64::new);
    let measured = measure(&DeformationGradient::new(moving).expect("0 < det F"));
    nine(&Symmetric { components: measured.components.map(|x| x.eps) })
}

/// The derivative of a quantity of the 31-digit reference by differences.
fn by_reference(
    f: &DeformationGradient,
    d: &Matrix3<f64>,
    quantity: fn(&piola_testkit::spectral::PolarReference) -> [[f64; 3]; 3],
) -> Vec<f64> {
    let reference = |x: &[f64]| {
        let f = core::array::from_fn(|i| core::array::from_fn(|j| x[3 * i + j]));
        quantity(&polar_reference(f)).as_flattened().to_vec()
    };
    difference_quotient(reference, &flat(f.matrix()), &flat(d))
}

fn check_against_reference(f: &DeformationGradient, d: &Matrix3<f64>) {
    let check = |what: &str, actual: Vec<f64>, expected: Vec<f64>| {
        assert_close_at_scale(what, &actual, &expected, 1.0, DIFFERENCES);
    };
    check("dU", nine(&RightStretch::derivative(f, d)), by_reference(f, d, |p| p.right_stretch));
    check("d(U − 1)", nine(&BiotStrain::derivative(f, d)), by_reference(f, d, |p| p.right_stretch_less_one));
    check("dV", nine(&LeftStretch::derivative(f, d)), by_reference(f, d, |p| p.left_stretch));
    check("d ln U", nine(&HenckyStrain::derivative(f, d)), by_reference(f, d, |p| p.hencky_material));
    check("d ln V", nine(&SpatialHenckyStrain::derivative(f, d)), by_reference(f, d, |p| p.hencky_spatial));
    check("dR", flat(&Rotation::derivative(f, d)), by_reference(f, d, |p| p.rotation));
}

/// d₂ of the derivative along d₁, by differences of the derivative.
fn check_second_derivatives(f: &DeformationGradient, a: &Matrix3<f64>, b: &Matrix3<f64>) {
    let check = |what: &str, actual: Symmetric, derivative: &dyn Fn(&DeformationGradient) -> Symmetric| {
        let along = |x: &[f64]| nine(&derivative(&gradient(x)));
        let expected = difference_quotient(along, &flat(f.matrix()), &flat(b));
        assert_close_at_scale(what, &nine(&actual), &expected, 1.0, DIFFERENCES);
    };
    check("d²C", RightCauchyGreen::second_derivative(a, b), &|f| RightCauchyGreen::derivative(f, a));
    check("d²B", LeftCauchyGreen::second_derivative(a, b), &|f| LeftCauchyGreen::derivative(f, a));
    check("d²E", GreenStrain::second_derivative(a, b), &|f| GreenStrain::derivative(f, a));
    check("d²e", AlmansiStrain::second_derivative(f, a, b), &|f| AlmansiStrain::derivative(f, a));
    check("d²U", RightStretch::second_derivative(f, a, b), &|f| RightStretch::derivative(f, a));
    check("d²V", LeftStretch::second_derivative(f, a, b), &|f| LeftStretch::derivative(f, a));
    check("d² ln U", HenckyStrain::second_derivative(f, a, b), &|f| HenckyStrain::derivative(f, a));
    check("d² ln V", SpatialHenckyStrain::second_derivative(f, a, b), &|f| SpatialHenckyStrain::derivative(f, a));
    for m in [-2.5, -1.0, 0.5, 3.0] {
        check("d² Seth-Hill", SethHillStrain::second_derivative(f, scale(m), a, b), &|f| {
            SethHillStrain::derivative(f, scale(m), a)
        });
        check("d² spatial Seth-Hill", SpatialSethHillStrain::second_derivative(f, scale(m), a, b), &|f| {
            SpatialSethHillStrain::derivative(f, scale(m), a)
        });
    }
}

/// By the chain rule of C = `FᵀF`.
fn check_derivatives_by_metric(f: &DeformationGradient, a: &Matrix3<f64>, b: &Matrix3<f64>) {
    let metric = RightCauchyGreen::of(f);
    let (da, db) = (RightCauchyGreen::derivative(f, a), RightCauchyGreen::derivative(f, b));
    let both = RightCauchyGreen::second_derivative(a, b);
    let check = |what: &str, slots: [[f64; 6]; 6], expected: Symmetric| {
        assert_close_at_scale(what, &contracted(&slots, &da), &nine(&expected), 1.0, ROUNDING.times(4.0));
        for (i, row) in slots.iter().enumerate() {
            for (j, entry) in row.iter().enumerate() {
                assert_close_at_scale("∂ij/∂kl = ∂kl/∂ij", &[*entry], &[slots[j][i]], 1.0, ROUNDING);
            }
        }
    };
    check("∂U/∂C", RightStretch::derivative_by_metric(&metric), RightStretch::derivative(f, a));
    check("∂ ln U/∂C", HenckyStrain::derivative_by_metric(&metric), HenckyStrain::derivative(f, a));
    let by_green = HenckyStrain::derivative_by_green(&GreenStrain::of(f)).map(|row| row.map(|x| 0.5 * x));
    check("∂ ln U/∂E", by_green, HenckyStrain::derivative(f, a));
    let second = |what: &str, slots: [[f64; 6]; 6], curved: Symmetric, expected: Symmetric| {
        let linear = contracted(&slots, &both);
        let sum: Vec<f64> = nine(&curved).iter().zip(linear).map(|(a, b)| a + b).collect();
        assert_close_at_scale(what, &sum, &nine(&expected), 1.0, ROUNDING.times(16.0));
    };
    second(
        "∂²U/∂C²",
        RightStretch::derivative_by_metric(&metric),
        RightStretch::second_derivative_by_metric(&metric, &da, &db),
        RightStretch::second_derivative(f, a, b),
    );
    second(
        "∂² ln U/∂C²",
        HenckyStrain::derivative_by_metric(&metric),
        HenckyStrain::second_derivative_by_metric(&metric, &da, &db),
        HenckyStrain::second_derivative(f, a, b),
    );
    for m in [-2.5, -1.0, 0.5, 3.0] {
        check(
            "∂ Seth-Hill/∂C",
            SethHillStrain::derivative_by_metric(&metric, scale(m)),
            SethHillStrain::derivative(f, scale(m), a),
        );
        second(
            "∂² Seth-Hill/∂C²",
            SethHillStrain::derivative_by_metric(&metric, scale(m)),
            SethHillStrain::second_derivative_by_metric(&metric, scale(m), &da, &db),
            SethHillStrain::second_derivative(f, scale(m), a, b),
        );
    }
}

#[test]
fn derivatives_at_coalescence_equal_differences_of_the_reference() {
    let a = Matrix3::new(0.3, -0.5, 0.7, 0.2, -0.4, 0.6, -0.8, 0.1, 0.9);
    let b = Matrix3::new(-0.6, 0.2, 0.4, 0.9, 0.3, -0.1, 0.5, -0.7, 0.8);
    for f in coalescent() {
        check_against_reference(&f, &a);
        check_second_derivatives(&f, &a, &b);
        check_derivatives_by_metric(&f, &a, &b);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn derivatives_equal_differences(f in deformation(), a in direction(), b in direction()) {
        // Steps of 2⁻⁷ along directions of length 0.1 stay within the stretches.
        let (a, b) = (a * 0.2, b * 0.2);
        check_against_reference(&f, &a);
        check_second_derivatives(&f, &a, &b);
    }
}

proptest! {
    // A fifth of the deformations have stretches too close to each other for dyads of axes.
    #![proptest_config(ProptestConfig { max_global_rejects: 10_000, ..ProptestConfig::with_cases(random_cases(10_000)) })]

    #[test]
    fn derivatives_along_a_direction_equal_those_of_dual_numbers(f in deformation(), d in direction()) {
        let check = |what: &str, actual: Symmetric, expected: Vec<f64>| {
            assert_close_at_scale(what, &nine(&actual), &expected, 1.0, ROUNDING);
        };
        check("dC", RightCauchyGreen::derivative(&f, &d), tangent_of(&f, &d, |f| RightCauchyGreen::of(f).0));
        check("dB", LeftCauchyGreen::derivative(&f, &d), tangent_of(&f, &d, |f| LeftCauchyGreen::of(f).0));
        check("dE", GreenStrain::derivative(&f, &d), tangent_of(&f, &d, |f| GreenStrain::of(f).0));
        check("de", AlmansiStrain::derivative(&f, &d), tangent_of(&f, &d, |f| AlmansiStrain::of(f).0));
        check("dU", RightStretch::derivative(&f, &d), tangent_of(&f, &d, right_stretch));
        check("d ln V", SpatialHenckyStrain::derivative(&f, &d), tangent_of(&f, &d, spatial_hencky));
    }

    #[test]
    fn whole_derivatives_equal_derivatives_along_a_direction(f in deformation(), d in direction()) {
        let check = |what: &str, whole: [[f64; 9]; 6], along: Symmetric| {
            assert_close_at_scale(what, &applied(&whole, &d), &nine(&along), 1.0, ROUNDING);
        };
        check("C", RightCauchyGreen::derivative_matrix(&f), RightCauchyGreen::derivative(&f, &d));
        check("B", LeftCauchyGreen::derivative_matrix(&f), LeftCauchyGreen::derivative(&f, &d));
        check("E", GreenStrain::derivative_matrix(&f), GreenStrain::derivative(&f, &d));
        check("ε", LinearStrain::derivative_matrix(&f), LinearStrain::derivative(&f, &d));
        check("e", AlmansiStrain::derivative_matrix(&f), AlmansiStrain::derivative(&f, &d));
        check("U", RightStretch::derivative_matrix(&f), RightStretch::derivative(&f, &d));
        check("V", LeftStretch::derivative_matrix(&f), LeftStretch::derivative(&f, &d));
        check("U − 1", BiotStrain::derivative_matrix(&f), BiotStrain::derivative(&f, &d));
        check("ln U", HenckyStrain::derivative_matrix(&f), HenckyStrain::derivative(&f, &d));
        check("ln V", SpatialHenckyStrain::derivative_matrix(&f), SpatialHenckyStrain::derivative(&f, &d));
        let m = scale(-0.5);
        check("Seth-Hill", SethHillStrain::derivative_matrix(&f, m), SethHillStrain::derivative(&f, m, &d));
    }

    #[test]
    fn derivatives_by_metric_equal_those_by_the_chain_rule(f in deformation(), a in direction(), b in direction()) {
        check_derivatives_by_metric(&f, &a, &b);
    }

    #[test]
    fn rates_of_green_and_almansi_strain_equal_stretching_carried_back(f in deformation(), rate in direction()) {
        let inverse = f.inverse().expect("regular");
        let velocity_gradient = rate * inverse.matrix();
        let stretching = (velocity_gradient + velocity_gradient.transpose()) * 0.5;
        let carried = f.matrix().transpose() * stretching * f.matrix();
        assert_close_at_scale("Ė = Fᵀ D F", &nine(&GreenStrain::derivative(&f, &rate)), &flat(&carried), 1.0, ROUNDING);
        let e = AlmansiStrain::of(&f).matrix();
        let spatial = stretching - velocity_gradient.transpose() * e - e * velocity_gradient;
        assert_close_at_scale("ė = D − Lᵀ e − e L", &nine(&AlmansiStrain::derivative(&f, &rate)), &flat(&spatial), 4.0, ROUNDING);
    }

    #[test]
    fn derivatives_of_invariants_equal_those_of_dual_numbers(f in deformation(), d in direction()) {
        let moving = f.matrix().zip_map(&d, Dual64::new);
        let moving = DeformationGradient::new(moving).expect("0 < det F");
        let dc = RightCauchyGreen::derivative(&f, &d);
        let c = RightCauchyGreen::of(&f).0;
        let along_gradient = |rows: [[f64; 3]; 3]| rows.as_flattened().iter().zip(flat(&d)).map(|(a, b)| a * b).sum::<f64>();
        let check = |what: &str, actual: f64, expected: Dual64| {
            assert_close_at_scale(what, &[actual], &[expected.eps], 16.0, ROUNDING);
        };
        let derivatives = invariants::derivatives(&c).map(|g| g.double_contraction(&dc));
        check("I₁ by C", derivatives[0], invariants::first(&moving));
        check("I₂ by C", derivatives[1], invariants::second(&moving));
        check("I₃ by C", derivatives[2], invariants::third(&moving));
        check("I₁ by F", along_gradient(invariants::first_gradient(&f)), invariants::first_minus_three(&moving));
        check("I₂ by F", along_gradient(invariants::second_gradient(&f)), invariants::second_minus_three(&moving));
        check("I₃ by F", along_gradient(invariants::third_gradient(&f)), invariants::third_minus_one(&moving));
        let first = invariants::isochoric_first_derivative(&f);
        check("Ī₁ by C", first.double_contraction(&dc), invariants::isochoric_first(&moving));
        let gradient = invariants::gradient_of_metric_derivative(f.gradient_rows(), &first);
        check("Ī₁ by F", along_gradient(gradient), invariants::isochoric_first_minus_three(&moving));
        let second = invariants::isochoric_second_derivative(&f);
        check("Ī₂ by C", second.double_contraction(&dc), invariants::isochoric_second_minus_three(&moving));
        check("J", along_gradient(f.cofactor_rows()), moving.jacobian());
        check("ln J", along_gradient(f.cofactor_rows()) / f.jacobian(), moving.ln_jacobian());
    }

    #[test]
    fn second_derivatives_of_invariants_equal_derivatives_of_their_derivatives(f in deformation(), d in direction(), x in direction()) {
        let moving = f.matrix().zip_map(&d, Dual64::new);
        let moving = DeformationGradient::new(moving).expect("0 < det F");
        let x = Symmetric::symmetric_part(rows_of(&x));
        let lifted = Symmetric { components: x.components.map(<Dual64 as Real>::lit) };
        let (c, dc) = (RightCauchyGreen::of(&f).0, RightCauchyGreen::derivative(&f, &d));
        let moving_c = RightCauchyGreen::of(&moving).0;
        let expected = invariants::derivatives(&moving_c).map(|g| g.double_contraction(&lifted).eps);
        let actual = invariants::second_derivatives(&c, &dc, &x);
        assert_close_at_scale("I", &actual, &expected, 16.0, ROUNDING);
        let check = |what: &str, actual: Symmetric, expected: Symmetric<Dual64>| {
            let expected = nine(&Symmetric { components: expected.components.map(|x| x.eps) });
            assert_close_at_scale(what, &nine(&actual), &expected, 16.0, ROUNDING.times(8.0));
        };
        check("Ī₁", invariants::isochoric_first_second_derivative(&f, &dc), invariants::isochoric_first_derivative(&moving));
        check("Ī₂", invariants::isochoric_second_second_derivative(&f, &dc), invariants::isochoric_second_derivative(&moving));
    }

    #[test]
    fn derivatives_of_principal_stretches_equal_dyads_of_axes(f in deformation(), d in direction()) {
        let stretch = analysis(&f);
        let stretches = stretch.principal_stretches();
        // Axes are determined to ε over the gap; where that is small there is nothing to compare.
        prop_assume!(0.05 < (stretches[0] - stretches[1]).min(stretches[1] - stretches[2]));
        let moving = f.matrix().zip_map(&d, Dual64::new);
        let tangents = analysis(&DeformationGradient::new(moving).expect("0 < det F")).principal_stretches();
        let (n, q) = (stretch.spatial_axes(), stretch.material_axes());
        for k in 0..3 {
            let rate: f64 = (0..3).map(|i| (0..3).map(|j| n[k][i] * d[(i, j)] * q[k][j]).sum::<f64>()).sum();
            assert_close_at_scale("dλ = n · dF q", &[rate], &[tangents[k].eps], 1.0, ROUNDING.times(20.0));
        }
    }
}
