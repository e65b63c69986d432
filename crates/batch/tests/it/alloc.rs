//! Batches allocate nothing as long as all points are good.

use nalgebra::Matrix3;
use piola_batch as batch;
use piola_batch::Gradients;
use piola_continuum::{FirstPiola, Symmetric};
use piola_testkit::allocations_in;

use super::cases::{deformations, stresses};

#[test]
fn batches_are_evaluated_without_allocating() {
    let (f, t) = (deformations(1003), stresses(1003));
    let matrices: Vec<Matrix3<f64>> = f.iter().map(|f| *f.matrix()).collect();
    let (mut r, mut u) = (vec![Matrix3::zeros(); 1003], vec![Symmetric::zero(); 1003]);
    let mut p = vec![FirstPiola::zero(); 1003];
    // The level of the machine is found out once.
    let _ = piola_numerics::Level::best();
    let (allocations, points) = allocations_in(|| {
        let requests = (
            batch::rotation(&mut r[..]),
            batch::right_stretch(&mut u[..]),
            batch::cauchy_to_first_piola(&t[..], &mut p[..]),
        );
        batch::evaluate(Gradients(&matrices[..]), requests).expect("deformations").points
    });
    assert_eq!((allocations, points), (0, 1003));
}
