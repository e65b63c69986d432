//! Powers of J that take the volume out of a deformation.

use piola_numerics::Real;

/// J^(−1/3) and J^(−2/3) with their differences from 1.
#[derive(Clone, Copy, Debug)]
pub struct Unimodular<T> {
    /// r = J^(−1/3).
    pub third: T,
    /// r − 1.
    pub third_change: T,
    /// r².
    pub two_thirds: T,
    /// r² − 1.
    pub two_thirds_change: T,
}

impl<T: Real> Unimodular<T> {
    /// Of J − 1 and J, the differences relative to themselves within a few ulp.
    ///
    /// ```text
    /// r − 1 = −(J − 1) r³/(1 + r + r²)        r² − 1 = (r − 1)(r + 1)
    /// ```
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn of(change: T, jacobian: T) -> Self {
        let third = jacobian.recip_cbrt();
        let two_thirds = third * third;
        let next = third + T::one();
        // In this order nothing overflows.
        let third_change = -(change * third / (next + two_thirds) * two_thirds);
        Self { third, third_change, two_thirds, two_thirds_change: third_change * next }
    }
}
