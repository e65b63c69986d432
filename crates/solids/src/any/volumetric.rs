//! Any of the built-in energies of the change of volume.

use piola_numerics::Real;

use crate::volumetric::{
    HartmannNeff, Lame, Liu, Logarithmic, Miehe, OgdenVolumetric, Quadratic, QuadraticLogarithmic, SimoTaylor,
    Volumetric,
};

/// Declares the enum of all parts, their conversions, and the dispatch.
macro_rules! any_volumetric {
    ($($(#[$about:meta])* $name:ident($part:ident)),+ $(,)?) => {
        /// Any of the built-in energies of the [change of volume](crate::volumetric), written with its name.
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[cfg_attr(feature = "serde", serde(tag = "law", rename_all = "snake_case"))]
        #[non_exhaustive]
        pub enum AnyVolumetric {
            $($(#[$about])* $name($part)),+
        }

        $(impl From<$part> for AnyVolumetric {
            fn from(part: $part) -> Self {
                Self::$name(part)
            }
        })+

        impl Volumetric for AnyVolumetric {
            const EITHER_SIGN: bool = true;

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn energy<T: Real>(&self, change: T, jacobian: T) -> T {
                match self { $(Self::$name(part) => part.energy(change, jacobian)),+ }
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn mean_kirchhoff<T: Real>(&self, change: T, jacobian: T) -> T {
                match self { $(Self::$name(part) => part.mean_kirchhoff(change, jacobian)),+ }
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn curvature<T: Real>(&self, change: T, jacobian: T) -> T {
                match self { $(Self::$name(part) => part.curvature(change, jacobian)),+ }
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn stiffness<T: Real>(&self, change: T, jacobian: T) -> T {
                match self { $(Self::$name(part) => part.stiffness(change, jacobian)),+ }
            }
        }
    };
}

any_volumetric! {
    /// ½ κ (J − 1)².
    Quadratic(Quadratic),
    /// ½ κ ln² J.
    Logarithmic(Logarithmic),
    /// ½ λ ln² J with λ of either sign.
    Lame(Lame),
    /// ¼ κ ((J − 1)² + ln² J).
    QuadraticLogarithmic(QuadraticLogarithmic),
    /// ¼ κ (J² − 1 − 2 ln J).
    SimoTaylor(SimoTaylor),
    /// κ (J ln J − J + 1).
    Liu(Liu),
    /// κ (J − 1 − ln J).
    Miehe(Miehe),
    /// κ β⁻² (J^(−β) − 1 + β ln J).
    Ogden(OgdenVolumetric),
    /// κ (J⁵ + J⁻⁵ − 2)/50.
    HartmannNeff(HartmannNeff),
}
