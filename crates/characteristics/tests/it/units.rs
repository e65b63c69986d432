//! Results do not depend on the units of the equation, of x and of u.

use piola_characteristics::{
    CauchyProblem, Classification, Covector, FirstOrderPde, InitialManifold, MongeCone, ParameterInterval,
};
use piola_numerics::Real;
use piola_testkit::{Tol, assert_close, assert_close_at_scale};

use super::systems::{Eikonal, Ellipsoid};

/// A (|ξ|² − k²)/2 = 0: the eikonal equation in units of its own and of u.
struct Measured {
    unit: f64,
    length: f64,
}
impl FirstOrderPde for Measured {
    fn value<T: Real>(&self, _x: &[T], _u: T, xi: &[T]) -> T {
        T::lit(0.5 * self.unit) * (xi[0] * xi[0] + xi[1] * xi[1] - T::lit(self.length * self.length))
    }
}

#[test]
fn generator_over_a_direction_does_not_depend_on_units() {
    let mut compared = 0;
    for unit in [1e-14, 1e-6, 1.0, 1e6, 1e14] {
        for slope in [1e-12, 1e-3, 1.0, 1e12] {
            let equation = Measured { unit, length: slope };
            let cone = MongeCone::new(&equation, &[0.3, -0.2], 0.5).unwrap();
            for direction in [[0.3, 0.7], [-0.9, 0.2], [0.55, -0.35]] {
                let guess = direction.map(|x| slope * (1.5 * x + 0.05));
                let generator = cone.generator_over(&direction, &guess).unwrap();
                let length = direction[0].hypot(direction[1]);
                let xi = direction.map(|x| slope * x / length);
                let few = Tol::ulps(32.0);
                assert_close("ξ", &generator.covector, &xi, few);
                assert_close("x′", &generator.x_rate, &xi.map(|x| unit * x), few);
                assert_close("u′", &[generator.u_rate], &[unit * slope * slope], few);
                compared += 1;
            }
        }
    }
    assert_eq!(compared, 60);
}

/// u = k R τ on a circle of the radius R by its angle: a strip formed by Monge's, not by characteristics.
struct Arc {
    radius: f64,
    length: f64,
}
impl InitialManifold for Arc {
    const COVECTOR: Covector = Covector::Guessed;
    fn place<T: Real>(&self, tau: &[T], x: &mut [T]) -> T {
        let radius = T::lit(self.radius);
        let (s, c) = tau[0].sin_cos();
        (x[0], x[1]) = (radius * c, radius * s);
        T::lit(self.length) * radius * tau[0]
    }
    fn covector<T: Real>(&self, tau: &[T], xi: &mut [T]) {
        let (s, c) = tau[0].sin_cos();
        (xi[0], xi[1]) = (T::lit(self.length) * (c - s), T::lit(self.length) * (s + c));
    }
}

/// ξ is k times the tangent (−sin τ, cos τ), along which the ray leaves the circle at once: of 0 = ξ′ = `a ξ_τ` the right side
/// is −a k (cos τ, sin τ), of the length a k, and its larger component is the magnitude that it is compared with.
#[test]
fn residual_of_a_monge_strip_does_not_depend_on_units() {
    let mut compared = 0;
    for (unit, radius, length) in
        [(1.0, 1.0, 1.0), (1e3, 1.0, 1.0), (1.0, 1e-3, 1.0), (1e-4, 1e2, 1.0), (1.0, 1.0, 1e-7)]
    {
        let (equation, arc) = (Measured { unit, length }, Arc { radius, length });
        let problem = CauchyProblem::new(&equation, &arc, 2).unwrap();
        for tau in [-0.7, 0.3, 1.1_f64] {
            let point = problem.initial_point(&[tau]).unwrap();
            let (s, c) = tau.sin_cos();
            assert_close("ξ", &point.xi, &[-length * s, length * c], Tol::ulps(64.0));
            assert_close("ξ_τ", &point.xi_tau, &[-length * c, -length * s], Tol::ulps(64.0));
            assert_close("residual", &[point.characteristic], &[1.0 / s.abs().max(c.abs())], Tol::ulps(64.0));
            compared += 1;
        }
        let interval = [ParameterInterval { from: -0.7, to: 1.1, parts: 9 }];
        let class = problem.classify(&interval).unwrap();
        // The ends of the parts that are nearest to a diagonal are τ = ±0.7.
        let Classification::None { residual, .. } = class else { panic!("{class:?}") };
        assert_close("largest residual", &[residual], &[1.0 / 0.7_f64.cos()], Tol::ulps(64.0));
    }
    assert_eq!(compared, 15);
}

/// u = 0 on a line through the origin whose unit normal is given as ξ.
struct Straight {
    along: [f64; 2],
    normal: [f64; 2],
}
impl InitialManifold for Straight {
    const COVECTOR: Covector = Covector::Given;
    fn place<T: Real>(&self, tau: &[T], x: &mut [T]) -> T {
        (x[0], x[1]) = (T::lit(self.along[0]) * tau[0], T::lit(self.along[1]) * tau[0]);
        T::zero()
    }
    fn covector<T: Real>(&self, _tau: &[T], xi: &mut [T]) {
        (xi[0], xi[1]) = (T::lit(self.normal[0]), T::lit(self.normal[1]));
    }
}

/// A normal is known to rounding, and `ξ·x_τ` then to rounding of `|ξ||x_τ|`, whatever the unit of x.
#[test]
fn given_covector_is_a_strip_in_any_unit_of_length() {
    let mut rounded = 0;
    for unit in [1e-9, 1.0, 1e9] {
        for (a, b) in [(1.0, 3.0), (2.0, 7.0), (0.3, 1.9), (5.0, 0.7)] {
            let length = f64::hypot(a, b);
            let line = Straight { along: [a * unit, b * unit], normal: [-b / length, a / length] };
            let point = CauchyProblem::new(&Eikonal, &line, 2).unwrap().initial_point(&[0.2]).unwrap();
            let scale = length * unit;
            assert_close_at_scale("u_τ − ξ·x_τ", &point.strip, &[0.0], scale, Tol::ulps(2.0));
            // Φ_ξ = ξ stands across the line: det(ξ, x_τ) = −|x_τ|.
            assert_close("det", &[point.determinant], &[-scale], Tol::ulps(4.0));
            rounded += usize::from(point.strip[0].abs() > 0.0);
        }
    }
    assert!(0 < rounded);
}

/// All rays of a sphere meet in its centre. Those beside the end of the longest axis of an ellipsoid meet at its two radii of
/// curvature b²/a and c²/a, between which the determinant has an extremum that is no zero.
#[test]
fn caustics_in_space_are_found_in_any_unit_of_length() {
    for radius in [1e-4, 1.0, 1e4] {
        let ellipsoid = Ellipsoid([1.5 * radius, radius, 1.25 * radius]);
        let problem = CauchyProblem::new(&Eikonal, &ellipsoid, 3).unwrap();
        let caustic = problem.caustic_points(&[0.0, 0.0], 0.0, 1.2 * radius).unwrap();
        let found: Vec<f64> = caustic.iter().map(|point| point.s).collect();
        let integrated = Tol::stated(1e-11, "a few dozen steps of local error 1e-13");
        assert_close("radii", &found, &[radius / 1.5, 1.25 * 1.25 * radius / 1.5], integrated);
        let sphere = Ellipsoid([radius; 3]);
        let problem = CauchyProblem::new(&Eikonal, &sphere, 3).unwrap();
        let caustic = problem.caustic_points(&[0.3, 0.2], 0.0, 1.7 * radius).unwrap();
        assert_eq!(caustic.len(), 1, "{radius}: {caustic:?}");
        assert!(caustic[0].touching);
        let dense = Tol::stated(1e-9, "a zero of the slope on dense output");
        assert_close("s", &[caustic[0].s], &[radius], dense);
        assert_close_at_scale("x", &caustic[0].x, &[0.0; 3], radius, dense);
    }
}
