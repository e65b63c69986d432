//! The characteristic system in three and four variables against derivatives by hand and a solution in closed form.

use nalgebra::Matrix4;
use piola_characteristics::{CauchyProblem, CharacteristicField, FirstOrderPde, InitialManifold, RayField};
use piola_integrators::Field;
use piola_numerics::{Dual, Real};
use piola_testkit::{Tol, assert_close, assert_close_at_scale, assert_each_close, assert_each_close_at_scales};
use proptest::prelude::*;

/// Φ = x₁ ξ₁² + u ξ₂ ξ₃ + x₃² ξ₄ − u² x₂ + x₄ ξ₁ ξ₄: every slope of Φ is different from every other.
struct Uneven;

impl FirstOrderPde for Uneven {
    fn value<T: Real>(&self, x: &[T], u: T, xi: &[T]) -> T {
        x[0] * xi[0] * xi[0] + u * xi[1] * xi[2] + x[2] * x[2] * xi[3] - u * u * x[1] + x[3] * xi[0] * xi[3]
    }
}

/// W(A.38) of it by hand:
///
/// ```text
/// Φ_ξ = (2 x₁ ξ₁ + x₄ ξ₄, u ξ₃, u ξ₂, x₃² + x₄ ξ₁)      Φ_u = ξ₂ ξ₃ − 2 u x₂      Φ_x = (ξ₁², −u², 2 x₃ ξ₄, ξ₁ ξ₄)
/// x′ = Φ_ξ      u′ = ξ·Φ_ξ      ξ′ = −(ξ Φ_u + Φ_x)
/// ```
fn by_hand<T: Real>(y: &[T]) -> [T; 9] {
    let two = T::lit(2.0);
    let ([x1, x2, x3, x4], u, [a, b, c, d]) = ([y[0], y[1], y[2], y[3]], y[4], [y[5], y[6], y[7], y[8]]);
    let x_rate = [two * x1 * a + x4 * d, u * c, u * b, x3 * x3 + x4 * a];
    let u_rate = a * x_rate[0] + b * x_rate[1] + c * x_rate[2] + d * x_rate[3];
    let by_u = b * c - two * u * x2;
    [
        x_rate[0],
        x_rate[1],
        x_rate[2],
        x_rate[3],
        u_rate,
        -(a * by_u + a * a),
        -(b * by_u - u * u),
        -(c * by_u + two * x3 * d),
        -(d * by_u + a * d),
    ]
}

proptest! {
    #[test]
    fn characteristic_system_in_four_variables_equals_that_by_hand(
        y in prop::array::uniform9(-2.0..2.0_f64), tangent in prop::array::uniform9(-1.0..1.0_f64),
        other in prop::array::uniform9(-1.0..1.0_f64),
    ) {
        let mut rate = [0.0; 9];
        CharacteristicField::new(&Uneven, 4).rate(0.0, &y, &mut rate).unwrap();
        // Products of up to four factors of two; u′ and ξ′ have some ten of them.
        let (scales, few) = ([8.0, 4.0, 4.0, 8.0, 32.0, 16.0, 16.0, 16.0, 16.0], Tol::ulps(8.0));
        assert_each_close_at_scales("y′", &rate, &by_hand(&y), &scales, few);
        // The neighbours: derivatives of the system by hand along the tangents.
        let state = [y, tangent, other].concat();
        let mut rates = [0.0; 27];
        RayField::new(&Uneven, 4, 2).rate(0.0, &state, &mut rates).unwrap();
        assert_each_close_at_scales("y₀′", &rates[..9], &by_hand(&y), &scales, few);
        for (index, along) in [tangent, other].iter().enumerate() {
            let moving: Vec<_> = y.iter().zip(along).map(|(&y, &along)| Dual::new(y, along)).collect();
            let expected = by_hand(&moving).map(|y| y.tangent);
            let found = &rates[9 * (index + 1)..9 * (index + 2)];
            assert_each_close_at_scales("yₐ′", found, &expected, &scales.map(|scale| 2.0 * scale), few);
        }
    }

    /// det(x_s, x_τ) in four variables, with x_s by hand, against nalgebra's expansion by minors.
    #[test]
    fn determinant_of_the_ray_map_in_four_variables_equals_its_expansion(
        y in prop::array::uniform9(-2.0..2.0_f64),
        tangents in prop::array::uniform3(prop::array::uniform9(-1.0..1.0_f64)),
    ) {
        let state = [&y[..], tangents.as_flattened()].concat();
        let x_s = by_hand(&y);
        let expected = Matrix4::from_fn(|i, j| if i == 0 { x_s[j] } else { tangents[i - 1][j] }).determinant();
        let found = RayField::new(&Uneven, 4, 3).determinant(&state);
        // Twenty-four products, each below 8: x_s has components up to 8, the others up to one.
        assert_close_at_scale("det", &[found], &[expected], 100.0, Tol::ulps(8.0));
    }
}

/// ξ₁ ξ₂ ξ₃ = u with u = (1 + τ₁)(2 + τ₂) on x = (τ₁, τ₂, 0).
struct Threefold;

impl FirstOrderPde for Threefold {
    fn value<T: Real>(&self, _x: &[T], u: T, xi: &[T]) -> T {
        xi[0] * xi[1] * xi[2] - u
    }
}

struct Saddle;

impl InitialManifold for Saddle {
    fn place<T: Real>(&self, tau: &[T], x: &mut [T]) -> T {
        (x[0], x[1], x[2]) = (tau[0], tau[1], T::zero());
        (T::one() + tau[0]) * (T::lit(2.0) + tau[1])
    }
}

/// With a = 1 + τ₁, b = 2 + τ₂ the covector begins with (b, a, 1). Since ξ′ = ξ and u′ = 3u on Φ = 0,
///
/// ```text
/// ξ = eˢ (b, a, 1)    u = e³ˢ a b    x = (τ₁ + a E, τ₂ + b E, a b E)    E = (e²ˢ − 1)/2
/// det(x_s, x_τ) = e²ˢ a b (1 − E²)
/// ```
///
/// and all rays meet their caustic at E = 1, s = ½ ln 3.
#[test]
fn characteristics_in_three_variables_equal_their_closed_form() {
    let problem = CauchyProblem::new(&Threefold, &Saddle, 3).unwrap().near(&[1.0; 3]).unwrap();
    let integrated = Tol::stated(1e-13, "a few dozen steps of local error 1e-13");
    let mut compared = 0;
    for tau in [[0.0, 0.0], [0.5, -0.75], [-0.25, 1.5]] {
        let [a, b] = [1.0 + tau[0], 2.0 + tau[1]];
        for s in [-0.5, 0.0, 0.25, 0.5, 0.75] {
            let (growth, square) = (s.exp(), (2.0 * s).exp());
            let e = 0.5 * (2.0 * s).exp_m1();
            let found = problem.characteristic(&tau, s).unwrap();
            assert_each_close("ξ", &found.xi, &[growth * b, growth * a, growth], integrated);
            assert_each_close("u", &[found.u], &[growth * square * a * b], integrated);
            assert_close("x", &found.x, &[tau[0] + a * e, tau[1] + b * e, a * b * e], integrated);
            #[rustfmt::skip]
            let jacobian = [
                square * a, square * b, square * a * b,
                1.0 + e,    0.0,        b * e,
                0.0,        1.0 + e,    a * e,
            ];
            assert_close("∂x/∂(s, τ)", &found.jacobian, &jacobian, integrated);
            let determinant = square * a * b * (1.0 - e * e);
            let scale = square * a * b * (1.0 + e * e);
            assert_each_close_at_scales("det", &[found.determinant], &[determinant], &[scale], integrated);
            compared += 1;
        }
        let caustic = problem.caustic_points(&tau, 0.0, 1.0).unwrap();
        assert_eq!(caustic.len(), 1);
        assert_close("s", &[caustic[0].s], &[0.5 * 3.0_f64.ln()], integrated);
    }
    assert_eq!(compared, 15);
}
