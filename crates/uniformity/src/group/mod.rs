//! Symmetry of the crystal: the nominal group and its Lie algebra.
//!
//! ```text
//! 𝒢 = {H : N(F H) = N(F) for all F}        𝔤 = {A : exp(tA) ∈ 𝒢 for all t}
//! ```
//!
//! | to | use |
//! |---|---|
//! | tell whether two maps K and K H describe one body | [`NominalGroup`] |
//! | choose among material connections | [`LieAlgebra`] |

mod algebra;
mod nominal;

pub use algebra::LieAlgebra;
pub use nominal::NominalGroup;
