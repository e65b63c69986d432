//! One solution, infinitely many, none: classification of initial strips, with the numbers.

use piola_characteristics::{
    CauchyProblem, Classification, Covector, FirstOrderPde, InitialManifold, ParameterInterval, Refinement, Search,
    StripKind,
};
use piola_characteristics::{CharacteristicsError, StripError};
use piola_numerics::Real;

use super::systems::{Eikonal, Line, Product, Wave};

/// ξ₁ = 0: constant along x¹.
struct Constant;
impl FirstOrderPde for Constant {
    fn value<T: Real>(&self, _x: &[T], _u: T, xi: &[T]) -> T {
        xi[0]
    }
}

/// Curves with u = a τ (or τ²) on them.
enum Curve {
    /// The unit circle by its angle.
    Arc(f64),
    /// The line y = 0 by its length.
    Straight(f64),
    /// x = (τ, τ²), u = τ².
    Tangent,
    /// u = sin τ on y = 0.
    Sine,
}
impl InitialManifold for Curve {
    fn place<T: Real>(&self, tau: &[T], x: &mut [T]) -> T {
        let t = tau[0];
        match *self {
            Self::Arc(a) => {
                (x[1], x[0]) = t.sin_cos();
                T::lit(a) * t
            }
            Self::Straight(a) => {
                (x[0], x[1]) = (t, T::zero());
                T::lit(a) * t
            }
            Self::Tangent => {
                (x[0], x[1]) = (t, t * t);
                t * t
            }
            Self::Sine => {
                (x[0], x[1]) = (t, T::zero());
                t.sin()
            }
        }
    }
}

/// u = 0 on y = 0 with ξ = (0, a τ + b) given.
struct Given(f64, f64);
impl InitialManifold for Given {
    const COVECTOR: Covector = Covector::Given;
    fn place<T: Real>(&self, tau: &[T], x: &mut [T]) -> T {
        (x[0], x[1]) = (tau[0], T::zero());
        T::zero()
    }
    fn covector<T: Real>(&self, tau: &[T], xi: &mut [T]) {
        (xi[0], xi[1]) = (T::zero(), T::lit(self.0) * tau[0] + T::lit(self.1));
    }
}

/// Simple zeros are found to rounding of the interval, whose length is about two, and so is what vanishes there with slopes
/// of a few units.
const ROOT: f64 = 64.0 * f64::EPSILON;

/// Sums of a few numbers of the size of one.
const EXACT: f64 = 4.0 * f64::EPSILON;

const LINE: [ParameterInterval; 1] = [ParameterInterval { from: -0.7, to: 1.1, parts: 9 }];

#[test]
fn transversal_strip_has_one_solution() {
    let problem = CauchyProblem::new(&Eikonal, &Wave, 2).unwrap();
    let Classification::Unique { transversality, .. } = problem.classify(&LINE).unwrap() else { panic!("not unique") };
    // ξ = c n + u_τ t/|x_τ| with |u_τ| ≤ 0.3 sin 1.1 and 1 ≤ |x_τ|.
    assert!(0.9 < transversality.abs() && transversality.abs() <= 1.0, "{transversality}");
}

#[test]
fn straight_ray_of_light_carries_infinitely_many_solutions() {
    let problem = CauchyProblem::new(&Eikonal, &Curve::Straight(1.0), 2).unwrap().near(&[1.0, 0.3]).unwrap();
    let class = problem.classify(&LINE).unwrap();
    let Classification::InfinitelyMany { transversality, residual, undetermined } = class else { panic!("{class:?}") };
    assert!(transversality < ROOT && residual < ROOT && !undetermined);
    let refused = problem.solve(&LINE, (0.0, 1.0), Refinement::to(1e-2)).err();
    assert!(
        matches!(refused, Some(CharacteristicsError::Strip(StripError::Characteristic { transversality, .. })) if transversality < ROOT)
    );
}

#[test]
fn bent_strip_that_is_monge_but_not_characteristic_has_no_solution() {
    // |u_τ| = |x_τ| on a circle: ξ is the tangent, along which the ray leaves at once.
    let problem = CauchyProblem::new(&Eikonal, &Curve::Arc(1.0), 2).unwrap().near(&[0.3, 0.9]).unwrap();
    let class = problem.classify(&LINE).unwrap();
    let Classification::None { transversality, residual, .. } = class else { panic!("{class:?}") };
    // ξ′ = 0 but ξ_τ has the length one.
    assert!(transversality.abs() < ROOT && (residual - 1.0).abs() < 0.5, "{residual}");
    let refused = problem.solve(&LINE, (0.0, 1.0), Refinement::to(1e-2)).err().unwrap();
    assert!(
        matches!(refused, CharacteristicsError::Strip(StripError::Monge { residual, .. }) if 0.5 < residual),
        "{refused}"
    );
    let text = refused.to_string();
    assert!(text.contains("Monge strip but not a characteristic one"), "{text}");
}

#[test]
fn data_faster_than_the_equation_allows_have_no_covector() {
    let problem = CauchyProblem::new(&Eikonal, &Curve::Straight(1.5), 2).unwrap().near(&[1.0, 0.3]).unwrap();
    let class = problem.classify(&LINE).unwrap();
    // Φ ≥ (1.5² − 1)/2 on the line of covectors.
    assert!(matches!(class, Classification::NoCovector { residual, .. } if 0.625 <= residual), "{class:?}");
    let error = problem.initial_point(&[0.2]).err();
    assert!(
        matches!(error, Some(CharacteristicsError::Strip(StripError::NoInitialCovector { residual, .. })) if 0.625 <= residual)
    );
    let none = problem.initial_points(&[0.2], Search { from: -3.0, to: 3.0, parts: 30 }).unwrap();
    assert!(none.is_empty());
}

#[test]
fn linear_equation_on_its_own_characteristic() {
    // u = 0 along the line: any ξ₂ will do.
    let problem = CauchyProblem::new(&Constant, &Curve::Straight(0.0), 2).unwrap();
    let class = problem.classify(&LINE).unwrap();
    assert!(matches!(class, Classification::InfinitelyMany { undetermined: true, .. }), "{class:?}");
    let refused = problem.solve(&LINE, (0.0, 1.0), Refinement::to(1e-2)).err();
    assert!(matches!(
        refused,
        Some(CharacteristicsError::Strip(StripError::Degenerate { kind: StripKind::Undetermined, .. }))
    ));
    // u = τ contradicts it.
    let problem = CauchyProblem::new(&Constant, &Curve::Straight(1.0), 2).unwrap();
    let class = problem.classify(&LINE).unwrap();
    assert!(
        matches!(class, Classification::NoCovector { residual, slope, .. } if (residual - 1.0).abs() < EXACT && slope.abs() < EXACT),
        "{class:?}"
    );
}

#[test]
fn given_covector_decides_between_infinitely_many_and_none() {
    let problem = CauchyProblem::new(&Constant, &Given(0.0, 2.0), 2).unwrap();
    let class = problem.classify(&LINE).unwrap();
    assert!(matches!(class, Classification::InfinitelyMany { undetermined: false, .. }), "{class:?}");
    let problem = CauchyProblem::new(&Constant, &Given(1.0, 2.0), 2).unwrap();
    let class = problem.classify(&LINE).unwrap();
    assert!(matches!(class, Classification::None { residual, .. } if 0.5 < residual), "{class:?}");
    // |ξ| = 1 is asked for.
    let problem = CauchyProblem::new(&Eikonal, &Given(0.0, 2.0), 2).unwrap();
    let error = problem.classify(&LINE).err();
    assert!(
        matches!(error, Some(CharacteristicsError::Strip(StripError::NotAStrip { condition: 1, residual, .. })) if (residual - 1.5).abs() < EXACT)
    );
}

#[test]
fn points_where_part_of_the_strip_degenerates_are_named() {
    // The parabola touches the characteristics y = const at τ = 0.
    let problem = CauchyProblem::new(&Constant, &Curve::Tangent, 2).unwrap();
    let class = problem.classify(&LINE).unwrap();
    let Classification::Partial { points } = &class else { panic!("{class:?}") };
    assert_eq!(points.len(), 1);
    assert!(points[0].parameters[0].abs() < ROOT && points[0].determinant.abs() < ROOT, "{points:?}");
    let refused = problem.solve(&LINE, (0.0, 1.0), Refinement::to(1e-2)).err();
    assert!(matches!(refused, Some(CharacteristicsError::Strip(StripError::Degenerate { .. }))));

    // u = sin τ on a line of the plane of light: the ray grazes the line where cos τ = 1, without a change of sign.
    let problem = CauchyProblem::new(&Eikonal, &Curve::Sine, 2).unwrap().near(&[0.8, 0.6]).unwrap();
    let class = problem.classify(&LINE).unwrap();
    let Classification::Partial { points } = &class else { panic!("{class:?}") };
    // A double root is known to the root of rounding, and tangency is decided at a sine of 1e-6.
    assert!(points.len() == 1 && points[0].parameters[0].abs() < 1e-5, "{points:?}");

    // ξ₁ξ₂ = u with u = y² on x = 0: Φ_ξ vanishes at y = 0.
    let problem = CauchyProblem::new(&Product, &Line::Square, 2).unwrap();
    let class = problem.classify(&LINE).unwrap();
    let Classification::Partial { points } = &class else { panic!("{class:?}") };
    assert!(points.len() == 1 && points[0].parameters[0].abs() < ROOT, "{points:?}");
}

/// Equations whose characteristics stand still where u = a τ on the line y = 0 gives ξ = (a, 0), or (a, 3a).
enum Still {
    /// |ξ|²/2 = 0: constants alone.
    Square,
    /// |ξ − (0.1, 0.3)|²/2 = 0: the plane u = x/10 + 3y/10 + c alone.
    Plane,
    /// ξ₁ ξ₂ = 0: functions of x, and functions of y.
    Cross,
    /// |ξ|²/2 + y = 0: nothing at y = 0 that goes on to both sides.
    Falling,
    /// (ξ₂ − x)²/2 + ξ₁²/2 = 0: nothing, since (0, x) is no gradient.
    Twisted,
    /// |ξ|²/2 = (x − 1/20)²/2.
    Valley,
}
impl FirstOrderPde for Still {
    fn value<T: Real>(&self, x: &[T], _u: T, xi: &[T]) -> T {
        let half = |a: T, b: T| T::lit(0.5) * (a * a + b * b);
        match self {
            Self::Square => half(xi[0], xi[1]),
            Self::Plane => half(xi[0] - T::lit(0.1), xi[1] - T::lit(0.3)),
            Self::Cross => xi[0] * xi[1],
            Self::Falling => half(xi[0], xi[1]) + x[1],
            Self::Twisted => half(xi[0], xi[1] - x[0]),
            Self::Valley => half(xi[0], xi[1]) - half(x[0] - T::lit(0.05), T::zero()),
        }
    }
}

#[test]
fn strip_on_which_characteristics_stand_still_is_neither_unique_nor_infinite() {
    // One solution, many, none: W(A.32), W(A.33) cannot tell them apart. The guess is the root, or far from it.
    let cases = [
        (Still::Square, 0.0, [0.0, 0.0]),
        (Still::Square, 0.0, [0.0, 1.0]),
        (Still::Plane, 0.1, [0.0, 0.0]),
        (Still::Plane, 0.1, [0.1, -20.0]),
        (Still::Cross, 0.0, [0.0, 0.0]),
        (Still::Twisted, 0.0, [0.0, 0.4]),
    ];
    for (equation, slope, guess) in cases {
        let line = Curve::Straight(slope);
        let problem = CauchyProblem::new(&equation, &line, 2).unwrap().near(&guess).unwrap();
        let class = problem.classify(&LINE).unwrap();
        let Classification::Stationary { stationary, points, ref parameters, speed, residual } = class else {
            panic!("{class:?}")
        };
        assert_eq!((stationary, points), (10, 10));
        assert!((parameters[0] + 0.7).abs() <= 0.0 && speed < ROOT && residual <= 0.0, "{class:?}");
        let refused = problem.solve(&LINE, (0.0, 1.0), Refinement::to(1e-2)).err();
        assert!(
            matches!(
                &refused,
                Some(CharacteristicsError::Strip(StripError::Degenerate { kind: StripKind::Stationary, .. }))
            ),
            "{refused:?}"
        );
    }
    // Of the same equation and data, another ξ is undetermined: u = g(y) with g′(0) = 1.
    let problem = CauchyProblem::new(&Still::Cross, &Curve::Straight(0.0), 2).unwrap().near(&[0.0, 1.0]).unwrap();
    let class = problem.classify(&LINE).unwrap();
    assert!(matches!(class, Classification::InfinitelyMany { undetermined: true, .. }), "{class:?}");
}

#[test]
fn strip_on_which_characteristics_stand_still_but_their_covectors_do_not_has_no_solution() {
    let problem = CauchyProblem::new(&Still::Falling, &Curve::Straight(0.0), 2).unwrap();
    let class = problem.classify(&LINE).unwrap();
    // ξΦ_u + Φ_x = (0, 1).
    assert!(matches!(class, Classification::None { residual, .. } if (residual - 1.0).abs() < EXACT), "{class:?}");
    let point = problem.initial_point(&[0.3]).unwrap();
    assert_eq!(point.kind, StripKind::Stationary);
    assert!(point.speed <= 0.0 && (point.characteristic - 1.0).abs() < EXACT, "{point:?}");
}

/// u on y = 0 between whose ends the determinant changes its sign without a zero.
enum Broken {
    /// u = 0; the guess of ξ changes its side at τ = 1/20.
    Sides,
    /// The same at τ = 0, where the slope 3/2 of u leaves no ξ.
    Gap,
    /// u = 0 where |τ| ≥ 1/20, not a number where not.
    Hole,
}
impl InitialManifold for Broken {
    const COVECTOR: Covector = Covector::Guessed;
    fn place<T: Real>(&self, tau: &[T], x: &mut [T]) -> T {
        let t = tau[0];
        (x[0], x[1]) = (t, T::zero());
        match self {
            Self::Sides => T::zero(),
            Self::Gap => T::lit(1.5) * t / (T::one() + T::lit(400.0) * t * t),
            Self::Hole => T::zero() * (t * t - T::lit(0.0025)).sqrt(),
        }
    }
    fn covector<T: Real>(&self, tau: &[T], xi: &mut [T]) {
        let side = if matches!(self, Self::Sides) { tau[0] - T::lit(0.05) } else { tau[0] };
        (xi[0], xi[1]) = (T::zero(), T::one().copysign(side));
    }
}

#[test]
fn change_of_sign_without_a_zero_is_named_for_what_it_is() {
    let problem = CauchyProblem::new(&Eikonal, &Broken::Sides, 2).unwrap();
    let class = problem.classify(&LINE).unwrap();
    let Classification::Partial { points } = &class else { panic!("{class:?}") };
    assert!(points.len() == 1 && points[0].kind == StripKind::Jump, "{points:?}");
    assert!((points[0].parameters[0] - 0.05).abs() < ROOT && (points[0].speed - 1.0).abs() < EXACT, "{points:?}");
    assert!((points[0].determinant.abs() - 1.0).abs() < EXACT);
    let refused = problem.solve(&LINE, (0.0, 1.0), Refinement::to(1e-2)).err();
    assert!(matches!(refused, Some(CharacteristicsError::Strip(StripError::Degenerate { kind: StripKind::Jump, .. }))));

    let problem = CauchyProblem::new(&Eikonal, &Broken::Gap, 2).unwrap();
    let class = problem.classify(&LINE).unwrap();
    let Classification::Partial { points } = &class else { panic!("{class:?}") };
    assert!(points.len() == 1 && points[0].kind == StripKind::NoCovector, "{points:?}");
    // Φ ≥ (1.5² − 1)/2.
    assert!(points[0].parameters[0].abs() < ROOT && 0.625 <= points[0].equation, "{points:?}");

    // Other errors between two points are errors.
    let problem = CauchyProblem::new(&Eikonal, &Broken::Hole, 2).unwrap();
    assert!(matches!(problem.classify(&LINE).err(), Some(CharacteristicsError::NotFinite { quantity: "u(τ)", .. })));

    // Φ_ξ = (0, τ − 1/20) vanishes with a sine that does not.
    let problem = CauchyProblem::new(&Still::Valley, &Given(1.0, -0.05), 2).unwrap();
    let class = problem.classify(&LINE).unwrap();
    let Classification::Partial { points } = &class else { panic!("{class:?}") };
    assert!(points.len() == 1 && points[0].kind == StripKind::Stationary, "{points:?}");
    assert!((points[0].parameters[0] - 0.05).abs() < ROOT && points[0].speed < ROOT, "{points:?}");
}

/// Surfaces in space with u on them.
enum Surface {
    /// u = τ¹ on the plane x³ = 0.
    Plane,
    /// u = τ¹ on the unit cylinder by angle and height.
    Cylinder,
    /// u = τ² on (τ¹, τ², τ¹²).
    Trough,
}
impl InitialManifold for Surface {
    fn place<T: Real>(&self, tau: &[T], x: &mut [T]) -> T {
        let (a, b) = (tau[0], tau[1]);
        match self {
            Self::Plane => {
                (x[0], x[1], x[2]) = (a, b, T::zero());
                a
            }
            Self::Cylinder => {
                let (s, c) = a.sin_cos();
                (x[0], x[1], x[2]) = (c, s, b);
                a
            }
            Self::Trough => {
                (x[0], x[1], x[2]) = (a, b, a * a);
                b
            }
        }
    }
}

const SQUARE: [ParameterInterval; 2] =
    [ParameterInterval { from: -0.7, to: 1.1, parts: 3 }, ParameterInterval { from: 0.1, to: 0.9, parts: 2 }];

#[test]
fn strip_manifolds_in_space_are_classified_alike() {
    // ξ = e₁ in the plane: its lines are rays.
    let problem = CauchyProblem::new(&Eikonal, &Surface::Plane, 3).unwrap().near(&[1.0, 0.2, 0.4]).unwrap();
    let class = problem.classify(&SQUARE).unwrap();
    assert!(matches!(class, Classification::InfinitelyMany { residual, .. } if residual < ROOT), "{class:?}");
    // ξ is the tangent of the circles of the cylinder, which are no rays.
    let problem = CauchyProblem::new(&Eikonal, &Surface::Cylinder, 3).unwrap().near(&[0.5, 0.8, 0.1]).unwrap();
    let class = problem.classify(&SQUARE).unwrap();
    assert!(matches!(class, Classification::None { residual, .. } if 0.5 < residual), "{class:?}");
    let refused = problem.solve(&SQUARE, (0.0, 1.0), Refinement::to(1e-1)).err();
    assert!(matches!(refused, Some(CharacteristicsError::Strip(StripError::Monge { .. }))));
    // The bottom of the trough is tangent to the lines along x¹: one point on each edge across it.
    let problem = CauchyProblem::new(&Constant, &Surface::Trough, 3).unwrap();
    let class = problem.classify(&SQUARE).unwrap();
    let Classification::Partial { points } = &class else { panic!("{class:?}") };
    assert!(points.len() == 3 && points.iter().all(|point| point.parameters[0].abs() < ROOT), "{points:?}");
}

#[test]
fn all_covectors_of_a_search_satisfy_the_strip_conditions() {
    let problem = CauchyProblem::new(&Eikonal, &Wave, 2).unwrap();
    let found = problem.initial_points(&[0.4], Search { from: -2.0, to: 2.0, parts: 16 }).unwrap();
    assert_eq!(found.len(), 2);
    for point in &found {
        assert!(point.equation.abs() < EXACT && point.strip[0].abs() < EXACT, "{point:?}");
        assert_eq!(point.kind, StripKind::Transversal);
    }
    assert!(found[0].determinant * found[1].determinant < 0.0);
}
