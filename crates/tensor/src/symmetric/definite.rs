//! Whether a symmetric tensor is positive definite.

use piola_numerics::sums::unit_in_last_place;
use piola_numerics::{Mask, Real};

use super::Symmetric;
use crate::TensorError;

/// The leading minors are not negative beyond rounding, in any lane.
///
/// What a formula has computed for stretches of very different size may be indefinite by rounding; it is accepted.
///
/// # Errors
/// `NotPositiveDefinite`.
pub fn positive_definite<T: Real>(quantity: &'static str, a: &Symmetric<T>) -> Result<(), TensorError> {
    let [xx, yy, zz, xy, yz, xz] = a.components;
    let scale = [yy, zz, xy, yz, xz].iter().fold(xx.abs(), |largest, x| largest.max(x.abs()));
    let tolerance = T::lit(-64.0 * unit_in_last_place::<T>());
    // Divided by the size, so that no product leaves the range of the scalar.
    let unit = a.components.map(|x| x / scale);
    let scaled = Symmetric { components: unit };
    let minors = [unit[0], unit[0] * unit[1] - unit[3] * unit[3], scaled.determinant()];
    for (i, minor) in minors.into_iter().enumerate() {
        let fits = if i == 0 { T::zero().less_than(minor) } else { tolerance.at_most(minor) };
        if !fits.all() {
            let fits = |lane: usize| {
                if i == 0 { 0.0 < minor.primal(lane) } else { tolerance.primal(lane) <= minor.primal(lane) }
            };
            let lane = (0..T::LANES).find(|&lane| !fits(lane)).unwrap_or(0);
            return Err(TensorError::NotPositiveDefinite {
                quantity,
                order: i + 1,
                minor: minor.primal(lane),
                scale: scale.primal(lane),
            });
        }
    }
    Ok(())
}
