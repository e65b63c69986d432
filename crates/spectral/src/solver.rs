//! Static solutions on a grid.

use crate::error::{SpectralError, check_length};
use crate::grid::BoxGrid;
use crate::modal::Modes;
use crate::operator::BoxOperator;
use crate::passes::{Memory, Plans, Task};
use crate::transform::{Direction, LinePlan};
use crate::walls::Walls;
use crate::waves::AxisWaves;
use crate::Precision;

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
    /// # Errors
    /// A list of the wrong length; a force that is not finite: the fields are then partly overwritten.
    pub fn solve_in_place(&mut self, fields: [&mut [T]; D]) -> Result<(), SpectralError> {
        let mut fields = fields;
        self.check_lengths("force", &fields)?;
        for (component, field) in fields.iter_mut().enumerate() {
            self.plans.pass_in_slabs(component, Direction::ToModes, field, Some("force"), &mut self.memory)?;
        }
        self.plans.pass_along_first(Task::Solve, &self.modes, fields.each_mut().map(|field| &mut **field), &mut self.memory);
        for (component, field) in fields.iter_mut().enumerate() {
            self.plans.pass_in_slabs(component, Direction::ToSamples, field, None, &mut self.memory)?;
        }
        Ok(())
    }

    fn check_lengths(&self, quantity: &'static str, fields: &[&mut [T]; D]) -> Result<(), SpectralError> {
        fields.iter().try_for_each(|field| check_length(quantity, field.len(), self.grid.len()))
    }
}
