//! How the types of strains are made: a symmetric tensor with its meaning, checked when it comes from outside.

/// A type that wraps a symmetric tensor and requires another one, made of it, to be positive definite.
macro_rules! symmetric_measure {
    ($(#[$documentation:meta])* $name:ident, $quantity:literal, $metric:literal, |$tensor:ident| $positive:expr) => {
        $(#[$documentation])*
        ///
        /// The field is open because formulas fill it; [`new`](Self::new) and [`from_matrix`](Self::from_matrix) check
        /// what comes from outside. Written as its components 11, 22, 33, 12, 23, 13.
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[cfg_attr(feature = "serde", serde(
            try_from = "[T; 6]",
            into = "[T; 6]",
            bound(serialize = "T: Real + serde::Serialize", deserialize = "T: Real + serde::Deserialize<'de>")
        ))]
        #[repr(transparent)]
        pub struct $name<T = f64>(
            /// The components.
            pub $crate::Symmetric<T>,
        );

        impl<T: Real> $name<T> {
            #[doc = concat!("From the components 11, 22, 33, 12, 23, 13; shears not doubled.")]
            ///
            /// # Errors
            #[doc = concat!("[`ContinuumError::NotFinite`](crate::ContinuumError::NotFinite); ",
                "[`ContinuumError::NotPositiveDefinite`](crate::ContinuumError::NotPositiveDefinite) when ", $metric,
                " has a negative leading minor, beyond rounding.")]
            pub fn new(xx: T, yy: T, zz: T, xy: T, yz: T, xz: T) -> Result<Self, $crate::ContinuumError> {
                Self::try_from([xx, yy, zz, xy, yz, xz])
            }

            /// From a matrix that is symmetric to rounding.
            ///
            /// # Errors
            /// As [`new`](Self::new), and [`ContinuumError::NotSymmetric`](crate::ContinuumError::NotSymmetric).
            pub fn from_matrix(matrix: &nalgebra::Matrix3<T>) -> Result<Self, $crate::ContinuumError> {
                Self::try_from($crate::strain::check::symmetric($quantity, matrix)?)
            }

            /// All nine components as an array of rows.
            #[inline(always)]
            #[must_use]
            pub fn rows(&self) -> $crate::tensor::rows::Rows<T> {
                self.0.rows()
            }

            /// All nine components as a matrix.
            #[inline(always)]
            #[must_use]
            pub fn matrix(&self) -> nalgebra::Matrix3<T> {
                self.0.matrix()
            }
        }

        impl<T: Real> TryFrom<[T; 6]> for $name<T> {
            type Error = $crate::ContinuumError;
            fn try_from(components: [T; 6]) -> Result<Self, Self::Error> {
                $crate::error::check_finite($quantity, &components)?;
                let $tensor = $crate::Symmetric { components };
                $crate::strain::check::positive_definite($metric, &$positive)?;
                Ok(Self($tensor))
            }
        }

        impl<T: Real> From<$name<T>> for [T; 6] {
            fn from(measure: $name<T>) -> Self {
                measure.0.components
            }
        }
    };
}

pub(super) use symmetric_measure;
