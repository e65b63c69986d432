//! Tensors of second and fourth order in three dimensions.
//!
//! | | type | stored |
//! |---|---|---|
//! | any second-order tensor | `nalgebra::Matrix3<T>` | 9 |
//! | a symmetric one | [`Symmetric`] | 6 |
//!
//! Meaning is added by the types of [`stress`](crate::stress), which wrap these.

pub mod rows;
pub mod symmetric;

pub use symmetric::Symmetric;
