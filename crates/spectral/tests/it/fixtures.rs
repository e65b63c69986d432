//! Sums of modes with their exact forces, and samples of functions.

use std::f64::consts::PI;

use piola_spectral::{BoxGrid, LameParameters, Parity, Precision, Walls};

/// λ = 3/2, μ = 3/4.
pub(crate) fn lame() -> LameParameters {
    LameParameters::new(1.5, 0.75).expect("elliptic")
}

/// A product of sines and cosines in each component, with its amplitudes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wave<const D: usize> {
    pub(crate) indices: [usize; D],
    pub(crate) amplitude: [f64; D],
}

impl<const D: usize> Wave<D> {
    pub(crate) fn wave_vector(&self, sides: [f64; D]) -> [f64; D] {
        std::array::from_fn(|axis| PI * self.indices[axis] as f64 / sides[axis])
    }

    pub(crate) fn value(&self, walls: Walls, sides: [f64; D], x: [f64; D]) -> [f64; D] {
        let q = self.wave_vector(sides);
        std::array::from_fn(|component| {
            (0..D).fold(self.amplitude[component], |product, axis| {
                product
                    * match walls.parity(component, axis) {
                        Parity::Sine => (q[axis] * x[axis]).sin(),
                        Parity::Cosine => (q[axis] * x[axis]).cos(),
                    }
            })
        })
    }

    /// −Lu = μ q² u + (λ + μ) q (q·u), in amplitudes.
    pub(crate) fn elastic_force(&self, lame: LameParameters, sides: [f64; D]) -> Self {
        let q = self.wave_vector(sides);
        let squared: f64 = q.iter().map(|q| q * q).sum();
        let along: f64 = q.iter().zip(self.amplitude).map(|(q, a)| q * a).sum();
        let mu = lame.shear_modulus();
        let amplitude = std::array::from_fn(|c| mu * squared * self.amplitude[c] + (lame.first() + mu) * q[c] * along);
        Self { indices: self.indices, amplitude }
    }
}

/// Samples of the components of a function.
pub(crate) fn samples<T: Precision, const D: usize>(
    grid: &BoxGrid<D>,
    function: impl Fn([f64; D]) -> [f64; D],
) -> [Vec<T>; D] {
    let values: Vec<[f64; D]> = (0..grid.len()).map(|point| function(grid.position(grid.indices(point)))).collect();
    std::array::from_fn(|component| values.iter().map(|value| T::lit(value[component])).collect())
}

/// The sum of waves at a place.
pub(crate) fn sum_of<const D: usize>(waves: &[Wave<D>], walls: Walls, sides: [f64; D], x: [f64; D]) -> [f64; D] {
    waves.iter().fold([0.0; D], |sum, wave| {
        let value = wave.value(walls, sides, x);
        std::array::from_fn(|c| sum[c] + value[c])
    })
}

pub(crate) fn slices<T, const D: usize>(fields: &mut [Vec<T>; D]) -> [&mut [T]; D] {
    fields.each_mut().map(Vec::as_mut_slice)
}
