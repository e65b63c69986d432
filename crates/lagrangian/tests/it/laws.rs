//! Identities that hold for every system and state.

mod lagrangian;
mod motion;
mod scalars;
