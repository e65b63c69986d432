//! Eigenvalues and eigenvectors of symmetric tensors.

use piola_continuum::Deformation;
use piola_numerics::{Lanes, Real};
use piola_tensor::Symmetric;
use piola_tensor::spectral::decompose;

use crate::engine::parts::flat;
use crate::{BatchScalar, Destination, Point, Quantity, Request};

/// Eigenvalues and eigenvectors of a symmetric tensor: see [`decompose`].
///
/// The vectors go out as nine components, one vector a row.
///
/// # Example
/// ```
/// use piola_batch as batch;
/// use piola_continuum::Symmetric;
/// let (mut values, mut vectors) = ([[0.0_f64; 3]], [[[0.0_f64; 3]; 3]]);
/// let tensors = [Symmetric::diagonal([1.0, 3.0, 2.0])];
/// batch::evaluate(batch::Undeformed(1), batch::eigenpairs(&tensors[..], &mut values[..], &mut vectors[..]))?;
/// assert!((values[0][0] - 3.0).abs() < 2e-15 && (vectors[0][0][1].abs() - 1.0).abs() < 1e-15);
/// # Ok::<(), piola_batch::BatchError>(())
/// ```
#[must_use]
pub fn eigenpairs<S, V, W>(tensor: S, values: V, vectors: W) -> Request<Eigenpairs, S, (V, W), 6, 12> {
    Request::new(Eigenpairs, tensor, (values, vectors))
}

/// The output of [`eigenpairs`].
#[derive(Clone, Copy, Debug)]
pub struct Eigenpairs;

impl Quantity<6, 12> for Eigenpairs {
    type Input = Symmetric;
    type Output = Self;
    const NEEDS_STRETCH: bool = false;
    const INPUT: &'static str = "tensor";

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn of<T: Real, D: Deformation<T>>(&self, _point: &Point<T, D>, components: [T; 6]) -> [T; 12] {
        let decomposition = decompose(&Symmetric { components });
        let ([x, y, z], [a, b, c, d, e, f, g, h, i]) = (decomposition.values, flat(decomposition.vectors));
        [x, y, z, a, b, c, d, e, f, g, h, i]
    }
}

/// Values and vectors apart.
impl<T, V, W> Destination<Eigenpairs, T, 12> for (V, W)
where
    T: BatchScalar,
    V: Destination<Eigenpairs, T, 3>,
    W: Destination<Eigenpairs, T, 9>,
{
    fn count(&self) -> usize {
        // Both are checked: a pair is as long as both parts, and no batch as long as neither.
        let (values, vectors) = (self.0.count(), self.1.count());
        if values == vectors { values } else { usize::MAX }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn split(self, middle: usize) -> (Self, Self) {
        let ((a, b), (c, d)) = (self.0.split(middle), self.1.split(middle));
        ((a, c), (b, d))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn put(&mut self, index: usize, [x, y, z, a, b, c, d, e, f, g, h, i]: [T; 12]) {
        self.0.put(index, [x, y, z]);
        self.1.put(index, [a, b, c, d, e, f, g, h, i]);
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn store<const N: usize>(&mut self, first: usize, count: usize, values: &[Lanes<T, N>; 12]) {
        let [x, y, z, a, b, c, d, e, f, g, h, i] = *values;
        self.0.store(first, count, &[x, y, z]);
        self.1.store(first, count, &[a, b, c, d, e, f, g, h, i]);
    }
}
