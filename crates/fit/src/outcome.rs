//! How a fit ended.

/// How a fit ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum Outcome {
    /// Solved directly: all parameters are factors.
    LinearSolution,
    /// Nothing is left to be fitted.
    ExactFit,
    /// The residuals are orthogonal to what parameters can change.
    GradientZero,
    /// Neither the sum of squares nor the parameters change any more.
    NoFurtherDecrease,
    /// Not converged: the evaluations are used up.
    OutOfPatience,
    /// Not converged: stresses were not finite on the way.
    NotFinite,
    /// Not converged: the caller stopped the search.
    Interrupted,
    /// Not converged to a stable law: the data ask for less than no stiffness. Every factor is zero, at its bound.
    NoStiffness,
}

impl Outcome {
    /// Whether the parameters are at a minimum, and the law has some stiffness if the data ask for any.
    #[must_use]
    pub const fn is_converged(self) -> bool {
        !matches!(self, Self::OutOfPatience | Self::NotFinite | Self::Interrupted | Self::NoStiffness)
    }

    /// The outcome in words.
    #[must_use]
    pub const fn reason(self) -> &'static str {
        match self {
            Self::LinearSolution => "solved directly",
            Self::ExactFit => "the residuals are zero",
            Self::GradientZero => "the gradient is zero",
            Self::NoFurtherDecrease => "no further decrease",
            Self::OutOfPatience => "stopped: evaluations used up",
            Self::NotFinite => "stopped: stresses not finite",
            Self::Interrupted => "stopped: interrupted",
            Self::NoStiffness => "stopped: no stiffness, all factors at their bound 0",
        }
    }
}
