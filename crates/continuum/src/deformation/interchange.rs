//! The gradients as arrays of rows and in glam's types, checked on the way in.

use piola_numerics::Real;
use piola_numerics::linear::matrix3::rows_of;

use super::{DeformationGradient, DisplacementGradient};

macro_rules! rows_of_gradients {
    ($($gradient:ident),*) => { $(
        impl<T: Real> TryFrom<[[T; 3]; 3]> for $gradient<T> {
            type Error = crate::ContinuumError;
            fn try_from(rows: [[T; 3]; 3]) -> Result<Self, Self::Error> {
                Self::from_rows(rows)
            }
        }
        impl<T: Real> From<$gradient<T>> for [[T; 3]; 3] {
            fn from(gradient: $gradient<T>) -> Self {
                rows_of(gradient.matrix())
            }
        }
    )* };
}
rows_of_gradients!(DeformationGradient, DisplacementGradient);

#[cfg(feature = "glam")]
piola_tensor::internal::glam_matrices!(DeformationGradient, crate::ContinuumError, |gradient| rows_of(
    gradient.matrix()
));
#[cfg(feature = "glam")]
piola_tensor::internal::glam_matrices!(DisplacementGradient, crate::ContinuumError, |gradient| rows_of(
    gradient.matrix()
));
