//! Identities that hold for every system and state.

mod gravitation;
mod lagrangian;
mod motion;
mod scalars;
