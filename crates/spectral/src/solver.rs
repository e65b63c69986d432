//! Static solutions on a grid.

use crate::Precision;
use crate::basis::{ModalSeries, is_same_box};
use crate::error::{SpectralError, check_length};
use crate::grid::{BoxGrid, PointLocation};
use crate::lift::NormalForces;
use crate::modal::Modes;
use crate::operator::{BoxOperator, LameParameters};
use crate::passes::{Memory, Plans, Task};
use crate::transform::{Direction, LinePlan};
use crate::walls::Walls;
use crate::waves::AxisWaves;

/// The force normal to the walls, where the modes of sliding walls have none.
///
/// # Example
/// ```
/// use piola_spectral::WallForces;
/// let forces = WallForces { largest: [[1.0, 0.5], [0.0, 2.0]] };
/// assert_eq!(forces.overall(), 2.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallForces<const D: usize> {
    /// The largest |f·n| on the near and the far wall of each axis, N/m³.
    pub largest: [[f64; 2]; D],
}

impl<const D: usize> WallForces<D> {
    /// The largest on all walls.
    #[must_use]
    pub fn overall(&self) -> f64 {
        self.largest.iter().flatten().copied().fold(0.0, f64::max)
    }
}

/// The static solution of Lu + f = 0 on a grid: planned once, in place, in O(n log n) for n points.
///
/// The samples of each component are a list in the order of the grid: the last index runs fastest. The solution is the
/// exact one for the force that interpolates the samples by sines and cosines, so it converges faster than any power of the
/// spacing when the force is smooth and obeys the walls.
///
/// | symbol | argument | shape | unit |
/// |---|---|---|---|
/// | f | `fields`, on entry | D lists of samples | N/m³ (membrane: N/m³, plate: N/m²) |
/// | u | `fields`, on return | D lists of samples | m (fluid: m/s) |
///
/// # Example
/// A bar between sliding walls, pulled by f = sin πx: (λ + 2μ) u″ + f = 0, so u = f/((λ + 2μ)π²).
/// ```
/// use piola_spectral::{BoxGrid, BoxOperator, BoxSolver, LameParameters, Walls};
/// use std::f64::consts::PI;
///
/// let grid = BoxGrid::cells([16, 8, 8], [1.0 / 16.0, 0.5, 0.5])?;
/// let operator = BoxOperator::elastic(LameParameters::new(2.0, 1.0)?);
/// let mut solver = BoxSolver::<f64, 3>::new(grid, Walls::Sliding, operator)?;
///
/// let force = |position: usize| (PI * grid.position(grid.indices(position))[0]).sin();
/// let mut x: Vec<f64> = (0..grid.len()).map(force).collect();
/// let (mut y, mut z) = (vec![0.0; grid.len()], vec![0.0; grid.len()]);
/// solver.solve_in_place([&mut x, &mut y, &mut z])?;
/// assert!((x[0] - force(0) / (4.0 * PI * PI)).abs() < 1e-17);
/// # Ok::<(), piola_spectral::SpectralError>(())
/// ```
///
/// # Accuracy
/// Some 16 ulp of the largest displacement.
///
/// # Source
/// B(4.79), B(4.100).
#[derive(Clone, Debug)]
pub struct BoxSolver<T, const D: usize> {
    grid: BoxGrid<D>,
    walls: Walls,
    operator: BoxOperator,
    plans: Plans<T, D>,
    modes: Modes<T, D>,
    memory: Memory<T>,
}

impl<T: Precision, const D: usize> BoxSolver<T, D> {
    /// Plans the solution on a grid.
    ///
    /// # Errors
    /// None today: grid and operator have been checked.
    pub fn new(grid: BoxGrid<D>, walls: Walls, operator: BoxOperator) -> Result<Self, SpectralError> {
        Ok(Self::planned(grid, walls, operator, [usize::MAX; D]))
    }

    /// The same with modes up to these indices only: 0 ≤ i ≤ `highest`.
    ///
    /// # Source
    /// The N of B(4.96).
    #[must_use]
    pub fn with_truncation(self, highest: [usize; D]) -> Self {
        Self::planned(self.grid, self.walls, self.operator, highest)
    }

    fn planned(grid: BoxGrid<D>, walls: Walls, operator: BoxOperator, highest: [usize; D]) -> Self {
        let points = grid.points();
        let lines = points.map(|points| LinePlan::new(points, grid.location()));
        let plans = Plans { lines, points, walls };
        let axes = std::array::from_fn(|axis| AxisWaves::new(&grid, axis, highest[axis]));
        let modes = Modes::new(axes, walls, &operator);
        let memory = plans.memory();
        Self { grid, walls, operator, plans, modes, memory }
    }

    /// The grid.
    #[must_use]
    pub fn grid(&self) -> &BoxGrid<D> {
        &self.grid
    }

    /// What the walls hold.
    #[must_use]
    pub fn walls(&self) -> Walls {
        self.walls
    }

    /// The operator.
    #[must_use]
    pub fn operator(&self) -> &BoxOperator {
        &self.operator
    }

    /// Replaces the force by the displacement.
    ///
    /// The force that counts is the sum of modes that interpolates the samples. At nodes, samples of components whose sine
    /// vanishes at a wall are ignored there: see [`solve_lifted_in_place`](Self::solve_lifted_in_place).
    ///
    /// # Errors
    /// A list of the wrong length; a force that is not finite: the fields are then partly overwritten.
    pub fn solve_in_place(&mut self, fields: [&mut [T]; D]) -> Result<(), SpectralError> {
        let mut fields = fields;
        self.check_lengths("force", &fields)?;
        for (component, field) in fields.iter_mut().enumerate() {
            self.plans.pass_in_slabs(component, Direction::ToModes, field, Some("force"), &mut self.memory)?;
        }
        self.plans.pass_along_first(Task::Solve, &self.modes, reborrow(&mut fields), &mut self.memory);
        for (component, field) in fields.iter_mut().enumerate() {
            self.plans.pass_in_slabs(component, Direction::ToSamples, field, None, &mut self.memory)?;
        }
        Ok(())
    }

    /// Replaces the force by the displacement, with what the force has normal to sliding walls treated apart.
    ///
    /// Sines vanish at the walls and approach a force that does not vanish there slowly. This method splits off a displacement
    /// that balances the force at the walls, and reports the force there. At cells the force at the walls is continued from
    /// the three nearest cells. It takes some more passes over the memory. For plates and guided walls it only reports.
    ///
    /// # Errors
    /// As of [`solve_in_place`](Self::solve_in_place).
    ///
    /// # Accuracy
    /// Order 4 in the spacing instead of 2, when the tangential force has no normal derivative at the walls; exact for a
    /// uniform force.
    pub fn solve_lifted_in_place(&mut self, fields: [&mut [T]; D]) -> Result<WallForces<D>, SpectralError> {
        let mut fields = fields;
        self.check_lengths("force", &fields)?;
        for field in &fields {
            let found = field.iter().position(|value| !value.primal(0).is_finite());
            if let Some(index) = found {
                return Err(SpectralError::NotFinite { quantity: "force", index, value: field[index].primal(0) });
            }
        }
        let forces: [NormalForces<T>; D] = std::array::from_fn(|axis| NormalForces::of(&self.grid, axis, fields[axis]));
        let report = WallForces { largest: forces.each_ref().map(NormalForces::largest) };
        let is_lifted = self.walls == Walls::Sliding && self.operator.order == 1;
        if !is_lifted {
            self.solve_in_place(fields)?;
            return Ok(report);
        }
        let mut slopes = Vec::with_capacity(D);
        for forces in &forces {
            let (grid, operator) = (&self.grid, &self.operator);
            let axes = &self.modes.axes;
            slopes.push(forces.balance(grid, operator, &self.plans, axes, &mut fields, &mut self.memory));
        }
        self.solve_in_place(reborrow(&mut fields))?;
        for (forces, slopes) in forces.iter().zip(&slopes) {
            forces.add_to(slopes, &self.grid, &self.operator, &mut fields);
        }
        Ok(report)
    }

    /// The modes of sampled fields.
    ///
    /// # Errors
    /// A list of the wrong length; a value that is not finite.
    pub fn series_of(&mut self, fields: [&[T]; D]) -> Result<ModalSeries<D>, SpectralError> {
        let highest = self.grid.points().map(|points| match self.grid.location() {
            PointLocation::Cells => points,
            PointLocation::Nodes => points - 1,
        });
        let mut series = ModalSeries::zeros(self.grid.sides(), self.walls, highest)?;
        let mut copies = fields.map(<[T]>::to_vec);
        let mut copies = copies.each_mut().map(Vec::as_mut_slice);
        self.check_lengths("field", &copies)?;
        for (component, field) in copies.iter_mut().enumerate() {
            self.plans.pass_in_slabs(component, Direction::ToModes, field, Some("field"), &mut self.memory)?;
        }
        self.plans.pass_along_first(Task::Analyse, &self.modes, reborrow(&mut copies), &mut self.memory);
        for position in 0..self.grid.len() {
            for component in 0..D {
                if let Some((indices, factor)) = self.mode_at(component, position) {
                    let place = series.position(indices).unwrap_or(0);
                    series.amplitudes[component][place] = factor * copies[component][position].primal(0);
                }
            }
        }
        Ok(series)
    }

    /// Samples a series at the points of the grid. Modes that the grid cannot tell apart from others are left out.
    ///
    /// # Errors
    /// A list of the wrong length; a series on another box or between other walls.
    pub fn sample_into(&mut self, series: &ModalSeries<D>, fields: [&mut [T]; D]) -> Result<(), SpectralError> {
        let mut fields = fields;
        self.check_lengths("field", &fields)?;
        if !is_same_box(&series.sides(), &self.grid.sides()) || series.walls() != self.walls {
            return Err(SpectralError::OtherGrid { quantity: "series" });
        }
        let scale: f64 = (0..D).map(|axis| 2.0 / self.grid.intervals(axis) as f64).product();
        for position in 0..self.grid.len() {
            for (component, field) in fields.iter_mut().enumerate() {
                let mode = self.mode_at(component, position);
                let amplitude =
                    mode.map_or(0.0, |(indices, factor)| series.amplitudes(indices)[component] * scale / factor);
                field[position] = T::lit(amplitude);
            }
        }
        self.plans.pass_along_first(Task::Synthesise, &self.modes, reborrow(&mut fields), &mut self.memory);
        for (component, field) in fields.iter_mut().enumerate() {
            self.plans.pass_in_slabs(component, Direction::ToSamples, field, None, &mut self.memory)?;
        }
        Ok(())
    }

    /// The indices of the mode of a component at a position of the transformed samples, and what makes an amplitude of it.
    fn mode_at(&self, component: usize, position: usize) -> Option<([usize; D], f64)> {
        let indices = self.modes.indices(component, self.grid.indices(position))?;
        let parity = |axis| self.walls.parity(component, axis);
        let factor = (0..D).map(|axis| self.modes.axes[axis].amplitude(indices[axis], parity(axis))).product();
        Some((indices, factor))
    }

    /// The gradient of sampled fields, the derivative of component c along axis b into `gradient[c][b]`: exact for the sum of modes that interpolates the
    /// samples.
    ///
    /// # Errors
    /// A list of the wrong length.
    pub fn gradient_into(&mut self, fields: [&[T]; D], gradient: &mut [[Vec<T>; D]; D]) -> Result<(), SpectralError> {
        for field in fields {
            check_length("field", field.len(), self.grid.len())?;
        }
        for list in gradient.iter().flatten() {
            check_length("gradient", list.len(), self.grid.len())?;
        }
        self.differentiate(fields, gradient);
        Ok(())
    }

    /// The linear strain ½(∇u + ∇uᵀ) of sampled displacements.
    ///
    /// # Errors
    /// A list of the wrong length.
    ///
    /// # Source
    /// B(4.71).
    pub fn strain_into(&mut self, fields: [&[T]; D], strain: &mut [[Vec<T>; D]; D]) -> Result<(), SpectralError> {
        self.gradient_into(fields, strain)?;
        let a_half = T::lit(0.5);
        for row in 0..D {
            for column in 0..row {
                for point in 0..self.grid.len() {
                    let mean = a_half * (strain[row][column][point] + strain[column][row][point]);
                    strain[row][column][point] = mean;
                    strain[column][row][point] = mean;
                }
            }
        }
        Ok(())
    }

    /// The stress λ tr ε 1 + 2μ ε of sampled displacements, Pa. In a rectangle: plane strain.
    ///
    /// # Errors
    /// A list of the wrong length.
    ///
    /// # Source
    /// B(4.76).
    pub fn stress_into(
        &mut self,
        lame: LameParameters,
        fields: [&[T]; D],
        stress: &mut [[Vec<T>; D]; D],
    ) -> Result<(), SpectralError> {
        self.strain_into(fields, stress)?;
        let (first, twice) = (T::lit(lame.first()), T::lit(2.0 * lame.shear_modulus()));
        for point in 0..self.grid.len() {
            let dilatation = (0..D).fold(T::lit(0.0), |sum, axis| sum + stress[axis][axis][point]);
            for row in 0..D {
                for column in 0..D {
                    let isotropic = if row == column { first * dilatation } else { T::lit(0.0) };
                    stress[row][column][point] = isotropic + twice * stress[row][column][point];
                }
            }
        }
        Ok(())
    }

    /// The derivative of component c along axis b into `gradient[c][b]`, with lengths that have been checked.
    pub(crate) fn differentiate(&mut self, fields: [&[T]; D], gradient: &mut [[Vec<T>; D]; D]) {
        for component in 0..D {
            for axis in 0..D {
                let (waves, into) = (&self.modes.axes[axis], &mut gradient[component][axis]);
                self.plans.differentiate(waves, component, axis, fields[component], into, &mut self.memory);
            }
        }
    }

    fn check_lengths(&self, quantity: &'static str, fields: &[&mut [T]; D]) -> Result<(), SpectralError> {
        fields.iter().try_for_each(|field| check_length(quantity, field.len(), self.grid.len()))
    }
}

fn reborrow<'a, T, const D: usize>(fields: &'a mut [&mut [T]; D]) -> [&'a mut [T]; D] {
    fields.each_mut().map(|field| &mut **field)
}
