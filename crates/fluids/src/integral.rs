//! An integral with an error bound.

/// An integral and what is known of its error.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Integral<T = f64> {
    /// Its value.
    pub value: T,
    /// A bound of the modulus of the error of any component, estimated from a coarser rule.
    pub bound: f64,
    /// How often the integrand was evaluated.
    pub evaluations: usize,
}
