//! The types of the measures of stress.

use nalgebra::Matrix3;

use crate::Symmetric;

macro_rules! symmetric_measure {
    ($(#[$documentation:meta])* $name:ident) => {
        $(#[$documentation])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[repr(transparent)]
        pub struct $name<T = f64>(
            /// The components.
            pub Symmetric<T>,
        );
    };
}

macro_rules! general_measure {
    ($(#[$documentation:meta])* $name:ident) => {
        $(#[$documentation])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[repr(transparent)]
        pub struct $name<T = f64>(
            /// The components, `(i, A)` at row i and column A.
            pub Matrix3<T>,
        );
    };
}

symmetric_measure! {
    /// Cauchy's stress T, Pa: force per area of the deformed body, W(16.4).
    CauchyStress
}
symmetric_measure! {
    /// Kirchhoff's stress τ = J T, Pa.
    KirchhoffStress
}
symmetric_measure! {
    /// The second Piola–Kirchhoff stress S = F⁻¹ P, Pa, B(4.57): components in the reference configuration.
    SecondPiola
}
general_measure! {
    /// The first Piola–Kirchhoff stress P = J T F⁻ᵀ, Pa, W(17.21): force per area of the reference body.
    FirstPiola
}
general_measure! {
    /// Biot's stress Rᵀ P, Pa; its symmetric part is conjugate to U.
    BiotStress
}
general_measure! {
    /// Mandel's stress C S, Pa.
    MandelStress
}
