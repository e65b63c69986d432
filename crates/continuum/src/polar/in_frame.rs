//! U, its inverse and its functions by their components in the frame of the axes, and tensors made of these.

use piola_numerics::{Mask, Real};
use piola_tensor::internal::rows::{Rows, transpose};
use piola_tensor::internal::spectral::{combination, expand, from_frame, larger, smaller, weighted};
use piola_tensor::spectral::{IsotropicFunction, Logarithm};

use super::{StretchAnalysis, choose, twice_green};
use crate::Symmetric;

impl<T: Real> StretchAnalysis<T> {
    /// Σ Mₖₗ qₖ ⊗ qₗ + s 1, and for small strain the multiple of E that was left out of M.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn material(&self, components: [T; 6], slope: T, added: T) -> Symmetric<T> {
        let rest = from_frame(&self.axes, components);
        if !self.small.any() {
            return shifted(rest, added);
        }
        shifted(rest + self.twice_green * (T::lit(0.5) * self.shift * slope), added)
    }

    /// Σ Mₖₗ R qₖ ⊗ R qₗ + s 1, and for small strain the multiple of R E Rᵀ = ½ (B − 1) that was left out of M.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn spatial(&self, components: [T; 6], slope: T, added: T) -> Symmetric<T> {
        let rest = from_frame(&self.turned_frame(), components);
        if !self.small.any() {
            return shifted(rest, added);
        }
        let twice_left_green = twice_green(&transpose(self.displacement));
        shifted(rest + twice_left_green * (T::lit(0.5) * self.shift * slope), added)
    }

    /// f at the diagonal of S.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn values_at_stretches<F: IsotropicFunction + ?Sized>(&self, f: &F) -> [T; 3] {
        if self.small.all() {
            [self.beside_one(f, 0), self.beside_one(f, 1), self.beside_one(f, 2)]
        } else if self.small.any() {
            [
                T::select(self.small, self.beside_one(f, 0), self.plain(f, 0)),
                T::select(self.small, self.beside_one(f, 1), self.plain(f, 1)),
                T::select(self.small, self.beside_one(f, 2), self.plain(f, 2)),
            ]
        } else {
            [self.plain(f, 0), self.plain(f, 1), self.plain(f, 2)]
        }
    }

    /// f(λₖ) for small strain.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn beside_one<F: IsotropicFunction + ?Sized>(&self, f: &F, k: usize) -> T {
        f.value_of_root_beside_one(self.excess[k], frozen(self.square[k]))
    }

    /// f(λₖ).
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn plain<F: IsotropicFunction + ?Sized>(&self, f: &F, k: usize) -> T {
        f.value_of_root(self.stretches[k], frozen(self.square[k]))
    }

    /// f(S), less f′(1) E for small strain, and f′(1): what is left out then is added without a rotation.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn frame_function<F: IsotropicFunction + ?Sized>(&self, f: &F) -> ([T; 6], T) {
        self.frame_function_of(f, self.values_at_stretches(f))
    }

    /// (λₖ, ln λₖ) in the order of the frame, without derivatives: for functions of the logarithm that one computes oneself
    /// and gives to [`material_function_of`](Self::material_function_of).
    #[doc(hidden)]
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn stretches_in_frame(&self) -> ([T; 3], [T; 3]) {
        (self.stretches, self.values_at_stretches(&Logarithm))
    }

    /// [`material_function`](Self::material_function), given f at the stretches of
    /// [`stretches_in_frame`](Self::stretches_in_frame); for scalars without derivatives.
    #[doc(hidden)]
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn material_function_of<F: IsotropicFunction + ?Sized>(&self, f: &F, values: [T; 3]) -> Symmetric<T> {
        let (components, slope) = self.frame_function_of(f, values);
        self.material(components, slope, T::zero())
    }

    /// As [`material_function_of`](Self::material_function_of), f(V).
    #[doc(hidden)]
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn spatial_function_of<F: IsotropicFunction + ?Sized>(&self, f: &F, values: [T; 3]) -> Symmetric<T> {
        let (components, slope) = self.frame_function_of(f, values);
        self.spatial(components, slope, T::zero())
    }

    /// As [`frame_function`](Self::frame_function), given f at the diagonal of S.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn frame_function_of<F: IsotropicFunction + ?Sized>(&self, f: &F, values: [T; 3]) -> ([T; 6], T) {
        let function = expand(f, self.stretches, values, self.departure);
        if !self.small.any() {
            return (function, T::zero());
        }
        let slope = f.slope_at_one::<T>();
        let part = T::lit(0.5) * self.shift * slope;
        let ([xx, yy, zz, xy, yz, xz], e) = (function, self.square);
        let less = [
            xx - part * e[0],
            yy - part * e[1],
            zz - part * e[2],
            xy - part * e[3],
            yz - part * e[4],
            xz - part * e[5],
        ];
        (less, slope)
    }

    /// S less the shift.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn frame_stretch(&self) -> [T; 6] {
        let ([x, y, z], d) = (self.excess, self.departure);
        if T::ORDER == 0 {
            return [x, y, z, d[3], d[4], d[5]];
        }
        [x + d[0], y + d[1], z + d[2], d[3], d[4], d[5]]
    }

    /// (S − m 1, m) with the middle stretch m, or for small strain (S − 1 − E, 0) = (−½ (S − 1)², 0): what remains
    /// to be put through the rounding of a change of frame.
    #[cfg_attr(not(debug_assertions), inline(always))]
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
        let square = if T::ORDER == 0 {
            [
                half * (x * x),
                half * (y * y),
                half * (z * z),
                half * (xy * (x + y)),
                half * (yz * (y + z)),
                half * (xz * (x + z)),
            ]
        } else {
            [
                half * (x * x + (xy * xy + xz * xz)),
                half * (y * y + (xy * xy + yz * yz)),
                half * (z * z + (yz * yz + xz * xz)),
                half * (xy * (x + y) + xz * yz),
                half * (yz * (y + z) + xy * xz),
                half * (xz * (x + z) + xy * yz),
            ]
        };
        if self.small.all() {
            return (square, T::zero());
        }
        (choose(self.small, square, less_middle), T::select(self.small, T::zero(), middle))
    }

    /// S⁻¹ less the shift.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn frame_inverse(&self) -> [T; 6] {
        let d = self.departure;
        let reciprocal = [self.stretches[0].recip(), self.stretches[1].recip(), self.stretches[2].recip()];
        let [x, y, z] = if self.small.any() {
            let ([x, y, z], [a, b, c]) = (self.excess, reciprocal);
            [T::select(self.small, -(x * a), a), T::select(self.small, -(y * b), b), T::select(self.small, -(z * c), c)]
        } else {
            reciprocal
        };
        let start = [
            x,
            y,
            z,
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
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn divided_images(&self) -> Rows<T> {
        let [xx, yy, zz, xy, yz, xz] = self.frame_inverse();
        [
            weighted(&self.images, [xx, xy, xz]),
            weighted(&self.images, [xy, yy, yz]),
            weighted(&self.images, [xz, yz, zz]),
        ]
    }

    /// R qₖ by rows.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn turned_frame(&self) -> Rows<T> {
        let ([a, b, c], [x, y, z]) = (self.images, self.divided_images());
        let (s, one) = (self.shift, T::one());
        [combination(s, a, one, x), combination(s, b, one, y), combination(s, c, one, z)]
    }
}

const PLACE: [[usize; 3]; 3] = [[0, 3, 5], [3, 1, 4], [5, 4, 2]];

/// A + s 1.
#[cfg_attr(not(debug_assertions), inline(always))]
fn shifted<T: Real>(a: Symmetric<T>, s: T) -> Symmetric<T> {
    let [xx, yy, zz, xy, yz, xz] = a.components;
    Symmetric::new(xx + s, yy + s, zz + s, xy, yz, xz)
}

/// (λₖ, λₖ − shift) from the diagonal, 2eₖ for small strain and λₖ² otherwise, without derivatives.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn roots_of<T: Real>(small: T::Mask, square: &[T; 6]) -> ([T; 3], [T; 3]) {
    let [a, b, c] = [root_of(small, square[0]), root_of(small, square[1]), root_of(small, square[2])];
    ([a.0, b.0, c.0], [a.1, b.1, c.1])
}

/// One of [`roots_of`].
#[cfg_attr(not(debug_assertions), inline(always))]
fn root_of<T: Real>(small: T::Mask, square: T) -> (T, T) {
    let x = frozen(square);
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
}

/// x without derivatives.
#[cfg_attr(not(debug_assertions), inline(always))]
fn frozen<T: Real>(x: T) -> T {
    if T::ORDER == 0 { x } else { x.frozen() }
}

/// What S has beyond its frozen diagonal: Sᵢⱼ = Gᵢⱼ/(λᵢ + λⱼ) off the diagonal, and the orders of derivatives.
#[cfg_attr(not(debug_assertions), inline(always))]
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
