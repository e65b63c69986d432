//! The tests of `piola-solids`.

mod golden;
#[path = "../invariant/once.rs"]
mod once;
mod range;
mod single;
