//! What goes wrong elsewhere: orders and factors of shears, overflow, tensors that are not what they claim.

use nalgebra::Matrix3;
use piola_tensor::Symmetric;
use piola_tensor::TensorError;
use piola_tensor::internal::positive_definite;
use piola_tensor::voigt::{BroNielsen, Piola, StrainVector};
use piola_tensor::{FourthOrder, MajorSymmetric, MinorSymmetric, PairSymmetric, Skew};
use piola_testkit::{Tol, assert_close};

use super::cases::nine;

#[test]
fn bro_nielsens_strain_vector_has_13_before_23() {
    // ∇u with u_z = 1, w_x = 2, v_z = 4, w_y = 8, B(4.73).
    let strain = Symmetric::symmetric_part([[0.0, 0.0, 1.0], [0.0, 0.0, 4.0], [2.0, 8.0, 0.0]]);
    let vector = StrainVector::<f64, BroNielsen>::of(&strain);
    assert_eq!(Ok(vector), StrainVector::new([0.0, 0.0, 0.0, 0.0, 3.0, 12.0]));
    assert_eq!(Ok(vector.reordered::<Piola>()), StrainVector::new([0.0, 0.0, 0.0, 0.0, 12.0, 3.0]));
    assert_eq!(vector.tensor(), strain);
}

#[test]
fn norms_and_inverses_neither_overflow_nor_underflow() {
    for scale in [1e-200, 1.0, 1e200] {
        let tensor = Symmetric::new(4.0, 5.0, 6.0, 1.0, 0.5, -1.0);
        let scaled = tensor * scale;
        assert_close("norm", &[scaled.norm() / scale], &[tensor.norm()], Tol::ulps(4.0));
        let inverse = scaled.inverse().expect("regular") * scale;
        assert_close("inverse", &nine(&inverse), &nine(&tensor.inverse().expect("regular")), Tol::ulps(16.0));
        let axial = Skew::new(1.0, -2.0, 2.0);
        assert_close("|W|", &[(axial * scale).norm() / scale], &[18.0_f64.sqrt()], Tol::ulps(4.0));
        let stiffness = MajorSymmetric::isotropic(1.0, 2.0);
        assert_close("|C|", &[(stiffness * scale).norm() / scale], &[stiffness.norm()], Tol::ulps(8.0));
        let compliance = (stiffness * scale).inverse().expect("regular") * scale;
        let expected = stiffness.inverse().expect("regular").components;
        assert_close("C⁻¹", &compliance.components, &expected, Tol::ulps(32.0));
    }
    assert_eq!(Symmetric::<f64>::zero().norm().to_bits(), 0.0_f64.to_bits());
}

#[test]
fn a_large_pressure_does_not_cost_the_deviator_digits() {
    let tensor = Symmetric::diagonal([1e9 + 2.0, 1e9 - 1.0, 1e9 - 1.0]);
    assert_eq!(tensor.deviator(), Symmetric::diagonal([2.0, -1.0, -1.0]));
}

#[test]
fn what_is_not_as_promised_is_refused_by_name() {
    let nan = Symmetric::new(1.0, f64::NAN, 0.0, 0.0, 0.0, 0.0);
    assert!(matches!(nan.inverse(), Err(TensorError::NotFinite { index: 1, .. })));
    let flat = Symmetric::diagonal([1.0, 2.0, 0.0]);
    assert!(matches!(flat.inverse(), Err(TensorError::SingularTensor { .. })));
    assert!(matches!(Symmetric::<f64>::zero().inverse(), Err(TensorError::SingularTensor { .. })));
    let c = MajorSymmetric::<f64>::spherical();
    assert!(matches!(c.inverse(), Err(TensorError::SingularTensor { .. })));
    assert!(matches!(c.minor().inverse(), Err(TensorError::SingularTensor { .. })));
    let shear = Matrix3::new(1.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
    assert!(matches!(c.rotated(&shear), Err(TensorError::NotARotation { .. })));
    assert!(matches!(Skew::from_matrix(&shear), Err(TensorError::NotSkew { row: 0, column: 0, .. })));
    let mut general = FourthOrder::<f64>::symmetrizer();
    general.components[5][0] += 1.0;
    let refused = general.minor_symmetric();
    assert!(matches!(refused, Err(TensorError::NotMinorSymmetric { .. })), "{refused:?}");
    let mut minor = MinorSymmetric::<f64>::identity();
    minor.components[4][2] = 1.0;
    let refused = minor.major_symmetric();
    assert!(matches!(refused, Err(TensorError::NotMajorSymmetric { entry: [2, 2, 1, 2], .. })), "{refused:?}");
    minor.components[0][0] = f64::INFINITY;
    assert!(matches!(MajorSymmetric::try_from(minor.components), Err(TensorError::NotFinite { index: 0, .. })));
}

#[test]
fn tensors_with_two_negative_eigenvalues_are_not_positive_definite() {
    // Eigenvalues 3, −1 and −1: the first minor, 1, and the determinant, 3, are positive, the second minor is −3.
    let a = Symmetric::new(1.0, 1.0, -1.0, 2.0, 0.0, 0.0);
    let expected = TensorError::NotPositiveDefinite { quantity: "C", order: 2, minor: -0.75, scale: 2.0 };
    assert_eq!(positive_definite("C", &a), Err(expected));
    assert_eq!(positive_definite("C", &a.square()), Ok(()));
}

#[test]
fn shear_stiffness_multiplies_the_engineering_shear_once() {
    // S₁₂ = 2 μ E₁₂ = μ γ₁₂: the entry of the tensor is μ, not 2 μ nor ½ μ.
    let stiffness = MajorSymmetric::isotropic(0.0, 5.0_f64);
    let strain = Symmetric::new(0.0, 0.0, 0.0, 0.5, 0.0, 0.0);
    assert_eq!(stiffness.contract(&strain).components[3].to_bits(), 5.0_f64.to_bits());
    assert_eq!(stiffness.entry(0, 1, 1, 0).to_bits(), 5.0_f64.to_bits());
}
