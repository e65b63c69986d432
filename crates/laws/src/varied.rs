//! A deformation whose entries carry derivatives.

use piola_continuum::Deformation;
use piola_numerics::Real;
use piola_numerics::linear::matrix3::determinant;
use piola_tensor::internal::rows::{Rows, identity, sum};

/// A deformation by its ∇u, whose entries carry derivatives.
#[derive(Clone, Copy)]
pub(crate) struct Varied<T>(Rows<T>);

/// Each entry of ∇u over another scalar.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn lifted<T: Real, S: Real>(h: Rows<T>, lift: impl Fn(usize, usize, T) -> S) -> Varied<S> {
    let row = |i: usize| [lift(i, 0, h[i][0]), lift(i, 1, h[i][1]), lift(i, 2, h[i][2])];
    Varied([row(0), row(1), row(2)])
}

impl<T: Real> Deformation<T> for Varied<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn gradient_rows(&self) -> Rows<T> {
        sum(self.0, identity())
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn displacement_rows(&self) -> Rows<T> {
        self.0
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn lifted<S: Real>(&self, lift: impl Fn(usize, usize, T) -> S) -> impl Deformation<S> {
        lifted(self.0, lift)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn jacobian(&self) -> T {
        self.volume_change() + T::one()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn volume_change(&self) -> T {
        let h = self.0;
        let minor = |i: usize, j: usize| h[i][i] * h[j][j] - h[i][j] * h[j][i];
        let trace = h[0][0] + h[1][1] + h[2][2];
        trace + ((minor(0, 1) + minor(1, 2) + minor(0, 2)) + determinant(h))
    }
}
