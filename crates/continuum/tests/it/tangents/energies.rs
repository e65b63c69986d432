//! Two energies, and their stresses and tangents by exact derivatives, with respect to E and, apart, to F.

use piola_continuum::{SecondPiola, Symmetric};
use piola_numerics::linear::matrix3::{determinant, dot};
use piola_numerics::{Gradient, Real};
use piola_tensor::internal::rows::{Rows, transposed_product};
use piola_tensor::{FourthOrder, MinorSymmetric};

/// The two bodies: a compressible neo-Hookean one, and one with a stiff family of fibres in addition.
pub(super) const FIBRES: [f64; 2] = [0.0, 3.0];

/// W(C) = ½ μ (tr C − 3 − ln det C) + ⅛ λ ln² det C + ¼ k (a · C a − 1)² + ¼ k (tr C − 3)(a · C a − 1).
pub(super) fn energy<T: Real>(c: Rows<T>, fibres: f64) -> T {
    let (mu, lambda, k) = (T::lit(1.5), T::lit(2.5), T::lit(fibres));
    let a = [T::lit(0.48), T::lit(-0.6), T::lit(0.64)];
    let (trace, ln) = (c[0][0] + c[1][1] + c[2][2] - T::lit(3.0), determinant(c).ln());
    let fibre = dot(a, [dot(c[0], a), dot(c[1], a), dot(c[2], a)]) - T::one();
    T::lit(0.5) * mu * (trace - ln)
        + T::lit(0.125) * lambda * ln * ln
        + T::lit(0.25) * k * (fibre * fibre + trace * fibre)
}

/// C of the six components of E.
fn cauchy_green<T: Real>(e: [T; 6]) -> Rows<T> {
    let two = T::lit(2.0);
    (Symmetric { components: e } * two + Symmetric::identity()).rows()
}

/// How often a component stands in the tensor.
fn count<T: Real>(slot: usize) -> T {
    T::lit(if slot < 3 { 1.0 } else { 2.0 })
}

/// S = ∂W/∂E.
pub(super) fn second_piola<T: Real>(e: &Symmetric<T>, fibres: f64) -> SecondPiola<T> {
    let variables: [Gradient<T, 6>; 6] = core::array::from_fn(|i| Gradient::variable(e.components[i], i));
    let partials = energy(cauchy_green(variables), fibres).partials;
    SecondPiola(Symmetric { components: core::array::from_fn(|i| partials[i] / count(i)) })
}

/// ∂S/∂E = ∂²W/∂E².
pub(super) fn material(e: &Symmetric, fibres: f64) -> MinorSymmetric {
    let inner: [Gradient<f64, 6>; 6] = core::array::from_fn(|i| Gradient::variable(e.components[i], i));
    let outer: [Gradient<Gradient<f64, 6>, 6>; 6] = core::array::from_fn(|i| Gradient::variable(inner[i], i));
    let second = energy(cauchy_green(outer), fibres).partials;
    MinorSymmetric {
        components: core::array::from_fn(|i| {
            core::array::from_fn(|j| second[i].partials[j] / (count::<f64>(i) * count::<f64>(j)))
        }),
    }
}

/// (P, ∂P/∂F) = (∂W/∂F, ∂²W/∂F²).
pub(super) fn first_piola(f: Rows<f64>, fibres: f64) -> (Rows<f64>, FourthOrder) {
    let variables: Rows<Gradient<Gradient<f64, 9>, 9>> = core::array::from_fn(|i| {
        core::array::from_fn(|a| Gradient::variable(Gradient::variable(f[i][a], 3 * i + a), 3 * i + a))
    });
    let w = energy(transposed_product(variables, variables), fibres);
    let stress = core::array::from_fn(|i| core::array::from_fn(|a| w.partials[3 * i + a].value));
    (stress, FourthOrder { components: w.partials.map(|p| p.partials) })
}

/// E of F.
pub(super) fn green<T: Real>(f: Rows<T>) -> Symmetric<T> {
    (Symmetric::identity().transposed_congruence(f) - Symmetric::identity()) * T::lit(0.5)
}
