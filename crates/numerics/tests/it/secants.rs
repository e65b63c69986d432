//! Changes of formulas between two points, against differences of values in 31 digits.

use piola_numerics::{Dual, Lanes, Mask, Real, Secant};
use piola_testkit::{DoubleDouble, Tol, assert_close, assert_each_close_at_scales};

/// A formula of two variables and the points at which it is compared.
struct Case<const N: usize> {
    name: &'static str,
    points: [[f64; 2]; N],
}

/// Relative distances of the two ends, from the smallest that doubles know to a half.
const DISTANCES: [f64; 8] = [4.5e-16, 1e-15, 3e-14, 1e-11, 1e-8, 1e-5, 1e-2, 0.5];

/// Compares the change of f from x to x (1 + distance) with that in 31 digits, at the scale of the largest change of
/// an argument or value.
macro_rules! assert_change {
    ($case:expr, $f:expr) => {
        for point in $case.points {
            for (k, distance) in DISTANCES.into_iter().enumerate() {
                // One variable or both move, forwards and backwards.
                let moved = [point[0] * (1.0 + distance), point[1] * (1.0 - [0.0, 0.3, -0.7][k % 3] * distance)];
                for (from, to) in [(point, moved), (moved, point)] {
                    let secant = |i: usize| Secant { start: from[i], end: to[i], change: to[i] - from[i] };
                    let actual: Secant<f64> = $f(secant(0), secant(1));
                    let at = |x: [f64; 2]| -> DoubleDouble { $f(DoubleDouble::lit(x[0]), DoubleDouble::lit(x[1])) };
                    let expected = (at(to) - at(from)).primal(0);
                    let largest = (0..2).map(|i| (to[i] - from[i]).abs() / point[i].abs().max(1.0)).fold(0.0, f64::max);
                    let what = format!("{} from {from:?} to {to:?}", $case.name);
                    let slope = ($f(Dual::variable(point[0]), Dual::constant(point[1])).tangent * point[0])
                        .abs()
                        .max(($f(Dual::constant(point[0]), Dual::variable(point[1])).tangent * point[1]).abs());
                    assert_each_close_at_scales(
                        &what,
                        &[actual.change],
                        &[expected],
                        &[slope * largest],
                        Tol::ulps(16.0),
                    );
                    let (start, end): (f64, f64) = ($f(from[0], from[1]), $f(to[0], to[1]));
                    assert_eq!([actual.start, actual.end].map(f64::to_bits), [start, end].map(f64::to_bits), "{what}");
                }
            }
        }
    };
}

fn case<const N: usize>(name: &'static str, points: [[f64; 2]; N]) -> Case<N> {
    Case { name, points }
}

fn of<T: Real>(f: impl Fn(T, T) -> T) -> impl Fn(T, T) -> T {
    f
}

#[test]
fn changes_of_operations_equal_differences_in_31_digits() {
    let points = [[1.5, 2.25], [-0.75, 3.0], [2.0, -1.25], [1e-3, 40.0]];
    assert_change!(case("sum", points), |x, y| of(|a, b| a + b)(x, y));
    assert_change!(case("difference", points), |x, y| of(|a, b| a - b)(x, y));
    assert_change!(case("product", points), |x, y| of(|a, b| a * b)(x, y));
    assert_change!(case("quotient", points), |x, y| of(|a, b| a / b)(x, y));
}

#[test]
fn changes_of_powers_equal_differences_in_31_digits() {
    let points = [[1.5, 2.25], [0.125, 0.5], [3.0, -1.5]];
    assert_change!(case("square root", points), |x, _| of(|a, _| Real::sqrt(a))(x, x));
    assert_change!(case("cube root", points), |x, _| of(|a, _| Real::cbrt(a))(x, x));
    assert_change!(case("cube root below zero", [[-1.5, 1.0]]), |x, _| of(|a, _| Real::cbrt(a))(x, x));
    assert_change!(case("fifth power", points), |x, _| of(|a, _| Real::powi(a, 5))(x, x));
    assert_change!(case("inverse cube", points), |x, _| of(|a, _| Real::powi(a, -3))(x, x));
    assert_change!(case("reciprocal", points), |x, _| of(|a, _| Real::recip(a))(x, x));
    assert_change!(case("power", points), Real::powf);
}

#[test]
fn changes_of_exponentials_and_logarithms_equal_differences_in_31_digits() {
    let points = [[0.75, 1.0], [-1.25, 1.0], [1.5, 1.0]];
    assert_change!(case("exp", points), |x, _| of(|a, _| Real::exp(a))(x, x));
    assert_change!(case("exp_m1", points), |x, _| of(|a, _| Real::exp_m1(a))(x, x));
    assert_change!(case("sinh", points), |x, _| of(|a, _| Real::sinh(a))(x, x));
    assert_change!(case("cosh", points), |x, _| of(|a, _| Real::cosh(a))(x, x));
    assert_change!(case("tanh", points), |x, _| of(|a, _| Real::tanh(a))(x, x));
    assert_change!(case("ln", [[0.75, 1.0], [12.0, 1.0]]), |x, _| of(|a, _| Real::ln(a))(x, x));
    assert_change!(case("ln_1p", [[0.75, 1.0], [-0.4, 1.0]]), |x, _| of(|a, _| Real::ln_1p(a))(x, x));
}

#[test]
fn changes_of_angles_equal_differences_in_31_digits() {
    let points = [[0.75, 1.5], [-1.25, 0.5], [2.5, -1.0]];
    assert_change!(case("sin", points), |x, _| of(|a, _| Real::sin(a))(x, x));
    assert_change!(case("cos", points), |x, _| of(|a, _| Real::cos(a))(x, x));
    assert_change!(case("tan", points), |x, _| of(|a, _| Real::tan(a))(x, x));
    assert_change!(case("asin", [[0.25, 1.0], [-0.6, 1.0]]), |x, _| of(|a, _| Real::asin(a))(x, x));
    assert_change!(case("acos", [[0.25, 1.0], [-0.6, 1.0]]), |x, _| of(|a, _| Real::acos(a))(x, x));
    assert_change!(case("atan", points), |x, _| of(|a, _| Real::atan(a))(x, x));
    assert_change!(case("atan2", points), Real::atan2);
}

#[test]
fn energy_of_a_pendulum_near_rest_changes_by_more_than_nothing() {
    // H = p²/2 + 1 − cos q at q = 1e-9: both energies round to nothing or to an ulp of one.
    let energy = |q: Secant<f64>, p: Secant<f64>| Secant::lit(0.5) * p * p + (Secant::lit(1.0) - q.cos());
    let change = energy(Secant::new(1e-9, 1e-10), Secant::new(2e-9, -1e-10)).change;
    let expected = 0.5 * (1.1e-9_f64.powi(2) - 1e-18) + 0.5 * (1.9e-9_f64.powi(2) - 4e-18);
    assert_close("change", &[change], &[expected], Tol::ulps(64.0));
}

#[test]
fn ends_on_different_branches_give_the_difference_of_values() {
    let crossing = Secant { start: -0.5, end: 0.25, change: 0.75 };
    assert_eq!(crossing.abs(), Secant { start: 0.5, end: 0.25, change: -0.25 });
    assert_eq!(Secant::lit(2.0).copysign(crossing), Secant { start: -2.0, end: 2.0, change: 4.0 });
    assert_eq!(crossing.max(Secant::lit(0.0)), Secant { start: 0.0, end: 0.25, change: 0.25 });
    // The angle jumps by a whole turn at the negative axis.
    let (y, x) = (Secant { start: 1e-3, end: -1e-3, change: -2e-3 }, Secant::lit(-1.0));
    let angle = y.atan2(x);
    assert_close("turn", &[angle.change], &[angle.end - angle.start], Tol::ulps(2.0));
    let (from_zero, root) =
        (Secant { start: 0.0, end: 4.0, change: 4.0 }, Secant { start: 0.0, end: 2.0, change: 2.0 });
    assert_eq!((from_zero.sqrt(), from_zero.powf(Secant::lit(0.5))), (root, root));
    assert_eq!(Secant::<f64>::constant(0.0).sqrt(), Secant::constant(0.0));
    let masks = crossing.less_than(Secant::lit(0.0));
    assert!(masks.any() && !masks.all() && (masks | !masks).all() && !(masks & !masks).any());
}

#[test]
fn secants_of_lanes_and_duals_are_those_of_their_parts() {
    let f = |a: f64, d: f64| (Secant::new(a, d).sin() / Secant::new(a, d)).change;
    let of_lanes = Secant::new(Lanes([0.5, 1.5]), Lanes([1e-9, 0.25]));
    let expected = [f(0.5, 1e-9), f(1.5, 0.25)];
    assert_close("lanes", &(of_lanes.sin() / of_lanes).change.0, &expected, Tol::ulps(8.0));
    // ∂/∂a (sin(a + d) − sin a) = cos(a + d) − cos a.
    let change = Secant::new(Dual::variable(0.5), Dual::constant(1e-9)).sin().change;
    let slope = Secant::new(0.5, 1e-9).cos().change;
    assert_close("dual", &[change.tangent], &[slope], Tol::ulps(8.0));
}
