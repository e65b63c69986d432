//! Tensors of fourth order.
//!
//! | symmetries | type | stored | typical |
//! |---|---|---|---|
//! | none | [`FourthOrder`] | 9×9, row 3i + j, column 3k + l | ∂P/∂F |
//! | minor, `C_ijkl = C_jikl = C_ijlk` | [`MinorSymmetric`] | 6×6 | tangent with the Green–Naghdi rate |
//! | minor and major, `C_ijkl = C_klij` | [`MajorSymmetric`] | 21 | ∂S/∂E of an energy |
//!
//! Stored are the components themselves, by pairs of indices in the order 11, 22, 33, 12, 23, 13, without factors
//! for shears: matrices with factors are types of their own, in [`voigt`](super::voigt).
//!
//! ```text
//! (C : A)_ij = C_ijkl A_kl      (A : C)_kl = A_ij C_ijkl      (C : D)_ijkl = C_ijmn D_mnkl
//! (A ⊗ B)_ijkl = A_ij B_kl      (A ⊗̄ B)_ijkl = A_ik B_jl      (A ⊗̲ B)_ijkl = A_il B_jk
//! ```

mod conversions;
mod general;
pub(crate) mod kernels;
mod major;
mod minor;
mod symmetry;

pub use general::FourthOrder;
pub use major::MajorSymmetric;
pub use minor::MinorSymmetric;
pub use symmetry::{Major, Minor, PairSymmetric, Symmetry};
