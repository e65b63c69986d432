//! Ends of runs.

/// How a run ended.
///
/// # Example
/// See [`simulate`](crate::motion::simulate).
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Outcome {
    /// The end was reached.
    Completed,
    /// The observer stopped it.
    Interrupted,
    /// The run failed for this reason.
    Failed(String),
}
