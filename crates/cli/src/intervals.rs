//! Options of the intervals of fitted parameters.

use clap::Args;
use piola_measured::MeasuredError;
use piola_measured::fitting::Intervals;

/// How the intervals of parameters are found.
#[derive(Debug, Args)]
pub(crate) struct IntervalArguments {
    /// How intervals are found: linear; profile, where each parameter is moved and all others are fitted anew; bootstrap or bootstrap:N,
    /// where the law is fitted to N tables that it would have made with errors drawn from its residuals (1000 without N).
    #[arg(long = "intervals", value_name = "KIND", default_value = "linear", conflicts_with = "profile")]
    pub(crate) kind: String,
    /// The same as --intervals profile.
    #[arg(long)]
    pub(crate) profile: bool,
}

impl IntervalArguments {
    /// The kind.
    pub(crate) fn kind(&self) -> Result<Intervals, MeasuredError> {
        if self.profile { Ok(Intervals::Profile) } else { Ok(self.kind.parse()?) }
    }
}
