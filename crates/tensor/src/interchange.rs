//! Tensors as text and in glam's types.

use crate::rows::Rows;

/// Conversions to and from glam's matrices, checked on the way in: entry (i, j) stays entry (i, j).
#[doc(hidden)]
#[macro_export]
macro_rules! glam_matrices {
    ($name:ident, $error:ty, |$measure:ident| $rows:expr) => {
        $crate::glam_matrices!($name, $error, |$measure| $rows, f64, DMat3);
        $crate::glam_matrices!($name, $error, |$measure| $rows, f32, Mat3);
    };
    ($name:ident, $error:ty, |$measure:ident| $rows:expr, $scalar:ident, $matrix:ident) => {
        impl From<$name<$scalar>> for glam::$matrix {
            fn from($measure: $name<$scalar>) -> Self {
                Self::from_cols_array_2d(&$rows).transpose()
            }
        }
        impl TryFrom<glam::$matrix> for $name<$scalar> {
            type Error = $error;
            fn try_from(matrix: glam::$matrix) -> Result<Self, Self::Error> {
                Self::from_rows(matrix.transpose().to_cols_array_2d())
            }
        }
    };
}

/// Conversions to and from glam's vectors, checked on the way in.
#[doc(hidden)]
#[macro_export]
macro_rules! glam_vectors {
    ($name:ident, $error:ty, |$found:ident| $components:expr) => {
        $crate::glam_vectors!($name, $error, |$found| $components, f64, DVec3);
        $crate::glam_vectors!($name, $error, |$found| $components, f32, Vec3);
    };
    ($name:ident, $error:ty, |$found:ident| $components:expr, $scalar:ident, $vector:ident) => {
        impl From<$name<$scalar>> for glam::$vector {
            fn from($found: $name<$scalar>) -> Self {
                Self::from_array($components)
            }
        }
        impl TryFrom<glam::$vector> for $name<$scalar> {
            type Error = $error;
            fn try_from(vector: glam::$vector) -> Result<Self, Self::Error> {
                Self::try_from(vector.to_array())
            }
        }
    };
}

/// Writes the rows in brackets.
///
/// # Errors
/// Those of the formatter.
pub fn write_rows<T: core::fmt::Display>(rows: &Rows<T>, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
    f.write_str("[")?;
    for (i, row) in rows.iter().enumerate() {
        f.write_str(if i == 0 { "[" } else { ", [" })?;
        for (j, component) in row.iter().enumerate() {
            f.write_str(if j == 0 { "" } else { ", " })?;
            core::fmt::Display::fmt(component, f)?;
        }
        f.write_str("]")?;
    }
    f.write_str("]")
}
