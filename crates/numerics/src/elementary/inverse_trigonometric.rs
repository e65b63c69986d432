//! arcsin, arccos, arctan and the angle of a point.
//!
//! ```text
//! arcsin x = x + x z A(z),  z = x²,                    |x| ≤ ½
//! arcsin x = π/2 − 2 arcsin √((1 − x)/2),              ½ < x
//! arctan x = θ + t + t z T(z),  z = t²,  t = tan(arctan x − θ),  tan θ ∈ {0, ½, 1, 3/2, ∞}
//! ```

use core::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use super::{both, choose, either, polynomial_10, polynomial_12, upper};

/// π/2 − `FRAC_PI_2`.
const HALF_PI_LOWER: f64 = 6.123_233_995_736_766e-17;
/// π − `PI`.
const PI_LOWER: f64 = 1.224_646_799_147_353_2e-16;

/// (arcsin x/x − 1)/z on |x| ≤ ½: near-minimax of degree 12, error 2⁻⁵⁷ relative to x after
/// multiplication by z.
const ARCSINE: [f64; 13] = [
    0.166_666_666_666_666_69,
    0.074_999_999_999_984_33,
    0.044_642_857_146_355_43,
    0.030_381_944_138_531_247,
    0.022_372_172_942_149_89,
    0.017_352_392_720_869_973,
    0.013_971_212_973_552_933,
    0.011_479_177_415_184_906,
    0.010_322_814_350_185_78,
    0.005_457_506_718_640_358,
    0.017_400_879_442_694_02,
    -0.014_851_887_071_247_204,
    0.028_757_851_367_421_566,
];

/// (arctan t/t − 1)/z on |t| ≤ 7/16: near-minimax of degree 10, error 2⁻⁵⁵ relative to t after
/// multiplication by z.
const ARCTANGENT: [f64; 11] = [
    -0.333_333_333_333_333_26,
    0.199_999_999_999_877_7,
    -0.142_857_142_831_486_4,
    0.111_111_109_005_604_75,
    -0.090_909_001_955_601_48,
    0.076_920_873_487_671_68,
    -0.066_632_392_991_071_36,
    0.058_477_247_206_451_06,
    -0.050_339_427_764_858_48,
    0.037_825_218_661_067_12,
    -0.017_547_235_157_290_005,
];

/// (|x| ≤ ½, y, y z A(z), lower part of y) where y is |x| or √((1 − |x|)/2).
#[cfg_attr(not(debug_assertions), inline(always))]
fn arcsine_parts(x: f64) -> (bool, f64, f64, f64) {
    let magnitude = x.abs();
    let small = magnitude <= 0.5;
    let half = 0.5 * (1.0 - magnitude);
    let root = half.sqrt();
    let root_upper = upper(root);
    // The tiny addend keeps 0/0 away at |x| = 1.
    let root_lower = (half - root_upper * root_upper) / (root + root_upper + 1e-300);
    let z = choose(small, x * x, half);
    let rest = choose(small, magnitude, root) * z * polynomial_12(z, ARCSINE);
    (small, choose(small, magnitude, root_upper), rest, choose(small, 0.0, root_lower))
}

/// arcsin x.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn asin(x: f64) -> f64 {
    let (small, y, rest, y_lower) = arcsine_parts(x);
    let near_one = FRAC_PI_4 - ((2.0 * rest - (HALF_PI_LOWER - 2.0 * y_lower)) - (FRAC_PI_4 - 2.0 * y));
    choose(small, y + rest, near_one).copysign(x)
}

/// arccos x.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn acos(x: f64) -> f64 {
    let (small, y, rest, y_lower) = arcsine_parts(x);
    let middle = FRAC_PI_2 - (y.copysign(x) - (HALF_PI_LOWER - rest.copysign(x)));
    let twice = 2.0 * (y + (rest + y_lower));
    let below = PI - 2.0 * (y + ((rest + y_lower) - HALF_PI_LOWER));
    choose(small, middle, choose(x < 0.0, below, twice))
}

/// The value that belongs to the first range that holds, or the last.
#[cfg_attr(not(debug_assertions), inline(always))]
fn pick(ranges: [bool; 4], v: [f64; 5]) -> f64 {
    choose(ranges[0], v[0], choose(ranges[1], v[1], choose(ranges[2], v[2], choose(ranges[3], v[3], v[4]))))
}

/// arctan x for 0 ≤ x.
#[cfg_attr(not(debug_assertions), inline(always))]
fn atan_of_positive(x: f64) -> f64 {
    // t = (a x + b)/(c x + d) in each range of x; θ in two parts.
    let (r1, r2, r3, r4) = (x < 0.4375, x < 0.6875, x < 1.1875, x < 2.4375);
    let ranges = [r1, r2, r3, r4];
    let numerator =
        choose(r4, x, 0.0) * pick(ranges, [1.0, 2.0, 1.0, 2.0, 0.0]) + pick(ranges, [0.0, -1.0, -1.0, -3.0, -1.0]);
    let denominator = x * pick(ranges, [0.0, 1.0, 1.0, 3.0, 1.0]) + pick(ranges, [1.0, 2.0, 1.0, 2.0, 0.0]);
    let angle = pick(ranges, [0.0, 0.463_647_609_000_806_1, FRAC_PI_4, 0.982_793_723_247_329, FRAC_PI_2]);
    let angle_lower = pick(
        ranges,
        [0.0, 2.269_877_745_296_168_7e-17, 3.061_616_997_868_383e-17, 1.390_331_103_123_099_8e-17, HALF_PI_LOWER],
    );
    let t = numerator / denominator;
    let z = t * t;
    angle + (t + (t * z * polynomial_10(z, ARCTANGENT) + angle_lower))
}

/// arctan x.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn atan(x: f64) -> f64 {
    atan_of_positive(x.abs()).copysign(x)
}

/// The angle of the point (x, y).
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn atan2(y: f64, x: f64) -> f64 {
    let (a, b) = (x.abs(), y.abs());
    // ∞/∞ counts as 1/1 and 0/0 as 0/1.
    let both_infinite = both(a == f64::INFINITY, b == f64::INFINITY);
    let both_zero = both(a == 0.0, b == 0.0);
    let (a, b) = (choose(either(both_infinite, both_zero), 1.0, a), choose(both_infinite, 1.0, b));
    let angle = atan_of_positive(b / a);
    let turned = PI - (angle - PI_LOWER);
    choose(x.is_sign_negative(), turned, angle).copysign(y)
}
