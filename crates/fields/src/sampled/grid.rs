//! Motions sampled at the nodes of a grid.

use nalgebra::Vector3;
use piola_numerics::Real;
use piola_numerics::linear::matrix3::determinant;

use super::Interpolation;
use super::spline::Axis;
use crate::FieldsError;
use crate::error::check_finite;
use crate::motion::Motion;

/// Displacements of the nodes of a rectilinear grid of particles at several times.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MotionSamples {
    /// The nodes along X₁, X₂ and X₃, m, each increasing; a single node means that nothing depends on that
    /// coordinate.
    pub nodes: [Vec<f64>; 3],
    /// The times, s, increasing; a single time means rest.
    pub times: Vec<f64>,
    /// u at node (i, j, k) and time l, m, at the index ((l n₁ + i) n₂ + j) n₃ + k.
    pub displacements: Vec<[f64; 3]>,
    /// The splines between them.
    pub interpolation: Interpolation,
}

/// A motion given by its samples on a grid, interpolated by tensor products of splines.
///
/// The displacement is interpolated, so that ∇u is as accurate as the displacements are: small strains do not
/// drown in the places.
///
/// # Errors
/// Asked outside the grid or the times it refuses with [`FieldsError::OutsideSamples`].
///
/// # Accuracy
/// Through every sample to a few ulp of the largest displacement; between them to the order in
/// [the table](super#), exact for polynomials of the degree.
///
/// # Example
/// Four samples of u₁ = X₁² t on each of two axes give it back everywhere.
/// ```
/// use nalgebra::Vector3;
/// use piola_fields::{Interpolation, Motion, MotionSamples, SampledMotion};
/// let axis = vec![0.0, 0.25, 0.5, 1.0];
/// let displacements = axis.iter().flat_map(|t| axis.iter().map(move |x| [x * x * t, 0.0, 0.0])).collect();
/// let motion = SampledMotion::new(MotionSamples {
///     nodes: [axis.clone(), vec![0.0], vec![0.0]],
///     times: axis.clone(),
///     displacements,
///     interpolation: Interpolation::Cubic,
/// })?;
/// let particle = Vector3::<f64>::new(0.75, 0.0, 0.0);
/// assert!((motion.velocity(&particle, 0.1)?.x - 0.5625).abs() < 1e-15);
/// assert!((motion.displacement_gradient(&particle, 0.4)?.matrix()[(0, 0)] - 0.6).abs() < 1e-15);
/// assert!(motion.velocity(&particle, 1.5).is_err());
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "MotionSamples", into = "MotionSamples"))]
pub struct SampledMotion {
    samples: MotionSamples,
    axes: [Axis; 3],
    times: Axis,
    coefficients: Box<[[f64; 3]]>,
}

impl SampledMotion {
    /// From samples.
    ///
    /// # Errors
    /// [`FieldsError::WrongLength`] when an axis is empty or the number of displacements is not
    /// n₁ n₂ n₃ × times; [`FieldsError::NotFinite`]; [`FieldsError::NotIncreasing`] with the name of the
    /// axis and the index of the node; [`FieldsError::FoldedCell`] with cell and time where 0 < det F is
    /// violated at a corner of a cell, by the edges that meet there.
    pub fn new(samples: MotionSamples) -> Result<Self, FieldsError> {
        let spline = |name, nodes: &[f64]| Axis::new(name, nodes, samples.interpolation);
        let [x, y, z] = &samples.nodes;
        let axes = [spline("nodes along X1", x)?, spline("nodes along X2", y)?, spline("nodes along X3", z)?];
        let times = spline("times", &samples.times)?;
        let expected = times.len() * axes[0].len() * axes[1].len() * axes[2].len();
        let found = samples.displacements.len();
        if found != expected {
            return Err(FieldsError::WrongLength { quantity: "displacements", found, expected });
        }
        check_finite("displacements", samples.displacements.as_flattened())?;
        check_cells(&axes, times.len(), &samples.displacements)?;
        let mut coefficients = samples.displacements.clone().into_boxed_slice();
        let mut stride = 1;
        for axis in [&axes[2], &axes[1], &axes[0], &times] {
            let factors = axis.factor();
            for start in (0..expected).filter(|index| index / stride % axis.len() == 0) {
                factors.solve(&mut coefficients, start, stride);
            }
            stride *= axis.len();
        }
        Ok(Self { samples, axes, times, coefficients })
    }

    /// From places x instead of displacements: `places` has the order of
    /// [`MotionSamples::displacements`].
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn from_places(
        nodes: [Vec<f64>; 3],
        times: Vec<f64>,
        places: &[[f64; 3]],
        interpolation: Interpolation,
    ) -> Result<Self, FieldsError> {
        let [x, y, z] = &nodes;
        let expected = times.len() * x.len() * y.len() * z.len();
        if places.len() != expected {
            return Err(FieldsError::WrongLength { quantity: "places", found: places.len(), expected });
        }
        check_finite("places", places.as_flattened())?;
        let displacement = |(index, place): (usize, &[f64; 3])| {
            let (k, rest) = (index % z.len(), index / z.len());
            [place[0] - x[rest / y.len() % x.len()], place[1] - y[rest % y.len()], place[2] - z[k]]
        };
        let displacements = places.iter().enumerate().map(displacement).collect();
        Self::new(MotionSamples { nodes, times, displacements, interpolation })
    }

    /// The samples.
    #[must_use]
    pub fn samples(&self) -> &MotionSamples {
        &self.samples
    }

    /// The value of the splines from the given first ones on.
    fn combine<T: Real>(&self, first: [usize; 4], reference: &Vector3<T>, t: T) -> Vector3<T> {
        let [x, y, z] = &self.axes;
        let (bt, bx) = (self.times.basis(first[0], t), x.basis(first[1], reference[0]));
        let (by, bz) = (y.basis(first[2], reference[1]), z.basis(first[3], reference[2]));
        let mut sum = [T::zero(); 3];
        for (l, &bt) in bt.iter().enumerate().take(self.times.width()) {
            for (i, &bx) in bx.iter().enumerate().take(x.width()) {
                let weight = bt * bx;
                for (j, &by) in by.iter().enumerate().take(y.width()) {
                    let row = ((first[0] + l) * x.len() + first[1] + i) * y.len() + first[2] + j;
                    let row = row * z.len() + first[3];
                    let mut along = [T::zero(); 3];
                    for (k, &bz) in bz.iter().enumerate().take(z.width()) {
                        for (along, &c) in along.iter_mut().zip(&self.coefficients[row + k]) {
                            *along += bz * T::lit(c);
                        }
                    }
                    let weight = weight * by;
                    for (sum, along) in sum.iter_mut().zip(along) {
                        *sum += weight * along;
                    }
                }
            }
        }
        Vector3::from(sum)
    }

    /// The first splines of the cell where a lane is.
    fn first<T: Real>(&self, reference: &Vector3<T>, t: T, lane: usize) -> [usize; 4] {
        let along = |axis: usize| self.axes[axis].first(reference[axis].primal(lane));
        [self.times.first(t.primal(lane)), along(0), along(1), along(2)]
    }
}

impl Motion for SampledMotion {
    #[inline]
    fn place<T: Real>(&self, reference: &Vector3<T>, t: T) -> Vector3<T> {
        reference + self.displacement(reference, t)
    }

    fn displacement<T: Real>(&self, reference: &Vector3<T>, t: T) -> Vector3<T> {
        let mut cell = self.first(reference, t, 0);
        let mut value = self.combine(cell, reference, t);
        // Lanes in other cells take the value from theirs.
        for lane in 1..T::LANES {
            let other = self.first(reference, t, lane);
            if other == cell {
                continue;
            }
            cell = other;
            let there = self.combine(cell, reference, t);
            let mask = self.times.within(cell[0], t)
                & self.axes[0].within(cell[1], reference[0])
                & self.axes[1].within(cell[2], reference[1])
                & self.axes[2].within(cell[3], reference[2]);
            value = Vector3::from_fn(|i, _| T::select(mask, there[i], value[i]));
        }
        value
    }

    fn check_domain<T: Real>(&self, reference: &Vector3<T>, t: T) -> Result<(), FieldsError> {
        self.times.check(t)?;
        self.axes.iter().zip(reference.iter()).try_for_each(|(axis, &x)| axis.check(x))
    }
}

impl TryFrom<MotionSamples> for SampledMotion {
    type Error = FieldsError;
    fn try_from(samples: MotionSamples) -> Result<Self, FieldsError> {
        Self::new(samples)
    }
}

impl From<SampledMotion> for MotionSamples {
    fn from(motion: SampledMotion) -> Self {
        motion.samples
    }
}

/// Refuses cells with a corner where the edges, divided by their lengths before, do not span a positive volume.
fn check_cells(axes: &[Axis; 3], times: usize, displacements: &[[f64; 3]]) -> Result<(), FieldsError> {
    let counts = [axes[0].len(), axes[1].len(), axes[2].len()];
    let cells = counts.map(|count| count.saturating_sub(1).max(1));
    let at = |l: usize, node: [usize; 3]| {
        displacements[((l * counts[0] + node[0]) * counts[1] + node[1]) * counts[2] + node[2]]
    };
    for time in 0..times {
        for index in 0..cells[0] * cells[1] * cells[2] {
            let cell = [index / (cells[1] * cells[2]), index / cells[2] % cells[1], index % cells[2]];
            for corner in 0..8_usize {
                let side = |axis: usize| (corner >> axis & 1).min(counts[axis] - 1);
                let node = [cell[0] + side(0), cell[1] + side(1), cell[2] + side(2)];
                // Column A of F by the edge of the cell along X_A, here as a row: the determinant is the same.
                let edge = |axis: usize| {
                    let mut edge = [0.0; 3];
                    edge[axis] = 1.0;
                    if counts[axis] == 1 {
                        return edge;
                    }
                    let (mut low, mut high) = (node, node);
                    (low[axis], high[axis]) = (cell[axis], cell[axis] + 1);
                    let nodes = axes[axis].nodes();
                    let length = nodes[high[axis]] - nodes[low[axis]];
                    let (before, after) = (at(time, low), at(time, high));
                    core::array::from_fn(|i| edge[i] + (after[i] - before[i]) / length)
                };
                let determinant = determinant([edge(0), edge(1), edge(2)]);
                let open = 0.0 < determinant;
                if !open {
                    return Err(FieldsError::FoldedCell { cell, time, determinant });
                }
            }
        }
    }
    Ok(())
}
