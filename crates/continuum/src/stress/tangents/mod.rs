//! Tangents: derivatives of stress, each a type of its own, so that no factor of 2 or J is lost between them.
//!
//! | type | maps | value | symmetry |
//! |---|---|---|---|
//! | [`FirstPiolaTangent`] A | Ḟ ↦ Ṗ | ∂P/∂F | none (9×9) |
//! | [`MaterialTangent`] C | Ė ↦ Ṡ | ∂S/∂E = 2 ∂S/∂C | minor, major |
//! | [`LieTangent`] c | D ↦ upper-convected rate of τ | F F F F C | minor, major |
//! | [`TruesdellTangent`] | D ↦ Truesdell rate of T | c/J | minor, major |
//! | [`JaumannTangent`] (`DDSDDE` of Abaqus) | D ↦ Jaumann rate of τ, over J | c/J + T-terms | minor, major |
//! | `MinorSymmetric` of an [`ObjectiveRate`] | D ↦ that rate of τ, over J, or of T | c/J + T-terms | minor |
//!
//! ```text
//! A_iAjB = δ_ij S_AB + F_iC F_jD C_CADB        c_ijkl = F_iA F_jB F_kC F_lD C_ABCD
//! Jaumann = c/J + ½ (δ_ik T_jl + δ_il T_jk + T_ik δ_jl + T_il δ_jk)        τ°/J = T° + T tr D
//! ```
//! Tangents are stored without factors for shears; the matrix that multiplies engineering shears is made by
//! [`voigt`](piola_tensor::voigt). The second parameter of a type says whether the law has an energy
//! ([`Major`](piola_tensor::Major), the default) or not ([`Minor`](piola_tensor::Minor)).

mod first_piola;
pub(crate) mod kernels;
mod other_rates;
mod spatial;
mod types;

pub use other_rates::ObjectiveRate;
pub use types::{FirstPiolaTangent, JaumannTangent, LieTangent, MaterialTangent, TruesdellTangent};
