//! Static solutions of sums of modes, and what is refused.

use piola_spectral::{BoxGrid, BoxOperator, BoxSolver, Walls};
use piola_testkit::{Tol, assert_close};

use super::fixtures::{Wave, lame, samples, slices, sum_of};

/// The rounding of the sums over the lines of three axes, there and back, and of the samples of the waves themselves.
const SUMS: Tol = Tol::ulps(64.0);

fn compare<const D: usize>(grid: BoxGrid<D>, walls: Walls, waves: &[Wave<D>]) {
    let sides = grid.sides();
    let forces: Vec<Wave<D>> = waves.iter().map(|wave| wave.elastic_force(lame(), sides)).collect();
    let mut fields = samples::<f64, D>(&grid, |x| sum_of(&forces, walls, sides, x));
    let expected = samples::<f64, D>(&grid, |x| sum_of(waves, walls, sides, x));
    let mut solver = BoxSolver::<f64, D>::new(grid, walls, BoxOperator::elastic(lame())).expect("plan");
    solver.solve_in_place(slices(&mut fields)).expect("solution");
    assert_close(&format!("{grid:?} {walls:?}"), &fields.concat(), &expected.concat(), SUMS);
}

fn waves_in_space() -> Vec<Wave<3>> {
    let indices = [[1, 2, 1], [2, 1, 3], [0, 1, 2], [3, 0, 1], [1, 1, 0], [0, 0, 2], [0, 3, 0], [1, 0, 0]];
    let wave = |(n, indices): (usize, [usize; 3])| {
        // A component without a sine has no amplitude.
        let amplitude = [0.5 + n as f64, -1.25, 0.75 - 0.5 * n as f64];
        Wave { indices, amplitude }
    };
    indices.into_iter().enumerate().map(wave).collect()
}

/// Components whose sine has index 0 vanish: their amplitude is set to zero.
fn without_vanishing<const D: usize>(walls: Walls, waves: Vec<Wave<D>>) -> Vec<Wave<D>> {
    let zeroed = |mut wave: Wave<D>| {
        for component in 0..D {
            let vanishes = |axis| {
                walls.parity(component, axis) == piola_spectral::Parity::Sine && wave.indices[axis] == 0
            };
            if (0..D).any(vanishes) {
                wave.amplitude[component] = 0.0;
            }
        }
        wave
    };
    waves.into_iter().map(zeroed).collect()
}

#[test]
fn solution_for_the_force_of_modes_equals_modes() {
    let grids = [
        BoxGrid::cells([8, 8, 8], [0.125; 3]),
        BoxGrid::cells([12, 9, 20], [0.1, 0.3, 0.07]),
        BoxGrid::cells([5, 16, 34], [0.2, 0.1, 0.05]),
        BoxGrid::nodes([9, 9, 9], [0.125; 3]),
        BoxGrid::nodes([13, 5, 21], [0.1, 0.3, 0.07]),
        BoxGrid::nodes([24, 17, 6], [0.1, 0.3, 0.07]),
    ];
    for grid in grids {
        let grid = grid.expect("grid");
        for walls in [Walls::Sliding, Walls::Guided] {
            compare(grid, walls, &without_vanishing(walls, waves_in_space()));
        }
    }
}

#[test]
fn solution_in_a_rectangle_equals_modes() {
    let waves = [[1, 2], [3, 1], [0, 2], [2, 0], [4, 4]].map(|indices| Wave { indices, amplitude: [0.5, -1.25] });
    let grids = [
        BoxGrid::cells([8, 16], [0.125, 0.25]),
        BoxGrid::cells([37, 11], [0.1, 0.3]),
        BoxGrid::nodes([9, 33], [0.1, 0.3]),
        BoxGrid::nodes([64, 10], [0.1, 0.3]),
    ];
    for grid in grids {
        let grid = grid.expect("grid");
        for walls in [Walls::Sliding, Walls::Guided] {
            compare(grid, walls, &without_vanishing(walls, waves.to_vec()));
        }
    }
}
