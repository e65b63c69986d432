//! Sums and sizes of vectors over any scalar.

use crate::Real;

/// n zeros.
pub fn zeros<T: Real>(values: &mut Vec<T>, n: usize) {
    values.clear();
    values.resize(n, T::zero());
}

/// Σ aᵢ bᵢ.
pub fn dot<T: Real>(a: &[T], b: &[T]) -> T {
    a.iter().zip(b).fold(T::zero(), |sum, (&a, &b)| sum + a * b)
}

/// The largest |x| over lanes; NaN stays.
pub fn size<T: Real>(x: T) -> f64 {
    (0..T::LANES).map(|lane| x.primal(lane).abs()).fold(0.0, |m, x| if x <= m { m } else { x })
}
