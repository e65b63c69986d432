//! The operator of the model: from forces to displacements or velocities.

use piola_spectral::{BoxGrid, BoxOperator, BoxSolver, LameParameters, Precision, Walls};

use crate::error::RegistrationError;
use crate::grid::ImageGrid;
use crate::model::RegistrationModel;
use crate::parallel::each;

#[derive(Debug)]
/// The solver of Lu + f = 0 on a grid, with its memory.
pub(crate) struct Response<const D: usize, T> {
    solver: BoxSolver<T, D>,
    components: [Vec<T>; D],
}

impl<const D: usize, T: Precision> Response<D, T> {
    /// Plans the solution for `model` on `grid`.
    pub(crate) fn new(grid: &ImageGrid<D>, model: &RegistrationModel) -> Result<Self, RegistrationError> {
        let [first, shear] = model.parameters();
        let operator = BoxOperator::elastic(LameParameters::new(first, shear)?);
        let solver = BoxSolver::new(BoxGrid::cells(grid.sizes(), grid.spacing())?, Walls::Sliding, operator)?;
        Ok(Self { solver, components: std::array::from_fn(|_| vec![T::zero(); grid.len()]) })
    }

    /// u with Lu + f = 0.
    pub(crate) fn solve(&mut self, force: &[[T; D]], out: &mut [[T; D]]) -> Result<(), RegistrationError> {
        for (axis, component) in self.components.iter_mut().enumerate() {
            each(&mut component[..], &|start, part: &mut [T]| {
                for (position, value) in (start..).zip(part) {
                    *value = force[position][axis];
                }
            });
        }
        self.solver.solve_in_place(self.components.each_mut().map(|component| &mut component[..]))?;
        let components = &self.components;
        each(out, &|start, part: &mut [[T; D]]| {
            for (position, vector) in (start..).zip(part) {
                *vector = std::array::from_fn(|axis| components[axis][position]);
            }
        });
        Ok(())
    }
}
