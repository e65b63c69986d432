//! What several outputs at a point share.

use piola_continuum::Deformation;
use piola_continuum::polar::StretchAnalysis;
use piola_numerics::Real;
use piola_tensor::internal::rows::Rows;

/// A deformation with what is already known of it: J where it was checked, the stretches as far as an output
/// needs them.
#[derive(Clone, Copy)]
pub struct Point<T: Real, D> {
    pub(super) deformation: D,
    pub(super) jacobian: Option<T>,
    pub(super) stretch: Option<StretchAnalysis<T>>,
}

impl<T: Real, D> core::fmt::Debug for Point<T, D> {
    fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let stretch = self.stretch.is_some();
        formatter
            .debug_struct("Point")
            .field("jacobian", &self.jacobian)
            .field("stretch", &stretch)
            .finish_non_exhaustive()
    }
}

impl<T: Real, D: Deformation<T>> Point<T, D> {
    /// The analysis of the stretches, made once for all outputs.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn stretch(&self) -> StretchAnalysis<T> {
        match self.stretch {
            Some(stretch) => stretch,
            None => analysed(&self.deformation),
        }
    }
}

/// Of a point beside a batch: compiled once, not into every quantity.
#[cold]
#[inline(never)]
fn analysed<T: Real, D: Deformation<T>>(deformation: &D) -> StretchAnalysis<T> {
    StretchAnalysis::of(deformation)
}

impl<T: Real, D: Deformation<T>> Deformation<T> for Point<T, D> {
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
        match self.jacobian {
            Some(jacobian) => jacobian,
            None => self.deformation.jacobian(),
        }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn volume_change(&self) -> T {
        self.deformation.volume_change()
    }
}
