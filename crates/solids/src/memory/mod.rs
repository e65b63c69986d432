//! Solids with memory: finite linear viscoelasticity, and simple materials as functionals of the history.
//!
//! ```text
//! S(t) = S_E(C(t)) + Σ gₖ hₖ(t)        hₖ(t) = ∫ exp(−(t − s)/τₖ) dS_D(C(s))/ds ds
//! T(t) = G(F(t − s), s ≥ 0)  W(18.1)    G(F^t) = R G(U^t) Rᵀ  W(18.11)
//! ```
//! | you have | use |
//! |---|---|
//! | a law of the solid at rest, one of the overstress, and a Prony series | [`Viscoelastic::new`] |
//! | a law of fast loading that relaxes by a Prony series | [`Viscoelastic::relaxing`] |
//! | a specimen of it with free sides or held forces | [`Viscoelastic::response`] with `piola_specimens::homogeneous::equilibrium` |
//! | any functional of histories | [`SimpleMaterial`]; of U-histories: [`Reduced`]; of an isotropic solid: [`IsotropicForm`] |

mod history;
mod prony;
mod response;
mod scaled;
mod viscoelastic;

pub use history::{
    History, IsotropicForm, Reduced, RelativeStretchHistory, Remembered, SimpleMaterial, StretchHistory,
};
pub use prony::{Prony, PronyStep, PronyTerm};
pub use response::ViscoelasticResponse;
pub use scaled::Scaled;
pub use viscoelastic::{Viscoelastic, ViscoelasticState};
