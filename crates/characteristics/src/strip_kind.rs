//! The kinds of initial strip manifolds.

/// What an initial strip manifold is at a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum StripKind {
    /// The characteristic leaves the manifold: det(Φ_ξ, x_τ) ≠ 0.
    Transversal,
    /// Along a direction of the manifold it is a characteristic strip W(A.37).
    Characteristic,
    /// Along a direction of the manifold it is a Monge strip W(A.36) but not a characteristic one.
    Monge,
    /// The data do not determine ξ: Φ vanishes for all ξ that they allow.
    Undetermined,
    /// Φ_ξ = 0 to rounding: the characteristic stands still.
    Stationary,
    /// No ξ satisfies the data and the equation.
    NoCovector,
    /// ξ goes over from one root of Φ to another: det(Φ_ξ, x_τ) changes its sign without a zero.
    Jump,
}
