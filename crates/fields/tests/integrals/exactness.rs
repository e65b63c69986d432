//! Every rule integrates every monomial of its degree exactly.

use nalgebra::{Matrix3, Vector3};
use piola_fields::integral::{
    Ball, Cuboid, Cylinder, Ellipsoid, Quadrature, Region, SphericalShell, SurfacePoint, TetrahedralMesh, VolumePoint,
};
use piola_testkit::{Tol, assert_close_at_scale};

/// Sums are compensated: what remains is the rounding of nodes, weights and powers of the degree.
fn rounding(degree: usize) -> Tol {
    Tol::ulps(4.0).times(4.0 + degree as f64)
}

fn power(x: &Vector3<f64>, [a, b, c]: [usize; 3]) -> f64 {
    let one = |x: f64, n: usize| (0..n).fold(1.0, |product, _| product * x);
    one(x.x, a) * one(x.y, b) * one(x.z, c)
}

/// All exponents with a sum of at most `degree`.
fn monomials(degree: usize) -> impl Iterator<Item = [usize; 3]> {
    (0..=degree).flat_map(move |a| (0..=degree - a).flat_map(move |b| (0..=degree - a - b).map(move |c| [a, b, c])))
}

/// (n − 1)!! for even n, by which moments of circles and spheres are expressed.
fn odd_factorial(n: usize) -> f64 {
    (1..n).step_by(2).map(|k| k as f64).product()
}

fn factorial(n: usize) -> f64 {
    (1..=n).map(|k| k as f64).product()
}

/// ∮ xᵃ yᵇ zᶜ dA over the unit sphere: 4π (a−1)!! (b−1)!! (c−1)!! / (a+b+c+1)!! for even exponents.
fn sphere([a, b, c]: [usize; 3]) -> f64 {
    if [a, b, c].iter().any(|n| n % 2 == 1) {
        return 0.0;
    }
    4.0 * core::f64::consts::PI * odd_factorial(a) * odd_factorial(b) * odd_factorial(c) / odd_factorial(a + b + c + 2)
}

/// ∮ xᵃ yᵇ ds over the unit circle: 2π (a−1)!! (b−1)!! / (a+b)!! for even exponents.
fn circle(a: usize, b: usize) -> f64 {
    if a % 2 == 1 || b % 2 == 1 {
        return 0.0;
    }
    let even_factorial: f64 = (2..=a + b).step_by(2).map(|k| k as f64).product();
    core::f64::consts::TAU * odd_factorial(a) * odd_factorial(b) / even_factorial
}

fn volume_integral(rules: &Quadrature, region: &impl Region<f64>, exponents: [usize; 3]) -> f64 {
    rules.volume_integral(region, |x: &Vector3<f64>| power(x, exponents)).expect("finite")
}

fn surface_integral(rules: &Quadrature, region: &impl Region<f64>, exponents: [usize; 3]) -> f64 {
    rules.surface_integral(region, |point: &SurfacePoint<f64>| power(&point.position, exponents)).expect("finite")
}

#[test]
fn box_rules_equal_products_of_powers_in_each_coordinate() {
    let (lower, upper) = ([-0.5, 0.0, -1.0], [1.0, 0.75, 0.5]);
    let cuboid = Cuboid::new(lower.into(), upper.into()).expect("a box");
    let line = |i: usize, n: usize| {
        let at = |x: f64| (0..=n).fold(1.0, |product, _| product * x) / (n + 1) as f64;
        at(upper[i]) - at(lower[i])
    };
    let at = |i: usize, n: usize, x: f64| power(&Vector3::from_fn(|j, _| if i == j { x } else { 1.0 }), [n; 3]);
    for degree in 0..=9 {
        let rules = Quadrature::of_degree(degree).expect("rules");
        for (a, b, c) in (0..=degree).flat_map(|a| (0..=degree).flat_map(move |b| (0..=degree).map(move |c| (a, b, c))))
        {
            let exponents = [a, b, c];
            let inside = volume_integral(&rules, &cuboid, exponents);
            let exact = line(0, a) * line(1, b) * line(2, c);
            assert_close_at_scale("inside", &[inside], &[exact], 1.6875, rounding(degree));
            let face = |i: usize| {
                let (j, k) = ((i + 1) % 3, (i + 2) % 3);
                let ends = at(i, exponents[i], lower[i]) + at(i, exponents[i], upper[i]);
                ends * line(j, exponents[j]) * line(k, exponents[k])
            };
            let around = surface_integral(&rules, &cuboid, exponents);
            assert_close_at_scale("around", &[around], &[face(0) + face(1) + face(2)], 9.0, rounding(degree));
        }
    }
}

#[test]
fn ball_and_shell_rules_equal_moments_of_spheres() {
    let unit = Ball::new(Vector3::zeros(), 1.0).expect("a ball");
    let shell = SphericalShell::new(Vector3::zeros(), [0.5, 1.0]).expect("a shell");
    for degree in 0..=12 {
        let rules = Quadrature::of_degree(degree).expect("rules");
        for exponents in monomials(degree) {
            let n: usize = exponents.iter().sum();
            let (moment, radial) = (sphere(exponents), (n + 3) as f64);
            let inner = (0..n + 3).fold(1.0, |product, _| product * 0.5);
            let found = [
                surface_integral(&rules, &unit, exponents),
                volume_integral(&rules, &unit, exponents),
                volume_integral(&rules, &shell, exponents),
                surface_integral(&rules, &shell, exponents),
            ];
            let exact = [moment, moment / radial, moment * (1.0 - inner) / radial, moment * (1.0 + 2.0 * inner)];
            assert_close_at_scale("moments", &found, &exact, 4.0, rounding(degree));
        }
    }
}

#[test]
fn ellipsoid_rules_equal_ball_rules_of_the_mapped_polynomial() {
    let semi_axes = Matrix3::new(1.0, 0.2, 0.0, 0.0, 0.5, 0.1, 0.3, 0.0, 0.75);
    let centre = Vector3::new(0.1, -0.2, 0.3);
    let ellipsoid = Ellipsoid::new(centre, semi_axes).expect("an ellipsoid");
    let unit = Ball::new(Vector3::zeros(), 1.0).expect("a ball");
    let reference = Quadrature::of_degree(30).expect("rules");
    for degree in 0..=8 {
        let rules = Quadrature::of_degree(degree).expect("rules");
        for exponents in monomials(degree) {
            let found = volume_integral(&rules, &ellipsoid, exponents);
            let mapped = |x: &Vector3<f64>| semi_axes.determinant() * power(&(centre + semi_axes * x), exponents);
            let exact = reference.volume_integral(&unit, mapped).expect("finite");
            assert_close_at_scale("moments", &[found], &[exact], 4.0, rounding(degree));
        }
    }
}

#[test]
fn ellipsoid_area_converges_to_the_closed_form_of_a_spheroid() {
    // Oblate: 2π a² + π c²/e ln((1 + e)/(1 − e)), e² = 1 − c²/a².
    let (a, c) = (1.0_f64, 0.8_f64);
    let spheroid = Ellipsoid::new(Vector3::zeros(), Matrix3::from_diagonal(&Vector3::new(a, a, c))).expect("a body");
    let e = ((a - c) * (a + c)).sqrt() / a;
    let exact = core::f64::consts::TAU * a * a + core::f64::consts::PI * c * c / e * ((1.0 + e) / (1.0 - e)).ln();
    let rules = Quadrature::of_degree(60).expect("rules");
    let found = surface_integral(&rules, &spheroid, [0; 3]);
    assert_close_at_scale("area", &[found], &[exact], 0.0, rounding(4));
}

#[test]
fn cylinder_rules_equal_moments_of_circles() {
    let axis = Vector3::new(0.0, 0.0, 2.0);
    for inner in [0.0, 0.5] {
        let cylinder = Cylinder::new(Vector3::new(0.0, 0.0, -1.0), axis, [inner, 1.0]).expect("a cylinder");
        for degree in 0..=10 {
            let rules = Quadrature::of_degree(degree).expect("rules");
            for [a, b, c] in monomials(degree) {
                let n = a + b;
                let power = (0..=n).fold(1.0, |product, _| product * inner);
                let along = if c % 2 == 1 { 0.0 } else { 2.0 / (c + 1) as f64 };
                let section = circle(a, b) * (1.0 - power * inner) / (n + 2) as f64;
                let ends = if c % 2 == 1 { 0.0 } else { 2.0 };
                let exact = [section * along, section * ends + circle(a, b) * along * (1.0 + power)];
                let found =
                    [volume_integral(&rules, &cylinder, [a, b, c]), surface_integral(&rules, &cylinder, [a, b, c])];
                assert_close_at_scale("moments", &found, &exact, 8.0, rounding(degree));
            }
        }
    }
}

#[test]
fn turned_cylinder_has_the_moments_of_the_upright_one() {
    let axis = Vector3::new(2.0, 1.0, -2.0) / 3.0;
    let upright = Cylinder::new(Vector3::zeros(), Vector3::z(), [0.25, 1.0]).expect("a cylinder");
    let turned = Cylinder::new(Vector3::zeros(), axis, [0.25, 1.0]).expect("a cylinder");
    let rules = Quadrature::of_degree(6).expect("rules");
    let along = |axis: Vector3<f64>| {
        move |x: &Vector3<f64>| {
            let z = x.dot(&axis);
            [z, z * z, x.dot(x) - z * z, z * x.dot(x)]
        }
    };
    let expected = rules.volume_integral(&upright, along(Vector3::z())).expect("finite");
    let found = rules.volume_integral(&turned, along(axis)).expect("finite");
    assert_close_at_scale("moments", &found, &expected, 1.0, rounding(6));
}

fn unit_tetrahedron() -> TetrahedralMesh {
    let corners = vec![Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z()];
    TetrahedralMesh::new(corners, vec![[0, 1, 2, 3]]).expect("a mesh")
}

#[test]
fn tetrahedron_and_triangle_rules_equal_ratios_of_factorials() {
    let mesh = unit_tetrahedron();
    for degree in 0..=24 {
        let rules = Quadrature::of_degree(degree).expect("rules");
        for [a, b, c] in monomials(degree) {
            let product = factorial(a) * factorial(b) * factorial(c);
            let inside = product / factorial(a + b + c + 3);
            let on_face = |n: usize, others: f64| if n == 0 { others } else { 0.0 };
            let flat = product / factorial(a + b + c + 2);
            let around = on_face(a, flat) + on_face(b, flat) + on_face(c, flat) + 3.0_f64.sqrt() * flat;
            let found = [volume_integral(&rules, &mesh, [a, b, c]), surface_integral(&rules, &mesh, [a, b, c])];
            // Relative to the integral of 1: the points' shares are what rounds.
            assert_close_at_scale("inside", &found[..1], &[inside], 1.0 / 6.0, rounding(degree));
            assert_close_at_scale("around", &found[1..], &[around], 2.4, rounding(degree));
        }
    }
}

#[test]
fn rules_of_the_highest_degrees_equal_powers() {
    let rules = Quadrature::of_degree(128).expect("rules");
    let unit = Cuboid::new(Vector3::repeat(-1.0), Vector3::repeat(1.0)).expect("a box");
    let found = volume_integral(&rules, &unit, [128, 126, 0]);
    assert_close_at_scale("box", &[found], &[8.0 / (129.0 * 127.0)], 0.0, rounding(128));
    let ball = Ball::new(Vector3::zeros(), 1.0).expect("a ball");
    let found = volume_integral(&rules, &ball, [0, 0, 100]);
    assert_close_at_scale("ball", &[found], &[4.0 * core::f64::consts::PI / (101.0 * 103.0)], 0.0, rounding(128));
}

#[test]
fn weights_are_positive_and_points_inside() {
    let unit = unit_tetrahedron();
    for degree in 0..=30 {
        let rules = Quadrature::of_degree(degree).expect("rules");
        let check = |point: VolumePoint<f64>| {
            let x = point.position;
            assert!(0.0 < point.weight && 0.0 < x.min() && x.sum() < 1.0, "degree {degree}: {point:?}");
            Ok(())
        };
        unit.volume_points(&rules, check).expect("visited");
        let check = |point: SurfacePoint<f64>| {
            let x = point.position;
            let rounding = Tol::ulps(1.0).value();
            assert!(0.0 < point.weight && 0.0 <= x.min() && x.sum() <= 1.0 + rounding, "degree {degree}: {point:?}");
            Ok(())
        };
        unit.surface_points(&rules, check).expect("visited");
    }
}

#[test]
fn counts_of_points_are_those_stated() {
    let mesh = unit_tetrahedron();
    let count = |degree: usize| {
        let mut counts = (0, 0);
        let rules = Quadrature::of_degree(degree).expect("rules");
        let inside = |_: VolumePoint<f64>| {
            counts.0 += 1;
            Ok(())
        };
        mesh.volume_points(&rules, inside).expect("visited");
        let around = |_: SurfacePoint<f64>| {
            counts.1 += 1;
            Ok(())
        };
        mesh.surface_points(&rules, around).expect("visited");
        (counts.0, counts.1 / 4)
    };
    let expected = [(1, 1), (4, 3), (8, 6), (14, 6), (14, 7)];
    for (degree, expected) in (1..).zip(expected) {
        assert_eq!(count(degree), expected, "degree {degree}");
    }
}
