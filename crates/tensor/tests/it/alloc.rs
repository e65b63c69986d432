//! Decompositions, functions, inverses and Voigt's maps allocate nothing.

use piola_tensor::spectral::{Exponential, decompose, second_derivative, tensor_function};
use piola_tensor::voigt::{Abaqus, StiffnessMatrix};
use piola_tensor::{MajorSymmetric, PairSymmetric, Symmetric};
use piola_testkit::allocations_in;

#[test]
fn tensors_are_decomposed_and_inverted_without_allocating() {
    let (allocations, finite) = allocations_in(|| {
        let a = Symmetric::new(1.0, 2.0, 3.0, 0.5, 0.25, 0.125);
        let second = second_derivative(&Exponential, &a, &a, &a).trace();
        let stiffness = MajorSymmetric::isotropic(1.0, 3.0);
        let compliance = StiffnessMatrix::<f64, Abaqus>::of(&stiffness).compliance().expect("regular");
        let strain = stiffness.inverse().expect("regular").contract(&a).trace() + compliance.entries[0][0];
        let singular = MajorSymmetric::<f64>::spherical().inverse().is_err();
        let values = decompose(&a).values[0] + tensor_function(&Exponential, &a).trace() + second + strain;
        singular && values.is_finite()
    });
    assert_eq!((allocations, finite), (0, true));
}
