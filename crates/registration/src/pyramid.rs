//! Coarser images of the same box.

use piola_numerics::Real;

use crate::image::Image;
use crate::sampler::{ImageSampler, Interpolant};

/// The standard deviation of the Gaussian, in samples of the finer image. At the coarser image's highest frequency it leaves e^(−π²/8) = 0.29.
const DEVIATION: f64 = 1.0;

/// Samples on either side of the Gaussian; what lies beyond is below 10⁻⁵.
const RADIUS: usize = 4;

/// The image on the grid of half as many samples along each axis: smoothed by a Gaussian against aliasing, then interpolated.
pub(crate) fn halved<const D: usize, T: Real>(image: &Image<D, T>) -> Image<D, T> {
    let grid = *image.grid();
    let mut values = image.values().to_vec();
    for axis in 0..D {
        smooth(&grid.sizes(), grid.strides()[axis], axis, &mut values);
    }
    let sampler = ImageSampler::new(&Image::computed(grid, values), Interpolant::Linear);
    let coarser = grid.halved();
    let values = (0..coarser.len()).map(|position| sampler.value(coarser.place(position).map(T::lit))).collect();
    Image::computed(coarser, values)
}

/// Smooths along one axis; reflected beyond the walls.
fn smooth<T: Real>(sizes: &[usize], stride: usize, axis: usize, values: &mut [T]) {
    let weights: [f64; 2 * RADIUS + 1] =
        std::array::from_fn(|at| (-0.5 * ((at as f64 - RADIUS as f64) / DEVIATION).powi(2)).exp());
    let total: f64 = weights.iter().sum();
    let weights = weights.map(|weight| T::lit(weight / total));
    let size = sizes[axis];
    let mut line = vec![T::zero(); size];
    for block in values.chunks_mut(size * stride) {
        for first in 0..stride {
            for (index, value) in line.iter_mut().enumerate() {
                *value = block[first + index * stride];
            }
            for index in 0..size {
                let mut sum = T::zero();
                for (at, weight) in weights.iter().enumerate() {
                    sum += *weight * line[mirrored(index + at, size)];
                }
                block[first + index * stride] = sum;
            }
        }
    }
}

/// The sample at `shifted` − RADIUS, reflected at the walls as often as necessary.
fn mirrored(shifted: usize, size: usize) -> usize {
    let period = 2 * size;
    let index = (shifted + period * RADIUS - RADIUS) % period;
    if index < size { index } else { period - 1 - index }
}

#[cfg(test)]
mod tests {
    use super::mirrored;

    #[test]
    fn indices_are_reflected_at_the_walls() {
        let found: Vec<_> = (0..11).map(|shifted| mirrored(shifted, 3)).collect();
        assert_eq!(found, [2, 2, 1, 0, 0, 1, 2, 2, 1, 0, 0]); // of −4 … 6
    }
}
