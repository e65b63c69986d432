//! Any of the built-in energies of the change of shape.

use piola_numerics::Real;

use crate::SolidsError;
use crate::isochoric::{ArrudaBoyce, ArrudaBoyceSeries, Gent, Isochoric, MooneyRivlin, NeoHookean, Rivlin, Yeoh};

/// Declares the enum of all parts, their conversions, and the dispatch.
macro_rules! any_isochoric {
    ($($(#[$about:meta])* $name:ident($part:ident)),+ $(,)?) => {
        /// Any of the built-in energies of the [change of shape](crate::isochoric), written with its name.
        ///
        /// Laws of Ī₁ alone are asked with Ī₂ too; [`AnySolid`](super::AnySolid) computes what the law needs.
        #[derive(Clone, Debug, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[cfg_attr(feature = "serde", serde(tag = "law", rename_all = "snake_case"))]
        #[non_exhaustive]
        pub enum AnyIsochoric {
            $($(#[$about])* $name($part)),+
        }

        $(impl From<$part> for AnyIsochoric {
            fn from(part: $part) -> Self {
                Self::$name(part)
            }
        })+

        impl Isochoric for AnyIsochoric {
            const SECOND: bool = true;
            const REFUSED_IS_NOT_FINITE: bool = true;

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn energy<T: Real>(&self, first: T, second: T) -> T {
                match self { $(Self::$name(part) => part.energy(first, second)),+ }
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn slopes<T: Real>(&self, first: T, second: T) -> [T; 2] {
                match self { $(Self::$name(part) => part.slopes(first, second)),+ }
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn curvatures<T: Real>(&self, first: T, second: T) -> [T; 3] {
                match self { $(Self::$name(part) => part.curvatures(first, second)),+ }
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn slopes_and_curvatures<T: Real>(&self, first: T, second: T) -> ([T; 2], [T; 3]) {
                match self { $(Self::$name(part) => part.slopes_and_curvatures(first, second)),+ }
            }
            fn check(&self, first: f64, second: f64) -> Result<(), SolidsError> {
                match self { $(Self::$name(part) => part.check(first, second)),+ }
            }
        }
    };
}

any_isochoric! {
    /// ½ μ (Ī₁ − 3).
    NeoHookean(NeoHookean),
    /// C₁₀ (Ī₁ − 3) + C₀₁ (Ī₂ − 3).
    MooneyRivlin(MooneyRivlin),
    /// Σ Cᵢ (Ī₁ − 3)ⁱ, i = 1, 2, 3.
    Yeoh(Yeoh),
    /// Σ Cᵢⱼ (Ī₁ − 3)ⁱ (Ī₂ − 3)ʲ.
    #[cfg_attr(feature = "serde", serde(with = "terms"))]
    Rivlin(Rivlin),
    /// −½ μ Jₘ ln(1 − (Ī₁ − 3)/Jₘ).
    Gent(Gent),
    /// Chains of N links.
    ArrudaBoyce(ArrudaBoyce),
    /// The first five terms of its series.
    ArrudaBoyceSeries(ArrudaBoyceSeries),
}

/// A series as it is written beside its name: a table with `terms`.
#[cfg(feature = "serde")]
mod terms {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    use super::Rivlin;
    use crate::isochoric::RivlinTerm;

    #[derive(Serialize, Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Written {
        terms: Vec<RivlinTerm>,
    }

    pub(super) fn serialize<S: Serializer>(law: &Rivlin, serializer: S) -> Result<S::Ok, S::Error> {
        Written { terms: law.terms().to_vec() }.serialize(serializer)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Rivlin, D::Error> {
        Rivlin::new(Written::deserialize(deserializer)?.terms).map_err(serde::de::Error::custom)
    }
}
