//! Decompositions and functions of tensors allocate nothing.

use piola_continuum::Symmetric;
use piola_continuum::polar::{StretchAnalysis, polar_hencky};
use piola_tensor::spectral::{Exponential, decompose, second_derivative, tensor_function};
use piola_testkit::allocations_in;

use super::cases::gradient;

#[test]
fn tensors_are_decomposed_without_allocating() {
    let ordinary = gradient([[1.0, 0.2, 0.0], [0.1, 1.1, 0.0], [0.0, 0.3, 0.9]]);
    let slow = gradient([[1e5, 0.2, 3.0], [0.1, 1.1, 0.0], [0.0, 0.3, 0.9]]);
    let (allocations, finite) = allocations_in(|| {
        let a = Symmetric::new(1.0, 2.0, 3.0, 0.5, 0.25, 0.125);
        let sums = [ordinary, slow].map(|f| {
            let stretch = StretchAnalysis::of(&f);
            let rest = stretch.rotation()[0][0] + stretch.hencky_spatial().trace() + stretch.right_stretch().trace();
            rest + polar_hencky(&f).hencky.trace()
        });
        let second = second_derivative(&Exponential, &a, &a, &a).trace();
        (sums[0] + sums[1] + second + tensor_function(&Exponential, &a).trace() + decompose(&a).values[0]).is_finite()
    });
    assert_eq!((allocations, finite), (0, true));
}
