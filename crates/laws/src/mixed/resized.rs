//! A deformation with another volume.

use piola_continuum::Deformation;
use piola_numerics::Real;
use piola_tensor::internal::rows::{Rows, scaled};

use crate::varied::lifted;

/// F̃ = (θ/J)^(1/3) F, kept as itself and as its difference from 1.
#[derive(Clone, Copy)]
pub(super) struct Resized<T> {
    gradient: Rows<T>,
    displacement: Rows<T>,
    volume_change: T,
    /// (θ/J)^(1/3).
    pub(super) scale: T,
}

impl<T: Real> Resized<T> {
    /// Of F and θ − 1. Nothing cancels at small strain.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn of(deformation: &impl Deformation<T>, volume_change: T) -> Self {
        let logarithm = (volume_change.ln_1p() - deformation.ln_jacobian()) * T::lit(1.0 / 3.0);
        let change = logarithm.exp_m1();
        let scale = change + T::one();
        // c F − 1 = c ∇u + (c − 1) 1.
        let mut displacement = scaled(deformation.displacement_rows(), scale);
        for (k, row) in displacement.iter_mut().enumerate() {
            row[k] += change;
        }
        Self { gradient: scaled(deformation.gradient_rows(), scale), displacement, volume_change, scale }
    }
}

impl<T: Real> Deformation<T> for Resized<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn gradient_rows(&self) -> Rows<T> {
        self.gradient
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn displacement_rows(&self) -> Rows<T> {
        self.displacement
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn lifted<S: Real>(&self, lift: impl Fn(usize, usize, T) -> S) -> impl Deformation<S> {
        lifted(self.displacement, lift)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn jacobian(&self) -> T {
        self.volume_change + T::one()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn volume_change(&self) -> T {
        self.volume_change
    }
}
