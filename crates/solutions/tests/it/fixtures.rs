//! Random laws, and a quadrature of the tests' own.

use piola_numerics::Real;
use piola_numerics::quadrature::GaussKronrod;
use piola_solids::isochoric::{Rivlin, RivlinTerm};
use piola_solutions::{LocalDeformation, ResponseFunctions};
use piola_tensor::internal::rows::{Rows, cofactor, product};
use proptest::prelude::*;

/// g₁ = a + b x + c y, g₋₁ = −(d + e x): elastic; with c ≠ e no energy has these functions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Elastic(pub(crate) [f64; 5]);

impl ResponseFunctions for Elastic {
    fn response<T: Real>(&self, first: T, second: T) -> [T; 2] {
        let [a, b, c, d, e] = self.0.map(T::lit);
        [a + b * first + c * second, -(d + e * first)]
    }
}

pub(crate) fn elastic() -> impl Strategy<Value = Elastic> {
    (0.2..2.0, 0.0..0.3, 0.0..0.3, 0.0..1.0, 0.0..0.1).prop_map(|(a, b, c, d, e)| Elastic([a, b, c, d, e]))
}

/// C₁₀ x + C₀₁ y + C₂₀ x² + C₁₁ x y.
pub(crate) fn rubber() -> impl Strategy<Value = Rivlin> {
    (0.1..1.0, 0.0..0.5, 0.0..0.05, 0.0..0.05).prop_map(|(c10, c01, c20, c11)| {
        let term = |first, second, coefficient| RivlinTerm { first, second, coefficient };
        Rivlin::new(vec![term(1, 0, c10), term(0, 1, c01), term(2, 0, c20), term(1, 1, c11)]).expect("terms")
    })
}

/// ∫ f ds by Kronrod's rule on many panels.
pub(crate) fn integral<T: Real>(from: f64, to: f64, f: impl Fn(f64) -> T) -> T {
    integral_by(48, (from, to), f)
}

/// ∫ f ds by Kronrod's rule on so many panels.
pub(crate) fn integral_by<T: Real>(panels: usize, (from, to): (f64, f64), f: impl Fn(f64) -> T) -> T {
    let GaussKronrod { nodes, kronrod, .. } = GaussKronrod::POINTS_21;
    let half = 0.5 * (to - from) / panels as f64;
    let mut sum = T::zero();
    for panel in 0..panels {
        let middle = from + half * (2 * panel + 1) as f64;
        sum += T::lit(kronrod[nodes.len()] * half) * f(middle);
        for (node, weight) in nodes.iter().zip(kronrod) {
            sum += T::lit(weight * half) * (f(middle - half * node) + f(middle + half * node));
        }
    }
    sum
}

/// P = T Cof F of an isochoric F, in mixed physical components.
pub(crate) fn first_piola(stress: Rows<f64>, local: &LocalDeformation) -> Rows<f64> {
    product(stress, cofactor(local.gradient))
}
