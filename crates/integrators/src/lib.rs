//! Time stepping for mechanics, over any scalar.
//!
//! | method | for | order | step |
//! |---|---|---|---|
//! | [`Composition`] | separable systems q̇ = u(t, p), ṗ = w(t, q): explicit, symplectic | 2, 4, 6, 8 | fixed |
//! | [`GaussLegendre`] | any field: implicit, symplectic in canonical variables | 2, 4, 6, 8 | fixed |
//! | [`DormandPrince853`] | any smooth field: explicit, dense output, events | 8(5,3) | adaptive |
//!
//! All three update the state with compensation, allocate nothing in a step, show every step to an observer
//! that may stop the run, and leave the last good state behind when they fail. All are generic over
//! [`Real`](piola_numerics::Real): over dual numbers a run yields its derivative with respect to initial
//! values or parameters, over lanes it advances several systems at once.
//!
//! # Which one?
//! - Energy must not drift over many periods, and the system separates: [`Composition`] of order 8.
//! - The same, but it does not separate (velocity-dependent forces, curved configuration space):
//!   [`GaussLegendre`] in canonical variables.
//! - Close encounters, prescribed output times, events, damping: [`DormandPrince853`].
//!
//! # Example
//! ```
//! use piola_integrators::{DormandPrince853, State, Tolerance, field};
//! let mut oscillator = field(2, |_t, y: &[f64], rate: &mut [f64]| {
//!     rate[0] = y[1];
//!     rate[1] = -y[0];
//! });
//! let mut state = State::new(0.0, vec![0.0, 1.0])?;
//! DormandPrince853::new(Tolerance::relative(1e-13)?).integrate_to(&mut oscillator, &mut state, 1.0)?;
//! assert!((state.values[0] - 1.0_f64.sin()).abs() < 1e-13);
//! # Ok::<(), piola_integrators::IntegratorsError>(())
//! ```
#![forbid(unsafe_code)]
#![cfg_attr(docsrs, feature(doc_cfg))]

mod composition;
mod dormand_prince;
mod error;
mod field;
mod gauss_legendre;
mod state;
mod tolerance;

pub use composition::{Composition, Order};
pub use dormand_prince::{Crossing, DenseStep, DormandPrince853, Event, EventAction, Occurrence};
pub use error::IntegratorsError;
pub use field::{Field, FunctionField, Separable, field, separable};
pub use gauss_legendre::GaussLegendre;
pub use state::{Ending, Report, State, Step, unobserved};
pub use tolerance::Tolerance;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadMe;
