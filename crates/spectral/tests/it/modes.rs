//! Eigenfunctions and series: orthonormality, degenerate indices, derivatives, energy, resultants, Green's function.

use std::f64::consts::PI;

use piola_spectral::{
    BoxGrid, BoxOperator, BoxSolver, Eigenbasis, LameParameters, ModalSeries, Polarisation, SpectralError, Walls,
};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};

use super::fixtures::{lame, samples, slices};

const FAMILIES: [Polarisation; 3] = [Polarisation::Longitudinal, Polarisation::Horizontal, Polarisation::Vertical];
const SIDES: [f64; 3] = [1.0, 0.75, 2.5];
/// Sums of a few dozen products.
const SUMS: Tol = Tol::ulps(64.0);

fn indices_up_to(highest: usize) -> impl Iterator<Item = [usize; 3]> {
    let count = highest + 1;
    (0..count * count * count).map(move |n| [n / (count * count), n / count % count, n % count])
}

#[test]
fn eigenfunctions_are_orthonormal_with_degenerate_indices() {
    let basis = Eigenbasis::new(SIDES, lame()).expect("basis");
    let (mut kept, mut vanishing) = (0, 0);
    for indices in indices_up_to(3) {
        for family in FAMILIES {
            if basis.vanishes(family, indices) {
                let refused = SpectralError::VanishingMode { indices, family: family.family() };
                assert_eq!(basis.amplitudes(family, indices), Err(refused));
                vanishing += 1;
                continue;
            }
            let mut series = ModalSeries::zeros(SIDES, Walls::Sliding, [3; 3]).expect("series");
            series.set_amplitudes(indices, basis.amplitudes(family, indices).expect("φ")).expect("set");
            assert_close("norm", &[series.squared_norm()], &[1.0], SUMS);
            for other in FAMILIES.into_iter().filter(|&other| !basis.vanishes(other, indices)) {
                let product = series.coefficient(&basis, other, indices).expect("⟨φ, φ⟩");
                let expected = if other == family { 1.0 } else { 0.0 };
                assert_close_at_scale("⟨φ, φ⟩", &[product], &[expected], 1.0, SUMS);
            }
            kept += 1;
        }
    }
    // Of 64 indices, φ₁ vanishes at one, φ₂ where i₁ = 0 or i₂ = 0: 28, φ₃ where i₃ = 0 or i₁ = i₂ = 0: 19.
    assert_eq!((kept, vanishing), (3 * 64 - 48, 48));
}

#[test]
fn norms_of_eigenfunctions_equal_quadrature() {
    let basis = Eigenbasis::new(SIDES, lame()).expect("basis");
    let grid = BoxGrid::cells([8; 3], SIDES.map(|side| side / 8.0)).expect("grid");
    let mut compared = 0;
    for indices in indices_up_to(2) {
        for family in FAMILIES.into_iter().filter(|&family| !basis.vanishes(family, indices)) {
            // The midpoint rule integrates products of these waves exactly.
            let sum: f64 = (0..grid.len())
                .map(|p| basis.value(family, indices, grid.position(grid.indices(p))).expect("φ"))
                .map(|value| value.iter().map(|v| v * v).sum::<f64>())
                .sum();
            let volume: f64 = grid.spacings().iter().product();
            assert_close(&format!("{family:?} {indices:?}"), &[volume * sum], &[1.0], SUMS);
            compared += 1;
        }
    }
    assert_eq!(compared, 26 + 12 + 16);
}

/// Each index set has as many eigenfunctions as its amplitudes have components that do not vanish: nothing is lost.
#[test]
fn eigenfunctions_of_each_index_span_its_components() {
    let basis = Eigenbasis::new(SIDES, lame()).expect("basis");
    let mut compared = 0;
    for indices in indices_up_to(2) {
        let functions = FAMILIES.into_iter().filter(|&family| !basis.vanishes(family, indices)).count();
        let components = indices.iter().filter(|&&index| 0 < index).count();
        assert_eq!(functions, components, "{indices:?}");
        compared += 1;
    }
    assert_eq!(compared, 27);
}

fn series() -> ModalSeries<3> {
    let mut series = ModalSeries::zeros(SIDES, Walls::Sliding, [4, 3, 5]).expect("series");
    for (n, indices) in [[1, 2, 1], [0, 1, 2], [2, 0, 0], [4, 3, 5], [0, 0, 3], [1, 1, 0]].into_iter().enumerate() {
        series.set_amplitudes(indices, [0.5 - n as f64, 1.0 + 0.25 * n as f64, -0.75]).expect("set");
    }
    series
}

#[test]
fn components_without_a_sine_stay_zero() {
    let mut series = ModalSeries::zeros(SIDES, Walls::Sliding, [2; 3]).expect("series");
    series.set_amplitudes([0, 1, 2], [1.0, 2.0, 3.0]).expect("set");
    assert_eq!(series.amplitudes([0, 1, 2]).map(f64::to_bits), [0.0, 2.0, 3.0].map(f64::to_bits));
    let mut guided = ModalSeries::zeros(SIDES, Walls::Guided, [2; 3]).expect("series");
    guided.set_amplitudes([0, 1, 2], [1.0, 2.0, 3.0]).expect("set");
    assert_eq!(guided.amplitudes([0, 1, 2]).map(f64::to_bits), [1.0, 0.0, 0.0].map(f64::to_bits));
}

#[test]
fn samples_of_a_series_return_its_amplitudes() {
    let mut compared = 0;
    for grid in [
        BoxGrid::cells([8, 10, 11], [SIDES[0] / 8.0, SIDES[1] / 10.0, SIDES[2] / 11.0]),
        BoxGrid::nodes([8, 10, 11], [SIDES[0] / 7.0, SIDES[1] / 9.0, SIDES[2] / 10.0]),
    ] {
        let grid = grid.expect("grid");
        let mut solver = BoxSolver::<f64, 3>::new(grid, Walls::Sliding, BoxOperator::elastic(lame())).expect("plan");
        let series = series();
        let mut fields = [(); 3].map(|()| vec![0.0; grid.len()]);
        solver.sample_into(&series, slices(&mut fields)).expect("samples");
        let direct = samples::<f64, 3>(&grid, |x| series.value(x).expect("value"));
        assert_close("samples", &fields.concat(), &direct.concat(), SUMS);
        let back = solver.series_of([&fields[0], &fields[1], &fields[2]]).expect("series");
        for indices in indices_up_to(6) {
            let (actual, expected) = (back.amplitudes(indices), series.amplitudes(indices));
            assert_close_at_scale(&format!("{indices:?}"), &actual, &expected, 1.0, SUMS);
            compared += 1;
        }
        let mut stress = [(); 3].map(|()| [(); 3].map(|()| vec![0.0; grid.len()]));
        solver.stress_into(lame(), [&fields[0], &fields[1], &fields[2]], &mut stress).expect("stress");
        for point in (0..grid.len()).step_by(17) {
            let expected = series.stress(lame(), grid.position(grid.indices(point))).expect("stress");
            let actual = [0, 1, 2].map(|row| [0, 1, 2].map(|column: usize| stress[row][column][point]));
            // The derivatives multiply rounding by the highest wave numbers, some 40/m.
            assert_close_at_scale("stress", actual.as_flattened(), expected.as_flattened(), 100.0, SUMS);
            compared += 1;
        }
    }
    assert_eq!(compared, 2 * (343 + 52));
}

#[test]
fn gradient_of_a_series_equals_differences() {
    let series = series();
    let (place, step) = ([0.3, 0.4, 1.1], 1e-3);
    let gradient = series.gradient(place).expect("gradient");
    for axis in 0..3 {
        let at = |count: f64| {
            let mut moved = place;
            moved[axis] += count * step;
            series.value(moved).expect("value")
        };
        let (a, b, c, d) = (at(-2.0), at(-1.0), at(1.0), at(2.0));
        for component in 0..3 {
            let quotient = (a[component] - 8.0 * b[component] + 8.0 * c[component] - d[component]) / (12.0 * step);
            // Order 4 with wave numbers of some 12/m.
            let tol = Tol::order(12.0 * step, 4).times(16.0);
            assert_close_at_scale("gradient", &[gradient[component][axis]], &[quotient], 12.0, tol);
        }
    }
}

#[test]
fn elastic_energy_equals_its_density_integrated_and_half_the_work() {
    let series = series();
    let grid = BoxGrid::cells([12; 3], SIDES.map(|side| side / 12.0)).expect("grid");
    let density = |x| {
        let (strain, stress) = (series.strain(x).expect("ε"), series.stress(lame(), x).expect("σ"));
        let pairs = strain.as_flattened().iter().zip(stress.as_flattened());
        0.5 * pairs.map(|(e, s)| e * s).sum::<f64>()
    };
    let volume: f64 = grid.spacings().iter().product();
    let sum: f64 = (0..grid.len()).map(|p| density(grid.position(grid.indices(p)))).sum();
    assert_close("energy", &[series.elastic_energy(lame())], &[volume * sum], SUMS);
}

#[test]
fn walls_and_body_force_balance() {
    let force = ModalSeries::of_function(SIDES, Walls::Sliding, [40, 6, 6], 64, |x| {
        [x[0] * (1.0 - x[0]) * (1.0 + (PI * x[1] / 0.75).cos()), (PI * x[1] / 0.75).sin(), 0.0]
    })
    .expect("projection");
    let u = force.solved(&BoxOperator::elastic(lame()));
    let resultant = force.integral();
    for (axis, resultant) in resultant.into_iter().enumerate().take(2) {
        let walls = [false, true].map(|is_far| u.wall_force(lame(), axis, is_far).expect("wall"));
        // The walls' series converges as Σ 1/i⁴; what is left of both sides is the same.
        assert_close("balance", &[walls[0] + walls[1]], &[-resultant], SUMS);
    }
    // ∫ x(1 − x) dx = 1/6 times the area, but for the odd sines above the 40th: Σ 16/(iπ)⁴ < 8/(π⁴ 3 · 40³) = 4.3e-7.
    let tol = Tol::stated(2.6e-6, "the rest of the sum of 1/i⁴ beside 1/6");
    assert_close("resultant", &[resultant[0]], &[0.75 * 2.5 / 6.0], tol);
}

#[test]
fn green_function_is_symmetric_and_solves_for_a_smooth_force() {
    let (x, y) = ([0.3, 0.5], [0.6, 0.2]);
    let operator = BoxOperator::elastic(lame());
    let green =
        |a, b| ModalSeries::<2>::green_function([1.0, 0.75], Walls::Sliding, [24, 24], &operator, a, b).expect("G");
    let (there, back) = (green(x, y), green(y, x));
    let turned = [[back[0][0], back[1][0]], [back[0][1], back[1][1]]];
    assert_close("G(x, y) = G(y, x)ᵀ", there.as_flattened(), turned.as_flattened(), SUMS);
    // u(x) = ∫ G(x, y) f(y) dy for f = (sin πy₁, 0) by the midpoint rule, which is exact for these waves.
    let grid = BoxGrid::cells([26, 26], [1.0 / 26.0, 0.75 / 26.0]).expect("grid");
    let mut sum = [0.0; 2];
    for point in 0..grid.len() {
        let source = grid.position(grid.indices(point));
        let column = green(x, source);
        for row in 0..2 {
            sum[row] += column[row][0] * (PI * source[0]).sin() * 0.75 / 676.0;
        }
    }
    let expected = (PI * x[0]).sin() / (3.0 * PI * PI);
    assert_close_at_scale("∫ G f", &sum, &[expected, 0.0], expected, SUMS);
}

/// E = μ(3λ + 2μ)/(λ + μ) and ν = λ/(2(λ + μ)): 11/4 and 3/8 for λ = 3, μ = 1; 1 and −1/2 for λ = −1/2, μ = 1. All are exact in binary.
#[test]
fn engineering_constants_give_the_parameters_of_lame() {
    for ([first, shear], [young, poisson]) in [([3.0, 1.0], [2.75, 0.375]), ([-0.5, 1.0], [1.0, -0.5])] {
        let found = LameParameters::from_engineering(young, poisson).expect("elliptic");
        assert_close("λ, μ", &[found.first(), found.shear_modulus()], &[first, shear], Tol::ulps(0.0));
    }
}
