//! Rotations as unit quaternions.
//!
//! All functions of the angle a = |θ| are entire in t = a², or regular for a < 2π. They are computed as such, so that nothing
//! cancels at small angles and derivatives are right at θ = 0:
//!
//! ```text
//! exp θ = 1 + ( −⅛ t s²,  ½ s c θ )         c = cos(a/4),   s = sin(a/4)/(a/4)
//! dexp⁻¹_{−θ} ω = ω + ½ θ×ω + D θ×(θ×ω)     D = (1 − (a/2) cot(a/2))/a²
//! ```

use piola_integrators::internal::{compensated_add, largest_lane};
use piola_numerics::sums::{CompensatedSum, unit_in_last_place};
use piola_numerics::{Mask, Real};

use super::LieGroup;

/// The rotations SO(3), as unit quaternions (w, x, y, z): Hamilton's product, body → space.
///
/// The algebra is the angular velocity in body components: q̇ = ½ q (0, ω). q and −q are the same rotation.
///
/// # Accuracy
/// The exponential is right to a few ulp at any angle. The differential of its inverse is right to a few ulp × 2π/(2π − a) and
/// not finite at a = |θ| = 2π. The length of q stays 1 within 2⁻⁵³ (f64) for any number of steps, which is as near as four
/// doubles come to a unit quaternion. Products are compensated; after each step the length is corrected along q.
///
/// # Example
/// ```
/// use piola_geometric::{LieGroup, Rotations};
/// let (mut q, mut carry) = ([1.0, 0.0, 0.0, 0.0], [0.0; 4]);
/// Rotations.advance(&mut q, &mut carry, &[0.0, std::f64::consts::PI, 0.0]); // half a turn about y
/// assert!(q[0].abs() < 1e-16 && (q[2] - 1.0).abs() < 1e-16);
/// ```
#[doc(alias("SO(3)", "quaternion", "attitude"))]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Rotations;

impl<T: Real> LieGroup<T> for Rotations {
    fn element_length(&self) -> usize {
        4
    }
    fn dimension(&self) -> usize {
        3
    }
    fn advance(&self, element: &mut [T], carry: &mut [T], displacement: &[T]) {
        let excess = excess_of_exponential(vector(displacement));
        let (q, low) = (quaternion(element), quaternion(carry));
        // q exp θ = q + q (exp θ − 1): the increment is rounded, the sum is not.
        let (increment, small) = (product(q, excess), product(low, excess));
        for (i, (element, carry)) in element.iter_mut().zip(carry).enumerate().take(4) {
            compensated_add(element, carry, increment[i] + small[i]);
        }
    }
    fn inverse_differential(&self, displacement: &[T], velocity: &mut [T]) {
        let rate = inverse_differential(vector(displacement), vector(velocity));
        velocity[..3].copy_from_slice(&rate);
    }
    /// Removes the defect of the length to first order: q ← q + ½ (1 − |q|²) q, with |q|² in twice the precision.
    fn renormalise(&self, element: &mut [T], carry: &mut [T]) {
        let (q, low) = (quaternion(element), quaternion(carry));
        let mut excess = CompensatedSum::new();
        excess.add(-T::one());
        for i in 0..4 {
            excess.add_product(q[i], q[i]);
            excess.add(q[i] * low[i] * T::lit(2.0));
        }
        let factor = excess.value() * T::lit(-0.5);
        for (i, (element, carry)) in element.iter_mut().zip(carry).enumerate().take(4) {
            compensated_add(element, carry, factor * q[i]);
        }
    }
    /// The length is off by more than √ulp, of which a correction to first order would not leave rounding alone.
    fn defect(&self, element: &[T]) -> Option<(usize, f64)> {
        let excess = quaternion(element).iter().fold(-T::one(), |sum, &x| sum + x * x);
        let defect = 0.5 * largest_lane(excess);
        if defect <= unit_in_last_place::<T>().sqrt() { None } else { Some((0, defect)) }
    }
}

/// The quaternion at the beginning of an element.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn quaternion<T: Real>(element: &[T]) -> [T; 4] {
    [element[0], element[1], element[2], element[3]]
}

/// The three numbers at the beginning of an element of the algebra.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn vector<T: Real>(numbers: &[T]) -> [T; 3] {
    [numbers[0], numbers[1], numbers[2]]
}

/// q p of two quaternions, i j = k.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn product<T: Real>(q: [T; 4], p: [T; 4]) -> [T; 4] {
    [
        q[0] * p[0] - q[1] * p[1] - q[2] * p[2] - q[3] * p[3],
        q[0] * p[1] + q[1] * p[0] + q[2] * p[3] - q[3] * p[2],
        q[0] * p[2] - q[1] * p[3] + q[2] * p[0] + q[3] * p[1],
        q[0] * p[3] + q[1] * p[2] - q[2] * p[1] + q[3] * p[0],
    ]
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn cross<T: Real>(a: [T; 3], b: [T; 3]) -> [T; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn squared<T: Real>(v: [T; 3]) -> T {
    v[0] * v[0] + v[1] * v[1] + v[2] * v[2]
}

/// exp θ − 1, without cancellation.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn excess_of_exponential<T: Real>(theta: [T; 3]) -> [T; 4] {
    let t = squared(theta);
    let (c, s) = quarter_angle_functions(t);
    let factor = T::lit(0.5) * s * c;
    [T::lit(-0.125) * t * s * s, factor * theta[0], factor * theta[1], factor * theta[2]]
}

/// dexp⁻¹_{−θ} ω.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn inverse_differential<T: Real>(theta: [T; 3], omega: [T; 3]) -> [T; 3] {
    let d = second_coefficient(squared(theta));
    let once = cross(theta, omega);
    let twice = cross(theta, once);
    core::array::from_fn(|i| omega[i] + T::lit(0.5) * once[i] + d * twice[i])
}

/// (cos(a/4), sin(a/4)/(a/4)) at t = a².
#[cfg_attr(not(debug_assertions), inline(always))]
fn quarter_angle_functions<T: Real>(t: T) -> (T, T) {
    // Below a = 1 the power series in x = t/16: nine terms leave 16⁻⁹/18! ≈ 2e-27.
    let small = t.less_than(T::one());
    let x = t * T::lit(1.0 / 16.0);
    let (mut cosine, mut sinc) = (T::one(), T::one());
    for k in (1..9_i32).rev() {
        let k = f64::from(k);
        cosine = T::one() - cosine * (x * T::lit(1.0 / (2.0 * k * (2.0 * k - 1.0))));
        sinc = T::one() - sinc * (x * T::lit(1.0 / (2.0 * k * (2.0 * k + 1.0))));
    }
    if small.all() {
        return (cosine, sinc);
    }
    // The root is taken of one where the series serves, so that its derivative is finite there.
    let quarter = T::select(small, T::one(), t).sqrt() * T::lit(0.25);
    let (s, c) = quarter.sin_cos();
    (T::select(small, cosine, c), T::select(small, sinc, s / quarter))
}

/// The coefficients of D in powers of t: 2ζ(2k)/(2π)²ᵏ for k = 1, 2, …
const SECOND_COEFFICIENT: [f64; 13] = [
    0.083_333_333_333_333_33,
    0.001_388_888_888_888_889,
    3.306_878_306_878_307e-5,
    8.267_195_767_195_768e-7,
    2.087_675_698_786_81e-8,
    5.284_190_138_687_493e-10,
    1.338_253_653_068_467_9e-11,
    3.389_680_296_322_582_7e-13,
    8.586_062_056_277_845e-15,
    2.174_868_698_558_062e-16,
    5.509_002_828_360_229_5e-18,
    1.395_446_468_581_252_2e-19,
    3.534_707_039_629_467e-21,
];

/// D = (1 − (a/2) cot(a/2))/a² at t = a².
#[cfg_attr(not(debug_assertions), inline(always))]
fn second_coefficient<T: Real>(t: T) -> T {
    // Below a = 1 the power series, of which thirteen terms leave 1e-21.
    let small = t.less_than(T::one());
    let series = SECOND_COEFFICIENT.iter().rev().fold(T::zero(), |sum, &coefficient| sum * t + T::lit(coefficient));
    if small.all() {
        return series;
    }
    let half = T::select(small, T::one(), t).sqrt() * T::lit(0.5);
    let (s, c) = half.sin_cos();
    T::select(small, series, (T::one() - half * c / s) / T::select(small, T::one(), t))
}
