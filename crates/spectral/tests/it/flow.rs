//! Creeping flow against the exact map of a steady velocity.

use std::f64::consts::PI;

use piola_spectral::{BoxGrid, BoxOperator, BoxSolver, ViscousFlow, Walls};
use piola_testkit::{Tol, assert_close, assert_order};

use super::fixtures::{lame, samples, slices};

fn flow(points: usize) -> (BoxGrid<2>, ViscousFlow<f64, 2>) {
    let grid = BoxGrid::cells([points, 6], [1.0 / points as f64, 0.25]).expect("grid");
    let solver = BoxSolver::<f64, 2>::new(grid, Walls::Sliding, BoxOperator::elastic(lame())).expect("plan");
    (grid, ViscousFlow::new(solver, 0.5).expect("flow"))
}

/// Where the particle at x was at t = 0 when its velocity was sin πx: tan(πX/2) = e^{−πt} tan(πx/2).
fn start_of(x: f64, t: f64) -> f64 {
    2.0 / PI * ((PI * x / 2.0).tan() * (-PI * t).exp()).atan()
}

/// The largest error of the displacement at t = 0.15, before any regridding.
fn error(points: usize, steps: usize) -> f64 {
    let (grid, mut flow) = flow(points);
    let v = samples::<f64, 2>(&grid, |x| [(PI * x[0]).sin(), 0.0]);
    let t = 0.15;
    for _ in 0..steps {
        flow.step([&v[0], &v[1]], t / steps as f64).expect("step");
    }
    assert_eq!(flow.regriddings(), 0);
    let errors = (0..grid.len()).map(|point| {
        let x = grid.position(grid.indices(point))[0];
        (flow.displacement()[0][point] - (x - start_of(x, t))).abs()
    });
    errors.fold(0.0, f64::max)
}

#[test]
fn displacement_of_a_steady_flow_converges_with_order_four_in_time() {
    let steps = [8, 16, 32];
    let errors = steps.map(|steps| error(32, steps));
    assert_order("time", &steps.map(|steps| 0.15 / steps as f64), &errors, 4.0, 0.3);
    assert!(errors[2] < 1e-8, "{errors:?}");
}

/// The largest error of the composed map at t = 0.6, after several regriddings, and their number.
fn error_of_the_composition(points: usize) -> (f64, usize) {
    let (grid, mut flow) = flow(points);
    let v = samples::<f64, 2>(&grid, |x| [(PI * x[0]).sin(), 0.0]);
    let steps = 4 * points;
    for _ in 0..steps {
        let report = flow.step([&v[0], &v[1]], 0.6 / steps as f64).expect("step");
        assert!(0.5 < report.least_jacobian && report.largest_courant_number < 0.8);
    }
    let (mut largest, mut least) = (0.0_f64, f64::INFINITY);
    for n in 1..100 {
        let x = f64::from(n) / 100.0;
        let actual = flow.reference_position([x, 0.7]).expect("place");
        largest = largest.max((actual[0] - start_of(x, 0.6)).abs());
        assert_close("across", &[actual[1]], &[0.7], Tol::ulps(8.0));
        least = least.min((start_of(x + 1e-4, 0.6) - start_of(x - 1e-4, 0.6)) / 2e-4);
    }
    let certified = flow.certified_jacobian();
    // The product of the least values of the pieces is below the least of the product, but for sampling at other places.
    assert!(0.0 < certified && certified < 1.01 * least, "{certified} {least}");
    (largest, flow.regriddings())
}

#[test]
fn composition_of_the_maps_converges_with_order_four_in_space() {
    let points = [32, 64, 128];
    let results = points.map(error_of_the_composition);
    assert!(results.iter().all(|&(_, regriddings)| 2 <= regriddings), "{results:?}");
    assert_order("space", &points.map(|n| 1.0 / n as f64), &results.map(|(error, _)| error), 4.0, 0.6);
    assert!(results[2].0 < 1e-5, "{results:?}");
}

#[test]
fn velocity_equals_the_displacement_of_the_elastic_box() {
    let (grid, mut flow) = flow(16);
    let force = |x: [f64; 2]| [(PI * x[0]).sin(), (PI * x[1] / 1.5).sin()];
    let (mut one, mut other) = (samples::<f64, 2>(&grid, force), samples::<f64, 2>(&grid, force));
    flow.velocity_in_place(slices(&mut one)).expect("velocity");
    let mut solver = BoxSolver::<f64, 2>::new(grid, Walls::Sliding, BoxOperator::elastic(lame())).expect("plan");
    solver.solve_in_place(slices(&mut other)).expect("solution");
    assert_eq!(one, other);
}
