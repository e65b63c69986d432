//! The principal frame of a symmetric tensor, by deflation: the kernel under everything spectral.
//!
//! ```text
//! A = m 1 + p B,  tr B = 0,  ½ B:B = 3        eigenvalues x of B:  x³ − 3x − 2r = 0,  r = ½ det B ∈ [−1, 1]
//! ```
//! Of the three roots 2 cos((arccos r + 2πk)/3) the one of largest modulus, y = |x| ∈ [√3, 2], is separated from
//! the others by at least √3 and is a regular function of |r|: a polynomial and one step of Newton's iteration
//! give it without trigonometry. Its eigenvector is a column of adj(B − x1), which has rank one and the smallest
//! nonzero eigenvalue 6; what remains is a 2×2 problem in the plane across it, solved by one rotation of Jacobi,
//! which is exact for coalescent pairs too. No step divides by a gap.

use piola_numerics::Real;
use piola_numerics::linear::matrix3::dot;
use piola_numerics::sums::unit_in_last_place;

use crate::Symmetric;
use crate::tensor::rows::Rows;

/// Near-minimax polynomial of the root y(|r|) on [0, 1], error 6·10⁻¹⁰.
const ROOT: [f64; 10] = [
    1.732_050_808_101_330_4,
    0.333_333_226_402_662_1,
    -0.096_221_442_294_609_98,
    0.049_334_755_569_866_1,
    -0.030_851_972_901_964_033,
    0.020_581_165_551_633_224,
    -0.012_900_457_547_466_437,
    0.006_505_493_361_280_503,
    -0.002_178_211_295_198_596_7,
    0.000_346_635_345_329_973_63,
];

/// Near-minimax polynomial of 1/(3(y² − 1)), the reciprocal slope for Newton's step, error 7·10⁻⁸.
const RECIPROCAL_SLOPE: [f64; 8] = [
    0.166_666_597_300_638_85,
    -0.096_216_101_535_780_38,
    0.073_879_304_580_805_84,
    -0.060_695_323_449_380_22,
    0.047_453_183_702_176_466,
    -0.030_138_396_737_101_71,
    0.012_636_372_716_759_428,
    -0.002_474_561_501_173_275,
];

/// Bounds within which squares neither overflow nor vanish, and the factors that bring other numbers there.
struct Range {
    low: f64,
    high: f64,
    raise: f64,
    lower: f64,
    /// Added to a square so that its root has a reciprocal: far below the smallest square in range.
    nothing_squared: f64,
    /// Added to a modulus of order one for the same purpose.
    nothing: f64,
}

const DOUBLE: Range =
    Range { low: 1e-120, high: 1e120, raise: 1e200, lower: 1e-200, nothing_squared: 1e-280, nothing: 1e-140 };
const SINGLE: Range =
    Range { low: 1e-14, high: 1e14, raise: 1e25, lower: 1e-25, nothing_squared: 1e-35, nothing: 1e-17 };

#[inline(always)]
fn range<T: Real>() -> Range {
    if unit_in_last_place::<T>() < 1e-10 { DOUBLE } else { SINGLE }
}

/// The root y of y³ − 3y = 2q in [√3, 2], for 0 ≤ q ≤ 1.
#[inline(always)]
fn separated_root<T: Real>(q: T) -> T {
    let c = |k: usize| T::lit(ROOT[k]);
    let d = |k: usize| T::lit(RECIPROCAL_SLOPE[k]);
    let q2 = q * q;
    let q4 = q2 * q2;
    let low = (c(0) + c(1) * q) + (c(2) + c(3) * q) * q2;
    let high = (c(4) + c(5) * q) + (c(6) + c(7) * q) * q2;
    let y = low + (high + (c(8) + c(9) * q) * q4) * q4;
    let slope = ((d(0) + d(1) * q) + (d(2) + d(3) * q) * q2) + ((d(4) + d(5) * q) + (d(6) + d(7) * q) * q2) * q4;
    y - (y * (y * y - T::lit(3.0)) - (q + q)) * slope
}

/// The larger of two numbers by one comparison.
#[inline(always)]
pub(super) fn larger<T: Real>(a: T, b: T) -> T {
    T::select(a.less_than(b), b, a)
}

/// The largest modulus of six numbers.
#[inline(always)]
pub(super) fn largest_modulus<T: Real>(a: [T; 6]) -> T {
    let [a, b, c, d, e, f] = [a[0].abs(), a[1].abs(), a[2].abs(), a[3].abs(), a[4].abs(), a[5].abs()];
    larger(larger(larger(a, b), larger(c, d)), larger(e, f))
}

/// `if_true` or `if_false`, component by component.
#[inline(always)]
fn choose<T: Real>(mask: T::Mask, if_true: [T; 3], if_false: [T; 3]) -> [T; 3] {
    [
        T::select(mask, if_true[0], if_false[0]),
        T::select(mask, if_true[1], if_false[1]),
        T::select(mask, if_true[2], if_false[2]),
    ]
}

/// a u + b v.
#[inline(always)]
pub(super) fn combination<T: Real>(a: T, u: [T; 3], b: T, v: [T; 3]) -> [T; 3] {
    [a * u[0] + b * v[0], a * u[1] + b * v[1], a * u[2] + b * v[2]]
}

/// Orthonormal right-handed axes, one a row, in which A is diagonal to rounding of its deviator, the largest
/// component first. For scalars without derivatives, or frozen ones.
///
/// # Accuracy
/// The axes are orthonormal within 2 ulp; the components that remain off the diagonal are a few ulp of the
/// deviator, whatever the gaps are. For A = m 1 the axes are some axes.
#[inline(always)]
pub(crate) fn principal_frame<T: Real>(a: &Symmetric<T>) -> Rows<T> {
    let range = range::<T>();
    let one = T::one();
    let [xx, yy, zz, xy, yz, xz] = a.components;

    // The deviator B, scaled to ½ B:B = 3.
    let mean = (xx + yy + zz) * T::lit(1.0 / 3.0);
    let (xx, yy, zz) = (xx - mean, yy - mean, zz - mean);
    let largest = largest_modulus([xx, yy, zz, xy, yz, xz]);
    let factor = T::select(
        largest.less_than(T::lit(range.low)),
        T::lit(range.raise),
        T::select(T::lit(range.high).less_than(largest), T::lit(range.lower), one),
    );
    let (xx, yy, zz, xy, yz, xz) = (xx * factor, yy * factor, zz * factor, xy * factor, yz * factor, xz * factor);
    let square = (xx * xx + yy * yy + zz * zz) * T::lit(1.0 / 6.0) + (xy * xy + yz * yz + xz * xz) * T::lit(1.0 / 3.0);
    let scale = (square + T::lit(range.nothing_squared)).sqrt().recip();
    let (xx, yy, zz, xy, yz, xz) = (xx * scale, yy * scale, zz * scale, xy * scale, yz * scale, xz * scale);

    // The separated eigenvalue x and its eigenvector v, a column of adj(B − x1).
    let r = T::lit(0.5) * (xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz));
    let x = separated_root(T::select(one.less_than(r.abs()), one, r.abs())).copysign(r);
    let (mx, my, mz) = (xx - x, yy - x, zz - x);
    let (ax, ay, az) = (my * mz - yz * yz, mx * mz - xz * xz, mx * my - xy * xy);
    let (axy, ayz, axz) = (yz * xz - xy * mz, xy * xz - yz * mx, xy * yz - xz * my);
    let v = choose::<T>(
        larger(ay, az).at_most(ax),
        [ax, axy, axz],
        choose::<T>(az.at_most(ay), [axy, ay, ayz], [axz, ayz, az]),
    );

    // The plane across it: the reflection that takes v to the third axis takes the first two there.
    let square = dot(v, v);
    let length = square.sqrt();
    let reciprocal = length.recip();
    let beta = (square + length * v[2].abs()).recip();
    let sign = one.copysign(v[2]);
    let n = [v[0] * reciprocal, v[1] * reciprocal, v[2] * reciprocal];
    let (bx, by) = (beta * v[0], beta * v[1]);
    let signed = sign * reciprocal;
    let u = [one - bx * v[0], -(bx * v[1]), -(signed * v[0])];
    let w = [sign * u[1], sign * (one - by * v[1]), -n[1]];

    // The 2×2 problem there, by one rotation: half the difference of its diagonal, h, and its shear, b.
    let image = [dot([xx, xy, xz], u), dot([xy, yy, yz], u), dot([xz, yz, zz], u)];
    let h = dot(u, image) + T::lit(0.5) * x;
    let b = dot(w, image);
    let adjacent = (h.abs() + T::lit(range.nothing)) + (h * h + b * b).sqrt();
    let reciprocal = (adjacent * adjacent + b * b).sqrt().recip();
    let (cosine, sine) = (adjacent * reciprocal, b * reciprocal);
    let forward = T::zero().at_most(h);
    let (c, s) = (T::select(forward, cosine, sine), T::select(forward, sine, cosine));
    let larger = combination(c, u, s, w);
    let smaller = combination(-s, u, c, w);

    let above = T::zero().at_most(r);
    [choose::<T>(above, n, larger), choose::<T>(above, larger, smaller), choose::<T>(above, smaller, n)]
}

/// Q A Qᵀ for axes Q by rows: the components 11, 22, 33, 12, 23, 13 of A in that frame.
#[inline(always)]
pub(crate) fn components_in<T: Real>(axes: &Rows<T>, a: &Symmetric<T>) -> [T; 6] {
    let [q, r, s] = *axes;
    let (aq, ar, a_s) = (a.apply(q), a.apply(r), a.apply(s));
    [dot(q, aq), dot(r, ar), dot(s, a_s), dot(q, ar), dot(r, a_s), dot(q, a_s)]
}

/// Σ Mₖₗ qₖ ⊗ qₗ: the tensor that has the components M in the frame of axes Q by rows.
#[inline(always)]
pub(crate) fn from_frame<T: Real>(axes: &Rows<T>, m: [T; 6]) -> Symmetric<T> {
    let [q, r, s] = *axes;
    let row = |a: T, b: T, c: T| -> [T; 3] {
        [a * q[0] + b * r[0] + c * s[0], a * q[1] + b * r[1] + c * s[1], a * q[2] + b * r[2] + c * s[2]]
    };
    let (mq, mr, ms) = (row(m[0], m[3], m[5]), row(m[3], m[1], m[4]), row(m[5], m[4], m[2]));
    let entry = |i: usize, j: usize| q[i] * mq[j] + r[i] * mr[j] + s[i] * ms[j];
    Symmetric { components: [entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(0, 2)] }
}
