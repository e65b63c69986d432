//! First-order partial differential equations Φ(x, u, ∇u) = 0 in m variables, by characteristics.
//!
//! ```text
//! x′ = Φ_ξ,    u′ = ξ·Φ_ξ,    ξ′ = −(ξ Φ_u + Φ_x),    ξ = ∇u                             W(A.38)
//! ```
//!
//! | to | use |
//! |---|---|
//! | state an equation, and data on a manifold | [`FirstOrderPde`], [`InitialManifold`] |
//! | see in which directions solutions can touch | [`MongeCone`] |
//! | integrate characteristics with any method | [`CharacteristicField`], [`RayField`] |
//! | complete ξ, follow one characteristic, find its caustic points | [`CauchyProblem`] |
//! | know how many solutions there are, and why | [`CauchyProblem::classify`] |
//! | solve, refining the initial manifold | [`CauchyProblem::solve`] |
//! | evaluate on all sheets, at first arrival, on a grid, at many points | [`CharacteristicSolution`] |
//! | find where the solution first breaks | [`CharacteristicSolution::first_loss_of_invertibility`] |
//! | advance many characteristics at once | [`Front`] |
//!
//! # References
//! C.-C. Wang, *Mathematical Principles of Mechanics and Electromagnetism*, Part A, appendix to chapter 2; R. Courant
//! and D. Hilbert, *Methods of Mathematical Physics* II, chapter II.
#![forbid(unsafe_code)]
#![cfg_attr(docsrs, feature(doc_cfg))]
#![expect(clippy::doc_markdown, reason = "symbols with indices, as g_ΔΓ, are not code")]
#![expect(clippy::needless_range_loop, reason = "the indices are those of the equations")]

mod check;
mod classification;
mod determinant;
mod equation;
mod error;
mod field;
mod front;
mod grid;
mod loss;
mod manifold;
mod mesh;
mod monge;
mod partials;
mod patch;
mod problem;
mod ray;
mod roots;
mod sheets;
mod solution;
mod strip;
mod strip_kind;

pub use classification::{Classification, DegeneratePoint};
pub use equation::FirstOrderPde;
pub use error::{CharacteristicsError, StripError};
pub use field::{CharacteristicField, RayField};
pub use front::Front;
pub use grid::{Grid, GridSolution, GridValue, Overlap};
pub use loss::FirstLoss;
pub use manifold::{Covector, InitialManifold};
pub use mesh::ParameterInterval;
pub use monge::{Generator, MongeCone, MongeResidual};
pub use problem::{CauchyProblem, RayPoint};
pub use ray::{CausticPoint, Ray};
pub use roots::Search;
pub use sheets::Sheet;
pub use solution::{CharacteristicSolution, Refinement};
pub use strip::InitialPoint;
pub use strip_kind::StripKind;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadMe;
