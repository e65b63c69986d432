//! The laws of conspire beside ours: see the bench.

#[path = "../../../src/notes.rs"]
pub mod notes;
