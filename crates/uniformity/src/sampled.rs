//! Uniformity maps sampled at the nodes of a grid.

use nalgebra::{Matrix3, Vector3};
use piola_fields::Interpolation;
use piola_fields::internal::Axis;
use piola_numerics::linear::matrix3::rows_of;
use piola_numerics::{Mask, Real};

use crate::UniformityError;
use crate::map::{UniformityMap, check_map};

/// Values of K at the nodes of a rectilinear grid.
///
/// # Example
/// See [`SampledUniformityMap`].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct UniformityMapSamples {
    /// The nodes along X₁, X₂ and X₃, m, each increasing; a single node means that nothing depends on that coordinate.
    pub nodes: [Vec<f64>; 3],
    /// K at node (i, j, k), at the index (i n₂ + j) n₃ + k.
    pub values: Vec<Matrix3<f64>>,
    /// The splines between them.
    pub interpolation: Interpolation,
}

/// A uniformity map by its samples, interpolated by tensor products of splines.
///
/// # Errors
/// Asked outside the grid it refuses with [`FieldsError::OutsideSamples`](piola_fields::FieldsError::OutsideSamples).
///
/// # Accuracy
/// Through every sample to a few ulp. For samples of a smooth map at the spacing h, with `Cubic` and `Quintic` splines:
///
/// | quantity | derivatives of K | cubic | quintic |
/// |---|---|---|---|
/// | K, metric, Burgers vector of a circuit | 0 | h⁴ | h⁶ |
/// | connection, torsion, dislocation density, Christoffel symbols | 1 | h³ | h⁵ |
/// | curvature | 2 | h² | h⁴ |
///
/// # Example
/// A map linear in X₂ is given back by two samples.
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use piola_fields::Interpolation;
/// use piola_uniformity::{AffineConnection, MaterialConnection, SampledUniformityMap, UniformityMap, UniformityMapSamples};
/// let map = SampledUniformityMap::new(UniformityMapSamples {
///     nodes: [vec![0.0], vec![0.0, 1.0], vec![0.0]],
///     values: vec![Matrix3::identity(), Matrix3::identity() * 2.0],
///     interpolation: Interpolation::Cubic,
/// })?;
/// let place = Vector3::new(0.0, 0.5, 0.0);
/// assert_eq!(map.value(&place)?, Matrix3::identity() * 1.5);
/// let torsion = MaterialConnection::of_crystal(map).torsion(&place)?;
/// assert!((torsion.components[0][0][1] + 1.0_f64 / 1.5).abs() < 1e-15); // −∂₂K/K
/// # Ok::<(), piola_uniformity::UniformityError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UniformityMapSamples", into = "UniformityMapSamples"))]
pub struct SampledUniformityMap {
    samples: UniformityMapSamples,
    axes: [Axis; 3],
    /// Of each column of K.
    coefficients: [Box<[[f64; 3]]>; 3],
}

impl SampledUniformityMap {
    /// From samples.
    ///
    /// # Errors
    /// [`UniformityError::WrongLength`] when an axis is empty or the number of values is not n₁ n₂ n₃; [`UniformityError::NotFinite`];
    /// [`UniformityError::SingularMap`] and [`UniformityError::OrientationReversing`] with the node;
    /// [`FieldsError::NotIncreasing`](piola_fields::FieldsError::NotIncreasing) with the axis.
    pub fn new(samples: UniformityMapSamples) -> Result<Self, UniformityError> {
        let [x, y, z] = &samples.nodes;
        let spline = |name, nodes: &[f64]| Axis::new(name, nodes, samples.interpolation);
        let axes = [spline("nodes along X1", x)?, spline("nodes along X2", y)?, spline("nodes along X3", z)?];
        let (found, expected) = (samples.values.len(), x.len() * y.len() * z.len());
        if found != expected {
            return Err(UniformityError::WrongLength { quantity: "samples of K", found, expected });
        }
        for (index, value) in samples.values.iter().enumerate() {
            let node = Vector3::new(x[index / z.len() / y.len()], y[index / z.len() % y.len()], z[index % z.len()]);
            check_map(rows_of(value), &node)?;
        }
        let coefficients = [0, 1, 2].map(|column: usize| {
            let mut coefficients: Box<[[f64; 3]]> =
                samples.values.iter().map(|value| value.column(column).into_owned().into()).collect();
            let mut stride = 1;
            for axis in [&axes[2], &axes[1], &axes[0]] {
                let factors = axis.factor();
                for start in (0..expected).filter(|index| index / stride % axis.len() == 0) {
                    factors.solve(&mut coefficients, start, stride);
                }
                stride *= axis.len();
            }
            coefficients
        });
        Ok(Self { samples, axes, coefficients })
    }

    /// A map sampled at the nodes of a grid.
    ///
    /// # Errors
    /// As [`new`](Self::new), and what the map refuses.
    pub fn of(
        map: &impl UniformityMap,
        nodes: [Vec<f64>; 3],
        interpolation: Interpolation,
    ) -> Result<Self, UniformityError> {
        let mut values = Vec::with_capacity(nodes[0].len() * nodes[1].len() * nodes[2].len());
        for &x in &nodes[0] {
            for &y in &nodes[1] {
                for &z in &nodes[2] {
                    values.push(map.value(&Vector3::new(x, y, z))?);
                }
            }
        }
        Self::new(UniformityMapSamples { nodes, values, interpolation })
    }

    /// The samples.
    #[must_use]
    pub const fn samples(&self) -> &UniformityMapSamples {
        &self.samples
    }

    /// The first splines of the cell where a lane is.
    fn first<T: Real>(&self, reference: &Vector3<T>, lane: usize) -> [usize; 3] {
        [0, 1, 2].map(|axis: usize| self.axes[axis].first(reference[axis].primal(lane)))
    }

    /// K by the splines from the given first ones on.
    fn combine<T: Real>(&self, first: [usize; 3], reference: &Vector3<T>) -> Matrix3<T> {
        let [x, y, z] = &self.axes;
        let bases = [0, 1, 2].map(|axis: usize| self.axes[axis].basis(first[axis], reference[axis]));
        let mut sum = [[T::zero(); 3]; 3];
        for (i, &bx) in bases[0].iter().enumerate().take(x.width()) {
            for (j, &by) in bases[1].iter().enumerate().take(y.width()) {
                let row = ((first[0] + i) * y.len() + first[1] + j) * z.len() + first[2];
                let weight = bx * by;
                for (column, coefficients) in sum.iter_mut().zip(&self.coefficients) {
                    let mut along = [T::zero(); 3];
                    for (k, &bz) in bases[2].iter().enumerate().take(z.width()) {
                        for (along, &c) in along.iter_mut().zip(&coefficients[row + k]) {
                            *along += bz * T::lit(c);
                        }
                    }
                    for (entry, along) in column.iter_mut().zip(along) {
                        *entry += weight * along;
                    }
                }
            }
        }
        Matrix3::from_fn(|i, j| sum[j][i])
    }
}

impl TryFrom<UniformityMapSamples> for SampledUniformityMap {
    type Error = UniformityError;
    fn try_from(samples: UniformityMapSamples) -> Result<Self, UniformityError> {
        Self::new(samples)
    }
}

impl From<SampledUniformityMap> for UniformityMapSamples {
    fn from(map: SampledUniformityMap) -> Self {
        map.samples
    }
}

impl UniformityMap for SampledUniformityMap {
    fn at<T: Real>(&self, reference: &Vector3<T>) -> Matrix3<T> {
        let mut cell = self.first(reference, 0);
        let mut value = self.combine(cell, reference);
        // Lanes in other cells take the value from theirs.
        for lane in 1..T::LANES {
            let other = self.first(reference, lane);
            if other == cell {
                continue;
            }
            cell = other;
            let there = self.combine(cell, reference);
            let mask = (0..3)
                .fold(T::Mask::splat(true), |mask, axis| mask & self.axes[axis].within(cell[axis], reference[axis]));
            value = Matrix3::from_fn(|i, j| T::select(mask, there[(i, j)], value[(i, j)]));
        }
        value
    }

    fn check_domain<T: Real>(&self, reference: &Vector3<T>) -> Result<(), UniformityError> {
        for (axis, &x) in self.axes.iter().zip(reference.iter()) {
            axis.check(x)?;
        }
        Ok(())
    }
}
