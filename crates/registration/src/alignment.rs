//! Two images of one level, compared under maps.

use piola_numerics::Real;

use crate::error::RegistrationError;
use crate::field::target;
use crate::grid::{ImageGrid, advance};
use crate::image::Image;
use crate::jacobian::slopes_at;
use crate::map::DisplacementMap;
use crate::measure::{Comparison, Side, SimilarityMeasure};
use crate::parallel::each;
use crate::sampler::{ImageSampler, Interpolant};

/// An image under a map: its samples and the gradient of its interpolant there.
struct Warped<const D: usize, T> {
    sampler: ImageSampler<D, T>,
    values: Vec<T>,
    gradients: Vec<[T; D]>,
}

impl<const D: usize, T: Real> Warped<D, T> {
    fn new(image: &Image<D, T>, interpolant: Interpolant) -> Self {
        let values = image.values().to_vec();
        let gradients = vec![[T::zero(); D]; values.len()];
        Self { sampler: ImageSampler::new(image, interpolant), values, gradients }
    }

    /// The image at x − `factor` u(x).
    fn warp(&mut self, grid: &ImageGrid<D>, field: &[[T; D]], factor: f64) {
        let factor = T::lit(factor);
        let (sampler, values, gradients) = (&self.sampler, &mut self.values[..], &mut self.gradients[..]);
        each((values, gradients), &|start, (values, gradients): (&mut [T], &mut [[T; D]])| {
            for ((position, value), gradient) in (start..).zip(values).zip(gradients) {
                (*value, *gradient) = sampler.with_gradient(target(grid, position, &field[position], factor));
            }
        });
    }
}

/// The fixed and the moving image of one level; in a symmetric registration both are warped.
pub(crate) struct Alignment<const D: usize, T> {
    pub(crate) grid: ImageGrid<D>,
    comparison: Comparison,
    fixed: Warped<D, T>,
    moving: Warped<D, T>,
    slopes: Vec<T>,
}

impl<const D: usize, T: Real> Alignment<D, T> {
    pub(crate) fn new(
        measure: SimilarityMeasure,
        interpolant: Interpolant,
        fixed: &Image<D, T>,
        moving: &Image<D, T>,
    ) -> Self {
        Self {
            grid: *fixed.grid(),
            comparison: Comparison::new(measure, fixed, moving),
            fixed: Warped::new(fixed, interpolant),
            moving: Warped::new(moving, interpolant),
            slopes: vec![T::zero(); fixed.values().len()],
        }
    }

    fn side(&mut self, side: Side) -> &mut Warped<D, T> {
        match side {
            Side::Fixed => &mut self.fixed,
            Side::Moving => &mut self.moving,
        }
    }

    /// Warps one image by x − `factor` u(x).
    pub(crate) fn warp(&mut self, side: Side, field: &[[T; D]], factor: f64) {
        let grid = self.grid;
        self.side(side).warp(&grid, field, factor);
    }

    /// The measure of the images as they are warped.
    pub(crate) fn measure(&mut self) -> f64 {
        self.comparison.value(&self.fixed.values, &self.moving.values)
    }

    /// Adds `factor` times −N ∂D/∂w to `out`, for the displacement w of one image in x ↦ I(x − w): the slope of D times ∇I.
    pub(crate) fn add_force(&mut self, side: Side, factor: f64, out: &mut [[T; D]]) {
        self.comparison.slopes(side, &self.fixed.values, &self.moving.values, &mut self.slopes);
        let slopes = &self.slopes;
        let gradients = if side == Side::Fixed { &self.fixed.gradients } else { &self.moving.gradients };
        let factor = T::lit(factor);
        each(out, &|start, part: &mut [[T; D]]| {
            for (position, force) in (start..).zip(part) {
                let slope = factor * slopes[position];
                for (component, gradient) in force.iter_mut().zip(gradients[position]) {
                    *component += slope * gradient;
                }
            }
        });
    }

    /// The same for a displacement that precedes the map h(x) = x − u(x) of the image: x ↦ I(h(x − w)), at w = 0.
    ///
    /// By the chain rule ∇I is replaced by (∇h)ᵀ∇I, with ∇h = 1 − ∇u by central differences: the mean of the two one-sided derivatives that
    /// the multilinear interpolant of h has at a sample.
    pub(crate) fn add_force_before(&mut self, side: Side, field: &[[T; D]], factor: f64, out: &mut [[T; D]]) {
        self.comparison.slopes(side, &self.fixed.values, &self.moving.values, &mut self.slopes);
        let (slopes, grid) = (&self.slopes, &self.grid);
        let gradients = if side == Side::Fixed { &self.fixed.gradients } else { &self.moving.gradients };
        let factor = T::lit(factor);
        each(out, &|start, part: &mut [[T; D]]| {
            let mut index = grid.index(start);
            for (position, force) in (start..).zip(part) {
                let slope = factor * slopes[position];
                let gradient = &gradients[position];
                // A flat place needs no derivative of the map.
                if !(slope * gradient.iter().fold(T::zero(), |sum, g| sum + *g * *g)).is_zero() {
                    let rows = slopes_at(grid, field, position, &index);
                    for (axis, component) in force.iter_mut().enumerate() {
                        let mut turned = gradient[axis];
                        for (row, g) in rows[axis].iter().zip(gradient) {
                            turned -= *row * *g;
                        }
                        *component += slope * turned;
                    }
                }
                advance(&mut index, &grid.sizes());
            }
        });
    }
}

impl SimilarityMeasure {
    /// D of the fixed and the warped image, and its force f = −N ∂D/∂u on each of the N samples: the exact derivative.
    ///
    /// Means over the box of f·δu are minus the change of D, so f is a force per volume of the box. It drives both models.
    ///
    /// # Errors
    /// As [`of`](Self::of); `UnequalSizes` or `UnequalSpacings` where the grid of the map differs.
    ///
    /// # Example
    /// ```
    /// use piola_registration::{DisplacementMap, Image, ImageGrid, Interpolant, SimilarityMeasure};
    /// let grid = ImageGrid::new([4, 4], [1.0, 1.0])?;
    /// let (fixed, moving) = (Image::from_fn(grid, |[_, x]| x)?, Image::from_fn(grid, |[_, x]| x + 1.0)?);
    /// let rest = DisplacementMap::identity(grid);
    /// let (measure, force) = SimilarityMeasure::SumOfSquares.force(&fixed, &moving, &rest, Interpolant::Linear)?;
    /// assert!((measure - 0.4_f64).abs() < 1e-15); // 1/(2 · 1.25)
    /// assert!((force[5][1] - 0.8_f64).abs() < 1e-15); // the moving image must go to greater x
    /// # Ok::<(), piola_registration::RegistrationError>(())
    /// ```
    pub fn force<const D: usize, T: Real>(
        self,
        fixed: &Image<D, T>,
        moving: &Image<D, T>,
        map: &DisplacementMap<D, T>,
        interpolant: Interpolant,
    ) -> Result<(f64, Vec<[T; D]>), RegistrationError> {
        self.of(fixed, moving)?;
        fixed.grid().check_same(map.grid())?;
        let mut alignment = Alignment::new(self, interpolant, fixed, moving);
        alignment.warp(Side::Moving, map.displacements(), 1.0);
        let measure = alignment.measure();
        let mut force = vec![[T::zero(); D]; fixed.values().len()];
        alignment.add_force(Side::Moving, 1.0, &mut force);
        Ok((measure, force))
    }
}
