//! Conversions to and from glam's types.

use glam::{DMat3, DVec3, Mat3, Vec3};
use piola_continuum::{ContinuumError, DeformationGradient, DisplacementGradient};

#[test]
fn glam_matrices_equal_gradients_entry_by_entry() {
    let rows = [[1.0, 0.5, 0.25], [0.125, 1.5, 0.0], [0.0, -0.5, 2.0]];
    let f = DeformationGradient::from_rows(rows).expect("0 < det F");
    let matrix = DMat3::from(f);
    assert_eq!(matrix.row(0), DVec3::from(rows[0]));
    assert_eq!(matrix.col(1), DVec3::new(0.5, 1.5, -0.5));
    assert_eq!(DeformationGradient::try_from(matrix), Ok(f));
    let h = DisplacementGradient::from_rows(rows).expect("0 < det F");
    assert_eq!(DisplacementGradient::try_from(DMat3::from(h)), Ok(h));
    let single =
        DeformationGradient::from_rows([[2.0_f32, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 0.0, 1.0]]).expect("0 < det F");
    assert_eq!(Mat3::from(single).row(1), Vec3::new(1.0, 1.0, 0.0));
    assert_eq!(DeformationGradient::try_from(Mat3::from(single)), Ok(single));
    let h = DisplacementGradient::<f32>::simple_shear(0.5).expect("finite");
    assert_eq!(DisplacementGradient::try_from(Mat3::from(h)), Ok(h));
}

#[test]
fn glam_matrices_are_checked() {
    let inverted = DeformationGradient::try_from(-DMat3::IDENTITY);
    assert_eq!(inverted, Err(ContinuumError::NonPositiveJacobian { determinant: -1.0 }));
    assert!(DisplacementGradient::<f32>::try_from(Mat3::from_diagonal(Vec3::splat(f32::NAN))).is_err());
}
