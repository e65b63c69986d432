//! All first derivatives of Φ, and the rates of a characteristic made of them.

use piola_numerics::{Dual, Gradient, Real};

use super::FirstOrderPde;
use super::determinant::norm;

/// Directions of differentiation in one pass, where there are more than two variables.
const CHUNK: usize = 4;

/// Φ_x, Φ_u, Φ_ξ in the order of the state (x, u, ξ), with the buffers to compute them.
#[derive(Clone, Debug)]
pub(super) struct Partials<T> {
    state: Vec<Gradient<T, CHUNK>>,
    pub(super) gradient: Vec<T>,
}

impl<T: Real> Partials<T> {
    pub(super) fn new(variables: usize) -> Self {
        let n = 2 * variables + 1;
        Self { state: Vec::with_capacity(n), gradient: vec![T::zero(); n] }
    }

    /// Φ at y = (x, u, ξ); its derivatives are left in `gradient`.
    pub(super) fn evaluate<P: FirstOrderPde>(&mut self, equation: &P, y: &[T]) -> T {
        let n = self.gradient.len();
        let m = n / 2;
        if m == 2 {
            let state: [Gradient<T, 5>; 5] = core::array::from_fn(|i| Gradient::variable(y[i], i));
            let value = equation.value(&state[..2], state[2], &state[3..]);
            self.gradient.copy_from_slice(&value.partials);
            return value.value;
        }
        let mut value = T::zero();
        for first in (0..n).step_by(CHUNK) {
            self.state.clear();
            self.state.extend(y[..n].iter().enumerate().map(|(i, &y)| Gradient::variable(y, i.wrapping_sub(first))));
            let part = equation.value(&self.state[..m], self.state[m], &self.state[m + 1..]);
            for (gradient, partial) in self.gradient[first..].iter_mut().zip(part.partials) {
                *gradient = partial;
            }
            value = part.value;
        }
        value
    }

    /// Writes (x′, u′, ξ′) = (Φ_ξ, ξ·Φ_ξ, −ξΦ_u − Φ_x) to `rate` and returns Φ.
    pub(super) fn rate_into<P: FirstOrderPde>(&mut self, equation: &P, y: &[T], rate: &mut [T]) -> T {
        let value = self.evaluate(equation, y);
        let m = self.gradient.len() / 2;
        let (by_x, by_u, by_xi) = (&self.gradient[..m], self.gradient[m], &self.gradient[m + 1..]);
        let xi = &y[m + 1..=2 * m];
        let mut along = T::zero();
        for i in 0..m {
            rate[i] = by_xi[i];
            along += xi[i] * by_xi[i];
            rate[m + 1 + i] = -(xi[i] * by_u + by_x[i]);
        }
        rate[m] = along;
        value
    }

    /// As [`rate_into`](Self::rate_into), but for an equation that is linear in ξ with ξ = 0 in y, where x′ = Φ_ξ and
    /// u′ = −Φ: ξ then stays zero, and is told by the ray map instead.
    pub(super) fn ray_rate_into<P: FirstOrderPde>(&mut self, equation: &P, y: &[T], rate: &mut [T]) -> T {
        if !P::QUASILINEAR {
            return self.rate_into(equation, y, rate);
        }
        let value = self.evaluate(equation, y);
        let m = self.gradient.len() / 2;
        rate[..m].copy_from_slice(&self.gradient[m + 1..]);
        rate[m] = -value;
        rate[m + 1..=2 * m].fill(T::zero());
        value
    }

    /// A magnitude that Φ is compared with: Σ|Φ_x x| + |Φ_u u| + Σ|Φ_ξ ξ| of the last evaluation.
    pub(super) fn magnitude(&self, y: &[T]) -> f64 {
        self.gradient.iter().zip(y).map(|(&g, &y)| (g * y).primal(0).abs()).sum()
    }
}

/// By how much each derivative of Φ changes, at most, when (x, u, ξ) change by their own magnitudes: Σ|∂²Φ/∂yᵢ∂yⱼ||yⱼ|,
/// with |ξ| for every component of ξ. A derivative below rounding of this cannot be told from zero.
pub(super) fn changes<P: FirstOrderPde>(equation: &P, y: &[f64]) -> Vec<f64> {
    let m = y.len() / 2;
    let length = norm(&y[m + 1..]);
    let mut work = Partials::new(m);
    let mut changes = vec![0.0; y.len()];
    for j in 0..y.len() {
        let one = |i: usize| if i == j { 1.0 } else { 0.0 };
        let state: Vec<Dual<f64>> = y.iter().enumerate().map(|(i, &y)| Dual::new(y, one(i))).collect();
        work.evaluate(equation, &state);
        let scale = if m < j { length } else { y[j].abs() };
        for (change, slope) in changes.iter_mut().zip(&work.gradient) {
            *change += slope.tangent.abs() * scale;
        }
    }
    changes
}
