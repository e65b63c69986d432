//! Laws of principal stretches and anisotropic laws.

mod cases;
mod derived;
mod identities;
mod near_reference;
#[path = "../invariant/once.rs"]
mod once;
mod traps;
