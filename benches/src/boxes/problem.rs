//! Samples of the smooth displacement of a cube, and of its force.

use piola_spectral::{LameParameters, SpectralError};
use piola_testkit::smooth_cube;

/// λ = 3/2, μ = 3/4.
///
/// # Errors
/// Never: these are elliptic.
pub fn lame() -> Result<LameParameters, SpectralError> {
    LameParameters::new(1.5, 0.75)
}

/// The force at all points of a grid of n × n × n; component c begins at `offset(c)`, in spacings.
#[must_use]
pub fn forces(lame: LameParameters, n: usize, offset: impl Fn(usize) -> [f64; 3]) -> [Vec<f64>; 3] {
    let lame = [lame.first(), lame.shear_modulus()];
    [0, 1, 2].map(|c| samples(n, offset(c), |x| smooth_cube::force(lame, x)[c]))
}

/// The displacement there.
#[must_use]
pub fn displacements(n: usize, offset: impl Fn(usize) -> [f64; 3]) -> [Vec<f64>; 3] {
    [0, 1, 2].map(|c| samples(n, offset(c), |x| smooth_cube::displacement(x)[c]))
}

/// The offset of samples at the centres of cells.
#[must_use]
pub fn centres(_component: usize) -> [f64; 3] {
    [0.5; 3]
}

/// Values of a component at all points of a grid of n × n × n, the last index running fastest; `offset` is the place of the
/// first point on each axis, in spacings.
fn samples(n: usize, offset: [f64; 3], value: impl Fn([f64; 3]) -> f64) -> Vec<f64> {
    let h = 1.0 / n as f64;
    let mut values = Vec::with_capacity(n * n * n);
    for i in 0..n {
        for j in 0..n {
            values.extend(
                (0..n).map(|k| {
                    value([(i as f64 + offset[0]) * h, (j as f64 + offset[1]) * h, (k as f64 + offset[2]) * h])
                }),
            );
        }
    }
    values
}

/// ‖a − b‖/‖b‖ over all components and samples.
#[must_use]
pub fn root_mean_square_error(a: &[f64], b: &[f64]) -> f64 {
    let sum = |value: &dyn Fn(f64, f64) -> f64| -> f64 { a.iter().zip(b).map(|(a, b)| value(*a, *b).powi(2)).sum() };
    (sum(&|a, b| a - b) / sum(&|_, b| b)).sqrt()
}
