//! Tensors of second and fourth order in three dimensions.
//!
//! | | type | stored |
//! |---|---|---|
//! | any second-order tensor | `nalgebra::Matrix3<T>` | 9 |
//! | a symmetric one | [`Symmetric`] | 6 |
//! | a skew one | [`Skew`] | 3 |
//! | any fourth-order tensor | [`FourthOrder`] | 81 |
//! | one with minor symmetries | [`MinorSymmetric`] | 36 |
//! | one with the major symmetry too | [`MajorSymmetric`] | 21 |
//!
//! Vectors and matrices of six components, with their orders and factors for shears, are in [`voigt`]; push-forward and
//! pull-back in [`transport`]. Meaning is added by the types of [`stress`](crate::stress), which wrap these.

pub mod fourth;
pub(crate) mod linear_space;
pub(crate) mod measures;
pub(crate) mod rotation;
pub mod rows;
pub(crate) mod scale;
mod skew;
pub(crate) mod skew_measure;
mod slots;
pub mod symmetric;
pub mod transport;
pub mod voigt;

pub use fourth::{FourthOrder, Major, MajorSymmetric, Minor, MinorSymmetric, PairSymmetric, Symmetry};
pub use skew::Skew;
pub use slots::{PAIR, SLOT, Slots};
pub use symmetric::Symmetric;
