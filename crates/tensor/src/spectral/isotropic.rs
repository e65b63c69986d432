//! Isotropic functions of a symmetric tensor: what the eigenvalues are put through, and its divided differences.

use piola_numerics::{Dual, Real};

use super::series::{Series, TERMS};

/// A function f of one variable that acts on a symmetric tensor through its eigenvalues:
/// f(A) = Σ f(λₖ) vₖ ⊗ vₖ.
///
/// Derivatives of f(A) are made of divided differences of f, which stay finite where eigenvalues coalesce:
///
/// ```text
/// f[a, b] = (f(a) − f(b))/(a − b),   f[a, a] = f′(a)
/// f[a, b, c] = (f[a, b] − f[b, c])/(a − c),   f[a, a, a] = ½ f″(a)
/// ```
///
/// Only [`value`](Self::value) has to be given. The provided divided differences are accurate near and at
/// coalescence for any f (they use its power series, taken from `value` itself); a function that is used in inner
/// loops may state closed forms without cancellation instead, as [`SquareRoot`](super::SquareRoot) does.
///
/// # Example
/// ```
/// use piola_tensor::spectral::{self, IsotropicFunction};
/// use piola_tensor::Symmetric;
/// use piola_numerics::{Dual, Real};
///
/// struct Cube;
/// impl IsotropicFunction for Cube {
///     fn value<T: Real>(&self, x: T) -> T {
///         x * x * x
///     }
/// }
/// // (1 + ε H)³ = 1 + 3 ε H + …
/// let shear = Symmetric::new(0.0, 0.0, 0.0, 1.0, 0.0, 0.0);
/// let slope = spectral::derivative(&Cube, &Symmetric::identity(), &shear);
/// assert!((slope.components[3] - 3.0_f64).abs() < 4e-15);
/// ```
pub trait IsotropicFunction {
    /// f(x).
    #[must_use]
    fn value<T: Real>(&self, x: T) -> T;

    /// f(1 + x): to be stated without cancellation by functions that vanish at 1, such as measures of strain.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn value_beside_one<T: Real>(&self, x: T) -> T {
        self.value(T::one() + x)
    }

    /// f(√s), given √s and s: to be stated by functions that need not wait for the root, such as the logarithm.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn value_of_root<T: Real>(&self, root: T, square: T) -> T {
        let _ = square;
        self.value(root)
    }

    /// f(√(1 + s)), given √(1 + s) − 1 and s.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn value_of_root_beside_one<T: Real>(&self, excess: T, square_less_one: T) -> T {
        let _ = square_less_one;
        self.value_beside_one(excess)
    }

    /// f[a, b], equal to f′(a) for a = b.
    ///
    /// The provided one is accurate to a few ulp of the largest of |f|/d and |f′| where d is
    /// [`smooth_within`](Self::smooth_within).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn divided_difference<T: Real>(&self, a: T, b: T) -> T {
        first_difference(self, a, b)
    }

    /// f[a, b] to about eight digits, given f(a) and f(b): enough to correct the rounding of a principal frame.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn rough_divided_difference<T: Real>(&self, a: T, b: T, value_at_a: T, value_at_b: T) -> T {
        let middle = T::lit(0.5) * (a + b);
        let gap = a - b;
        let near = gap.abs().less_than(self.smooth_within(middle) * T::lit(1e-4));
        let slope = self.value(Dual::variable(middle)).tangent;
        T::select(near, slope, (value_at_a - value_at_b) / T::select(near, T::one(), gap))
    }

    /// f′(1); zero where f is not regular there.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn slope_at_one<T: Real>(&self) -> T {
        let slope = self.divided_difference(T::one(), T::one());
        T::select(slope.is_finite(), slope, T::zero())
    }

    /// f[a, b, c], equal to ½ f″(a) for a = b = c.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn second_divided_difference<T: Real>(&self, a: T, b: T, c: T) -> T {
        second_difference(self, a, b, c)
    }

    /// A distance from x within which f has no singularity and does not vary much, |x| unless stated: where the
    /// power series at x may be used out to a sixth of it.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn smooth_within<T: Real>(&self, x: T) -> T {
        x.abs()
    }
}

/// The power series of f(centre + unit ε) in ε.
#[inline]
pub(super) fn series_at<T: Real, F: IsotropicFunction + ?Sized>(f: &F, centre: T, unit: T) -> [T; TERMS] {
    f.value(Series::variable(centre, unit)).0
}

/// The unit of a power series at `centre`: one, unless powers of distances as small or large as those within which f is
/// smooth would leave the range of numbers.
#[inline]
pub(super) fn unit_at<T: Real, F: IsotropicFunction + ?Sized>(f: &F, centre: T) -> T {
    let reach = f.smooth_within(centre).frozen();
    let tiny = T::zero().less_than(reach) & reach.less_than(T::lit(1e-6));
    T::select(tiny | T::lit(1e6).less_than(reach), reach, T::one())
}

/// As [`difference_of_series`], of f at nodes around a centre.
#[inline]
fn difference_about<T: Real, F: IsotropicFunction + ?Sized, const M: usize>(f: &F, centre: T, nodes: [T; M]) -> T {
    let unit = unit_at(f, centre);
    let sum = difference_of_series(series_at(f, centre, unit), nodes.map(|node| (node - centre) / unit));
    (1..M).fold(sum, |sum, _| sum / unit)
}

/// f[x₁, …, xₘ] from the power series at a centre that the nodes are near: Σₖ cₘ₋₁₊ₖ hₖ(x − centre), with the
/// complete homogeneous polynomials hₖ.
#[inline]
pub(super) fn difference_of_series<T: Real, const M: usize>(coefficients: [T; TERMS], offsets: [T; M]) -> T {
    // hₖ of the first m offsets, by hₖ(x₁…xₘ) = hₖ(x₁…xₘ₋₁) + xₘ hₖ₋₁(x₁…xₘ).
    let mut h = [T::zero(); TERMS];
    h[0] = T::one();
    for offset in offsets {
        for k in 1..TERMS {
            let before = h[k - 1];
            h[k] += offset * before;
        }
    }
    // Smallest terms first.
    let mut sum = T::zero();
    for k in (0..=TERMS - M).rev() {
        sum += coefficients[M - 1 + k] * h[k];
    }
    sum
}

/// Where the nodes between `low` and `high` are close enough for the power series at their middle.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn clustered<T: Real, F: IsotropicFunction + ?Sized>(f: &F, low: T, high: T) -> T::Mask {
    let middle = T::lit(0.5) * (low + high);
    (high - low).at_most(f.smooth_within(middle) * T::lit(1.0 / 3.0))
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn first_difference<T: Real, F: IsotropicFunction + ?Sized>(f: &F, a: T, b: T) -> T {
    use piola_numerics::Mask;
    let middle = T::lit(0.5) * (a + b);
    let near = clustered(f, a.min(b), a.max(b));
    let gap = T::select(near, T::one(), a - b);
    let quotient = (f.value(a) - f.value(b)) / gap;
    if !near.any() {
        return quotient;
    }
    T::select(near, difference_about(f, middle, [a, b]), quotient)
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn second_difference<T: Real, F: IsotropicFunction + ?Sized>(f: &F, a: T, b: T, c: T) -> T {
    use piola_numerics::Mask;
    let [high, between, low] = super::decomposition::descending([a, b, c]);
    let middle = T::lit(0.5) * (high + low);
    let near = clustered(f, low, high);
    let gap = T::select(near, T::one(), high - low);
    let quotient = (f.divided_difference(high, between) - f.divided_difference(between, low)) / gap;
    if !near.any() {
        return quotient;
    }
    T::select(near, difference_about(f, middle, [high, between, low]), quotient)
}
