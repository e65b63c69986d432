//! How tensors with a meaning are made: strains, stresses and rates as types around a symmetric, general or skew tensor.
//!
//! All have the same constructors, and all of these check: `new`, `from_rows`, for symmetric ones `from_matrix`, and
//! `try_from` the stored components. The field is open because formulas fill it without a check.
//!
//! | macro | for |
//! |---|---|
//! | `symmetric_measure!` | six components; with a metric that must be positive definite |
//! | `general_measure!` | nine components |
//! | `skew_measure!` | an axial vector |
//! | `linear_measure!` | sums and multiples of a symmetric or general one; not for C, B, U and V, whose differences are none |

mod skew;

/// A type around a symmetric tensor. With a metric, another tensor made of it must be positive definite.
macro_rules! symmetric_measure {
    ($(#[$documentation:meta])* $name:ident, $quantity:literal $(, $metric:literal, |$tensor:ident| $positive:expr)?) => {
        $(#[$documentation])*
        ///
        /// The field is open because formulas fill it; [`new`](Self::new), [`from_rows`](Self::from_rows) and
        /// [`from_matrix`](Self::from_matrix) check what comes from outside. Written as its components 11, 22, 33, 12, 23, 13.
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[cfg_attr(feature = "serde", serde(
            try_from = "[T; 6]",
            into = "[T; 6]",
            bound(
                serialize = "T: piola_numerics::Real + serde::Serialize",
                deserialize = "T: piola_numerics::Real + serde::Deserialize<'de>"
            )
        ))]
        #[repr(transparent)]
        pub struct $name<T = f64>(
            /// The components.
            pub $crate::Symmetric<T>,
        );

        impl<T: piola_numerics::Real> $name<T> {
            /// From the components 11, 22, 33, 12, 23, 13; shears not doubled.
            ///
            /// # Errors
            /// [`ContinuumError::NotFinite`](crate::ContinuumError::NotFinite), in any lane.
            $(
            #[doc = concat!("[`TensorError::NotPositiveDefinite`](piola_tensor::TensorError::NotPositiveDefinite) when ",
                $metric, " has a negative leading minor, beyond rounding.")]
            )?
            pub fn new(xx: T, yy: T, zz: T, xy: T, yz: T, xz: T) -> Result<Self, $crate::ContinuumError> {
                Self::try_from([xx, yy, zz, xy, yz, xz])
            }

            /// From an array of rows that is symmetric to rounding.
            ///
            /// # Errors
            /// As [`new`](Self::new), and [`TensorError::NotSymmetric`](piola_tensor::TensorError::NotSymmetric) when
            /// opposite entries differ by more than 32 ulp of the largest.
            pub fn from_rows(rows: piola_tensor::internal::rows::Rows<T>) -> Result<Self, $crate::ContinuumError> {
                Self::try_from($crate::Symmetric::of_quantity($quantity, rows)?.components)
            }

            /// From a matrix that is symmetric to rounding.
            ///
            /// # Errors
            /// As [`from_rows`](Self::from_rows).
            pub fn from_matrix(matrix: &nalgebra::Matrix3<T>) -> Result<Self, $crate::ContinuumError> {
                Self::from_rows(piola_numerics::linear::matrix3::rows_of(matrix))
            }

            /// All nine components as an array of rows.
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[must_use]
            pub fn rows(&self) -> piola_tensor::internal::rows::Rows<T> {
                self.0.rows()
            }

            /// All nine components as a matrix.
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[must_use]
            pub fn matrix(&self) -> nalgebra::Matrix3<T> {
                self.0.matrix()
            }

            /// f of the components of two.
            #[allow(dead_code, reason = "measures whose differences are none lack operators")]
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn each(a: &Self, b: &Self, f: impl Fn(T, T) -> T) -> Self {
                Self($crate::Symmetric::each(&a.0, &b.0, f))
            }
        }

        /// The components 11, 22, 33, 12, 23, 13, checked as by `new`.
        impl<T: piola_numerics::Real> TryFrom<[T; 6]> for $name<T> {
            type Error = $crate::ContinuumError;
            fn try_from(components: [T; 6]) -> Result<Self, Self::Error> {
                $crate::error::check_finite($quantity, &components)?;
                $(
                let $tensor = $crate::Symmetric { components };
                piola_tensor::internal::positive_definite($metric, &$positive)?;
                )?
                Ok(Self($crate::Symmetric { components }))
            }
        }

        /// The components 11, 22, 33, 12, 23, 13.
        impl<T: piola_numerics::Real> From<$name<T>> for [T; 6] {
            fn from(measure: $name<T>) -> Self {
                measure.0.components
            }
        }

        $crate::measures::shown_by_rows!($name);
        #[cfg(feature = "glam")]
        piola_tensor::internal::glam_matrices!($name, $crate::ContinuumError, |measure| measure.rows());
    };
}

/// A type around a general 3×3 tensor.
macro_rules! general_measure {
    ($(#[$documentation:meta])* $name:ident, $quantity:literal) => {
        $(#[$documentation])*
        ///
        /// The field is open because formulas fill it; [`new`](Self::new) and [`from_rows`](Self::from_rows) check what
        /// comes from outside. Written by rows.
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[cfg_attr(feature = "serde", serde(
            try_from = "[[T; 3]; 3]",
            into = "[[T; 3]; 3]",
            bound(
                serialize = "T: piola_numerics::Real + serde::Serialize",
                deserialize = "T: piola_numerics::Real + serde::Deserialize<'de>"
            )
        ))]
        #[repr(transparent)]
        pub struct $name<T = f64>(
            /// The components.
            pub nalgebra::Matrix3<T>,
        );

        impl<T: piola_numerics::Real> $name<T> {
            /// From a matrix.
            ///
            /// # Errors
            /// [`ContinuumError::NotFinite`](crate::ContinuumError::NotFinite), in any lane.
            pub fn new(matrix: nalgebra::Matrix3<T>) -> Result<Self, $crate::ContinuumError> {
                Self::from_rows(piola_numerics::linear::matrix3::rows_of(&matrix))
            }

            /// From an array of rows.
            ///
            /// # Errors
            /// As [`new`](Self::new).
            pub fn from_rows(rows: piola_tensor::internal::rows::Rows<T>) -> Result<Self, $crate::ContinuumError> {
                $crate::error::check_finite($quantity, rows.as_flattened())?;
                Ok(Self::trusted(rows))
            }

            /// From rows that a formula has computed.
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[doc(hidden)]
            pub fn trusted(rows: piola_tensor::internal::rows::Rows<T>) -> Self {
                Self(piola_numerics::linear::matrix3::from_rows(rows))
            }

            /// All nine components as an array of rows.
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[must_use]
            pub fn rows(&self) -> piola_tensor::internal::rows::Rows<T> {
                piola_numerics::linear::matrix3::rows_of(&self.0)
            }

            /// All nine components as a matrix.
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[must_use]
            pub fn matrix(&self) -> nalgebra::Matrix3<T> {
                piola_numerics::linear::matrix3::from_rows(self.rows())
            }

            /// f of the components of two.
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn each(a: &Self, b: &Self, f: impl Fn(T, T) -> T) -> Self {
                let (a, b) = (a.rows(), b.rows());
                let row = |i: usize| [f(a[i][0], b[i][0]), f(a[i][1], b[i][1]), f(a[i][2], b[i][2])];
                Self::trusted([row(0), row(1), row(2)])
            }
        }

        /// From rows, checked.
        impl<T: piola_numerics::Real> TryFrom<piola_tensor::internal::rows::Rows<T>> for $name<T> {
            type Error = $crate::ContinuumError;
            fn try_from(rows: piola_tensor::internal::rows::Rows<T>) -> Result<Self, Self::Error> {
                Self::from_rows(rows)
            }
        }
        impl<T: piola_numerics::Real> From<$name<T>> for piola_tensor::internal::rows::Rows<T> {
            fn from(measure: $name<T>) -> Self {
                measure.rows()
            }
        }

        $crate::measures::linear_measure!($name, nalgebra::Matrix3::from_element(T::zero()));
        $crate::measures::shown_by_rows!($name);
        #[cfg(feature = "glam")]
        piola_tensor::internal::glam_matrices!($name, $crate::ContinuumError, |measure| measure.rows());
    };
}

/// Sums and multiples of a symmetric or general measure.
macro_rules! linear_measure {
    ($($name:ident)*) => { $(
        $crate::measures::linear_measure!($name, $crate::Symmetric::zero());
    )* };
    ($name:ident, $zero:expr) => {
        impl<T: piola_numerics::Real> $name<T> {
            /// 0.
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[must_use]
            pub fn zero() -> Self {
                Self($zero)
            }
        }
        piola_tensor::internal::linear_space!($name);
    };
}

/// The rows, in brackets; a precision is that of each component.
macro_rules! shown_by_rows {
    ($name:ident) => {
        /// The rows, in brackets; a precision is that of each component.
        impl<T: piola_numerics::Real + core::fmt::Display> core::fmt::Display for $name<T> {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                piola_tensor::internal::write_rows(&self.rows(), f)
            }
        }
    };
}

pub(crate) use skew::skew_measure;
pub(crate) use {general_measure, linear_measure, shown_by_rows, symmetric_measure};
