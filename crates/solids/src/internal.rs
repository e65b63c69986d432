//! Functions for Piola's other crates only.

pub use crate::internal_constraints::orthogonal::{outside_of_columns, rank_of_columns};
pub use crate::isochoric::arruda_boyce::arruda_boyce;
pub use crate::isochoric::gent::gent;
pub use crate::isochoric::mooney_rivlin::mooney_rivlin;
pub use crate::isochoric::neo_hookean::neo_hookean;
pub use crate::isochoric::rivlin::rivlin_term;
pub use crate::isochoric::yeoh::yeoh;
pub use crate::isochoric_factor::Unimodular;
pub use crate::ogden::terms::ogden_term;
/// Parts of stress and tangent, for laws whose answers are put together elsewhere.
pub mod composition {
    pub use crate::invariant::kinematics::InvariantKinematics;
    pub use crate::invariant::straight::square;
    pub use crate::invariant::tangent::sum_of_terms;
    pub use crate::stretch::frames::{composed, in_frames};
}
/// P and ∂P/∂F as numbers one after the other.
pub mod packed {
    pub use crate::packed::*;
}
pub use crate::strain_energy::{first_piola_numbers, inverse_metric};
pub use crate::stretch::isochoric::UnimodularDeformation;
