//! Isotropic functions of symmetric tensors and their derivatives.
//!
//! ```text
//! f(A)        = Σ f(λᵢ) vᵢ ⊗ vᵢ
//! Df(A)[H]ᵢⱼ  = f[λᵢ, λⱼ] Hᵢⱼ                                       in the principal frame of A
//! D²f(A)[H, K]ᵢⱼ = Σₖ f[λᵢ, λₖ, λⱼ] (Hᵢₖ Kₖⱼ + Kᵢₖ Hₖⱼ)
//! ```

use piola_numerics::{Dual, Real};

use super::IsotropicFunction;
use super::expansion::expand;
use super::frame::{axes_in_order, components_in, from_frame, separated_frame};
use crate::Symmetric;
use crate::rows::Rows;

/// f(A) of a symmetric tensor.
///
/// # Accuracy
/// A few ulp of the largest |f(λ)| and of ‖A‖ max |f′|, whatever the gaps of the eigenvalues. Over scalars with
/// derivatives (up to the fourth order) these are finite and accurate at coalescence too; f must be regular at
/// each eigenvalue.
///
/// # Example
/// ```
/// use piola_tensor::{Symmetric, spectral};
/// use spectral::{Exponential, Logarithm, tensor_function};
/// let strain = Symmetric::new(0.1, 0.2, 0.3, 0.05, 0.0, 0.0);
/// let back = tensor_function(&Logarithm, &tensor_function(&Exponential, &strain));
/// assert!((back - strain).components.iter().all(|x: &f64| x.abs() < 1e-15));
/// ```
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn tensor_function<T: Real, F: IsotropicFunction + ?Sized>(f: &F, a: &Symmetric<T>) -> Symmetric<T> {
    let (axes, nodes, departure) = frame_of(a);
    let values = [f.value(nodes[0]), f.value(nodes[1]), f.value(nodes[2])];
    from_frame(&axes, expand(f, nodes, values, departure))
}

/// The frozen frame of A, its frozen diagonal there, and the rest.
#[cfg_attr(not(debug_assertions), inline(always))]
fn frame_of<T: Real>(a: &Symmetric<T>) -> (Rows<T>, [T; 3], [T; 6]) {
    if T::ORDER == 0 {
        let (axes, _) = separated_frame(a);
        let [x, y, z, xy, yz, xz] = components_in(&axes, a);
        return (axes, [x, y, z], [T::zero(), T::zero(), T::zero(), xy, yz, xz]);
    }
    let frozen = Symmetric { components: a.components.map(T::frozen) };
    let (axes, first) = separated_frame(&frozen);
    // Divided differences of higher orders take the values in descending order.
    let axes = axes_in_order(first, axes).map(|axis| axis.map(T::frozen));
    let [x, y, z, xy, yz, xz] = components_in(&axes, a);
    let nodes = [x.frozen(), y.frozen(), z.frozen()];
    (axes, nodes, [x - nodes[0], y - nodes[1], z - nodes[2], xy, yz, xz])
}

/// `Df(A)[H]`, the derivative of f(A) along H (Daleckii and Krein).
///
/// # Accuracy
/// Finite and accurate to a few ulp of ‖H‖ max |f[λᵢ, λⱼ]| at and near coalescence.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn derivative<T: Real, F: IsotropicFunction + ?Sized>(f: &F, a: &Symmetric<T>, h: &Symmetric<T>) -> Symmetric<T> {
    if T::ORDER != 0 {
        return along(f, a, h);
    }
    let (axes, nodes, _) = frame_of(a);
    let h = components_in(&axes, h);
    let d = first_differences(f, nodes);
    from_frame(&axes, [d[0] * h[0], d[1] * h[1], d[2] * h[2], d[3] * h[3], d[4] * h[4], d[5] * h[5]])
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn along<T: Real, F: IsotropicFunction + ?Sized>(f: &F, a: &Symmetric<T>, h: &Symmetric<T>) -> Symmetric<T> {
    let line = Symmetric { components: core::array::from_fn(|i| Dual::new(a.components[i], h.components[i])) };
    Symmetric { components: tensor_function(f, &line).components.map(|x| x.tangent) }
}

/// D²f(A)[H, K], the second derivative of f(A) along H and K.
///
/// # Accuracy
/// Finite and accurate to a few ulp of ‖H‖ ‖K‖ max |f[λᵢ, λₖ, λⱼ]| at and near coalescence.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn second_derivative<T: Real, F: IsotropicFunction + ?Sized>(
    f: &F,
    a: &Symmetric<T>,
    h: &Symmetric<T>,
    k: &Symmetric<T>,
) -> Symmetric<T> {
    if T::ORDER != 0 {
        return along_both(f, a, h, k);
    }
    let (axes, [p, q, r], _) = frame_of(a);
    let d = |a: T, b: T, c: T| f.second_divided_difference(a, b, c);
    let (ppp, ppq, ppr, pqq, pqr) = (d(p, p, p), d(p, p, q), d(p, p, r), d(p, q, q), d(p, q, r));
    let (prr, qqq, qqr, qrr, rrr) = (d(p, r, r), d(q, q, q), d(q, q, r), d(q, r, r), d(r, r, r));
    let h = components_in(&axes, h);
    let k = components_in(&axes, k);
    // (H K + K H)/… term by term: component (i, j) is Σₘ f[λᵢ, λₘ, λⱼ] (Hᵢₘ Kₘⱼ + Kᵢₘ Hₘⱼ).
    let t = |a: usize, b: usize| h[a] * k[b] + k[a] * h[b];
    from_frame(
        &axes,
        [
            ppp * t(0, 0) + ppq * t(3, 3) + ppr * t(5, 5),
            pqq * t(3, 3) + qqq * t(1, 1) + qqr * t(4, 4),
            prr * t(5, 5) + qrr * t(4, 4) + rrr * t(2, 2),
            ppq * t(0, 3) + pqq * t(3, 1) + pqr * t(5, 4),
            pqr * t(3, 5) + qqr * t(1, 4) + qrr * t(4, 2),
            ppr * t(0, 5) + pqr * t(3, 4) + prr * t(5, 2),
        ],
    )
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn along_both<T: Real, F: IsotropicFunction + ?Sized>(
    f: &F,
    a: &Symmetric<T>,
    h: &Symmetric<T>,
    k: &Symmetric<T>,
) -> Symmetric<T> {
    let plane = Symmetric {
        components: core::array::from_fn(|i| {
            Dual::new(Dual::new(a.components[i], h.components[i]), Dual::new(k.components[i], T::zero()))
        }),
    };
    Symmetric { components: tensor_function(f, &plane).components.map(|x| x.tangent.tangent) }
}

/// f[λᵢ, λⱼ] for 11, 22, 33, 12, 23, 13.
#[cfg_attr(not(debug_assertions), inline(always))]
fn first_differences<T: Real, F: IsotropicFunction + ?Sized>(f: &F, [a, b, c]: [T; 3]) -> [T; 6] {
    let d = |a: T, b: T| f.divided_difference(a, b);
    [d(a, a), d(b, b), d(c, c), d(a, b), d(b, c), d(a, c)]
}

/// The whole derivative D = ∂f(A)/∂A as an array of its components Dᵢⱼₖₗ: rows (i, j), columns (k, l) in the order
/// 11, 22, 33, 12, 23, 13, without factors of 2.
///
/// ```text
/// Df(A)[H]ᵢⱼ = Dᵢⱼₖₗ Hₖₗ,    Dᵢⱼₖₗ = Dⱼᵢₖₗ = Dₖₗᵢⱼ
/// ```
/// so that a column of a shear counts twice when the array is applied to six components.
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn derivative_array<T: Real, F: IsotropicFunction + ?Sized>(f: &F, a: &Symmetric<T>) -> [[T; 6]; 6] {
    let (o, l, h) = (T::zero(), T::one(), T::lit(0.5));
    let mut array = [[o; 6]; 6];
    for (column, size) in [l, l, l, h, h, h].into_iter().enumerate() {
        let mut direction = Symmetric::zero();
        direction.components[column] = size;
        let slope = derivative(f, a, &direction);
        for (row, entry) in slope.components.into_iter().enumerate() {
            array[row][column] = entry;
        }
    }
    array
}
