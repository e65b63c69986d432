//! What is refused, with the numbers.

use piola_characteristics::{
    CauchyProblem, FirstOrderPde, Front, Grid, InitialManifold, MongeCone, Overlap, ParameterInterval, Refinement,
    Search,
};
use piola_characteristics::{CharacteristicsError, StripError};
use piola_integrators::Tolerance;
use piola_numerics::Real;

use super::systems::{Bent, Burgers, Eikonal, Line, Parabola, Wave};

/// A manifold that stands still at τ = 0, and is infinite beyond τ = 1.
struct Odd;
impl InitialManifold for Odd {
    fn place<T: Real>(&self, tau: &[T], x: &mut [T]) -> T {
        (x[0], x[1]) = (tau[0] * tau[0], (T::one() - tau[0]).sqrt() * T::zero());
        T::zero()
    }
}

/// √ξ₁ + ξ₂ − u = 0: not everywhere real.
struct Root;
impl FirstOrderPde for Root {
    fn value<T: Real>(&self, _x: &[T], u: T, xi: &[T]) -> T {
        xi[0].sqrt() + xi[1] - u
    }
}

#[test]
fn bad_data_are_refused_by_name() {
    assert!(matches!(
        CauchyProblem::new(&Eikonal, &Wave, 1).err(),
        Some(CharacteristicsError::WrongLength { expected: 2, found: 1, .. })
    ));
    let problem = CauchyProblem::new(&Bent, &Wave, 2).unwrap();
    assert!(matches!(problem.clone().near(&[0.0]).err(), Some(CharacteristicsError::WrongLength { .. })));
    assert!(matches!(
        problem.clone().near(&[0.0, f64::NAN]).err(),
        Some(CharacteristicsError::NotFinite { quantity: "guess of ξ", index: 1, .. })
    ));
    assert!(matches!(problem.initial_point(&[0.0, 1.0]).err(), Some(CharacteristicsError::WrongLength { .. })));
    assert!(matches!(
        problem.initial_point(&[f64::INFINITY]).err(),
        Some(CharacteristicsError::NotFinite { quantity: "τ", .. })
    ));
    assert!(matches!(problem.characteristic(&[0.0], f64::NAN).err(), Some(CharacteristicsError::NotFinite { .. })));
    assert!(matches!(
        problem.caustic_points(&[0.0], 0.5, 1.0).err(),
        Some(CharacteristicsError::InvalidSpan { from, .. }) if (from - 0.5).abs() <= 0.0
    ));
    let backwards = [ParameterInterval { from: 1.0, to: 0.0, parts: 3 }];
    assert!(matches!(problem.classify(&backwards).err(), Some(CharacteristicsError::InvalidInterval { .. })));
    let empty = [ParameterInterval { from: 0.0, to: 1.0, parts: 0 }];
    assert!(matches!(problem.classify(&empty).err(), Some(CharacteristicsError::TooFewSamples { .. })));
    let interval = [ParameterInterval { from: 0.0, to: 1.0, parts: 2 }];
    assert!(problem.solve(&interval, (0.0, 0.1), Refinement::to(f64::NAN)).is_err());
    let solution = problem.solve(&interval, (0.0, 0.1), Refinement::to(1e-2)).unwrap();
    let grid = Grid { origin: [0.0; 2], spacing: [0.1, 0.0], points: [2, 2] };
    assert!(matches!(
        solution.onto_grid(grid, Overlap::Nothing).err(),
        Some(CharacteristicsError::InvalidInterval { .. })
    ));
    assert!(matches!(solution.at(&[f64::NAN, 0.0]).err(), Some(CharacteristicsError::NotFinite { quantity: "x", .. })));
}

#[test]
fn manifold_that_stands_still_is_refused_with_its_place() {
    let problem = CauchyProblem::new(&Eikonal, &Odd, 2).unwrap();
    assert!(matches!(
        problem.initial_point(&[0.0]).err(),
        Some(CharacteristicsError::Strip(StripError::DependentParameters { index: 0, parameters, .. })) if parameters == [0.0]
    ));
    assert!(matches!(
        problem.initial_point(&[1.5]).err(),
        Some(CharacteristicsError::NotFinite { quantity: "x(τ)", .. })
    ));
}

#[test]
fn equation_without_value_at_the_guess_is_refused() {
    let problem = CauchyProblem::new(&Root, &Line::Square, 2).unwrap().near(&[-1.0, 0.0]).unwrap();
    assert!(matches!(problem.initial_point(&[1.0]).err(), Some(CharacteristicsError::NotFinite { quantity: "Φ", .. })));
}

/// ξ₁ + ξ₂² = 0, declared linear.
struct Declared;
impl FirstOrderPde for Declared {
    const QUASILINEAR: bool = true;
    fn value<T: Real>(&self, _x: &[T], _u: T, xi: &[T]) -> T {
        xi[0] + xi[1] * xi[1]
    }
}

#[test]
fn guess_from_which_no_step_leads_is_refused() {
    let problem = CauchyProblem::new(&Eikonal, &Parabola(0.5), 2).unwrap();
    assert!(matches!(
        problem.initial_point(&[1.0]).err(),
        Some(CharacteristicsError::Strip(StripError::NoInitialCovector { residual, slope, .. })) if (residual + 0.5).abs() < 1e-15 && slope.abs() <= 0.0
    ));
}

/// Riccati's ξ′ = −ξ² − … has no end but infinity: the run says where, and which declaration leads on.
#[test]
fn gradient_that_becomes_infinite_names_the_missing_declaration() {
    let problem = CauchyProblem::new(&Undeclared, &Line::Sine, 2).unwrap();
    let named = |error: Option<CharacteristicsError>, breaking: f64| match error {
        Some(CharacteristicsError::UndeclaredQuasilinear { s, x }) => {
            // ξ = 1/(breaking − s) outgrows every step: the run stops a little before.
            assert!((s - breaking).abs() < 1e-6 && (x[0] - breaking).abs() < 1e-6, "{s}, {x:?}");
        }
        other => panic!("{other:?}"),
    };
    named(problem.characteristic(&[core::f64::consts::PI], 1.5).err(), 1.0);
    named(problem.characteristic(&[3.75], 1.5).err(), -1.0 / 3.75_f64.cos());
    let wave = [ParameterInterval { from: 0.0, to: 6.0, parts: 8 }];
    // The first characteristic of the grid that breaks.
    named(problem.solve(&wave, (0.0, 1.5), Refinement::to(1e-3)).err(), -1.0 / 3.0_f64.cos());
    let message = problem.characteristic(&[core::f64::consts::PI], 1.5).unwrap_err().to_string();
    assert!(message.contains("const QUASILINEAR: bool = true"), "{message}");
}

/// Burgers's equation that does not say that it is linear in ξ.
struct Undeclared;
impl FirstOrderPde for Undeclared {
    fn value<T: Real>(&self, x: &[T], u: T, xi: &[T]) -> T {
        Burgers.value(x, u, xi)
    }
}

#[test]
fn false_declaration_of_linearity_is_refused() {
    let problem = CauchyProblem::new(&Declared, &Line::Square, 2).unwrap();
    // ξ = (−4, 2) at τ = 1, and Φ(2ξ) − 2Φ(ξ) + Φ(0) = 2 ξ₂².
    assert!(matches!(
        problem.initial_point(&[1.0]).err(),
        Some(CharacteristicsError::Strip(StripError::NotQuasilinear { residual, .. })) if (residual - 8.0).abs() < 1e-14
    ));
}

#[test]
fn cone_of_a_linear_equation_is_one_line() {
    let cone = MongeCone::new(&Burgers, &[0.0, 0.0], 2.0).unwrap();
    // x′ = (1, u): any covector with ξ₁ + 2 ξ₂ = 0 touches it.
    let generator = cone.generator_over(&[0.5, 1.0], &[0.0, 1.0]).unwrap();
    // Sums of two numbers of a few units.
    assert!((generator.x_rate[1] - 2.0).abs() < 1e-15 && generator.u_rate.abs() < 1e-14);
    let refused = cone.generator_over(&[1.0, 0.0], &[0.0, 1.0]).err();
    assert!(matches!(refused, Some(CharacteristicsError::NoGenerator { residual, .. }) if 0.1 < residual));
    assert!(matches!(cone.generator(&[1.0, 1.0]).err(), Some(CharacteristicsError::NoGenerator { .. })));
    assert!(matches!(
        cone.generator_over(&[0.0, 0.0], &[0.0, 1.0]).err(),
        Some(CharacteristicsError::NoGenerator { .. })
    ));
    let search = Search { from: -1.0, to: f64::NAN, parts: 3 };
    let refused = cone.generators_along(&[0.0, 0.0], &[1.0, 0.0], search).err();
    assert!(matches!(refused, Some(CharacteristicsError::NotFinite { quantity: "search", index: 1, .. })));
    let search = Search { from: -1.0, to: 1.0, parts: 0 };
    let refused = cone.generators_along(&[0.0, 0.0], &[1.0, 0.0], search).err();
    assert!(matches!(refused, Some(CharacteristicsError::TooFewSamples { found: 0, needed: 1 })));
    let refused = CauchyProblem::new(&Eikonal, &Wave, 2).unwrap().initial_points(&[0.4], search).err();
    assert!(matches!(refused, Some(CharacteristicsError::TooFewSamples { found: 0, needed: 1 })));
}

#[test]
fn front_keeps_its_rows_when_a_step_fails() {
    assert!(matches!(Front::new(2, vec![0.0; 7]).err(), Some(CharacteristicsError::WrongLength { .. })));
    let tolerance = Tolerance::relative(1e-9).unwrap();
    // ξ₂′ = −ξ₂²: four rows for which 3/2 is no distance, and a fifth with ξ₂ = −1/(1 − s).
    let mut rows = [0.0, 0.5, 0.0, 0.0, 1.0].repeat(4);
    rows.extend([0.0, 0.0, 0.0, 0.0, -1.0]);
    let mut front = Front::new(2, rows).unwrap();
    let before = front.clone();
    let error = front.advance(&Undeclared, 1.5, tolerance).err();
    assert!(matches!(error, Some(CharacteristicsError::Run { time, .. }) if (time - 1.0).abs() < 1e-6), "{error:?}");
    assert_eq!(front, before);
    let error = front.advance(&Undeclared, f64::INFINITY, tolerance).err();
    assert!(matches!(error, Some(CharacteristicsError::NotFinite { quantity: "step", .. })), "{error:?}");
    assert_eq!(front, before);
    // A step that all rows allow.
    front.advance(&Undeclared, 0.5, tolerance).unwrap();
    assert!((front.s() - 0.5).abs() <= 0.0);
    for (row, slope) in [(3, 1.0 / 1.5), (4, -2.0)] {
        // Ten times the tolerance of the steps.
        assert!((front.row(row).unwrap()[4] - slope).abs() < 1e-8, "{:?}", front.row(row));
    }
    let mut empty = Front::new(2, Vec::new()).unwrap();
    empty.advance(&Root, 1.0, Tolerance::relative(1e-9).unwrap()).unwrap();
    assert!(empty.is_empty() && empty.row(0).is_none());
}
