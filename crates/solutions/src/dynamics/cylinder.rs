//! Families 1 and 3 in motion as one: when the acceleration has a potential, and the potential.

use piola_fields::Residual;
use piola_numerics::{Jet, Real};

use super::moving::{NamedCondition, sum};

/// r² = 2 a ξ + offset, (θ, z) = block · (η, Z) of particles (ξ, η, Z), with a = 1/det block; all depend on time.
///
/// ```text
/// 2 r ṙ = κ + α r²      α = ȧ/a,  γ = ä/a,  κ = (offset)˙ − α offset
/// θ̇ = β θ               z̈ = ε z
/// ζ = −(¼ γ − ⅛ α²) r² − ½ κ̇ ln r − κ²/(8 r²) + ½ β (β r² − κ) θ² − ½ ε z²
/// ```
pub(super) struct MovingCylinder {
    pub(super) a: Jet<f64, 0>,
    pub(super) offset: Jet<f64, 0>,
    /// b, c, d, e.
    pub(super) block: [Jet<f64, 0>; 4],
}

impl MovingCylinder {
    /// b ċ = c ḃ,  b c̈ = c b̈,  (a b ḃ)˙ = 0,  (a c ċ)˙ = 0,  d ë = e d̈, under the names of a family.
    pub(super) fn conditions(&self, names: [&'static str; 5]) -> [NamedCondition; 5] {
        let (a, [b, c, d, e]) = (self.a, self.block);
        let growth =
            |q: Jet<f64, 0>| [a.rate * q.value * q.rate, a.value * q.rate * q.rate, a.value * q.value * q.second_rate];
        let residuals: [Residual; 5] = [
            sum(&[b.value * c.rate, -(c.value * b.rate)]),
            sum(&[b.value * c.second_rate, -(c.value * b.second_rate)]),
            sum(&growth(b)),
            sum(&growth(c)),
            sum(&[d.value * e.second_rate, -(e.value * d.second_rate)]),
        ];
        core::array::from_fn(|i| (names[i], residuals[i]))
    }

    /// ζ where the conditions hold.
    pub(super) fn potential<T: Real>(&self, [r, theta, z]: [T; 3]) -> T {
        let Self { a, offset, block: [b, c, d, e] } = *self;
        let (alpha, gamma) = (a.rate / a.value, a.second_rate / a.value);
        let kappa = offset.rate - alpha * offset.value;
        let kappa_rate = offset.second_rate - alpha * offset.rate - (gamma - alpha * alpha) * offset.value;
        let beta = a.value * (e.value * b.rate - d.value * c.rate);
        let epsilon = a.value * (b.value * e.second_rate - c.value * d.second_rate);
        let square = r * r;
        let radial = T::lit(0.25 * gamma - 0.125 * alpha * alpha) * square
            + T::lit(0.5 * kappa_rate) * r.ln()
            + T::lit(0.125 * kappa * kappa) / square;
        let turn = T::lit(0.5 * beta) * (T::lit(beta) * square - T::lit(kappa)) * theta * theta;
        turn - radial - T::lit(0.5 * epsilon) * z * z
    }
}
