//! Laws made of laws: sums, which are networks in parallel, shares, and a shape with a volume.

mod decoupled;
mod sum;
mod volume;

pub use decoupled::Decoupled;
pub use piola_solids::memory::Scaled;
pub use sum::Sum;
pub use volume::OfVolume;
