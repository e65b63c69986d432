//! Invariants of the part of a deformation that does not change the volume, and their derivatives.
//!
//! ```text
//! Ī₁ = J^(−2/3) I₁      Ī₂ = J^(−4/3) I₂      of C or B, unchanged by a dilatation
//! ```

use piola_numerics::internal::Lanewise;
use piola_numerics::{Mask, Real};
use piola_tensor::internal::rows::Rows;

use super::{derivatives, first, second};
use crate::strain::kernels::{green, left_cauchy_green, right_cauchy_green, right_cauchy_green_minus_one};
use crate::{Deformation, Symmetric};

/// J^p.
#[cfg_attr(not(debug_assertions), inline(always))]
fn power_of_jacobian<T: Real>(deformation: &impl Deformation<T>, exponent: f64) -> T {
    (T::lit(exponent) * deformation.ln_jacobian()).exp()
}

/// Ī₁ = J^(−2/3) I₁, unchanged by a dilatation.
///
/// # Accuracy
/// 8 ulp × the condition number; |ln J| ulp from the power.
///
/// # Example
/// ```
/// use piola_continuum::{DeformationGradient, strain::invariants};
/// let bar = DeformationGradient::uniaxial(8.0, 1.0)?;
/// assert!((invariants::isochoric_first(&bar) - 66.0 / 4.0_f64).abs() < 1e-13); // (64 + 1 + 1)/8^(2/3)
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn isochoric_first<T: Real>(deformation: &impl Deformation<T>) -> T {
    let [excess, volume] = T::lanewise(&First, of_deformation(deformation));
    let (near, beside) = (is_near(volume), T::lit(3.0) + excess);
    if near.all() {
        return beside;
    }
    T::select(near, beside, power_of_jacobian(deformation, -2.0 / 3.0) * first(deformation))
}

/// Ī₂ = J^(−4/3) I₂, unchanged by a dilatation.
///
/// # Accuracy
/// 8 ulp × the condition number; |ln J| ulp from the power.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn isochoric_second<T: Real>(deformation: &impl Deformation<T>) -> T {
    let [excess, volume] = T::lanewise(&Second, of_deformation(deformation));
    let (near, beside) = (is_near(volume), T::lit(3.0) + excess);
    if near.all() {
        return beside;
    }
    T::select(near, beside, power_of_jacobian(deformation, -4.0 / 3.0) * second(deformation))
}

/// Ī₁ − 3, without cancellation: it is of second order in the strain's deviator.
///
/// ```text
/// C ~ 1 + D,  tr D = 0:    Ī₁ − 3 = 3 ((1 + v)^(−1/3) − 1),    v = det(1 + D) − 1 = −½ D : D + det D
/// ```
///
/// # Accuracy
/// A few ulp × |E|/|dev E|, of itself, however small the strain is.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn isochoric_first_minus_three<T: Real>(deformation: &impl Deformation<T>) -> T {
    let [excess, volume] = T::lanewise(&First, of_deformation(deformation));
    let near = is_near(volume);
    if near.all() {
        return excess;
    }
    T::select(near, excess, power_of_jacobian(deformation, -2.0 / 3.0) * first(deformation) - T::lit(3.0))
}

/// Ī₂ − 3, without cancellation: it is of second order in the strain's deviator.
///
/// ```text
/// Ī₂ − 3 = (1 + v)^(−2/3) (3 − ½ D : D) − 3        with D and v as for Ī₁
/// ```
///
/// # Accuracy
/// As [`isochoric_first_minus_three`].
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn isochoric_second_minus_three<T: Real>(deformation: &impl Deformation<T>) -> T {
    let [excess, volume] = T::lanewise(&Second, of_deformation(deformation));
    let near = is_near(volume);
    if near.all() {
        return excess;
    }
    T::select(near, excess, power_of_jacobian(deformation, -4.0 / 3.0) * second(deformation) - T::lit(3.0))
}

/// Ī₁ − 3 and Ī₂ − 3, what they share computed once.
///
/// # Accuracy
/// As [`isochoric_first_minus_three`].
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn isochoric_minus_three<T: Real>(deformation: &impl Deformation<T>) -> [T; 2] {
    let [x, y, volume] = T::lanewise(&Both, of_deformation(deformation));
    let near = is_near(volume);
    if near.all() {
        return [x, y];
    }
    let three = T::lit(3.0);
    let power = power_of_jacobian(deformation, -2.0 / 3.0);
    [
        T::select(near, x, power * first(deformation) - three),
        T::select(near, y, power * power * second(deformation) - three),
    ]
}

/// F and ∇u, nine numbers each.
#[cfg_attr(not(debug_assertions), inline(always))]
fn of_deformation<T: Real>(deformation: &impl Deformation<T>) -> [T; 18] {
    let [[a, b, c], [d, e, f], [g, h, i]] = deformation.gradient_rows();
    let [[j, k, l], [m, n, o], [p, q, r]] = deformation.displacement_rows();
    [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r]
}

/// Where the strain is not so large that 1 + D has lost its smallest eigenvalue, of det(1 + D) − 1.
#[cfg_attr(not(debug_assertions), inline(always))]
fn is_near<T: Real>(volume: T) -> T::Mask {
    T::lit(-0.75).less_than(volume)
}

/// Ī₁ − 3 of F and ∇u, and det(1 + D) − 1.
struct First;

/// Ī₂ − 3 of F and ∇u, and det(1 + D) − 1.
struct Second;

/// Both, and det(1 + D) − 1.
struct Both;

impl Lanewise<18, 2> for First {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<T: Real>(&self, inputs: [T; 18]) -> [T; 2] {
        let deviation = Deviation::of(inputs);
        [deviation.first_minus_three(), deviation.volume]
    }
}

impl Lanewise<18, 2> for Second {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<T: Real>(&self, inputs: [T; 18]) -> [T; 2] {
        let deviation = Deviation::of(inputs);
        [deviation.second_minus_three(), deviation.volume]
    }
}

impl Lanewise<18, 3> for Both {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<T: Real>(&self, inputs: [T; 18]) -> [T; 3] {
        let deviation = Deviation::of(inputs);
        [deviation.first_minus_three(), deviation.second_minus_three(), deviation.volume]
    }
}

/// C = c (1 + D) with c = ⅓ tr C and tr D = 0, and (1 + v)^(−1/3) with v = det(1 + D) − 1.
struct Deviation<T> {
    /// −½ D : D, the second invariant of D.
    second: T,
    /// v.
    volume: T,
    /// r = (1 + v)^(−1/3).
    root: T,
    /// r − 1 = −v r³/(1 + r + r²).
    root_change: T,
}

impl<T: Real> Deviation<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn of(inputs: [T; 18]) -> Self {
        if T::ORDER == 0 { Self::inlined(inputs) } else { Self::apart(inputs) }
    }

    /// Of numbers with derivatives it is long: it is compiled once for each.
    #[inline(never)]
    fn apart(inputs: [T; 18]) -> Self {
        Self::inlined(inputs)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn inlined([a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r]: [T; 18]) -> Self {
        // From 2E where C is near 1, from C itself where a dilatation has moved it away.
        let twice_green = right_cauchy_green_minus_one([[j, k, l], [m, n, o], [p, q, r]]);
        let metric = right_cauchy_green([[a, b, c], [d, e, f], [g, h, i]]);
        let excess = twice_green.trace() / T::lit(3.0);
        let near = excess.abs().less_than(T::lit(0.5));
        let mean = T::select(near, T::one() + excess, metric.trace() / T::lit(3.0));
        let ([a, b, c, d, e, f], [u, v, w, x, y, z]) =
            (twice_green.deviator().components, metric.deviator().components);
        let chosen = [
            T::select(near, a, u),
            T::select(near, b, v),
            T::select(near, c, w),
            T::select(near, d, x),
            T::select(near, e, y),
            T::select(near, f, z),
        ];
        let d = Symmetric { components: chosen } * mean.recip();
        let second = T::lit(-0.5) * d.double_contraction(&d);
        let volume = second + d.determinant();
        let root = (T::one() + volume).recip_cbrt();
        let square = root * root;
        let root_change = -(volume * (root * square) / ((T::one() + root) + square));
        Self { second, volume, root, root_change }
    }

    /// 3 (r − 1).
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn first_minus_three(&self) -> T {
        T::lit(3.0) * self.root_change
    }

    /// 3 (r² − 1) − ½ r² D : D.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn second_minus_three(&self) -> T {
        T::lit(3.0) * (self.root_change * (T::one() + self.root)) + self.second * (self.root * self.root)
    }
}

/// ∂Ī₁/∂C = J^(−2/3) (1 − ⅓ I₁ C⁻¹) = 2 J^(−2/3) C⁻¹ dev E, without cancellation at small strain.
///
/// # Accuracy
/// A few ulp × the condition number of C.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn isochoric_first_derivative<T: Real>(deformation: &impl Deformation<T>) -> Symmetric<T> {
    let e = green(deformation.displacement_rows());
    times_inverse_metric(deformation, &e.deviator(), T::lit(2.0) * power_of_jacobian(deformation, -2.0 / 3.0))
}

/// ∂Ī₂/∂C = J^(−4/3) (I₁ 1 − C − ⅔ I₂ C⁻¹) = 2 J^(−4/3) C⁻¹ dev((1 + 2 tr E) E − 2 E²).
///
/// # Accuracy
/// As [`isochoric_first_derivative`].
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn isochoric_second_derivative<T: Real>(deformation: &impl Deformation<T>) -> Symmetric<T> {
    let e = green(deformation.displacement_rows());
    let square = left_cauchy_green(e.rows());
    let two = T::lit(2.0);
    let inner = e * (T::one() + two * e.trace()) - square * two;
    times_inverse_metric(deformation, &inner.deviator(), two * power_of_jacobian(deformation, -4.0 / 3.0))
}

/// s C⁻¹ A of an A that commutes with C.
#[cfg_attr(not(debug_assertions), inline(always))]
fn times_inverse_metric<T: Real>(deformation: &impl Deformation<T>, a: &Symmetric<T>, s: T) -> Symmetric<T> {
    let inverse = deformation.inverse_rows();
    let metric: Rows<T> = left_cauchy_green(inverse).rows();
    Symmetric::symmetric_part(piola_tensor::internal::rows::product(metric, a.rows())) * s
}

/// `D²Ī₁[X]`, the derivative of ∂Ī₁/∂C along a symmetric X.
///
/// ```text
/// −⅓ (C⁻¹ : X) ∂Ī₁/∂C + ⅓ J^(−2/3) (I₁ C⁻¹ X C⁻¹ − (tr X) C⁻¹)
/// ```
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn isochoric_first_second_derivative<T: Real>(deformation: &impl Deformation<T>, x: &Symmetric<T>) -> Symmetric<T> {
    let (metric, turned) = inverse_metric_and_sandwich(deformation, x);
    let third = T::lit(1.0 / 3.0);
    let rate = -third * metric.double_contraction(x);
    isochoric_first_derivative(deformation) * rate
        + (turned * first(deformation) - metric * x.trace()) * (third * power_of_jacobian(deformation, -2.0 / 3.0))
}

/// `D²Ī₂[X]`, the derivative of ∂Ī₂/∂C along a symmetric X.
///
/// ```text
/// −⅔ (C⁻¹ : X) ∂Ī₂/∂C + J^(−4/3) (tr X 1 − X − ⅔ (I₁ tr X − C : X) C⁻¹ + ⅔ I₂ C⁻¹ X C⁻¹)
/// ```
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn isochoric_second_second_derivative<T: Real>(
    deformation: &impl Deformation<T>,
    x: &Symmetric<T>,
) -> Symmetric<T> {
    let (metric, turned) = inverse_metric_and_sandwich(deformation, x);
    let two_thirds = T::lit(2.0 / 3.0);
    let rate = -two_thirds * metric.double_contraction(x);
    let c = right_cauchy_green(deformation.gradient_rows());
    let of_second = derivatives(&c)[1].double_contraction(x);
    isochoric_second_derivative(deformation) * rate
        + (derivatives(x)[1] - metric * (two_thirds * of_second) + turned * (two_thirds * second(deformation)))
            * power_of_jacobian(deformation, -4.0 / 3.0)
}

/// C⁻¹ and C⁻¹ X C⁻¹.
#[cfg_attr(not(debug_assertions), inline(always))]
fn inverse_metric_and_sandwich<T: Real>(
    deformation: &impl Deformation<T>,
    x: &Symmetric<T>,
) -> (Symmetric<T>, Symmetric<T>) {
    let metric = left_cauchy_green(deformation.inverse_rows());
    (metric, x.congruence(metric.rows()))
}
