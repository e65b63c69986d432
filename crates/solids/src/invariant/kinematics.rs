//! Kinematics for stress and tangent of a law of invariants: near the reference, turned from it, and far from it.

use piola_continuum::internal::strain as kernels;
use piola_continuum::{Deformation, Symmetric};
use piola_numerics::{Mask, Real};
use piola_tensor::internal::rows::{Rows, cofactor, double_contraction, product, scaled, sum};

use super::energy::{InvariantEnergy, Invariants, Slopes};

/// Strains with components up to this size take the forms in which everything is as small as the strain.
pub(super) const SMALL: f64 = 0.25;

/// Kinematic quantities of both stress and tangent.
#[derive(Debug)]
pub struct InvariantKinematics<T: Real> {
    /// F.
    pub(super) gradient: Rows<T>,
    /// 1 where what follows is a difference from the reference, 0 where it is not.
    pub(super) shift: T,
    /// C − 1; C where the strain is large.
    pub(super) change: Symmetric<T>,
    pub(super) cofactor: Rows<T>,
    /// The invariants.
    pub invariants: Invariants<T>,
    /// F − Cof F where ∇u is moderate, computed from ∇u; F − F⁻ᵀ where only the strain is; F elsewhere.
    beyond: Rows<T>,
    /// Mask of moderate ∇u.
    near: T::Mask,
    /// Mask of small strains.
    turned: T::Mask,
}

impl<T: Real> InvariantKinematics<T> {
    /// Errors are relative to the strain or to |∇u|², as a stress needs it: those of the invariants themselves, as an
    /// energy needs it, are those of [`invariants_of`].
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn of<L: InvariantEnergy>(gradient: Rows<T>, displacement: Rows<T>, jacobian: T) -> Self {
        if L::SECOND {
            Self::with_invariants::<true>(gradient, displacement, jacobian)
        } else {
            Self::with_invariants::<false>(gradient, displacement, jacobian)
        }
    }

    /// Those of a law that depends on I₂, or not.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn with_invariants<const SECOND: bool>(gradient: Rows<T>, displacement: Rows<T>, jacobian: T) -> Self {
        let closed = Self::closed::<SECOND>(gradient, displacement);
        let near = kernels::is_moderate(gradient, displacement);
        // The forms for large strain only in the lanes that need them.
        if near.all() { closed } else { Self { near, turned: near, ..closed }.completed::<SECOND>(jacobian) }
    }

    /// [`of`](Self::of) a deformation.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn of_deformation<L: InvariantEnergy>(deformation: &impl Deformation<T>) -> Self {
        Self::of::<L>(deformation.gradient_rows(), deformation.displacement_rows(), deformation.jacobian())
    }

    /// Those of F and ∇u where they are [moderate](kernels::is_moderate).
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn near<L: InvariantEnergy>(gradient: Rows<T>, h: Rows<T>) -> Self {
        if L::SECOND { Self::closed::<true>(gradient, h) } else { Self::closed::<false>(gradient, h) }
    }

    /// Those of F and ∇u where they are [moderate](kernels::is_moderate), of a law that depends on I₂, or not.
    // Without optimisation a function of its own: each method of each law would hold two copies.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[cfg_attr(debug_assertions, inline(never))]
    #[must_use]
    pub fn closed<const SECOND: bool>(gradient: Rows<T>, h: Rows<T>) -> Self {
        let (one, two) = (T::one(), T::lit(2.0));
        let change = kernels::right_cauchy_green_minus_one(h);
        let [a, b, c, x_12, x_23, x_13] = change.components;
        let first = a + b + c;
        let trace = h[0][0] + h[1][1] + h[2][2];

        // Cof F = (1 + tr H) 1 − Hᵀ + Cof H, J = 1 + tr H + i₂(H) + det H, F − Cof F = H + Hᵀ − (tr H) 1 − Cof H.
        let m = cofactor(h);
        let second_trace = m[0][0] + m[1][1] + m[2][2];
        let bend = second_trace + (h[0][0] * m[0][0] + h[0][1] * m[0][1] + h[0][2] * m[0][2]);
        let volume = trace + bend;
        let k = |i: usize| (trace - h[i][i]) + m[i][i];
        let minors = [
            [k(0), m[0][1] - h[1][0], m[0][2] - h[2][0]],
            [m[1][0] - h[0][1], k(1), m[1][2] - h[2][1]],
            [m[2][0] - h[0][2], m[2][1] - h[1][2], k(2)],
        ];
        let (x, y, z) = (h[0][1] + h[1][0], h[1][2] + h[2][1], h[0][2] + h[2][0]);
        let d = |i: usize| (h[i][i] + h[i][i]) - trace - m[i][i];
        let beyond =
            [[d(0), x - m[0][1], z - m[0][2]], [x - m[1][0], d(1), y - m[1][2]], [z - m[2][0], y - m[2][1], d(2)]];
        // I₂ − 3 = 2 tr (C − 1) + i₂(C − 1).
        let second = if SECOND {
            (two * first + (a * b + b * c + a * c)) - (x_12 * x_12 + x_23 * x_23 + x_13 * x_13)
        } else {
            T::zero()
        };
        Self {
            gradient,
            change,
            cofactor: [
                [one + minors[0][0], minors[0][1], minors[0][2]],
                [minors[1][0], one + minors[1][1], minors[1][2]],
                [minors[2][0], minors[2][1], one + minors[2][2]],
            ],
            invariants: Invariants {
                first,
                second,
                change: volume,
                jacobian: one + volume,
                first_whole: first + T::lit(3.0),
                second_whole: second + T::lit(3.0),
            },
            shift: one,
            beyond,
            near: Mask::splat(true),
            turned: Mask::splat(true),
        }
    }

    /// With the forms for large strain in the lanes that need them.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[cfg_attr(debug_assertions, inline(never))]
    fn completed<const SECOND: bool>(self, jacobian: T) -> Self {
        let (one, three) = (T::one(), T::lit(3.0));
        let plain_cofactor = cofactor(self.gradient);
        // I₁ = F : F and I₂ = Cof F : Cof F.
        let first = double_contraction(self.gradient, self.gradient);
        let second = if SECOND { double_contraction(plain_cofactor, plain_cofactor) } else { three };
        let (near, closed) = (self.near, self.invariants);
        let turned = largest_modulus(&self.change).at_most(T::lit(SMALL));
        let mut beyond = self.gradient;
        let mut shift = T::zero();
        let mut change = kernels::right_cauchy_green(self.gradient);
        if turned.any() {
            // F − F⁻ᵀ = F⁻ᵀ (C − 1), as for large rotations.
            let inverse_transpose = scaled(plain_cofactor, jacobian.recip());
            beyond = select(turned, product(inverse_transpose, self.change.rows()), beyond);
            shift = T::select(turned, one, shift);
            change = select_symmetric(turned, &self.change, &change);
        }
        Self {
            gradient: self.gradient,
            shift: T::select(near, one, shift),
            change: select_symmetric(near, &self.change, &change),
            cofactor: select(near, self.cofactor, plain_cofactor),
            invariants: Invariants {
                first: closed.first,
                second: T::select(near, closed.second, second - three),
                change: T::select(near, closed.change, jacobian - one),
                jacobian: T::select(near, closed.jacobian, jacobian),
                first_whole: T::select(near, closed.first_whole, first),
                second_whole: T::select(near, closed.second_whole, second),
            },
            beyond: select(near, self.beyond, beyond),
            near,
            turned,
        }
    }

    /// tr (C − 1), or tr C.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn trace(&self) -> T {
        let [a, b, c, ..] = self.change.components;
        a + b + c
    }

    /// P = k (F − Cof F) + (s + k (J − 1))/J Cof F + 2 w₂ F ((I₁ − 3) 1 − (C − 1)),  k = 2 w₁ + 4 w₂;
    /// at large strain P = 2 w₁ F + ∂W/∂J Cof F + 2 w₂ F (I₁ 1 − C).
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn first_piola<L: InvariantEnergy>(&self, slopes: &Slopes<T>) -> Rows<T> {
        if L::SECOND { self.stress::<true>(slopes) } else { self.stress::<false>(slopes) }
    }

    /// P of the slopes of a law that depends on I₂, or not.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn stress<const SECOND: bool>(&self, slopes: &Slopes<T>) -> Rows<T> {
        let (two, four) = (T::lit(2.0), T::lit(4.0));
        let mut stiffness = two * slopes.first;
        if SECOND {
            stiffness += four * slopes.second * self.shift;
        }
        let mut pressure = slopes.residual + stiffness * self.invariants.change;
        if !self.near.all() {
            let far = T::select(self.turned, slopes.residual, slopes.volume);
            pressure = T::select(self.near, pressure, far);
        }
        let stress =
            sum(scaled(self.beyond, stiffness), scaled(self.cofactor, pressure * self.invariants.jacobian.recip()));
        if !SECOND {
            return stress;
        }
        // The slope comes last: it waits for a root of J, and what is multiplied by it does not.
        let inner = Symmetric::identity() * self.trace() - self.change;
        sum(stress, scaled(product(self.gradient, inner.rows()), two * slopes.second))
    }
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn largest_modulus<T: Real>(a: &Symmetric<T>) -> T {
    let [a, b, c, d, e, f] = a.components;
    let (a, b, c, d, e, f) = (a.abs(), b.abs(), c.abs(), d.abs(), e.abs(), f.abs());
    let larger = |a: T, b: T| T::select(a.less_than(b), b, a);
    larger(larger(larger(a, b), larger(c, d)), larger(e, f))
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn select<T: Real>(mask: T::Mask, a: Rows<T>, b: Rows<T>) -> Rows<T> {
    // Loops, not closures: those would not be inlined into lanes.
    let mut chosen = b;
    let mut i = 0;
    while i < 3 {
        let mut j = 0;
        while j < 3 {
            chosen[i][j] = T::select(mask, a[i][j], b[i][j]);
            j += 1;
        }
        i += 1;
    }
    chosen
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn select_symmetric<T: Real>(mask: T::Mask, a: &Symmetric<T>, b: &Symmetric<T>) -> Symmetric<T> {
    let mut chosen = *b;
    let mut k = 0;
    while k < 6 {
        chosen.components[k] = T::select(mask, a.components[k], b.components[k]);
        k += 1;
    }
    chosen
}
