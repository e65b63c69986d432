//! The two models of deformation.

use crate::error::{RegistrationError, check_bound};

/// How the moving image resists deformation.
///
/// Both models have the operator L = μΔ + (λ + μ)∇∇·, with sliding walls, and the drive f of the images:
///
/// | model | equations | deformations |
/// |---|---|---|
/// | elastic | L u + f(u) = 0 | small deformations: the stress grows with them and pulls back |
/// | viscous fluid | L v + f(u) = 0, ∂u/∂t = v − (∇u)v | large deformations: the stress relaxes |
///
/// Measures of similarity have no unit and are means over the box, so λ and μ have none either. In the elastic model they weigh the energy
/// of the deformation, ½ mean(−u·Lu), against the measure. In the fluid model only the ratio λ/μ matters.
///
/// # Example
/// ```
/// use piola_registration::RegistrationModel;
/// let stiff = RegistrationModel::elastic(0.5, 1.0)?;
/// assert!(matches!(stiff, RegistrationModel::Elastic { .. }));
/// assert!(RegistrationModel::elastic(-2.5, 1.0).is_err()); // not elliptic
/// # Ok::<(), piola_registration::RegistrationError>(())
/// ```
///
/// # Source
/// B(4.79), B(4.85).
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum RegistrationModel {
    /// Linear elasticity: the energy of the deformation and the measure together are least.
    Elastic {
        /// λ.
        first_lame_parameter: f64,
        /// μ.
        shear_modulus: f64,
    },
    /// A viscous fluid in creeping motion: the images drive it until they match.
    ViscousFluid {
        /// λ.
        second_viscosity: f64,
        /// μ.
        shear_viscosity: f64,
    },
}

impl RegistrationModel {
    /// Linear elasticity with λ and μ.
    ///
    /// # Errors
    /// [`RegistrationError::OutOfBounds`] unless 0 < μ and 0 < λ + 2μ; `NotFinite`.
    pub fn elastic(first_lame_parameter: f64, shear_modulus: f64) -> Result<Self, RegistrationError> {
        check(first_lame_parameter, shear_modulus)?;
        Ok(Self::Elastic { first_lame_parameter, shear_modulus })
    }

    /// A viscous fluid with λ and μ.
    ///
    /// # Errors
    /// [`RegistrationError::OutOfBounds`] unless 0 < μ and 0 < λ + 2μ; `NotFinite`.
    pub fn viscous_fluid(second_viscosity: f64, shear_viscosity: f64) -> Result<Self, RegistrationError> {
        check(second_viscosity, shear_viscosity)?;
        Ok(Self::ViscousFluid { second_viscosity, shear_viscosity })
    }

    /// λ and μ.
    pub(crate) fn parameters(&self) -> [f64; 2] {
        match *self {
            Self::Elastic { first_lame_parameter, shear_modulus } => [first_lame_parameter, shear_modulus],
            Self::ViscousFluid { second_viscosity, shear_viscosity } => [second_viscosity, shear_viscosity],
        }
    }

    /// Refuses parameters written into the variants without the constructors.
    pub(crate) fn check(&self) -> Result<(), RegistrationError> {
        let [first, shear] = self.parameters();
        check(first, shear)
    }
}

fn check(first: f64, shear: f64) -> Result<(), RegistrationError> {
    check_bound("λ", first, "a finite number", true)?;
    check_bound("μ", shear, "0 < μ", 0.0 < shear)?;
    check_bound("λ + 2μ", first + 2.0 * shear, "0 < λ + 2μ", 0.0 < first + 2.0 * shear)
}
