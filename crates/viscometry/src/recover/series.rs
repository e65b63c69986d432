//! Σ φ(q²ⁿ M) without its slowness: what is left of the series after some terms, from ΔΩ itself.
//!
//! With u = ln M, δ = 2 ln(R₂/R₁) and W = ΔΩ the terms are φ(u − nδ) = 2 W′(u − nδ), and 2 W = ∫ φ du from −∞. If W is a sum (or
//! an integral) of powers e^(su) with the weights w(s), the sum of all terms is known:
//!
//! ```text
//! Σ φ(u − nδ) = 2 Σ w(s) F(s)      F(s) = s/(1 − e^(−sδ))
//!             = 2 W [ F(κ₁) + κ₂ F″/2 + κ₃ F‴/6 + (κ₄ + 3 κ₂²) F⁗/24 + … ]      κₙ = dⁿ ln W/duⁿ
//! ```
//! where the derivatives of F are at κ₁, and κ₁, κ₂, κ₃, κ₄ are the cumulants of the exponents s under w. One power is summed exactly
//! by the first term; a narrow gap makes F smooth over the spread of the exponents, and few terms of the series taken directly
//! make the spread itself small, because at small stresses one power remains. F(s) = 1/δ + s/2 + s²δ/12 − … makes of it the
//! formula of Euler and Maclaurin, whose first term is the narrow gap W(23.85).

use piola_numerics::{Dual, Real};

use super::splines::Derivatives;

type Second = Dual<Dual<f64>>;
pub(super) type Fourth = Dual<Dual<Second>>;

/// The variable with its first four derivatives.
pub(super) fn fourth(x: f64) -> Fourth {
    Dual::variable(Dual::variable(Dual::variable(Dual::variable(x))))
}

/// The value and four derivatives of a function of the variable.
pub(super) const fn derivatives(f: &Fourth) -> Derivatives {
    [
        f.value.value.value.value,
        f.tangent.value.value.value,
        f.tangent.tangent.value.value,
        f.tangent.tangent.tangent.value,
        f.tangent.tangent.tangent.tangent,
    ]
}

/// B₂ₖ/(2k)! of the expansion x/(1 − e⁻ˣ) = 1 + x/2 + Σ B₂ₖ x²ᵏ/(2k)!.
const BERNOULLI: [f64; 7] = [
    1.0 / 12.0,
    -1.0 / 720.0,
    1.0 / 30_240.0,
    -1.0 / 1_209_600.0,
    1.0 / 47_900_160.0,
    -691.0 / 1_307_674_368_000.0,
    1.0 / 74_724_249_600.0,
];

/// x/(1 − e⁻ˣ), 1 at 0.
fn bernoulli<T: Real>(x: T) -> T {
    // Up to here seven terms leave 10⁻¹⁶; beyond, fourth derivatives of the quotient lose four digits at most.
    if x.primal(0).abs() < 0.5 {
        let square = x * x;
        let even = BERNOULLI.iter().rev().fold(T::zero(), |sum, c| (sum + T::lit(*c)) * square);
        return T::one() + T::lit(0.5) * x + even;
    }
    x / -(-x).exp_m1()
}

/// The order of the expansion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Order {
    /// One power.
    Power,
    /// Their variance too.
    Variance,
    /// All that four derivatives give.
    Full,
}

/// The rest of the series.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rest {
    /// Its sum over 2 W.
    pub(super) factor: f64,
    /// Its last terms over 2 W, without sign.
    pub(super) error: f64,
    /// Its derivatives with respect to κ₁ and κ₂ up to the order of the variance.
    pub(super) slopes: [f64; 2],
}

/// Of κ₁ … κ₄ (`cumulants[0]` is not used) and δ.
pub(super) fn rest(cumulants: Derivatives, step: f64, order: Order) -> Rest {
    let [_, k1, k2, k3, k4] = cumulants;
    let [f0, f1, f2, f3, f4] = derivatives(&bernoulli(fourth(k1 * step)));
    let (f0, f2, f3, f4) = (f0 / step, f2 * step, f3 * step * step, f4 * step * step * step);
    let variance = 0.5 * k2 * f2;
    let (third, fourth) = (k3 * f3 / 6.0, (k4.abs() + 3.0 * k2 * k2) * f4.abs() / 24.0);
    match order {
        Order::Power => Rest { factor: f0, error: variance.abs(), slopes: [f1, 0.0] },
        Order::Variance => {
            Rest { factor: f0 + variance, error: third.abs() + fourth, slopes: [f1 + 0.5 * k2 * f3, 0.5 * f2] }
        }
        Order::Full => Rest {
            factor: f0 + variance + third + (k4 + 3.0 * k2 * k2) * f4 / 24.0,
            error: 0.1 * third.abs() + fourth,
            slopes: [f1 + 0.5 * k2 * f3, 0.5 * f2],
        },
    }
}

#[cfg(test)]
mod tests {
    use super::{BERNOULLI, Order, bernoulli, derivatives, fourth, rest};

    #[test]
    fn both_forms_of_the_factor_agree_where_they_meet() {
        let near = derivatives(&bernoulli(fourth(0.5 * (1.0 - 1e-15))));
        let far = derivatives(&bernoulli(fourth(0.5)));
        for (k, (a, b)) in near.into_iter().zip(far).enumerate() {
            assert!((a - b).abs() < [4e-16, 1e-14, 1e-13, 1e-12, 2e-11][k], "{k}: {a} {b}");
        }
        assert!(BERNOULLI[6] * 0.5_f64.powi(14) < 1e-15);
    }

    #[test]
    fn the_rest_of_one_power_is_a_geometric_series() {
        // W = e^(2u): φ = 4 e^(2u), all terms 4/(1 − e^(−2δ)) = 2 W F.
        for step in [1e-3, 0.1, 1.0, 5.0] {
            let sum = 4.0 / -(-2.0_f64 * step).exp_m1();
            let rest = rest([0.0, 2.0, 0.0, 0.0, 0.0], step, Order::Full);
            assert!((2.0 * rest.factor / sum - 1.0).abs() < 1e-15);
        }
    }
}
