//! What cannot be done is refused with the numbers that say why.

use nalgebra::Vector3;
use piola_hamiltonian::{
    Delaunay, Generated, GeneratingFunction, GeneratingKind, HamiltonianError, HamiltonianField, LegendreTransform,
    OscillatorActionAngle, PhaseFunction, PhaseFunctions, PhaseMap, PhasePoint, PolarCoordinates, RotatingFrame,
    SphericalCoordinates, canonical_test, differential, image_and_jacobian, poisson_bracket, require_canonical,
    trajectory_from_integrals,
};
use piola_integrators::{Field, Tolerance};
use piola_lagrangian::{Holonomic, Lagrangian, LagrangianError, Placement};
use piola_numerics::Real;

use super::systems::{Kepler, PlaneMoment};

#[test]
fn a_singular_hessian_is_refused_with_its_null_direction() {
    struct Sum; // one particle at q₁ + q₂
    impl Holonomic for Sum {
        fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
            bodies.particle(1.0, Vector3::new(q[0] + q[1], T::zero(), T::zero()));
        }
    }
    let system = Lagrangian::of(Sum);
    match system.hamiltonian(&[0.0, 0.0], &[1.0, 2.0], 0.0) {
        Err(LagrangianError::SingularMetric { direction, .. }) => assert!((direction[0] + direction[1]).abs() < 1e-15),
        other => panic!("{other:?}"),
    }
    // Velocities with these momenta are not the only ones: they are not vouched for.
    let refused = system.legendre_certificate(&[0.0, 0.0], &[1.0, 0.0], &[1.0, 1.0], 0.0).unwrap_err();
    assert!(matches!(refused, LagrangianError::SingularMetric { coordinate: 1, .. }), "{refused}");
    let refused = system.legendre_certificate(&[0.0, 0.0], &[1.0], &[1.0, 1.0], 0.0).unwrap_err();
    assert!(matches!(refused, LagrangianError::WrongLength { quantity: "q̇", .. }), "{refused}");
    let refused = system.legendre_certificate(&[0.0, 0.0], &[1.0, 0.0], &[1.0, f64::NAN], 0.0).unwrap_err();
    assert!(matches!(refused, LagrangianError::NotFinite { quantity: "p", index: 1, .. }), "{refused}");
    // As a function on phase space it is not a number, which is refused wherever it is used.
    let refused = differential(&LegendreTransform(&system), &[0.0, 0.0], &[1.0, 2.0], 0.0).unwrap_err();
    assert!(matches!(refused, HamiltonianError::NotFinite { quantity: "dK", .. }), "{refused}");
}

#[test]
fn a_map_that_is_not_canonical_is_refused_with_its_worst_entry() {
    struct Stretched; // Q₂ = 3 q₂
    impl PhaseMap for Stretched {
        fn map<T: Real>(&self, q: &[T], p: &[T], _t: T, new: &mut [T]) -> Result<(), HamiltonianError> {
            new.copy_from_slice(&[q[0], T::lit(3.0) * q[1], p[0], p[1]]);
            Ok(())
        }
    }
    let refused = require_canonical(&Stretched, &[1.0, 2.0], &[3.0, 4.0], 0.0, 1e-12).unwrap_err();
    assert_eq!(refused, HamiltonianError::NotCanonical { residual: 2.0, relative: 2.0 / 3.0, row: 3, column: 1 });
    assert!(refused.to_string().contains("entry (3, 1)"));
}

#[test]
fn charts_are_refused_where_they_end() {
    let origin = image_and_jacobian(&PolarCoordinates, &[0.0, 0.0], &[1.0, 1.0], 0.0).unwrap_err();
    assert!(matches!(origin, HamiltonianError::NotFinite { quantity: "(Q, P)", index: 2, .. }), "{origin}");
    let axis = canonical_test(&SphericalCoordinates, &[0.0, 0.0, 1.0], &[1.0, 1.0, 0.0], 0.0).unwrap_err();
    assert!(matches!(axis, HamiltonianError::NotFinite { .. }), "{axis}");
    let kepler = Delaunay::new(1.0, 1.0).unwrap();
    let mut new = [0.0; 6];
    let escape = kepler.map(&[1.0, 0.0, 0.0], &[0.0, 0.0, 2.0], 0.0, &mut new).unwrap_err();
    assert_eq!(escape, HamiltonianError::NotBound { energy: 1.0 });
    let circle = kepler.map(&[1.0, 0.0, 0.0], &[0.0, 0.0, 1.0], 0.0, &mut new).unwrap_err();
    assert_eq!(circle, HamiltonianError::DegenerateElements { eccentricity: 0.0, sine_of_inclination: 1.0 });
    let flat = kepler.map(&[1.0, 0.0, 0.0], &[0.0, 1.1, 0.0], 0.0, &mut new).unwrap_err();
    assert!(
        matches!(flat, HamiltonianError::DegenerateElements { sine_of_inclination, .. } if sine_of_inclination == 0.0)
    );
}

#[test]
fn numbers_that_are_none_are_refused_by_name() {
    let kepler = Kepler { mass: 1.0, strength: 1.0 };
    let refused = poisson_bracket(&PlaneMoment, &kepler, &[1.0, f64::NAN], &[1.0, 2.0], 0.0).unwrap_err();
    assert!(matches!(refused, HamiltonianError::NotFinite { quantity: "q", index: 1, .. }), "{refused}");
    let refused = poisson_bracket(&PlaneMoment, &kepler, &[0.0, 0.0], &[1.0, 2.0], 0.0).unwrap_err();
    assert!(matches!(refused, HamiltonianError::NotFinite { quantity: "{K, H}", .. }), "{refused}");
    let mut rate = [0.0; 4];
    let refused = HamiltonianField::new(&kepler, 2).rate(0.0, &[0.0, 0.0, 1.0, 2.0], &mut rate).unwrap_err();
    assert!(matches!(refused, HamiltonianError::NotFinite { quantity: "dH", .. }), "{refused}");
    assert_eq!(
        differential(&kepler, &[1.0, 0.0], &[1.0], 0.0).unwrap_err(),
        HamiltonianError::WrongLength { quantity: "p", expected: 2, found: 1 }
    );
    assert_eq!(
        OscillatorActionAngle::new(1.0, -2.0).unwrap_err(),
        HamiltonianError::NotPositive { quantity: "angular frequency", value: -2.0 }
    );
    assert!(RotatingFrame::new(f64::INFINITY).is_err());
    let frame = RotatingFrame::new(1.0).unwrap();
    assert!(frame.map(&[1.0], &[1.0], 0.0, &mut [0.0; 2]).is_err());
    assert!(frame.map(&[1.0; 4], &[1.0; 4], 0.0, &mut [0.0; 8]).is_err());
}

#[test]
fn a_generating_function_without_mixed_derivative_or_solution_is_refused() {
    struct Short; // p = Q/√(1 + Q²) reaches no 2
    impl GeneratingFunction for Short {
        fn value<T: Real>(&self, q: &[T], new: &[T], _t: T) -> T {
            q[0] * new[0] / (T::one() + new[0] * new[0]).sqrt()
        }
    }
    struct Separate;
    impl GeneratingFunction for Separate {
        fn value<T: Real>(&self, q: &[T], new: &[T], _t: T) -> T {
            q[0] * q[0] + new[0] * new[0]
        }
    }
    let map = Generated::new(Separate, GeneratingKind::First, &[0.0]);
    assert!(matches!(map.map(&[1.0], &[3.0], 0.0, &mut [0.0; 2]), Err(HamiltonianError::Numerics(_))));
    let map = Generated::new(Short, GeneratingKind::First, &[0.0]);
    let refused = map.map(&[1.0], &[2.0], 0.0, &mut [0.0; 2]).unwrap_err();
    assert!(matches!(refused, HamiltonianError::NotSolved { .. } | HamiltonianError::Numerics(_)), "{refused}");
    assert_eq!(
        Generated::new(Short, GeneratingKind::First, &[0.0; 2]).map(&[1.0], &[0.5], 0.0, &mut [0.0; 2]),
        Err(HamiltonianError::WrongLength { quantity: "guess", expected: 1, found: 2 })
    );
}

#[test]
fn what_is_no_integral_makes_no_trajectory() {
    struct Three;
    impl PhaseFunctions for Three {
        fn count(&self) -> usize {
            3
        }
        fn values<T: Real>(&self, q: &[T], p: &[T], t: T, out: &mut [T]) {
            out.copy_from_slice(&[
                Kepler { mass: 1.0, strength: 1.0 }.value(q, p, t),
                PlaneMoment.value(q, p, t),
                q[0],
            ]);
        }
    }
    let kepler = Kepler { mass: 1.0, strength: 1.0 };
    let start = PhasePoint::new(&[1.0, 0.0], &[0.1, 1.0], 0.0).unwrap();
    let tolerance = Tolerance::relative(1e-10).unwrap();
    let refused = trajectory_from_integrals(&Three, &kepler, &start, &[1.0], tolerance).unwrap_err();
    assert!(matches!(refused, HamiltonianError::NotAnIntegral { index: 2, relative } if 0.9 < relative), "{refused}");
}

#[test]
fn points_of_the_wrong_size_and_actions_that_no_motion_has_are_refused() {
    use piola_hamiltonian::{
        CanonicalOneForm, ExtendedTwoForm, Inverse, closedness_residual, exterior_derivative, integral_test,
    };
    struct Product;
    impl GeneratingFunction for Product {
        fn value<T: Real>(&self, q: &[T], new: &[T], _t: T) -> T {
            q[0] * new[0] + q[1] * new[1]
        }
    }
    let kepler = Kepler { mass: 1.0, strength: 1.0 };
    assert_eq!(
        exterior_derivative(&CanonicalOneForm, &[1.0, 2.0, 3.0]).unwrap_err(),
        HamiltonianError::WrongLength { quantity: "x", expected: 4, found: 3 }
    );
    assert!(closedness_residual(&ExtendedTwoForm(&kepler), &[1.0, 2.0, 3.0, 4.0]).is_err());
    let oscillator = OscillatorActionAngle::new(1.0, 1.0).unwrap();
    assert_eq!(
        Inverse(oscillator).map(&[0.5], &[-2.0], 0.0, &mut [0.0; 2]).unwrap_err(),
        HamiltonianError::InvalidAction { index: 0, value: -2.0, least: 0.0, greatest: f64::INFINITY }
    );
    let delaunay = Delaunay::new(1.0, 1.0).unwrap();
    for (actions, index) in [([1.0, 1.5, 0.5], 1), ([1.0, 0.5, 0.75], 2), ([-1.0, 0.5, 0.25], 0)] {
        match Inverse(delaunay).map(&[0.1; 3], &actions, 0.0, &mut [0.0; 6]) {
            Err(HamiltonianError::InvalidAction { index: found, .. }) => assert_eq!(found, index),
            other => panic!("{other:?}"),
        }
    }
    let map = Generated::new(Product, GeneratingKind::First, &[0.0; 2]);
    assert_eq!(
        map.map(&[1.0, 2.0], &[3.0], 0.0, &mut [0.0; 4]).unwrap_err(),
        HamiltonianError::WrongLength { quantity: "p", expected: 2, found: 1 }
    );
    assert!(map.map(&[1.0, 2.0], &[3.0, 4.0], 0.0, &mut [0.0; 3]).is_err());
    assert!(map.map(&[1.0, 2.0], &[3.0, f64::NAN], 0.0, &mut [0.0; 4]).is_err());
    assert_eq!(
        integral_test(&kepler, &kepler, &[]).unwrap_err(),
        HamiltonianError::TooFewSamples { found: 0, needed: 1 }
    );
}
