//! The requests of the library, and the macro that makes them.

mod derivatives;
mod kinematic;
mod rates;
mod spectral;
mod stresses;
mod tangents;

pub use derivatives::{HenckyDerivative, HenckySecondDerivative, hencky_derivative, hencky_second_derivative};
pub use kinematic::{
    GreenStrainOutput, Hencky, Jacobian, LeftCauchyGreenOutput, LeftStretch, PrincipalStretches,
    RightCauchyGreenOutput, RightStretch, Rotation, SpatialHencky, green_strain, hencky, jacobian, left_cauchy_green,
    left_stretch, principal_stretches, right_cauchy_green, right_stretch, rotation, spatial_hencky,
};
pub use rates::{
    HenckyRate, RateOfDeformationOutput, VelocityGradientOutput, hencky_rate, rate_of_deformation, velocity_gradient,
};
pub use spectral::{Eigenpairs, eigenpairs};
pub use stresses::{
    CauchyToFirstPiola, CauchyToKirchhoff, CauchyToSecondPiola, FirstPiolaToCauchy, FirstPiolaToSecondPiola,
    KirchhoffToCauchy, SecondPiolaToCauchy, SecondPiolaToFirstPiola, VonMises, cauchy_to_first_piola,
    cauchy_to_kirchhoff, cauchy_to_second_piola, first_piola_to_cauchy, first_piola_to_second_piola,
    kirchhoff_to_cauchy, second_piola_to_cauchy, second_piola_to_first_piola, von_mises,
};
pub use tangents::{
    FirstPiolaTangentOutput, JaumannTangentOutput, PushForwardTangent, TruesdellTangentOutput, first_piola_tangent,
    jaumann_tangent, push_forward_tangent, truesdell_tangent,
};

/// Functions that make requests, with their quantities.
///
/// ```text
/// /// What it is, with its formula.
/// function(source, …) Name: Input [I] => Output [K], "what the input is", |point, input| value;
/// ```
/// `stretches` before the closure says that the value is computed from the analysis of the stretches; braces behind the
/// closure hold further items of the quantity.
macro_rules! quantity {
    ($($(#[$documentation:meta])* $function:ident($($argument:ident: $generic:ident),*)
        $name:ident: $input:ty [$i:literal] => $output:ty [$k:literal], $what:literal,
        $($stretches:ident)? |$point:pat_param, $given:pat_param| $value:expr $(, { $($more:item)* })?;)*) => { $(
        $(#[$documentation])*
        #[must_use]
        pub fn $function<$($generic,)* V>($($argument: $generic,)* to: V)
            -> $crate::Request<$name, $crate::requests::joined!(type $($generic)*), V, $i, $k>
        {
            $crate::Request::new($name, $crate::requests::joined!($($argument)*), to)
        }

        #[doc = concat!("The quantity of [`", stringify!($function), "`].")]
        #[derive(Clone, Copy, Debug)]
        pub struct $name;

        impl $crate::Quantity<$i, $k> for $name {
            type Input = $input;
            type Output = $output;
            const NEEDS_STRETCH: bool = $crate::requests::needed!($($stretches)?);
            const INPUT: &'static str = $what;

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn of<T: piola_numerics::Real, D: piola_continuum::Deformation<T>>(
                &self,
                $point: &$crate::Point<T, D>,
                $given: [T; $i],
            ) -> [T; $k] {
                $value
            }

            $($($more)*)?
        }
    )* };
}

/// No source, one, or several side by side.
macro_rules! joined {
    ($(type)?) => { () };
    (type $one:ident) => { $one };
    (type $($several:ident)+) => { ($($several),+) };
    ($one:ident) => { $one };
    ($($several:ident)+) => { ($($several),+) };
}

macro_rules! needed {
    () => {
        false
    };
    (stretches) => {
        true
    };
}

use {joined, needed, quantity};
