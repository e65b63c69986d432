//! Convergence of static solutions.

use std::f64::consts::PI;

use piola_spectral::{BoxGrid, BoxOperator, BoxSolver, Walls};
use piola_testkit::{Tol, assert_close, assert_order, relative_error, smooth_cube};

use super::fixtures::{lame, samples, slices};

fn force(x: [f64; 3]) -> [f64; 3] {
    smooth_cube::force([lame().first(), lame().shear_modulus()], x)
}

fn error(grid: BoxGrid<3>) -> f64 {
    let mut fields = samples::<f64, 3>(&grid, force);
    let mut solver = BoxSolver::<f64, 3>::new(grid, Walls::Sliding, BoxOperator::elastic(lame())).expect("plan");
    solver.solve_in_place(slices(&mut fields)).expect("solution");
    relative_error(&fields.concat(), &samples::<f64, 3>(&grid, smooth_cube::displacement).concat())
}

#[test]
fn smooth_problems_converge_spectrally() {
    let cells = [4, 8, 12, 16, 24].map(|n| error(BoxGrid::cells([n; 3], [1.0 / n as f64; 3]).expect("grid")));
    let nodes = [4, 8, 12, 16, 24].map(|n| error(BoxGrid::nodes([n + 1; 3], [1.0 / n as f64; 3]).expect("grid")));
    for errors in [cells, nodes] {
        for pair in errors[..4].windows(2) {
            assert!(pair[1] < 0.1 * pair[0], "a factor of ten for four more points: {errors:?}");
        }
        assert!(errors[4] < 1e-12, "{errors:?}");
    }
}

#[test]
fn single_precision_equals_double_to_its_rounding() {
    let grid = BoxGrid::cells([16, 12, 24], [1.0 / 16.0, 1.0 / 12.0, 1.0 / 24.0]).expect("grid");
    let mut fields = samples::<f32, 3>(&grid, force);
    let mut solver = BoxSolver::<f32, 3>::new(grid, Walls::Sliding, BoxOperator::elastic(lame())).expect("plan");
    solver.solve_in_place(slices(&mut fields)).expect("solution");
    let wide: Vec<f64> = fields.concat().into_iter().map(f64::from).collect();
    let mut doubles = samples::<f64, 3>(&grid, force);
    let mut solver = BoxSolver::<f64, 3>::new(grid, Walls::Sliding, BoxOperator::elastic(lame())).expect("plan");
    solver.solve_in_place(slices(&mut doubles)).expect("solution");
    assert_close("f32", &wide, &doubles.concat(), Tol::ulps32(16.0));
}

#[test]
fn uniform_force_is_lifted_exactly() {
    let mut compared = 0;
    for grid in [BoxGrid::nodes([9, 7, 5], [0.25, 0.5, 0.5]), BoxGrid::cells([8, 7, 5], [0.25, 0.5, 0.5])] {
        let grid = grid.expect("grid");
        let mut fields = samples::<f64, 3>(&grid, |_| [1.5, 0.0, 0.0]);
        let mut solver = BoxSolver::<f64, 3>::new(grid, Walls::Sliding, BoxOperator::elastic(lame())).expect("plan");
        let walls = solver.solve_lifted_in_place(slices(&mut fields)).expect("solution");
        assert_close("walls", walls.largest.as_flattened(), &[1.5, 1.5, 0.0, 0.0, 0.0, 0.0], Tol::ulps(4.0));
        // (λ + 2μ) u″ + f = 0 between 0 and 2.
        let expected = samples::<f64, 3>(&grid, |x| [0.25 * x[0] * (2.0 - x[0]), 0.0, 0.0]);
        assert_close("u", &fields.concat(), &expected.concat(), Tol::ulps(32.0));
        compared += 1;
    }
    assert_eq!(compared, 2);
}

/// The largest change of the displacement at common nodes between n and 2n intervals.
fn change(intervals: usize, is_lifted: bool) -> f64 {
    let solution = |n: usize| {
        let grid = BoxGrid::nodes([n + 1; 2], [1.0 / n as f64; 2]).expect("grid");
        let mut fields = samples::<f64, 2>(&grid, |x| [(1.0 + x[0] * x[0]) * (PI * x[1]).cos(), 0.0]);
        let mut solver = BoxSolver::<f64, 2>::new(grid, Walls::Sliding, BoxOperator::elastic(lame())).expect("plan");
        if is_lifted {
            solver.solve_lifted_in_place(slices(&mut fields)).expect("solution");
        } else {
            solver.solve_in_place(slices(&mut fields)).expect("solution");
        }
        fields
    };
    let (coarse, fine) = (solution(intervals), solution(2 * intervals));
    let mut largest = 0.0_f64;
    for row in 0..=intervals {
        for column in 0..=intervals {
            for component in 0..2 {
                let far = fine[component][2 * row * (2 * intervals + 1) + 2 * column];
                largest = largest.max((coarse[component][row * (intervals + 1) + column] - far).abs());
            }
        }
    }
    largest
}

#[test]
fn lifted_forces_converge_with_order_four() {
    let intervals = [16, 32, 64];
    let steps = intervals.map(|n| 1.0 / n as f64);
    assert_order("plain", &steps, &intervals.map(|n| change(n, false)), 2.0, 0.3);
    assert_order("lifted", &steps, &intervals.map(|n| change(n, true)), 4.0, 0.4);
}

/// u = (x(1 − x) cc, q φ sc, r φ cs) with sines and cosines of qy and rz, φ′ = κx(1 − x) and κ = (λ + μ)/μ: the force is
/// normal to the walls x = 0 and x = 1, and varies along them. ∇·u = (1 − 2x + (q² + r²)φ) cc.
fn varies_along_the_wall([x, y, z]: [f64; 3]) -> [[f64; 3]; 2] {
    let (mu, coupling) = (lame().shear_modulus(), lame().first() + lame().shear_modulus());
    let (q, r, kappa) = (2.0 * PI, PI, coupling / mu);
    let squared = q * q + r * r;
    let (normal, slope, second) = (x * (1.0 - x), 1.0 - 2.0 * x, -2.0);
    let phi = [kappa * x * x * (0.5 - x / 3.0), kappa * x * (1.0 - x), kappa * (1.0 - 2.0 * x)];
    let waves = [(q * y).cos() * (r * z).cos(), q * (q * y).sin() * (r * z).cos(), r * (q * y).cos() * (r * z).sin()];
    // −f = μΔu + (λ + μ)∇(∇·u).
    let across = mu * (second - squared * normal) + coupling * (second + squared * phi[1]);
    let along = mu * (phi[2] - squared * phi[0]) - coupling * (slope + squared * phi[0]);
    let (displacement, force) = ([normal, phi[0], phi[0]], [-across, -along, -along]);
    [displacement, force].map(|profile| std::array::from_fn(|c| profile[c] * waves[c]))
}

/// Such a displacement is a sum of those that are split off: polynomials across the box, one wave along the walls. So it has no error but
/// rounding, on nodes and on few of them.
#[test]
fn forces_of_one_wave_along_the_wall_are_lifted_exactly() {
    let grid = BoxGrid::nodes([9, 9, 6], [0.125, 0.125, 0.2]).expect("grid");
    let mut fields = samples::<f64, 3>(&grid, |x| varies_along_the_wall(x)[1]);
    let mut solver = BoxSolver::<f64, 3>::new(grid, Walls::Sliding, BoxOperator::elastic(lame())).expect("plan");
    let walls = solver.solve_lifted_in_place(slices(&mut fields)).expect("solution");
    // −(λ + 2μ) ∂²u/∂x² at the walls, where u and φ′ vanish.
    assert_close("walls", &walls.largest[0], &[2.0 * lame().longitudinal_modulus(); 2], Tol::ulps(8.0));
    let expected = samples::<f64, 3>(&grid, |x| varies_along_the_wall(x)[0]);
    assert_close("u", &fields.concat(), &expected.concat(), Tol::ulps(32.0));
}
