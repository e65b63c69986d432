//! Declares a law of a solid or fluid with plain parameters: checked constructor, getters, validated serde.

/// Declares a law: the error of its crate, then each parameter with its documentation, its bound as text and as a condition.
///
/// `$field as "old"` is also found by, and read from, an older or shorter name; data that need no check follow after `with`.
#[doc(hidden)]
#[macro_export]
#[expect(clippy::crate_in_macro_def, reason = "the checks are those of the crate whose law it is")]
macro_rules! parameters {
    (
        $error:ident;
        $(#[$documentation:meta])*
        pub struct $name:ident($law:literal) {
            $($(#[$about:meta])* $field:ident $(as $old:literal)?: $bound:literal => $holds:expr),+ $(,)?
        }
        $(with { $($(#[$about_datum:meta])* $datum:ident: $type:ty),+ $(,)? })?
    ) => {
        $(#[$documentation])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize))]
        pub struct $name {
            $($field: f64,)+
            $($($datum: $type,)+)?
        }

        impl $name {
            /// The law's name in errors.
            pub const NAME: &'static str = $law;

            /// From the parameters, within the bounds of the table.
            ///
            /// # Errors
            #[doc = concat!("[`", stringify!($error), "::NotFinite`](crate::", stringify!($error), "::NotFinite),")]
            #[doc = concat!("[`", stringify!($error), "::OutOfBounds`](crate::", stringify!($error), "::OutOfBounds).")]
            pub fn new($($field: f64,)+ $($($datum: $type,)+)?) -> Result<Self, crate::$error> {
                $(crate::error::check_finite($law, stringify!($field), $field)?;)+
                $(crate::error::check_bound($law, stringify!($field), $field, $bound, $holds)?;)+
                Ok(Self { $($field,)+ $($($datum,)+)? })
            }

            $($(#[$about])*
            $(#[doc(alias = $old)])?
            #[must_use]
            pub const fn $field(&self) -> f64 {
                self.$field
            })+

            $($($(#[$about_datum])*
            #[must_use]
            pub const fn $datum(&self) -> $type {
                self.$datum
            })+)?
        }

        #[cfg(feature = "serde")]
        impl<'de> serde::Deserialize<'de> for $name {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                /// The parameters as they are written.
                #[derive(serde::Deserialize)]
                #[serde(deny_unknown_fields)]
                struct Written {
                    $($(#[serde(alias = $old)])? $field: f64,)+
                    $($($datum: $type,)+)?
                }
                let written = Written::deserialize(deserializer)?;
                Self::new($(written.$field,)+ $($(written.$datum,)+)?).map_err(serde::de::Error::custom)
            }
        }
    };
}
