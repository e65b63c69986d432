//! Checked constructor, getters and validated serde of a flow of numbers.

/// Declares a flow of numbers, each with its documentation, its bound as text and as a condition on all of them; then further numbers that may
/// be added. Every flow may slip at its walls.
macro_rules! flow_of_numbers {
    (
        $(#[$documentation:meta])*
        pub struct $name:ident($flow:literal) {
            $($(#[$about:meta])* $field:ident: $bound:literal => $holds:expr),+ $(,)?
        }
        $(also {
            $($(#[$added:meta])* $extra:ident: $kind:ty = $default:expr, $restored:expr);+ $(;)?
        })?
    ) => {
        $(#[$documentation])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize))]
        pub struct $name {
            $($field: f64,)+
            $($($extra: $kind,)+)?
            slip: crate::WallSlip,
        }

        impl $name {
            /// The flow's name in errors.
            pub const NAME: &'static str = $flow;

            /// From its numbers, within the bounds of the table.
            ///
            /// # Errors
            /// [`ViscometryError::NotFinite`](crate::ViscometryError::NotFinite),
            /// [`ViscometryError::OutOfBounds`](crate::ViscometryError::OutOfBounds).
            pub fn new($($field: f64),+) -> Result<Self, crate::ViscometryError> {
                $(crate::error::check_bound($flow, stringify!($field), $field, $bound, $holds)?;)+
                Ok(Self { $($field,)+ $($($extra: $default,)+)? slip: crate::WallSlip::NONE })
            }

            $($(#[$about])*
            #[must_use]
            pub const fn $field(&self) -> f64 {
                self.$field
            })+

            $($($(#[$added])*
            #[must_use]
            pub const fn $extra(&self) -> $kind {
                self.$extra
            })+)?

            /// Slip at the walls; none unless given.
            #[must_use]
            pub const fn slip(&self) -> crate::WallSlip {
                self.slip
            }

            /// With slip at the walls.
            #[must_use]
            pub const fn with_slip(mut self, slip: crate::WallSlip) -> Self {
                self.slip = slip;
                self
            }
        }

        #[cfg(feature = "serde")]
        impl<'de> serde::Deserialize<'de> for $name {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                /// The numbers as they are written.
                #[derive(serde::Deserialize)]
                #[serde(deny_unknown_fields)]
                struct Written {
                    $($field: f64,)+
                    $($($extra: Option<$kind>,)+)?
                    slip: Option<crate::WallSlip>,
                }
                let written = Written::deserialize(deserializer)?;
                let flow = Self::new($(written.$field),+).map_err(serde::de::Error::custom)?;
                $($(
                    let restore: fn(Self, $kind) -> Result<Self, crate::ViscometryError> = $restored;
                    let flow = match written.$extra {
                        Some(value) => restore(flow, value).map_err(serde::de::Error::custom)?,
                        None => flow,
                    };
                )+)?
                Ok(written.slip.map_or(flow, |slip| flow.with_slip(slip)))
            }
        }
    };
}
pub(super) use flow_of_numbers;
