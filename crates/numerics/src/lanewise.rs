//! Computations of which each lane is one turn of a loop.

use crate::Real;

/// A computation of O numbers from I numbers, over any scalar, for [`Real::lanewise`].
///
/// In [`Lanes`](crate::Lanes) operations are vectors one by one: what the compiler makes of hundreds of them is good or
/// not as it happens to find the vectors again. One loop over the lanes around all of them it turns into vectors as a
/// whole, if the computation is straight: no loop of a length that is known at run time only, no call that is not
/// inlined, and of two sides of a branch both may be computed.
pub trait Lanewise<const I: usize, const O: usize> {
    /// Computes; to be marked `#[cfg_attr(not(debug_assertions), inline(always))]`, as everything that it calls.
    #[must_use]
    fn run<T: Real>(&self, inputs: [T; I]) -> [T; O];
}
