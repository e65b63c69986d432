//! No solution allocates.

use piola_spectral::{BoxGrid, BoxOperator, BoxSolver, Walls};
use piola_testkit::allocations_in;

use super::fixtures::{lame, samples, slices};

#[test]
fn static_solution_allocates_nothing() {
    let mut runs = 0;
    for grid in [BoxGrid::cells([16, 12, 10], [0.1; 3]), BoxGrid::nodes([9, 17, 13], [0.1; 3])] {
        let grid = grid.expect("grid");
        let mut solver = BoxSolver::<f64, 3>::new(grid, Walls::Sliding, BoxOperator::elastic(lame())).expect("plan");
        let mut fields = samples::<f64, 3>(&grid, |x| [x[0].sin(), x[1], x[2] * x[0]]);
        let (count, result) = allocations_in(|| solver.solve_in_place(slices(&mut fields)));
        assert!(result.is_ok());
        assert_eq!(count, 0);
        runs += 1;
    }
    assert_eq!(runs, 2);
}
