//! What can be wrong with the data of a continuum: each variant names the violated condition and holds the numbers.

use piola_numerics::{Mask, Real};

/// A violated condition of continuum mechanics.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ContinuumError {
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
    /// 0 < det F is violated: the body is turned inside out or flattened.
    #[error("det F = {determinant:e} is not positive: the body is turned inside out or flattened")]
    NonPositiveJacobian {
        /// det F.
        determinant: f64,
    },
    /// `T_ij` = `T_ji` is violated.
    #[error(
        "{quantity} is not symmetric: entries ({row},{column}) and ({column},{row}) differ by {difference:e}, \
         more than rounding of its largest entry {scale:e}"
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
    /// QᵀQ = 1 or 0 < det Q is violated for what should be a rotation.
    #[error("not a rotation: QᵀQ − 1 has an entry {defect:e}, det Q = {determinant}")]
    NotARotation {
        /// The largest entry of QᵀQ − 1 in modulus.
        defect: f64,
        /// det Q.
        determinant: f64,
    },
    /// 0 < λ is violated for a principal stretch.
    #[error("principal stretch {index} is {value}, not positive")]
    NonPositiveStretch {
        /// Which stretch, from 0.
        index: usize,
        /// Its value.
        value: f64,
    },
}

/// The first number that is infinite or NaN in any lane, by name and position.
#[inline]
pub(crate) fn check_finite<T: Real>(quantity: &'static str, values: &[T]) -> Result<(), ContinuumError> {
    for (index, value) in values.iter().enumerate() {
        if !value.is_finite().all() {
            let lane = (0..T::LANES).find(|&lane| !value.primal(lane).is_finite()).unwrap_or(0);
            return Err(ContinuumError::NotFinite { quantity, index, value: value.primal(lane) });
        }
    }
    Ok(())
}
