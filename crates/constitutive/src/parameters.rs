//! What every law of a solid or fluid with plain parameters has: a checked constructor, getters and validated serde.

/// Declares a law of numbers: each parameter with its documentation, its bound as text and as a condition on all of them.
macro_rules! parameters {
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
            /// The law's name in errors.
            pub const NAME: &'static str = $law;

            /// From the parameters, within the bounds of the table.
            ///
            /// # Errors
            /// [`ConstitutiveError::NotFinite`](crate::ConstitutiveError::NotFinite),
            /// [`ConstitutiveError::OutOfBounds`](crate::ConstitutiveError::OutOfBounds).
            pub fn new($($field: f64),+) -> Result<Self, crate::ConstitutiveError> {
                $(crate::error::check_finite($law, stringify!($field), $field)?;)+
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
pub(crate) use parameters;
