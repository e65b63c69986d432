//! Static solutions on a periodic box.

use std::f64::consts::PI;

use piola_spectral::{BoxGrid, BoxOperator, PeriodicSolver, SpectralError};
use piola_testkit::{Tol, assert_close};

use super::fixtures::{lame, samples, slices};

/// u = a sin(q·x + phase) has −Lu = (μ q² a + (λ + μ) q (q·a)) sin(q·x + phase).
#[test]
fn solution_for_the_force_of_plane_waves_equals_waves() {
    let waves = [
        ([1.0, 2.0, -1.0], [0.5, -1.0, 2.0], 0.3),
        ([0.0, 1.0, 3.0], [1.0, 0.0, -0.5], 1.1),
        ([-2.0, 0.0, 0.0], [1.0, 2.0, 3.0], 0.0),
    ];
    let mut compared = 0;
    for points in [[8, 8, 8], [9, 7, 11], [6, 10, 13]] {
        let grid = BoxGrid::cells(points, [0.1, 0.2, 0.15]).expect("grid");
        let sides = grid.sides();
        let field = |x: [f64; 3], is_force: bool| {
            let mut sum = [0.0; 3];
            for (numbers, a, phase) in waves {
                let q: [f64; 3] = std::array::from_fn(|axis| 2.0 * PI * numbers[axis] / sides[axis]);
                let dot = |b: [f64; 3]| q.iter().zip(b).map(|(q, b)| q * b).sum::<f64>();
                let (squared, along, wave) = (dot(q), dot(a), (dot(x) + phase).sin());
                for c in 0..3 {
                    let mu = lame().shear_modulus();
                    let force = mu * squared * a[c] + (lame().first() + mu) * q[c] * along;
                    sum[c] += wave * if is_force { force } else { a[c] };
                }
            }
            sum
        };
        let mut fields = samples::<f64, 3>(&grid, |x| field(x, true));
        let mut solver = PeriodicSolver::<f64, 3>::new(grid, BoxOperator::elastic(lame())).expect("plan");
        solver.solve_in_place(slices(&mut fields)).expect("solution");
        let expected = samples::<f64, 3>(&grid, |x| field(x, false));
        // The forces of the waves differ by the ratio of their stiffnesses, some 60.
        assert_close(&format!("{points:?}"), &fields.concat(), &expected.concat(), Tol::ulps(16.0).times(60.0));
        compared += 1;
    }
    assert_eq!(compared, 3);
}

#[test]
fn unbalanced_forces_and_nodes_are_refused() {
    let operator = BoxOperator::elastic(lame());
    let nodes = BoxGrid::nodes([5, 5], [0.25; 2]).expect("grid");
    let refused = PeriodicSolver::<f64, 2>::new(nodes, operator).err();
    assert_eq!(refused, Some(SpectralError::OtherGrid { quantity: "periodic field" }));
    let grid = BoxGrid::cells([4, 4], [0.25; 2]).expect("grid");
    let mut solver = PeriodicSolver::<f64, 2>::new(grid, operator).expect("plan");
    let mut fields = [vec![0.0; 16], vec![0.5; 16]];
    let refused = solver.solve_in_place(slices(&mut fields)).err();
    assert_eq!(refused, Some(SpectralError::UnbalancedForce { component: 1, mean: 0.5, largest: 0.5 }));
    fields[0][3] = f64::INFINITY;
    let refused = solver.solve_in_place(slices(&mut fields)).err();
    assert_eq!(refused, Some(SpectralError::NotFinite { quantity: "force", index: 3, value: f64::INFINITY }));
}
