//! A part of an ensemble, for one of several machines.

use core::str::FromStr;

use crate::EnsembleError;

/// A part of an ensemble, for one of several machines: `2/8` are the members 1, 9, 17, …
///
/// # Example
/// ```
/// use piola_ensemble::Portion;
/// let part: Portion = "2/8".parse()?;
/// assert!(part.has(9) && !part.has(10));
/// assert!("9/8".parse::<Portion>().is_err());
/// # Ok::<(), piola_ensemble::EnsembleError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub struct Portion {
    /// Which, from 1.
    pub number: u64,
    /// Of how many.
    pub parts: u64,
}

impl Portion {
    /// All of it.
    pub const WHOLE: Self = Self { number: 1, parts: 1 };

    /// Whether a member belongs to it.
    #[must_use]
    pub const fn has(self, member: u64) -> bool {
        member % self.parts == self.number - 1
    }
}

impl FromStr for Portion {
    type Err = EnsembleError;

    fn from_str(text: &str) -> Result<Self, EnsembleError> {
        let parsed = text.split_once('/').and_then(|(number, parts)| {
            let (number, parts) = (number.trim().parse().ok()?, parts.trim().parse().ok()?);
            (1 <= number && number <= parts).then_some(Self { number, parts })
        });
        parsed.ok_or_else(|| EnsembleError::Argument {
            argument: format!("part {text}"),
            valid: "K/N with 1 ≤ K ≤ N, as 2/8",
        })
    }
}
