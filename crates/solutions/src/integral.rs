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
    #[inline(always)]
    fn write(self, parts: &mut [f64]) {
        parts[0] = self;
    }
    #[inline(always)]
    fn read(parts: &[f64]) -> Self {
        parts[0]
    }
}

impl Packed for Dual<f64> {
    const COUNT: usize = 2;
    #[inline(always)]
    fn write(self, parts: &mut [f64]) {
        parts[0] = self.value;
        parts[1] = self.tangent;
    }
    #[inline(always)]
    fn read(parts: &[f64]) -> Self {
        Self::new(parts[0], parts[1])
    }
}

impl<const N: usize> Packed for Gradient<f64, N> {
    const COUNT: usize = 1 + N;
    #[inline(always)]
    fn write(self, parts: &mut [f64]) {
        parts[0] = self.value;
        parts[1..=N].copy_from_slice(&self.partials);
    }
    #[inline(always)]
    fn read(parts: &[f64]) -> Self {
        Self { value: parts[0], partials: core::array::from_fn(|i| parts[1 + i]) }
    }
}

/// Accurate to rounding, as the sizes of the integrands have it.
struct ToRounding;

impl<const K: usize> Accuracy<K> for ToRounding {
    fn allowed(&self, _values: &[f64; K], sizes: &[f64; K]) -> [f64; K] {
        sizes.map(|size| ACCURACY * size)
    }
    fn is_worth_halving(&self, panel: &Panel<K>) -> bool {
        // The rule adds 8 ε ∫ |f| for rounding: below twice that there is nothing to gain.
        (0..K).any(|k| 16.0 * f64::EPSILON * panel.sizes[k] < panel.errors[k])
    }
}

/// ∫ f ds of M functions from `from` to `to`, with derivatives with respect to whatever the scalar carries, also in the
/// ends. `K` is at least M · COUNT.
///
/// The range is the image of (0, 1), so that the derivative is taken under the integral sign.
pub(crate) fn integrate<T: Packed, const M: usize, const K: usize>(
    quantity: &'static str,
    (from, to): (T, T),
    f: impl Fn(T) -> Result<[T; M], SolutionsError>,
) -> Result<[T; M], SolutionsError> {
    const { assert!(M * T::COUNT <= K) };
    let length = to - from;
    let integrand = |_part: usize, u: f64| {
        let mut packed = [0.0; K];
        let values = f(from + length * T::lit(u))?;
        for (value, parts) in values.into_iter().zip(packed.chunks_exact_mut(T::COUNT)) {
            (value * length).write(parts);
        }
        Ok::<_, SolutionsError>(packed)
    };
    let mut panels = [Panel::<K>::EMPTY; PANELS];
    let method = (&GaussKronrod::POINTS_21, &Quadpack);
    let found = quadrature::integrate(&mut panels, [(0.0, 1.0)], method, &ToRounding, integrand)?;
    if let Ending::NotFinite { component, value, .. } = found.ending {
        return Err(SolutionsError::NotFinite { quantity, index: component / T::COUNT, value });
    }
    // Where components cancel, their own size is no measure of what rounding leaves.
    let largest = found.sizes.into_iter().fold(0.0, f64::max);
    for k in 0..K {
        let (error, size) = (found.errors[k], found.sizes[k]);
        if !(error <= REFUSED * size || error <= ACCURACY * largest) {
            return Err(SolutionsError::IntegralNotConverged { quantity, error, size });
        }
    }
    Ok(core::array::from_fn(|m| T::read(&found.values[m * T::COUNT..(m + 1) * T::COUNT])))
}
