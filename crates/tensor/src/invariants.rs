//! The principal invariants.

use piola_numerics::Real;

use crate::Symmetric;

/// The principal invariants (I₁, I₂, I₃) = (tr T, sum of the principal minors, det T) of a symmetric tensor: of a stress Pa, Pa², Pa³.
///
/// # Example
/// ```
/// use piola_tensor::{Symmetric, principal_invariants};
/// assert_eq!(principal_invariants(&Symmetric::diagonal([1.0, 2.0, 3.0])), [6.0, 11.0, 6.0]);
/// ```
#[cfg_attr(not(debug_assertions), inline(always))]
#[must_use]
pub fn principal_invariants<T: Real>(a: &Symmetric<T>) -> [T; 3] {
    let [xx, yy, zz, xy, yz, xz] = a.components;
    let second = (xx * yy - xy * xy) + (yy * zz - yz * yz) + (xx * zz - xz * xz);
    [a.trace(), second, a.determinant()]
}
