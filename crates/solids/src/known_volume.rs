//! A deformation whose change of volume is computed once.

use piola_continuum::Deformation;
use piola_numerics::Real;
use piola_tensor::internal::rows::Rows;

/// A deformation with J and J − 1, for everything that is asked of it: each formula would compute J − 1 again, and the compiler
/// does not see that it is the same where a rare case has a path of its own.
#[derive(Clone, Copy)]
pub(super) struct KnownVolume<T, D> {
    deformation: D,
    jacobian: T,
    change: T,
}

impl<T: Real, D: Deformation<T>> KnownVolume<T, D> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn of(deformation: &D) -> Self {
        Self { deformation: *deformation, jacobian: deformation.jacobian(), change: deformation.volume_change() }
    }
}

impl<T: Real, D: Deformation<T>> Deformation<T> for KnownVolume<T, D> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn lifted<S: Real>(&self, lift: impl Fn(usize, usize, T) -> S) -> impl Deformation<S> {
        self.deformation.lifted(lift)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn gradient_rows(&self) -> Rows<T> {
        self.deformation.gradient_rows()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn displacement_rows(&self) -> Rows<T> {
        self.deformation.displacement_rows()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn jacobian(&self) -> T {
        self.jacobian
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn volume_change(&self) -> T {
        self.change
    }
}
