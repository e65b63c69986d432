//! What every fluid of numbers has: a checked constructor, getters, validated serde, and its parameters as a list for fits.

/// A fluid of `N` numbers whose shear stress is one formula of them and of the shear rate.
///
/// Fits evaluate it over differentiable parameters; the fluid's own [`shear_stress`](super::ViscometricFluid::shear_stress) is the same
/// function at its own.
pub trait Parameters<const N: usize>: Sized {
    /// The names of the parameters, in order.
    const NAMES: [&'static str; N];

    /// The parameters, in order.
    fn parameters(&self) -> [f64; N];

    /// From the parameters, in order, within their bounds.
    ///
    /// # Errors
    /// [`ConstitutiveError::NotFinite`](crate::ConstitutiveError::NotFinite),
    /// [`ConstitutiveError::OutOfBounds`](crate::ConstitutiveError::OutOfBounds).
    fn from_parameters(parameters: [f64; N]) -> Result<Self, crate::ConstitutiveError>;

    /// τ, Pa, of parameters that may carry derivatives, for 0 ≤ `shear_rate`, 1/s.
    fn shear_stress_of<T: piola_numerics::Real>(parameters: [T; N], shear_rate: T) -> T;
}

/// Declares a fluid of numbers: each parameter with its documentation, its bound as text and as a condition on all of them.
macro_rules! fluid_of_parameters {
    (
        $(#[$documentation:meta])*
        pub struct $name:ident($law:literal) {
            $($(#[$about:meta])* $field:ident: $bound:literal => $holds:expr),+ $(,)?
        }
    ) => {
        $(#[$documentation])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize))]
        pub struct $name {
            $($field: f64),+
        }

        impl $name {
            /// The fluid's name in errors.
            pub const NAME: &'static str = $law;

            /// From the parameters, within the bounds of the table.
            ///
            /// # Errors
            /// [`ConstitutiveError::NotFinite`](crate::ConstitutiveError::NotFinite),
            /// [`ConstitutiveError::OutOfBounds`](crate::ConstitutiveError::OutOfBounds).
            pub fn new($($field: f64),+) -> Result<Self, crate::ConstitutiveError> {
                $(crate::error::check_bound($law, stringify!($field), $field, $bound, $holds)?;)+
                Ok(Self { $($field),+ })
            }

            $($(#[$about])*
            #[must_use]
            pub const fn $field(&self) -> f64 {
                self.$field
            })+
        }

        #[cfg(feature = "serde")]
        impl<'de> serde::Deserialize<'de> for $name {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                /// The parameters as they are written.
                #[derive(serde::Deserialize)]
                #[serde(deny_unknown_fields)]
                struct Written {
                    $($field: f64),+
                }
                let written = Written::deserialize(deserializer)?;
                Self::new($(written.$field),+).map_err(serde::de::Error::custom)
            }
        }
    };
}
pub(super) use fluid_of_parameters;
