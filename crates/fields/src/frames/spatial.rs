//! Fields in space: functions of x.

use nalgebra::Vector3;
use piola_numerics::{Dual, Real};

use super::Material;
use crate::FieldsError;
use crate::field::{Field, ValueOf, along, check_point, finite, local_rate, value_and_partials};
use crate::motion::{Motion, check_event};
use crate::value::map;

/// A field as a function of the place x and the time: the Eulerian frame. Cartesian components.
///
/// # Example
/// A temperature at rest in space, met by a particle that moves at 3 m/s up its gradient.
/// ```
/// use nalgebra::Vector3;
/// use piola_fields::{Field, Spatial, Uniform};
/// use piola_numerics::Real;
/// struct Temperature;
/// impl Field for Temperature {
///     type Value = f64;
///     fn at<T: Real>(&self, place: &Vector3<T>, _time: T) -> T {
///         place.x * place.x
///     }
/// }
/// let temperature = Spatial(Temperature);
/// let wind = Uniform(Vector3::new(3.0, 0.0, 0.0));
/// let place = Vector3::new(2.0, 0.0, 0.0);
/// assert_eq!(temperature.local_rate(&place, 0.0)?, 0.0);
/// assert_eq!(temperature.material_derivative(&wind, &place, 0.0)?, 12.0); // 2 x v
/// # Ok::<(), piola_fields::FieldsError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Spatial<F>(pub F);

impl<F: Field> Spatial<F> {
    /// Ψ(x, t).
    ///
    /// # Errors
    /// [`FieldsError::NotFinite`] for a place, time or value.
    pub fn value<T: Real>(&self, place: &Vector3<T>, t: T) -> Result<ValueOf<F, T>, FieldsError> {
        check_point(place, t)?;
        finite::<F::Value, T>("field", self.0.at(place, t))
    }

    /// ∂Ψ/∂t at fixed x.
    ///
    /// # Errors
    /// [`FieldsError::NotFinite`] for a place, time or result.
    pub fn local_rate<T: Real>(&self, place: &Vector3<T>, t: T) -> Result<ValueOf<F, T>, FieldsError> {
        check_point(place, t)?;
        finite::<F::Value, T>("local rate", local_rate(&self.0, place, t))
    }

    /// ∂Ψ/∂xⱼ for j = 1, 2, 3, per metre.
    ///
    /// # Errors
    /// [`FieldsError::NotFinite`] for a place, time or result.
    pub fn gradient<T: Real>(&self, place: &Vector3<T>, t: T) -> Result<[ValueOf<F, T>; 3], FieldsError> {
        check_point(place, t)?;
        let [a, b, c] = value_and_partials(&self.0, place, t).1;
        let checked = |partial| finite::<F::Value, T>("grad", partial);
        Ok([checked(a)?, checked(b)?, checked(c)?])
    }

    /// Ψ̇ = ∂Ψ/∂t + (grad Ψ) v at the place x, W(14.19), B(4.19), from the velocity as a field in space.
    ///
    /// For scalars, vectors and tensors in Cartesian components; one pass along (v, 1) gives the sum.
    ///
    /// | symbol | argument | unit |
    /// |---|---|---|
    /// | v | `velocity` | m/s |
    /// | x, t | `place`, `t` | m, s |
    /// | Ψ̇ | returned | `[Ψ]/s` |
    ///
    /// # Errors
    /// [`FieldsError::NotFinite`] for a place, time, velocity or result.
    pub fn material_derivative<T: Real>(
        &self,
        velocity: &impl Field<Value = Vector3<f64>>,
        place: &Vector3<T>,
        t: T,
    ) -> Result<ValueOf<F, T>, FieldsError> {
        check_point(place, t)?;
        let velocity = finite::<Vector3<f64>, T>("velocity", velocity.at(place, t))?;
        finite::<F::Value, T>("material rate", along(&self.0, place, &velocity, t).1)
    }

    /// Ψ̇ at the particle X: the rate of Ψ(x(X, t), t) at fixed X.
    ///
    /// # Errors
    /// What the motion refuses; [`FieldsError::NotFinite`] for a result.
    pub fn rate_following<T: Real>(
        &self,
        motion: &impl Motion,
        reference: &Vector3<T>,
        t: T,
    ) -> Result<ValueOf<F, T>, FieldsError> {
        check_event(motion, reference, t)?;
        let t = Dual::variable(t);
        let value = self.0.at(&motion.place(&reference.map(Dual::constant), t), t);
        finite::<F::Value, T>("material rate", map::<F::Value, _, _>(&value, |x| x.tangent))
    }

    /// The same field as a function of the particle: Ψ(X, t) = Ψ(x(X, t), t), B(4.14).
    pub fn following<M: Motion>(self, motion: M) -> Material<Following<F, M>> {
        Material(Following { field: self.0, motion })
    }
}

/// A field in space as a function of the particles of a motion: [`Spatial::following`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Following<F, M> {
    /// Ψ(x, t).
    pub field: F,
    /// x(X, t).
    pub motion: M,
}

impl<F: Field, M: Motion> Field for Following<F, M> {
    type Value = F::Value;
    #[inline]
    fn at<T: Real>(&self, place: &Vector3<T>, t: T) -> ValueOf<F, T> {
        self.field.at(&self.motion.place(place, t), t)
    }
}
