//! Least squares: against normal equations, for rows and columns of any size, and what is refused.

use nalgebra::{DMatrix, DVector};
use piola_numerics::linear::ldlt;
use piola_numerics::linear::least_squares::LeastSquares;
use piola_numerics::{Dual, Lanes, NumericsError, Real};
use piola_testkit::strategies::vector;
use piola_testkit::{Tol, allocations_in, assert_close};
use proptest::prelude::*;

fn solved<T: Real>(a: &DMatrix<T>, b: &[T], h: &[T]) -> Result<Vec<T>, NumericsError> {
    let mut problem = LeastSquares::new();
    problem.begin(a.ncols());
    for (row, &right) in a.row_iter().zip(b) {
        problem.add_row(row.iter().copied(), right)?;
    }
    let mut x = h.to_vec();
    problem.solve_in_place(&mut x, 0.0)?;
    Ok(x)
}

fn condition(a: &DMatrix<f64>) -> f64 {
    let values = a.singular_values();
    values.max() / values.min()
}

/// Rows 1, t, t², …: condition numbers that grow by a factor of six or so with each column.
fn powers(rows: usize, columns: usize) -> DMatrix<f64> {
    DMatrix::from_fn(rows, columns, |i, j| ((i + 1) as f64 / rows as f64).powi(i32::try_from(j).unwrap()))
}

proptest! {
    #[test]
    fn least_squares_solution_equals_that_of_normal_equations(
        entries in vector(45, -1.0..1.0),
        b in vector(9, -1.0..1.0),
        h in vector(5, -1.0..1.0),
    ) {
        let a = DMatrix::from_column_slice(9, 5, &entries);
        let normal = a.transpose() * &a;
        prop_assume!(condition(&normal) < 1e6);
        let right = a.transpose() * DVector::from_column_slice(&b) + DVector::from_column_slice(&h);
        let expected = ldlt::Ldlt::new(&normal).unwrap().solve(&right).unwrap();
        let found = solved(&a, &b, &h).unwrap();
        assert_close("x", &found, expected.as_slice(), Tol::ulps(64.0).times(condition(&normal)));
    }

    #[test]
    fn weighted_rows_keep_their_digits(entries in vector(20, -1.0..1.0), x in vector(4, -1.0..1.0)) {
        // Rows of sizes from 1e-6 to 1e6 that agree on x: none of the small ones is drowned.
        let a = DMatrix::from_column_slice(5, 4, &entries);
        prop_assume!(condition(&a.rows(0, 4).into_owned()) < 1e4);
        let weights = [1e-6, 1e6, 1e-3, 1.0, 1e3];
        let weighted = DMatrix::from_fn(5, 4, |i, j| weights[i] * a[(i, j)]);
        let b = &weighted * DVector::from_column_slice(&x);
        let found = solved(&weighted, b.as_slice(), &[0.0; 4]).unwrap();
        // Row by row the condition is that of the four rows, in whatever order they are eliminated.
        assert_close("x", &found, &x, Tol::ulps(64.0).times(1e5));
    }
}

#[test]
fn rows_lose_the_root_of_what_normal_equations_lose() {
    for columns in [4, 6, 8, 10] {
        let a = powers(12, columns);
        let x: Vec<f64> = (0..columns).map(|j| 1.0 - 2.0 * (j % 2) as f64).collect();
        // Exact right-hand sides are rounded once: their error is one ulp of the rows.
        let b = &a * DVector::from_column_slice(&x);
        let found = solved(&a, b.as_slice(), &vec![0.0; columns]).unwrap();
        assert_close("x", &found, &x, Tol::ulps(8.0).times(condition(&a)));
    }
}

#[test]
fn units_of_columns_do_not_matter() {
    let a = powers(6, 3);
    let b = [1.0, -1.0, 2.0, 0.5, 0.25, 3.0];
    let units = [2.0_f64.powi(-300), 1.0, 2.0_f64.powi(400)];
    let scaled = DMatrix::from_fn(6, 3, |i, j| a[(i, j)] * units[j]);
    let plain = solved(&a, &b, &[1.0, 2.0, 3.0]).unwrap();
    let found = solved(&scaled, &b, &[units[0], 2.0 * units[1], 3.0 * units[2]]).unwrap();
    for j in 0..3 {
        assert_eq!((found[j] * units[j]).to_bits(), plain[j].to_bits());
    }
}

#[test]
fn derivatives_and_lanes_of_solutions_equal_those_of_their_parts() {
    let a = powers(6, 3);
    let (b, rates) = ([1.0, -1.0, 2.0, 0.5, 0.25, 3.0], [0.5, 1.0, 0.0, -1.0, 0.0, 0.25]);
    let plain = solved(&a, &b, &[0.0; 3]).unwrap();
    let moving: Vec<Dual<f64>> = b.iter().zip(rates).map(|(&b, rate)| Dual::new(b, rate)).collect();
    let found = solved(&a.map(Dual::constant), &moving, &[Dual::constant(0.0); 3]).unwrap();
    // The solution is linear in b.
    let expected = solved(&a, &rates, &[0.0; 3]).unwrap();
    let tolerance = Tol::ulps(16.0).times(condition(&a));
    for j in 0..3 {
        assert_eq!(found[j].value.to_bits(), plain[j].to_bits());
    }
    let tangents: Vec<f64> = found.iter().map(|x| x.tangent).collect();
    assert_close("ẋ", &tangents, &expected, tolerance);
    let both: Vec<Lanes<f64, 2>> = b.iter().zip(rates).map(|(&b, rate)| Lanes([b, rate])).collect();
    let found = solved(&a.map(Lanes::lit), &both, &[Lanes::lit(0.0); 3]).unwrap();
    for (lane, expected) in [plain, expected].iter().enumerate() {
        let found: Vec<f64> = found.iter().map(|x| x.primal(lane)).collect();
        assert_close("lane", &found, expected, tolerance);
    }
}

#[test]
fn dependent_columns_are_refused_with_their_direction() {
    // Column 2 is twice column 0 minus column 1, in units of its own.
    let a = DMatrix::from_fn(5, 3, |i, j| {
        let t = (i + 1) as f64;
        [1.0, t, 1024.0 * (2.0 - t)][j]
    });
    let mut problem = LeastSquares::new();
    problem.begin(3);
    for row in a.row_iter() {
        problem.add_row(row.iter().copied(), 1.0).unwrap();
    }
    let error = problem.solve_in_place(&mut [0.0; 3], 0.0).unwrap_err();
    let NumericsError::Singular { pivot, value, scale } = error else { panic!("{error}") };
    assert!(value < Tol::ulps(64.0).value() * scale);
    let mut z = [0.0; 3];
    problem.null_direction_into(pivot, &mut z).unwrap();
    assert!((z[pivot] - 1.0).abs() < f64::EPSILON);
    let z = z.map(|x| x / z[2]);
    assert_close("z", &z, &[-2048.0, 1024.0, 1.0], Tol::ulps(64.0));
}

#[test]
fn too_few_rows_and_numbers_that_are_none_are_refused() {
    let one = solved(&DMatrix::from_element(1, 2, 1.0), &[1.0], &[0.0; 2]);
    assert!(matches!(one, Err(NumericsError::Singular { .. })), "{one:?}");
    let none = solved(&DMatrix::from_element(2, 1, f64::NAN), &[1.0; 2], &[0.0]);
    assert!(matches!(none, Err(NumericsError::Singular { pivot: 0, .. })), "{none:?}");
    let zero = solved(&DMatrix::from_element(2, 1, 0.0), &[1.0; 2], &[0.0]);
    assert!(matches!(zero, Err(NumericsError::Singular { pivot: 0, .. })), "{zero:?}");
    let mut problem = LeastSquares::new();
    problem.begin(2);
    assert!(matches!(problem.add_row([1.0], 0.0), Err(NumericsError::WrongLength { quantity: "row", .. })));
    assert!(matches!(problem.solve_in_place(&mut [0.0], 0.0), Err(NumericsError::WrongLength { .. })));
    assert_eq!(solved::<f64>(&DMatrix::zeros(0, 0), &[], &[]), Ok(Vec::new()));
}

#[test]
fn solving_again_allocates_nothing() {
    let a = powers(6, 3);
    let mut problem = LeastSquares::new();
    let mut solve = || {
        problem.begin(3);
        for row in a.row_iter() {
            problem.add_row(row.iter().copied(), 1.0).unwrap();
        }
        problem.solve_in_place(&mut [0.0; 3], 0.0).unwrap();
    };
    solve();
    assert_eq!(allocations_in(solve).0, 0);
}
