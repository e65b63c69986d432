//! What can be wrong with an expression.

/// A condition that the nodes of an expression violate.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ExpressionError {
    /// A list of the wrong length.
    #[error("`{quantity}` has length {found}; length {expected} is needed")]
    WrongLength {
        /// The name of the list.
        quantity: &'static str,
        /// The length needed.
        expected: usize,
        /// The length found.
        found: usize,
    },
    /// An infinite or NaN number.
    #[error("component {index} of `{quantity}` is {value}; it must be finite")]
    NotFinite {
        /// The name of the quantity.
        quantity: &'static str,
        /// The index of the node.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// A node takes one that does not stand before it, or that another node takes.
    #[error("node {node} of an expression takes node {operand}, which must stand before it and be taken once")]
    ExpressionOrder {
        /// The index of the node.
        node: usize,
        /// The index that it takes.
        operand: usize,
    },
    /// An expression of more levels than an evaluation follows.
    #[error("an expression has {depth} levels; at most {most} are allowed")]
    ExpressionTooDeep {
        /// The number of levels.
        depth: usize,
        /// The largest number allowed, [`DEEPEST_EXPRESSION`](crate::DEEPEST_EXPRESSION).
        most: usize,
    },
}
