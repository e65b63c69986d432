//! Static solutions on a periodic box, by complex Fourier transforms.

use std::f64::consts::PI;
use std::fmt;
use std::sync::Arc;

use rustfft::num_complex::Complex;
use rustfft::{Fft, FftPlanner};

use crate::Precision;
use crate::error::{SpectralError, check_length};
use crate::grid::{BoxGrid, PointLocation};
use crate::operator::BoxOperator;

/// The static solution of Lu + f = 0 on a box whose opposite faces are identified; planned once.
///
/// The samples are at cells: n points a side L = n h apart. The mean of the force must be zero, because nothing holds the
/// body; the mean of the solution is zero. The highest mode of an even number of points has no derivative there and takes its
/// part of the coupling as zero.
///
/// # Example
/// A wave of shear: μu″ + f = 0.
/// ```
/// use piola_spectral::{BoxGrid, BoxOperator, LameParameters, PeriodicSolver};
/// use std::f64::consts::PI;
/// let grid = BoxGrid::cells([6, 8], [1.0, 0.125])?;
/// let operator = BoxOperator::elastic(LameParameters::new(1.0, 0.5)?);
/// let mut solver = PeriodicSolver::<f64, 2>::new(grid, operator)?;
/// let mut x: Vec<f64> = (0..grid.len()).map(|p| (2.0 * PI * grid.position(grid.indices(p))[1]).sin()).collect();
/// let (force, mut y) = (x[3], vec![0.0; grid.len()]);
/// solver.solve_in_place([&mut x, &mut y])?;
/// assert!((x[3] - force / (2.0 * PI * PI)).abs() < 1e-16);
/// # Ok::<(), piola_spectral::SpectralError>(())
/// ```
///
/// # Source
/// B(4.79) with periodic fields.
pub struct PeriodicSolver<T, const D: usize> {
    grid: BoxGrid<D>,
    operator: BoxOperator,
    plans: [[Arc<dyn Fft<T>>; 2]; D],
    fields: [Vec<Complex<T>>; D],
    line: Vec<Complex<T>>,
    scratch: Vec<Complex<T>>,
}

impl<T, const D: usize> fmt::Debug for PeriodicSolver<T, D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut debug = f.debug_struct("PeriodicSolver");
        debug.field("grid", &self.grid).field("operator", &self.operator).finish_non_exhaustive()
    }
}

impl<T: Precision, const D: usize> PeriodicSolver<T, D> {
    /// Plans the solution on a grid of cells.
    ///
    /// # Errors
    /// A grid of nodes: its first and last points would be the same.
    pub fn new(grid: BoxGrid<D>, operator: BoxOperator) -> Result<Self, SpectralError> {
        if grid.location() != PointLocation::Cells {
            return Err(SpectralError::OtherGrid { quantity: "periodic field" });
        }
        let mut planner = FftPlanner::new();
        let plans = grid.points().map(|n| [planner.plan_fft_forward(n), planner.plan_fft_inverse(n)]);
        let zero = Complex::new(T::lit(0.0), T::lit(0.0));
        let longest = grid.points().into_iter().max().unwrap_or(0);
        let scratch = plans.iter().flatten().map(|plan| plan.get_inplace_scratch_len()).max().unwrap_or(0);
        let fields = std::array::from_fn(|_| vec![zero; grid.len()]);
        Ok(Self { grid, operator, plans, fields, line: vec![zero; longest], scratch: vec![zero; scratch] })
    }

    /// The grid.
    #[must_use]
    pub fn grid(&self) -> &BoxGrid<D> {
        &self.grid
    }

    /// Replaces the force by the displacement.
    ///
    /// # Errors
    /// A list of the wrong length; a force that is not finite; a force whose mean exceeds the rounding of its sum.
    pub fn solve_in_place(&mut self, fields: [&mut [T]; D]) -> Result<(), SpectralError> {
        let count = self.grid.len();
        for (component, field) in fields.iter().enumerate() {
            check_length("force", field.len(), count)?;
            let (mut sum, mut largest) = (0.0_f64, 0.0_f64);
            for (index, value) in field.iter().enumerate() {
                let value = value.primal(0);
                if !value.is_finite() {
                    return Err(SpectralError::NotFinite { quantity: "force", index, value });
                }
                sum += value;
                largest = largest.max(value.abs());
            }
            let mean = sum / count as f64;
            // The samples themselves are rounded.
            if 16.0 * T::unit_roundoff() * largest < mean.abs() {
                return Err(SpectralError::UnbalancedForce { component, mean, largest });
            }
        }
        let zero = T::lit(0.0);
        for (copy, field) in self.fields.iter_mut().zip(&fields) {
            for (copy, value) in copy.iter_mut().zip(field.iter()) {
                *copy = Complex::new(*value, zero);
            }
        }
        self.transform(0);
        self.solve_modes();
        self.transform(1);
        for (copy, field) in self.fields.iter().zip(fields) {
            for (copy, value) in copy.iter().zip(field) {
                *value = copy.re;
            }
        }
        Ok(())
    }

    /// Forward (0) or backward (1) along all axes.
    fn transform(&mut self, direction: usize) {
        let points = self.grid.points();
        for field in &mut self.fields {
            for (axis, plans) in self.plans.iter().enumerate() {
                let stride: usize = points[axis + 1..].iter().product();
                let line = &mut self.line[..points[axis]];
                for block in field.chunks_exact_mut(points[axis] * stride) {
                    for first in 0..stride {
                        for (entry, value) in line.iter_mut().zip(block[first..].iter().step_by(stride)) {
                            *entry = *value;
                        }
                        plans[direction].process_with_scratch(line, &mut self.scratch);
                        for (entry, value) in line.iter().zip(block[first..].iter_mut().step_by(stride)) {
                            *value = *entry;
                        }
                    }
                }
            }
        }
    }

    fn solve_modes(&mut self) {
        let (points, sides) = (self.grid.points(), self.grid.sides());
        let share = 1.0 / self.grid.len() as f64;
        for position in 0..self.grid.len() {
            let indices = self.grid.indices(position);
            // The wave vector, and what of it couples components: nothing along an axis of the highest mode.
            let mut q = [0.0; D];
            let mut coupling = [0.0; D];
            for axis in 0..D {
                let (index, n) = (indices[axis], points[axis]);
                let number = if 2 * index <= n { index as f64 } else { -((n - index) as f64) };
                q[axis] = 2.0 * PI * number / sides[axis];
                coupling[axis] = if 2 * index == n { 0.0 } else { q[axis] };
            }
            let squared: f64 = q.iter().map(|q| q * q).sum();
            if squared == 0.0 {
                for field in &mut self.fields {
                    field[position] = Complex::new(T::lit(0.0), T::lit(0.0));
                }
                continue;
            }
            let [along, across] = self.operator.eigenvalues(squared).map(|kappa| -1.0 / kappa);
            let force = self.fields.each_ref().map(|field| field[position]);
            let mut projected = Complex::new(T::lit(0.0), T::lit(0.0));
            for component in 0..D {
                projected = projected + force[component] * T::lit(coupling[component] / squared);
            }
            for component in 0..D {
                // The highest mode alone is its own wave: its square along its axis counts.
                let own = q[component] - coupling[component];
                let part = projected * T::lit(coupling[component]) + force[component] * T::lit(own * own / squared);
                self.fields[component][position] =
                    force[component] * T::lit(share * across) + part * T::lit(share * (along - across));
            }
        }
    }
}
