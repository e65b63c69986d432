//! The methods of the family, by their order.

use super::tableau::Tableau;
use super::tables::{FIVE, SEVEN, THREE};

/// A method of the family Radau IIA, by its order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum RadauOrder {
    /// Three stages.
    Five,
    /// Five stages.
    Nine,
    /// Seven stages.
    Thirteen,
}

impl RadauOrder {
    /// All of them, the lowest first.
    pub const ALL: [Self; 3] = [Self::Five, Self::Nine, Self::Thirteen];

    /// The order: 2s − 1 for s stages.
    #[must_use]
    pub const fn value(self) -> u32 {
        match self {
            Self::Five => 5,
            Self::Nine => 9,
            Self::Thirteen => 13,
        }
    }

    /// The coefficients.
    #[must_use]
    #[doc(hidden)]
    pub const fn tableau(self) -> &'static Tableau {
        match self {
            Self::Five => &THREE,
            Self::Nine => &FIVE,
            Self::Thirteen => &SEVEN,
        }
    }

    pub(super) const fn higher(self) -> Self {
        match self {
            Self::Five => Self::Nine,
            Self::Nine | Self::Thirteen => Self::Thirteen,
        }
    }

    pub(super) const fn lower(self) -> Self {
        match self {
            Self::Five | Self::Nine => Self::Five,
            Self::Thirteen => Self::Nine,
        }
    }
}
