//! The isochoric part of a deformation.

use piola_continuum::Deformation;
use piola_numerics::{Mask, Real};
use piola_tensor::internal::rows::{Rows, difference, identity, scaled, sum};

use crate::isochoric_factor::Unimodular;

/// J^(−1/3) F, kept as itself and as its difference from 1.
#[derive(Clone, Copy, Debug)]
pub struct UnimodularDeformation<T> {
    gradient: Rows<T>,
    displacement: Rows<T>,
}

impl<T: Real> UnimodularDeformation<T> {
    /// Of F or ∇u.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn of(deformation: &impl Deformation<T>) -> Self {
        let change_of_volume = deformation.volume_change();
        let Unimodular { third: scale, third_change: change, .. } =
            Unimodular::of(change_of_volume, deformation.jacobian());
        let mut displacement = scaled(deformation.displacement_rows(), scale);
        for (k, row) in displacement.iter_mut().enumerate() {
            row[k] += change;
        }
        let gradient = scaled(deformation.gradient_rows(), scale);
        // Of a body that is compressed to nearly nothing, or blown up, nothing is left of differences from the reference.
        let beside = change_of_volume.abs().at_most(T::lit(0.875));
        if !beside.all() {
            let plain = difference(gradient, identity());
            for (row, plain) in displacement.iter_mut().zip(plain) {
                for (entry, plain) in row.iter_mut().zip(plain) {
                    *entry = T::select(beside, *entry, plain);
                }
            }
        }
        Self { gradient, displacement }
    }
}

impl<T: Real> Deformation<T> for UnimodularDeformation<T> {
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
        let entry = |i: usize, j: usize| lift(i, j, self.displacement[i][j]);
        let row = |i: usize| [entry(i, 0), entry(i, 1), entry(i, 2)];
        let displacement = [row(0), row(1), row(2)];
        UnimodularDeformation { gradient: sum(displacement, identity()), displacement }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn jacobian(&self) -> T {
        T::one()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn volume_change(&self) -> T {
        T::zero()
    }
}
