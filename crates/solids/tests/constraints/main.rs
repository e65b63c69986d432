//! Internal constraints.

mod reactions;
