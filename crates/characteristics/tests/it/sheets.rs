//! The solution at points: one sheet, several, none; interpolated on a grid.

use piola_characteristics::CharacteristicsError;
use piola_characteristics::{CauchyProblem, FirstOrderPde, Grid, Overlap, ParameterInterval, Refinement};
use piola_numerics::Real;
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use proptest::prelude::*;

use super::systems::{Burgers, Circle, Eikonal, Line, Parabola, Product};

fn integrated() -> Tol {
    Tol::stated(1e-11, "an inverted ray map of local error 1e-13")
}

/// Inside the cusp three normals of y = x²/2 reach a point, two of equal length.
#[test]
fn three_sheets_inside_the_cusp_of_a_parabola() {
    let problem = CauchyProblem::new(&Eikonal, &Parabola(0.5), 2).unwrap().near(&[0.0, 1.0]).unwrap();
    let interval = [ParameterInterval { from: -2.1, to: 2.3, parts: 8 }];
    let solution = problem.solve(&interval, (0.0, 2.5), Refinement::to(2e-2)).unwrap();
    // From (0, 2): along the axis, and from (±√2, 1).
    let x = [0.0, 2.0];
    let sheets = solution.sheets_at(&x).unwrap();
    assert_eq!(sheets.len(), 3, "{sheets:?}");
    let values: Vec<f64> = sheets.iter().map(|sheet| sheet.point.u).collect();
    assert_close("u", &values, &[3.0_f64.sqrt(), 3.0_f64.sqrt(), 2.0], integrated());
    assert_eq!(sheets.iter().map(|sheet| sheet.caustics).collect::<Vec<_>>(), [0, 0, 1]);
    let first = solution.first_arrival(&x).unwrap();
    assert_close("σ", &[first.point.parameters[0].abs()], &[2.0_f64.sqrt()], integrated());
    let refused = solution.at(&x).err();
    assert!(matches!(refused, Some(CharacteristicsError::SeveralSheets { values, .. }) if values.len() == 3));
    // Outside of the evolute there is one.
    let outside = solution.at(&[0.5, 1.0]).unwrap();
    assert_eq!(outside.caustics, 0);
    let refused = solution.at(&[0.0, -1.0]).err();
    assert!(matches!(refused, Some(CharacteristicsError::OutsideOfCharacteristics { distance, .. }) if 0.9 < distance));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    /// Every normal of y = x²/2 that reaches a point is found: σ³/2 + (1 − y) σ = x.
    #[test]
    fn sheets_equal_the_normals_of_a_parabola(x in -0.9..0.9_f64, y in 0.6..2.2_f64) {
        let problem = CauchyProblem::new(&Eikonal, &Parabola(0.5), 2).unwrap().near(&[0.0, 1.0]).unwrap();
        let interval = [ParameterInterval { from: -2.5, to: 2.5, parts: 8 }];
        let solution = problem.solve(&interval, (0.0, 3.5), Refinement::to(1e-2)).unwrap();
        let cubic = |sigma: f64| 0.5 * sigma.powi(3) + (1.0 - y) * sigma - x;
        let mut expected = Vec::new();
        for i in 0..5000 {
            let (mut a, mut b) = (-2.5 + f64::from(i) * 1e-3, -2.5 + f64::from(i + 1) * 1e-3);
            if (cubic(a) < 0.0) != (cubic(b) < 0.0) && 0.5 * a * a < y {
                for _ in 0..60 {
                    let middle = 0.5 * (a + b);
                    if (cubic(a) < 0.0) == (cubic(middle) < 0.0) { a = middle } else { b = middle }
                }
                expected.push((a - x).hypot(0.5 * a * a - y));
            }
        }
        // Two normals about to merge are as near to a caustic as the root of rounding.
        prop_assume!((2.0 * (y - 1.0).max(0.0) / 3.0).powi(3) * 4.0 - 4.0 * x * x < -1e-3
            || 1e-3 < (2.0 * (y - 1.0).max(0.0) / 3.0).powi(3) * 4.0 - 4.0 * x * x);
        expected.sort_by(f64::total_cmp);
        let found: Vec<f64> = solution.sheets_at(&[x, y]).unwrap().iter().map(|sheet| sheet.point.u).collect();
        prop_assert_eq!(found.len(), expected.len());
        assert_close("u", &found, &expected, Tol::stated(1e-9, "rays near a caustic"));
    }
}

#[test]
fn one_sheet_beyond_a_focus_is_refused_as_the_solution() {
    let circle = Circle { radius: 1.0, centre: [0.0; 2], outward: false };
    let problem = CauchyProblem::new(&Eikonal, &circle, 2).unwrap();
    let interval = [ParameterInterval { from: -0.4, to: 0.5, parts: 4 }];
    let solution = problem.solve(&interval, (0.0, 1.8), Refinement::to(1e-2)).unwrap();
    let refused = solution.at(&[-0.5, 0.01]).err();
    // Through the centre to the far side.
    let expected = 1.0 + 0.5_f64.hypot(0.01);
    assert!(
        matches!(refused, Some(CharacteristicsError::BeyondCaustic { value, caustics: 1, .. }) if (value - expected).abs() < integrated().value()),
        "{refused:?}"
    );
}

/// u = (x + 4y)²/16, from the far side of the data as well as from the near one.
#[test]
fn closed_form_of_the_product_equation_on_both_sides_of_the_data() {
    let problem = CauchyProblem::new(&Product, &Line::Square, 2).unwrap();
    let interval = [ParameterInterval { from: 0.25, to: 2.0, parts: 4 }];
    let solution = problem.solve(&interval, (-0.5, 0.5), Refinement::to(1e-3)).unwrap();
    for x in [[0.3, 0.9], [-0.25, 1.1], [0.0, 0.75]] {
        let sheet = solution.at(&x).unwrap();
        let root = (x[0] + 4.0 * x[1]) / 4.0;
        assert_close_at_scale("u", &[sheet.point.u], &[root * root], 1.0, integrated());
        assert_close_at_scale("ξ", &sheet.point.xi, &[0.5 * root, 2.0 * root], 1.0, integrated());
    }
    // Φ is an integral: a few dozen steps of local error 1e-13 leave this of it.
    assert!(solution.drift() < 1e-12);
    assert!(solution.first_loss_of_invertibility().unwrap().is_none());
    assert!(solution.first_loss_of_invertibility_backwards().unwrap().is_none());
}

/// The wave breaks at t = 1 on one characteristic; at the end of the span only those very near to it have broken.
#[test]
fn loss_between_characteristics_that_have_none_is_found() {
    let problem = CauchyProblem::new(&Burgers, &Line::Sine, 2).unwrap();
    let interval = [ParameterInterval { from: 0.1, to: 6.0, parts: 7 }];
    let solution = problem.solve(&interval, (0.0, 1.0001), Refinement::to(10.0)).unwrap();
    assert!(solution.rays().iter().all(|ray| ray.caustic.is_empty()));
    let loss = solution.first_loss_of_invertibility().unwrap().unwrap();
    assert_close("s, τ", &[loss.point.s, loss.point.parameters[0]], &[1.0, core::f64::consts::PI], integrated());
    let before = problem.solve(&interval, (0.0, 0.9999), Refinement::to(10.0)).unwrap();
    assert!(before.first_loss_of_invertibility().unwrap().is_none());
}

#[test]
fn finer_resolution_needs_more_characteristics_and_is_met() {
    let problem = CauchyProblem::new(&Eikonal, &Parabola(0.5), 2).unwrap().near(&[0.0, -1.0]).unwrap();
    let interval = [ParameterInterval { from: -3.0, to: 3.0, parts: 2 }];
    let mut before = 0;
    for resolution in [1e-1, 1e-3, 1e-5] {
        let solution = problem.solve(&interval, (0.0, 1.0), Refinement::to(resolution)).unwrap();
        assert!(solution.interpolation_error() <= resolution);
        assert!(before < solution.rays().len(), "{}", solution.rays().len());
        before = solution.rays().len();
        assert_eq!(solution.simplices().len() + 1, before);
    }
    // They stand where the curve bends, not at equal distances.
    let solution = problem.solve(&interval, (0.0, 1.0), Refinement::to(1e-4)).unwrap();
    let within = solution.rays().iter().filter(|ray| ray.parameters[0].abs() < 1.0).count();
    assert!(2 * within > solution.rays().len(), "{within} of {}", solution.rays().len());
    let few = Refinement { most_rays: 10, ..Refinement::to(1e-6) };
    let refused = problem.solve(&interval, (0.0, 1.0), few).err();
    assert!(matches!(refused, Some(CharacteristicsError::TooManyCharacteristics { error, .. }) if 1e-6 < error));
}

/// ∂u/∂t + f(t) ∂u/∂q = 0 with a gust f = exp(−400 (t − 5/6)²).
struct Gust;
impl FirstOrderPde for Gust {
    fn value<T: Real>(&self, x: &[T], _u: T, xi: &[T]) -> T {
        let t = x[0] - T::lit(5.0 / 6.0);
        xi[0] + (T::lit(-400.0) * t * t).exp() * xi[1]
    }
}

#[test]
fn interpolation_is_tested_in_every_part_of_s() {
    let problem = CauchyProblem::new(&Gust, &Line::Sine, 2).unwrap();
    let interval = [ParameterInterval { from: 0.0, to: 1.0, parts: 2 }];
    // The gust blows in the last of three parts only.
    let coarse = Refinement { levels: 3, most_levels: 3, ..Refinement::to(1e-3) };
    let refused = problem.solve(&interval, (0.0, 1.0), coarse).err();
    // q at s = 2/3 is 0 to 1e-6, and half of q(1) = √π/20 where it is interpolated.
    let expected = core::f64::consts::PI.sqrt() / 640.0;
    assert!(
        matches!(&refused, Some(CharacteristicsError::TooManyCharacteristics { rays: 3, error }) if (error - expected).abs() < 1e-5),
        "{refused:?}"
    );
    // One part has no middle: there are two, and more as they are needed.
    for levels in [0, 1, 2, 3] {
        let solution = problem.solve(&interval, (0.0, 1.0), Refinement { levels, ..Refinement::to(1e-4) }).unwrap();
        assert!(12 < solution.levels().len() && solution.interpolation_error() <= 1e-4, "{}", solution.levels().len());
        let capped = Refinement { levels, most_levels: 8, ..Refinement::to(1e-4) };
        let refused = problem.solve(&interval, (0.0, 1.0), capped).err();
        assert!(matches!(refused, Some(CharacteristicsError::TooManyCharacteristics { error, .. }) if 1e-4 < error));
    }
    let one = Refinement { levels: 1, most_levels: 1, ..Refinement::to(1.0) };
    let solution = problem.solve(&interval, (0.0, 1.0), one).unwrap();
    assert!(solution.levels().len() == 3 && 1e-4 < solution.interpolation_error());
}

#[test]
fn distance_to_a_circle_on_a_grid() {
    let circle = Circle { radius: 0.5, centre: [0.1, -0.2], outward: true };
    let problem = CauchyProblem::new(&Eikonal, &circle, 2).unwrap();
    let interval = [ParameterInterval { from: 0.0, to: core::f64::consts::TAU, parts: 6 }];
    let resolution = 1e-6;
    let solution = problem.solve(&interval, (0.0, 1.0), Refinement::to(resolution)).unwrap();
    let grid = Grid { origin: [-1.5, -1.5], spacing: [0.125, 0.1], points: [25, 31] };
    let values = solution.onto_grid(grid, Overlap::Nothing).unwrap();
    let mut covered = 0;
    for j in 0..grid.points[1] {
        for i in 0..grid.points[0] {
            let x = grid.point(i, j);
            let distance = (x[0] - 0.1).hypot(x[1] + 0.2);
            match values.get(i, j) {
                Some(value) => {
                    covered += 1;
                    let tol = Tol::stated(4.0 * resolution, "the resolution asked for");
                    assert_close_at_scale("u", &[value.u], &[distance - 0.5], 1.0, tol);
                    assert_eq!(value.sheets, 1);
                }
                None => assert!(!(0.501..=1.499).contains(&distance), "{x:?} {distance}"),
            }
        }
    }
    assert_eq!(values.covered(), covered);
    // |∇u| by differences of values that are interpolated to 1e-6, over a tenth.
    assert!(values.largest_residual(0.1) < 1e-4, "{}", values.largest_residual(0.1));
    assert_eq!(values.get(25, 0), None);
}

#[test]
fn breaking_wave_has_three_sheets_on_a_grid() {
    let problem = CauchyProblem::new(&Burgers, &Line::Sine, 2).unwrap();
    let interval = [ParameterInterval { from: 0.0, to: core::f64::consts::TAU, parts: 8 }];
    let solution = problem.solve(&interval, (0.0, 2.0), Refinement::to(1e-4)).unwrap();
    let grid = Grid { origin: [0.5, 0.1], spacing: [1.25, 0.3], points: [2, 20] };
    let all = solution.onto_grid(grid, Overlap::FirstArrival).unwrap();
    let single = solution.onto_grid(grid, Overlap::Nothing).unwrap();
    let mut folded = 0;
    for j in 0..20 {
        // Before t = 1 one sheet everywhere; u = sin(q − u t), off by up to 1 + t times what u is, which is interpolated to 1e-4.
        let value = all.get(0, j).unwrap();
        assert_eq!(value.sheets, 1);
        assert!((value.u - (grid.point(0, j)[1] - 0.5 * value.u).sin()).abs() < 1e-3);
        let value = all.get(1, j).unwrap();
        assert!((value.u - (grid.point(1, j)[1] - 1.75 * value.u).sin()).abs() < 1e-3);
        assert_eq!(single.get(1, j).is_none(), 1 < value.sheets);
        if 1 < value.sheets {
            assert_eq!(value.sheets, 3, "{value:?}");
            folded += 1;
        }
    }
    assert!(0 < folded);
    let sheets = solution.sheets_at(&[1.75, core::f64::consts::PI]).unwrap();
    let mut values: Vec<f64> = sheets.iter().map(|sheet| sheet.point.u).collect();
    values.sort_by(f64::total_cmp);
    assert_eq!(values.len(), 3);
    assert_close_at_scale("middle", &[values[1], values[0] + values[2]], &[0.0, 0.0], 1.0, integrated());
}
