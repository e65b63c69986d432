//! Checks of what comes from outside.

use piola_numerics::{Mask, Real};

use crate::GravitationError;

pub(crate) fn check_length(quantity: &'static str, expected: usize, found: usize) -> Result<(), GravitationError> {
    if expected == found { Ok(()) } else { Err(GravitationError::WrongLength { quantity, expected, found }) }
}

pub(crate) fn check_finite<T: Real>(quantity: &'static str, values: &[T]) -> Result<(), GravitationError> {
    for (index, value) in values.iter().enumerate() {
        if !value.is_finite().all() {
            let lane = (0..T::LANES).find(|&lane| !f64::is_finite(value.primal(lane))).unwrap_or(0);
            return Err(GravitationError::NotFinite { quantity, index, value: value.primal(lane) });
        }
    }
    Ok(())
}
