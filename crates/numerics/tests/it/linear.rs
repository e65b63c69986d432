//! Linear systems: the factors make the matrix again, solutions solve, and refusals say why.

use nalgebra::{DMatrix, DVector, Matrix3, SMatrix, Vector2, Vector3, dmatrix, dvector};
use piola_numerics::linear::{ldlt, lu, matrix3};
use piola_numerics::{Dual, Gradient, Lanes, NumericsError, Real};
use piola_testkit::strategies::{positive_definite, vector};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use proptest::prelude::*;

/// A Aᵀ + n·1: symmetric positive definite with a condition number below about 2n.
fn gram(n: usize, entries: &[f64]) -> DMatrix<f64> {
    let a = DMatrix::from_column_slice(n, n, entries);
    &a * a.transpose() + DMatrix::identity(n, n) * n as f64
}

fn condition(a: &DMatrix<f64>) -> f64 {
    let values = a.singular_values();
    values.max() / values.min()
}

/// The Hilbert matrix 1/(i + j + 1), with condition number e^{3.5 n}.
fn hilbert(n: usize) -> DMatrix<f64> {
    DMatrix::from_fn(n, n, |i, j| 1.0 / (i + j + 1) as f64)
}

proptest! {
    #[test]
    fn lower_diagonal_upper_product_equals_matrix(entries in vector(49, -1.0..1.0)) {
        let a = gram(7, &entries);
        let factors = ldlt::Ldlt::new(&a).unwrap();
        let factors = DMatrix::from_column_slice(7, 7, factors.factors());
        let mut lower = factors.lower_triangle();
        let diagonal = DMatrix::from_diagonal(&factors.diagonal());
        lower.fill_diagonal(1.0);
        assert_close("L D Lᵀ", (&lower * diagonal * lower.transpose()).as_slice(), a.as_slice(), Tol::ulps(8.0));
    }

    #[test]
    fn ldlt_solution_equals_the_vector_it_was_made_from(
        entries in vector(49, -1.0..1.0),
        x in vector(7, -1.0..1.0),
    ) {
        let (a, x) = (gram(7, &entries), DVector::from_column_slice(&x));
        let factors = ldlt::Ldlt::new(&a).unwrap();
        let solution = factors.solve(&(&a * &x)).unwrap();
        assert_close("A⁻¹ A x", solution.as_slice(), x.as_slice(), Tol::ulps(8.0).times(condition(&a)));
        assert_close("det A", &[factors.determinant()], &[a.determinant()], Tol::ulps(64.0));
        let estimate = factors.condition_estimate(a.as_slice()).unwrap();
        let exact = one_norm(&a) * one_norm(&a.try_inverse().unwrap());
assert_close("κ₁", &[estimate], &[exact], Tol::ulps(16.0).times(exact));
    }

    #[test]
    fn estimate_of_a_large_condition_number_is_below_it(entries in vector(225, -1.0..1.0)) {
        let a = gram(15, &entries);
        let estimate = ldlt::Ldlt::new(&a).unwrap().condition_estimate(a.as_slice()).unwrap();
        let lu_estimate = lu::Lu::new(&a).unwrap().condition_estimate(a.as_slice()).unwrap();
        let ratio = estimate / (one_norm(&a) * one_norm(&a.try_inverse().unwrap()));
        let rounding = Tol::ulps_because(1024.0, "a few ulp times condition numbers of some hundreds");
        prop_assert!(0.1 < ratio && ratio <= 1.0 + rounding.value(), "ratio {}", ratio);
        assert_close("by LDLᵀ and LU", &[estimate], &[lu_estimate], rounding);
    }

    #[test]
    fn lu_solution_equals_the_vector_it_was_made_from(
        entries in vector(36, -1.0..1.0),
        x in vector(6, -1.0..1.0),
    ) {
        let (a, x) = (DMatrix::from_column_slice(6, 6, &entries), DVector::from_column_slice(&x));
        let kappa = condition(&a);
        prop_assume!(kappa < 1e10);
        let factors = lu::Lu::new(&a).unwrap();
        let tolerance = Tol::ulps(16.0).times(kappa);
        assert_close_at_scale("A⁻¹ A x", factors.solve(&(&a * &x)).unwrap().as_slice(), x.as_slice(), 1.0, tolerance);
        let mut transposed = a.transpose() * &x;
        factors.solve_transposed_in_place(transposed.as_mut_slice()).unwrap();
        assert_close_at_scale("A⁻ᵀ Aᵀ x", transposed.as_slice(), x.as_slice(), 1.0, tolerance);
        assert_close("det A", &[factors.determinant()], &[a.determinant()], tolerance);
        let estimate = factors.condition_estimate(a.as_slice()).unwrap();
        let exact = one_norm(&a) * one_norm(&a.try_inverse().unwrap());
        assert_close("κ₁", &[estimate], &[exact], tolerance);
    }

    #[test]
    fn inverse_times_matrix_equals_identity(a in positive_definite(0.5..8.0), shear in vector(9, -0.1..0.1)) {
        let a = matrix3::from_rows(a) + Matrix3::from_column_slice(&shear);
        let kappa = condition(&DMatrix::from_column_slice(3, 3, a.as_slice()));
        let tolerance = Tol::ulps(8.0).times(kappa);
        let inverse = matrix3::inverse(&a).unwrap();
        assert_close("A⁻¹ A", (inverse * a).as_slice(), Matrix3::identity().as_slice(), tolerance);
        let x = Vector3::new(1.0, -2.0, 0.5);
        assert_close("A⁻¹ (A x)", matrix3::solve(&a, &(a * x)).unwrap().as_slice(), x.as_slice(), tolerance);
        assert_close("LU", lu::solve(a, a * x).unwrap().as_slice(), x.as_slice(), tolerance);
        assert_close("det", &[matrix3::determinant(matrix3::rows_of(&a))], &[a.determinant()], tolerance);
        let adjugate = matrix3::from_rows(matrix3::adjugate(matrix3::rows_of(&a)));
        let expected = Matrix3::identity() * a.determinant();
        assert_close("A adj A = det A", (a * adjugate).as_slice(), expected.as_slice(), tolerance);
    }

    #[test]
    fn solution_over_lanes_equals_solution_of_each_lane(
        matrices in proptest::collection::vec(positive_definite(0.5..8.0), 4),
        b in vector(3, -1.0..1.0),
    ) {
        let rows: [[Lanes<f64, 4>; 3]; 3] = core::array::from_fn(|i| {
            core::array::from_fn(|j| Lanes::from(core::array::from_fn::<f64, 4, _>(|lane| matrices[lane][i][j])))
        });
        let right = Vector3::from_fn(|i, _| Lanes::lit(b[i]));
        let lanes = matrix3::from_rows(rows);
        let solutions = [
            ("LDLᵀ", ldlt::solve(lanes, right).unwrap()),
            ("LU", lu::solve(lanes, right).unwrap()),
            ("3×3", matrix3::solve(&lanes, &right).unwrap()),
        ];
        for (lane, matrix) in matrices.iter().enumerate() {
            let a = matrix3::from_rows(*matrix);
            let expected = ldlt::solve(a, Vector3::from_column_slice(&b)).unwrap();
            for (how, solution) in &solutions {
                let solution: Vec<f64> = solution.iter().map(|x| x.primal(lane)).collect();
                let tolerance = Tol::ulps(8.0).times(16.0);
                assert_close(how, &solution, expected.as_slice(), tolerance);
            }
        }
    }

    #[test]
    fn derivative_of_solution_equals_implicit_derivative(
        a in positive_definite(0.5..8.0),
        b in positive_definite(0.5..8.0),
    ) {
        // (A + εB) x = r:  x′ = −A⁻¹ B x.
        let (a, b, r) = (matrix3::from_rows(a), matrix3::from_rows(b), Vector3::new(1.0, -2.0, 0.5));
        let dual = Matrix3::from_fn(|i, j| Dual::new(a[(i, j)], b[(i, j)]));
        let right = r.map(Dual::constant);
        let x = matrix3::solve(&a, &r).unwrap();
        let expected = matrix3::solve(&a, &-(b * x)).unwrap();
        for solution in [
            ldlt::solve(dual, right).unwrap(),
            lu::solve(dual, right).unwrap(),
            matrix3::solve(&dual, &right).unwrap(),
        ] {
            let tolerance = Tol::ulps(8.0).times(16.0);
            assert_close("x", solution.map(|x| x.value).as_slice(), x.as_slice(), tolerance);
            assert_close_at_scale("x′", solution.map(|x| x.tangent).as_slice(), expected.as_slice(), (b * x).amax(), tolerance.times(16.0));
        }
    }
}

fn one_norm(a: &DMatrix<f64>) -> f64 {
    a.column_iter().map(|column| column.iter().map(|x| x.abs()).sum()).fold(0.0, f64::max)
}

#[test]
fn derivative_of_determinant_equals_adjugate() {
    let a = [[2.0, -1.0, 0.5], [0.25, 3.0, 1.0], [-0.5, 0.75, 1.5]];
    let variables: [[Gradient<f64, 9>; 3]; 3] =
        core::array::from_fn(|i| core::array::from_fn(|j| Gradient::variable(a[i][j], 3 * i + j)));
    let determinant = matrix3::determinant(variables);
    let adjugate = matrix3::adjugate(a);
    let expected: [f64; 9] = core::array::from_fn(|k| adjugate[k % 3][k / 3]);
    assert_close("∂ det A/∂A", &determinant.partials, &expected, Tol::ulps(2.0));
}

#[test]
fn dependent_direction_is_found_and_told() {
    // The third coordinate moves as the first minus twice the second: a metric of rank two.
    let frame = dmatrix![1.0, 0.0, 1.0, 0.5; 0.0, 1.0, -2.0, 0.25];
    let a = frame.transpose() * &frame;
    let mut factors = a.as_slice().to_vec();
    let error = ldlt::factor_in_place(&mut factors, 4).unwrap_err();
    let NumericsError::NotPositiveDefinite { pivot, value, diagonal } = error else { panic!("{error}") };
    assert_eq!(pivot, 2);
    assert_close("pivot", &[value], &[0.0], Tol::ulps(4.0).times(diagonal));
    let mut direction = [0.0; 4];
    ldlt::null_direction_into(&factors, 4, pivot, &mut direction).unwrap();
    assert_close("null direction", &direction, &[-1.0, 2.0, 1.0, 0.0], Tol::ulps(4.0));
    let image = a * DVector::from_column_slice(&direction);
    assert_close("A z", image.as_slice(), &[0.0; 4], Tol::ulps(16.0));
    assert!(ldlt::null_direction_into(&factors, 4, 4, &mut direction).is_err());
}

#[test]
fn pivots_are_judged_in_the_units_of_their_coordinate() {
    // A metre and a nanometre coordinate of equal standing: small is not singular.
    let x = ldlt::solve(nalgebra::matrix![1.0, 0.5e-9; 0.5e-9, 1e-18], nalgebra::vector![1.0, 0.5e-9]).unwrap();
    assert_close("x", x.as_slice(), &[1.0, 0.0], Tol::ulps(4.0));
    let x = lu::solve(nalgebra::matrix![1.0, 0.5e-9; 2.0, 2e-9], nalgebra::vector![1.0, 2.0]).unwrap();
    assert_close("x", x.as_slice(), &[1.0, 0.0], Tol::ulps(4.0));
    let thin = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, 1e-30));
    assert_close("A⁻¹", &[matrix3::inverse(&thin).unwrap()[(2, 2)]], &[1e30], Tol::ulps(1.0));
}

#[test]
fn indefinite_singular_and_nan_matrices_are_refused_with_the_pivot() {
    let refused = |a: [f64; 4]| ldlt::factor_in_place(&mut a.clone(), 2).unwrap_err();
    assert_eq!(
        refused([1.0, 2.0, 2.0, 1.0]),
        NumericsError::NotPositiveDefinite { pivot: 1, value: -3.0, diagonal: 1.0 }
    );
    assert_eq!(
        refused([-1.0, 0.0, 0.0, 1.0]),
        NumericsError::NotPositiveDefinite { pivot: 0, value: -1.0, diagonal: -1.0 }
    );
    assert_eq!(refused([0.0; 4]), NumericsError::NotPositiveDefinite { pivot: 0, value: 0.0, diagonal: 0.0 });
    assert!(matches!(refused([1.0, f64::NAN, 0.0, 1.0]), NumericsError::NotPositiveDefinite { pivot: 1, .. }));
    let error = lu::Lu::new(&dmatrix![1.0, 2.0; 2.0, 4.0]).unwrap_err();
    assert_eq!(error, NumericsError::Singular { pivot: 1, value: 0.0, scale: 4.0 });
    let mut nan = [f64::NAN, 1.0, 1.0, 1.0];
    assert!(matches!(lu::factor_in_place(&mut nan, &mut [0; 2]), Err(NumericsError::Singular { pivot: 0, .. })));
    let error = matrix3::inverse(&Matrix3::new(1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0)).unwrap_err();
    assert!(matches!(error, NumericsError::Singular { pivot: 3, .. }), "{error}");
}

#[test]
fn one_bad_lane_is_refused_with_its_numbers() {
    let mut a = [Lanes::<f64, 4>::from([1.0, 2.0, -3.0, 4.0])];
    let error = ldlt::factor_in_place(&mut a, 1).unwrap_err();
    assert_eq!(error, NumericsError::NotPositiveDefinite { pivot: 0, value: -3.0, diagonal: -3.0 });
    // The lane beside it is small and regular.
    let mut a = [Lanes::<f64, 4>::from([1e-20, 0.0, -3.0, 4.0])];
    let error = lu::factor_in_place(&mut a, &mut [0]).unwrap_err();
    assert_eq!(error, NumericsError::Singular { pivot: 0, value: 0.0, scale: 0.0 });
}

#[test]
fn pivot_rows_of_lanes_do_not_depend_on_the_units_of_a_lane() {
    // The second row is good for both lanes; with the first one the second lane would lose ten digits.
    let lanes = |unit: f64, a: f64, b: f64| Lanes::<f64, 2>::from([a * unit, b]);
    let x = Vector2::new(lanes(1.0, 1.0, 3.0), lanes(1.0, -2.0, 0.1));
    // A power of two changes no digit.
    for unit in [1.0, 2.0_f64.powi(-40), 2.0_f64.powi(40)] {
        let a = nalgebra::matrix![
            lanes(unit, 1.0, 1e-10), lanes(unit, 2.0, 1.0);
            lanes(unit, 0.5, 1.0), lanes(unit, -1.0, 1.0)
        ];
        let solution = lu::solve(a, a * x).unwrap();
        for lane in 0..2 {
            let [found, expected] = [&solution, &x].map(|x| x.map(|x| x.primal(lane)));
            assert_close(&format!("x at {unit:e}"), found.as_slice(), expected.as_slice(), Tol::ulps(8.0));
        }
    }
}

#[test]
fn pivot_row_of_lanes_serves_every_lane() {
    // Each lane alone would begin with another row; the third is good for both.
    let lanes = |a: f64, b: f64| Lanes::<f64, 2>::from([a, b]);
    let a = SMatrix::<Lanes<f64, 2>, 3, 3>::from_row_slice(&[
        lanes(1.0, 0.0),
        lanes(2.0, 1.0),
        lanes(0.0, 1.0),
        lanes(0.0, 1.0),
        lanes(1.0, 2.0),
        lanes(1.0, 0.0),
        lanes(0.9, 0.9),
        lanes(0.0, 0.0),
        lanes(1.0, 1.0),
    ]);
    let x = Vector3::new(lanes(1.0, -1.0), lanes(2.0, 3.0), lanes(-0.5, 0.25));
    let b = a * x;
    let solution = lu::solve(a, b).unwrap();
    for lane in 0..2 {
        let (actual, expected): (Vec<f64>, Vec<f64>) =
            solution.iter().zip(&x).map(|(s, x)| (s.primal(lane), x.primal(lane))).unzip();
        assert_close("x", &actual, &expected, Tol::ulps(16.0));
    }
}

#[test]
fn refined_solution_of_hilbert_matrix_equals_the_vector_it_was_made_from() {
    // Scaled by 360360 the entries and the right-hand side for x = (1, …, 1) are whole numbers.
    let n = 8;
    let a = hilbert(n).map(|x| (x * 360_360.0).round());
    let b: Vec<f64> = (0..n).map(|i| a.row(i).iter().sum()).collect();
    let factors = ldlt::Ldlt::new(&a).unwrap();
    let (mut x, mut scratch) = (b.clone(), vec![0.0; n]);
    factors.solve_in_place(&mut x).unwrap();
    let before = piola_testkit::relative_error(&x, &vec![1.0; n]);
    assert!(Tol::ulps(1e4).value() < before, "the system is ill-conditioned: {before:e}");
    let correction = factors.refine(a.as_slice(), &b, &mut x, &mut scratch).unwrap();
    assert_close("x", &x, &vec![1.0; n], Tol::ulps(1.0));
    assert!(correction < Tol::stated(1e-8, "where refinement is trusted").value());
    let estimate = factors.condition_estimate(a.as_slice()).unwrap();
    assert!(1e10 < estimate && estimate < 1e11, "κ₁ of this matrix is 3.4e10, estimated {estimate:e}");
}

#[test]
fn single_precision_systems_are_judged_in_single_precision() {
    let a = nalgebra::matrix![1.0_f32, 1.0; 1.0, 1.0 + f32::EPSILON];
    assert!(ldlt::solve(a, nalgebra::vector![1.0, 1.0]).is_err());
    assert!(lu::solve(a, nalgebra::vector![1.0, 1.0]).is_err());
    assert!(ldlt::solve(a.map(f64::from), nalgebra::vector![1.0, 1.0]).is_ok());
}

#[test]
fn empty_systems_have_empty_solutions() {
    let empty = DMatrix::<f64>::zeros(0, 0);
    let (ldlt, lu) = (ldlt::Ldlt::new(&empty).unwrap(), lu::Lu::new(&empty).unwrap());
    assert_eq!((ldlt.order(), lu.order()), (0, 0));
    assert_eq!(ldlt.solve(&dvector![]).unwrap().len() + lu.solve(&dvector![]).unwrap().len(), 0);
    assert_close("determinant", &[ldlt.determinant(), lu.determinant()], &[1.0, 1.0], Tol::ulps(0.0));
    let conditions = [ldlt.condition_estimate(&[]).unwrap(), lu.condition_estimate(&[]).unwrap()];
    assert_close("condition", &conditions, &[0.0, 0.0], Tol::ulps(0.0));
    assert_close("refined", &[ldlt.refine(&[], &[], &mut [], &mut []).unwrap()], &[0.0], Tol::ulps(0.0));
}

/// Rows x, 2y and x + 2y in the metric diag(1, 4).
#[test]
fn independent_rows_of_a_metric_are_chosen_and_met_with_the_least_change() {
    let mut rows = piola_numerics::internal::IndependentRows::default();
    rows.factor_metric(&[1.0, 0.0, 0.0, 4.0], 2).unwrap();
    rows.scale(&[1.0, 0.0, 0.0, 2.0, 1.0, 2.0], 3);
    assert_eq!(rows.sizes, [1.0, 1.0, 2.0_f64.sqrt()]);
    rows.choose(1e-7);
    assert_eq!((rows.rank, rows.taken()), (2, &[0, 1][..]));
    assert_close("shares", &[rows.share(0), rows.share(1)], &[1.0, 1.0], Tol::ulps(1.0));
    let mut change = [0.0; 2];
    rows.correct(&[3.0, -4.0, -1.0], &mut change);
    assert_close("change", &change, &[-3.0, 2.0], Tol::ulps(2.0));
    rows.combine();
    let expected = [1.0, 1.0, 0.0];
    assert_close("x + 2y", &rows.combination(2), &expected, Tol::ulps(4.0));
}
