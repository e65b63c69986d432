//! Homogeneous motions that every body of a class can perform, and tests of motions.
//!
//! ```text
//! x = F(t) X + c(t)        b = F̈ X + c̈        W(22.7)
//! ```
//! | motion | needs boundary tractions alone in | test |
//! |---|---|---|
//! | F = F₀ t + F₁, c linear, W(22.8) | every simple material | [`MotionConditions::acceleration`] |
//! | det F = 1, F̈ F⁻¹ symmetric, W(22.21) | every incompressible simple material | [`MotionConditions::volume`], [`MotionConditions::circulation`] |
//!
//! A motion is a [`HomogeneousMotion`](piola_continuum::rates::HomogeneousMotion). Constant stretch histories and viscometric
//! motions, W(22.29–22.33), have their tests in `piola_continuum::rates`: `stretch_history` and `viscometric_motion`.
//!
//! # Source
//! W §22; B. D. Coleman and C. Truesdell, Z. angew. Math. Mech. 45 (1965) 547.

mod conditions;
mod configuration;
mod lifetime;

pub use conditions::{MotionConditions, acceleration_potential, body_force, simple_shearing, steady_extension};
pub use configuration::{MaterialSymmetry, configuration_residual};
pub use lifetime::{Lifetime, lifetime};
