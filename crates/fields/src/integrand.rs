//! What can be integrated: scalars, vectors, tensors and arrays over any [`Real`].

use nalgebra::{Matrix3, Vector3};
use piola_numerics::sums::two_sum;
use piola_numerics::{Dual, Element, Gradient, Jet, Lanes, Mask, Real};
use piola_tensor::Symmetric;

use crate::FieldsError;
use crate::error::check_finite;
use crate::field::finite;
use crate::value::FieldValue;

/// A value with components that can be weighted and added.
///
/// Implemented for `f32`, `f64`, lanes and all differentiable scalars, for `Vector3`, `Matrix3`, [`Symmetric`]
/// and arrays `[T; N]` of them. An integral of differentiable values carries the derivatives of the integral,
/// exact to rounding.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_fields::integral::Integrand;
/// assert_eq!(Vector3::new(1.0, 2.0, 3.0).components(), [1.0, 2.0, 3.0]);
/// ```
pub trait Integrand: Copy {
    /// The scalar of the components.
    type Scalar: Real;
    /// The value whose components are zero.
    #[must_use]
    fn zero() -> Self;
    /// The components.
    #[must_use]
    fn components(&self) -> &[Self::Scalar];
    /// The components, to be changed.
    #[must_use]
    fn components_mut(&mut self) -> &mut [Self::Scalar];
}

macro_rules! scalar_integrand {
    ($([$($parameters:tt)*] $scalar:ty),* $(,)?) => {$(
        impl<$($parameters)*> Integrand for $scalar {
            type Scalar = Self;
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn zero() -> Self {
                Real::lit(0.0)
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn components(&self) -> &[Self] {
                core::slice::from_ref(self)
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn components_mut(&mut self) -> &mut [Self] {
                core::slice::from_mut(self)
            }
        }
    )*};
}

scalar_integrand!(
    [] f32,
    [] f64,
    [T: Real] Dual<T>,
    [T: Real, const N: usize] Gradient<T, N>,
    [T: Real, const N: usize] Jet<T, N>,
    [T: Element, const N: usize] Lanes<T, N>,
);

impl<T: Real> Integrand for Vector3<T> {
    type Scalar = T;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn zero() -> Self {
        Self::repeat(T::lit(0.0))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn components(&self) -> &[T] {
        self.as_slice()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn components_mut(&mut self) -> &mut [T] {
        self.as_mut_slice()
    }
}

impl<T: Real> Integrand for Matrix3<T> {
    type Scalar = T;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn zero() -> Self {
        Self::repeat(T::lit(0.0))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn components(&self) -> &[T] {
        self.as_slice()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn components_mut(&mut self) -> &mut [T] {
        self.as_mut_slice()
    }
}

impl<T: Real> Integrand for Symmetric<T> {
    type Scalar = T;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn zero() -> Self {
        Self { components: [T::lit(0.0); 6] }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn components(&self) -> &[T] {
        &self.components
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn components_mut(&mut self) -> &mut [T] {
        &mut self.components
    }
}

impl<T: Real, const N: usize> Integrand for [T; N] {
    type Scalar = T;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn zero() -> Self {
        [T::lit(0.0); N]
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn components(&self) -> &[T] {
        self
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn components_mut(&mut self) -> &mut [T] {
        self
    }
}

/// A running integral Σ w f that keeps what its additions round off.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RunningIntegral<V> {
    sum: V,
    carry: V,
}

impl<V: Integrand> RunningIntegral<V> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn new() -> Self {
        Self { sum: V::zero(), carry: V::zero() }
    }

    /// Adds `weight` × `term`, a value at `position`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn add(
        &mut self,
        term: &V,
        weight: V::Scalar,
        position: &Vector3<V::Scalar>,
    ) -> Result<(), FieldsError> {
        let parts = self.sum.components_mut().iter_mut().zip(self.carry.components_mut()).zip(term.components());
        for (component, ((sum, carry), &value)) in parts.enumerate() {
            if !value.is_finite().all() {
                return Err(not_finite(component, value, position));
            }
            let (total, error) = two_sum(*sum, value * weight);
            *sum = total;
            *carry += error;
        }
        Ok(())
    }

    /// The integral, if it is in the range of numbers.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn value(mut self) -> Result<V, FieldsError> {
        for (sum, &carry) in self.sum.components_mut().iter_mut().zip(self.carry.components()) {
            // After an overflow the carry is NaN and the plain sum tells what happened.
            *sum = V::Scalar::select(carry.is_finite(), *sum + carry, *sum);
        }
        check_finite("integral", self.sum.components())?;
        Ok(self.sum)
    }
}

/// A running integral of the values of a field.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FieldIntegral<V: FieldValue, T: Real> {
    sum: V::Over<T>,
    carry: V::Over<T>,
}

impl<V: FieldValue, T: Real> FieldIntegral<V, T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn new() -> Self {
        let zero = V::from_components(|_| T::lit(0.0));
        Self { sum: zero, carry: zero }
    }

    /// Adds `weight` × `term`, a value at `position`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn add(&mut self, term: &V::Over<T>, weight: T, position: &Vector3<T>) -> Result<(), FieldsError> {
        let not_finite_at = |i: &usize| !V::component::<T>(term, *i).is_finite().all();
        if let Some(component) = (0..V::COMPONENTS).find(not_finite_at) {
            return Err(not_finite(component, V::component(term, component), position));
        }
        let step = |i| two_sum(V::component::<T>(&self.sum, i), V::component::<T>(term, i) * weight);
        let carry = V::from_components(|i| V::component::<T>(&self.carry, i) + step(i).1);
        self.sum = V::from_components(|i| step(i).0);
        self.carry = carry;
        Ok(())
    }

    /// The integral, if it is in the range of numbers.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn value(self) -> Result<V::Over<T>, FieldsError> {
        let total = V::from_components(|i| {
            let (sum, carry) = (V::component::<T>(&self.sum, i), V::component::<T>(&self.carry, i));
            // After an overflow the carry is NaN and the plain sum tells what happened.
            T::select(carry.is_finite(), sum + carry, sum)
        });
        finite::<V, T>("integral", total)
    }
}

#[cold]
fn not_finite<T: Real>(component: usize, value: T, position: &Vector3<T>) -> FieldsError {
    let lane = (0..T::LANES).find(|&lane| !value.primal(lane).is_finite()).unwrap_or(0);
    FieldsError::IntegrandNotFinite {
        position: [position.x.primal(lane), position.y.primal(lane), position.z.primal(lane)],
        component,
        value: value.primal(lane),
    }
}

/// The largest component in modulus, over all lanes; derivatives do not count.
pub(crate) fn largest_component<V: Integrand>(value: &V) -> f64 {
    let lanes = |x: &V::Scalar| (0..V::Scalar::LANES).map(|lane| x.primal(lane).abs()).fold(0.0, f64::max);
    value.components().iter().map(lanes).fold(0.0, f64::max)
}

/// The largest difference of components in modulus, over all lanes; derivatives do not count.
pub(crate) fn largest_difference<V: Integrand>(a: &V, b: &V) -> f64 {
    let mut difference = *a;
    for (component, &other) in difference.components_mut().iter_mut().zip(b.components()) {
        *component -= other;
    }
    largest_component(&difference)
}
