//! Results that are kept from one call to the next: what no joint changed is not computed again.

mod changes;
mod counts;
mod dynamics;
mod mass_matrix;

pub use counts::DynamicsCounts;
pub use dynamics::KeptDynamics;
pub use mass_matrix::{KeptMassMatrix, UpdateCounts};
