//! Measures of similarity of two images and their exact derivatives.

use piola_numerics::Real;

use crate::error::RegistrationError;
use crate::image::Image;
use crate::parallel::{each, fold, sum};
use crate::sampler::{cubic_slopes, cubic_weights};

/// Bins of the joint histogram along each axis.
const BINS: usize = 32;

/// p(j, k) for fixed bin j and moving bin k.
type Histogram = [[f64; BINS]; BINS];

/// How dissimilar two images are: a number without unit that the registration makes small.
///
/// | measure | D(a, b) | use it where |
/// |---|---|---|
/// | sum of squares | `mean (a − b)² / (σ_F² + σ_M²)` | equal things have equal intensities |
/// | cross-correlation | `1 − cov(a, b)/(σ_a σ_b)` | intensities are related linearly |
/// | mutual information | `−Σ p(j,k) ln [p(j,k)/(p(j) p(k))]` | intensities are related in any way, as between two kinds of scanner |
///
/// a is the fixed and b the warped image; `σ_F²` and `σ_M²` are the variances of the two images before any deformation. All three are symmetric.
/// For images of equal mean and variance the first two agree. The joint density p is estimated with 32 × 32 bins over the ranges of the
/// images, with cubic B-splines as windows, so it is twice continuously differentiable; its unit is the nat.
///
/// # Example
/// ```
/// use piola_registration::{Image, ImageGrid, SimilarityMeasure};
/// let grid = ImageGrid::new([16, 16], [1.0, 1.0])?;
/// let image = Image::from_fn(grid, |[y, x]| (0.4 * x).sin() * (0.3 * y).cos())?;
/// let brighter = Image::from_fn(grid, |[y, x]| 3.0 + 2.0 * (0.4 * x).sin() * (0.3 * y).cos())?;
/// assert_eq!(SimilarityMeasure::SumOfSquares.of(&image, &image)?, 0.0);
/// assert!(SimilarityMeasure::CrossCorrelation.of(&image, &brighter)?.abs() < 1e-15);
/// # Ok::<(), piola_registration::RegistrationError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[doc(alias = "SSD")]
#[doc(alias = "NCC")]
#[doc(alias = "MI")]
#[non_exhaustive]
pub enum SimilarityMeasure {
    /// Mean square of the difference, over the sum of the variances.
    #[default]
    SumOfSquares,
    /// One minus the normalised cross-correlation.
    CrossCorrelation,
    /// The negative mutual information, in nats.
    MutualInformation,
}

impl SimilarityMeasure {
    /// D of two images.
    ///
    /// # Errors
    /// [`RegistrationError::UnequalSizes`] or `UnequalSpacings` where the grids differ; `ConstantImage` where an image has one value.
    pub fn of<const D: usize, T: Real>(
        self,
        fixed: &Image<D, T>,
        moving: &Image<D, T>,
    ) -> Result<f64, RegistrationError> {
        fixed.grid().check_same(moving.grid())?;
        fixed.check_contrast("fixed")?;
        moving.check_contrast("moving")?;
        Ok(Comparison::new(self, fixed, moving).value(fixed.values(), moving.values()))
    }
}

/// With respect to which image a derivative is taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Side {
    Fixed,
    Moving,
}

/// A measure with the constants of two images, and what the last value left for the derivatives.
pub(crate) struct Comparison {
    measure: SimilarityMeasure,
    /// Mean and variance of the images before any deformation.
    moments: [[f64; 2]; 2],
    ranges: [[f64; 2]; 2],
    /// Means, covariance and variances of the images last compared.
    joint: Joint,
    /// ln [p(j,k)/(p(j) p(k))].
    logarithms: Box<Histogram>,
}

#[derive(Clone, Copy, Default)]
struct Joint {
    means: [f64; 2],
    variances: [f64; 2],
    covariance: f64,
}

impl Comparison {
    pub(crate) fn new<const D: usize, T: Real>(
        measure: SimilarityMeasure,
        fixed: &Image<D, T>,
        moving: &Image<D, T>,
    ) -> Self {
        Self {
            measure,
            moments: [fixed.mean_and_variance(), moving.mean_and_variance()],
            ranges: [fixed.range(), moving.range()],
            joint: Joint::default(),
            logarithms: Box::new([[0.0; BINS]; BINS]),
        }
    }

    /// `2/(σ_F² + σ_M²)` for the mean of half the squares.
    fn square_weight(&self) -> f64 {
        2.0 / (self.moments[0][1] + self.moments[1][1])
    }

    /// D(a, b).
    pub(crate) fn value<T: Real>(&mut self, a: &[T], b: &[T]) -> f64 {
        let count = a.len() as f64;
        match self.measure {
            SimilarityMeasure::SumOfSquares => {
                let squares = sum(0..a.len(), &|_, range: std::ops::Range<usize>| {
                    a[range.clone()].iter().zip(&b[range]).map(|(a, b)| (*b - *a).primal(0).powi(2)).sum()
                });
                0.5 * self.square_weight() * squares / count
            }
            SimilarityMeasure::CrossCorrelation => {
                self.joint = joint(a, b, [self.moments[0][0], self.moments[1][0]]);
                1.0 - self.correlation()
            }
            SimilarityMeasure::MutualInformation => {
                let ranges = self.ranges;
                // Leaves are large: each has a histogram of its own.
                let mut density = fold(
                    Blocks(0..a.len()),
                    &|_, Blocks(range)| histogram(&ranges, &a[range.clone()], &b[range]),
                    &|mut one, other| {
                        for (one, other) in one.as_flattened_mut().iter_mut().zip(other.as_flattened()) {
                            *one += other;
                        }
                        one
                    },
                );
                for p in density.as_flattened_mut() {
                    *p /= count;
                }
                -information(&density, &mut self.logarithms)
            }
        }
    }

    /// ρ; zero where an image has become constant.
    fn correlation(&self) -> f64 {
        let product = (self.joint.variances[0] * self.joint.variances[1]).sqrt();
        if 0.0 < product { self.joint.covariance / product } else { 0.0 }
    }

    /// N ∂D/∂a or N ∂D/∂b, for the images whose [`value`](Self::value) was taken last.
    pub(crate) fn slopes<T: Real>(&self, side: Side, a: &[T], b: &[T], out: &mut [T]) {
        match self.measure {
            SimilarityMeasure::SumOfSquares => {
                let weight = T::lit(if side == Side::Moving { self.square_weight() } else { -self.square_weight() });
                each(out, &|start, part: &mut [T]| {
                    for (position, slope) in (start..).zip(part) {
                        *slope = weight * (b[position] - a[position]);
                    }
                });
            }
            SimilarityMeasure::CrossCorrelation => {
                let (own, other, mine, theirs) = if side == Side::Moving { (1, 0, b, a) } else { (0, 1, a, b) };
                let Joint { means, variances, .. } = self.joint;
                let product = (variances[0] * variances[1]).sqrt();
                if product <= 0.0 {
                    out.fill(T::zero());
                    return;
                }
                let (towards, back) = (T::lit(1.0 / product), T::lit(self.correlation() / variances[own]));
                let (my_mean, their_mean) = (T::lit(means[own]), T::lit(means[other]));
                each(out, &|start, part: &mut [T]| {
                    for (position, slope) in (start..).zip(part) {
                        *slope = back * (mine[position] - my_mean) - towards * (theirs[position] - their_mean);
                    }
                });
            }
            SimilarityMeasure::MutualInformation => {
                let (ranges, logarithms) = (&self.ranges, &self.logarithms);
                each(out, &|start, part: &mut [T]| {
                    for (position, slope) in (start..).zip(part) {
                        let (j, t, fixed_inside) = window(&ranges[0], a[position].primal(0));
                        let (k, s, moving_inside) = window(&ranges[1], b[position].primal(0));
                        let (fixed, moving, is_inside, range) = match side {
                            Side::Moving => (cubic_weights(t), cubic_slopes(s), moving_inside, ranges[1]),
                            Side::Fixed => (cubic_slopes(t), cubic_weights(s), fixed_inside, ranges[0]),
                        };
                        let mut derivative = 0.0;
                        if is_inside {
                            for (row, weight) in logarithms[j..j + 4].iter().zip(fixed) {
                                let inner: f64 = row[k..k + 4].iter().zip(moving).map(|(l, weight)| l * weight).sum();
                                derivative -= weight * inner;
                            }
                        }
                        *slope = T::lit(derivative * (BINS - 3) as f64 / (range[1] - range[0]));
                    }
                });
            }
        }
    }
}

/// A range of samples in leaves eight times the usual size.
struct Blocks(std::ops::Range<usize>);

impl crate::parallel::Span for Blocks {
    fn count(&self) -> usize {
        self.0.len() / 8
    }
    fn halves(self, at: usize) -> (Self, Self) {
        let middle = self.0.start + 8 * at;
        (Self(self.0.start..middle), Self(middle..self.0.end))
    }
}

/// Means, variances and covariance, summed about `about` so that digits are not lost.
fn joint<T: Real>(a: &[T], b: &[T], about: [f64; 2]) -> Joint {
    let count = a.len() as f64;
    let sums = fold(
        0..a.len(),
        &|_, range: std::ops::Range<usize>| {
            let mut sums = [0.0; 5];
            for (a, b) in a[range.clone()].iter().zip(&b[range]) {
                let (a, b) = (a.primal(0) - about[0], b.primal(0) - about[1]);
                for (sum, term) in sums.iter_mut().zip([a, b, a * a, b * b, a * b]) {
                    *sum += term;
                }
            }
            sums
        },
        &|one, other| std::array::from_fn(|at| one[at] + other[at]),
    );
    let [a, b, aa, bb, ab] = sums.map(|sum: f64| sum / count);
    Joint {
        means: [about[0] + a, about[1] + b],
        variances: [(aa - a * a).max(0.0), (bb - b * b).max(0.0)],
        covariance: ab - a * b,
    }
}

/// The first of four bins that a value touches, its share of the way in the cell, and whether it lies in the range.
#[cfg_attr(not(debug_assertions), inline(always))]
fn window(range: &[f64; 2], value: f64) -> (usize, f64, bool) {
    let cells = (BINS - 3) as f64;
    let at = (value - range[0]) / (range[1] - range[0]) * cells;
    let is_inside = 0.0 <= at && at <= cells;
    let at = at.clamp(0.0, cells);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between zero and the number of bins")]
    let cell = (at as usize).min(BINS - 4);
    (cell, at - cell as f64, is_inside)
}

fn histogram<T: Real>(ranges: &[[f64; 2]; 2], a: &[T], b: &[T]) -> Histogram {
    let mut counts = [[0.0; BINS]; BINS];
    for (a, b) in a.iter().zip(b) {
        let (j, t, _) = window(&ranges[0], a.primal(0));
        let (k, s, _) = window(&ranges[1], b.primal(0));
        let moving = cubic_weights(s);
        for (row, fixed) in counts[j..j + 4].iter_mut().zip(cubic_weights(t)) {
            for (count, moving) in row[k..k + 4].iter_mut().zip(moving) {
                *count += fixed * moving;
            }
        }
    }
    counts
}

/// The mutual information of a density; its logarithms are left in `logarithms`, zero where the density is.
fn information(density: &Histogram, logarithms: &mut Histogram) -> f64 {
    let rows: [f64; BINS] = std::array::from_fn(|j| density[j].iter().sum());
    let columns: [f64; BINS] = std::array::from_fn(|k| density.iter().map(|row| row[k]).sum());
    let mut information = 0.0;
    for j in 0..BINS {
        for k in 0..BINS {
            let p = density[j][k];
            logarithms[j][k] = if 0.0 < p { (p / (rows[j] * columns[k])).ln() } else { 0.0 };
            information += p * logarithms[j][k];
        }
    }
    information
}
