//! What data say of a parameter.

/// What the data say of a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum State {
    /// They determine it.
    Determined,
    /// It is at a bound, or at zero where stability asks for a sign.
    AtBound,
    /// Its bounds leave one value: it is held there, not fitted.
    Held,
    /// They say nothing of it, or not of it alone, or not its order of magnitude.
    Undetermined,
    /// They fix it, but there are as many parameters as numbers: what remains says nothing of the error of any.
    NoDegreesOfFreedom,
}
