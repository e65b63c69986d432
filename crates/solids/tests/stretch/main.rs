//! Laws of principal stretches and anisotropic laws.

mod cases;
mod derived;
mod identities;
mod near_reference;
mod traps;
