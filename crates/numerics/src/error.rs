//! What can be wrong with the input of this crate.

/// A condition that the input of a numerical routine violates, with the offending number.
///
/// Values of lanes and of differentiable numbers are reported as plain numbers: the value, without
/// derivatives, of the first lane that violates the condition.
///
/// # Example
/// ```
/// use piola_numerics::{NumericsError, linear::ldlt};
/// let mut matrix = [1.0, 2.0, 2.0, 4.0]; // the second row is twice the first
/// let error = ldlt::factor_in_place(&mut matrix, 2).unwrap_err();
/// assert_eq!(error, NumericsError::NotPositiveDefinite { pivot: 1, value: 0.0, diagonal: 4.0 });
/// ```
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NumericsError {
    /// A vector or matrix has the wrong number of entries.
    #[error("`{quantity}` has length {found}; length {expected} is needed")]
    WrongLength {
        /// The name of the argument.
        quantity: &'static str,
        /// The number of entries it must have.
        expected: usize,
        /// The number of entries it has.
        found: usize,
    },
    /// An entry is infinite or NaN.
    #[error("entry {index} of `{quantity}` is {value}, which is not a finite number")]
    NotFinite {
        /// The name of the argument or of the result.
        quantity: &'static str,
        /// The index of the first such entry, counted from 0 (in matrices down the columns).
        index: usize,
        /// The entry.
        value: f64,
    },
    /// 0 < d violated for a pivot d of L D Lᵀ: the matrix is indefinite, or singular to rounding.
    #[error(
        "the matrix is not positive definite: pivot {pivot} is {value:e} where the diagonal entry is {diagonal:e}, so \
         columns 0 to {pivot} are dependent or indefinite"
    )]
    NotPositiveDefinite {
        /// The index of the pivot, counted from 0.
        pivot: usize,
        /// The pivot.
        value: f64,
        /// The diagonal entry it was computed from, of which it must be more than a rounding error.
        diagonal: f64,
    },
    /// 0 < |u| violated for a pivot u of an elimination, or 0 < |det A| for a 3×3 matrix: singular to
    /// rounding.
    #[error("the matrix is singular: pivot {pivot} is {value:e} where the entries it comes from are of size {scale:e}")]
    Singular {
        /// The index of the pivot, counted from 0; 3 when it is the determinant of a 3×3 matrix.
        pivot: usize,
        /// The pivot or determinant.
        value: f64,
        /// The size of the numbers it was computed from.
        scale: f64,
    },
}

/// Refuses entries that are infinite or NaN in any lane.
pub(crate) fn check_finite<T: crate::Real>(quantity: &'static str, values: &[T]) -> Result<(), NumericsError> {
    for (index, &entry) in values.iter().enumerate() {
        if !crate::Mask::all(entry.is_finite()) {
            return Err(NumericsError::NotFinite { quantity, index, value: first_lane(entry, |x| !x.is_finite()) });
        }
    }
    Ok(())
}

/// Refuses a slice of the wrong length.
pub(crate) fn check_dimension(quantity: &'static str, found: usize, expected: usize) -> Result<(), NumericsError> {
    if found == expected { Ok(()) } else { Err(NumericsError::WrongLength { quantity, expected, found }) }
}

/// The value of the first lane with a property; of lane 0 when none has it.
pub(crate) fn first_lane<T: crate::Real>(value: T, property: impl Fn(f64) -> bool) -> f64 {
    (0..T::LANES).map(|lane| value.primal(lane)).find(|&x| property(x)).unwrap_or_else(|| value.primal(0))
}
