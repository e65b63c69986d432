//! Hamilton–Jacobi theory: solutions, complete integrals, extremals between events, transversals and wave fronts.
//!
//! ```text
//! ∂U/∂t + H(q, ∂U/∂q, t) = 0                                                               W(11.19)
//! ```
//!
//! Momenta are p = +∂U/∂q throughout (U = −W of the generating functions of W(11.7)).
//!
//! | to get | use |
//! |---|---|
//! | how far a function is from solving the equation | [`Candidate`], [`StationaryCandidate`] |
//! | the trajectories that belong to a solution | [`ExtremalField`] |
//! | Monge and characteristic strips | [`StripResidual`], [`CharacteristicStrip`] |
//! | the motion from a complete integral | [`Constants`] |
//! | the motion of a system that separates, by quadratures | [`SeparableMotion`] |
//! | all extremals between two events, with their actions; whether any is missing | [`GeodeticDistance`] |
//! | all extremals that leave one event | [`IntegralConoid`] |
//! | the solution with given initial values, its caustics | [`Transversals`] |
//! | a level of that solution as the envelope of what an earlier one emits | [`Transversals::envelope_event`] |
//! | wave fronts in the plane and in space | [`WaveFront`] |

mod candidate;
mod complete_integral;
mod conoid;
mod degree;
mod events;
mod extremal_field;
mod fronts;
mod geodetic_distance;
mod levels;
mod momentum_length;
mod morse;
mod separable;
mod sheets;
mod strips;
mod transversals;

pub use crate::ray::RayField;
pub use candidate::{Candidate, PrincipalFunction, Residual, StationaryCandidate};
pub use complete_integral::{CompleteIntegral, Constants};
pub use conoid::{ConoidPoint, ConoidRay, IntegralConoid};
pub use events::{Event, SearchRegion};
pub use extremal_field::{ExtremalField, FieldExtremal};
pub use fronts::{ArrivedPiece, FrontRay, FrontReport, InitialFront, Mesh, WaveFront};
pub use geodetic_distance::{Extremal, GeodeticDistance};
pub use levels::LevelPoint;
pub use morse::ConjugatePoint;
pub use separable::{FixedCentres, KeplerParabolic, KeplerPolar, Separable, SeparableMotion, SeparatedIntegral};
pub use strips::{CharacteristicStrip, Strip, StripResidual};
pub use transversals::{Transversal, TransversalPoint, Transversals};
