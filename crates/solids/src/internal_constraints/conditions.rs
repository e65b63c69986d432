//! Conditions on a stress, from which multipliers are found.

use piola_continuum::{Deformation, Symmetric};
use piola_numerics::linear::matrix3::cross;

use crate::Fibre;
use crate::SolidsError;
use crate::error::check_finite;

const WHAT: &str = "condition";

/// A : T = b, a linear condition on Cauchy's stress.
///
/// # Example
/// ```
/// use piola_solids::internal_constraints::StressCondition;
/// use piola_continuum::CauchyStress;
/// let stress = CauchyStress::new(1.0, 2.0, 3.0, 0.0, 0.0, 0.0)?;
/// let pressed = StressCondition::normal_traction([0.0, 2.0, 0.0], 2.5)?;
/// assert_eq!(pressed.residual(&stress), -0.5); // n · T n = 2, asked was 2.5
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StressCondition {
    functional: Symmetric,
    value: f64,
}

impl StressCondition {
    /// A : T = b.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`].
    pub fn new(functional: Symmetric, value: f64) -> Result<Self, SolidsError> {
        for component in functional.components {
            check_finite(WHAT, "A", component)?;
        }
        check_finite(WHAT, "value", value)?;
        Ok(Self { functional, value })
    }

    /// n · T n = t on the plane with a normal along `normal`, of any length, Pa.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`]; [`SolidsError::OutOfBounds`] for the zero vector.
    pub fn normal_traction(normal: [f64; 3], value: f64) -> Result<Self, SolidsError> {
        Self::new(Fibre::new(normal)?.structure(), value)
    }

    /// m · T n = t: the traction along `direction` on the plane with a normal along `normal`, Pa. Both of any length.
    ///
    /// # Errors
    /// As [`normal_traction`](Self::normal_traction).
    pub fn traction(normal: [f64; 3], direction: [f64; 3], value: f64) -> Result<Self, SolidsError> {
        let (n, m) = (Fibre::new(normal)?.direction(), Fibre::new(direction)?.direction());
        Self::new(Symmetric::symmetric_dyad(n, m), value)
    }

    /// T n = 0: three conditions on a face with a normal along `normal`.
    ///
    /// # Errors
    /// As [`normal_traction`](Self::normal_traction).
    pub fn traction_free(normal: [f64; 3]) -> Result<[Self; 3], SolidsError> {
        let n = Fibre::new(normal)?.direction();
        let mut axis = [0.0; 3];
        let least = (0..3).fold(0, |least, k| if n[k].abs() < n[least].abs() { k } else { least });
        axis[least] = 1.0;
        let m = cross(n, axis);
        Ok([Self::normal_traction(n, 0.0)?, Self::traction(n, m, 0.0)?, Self::traction(n, cross(n, m), 0.0)?])
    }

    /// f · T f = t with f = F e, the deformed fibre, which is not normalised.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`].
    pub fn along_fibre(fibre: Fibre, deformation: &impl Deformation<f64>, value: f64) -> Result<Self, SolidsError> {
        Self::new(fibre.structure().congruence(deformation.gradient_rows()), value)
    }

    /// ⅓ tr T = t.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`].
    pub fn mean_stress(value: f64) -> Result<Self, SolidsError> {
        Self::new(Symmetric::identity() * (1.0 / 3.0), value)
    }

    /// A.
    #[must_use]
    pub const fn functional(&self) -> &Symmetric {
        &self.functional
    }

    /// b.
    #[must_use]
    pub const fn value(&self) -> f64 {
        self.value
    }

    /// A : T − b.
    #[must_use]
    pub fn residual(&self, stress: &piola_continuum::CauchyStress) -> f64 {
        self.functional.double_contraction(&stress.0) - self.value
    }
}
