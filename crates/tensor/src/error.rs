//! What can be wrong with the data of a tensor: each variant names the violated condition and holds the numbers.

use piola_numerics::{Mask, Real};

/// A violated condition on a tensor.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TensorError {
    /// A number is infinite or NaN.
    #[error("{quantity}[{index}] = {value} is not finite")]
    NotFinite {
        /// What the number is.
        quantity: &'static str,
        /// Its position, in row-major order for a matrix.
        index: usize,
        /// The number itself.
        value: f64,
    },
    /// `T_ij` = `T_ji` is violated.
    #[error(
        "{quantity} is not symmetric: entries ({row},{column}) and ({column},{row}) differ by {difference:e}, more \
         than the rounding of its largest entry {scale:e}"
    )]
    NotSymmetric {
        /// What should be symmetric.
        quantity: &'static str,
        /// Row of the entry above the diagonal, from 0.
        row: usize,
        /// Column of that entry, from 0.
        column: usize,
        /// `T_ij − T_ji`.
        difference: f64,
        /// The largest entry.
        scale: f64,
    },
    /// `W_ij` = −`W_ji` is violated.
    #[error(
        "the tensor is not skew: entries ({row},{column}) and ({column},{row}) add up to {sum:e}, more than the \
         rounding of the largest entry {scale:e}"
    )]
    NotSkew {
        /// Row of the entry on or above the diagonal, from 0.
        row: usize,
        /// Column of that entry, from 0.
        column: usize,
        /// `W_ij + W_ji`.
        sum: f64,
        /// The largest entry.
        scale: f64,
    },
    /// `C_ijkl` = `C_jikl` or `C_ijkl` = `C_ijlk` is violated.
    #[error(
        "the fourth-order tensor lacks a minor symmetry: entry {entry:?} differs by {difference:e} from the one with \
         two indices exchanged, more than the rounding of the largest entry {scale:e}"
    )]
    NotMinorSymmetric {
        /// Indices i, j, k, l of the entry, from 0.
        entry: [usize; 4],
        /// The difference.
        difference: f64,
        /// The largest entry.
        scale: f64,
    },
    /// `C_ijkl` = `C_klij` is violated.
    #[error(
        "the fourth-order tensor lacks the major symmetry: entry {entry:?} differs by {difference:e} from the one with \
         the pairs exchanged, more than the rounding of the largest entry {scale:e}"
    )]
    NotMajorSymmetric {
        /// Indices i, j, k, l of the entry, from 0.
        entry: [usize; 4],
        /// `C_ijkl − C_klij`.
        difference: f64,
        /// The largest entry.
        scale: f64,
    },
    /// det A ≠ 0 is violated for a tensor that should be inverted.
    #[error("the tensor is singular: divided by {scale:e}, it has a determinant or pivot of {relative_determinant:e}")]
    SingularTensor {
        /// The determinant, or the pivot, of A/scale.
        relative_determinant: f64,
        /// The size of the components of A, a power of two.
        scale: f64,
    },
    /// `QᵀQ` = 1 or 0 < det Q is violated for what should be a rotation.
    #[error("the matrix is not a rotation: the largest entry of QᵀQ − 1 is {defect:e}, det Q = {determinant}")]
    NotARotation {
        /// The largest entry of `QᵀQ` − 1 in modulus.
        defect: f64,
        /// det Q.
        determinant: f64,
    },
    /// A tensor that belongs to a deformation has a negative leading minor.
    #[error(
        "{quantity} is not positive definite: divided by its largest entry {scale:e}, it has a leading minor of order \
         {order} of {minor:e}"
    )]
    NotPositiveDefinite {
        /// The tensor, for a strain the squared length that it stands for.
        quantity: &'static str,
        /// 1, 2 or 3: how many rows the minor has.
        order: usize,
        /// The minor of the tensor divided by `scale`.
        minor: f64,
        /// The largest entry.
        scale: f64,
    },
    /// A number is not between its bounds.
    #[error("{quantity} = {value} is not between {least} and {largest}")]
    OutOfRange {
        /// What the number is.
        quantity: &'static str,
        /// The number itself.
        value: f64,
        /// The lower bound.
        least: f64,
        /// The upper bound.
        largest: f64,
    },
}

/// The first number that is infinite or NaN in any lane, by name and position.
///
/// # Errors
/// `NotFinite`.
#[inline]
pub fn check_finite<T: Real>(quantity: &'static str, values: &[T]) -> Result<(), TensorError> {
    for (index, value) in values.iter().enumerate() {
        if !value.is_finite().all() {
            let lane = (0..T::LANES).find(|&lane| !value.primal(lane).is_finite()).unwrap_or(0);
            return Err(TensorError::NotFinite { quantity, index, value: value.primal(lane) });
        }
    }
    Ok(())
}

/// 0 ≤ value ≤ largest, to an ulp of that, in every lane.
///
/// # Errors
/// `OutOfRange`.
pub fn check_range<T: Real>(quantity: &'static str, value: T, largest: f64) -> Result<(), TensorError> {
    let slack = largest.min(1.0) * piola_numerics::sums::unit_in_last_place::<T>();
    let within = |x: f64| 0.0 <= x && x <= largest + slack;
    match (0..T::LANES).map(|lane| value.primal(lane)).find(|&x| !within(x)) {
        None => Ok(()),
        Some(value) => Err(TensorError::OutOfRange { quantity, value, least: 0.0, largest }),
    }
}
