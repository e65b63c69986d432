//! Images with texture and known deformations.

use std::f64::consts::PI;

use piola_registration::{Image, ImageGrid, Precision, RegistrationError};

/// Sums of waves that leave no place flat.
pub(crate) fn texture<const D: usize>(place: [f64; D]) -> f64 {
    let waves = (1..=4).map(f64::from).map(|k| {
        let along = |axis: usize| {
            let beside = place[(axis + 1) % D];
            ((2.0 * k + 1.0) * PI * place[axis] + 1.3 * k * (axis as f64 + 1.0) + 0.7 * beside * k * PI).sin()
        };
        (0..D).map(along).product::<f64>()
    });
    waves.sum()
}

/// A displacement of `amplitude` in the unit box that leaves its walls in place.
pub(crate) fn displacement<const D: usize>(amplitude: f64, place: [f64; D]) -> [f64; D] {
    std::array::from_fn(|axis| {
        let beside = place[(axis + 1) % D];
        amplitude * (PI * place[axis]).sin() * (2.0 * PI * beside + 0.4 * axis as f64).cos()
    })
}

/// The unit box with n samples along each side.
pub(crate) fn unit_box<const D: usize>(n: usize) -> Result<ImageGrid<D>, RegistrationError> {
    ImageGrid::new([n; D], [1.0 / n as f64; D])
}

/// The fixed and the moving image: fixed(x) = moving(x − u(x)) by formula, not by interpolation.
pub(crate) fn phantom<const D: usize, T: Precision>(
    grid: ImageGrid<D>,
    amplitude: f64,
) -> Result<[Image<D, T>; 2], RegistrationError> {
    let deformed = |place: [f64; D]| {
        let u = displacement(amplitude, place);
        texture::<D>(std::array::from_fn(|axis| place[axis] - u[axis]))
    };
    Ok([Image::from_fn(grid, |place| T::lit(deformed(place)))?, Image::from_fn(grid, |place| T::lit(texture(place)))?])
}

/// A disc and the letter C in the unit square, with edges some two samples wide.
pub(crate) fn disc_and_letter(n: usize) -> Result<[Image<2, f64>; 2], RegistrationError> {
    let grid = unit_box(n)?;
    let width = 0.5 / n as f64;
    let soft = |inside: f64| 1.0 / (1.0 + (-inside / width).exp());
    let disc = Image::from_fn(grid, |[y, x]| soft(0.25 - (x - 0.5).hypot(y - 0.5)))?;
    let letter = Image::from_fn(grid, |[y, x]| {
        let (x, y) = (x - 0.5, y - 0.5);
        let ring = 0.09 - (x.hypot(y) - 0.24).abs();
        let mouth = x.min(0.08 - y.abs());
        soft(ring.min(-mouth))
    })?;
    Ok([disc, letter])
}
