//! What a field can be a field of: scalars, vectors, tensors and the measures of stress.

use core::fmt::Debug;

use nalgebra::{Matrix3, Vector3};
use piola_continuum::{BiotStress, CauchyStress, FirstPiola, KirchhoffStress, MandelStress, SecondPiola};
use piola_numerics::Real;
use piola_numerics::linear::matrix3::rows_of;
use piola_tensor::Symmetric;
use piola_tensor::internal::rows::Rows;

/// A kind of value of fields, named by its type over `f64`: `f64`, `Vector3<f64>`, `Matrix3<f64>`,
/// [`Symmetric`] and every measure of stress.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_fields::FieldValue;
/// let v = <Vector3<f64> as FieldValue>::from_components(|i| i as f64);
/// assert_eq!(v, Vector3::new(0.0, 1.0, 2.0));
/// ```
pub trait FieldValue: Copy + Debug {
    /// The same kind over any scalar.
    type Over<T: Real>: Copy + Debug;
    /// The number of stored components.
    const COMPONENTS: usize;
    /// The component at `index`, which is below [`COMPONENTS`](Self::COMPONENTS); row-major for matrices, in
    /// Voigt's order for symmetric tensors.
    fn component<T: Real>(value: &Self::Over<T>, index: usize) -> T;
    /// From the components.
    fn from_components<T: Real>(component: impl FnMut(usize) -> T) -> Self::Over<T>;
}

impl FieldValue for f64 {
    type Over<T: Real> = T;
    const COMPONENTS: usize = 1;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn component<T: Real>(value: &T, _index: usize) -> T {
        *value
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn from_components<T: Real>(mut component: impl FnMut(usize) -> T) -> T {
        component(0)
    }
}

impl FieldValue for Vector3<f64> {
    type Over<T: Real> = Vector3<T>;
    const COMPONENTS: usize = 3;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn component<T: Real>(value: &Vector3<T>, index: usize) -> T {
        value[index]
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn from_components<T: Real>(mut component: impl FnMut(usize) -> T) -> Vector3<T> {
        Vector3::from_fn(|i, _| component(i))
    }
}

impl FieldValue for Matrix3<f64> {
    type Over<T: Real> = Matrix3<T>;
    const COMPONENTS: usize = 9;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn component<T: Real>(value: &Matrix3<T>, index: usize) -> T {
        value[(index / 3, index % 3)]
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn from_components<T: Real>(mut component: impl FnMut(usize) -> T) -> Matrix3<T> {
        Matrix3::from_fn(|i, j| component(3 * i + j))
    }
}

impl FieldValue for Symmetric {
    type Over<T: Real> = Symmetric<T>;
    const COMPONENTS: usize = 6;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn component<T: Real>(value: &Symmetric<T>, index: usize) -> T {
        value.components[index]
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn from_components<T: Real>(component: impl FnMut(usize) -> T) -> Symmetric<T> {
        Symmetric { components: core::array::from_fn(component) }
    }
}

macro_rules! values_of_wrapped {
    ($inner:ty: $($name:ident),*) => {$(
        impl FieldValue for $name {
            type Over<T: Real> = $name<T>;
            const COMPONENTS: usize = <$inner as FieldValue>::COMPONENTS;
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn component<T: Real>(value: &$name<T>, index: usize) -> T {
                <$inner as FieldValue>::component(&value.0, index)
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn from_components<T: Real>(component: impl FnMut(usize) -> T) -> $name<T> {
                $name(<$inner as FieldValue>::from_components(component))
            }
        }
    )*};
}

values_of_wrapped!(Symmetric: CauchyStress, KirchhoffStress, SecondPiola);
values_of_wrapped!(Matrix3<f64>: FirstPiola, BiotStress, MandelStress);

/// A kind of value that is a tensor of second order.
pub trait TensorValue: FieldValue {
    /// All nine components as an array of rows.
    fn rows<T: Real>(value: &Self::Over<T>) -> Rows<T>;
}

impl TensorValue for Matrix3<f64> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn rows<T: Real>(value: &Matrix3<T>) -> Rows<T> {
        rows_of(value)
    }
}

macro_rules! tensor_values {
    ($($name:ident),*) => {$(
        impl TensorValue for $name {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn rows<T: Real>(value: &$name<T>) -> Rows<T> {
                value.rows()
            }
        }
    )*};
}

tensor_values!(Symmetric, CauchyStress, KirchhoffStress, SecondPiola, FirstPiola, BiotStress, MandelStress);

/// The value with f done to every component.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn map<V: FieldValue, A: Real, B: Real>(value: &V::Over<A>, mut f: impl FnMut(A) -> B) -> V::Over<B> {
    V::from_components(|i| f(V::component(value, i)))
}
