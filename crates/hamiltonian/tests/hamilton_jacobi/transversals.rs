//! Solutions from initial data, their caustics, and the integral conoid.

use core::cell::Cell;

use piola_hamiltonian::PhaseFunction;
use piola_hamiltonian::hamilton_jacobi::{Event, GeodeticDistance, IntegralConoid, PrincipalFunction, Transversals};
use piola_hamiltonian::{HamiltonJacobiError, HamiltonianError};
use piola_numerics::Real;
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use proptest::prelude::*;
use proptest::test_runner::TestRunner;

use super::systems::{Bowl, Magnetic, Particle};

/// U₀ = 0.4 x + sin(x + 0.5 y)/2 as values at one time.
#[derive(Debug)]
struct Wavy;

impl PrincipalFunction for Wavy {
    fn value<T: Real>(&self, q: &[T], _t: T) -> T {
        T::lit(0.4) * q[0] + T::lit(0.5) * (q[0] + T::lit(0.5) * q[1]).sin()
    }
}

/// U = x + 0.3 y² − 0.9 t − 0.1 t²: a curved manifold of events.
#[derive(Debug)]
struct Curved;

impl PrincipalFunction for Curved {
    fn value<T: Real>(&self, q: &[T], t: T) -> T {
        q[0] + T::lit(0.3) * q[1] * q[1] - T::lit(0.9) * t - T::lit(0.1) * t * t
    }
}

/// U = −(a x² + b y²)/2: rays that come together.
#[derive(Debug)]
struct Converging(f64, f64);

impl PrincipalFunction for Converging {
    fn value<T: Real>(&self, q: &[T], _t: T) -> T {
        T::lit(-0.5) * (T::lit(self.0) * q[0] * q[0] + T::lit(self.1) * q[1] * q[1])
    }
}

/// A derivative by central differences of order eight.
fn slope(f: impl Fn(f64) -> f64) -> f64 {
    let h = 2e-3;
    let weights = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];
    (1..=4).zip(weights).map(|(k, weight)| weight * (f(f64::from(k) * h) - f(-f64::from(k) * h)) / h).sum()
}

/// ∂U/∂t + H(q, ∂U/∂q, t) with all derivatives by differences of U alone, and ∂U/∂q against the momenta. False near a caustic,
/// where U has large derivatives, and differences are no measure.
fn residual<H: PhaseFunction, U: PrincipalFunction>(
    h: &H,
    rays: &Transversals<'_, H, U>,
    q: [f64; 2],
    t: f64,
    foot: &Event,
) -> bool {
    let here = rays.solution(&Event::new(&q, t), foot).unwrap();
    if here.jacobian < 0.3 {
        return false;
    }
    assert!(here.caustics.is_empty(), "{here:?}");
    let u =
        |x: f64, y: f64, s: f64| rays.solution(&Event::new(&[q[0] + x, q[1] + y], t + s), &here.foot).unwrap().value;
    let momenta = [slope(|x| u(x, 0.0, 0.0)), slope(|y| u(0.0, y, 0.0))];
    let rate = slope(|s| u(0.0, 0.0, s));
    let size = here.energy.abs().max(1.0);
    let stated = Tol::stated(1e-9, "differences of order eight of values integrated to 1e-13");
    assert_close_at_scale("∂U/∂t + H", &[rate + h.value(&q, &momenta, t)], &[0.0], size, stated);
    assert_close_at_scale("∂U/∂q = p", &momenta, &here.momenta, size, stated);
    assert_close_at_scale("−∂U/∂t = H", &[-rate], &[here.energy], size, stated);
    true
}

fn few_cases() -> TestRunner {
    TestRunner::new(ProptestConfig::with_cases(12))
}

#[test]
fn solution_from_values_solves_the_equation() {
    let compared = Cell::new(0);
    let outcome = few_cases().run(&(-1.0..1.0_f64, -1.0..1.0_f64, -0.3..0.3_f64), |(x, y, t)| {
        let magnetic = Magnetic { mass: 1.0, charge: 1.0, field: 0.5 };
        let start = Event::new(&[x, y], 0.0);
        let bowl = residual(&Bowl, &Transversals::of_values(&Bowl, &Wavy, 0.0), [x, y], t, &start);
        let bent = residual(&magnetic, &Transversals::of_values(&magnetic, &Wavy, 0.0), [x, y], t, &start);
        compared.set(compared.get() + u32::from(bowl) + u32::from(bent));
        Ok(())
    });
    assert_eq!(outcome, Ok(()));
    assert!(12 <= compared.get(), "{} of 24", compared.get());
}

#[test]
fn solution_from_a_manifold_solves_the_equation_and_is_transversal() {
    let compared = Cell::new(0);
    let outcome = few_cases().run(&(-0.5..0.5_f64, -0.2..0.2_f64, 0.05..0.3_f64), |(y, t, later)| {
        let q = [0.9 * t + 0.1 * t * t - 0.3 * y * y, y];
        let rays = Transversals::of_manifold(&Bowl, &Curved, 2.0);
        let start = rays.start(&q, t).unwrap();
        // −p₀/U_q = H₀/U_t.
        let (slopes, energy) = ([1.0, 0.6 * y, -0.9 - 0.2 * t], Bowl.value(&q, &start.momenta, t));
        let ratios = [start.momenta[0] / slopes[0], -energy / slopes[2]];
        assert_close("λ", &ratios, &[start.scale, start.scale], Tol::ulps(64.0));
        assert_close("p₀", &[start.momenta[1]], &[slopes[1] * start.scale], Tol::ulps(64.0));
        let ahead = rays.follow(&start, t + later).unwrap();
        let place = [ahead.coordinates[0], ahead.coordinates[1]];
        compared.set(compared.get() + u32::from(residual(&Bowl, &rays, place, t + later, &start.foot)));
        // The action is the geodetic distance from the foot.
        let event = Event::new(&place, t + later);
        let g = GeodeticDistance::new(&Bowl).between(&start.foot, &event, &start.momenta).unwrap();
        assert_close_at_scale("U = G", &[ahead.value], &[g.distance], 1.0, Tol::stated(1e-11, "shooting"));
        Ok(())
    });
    assert_eq!(outcome, Ok(()));
    assert!(6 <= compared.get(), "{} of 12", compared.get());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn conoid_is_the_geodetic_distance_from_its_vertex(energy in 0.5..4.0_f64, x in -0.5..0.5_f64) {
        let vertex = Event::new(&[x, 0.3], 0.25);
        let fan = IntegralConoid::fan(&Bowl, &vertex, energy, 5).unwrap();
        let conoid = IntegralConoid::new(&Bowl, &vertex, &fan, &[0.5, 1.0]).unwrap();
        for (ray, momenta) in conoid.rays.iter().zip(&fan) {
            let kept = Bowl.value(&vertex.coordinates, momenta, 0.25);
            assert_close("H on the fan", &[kept], &[energy], Tol::ulps(16.0));
            for (point, &time) in ray.points.iter().zip(&conoid.times) {
                assert_eq!(point.folds, 0);
                let g = GeodeticDistance::new(&Bowl).between(&vertex, &Event::new(&point.coordinates, time), momenta).unwrap();
                let tolerance = Tol::stated(1e-10, "shooting");
                assert_close_at_scale("V = G", &[point.value], &[g.distance], 1.0, tolerance);
                assert_close_at_scale("p = ∂G/∂q₁", &point.momenta, &g.final_momenta, 1.0, tolerance);
            }
        }
    }
}

#[test]
fn caustics_of_converging_rays_are_where_optics_puts_them() {
    let free = Particle::oscillator(1.0, 0.0, 2);
    let close = Tol::stated(1e-10, "dense output of order seven");
    // Two focal lines, at t = 1/a and 1/b.
    let astigmatic = Converging(1.0, 0.5);
    let rays = Transversals::of_values(&free, &astigmatic, 0.0);
    let start = rays.start(&[0.3, 0.4], 0.0).unwrap();
    let beyond = rays.follow(&start, 3.0).unwrap();
    let times: Vec<f64> = beyond.caustics.iter().map(|caustic| caustic.time).collect();
    assert_close("times", &times, &[1.0, 2.0], close);
    assert_close("(1 − t)(1 − t/2)", &[beyond.jacobian], &[1.0], close);
    assert!(rays.follow(&start, 1.5).unwrap().jacobian < 0.0);
    // A point focus touches zero without a change of sign, and counts twice.
    let round = Converging(1.0, 1.0);
    let rays = Transversals::of_values(&free, &round, 0.0);
    let beyond = rays.follow(&rays.start(&[0.3, 0.4], 0.0).unwrap(), 1.5).unwrap();
    assert_eq!((beyond.caustics.len(), beyond.caustics[0].multiplicity), (1, 2));
    assert_close("focus", &[beyond.caustics[0].time, beyond.jacobian], &[1.0, 0.25], close);
    // Nothing is regular at the focus itself.
    match rays.solution(&Event::new(&[0.0, 0.0], 1.0), &Event::new(&[0.1, 0.2], 0.0)) {
        Err(HamiltonianError::HamiltonJacobi(HamiltonJacobiError::OnCaustic { ratio })) => assert!(ratio.abs() < 1e-9),
        other => panic!("{other:?}"),
    }
}

#[test]
fn rays_of_a_conoid_fold_at_the_conjugate_points_of_its_vertex() {
    let oscillator = Particle::oscillator(1.0, 2.0, 2);
    let vertex = Event::new(&[0.5, 0.0], 0.0);
    let conoid = IntegralConoid::new(&oscillator, &vertex, &[vec![1.0, 2.0]], &[1.0, 2.0, 4.0]).unwrap();
    let folds: Vec<usize> = conoid.rays[0].points.iter().map(|point| point.folds).collect();
    assert_eq!(folds, [0, 2, 4]); // at t = π/2 and π
    let wrong = IntegralConoid::new(&oscillator, &vertex, &[vec![1.0, 2.0]], &[1.0, -2.0]);
    assert_eq!(wrong, Err(HamiltonianError::TimesNotIncreasing { index: 1, time: -2.0, before: 1.0 }));
    let deep = Particle { mass: 1.0, omega: 0.0, gravity: vec![0.0, -1.0] };
    let below = IntegralConoid::fan(&deep, &Event::new(&[0.0, 3.0], 0.0), 1.0, 4);
    assert!(
        matches!(below, Err(HamiltonianError::HamiltonJacobi(HamiltonJacobiError::NotFound { .. }))),
        "no momentum makes up for the height: {below:?}"
    );
}

/// H = p²/2 + 1/2.
#[derive(Debug)]
struct Lifted;

impl PhaseFunction for Lifted {
    fn value<T: Real>(&self, _q: &[T], p: &[T], _t: T) -> T {
        T::lit(0.5) * (p[0] * p[0] + T::one())
    }
}

/// U = q − v t.
#[derive(Debug)]
struct Moving(f64);

impl PrincipalFunction for Moving {
    fn value<T: Real>(&self, q: &[T], t: T) -> T {
        q[0] - T::lit(self.0) * t
    }
}

#[test]
fn manifolds_that_extremals_touch_are_refused() {
    // λ²/2 − v λ + 1/2 = 0: two roots, a double one, none.
    let start = |speed: f64| Transversals::of_manifold(&Lifted, &Moving(speed), 3.0).start(&[0.0], 0.0);
    assert_close("λ", &[start(1.25).unwrap().scale], &[2.0], Tol::ulps(8.0));
    let touching = start(1.0);
    assert!(
        matches!(touching, Err(HamiltonianError::HamiltonJacobi(HamiltonJacobiError::NotTransversal { .. }))),
        "{touching:?}"
    );
    assert!(matches!(start(0.5), Err(HamiltonianError::HamiltonJacobi(HamiltonJacobiError::NotFound { .. }))));
}
