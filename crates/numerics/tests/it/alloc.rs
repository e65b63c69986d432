//! Evaluations and solutions allocate nothing once their memory is there.

use piola_numerics::derivatives::{self, Workspace};
use piola_numerics::linear::{ldlt, lu, matrix3};
use piola_numerics::quadrature::{self, GaussKronrod, Panel, Quadpack};
use piola_numerics::sums::{compensated_add, compensated_dot, compensated_sum};
use piola_testkit::allocations_in;

use crate::formulas::{Coupled, CoupledGradient};

#[test]
fn derivatives_into_memory_of_the_caller_allocate_nothing() {
    const N: usize = 9;
    let x: [f64; N] = core::array::from_fn(|i| 0.1 * i as f64);
    let v: [f64; N] = core::array::from_fn(|i| 1.0 - 0.2 * i as f64);
    let mut workspace = Workspace::<f64>::with_values(N, N);
    let (mut vector, mut value, mut matrix) = ([0.0; N], [0.0; N], [0.0; N * N]);
    let (count, result) = allocations_in(|| {
        derivatives::gradient_into(&mut workspace, &Coupled, &x, &mut vector)?;
        derivatives::hessian_vector_product_into(&mut workspace, &Coupled, &x, &v, &mut vector)?;
        derivatives::hessian_into(&mut workspace, &Coupled, &x, &mut vector, &mut matrix)?;
        derivatives::directional(&mut workspace, &Coupled, &x, &v)?;
        derivatives::mixed(&mut workspace, &Coupled, &x, &v, &v)?;
        derivatives::jacobian_into(&mut workspace, &CoupledGradient, &x, &mut value, &mut matrix)?;
        derivatives::jacobian_vector_product_into(&mut workspace, &CoupledGradient, &x, &v, &mut value, &mut vector)
    });
    assert_eq!((count, result), (0, Ok(())));
}

#[test]
fn linear_systems_allocate_nothing() {
    let a = nalgebra::dmatrix![4.0, 1.0, 0.5; 1.0, 3.0, 0.25; 0.5, 0.25, 2.0];
    let fixed = nalgebra::Matrix3::from_column_slice(a.as_slice());
    let (mut ldlt, mut lu) = (ldlt::Ldlt::new(&a).unwrap(), lu::Lu::new(&a).unwrap());
    let b = [1.0, 2.0, 3.0];
    let (mut x, mut scratch) = (b, [0.0; 3]);
    let (count, result) = allocations_in(|| {
        ldlt.factor(a.as_slice())?;
        ldlt.solve_in_place(&mut x)?;
        ldlt.refine(a.as_slice(), &b, &mut x, &mut scratch)?;
        lu.factor(a.as_slice())?;
        lu.solve_in_place(&mut x)?;
        ldlt::solve(fixed, b.into())?;
        lu::solve(fixed, b.into())?;
        matrix3::inverse(&fixed)?;
        matrix3::solve(&fixed, &b.into())
    });
    assert!(result.is_ok());
    assert_eq!(count, 0);
}

#[test]
fn compensated_sums_allocate_nothing() {
    let (mut y, mut carry) = ([1.0; 4], [0.0; 4]);
    let (count, _) = allocations_in(|| {
        compensated_add(&mut y, &mut carry, &[1e-17; 4])?;
        compensated_dot(&y, &carry).map(|dot| dot + compensated_sum(&y))
    });
    assert_eq!(count, 0);
}

#[test]
fn adaptive_integration_on_the_stack_allocates_nothing() {
    let allowed = |values: &[f64; 1], _: &[f64; 1]| [1e-12 * values[0]];
    let (count, found) = allocations_in(|| {
        let method = (&GaussKronrod::POINTS_21, &Quadpack);
        quadrature::integrate(&mut [Panel::EMPTY; 96], [(0.0, 1.0)], method, &allowed, |_, x: f64| {
            Ok::<_, core::convert::Infallible>([x.sqrt()])
        })
    });
    assert!(found.is_ok_and(|found| 5 < found.panels));
    assert_eq!(count, 0);
}
