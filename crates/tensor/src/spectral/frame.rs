//! The principal frame of a symmetric tensor, by deflation: the kernel under everything spectral.
//!
//! ```text
//! A = m 1 + p B,  tr B = 0,  ½ B:B = 3        eigenvalues x of B:  x³ − 3x − 2r = 0,  r = ½ det B ∈ [−1, 1]
//! ```
//! Of the three roots 2 cos((arccos r + 2πk)/3) the one of largest modulus, y = |x| ∈ [√3, 2], is separated from
//! the others by at least √3 and is a regular function of |r|: a polynomial
//! gives it without trigonometry. Its eigenvector is a column of adj(B − x1), which has rank one and the smallest
//! nonzero eigenvalue 6; what remains is a 2×2 problem in the plane across it, solved by one rotation of Jacobi,
//! which is exact for coalescent pairs too. No step divides by a gap.

use piola_numerics::linear::matrix3::{cross, dot};
use piola_numerics::sums::unit_in_last_place;
use piola_numerics::{Mask, Real};

use crate::Symmetric;
use crate::rows::{Rows, apply};

/// Near-minimax polynomial of the root y in |r| − ½ on [−½, ½], error 2·10⁻¹⁶.
const ROOT: [f64; 18] = [
    1.879_385_241_571_816_6,
    0.263_287_229_089_799_07,
    -0.051_451_311_901_238_125,
    0.017_706_479_293_360_177,
    -0.007_476_648_949_177_976,
    0.003_514_522_796_557_794_5,
    -0.001_765_283_297_331_928_5,
    0.000_927_561_951_534_681_6,
    -0.000_503_577_787_516_658_4,
    0.000_280_248_729_545_828_73,
    -0.000_158_945_367_582_658_66,
    9.161_096_611_985_547e-5,
    -5.401_356_609_724_443e-5,
    3.189_109_794_447_260_4e-5,
    -1.691_556_509_453_063e-5,
    1.012_521_566_321_315e-5,
    -1.055_496_289_493_908_9e-5,
    6.446_471_913_600_215e-6,
];

/// Bounds within which cubes neither overflow nor vanish.
struct Range {
    low: f64,
    high: f64,
    /// Added to a square so that its root has a reciprocal: far below the smallest square in range.
    nothing_squared: f64,
    /// Added to a modulus of order one for the same purpose.
    nothing: f64,
}

const DOUBLE: Range = Range { low: 1e-100, high: 1e100, nothing_squared: 1e-240, nothing: 1e-140 };
const SINGLE: Range = Range { low: 1e-12, high: 1e12, nothing_squared: 1e-32, nothing: 1e-17 };

#[cfg_attr(not(debug_assertions), inline(always))]
fn range<T: Real>() -> Range {
    if unit_in_last_place::<T>() < 1e-10 { DOUBLE } else { SINGLE }
}

/// Four terms of the polynomial of the root, from k on.
#[cfg_attr(not(debug_assertions), inline(always))]
fn cubic<T: Real>(k: usize, t: T, t2: T) -> T {
    (T::lit(ROOT[k]) + T::lit(ROOT[k + 1]) * t) + (T::lit(ROOT[k + 2]) + T::lit(ROOT[k + 3]) * t) * t2
}

/// The root y of y³ − 3y = 2q in [√3, 2], for 0 ≤ q ≤ 1, or beyond by rounding.
#[cfg_attr(not(debug_assertions), inline(always))]
fn separated_root<T: Real>(q: T) -> T {
    let t = q - T::lit(0.5);
    let t2 = t * t;
    let t4 = t2 * t2;
    let t8 = t4 * t4;
    let low = cubic(0, t, t2) + cubic(4, t, t2) * t4;
    let high = cubic(8, t, t2) + cubic(12, t, t2) * t4;
    (low + (T::lit(ROOT[16]) + T::lit(ROOT[17]) * t) * (t8 * t8)) + high * t8
}

/// The larger of two numbers by one comparison.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn larger<T: Real>(a: T, b: T) -> T {
    T::select(a.less_than(b), b, a)
}

/// The smaller of two numbers by one comparison.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn smaller<T: Real>(a: T, b: T) -> T {
    T::select(b.less_than(a), b, a)
}

/// The largest modulus of six numbers.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn largest_modulus<T: Real>(a: [T; 6]) -> T {
    let [a, b, c, d, e, f] = [a[0].abs(), a[1].abs(), a[2].abs(), a[3].abs(), a[4].abs(), a[5].abs()];
    larger(larger(larger(a, b), larger(c, d)), larger(e, f))
}

/// `if_true` or `if_false`, component by component.
#[cfg_attr(not(debug_assertions), inline(always))]
fn choose<T: Real>(mask: T::Mask, if_true: [T; 3], if_false: [T; 3]) -> [T; 3] {
    [
        T::select(mask, if_true[0], if_false[0]),
        T::select(mask, if_true[1], if_false[1]),
        T::select(mask, if_true[2], if_false[2]),
    ]
}

/// a u + b v.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn combination<T: Real>(a: T, u: [T; 3], b: T, v: [T; 3]) -> [T; 3] {
    [a * u[0] + b * v[0], a * u[1] + b * v[1], a * u[2] + b * v[2]]
}

/// a u.
#[cfg_attr(not(debug_assertions), inline(always))]
fn times<T: Real>([x, y, z]: [T; 3], a: T) -> [T; 3] {
    [x * a, y * a, z * a]
}

/// u/a: a vector along an axis over its length is exactly of length 1, which by the reciprocal it need not be.
#[cfg_attr(not(debug_assertions), inline(always))]
fn over<T: Real>([x, y, z]: [T; 3], a: T) -> [T; 3] {
    [x / a, y / a, z / a]
}

/// ½ A:A/3 of the squares of its components, and a little.
#[cfg_attr(not(debug_assertions), inline(always))]
fn mean_square<T: Real>([xx, yy, zz, xy, yz, xz]: [T; 6], little: f64) -> T {
    (xx + yy + zz) * T::lit(1.0 / 6.0) + ((xy + yz + xz) * T::lit(1.0 / 3.0) + T::lit(little))
}

/// A over its largest modulus where the mask holds and A is not zero.
#[cold]
#[inline(never)]
fn brought_into_range<T: Real>(mask: T::Mask, a: [T; 6]) -> [T; 6] {
    let largest = largest_modulus(a);
    let divisor = T::select(mask & T::zero().less_than(largest), largest, T::one());
    a.map(|x| x / divisor)
}

/// A principal frame before its last rotation, which is that of a 2×2 problem.
#[derive(Clone, Copy, Debug)]
pub struct UnturnedFrame<T: Real> {
    /// The first axis, and two unit vectors across it, by rows.
    pub vectors: Rows<T>,
    /// (cos φ, sin φ) r of the angle φ by which these two are to be turned.
    turn: [T; 2],
    /// r², which is 1 exactly where nothing is to be turned.
    square: T,
    /// Where the first axis is that of the largest eigenvalue, and not of the smallest.
    pub first: T::Mask,
}

impl<T: Real> UnturnedFrame<T> {
    /// The axes by rows.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn axes(&self) -> Rows<T> {
        let ([n, u, w], [c, s]) = (self.vectors, self.turn);
        let inverse = self.square.sqrt().recip();
        let (c, s) = (c * inverse, s * inverse);
        [n, combination(c, u, s, w), combination(c, w, -s, u)]
    }

    /// (F qₖ by rows, their products) for the axes qₖ, from F: neither waits for r, the root with which the angle ends.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn images(&self, f: Rows<T>) -> (Rows<T>, [T; 6]) {
        let ([n, u, w], [c, s]) = (self.vectors, self.turn);
        let (n, u, w) = (apply(f, n), apply(f, u), apply(f, w));
        let (u, w) = (combination(c, u, s, w), combination(c, w, -s, u));
        let (inverse, inverse_square) = (self.square.sqrt().recip(), self.square.recip());
        let [nn, uu, ww, nu, uw, nw] = gram(&[n, u, w]);
        let products = [nn, uu * inverse_square, ww * inverse_square, nu * inverse, uw * inverse_square, nw * inverse];
        ([n, times(u, inverse), times(w, inverse)], products)
    }
}

/// Gₖₗ = bₖ · bₗ for 11, 22, 33, 12, 23, 13.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn gram<T: Real>([a, b, c]: &Rows<T>) -> [T; 6] {
    [dot(*a, *a), dot(*b, *b), dot(*c, *c), dot(*a, *b), dot(*b, *c), dot(*a, *c)]
}

/// Orthonormal right-handed axes, one a row, in which A is diagonal to rounding of its deviator. For scalars without
/// derivatives, or frozen ones.
///
/// The first axis is that of the separated eigenvalue, the largest where the mask holds and the smallest elsewhere; of the
/// other two that of the larger one comes first: [`in_order`] puts them into descending order.
///
/// # Accuracy
/// The axes are orthonormal within 2 ulp; the components that remain off the diagonal are a few ulp of the
/// deviator, whatever the gaps are. For A = m 1 the axes are some axes.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn separated_frame<T: Real>(a: &Symmetric<T>) -> (Rows<T>, T::Mask) {
    let frame = unturned_frame(a);
    (frame.axes(), frame.first)
}

/// `separated_frame` but for its last rotation.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn unturned_frame<T: Real>(a: &Symmetric<T>) -> UnturnedFrame<T> {
    let range = range::<T>();
    let (one, half) = (T::one(), T::lit(0.5));
    let [xx, yy, zz, xy, yz, xz] = a.components;

    // Three times the deviator, by differences: a large mean takes no digits from it.
    let (three, upper, lower, outer) = (T::lit(3.0), xx - yy, yy - zz, xx - zz);
    let (mut xx, mut yy, mut zz) = (upper + outer, lower - upper, -(outer + lower));
    let (mut xy, mut yz, mut xz) = (xy * three, yz * three, xz * three);
    let mut squares = [xx * xx, yy * yy, zz * zz, xy * xy, yz * yz, xz * xz];
    let mut square = mean_square(squares, range.nothing_squared);
    // Brought into range where its cubes would leave it.
    let outside = !(T::lit(range.low * range.low).at_most(square) & square.at_most(T::lit(range.high * range.high)));
    if outside.any() {
        [xx, yy, zz, xy, yz, xz] = brought_into_range(outside, [xx, yy, zz, xy, yz, xz]);
        squares = [xx * xx, yy * yy, zz * zz, xy * xy, yz * yz, xz * xz];
        square = mean_square(squares, range.nothing_squared);
    }

    // B, scaled to ½ B:B = 3; its determinant by that of the deviator, beside the root and the quotient.
    let size = square.sqrt();
    // 1/√s and r without waiting for the root.
    let inverse = square.recip();
    let scale = size * inverse;
    let [xxxx, yyyy, zzzz, xyxy, yzyz, xzxz] = squares;
    let determinant = xx * (yy * zz - yzyz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);

    // The column of adj(B − x1) = B² + x B + (x² − 3) 1 with the largest diagonal, or nearly: by a mean x, so that
    // the choice need not wait for x.
    let mean_root = (T::lit(1.87) * size).copysign(determinant);
    let (ax, ay, az) = (
        (xxxx + (xyxy + xzxz)) + mean_root * xx,
        (yyyy + (xyxy + yzyz)) + mean_root * yy,
        (zzzz + (yzyz + xzxz)) + mean_root * zz,
    );
    let (first, last) = (ay.at_most(ax), larger(ax, ay).less_than(az));

    let r = ((half * determinant) * inverse * inverse) * size;
    let (xx, yy, zz, xy, yz, xz) = (xx * scale, yy * scale, zz * scale, xy * scale, yz * scale, xz * scale);

    // The separated eigenvalue x and its eigenvector v, that column of adj(B − x1).
    let x = separated_root(r.abs()).copysign(r);
    let (mx, my, mz) = (xx - x, yy - x, zz - x);
    let (ax, ay, az) = (my * mz - yz * yz, mx * mz - xz * xz, mx * my - xy * xy);
    let (axy, ayz, axz) = (yz * xz - xy * mz, xy * xz - yz * mx, xy * yz - xz * my);
    let v = choose::<T>(last, [axz, ayz, az], choose::<T>(first, [ax, axy, axz], [axy, ay, ayz]));

    // Across it: u with one component left out, not the largest of v, and w = v × u.
    let u = choose::<T>(last, [T::zero(), v[2], -v[1]], [-v[1], v[0], T::zero()]);
    let w = cross(v, u);
    let (vv, uu) = (dot(v, v), dot(u, u));
    let length = vv.sqrt();

    // The 2×2 problem there, by one rotation: half the difference of its diagonal, h, and its shear, b, both times
    // |u|² |v|, since only their ratio counts. What need not wait for a root or a quotient does not: h |v|⁻¹ does not
    // wait for |v|, nor do the unit vectors for the angle.
    let image = [dot([xx, xy, xz], u), dot([xy, yy, yz], u), dot([xz, yz, zz], u)];
    let h = dot(u, image) + (half * x) * uu;
    let b = dot(w, image);
    let b_squared = b * b;
    let adjacent = (h.abs() * length + T::lit(range.nothing)) + ((h * h) * vv + b_squared).sqrt();
    let tangent = b / adjacent;
    let square = one + tangent * tangent;
    // By products with 1 and 0, which no compiler turns into a jump.
    let forward = half + half.copysign(h);
    let backward = one - forward;
    let turn = [forward + backward * tangent, backward + forward * tangent];
    let vectors = [over(v, length), over(u, uu.sqrt()), over(w, dot(w, w).sqrt())];

    // By x and not by r, whose zero may be negative: then x is the smallest.
    UnturnedFrame { vectors, turn, square, first: T::zero().at_most(x) }
}

/// Of `separated_frame`, what belongs to the axes, in descending order.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn in_order<T: Real>(first: T::Mask, [n, larger, smaller]: [T; 3]) -> [T; 3] {
    choose::<T>(first, [n, larger, smaller], [larger, smaller, n])
}

/// The axes of `separated_frame` in descending order, right-handed as they are.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn axes_in_order<T: Real>(first: T::Mask, [n, larger, smaller]: Rows<T>) -> Rows<T> {
    [choose::<T>(first, n, larger), choose::<T>(first, larger, smaller), choose::<T>(first, smaller, n)]
}

/// Q A Qᵀ for axes Q by rows: the components 11, 22, 33, 12, 23, 13 of A in that frame.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn components_in<T: Real>(axes: &Rows<T>, a: &Symmetric<T>) -> [T; 6] {
    let [q, r, s] = *axes;
    let (aq, ar, a_s) = (a.apply(q), a.apply(r), a.apply(s));
    [dot(q, aq), dot(r, ar), dot(s, a_s), dot(q, ar), dot(r, a_s), dot(q, a_s)]
}

/// Σ mₖ qₖ. A function, as all that lanes go through: what a closure holds the compiler may leave out of line.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn weighted<T: Real>([q, r, s]: &Rows<T>, [a, b, c]: [T; 3]) -> [T; 3] {
    [a * q[0] + b * r[0] + c * s[0], a * q[1] + b * r[1] + c * s[1], a * q[2] + b * r[2] + c * s[2]]
}

/// Entry (i, j) of Σ aₖ ⊗ bₖ.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn product_entry<T: Real>([a0, a1, a2]: &Rows<T>, [b0, b1, b2]: &Rows<T>, i: usize, j: usize) -> T {
    a0[i] * b0[j] + a1[i] * b1[j] + a2[i] * b2[j]
}

/// Σ Mₖₗ qₖ ⊗ qₗ: the tensor that has the components M in the frame of axes Q by rows.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn from_frame<T: Real>(axes: &Rows<T>, m: [T; 6]) -> Symmetric<T> {
    let [xx, yy, zz, xy, yz, xz] = m;
    let images = [weighted(axes, [xx, xy, xz]), weighted(axes, [xy, yy, yz]), weighted(axes, [xz, yz, zz])];
    Symmetric {
        components: [
            product_entry(axes, &images, 0, 0),
            product_entry(axes, &images, 1, 1),
            product_entry(axes, &images, 2, 2),
            product_entry(axes, &images, 0, 1),
            product_entry(axes, &images, 1, 2),
            product_entry(axes, &images, 0, 2),
        ],
    }
}
