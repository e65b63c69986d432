//! Integrals of mechanics over any differentiable scalar, by the adaptive quadrature of `piola-numerics`.

use piola_numerics::quadrature::{self, Accuracy, Ending, GaussKronrod, Panel, Quadpack};
use piola_numerics::{Dual, Gradient, Real};

use crate::SolutionsError;

/// Relative to ∫ |f|: what the sums leave when the integrand is exact to a few ulp.
const ACCURACY: f64 = 1e-13;
/// Relative to ∫ |f|: beyond it an integral is refused.
const REFUSED: f64 = 1e-9;
/// Panels: each halving of one adds one.
const PANELS: usize = 48;

/// A scalar as a list of floats, so that an integral takes its derivatives with it.
pub(crate) trait Packed: Real {
    /// How many floats there are.
    const COUNT: usize;
    /// Writes them.
    fn write(self, parts: &mut [f64]);
    /// Reads them.
    fn read(parts: &[f64]) -> Self;
}

impl Packed for f64 {
    const COUNT: usize = 1;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn write(self, parts: &mut [f64]) {
        parts[0] = self;
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn read(parts: &[f64]) -> Self {
        parts[0]
    }
}

impl Packed for Dual<f64> {
    const COUNT: usize = 2;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn write(self, parts: &mut [f64]) {
        parts[0] = self.value;
        parts[1] = self.tangent;
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn read(parts: &[f64]) -> Self {
        Self::new(parts[0], parts[1])
    }
}

impl<const N: usize> Packed for Gradient<f64, N> {
    const COUNT: usize = 1 + N;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn write(self, parts: &mut [f64]) {
        parts[0] = self.value;
        parts[1..=N].copy_from_slice(&self.partials);
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn read(parts: &[f64]) -> Self {
        Self { value: parts[0], partials: core::array::from_fn(|i| parts[1 + i]) }
    }
}

/// Accurate to rounding: of the integrands, and of the terms that cancel in them, whose moduli are integrated last.
struct ToRounding;

impl<const K: usize> Accuracy<K> for ToRounding {
    fn allowed(&self, _values: &[f64; K], sizes: &[f64; K]) -> [f64; K] {
        let mut allowed = sizes.map(|size| (ACCURACY * size).max(32.0 * f64::EPSILON * sizes[K - 1]));
        // The moduli have kinks, and are a scale only.
        allowed[K - 1] = f64::INFINITY;
        allowed
    }
    fn is_worth_halving(&self, panel: &Panel<K>) -> bool {
        // The rule adds 8 ε ∫ |f| for rounding: below twice that there is nothing to gain.
        let floor = 16.0 * f64::EPSILON;
        (0..K - 1).any(|k| floor * panel.sizes[k].max(panel.sizes[K - 1]) < panel.errors[k])
    }
}

/// ∫ f ds of M functions from `from` to `to`, with derivatives with respect to whatever the scalar carries, also in the
/// ends. `K` is above M · COUNT.
///
/// The function returns its values and the sum of the moduli of the terms that cancel in them. The range is the image of
/// (0, 1), so that the derivative is taken under the integral sign.
pub(crate) fn integrate<T: Packed, const M: usize, const K: usize>(
    quantity: &'static str,
    (from, to): (T, T),
    f: impl Fn(T) -> Result<([T; M], f64), SolutionsError>,
) -> Result<[T; M], SolutionsError> {
    integrate_over::<T, M, K>(quantity, (from, to - from), f)
}

/// The same over a range of which the length is known without cancellation.
pub(crate) fn integrate_over<T: Packed, const M: usize, const K: usize>(
    quantity: &'static str,
    (from, length): (T, T),
    f: impl Fn(T) -> Result<([T; M], f64), SolutionsError>,
) -> Result<[T; M], SolutionsError> {
    const { assert!(M * T::COUNT < K) };
    let integrand = |_part: usize, u: f64| {
        let mut packed = [0.0; K];
        let (values, terms) = f(from + length * T::lit(u))?;
        for (value, parts) in values.into_iter().zip(packed.chunks_exact_mut(T::COUNT)) {
            (value * length).write(parts);
        }
        packed[K - 1] = terms * length.primal(0);
        Ok::<_, SolutionsError>(packed)
    };
    let mut panels = [Panel::<K>::EMPTY; PANELS];
    let method = (&GaussKronrod::POINTS_21, &Quadpack);
    let found = quadrature::integrate(&mut panels, [(0.0, 1.0)], method, &ToRounding, integrand)?;
    if let Ending::NotFinite { component, value, .. } = found.ending {
        return Err(SolutionsError::NotFinite { quantity, index: component / T::COUNT, value });
    }
    for k in 0..K - 1 {
        let (error, size) = (found.errors[k], found.sizes[k]);
        if !(error <= REFUSED * size || error <= 10.0 * ACCURACY * found.sizes[K - 1]) {
            return Err(SolutionsError::IntegralNotConverged { quantity, error, size });
        }
    }
    Ok(core::array::from_fn(|m| T::read(&found.values[m * T::COUNT..(m + 1) * T::COUNT])))
}
