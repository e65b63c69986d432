//! Conversions to and from glam.

use glam::{DMat3, DVec3, Mat3, Vec3};
use nalgebra::{Matrix3, Vector3};
use piola_continuum::{CauchyStress, ContinuumError, FirstPiola, ReferenceNormal, UnitNormal};
use piola_numerics::Real;
use piola_tensor::TensorError;

#[test]
fn stresses_and_normals_of_glam_equal_those_of_nalgebra() {
    let entries = Matrix3::new(1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0);
    let stress = FirstPiola::new(entries).expect("finite");
    let matrix = DMat3::from(stress);
    assert_eq!(matrix.row(0), DVec3::new(1.0, 2.0, 3.0));
    assert_eq!(FirstPiola::try_from(matrix), Ok(stress));
    let single = FirstPiola::new(entries.map(f32::lit)).expect("finite");
    assert_eq!(FirstPiola::try_from(Mat3::from(single)), Ok(single));
    assert!(matches!(CauchyStress::try_from(matrix), Err(ContinuumError::Tensor(TensorError::NotSymmetric { .. }))));
    let stress: CauchyStress<f32> = CauchyStress::new(1.0, 2.0, 3.0, 4.0, 5.0, 6.0).expect("finite");
    assert_eq!(CauchyStress::try_from(Mat3::from(stress)), Ok(stress));
    let normal = UnitNormal::new(Vector3::new(0.0, 3.0, 4.0)).expect("a direction");
    assert_eq!(DVec3::from(normal), DVec3::new(0.0, 0.6, 0.8));
    assert_eq!(UnitNormal::try_from(DVec3::new(0.0, 3.0, 4.0)), Ok(normal));
    assert_eq!(ReferenceNormal::try_from(Vec3::ZERO), Err(ContinuumError::ZeroNormal));
}
