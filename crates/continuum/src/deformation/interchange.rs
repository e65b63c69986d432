//! The gradients as arrays of rows and in glam's types, checked on the way in.

use piola_numerics::Real;
use piola_numerics::linear::matrix3::rows_of;

#[cfg(feature = "glam")]
macro_rules! glam_matrices {
    ($($gradient:ident<$float:ident> $matrix:ident),*) => { $(
        impl TryFrom<glam::$matrix> for super::$gradient<$float> {
            type Error = crate::ContinuumError;
            /// Row i and column j of the one are those of the other.
            fn try_from(matrix: glam::$matrix) -> Result<Self, Self::Error> {
                Self::from_rows(matrix.transpose().to_cols_array_2d())
            }
        }
        impl From<super::$gradient<$float>> for glam::$matrix {
            fn from(gradient: super::$gradient<$float>) -> Self {
                Self::from_cols_array_2d(&rows_of(gradient.matrix())).transpose()
            }
        }
    )* };
}
#[cfg(feature = "glam")]
glam_matrices!(
    DeformationGradient<f64> DMat3, DeformationGradient<f32> Mat3,
    DisplacementGradient<f64> DMat3, DisplacementGradient<f32> Mat3
);

macro_rules! rows_of_gradients {
    ($($gradient:ident),*) => { $(
        impl<T: Real> TryFrom<[[T; 3]; 3]> for super::$gradient<T> {
            type Error = crate::ContinuumError;
            fn try_from(rows: [[T; 3]; 3]) -> Result<Self, Self::Error> {
                Self::from_rows(rows)
            }
        }
        impl<T: Real> From<super::$gradient<T>> for [[T; 3]; 3] {
            fn from(gradient: super::$gradient<T>) -> Self {
                rows_of(gradient.matrix())
            }
        }
    )* };
}
rows_of_gradients!(DeformationGradient, DisplacementGradient);
