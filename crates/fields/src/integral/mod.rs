//! Integrals over bodies and parts of space, and what they state: resultants, transport, balance, virtual work.
//!
//! | to | use |
//! |---|---|
//! | integrate over a region or its boundary, exactly for polynomials of a degree | [`Quadrature`] |
//! | the same with an estimate of the error, or to a tolerance | [`EstimatedQuadrature`], [`AdaptiveQuadrature`] |
//! | say where | [`Cuboid`], [`Ball`], [`SphericalShell`], [`Ellipsoid`], [`Cylinder`], [`TetrahedralMesh`], any [`Region`] |
//! | follow a region in motion, and differentiate in time | [`MovedRegion`] with a dual time |
//! | mass, momentum, moment, kinetic energy; forces and power | [`Resultants`], [`ForceResultants`] |
//! | check the transport and divergence theorems | [`transport()`], [`transport_of_mass`], [`divergence_theorem`], [`tensor_divergence_theorem`] |
//! | check the balances of a part of a body | [`MassBalance`], [`IntegralBalance`], [`EnergyBalance`] |
//! | forces on the nodes of a body of tetrahedra, masses, energies | [`LinearTetrahedra`], [`QuadraticTetrahedra`] |
//! | let such a body move | [`ExplicitMotion`] |
//!
//! ```text
//! ∫ g dv over χ(𝒫, t) = ∫ g J dV over 𝒫          n da = J F⁻ᵀ N dA
//! ```
//!
//! Nothing is allocated after construction. Integrands may be scalars, vectors and tensors over any
//! [`Real`](piola_numerics::Real): integrals of duals carry the derivative of the integral.
//!
//! # References
//! W(15.4–15.18), W(17.1–17.3), W(20.4), W(21.4); B(4.25), B(4.38–4.40), B(4.58–4.61).

mod balance;
mod element;
mod energy_balance;
mod estimate;
mod mass_balance;
mod mesh;
mod quadrature;
mod region;
mod resultants;
mod transport;

pub use crate::integrand::Integrand;
pub use balance::{IntegralBalance, stress_power};
pub use element::{ExplicitMotion, LinearTetrahedra, MaterialPoint, QuadraticTetrahedra, TetrahedralElements};
pub use energy_balance::{EnergyBalance, StoredEnergy, strain_energy};
pub use estimate::{AdaptiveQuadrature, Estimate, EstimatedQuadrature};
pub use mass_balance::MassBalance;
pub use mesh::{BoundaryTriangle, TetrahedralMesh};
pub use quadrature::Quadrature;
pub use region::{Ball, Cuboid, Cylinder, Ellipsoid, MovedRegion, Region, SphericalShell, SurfacePoint, VolumePoint};
pub use resultants::{ForceResultants, Resultants};
pub use transport::{Sides, Transport, divergence_theorem, tensor_divergence_theorem, transport, transport_of_mass};
