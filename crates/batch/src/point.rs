//! What several outputs at a point share.

use piola_numerics::Real;

use super::requests::{Quantity, Request};
use super::{BatchScalar, Destination, Source};
use crate::Deformation;
use crate::spectral::StretchAnalysis;
use crate::tensor::rows::Rows;

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
    #[inline(always)]
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

impl<Q, S, V, const I: usize, const K: usize> Request<Q, S, V, I, K> {
    /// What a batch would write at one point: from the deformation there, and the input of the request at an index.
    ///
    /// To look into a batch, or to try a quantity of one's own; of a million points [`evaluate`](super::evaluate) is the
    /// way. Nothing is written, and nothing is checked.
    ///
    /// # Accuracy
    /// The numbers of a batch, but for elementary functions, which are those of the standard library here.
    ///
    /// # Example
    /// ```
    /// use piola_batch as batch;
    /// use piola_continuum::{CauchyStress, DeformationGradient, FirstPiola};
    /// let (f, stress) = (DeformationGradient::diagonal([2.0, 0.5, 0.5])?, [CauchyStress::new(8.0, 0.0, 0.0, 0.0, 0.0, 0.0)?]);
    /// let mut nominal = [FirstPiola::zero()];
    /// let request = batch::cauchy_to_first_piola(&stress[..], &mut nominal[..]);
    /// assert_eq!(request.at(&f, 0)[0], 2.0); // by rows
    /// # Ok::<(), piola_batch::BatchError>(())
    /// ```
    ///
    /// # Panics
    /// When the source has no such index.
    #[must_use]
    pub fn at<T: BatchScalar, D: Deformation<T> + Copy>(&self, deformation: &D, index: usize) -> [T; K]
    where
        Q: Quantity<I, K>,
        S: Source<Q::Input, T, I>,
        V: Destination<Q::Output, T, K>,
    {
        let point = Point { deformation: *deformation, jacobian: None, stretch: None };
        self.quantity.of(&point, self.source.point(index))
    }
}

impl<T: Real, D: Deformation<T>> Deformation<T> for Point<T, D> {
    #[inline(always)]
    fn lifted<S: Real>(&self, lift: impl Fn(usize, usize, T) -> S) -> impl Deformation<S> {
        self.deformation.lifted(lift)
    }
    #[inline(always)]
    fn gradient_rows(&self) -> Rows<T> {
        self.deformation.gradient_rows()
    }
    #[inline(always)]
    fn displacement_rows(&self) -> Rows<T> {
        self.deformation.displacement_rows()
    }
    #[inline(always)]
    fn jacobian(&self) -> T {
        match self.jacobian {
            Some(jacobian) => jacobian,
            None => self.deformation.jacobian(),
        }
    }
    #[inline(always)]
    fn volume_change(&self) -> T {
        self.deformation.volume_change()
    }
}
