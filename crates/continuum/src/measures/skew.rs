//! How skew tensors with a meaning are made: spins as types around an axial vector.

/// A type around a skew tensor, by its axial vector ω: Ω v = ω × v.
macro_rules! skew_measure {
    ($(#[$documentation:meta])* $name:ident, $quantity:literal) => {
        $(#[$documentation])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[cfg_attr(feature = "serde", serde(
            try_from = "[T; 3]",
            into = "[T; 3]",
            bound(
                serialize = "T: piola_numerics::Real + serde::Serialize",
                deserialize = "T: piola_numerics::Real + serde::Deserialize<'de>"
            )
        ))]
        #[repr(transparent)]
        pub struct $name<T = f64> {
            /// The axial vector ω, with Ω v = ω × v.
            pub axial: nalgebra::Vector3<T>,
        }

        impl<T: piola_numerics::Real> $name<T> {
            /// From the axial vector ω, 1/s.
            ///
            /// # Errors
            /// [`ContinuumError::NotFinite`](crate::ContinuumError::NotFinite), in any lane.
            pub fn new(axial: nalgebra::Vector3<T>) -> Result<Self, $crate::ContinuumError> {
                Self::try_from([axial[0], axial[1], axial[2]])
            }

            /// 0.
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[must_use]
            pub fn zero() -> Self {
                Self::of_axial([T::zero(); 3])
            }

            /// The skew tensor Ω.
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[must_use]
            pub fn tensor(&self) -> piola_tensor::Skew<T> {
                piola_tensor::Skew { axial: [self.axial[0], self.axial[1], self.axial[2]] }
            }

            /// The skew tensor Ω as a matrix.
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[must_use]
            pub fn matrix(&self) -> nalgebra::Matrix3<T> {
                self.tensor().matrix()
            }

            /// The skew tensor Ω as an array of rows.
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[must_use]
            pub fn rows(&self) -> piola_tensor::internal::rows::Rows<T> {
                self.tensor().rows()
            }

            /// From an axial vector that a formula has computed.
            #[cfg_attr(not(debug_assertions), inline(always))]
            pub(crate) fn of_axial(axial: [T; 3]) -> Self {
                Self { axial: nalgebra::Vector3::from(axial) }
            }

            /// f of the components of two.
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn each(a: &Self, b: &Self, f: impl Fn(T, T) -> T) -> Self {
                Self::of_axial(piola_tensor::Skew::each(&a.tensor(), &b.tensor(), f).axial)
            }
        }

        piola_tensor::internal::linear_space!($name);

        /// From the axial vector, checked.
        impl<T: piola_numerics::Real> TryFrom<[T; 3]> for $name<T> {
            type Error = $crate::ContinuumError;
            fn try_from(axial: [T; 3]) -> Result<Self, Self::Error> {
                $crate::error::check_finite($quantity, &axial)?;
                Ok(Self::of_axial(axial))
            }
        }
        /// The axial vector.
        impl<T: piola_numerics::Real> From<$name<T>> for [T; 3] {
            fn from(spin: $name<T>) -> Self {
                spin.tensor().axial
            }
        }

        #[cfg(feature = "glam")]
        piola_tensor::internal::glam_vectors!($name, $crate::ContinuumError, |spin| <[_; 3]>::from(spin));
    };
}

pub(crate) use skew_measure;
