//! Values and gradients of an image between its samples.

use piola_numerics::Real;

use crate::grid::ImageGrid;
use crate::image::Image;

/// How values between samples follow from the samples.
///
/// Both interpolate: at a sample they return its value. Outside the box of the outermost samples, both return the value at the nearest point
/// of that box, so the derivative across its wall is zero there.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Interpolant {
    /// Multilinear in each cell: continuous; the gradient jumps from cell to cell.
    #[default]
    Linear,
    /// The cubic B-spline through the samples, mirrored at the outermost ones: twice continuously differentiable. It takes four times (2-D)
    /// to eight times (3-D) as many products as the linear one, and exceeds the range of the samples near steps.
    CubicSpline,
}

/// An image with an interpolant: values and exact gradients anywhere.
///
/// # Example
/// ```
/// use piola_registration::{Image, ImageGrid, ImageSampler, Interpolant};
/// let ramp = Image::from_fn(ImageGrid::new([8, 8], [0.5, 0.5])?, |[y, x]| 3.0 * x + y)?;
/// let (value, gradient) = ImageSampler::new(&ramp, Interpolant::Linear).with_gradient([1.1, 2.3]);
/// assert!((value - 8.0_f64).abs() < 1e-14 && (gradient[0] - 1.0).abs() < 1e-14 && (gradient[1] - 3.0).abs() < 1e-14);
/// # Ok::<(), piola_registration::RegistrationError>(())
/// ```
#[derive(Debug, Clone)]
pub struct ImageSampler<const D: usize, T> {
    grid: ImageGrid<D>,
    interpolant: Interpolant,
    /// The samples, or the coefficients of the B-spline.
    coefficients: Vec<T>,
}

/// One axis at a point: the first sample of its cell, the share of the way to the next one, and whether the point lies inside.
struct Position<T> {
    cell: usize,
    share: T,
    is_inside: bool,
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn position<T: Real>(place: T, spacing: f64, size: usize) -> Position<T> {
    let index = place * T::lit(1.0 / spacing) - T::lit(0.5);
    let last = (size - 1) as f64;
    let at = index.primal(0);
    if at < 0.0 {
        return Position { cell: 0, share: T::zero(), is_inside: false };
    }
    if last < at {
        return Position { cell: size - 2, share: T::one(), is_inside: false };
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between zero and the size")]
    let cell = (at as usize).min(size - 2);
    Position { cell, share: index - T::lit(cell as f64), is_inside: true }
}

impl<const D: usize, T: Real> ImageSampler<D, T> {
    /// Prepares `image` for evaluation.
    #[must_use]
    pub fn new(image: &Image<D, T>, interpolant: Interpolant) -> Self {
        let grid = *image.grid();
        let mut coefficients = image.values().to_vec();
        if interpolant == Interpolant::CubicSpline {
            for axis in 0..D {
                filter_axis(&grid, axis, &mut coefficients);
            }
        }
        Self { grid, interpolant, coefficients }
    }

    /// The value at `place`, m.
    #[must_use]
    #[inline]
    pub fn value(&self, place: [T; D]) -> T {
        self.with_gradient(place).0
    }

    /// The value at `place` and its gradient, per m: the exact derivative of the interpolant.
    ///
    /// Where the linear interpolant has no derivative, on the walls of cells, the gradient is that of the cell with the greater index.
    #[must_use]
    #[inline]
    pub fn with_gradient(&self, place: [T; D]) -> (T, [T; D]) {
        match self.interpolant {
            Interpolant::Linear => self.linear(place),
            Interpolant::CubicSpline => self.cubic(place),
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn linear(&self, place: [T; D]) -> (T, [T; D]) {
        let (sizes, spacing, strides) = (self.grid.sizes(), self.grid.spacing(), self.grid.strides());
        let mut weights = [[T::zero(); 2]; D];
        let mut slopes = [T::zero(); D];
        let mut base = 0;
        for axis in 0..D {
            let Position { cell, share, is_inside } = position(place[axis], spacing[axis], sizes[axis]);
            base += cell * strides[axis];
            weights[axis] = [T::one() - share, share];
            slopes[axis] = if is_inside { T::lit(1.0 / spacing[axis]) } else { T::zero() };
        }
        let mut value = T::zero();
        let mut gradient = [T::zero(); D];
        for corner in 0..1 << D {
            let mut offset = base;
            for (axis, stride) in strides.iter().enumerate() {
                offset += (corner >> axis & 1) * stride;
            }
            let sample = self.coefficients[offset];
            let mut weight = T::one();
            for (axis, pair) in weights.iter().enumerate() {
                weight *= pair[corner >> axis & 1];
            }
            value += weight * sample;
            for (axis, slope) in gradient.iter_mut().enumerate() {
                let mut weight = if corner >> axis & 1 == 1 { sample } else { -sample };
                for (other, pair) in weights.iter().enumerate() {
                    if other != axis {
                        weight *= pair[corner >> other & 1];
                    }
                }
                *slope += weight;
            }
        }
        for axis in 0..D {
            gradient[axis] *= slopes[axis];
        }
        (value, gradient)
    }

    #[inline(never)]
    fn cubic(&self, place: [T; D]) -> (T, [T; D]) {
        let (sizes, spacing, strides) = (self.grid.sizes(), self.grid.spacing(), self.grid.strides());
        let mut weights = [[T::zero(); 4]; D];
        let mut slopes = [[T::zero(); 4]; D];
        let mut offsets = [[0; 4]; D];
        for axis in 0..D {
            let Position { cell, share, is_inside } = position(place[axis], spacing[axis], sizes[axis]);
            weights[axis] = cubic_weights(share);
            if is_inside {
                slopes[axis] = cubic_slopes(share).map(|slope| slope * T::lit(1.0 / spacing[axis]));
            }
            let last = sizes[axis] - 1;
            let before = if cell == 0 { 1 } else { cell - 1 };
            let after = if last < cell + 2 { last - 1 } else { cell + 2 };
            offsets[axis] = [before, cell, cell + 1, after].map(|index| index * strides[axis]);
        }
        let mut value = T::zero();
        let mut gradient = [T::zero(); D];
        for corner in 0..1 << (2 * D) {
            let mut offset = 0;
            let mut weight = T::one();
            for axis in 0..D {
                let digit = corner >> (2 * axis) & 3;
                offset += offsets[axis][digit];
                weight *= weights[axis][digit];
            }
            let sample = self.coefficients[offset];
            value += weight * sample;
            for (axis, slope) in gradient.iter_mut().enumerate() {
                let mut weight = sample;
                for other in 0..D {
                    let digit = corner >> (2 * other) & 3;
                    weight *= if other == axis { slopes[other][digit] } else { weights[other][digit] };
                }
                *slope += weight;
            }
        }
        (value, gradient)
    }
}

/// The four cubic B-splines that do not vanish at the share `t` of a cell.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn cubic_weights<T: Real>(t: T) -> [T; 4] {
    let sixth = T::lit(1.0 / 6.0);
    let s = T::one() - t;
    [
        sixth * s * s * s,
        T::lit(2.0 / 3.0) - t * t * (T::one() - T::lit(0.5) * t),
        T::lit(2.0 / 3.0) - s * s * (T::one() - T::lit(0.5) * s),
        sixth * t * t * t,
    ]
}

/// Their derivatives.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn cubic_slopes<T: Real>(t: T) -> [T; 4] {
    let half = T::lit(0.5);
    let s = T::one() - t;
    [-half * s * s, t * (T::lit(1.5) * t - T::lit(2.0)), -s * (T::lit(1.5) * s - T::lit(2.0)), half * t * t]
}

/// Turns samples into coefficients of the B-spline through them, along one axis: the recursive filter with the pole √3 − 2.
fn filter_axis<const D: usize, T: Real>(grid: &ImageGrid<D>, axis: usize, values: &mut [T]) {
    let (size, stride) = (grid.sizes()[axis], grid.strides()[axis]);
    let pole = 3.0_f64.sqrt() - 2.0;
    let period = 2 * (size - 1);
    for first in (0..values.len()).filter(|&position| grid.index(position)[axis] == 0) {
        let at = |index: usize| first + index * stride;
        // The sum over the mirrored samples; powers below the rounding are left out.
        let (mut power, mut start) = (1.0, T::zero());
        for step in 0..period {
            start += T::lit(power) * values[at(if step < size { step } else { period - step })];
            power *= pole;
            if power.abs() < 1e-18 {
                break;
            }
        }
        let repeated = if 1e-18 <= power.abs() { 1.0 - power } else { 1.0 };
        values[at(0)] = start * T::lit(6.0 / repeated);
        for index in 1..size {
            values[at(index)] = values[at(index)] * T::lit(6.0) + T::lit(pole) * values[at(index - 1)];
        }
        let (last, before) = (values[at(size - 1)], values[at(size - 2)]);
        values[at(size - 1)] = T::lit(pole / (pole * pole - 1.0)) * (last + T::lit(pole) * before);
        for index in (0..size - 1).rev() {
            values[at(index)] = T::lit(pole) * (values[at(index + 1)] - values[at(index)]);
        }
    }
}
