//! Invariants of deformation, their small-strain forms without cancellation, and their derivatives.
//!
//! ```text
//! I₁ = tr A      I₂ = ½ (I₁² − tr A²)      I₃ = det A                                B(4.62)
//! ∂I₁/∂A = 1     ∂I₂/∂A = I₁ 1 − A         ∂I₃/∂A = Cof A = I₃ A⁻¹                    W(24.12), W(24.16)
//! Ī₁ = J^(−2/3) I₁      Ī₂ = J^(−4/3) I₂                                      of C or B, unchanged by dilatation
//! ```
//!
//! | of | function | | small strain |
//! |---|---|---|---|
//! | any symmetric tensor | [`principal_invariants`], [`derivatives`], [`second_derivatives`] | | |
//! | a deformation: C and B | [`first`], [`second`], [`third`] | I | [`first_minus_three`], [`second_minus_three`], [`third_minus_one`] |
//! | its part without change of volume | [`isochoric_first`], [`isochoric_second`] | Ī | [`isochoric_first_minus_three`], [`isochoric_second_minus_three`] |
//!
//! J and J − 1 are asked of the [`Deformation`] itself. Derivatives of Ī with respect to C are those functions that
//! begin with `isochoric` and end with `derivative`.

use piola_numerics::linear::matrix3::dot;
use piola_numerics::{Mask, Real};

use super::kernels::{green, right_cauchy_green, right_cauchy_green_minus_one};
use crate::deformation::volume::trace_pair;
use crate::tensor::rows::{Rows, cofactor, double_contraction};
use crate::{Deformation, Symmetric};

pub use crate::stress::invariants::principal_invariants;

/// (∂I₁/∂A, ∂I₂/∂A, ∂I₃/∂A) = (1, I₁ 1 − A, Cof A) of a symmetric tensor; finite for singular A too.
///
/// # Example
/// ```
/// use piola_continuum::{Symmetric, strain::invariants};
/// let derivatives = invariants::derivatives(&Symmetric::diagonal([2.0, 3.0, 0.0]));
/// assert_eq!(derivatives[1], Symmetric::diagonal([3.0, 2.0, 5.0]));
/// assert_eq!(derivatives[2], Symmetric::diagonal([0.0, 0.0, 6.0]));
/// ```
///
/// # Source
/// W(24.12), W(24.16).
#[inline(always)]
#[must_use]
pub fn derivatives<T: Real>(a: &Symmetric<T>) -> [Symmetric<T>; 3] {
    let [xx, yy, zz, xy, yz, xz] = a.components;
    // I₁ − A₁₁ as A₂₂ + A₃₃: no difference is formed.
    let second = Symmetric::new(yy + zz, xx + zz, xx + yy, -xy, -yz, -xz);
    [Symmetric::identity(), second, Symmetric::upper_triangle(cofactor(a.rows()))]
}

/// The second derivatives of I₁, I₂ and I₃ along two symmetric directions X and Y.
///
/// ```text
/// D²I₁ = 0        D²I₂ = tr X tr Y − X : Y        D²I₃ = (tr A tr X − A : X) tr Y − tr X A : Y − tr A X : Y + 2 (A X) : Y
/// ```
///
/// # Example
/// ```
/// use piola_continuum::{Symmetric, strain::invariants};
/// let one = Symmetric::<f64>::identity();
/// assert_eq!(invariants::second_derivatives(&one, &one, &one), [0.0, 6.0, 6.0]); // of 3 s, 3 s² and s³ at s = 1
/// ```
#[inline(always)]
#[must_use]
pub fn second_derivatives<T: Real>(a: &Symmetric<T>, x: &Symmetric<T>, y: &Symmetric<T>) -> [T; 3] {
    let second = derivatives(x)[1].double_contraction(y);
    [T::zero(), second, cofactor_derivative(a, x).double_contraction(y)]
}

/// The derivative of Cof A along X: the polarised cofactor, without division.
#[inline(always)]
fn cofactor_derivative<T: Real>(a: &Symmetric<T>, x: &Symmetric<T>) -> Symmetric<T> {
    let [axx, ayy, azz, axy, ayz, axz] = a.components;
    let [xx, yy, zz, xy, yz, xz] = x.components;
    let two = T::lit(2.0);
    Symmetric::new(
        ayy * zz + azz * yy - two * ayz * yz,
        axx * zz + azz * xx - two * axz * xz,
        axx * yy + ayy * xx - two * axy * xy,
        (ayz * xz + axz * yz) - (axy * zz + azz * xy),
        (axy * xz + axz * xy) - (axx * yz + ayz * xx),
        (axy * yz + ayz * xy) - (ayy * xz + axz * yy),
    )
}

/// I₁ = tr C = F : F.
///
/// # Accuracy
/// 5 ulp.
///
/// # Example
/// ```
/// use piola_continuum::{DeformationGradient, strain::invariants};
/// assert_eq!(invariants::first(&DeformationGradient::diagonal([1.0, 2.0, 3.0])?), 14.0);
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[inline(always)]
#[must_use]
pub fn first<T: Real>(deformation: &impl Deformation<T>) -> T {
    let f = deformation.gradient_rows();
    double_contraction(f, f)
}

/// I₂ = ½ (I₁² − tr C²) = Cof F : Cof F.
///
/// # Accuracy
/// A few ulp × the condition number of Cof F: no difference of squares is formed.
///
/// # Example
/// ```
/// use piola_continuum::{DeformationGradient, strain::invariants};
/// assert_eq!(invariants::second(&DeformationGradient::diagonal([1.0, 2.0, 3.0])?), 49.0); // 4 + 36 + 9
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[inline(always)]
#[must_use]
pub fn second<T: Real>(deformation: &impl Deformation<T>) -> T {
    let k = deformation.cofactor_rows();
    double_contraction(k, k)
}

/// I₃ = det C = J².
///
/// # Example
/// ```
/// use piola_continuum::{DeformationGradient, strain::invariants};
/// assert_eq!(invariants::third(&DeformationGradient::diagonal([1.0, 2.0, 3.0])?), 36.0);
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[inline(always)]
#[must_use]
pub fn third<T: Real>(deformation: &impl Deformation<T>) -> T {
    let jacobian = deformation.jacobian();
    jacobian * jacobian
}

/// I₁ − 3 = 2 tr ∇u + ∇u : ∇u, without cancellation.
///
/// # Accuracy
/// A few ulp of |∇u|², or of I₁ − 3 where that is larger.
///
/// # Example
/// ```
/// use piola_continuum::{DisplacementGradient, strain::invariants};
/// assert_eq!(invariants::first_minus_three(&DisplacementGradient::simple_shear(1e-9)?), 1e-9 * 1e-9);
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[inline(always)]
#[must_use]
pub fn first_minus_three<T: Real>(deformation: &impl Deformation<T>) -> T {
    let h = deformation.displacement_rows();
    let (trace, error) = trace_pair(h);
    (trace + trace) + (double_contraction(h, h) + (error + error))
}

/// I₂ − 3 = 2 tr K + K : K with K = Cof F − 1 = (tr ∇u) 1 − ∇uᵀ + Cof ∇u, without cancellation.
///
/// # Accuracy
/// A few ulp of |∇u|², or of I₂ − 3 where that is larger; of |K|² at large strain.
///
/// # Example
/// ```
/// use piola_continuum::{DisplacementGradient, strain::invariants};
/// assert_eq!(invariants::second_minus_three(&DisplacementGradient::simple_shear(1e-9)?), 1e-9 * 1e-9);
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[inline(always)]
#[must_use]
pub fn second_minus_three<T: Real>(deformation: &impl Deformation<T>) -> T {
    let h = deformation.displacement_rows();
    let minors = cofactor(h);
    let (trace, error) = trace_pair(h);
    let k = [
        [(h[1][1] + h[2][2]) + minors[0][0], minors[0][1] - h[1][0], minors[0][2] - h[2][0]],
        [minors[1][0] - h[0][1], (h[0][0] + h[2][2]) + minors[1][1], minors[1][2] - h[2][1]],
        [minors[2][0] - h[0][2], minors[2][1] - h[1][2], (h[0][0] + h[1][1]) + minors[2][2]],
    ];
    // tr K = 2 tr ∇u + tr Cof ∇u.
    let doubled_second = minors[0][0] + minors[1][1] + minors[2][2];
    let (four, two) = (T::lit(4.0), T::lit(2.0));
    four * trace + ((two * doubled_second + double_contraction(k, k)) + four * error)
}

/// I₃ − 1 = (J − 1)(J + 1), without cancellation.
///
/// # Example
/// ```
/// use piola_continuum::{DisplacementGradient, strain::invariants};
/// assert_eq!(invariants::third_minus_one(&DisplacementGradient::diagonal([1e-20, 0.0, 0.0])?), 2e-20);
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[inline(always)]
#[must_use]
pub fn third_minus_one<T: Real>(deformation: &impl Deformation<T>) -> T {
    deformation.volume_change() * (T::one() + deformation.jacobian())
}

/// J^p.
#[inline(always)]
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
#[inline(always)]
#[must_use]
pub fn isochoric_first<T: Real>(deformation: &impl Deformation<T>) -> T {
    let deviation = Deviation::of(deformation);
    deviation.choose(
        |small| T::lit(3.0) + small.first_minus_three(),
        || power_of_jacobian(deformation, -2.0 / 3.0) * first(deformation),
    )
}

/// Ī₂ = J^(−4/3) I₂, unchanged by a dilatation.
///
/// # Accuracy
/// 8 ulp × the condition number; |ln J| ulp from the power.
///
/// # Example
/// ```
/// use piola_continuum::{DeformationGradient, strain::invariants};
/// let bar = DeformationGradient::uniaxial(8.0, 1.0)?;
/// assert!((invariants::isochoric_second(&bar) - 129.0 / 16.0_f64).abs() < 1e-13); // (64 + 64 + 1)/8^(4/3)
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[inline(always)]
#[must_use]
pub fn isochoric_second<T: Real>(deformation: &impl Deformation<T>) -> T {
    let deviation = Deviation::of(deformation);
    deviation.choose(
        |small| T::lit(3.0) + small.second_minus_three(),
        || power_of_jacobian(deformation, -4.0 / 3.0) * second(deformation),
    )
}

/// Ī₁ − 3, without cancellation: it is of second order in the strain's deviator.
///
/// ```text
/// C ~ 1 + D,  tr D = 0:    Ī₁ − 3 = 3 ((1 + v)^(−1/3) − 1),    v = det(1 + D) − 1 = −½ D : D + det D
/// ```
///
/// # Accuracy
/// A few ulp × |E|/|dev E|, of itself, however small the strain is.
///
/// # Example
/// ```
/// use piola_continuum::{DisplacementGradient, strain::invariants};
/// let shear = invariants::isochoric_first_minus_three(&DisplacementGradient::simple_shear(1e-9)?);
/// assert!((shear / 1e-18 - 1.0_f64).abs() < 1e-15); // k²
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[inline(always)]
#[must_use]
pub fn isochoric_first_minus_three<T: Real>(deformation: &impl Deformation<T>) -> T {
    let deviation = Deviation::of(deformation);
    deviation.choose(Deviation::first_minus_three, || {
        power_of_jacobian(deformation, -2.0 / 3.0) * first(deformation) - T::lit(3.0)
    })
}

/// Ī₂ − 3, without cancellation: it is of second order in the strain's deviator.
///
/// ```text
/// Ī₂ − 3 = (1 + v)^(−2/3) (3 − ½ D : D) − 3        with D and v as for Ī₁
/// ```
///
/// # Accuracy
/// As [`isochoric_first_minus_three`].
///
/// # Example
/// ```
/// use piola_continuum::{DisplacementGradient, strain::invariants};
/// let shear = invariants::isochoric_second_minus_three(&DisplacementGradient::simple_shear(1e-9)?);
/// assert!((shear / 1e-18 - 1.0_f64).abs() < 1e-15); // k²
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[inline(always)]
#[must_use]
pub fn isochoric_second_minus_three<T: Real>(deformation: &impl Deformation<T>) -> T {
    let deviation = Deviation::of(deformation);
    deviation.choose(Deviation::second_minus_three, || {
        power_of_jacobian(deformation, -4.0 / 3.0) * second(deformation) - T::lit(3.0)
    })
}

/// C = c (1 + D) with c = ⅓ tr C and tr D = 0.
struct Deviation<T> {
    /// −½ D : D, the second invariant of D.
    second: T,
    /// det(1 + D) − 1.
    volume: T,
}

impl<T: Real> Deviation<T> {
    #[inline(always)]
    fn of(deformation: &impl Deformation<T>) -> Self {
        // From 2E where C is near 1, from C itself where a dilatation has moved it away.
        let twice_green = right_cauchy_green_minus_one(deformation.displacement_rows());
        let metric = right_cauchy_green(deformation.gradient_rows());
        let excess = twice_green.trace() / T::lit(3.0);
        let near = excess.abs().less_than(T::lit(0.5));
        let mean = T::select(near, T::one() + excess, metric.trace() / T::lit(3.0));
        let (small, large) = (twice_green.deviator().components, metric.deviator().components);
        let chosen: [T; 6] = core::array::from_fn(|k| T::select(near, small[k], large[k]));
        let d = Symmetric { components: chosen } * mean.recip();
        let second = T::lit(-0.5) * d.double_contraction(&d);
        Self { second, volume: second + d.determinant() }
    }

    /// `near` unless the strain is so large that 1 + D has lost its smallest eigenvalue.
    #[inline(always)]
    fn choose(&self, near: impl Fn(&Self) -> T, far: impl Fn() -> T) -> T {
        let is_near = T::lit(-0.75).less_than(self.volume);
        if is_near.all() { near(self) } else { T::select(is_near, near(self), far()) }
    }

    /// (1 + v)^p − 1.
    #[inline(always)]
    fn power_minus_one(&self, exponent: f64) -> T {
        (T::lit(exponent) * self.volume.ln_1p()).exp_m1()
    }

    #[inline(always)]
    fn first_minus_three(&self) -> T {
        T::lit(3.0) * self.power_minus_one(-1.0 / 3.0)
    }

    #[inline(always)]
    fn second_minus_three(&self) -> T {
        let power = self.power_minus_one(-2.0 / 3.0);
        T::lit(3.0) * power + self.second * (T::one() + power)
    }
}

/// ∂Ī₁/∂C = J^(−2/3) (1 − ⅓ I₁ C⁻¹) = 2 J^(−2/3) C⁻¹ dev E, without cancellation at small strain.
///
/// # Accuracy
/// A few ulp × the condition number of C.
///
/// # Example
/// ```
/// use piola_continuum::{DeformationGradient, strain::invariants};
/// let bar = DeformationGradient::diagonal([2.0, 1.0, 0.5])?; // I₁ = 5.25, J = 1
/// let derivative = invariants::isochoric_first_derivative(&bar);
/// assert!((derivative.components[0] - (1.0 - 5.25 / 12.0_f64)).abs() < 1e-15);
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[inline(always)]
#[must_use]
pub fn isochoric_first_derivative<T: Real>(deformation: &impl Deformation<T>) -> Symmetric<T> {
    let e = green(deformation.displacement_rows());
    times_inverse_metric(deformation, &e.deviator(), T::lit(2.0) * power_of_jacobian(deformation, -2.0 / 3.0))
}

/// ∂Ī₂/∂C = J^(−4/3) (I₁ 1 − C − ⅔ I₂ C⁻¹) = 2 J^(−4/3) C⁻¹ dev((1 + 2 tr E) E − 2 E²).
///
/// # Accuracy
/// As [`isochoric_first_derivative`].
///
/// # Example
/// ```
/// use piola_continuum::{DeformationGradient, strain::invariants};
/// let bar = DeformationGradient::diagonal([2.0, 1.0, 0.5])?; // I₁ = I₂ = 5.25, J = 1
/// let derivative = invariants::isochoric_second_derivative(&bar);
/// assert!((derivative.components[0] - (5.25 - 4.0 - 3.5 / 4.0_f64)).abs() < 1e-15);
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[inline(always)]
#[must_use]
pub fn isochoric_second_derivative<T: Real>(deformation: &impl Deformation<T>) -> Symmetric<T> {
    let e = green(deformation.displacement_rows());
    let square = super::kernels::left_cauchy_green(e.rows());
    let two = T::lit(2.0);
    let inner = e * (T::one() + two * e.trace()) - square * two;
    times_inverse_metric(deformation, &inner.deviator(), two * power_of_jacobian(deformation, -4.0 / 3.0))
}

/// s C⁻¹ A of an A that commutes with C.
#[inline(always)]
fn times_inverse_metric<T: Real>(deformation: &impl Deformation<T>, a: &Symmetric<T>, s: T) -> Symmetric<T> {
    let inverse = deformation.inverse_rows();
    let metric: Rows<T> = super::kernels::left_cauchy_green(inverse).rows();
    Symmetric::symmetric_part(crate::tensor::rows::product(metric, a.rows())) * s
}

/// `D²Ī₁[X]`, the derivative of ∂Ī₁/∂C along a symmetric X.
///
/// ```text
/// −⅓ (C⁻¹ : X) ∂Ī₁/∂C + ⅓ J^(−2/3) (I₁ C⁻¹ X C⁻¹ − (tr X) C⁻¹)
/// ```
///
/// # Example
/// ```
/// use piola_continuum::{DeformationGradient, Symmetric, strain::invariants};
/// let shear = Symmetric::new(0.0, 0.0, 0.0, 1.0, 0.0, 0.0);
/// let second = invariants::isochoric_first_second_derivative(&DeformationGradient::identity(), &shear);
/// assert_eq!(second.components[3], 1.0_f64); // dev X
/// ```
#[inline(always)]
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
///
/// # Example
/// ```
/// use piola_continuum::{DeformationGradient, Symmetric, strain::invariants};
/// let shear = Symmetric::new(0.0, 0.0, 0.0, 1.0, 0.0, 0.0);
/// let second = invariants::isochoric_second_second_derivative(&DeformationGradient::identity(), &shear);
/// assert!((second.components[3] - 1.0_f64).abs() < 1e-15); // dev X
/// ```
#[inline(always)]
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
#[inline(always)]
fn inverse_metric_and_sandwich<T: Real>(
    deformation: &impl Deformation<T>,
    x: &Symmetric<T>,
) -> (Symmetric<T>, Symmetric<T>) {
    let metric = super::kernels::left_cauchy_green(deformation.inverse_rows());
    (metric, x.congruence(metric.rows()))
}

/// ∂I₁/∂F = 2 F.
///
/// # Example
/// ```
/// use piola_continuum::{DeformationGradient, strain::invariants};
/// let gradient = invariants::first_gradient(&DeformationGradient::diagonal([1.0, 2.0, 3.0])?);
/// assert_eq!(gradient[2], [0.0, 0.0, 6.0]);
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[inline(always)]
#[must_use]
pub fn first_gradient<T: Real>(deformation: &impl Deformation<T>) -> Rows<T> {
    crate::tensor::rows::scaled(deformation.gradient_rows(), T::lit(2.0))
}

/// ∂I₂/∂F = 2 F (I₁ 1 − C).
///
/// # Example
/// ```
/// use piola_continuum::{DeformationGradient, strain::invariants};
/// let gradient = invariants::second_gradient(&DeformationGradient::diagonal([1.0, 2.0, 3.0])?);
/// assert_eq!(gradient[0][0], 26.0); // 2 · 1 · (4 + 9)
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[inline(always)]
#[must_use]
pub fn second_gradient<T: Real>(deformation: &impl Deformation<T>) -> Rows<T> {
    let f = deformation.gradient_rows();
    let c = right_cauchy_green(f);
    gradient_of_metric_derivative(f, &derivatives(&c)[1])
}

/// ∂I₃/∂F = 2 J Cof F.
///
/// # Example
/// ```
/// use piola_continuum::{DeformationGradient, strain::invariants};
/// let gradient = invariants::third_gradient(&DeformationGradient::diagonal([1.0, 2.0, 3.0])?);
/// assert_eq!(gradient[0][0], 72.0); // 2 · 6 · (2 · 3)
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[inline(always)]
#[must_use]
pub fn third_gradient<T: Real>(deformation: &impl Deformation<T>) -> Rows<T> {
    crate::tensor::rows::scaled(deformation.cofactor_rows(), T::lit(2.0) * deformation.jacobian())
}

/// ∂φ/∂F = 2 F (∂φ/∂C) of a function of C, given its derivative: by the chain rule of C = Fᵀ F.
///
/// # Example
/// ```
/// use piola_continuum::{DeformationGradient, Deformation, strain::invariants};
/// let bar = DeformationGradient::diagonal([2.0, 1.0, 0.5])?;
/// let derivative = invariants::isochoric_first_derivative(&bar);
/// let gradient = invariants::gradient_of_metric_derivative(bar.gradient_rows(), &derivative);
/// assert!((gradient[0][0] - 4.0 * (1.0 - 5.25 / 12.0_f64)).abs() < 1e-14);
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
#[inline(always)]
#[must_use]
pub fn gradient_of_metric_derivative<T: Real>(f: Rows<T>, derivative: &Symmetric<T>) -> Rows<T> {
    let two = T::lit(2.0);
    let s = derivative.rows();
    f.map(|row| [two * dot(row, s[0]), two * dot(row, s[1]), two * dot(row, s[2])])
}
