//! An integral with an error bound.

/// An integral with a bound of its error.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Integral<T = f64> {
    /// Its value.
    pub value: T,
    /// A bound of the modulus of the error of any component, estimated from a coarser rule.
    pub bound: f64,
    /// Evaluations of the integrand.
    pub evaluations: usize,
}
