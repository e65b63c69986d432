//! The order in which the six components of a symmetric tensor are stored: Piola's own, 11, 22, 33, 12, 23, 13.
//!
//! Other orders, and vectors with doubled shears, are in [`voigt`](super::voigt).

/// The place of component (i, j) among the six.
///
/// # Example
/// ```
/// use piola_tensor::{PAIR, SLOT};
/// assert_eq!((SLOT[1][2], SLOT[2][1], PAIR[4]), (4, 4, (1, 2)));
/// ```
pub const SLOT: [[usize; 3]; 3] = [[0, 3, 5], [3, 1, 4], [5, 4, 2]];

/// The indices (i, j), i ≤ j, of each of the six components.
pub const PAIR: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)];

/// A 6×6 array over pairs of indices: entry (ij, kl) of a fourth-order tensor, without factors for shears.
pub type Slots<T> = [[T; 6]; 6];
