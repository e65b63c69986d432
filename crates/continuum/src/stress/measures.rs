//! The types of the measures of stress.

use core::fmt;
use core::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

use nalgebra::Matrix3;
use piola_numerics::Real;
use piola_numerics::linear::matrix3::{from_rows, rows_of};

use crate::error::check_finite;
use crate::tensor::rows::{self, Rows};
use crate::{ContinuumError, Symmetric};

macro_rules! symmetric_measure {
    ($(#[$documentation:meta])* $name:ident, $quantity:literal) => {
        $(#[$documentation])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[cfg_attr(
            feature = "serde",
            serde(
                try_from = "[T; 6]",
                into = "[T; 6]",
                bound(serialize = "T: Real + serde::Serialize", deserialize = "T: Real + serde::Deserialize<'de>")
            )
        )]
        #[repr(transparent)]
        pub struct $name<T = f64>(
            /// The components.
            pub Symmetric<T>,
        );

        impl<T: Real> $name<T> {
            /// From the components 11, 22, 33, 12, 23, 13, Pa.
            ///
            /// # Errors
            /// [`ContinuumError::NotFinite`].
            pub fn new(xx: T, yy: T, zz: T, xy: T, yz: T, xz: T) -> Result<Self, ContinuumError> {
                Self::try_from([xx, yy, zz, xy, yz, xz])
            }

            /// From a matrix that is symmetric to rounding.
            ///
            /// # Errors
            /// [`ContinuumError::NotFinite`]; [`ContinuumError::NotSymmetric`], as
            /// [`Symmetric::from_matrix`].
            pub fn from_matrix(matrix: &Matrix3<T>) -> Result<Self, ContinuumError> {
                let named = |error| match error {
                    ContinuumError::NotFinite { index, value, .. } => {
                        ContinuumError::NotFinite { quantity: $quantity, index, value }
                    }
                    ContinuumError::NotSymmetric { row, column, difference, scale, .. } => {
                        ContinuumError::NotSymmetric { quantity: $quantity, row, column, difference, scale }
                    }
                    other => other,
                };
                Symmetric::from_matrix(matrix).map(Self).map_err(named)
            }

            /// All nine components as an array of rows.
            #[inline(always)]
            #[must_use]
            pub fn rows(&self) -> Rows<T> {
                self.0.rows()
            }
        }

        /// The components 11, 22, 33, 12, 23, 13.
        impl<T: Real> TryFrom<[T; 6]> for $name<T> {
            type Error = ContinuumError;
            fn try_from(components: [T; 6]) -> Result<Self, ContinuumError> {
                check_finite($quantity, &components)?;
                Ok(Self(Symmetric { components }))
            }
        }
        /// The components 11, 22, 33, 12, 23, 13.
        impl<T: Real> From<$name<T>> for [T; 6] {
            fn from(stress: $name<T>) -> Self {
                stress.0.components
            }
        }

        operations!($name, Symmetric::zero(), |a, b| a + b, |a, b| a - b, |a| -a, |a, s| a * s, |a, s| a / s);
    };
}

macro_rules! general_measure {
    ($(#[$documentation:meta])* $name:ident, $quantity:literal) => {
        $(#[$documentation])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[cfg_attr(
            feature = "serde",
            serde(
                try_from = "[[T; 3]; 3]",
                into = "[[T; 3]; 3]",
                bound(serialize = "T: Real + serde::Serialize", deserialize = "T: Real + serde::Deserialize<'de>")
            )
        )]
        #[repr(transparent)]
        pub struct $name<T = f64>(
            /// The components, `(i, A)` at row i and column A.
            pub Matrix3<T>,
        );

        impl<T: Real> $name<T> {
            /// From a matrix, Pa.
            ///
            /// # Errors
            /// [`ContinuumError::NotFinite`].
            pub fn new(matrix: Matrix3<T>) -> Result<Self, ContinuumError> {
                Self::try_from(rows_of(&matrix))
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
                check_finite($quantity, rows.as_flattened())?;
                Ok(Self::from_rows(rows))
            }
        }
        impl<T: Real> From<$name<T>> for Rows<T> {
            fn from(stress: $name<T>) -> Self {
                stress.rows()
            }
        }

        operations!(
            $name,
            Matrix3::from_element(T::zero()),
            |a, b| from_rows(rows::sum(rows_of(&a), rows_of(&b))),
            |a, b| from_rows(rows::difference(rows_of(&a), rows_of(&b))),
            |a| from_rows(rows::scaled(rows_of(&a), -T::one())),
            |a, s| from_rows(rows::scaled(rows_of(&a), s)),
            |a, s| from_rows(rows_of(&a).map(|row| row.map(|component| component / s)))
        );
    };
}

macro_rules! operations {
    ($name:ident, $zero:expr, |$a:ident, $b:ident| $sum:expr, |$c:ident, $d:ident| $difference:expr,
     |$e:ident| $negative:expr, |$f:ident, $s:ident| $scaled:expr, |$g:ident, $r:ident| $divided:expr) => {
        impl<T: Real> $name<T> {
            /// No stress.
            #[inline(always)]
            #[must_use]
            pub fn zero() -> Self {
                Self($zero)
            }

            /// All nine components as a matrix, Pa.
            #[inline(always)]
            #[must_use]
            pub fn matrix(&self) -> Matrix3<T> {
                from_rows(self.rows())
            }
        }
        impl<T: Real> Default for $name<T> {
            fn default() -> Self {
                Self::zero()
            }
        }
        impl<T: Real> Add for $name<T> {
            type Output = Self;
            #[inline(always)]
            fn add(self, other: Self) -> Self {
                let ($a, $b) = (self.0, other.0);
                Self($sum)
            }
        }
        impl<T: Real> Sub for $name<T> {
            type Output = Self;
            #[inline(always)]
            fn sub(self, other: Self) -> Self {
                let ($c, $d) = (self.0, other.0);
                Self($difference)
            }
        }
        impl<T: Real> AddAssign for $name<T> {
            #[inline(always)]
            fn add_assign(&mut self, other: Self) {
                *self = *self + other;
            }
        }
        impl<T: Real> SubAssign for $name<T> {
            #[inline(always)]
            fn sub_assign(&mut self, other: Self) {
                *self = *self - other;
            }
        }
        impl<T: Real> Neg for $name<T> {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                let $e = self.0;
                Self($negative)
            }
        }
        impl<T: Real> Mul<T> for $name<T> {
            type Output = Self;
            #[inline(always)]
            fn mul(self, factor: T) -> Self {
                let ($f, $s) = (self.0, factor);
                Self($scaled)
            }
        }
        impl<T: Real> MulAssign<T> for $name<T> {
            #[inline(always)]
            fn mul_assign(&mut self, factor: T) {
                *self = *self * factor;
            }
        }
        impl<T: Real> Div<T> for $name<T> {
            type Output = Self;
            #[inline(always)]
            fn div(self, divisor: T) -> Self {
                let ($g, $r) = (self.0, divisor);
                Self($divided)
            }
        }
        impl<T: Real> core::iter::Sum for $name<T> {
            fn sum<I: Iterator<Item = Self>>(stresses: I) -> Self {
                stresses.fold(Self::zero(), |sum, stress| sum + stress)
            }
        }
        /// The rows, in brackets; a precision is that of each component.
        impl<T: Real + fmt::Display> fmt::Display for $name<T> {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("[")?;
                for (i, row) in self.rows().iter().enumerate() {
                    f.write_str(if i == 0 { "[" } else { ", [" })?;
                    for (j, component) in row.iter().enumerate() {
                        f.write_str(if j == 0 { "" } else { ", " })?;
                        fmt::Display::fmt(component, f)?;
                    }
                    f.write_str("]")?;
                }
                f.write_str("]")
            }
        }
    };
}

symmetric_measure! {
    /// Cauchy's stress T, Pa: force per area of the deformed body.
    ///
    /// ```text
    /// t = T n,   T = Tᵀ
    /// ```
    /// Components refer to space on both sides. The field is open because constitutive formulas fill it;
    /// [`new`](Self::new) and [`from_matrix`](Self::from_matrix) check what comes from outside.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Matrix3;
    /// use piola_continuum::{CauchyStress, DeformationGradient};
    /// let bar = CauchyStress::new(8.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
    /// let stretch = DeformationGradient::new(Matrix3::from_diagonal(&[2.0, 0.5, 0.5].into()))?;
    /// // 8 Pa on a quarter of the area are 2 Pa on the area before the deformation.
    /// assert_eq!(bar.first_piola(&stretch).0[(0, 0)], 2.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    ///
    /// # Source
    /// W(16.4), W(17.34).
    CauchyStress, "Cauchy stress"
}
symmetric_measure! {
    /// Kirchhoff's stress τ = J T, Pa: Cauchy's stress weighed with the change of volume.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Matrix3;
    /// use piola_continuum::{CauchyStress, DeformationGradient, KirchhoffStress};
    /// let stretch = DeformationGradient::new(Matrix3::from_diagonal(&[2.0, 0.5, 0.5].into()))?;
    /// let kirchhoff = CauchyStress::new(8.0, 0.0, 0.0, 0.0, 0.0, 0.0)?.kirchhoff(&stretch);
    /// assert_eq!(kirchhoff, KirchhoffStress::new(4.0, 0.0, 0.0, 0.0, 0.0, 0.0)?); // J = 1/2
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    KirchhoffStress, "Kirchhoff stress"
}
symmetric_measure! {
    /// The second Piola–Kirchhoff stress S = F⁻¹ P, Pa: components in the reference configuration on both
    /// sides.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Matrix3;
    /// use piola_continuum::{DeformationGradient, SecondPiola};
    /// let stretch = DeformationGradient::new(Matrix3::from_diagonal(&[2.0, 0.5, 0.5].into()))?;
    /// let stress = SecondPiola::new(1.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
    /// assert_eq!(stress.cauchy(&stretch).0.components[0], 8.0); // 2 · 1 · 2 / J
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    ///
    /// # Source
    /// B(4.57).
    SecondPiola, "second Piola-Kirchhoff stress"
}
general_measure! {
    /// The first Piola–Kirchhoff stress P = J T F⁻ᵀ = T Cof F, Pa: force per area of the reference body.
    ///
    /// Rows refer to space, columns to the reference configuration; in general P is not symmetric, but
    /// P Fᵀ is, W(17.35): see [`moment_residual`](FirstPiola::moment_residual).
    ///
    /// # Example
    /// ```
    /// use nalgebra::Matrix3;
    /// use piola_continuum::{DeformationGradient, FirstPiola};
    /// let shear = DeformationGradient::new(Matrix3::new(1.0, 0.5, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0))?;
    /// let pull = FirstPiola::new(Matrix3::new(0.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0))?;
    /// assert_eq!(pull.moment_residual(&shear).z, 1.0); // this P turns the sheared body: it is no stress
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    ///
    /// # Source
    /// W(17.21), B(4.52).
    FirstPiola, "first Piola-Kirchhoff stress"
}
general_measure! {
    /// Biot's stress Rᵀ P, Pa: force per area of the reference body, turned back by the rotation R.
    ///
    /// Both sides refer to the reference configuration. It need not be symmetric; its
    /// [symmetric part](BiotStress::symmetric_part) is conjugate to U.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Matrix3;
    /// use piola_continuum::{BiotStress, FirstPiola};
    /// let turn = Matrix3::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
    /// // The traction (0, 3, 0) on the first face is (3, 0, 0) before the quarter turn.
    /// let first_piola = FirstPiola::new(Matrix3::new(0.0, 0.0, 0.0, 3.0, 0.0, 0.0, 0.0, 0.0, 0.0))?;
    /// let biot: BiotStress = first_piola.biot_of_rotation(&turn)?;
    /// assert_eq!(biot.0[(0, 0)], 3.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    BiotStress, "Biot stress"
}
general_measure! {
    /// Mandel's stress C S = Fᵀ P, Pa: conjugate to F⁻¹ Ḟ.
    ///
    /// Both sides refer to the reference configuration. It is symmetric only where C and S commute, as they
    /// do in an isotropic body.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Matrix3;
    /// use piola_continuum::{DeformationGradient, SecondPiola};
    /// let stretch = DeformationGradient::new(Matrix3::from_diagonal(&[2.0, 0.5, 0.5].into()))?;
    /// let mandel = SecondPiola::new(1.0, 0.0, 0.0, 0.0, 0.0, 0.0)?.mandel(&stretch);
    /// assert_eq!(mandel.0[(0, 0)], 4.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    MandelStress, "Mandel stress"
}
