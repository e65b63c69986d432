//! Change of the reference configuration.

use nalgebra::Matrix3;
use piola_continuum::{Deformation, DeformationGradient};
use piola_numerics::Real;
use piola_solids::{Hyperelastic, SolidsError};
use piola_tensor::internal::rows::{Rows, product};

use super::Elastic;

/// The same material, told from another reference configuration: G′(F′) = G(F′ K), W(18.24).
///
/// K is the gradient of the change from the old reference to the new: a deformation F from the old is F = F′ K.
/// Energies are per volume of the new reference: W′(F′) = W(F′ K)/det K.
///
/// # Example
/// A bar held at twice its length is the new reference: its stress there is the one at λ = 2.
/// ```
/// use nalgebra::Matrix3;
/// use piola_specimens::checks::ChangedReference;
/// use piola_solids::{Hyperelastic, MooneyRivlin};
/// use piola_continuum::DeformationGradient;
/// let rubber = MooneyRivlin::stress_free(0.5, 0.25, 1.0)?;
/// let held = DeformationGradient::diagonal([2.0, 1.0, 1.0])?;
/// let told = ChangedReference::new(rubber, &held);
/// let (old, new) = (rubber.cauchy(&held), told.cauchy(&DeformationGradient::<f64>::identity()));
/// assert!((old.0.components[0] - new.0.components[0]).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChangedReference<L> {
    law: L,
    change: DeformationGradient,
}

impl<L> ChangedReference<L> {
    /// Of a law and K.
    #[must_use]
    pub const fn new(law: L, change: &DeformationGradient) -> Self {
        Self { law, change: *change }
    }

    /// F = F′ K over any scalar.
    fn composed<T: Real>(&self, deformation: &impl Deformation<T>) -> Rows<T> {
        let change = self.change.gradient_rows().map(|row| row.map(T::lit));
        product(deformation.gradient_rows(), change)
    }
}

impl<L: Elastic> Elastic for ChangedReference<L> {
    fn cauchy(&self, gradient: &Matrix3<f64>) -> Matrix3<f64> {
        self.law.cauchy(&(gradient * self.change.matrix()))
    }

    fn answers(&self, gradient: &Matrix3<f64>) -> bool {
        self.law.answers(&(gradient * self.change.matrix()))
    }

    fn is_incompressible(&self) -> bool {
        self.law.is_incompressible()
    }
}

impl<L: Hyperelastic> Hyperelastic for ChangedReference<L> {
    fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        let gradient = self.composed(deformation);
        let energy = self.law.energy(&DeformationGradient::<T>::identity().lifted(|i, j, _| gradient[i][j]));
        (energy - T::lit(self.law.energy(&self.change))) / T::lit(self.change.jacobian())
    }

    fn reference_energy(&self) -> f64 {
        (self.law.energy(&self.change) + self.law.reference_energy()) / self.change.jacobian()
    }

    fn check<T: Real>(&self, deformation: &impl Deformation<T>) -> Result<(), SolidsError> {
        let gradient = self.composed(deformation);
        self.law.check(&DeformationGradient::<T>::identity().lifted(|i, j, _| gradient[i][j]))
    }

    fn is_incompressible(&self) -> bool {
        self.law.is_incompressible()
    }
}
