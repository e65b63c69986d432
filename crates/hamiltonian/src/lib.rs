//! Hamiltonian mechanics on phase space, for any function H(q, p, t).
//!
//! ```text
//! q̇ = ∂H/∂p        ṗ = −∂H/∂q                                                           W(9.10)
//! ```
//!
//! A function on phase space is a [`PhaseFunction`]: one generic formula, differentiated exactly. What can be asked:
//!
//! | to get | use |
//! |---|---|
//! | the motion in time, by any integrator | [`HamiltonianField`] |
//! | H of a Lagrangian, and dH without differentiating H | [`LegendreTransform`], [`Lagrangian::hamiltonian`](piola_lagrangian::Lagrangian::hamiltonian) |
//! | dK, (K_p, −K_q), ∂K/∂t, ∂²K | [`differential`], [`symplectic_gradient`], [`time_derivative`], [`hessian`] |
//! | {K, H}, nested; dK/dt along the motion | [`poisson_bracket`], [`Bracket`], [`rate_along`] |
//! | velocities and momenta in other coordinates | [`TangentVector`], [`CotangentVector`] |
//! | θ, ω, θ̃, ω̃ as forms; d; ω as a map | [`CanonicalOneForm`], [`CanonicalTwoForm`], [`ExtendedOneForm`], [`ExtendedTwoForm`], [`exterior_derivative`] |
//! | Lie derivatives; whether a field is locally Hamiltonian | [`lie_derivative_of_function`], [`lie_derivative_of_one_form`], [`lie_derivative_of_two_form`], [`locally_hamiltonian_test`] |
//! | whether a map is canonical, or a contact transformation | [`canonical_test`], [`contact_test`], [`require_canonical`] |
//! | a map from a generating function, under identities too | [`Generated`], [`DegenerateGenerated`] |
//! | maps ready made, composed, inverted | [`PointTransformation`], [`PolarCoordinates`], [`SphericalCoordinates`], [`OscillatorActionAngle`], [`Delaunay`], [`RotatingFrame`], [`Composed`], [`Inverse`] |
//! | H and K in new coordinates | [`TransformedHamiltonian`], [`PulledBack`] |
//! | whether K is an integral; its symmetry; K of a symmetry | [`integral_test`], [`symmetry_flow`], [`integral_of_symmetry`] |
//! | involution and independence of integrals; integrals among candidates | [`involution_test`], [`integrals_among`] |
//! | a trajectory from 2n − 1 integrals | [`trajectory_from_integrals`] |
//! | Poincaré sections, Lyapunov exponents | [`PoincareSection`], [`lyapunov_exponents`], [`lyapunov_exponents_observed`] |
#![forbid(unsafe_code)]
#![cfg_attr(docsrs, feature(doc_cfg))]
#![expect(clippy::doc_markdown, reason = "symbols with indices, as g_ΔΓ, are not code")]
#![expect(clippy::needless_range_loop, reason = "the indices are those of the equations")]

mod bracket;
mod candidates;
mod canonical;
mod check;
mod composition;
mod degenerate;
pub(crate) mod differential;
mod error;
mod field;
mod forms;
mod function;
mod generating;
pub mod hamilton_jacobi;
mod integrals;
mod legendre;
mod lie_derivative;
mod lyapunov;
pub(crate) mod newton;
mod noether;
mod partial_derivatives;
mod ray;
mod section;
mod tangent;
mod trajectory;
mod transformations;

pub use bracket::{Bracket, poisson_bracket, rate_along};
pub use candidates::{IntegralsFound, integrals_among};
pub use canonical::{
    CanonicalTest, InvertiblePhaseMap, PhaseMap, PulledBack, TransformedHamiltonian, canonical_test, contact_test,
    image_and_jacobian, require_canonical,
};
pub use composition::{Composed, Inverse, InvertedByNewton};
pub use degenerate::{DegenerateGenerated, Identities};
pub use differential::{differential, hessian, symplectic_gradient, time_derivative};
pub use error::{HamiltonJacobiError, HamiltonianError};
pub use field::HamiltonianField;
pub use forms::{
    CanonicalOneForm, CanonicalTwoForm, Differential, ExtendedOneForm, ExtendedTwoForm, OneForm, SymplecticGradient,
    TwoForm, VectorField, closedness_residual, exterior_derivative, raise,
};
pub use function::PhaseFunction;
pub use generating::{Generated, GeneratingFunction, GeneratingKind};
pub use integrals::{IntegralTest, Involution, PhaseFunctions, PhasePoint, integral_test, involution_test};
pub use legendre::LegendreTransform;
pub use lie_derivative::{
    LocallyHamiltonianTest, lie_derivative_of_function, lie_derivative_of_one_form, lie_derivative_of_two_form,
    locally_hamiltonian_test,
};
pub use lyapunov::{LyapunovExponents, lyapunov_exponents, lyapunov_exponents_observed};
pub use noether::{Generator, OneParameterGroup, SymmetryFlow, integral_of_symmetry, symmetry_flow};
pub use section::PoincareSection;
pub use tangent::{CotangentVector, TangentVector};
pub use trajectory::trajectory_from_integrals;
pub use transformations::{
    Delaunay, KeplerOfActions, OscillatorActionAngle, PointTransformation, PolarCoordinates, RotatingFrame,
    SphericalCoordinates,
};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadMe;
