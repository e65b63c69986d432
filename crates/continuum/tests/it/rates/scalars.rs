//! The same formulas in lanes, in single precision and over differentiable numbers.

use nalgebra::Matrix3;
use piola_continuum::rates::{
    GradientRate, StretchRates, VelocityGradient, exponential, exponential_rows, logarithm, strain,
};
use piola_continuum::{DeformationGradient, Symmetric};
use piola_numerics::linear::matrix3::{from_rows, rows_of};
use piola_numerics::{Dual, Kernel, Lanes, Real, dispatch};
use piola_testkit::strategies::random_cases;
use piola_testkit::{Tol, assert_close_at_scale, difference_quotient};
use proptest::prelude::*;

use super::cases::{Path, assert_same, nine, path};

/// All rates of one deformation, in a row.
fn all<T: Real>(f: &DeformationGradient<T>, rate: &GradientRate<T>) -> Vec<T> {
    let l = VelocityGradient::of(f, rate);
    let rates = StretchRates::of(f, rate);
    let tensors = [
        rates.right_stretch(),
        rates.left_stretch(),
        rates.hencky_material(),
        rates.hencky_spatial(),
        strain::right_cauchy_green_rate(f, rate).0,
        strain::almansi_rate(f, &l).0,
    ];
    let spins = [rates.polar_spin().axial, rates.material_spin().axial, rates.logarithmic_spin().axial];
    let mut list: Vec<T> = tensors.iter().flat_map(|a: &Symmetric<T>| a.components).collect();
    list.extend(spins.iter().flat_map(|a| [a[0], a[1], a[2]]));
    list.extend(rates.rotation().iter().chain(l.0.iter()));
    list
}

struct All<'a>(&'a DeformationGradient<Lanes<f64, 4>>, &'a GradientRate<Lanes<f64, 4>>);
impl Kernel for All<'_> {
    type Output = Vec<Lanes<f64, 4>>;
    fn run(self) -> Self::Output {
        all(self.0, self.1)
    }
}

fn in_lanes(matrices: [&Matrix3<f64>; 4]) -> Matrix3<Lanes<f64, 4>> {
    Matrix3::from_fn(|i, j| Lanes(matrices.map(|m| m[(i, j)])))
}

fn close(what: &str, actual: &[f64], expected: &[f64], tol: Tol) {
    assert_close_at_scale(what, actual, expected, 1.0, tol);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(1_000)))]

    #[test]
    fn rates_in_lanes_equal_rates_one_by_one(a in path(), b in path(), c in path(), d in path()) {
        let paths = [&a, &b, &c, &d];
        let gradients = paths.map(|p: &Path| &p.gradient[0]);
        let f = DeformationGradient::new(in_lanes(gradients)).expect("0 < det F");
        let rate = GradientRate(in_lanes(paths.map(|p| &p.gradient[1])));
        let lanes = dispatch(All(&f, &rate));
        for (lane, path) in paths.into_iter().enumerate() {
            let alone = all(&path.deformation(), &path.rate());
            let here: Vec<f64> = lanes.iter().map(|x| x.0[lane]).collect();
            // Elementary functions of lanes and of floats may differ in the last digits.
            close("rates", &here, &alone, Tol::ulps(64.0).times(path.condition()));
        }
        let exponents = in_lanes(paths.map(|p| &p.gradient[2])) * Lanes([0.125, 4.0, 1.0, 8.0]);
        let lanes = exponential_rows(rows_of(&exponents));
        for (lane, (path, t)) in paths.into_iter().zip([0.125, 4.0, 1.0, 8.0]).enumerate() {
            let alone = exponential(&(path.gradient[2] * t)).expect("finite");
            let here = from_rows(lanes.map(|row| row.map(|x| x.0[lane])));
            // One tensor among others is scaled as if it were alone.
            assert_same("exp", &here, &alone, 0.0, Tol::ulps(4.0));
        }
    }

    #[test]
    fn rates_in_single_precision_equal_rates_in_double(path in path()) {
        let narrow = |m: &Matrix3<f64>| m.map(f32::lit);
        let f = DeformationGradient::new(narrow(&path.gradient[0])).expect("0 < det F");
        let rate = GradientRate(narrow(&path.gradient[1]));
        let wide = |m: &Matrix3<f32>| m.map(f64::from);
        let expected = all(&DeformationGradient::new(wide(f.matrix())).expect("0 < det F"), &GradientRate(wide(&rate.0)));
        let actual: Vec<f64> = all(&f, &rate).into_iter().map(f64::from).collect();
        close("rates", &actual, &expected, Tol::ulps32(32.0).times(path.condition()));
        let e = exponential(&narrow(&path.gradient[2])).expect("finite");
        let expected = exponential(&wide(&narrow(&path.gradient[2]))).expect("finite");
        assert_same("exp", &wide(&e), &expected, 0.0, Tol::ulps32(16.0));
        let log = logarithm(&narrow(&(path.gradient[2] * 0.25))).expect("near 1");
        let expected = logarithm(&wide(&narrow(&(path.gradient[2] * 0.25)))).expect("near 1");
        assert_same("ln", &wide(&log), &expected, 0.0, Tol::ulps32(64.0));
    }

    #[test]
    fn derivatives_of_rates_equal_differences(path in path()) {
        // At coalescent stretches too: the rates are functions of F and Ḟ without a singularity.
        let direction = [nine(&path.gradient[2]), nine(&path.gradient[1])].concat().iter().map(|x| x * 0.125).collect::<Vec<_>>();
        let point = [nine(&path.gradient[0]), nine(&path.gradient[1])].concat();
        let of = |x: &[f64]| all(&DeformationGradient::new(Matrix3::from_row_slice(&x[..9])).expect("0 < J"), &GradientRate(Matrix3::from_row_slice(&x[9..])));
        let moving: Vec<Dual<f64>> = point.iter().zip(&direction).map(|(x, v)| Dual::new(*x, *v)).collect();
        let f = DeformationGradient::new(Matrix3::from_row_slice(&moving[..9])).expect("0 < J");
        let exact: Vec<f64> = all(&f, &GradientRate(Matrix3::from_row_slice(&moving[9..]))).iter().map(|x| x.tangent).collect();
        let differences = difference_quotient(of, &point, &direction);
        let tol = Tol::stated(1e-9, "sixth-order differences").times(path.condition().powi(2));
        close("derivatives of rates", &exact, &differences, tol);
    }
}
