//! The static solution on a box: ours, by other transforms, by differences and conjugate gradients.
//!
//! | module | what |
//! |---|---|
//! | [`problem`] | a smooth displacement between sliding walls with its force |
//! | [`transforms`] | the same method with the transforms of other libraries, line by line |
//! | [`differences`] | differences on a staggered grid, solved by conjugate gradients |
//! | [`measure`] | time and true error of each, in one run |

pub mod differences;
pub mod measure;
pub mod problem;
pub mod transforms;
