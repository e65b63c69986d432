//! How the types of rates are made: a general tensor, a symmetric one, or a skew one with its axial vector.

/// A type that wraps a general 3×3 matrix.
macro_rules! general_rate {
    ($(#[$documentation:meta])* $name:ident, $quantity:literal) => {
        $(#[$documentation])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[cfg_attr(feature = "serde", serde(
            try_from = "[[T; 3]; 3]",
            into = "[[T; 3]; 3]",
            bound(serialize = "T: Real + serde::Serialize", deserialize = "T: Real + serde::Deserialize<'de>")
        ))]
        #[repr(transparent)]
        pub struct $name<T = f64>(
            /// The components.
            pub Matrix3<T>,
        );

        impl<T: Real> $name<T> {
            /// From a matrix.
            ///
            /// # Errors
            /// [`ContinuumError::NotFinite`], in any lane.
            pub fn new(matrix: Matrix3<T>) -> Result<Self, ContinuumError> {
                check_finite($quantity, rows_of(&matrix).as_flattened())?;
                Ok(Self(matrix))
            }

            /// From an array of rows that a kernel has computed.
            #[inline(always)]
            #[must_use]
            pub fn from_rows(rows: Rows<T>) -> Self {
                Self(from_rows(rows))
            }

            /// All nine components as an array of rows.
            #[inline(always)]
            #[must_use]
            pub fn rows(&self) -> Rows<T> {
                rows_of(&self.0)
            }
        }

        impl<T: Real> TryFrom<Rows<T>> for $name<T> {
            type Error = ContinuumError;
            fn try_from(rows: Rows<T>) -> Result<Self, ContinuumError> {
                Self::new(from_rows(rows))
            }
        }
        impl<T: Real> From<$name<T>> for Rows<T> {
            fn from(rate: $name<T>) -> Self {
                rate.rows()
            }
        }

        #[cfg(feature = "glam")]
        impl TryFrom<glam::DMat3> for $name<f64> {
            type Error = ContinuumError;
            fn try_from(matrix: glam::DMat3) -> Result<Self, ContinuumError> {
                Self::try_from(matrix.transpose().to_cols_array_2d())
            }
        }
        #[cfg(feature = "glam")]
        impl From<$name<f64>> for glam::DMat3 {
            fn from(rate: $name<f64>) -> Self {
                Self::from_cols_array_2d(&rate.rows()).transpose()
            }
        }
        #[cfg(feature = "glam")]
        impl TryFrom<glam::Mat3> for $name<f32> {
            type Error = ContinuumError;
            fn try_from(matrix: glam::Mat3) -> Result<Self, ContinuumError> {
                Self::try_from(matrix.transpose().to_cols_array_2d())
            }
        }
        #[cfg(feature = "glam")]
        impl From<$name<f32>> for glam::Mat3 {
            fn from(rate: $name<f32>) -> Self {
                Self::from_cols_array_2d(&rate.rows()).transpose()
            }
        }
    };
}

/// A type that wraps a symmetric tensor.
macro_rules! symmetric_rate {
    ($(#[$documentation:meta])* $name:ident, $quantity:literal) => {
        $(#[$documentation])*
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
            pub Symmetric<T>,
        );

        impl<T: Real> $name<T> {
            /// From the components 11, 22, 33, 12, 23, 13.
            ///
            /// # Errors
            /// [`ContinuumError::NotFinite`], in any lane.
            pub fn new(xx: T, yy: T, zz: T, xy: T, yz: T, xz: T) -> Result<Self, ContinuumError> {
                Self::try_from([xx, yy, zz, xy, yz, xz])
            }

            /// All nine components as an array of rows.
            #[inline(always)]
            #[must_use]
            pub fn rows(&self) -> Rows<T> {
                self.0.rows()
            }

            /// All nine components as a matrix.
            #[inline(always)]
            #[must_use]
            pub fn matrix(&self) -> Matrix3<T> {
                self.0.matrix()
            }
        }

        impl<T: Real> TryFrom<[T; 6]> for $name<T> {
            type Error = ContinuumError;
            fn try_from(components: [T; 6]) -> Result<Self, ContinuumError> {
                check_finite($quantity, &components)?;
                Ok(Self(Symmetric { components }))
            }
        }
        impl<T: Real> From<$name<T>> for [T; 6] {
            fn from(rate: $name<T>) -> Self {
                rate.0.components
            }
        }
    };
}

/// A type that wraps a skew tensor by its axial vector ω: Ω v = ω × v.
macro_rules! skew_rate {
    ($(#[$documentation:meta])* $name:ident, $quantity:literal) => {
        $(#[$documentation])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[cfg_attr(feature = "serde", serde(
            try_from = "[T; 3]",
            into = "[T; 3]",
            bound(serialize = "T: Real + serde::Serialize", deserialize = "T: Real + serde::Deserialize<'de>")
        ))]
        #[repr(transparent)]
        pub struct $name<T = f64> {
            /// The axial vector ω, with Ω v = ω × v.
            pub axial: Vector3<T>,
        }

        impl<T: Real> $name<T> {
            /// From the axial vector ω, 1/s.
            ///
            /// # Errors
            /// [`ContinuumError::NotFinite`], in any lane.
            pub fn new(axial: Vector3<T>) -> Result<Self, ContinuumError> {
                Self::try_from([axial[0], axial[1], axial[2]])
            }

            /// The skew tensor Ω as a matrix.
            #[inline(always)]
            #[must_use]
            pub fn matrix(&self) -> Matrix3<T> {
                from_rows(self.rows())
            }

            /// The skew tensor Ω as an array of rows.
            #[inline(always)]
            #[must_use]
            pub fn rows(&self) -> Rows<T> {
                skew_of_axial([self.axial[0], self.axial[1], self.axial[2]])
            }

            /// From an axial vector that a kernel has computed.
            #[inline(always)]
            #[must_use]
            pub fn of_axial(axial: [T; 3]) -> Self {
                Self { axial: Vector3::new(axial[0], axial[1], axial[2]) }
            }
        }

        impl<T: Real> TryFrom<[T; 3]> for $name<T> {
            type Error = ContinuumError;
            fn try_from(axial: [T; 3]) -> Result<Self, ContinuumError> {
                check_finite($quantity, &axial)?;
                Ok(Self::of_axial(axial))
            }
        }
        impl<T: Real> From<$name<T>> for [T; 3] {
            fn from(spin: $name<T>) -> Self {
                [spin.axial[0], spin.axial[1], spin.axial[2]]
            }
        }

        #[cfg(feature = "glam")]
        impl From<$name<f64>> for glam::DVec3 {
            /// The axial vector.
            fn from(spin: $name<f64>) -> Self {
                Self::new(spin.axial[0], spin.axial[1], spin.axial[2])
            }
        }
        #[cfg(feature = "glam")]
        impl From<$name<f32>> for glam::Vec3 {
            /// The axial vector.
            fn from(spin: $name<f32>) -> Self {
                Self::new(spin.axial[0], spin.axial[1], spin.axial[2])
            }
        }
    };
}

pub(super) use {general_rate, skew_rate, symmetric_rate};
