//! Static solutions of sums of modes, and what is refused.

use piola_spectral::{BoxGrid, BoxOperator, BoxSolver, Walls};
use piola_testkit::{Tol, assert_close};

use super::fixtures::{Wave, lame, samples, slices, sum_of};

/// The rounding of the sums over the lines of three axes, there and back, and of the samples of the waves themselves, for
/// forces of equal size; forces of stiff modes are larger, and so is their rounding.
const SUMS: Tol = Tol::ulps(16.0);

fn compare<const D: usize>(grid: BoxGrid<D>, walls: Walls, waves: &[Wave<D>]) {
    let sides = grid.sides();
    let squares = waves.iter().map(|wave| wave.wave_vector(sides).iter().map(|q| q * q).sum::<f64>());
    let (least, largest) = squares.fold((f64::MAX, 0.0_f64), |(least, largest), q| (least.min(q), largest.max(q)));
    let forces: Vec<Wave<D>> = waves.iter().map(|wave| wave.elastic_force(lame(), sides)).collect();
    let mut fields = samples::<f64, D>(&grid, |x| sum_of(&forces, walls, sides, x));
    let expected = samples::<f64, D>(&grid, |x| sum_of(waves, walls, sides, x));
    let mut solver = BoxSolver::<f64, D>::new(grid, walls, BoxOperator::elastic(lame())).expect("plan");
    solver.solve_in_place(slices(&mut fields)).expect("solution");
    assert_close(&format!("{grid:?} {walls:?}"), &fields.concat(), &expected.concat(), SUMS.times(largest / least));
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
            let vanishes =
                |axis| walls.parity(component, axis) == piola_spectral::Parity::Sine && wave.indices[axis] == 0;
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

/// Membranes and plates act on each component alone: S q² u = f and B q⁴ u = f.
#[test]
fn membranes_and_plates_divide_by_their_eigenvalues() {
    let waves = [[1, 2], [3, 1], [0, 2], [2, 0], [4, 4]].map(|indices| Wave { indices, amplitude: [0.5, -1.25] });
    let grid = BoxGrid::cells([12, 10], [0.1, 0.15]).expect("grid");
    let sides = grid.sides();
    let mut compared = 0;
    for walls in [Walls::Sliding, Walls::Guided] {
        let waves = without_vanishing(walls, waves.to_vec());
        for (operator, order) in [(BoxOperator::membrane(2.5), 1), (BoxOperator::plate(2.5), 2)] {
            let force = |wave: &Wave<2>| {
                let squared: f64 = wave.wave_vector(sides).iter().map(|q| q * q).sum();
                Wave { amplitude: wave.amplitude.map(|a| 2.5 * squared.powi(order) * a), ..*wave }
            };
            let forces: Vec<Wave<2>> = waves.iter().map(force).collect();
            let mut fields = samples::<f64, 2>(&grid, |x| sum_of(&forces, walls, sides, x));
            let expected = samples::<f64, 2>(&grid, |x| sum_of(&waves, walls, sides, x));
            let mut solver = BoxSolver::<f64, 2>::new(grid, walls, operator.expect("operator")).expect("plan");
            solver.solve_in_place(slices(&mut fields)).expect("solution");
            // The squares of the wave vectors differ by a factor of 14, those of the plate by 200.
            let tol = SUMS.times(14.0_f64.powi(order));
            assert_close(&format!("{walls:?} {order}"), &fields.concat(), &expected.concat(), tol);
            compared += 1;
        }
    }
    assert_eq!(compared, 4);
}

/// The modes up to N are kept, those above are dropped.
#[test]
fn truncated_solution_equals_its_lower_modes() {
    let grid = BoxGrid::cells([8, 8, 8], [0.125; 3]).expect("grid");
    let (low, high) =
        (Wave { indices: [1, 2, 1], amplitude: [1.0, 2.0, -1.0] }, Wave { indices: [1, 3, 1], amplitude: [1.0; 3] });
    let (sides, walls) = (grid.sides(), Walls::Sliding);
    let forces = [low, high].map(|wave| wave.elastic_force(lame(), sides));
    let mut fields = samples::<f64, 3>(&grid, |x| sum_of(&forces, walls, sides, x));
    let solver = BoxSolver::<f64, 3>::new(grid, walls, BoxOperator::elastic(lame())).expect("plan");
    solver.with_truncation([2; 3]).solve_in_place(slices(&mut fields)).expect("solution");
    let expected = samples::<f64, 3>(&grid, |x| low.value(walls, sides, x));
    assert_close("u", &fields.concat(), &expected.concat(), SUMS.times(4.0));
}

/// The pieces of work are the same for any number of threads, and so are the bits.
#[cfg(feature = "rayon")]
#[test]
fn threads_do_not_change_a_bit() {
    let grid = BoxGrid::cells([33, 24, 40], [0.1; 3]).expect("grid");
    let force = |x: [f64; 3]| [x[0].sin() + x[1], x[2] * x[0], (x[1] * x[2]).cos()];
    let solve = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("pool");
        pool.install(|| {
            let mut fields = samples::<f64, 3>(&grid, force);
            let mut solver =
                BoxSolver::<f64, 3>::new(grid, Walls::Sliding, BoxOperator::elastic(lame())).expect("plan");
            solver.solve_in_place(slices(&mut fields)).expect("solution");
            fields
        })
    };
    assert_eq!(solve(1), solve(3));
}
