//! U, its inverse and its functions by their components in the frame of the axes, and tensors made of these.

use piola_numerics::sums::unit_in_last_place;
use piola_numerics::{Mask, Real};

use super::{StretchAnalysis, choose, freeze, gram, twice_green};
use crate::Symmetric;
use crate::spectral::IsotropicFunction;
use crate::spectral::expansion::expand;
use crate::spectral::frame::{combination, from_frame, larger, smaller};
use crate::tensor::rows::{Rows, transpose};

impl<T: Real> StretchAnalysis<T> {
    /// Σ Mₖₗ qₖ ⊗ qₗ + s 1, and for small strain the multiple of E that was left out of M.
    #[inline(always)]
    pub(super) fn material(&self, components: [T; 6], slope: T, added: T) -> Symmetric<T> {
        let rest = from_frame(&self.axes, components);
        if !self.small.any() {
            return shifted(rest, added);
        }
        shifted(rest + self.twice_green * (T::lit(0.5) * self.shift * slope), added)
    }

    /// Σ Mₖₗ R qₖ ⊗ R qₗ + s 1, and for small strain the multiple of R E Rᵀ = ½ (B − 1) that was left out of M.
    #[inline(always)]
    pub(super) fn spatial(&self, components: [T; 6], slope: T, added: T) -> Symmetric<T> {
        let rest = from_frame(&self.turned_frame(), components);
        if !self.small.any() {
            return shifted(rest, added);
        }
        let twice_left_green = twice_green(&transpose(self.displacement));
        shifted(rest + twice_left_green * (T::lit(0.5) * self.shift * slope), added)
    }

    /// f at the diagonal of S.
    #[inline(always)]
    pub(super) fn values_at_stretches<F: IsotropicFunction + ?Sized>(&self, f: &F) -> [T; 3] {
        let beside = |k: usize| f.value_beside_one(self.excess[k]);
        let plain = |k: usize| f.value(self.stretches[k]);
        if self.small.all() {
            [beside(0), beside(1), beside(2)]
        } else if self.small.any() {
            [
                T::select(self.small, beside(0), plain(0)),
                T::select(self.small, beside(1), plain(1)),
                T::select(self.small, beside(2), plain(2)),
            ]
        } else {
            [plain(0), plain(1), plain(2)]
        }
    }

    /// f(S), less f′(1) E for small strain, and f′(1): what is left out then is added without a rotation.
    #[inline(always)]
    pub(super) fn frame_function<F: IsotropicFunction + ?Sized>(&self, f: &F) -> ([T; 6], T) {
        let function = expand(f, self.stretches, self.values_at_stretches(f), self.departure);
        if !self.small.any() {
            return (function, T::zero());
        }
        let slope = f.slope_at_one::<T>();
        let part = T::lit(0.5) * self.shift * slope;
        let e = self.square;
        let less = |k: usize| function[k] - part * e[k];
        ([less(0), less(1), less(2), less(3), less(4), less(5)], slope)
    }

    /// S less the shift.
    #[inline(always)]
    pub(super) fn frame_stretch(&self) -> [T; 6] {
        let ([x, y, z], d) = (self.excess, self.departure);
        if T::ORDER == 0 {
            return [x, y, z, d[3], d[4], d[5]];
        }
        [x + d[0], y + d[1], z + d[2], d[3], d[4], d[5]]
    }

    /// (S − m 1, m) with the middle stretch m, or for small strain (S − 1 − E, 0) = (−½ (S − 1)², 0): what remains
    /// to be put through the rounding of a change of frame.
    #[inline(always)]
    pub(super) fn beyond_green(&self) -> ([T; 6], T) {
        let k = self.frame_stretch();
        let [separate, upper, lower] = self.stretches;
        let middle = larger(lower, smaller(separate, upper));
        let less_middle = [k[0] - middle, k[1] - middle, k[2] - middle, k[3], k[4], k[5]];
        if !self.small.any() {
            return (less_middle, middle);
        }
        let [x, y, z, xy, yz, xz] = k;
        let half = T::lit(-0.5);
        // Products of two shears matter only where they are more than rounding.
        let shears = |a: T, b: T| if T::ORDER == 0 { T::zero() } else { a * b };
        let square = [
            half * (x * x + (shears(xy, xy) + shears(xz, xz))),
            half * (y * y + (shears(xy, xy) + shears(yz, yz))),
            half * (z * z + (shears(yz, yz) + shears(xz, xz))),
            half * (xy * (x + y) + shears(xz, yz)),
            half * (yz * (y + z) + shears(xy, xz)),
            half * (xz * (x + z) + shears(xy, yz)),
        ];
        if self.small.all() {
            return (square, T::zero());
        }
        (choose(self.small, square, less_middle), T::select(self.small, T::zero(), middle))
    }

    /// S⁻¹ less the shift.
    #[inline(always)]
    pub(super) fn frame_inverse(&self) -> [T; 6] {
        let d = self.departure;
        let reciprocal = [self.stretches[0].recip(), self.stretches[1].recip(), self.stretches[2].recip()];
        let less = |k: usize| {
            if self.small.any() {
                T::select(self.small, -(self.excess[k] * reciprocal[k]), reciprocal[k])
            } else {
                reciprocal[k]
            }
        };
        let start = [
            less(0),
            less(1),
            less(2),
            -(d[3] * (reciprocal[0] * reciprocal[1])),
            -(d[4] * (reciprocal[1] * reciprocal[2])),
            -(d[5] * (reciprocal[0] * reciprocal[2])),
        ];
        if T::ORDER == 0 {
            return start;
        }
        // S₀⁻¹ (1 − N S⁻¹), order by order, for the part beyond S₀⁻¹.
        let mut beyond = [T::zero(); 6];
        for _ in 0..T::ORDER {
            let y = |i: usize, j: usize| {
                let rest = beyond[PLACE[i][j]];
                if i == j { reciprocal[i] + rest } else { rest }
            };
            let entry = |i: usize, j: usize| {
                let row = |k: usize| d[PLACE[i][k]];
                -(reciprocal[i] * (row(0) * y(0, j) + row(1) * y(1, j) + row(2) * y(2, j)))
            };
            beyond = [entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(0, 2)];
        }
        [start[0] + beyond[0], start[1] + beyond[1], start[2] + beyond[2], beyond[3], beyond[4], beyond[5]]
    }

    /// Σₗ (S⁻¹ − shift)ₖₗ bₗ by rows.
    #[inline(always)]
    pub(super) fn divided_images(&self) -> Rows<T> {
        let [xx, yy, zz, xy, yz, xz] = self.frame_inverse();
        let [a, b, c] = self.images;
        let row = |x: T, y: T, z: T| combination(T::one(), combination(x, a, y, b), z, c);
        [row(xx, xy, xz), row(xy, yy, yz), row(xz, yz, zz)]
    }

    /// R qₖ by rows.
    #[inline(always)]
    pub(super) fn turned_frame(&self) -> Rows<T> {
        let divided = self.divided_images();
        let row = |k: usize| combination(self.shift, self.images[k], T::one(), divided[k]);
        [row(0), row(1), row(2)]
    }
}

const PLACE: [[usize; 3]; 3] = [[0, 3, 5], [3, 1, 4], [5, 4, 2]];

/// A + s 1.
#[inline(always)]
fn shifted<T: Real>(a: Symmetric<T>, s: T) -> Symmetric<T> {
    let [xx, yy, zz, xy, yz, xz] = a.components;
    Symmetric::new(xx + s, yy + s, zz + s, xy, yz, xz)
}

/// Whether images are not orthogonal enough for the first order to suffice.
#[inline(always)]
pub(super) fn skewed<T: Real>(images: &Rows<T>) -> T::Mask {
    let enough = T::lit((0.125 * unit_in_last_place::<T>()).sqrt());
    let g = gram(&freeze(*images));
    let length = [g[0].sqrt(), g[1].sqrt(), g[2].sqrt()];
    let tilted = |i: usize, j: usize, place: usize| (enough * (length[i] * length[j])).less_than(g[place].abs());
    tilted(0, 1, 3) | tilted(1, 2, 4) | tilted(0, 2, 5)
}

/// (λₖ, λₖ − shift) from the diagonal, 2eₖ for small strain and λₖ² otherwise, without derivatives.
#[inline(always)]
pub(super) fn roots_of<T: Real>(small: T::Mask, square: &[T; 6]) -> ([T; 3], [T; 3]) {
    let root = |k: usize| {
        let x = if T::ORDER == 0 { square[k] } else { square[k].frozen() };
        if !small.any() {
            let root = x.sqrt();
            return (root, root);
        }
        let beside = (T::one() + x).sqrt();
        let excess = x / (T::one() + beside);
        if small.all() {
            return (beside, excess);
        }
        let root = T::select(small, beside, x.sqrt());
        (root, T::select(small, excess, root))
    };
    let (a, b, c) = (root(0), root(1), root(2));
    ([a.0, b.0, c.0], [a.1, b.1, c.1])
}

/// What S has beyond its frozen diagonal: Sᵢⱼ = Gᵢⱼ/(λᵢ + λⱼ) off the diagonal, and the orders of derivatives.
#[inline(always)]
pub(super) fn departure_of<T: Real>(shift: T, square: &[T; 6], stretches: &[T; 3], excess: &[T; 3]) -> [T; 6] {
    let [a, b, c] = *stretches;
    let reciprocal = [(a + b).recip(), (b + c).recip(), (a + c).recip()];
    if T::ORDER == 0 {
        let o = T::zero();
        return [o, o, o, square[3] * reciprocal[0], square[4] * reciprocal[1], square[5] * reciprocal[2]];
    }
    // (shift + K)² = shift + square, K = excess + departure: each pass brings in one order.
    let weights = [(a + a).recip(), (b + b).recip(), (c + c).recip(), reciprocal[0], reciprocal[1], reciprocal[2]];
    let mut departure = [T::zero(); 6];
    for _ in 0..T::ORDER {
        let k = |i: usize, j: usize| {
            let rest = departure[PLACE[i][j]];
            if i == j { excess[i] + rest } else { rest }
        };
        let residual = |place: usize, i: usize, j: usize| {
            let doubled = (shift + shift) * k(i, j);
            square[place] - (doubled + (k(i, 0) * k(0, j) + k(i, 1) * k(1, j) + k(i, 2) * k(2, j)))
        };
        let step = [
            residual(0, 0, 0) * weights[0],
            residual(1, 1, 1) * weights[1],
            residual(2, 2, 2) * weights[2],
            residual(3, 0, 1) * weights[3],
            residual(4, 1, 2) * weights[4],
            residual(5, 0, 2) * weights[5],
        ];
        departure = core::array::from_fn(|place| departure[place] + step[place]);
    }
    departure
}
