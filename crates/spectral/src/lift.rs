//! Forces that do not vanish normal to sliding walls: a displacement that balances them at the walls is split off.
//!
//! ```text
//! w_a = p(x_a) g/A,   p(0) = p(L) = 0,   p″ = −(1 − ξ) for the wall ξ = 0 and −ξ for the wall ξ = 1,   ξ = x_a/L
//! ```
//! g is the force normal to the wall and A = λ + 2μ. Then f + Lw vanishes normal to the walls, its sines converge faster by
//! two orders, and u = w + (the solution for f + Lw).

use crate::Precision;
use crate::grid::{BoxGrid, PointLocation};
use crate::operator::BoxOperator;
use crate::passes::{Memory, Plans};
use crate::transform::{Direction, Line};
use crate::walls::Parity;
use crate::waves::AxisWaves;

/// The force normal to the two walls of an axis.
pub(crate) struct NormalForces<T> {
    axis: usize,
    /// Of the near and the far wall.
    pub(crate) faces: [Vec<T>; 2],
}

/// p, p′ and p″ at ξ of a wall at ξ = 0.
fn profile(xi: f64, side: f64) -> [f64; 3] {
    let value = -side * side * xi * (xi * (0.5 - xi / 6.0) - 1.0 / 3.0);
    [value, -side * (xi * (1.0 - 0.5 * xi) - 1.0 / 3.0), xi - 1.0]
}

/// p, p′ and p″ of both walls at point m of an axis.
fn profiles<const D: usize>(grid: &BoxGrid<D>, axis: usize, m: usize) -> [[f64; 3]; 2] {
    let side = grid.sides()[axis];
    let mut indices = [0; D];
    indices[axis] = m;
    let xi = grid.position(indices)[axis] / side;
    let [value, slope, curvature] = profile(1.0 - xi, side);
    [profile(xi, side), [value, -slope, curvature]]
}

/// The position of the first point of each line along an axis, and the distance of its points.
fn lines<const D: usize>(points: [usize; D], axis: usize) -> (usize, usize) {
    let stride = points[axis + 1..].iter().product();
    (stride, points[axis] * stride)
}

impl<T: Precision> NormalForces<T> {
    /// Reads the samples on the walls, or continues those of the three nearest cells by a parabola.
    pub(crate) fn of<const D: usize>(grid: &BoxGrid<D>, axis: usize, field: &[T]) -> Self {
        let points = grid.points();
        let (stride, block) = lines(points, axis);
        let count = points[axis];
        let weights: &[f64] = match grid.location() {
            PointLocation::Nodes => &[1.0],
            PointLocation::Cells if count < 3 => &[1.5, -0.5],
            PointLocation::Cells => &[1.875, -1.25, 0.375],
        };
        let face = |is_far: bool| {
            (0..field.len() / count)
                .map(|line| {
                    let start = line / stride * block + line % stride;
                    weights.iter().enumerate().fold(T::lit(0.0), |sum, (m, weight)| {
                        let m = if is_far { count - 1 - m } else { m };
                        sum + T::lit(*weight) * field[start + m * stride]
                    })
                })
                .collect()
        };
        Self { axis, faces: [face(false), face(true)] }
    }

    /// The largest absolute values on the two walls.
    pub(crate) fn largest(&self) -> [f64; 2] {
        self.faces.each_ref().map(|face| face.iter().map(|value| value.primal(0).abs()).fold(0.0, f64::max))
    }

    /// Adds Lw to the force.
    pub(crate) fn balance<const D: usize>(
        &self,
        grid: &BoxGrid<D>,
        operator: &BoxOperator,
        plans: &Plans<T, D>,
        waves: &[AxisWaves<T>; D],
        fields: &mut [&mut [T]; D],
        memory: &mut Memory<T>,
    ) {
        let axis = self.axis;
        let [along, across] = operator.stiffnesses;
        let (stride, block) = lines(grid.points(), axis);
        let zero = T::lit(0.0);
        for (which, face) in self.faces.iter().enumerate() {
            let mut laplacian = vec![zero; face.len()];
            for other in (0..D).filter(|&other| other != axis) {
                let first = derivative(plans, waves, axis, other, face, 1, memory);
                let second = derivative(plans, waves, axis, other, face, 2, memory);
                for (sum, second) in laplacian.iter_mut().zip(second) {
                    *sum += second;
                }
                for m in 0..grid.points()[axis] {
                    let factor = T::lit((along - across) / along * profiles(grid, axis, m)[which][1]);
                    for (line, slope) in first.iter().enumerate() {
                        fields[other][line / stride * block + line % stride + m * stride] += factor * *slope;
                    }
                }
            }
            for m in 0..grid.points()[axis] {
                let [value, _, curvature] = profiles(grid, axis, m)[which];
                let (value, curvature) = (T::lit(across / along * value), T::lit(curvature));
                for (line, (force, laplacian)) in face.iter().zip(&laplacian).enumerate() {
                    fields[axis][line / stride * block + line % stride + m * stride] +=
                        curvature * *force + value * *laplacian;
                }
            }
        }
    }

    /// Adds w to the displacement.
    pub(crate) fn add_to<const D: usize>(&self, grid: &BoxGrid<D>, operator: &BoxOperator, field: &mut [T]) {
        let (stride, block) = lines(grid.points(), self.axis);
        for m in 0..grid.points()[self.axis] {
            let profiles = profiles(grid, self.axis, m);
            for (face, [value, _, _]) in self.faces.iter().zip(profiles) {
                let value = T::lit(value / operator.stiffnesses[0]);
                for (line, force) in face.iter().enumerate() {
                    field[line / stride * block + line % stride + m * stride] += value * *force;
                }
            }
        }
    }
}

/// The first or second derivative of a face along an axis, by cosines.
fn derivative<T: Precision, const D: usize>(
    plans: &Plans<T, D>,
    waves: &[AxisWaves<T>; D],
    normal: usize,
    axis: usize,
    face: &[T],
    order: usize,
    memory: &mut Memory<T>,
) -> Vec<T> {
    let points = plans.points[axis];
    let stride: usize = (axis + 1..D).filter(|&other| other != normal).map(|other| plans.points[other]).product();
    let mut result = vec![T::lit(0.0); face.len()];
    let (panel, transform) = memory.parts(points);
    for line in 0..face.len() / points {
        let start = line / stride * stride * points + line % stride;
        for (m, entry) in panel.iter_mut().enumerate() {
            *entry = Line::splat(face[start + m * stride]);
        }
        plans.lines[axis].run(Direction::ToModes, Parity::Cosine, panel, transform);
        for (slot, entry) in panel.iter_mut().enumerate() {
            let first = waves[axis].derivative(slot);
            let factor = match order {
                1 if waves[axis].is_special(slot) => T::lit(0.0),
                1 => first,
                _ => first * waves[axis].wave_of(slot),
            };
            *entry *= Line::splat(-factor);
        }
        let parity = if order == 1 { Parity::Sine } else { Parity::Cosine };
        plans.lines[axis].run(Direction::ToSamples, parity, panel, transform);
        for (m, entry) in panel.iter().enumerate() {
            result[start + m * stride] = entry.0[0];
        }
    }
    result
}
