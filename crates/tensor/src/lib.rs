//! Tensors of second and fourth order in three dimensions.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod error;
mod fourth;
mod interchange;
mod invariants;
mod linear_space;
pub mod rotation;
mod rows;
mod scale;
mod skew;
mod slots;
pub mod spectral;
mod symmetric;
pub mod voigt;

pub use error::TensorError;
pub use fourth::{FourthOrder, Major, MajorSymmetric, Minor, MinorSymmetric, PairSymmetric, Symmetry};
pub use invariants::principal_invariants;
pub use rows::Rows;
pub use skew::Skew;
pub use slots::{PAIR, SLOT, Slots};
pub use symmetric::Symmetric;

/// What only Piola's own crates need: kernels on plain arrays, checks, and macros of tensors with a meaning.
#[doc(hidden)]
pub mod internal {
    pub use crate::error::{check_finite, check_range};
    pub use crate::interchange::write_rows;
    pub use crate::symmetric::definite::positive_definite;
    pub use crate::symmetric::kernels::product_symmetrized;
    pub use crate::{glam_matrices, glam_vectors, linear_space};

    /// Arrays of rows.
    pub mod rows {
        pub use crate::rows::*;
    }
    /// Scaling by powers of two.
    pub mod scale {
        pub use crate::scale::{largest, norm, power_of_two_scale, square_root};
    }
    /// Arrays of six by six components.
    pub mod fourth {
        pub use crate::fourth::kernels::{congruence_matrix, transform_major, transform_minor};
    }
    /// Principal frames.
    pub mod spectral {
        #[cfg(feature = "serde")]
        pub use crate::spectral::decomposition::check_principal;
        pub use crate::spectral::decomposition::{descending, lifted, turned};
        pub use crate::spectral::expansion::expand;
        pub use crate::spectral::frame::{
            UnturnedFrame, axes_in_order, combination, components_in, from_frame, gram, in_order, larger,
            largest_modulus, product_entry, smaller, unturned_frame, weighted,
        };
    }
}
