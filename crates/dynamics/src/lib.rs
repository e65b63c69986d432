//! Analytical dynamics.
//!
//! | module | what |
//! |---|---|
//! | [`lagrangian`] | Lagrange's equations of any placement map, with a potential and applied forces |
//! | [`anholonomic`] | quasi-velocities: structure coefficients, Boltzmann–Hamel equations, rolling |
//! | [`constraints`] | constraints φ(q, t) = 0 with multipliers: closed loops, redundancy, RATTLE |
//! | [`small_motions`] | equilibria, linearisation about any state, normal and complex modes, stability |
//! | [`hamiltonian`] | functions, forms and maps of phase space, integrals and symmetries, for any H(q, p, t) |
//! | [`hamilton_jacobi`] | Hamilton–Jacobi equation, extremals between events, transversals, wave fronts |
//! | [`first_order_pde`] | first-order partial differential equations Φ(x, u, ∇u) = 0 by characteristics |
//! | [`newton_euler`] | Newton's and Euler's laws of particles and rigid bodies |
//! | [`rigid_motion`] | the rotation of a rigid body by unit quaternions |
//! | [`gravitation`] | many bodies attracting each other: direct summation in lanes, post-Newtonian term |
#![forbid(unsafe_code)]
#![cfg_attr(docsrs, feature(doc_cfg))]
#![expect(clippy::doc_markdown, reason = "symbols with indices, as g_ΔΓ, are not code")]
#![expect(clippy::needless_range_loop, reason = "the indices are those of the equations")]

pub mod anholonomic;
mod check;
pub mod constraints;
mod error;
pub mod first_order_pde;
pub mod gravitation;
pub mod hamilton_jacobi;
pub mod hamiltonian;
pub mod lagrangian;
pub mod newton_euler;
pub mod rigid_motion;
mod run;
pub mod small_motions;
#[cfg(feature = "serde")]
mod written;

pub use error::DynamicsError;
pub use run::Run;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadMe;
