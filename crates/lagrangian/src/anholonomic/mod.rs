//! Equations of motion in quasi-velocities: velocity components in a non-coordinate frame.
//!
//! ```text
//! q̇ = k_A u^A + d                                            W(6.12), W(6.15)
//! [k_A, k_B] = K^C_AB k_C                                     W(6.13)
//! d/dt(∂L̄/∂u^A) − k_A(L̄) + K^C_AB u^B ∂L̄/∂u^C = Ω_A          W(6.29)
//! ```
//!
//! The angular velocity of a body is the best known example: no angles have it as their rates. Rolling is the
//! other: where some u^h (what slips) are held at zero, the equations of the others are complete, and those of
//! u^h give the reactions.
//!
//! | to get | call |
//! |---|---|
//! | a Lagrangian system in quasi-velocities | [`Lagrangian::in_frame`], [`Lagrangian::in_coframe`] |
//! | K^C_AB | [`structure_coefficients`] |
//! | u̇, and q̈ | [`InFrame::acceleration`], [`InFrame::coordinate_acceleration`] |
//! | the Boltzmann–Hamel equations term by term | [`InFrame::boltzmann_hamel`] |
//! | the motion with some u held, its reactions | [`InFrame::holding`], [`Nonholonomic`] |
//! | the motion in time | [`Nonholonomic::integrate`], or a field for any integrator: [`Nonholonomic::motion`] |
//! | a sphere, a disc, a blade on a plane | [`rolling`] |
//! | the angular velocity in body axes | [`BodyAngularVelocity`] |
//!
//! Give vectors k_A ([`AnholonomicFrame`]) where you know directions of motion; give forms u^A = A^A_C q̇^C + a^A
//! ([`Coframe`]) where you know what is to be zero. Signs: K is that of the bracket above; on SO(3) in body axes
//! K^k_ij = +ε_ijk, which gives Euler's equations.
//!
//! [`Lagrangian::in_frame`]: crate::Lagrangian::in_frame
//! [`Lagrangian::in_coframe`]: crate::Lagrangian::in_coframe

mod boltzmann_hamel;
mod frame;
mod in_frame;
mod map;
mod nonholonomic;
pub mod rolling;
mod rotation;
mod run;
mod solve;
mod workspace;

pub use boltzmann_hamel::BoltzmannHamel;
pub use frame::{AnholonomicFrame, ByCoframe, ByFrame, Coframe, QuasiVelocities};
pub use in_frame::{InFrame, QuasiMotion, drift_coefficients, structure_coefficients};
pub use nonholonomic::{ConstrainedMotion, Nonholonomic};
pub use rotation::BodyAngularVelocity;
pub use workspace::Workspace;
