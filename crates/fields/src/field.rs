//! Fields: values that depend on place and time.

use nalgebra::Vector3;
use piola_numerics::{Dual, Gradient, Real};

use super::motion::kernels::variables;
use super::value::{FieldValue, map};
use crate::FieldsError;
use crate::error::check_finite;

/// The value of the field `F` over the scalar `T`.
pub type ValueOf<F, T> = <<F as Field>::Value as FieldValue>::Over<T>;

/// A field: a formula over any scalar for the value at a place and time.
///
/// What the place means is said by who takes the field: particles X in [`Material`](super::Material), places x in
/// [`Spatial`](super::Spatial), coordinates q with components in the local basis in
/// `Flow`.
///
/// # Example
/// The stress of water at rest: ten metres deep the pressure is ρ g h.
/// ```
/// use nalgebra::Vector3;
/// use piola_continuum::{CauchyStress, Symmetric};
/// use piola_fields::Field;
/// use piola_numerics::Real;
///
/// struct Hydrostatic;
/// impl Field for Hydrostatic {
///     type Value = CauchyStress;
///     fn at<T: Real>(&self, place: &Vector3<T>, _time: T) -> CauchyStress<T> {
///         let pressure = T::lit(-1000.0 * 9.81) * place.z;
///         CauchyStress(Symmetric::diagonal([-pressure; 3]))
///     }
/// }
/// let stress = Hydrostatic.at(&Vector3::new(0.0, 0.0, -10.0), 0.0);
/// assert_eq!(stress.0.components[0], -98100.0);
/// ```
pub trait Field {
    /// What it is a field of, over `f64`.
    type Value: FieldValue;

    /// The value at a place and time.
    fn at<T: Real>(&self, place: &Vector3<T>, t: T) -> ValueOf<Self, T>;
}

impl<F: Field> Field for &F {
    type Value = F::Value;
    #[inline]
    fn at<T: Real>(&self, place: &Vector3<T>, t: T) -> ValueOf<Self, T> {
        (**self).at(place, t)
    }
}

/// The field with the same value everywhere and always.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_fields::{Field, Uniform};
/// let gravity = Uniform(Vector3::new(0.0, 0.0, -9.81));
/// assert_eq!(gravity.at(&Vector3::new(1.0, 2.0, 3.0), 4.0).z, -9.81);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Uniform<V>(pub V);

impl<V: FieldValue<Over<f64> = V>> Field for Uniform<V> {
    type Value = V;
    #[inline]
    fn at<T: Real>(&self, _place: &Vector3<T>, _time: T) -> V::Over<T> {
        map::<V, _, _>(&self.0, T::lit)
    }
}

/// Refuses a place or t that is not finite.
#[inline]
pub(crate) fn check_point<T: Real>(place: &Vector3<T>, t: T) -> Result<(), FieldsError> {
    check_finite("place", place.as_slice())?;
    check_finite("t", &[t])
}

/// The value, if all components are finite.
#[inline]
pub(crate) fn finite<V: FieldValue, T: Real>(
    quantity: &'static str,
    value: V::Over<T>,
) -> Result<V::Over<T>, FieldsError> {
    for index in 0..V::COMPONENTS {
        check_finite(quantity, &[V::component(&value, index)]).map_err(|error| match error {
            FieldsError::NotFinite { value, .. } => FieldsError::NotFinite { quantity, index, value },
            other => other,
        })?;
    }
    Ok(value)
}

/// (value, derivative along (velocity, 1) in space and time).
#[inline]
pub(crate) fn along<F: Field + ?Sized, T: Real>(
    field: &F,
    place: &Vector3<T>,
    velocity: &Vector3<T>,
    t: T,
) -> (ValueOf<F, T>, ValueOf<F, T>) {
    let place = Vector3::from_fn(|i, _| Dual::new(place[i], velocity[i]));
    let value = field.at(&place, Dual::variable(t));
    (map::<F::Value, _, _>(&value, |x| x.value), map::<F::Value, _, _>(&value, |x| x.tangent))
}

/// ∂/∂t at fixed place.
#[inline]
pub(crate) fn local_rate<F: Field + ?Sized, T: Real>(field: &F, place: &Vector3<T>, t: T) -> ValueOf<F, T> {
    let value = field.at(&place.map(Dual::constant), Dual::variable(t));
    map::<F::Value, _, _>(&value, |x| x.tangent)
}

/// (value, partial derivatives with respect to the three coordinates of the place).
#[inline]
pub(crate) fn value_and_partials<F: Field + ?Sized, T: Real>(
    field: &F,
    place: &Vector3<T>,
    t: T,
) -> (ValueOf<F, T>, [ValueOf<F, T>; 3]) {
    let value = field.at(&variables(place), Gradient::constant(t));
    let partial = |j: usize| map::<F::Value, _, _>(&value, |x| x.partials[j]);
    (map::<F::Value, _, _>(&value, |x| x.value), [partial(0), partial(1), partial(2)])
}
