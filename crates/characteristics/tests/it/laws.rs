//! Identities of characteristics, for any data.

use nalgebra::Vector3;
use piola_characteristics::CharacteristicsError;
use piola_characteristics::{
    CauchyProblem, CharacteristicField, CharacteristicSolution, Classification, Covector, DegeneratePoint,
    FirstOrderPde, Front, Generator, InitialManifold, MongeCone, Overlap, ParameterInterval, RayField, RayPoint,
    Refinement, Search, StripKind,
};
use piola_integrators::{Field, Tolerance};
use piola_numerics::Real;
use piola_testkit::strategies::random_cases;
use piola_testkit::{Tol, assert_close, assert_close_at_scale, difference_quotient};
use proptest::prelude::*;

use super::systems::{
    Bent, ByPolar, Eikonal, Ellipsoid, Hill, Multiplied, Parabola, PolarEikonal, Relabelled, Reparametrised, Turned,
    Wave,
};

fn integrated() -> Tol {
    Tol::stated(1e-11, "a few dozen steps of local error 1e-13")
}

fn ray<P: FirstOrderPde, M: InitialManifold>(equation: &P, manifold: &M, tau: f64, s: f64) -> RayPoint {
    CauchyProblem::new(equation, manifold, 2).unwrap().characteristic(&[tau], s).unwrap()
}

/// A manifold about the axis x² = 0 turned, and moved away from the place where polar coordinates end.
fn away<M>(inner: M, angle: f64) -> Turned<M> {
    Turned { inner, angle, shift: [0.0, -1.2] }
}

/// Data of the eikonal equation on curves that its rays may touch, with ξ along the curve as a guess.
#[derive(Clone, Copy, Debug)]
enum Touched {
    /// u = a τ on the line x² = 0.
    Straight(f64),
    /// u = sin τ on the line x² = 0.
    Sine,
    /// u = τ on a circle of the radius one.
    Arc,
}

impl InitialManifold for Touched {
    const COVECTOR: Covector = Covector::Guessed;
    fn place<T: Real>(&self, tau: &[T], x: &mut [T]) -> T {
        (x[0], x[1]) = (tau[0], T::zero());
        match *self {
            Self::Straight(a) => T::lit(a) * tau[0],
            Self::Sine => tau[0].sin(),
            Self::Arc => {
                (x[0], x[1]) = (tau[0].sin(), T::one() - tau[0].cos());
                tau[0]
            }
        }
    }
    fn covector<T: Real>(&self, tau: &[T], xi: &mut [T]) {
        let (s, c) = if matches!(self, Self::Arc) { tau[0].sin_cos() } else { (T::zero(), T::one()) };
        // A little to the left of the curve.
        (xi[0], xi[1]) = (c - T::lit(0.3) * s, s + T::lit(0.3) * c);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(1_000)))]

    /// W(A.20), W(A.25): Φ stays zero and ξ = ∇u, with ∇u from the ray map.
    #[test]
    fn equation_is_conserved_and_covector_is_gradient(tau in -2.0..2.0_f64, s in -0.4..0.6_f64) {
        let point = ray(&Bent, &Wave, tau, s);
        // An integral: what a few dozen steps of local error 1e-13 leave of it.
        prop_assert!(point.equation.abs() < 1e-12, "{}", point.equation);
        let loose = integrated().times(1.0 / point.determinant.abs().min(1.0));
        prop_assert!(point.gradient_residual <= loose.value(), "{point:?}");
    }

    #[test]
    fn turned_coordinates_leave_the_solution(
        tau in -2.0..2.0_f64, s in -0.4..0.6_f64, angle in -3.0..3.0_f64, a in -1.0..1.0_f64, b in -1.0..1.0_f64,
    ) {
        let shift = [a, b];
        let here = ray(&Bent, &Wave, tau, s);
        let there = ray(&Turned { inner: Bent, angle, shift }, &Turned { inner: Wave, angle, shift }, tau, s);
        assert_close_at_scale("u", &[there.u], &[here.u], 1.0, integrated());
        assert_close_at_scale("D", &[there.determinant], &[here.determinant], 1.0, integrated());
        let (sin, cos) = angle.sin_cos();
        let back = [cos * there.x[0] - sin * there.x[1] + a, sin * there.x[0] + cos * there.x[1] + b];
        assert_close_at_scale("x", &back, &here.x, 3.0, integrated());
        let back = [cos * there.xi[0] - sin * there.xi[1], sin * there.xi[0] + cos * there.xi[1]];
        assert_close_at_scale("ξ", &back, &here.xi, 1.0, integrated());
    }

    #[test]
    fn relabelled_coordinates_leave_the_solution_and_turn_the_determinant(tau in -2.0..2.0_f64, s in -0.4..0.6_f64) {
        let (here, there) = (ray(&Bent, &Wave, tau, s), ray(&Relabelled(Bent), &Relabelled(Wave), tau, s));
        assert_close_at_scale("u", &[there.u], &[here.u], 1.0, integrated());
        assert_close_at_scale("x", &[there.x[1], there.x[0]], &here.x, 1.0, integrated());
        assert_close_at_scale("D", &[-there.determinant], &[here.determinant], 1.0, integrated());
    }

    #[test]
    fn polar_coordinates_leave_the_solution(tau in -2.0..2.0_f64, s in -0.4..1.5_f64, angle in -3.0..3.0_f64) {
        let wave = || away(Wave, angle);
        let (here, there) = (ray(&Eikonal, &wave(), tau, s), ray(&PolarEikonal, &ByPolar(wave()), tau, s));
        assert_close_at_scale("u, s", &[there.u, there.s], &[here.u, s], 1.0, integrated());
        let (radius, (sin, cos)) = (there.x[0], there.x[1].sin_cos());
        assert_close_at_scale("x", &[radius * cos, radius * sin], &here.x, 3.0, integrated());
        let across = there.xi[1] / radius;
        let xi = [there.xi[0] * cos - across * sin, there.xi[0] * sin + across * cos];
        assert_close_at_scale("ξ", &xi, &here.xi, 1.0, integrated());
        // dx¹ dx² = r dr dφ.
        assert_close_at_scale("D", &[there.determinant * radius], &[here.determinant], 2.0, integrated());
    }

    /// W(A.40): the completed ξ is that of a strip, and its derivatives are those of the completion.
    #[test]
    fn completed_covectors_form_a_strip(tau in -2.0..2.0_f64) {
        let problem = CauchyProblem::new(&Bent, &Wave, 2).unwrap();
        let point = problem.initial_point(&[tau]).unwrap();
        let rounding = Tol::ulps(32.0);
        assert_close_at_scale("Φ, u_τ − ξ·x_τ", &[point.equation, point.strip[0]], &[0.0, 0.0], 1.0, rounding);
        let quotient = difference_quotient(|tau| problem.initial_point(tau).unwrap().xi, &[tau], &[1.0]);
        assert_close_at_scale("ξ_τ", &point.xi_tau, &quotient, 1.0, Tol::stated(1e-9, "a difference quotient"));
    }

    /// det(x_s, x_τ) and its slope against differences of rays.
    #[test]
    fn ray_map_equals_differences_of_rays(tau in -2.0..2.0_f64, s in -0.3..0.5_f64) {
        let point = ray(&Bent, &Wave, tau, s);
        let by_s = difference_quotient(|s| ray(&Bent, &Wave, tau, s[0]).x, &[s], &[1.0]);
        let by_tau = difference_quotient(|tau| ray(&Bent, &Wave, tau[0], s).x, &[tau], &[1.0]);
        let differences = Tol::stated(1e-9, "a difference quotient of integrated rays");
        assert_close_at_scale("x_s", &point.jacobian[..2], &by_s, 1.0, differences);
        assert_close_at_scale("x_τ", &point.jacobian[2..], &by_tau, 1.0, differences);
    }

    /// W(A.19): x′ = Φ_ξ, u′ = ξ·Φ_ξ, ξ′ = −Φ_x − Φ_u ξ, with the slopes of Φ as differences.
    #[test]
    fn rate_of_a_characteristic_equals_differences_of_the_equation(y in proptest::array::uniform5(-1.0..1.0_f64)) {
        let phi = |y: &[f64]| vec![Bent.value(&y[..2], y[2], &y[3..])];
        let slopes: [f64; 5] = core::array::from_fn(|i| {
            let direction: [f64; 5] = core::array::from_fn(|j| f64::from(u8::from(i == j)));
            difference_quotient(phi, &y, &direction)[0]
        });
        let [by_x1, by_x2, by_u, by_xi1, by_xi2] = slopes;
        let expected = [by_xi1, by_xi2, y[3] * by_xi1 + y[4] * by_xi2, -by_x1 - by_u * y[3], -by_x2 - by_u * y[4]];
        let mut rate = [0.0; 5];
        CharacteristicField::new(&Bent, 2).rate(0.0, &y, &mut rate).unwrap();
        assert_close_at_scale("y′", &rate, &expected, 1.0, Tol::stated(1e-9, "difference quotients"));
        // With neighbours it is the same characteristic.
        let (mut both, mut start) = ([0.0; 10], [0.0; 10]);
        start[..5].copy_from_slice(&y);
        RayField::new(&Bent, 2, 1).rate(0.0, &start, &mut both).unwrap();
        assert_close_at_scale("with a neighbour", &both[..5], &rate, 1.0, Tol::ulps(8.0));
    }

    #[test]
    fn slope_of_determinant_equals_its_difference(y in proptest::array::uniform10(-1.0..1.0_f64)) {
        let mut field = RayField::new(&Bent, 2, 1);
        let mut rate = [0.0; 10];
        field.rate(0.0, &y, &mut rate).unwrap();
        let slope = field.determinant_and_slope(&y).tangent;
        let quotient = difference_quotient(|y| vec![RayField::new(&Bent, 2, 1).determinant(y)], &y, &rate);
        assert_close_at_scale("D′", &[slope], &quotient, 1.0, Tol::stated(1e-9, "a difference quotient"));
    }

    /// W(A.35): at every point of a characteristic its direction is a generator of the cone, and a Monge direction.
    #[test]
    fn characteristics_run_along_generators_of_the_cone(tau in -2.0..2.0_f64, s in -0.4..0.6_f64) {
        let point = ray(&Bent, &Wave, tau, s);
        let cone = MongeCone::new(&Bent, &point.x, point.u).unwrap();
        let x_rate = &point.jacobian[..2];
        let generator = cone.generator_over(x_rate, &[point.xi[0] + 0.05, point.xi[1] - 0.05]).unwrap();
        assert_close_at_scale("ξ", &generator.covector, &point.xi, 1.0, integrated());
        let u_rate = generator.u_rate;
        prop_assert!(cone.monge_residual(x_rate, u_rate, &point.xi).unwrap().largest() < integrated().value());
        // Neither a steeper direction nor one across it belongs to the strip.
        prop_assert!(0.01 < cone.monge_residual(x_rate, u_rate + 0.2, &point.xi).unwrap().largest());
        prop_assert!(0.1 < cone.monge_residual(&[-x_rate[1], x_rate[0]], 0.0, &point.xi).unwrap().largest());
    }
}

/// Along a chord of the circle |ξ| = 1 there are two covectors, in the order of c; each is its own direction, and u′ = 1.
#[test]
fn generators_along_a_chord_are_those_at_its_ends() {
    let cone = MongeCone::new(&Eikonal, &[0.3, -0.2], 0.5).unwrap();
    // |(1 + c, c)|² = 1 at c = −1 and at c = 0.
    let search = Search { from: -2.1, to: 1.3, parts: 7 };
    let found = cone.generators_along(&[1.0, 0.0], &[1.0, 1.0], search).unwrap();
    let joined = |part: fn(&Generator) -> &[f64]| found.iter().flat_map(part).copied().collect::<Vec<_>>();
    let few = Tol::ulps(8.0);
    assert_close("ξ", &joined(|generator| &generator.covector), &[0.0, -1.0, 1.0, 0.0], few);
    assert_close("x′", &joined(|generator| &generator.x_rate), &[0.0, -1.0, 1.0, 0.0], few);
    assert_close("u′", &[found[0].u_rate, found[1].u_rate], &[1.0, 1.0], few);
    assert_close("ξ′", &joined(|generator| &generator.covector_rate), &[0.0; 4], few);
}

const WAVE: [ParameterInterval; 1] = [ParameterInterval { from: -1.5, to: 1.5, parts: 6 }];

/// The solution does not know how its manifold or its characteristics are parametrised.
#[test]
fn solution_does_not_depend_on_parameters() {
    let refinement = Refinement::to(1e-2);
    let (other, faster) = (Reparametrised(Wave), Multiplied(Bent));
    let plain = CauchyProblem::new(&Bent, &Wave, 2).unwrap();
    let solution: CharacteristicSolution<_, _> = plain.solve(&WAVE, (0.0, 0.6), refinement).unwrap();
    let renamed = CauchyProblem::new(&Bent, &other, 2).unwrap().solve(&WAVE, (0.0, 0.6), refinement).unwrap();
    let multiplied = CauchyProblem::new(&faster, &Wave, 2).unwrap().solve(&WAVE, (0.0, 0.1), refinement).unwrap();
    for (tau, s) in [(-0.9, 0.1), (-0.3, 0.15), (0.2, 0.05), (0.7, 0.14)] {
        let point = plain.characteristic(&[tau], s).unwrap();
        let found = solution.at(&point.x).unwrap();
        assert_close_at_scale("s, τ", &[found.point.s, found.point.parameters[0]], &[s, tau], 1.0, integrated());
        for sheet in [renamed.at(&point.x).unwrap(), multiplied.at(&point.x).unwrap()] {
            assert_close_at_scale("u", &[sheet.point.u], &[point.u], 1.0, integrated());
            assert_close_at_scale("ξ", &sheet.point.xi, &point.xi, 1.0, integrated());
        }
    }
}

/// Where waves first meet their neighbours is a place, whatever coordinates it has.
#[test]
fn polar_coordinates_leave_the_first_loss_of_invertibility() {
    // Away from the cut of the angle.
    for angle in [0.0, 0.7] {
        let (wave, by_polar) = (away(Wave, angle), ByPolar(away(Wave, angle)));
        let cartesian = CauchyProblem::new(&Eikonal, &wave, 2).unwrap();
        let polar = CauchyProblem::new(&PolarEikonal, &by_polar, 2).unwrap();
        let here = cartesian.solve(&WAVE, (0.0, 6.0), Refinement::to(3e-2)).unwrap();
        let there = polar.solve(&WAVE, (0.0, 6.0), Refinement::to(3e-2)).unwrap();
        let here = here.first_loss_of_invertibility().unwrap().unwrap();
        let there = there.first_loss_of_invertibility().unwrap().unwrap();
        assert_close("s", &[there.point.s], &[here.point.s], integrated());
        assert_eq!((there.at_edge, there.point.touching), (here.at_edge, here.point.touching));
        // s* is flat where it is least, and τ, u and x are known to the root of the tolerance.
        let found = Tol::stated(1e-6, "the root of the tolerance");
        assert_close_at_scale("τ", &there.point.parameters, &here.point.parameters, 1.0, found);
        assert_close_at_scale("u", &[there.point.u], &[here.point.u], 1.0, found);
        let (sin, cos) = there.point.x[1].sin_cos();
        let place = [there.point.x[0] * cos, there.point.x[0] * sin];
        assert_close_at_scale("x", &place, &here.point.x, 1.0, found);
    }
}

/// Whether there is one solution, none or infinitely many does not depend on coordinates; angles between directions do.
#[test]
fn polar_coordinates_leave_the_classification() {
    let interval = [ParameterInterval { from: -0.7, to: 1.1, parts: 9 }];
    let cases = [
        (Touched::Straight(0.5), "Unique"),
        (Touched::Straight(1.0), "InfinitelyMany"),
        (Touched::Arc, "None"),
        (Touched::Straight(1.5), "NoCovector"),
        (Touched::Sine, "Partial"),
    ];
    for ((data, name), angle) in cases.into_iter().flat_map(|case| [(case, 0.0), (case, 0.7), (case, -2.0)]) {
        let (manifold, by_polar) = (away(data, angle), ByPolar(away(data, angle)));
        let here = CauchyProblem::new(&Eikonal, &manifold, 2).unwrap().classify(&interval).unwrap();
        let there = CauchyProblem::new(&PolarEikonal, &by_polar, 2).unwrap().classify(&interval).unwrap();
        for class in [&here, &there] {
            assert!(format!("{class:?}").starts_with(name), "{data:?} turned by {angle}: {class:?}");
        }
        if let (Classification::Partial { points: here }, Classification::Partial { points: there }) = (&here, &there) {
            // There ξ has no derivative, so that what the strip is at this very point is not told.
            let places =
                |points: &[DegeneratePoint]| -> Vec<f64> { points.iter().map(|point| point.parameters[0]).collect() };
            let (here, there) = (places(here), places(there));
            assert_close_at_scale("τ", &there, &here, 1.0, Tol::stated(1e-5, "a ray that grazes: a double root of Φ"));
        }
    }
}

/// ξ = ∇u by differences of u at displaced points, each found by inverting the ray map anew.
#[test]
fn covector_equals_difference_quotient_of_solution() {
    let solution = CauchyProblem::new(&Bent, &Wave, 2).unwrap().solve(&WAVE, (0.0, 0.5), Refinement::to(1e-2)).unwrap();
    let x = [0.3, 0.2];
    let xi = solution.at(&x).unwrap().point.xi;
    let u = |x: &[f64]| vec![solution.at(x).unwrap().point.u];
    let quotients = [difference_quotient(u, &x, &[1.0, 0.0]), difference_quotient(u, &x, &[0.0, 1.0])].concat();
    assert_close_at_scale("ξ", &xi, &quotients, 1.0, Tol::stated(1e-9, "a difference quotient"));
}

/// A front in lanes is its characteristics one by one, and the same to the last bit in pieces.
#[test]
fn front_in_lanes_equals_single_characteristics() {
    let problem = CauchyProblem::new(&Bent, &Wave, 2).unwrap();
    let interval = [ParameterInterval { from: -1.5, to: 1.5, parts: 9 }];
    let mut front = problem.front(&interval).unwrap();
    assert_eq!(front.len(), 10);
    let tolerance = Tolerance::relative(1e-13).unwrap();
    let mut pieces: Vec<Front> = front.rows().chunks(4 * 5).map(|rows| Front::new(2, rows.to_vec()).unwrap()).collect();
    front.advance(&Bent, 0.4, tolerance).unwrap();
    for piece in &mut pieces {
        piece.advance(&Bent, 0.4, tolerance).unwrap();
    }
    let joined: Vec<f64> = pieces.iter().flat_map(|piece| piece.rows().iter().copied()).collect();
    assert!(front.rows().iter().zip(&joined).all(|(a, b)| a.to_bits() == b.to_bits()));
    // An integral, as above.
    assert!(front.drift(&Bent) < 1e-12);
    for (i, row) in front.rows().chunks(5).enumerate() {
        let point = problem.characteristic(&[-1.5 + 3.0 * i as f64 / 9.0], 0.4).unwrap();
        assert_close_at_scale("x", &row[..2], &point.x, 1.0, integrated());
        assert_close_at_scale("ξ", &row[3..], &point.xi, 1.0, integrated());
    }
}

/// What one workspace did before leaves no trace: a characteristic is the same to the last bit among any others.
#[test]
fn characteristics_do_not_depend_on_each_other() {
    let problem = CauchyProblem::new(&Bent, &Wave, 2).unwrap();
    let unrefined = Refinement { most_levels: 4, ..Refinement::to(1e3) };
    let solve = |parts| {
        let interval = [ParameterInterval { from: -1.5, to: 1.5, parts }];
        problem.solve(&interval, (-0.2, 0.4), unrefined).unwrap()
    };
    let (coarse, fine) = (solve(3), solve(12));
    assert_eq!((coarse.rays().len(), fine.rays().len()), (4, 13));
    for (i, ray) in coarse.rays().iter().enumerate() {
        let other = &fine.rays()[4 * i];
        // The same steps in another order of the rays: a few ulp of states of a few units.
        assert!(ray.states.iter().zip(&other.states).all(|(a, b)| (a - b).abs() < 1e-14));
        assert_eq!(ray.parameters, other.parameters);
    }
    let again = solve(12);
    for (ray, other) in fine.rays().iter().zip(again.rays()) {
        assert!(ray.states.iter().zip(&other.states).all(|(a, b)| a.to_bits() == b.to_bits()));
    }
    let (x, u, xi) = fine.strip(4, 0).unwrap();
    let point = problem.characteristic(&[-0.5], -0.2).unwrap();
    assert_close_at_scale("x", x, &point.x, 1.0, integrated());
    assert_close_at_scale("u, ξ", &[u, xi[0], xi[1]], &[point.u, point.xi[0], point.xi[1]], 1.0, integrated());
    assert!(fine.strip(13, 0).is_none() && fine.strip(0, 99).is_none());
}

/// In four variables: tetrahedra of parameters, six a box, refined where the hill is curved.
#[test]
fn solution_in_four_variables_is_refined_and_inverted() {
    let problem = CauchyProblem::new(&Eikonal, &Hill, 4).unwrap().near(&[0.0, 0.0, 0.0, 1.0]).unwrap();
    let short = ParameterInterval { from: -1.0, to: 1.0, parts: 2 };
    let box_of_three = [short, short, ParameterInterval { from: -0.5, to: 2.5, parts: 2 }];
    let given = problem.solve(&box_of_three, (0.0, 0.5), Refinement::to(f64::INFINITY)).unwrap();
    assert_eq!((given.rays().len(), given.simplices().len()), (27, 48));
    let solution = problem.solve(&box_of_three, (0.0, 0.5), Refinement::to(1e-4)).unwrap();
    assert!(27 < solution.rays().len() && solution.interpolation_error() <= 1e-4, "{}", solution.rays().len());
    for solution in [&given, &solution] {
        // The tetrahedra fill the box, and every side belongs to two of them or lies in its surface.
        let tau = |i: usize| &solution.rays()[i].parameters;
        let mut sides = std::collections::BTreeMap::<Vec<usize>, usize>::new();
        let mut volume = 0.0;
        for simplex in solution.simplices() {
            let edge = |i: usize| Vector3::from_fn(|k, _| tau(simplex[i])[k] - tau(simplex[0])[k]);
            volume += edge(1).cross(&edge(2)).dot(&edge(3)).abs() / 6.0;
            for left_out in 0..4 {
                let mut side = simplex.clone();
                side.remove(left_out);
                side.sort_unstable();
                *sides.entry(side).or_default() += 1;
            }
        }
        assert_close("volume", &[volume], &[12.0], Tol::ulps(16.0));
        for (side, count) in sides {
            let at_surface = (0..3).any(|k| {
                let value = tau(side[0])[k];
                (value <= box_of_three[k].from || box_of_three[k].to <= value)
                    && side.iter().all(|&i| (tau(i)[k] - value).abs() <= 0.0)
            });
            assert_eq!(count, if at_surface { 1 } else { 2 }, "{side:?}");
        }
    }
    let point = problem.characteristic(&[0.3, -0.2, 0.6], 0.35).unwrap();
    assert!(point.gradient_residual < 1e-12 && point.equation.abs() < 1e-13);
    let found = solution.at(&point.x).unwrap();
    assert_close_at_scale("τ", &found.point.parameters, &[0.3, -0.2, 0.6], 1.0, integrated());
    assert_close_at_scale("u", &[found.point.u], &[0.35], 1.0, integrated());
}

/// Waves from a sphere inwards: within it the distance to it, at the centre of curvature no sheet of the data.
#[test]
fn points_in_space_are_evaluated_like_single_ones() {
    let sphere = Ellipsoid([1.0; 3]);
    let problem = CauchyProblem::new(&Eikonal, &sphere, 3).unwrap();
    let patch = ParameterInterval { from: -0.8, to: 0.8, parts: 3 };
    let solution = problem.solve(&[patch; 2], (0.0, 1.6), Refinement::to(3e-2)).unwrap();
    let radii = [0.9, 0.7, 0.25, -0.3, 1.2];
    let mut points: Vec<Vec<f64>> = radii.iter().map(|r| [0.8, 0.6, 0.0].map(|x| r * x).to_vec()).collect();
    points.push(vec![0.0, 0.1, 0.9]);
    for overlap in [Overlap::FirstArrival, Overlap::Nothing] {
        let sheets = solution.at_points(&points, overlap).unwrap();
        for (sheet, radius) in sheets.iter().zip(radii).take(4) {
            let sheet = sheet.as_ref().unwrap();
            assert_close_at_scale("u", &[sheet.point.u], &[1.0 - radius], 1.0, integrated());
            assert_close_at_scale("ξ", &sheet.point.xi, &[-0.8, -0.6, 0.0], 1.0, integrated());
            assert_eq!(sheet.caustics, usize::from(radius < 0.0));
        }
        // Outside of the sphere, and beyond the patch.
        assert!(sheets[4].is_none() && sheets[5].is_none());
    }
    // On the other side of a parabola three arms of the front overlap: the first of them, or nothing.
    let waves = CauchyProblem::new(&Eikonal, &Parabola(0.5), 2).unwrap().near(&[0.0, 1.0]).unwrap();
    let line = [ParameterInterval { from: -3.0, to: 3.0, parts: 8 }];
    let solution = waves.solve(&line, (0.0, 2.5), Refinement::to(1e-2)).unwrap();
    let folded = vec![vec![0.0, 1.5], vec![0.0, 0.5]];
    let first = solution.at_points(&folded, Overlap::FirstArrival).unwrap();
    let single = solution.first_arrival(&folded[0]).unwrap();
    assert_eq!(first[0].as_ref(), Some(&single));
    // The nearest points of y = x²/2 to (0, 3/2) are (±1, 1/2).
    assert_close("u", &[single.point.u], &[2.0_f64.sqrt()], integrated());
    let none = solution.at_points(&folded, Overlap::Nothing).unwrap();
    assert!(none[0].is_none());
    assert_close("u", &[none[1].as_ref().unwrap().point.u], &[0.5], integrated());
    let refused = solution.at_points(&[vec![0.0, 1.0], vec![0.0, f64::NAN]], Overlap::Nothing).unwrap_err();
    assert!(matches!(refused, CharacteristicsError::NotFinite { quantity: "x", index: 1, .. }), "{refused}");
    assert!(solution.at_points(&[vec![0.0; 3]], Overlap::Nothing).is_err());
}

/// In space: the normals of an ellipsoid meet its caustic at the radii of curvature; first at the smallest of them.
#[test]
fn first_loss_inside_an_ellipsoid_is_its_smallest_radius_of_curvature() {
    let ellipsoid = Ellipsoid([1.5, 1.0, 1.25]);
    let problem = CauchyProblem::new(&Eikonal, &ellipsoid, 3).unwrap();
    let patch =
        [ParameterInterval { from: -0.83, to: 0.7, parts: 3 }, ParameterInterval { from: -0.67, to: 0.8, parts: 3 }];
    let solution = problem.solve(&patch, (0.0, 0.9), Refinement::to(3e-2)).unwrap();
    let loss = solution.first_loss_of_invertibility().unwrap().unwrap();
    // At the end of the longest axis the radii are b²/a and c²/a.
    assert_close("s", &[loss.point.s], &[1.0 / 1.5], integrated());
    assert_close_at_scale("τ", &loss.point.parameters, &[0.0, 0.0], 1.0, Tol::stated(1e-6, "descent along a gradient"));
    let caustic = problem.caustic_points(&[0.0, 0.0], 0.0, 1.2).unwrap();
    let radii: Vec<f64> = caustic.iter().map(|point| point.s).collect();
    assert_close("radii", &radii, &[1.0 / 1.5, 1.25 * 1.25 / 1.5], integrated());
    // A point within, on one sheet.
    let point = problem.characteristic(&[0.2, -0.3], 0.4).unwrap();
    let found = solution.at(&point.x).unwrap();
    assert_close_at_scale("u", &[found.point.u], &[0.4], 1.0, integrated());
    assert_close_at_scale("τ", &found.point.parameters, &[0.2, -0.3], 1.0, integrated());
}

/// All rays of a sphere meet in one point, where the determinant (1 − s)² touches zero.
#[test]
fn focus_of_a_sphere_is_a_touching_caustic() {
    let sphere = Ellipsoid([1.0; 3]);
    let problem = CauchyProblem::new(&Eikonal, &sphere, 3).unwrap();
    let caustic = problem.caustic_points(&[0.3, 0.2], 0.0, 1.7).unwrap();
    assert_eq!(caustic.len(), 1, "{caustic:?}");
    assert!(caustic[0].touching);
    assert_close("s", &[caustic[0].s], &[1.0], Tol::stated(1e-9, "a zero of the slope on dense output"));
    assert_eq!(problem.initial_point(&[0.3, 0.2]).unwrap().kind, StripKind::Transversal);
}
