//! Equilibrium beside closed forms.

use core::f64::consts::PI;

use piola_testkit::{Tol, assert_close, assert_close_at_scale};

use super::{field, in_box, in_rectangle, run};
use crate::support::{assert_small, replaced};

/// λ + 2μ = 5 and μ = 1.5.
const PLATE: &str = r#"
[box]
type = "static"
sides = [2.0, 1.0]
points = [17, 9]
location = "nodes"
first_lame_parameter = 2.0
shear_modulus = 1.5

[[load]]
type = "mode"
indices = [2, 3]
force_per_volume = [1.0, 3.0]
"#;

/// κ of B(4.91) and B(4.102), for sides other than 1.
fn kappa(stiffness: f64, indices: &[f64], sides: &[f64]) -> f64 {
    let squared: f64 = indices.iter().zip(sides).map(|(i, side)| (i / side).powi(2)).sum();
    -PI * PI * stiffness * squared
}

#[test]
fn load_along_its_wave_moves_by_force_over_the_first_eigenvalue() {
    // The wave vector is along (2/2, 3/1) = (1, 3): so is the load.
    let run = run(PLATE);
    let found = field(in_rectangle(&run));
    let factor = -1.0 / kappa(5.0, &[2.0, 3.0], &[2.0, 1.0]);
    let mut expected = [Vec::new(), Vec::new()];
    for point in 0..found.grid.len() {
        let [x, y] = found.grid.position(found.grid.indices(point));
        expected[0].push(factor * (PI * x).sin() * (3.0 * PI * y).cos());
        expected[1].push(3.0 * factor * (PI * x).cos() * (3.0 * PI * y).sin());
    }
    for (found, expected) in found.displacement.iter().zip(&expected) {
        assert_close("u", found, expected, Tol::ulps(64.0));
    }
    // ½∫ f·u with ∫ (sin cos)² = side/2 · side/2.
    let Some(energy) = found.energy else { panic!("no energy") };
    assert_close("energy", &[energy], &[0.5 * factor * 10.0 * 0.5], Tol::ulps(64.0));
}

#[test]
fn highest_modes_that_a_grid_tells_apart_move_by_force_over_the_eigenvalue() {
    // Wave vectors along (15/2, 7) and across (13/2, 7).
    let load = "[[load]]\ntype = 'mode'\nindices = [13, 7]\nforce_per_volume = [-7.0, 6.5]\n";
    let text = replaced(&replaced(PLATE, "[2, 3]", "[15, 7]"), "[1.0, 3.0]", "[7.5, 7.0]");
    let run = run(&format!("{text}{load}"));
    let found = field(in_rectangle(&run));
    let first = -1.0 / kappa(5.0, &[15.0, 7.0], &[2.0, 1.0]);
    let second = -1.0 / kappa(1.5, &[13.0, 7.0], &[2.0, 1.0]);
    let mut expected = [Vec::new(), Vec::new()];
    for point in 0..found.grid.len() {
        let [x, y] = found.grid.position(found.grid.indices(point)).map(|x| PI * x);
        let (sine, cosine) = (7.0 * y).sin_cos();
        expected[0].push((7.5 * first * (7.5 * x).sin() - 7.0 * second * (6.5 * x).sin()) * cosine);
        expected[1].push((7.0 * first * (7.5 * x).cos() + 6.5 * second * (6.5 * x).cos()) * sine);
    }
    for (found, expected) in found.displacement.iter().zip(&expected) {
        assert_close("u", found, expected, Tol::ulps_because(256.0, "phases of up to 15 π"));
    }
}

#[test]
fn load_across_its_wave_moves_by_force_over_the_second_eigenvalue() {
    let text = replaced(PLATE, "[1.0, 3.0]", "[-3.0, 1.0]");
    let text = format!("{text}[[probe]]\nname = 'p'\nat = [0.3, 0.4]\n");
    let run = run(&text);
    let factor = -1.0 / kappa(1.5, &[2.0, 3.0], &[2.0, 1.0]);
    let (x, y) = (0.3, 0.4);
    let expected =
        [-3.0 * factor * (PI * x).sin() * (3.0 * PI * y).cos(), factor * (PI * x).cos() * (3.0 * PI * y).sin()];
    let (_, found) = &field(in_rectangle(&run)).probes[0];
    assert_close("u", found, &expected, Tol::ulps(64.0));
}

#[test]
fn third_family_of_a_box_has_the_second_eigenvalue() {
    let text = r#"
[box]
type = "static"
sides = [1.0, 1.0, 1.0]
points = [8, 10, 12]
first_lame_parameter = 2.0
shear_modulus = 1.5
[[load]]
type = "mode"
indices = [1, 2, 3]
# (ik, jk, −(i² + j²))
force_per_volume = [3.0, 6.0, -5.0]
"#;
    let run = run(text);
    let found = field(in_box(&run));
    let factor = -1.0 / kappa(1.5, &[1.0, 2.0, 3.0], &[1.0; 3]);
    for point in 0..found.grid.len() {
        let [x, y, z] = found.grid.position(found.grid.indices(point)).map(|x| PI * x);
        let (sx, cx) = x.sin_cos();
        let (sy, cy) = (2.0 * y).sin_cos();
        let (sz, cz) = (3.0 * z).sin_cos();
        let expected = [3.0 * factor * sx * cy * cz, 6.0 * factor * cx * sy * cz, -5.0 * factor * cx * cy * sz];
        let u: Vec<f64> = found.displacement.iter().map(|list| list[point]).collect();
        assert_close_at_scale("u", &u, &expected, 6.0 * factor, Tol::ulps(64.0));
    }
}

#[test]
fn uniform_load_between_sliding_walls_is_a_parabola() {
    let text = replaced(
        PLATE,
        "type = \"mode\"\nindices = [2, 3]\nforce_per_volume = [1.0, 3.0]",
        "type = \"uniform\"\nforce_per_volume = [10.0, 0.0]",
    );
    let run = run(&text);
    let found = field(in_rectangle(&run));
    // (λ + 2μ) u″ + f = 0.
    let expected: Vec<f64> = (0..found.grid.len())
        .map(|point| found.grid.position(found.grid.indices(point))[0])
        .map(|x| 10.0 / (2.0 * 5.0) * x * (2.0 - x))
        .collect();
    assert_close("u", &found.displacement[0], &expected, Tol::ulps(64.0));
    assert_eq!(found.resultant, Some([20.0, 0.0]));
    let Some(lifted) = found.lifted else { panic!("nothing was lifted") };
    assert_close("force at the walls", &[lifted.overall()], &[10.0], Tol::ulps(8.0));
    // Half on each wall. The slope of the sum of modes at a wall is that of the parabola at half a spacing.
    let Some(walls) = found.wall_forces else { panic!("no forces of the walls") };
    let tolerance = Tol::stated(0.5 / 16.0, "half a spacing over the side");
    assert_close("walls", &walls[0], &[-10.0, -10.0], tolerance);
    assert!(found.unbalance().is_some_and(|share| 0.0 < share && share < 0.04));
}

#[test]
fn truncated_uniform_load_is_its_first_sine() {
    let text = replaced(
        PLATE,
        "type = \"mode\"\nindices = [2, 3]\nforce_per_volume = [1.0, 3.0]",
        "type = \"uniform\"\nforce_per_volume = [10.0, 0.0]",
    );
    let cells = replaced(&replaced(&text, "location = \"nodes\"", "modes = [2, 2]"), "[17, 9]", "[64, 8]");
    let run = run(&cells);
    let found = field(in_rectangle(&run));
    // The first sine of a constant is 4/π, less a share of order (π h/L)²/12 at centres of cells.
    let factor = 10.0 * 4.0 / PI / -kappa(5.0, &[1.0], &[2.0]);
    let expected: Vec<f64> = (0..found.grid.len())
        .map(|point| factor * (0.5 * PI * found.grid.position(found.grid.indices(point))[0]).sin())
        .collect();
    assert_close("u", &found.displacement[0], &expected, Tol::order(PI / 64.0, 2));
    assert!(found.lifted.is_none());
}

#[test]
fn displacement_by_a_force_elsewhere_is_that_of_the_force_here() {
    let at = |source: &str, force: &str, place: &str| {
        let text = replaced(
            PLATE,
            "type = \"mode\"\nindices = [2, 3]\nforce_per_volume = [1.0, 3.0]",
            &format!("type = \"line\"\nat = {source}\nforce_per_length = {force}"),
        );
        let run = run(&format!("{text}[[probe]]\nname = 'p'\nat = {place}\n"));
        let found = field(in_rectangle(&run));
        (found.probes[0].1, found.resultant)
    };
    let ([_, across], resultant) = at("[0.5, 0.25]", "[2.0, 0.0]", "[1.3, 0.7]");
    let ([along, _], _) = at("[1.3, 0.7]", "[0.0, 2.0]", "[0.5, 0.25]");
    assert_small("u_y by f_x less u_x by f_y", across - along, Tol::ulps(16.0));
    assert!(1e-4 < across.abs());
    assert_eq!(resultant, Some([2.0, 0.0]));
}
