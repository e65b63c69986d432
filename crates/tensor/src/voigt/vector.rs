//! Vectors of six components.

use core::marker::PhantomData;

use nalgebra::Vector6;
use piola_numerics::Real;

use super::order::{Piola, VoigtOrder};
use crate::error::check_finite;
use crate::scale::{largest, power_of_two_scale, square_root};
use crate::{Symmetric, TensorError};

macro_rules! vectors {
    ($($(#[$documentation:meta])* $name:ident, $quantity:literal, $into:expr, $back:expr;)*) => {$(
        $(#[$documentation])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[cfg_attr(feature = "serde", serde(
            try_from = "[T; 6]",
            into = "[T; 6]",
            bound(
                serialize = "T: Real + serde::Serialize, O: VoigtOrder",
                deserialize = "T: Real + serde::Deserialize<'de>, O: VoigtOrder"
            )
        ))]
        pub struct $name<T = f64, O = Piola> {
            /// The components in the order O, with the factors of this type.
            pub components: [T; 6],
            order: PhantomData<O>,
        }

        impl<T: Real, O: VoigtOrder> $name<T, O> {
            /// From components in the order O, with the factors of this type.
            ///
            /// # Errors
            /// [`TensorError::NotFinite`].
            pub fn new(components: [T; 6]) -> Result<Self, TensorError> {
                check_finite($quantity, &components)?;
                Ok(Self::raw(components))
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            pub(super) fn raw(components: [T; 6]) -> Self {
                Self { components, order: PhantomData }
            }

            /// Of a tensor.
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[must_use]
            pub fn of(tensor: &Symmetric<T>) -> Self {
                let factor: fn(T) -> T = $into;
                let place = |p: usize| {
                    let component = tensor.components[O::PLACES[p]];
                    if p < 3 { component } else { factor(component) }
                };
                Self::raw([place(0), place(1), place(2), place(3), place(4), place(5)])
            }

            /// The tensor.
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[must_use]
            pub fn tensor(&self) -> Symmetric<T> {
                let factor: fn(T) -> T = $back;
                let mut tensor = Symmetric::zero();
                for (p, component) in self.components.iter().enumerate() {
                    tensor.components[O::PLACES[p]] = if p < 3 { *component } else { factor(*component) };
                }
                tensor
            }

            /// The same in another order, to the last bit.
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[must_use]
            pub fn reordered<N: VoigtOrder>(&self) -> $name<T, N> {
                let mut stored = [T::zero(); 6];
                for (p, component) in self.components.iter().enumerate() {
                    stored[O::PLACES[p]] = *component;
                }
                $name::raw([0, 1, 2, 3, 4, 5].map(|p: usize| stored[N::PLACES[p]]))
            }

            /// As a vector of nalgebra.
            #[must_use]
            pub fn vector(&self) -> Vector6<T> {
                Vector6::from(self.components)
            }
        }

        /// Refuses infinite and NaN components.
        impl<T: Real, O: VoigtOrder> TryFrom<[T; 6]> for $name<T, O> {
            type Error = TensorError;
            fn try_from(components: [T; 6]) -> Result<Self, TensorError> {
                Self::new(components)
            }
        }

        impl<T, O> From<$name<T, O>> for [T; 6] {
            fn from(vector: $name<T, O>) -> Self {
                vector.components
            }
        }

        /// Refuses infinite and NaN components.
        impl<T: Real, O: VoigtOrder> TryFrom<Vector6<T>> for $name<T, O> {
            type Error = TensorError;
            fn try_from(v: Vector6<T>) -> Result<Self, TensorError> {
                Self::new([v[0], v[1], v[2], v[3], v[4], v[5]])
            }
        }
    )*};
}

vectors! {
    /// A stress-like Voigt vector: shears as they are.
    ///
    /// # Example
    /// ```
    /// use piola_tensor::Symmetric;
    /// use piola_tensor::voigt::{Classical, StressVector};
    /// let tensor = Symmetric::new(1.0, 2.0, 3.0, 12.0, 23.0, 13.0);
    /// let classical = StressVector::<f64, Classical>::of(&tensor);
    /// assert_eq!(classical.components, [1.0, 2.0, 3.0, 23.0, 13.0, 12.0]);
    /// ```
    StressVector, "stress vector", |x| x, |x| x;
    /// A strain-like Voigt vector: shears doubled, the engineering shears γᵢⱼ = 2 εᵢⱼ.
    ///
    /// # Example
    /// B(4.73): the vector of ∇u with `u_y` = 1 and `w_x` = 4.
    /// ```
    /// use piola_tensor::Symmetric;
    /// use piola_tensor::voigt::{BroNielsen, StrainVector};
    /// let strain = Symmetric::symmetric_part([[0.0, 1.0, 0.0], [0.0; 3], [4.0, 0.0, 0.0]]);
    /// let vector = StrainVector::<f64, BroNielsen>::of(&strain);
    /// assert_eq!(vector.components, [0.0, 0.0, 0.0, 1.0, 4.0, 0.0]); // γ₁₃ before γ₂₃
    /// ```
    ///
    /// # Source
    /// B(4.73).
    StrainVector, "strain vector", |x| x + x, |x| x * T::lit(0.5);
    /// A vector of Mandel: shears times √2, so that norms and products are those of the tensors.
    ///
    /// # Accuracy
    /// Each shear rounded once more than the tensor's.
    ///
    /// # Example
    /// ```
    /// use piola_tensor::Symmetric;
    /// use piola_tensor::voigt::MandelVector;
    /// let vector = MandelVector::<f64>::of(&Symmetric::diagonal([3.0, 4.0, 0.0]));
    /// assert_eq!(vector.norm(), 5.0);
    /// ```
    MandelVector, "Mandel vector", |x| x * T::lit(core::f64::consts::SQRT_2),
        |x| x / T::lit(core::f64::consts::SQRT_2);
}

impl<T: Real, O: VoigtOrder> StressVector<T, O> {
    /// T : ε, the product with a strain vector of the same order.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn dot(&self, strain: &StrainVector<T, O>) -> T {
        crate::fourth::kernels::dot6(&self.components, &strain.components)
    }
}

impl<T: Real, O: VoigtOrder> MandelVector<T, O> {
    /// A : B.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn dot(&self, other: &Self) -> T {
        crate::fourth::kernels::dot6(&self.components, &other.components)
    }

    /// |A|, for components anywhere in the range of numbers.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn norm(&self) -> T {
        let (scale, unscale) = power_of_two_scale(largest(self.components));
        let scaled = self.components.map(|x| x * scale);
        square_root(crate::fourth::kernels::dot6(&scaled, &scaled)) * unscale
    }
}
