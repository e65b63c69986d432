//! Fields of particles: functions of X.

use nalgebra::Vector3;
use piola_numerics::Real;

use crate::FieldsError;
use crate::field::{Field, ValueOf, check_point, finite, local_rate, value_and_partials};

/// A field as a function of the particle X and the time: the Lagrangian frame.
///
/// # Example
/// A temperature that each particle keeps, but for a slow rise.
/// ```
/// use nalgebra::Vector3;
/// use piola_fields::{Field, Material};
/// use piola_numerics::Real;
/// struct Temperature;
/// impl Field for Temperature {
///     type Value = f64;
///     fn at<T: Real>(&self, particle: &Vector3<T>, t: T) -> T {
///         particle.x * particle.x + T::lit(3.0) * t
///     }
/// }
/// let temperature = Material(Temperature);
/// let particle = Vector3::new(2.0, 0.0, 0.0);
/// assert_eq!(temperature.value(&particle, 1.0)?, 7.0);
/// assert_eq!(temperature.rate(&particle, 1.0)?, 3.0);
/// assert_eq!(temperature.gradient(&particle, 1.0)?, [4.0, 0.0, 0.0]);
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Material<F>(pub F);

impl<F: Field> Material<F> {
    /// Ψ(X, t).
    ///
    /// # Errors
    /// [`FieldsError::NotFinite`] for a place, time or value.
    pub fn value<T: Real>(&self, reference: &Vector3<T>, t: T) -> Result<ValueOf<F, T>, FieldsError> {
        check_point(reference, t)?;
        finite::<F::Value, T>("field", self.0.at(reference, t))
    }

    /// Ψ̇ = ∂Ψ/∂t at fixed X: the material derivative.
    ///
    /// # Errors
    /// [`FieldsError::NotFinite`] for a place, time or result.
    pub fn rate<T: Real>(&self, reference: &Vector3<T>, t: T) -> Result<ValueOf<F, T>, FieldsError> {
        check_point(reference, t)?;
        finite::<F::Value, T>("material rate", local_rate(&self.0, reference, t))
    }

    /// `∂Ψ/∂X_A` for A = 1, 2, 3, per metre of the reference configuration.
    ///
    /// # Errors
    /// [`FieldsError::NotFinite`] for a place, time or result.
    pub fn gradient<T: Real>(&self, reference: &Vector3<T>, t: T) -> Result<[ValueOf<F, T>; 3], FieldsError> {
        check_point(reference, t)?;
        let [a, b, c] = value_and_partials(&self.0, reference, t).1;
        let checked = |partial| finite::<F::Value, T>("Grad", partial);
        Ok([checked(a)?, checked(b)?, checked(c)?])
    }
}
