//! Rates to and from glam.

use piola_continuum::ContinuumError;
use piola_continuum::rates::{GradientRate, Spin, VelocityGradient};

#[test]
fn rates_from_glam_equal_rates_by_rows() {
    let rows = [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, 9.0]];
    let matrix = glam::DMat3::from_cols_array_2d(&rows).transpose();
    let l = VelocityGradient::try_from(matrix).expect("finite");
    assert_eq!(l.rows(), rows);
    assert_eq!(glam::DMat3::from(l), matrix);
    let single = GradientRate::<f32>::try_from(glam::Mat3::IDENTITY).expect("finite");
    assert_eq!(glam::Mat3::from(single), glam::Mat3::IDENTITY);
    let spin = Spin::try_from([1.0, 2.0, 3.0]).expect("finite");
    assert_eq!(glam::DVec3::from(spin), glam::DVec3::new(1.0, 2.0, 3.0));
    let bad = VelocityGradient::try_from(glam::DMat3::NAN);
    assert!(matches!(bad, Err(ContinuumError::NotFinite { .. })));
}
