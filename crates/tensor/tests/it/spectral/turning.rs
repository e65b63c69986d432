//! Tensors whose principal frame turns: axes and functions have all their derivatives, since they are known in that frame.

use piola_numerics::{Jet, Real};
use piola_tensor::Symmetric;
use piola_tensor::spectral::{
    Exponential, IsotropicFunction, Logarithm, Power, SquareRoot, decompose, tensor_function,
};
use piola_testkit::spectral::{Random, Rows};
use piola_testkit::{Tol, assert_close};

/// The columns of q turned by an angle about the third of them, one a row.
fn turned_axes<T: Real>(q: &Rows<f64>, angle: T) -> Rows<T> {
    let (s, c) = angle.sin_cos();
    let (o, l) = (T::zero(), T::one());
    [[c, s, o], [-s, c, o], [o, o, l]]
        .map(|axis| core::array::from_fn(|i| (0..3).fold(T::zero(), |sum, k| sum + T::lit(q[i][k]) * axis[k])))
}

/// Σ λₖ vₖ ⊗ vₖ.
fn assembled<T: Real>(values: [T; 3], axes: &Rows<T>) -> Symmetric<T> {
    let entry = |i: usize, j: usize| (0..3).fold(T::zero(), |sum, k| sum + values[k] * axes[k][i] * axes[k][j]);
    Symmetric { components: [entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(0, 2)] }
}

/// A number with its first two derivatives in time.
type Curve = Jet<f64, 0>;
/// A number with its first four derivatives in time.
type LongCurve = Jet<Curve, 0>;

#[test]
fn principal_axes_that_turn_steadily_move_and_accelerate_as_on_a_circle() {
    let mut random = Random::new(31);
    let spin = 0.7;
    for _ in 0..100 {
        let q = random.rotation();
        // λ₁ = 4 + t², λ₂ = 1 − 3t and λ₃ = −2 at t = 0.
        let t = Curve::time(0.0);
        let values =
            [Curve::constant(4.0) + t * t, Curve::constant(1.0) - t * Curve::constant(3.0), Curve::constant(-2.0)];
        let start = random.symmetric();
        let axes = turned_axes(&q, Curve::constant(start) + t * Curve::constant(spin));
        let found = decompose(&assembled(values, &axes));
        let parts = |x: Curve| [x.value, x.rate, x.second_rate];
        let expected = [[4.0, 0.0, 2.0], [1.0, -3.0, 0.0], [-2.0, 0.0, 0.0]];
        assert_close("λ", found.values.map(parts).as_flattened(), expected.as_flattened(), Tol::ulps(64.0));
        // The first axis moves with ω towards the second and the second against the first; both accelerate with ω² inwards.
        let [a, b, c] = turned_axes(&q, start);
        let motions = [
            [a, b.map(|x| spin * x), a.map(|x| -spin * spin * x)],
            [b, a.map(|x| -spin * x), b.map(|x| -spin * spin * x)],
            [c, [0.0; 3], [0.0; 3]],
        ];
        for (axis, motion) in found.vectors.into_iter().zip(motions) {
            // An axis may point either way.
            let way = (0..3).map(|i| axis[i].value * motion[0][i]).sum::<f64>().signum();
            let found = [axis.map(|x| way * x.value), axis.map(|x| way * x.rate), axis.map(|x| way * x.second_rate)];
            assert_close("v, v′, v″", found.as_flattened(), motion.as_flattened(), Tol::ulps(64.0));
        }
    }
}

/// √x from its value alone: its divided differences are the provided ones.
struct PlainRoot;
impl IsotropicFunction for PlainRoot {
    fn value<T: Real>(&self, x: T) -> T {
        x.sqrt()
    }
}

/// Eigenvalues and their velocities: far apart, close together, and passing through one another.
const MOTIONS: [[[f64; 3]; 2]; 7] = [
    [[3.0, 1.0, 0.2], [0.5, -0.25, 0.1]],
    [[2.0, 1.9, 0.3], [0.5, -0.25, 0.1]],
    [[2.0, 0.35, 0.3], [0.5, -0.25, 0.1]],
    [[1.6, 1.5, 1.4], [0.5, -0.25, 0.1]],
    [[2.0, 2.0, 0.5], [0.5, -0.25, 0.1]],
    [[2.0, 0.5, 0.5], [0.5, -0.25, 0.1]],
    [[1.5, 1.5, 1.5], [0.5, -0.25, 0.1]],
];

fn check(name: &str, f: &impl IsotropicFunction, sizes: &[f64]) {
    let mut random = Random::new(32);
    let t = LongCurve::time(Curve::time(0.0));
    for &size in sizes {
        for [values, velocities] in MOTIONS {
            let q = random.rotation();
            let axes = turned_axes(&q, LongCurve::lit(0.3) + t * LongCurve::lit(0.8));
            let values: [LongCurve; 3] = core::array::from_fn(|k| {
                (LongCurve::lit(values[k]) + t * LongCurve::lit(velocities[k])) * LongCurve::lit(size)
            });
            let found = tensor_function(f, &assembled(values, &axes));
            let expected = assembled(values.map(|x| f.value(x)), &axes);
            // The value and four derivatives; the third is there twice.
            let parts: [fn(&LongCurve) -> f64; 6] = [
                |x| x.value.value,
                |x| x.value.rate,
                |x| x.value.second_rate,
                |x| x.rate.second_rate,
                |x| x.second_rate.rate,
                |x| x.second_rate.second_rate,
            ];
            for (k, part) in parts.into_iter().enumerate() {
                let [found, expected] = [&found, &expected].map(|a| a.components.each_ref().map(part));
                let what = format!("part {k} of {name} at {size:e} {:?}", values.map(|x| x.value.value));
                assert_close(&what, &found, &expected, DERIVATIVES);
            }
        }
    }
}

const DERIVATIVES: Tol = Tol::stated(1e-11, "four derivatives, by quotients of gaps where eigenvalues are apart");

#[test]
fn functions_of_turning_tensors_have_four_derivatives_at_coalescence_and_away_from_it() {
    // Beyond 10⁶ and below 10⁻⁶ the power series are those of scaled distances.
    let sizes = [1.0, 1e-8, 1e8];
    check("√", &SquareRoot, &sizes);
    check("ln", &Logarithm, &sizes);
    check("x^−2.5", &Power(-2.5), &sizes);
    check("plain √", &PlainRoot, &sizes);
    // Of small tensors the sum over the axes leaves nothing but 1, of large ones infinity.
    check("exp", &Exponential, &[1.0]);
}
