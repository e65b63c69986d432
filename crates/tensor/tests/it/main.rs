//! Identities, traps and formats of tensors of second and fourth order, of Voigt's and Mandel's maps.

mod cases;
mod laws;
mod spectral;
mod traps;
#[cfg(feature = "serde")]
mod written;
