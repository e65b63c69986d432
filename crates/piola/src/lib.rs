//! Mechanics from Lagrange to Cauchy.
//!
//! Piola is a set of small crates; this one re-exports them. Take it whole, or a single crate.
//!
//! # A guided tour
//!
//! **1. Say where things are.** A system is a map from generalised coordinates to places, written once over
//! any scalar:
//!
//! ```
//! # #[cfg(feature = "dynamics")] {
//! use nalgebra::Vector3;
//! use piola::lagrangian::{Holonomic, Lagrangian, Placement};
//! use piola::numerics::Real;
//!
//! struct Pendulum { length: f64 }
//! impl Holonomic for Pendulum {
//!     fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
//!         let (s, c) = q[0].sin_cos();
//!         let length = T::lit(self.length);
//!         bodies.particle(1.0, Vector3::new(length * s, T::zero(), -length * c));
//!     }
//! }
//!
//! // 2. Ask. A call computes what it returns, and nothing else.
//! let pendulum = Lagrangian::of(Pendulum { length: 2.0 }).with_gravity(10.0);
//! let quarter_turn = std::f64::consts::FRAC_PI_2;
//! let acceleration = pendulum.acceleration(&[quarter_turn], &[0.0], 0.0)?;
//! assert!((acceleration[0] + 5.0).abs() < 1e-15); // −g/l
//! let energies = pendulum.energies(&[0.0], &[3.0], 0.0)?;
//! assert_eq!(energies.kinetic, 18.0); // ½ m l² q̇²
//!
//! // 3. Run it, with a method chosen and named, and its error estimated…
//! use piola::integrators::{GaussLegendre, Order, State, Tolerance};
//! let run = pendulum.integrate(&[1.0], &[0.0], 0.0..10.0, Tolerance::relative(1e-12)?)?;
//! assert!(run.error_estimate() < 1e-9);
//!
//! // 4. …or by a method of your choice: symplectic, in canonical variables.
//! let mut state = State::new(0.0, vec![1.0, 0.0])?;
//! GaussLegendre::new(Order::Eight, 0.05)?.integrate_to(&mut pendulum.canonical_motion(1), &mut state, 10.0)?;
//! assert!((state.values[0] - run.last().0[0]).abs() < 1e-9);
//! # }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! **5. Differentiate anything.** Every formula runs over dual numbers, nested as deep as you like:
//!
//! ```
//! use piola::numerics::{Dual, Real};
//! fn energy<T: Real>(angle: T) -> T {
//!     -angle.cos()
//! }
//! let stiffness = energy(Dual::variable(Dual::variable(0.0_f64))).tangent.tangent;
//! assert_eq!(stiffness, 1.0);
//! ```
//!
//! # Where to look
//!
//! | area | module | feature |
//! |---|---|---|
//! | scalars, exact derivatives, lanes, small linear systems, compensated sums | [`numerics`] | always |
//! | particles, bodies, attitudes, inertia, placement maps | [`kinematics`] | `kinematics` |
//! | time stepping | [`integrators`] | `integrators` |
//! | time stepping on groups, variational, energy-keeping | [`geometric`] | `geometric` |
//! | stiff and constrained systems | [`stiff`] | `stiff` |
//! | Lagrange's equations, reactions, small motions, rolling, closed loops | [`lagrangian`] | `lagrangian` |
//! | phase space, Hamilton–Jacobi theory, wave fronts | [`hamiltonian`] | `hamiltonian` |
//! | attracting bodies, Kepler's motion | [`gravitation`] | `gravitation` |
//! | trees of rigid bodies in linear time | [`multibody`] | `multibody` |
//! | equations of first order by characteristics | [`characteristics`] | `characteristics` |
//! | tensors of three dimensions and their functions | [`tensor`] | `tensor` |
//! | deformation, strain, rates, stress, tangents at a point | [`continuum`] | `continuum` |
//! | millions of points in lanes | [`batch`] | `batch` |
//! | motions, coordinates, balances, integrals | [`fields`] | `fields` |
//! | laws of solids, internal constraints, memory | [`solids`] | `solids` |
//! | homogeneous specimens, and checks of laws | [`specimens`] | `specimens` |
//! | laws of one's own by their energy; sums of laws | [`laws`] | `laws` |
//! | solids with internal variables | [`inelastic`] | `inelastic` |
//! | any of them, chosen at run time | [`inelastic`], type `AnyInelastic` | `any-inelastic` |
//! | laws of fluids | [`fluids`] | `fluids` |
//! | viscometric flows and their inversion | [`viscometry`] | `viscometry` |
//! | exact solutions of nonlinear elasticity | [`solutions`] | `solutions` |
//! | parameters of laws from measurements | [`fit`] | `fit` |
//! | relaxation spectra | [`spectra`] | `spectra` |
//! | viscoelastic fluids from start-up, extension, normal stresses | [`fit`], module `nonlinear` | `nonlinear` |
//! | materially uniform bodies, dislocations, residual stress | [`uniformity`] | `uniformity` |
//! | elastic and viscous fields on a box | [`spectral`] | `spectral` |
//! | elastic and fluid registration of images | [`registration`] | `registration` |
//!
//! The feature `dynamics` is `lagrangian`, `hamiltonian` and `gravitation`; `constitutive` is `solids` and `fluids`.
//!
//! # Features
#![doc = document_features::document_features!()]
#![forbid(unsafe_code)]
#![cfg_attr(docsrs, feature(doc_cfg))]

#[cfg(feature = "batch")]
pub use piola_batch as batch;
#[cfg(feature = "characteristics")]
pub use piola_characteristics as characteristics;
#[cfg(feature = "continuum")]
pub use piola_continuum as continuum;
#[cfg(feature = "fields")]
pub use piola_fields as fields;
#[cfg(feature = "fit")]
pub use piola_fit as fit;
#[cfg(feature = "fluids")]
pub use piola_fluids as fluids;
#[cfg(feature = "geometric")]
pub use piola_geometric as geometric;
#[cfg(feature = "gravitation")]
pub use piola_gravitation as gravitation;
#[cfg(feature = "hamiltonian")]
pub use piola_hamiltonian as hamiltonian;
#[cfg(feature = "inelastic")]
pub use piola_inelastic as inelastic;
#[cfg(feature = "integrators")]
pub use piola_integrators as integrators;
#[cfg(feature = "kinematics")]
pub use piola_kinematics as kinematics;
#[cfg(feature = "lagrangian")]
pub use piola_lagrangian as lagrangian;
#[cfg(feature = "laws")]
pub use piola_laws as laws;
#[cfg(feature = "multibody")]
pub use piola_multibody as multibody;
pub use piola_numerics as numerics;
#[cfg(feature = "registration")]
pub use piola_registration as registration;
#[cfg(feature = "solids")]
pub use piola_solids as solids;
#[cfg(feature = "solutions")]
pub use piola_solutions as solutions;
#[cfg(feature = "specimens")]
pub use piola_specimens as specimens;
#[cfg(feature = "spectra")]
pub use piola_spectra as spectra;
#[cfg(feature = "spectral")]
pub use piola_spectral as spectral;
#[cfg(feature = "stiff")]
pub use piola_stiff as stiff;
#[cfg(feature = "tensor")]
pub use piola_tensor as tensor;
#[cfg(feature = "uniformity")]
pub use piola_uniformity as uniformity;
#[cfg(feature = "viscometry")]
pub use piola_viscometry as viscometry;

/// The snippets of the project's read-me and of the book run as tests.
#[cfg(all(doctest, feature = "full"))]
mod book {
    #[doc = include_str!("../../../README.md")]
    struct ReadMe;
    #[doc = include_str!("../../../docs/tutorials/tour.md")]
    struct Tour;
    #[doc = include_str!("../../../docs/tutorials/mechanisms.md")]
    struct Mechanisms;
    #[doc = include_str!("../../../docs/tutorials/phase-space.md")]
    struct PhaseSpace;
    #[doc = include_str!("../../../docs/tutorials/continuum.md")]
    struct Continuum;
    #[doc = include_str!("../../../docs/tutorials/solids.md")]
    struct Solids;
    #[doc = include_str!("../../../docs/tutorials/flows.md")]
    struct Flows;
    #[doc = include_str!("../../../docs/how-to/placements.md")]
    struct Placements;
    #[doc = include_str!("../../../docs/how-to/constraints.md")]
    struct Constraints;
    #[doc = include_str!("../../../docs/how-to/trees.md")]
    struct Trees;
    #[doc = include_str!("../../../docs/how-to/integrators.md")]
    struct Integrators;
    #[doc = include_str!("../../../docs/how-to/scalars.md")]
    struct Scalars;
    #[doc = include_str!("../../../docs/how-to/own-laws.md")]
    struct OwnLaws;
    #[doc = include_str!("../../../docs/how-to/fitting.md")]
    struct Fitting;
    #[doc = include_str!("../../../docs/how-to/finite-elements.md")]
    struct FiniteElements;
}
