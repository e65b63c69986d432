//! Tests of equilibria, linearisation, modes and stability.

mod conditioning;
mod counts;
mod equilibria;
mod linearisation;
mod modes;
mod stability;
mod systems;
