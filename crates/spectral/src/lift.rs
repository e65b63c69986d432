//! Forces that do not vanish normal to sliding walls: a displacement that balances them at the walls is split off.
//!
//! ```text
//! w_a = p(x_a) g,   w_b = r(x_a) ∂g/∂x_b,   ξ = x_a/L,   A = λ + 2μ
//! p = 0 and r' = 0 at both walls;   A p″ = −(1 − ξ),   A μ r‴ = (λ + μ)(1 − ξ) for the wall ξ = 0
//! ```
//! g is the force normal to the wall, b runs along the wall. Then f + Lw has no part normal to the walls, and its tangential
//! part has the normal derivatives of f. Its modes fall faster by two orders, and u = w + (the solution for f + Lw).

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

/// p, p′, p″, r, r′, r″ across the box, each for the two walls of an axis.
fn profiles<const D: usize>(grid: &BoxGrid<D>, operator: &BoxOperator, axis: usize, m: usize) -> [[f64; 6]; 2] {
    let [along, across] = operator.stiffnesses;
    let side = grid.sides()[axis];
    let mut indices = [0; D];
    indices[axis] = m;
    let near = grid.position(indices)[axis] / side;
    let coupling = (along - across) / across;
    let at = |xi: f64| {
        let p = [
            -side * side * xi * (xi * (0.5 - xi / 6.0) - 1.0 / 3.0),
            -side * (xi * (1.0 - 0.5 * xi) - 1.0 / 3.0),
            xi - 1.0,
        ];
        let r = [
            side * side * side * xi * xi * (xi * (1.0 / 6.0 - xi / 24.0) - 1.0 / 6.0),
            side * side * xi * (xi * (0.5 - xi / 6.0) - 1.0 / 3.0),
            side * (xi * (1.0 - 0.5 * xi) - 1.0 / 3.0),
        ];
        [p.map(|p| p / along), r.map(|r| r * coupling / along)]
    };
    let [[p, dp, ddp], [r, dr, ddr]] = at(near);
    let [[q, dq, ddq], [t, dt, ddt]] = at(1.0 - near);
    [[p, dp, ddp, r, dr, ddr], [q, -dq, ddq, -t, dt, -ddt]]
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

    /// Adds Lw to the force. Returns the derivatives of g on both walls along each axis: `add_to` needs them.
    pub(crate) fn balance<const D: usize>(
        &self,
        grid: &BoxGrid<D>,
        operator: &BoxOperator,
        plans: &Plans<T, D>,
        waves: &[AxisWaves<T>; D],
        fields: &mut [&mut [T]; D],
        memory: &mut Memory<T>,
    ) -> [[Vec<T>; D]; 2] {
        let axis = self.axis;
        let [along, across] = operator.stiffnesses;
        let (stride, block) = lines(grid.points(), axis);
        let mut slopes = [(); 2].map(|()| [(); D].map(|()| Vec::new()));
        for (which, face) in self.faces.iter().enumerate() {
            let mut laplacian = vec![T::lit(0.0); face.len()];
            for other in (0..D).filter(|&other| other != axis) {
                for (sum, second) in laplacian.iter_mut().zip(derivative(plans, waves, axis, other, face, 2, memory)) {
                    *sum += second;
                }
            }
            let mut add = |component: usize, m: usize, factor: f64, values: &[T]| {
                let factor = T::lit(factor);
                for (line, value) in values.iter().enumerate() {
                    fields[component][line / stride * block + line % stride + m * stride] += factor * *value;
                }
            };
            for m in 0..grid.points()[axis] {
                let [p, _, ddp, _, dr, _] = profiles(grid, operator, axis, m)[which];
                add(axis, m, along * ddp, face);
                add(axis, m, across * p + (along - across) * dr, &laplacian);
            }
            for other in (0..D).filter(|&other| other != axis) {
                let slope = derivative(plans, waves, axis, other, face, 1, memory);
                let third = derivative(plans, waves, axis, other, &laplacian, 1, memory);
                for m in 0..grid.points()[axis] {
                    let [_, dp, _, r, _, ddr] = profiles(grid, operator, axis, m)[which];
                    add(other, m, across * ddr + (along - across) * dp, &slope);
                    add(other, m, along * r, &third);
                }
                slopes[which][other] = slope;
            }
        }
        slopes
    }

    /// Adds w to the displacement.
    pub(crate) fn add_to<const D: usize>(
        &self,
        slopes: &[[Vec<T>; D]; 2],
        grid: &BoxGrid<D>,
        operator: &BoxOperator,
        fields: &mut [&mut [T]; D],
    ) {
        let (stride, block) = lines(grid.points(), self.axis);
        for m in 0..grid.points()[self.axis] {
            let profiles = profiles(grid, operator, self.axis, m);
            for ((face, slopes), [p, _, _, r, _, _]) in self.faces.iter().zip(slopes).zip(profiles) {
                for (component, field) in fields.iter_mut().enumerate() {
                    let (factor, values) = if component == self.axis { (p, face) } else { (r, &slopes[component]) };
                    let factor = T::lit(factor);
                    for (line, value) in values.iter().enumerate() {
                        field[line / stride * block + line % stride + m * stride] += factor * *value;
                    }
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
