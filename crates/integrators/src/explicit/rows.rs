//! Weighted sums of stages that stand in one piece of memory, row after row.

use piola_numerics::Real;

/// Components worked on at once: the compiler keeps their sums in registers.
const BLOCK: usize = 4;

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

/// Writes y + (carry + h Σ aⱼ kⱼ) to `out`, for the pairs (j, aⱼ) of a row of the tableau.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn combine<T: Real>(
    weights: &[(usize, f64)],
    stages: &[T],
    (y, carry): (&[T], &[T]),
    h: f64,
    out: &mut [T],
) {
    let n = out.len();
    let h = T::lit(h);
    let (y, carry) = (&y[..n], &carry[..n]);
    let whole = n - n % BLOCK;
    for (b, out) in out.as_chunks_mut::<BLOCK>().0.iter_mut().enumerate() {
        let mut sum = sum_of_row::<T, BLOCK>(weights, stages, n, b * BLOCK);
        let (y, carry) = (&y[b * BLOCK..][..BLOCK], &carry[b * BLOCK..][..BLOCK]);
        for l in 0..BLOCK {
            sum[l] = y[l] + (carry[l] + h * sum[l]);
        }
        // Written at once: the compiler cannot know that `out` and `y` are apart.
        *out = sum;
    }
    for i in whole..n {
        let [sum] = sum_of_row(weights, stages, n, i);
        out[i] = y[i] + (carry[i] + h * sum);
    }
}

/// Writes Σ aⱼ kⱼ to `out`.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn weighted_sums<T: Real>(weights: &[(usize, f64)], stages: &[T], out: &mut [T]) {
    let n = out.len();
    let whole = n - n % BLOCK;
    for (b, out) in out.as_chunks_mut::<BLOCK>().0.iter_mut().enumerate() {
        *out = sum_of_row(weights, stages, n, b * BLOCK);
    }
    for (i, out) in out.iter_mut().enumerate().skip(whole) {
        [*out] = sum_of_row(weights, stages, n, i);
    }
}

/// Σ aⱼ kⱼ of N components from the given one on; even and odd terms apart, which halves the time spent waiting for
/// additions.
#[cfg_attr(not(debug_assertions), inline(always))]
fn sum_of_row<T: Real, const N: usize>(weights: &[(usize, f64)], stages: &[T], n: usize, first: usize) -> [T; N] {
    let (mut even, mut odd) = ([T::zero(); N], [T::zero(); N]);
    let add = |sum: &mut [T; N], &(j, a): &(usize, f64)| {
        let (factor, term) = (T::lit(a), &stages[j * n + first..][..N]);
        for l in 0..N {
            sum[l] += factor * term[l];
        }
    };
    let (pairs, rest) = weights.as_chunks::<2>();
    for [one, other] in pairs {
        add(&mut even, one);
        add(&mut odd, other);
    }
    if let [last] = rest {
        add(&mut even, last);
    }
    for l in 0..N {
        even[l] += odd[l];
    }
    even
}
