//! The exponential of a general 3×3 tensor, its derivative, and the logarithm.
//!
//! ```text
//! A = μ 1 + A′,  tr A′ = 0            exp A = e^μ exp A′
//! exp A′ = (exp 2⁻ˢA′)^(2ˢ)           |2⁻ˢA′| ≤ 1
//! exp A″ − 1 = P A″² + Q A″ + R 1     P, Q, R: series in the invariants of A″, by A″³ = I₁A″² − I₂A″ + I₃1
//! ```
//! Squaring is done on X = exp A″ − 1, as X ← 2X + X²: each squaring then adds an error of one rounding of X,
//! which is a relative error of A″ no larger than that of its own entries, instead of doubling what went before.
//! The mean is taken out because without it a decaying exponential would be a difference of numbers near one.
//! A skew tensor is a rotation in closed form (Rodrigues).
//!
//! | to get | use |
//! |---|---|
//! | exp A | [`exponential`] |
//! | exp A − 1, to full relative accuracy for small A | [`exponential_minus_identity`] |
//! | d exp(A + sE)/ds at s = 0 | [`exponential_derivative`] |
//! | A from exp A near 1 | [`logarithm`] |
//!
//! # Accuracy
//! A few ulp × the condition number of the exponential, which is at least |A|, as large as the result's own norm
//! allows. Exact for nilpotent A whose powers are exact. Where the real parts of two eigenvalues differ by more
//! than 600 (60 in f32) the result is accurate to rounding of one.

use nalgebra::Matrix3;
use piola_numerics::linear::matrix3::{dot, from_rows, inverse_and_determinant, rows_of};
use piola_numerics::sums::unit_in_last_place;
use piola_numerics::{Dual, Mask, Real};
use piola_tensor::Skew;
use piola_tensor::internal::rows::{Rows, difference, identity, product, scaled, sum, trace};

use crate::ContinuumError;
use crate::error::check_finite;

/// The number of terms of the series: with |A″| ≤ 1 those left out are below 1e-19, and so are their first three
/// derivatives.
const TERMS: i32 = 22;

/// exp A.
///
/// # Errors
/// [`ContinuumError::NotFinite`]: A is not, or its exponential is beyond the range of numbers.
pub fn exponential<T: Real>(a: &Matrix3<T>) -> Result<Matrix3<T>, ContinuumError> {
    let rows = rows_of(a);
    check_finite("A", rows.as_flattened())?;
    checked(exponential_rows(rows))
}

/// exp A − 1, without cancellation for small A.
///
/// # Errors
/// As [`exponential`].
pub fn exponential_minus_identity<T: Real>(a: &Matrix3<T>) -> Result<Matrix3<T>, ContinuumError> {
    let rows = rows_of(a);
    check_finite("A", rows.as_flattened())?;
    checked(exponential_minus_identity_rows(rows))
}

/// (exp A, d exp(A + s E)/ds at s = 0): the exponential and its derivative along E.
///
/// ```text
/// D exp(A)[E] = ∫₀¹ exp(σA) E exp((1−σ)A) dσ
/// ```
///
/// # Errors
/// As [`exponential`].
pub fn exponential_derivative<T: Real>(
    a: &Matrix3<T>,
    e: &Matrix3<T>,
) -> Result<(Matrix3<T>, Matrix3<T>), ContinuumError> {
    check_finite("A", a.as_slice())?;
    check_finite("E", e.as_slice())?;
    let both = exponential_rows(rows_of(&a.zip_map(e, Dual::new)));
    let value = both.map(|row| row.map(|x| x.value));
    let derivative = both.map(|row| row.map(|x| x.tangent));
    Ok((checked(value)?, checked(derivative)?))
}

fn checked<T: Real>(result: Rows<T>) -> Result<Matrix3<T>, ContinuumError> {
    check_finite("exp A", result.as_flattened())?;
    Ok(from_rows(result))
}

/// exp A of an array of rows.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn exponential_rows<T: Real>(a: Rows<T>) -> Rows<T> {
    let (mean, isochoric) = parts(a);
    scaled(sum(identity(), isochoric), mean.exp())
}

/// exp A − 1 of an array of rows.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn exponential_minus_identity_rows<T: Real>(a: Rows<T>) -> Rows<T> {
    let (mean, isochoric) = parts(a);
    sum(scaled(isochoric, mean.exp()), scaled(identity(), mean.exp_m1()))
}

/// (μ, exp(A − μ1) − 1).
#[cfg_attr(not(debug_assertions), inline(always))]
fn parts<T: Real>(a: Rows<T>) -> (T, Rows<T>) {
    let mean = trace(a) * T::lit(1.0 / 3.0);
    let deviator = difference(a, scaled(identity(), mean));
    // Beyond, the exponential of the deviator alone would leave the range of numbers.
    let single = 1e-10 < unit_in_last_place::<T>();
    let far = T::lit(if single { 60.0 } else { 600.0 }).less_than(row_norm(deviator));
    let zero = T::zero();
    let mean = T::select(far, zero, mean);
    let deviator = select_rows(far, a, deviator);
    let general = scaled_and_squared(deviator);
    if T::ORDER == 0 {
        let skew = is_skew(a);
        if skew.any() {
            return (T::select(skew, zero, mean), select_rows(skew, rotation_minus_identity(a), general));
        }
    }
    (mean, general)
}

/// exp A − 1 by scaling and squaring.
#[cfg_attr(not(debug_assertions), inline(always))]
fn scaled_and_squared<T: Real>(mut a: Rows<T>) -> Rows<T> {
    let half = T::lit(0.5);
    let mut norm = row_norm(a).frozen();
    let mut halvings = T::zero();
    let mut most = 0;
    loop {
        let large = T::one().less_than(norm) & norm.is_finite();
        if !large.any() {
            break;
        }
        norm = T::select(large, norm * half, norm);
        halvings = T::select(large, halvings + T::one(), halvings);
        a = select_rows(large, scaled(a, half), a);
        most += 1;
    }
    let mut x = series(a);
    for step in 0..most {
        // 2X + X², in the lanes that still need it.
        let squared = sum(sum(x, x), product(x, x));
        x = select_rows(T::lit(f64::from(step)).less_than(halvings), squared, x);
    }
    x
}

/// exp A − 1 for |A| ≤ 1, as A + P A² + Q A + R 1.
#[cfg_attr(not(debug_assertions), inline(always))]
fn series<T: Real>(a: Rows<T>) -> Rows<T> {
    let square = product(a, a);
    let first = trace(a);
    let second = second_invariant(a);
    let third = piola_numerics::linear::matrix3::determinant(a);
    // Aⁿ/n! = p A² + q A + r 1, from n = 2.
    let (mut p, mut q, mut r) = (T::lit(0.5), T::zero(), T::zero());
    let (mut big_p, mut big_q, mut big_r) = (p, q, r);
    let mut n = 3;
    while n <= TERMS {
        let inverse = T::lit(1.0 / f64::from(n));
        let next = (first * p + q, r - second * p, third * p);
        (p, q, r) = (next.0 * inverse, next.1 * inverse, next.2 * inverse);
        big_p += p;
        big_q += q;
        big_r += r;
        n += 1;
    }
    let higher = sum(scaled(square, big_p), sum(scaled(a, big_q), scaled(identity(), big_r)));
    sum(a, higher)
}

/// I₂, the sum of the principal minors.
#[cfg_attr(not(debug_assertions), inline(always))]
fn second_invariant<T: Real>(a: Rows<T>) -> T {
    (a[0][0] * a[1][1] - a[0][1] * a[1][0])
        + (a[1][1] * a[2][2] - a[1][2] * a[2][1])
        + (a[0][0] * a[2][2] - a[0][2] * a[2][0])
}

/// The largest sum of moduli of a row, or of a column, whichever is smaller.
#[cfg_attr(not(debug_assertions), inline(always))]
fn row_norm<T: Real>(a: Rows<T>) -> T {
    let m = [
        [a[0][0].abs(), a[0][1].abs(), a[0][2].abs()],
        [a[1][0].abs(), a[1][1].abs(), a[1][2].abs()],
        [a[2][0].abs(), a[2][1].abs(), a[2][2].abs()],
    ];
    let rows = (m[0][0] + m[0][1] + m[0][2]).max(m[1][0] + m[1][1] + m[1][2]).max(m[2][0] + m[2][1] + m[2][2]);
    let columns = (m[0][0] + m[1][0] + m[2][0]).max(m[0][1] + m[1][1] + m[2][1]).max(m[0][2] + m[1][2] + m[2][2]);
    rows.min(columns)
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn select_rows<T: Real>(mask: T::Mask, a: Rows<T>, b: Rows<T>) -> Rows<T> {
    let row = |i: usize| {
        [T::select(mask, a[i][0], b[i][0]), T::select(mask, a[i][1], b[i][1]), T::select(mask, a[i][2], b[i][2])]
    };
    [row(0), row(1), row(2)]
}

/// Where A = −Aᵀ to the last bit.
#[cfg_attr(not(debug_assertions), inline(always))]
fn is_skew<T: Real>(a: Rows<T>) -> T::Mask {
    let vanishes = |x: T| x.at_most(T::zero()) & T::zero().at_most(x);
    vanishes(a[0][0])
        & vanishes(a[1][1])
        & vanishes(a[2][2])
        & vanishes(a[0][1] + a[1][0])
        & vanishes(a[1][2] + a[2][1])
        & vanishes(a[0][2] + a[2][0])
}

/// exp Ω − 1 = sin θ/θ Ω + ½ (sin ½θ/½θ)² Ω², θ = |ω|, for a skew Ω.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn rotation_minus_identity<T: Real>(skew: Rows<T>) -> Rows<T> {
    let w = [skew[2][1], skew[0][2], skew[1][0]];
    // Divided by the largest component, the squares stay within the range of numbers.
    let largest = w[0].abs().max(w[1].abs()).max(w[2].abs());
    let zero = largest.at_most(T::zero());
    let scale = T::select(zero, T::one(), largest);
    let v = [w[0] / scale, w[1] / scale, w[2] / scale];
    let length = T::select(zero, T::one(), dot(v, v)).sqrt();
    let n = [v[0] / length, v[1] / length, v[2] / length];
    // One step towards length one, so that the result is as orthogonal as its sine and cosine allow.
    let step = T::lit(1.5) - T::lit(0.5) * dot(n, n);
    let n = [n[0] * step, n[1] * step, n[2] * step];
    let angle = T::select(zero, T::zero(), length * scale);
    let (sine, _) = angle.sin_cos();
    let half_sine = (angle * T::lit(0.5)).sin();
    let versine = T::lit(2.0) * half_sine * half_sine;
    let axis = Skew { axial: n }.rows();
    sum(scaled(axis, sine), scaled(product(axis, axis), versine))
}

/// ln F near 1: the K with exp K = F whose eigenvalues have imaginary parts within ±π.
///
/// ```text
/// F = (F^(1/2ˢ))^(2ˢ),   ln G = 2 artanh Z,   Z = (G − 1)(G + 1)⁻¹
/// ```
/// The velocity gradient K of a steady motion exp(Kt) that reaches F at t = 1. Roots are taken until |G − 1| ≤ ¼.
///
/// # Errors
/// [`ContinuumError::NotFinite`]; [`ContinuumError::NoPrincipalLogarithm`] when an eigenvalue of F is zero or
/// negative, so that no real principal logarithm exists, as for a half turn.
///
/// # Accuracy
/// A few ulp × the condition number; relative to |F − 1| when that is given exactly, as `minus_identity`.
pub fn logarithm<T: Real>(minus_identity: &Matrix3<T>) -> Result<Matrix3<T>, ContinuumError> {
    let mut x = rows_of(minus_identity);
    check_finite("F − 1", x.as_flattened())?;
    let quarter = T::lit(0.25);
    let mut doublings = 1.0;
    let mut roots = 0;
    while quarter.less_than(row_norm(x)).any() {
        if roots == MOST_ROOTS {
            return Err(ContinuumError::NoPrincipalLogarithm);
        }
        x = root_minus_identity(x)?;
        doublings *= 2.0;
        roots += 1;
    }
    // Z = X (2 + X)⁻¹ and ln(1 + X) = 2 Σ Z^(2k+1)/(2k+1).
    let z = product(x, inverse_and_determinant(sum(scaled(identity(), T::lit(2.0)), x)).0);
    let square = product(z, z);
    let mut polynomial = scaled(identity(), T::lit(1.0 / f64::from(2 * ARTANH_TERMS + 1)));
    let mut k = ARTANH_TERMS;
    while 1 < k {
        k -= 1;
        polynomial = sum(product(polynomial, square), scaled(identity(), T::lit(1.0 / f64::from(2 * k + 1))));
    }
    let higher = product(product(polynomial, square), z);
    let result = scaled(sum(z, higher), T::lit(2.0 * doublings));
    check_finite("ln F", result.as_flattened())?;
    Ok(from_rows(result))
}

/// |Z| ≤ 1/7 when |X| ≤ ¼: the first term left out is below (1/7)²²/23, 2e-20.
const ARTANH_TERMS: i32 = 10;
/// Roots of F until it is near 1; more are needed only where the logarithm does not exist.
const MOST_ROOTS: usize = 64;

/// Y = √(1 + X) − 1 by Denman and Beavers' iteration with the product M of the two iterates.
///
/// ```text
/// M ← ½ (1 + ½ (M + M⁻¹)),   G ← ½ G (1 + M⁻¹),     M → 1, G → √F
/// ```
/// Written for Y = G − 1 and N = M − 1, so that a small X keeps its digits. Cheng, Higham, Kenney & Laub,
/// *SIAM J. Matrix Anal. Appl.* 22 (2001).
fn root_minus_identity<T: Real>(x: Rows<T>) -> Result<Rows<T>, ContinuumError> {
    let half = T::lit(0.5);
    let (mut y, mut n) = (x, x);
    let tolerance = T::lit(unit_in_last_place::<T>());
    let mut after = 0;
    for _ in 0..MOST_ROOTS {
        // K = M⁻¹ − 1 = −N (1 + N)⁻¹
        let k = scaled(product(n, inverse_and_determinant(sum(identity(), n)).0), -T::one());
        // G (1 + M⁻¹)/2 − 1 = Y + ½ (K + Y K)
        y = sum(y, scaled(sum(k, product(y, k)), half));
        // (2 + M + M⁻¹)/4 − 1 = ¼ (N + K), and N + K = N² (1 + N)⁻¹ = −N K
        n = scaled(product(n, k), T::lit(-0.25));
        let norm = row_norm(n);
        if !norm.is_finite().all() {
            return Err(ContinuumError::NoPrincipalLogarithm);
        }
        // Quadratic: what is within rounding has one more step for each order of derivatives.
        if norm.at_most(tolerance).all() {
            after += 1;
            if T::ORDER < after {
                return Ok(y);
            }
        }
    }
    Err(ContinuumError::NoPrincipalLogarithm)
}
