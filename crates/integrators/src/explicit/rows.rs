//! Weighted sums of stages that stand in one piece of memory, row after row.

use piola_numerics::Real;

/// Components worked on at once: small systems are one block, whose sums the compiler keeps in registers.
const BLOCK: usize = 4;

/// Blocks of a system of n components: none beyond the size where the plain loop, in vector registers, is faster.
const fn blocks_of(n: usize) -> usize {
    if n < 16 { n / BLOCK } else { 0 }
}

/// Row j of rows of n numbers.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn row<T>(rows: &[T], j: usize, n: usize) -> &[T] {
    &rows[j * n..][..n]
}

/// Row j of rows of n numbers, to be written.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn row_mut<T>(rows: &mut [T], j: usize, n: usize) -> &mut [T] {
    &mut rows[j * n..][..n]
}

/// The terms of a row of the tableau: its coefficients and the stages that they belong to.
///
/// Filled by loops: `core::array::from_fn` would be a call here, not unrolled.
#[cfg_attr(not(debug_assertions), inline(always))]
fn terms<'a, T: Real, const M: usize>(
    weights: &[(usize, f64); M],
    stages: &'a [T],
    n: usize,
) -> ([T; M], [&'a [T]; M]) {
    let (mut factors, mut terms) = ([T::zero(); M], [stages; M]);
    for m in 0..M {
        factors[m] = T::lit(weights[m].1);
        terms[m] = row(stages, weights[m].0, n);
    }
    (factors, terms)
}

/// Writes y + (carry + h Σ aⱼ kⱼ) to `out`, for (j, aⱼ) of a row of the tableau.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn combine<T: Real, const M: usize>(
    weights: &[(usize, f64); M],
    stages: &[T],
    (y, carry): (&[T], &[T]),
    h: f64,
    out: &mut [T],
) {
    let n = out.len();
    let h = T::lit(h);
    let (factors, terms) = terms(weights, stages, n);
    let (y, carry) = (&y[..n], &carry[..n]);
    let blocks = blocks_of(n);
    for (b, out) in out.as_chunks_mut::<BLOCK>().0[..blocks].iter_mut().enumerate() {
        let mut sum = sum_of_terms::<T, M, BLOCK>(&factors, &terms, b * BLOCK);
        let (y, carry) = (&y[b * BLOCK..][..BLOCK], &carry[b * BLOCK..][..BLOCK]);
        for l in 0..BLOCK {
            sum[l] = y[l] + (carry[l] + h * sum[l]);
        }
        // Written at once: the compiler cannot know that `out` and `y` are apart.
        *out = sum;
    }
    for i in blocks * BLOCK..n {
        let [sum] = sum_of_terms(&factors, &terms, i);
        out[i] = y[i] + (carry[i] + h * sum);
    }
}

/// Writes Σ aⱼ kⱼ to `out`.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn weighted_sums<T: Real, const M: usize>(weights: &[(usize, f64); M], stages: &[T], out: &mut [T]) {
    let n = out.len();
    let (factors, terms) = terms(weights, stages, n);
    let blocks = blocks_of(n);
    for (b, out) in out.as_chunks_mut::<BLOCK>().0[..blocks].iter_mut().enumerate() {
        *out = sum_of_terms(&factors, &terms, b * BLOCK);
    }
    for i in blocks * BLOCK..n {
        [out[i]] = sum_of_terms(&factors, &terms, i);
    }
}

/// Σ aⱼ kⱼ of N components from the given one on; even and odd terms apart, which halves the time spent waiting for
/// additions.
#[cfg_attr(not(debug_assertions), inline(always))]
fn sum_of_terms<T: Real, const M: usize, const N: usize>(factors: &[T; M], terms: &[&[T]; M], first: usize) -> [T; N] {
    let (mut even, mut odd) = ([T::zero(); N], [T::zero(); N]);
    for m in 0..M {
        let term = &terms[m][first..first + N];
        let sum = if m % 2 == 0 { &mut even } else { &mut odd };
        for l in 0..N {
            let product = factors[m] * term[l];
            sum[l] = if m < 2 { product } else { sum[l] + product };
        }
    }
    if 1 < M {
        for l in 0..N {
            even[l] += odd[l];
        }
    }
    even
}
