//! The functions that C calls; `include/piola.h` declares them.
//!
//! Every function checks its pointers and lengths, catches panics, and returns a [`PiolaStatus`]. After a status other than
//! `PIOLA_STATUS_OK`, [`piola_last_error`](status::piola_last_error) has the message for the same thread. Laws are never changed, so threads may
//! share them; a law must not be freed while another thread uses it.
//!
//! # Safety
//! Of every function: pointers lead to as many values as the lengths beside them say, texts end with a zero byte, handles come from
//! this library and were not freed, and outputs overlap nothing else.

pub mod abaqus;
pub mod fluids;
#[cfg(feature = "history")]
pub mod history;
mod memory;
pub mod solids;
pub mod status;

pub use status::PiolaStatus;
