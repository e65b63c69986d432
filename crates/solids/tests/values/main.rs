//! Laws of solids against values that an independent script computed, and against values by hand.

mod laws;
mod membrane;
mod memory;
#[path = "../invariant/once.rs"]
mod once;
mod volumes;
